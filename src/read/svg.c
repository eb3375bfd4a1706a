#include "read/svg.h"
#include "base/number.h"
#include "base/status.h"
#include "read/kinds.h"
#include "read/paint.h"

#include <stdio.h>
#include <string.h>

/* Illustrator rounds to 0.001 of a point, Origami Simulator merges within 3 pixels. */
static const double MERGE = 1e-3;
/* A curve whose inner points are off its chord by less than this part of it is a straight line, drawn with a curve's
 * tool. */
static const double STRAIGHT = 1e-6;

/* What <use> repeats is bounded in sum, counted about as its bytes, and so is how deep the elements stand in each
 * other. */
enum { MOST_REPEATED = 1 << 24, OF_ELEMENT = 64, OF_SEGMENT = 16, MOST_NESTED = 256 };
/* So many bytes of attributes are looked through in the time of one byte of a path. */
enum { OTHERS_A_BYTE = 8 };

/* What styles may cost for each element, beside what they may cost at all: whole drawings may be large. */
enum { WORK_AN_ELEMENT = 4096, WORK_UNASKED = 1 << 20 };

/* Strokes of no plain colour that are told by name. */
enum { MOST_UNKNOWN = 16 };

/* The <use> that are being followed, inmost first. */
typedef struct chain { const rg_xml_node *user, *target; const struct chain *out; } chain;

/* How many of a kind there are, and the line of the first. */
typedef struct tally { int32_t count, where; char text[RG_CSS_VALUE]; } tally;

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    rg_painting with;
    const chain *uses;
    int64_t repeated, asked_at; /* css.work, when it was asked last whether to go on */
    int depth;
    tally hidden, unpainted, rings, curves, unwanted, unknown[MOST_UNKNOWN];
} reader;

static int is(const char *a, const char *b) { return strcmp(a, b) == 0; }

static void tell(tally *t, const rg_xml_node *n)
{
    if (!t->count++) t->where = rg_xml_line(n);
}

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

/* The next number of a list; moves *s on. No more is looked at than it has characters, more or less: lists may be as
 * long as the file. What ends that near to where it was looked at may go on: with an exponent, its sign and a digit. */
static int next_number(const char **s, double *x)
{
    enum { LOOKED_AT = 500, EXPONENT = 3 };
    size_t used, room = LOOKED_AT;
    *s = skip(*s);
    while ((used = rg_number_scan(*s, strnlen(*s, room), x)) + EXPONENT > room) room *= 2;
    *s += used;
    return used > 0;
}

/* A flag of an arc: one character, whatever stands behind it. */
static int next_flag(const char **s, double *x)
{
    *s = skip(*s);
    if (**s != '0' && **s != '1') return 0;
    *x = *(*s)++ - '0';
    return 1;
}

/* A number and its unit, in pixels; *metric: whether that unit is a length on paper. A percentage is one of `whole`. 0:
 * not a length, or in units that are not known. */
static int pixels(const char *s, double whole, double *x, int *metric)
{
    static const struct { const char *unit; double pixels; int metric; } units[] = {
        {"", 1, 0}, {"px", 1, 0}, {"pt", 96.0 / 72, 1}, {"pc", 16, 1}, {"in", 96, 1}, {"cm", 96 / 2.54, 1},
        {"mm", 96 / 25.4, 1}, {"Q", 96 / 101.6, 1}};
    double number;
    if (!next_number(&s, &number)) return 0;
    const size_t unit = strcspn(s, " \t\r\n");
    if (s[unit + strspn(s + unit, " \t\r\n")]) return 0;
    *metric = 0;
    if (unit == 1 && *s == '%') return *x = number / 100 * whole, !isnan(whole);
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strlen(units[i].unit) == unit && strncmp(units[i].unit, s, unit) == 0) {
            *metric = units[i].metric;
            return *x = number * units[i].pixels, 1;
        }
    return 0;
}

/* Of an attribute; percentages are of the viewport's width, or height, or what is between them for a radius. */
static rg_status length(const reader *r, const rg_xml_node *n, const rg_paint *p, const char *name, double *x)
{
    const char *s = rg_xml_attribute(n, name);
    const int is_wide = strchr(name, 'x') != NULL || strcmp(name, "width") == 0;
    int metric;
    *x = 0;
    if (!*s || pixels(s, is_wide ? p->w : p->h, x, &metric)) return RG_OK;
    return rg_fail(RG_EFORMAT, r->why, rg_xml_line(n),
                   strchr(s, '%') ? "<%.20s>: %s is a part of a size that the drawing does not say: \"%.60s\""
                                  : "<%.20s>: %s is not a length in units that are known: \"%.60s\"",
                   rg_xml_name(n), name, s);
}

/* ---------------------------------------------------------------------------------------------- transforms ---- */

/* One of transform's functions from its numbers; 0: no such one, or not so many numbers. */
static int function(const char *name, size_t n, const double *v, int count, rg_affine *m)
{
    const double angle = count > 0 ? v[0] * RG_DEG : 0;
    if (n == 6 && memcmp(name, "matrix", n) == 0 && count == 6) *m = (rg_affine){v[0], v[1], v[2], v[3], v[4], v[5]};
    else if (n == 9 && memcmp(name, "translate", n) == 0 && (count == 1 || count == 2))
        *m = rg_affine_shift(v[0], count > 1 ? v[1] : 0);
    else if (n == 5 && memcmp(name, "scale", n) == 0 && (count == 1 || count == 2))
        *m = rg_affine_scale(v[0], v[count - 1]);
    else if (n == 5 && memcmp(name, "skewX", n) == 0 && count == 1) *m = (rg_affine){1, 0, tan(angle), 1, 0, 0};
    else if (n == 5 && memcmp(name, "skewY", n) == 0 && count == 1) *m = (rg_affine){1, tan(angle), 0, 1, 0, 0};
    else if (n == 6 && memcmp(name, "rotate", n) == 0 && (count == 1 || count == 3)) {
        *m = rg_affine_turn(v[0]);
        if (count == 3)
            *m = rg_affine_mul(rg_affine_mul(rg_affine_shift(v[1], v[2]), *m), rg_affine_shift(-v[1], -v[2]));
    } else return 0;
    return 1;
}

/* The units that a style has to have, and an attribute may. */
static const char *skip_unit(const char *s)
{
    return strncmp(s, "px", 2) == 0 ? s + 2 : strncmp(s, "deg", 3) == 0 ? s + 3 : s;
}

/* The point that all of an element's transform goes round. 0: it is none that is understood. */
static int origin(const char *s, rg_vec2 *x)
{
    if (!next_number(&s, &x->x)) return 0;
    s = skip_unit(s);
    if (!next_number(&s, &x->y)) return 0;
    return *skip(skip_unit(s)) == 0;
}

static rg_status transform(reader *r, const rg_xml_node *n, rg_affine *m)
{
    char said[RG_CSS_VALUE], at[RG_CSS_VALUE];
    const int is_style = rg_css_said(&r->with.css, n, "transform", said);
    const char *s = skip(is_style ? said : rg_xml_attribute(n, "transform"));
    rg_vec2 o = {0, 0};
    if (!*s || is(s, "none")) return RG_OK;
    if (rg_css_get(&r->with.css, n, "transform-origin", at) && !origin(at, &o))
        return fail(r, n, "transform-origin", at);
    *m = rg_affine_mul(*m, rg_affine_shift(o.x, o.y));
    while (*s) {
        const char *name = s;
        const size_t name_n = strcspn(s, "( \t\r\n");
        double v[6];
        int count = 0;
        rg_affine one;
        s = skip(s + name_n);
        if (*s++ != '(') return fail(r, n, "transform", name);
        for (s = skip(s); *s && *s != ')'; s = skip(s))
            if (count == 6 || !next_number(&s, &v[count++])) return fail(r, n, "transform", name);
            else s = skip_unit(s);
        if (*s != ')' || !function(name, name_n, v, count, &one)) return fail(r, n, "transform", name);
        *m = rg_affine_mul(*m, one);
        s = skip(s + 1);
    }
    *m = rg_affine_mul(*m, rg_affine_shift(-o.x, -o.y));
    return RG_OK;
}

/* Strokes of no plain colour, each with how many lines it has; those beyond the most are counted with the last. */
static void tell_unknown(reader *r, const rg_xml_node *n, const rg_paint *p)
{
    int i = 0;
    while (i < MOST_UNKNOWN - 1 && r->unknown[i].count && strcmp(r->unknown[i].text, p->paint) != 0) i++;
    if (!r->unknown[i].count) memcpy(r->unknown[i].text, p->paint, sizeof p->paint);
    tell(&r->unknown[i], n);
}

/* -------------------------------------------------------------------------------------------------- shapes ---- */

/* What is repeated costs time and room that the size of the file does not bound. */
static rg_status charge(reader *r, const rg_xml_node *n, size_t cost)
{
    if (!r->uses) return RG_OK;
    r->repeated += (int64_t)cost;
    if (r->repeated <= MOST_REPEATED) return RG_OK;
    return rg_fail(RG_EFORMAT, r->why, rg_xml_line(r->uses->user),
                   "<use>: the drawing is too large with all that it repeats (here <%.20s>)",
                   rg_xml_name(n));
}

static rg_status segment(reader *r, const rg_xml_node *n, const rg_paint *p, rg_vec2 a, rg_vec2 b)
{
    const int32_t where = rg_xml_line(n);
    const rg_status cost = charge(r, n, OF_SEGMENT);
    if (cost != RG_OK) return cost;
    a = rg_affine_point(p->m, a);
    b = rg_affine_point(p->m, b);
    if (!isfinite(a.x) || !isfinite(a.y) || !isfinite(b.x) || !isfinite(b.y))
        return rg_lines_warn(r->out, where, "a line is dropped: a coordinate is not a finite number");
    int kind;
    char text[RG_CSS_VALUE];
    const char assignment = rg_paint_kind(&r->with, p, &kind), *colour = rg_paint_name(p, text);
    if (kind >= 0) r->out->kinds_used |= UINT64_C(1) << kind;
    rg_status s = rg_lines_trait(r->out, RG_BY_COLOUR, colour, strlen(colour), assignment);
    if (s == RG_OK && p->layer)
        s = rg_lines_trait(r->out, RG_BY_LAYER, p->layer, strnlen(p->layer, RG_TRAIT_ROOM), assignment);
    if (s == RG_OK) s = rg_lines_trait(r->out, RG_BY_DASH, p->dash, strlen(p->dash), assignment);
    if (assignment == RG_LEFT_OUT) return tell(&r->unwanted, n), s;
    if (!p->known && kind < 0 && !p->letter && !p->named) tell_unknown(r, n, p);
    if (s == RG_OK) s = rg_lines_add(r->out, (rg_vec2){a.x, -a.y}, (rg_vec2){b.x, -b.y}, assignment, where);
    if (s != RG_OK || !r->with.s->targets) return s;
    rg_line *l = &r->out->line[r->out->count - 1];
    const double part = p->opacity * p->stroke_opacity * (p->known ? p->alpha : 1);
    const int folds = assignment == RG_MOUNTAIN || assignment == RG_VALLEY;
    if (folds && part < 1) l->target = (assignment == RG_MOUNTAIN ? -RG_PI : RG_PI) * part;
    if (folds && !isnan(p->angle)) l->target = assignment == RG_MOUNTAIN ? -fabs(p->angle) : fabs(p->angle);
    if (assignment == RG_UNASSIGNED && !isnan(p->angle) && p->angle != 0) l->target = p->angle;
    return RG_OK;
}

/* Of what is no crease, a curve does no harm. */
static int cannot_fold(const reader *r, const rg_paint *p)
{
    int kind;
    const char assignment = rg_paint_kind(&r->with, p, &kind);
    return assignment == RG_FLAT || assignment == RG_LEFT_OUT;
}

static rg_status line(reader *r, const rg_xml_node *n, const rg_paint *p)
{
    rg_vec2 a = {0, 0}, b = {0, 0};
    rg_status s = length(r, n, p, "x1", &a.x);
    if (s == RG_OK) s = length(r, n, p, "y1", &a.y);
    if (s == RG_OK) s = length(r, n, p, "x2", &b.x);
    if (s == RG_OK) s = length(r, n, p, "y2", &b.y);
    return s == RG_OK ? segment(r, n, p, a, b) : s;
}

static rg_status rectangle(reader *r, const rg_xml_node *n, const rg_paint *p)
{
    double x = 0, y = 0, w = 0, h = 0, rx = 0, ry = 0;
    rg_status s = length(r, n, p, "x", &x);
    if (s == RG_OK) s = length(r, n, p, "y", &y);
    if (s == RG_OK) s = length(r, n, p, "width", &w);
    if (s == RG_OK) s = length(r, n, p, "height", &h);
    if (s == RG_OK) s = length(r, n, p, "rx", &rx);
    if (s == RG_OK) s = length(r, n, p, "ry", &ry);
    if (s == RG_OK && (rx > 0 || ry > 0)) {
        if (cannot_fold(r, p)) return tell(&r->curves, n), RG_OK;
        return fail(r, n, "its corners are round: rx, ry", rg_xml_attribute(n, rx > 0 ? "rx" : "ry"));
    }
    const rg_vec2 corner[] = {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    for (int i = 0; s == RG_OK && i < 4 && w > 0 && h > 0; i++) s = segment(r, n, p, corner[i], corner[(i + 1) % 4]);
    return s;
}

static rg_status polyline(reader *r, const rg_xml_node *n, const rg_paint *p, int closed)
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

/* Whether x lies on the chord from a to b, as far as one can see; a curve back to where it began has none. */
static int on_chord(rg_vec2 a, rg_vec2 b, rg_vec2 x)
{
    const rg_vec2 d = rg_vec2_sub(b, a), r = rg_vec2_sub(x, a);
    const double square = rg_vec2_dot(d, d), along = rg_vec2_dot(d, r);
    if (!(square > 0)) return r.x == 0 && r.y == 0;
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

/* Where a command leads from `at`. 0: over a curve, *to is set all the same. */
static int lead(char command, const double *v, rg_vec2 at, rg_vec2 *to)
{
    const rg_vec2 from = command >= 'a' ? at : (rg_vec2){0, 0};
    const int count = numbers(command);
    switch (command | 32) {
    case 'h': *to = (rg_vec2){from.x + v[0], at.y}; return 1;
    case 'v': *to = (rg_vec2){at.x, from.y + v[0]}; return 1;
    default: break;
    }
    *to = (rg_vec2){from.x + v[count - 2], from.y + v[count - 1]};
    if ((command | 32) == 't' || (command | 32) == 's') return 0; /* what bends it stands in the command before */
    if ((command | 32) == 'a') return v[0] == 0 || v[1] == 0;
    for (int i = 0; i + 3 < count; i += 2)
        if (!on_chord(at, *to, (rg_vec2){from.x + v[i], from.y + v[i + 1]})) return 0;
    return 1;
}

static rg_status path(reader *r, const rg_xml_node *n, const rg_paint *p)
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
        for (int i = 0; i < count; i++) {
            const int is_flag = (command | 32) == 'a' && (i == 3 || i == 4);
            if (!(is_flag ? next_flag(&s, &v[i]) : next_number(&s, &v[i])))
                return fail(r, n, "path: a number is missing at", here);
        }
        const int bends = count > 0 && !lead(command, v, at, &to);
        if (bends && !cannot_fold(r, p))
            return fail(r, n, "a curve, where paper folds along straight lines only:", here);
        if (bends) tell(&r->curves, n);
        else if ((command | 32) == 'm') {
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
static rg_status ring(reader *r, const rg_xml_node *n, const rg_paint *p)
{
    int kind;
    if (rg_paint_kind(&r->with, p, &kind) == RG_BORDER)
        return rg_fail(RG_EFORMAT, r->why, rg_xml_line(n), "<%s>: a curve as border, paper has straight ones here",
                       rg_xml_name(n));
    tell(&r->rings, n);
    return RG_OK;
}

static int is_shape(const rg_xml_node *n)
{
    static const char *const names[] = {"line", "rect", "polyline", "polygon", "path", "circle", "ellipse"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (rg_xml_is(n, names[i])) return 1;
    return 0;
}

/* What is not seen: counted, so that it can be told. The parser bounds the depth. */
static rg_status tell_hidden(reader *r, const rg_xml_node *n)
{
    rg_status s = charge(r, n, OF_ELEMENT);
    if (is_shape(n)) tell(&r->hidden, n);
    if (rg_xml_is(n, "defs") || rg_xml_is(n, "symbol")) return s;
    for (const rg_xml_node *c = rg_xml_child(n); s == RG_OK && c; c = rg_xml_next(c)) s = tell_hidden(r, c);
    return s;
}

static rg_status shape(reader *r, const rg_xml_node *n, const rg_paint *p)
{
    const char *name = rg_xml_name(n);
    if (!is_shape(n)) return RG_OK;
    if (p->hidden) return tell(&r->hidden, n), RG_OK;
    if (!p->stroked && !p->letter) return tell(&r->unpainted, n), RG_OK;
    if (is(name, "line")) return line(r, n, p);
    if (is(name, "rect")) return rectangle(r, n, p);
    if (is(name, "polyline")) return polyline(r, n, p, 0);
    if (is(name, "polygon")) return polyline(r, n, p, 1);
    if (is(name, "path")) return path(r, n, p);
    return ring(r, n, p);
}

/* ------------------------------------------------------------------------------------- viewports, repeats ---- */

/* Width or height of a viewport: as the <use> that repeats it says, or it itself, or all that is around it. */
static rg_status extent(const reader *r, const rg_xml_node *n, const rg_xml_node *user, const rg_paint *p,
                        const char *name, double *x)
{
    const rg_xml_node *says = user && *rg_xml_attribute(user, name) ? user : n;
    const char *text = rg_xml_attribute(says, name);
    double part = 100;
    if (!*text || is(text, "auto")) return RG_OK;
    if (!strchr(text, '%')) return length(r, says, p, name, x);
    if (!next_number(&text, &part)) return fail(r, says, name, rg_xml_attribute(says, name));
    *x *= part / 100;
    return RG_OK;
}

/* 0: there is none that can be used. */
static int view_box(const rg_xml_node *n, double box[4])
{
    const char *s = rg_xml_attribute(n, "viewBox");
    for (int i = 0; i < 4; i++)
        if (!next_number(&s, &box[i])) return 0;
    return box[2] > 0 && box[3] > 0;
}

/* Where what is `free` wide is put: at the beginning, in the middle, at the end. */
static double align(const char *how, char axis, double free)
{
    const char *at = strchr(how, axis);
    return at && strncmp(at + 1, "Min", 3) == 0 ? 0 : at && strncmp(at + 1, "Max", 3) == 0 ? free : free / 2;
}

/* The coordinates of a viewBox, fitted into the viewport, which then is the box. */
static void fit(const rg_xml_node *n, const double box[4], rg_paint *p)
{
    const char *how = rg_xml_attribute(n, "preserveAspectRatio");
    const double w = isnan(p->w) ? box[2] : p->w, h = isnan(p->h) ? box[3] : p->h;
    double x = w / box[2], y = h / box[3];
    if (!strstr(how, "none")) x = y = strstr(how, "slice") ? fmax(x, y) : fmin(x, y);
    p->m = rg_affine_mul(p->m, rg_affine_shift(align(how, 'x', w - x * box[2]), align(how, 'Y', h - y * box[3])));
    p->m = rg_affine_mul(rg_affine_mul(p->m, rg_affine_scale(x, y)), rg_affine_shift(-box[0], -box[1]));
}

/* Metres in a unit of the drawing, where it says how large it is on paper; 0: it does not. */
static double size_on_paper(const rg_xml_node *n, const rg_paint *p, const int metric[2])
{
    const double pixel = 0.0254 / 96;
    double box[4], x = INFINITY;
    if (!metric[0] && !metric[1]) return 0;
    if (!view_box(n, box)) return pixel;
    if (metric[0]) x = p->w / box[2];
    if (metric[1]) x = fmin(x, p->h / box[3]);
    return x > 0 && isfinite(x) ? x * pixel : 0;
}

/* Into a <svg> or <symbol>. The outmost one is the drawing itself, whose units stay what they are. */
static rg_status enter_viewport(const reader *r, const rg_xml_node *n, const rg_xml_node *user, rg_paint *p)
{
    const int is_outmost = r->depth == 1;
    const rg_paint around = *p;
    double x = 0, y = 0, box[4];
    int metric[2] = {0, 0};
    rg_status s = RG_OK;
    if (is_outmost) {
        if (!pixels(rg_xml_attribute(n, "width"), NAN, &p->w, &metric[0])) p->w = NAN;
        if (!pixels(rg_xml_attribute(n, "height"), NAN, &p->h, &metric[1])) p->h = NAN;
        r->out->metres = size_on_paper(n, p, metric);
    } else {
        s = length(r, n, p, "x", &x);
        if (s == RG_OK) s = length(r, n, p, "y", &y);
        if (s == RG_OK) s = extent(r, n, user, &around, "width", &p->w);
        if (s == RG_OK) s = extent(r, n, user, &around, "height", &p->h);
        p->m = rg_affine_mul(p->m, rg_affine_shift(x, y));
    }
    if (s != RG_OK || !view_box(n, box)) return s;
    if (!is_outmost) fit(n, box, p);
    p->w = box[2];
    p->h = box[3];
    return RG_OK;
}

static rg_status element(reader *r, const rg_xml_node *n, const rg_paint *around, const rg_xml_node *user);

/* <use>: draws what it names as if it stood here. p: its own, which is moved there. */
static rg_status repeat(reader *r, const rg_xml_node *n, rg_paint *p)
{
    const char *name = rg_xml_attribute(n, "href");
    const rg_xml_node *target = *name == '#' ? rg_ids_find(&r->with.ids, name + 1) : NULL;
    if (!target)
        return rg_lines_warn(r->out, rg_xml_line(n),
                             *name && *name != '#' ? "<use>: \"%.60s\" lies in another file and is missing"
                                                   : "<use>: there is no \"%.60s\"", name);
    for (const chain *c = r->uses; c; c = c->out)
        if (c->target == target) return fail(r, n, "it repeats itself:", name);
    double x = 0, y = 0;
    rg_status s = length(r, n, p, "x", &x);
    if (s == RG_OK) s = length(r, n, p, "y", &y);
    p->m = rg_affine_mul(p->m, rg_affine_shift(x, y));
    const chain here = {n, target, r->uses};
    r->uses = &here;
    if (s == RG_OK) s = element(r, target, p, n);
    r->uses = here.out;
    return s;
}

/* ---------------------------------------------------------------------------------------------------- tree ---- */

static int is_group(const rg_xml_node *n, const rg_xml_node *user)
{
    const char *name = rg_xml_name(n);
    return is(name, "g") || is(name, "a") || is(name, "svg") || is(name, "switch") || (user && is(name, "symbol"));
}

static rg_status inside(reader *r, const rg_xml_node *n, const rg_paint *p)
{
    rg_status s = RG_OK;
    for (const rg_xml_node *c = rg_xml_child(n); s == RG_OK && c; c = rg_xml_next(c)) s = element(r, c, p, NULL);
    return s;
}

/* After an element was looked at. */
static rg_status go_on(reader *r, const rg_xml_node *n)
{
    rg_css *css = &r->with.css;
    if (css->work > css->most)
        return rg_fail(RG_EFORMAT, r->why, rg_xml_line(n),
                       "<%.20s>: its styles are too much to look through, with all rules, variables and gradients",
                       rg_xml_name(n));
    if (css->work - r->asked_at < WORK_UNASKED) return RG_OK;
    r->asked_at = css->work;
    return rg_stop_asked(r->out->stop) ? RG_ECANCELLED : RG_OK;
}

/* An element in what is around it; `user`: the <use> that names it. */
static rg_status element(reader *r, const rg_xml_node *n, const rg_paint *around, const rg_xml_node *user)
{
    rg_paint p = *around; /* one for each level: threads may have small stacks */
    const char *name = rg_xml_name(n);
    const size_t path = strlen(rg_xml_attribute(n, "d")) + strlen(rg_xml_attribute(n, "points"));
    rg_status s = charge(r, n, OF_ELEMENT + path + rg_xml_attributes_size(n) / OTHERS_A_BYTE);
    if (s != RG_OK) return s;
    r->with.css.most += WORK_AN_ELEMENT;
    const int is_there = rg_paint_inherit(&r->with, n, &p);
    if ((s = go_on(r, n)) != RG_OK) return s;
    if (!is_there) return tell_hidden(r, n);
    if (r->depth == MOST_NESTED) return fail(r, n, "nested too deep:", name);
    r->depth++;
    const int is_viewport = is(name, "svg") || (user && is(name, "symbol"));
    s = transform(r, n, &p.m);
    if (s == RG_OK) s = go_on(r, n);
    if (s == RG_OK && is_viewport) s = enter_viewport(r, n, user, &p);
    if (s == RG_OK) s = is(name, "use") ? repeat(r, n, &p) : is_group(n, user) ? inside(r, n, &p) : shape(r, n, &p);
    r->depth--;
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
        s = rg_xml_is(c, "style") ? rg_css_add(&r->with.css, c, r->out, r->why) : styles(r, c);
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

/* What was left out, each kind told once. */
static rg_status tell_all(reader *r)
{
    const struct { const tally *t; const char *format; } kinds[] = {
        {&r->hidden, "hidden (display or visibility): %d left out, the first here"},
        {&r->rings, "circles are left out as marks, no creases: %d, the first here"},
        {&r->curves, "curves of auxiliary lines are left out: %d, the first here"},
        {&r->unwanted, "left out as --line asks: %d lines, the first here"}};
    rg_status s = RG_OK;
    for (size_t i = 0; s == RG_OK && i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].t->count) s = rg_lines_warn(r->out, kinds[i].t->where, kinds[i].format, (int)kinds[i].t->count);
    for (int i = 0; s == RG_OK && i < MOST_UNKNOWN && r->unknown[i].count; i++)
        s = rg_lines_warn(r->out, r->unknown[i].where,
                          "stroke \"%.80s\" is no plain colour: taken for auxiliary lines (%d); --line says what"
                          " they are", r->unknown[i].text, (int)r->unknown[i].count);
    return s;
}

static rg_status nothing_drawn(const reader *r, const rg_xml_node *root)
{
    const int32_t left_out = r->rings.count + r->curves.count + r->unwanted.count;
    if (r->hidden.count && r->hidden.count >= r->unpainted.count)
        return rg_fail(RG_EFORMAT, r->why, r->hidden.where,
                       "no lines: what is drawn is hidden (display or visibility), %d shapes, the first here",
                       (int)r->hidden.count);
    if (r->unpainted.count)
        return rg_fail(RG_EFORMAT, r->why, r->unpainted.where,
                       "no lines: no shape has a stroke, %d of them, the first here",
                       (int)r->unpainted.count);
    if (left_out)
        return rg_fail(RG_EFORMAT, r->why, rg_xml_line(root),
                       "no lines: all of the drawing is circles, curves or left out");
    return rg_fail(RG_EFORMAT, r->why, rg_xml_line(root), "no lines: there are no shapes in the drawing");
}

static rg_status document(reader *r, const rg_xml_node *root)
{
    if (!rg_xml_is(root, "svg"))
        return rg_fail(RG_EFORMAT, r->why, rg_xml_line(root), "the root is <%.40s>, not <svg>", rg_xml_name(root));
    const rg_paint plain = {.color = "black", .dash = "solid", .kind = -1, .angle = NAN, .alpha = 1,
                            .stroke_opacity = 1, .opacity = 1, .w = NAN, .h = NAN, .m = rg_affine_shift(0, 0)};
    rg_status s = metadata(r->out, root);
    if (s == RG_OK) s = styles(r, root);
    if (s == RG_OK) s = rg_ids_init(&r->with.ids, &r->out->mem, root);
    if (s == RG_OK) s = element(r, root, &plain, NULL);
    if (s == RG_OK) s = tell_all(r);
    return s == RG_OK && r->out->count == 0 ? nothing_drawn(r, root) : s;
}

rg_status rg_svg_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop,
                      const rg_reading *settings, rg_lines *out, rg_diag *why)
{
    rg_xml *doc = NULL;
    reader r = {.out = out, .why = why, .with = {.s = settings}};
    rg_lines_init(out, mem);
    out->stop = stop;
    rg_css_init(&r.with.css, mem);
    out->merge = MERGE;
    out->y_down = 1;
    rg_status s = rg_xml_parse(bytes, size, RG_XML_ANY_TYPE, stop, &doc, why);
    if (s == RG_OK) s = document(&r, rg_xml_root(doc));
    rg_xml_free(doc);
    rg_css_free(&r.with.css);
    rg_ids_free(&r.with.ids);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
