#include "save/svg.h"
#include "base/file.h"
#include "base/number.h"
#include "base/utf8.h"

/* Parts of the drawing's size. */
static const double MARGIN = 0.05, STROKE = 0.002, DASH = 0.01;

static const char *colour(char assignment)
{
    switch (assignment) {
    case RG_BORDER: return "#000000";
    case RG_MOUNTAIN: return "#ff0000";
    case RG_VALLEY: return "#0000ff";
    case RG_FLAT: return "#ffff00";
    case RG_UNASSIGNED: return "#ff00ff";
    default: return "#808080";
    }
}

/* Text of an element; what XML cannot hold becomes U+FFFD. */
static void say(FILE *out, const char *before, const char *text, const char *after)
{
    if (!text) return;
    fputs(before, out);
    for (const unsigned char *s = (const unsigned char *)text; *s;) {
        const size_t n = rg_utf8_character(s);
        if (!rg_utf8_in_xml(s, n) || *s == '\r') fputs("\xEF\xBF\xBD", out);
        else if (*s == '&') fputs("&amp;", out);
        else if (*s == '<') fputs("&lt;", out);
        else if (*s == '>') fputs("&gt;", out);
        else fwrite(s, 1, n, out);
        s += n ? n : 1;
    }
    fputs(after, out);
}

static void attribute(FILE *out, const char *name, double x)
{
    char text[RG_NUMBER_ROOM];
    fprintf(out, " %s=\"%s\"", name, rg_number_print(text, x));
}

/* Mountains dash dot, valleys dashes, as folders draw them: so that they can be told apart without colours. */
static void dashes(FILE *out, char assignment, double size)
{
    const double d = DASH * size;
    char a[RG_NUMBER_ROOM], b[RG_NUMBER_ROOM], c[RG_NUMBER_ROOM];
    rg_number_print(a, 2 * d), rg_number_print(b, d), rg_number_print(c, d / 4);
    if (assignment == RG_MOUNTAIN) fprintf(out, " stroke-dasharray=\"%s %s %s %s\"", a, b, c, b);
    if (assignment == RG_VALLEY) fprintf(out, " stroke-dasharray=\"%s %s\"", a, b);
}

static void draw(FILE *out, const rg_line *l, double size)
{
    fprintf(out, "<line stroke=\"%s\"", colour(l->assignment));
    dashes(out, l->assignment, size);
    if (isfinite(l->target) && (l->assignment == RG_MOUNTAIN || l->assignment == RG_VALLEY))
        attribute(out, "opacity", fabs(l->target) / RG_PI);
    attribute(out, "x1", l->a.x);
    attribute(out, "y1", -l->a.y);
    attribute(out, "x2", l->b.x);
    attribute(out, "y2", -l->b.y);
    fputs("/>\n", out);
}

/* Returns the drawing's size. */
static double open_drawing(FILE *out, const rg_lines *l)
{
    rg_vec2 low = {0, 0}, high = low;
    for (int32_t i = 0; i < 2 * l->count; i++) {
        const rg_vec2 x = i % 2 ? l->line[i / 2].b : l->line[i / 2].a;
        low = i ? (rg_vec2){fmin(low.x, x.x), fmin(low.y, x.y)} : x;
        high = i ? (rg_vec2){fmax(high.x, x.x), fmax(high.y, x.y)} : x;
    }
    const double size = fmax(high.x - low.x, high.y - low.y), margin = MARGIN * size;
    char a[RG_NUMBER_ROOM], b[RG_NUMBER_ROOM], c[RG_NUMBER_ROOM], d[RG_NUMBER_ROOM];
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"", out);
    if (l->metres > 0) { /* as large on paper as the file says */
        fprintf(out, " width=\"%smm\"", rg_number_print(a, 1000 * l->metres * (high.x - low.x + 2 * margin)));
        fprintf(out, " height=\"%smm\"", rg_number_print(a, 1000 * l->metres * (high.y - low.y + 2 * margin)));
    }
    fprintf(out, " viewBox=\"%s %s %s %s\">\n",
            rg_number_print(a, low.x - margin), rg_number_print(b, -high.y - margin),
            rg_number_print(c, high.x - low.x + 2 * margin), rg_number_print(d, high.y - low.y + 2 * margin));
    say(out, "<title>", l->title, "</title>\n");
    say(out, "<desc>", l->memo, "</desc>\n");
    say(out, "<metadata><dc:creator xmlns:dc=\"http://purl.org/dc/elements/1.1/\">", l->author,
        "</dc:creator></metadata>\n");
    fputs("<g fill=\"none\" stroke-linecap=\"round\"", out);
    attribute(out, "stroke-width", STROKE * size);
    fputs(">\n", out);
    return size;
}

rg_status rg_svg_write(const rg_lines *l, const rg_dest *to, rg_diag *why)
{
    rg_file f;
    rg_status s = rg_file_begin_to(&f, &l->mem, to, why);
    if (s != RG_OK) return s;
    const double size = open_drawing(f.stream, l);
    for (int32_t i = 0; i < l->count; i++) draw(f.stream, &l->line[i], size);
    fputs("</g>\n</svg>\n", f.stream);
    return rg_file_commit(&f, why);
}
