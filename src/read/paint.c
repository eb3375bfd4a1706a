#include "read/paint.h"
#include "base/number.h"
#include "read/kinds.h"

#include <stdio.h>
#include <string.h>

/* Steps from one var() to the next. */
enum { MOST_VARIABLES = 8 };

static int is(const char *a, const char *b) { return strcmp(a, b) == 0; }

/* ------------------------------------------------------------------------------------------------- colour ---- */

static void opacity(rg_painting *w, const rg_xml_node *n, const char *name, double *x)
{
    char value[RG_CSS_VALUE];
    double v;
    if (!rg_css_get(&w->css, n, name, value) || is(value, "inherit")) return;
    const size_t used = rg_number_scan(value, strlen(value), &v);
    if (used == 0) return;
    if (value[used] == '%') v /= 100;
    *x = v < 0 ? 0 : fmin(v, 1);
}

static int begins(const char *s, const char *word) { return strncmp(s, word, strlen(word)) == 0; }

/* The value of var(--name, otherwise) for an element: its own, or of what is around it, or otherwise. 0: none. */
static int variable(rg_painting *w, const rg_xml_node *n, char value[RG_CSS_VALUE])
{
    char name[RG_CSS_VALUE], otherwise[RG_CSS_VALUE] = "";
    const char *s = value + strlen("var(");
    s += strspn(s, " \t\r\n");
    const size_t length = strcspn(s, ", \t\r\n)");
    memcpy(name, s, length);
    name[length] = 0;
    const char *comma = strchr(s + length, ','), *end = strrchr(s, ')');
    if (comma) comma += 1 + strspn(comma + 1, " \t\r\n");
    if (comma && end > comma) snprintf(otherwise, sizeof otherwise, "%.*s", (int)(end - comma), comma);
    for (; n; n = rg_xml_parent(n))
        if (rg_css_get(&w->css, n, name, value)) return 1;
    memcpy(value, otherwise, sizeof otherwise);
    return value[0] != 0;
}

/* What looking at a part of a gradient costs, as its bytes: names of colours are compared. */
enum { OF_STOP = 128 };

/* The colour of a gradient that has only one, as some programs keep their swatches. 0: it has several, or is none. */
static int swatch(rg_painting *w, const char *id, rg_colour *c, double *alpha)
{
    const rg_xml_node *n = rg_ids_find(&w->ids, id);
    for (int step = 0; n && step < MOST_VARIABLES; step++) {
        char value[RG_CSS_VALUE];
        int stops = 0, same = 1;
        for (const rg_xml_node *stop = rg_xml_child(n); stop; stop = rg_xml_next(stop)) {
            rg_colour one;
            w->css.work += OF_STOP;
            if (w->css.work > w->css.most) return 0;
            if (!rg_xml_is(stop, "stop")) continue;
            if (!rg_css_get(&w->css, stop, "stop-color", value) || !rg_colour_parse(value, &one, alpha)) return 0;
            same &= !stops || (one.r == c->r && one.g == c->g && one.b == c->b);
            *c = one;
            stops++;
        }
        if (stops > 0) return same;
        const char *next = rg_xml_attribute(n, "href");
        n = *next == '#' ? rg_ids_find(&w->ids, next + 1) : NULL;
    }
    return 0;
}

/* Past the first colour of a paint, behind which others may stand for other machines: "#f00 icc-color(...)". */
static size_t first_colour(const char *s)
{
    const size_t name = strcspn(s, "( \t\r\n");
    return s[name] == '(' ? name + strcspn(s + name, ")") + (strchr(s, ')') != NULL) : name;
}

/* The colour of a paint. 0: none that is plain; -1: nothing is painted. */
static int plain_colour(rg_painting *w, const rg_xml_node *n, const rg_paint *p, rg_colour *c, double *alpha)
{
    char value[RG_CSS_VALUE], id[RG_CSS_VALUE];
    snprintf(value, sizeof value, "%s", p->paint);
    for (int step = 0; step < MOST_VARIABLES; step++) {
        if (begins(value, "var(")) {
            if (!variable(w, n, value)) return 0;
        } else if (begins(value, "url(")) {
            const size_t from = 4 + strspn(value + 4, "\"' "), length = strcspn(value + from, "\"' )"),
                end = strcspn(value, ")");
            snprintf(id, sizeof id, "%.*s", (int)length, value + from);
            if (*id == '#' && swatch(w, id + 1, c, alpha)) return 1;
            if (!value[end] || !value[end + 1 + strspn(value + end + 1, " \t")]) return 0;
            const char *other = value + end + 1 + strspn(value + end + 1, " \t");
            memmove(value, other, strlen(other) + 1);
        } else break;
    }
    if (is(value, "currentColor") || is(value, "currentcolor")) snprintf(value, sizeof value, "%s", p->color);
    if (is(value, "none") || is(value, "transparent")) return -1;
    value[first_colour(value)] = 0;
    return rg_colour_parse(value, c, alpha);
}

/* ----------------------------------------------------------------------------------------------- what it is ---- */

static char letter_of(const char *s)
{
    static const char letters[] = "BMVFUCJ";
    const char c = *s >= 'a' && *s <= 'z' ? (char)(*s - 'a' + 'A') : *s;
    if (!c || s[1] || !strchr(letters, c)) return rg_kinds_of_name(s, strlen(s)); /* the word */
    return c == 'C' ? RG_BORDER : c == 'J' ? RG_FLAT : c;
}

static void of_name(const rg_painting *w, rg_paint *p, const char *name, size_t n)
{
    const char says = rg_kinds_of_name(name, n);
    const int kind = rg_kinds_find(w->s, RG_BY_LAYER, name, n);
    if (says) p->named = says;
    if (kind > p->kind) p->kind = kind;
}

/* Names of an element: its label, its id, its classes; and what it says of itself as data. */
static void names(const rg_painting *w, const rg_xml_node *n, rg_paint *p)
{
    const char *label = rg_xml_attribute(n, "label"), *id = rg_xml_attribute(n, "id"),
        *words = rg_xml_attribute(n, "class");
    const char *data = rg_xml_attribute(n, "data-assignment");
    static const char *const angles[] = {"data-foldAngle", "data-foldangle", "data-fold-angle"};
    double degrees;
    if (is(rg_xml_name(n), "g") || is(rg_xml_name(n), "symbol")) {
        if (*label || *id) p->layer = *label ? label : id;
        else if (*words) p->layer = words;
    } else if (*label || *words) p->layer = *label ? label : words;
    of_name(w, p, id, strlen(id));
    of_name(w, p, label, strlen(label));
    for (const char *s = words; *s;) {
        const size_t n_of = strcspn(s, " \t\r\n");
        of_name(w, p, s, n_of);
        s += n_of + strspn(s + n_of, " \t\r\n");
    }
    if (letter_of(data)) p->letter = letter_of(data);
    for (int i = 0; i < 3; i++) {
        const char *text = rg_xml_attribute(n, angles[i]);
        if (*text && rg_number_parse(text, strlen(text), &degrees) && fabs(degrees) <= 180) p->angle = degrees * RG_DEG;
    }
}

int rg_paint_inherit(rg_painting *w, const rg_xml_node *n, rg_paint *p)
{
    char value[RG_CSS_VALUE];
    double own = 1;
    if (rg_css_get(&w->css, n, "display", value) && is(value, "none")) return 0;
    if (rg_css_get(&w->css, n, "visibility", value) && !is(value, "inherit")) p->hidden = !is(value, "visible");
    names(w, n, p);
    opacity(w, n, "opacity", &own);
    p->opacity *= own;
    opacity(w, n, "stroke-opacity", &p->stroke_opacity);
    if (rg_css_get(&w->css, n, "stroke-dasharray", value) && !is(value, "inherit"))
        snprintf(p->dash, sizeof p->dash, "%s", is(value, "none") || is(value, "0") ? "solid" : value);
    const int recoloured = rg_css_get(&w->css, n, "color", value) && !is(value, "inherit") &&
        !is(value, "currentColor");
    if (recoloured) memcpy(p->color, value, sizeof value);
    if (rg_css_get(&w->css, n, "stroke", value) && !is(value, "inherit")) memcpy(p->paint, value, sizeof value);
    else if (!recoloured) return 1;
    const int colour = *p->paint ? plain_colour(w, n, p, &p->stroke, &p->alpha) : -1;
    p->stroked = colour >= 0;
    p->known = colour > 0;
    return 1;
}

const char *rg_paint_name(const rg_paint *p, char text[RG_CSS_VALUE])
{
    if (!p->known) return *p->paint && p->stroked ? p->paint : "none";
    snprintf(text, RG_CSS_VALUE, "#%02x%02x%02x", (int)lround(255 * p->stroke.r), (int)lround(255 * p->stroke.g),
             (int)lround(255 * p->stroke.b));
    return text;
}

char rg_paint_kind(const rg_painting *w, const rg_paint *p, int *kind)
{
    char text[RG_CSS_VALUE];
    const char *colour = rg_paint_name(p, text);
    const int by_colour = rg_kinds_find(w->s, RG_BY_COLOUR, colour, strlen(colour));
    const int by_dash = rg_kinds_find(w->s, RG_BY_DASH, p->dash, strlen(p->dash));
    *kind = p->kind > by_colour ? p->kind : by_colour;
    if (by_dash > *kind) *kind = by_dash;
    if (*kind >= 0) return rg_kinds_letter(w->s, *kind);
    if (p->letter) return p->letter;
    const char says = p->known ? rg_colour_assignment(p->stroke) : 0;
    if (says && says != RG_BORDER) return says;
    return p->named ? p->named : says ? says : RG_FLAT;
}
