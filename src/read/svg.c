#include "read/svg.h"
#include "base/number.h"
#include "base/status.h"
#include "read/colour.h"
#include "read/css.h"

#include <string.h>

/* Illustrator rounds to 0.001 of a point, Origami Simulator merges within 3 pixels. */
static const double MERGE = 1e-3;
/* A curve whose inner points are off its chord by less than this part of it is a straight line, drawn with a curve's
 * tool. */
static const double STRAIGHT = 1e-6;

typedef struct matrix { double a, b, c, d, e, f; } matrix; /* x' = a x + c y + e, y' = b x + d y + f */

/* What an element hands down to those inside it. */
typedef struct paint {
    int stroked, hidden, known; /* known: `stroke` is its colour */
    rg_colour stroke;
    double alpha, stroke_opacity, opacity; /* opacity: of all groups around too */
    matrix m;
} paint;

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    rg_css css;
    int targets, told_colour, told_use, told_ring;
} reader;

static rg_status fail(const reader *r, const rg_xml_node *n, const char *what, const char *detail)
{
    return rg_fail(RG_EFORMAT, r->why, rg_xml_line(n), "<%.20s>: %s \"%.60s\"", rg_xml_name(n), what, detail);
}

/* ------------------------------------------------------------------------------------------------- numbers ---- */

static const char *skip(const char *s)
{
    while (*s == ' ' || *s == ',' || (*s >= '\t' && *s <= '\r')) s++;
    return s;
}

/* The next number of a list; moves *s on. No list has longer numbers than this looks at. */
static int next_number(const char **s, double *x)
{
    *s = skip(*s);
    const size_t used = rg_number_scan(*s, strnlen(*s, 500), x);
    *s += used;
    return used > 0;
}

static rg_status length(const reader *r, const rg_xml_node *n, const char *name, double *x)
{
    static const struct { const char *unit; double pixels; } units[] = {
        {"", 1}, {"px", 1}, {"pt", 96.0 / 72}, {"pc", 16}, {"in", 96}, {"cm", 96 / 2.54}, {"mm", 96 / 25.4}};
    const char *s = rg_xml_attribute(n, name);
    *x = 0;
    if (!*s) return RG_OK;
    if (!next_number(&s, x)) return fail(r, n, name, rg_xml_attribute(n, name));
    const size_t unit = strcspn(s, " \t\r\n");
    if (s[unit + strspn(s + unit, " \t\r\n")] == 0)
        for (size_t i = 0; i < sizeof units / sizeof *units; i++)
            if (strlen(units[i].unit) == unit && strncmp(units[i].unit, s, unit) == 0)
                return *x *= units[i].pixels, RG_OK;
    return fail(r, n, "a length in units that are not known:", rg_xml_attribute(n, name));
}

/* ---------------------------------------------------------------------------------------------- transforms ---- */

static matrix times(matrix p, matrix q)
{
    return (matrix){p.a * q.a + p.c * q.b, p.b * q.a + p.d * q.b, p.a * q.c + p.c * q.d, p.b * q.c + p.d * q.d,
                    p.a * q.e + p.c * q.f + p.e, p.b * q.e + p.d * q.f + p.f};
}

static matrix shift(double x, double y) { return (matrix){1, 0, 0, 1, x, y}; }

/* One of transform's functions from its numbers; 0: no such one, or not so many numbers. */
static int function(const char *name, size_t n, const double *v, int count, matrix *m)
{
    const double angle = count > 0 ? v[0] * RG_DEG : 0;
    if (n == 6 && memcmp(name, "matrix", n) == 0 && count == 6) *m = (matrix){v[0], v[1], v[2], v[3], v[4], v[5]};
    else if (n == 9 && memcmp(name, "translate", n) == 0 && (count == 1 || count == 2))
        *m = shift(v[0], count > 1 ? v[1] : 0);
    else if (n == 5 && memcmp(name, "scale", n) == 0 && (count == 1 || count == 2))
        *m = (matrix){v[0], 0, 0, v[count - 1], 0, 0};
    else if (n == 5 && memcmp(name, "skewX", n) == 0 && count == 1) *m = (matrix){1, 0, tan(angle), 1, 0, 0};
    else if (n == 5 && memcmp(name, "skewY", n) == 0 && count == 1) *m = (matrix){1, tan(angle), 0, 1, 0, 0};
    else if (n == 6 && memcmp(name, "rotate", n) == 0 && (count == 1 || count == 3)) {
        const double quarter = v[0] / 90; /* exact where it can be */
        double c = cos(angle), s = sin(angle);
        if (quarter == floor(quarter)) {
            const int turns = (int)fmod(fmod(quarter, 4) + 4, 4);
            c = turns == 0 ? 1 : turns == 2 ? -1 : 0;
            s = turns == 1 ? 1 : turns == 3 ? -1 : 0;
        }
        *m = (matrix){c, s, -s, c, 0, 0};
        if (count == 3) *m = times(times(shift(v[1], v[2]), *m), shift(-v[1], -v[2]));
    } else return 0;
    return 1;
}

static rg_status transform(const reader *r, const rg_xml_node *n, matrix *m)
{
    const char *all = rg_xml_attribute(n, "transform"), *s = skip(all);
    while (*s) {
        const char *name = s;
        const size_t name_n = strcspn(s, "( \t\r\n");
        double v[6];
        int count = 0;
        matrix one;
        s = skip(s + name_n);
        if (*s++ != '(') return fail(r, n, "transform", name);
        for (s = skip(s); *s && *s != ')'; s = skip(s))
            if (count == 6 || !next_number(&s, &v[count++])) return fail(r, n, "transform", name);
        if (*s != ')' || !function(name, name_n, v, count, &one)) return fail(r, n, "transform", name);
        *m = times(*m, one);
        s = skip(s + 1);
    }
    return RG_OK;
}

/* --------------------------------------------------------------------------------------------------- paint ---- */

static int is(const char *a, const char *b) { return strcmp(a, b) == 0; }

static void opacity(const reader *r, const rg_xml_node *n, const char *name, double *x)
{
    char value[RG_CSS_VALUE];
    double v;
    if (!rg_css_get(&r->css, n, name, value) || is(value, "inherit")) return;
    const size_t used = rg_number_scan(value, strlen(value), &v);
    if (used == 0) return;
    if (value[used] == '%') v /= 100;
    *x = v < 0 ? 0 : fmin(v, 1);
}

/* What n is painted with, after what is around it. 0: it is not there at all. */
static int repaint(const reader *r, const rg_xml_node *n, paint *p)
{
    char value[RG_CSS_VALUE];
    double own = 1;
    if (rg_css_get(&r->css, n, "display", value) && is(value, "none")) return 0;
    if (rg_css_get(&r->css, n, "visibility", value) && !is(value, "inherit")) p->hidden = !is(value, "visible");
    opacity(r, n, "opacity", &own);
    p->opacity *= own;
    opacity(r, n, "stroke-opacity", &p->stroke_opacity);
    if (!rg_css_get(&r->css, n, "stroke", value) || is(value, "inherit")) return 1;
    p->stroked = !is(value, "none") && !is(value, "transparent");
    if (is(value, "currentColor") && !rg_css_get(&r->css, n, "color", value)) strcpy(value, "black");
    p->known = p->stroked && rg_colour_parse(value, &p->stroke, &p->alpha);
    return 1;
}

/* -------------------------------------------------------------------------------------------------- shapes ---- */

static rg_vec2 apply(matrix m, rg_vec2 x) { return (rg_vec2){m.a * x.x + m.c * x.y + m.e, m.b * x.x + m.d * x.y + m.f}; }

static rg_status segment(reader *r, const rg_xml_node *n, const paint *p, rg_vec2 a, rg_vec2 b)
{
    const int32_t where = rg_xml_line(n);
    a = apply(p->m, a);
    b = apply(p->m, b);
    if (!isfinite(a.x) || !isfinite(a.y) || !isfinite(b.x) || !isfinite(b.y))
        return rg_lines_warn(r->out, where, "a line is dropped: a coordinate is not a finite number");
    const char assignment = p->known ? rg_colour_assignment(p->stroke) : RG_FLAT;
    rg_status s = RG_OK;
    if (!p->known && !r->told_colour++)
        s = rg_lines_warn(r->out, where, "a stroke that is no plain colour: taken for an auxiliary line, as all of its kind");
    if (s == RG_OK) s = rg_lines_add(r->out, (rg_vec2){a.x, -a.y}, (rg_vec2){b.x, -b.y}, assignment, where);
    const double part = p->opacity * p->stroke_opacity * p->alpha;
    if (s == RG_OK && r->targets && part < 1 && (assignment == RG_MOUNTAIN || assignment == RG_VALLEY))
        r->out->line[r->out->count - 1].target = (assignment == RG_MOUNTAIN ? -RG_PI : RG_PI) * part;
    return s;
}

static rg_status line(reader *r, const rg_xml_node *n, const paint *p)
{
    rg_vec2 a, b;
    rg_status s = length(r, n, "x1", &a.x);
    if (s == RG_OK) s = length(r, n, "y1", &a.y);
    if (s == RG_OK) s = length(r, n, "x2", &b.x);
    if (s == RG_OK) s = length(r, n, "y2", &b.y);
    return s == RG_OK ? segment(r, n, p, a, b) : s;
}

static rg_status rectangle(reader *r, const rg_xml_node *n, const paint *p)
{
    double x, y, w, h, rx, ry;
    rg_status s = length(r, n, "x", &x);
    if (s == RG_OK) s = length(r, n, "y", &y);
    if (s == RG_OK) s = length(r, n, "width", &w);
    if (s == RG_OK) s = length(r, n, "height", &h);
    if (s == RG_OK) s = length(r, n, "rx", &rx);
    if (s == RG_OK) s = length(r, n, "ry", &ry);
    if (s == RG_OK && (rx > 0 || ry > 0))
        return fail(r, n, "its corners are round: rx, ry", rg_xml_attribute(n, rx > 0 ? "rx" : "ry"));
    const rg_vec2 corner[] = {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    for (int i = 0; s == RG_OK && i < 4 && w > 0 && h > 0; i++) s = segment(r, n, p, corner[i], corner[(i + 1) % 4]);
    return s;
}

static rg_status polyline(reader *r, const rg_xml_node *n, const paint *p, int closed)
{
    const char *points = rg_xml_attribute(n, "points"), *s = points;
    rg_vec2 start = {0, 0}, last = start, x;
    rg_status status = RG_OK;
    for (int32_t i = 0; status == RG_OK && *(s = skip(s)); i++) {
        if (!next_number(&s, &x.x) || !next_number(&s, &x.y)) return fail(r, n, "points", s);
        if (i == 0) start = x;
        else status = segment(r, n, p, last, x);
        last = x;
    }
    if (status == RG_OK && closed && (last.x != start.x || last.y != start.y)) status = segment(r, n, p, last, start);
    return status;
}

/* ---------------------------------------------------------------------------------------------------- path ---- */

/* Whether x lies on the chord from a to b, as far as one can see. */
static int on_chord(rg_vec2 a, rg_vec2 b, rg_vec2 x)
{
    const rg_vec2 d = rg_vec2_sub(b, a), r = rg_vec2_sub(x, a);
    const double square = rg_vec2_dot(d, d), along = rg_vec2_dot(d, r);
    return fabs(rg_vec2_cross(d, r)) <= STRAIGHT * square && along >= -STRAIGHT * square &&
           along <= (1 + STRAIGHT) * square;
}

/* How many numbers a path's command takes; -1: no command. */
static int numbers(char command)
{
    switch (command | 32) {
    case 'm': case 'l': case 't': return 2;
    case 'h': case 'v': return 1;
    case 'q': case 's': return 4;
    case 'c': return 6;
    case 'a': return 7;
    case 'z': return 0;
    default: return -1;
    }
}

/* Where a command leads from `at`. 0: over a curve. */
static int lead(char command, const double *v, rg_vec2 at, rg_vec2 *to)
{
    const rg_vec2 from = command >= 'a' ? at : (rg_vec2){0, 0};
    const int count = numbers(command);
    switch (command | 32) {
    case 'h': *to = (rg_vec2){from.x + v[0], at.y}; return 1;
    case 'v': *to = (rg_vec2){at.x, from.y + v[0]}; return 1;
    case 't': case 's': return 0; /* what bends it stands in the command before */
    default: break;
    }
    *to = (rg_vec2){from.x + v[count - 2], from.y + v[count - 1]};
    if ((command | 32) == 'a') return v[0] == 0 || v[1] == 0;
    for (int i = 0; i + 3 < count; i += 2)
        if (!on_chord(at, *to, (rg_vec2){from.x + v[i], from.y + v[i + 1]})) return 0;
    return 1;
}

static rg_status path(reader *r, const rg_xml_node *n, const paint *p)
{
    const char *s = skip(rg_xml_attribute(n, "d"));
    rg_vec2 at = {0, 0}, start = at;
    char command = 0;
    rg_status status = RG_OK;
    if (*s && (*s | 32) != 'm') return fail(r, n, "a path that does not begin with M:", s);
    for (; status == RG_OK && *(s = skip(s));) {
        const char *here = s;
        if (numbers(*s) >= 0) command = *s++;
        else if ((command | 32) == 'z') return fail(r, n, "path: no command at", here);
        const int count = numbers(command);
        double v[7];
        rg_vec2 to = start;
        for (int i = 0; i < count; i++)
            if (!next_number(&s, &v[i])) return fail(r, n, "path: a number is missing at", here);
        if (count > 0 && !lead(command, v, at, &to))
            return fail(r, n, "a curve, where paper folds along straight lines only:", here);
        if ((command | 32) == 'm') {
            start = to;
            command = command == 'm' ? 'l' : 'L'; /* what follows without a command is lines */
        } else if (count > 0 || to.x != at.x || to.y != at.y) {
            status = segment(r, n, p, at, to);
        }
        at = to;
    }
    return status;
}

/* ------------------------------------------------------------------------------------------------ document ---- */

/* Rings mark vertices in many drawings. A border, though, is the paper's. */
static rg_status ring(reader *r, const rg_xml_node *n, const paint *p)
{
    const char *name = rg_xml_name(n);
    if (p->known && rg_colour_assignment(p->stroke) == RG_BORDER)
        return rg_fail(RG_EFORMAT, r->why, rg_xml_line(n), "<%s>: a curve as border, paper has straight ones here", name);
    if (r->told_ring++) return RG_OK;
    return rg_lines_warn(r->out, rg_xml_line(n), "<%s> is left out, as all circles: a mark, no crease", name);
}

static rg_status shape(reader *r, const rg_xml_node *n, const paint *p)
{
    const char *name = rg_xml_name(n);
    if (is(name, "use") && !r->told_use++)
        return rg_lines_warn(r->out, rg_xml_line(n), "<use> is not followed: what it repeats is missing");
    if (!p->stroked || p->hidden) return RG_OK;
    if (is(name, "line")) return line(r, n, p);
    if (is(name, "rect")) return rectangle(r, n, p);
    if (is(name, "polyline")) return polyline(r, n, p, 0);
    if (is(name, "polygon")) return polyline(r, n, p, 1);
    if (is(name, "path")) return path(r, n, p);
    if (is(name, "circle") || is(name, "ellipse")) return ring(r, n, p);
    return RG_OK;
}

/* The parser bounds the depth. */
static rg_status group(reader *r, const rg_xml_node *n, paint p)
{
    if (!repaint(r, n, &p)) return RG_OK;
    rg_status s = transform(r, n, &p.m);
    for (const rg_xml_node *c = rg_xml_child(n); s == RG_OK && c; c = rg_xml_next(c)) {
        const char *name = rg_xml_name(c);
        paint own = p;
        if (is(name, "svg")) {
            double x, y;
            s = length(r, c, "x", &x);
            if (s == RG_OK) s = length(r, c, "y", &y);
            if (s == RG_OK) own.m = times(p.m, shift(x, y));
        }
        if (is(name, "g") || is(name, "a") || is(name, "svg") || is(name, "switch")) {
            if (s == RG_OK) s = group(r, c, own);
            continue;
        }
        if (!repaint(r, c, &own)) continue;
        s = transform(r, c, &own.m);
        if (s == RG_OK) s = shape(r, c, &own);
    }
    return s;
}

static const rg_xml_node *find(const rg_xml_node *n, const char *name)
{
    for (const rg_xml_node *c = rg_xml_child(n); c; c = rg_xml_next(c)) {
        const rg_xml_node *found = rg_xml_is(c, name) ? c : find(c, name);
        if (found) return found;
    }
    return NULL;
}

static rg_status styles(reader *r, const rg_xml_node *n)
{
    rg_status s = RG_OK;
    for (const rg_xml_node *c = rg_xml_child(n); s == RG_OK && c; c = rg_xml_next(c))
        s = rg_xml_is(c, "style") ? rg_css_add(&r->css, c, r->why) : styles(r, c);
    return s;
}

static rg_status say(rg_lines *l, const rg_xml_node *n, char **to)
{
    if (!n || *to) return RG_OK;
    char *s = rg_xml_string(&l->mem, n);
    if (!s) return RG_ENOMEM;
    if (*s) *to = s;
    else rg_mem_free(&l->mem, s);
    return RG_OK;
}

static rg_status metadata(rg_lines *l, const rg_xml_node *root)
{
    rg_status s = RG_OK;
    for (const rg_xml_node *c = rg_xml_child(root); s == RG_OK && c; c = rg_xml_next(c)) {
        if (rg_xml_is(c, "title")) s = say(l, c, &l->title);
        if (rg_xml_is(c, "desc")) s = say(l, c, &l->memo);
        if (!rg_xml_is(c, "metadata")) continue;
        const rg_xml_node *creator = find(c, "creator"), *agent = creator ? find(creator, "title") : NULL;
        s = say(l, agent ? agent : creator, &l->author);
    }
    return s;
}

static rg_status document(reader *r, const rg_xml_node *root)
{
    if (!rg_xml_is(root, "svg"))
        return rg_fail(RG_EFORMAT, r->why, rg_xml_line(root), "the root is <%.40s>, not <svg>", rg_xml_name(root));
    const paint plain = {.alpha = 1, .stroke_opacity = 1, .opacity = 1, .m = shift(0, 0)};
    rg_status s = metadata(r->out, root);
    if (s == RG_OK) s = styles(r, root);
    if (s == RG_OK) {
        paint p = plain;
        s = group(r, root, p);
    }
    if (s == RG_OK && r->out->count == 0)
        s = rg_fail(RG_EFORMAT, r->why, rg_xml_line(root), "no lines: nothing in the drawing has a stroke");
    return s;
}

rg_status rg_svg_read(const void *bytes, size_t size, const rg_memory *mem, int targets, rg_lines *out, rg_diag *why)
{
    rg_xml *doc = NULL;
    reader r = {.out = out, .why = why, .targets = targets};
    rg_lines_init(out, mem);
    rg_css_init(&r.css, mem);
    out->merge = MERGE;
    rg_status s = rg_xml_parse(bytes, size, RG_XML_ANY_TYPE, &doc, why);
    if (s == RG_OK) s = document(&r, rg_xml_root(doc));
    rg_xml_free(doc);
    rg_css_free(&r.css);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
