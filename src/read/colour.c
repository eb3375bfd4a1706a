#include "read/colour.h"
#include "base/number.h"
#include "lines/lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

char rg_colour_assignment(rg_colour c)
{
    const double high = fmax(c.r, fmax(c.g, c.b)), low = fmin(c.r, fmin(c.g, c.b)), range = high - low;
    if (high < 0.2) return RG_BORDER;
    if (range < 0.25 * high) return high < 0.3 ? RG_BORDER : RG_FLAT;
    double hue = high == c.r ? (c.g - c.b) / range : high == c.g ? 2 + (c.b - c.r) / range : 4 + (c.r - c.g) / range;
    hue = 60 * (hue < 0 ? hue + 6 : hue);
    static const struct { double to; char assignment; } hues[] = {
        {20, RG_MOUNTAIN}, {48, RG_UNASSIGNED}, {75, RG_FLAT}, {165, RG_BORDER}, {200, RG_FLAT}, {270, RG_VALLEY},
        {335, RG_UNASSIGNED}};
    for (size_t i = 0; i < sizeof hues / sizeof *hues; i++)
        if (hue < hues[i].to) return hues[i].assignment;
    return RG_MOUNTAIN;
}

/* Greens and the dark grays at the end of the index are borders, greens and 7 by ORIPA, 250 by it and Oriedita. */
char rg_colour_index_assignment(int i)
{
    if (i == 1 || (i >= 10 && i <= 39)) return RG_MOUNTAIN;
    if (i == 2 || i == 5 || (i >= 140 && i <= 199)) return RG_VALLEY;
    if (i == 3 || i == 7 || (i >= 60 && i <= 129) || i == 250) return RG_BORDER;
    return RG_FLAT;
}

/* Those of CSS's names that a drawing of creases may have; nearest relatives of the assignments and the grays. */
static const struct { const char *name; unsigned rgb; } named[] = {
    {"aqua", 0x00ffff}, {"black", 0x000000}, {"blue", 0x0000ff}, {"blueviolet", 0x8a2be2}, {"brown", 0xa52a2a},
    {"cornflowerblue", 0x6495ed}, {"crimson", 0xdc143c}, {"cyan", 0x00ffff}, {"darkblue", 0x00008b},
    {"darkcyan", 0x008b8b}, {"darkgray", 0xa9a9a9}, {"darkgreen", 0x006400}, {"darkgrey", 0xa9a9a9},
    {"darkmagenta", 0x8b008b}, {"darkorange", 0xff8c00}, {"darkred", 0x8b0000}, {"darkslateblue", 0x483d8b},
    {"darkslategray", 0x2f4f4f}, {"deepskyblue", 0x00bfff}, {"dimgray", 0x696969}, {"dimgrey", 0x696969},
    {"dodgerblue", 0x1e90ff}, {"firebrick", 0xb22222}, {"forestgreen", 0x228b22}, {"fuchsia", 0xff00ff},
    {"gainsboro", 0xdcdcdc}, {"gold", 0xffd700}, {"gray", 0x808080}, {"green", 0x008000}, {"grey", 0x808080},
    {"indianred", 0xcd5c5c}, {"indigo", 0x4b0082}, {"lightblue", 0xadd8e6}, {"lightgray", 0xd3d3d3},
    {"lightgreen", 0x90ee90}, {"lightgrey", 0xd3d3d3}, {"lime", 0x00ff00}, {"limegreen", 0x32cd32},
    {"magenta", 0xff00ff}, {"maroon", 0x800000}, {"mediumblue", 0x0000cd}, {"midnightblue", 0x191970},
    {"navy", 0x000080}, {"olive", 0x808000}, {"orange", 0xffa500}, {"orangered", 0xff4500}, {"orchid", 0xda70d6},
    {"purple", 0x800080}, {"red", 0xff0000}, {"royalblue", 0x4169e1}, {"silver", 0xc0c0c0}, {"skyblue", 0x87ceeb},
    {"slateblue", 0x6a5acd}, {"slategray", 0x708090}, {"steelblue", 0x4682b4}, {"teal", 0x008080}, {"tomato", 0xff6347},
    {"violet", 0xee82ee}, {"white", 0xffffff}, {"whitesmoke", 0xf5f5f5}, {"yellow", 0xffff00}};

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

static int same(const char *s, size_t n, const char *word)
{
    size_t i = 0;
    while (i < n && word[i] && lower(s[i]) == word[i]) i++;
    return i == n && !word[i];
}

static int hex(const char *s, size_t n, rg_colour *c, double *alpha)
{
    double v[4] = {0, 0, 0, 1};
    const size_t each = n < 6 ? 1 : 2;
    if (n != 3 && n != 4 && n != 6 && n != 8) return 0;
    for (size_t i = 0; i < n; i += each) {
        char digits[3] = {s[i], s[i + each - 1], 0}, *end;
        if (!strchr("0123456789abcdefABCDEF", digits[0])) return 0;
        v[i / each] = (double)strtol(digits, &end, 16) / 255;
        if (*end) return 0;
    }
    *c = (rg_colour){v[0], v[1], v[2]};
    *alpha = v[3];
    return 1;
}

static double clamp(double x) { return x >= 0 ? fmin(x, 1) : 0; }

/* The part of red, green (4 further on) or blue (8 further on) in a hue of 0 ... 12. */
static double part(double from, double hue, double s, double l)
{
    const double k = fmod(from + hue, 12), a = s * fmin(l, 1 - l);
    return l - a * fmax(-1, fmin(fmin(k - 3, 9 - k), 1));
}

/* rgb(...) and hsl(...): three numbers and perhaps an alpha; commas, blanks or / between them. */
static int function(const char *s, size_t n, rg_colour *c, double *alpha)
{
    const int is_hsl = n > 4 && same(s, 3, "hsl");
    if (n < 6 || s[n - 1] != ')' || !(is_hsl || same(s, 3, "rgb"))) return 0;
    size_t at = lower(s[3]) == 'a' ? 4 : 3;
    if (s[at++] != '(') return 0;
    double v[4] = {0, 0, 0, 1};
    int count = 0;
    for (n--; at < n;) {
        if (strchr(" ,/\t\r\n", s[at])) {
            at++;
            continue;
        }
        double x;
        const size_t used = rg_number_scan(s + at, n - at, &x);
        if (used == 0 || count == 4) return 0;
        at += used;
        const int percent = at < n && s[at] == '%';
        if (n - at >= 3 && same(s + at, 3, "deg")) at += 3;
        at += (size_t)percent;
        if (percent) x /= 100;
        else if (count < 3 && !is_hsl) x /= 255;
        v[count++] = x;
    }
    if (count < 3 || !isfinite(v[0])) return 0;
    for (int i = is_hsl; i < 4; i++) v[i] = clamp(v[i]);
    double hue = fmod(v[0], 360) / 30;
    if (hue < 0) hue += 12;
    *c = is_hsl ? (rg_colour){part(0, hue, v[1], v[2]), part(8, hue, v[1], v[2]), part(4, hue, v[1], v[2])}
                : (rg_colour){v[0], v[1], v[2]};
    *alpha = v[3];
    return 1;
}

int rg_colour_parse(const char *s, rg_colour *c, double *alpha)
{
    *alpha = 1;
    s += strspn(s, " \t\r\n");
    size_t n = strlen(s);
    while (n > 0 && strchr(" \t\r\n", s[n - 1])) n--;
    if (n > 100) return 0;
    if (*s == '#') return hex(s + 1, n - 1, c, alpha);
    for (size_t i = 0; i < sizeof named / sizeof *named; i++)
        if (same(s, n, named[i].name)) {
            const unsigned rgb = named[i].rgb;
            *c = (rg_colour){(rgb >> 16) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
            return 1;
        }
    return function(s, n, c, alpha);
}
