#include "read/kinds.h"
#include "base/status.h"
#include "read/colour.h"

#include <stdlib.h>
#include <string.h>

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

/* What a layer or a class is called is said at the beginning. */
enum { LONGEST_NAME = 255 };

static int same(const char *s, size_t n, const char *word, size_t word_n)
{
    size_t i = 0;
    while (i < n && i < word_n && lower(s[i]) == lower(word[i])) i++;
    return i == n && i == word_n;
}

static const struct { const char *name; char assignment; } KINDS[] = {
    {"border", RG_BORDER}, {"cut", RG_BORDER}, {"mountain", RG_MOUNTAIN}, {"valley", RG_VALLEY},
    {"unassigned", RG_UNASSIGNED}, {"aux", RG_FLAT}, {"none", RG_LEFT_OUT}};

/* A KEY may have a = in it, a KIND has not. */
char rg_kinds_letter(const rg_reading *s, int i)
{
    const char *equals = strrchr(s->kind[i], '=');
    for (size_t k = 0; equals && k < sizeof KINDS / sizeof *KINDS; k++)
        if (same(equals + 1, strlen(equals + 1), KINDS[k].name, strlen(KINDS[k].name))) return KINDS[k].assignment;
    return 0;
}

rg_status rg_kinds_check(const rg_reading *s, rg_diag *why)
{
    if (s->kinds > RG_MOST_KINDS) return rg_fail(RG_EARG, why, 0, "more than %d kinds of lines", (int)RG_MOST_KINDS);
    for (int i = 0; i < s->kinds; i++)
        if (!rg_kinds_letter(s, i) || s->kind[i][0] == '=')
            return rg_fail(RG_EARG, why, 0,
                           "\"%.60s\" is not KEY=KIND, KIND one of border, cut, mountain, valley, unassigned, aux, "
                           "none",
                           s->kind[i]);
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------------------- colours ---- */

/* Those of AutoCAD's numbers that have a name there. */
static int index_of(const char *s, size_t n)
{
    static const char *const names[] = {"", "red", "yellow", "green", "cyan", "blue", "magenta", "white"};
    char digits[8] = "";
    if (n == 0 || n >= sizeof digits) return 0;
    memcpy(digits, s, n);
    if (strspn(digits, "0123456789") == n) return (int)strtol(digits, NULL, 10);
    for (int i = 1; i < 8; i++)
        if (same(s, n, names[i], strlen(names[i]))) return i;
    return 0;
}

/* A colour is the same however it is written. */
static int same_colour(const char *key, size_t key_n, const char *name, size_t n)
{
    char a[RG_TRAIT_ROOM] = "", b[RG_TRAIT_ROOM] = "";
    double alpha;
    rg_colour p, q;
    if (key_n >= sizeof a || n >= sizeof b) return 0;
    memcpy(a, key, key_n);
    memcpy(b, name, n);
    const int number = n > 0 && strspn(b, "0123456789") == n;
    if (number) return index_of(name, n) > 0 && index_of(key, key_n) == index_of(name, n);
    const double half = 0.5 / 255;
    return rg_colour_parse(a, &p, &alpha) && rg_colour_parse(b, &q, &alpha) && fabs(p.r - q.r) < half &&
           fabs(p.g - q.g) < half && fabs(p.b - q.b) < half;
}

/* ------------------------------------------------------------------------------------------------------ dashes ---- */

static const char *skip(const char *s, const char *end)
{
    while (s < end && (*s == ' ' || *s == ',' || *s == '\t')) s++;
    return s;
}

/* Lists of lengths, whatever stands between them. */
static int same_dash(const char *a, size_t a_n, const char *b, size_t b_n)
{
    const char *const a_end = a + a_n, *const b_end = b + b_n;
    for (;;) {
        a = skip(a, a_end), b = skip(b, b_end);
        if (a == a_end || b == b_end) return a == a_end && b == b_end;
        const char *p = a, *q = b;
        while (p < a_end && skip(p, a_end) == p) p++;
        while (q < b_end && skip(q, b_end) == q) q++;
        if (!same(a, (size_t)(p - a), b, (size_t)(q - b))) return 0;
        a = p, b = q;
    }
}

/* -------------------------------------------------------------------------------------------------------- find ---- */

int rg_kinds_find(const rg_reading *s, rg_trait_sort sort, const char *name, size_t n)
{
    static const char *const prefix[RG_TRAIT_SORTS][2] = {
        {"colour:", "color:"}, {"layer:", "name:"}, {"dash:", "linetype:"}};
    for (int i = s->kinds - 1; n > 0 && i >= 0; i--) {
        const char *key = s->kind[i];
        size_t key_n = (size_t)(strrchr(key, '=') - key);
        int other = 0;
        for (int k = 0; k < RG_TRAIT_SORTS; k++)
            for (int spelling = 0; spelling < 2; spelling++) {
                const size_t before = strlen(prefix[k][spelling]);
                if (key_n <= before || !same(key, before, prefix[k][spelling], before)) continue;
                key += before, key_n -= before;
                other = k != (int)sort;
            }
        if (other) continue;
        if (same(key, key_n, name, n)) return i;
        if (sort == RG_BY_COLOUR && same_colour(key, key_n, name, n)) return i;
        if (sort == RG_BY_DASH && same_dash(key, key_n, name, n)) return i;
    }
    return -1;
}

rg_status rg_kinds_warn_unused(const rg_reading *s, rg_lines *l)
{
    rg_status status = RG_OK;
    for (int i = 0; status == RG_OK && i < s->kinds; i++) {
        if (l->kinds_used >> i & 1) continue;
        char there[140] = "";
        size_t n = 0;
        for (int32_t k = 0; k < l->traits && n + RG_TRAIT_ROOM + 2 < sizeof there; k++) {
            memcpy(there + n, k ? ", " : "", k ? 2 : 0);
            n += k ? 2 : 0;
            memcpy(there + n, l->trait[k].name, strlen(l->trait[k].name));
            n += strlen(l->trait[k].name);
        }
        status = rg_lines_warn(l, 0, "--line %.40s: no line is of that colour, layer, name or dash; there are: %s",
                               s->kind[i], n ? there : "none in this format");
    }
    return status;
}

char rg_kinds_of_name(const char *name, size_t n)
{
    static const struct { const char *word; char assignment; } words[] = {
        {"mountain", RG_MOUNTAIN}, {"valley", RG_VALLEY}, {"unassigned", RG_UNASSIGNED}, {"aux", RG_FLAT},
        {"facet", RG_FLAT}, {"flat", RG_FLAT}, {"construction", RG_FLAT}, {"guide", RG_FLAT}, {"annotation", RG_FLAT},
        {"dimension", RG_FLAT}, {"notes", RG_FLAT}, {"defpoints", RG_FLAT}, {"cut", RG_BORDER},
        {"border", RG_BORDER}, {"boundary", RG_BORDER}, {"contour", RG_BORDER}, {"outline", RG_BORDER}};
    if (n > LONGEST_NAME) n = LONGEST_NAME;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const size_t word = strlen(words[i].word);
        for (size_t at = 0; at + word <= n; at++)
            if (same(name + at, word, words[i].word, word)) return words[i].assignment;
    }
    return 0;
}
