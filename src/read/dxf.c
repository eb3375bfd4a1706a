#include "read/dxf.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/status.h"
#include "read/colour.h"

#include <string.h>

enum { BY_LAYER = 256, WHITE = 7, MOST_LAYERS = 4096 };

typedef struct slice { const char *s; size_t n; } slice;
typedef struct layer { slice name; int colour; } layer;

/* What of an entity has been read so far. */
typedef struct entity {
    slice name, layer;
    int32_t where;
    long colour, flags, rgb; /* rgb -1: none */
    double x[3], y[3];       /* by group code less 10; of a vertex x[0], y[0] */
    int points, mirrored;    /* mirrored: drawn on the back of its plane */
    rg_vec2 first, last;
} entity;

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    const char *s, *end;
    int32_t line;  /* of the value of the last pair */
    long code;
    slice value;
    int pending;   /* the last pair is to be read again */
    layer *layers; /* by the table of layers */
    int32_t layer_count;
    size_t layer_room;
    int told_insert;
} reader;

/* ------------------------------------------------------------------------------------------------- pairs ---- */

static slice next_line(reader *r)
{
    const char *from = r->s;
    while (r->s < r->end && *r->s != '\n' && *r->s != '\r') r->s++;
    slice l = {from, (size_t)(r->s - from)};
    if (r->s < r->end) r->s += *r->s == '\r' && r->s + 1 < r->end && r->s[1] == '\n' ? 2 : 1;
    if (r->line < INT32_MAX) r->line++;
    while (l.n > 0 && (*l.s == ' ' || *l.s == '\t')) l.s++, l.n--;
    while (l.n > 0 && (l.s[l.n - 1] == ' ' || l.s[l.n - 1] == '\t')) l.n--;
    return l;
}

static int show(slice s) { return s.n < 40 ? (int)s.n : 40; }

/* The next pair of group code and value. A file that just ends is refused: it says EOF where it ends. */
static rg_status next(reader *r)
{
    if (r->pending) return r->pending = 0, RG_OK;
    if (r->s >= r->end) return rg_fail(RG_EFORMAT, r->why, r->line, "the file ends here, without EOF: it is cut short");
    const slice code = next_line(r);
    if (!rg_number_whole(code.s, code.n, &r->code))
        return rg_fail(RG_EFORMAT, r->why, r->line, "group code \"%.*s\" is no whole number", show(code), code.s);
    if (r->s >= r->end)
        return rg_fail(RG_EFORMAT, r->why, r->line, "the file ends here, without EOF: it is cut short");
    r->value = next_line(r);
    return RG_OK;
}

static int is(slice s, const char *word) { return s.n == strlen(word) && memcmp(s.s, word, s.n) == 0; }

static rg_status whole(const reader *r, long *x)
{
    if (rg_number_whole(r->value.s, r->value.n, x)) return RG_OK;
    return rg_fail(RG_EFORMAT, r->why, r->line, "group %ld is \"%.*s\", which is no whole number", r->code, show(r->value),
                   r->value.s);
}

static rg_status number(const reader *r, double *x)
{
    if (rg_number_parse(r->value.s, r->value.n, x) && isfinite(*x)) return RG_OK;
    return rg_fail(RG_EFORMAT, r->why, r->line, "group %ld is \"%.*s\", which is no finite number", r->code, show(r->value),
                   r->value.s);
}

/* ------------------------------------------------------------------------------------------- assignments ---- */

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

static int contains(slice s, const char *word)
{
    const size_t n = strlen(word);
    for (size_t at = 0; at + n <= s.n; at++) {
        size_t i = 0;
        while (i < n && lower(s.s[at + i]) == word[i]) i++;
        if (i == n) return 1;
    }
    return 0;
}

/* 0: the name says nothing. */
static char by_name(slice name)
{
    static const struct { const char *word; char assignment; } words[] = {
        {"mountain", RG_MOUNTAIN}, {"valley", RG_VALLEY}, {"unassigned", RG_UNASSIGNED}, {"aux", RG_FLAT},
        {"facet", RG_FLAT}, {"flat", RG_FLAT}, {"cut", RG_BORDER}, {"border", RG_BORDER}, {"boundary", RG_BORDER}, {"contour", RG_BORDER},
        {"outline", RG_BORDER}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (contains(name, words[i].word)) return words[i].assignment;
    return 0;
}

static char assignment(const reader *r, const entity *e)
{
    const char named = by_name(e->layer);
    if (named) return named;
    if (e->rgb >= 0)
        return rg_colour_assignment((rg_colour){(double)(e->rgb >> 16 & 255) / 255, (double)(e->rgb >> 8 & 255) / 255,
                                                (double)(e->rgb & 255) / 255});
    long colour = e->colour;
    if (colour == BY_LAYER) {
        colour = WHITE;
        for (int32_t i = 0; i < r->layer_count; i++)
            if (r->layers[i].name.n == e->layer.n && memcmp(r->layers[i].name.s, e->layer.s, e->layer.n) == 0)
                colour = r->layers[i].colour;
    }
    return rg_colour_index_assignment((int)colour);
}

/* ---------------------------------------------------------------------------------------------- entities ---- */

static rg_status segment(reader *r, const entity *e, rg_vec2 a, rg_vec2 b)
{
    if (e->mirrored) a.x = -a.x, b.x = -b.x;
    return rg_lines_add(r->out, a, b, assignment(r, e), e->where);
}

/* A corner of a polyline is complete. */
static rg_status corner(reader *r, entity *e)
{
    const rg_vec2 x = {e->x[0], e->y[0]};
    const rg_status s = e->points ? segment(r, e, e->last, x) : RG_OK;
    if (!e->points++) e->first = x;
    e->last = x;
    return s;
}

static rg_status curve(const reader *r, slice name, int32_t where)
{
    return rg_fail(RG_EFORMAT, r->why, where, "%.*s: a curve, where paper folds along straight lines only", show(name), name.s);
}

/* The pairs of one entity up to the next one. In a polyline each 10 begins a corner, if `corners` says so. */
static rg_status groups(reader *r, entity *e, int corners)
{
    int open = 0;
    rg_status s;
    while ((s = next(r)) == RG_OK && r->code != 0) {
        double bulge, z;
        if (r->code == 8) e->layer = r->value;
        if (r->code == 62) s = whole(r, &e->colour);
        if (r->code == 420) s = whole(r, &e->rgb);
        if (r->code == 70) s = whole(r, &e->flags);
        if (r->code == 10 && corners) {
            if (open) s = corner(r, e);
            open = 1;
        }
        if (s == RG_OK && (r->code == 10 || r->code == 11)) s = number(r, &e->x[r->code - 10]);
        if (s == RG_OK && (r->code == 20 || r->code == 21)) s = number(r, &e->y[r->code - 20]);
        if (s == RG_OK && r->code == 42) s = number(r, &bulge);
        if (s == RG_OK && r->code == 42 && bulge != 0)
            s = rg_fail(RG_EFORMAT, r->why, r->line, "%.*s: a bulge, where paper folds along straight lines only",
                        show(e->name), e->name.s);
        if (s == RG_OK && r->code == 230) {
            s = number(r, &z);
            e->mirrored = s == RG_OK && z < 0;
        }
        if (s != RG_OK) return s;
    }
    r->pending = 1;
    if (s == RG_OK && open) s = corner(r, e);
    return s;
}

static entity begin(const reader *r)
{
    return (entity){.name = r->value, .where = r->line, .colour = BY_LAYER, .rgb = -1, .layer = {"", 0}};
}

static rg_status close_polyline(reader *r, const entity *e)
{
    return e->flags & 1 && e->points > 2 ? segment(r, e, e->last, e->first) : RG_OK;
}

/* POLYLINE, its VERTEX entities, SEQEND. */
static rg_status old_polyline(reader *r, entity *e)
{
    rg_status s = groups(r, e, 0);
    if (s == RG_OK && e->flags & 0x76) return curve(r, e->name, e->where); /* fitted curves, meshes */
    while (s == RG_OK && (s = next(r)) == RG_OK && is(r->value, "VERTEX")) {
        entity v = begin(r);
        s = groups(r, &v, 0);
        e->x[0] = v.x[0];
        e->y[0] = v.y[0];
        if (s == RG_OK) s = corner(r, e);
    }
    if (s == RG_OK && !is(r->value, "SEQEND")) r->pending = 1;
    return s == RG_OK ? close_polyline(r, e) : s;
}

static rg_status read_entity(reader *r)
{
    static const char *const curves[] = {"ARC", "CIRCLE", "ELLIPSE", "SPLINE", "HELIX"};
    entity e = begin(r);
    for (size_t i = 0; i < sizeof curves / sizeof *curves; i++)
        if (is(e.name, curves[i])) return curve(r, e.name, e.where);
    if (is(e.name, "POLYLINE")) return old_polyline(r, &e);
    if (is(e.name, "INSERT") && !r->told_insert++) {
        const rg_status s = rg_lines_warn(r->out, e.where, "INSERT is not followed: what is in the block is missing");
        if (s != RG_OK) return s;
    }
    const int light = is(e.name, "LWPOLYLINE");
    if (!light && !is(e.name, "LINE")) {
        rg_status s;
        while ((s = next(r)) == RG_OK && r->code != 0) continue;
        r->pending = 1;
        return s;
    }
    rg_status s = groups(r, &e, light);
    if (s == RG_OK && light) return close_polyline(r, &e);
    e.mirrored = 0; /* the ends of a LINE are those of the drawing, whatever its plane */
    return s == RG_OK ? segment(r, &e, (rg_vec2){e.x[0], e.y[0]}, (rg_vec2){e.x[1], e.y[1]}) : s;
}

static rg_status entities(reader *r)
{
    for (rg_status s;;) {
        if ((s = next(r)) != RG_OK) return s;
        if (r->code != 0) continue;
        if (is(r->value, "ENDSEC")) return RG_OK;
        if (is(r->value, "EOF")) return r->pending = 1, RG_OK;
        if ((s = read_entity(r)) != RG_OK) return s;
    }
}

/* The table of layers, for the colours that lines take from it. */
static rg_status tables(reader *r)
{
    layer *l = NULL;
    for (rg_status s;;) {
        if ((s = next(r)) != RG_OK) return s;
        if (r->code == 0) l = NULL;
        if (r->code == 0 && is(r->value, "ENDSEC")) return RG_OK;
        if (r->code == 0 && is(r->value, "EOF")) return r->pending = 1, RG_OK;
        if (r->code == 0 && is(r->value, "LAYER") && r->layer_count < MOST_LAYERS) {
            s = rg_mem_grow(&r->out->mem, (void **)&r->layers, &r->layer_room, (size_t)r->layer_count + 1,
                            sizeof *r->layers);
            if (s != RG_OK) return s;
            l = &r->layers[r->layer_count++];
            *l = (layer){{"", 0}, WHITE};
        }
        if (l && r->code == 2) l->name = r->value;
        if (l && r->code == 62) {
            long colour;
            if ((s = whole(r, &colour)) != RG_OK) return s;
            l->colour = colour > -256 && colour < 0 ? (int)-colour : (int)(colour & 255); /* negative: switched off */
        }
    }
}

static rg_status sections(reader *r)
{
    int section = 0, seen = 0;
    for (rg_status s;;) {
        if ((s = next(r)) != RG_OK) return s;
        if (r->code == 0 && is(r->value, "EOF")) break;
        const int name = section && r->code == 2;
        section = r->code == 0 && is(r->value, "SECTION");
        if (name && is(r->value, "TABLES") && (s = tables(r)) != RG_OK) return s;
        if (name && is(r->value, "ENTITIES")) {
            seen = 1;
            if ((s = entities(r)) != RG_OK) return s;
        }
    }
    if (!seen) return rg_fail(RG_EFORMAT, r->why, r->line, "no section ENTITIES: nothing is drawn");
    return r->out->count ? RG_OK : rg_fail(RG_EFORMAT, r->why, r->line, "no LINE, LWPOLYLINE or POLYLINE in the drawing");
}

rg_status rg_dxf_read(const void *bytes, size_t size, const rg_memory *mem, rg_lines *out, rg_diag *why)
{
    reader r = {.out = out, .why = why, .s = bytes, .end = (const char *)bytes + size};
    rg_lines_init(out, mem);
    rg_status s = size ? sections(&r) : rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    rg_mem_free(mem, r.layers);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
