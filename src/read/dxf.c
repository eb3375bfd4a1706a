#include "read/dxf.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/status.h"
#include "read/affine.h"
#include "read/colour.h"

#include <stdlib.h>
#include <string.h>

enum { BY_BLOCK = 0, BY_LAYER = 256, WHITE = 7, MOST_LAYERS = 4096 };
/* What INSERT repeats is bounded in sum, counted in pairs, and so is how deep blocks stand in each other. */
enum { MOST_REPEATED = 1 << 22, OF_SEGMENT = 8, MOST_NESTED = 64 };

typedef struct slice { const char *s; size_t n; } slice;
typedef struct layer { slice name; int colour; } layer;
typedef struct block { slice name; rg_vec2 base; const char *s; int32_t line, order; } block; /* s: its first entity */

/* What of an entity has been read so far. */
typedef struct entity {
    slice name, layer;
    int32_t where;
    long colour, flags, rgb; /* rgb -1: none */
    double x[3], y[3];       /* by group code less 10; of a vertex x[0], y[0] */
    int points, mirrored;    /* mirrored: drawn on the back of its plane */
    int on_sheet;            /* of a layout: paper to print on */
    rg_vec2 first, last;
} entity;

/* The INSERT that are being followed, inmost first. */
typedef struct chain { const entity *insert; const block *block; const struct chain *out; } chain;

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
    block *blocks; /* sorted by name */
    int32_t block_count;
    size_t block_room;
    const chain *inserts;
    rg_affine place; /* of the block that is read */
    int64_t repeated;
    int told_sheet;
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

/* What is repeated costs time and room that the size of the file does not bound. */
static rg_status charge(reader *r, int cost)
{
    if (!r->inserts || (r->repeated += cost) <= MOST_REPEATED) return RG_OK;
    return rg_fail(RG_EFORMAT, r->why, r->inserts->insert->where, "INSERT: the drawing is too large with all that it repeats");
}

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
    return charge(r, 1);
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

static int layer_colour(const reader *r, slice name)
{
    int colour = WHITE;
    for (int32_t i = 0; i < r->layer_count; i++)
        if (r->layers[i].name.n == name.n && memcmp(r->layers[i].name.s, name.s, name.n) == 0) colour = r->layers[i].colour;
    return colour;
}

/* What a block leaves open is as the INSERT has it. */
static void inherit(const reader *r, entity *e)
{
    const entity *from = r->inserts ? r->inserts->insert : NULL;
    if (from && e->colour == BY_BLOCK && e->rgb < 0) {
        e->colour = from->colour == BY_LAYER ? layer_colour(r, from->layer) : from->colour;
        e->rgb = from->rgb;
    }
    if (from && is(e->layer, "0")) e->layer = from->layer;
}

static char assignment(const reader *r, const entity *e)
{
    const char named = by_name(e->layer);
    if (named) return named;
    if (e->rgb >= 0)
        return rg_colour_assignment((rg_colour){(double)(e->rgb >> 16 & 255) / 255, (double)(e->rgb >> 8 & 255) / 255,
                                                (double)(e->rgb & 255) / 255});
    return rg_colour_index_assignment((int)(e->colour == BY_LAYER ? layer_colour(r, e->layer) : e->colour));
}

/* ---------------------------------------------------------------------------------------------- entities ---- */

static rg_status segment(reader *r, const entity *e, rg_vec2 a, rg_vec2 b)
{
    if (e->on_sheet)
        return r->told_sheet++ ? RG_OK : rg_lines_warn(r->out, e->where, "what is drawn on a layout's paper is left out");
    if (e->mirrored) a.x = -a.x, b.x = -b.x;
    a = rg_affine_point(r->place, a);
    b = rg_affine_point(r->place, b);
    if (!isfinite(a.x) || !isfinite(a.y) || !isfinite(b.x) || !isfinite(b.y))
        return rg_lines_warn(r->out, e->where, "a line is dropped: a coordinate is not a finite number");
    const rg_status s = charge(r, OF_SEGMENT);
    return s == RG_OK ? rg_lines_add(r->out, a, b, assignment(r, e), e->where) : s;
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

/* What any entity may say. */
static rg_status common(reader *r, entity *e)
{
    double z;
    long paper;
    rg_status s = RG_OK;
    if (r->code == 8) e->layer = r->value;
    if (r->code == 62) s = whole(r, &e->colour);
    if (r->code == 420) s = whole(r, &e->rgb);
    if (r->code == 67 && (s = whole(r, &paper)) == RG_OK) e->on_sheet = paper != 0;
    if (r->code == 230 && (s = number(r, &z)) == RG_OK) e->mirrored = z < 0;
    return s;
}

/* The pairs of one entity up to the next one. In a polyline each 10 begins a corner, if `corners` says so. */
static rg_status groups(reader *r, entity *e, int corners)
{
    int open = 0;
    rg_status s;
    while ((s = next(r)) == RG_OK && r->code != 0) {
        double bulge;
        s = common(r, e);
        if (s == RG_OK && r->code == 70) s = whole(r, &e->flags);
        if (r->code == 10 && corners) {
            if (s == RG_OK && open) s = corner(r, e);
            open = 1;
        }
        if (s == RG_OK && (r->code == 10 || r->code == 11)) s = number(r, &e->x[r->code - 10]);
        if (s == RG_OK && (r->code == 20 || r->code == 21)) s = number(r, &e->y[r->code - 20]);
        if (s == RG_OK && r->code == 42) s = number(r, &bulge);
        if (s == RG_OK && r->code == 42 && bulge != 0)
            s = rg_fail(RG_EFORMAT, r->why, r->line, "%.*s: a bulge, where paper folds along straight lines only",
                        show(e->name), e->name.s);
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

/* Back to where it was. */
static void return_to(reader *r, const reader *was)
{
    r->s = was->s;
    r->line = was->line;
    r->code = was->code;
    r->value = was->value;
    r->pending = was->pending;
}

static rg_status close_polyline(reader *r, const entity *e)
{
    return e->flags & 1 && e->points > 2 ? segment(r, e, e->last, e->first) : RG_OK;
}

/* Read twice: what holds for all corners may stand behind them. */
static rg_status light_polyline(reader *r, entity *e)
{
    const reader was = *r;
    rg_status s = groups(r, e, 0);
    if (s != RG_OK) return s;
    return_to(r, &was);
    inherit(r, e);
    e->first = e->last = (rg_vec2){0, 0};
    s = groups(r, e, 1);
    return s == RG_OK ? close_polyline(r, e) : s;
}

/* POLYLINE, its VERTEX entities, SEQEND. */
static rg_status old_polyline(reader *r, entity *e)
{
    rg_status s = groups(r, e, 0);
    inherit(r, e);
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

/* ------------------------------------------------------------------------------------------------ blocks ---- */

/* What an INSERT says of where its block goes. */
typedef struct insert {
    slice name;
    double scale[5]; /* by group code less 41: of x, y, z; then from column to column, from row to row */
    double turn;     /* degrees */
    long count[2];   /* columns, rows */
} insert;

/* Names of blocks are the same in small and capital letters. */
static int compare(slice a, slice b)
{
    for (size_t i = 0; i < a.n && i < b.n; i++)
        if (lower(a.s[i]) != lower(b.s[i])) return (unsigned char)lower(a.s[i]) < (unsigned char)lower(b.s[i]) ? -1 : 1;
    return (a.n > b.n) - (a.n < b.n);
}

static int by_block_name(const void *a, const void *b)
{
    const block *p = a, *q = b;
    const int order = compare(p->name, q->name);
    return order ? order : (p->order > q->order) - (p->order < q->order);
}

static const block *find_block(const reader *r, slice name)
{
    int32_t low = 0, high = r->block_count;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (compare(r->blocks[middle].name, name) < 0) low = middle + 1;
        else high = middle;
    }
    return low < r->block_count && compare(r->blocks[low].name, name) == 0 ? &r->blocks[low] : NULL;
}

static rg_status entities(reader *r);

static rg_affine placed(const entity *e, const insert *i, const block *b, long column, long row)
{
    rg_affine m = rg_affine_mul(rg_affine_scale(e->mirrored ? -1 : 1, 1), rg_affine_shift(e->x[0], e->y[0]));
    m = rg_affine_mul(m, rg_affine_turn(i->turn));
    m = rg_affine_mul(m, rg_affine_shift((double)column * i->scale[3], (double)row * i->scale[4]));
    return rg_affine_mul(rg_affine_mul(m, rg_affine_scale(i->scale[0], i->scale[1])), rg_affine_shift(-b->base.x, -b->base.y));
}

/* Reads the block again for every place that it has. */
static rg_status follow(reader *r, const entity *e, const insert *i, const block *b)
{
    const reader was = *r;
    const chain here = {e, b, r->inserts};
    rg_status s = RG_OK;
    r->inserts = &here;
    for (long row = 0; s == RG_OK && row < i->count[1]; row++)
        for (long column = 0; s == RG_OK && column < i->count[0]; column++) {
            r->place = rg_affine_mul(was.place, placed(e, i, b, column, row));
            r->s = b->s;
            r->line = b->line;
            r->pending = 0;
            s = entities(r);
        }
    return_to(r, &was);
    r->inserts = was.inserts;
    r->place = was.place;
    return s;
}

static rg_status read_insert(reader *r, entity *e)
{
    insert i = {.name = {"", 0}, .scale = {1, 1, 1, 0, 0}, .count = {1, 1}};
    rg_status s;
    while ((s = next(r)) == RG_OK && r->code != 0) {
        const long code = r->code;
        s = common(r, e);
        if (code == 2) i.name = r->value;
        if (s == RG_OK && code == 10) s = number(r, &e->x[0]);
        if (s == RG_OK && code == 20) s = number(r, &e->y[0]);
        if (s == RG_OK && code >= 41 && code <= 45) s = number(r, &i.scale[code - 41]);
        if (s == RG_OK && code == 50) s = number(r, &i.turn);
        if (s == RG_OK && (code == 70 || code == 71)) s = whole(r, &i.count[code - 70]);
        if (s != RG_OK) return s;
    }
    r->pending = 1;
    if (s != RG_OK || e->on_sheet) return s;
    inherit(r, e);
    for (int k = 0; k < 2; k++)
        if (i.count[k] < 1) i.count[k] = 1; /* 0 is what some programs write for one */
    const block *b = find_block(r, i.name);
    if (!b) return rg_lines_warn(r->out, e->where, "INSERT: there is no block \"%.*s\"", show(i.name), i.name.s);
    int depth = 0;
    for (const chain *c = r->inserts; c; c = c->out, depth++)
        if (c->block == b)
            return rg_fail(RG_EFORMAT, r->why, e->where, "INSERT: the block \"%.*s\" repeats itself", show(i.name), i.name.s);
    if (depth == MOST_NESTED) return rg_fail(RG_EFORMAT, r->why, e->where, "INSERT: blocks are nested too deep");
    return follow(r, e, &i, b);
}

/* The section of blocks: what they are called, and where their entities begin. */
static rg_status blocks(reader *r)
{
    block *open = NULL;
    for (rg_status s;;) {
        const char *here = r->s;
        const int32_t line = r->line;
        if ((s = next(r)) != RG_OK) return s;
        if (r->code == 0 && open) {
            open->s = here;
            open->line = line;
            open = NULL;
        }
        if (r->code == 0 && is(r->value, "EOF")) r->pending = 1;
        if (r->code == 0 && (is(r->value, "ENDSEC") || r->pending)) break;
        if (r->code == 0 && is(r->value, "BLOCK")) {
            if (r->block_count == INT32_MAX) return RG_ENOMEM;
            s = rg_mem_grow(&r->out->mem, (void **)&r->blocks, &r->block_room, (size_t)r->block_count + 1, sizeof *r->blocks);
            if (s != RG_OK) return s;
            open = &r->blocks[r->block_count];
            *open = (block){.name = {"", 0}, .order = r->block_count++};
        }
        if (open && r->code == 2) open->name = r->value;
        if (open && r->code == 10) s = number(r, &open->base.x);
        if (open && r->code == 20) s = number(r, &open->base.y);
        if (s != RG_OK) return s;
    }
    if (r->block_count > 0) qsort(r->blocks, (size_t)r->block_count, sizeof *r->blocks, by_block_name);
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------------- sections ---- */

static rg_status read_entity(reader *r)
{
    static const char *const curves[] = {"ARC", "CIRCLE", "ELLIPSE", "SPLINE", "HELIX"};
    entity e = begin(r);
    for (size_t i = 0; i < sizeof curves / sizeof *curves; i++)
        if (is(e.name, curves[i])) return curve(r, e.name, e.where);
    if (is(e.name, "POLYLINE")) return old_polyline(r, &e);
    if (is(e.name, "LWPOLYLINE")) return light_polyline(r, &e);
    if (is(e.name, "INSERT")) return read_insert(r, &e);
    rg_status s;
    if (!is(e.name, "LINE")) {
        while ((s = next(r)) == RG_OK && r->code != 0) continue;
        r->pending = 1;
        return s;
    }
    s = groups(r, &e, 0);
    e.mirrored = 0; /* the ends of a LINE are those of the drawing, whatever its plane */
    inherit(r, &e);
    return s == RG_OK ? segment(r, &e, (rg_vec2){e.x[0], e.y[0]}, (rg_vec2){e.x[1], e.y[1]}) : s;
}

static rg_status entities(reader *r)
{
    for (rg_status s;;) {
        if ((s = next(r)) != RG_OK) return s;
        if (r->code != 0) continue;
        if (is(r->value, "ENDSEC") || is(r->value, "ENDBLK")) return RG_OK;
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
        if (name && is(r->value, "BLOCKS") && (s = blocks(r)) != RG_OK) return s;
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
    reader r = {.out = out, .why = why, .s = bytes, .end = (const char *)bytes + size, .place = rg_affine_shift(0, 0)};
    rg_lines_init(out, mem);
    rg_status s = size ? sections(&r) : rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    rg_mem_free(mem, r.layers);
    rg_mem_free(mem, r.blocks);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
