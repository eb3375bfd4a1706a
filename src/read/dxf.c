#include "read/dxf.h"
#include "base/memory.h"
#include "base/status.h"
#include "read/colour.h"
#include "read/kinds.h"
#include "read/space.h"
#include "read/tables.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BY_BLOCK = 0, BY_LAYER = 256 };
/* What INSERT repeats is bounded in sum, counted in pairs, and so is how deep blocks stand in each other. */
enum { MOST_REPEATED = 1 << 21, OF_SEGMENT = 8, MOST_NESTED = 64 };
enum { BYTES_A_PAIR = 8 }; /* longer values take longer */
/* Kinds of entities that are told by name when they are left out. */
enum { MOST_LEFT_OUT = 24 };

/* What of an entity has been read so far. */
typedef struct entity {
    rg_slice name, layer, dash;
    rg_layer *on; /* of that name, NULL: it is in no table; known when all of the entity is */
    int32_t where;
    long colour, flags, rgb; /* rgb -1: none */
    /* of a facet of a mesh: vertices from 1, negative: the side after it is not drawn; 0: none */
    long corner[4];
    long rows, columns;      /* of a mesh */
    double x[4], y[4], z[4]; /* by group code less 10; of a vertex [0] */
    double elevation, bulge; /* bulge: of the side after the last corner */
    rg_vec3 normal;          /* of its plane; what is drawn in space has none */
    int points, in_space, invisible;
    int on_sheet;            /* of a layout: paper to print on */
    int32_t bulge_line;
    rg_vec3 first, last;
} entity;

typedef struct tally { rg_slice name; int32_t count, where; } tally;

/* The INSERT that are being followed, inmost first. */
typedef struct chain { const entity *insert; const rg_block *block; const struct chain *out; } chain;

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    const rg_reading *settings;
    rg_pairs in;
    rg_tables tables;
    const chain *inserts;
    rg_map3 place; /* of the block that is read */
    int64_t repeated;
    rg_space space;
    int told_sheet;
    tally left_out[MOST_LEFT_OUT], invisible, curves, unwanted;
} reader;

/* ------------------------------------------------------------------------------------------------- pairs ---- */

/* What is repeated costs time and room that the size of the file does not bound. */
static rg_status charge(reader *r, int64_t cost)
{
    if (!r->inserts || (r->repeated += cost) <= MOST_REPEATED) return RG_OK;
    return rg_fail(RG_EFORMAT, r->why, r->inserts->insert->where,
                   "INSERT: the drawing is too large with all that it repeats");
}

/* The next pair of group code and value. */
static rg_status next(reader *r)
{
    const int is_again = r->in.pending;
    const rg_status s = rg_pairs_next(&r->in);
    return s == RG_OK && !is_again ? charge(r, 1 + (int64_t)(r->in.value.n / BYTES_A_PAIR)) : s;
}

static rg_status whole(const reader *r, long *x) { return rg_pairs_whole(&r->in, x); }
static rg_status number(const reader *r, double *x) { return rg_pairs_number(&r->in, x); }

/* ------------------------------------------------------------------------------------------- assignments ---- */

static void tell(tally *t, int32_t where)
{
    if (!t->count++) t->where = where;
}

/* Entities that are no lines, by their kind; those beyond the most are counted with the last. */
static void leave_out(reader *r, rg_slice name, int32_t where)
{
    int i = 0;
    while (i < MOST_LEFT_OUT - 1 && r->left_out[i].count &&
           !(r->left_out[i].name.n == name.n && memcmp(r->left_out[i].name.s, name.s, name.n) == 0)) i++;
    if (!r->left_out[i].count) r->left_out[i].name = name;
    tell(&r->left_out[i], where);
}

static long layer_colour(const entity *e) { return e->on ? e->on->colour : RG_DXF_WHITE; }

/* The name of its pattern of dashes. */
static rg_slice dash_of(const entity *e)
{
    const rg_layer *l = e->on;
    if (e->dash.n && !rg_slice_is(e->dash, "BYLAYER") && !rg_slice_is(e->dash, "ByLayer")) return e->dash;
    return l && l->dash.n ? l->dash : (rg_slice){"CONTINUOUS", 10};
}

/* What a block leaves open is as the INSERT has it. Looked for once for an entity: there may be many layers. */
static void inherit(const reader *r, entity *e)
{
    const entity *from = r->inserts ? r->inserts->insert : NULL;
    if (from && e->colour == BY_BLOCK && e->rgb < 0) {
        e->colour = from->colour == BY_LAYER ? layer_colour(from) : from->colour;
        e->rgb = from->rgb;
    }
    const int is_open = from && rg_slice_is(e->layer, "0");
    e->on = is_open ? from->on : rg_tables_layer(&r->tables, e->layer);
    if (is_open) e->layer = from->layer;
}

/* A colour of 24 bits as CSS writes it, else the number in the index. */
static rg_slice colour_name(const entity *e, char text[16])
{
    if (e->rgb >= 0) snprintf(text, 16, "#%06lx", e->rgb & 0xffffffL);
    else snprintf(text, 16, "%d", (int)(e->colour == BY_LAYER ? layer_colour(e) : e->colour));
    return (rg_slice){text, strlen(text)};
}

/* What a line of this entity stands for: as the user says, by its layer's name, by its colour. */
static char kind_of(const reader *r, const entity *e, int *kind)
{
    char text[16];
    const rg_slice name[RG_TRAIT_SORTS] = {colour_name(e, text), e->layer, dash_of(e)};
    *kind = -1;
    for (int i = 0; i < RG_TRAIT_SORTS; i++) {
        const int k = rg_kinds_find(r->settings, (rg_trait_sort)i, name[i].s, name[i].n);
        if (k > *kind) *kind = k;
    }
    if (*kind >= 0) return rg_kinds_letter(r->settings, *kind);
    const char named = rg_kinds_of_name(e->layer.s, e->layer.n);
    if (named) return named;
    if (e->rgb >= 0)
        return rg_colour_assignment((rg_colour){(double)(e->rgb >> 16 & 255) / 255, (double)(e->rgb >> 8 & 255) / 255,
                                                (double)(e->rgb & 255) / 255});
    return rg_colour_index_assignment((int)(e->colour == BY_LAYER ? layer_colour(e) : e->colour));
}

/* Of what is no crease, a curve does no harm. */
static int cannot_fold(const reader *r, const entity *e)
{
    int kind;
    const char assignment = kind_of(r, e, &kind);
    return assignment == RG_FLAT || assignment == RG_LEFT_OUT;
}

/* Whether it is not to be seen: then it is counted, with its layer or by itself. */
static int is_hidden(reader *r, const entity *e)
{
    rg_layer *l = e->on;
    if (e->invisible) return tell(&r->invisible, e->where), 1;
    if (!l || !l->hidden) return 0;
    if (!l->lines++) l->where = e->where;
    return 1;
}

/* ---------------------------------------------------------------------------------------------- entities ---- */

static rg_vec3 place_point(const reader *r, const entity *e, rg_vec3 x)
{
    return rg_map3_point(r->place, e->in_space ? x : rg_map3_point(rg_map3_of_normal(e->normal), x));
}

static int is_finite(rg_vec3 x) { return isfinite(x.x) && isfinite(x.y) && isfinite(x.z); }

/* letter 0: the entity's own. */
static rg_status segment(reader *r, const entity *e, rg_vec3 a, rg_vec3 b, char letter)
{
    if (e->on_sheet)
        return r->told_sheet++ ? RG_OK
            : rg_lines_warn(r->out, e->where, "what is drawn on a layout's paper is left out");
    if (is_hidden(r, e)) return RG_OK;
    int kind;
    char text[16];
    const char own = kind_of(r, e, &kind), assignment = letter && kind < 0 ? letter : own;
    const rg_slice colour = colour_name(e, text), dash = dash_of(e);
    if (kind >= 0) r->out->kinds_used |= UINT64_C(1) << kind;
    rg_status s = rg_lines_trait(r->out, RG_BY_COLOUR, colour.s, colour.n, assignment);
    if (s == RG_OK) s = rg_lines_trait(r->out, RG_BY_LAYER, e->layer.s, e->layer.n, assignment);
    if (s == RG_OK) s = rg_lines_trait(r->out, RG_BY_DASH, dash.s, dash.n, assignment);
    if (assignment == RG_LEFT_OUT) return tell(&r->unwanted, e->where), s;
    a = place_point(r, e, a);
    b = place_point(r, e, b);
    if (!is_finite(a) || !is_finite(b))
        return rg_lines_warn(r->out, e->where, "a line is dropped: a coordinate is not a finite number");
    if (s == RG_OK) s = charge(r, OF_SEGMENT);
    return s == RG_OK ? rg_space_add(&r->space, r->out, a, b, assignment, e->where) : s;
}

static rg_status curved(const reader *r, const entity *e, const char *what, int32_t where)
{
    return rg_fail(RG_EFORMAT, r->why, where,
                   "%.*s: a %s, where paper folds along straight lines only; "
                   "--line %.*s=none leaves out what is on its layer",
                   RG_SHOWN(e->name), what, RG_SHOWN(e->layer));
}

/* The side of a polyline from its last corner. */
static rg_status side(reader *r, entity *e, rg_vec3 x)
{
    if (e->bulge == 0 || e->on_sheet || is_hidden(r, e)) return e->bulge == 0 ? segment(r, e, e->last, x, 0) : RG_OK;
    if (cannot_fold(r, e)) return tell(&r->curves, e->where), RG_OK;
    return curved(r, e, "bulge", e->bulge_line);
}

/* A corner of a polyline is complete; `bulge`: of the side after it. */
static rg_status corner(reader *r, entity *e, rg_vec3 x, double bulge, int32_t bulge_line)
{
    const rg_status s = e->points ? side(r, e, x) : RG_OK;
    if (!e->points++) e->first = x;
    e->last = x;
    e->bulge = bulge;
    e->bulge_line = bulge_line;
    return s;
}

/* What any entity may say. */
static rg_status common(reader *r, entity *e)
{
    long paper;
    rg_status s = RG_OK;
    if (r->in.code == 8) e->layer = r->in.value;
    if (r->in.code == 6) e->dash = r->in.value;
    if (r->in.code == 62) s = whole(r, &e->colour);
    if (r->in.code == 420) s = whole(r, &e->rgb);
    if (r->in.code == 60 && (s = whole(r, &paper)) == RG_OK) e->invisible = paper == 1;
    if (r->in.code == 67 && (s = whole(r, &paper)) == RG_OK) e->on_sheet = paper != 0;
    if (r->in.code == 210) s = number(r, &e->normal.x);
    if (r->in.code == 220) s = number(r, &e->normal.y);
    if (r->in.code == 230) s = number(r, &e->normal.z);
    return s;
}

/* A normal is only one if it points somewhere. */
static void settle_normal(entity *e)
{
    const double length = rg_vec3_length(e->normal);
    if (!(length > 0) || !isfinite(length)) e->normal = (rg_vec3){0, 0, 1};
}

static rg_vec3 point(const entity *e, int i) { return (rg_vec3){e->x[i], e->y[i], e->z[i]}; }

/* The pairs of one entity up to the next one. In a polyline each 10 begins a corner, if `corners` says so. */
static rg_status groups(reader *r, entity *e, int corners)
{
    int open = 0;
    double bulge = 0;
    int32_t bulge_line = 0;
    rg_status s;
    while ((s = next(r)) == RG_OK && r->in.code != 0) {
        if (!corners) s = common(r, e); /* else it is known, with what it inherits */
        if (s == RG_OK && r->in.code == 70) s = whole(r, &e->flags);
        if (s == RG_OK && r->in.code >= 71 && r->in.code <= 74) s = whole(r, &e->corner[r->in.code - 71]);
        if (s == RG_OK && r->in.code == 38) s = number(r, &e->elevation);
        if (r->in.code == 10 && corners) {
            if (s == RG_OK && open) s = corner(r, e, (rg_vec3){e->x[0], e->y[0], e->elevation}, bulge, bulge_line);
            open = 1;
            bulge = 0;
        }
        if (s == RG_OK && r->in.code >= 10 && r->in.code <= 13) s = number(r, &e->x[r->in.code - 10]);
        if (s == RG_OK && r->in.code >= 20 && r->in.code <= 23) s = number(r, &e->y[r->in.code - 20]);
        if (s == RG_OK && r->in.code >= 30 && r->in.code <= 33) s = number(r, &e->z[r->in.code - 30]);
        if (s == RG_OK && r->in.code == 42 && (s = number(r, &bulge)) == RG_OK) bulge_line = r->in.line;
        if (s != RG_OK) return s;
    }
    r->in.pending = 1;
    settle_normal(e);
    if (s == RG_OK && open) s = corner(r, e, (rg_vec3){e->x[0], e->y[0], e->elevation}, bulge, bulge_line);
    if (!corners) e->bulge = bulge, e->bulge_line = bulge_line;
    return s;
}

/* What is of no use here: only whom it belongs to is read. */
static rg_status pass_over(reader *r, entity *e)
{
    rg_status s;
    while ((s = next(r)) == RG_OK && r->in.code != 0)
        if ((s = common(r, e)) != RG_OK) return s;
    r->in.pending = 1;
    return s;
}

static entity begin(const reader *r)
{
    return (entity){.name = r->in.value, .where = r->in.line, .colour = BY_LAYER, .rgb = -1, .layer = {"", 0},
                    .dash = {"", 0},
                    .normal = {0, 0, 1}};
}

static rg_status close_polyline(reader *r, entity *e)
{
    return e->flags & 1 && e->points > 2 ? side(r, e, e->first) : RG_OK;
}

/* Read twice: what holds for all corners may stand behind them. */
static rg_status light_polyline(reader *r, entity *e)
{
    const rg_pairs was = r->in;
    rg_status s = groups(r, e, 0);
    if (s != RG_OK) return s;
    r->in = was;
    inherit(r, e);
    e->bulge = 0;
    s = groups(r, e, 1);
    return s == RG_OK ? close_polyline(r, e) : s;
}

/* Flags of a POLYLINE, and of its VERTEX. */
enum { CLOSED = 1, FITTED = 2, SPLINE = 4, IN_SPACE = 8, GRID = 16, CLOSED_ACROSS = 32, FACETS = 64, OF_FACETS = 128 };

/* The vertices of a mesh. */
typedef struct grid { rg_vec3 *x; int32_t count; size_t room; } grid;

/* Sides of facets: a crease, or border where they are the sheet's, unless layer or colour says mountain, valley or the
 * like. */
static rg_status facet_side(reader *r, const entity *e, rg_vec3 a, rg_vec3 b)
{
    int kind;
    const int32_t before = r->out->count;
    const int plain = kind_of(r, e, &kind) == RG_BORDER && kind < 0;
    rg_status s = segment(r, e, a, b, plain ? RG_UNASSIGNED : 0);
    return s == RG_OK && plain && r->out->count > before ? rg_space_side(&r->space, r->out, before) : s;
}

static rg_status facet(reader *r, const entity *e, const entity *v, const grid *g)
{
    rg_status s = RG_OK;
    int n = 0;
    while (n < 4 && v->corner[n]) n++;
    for (int k = 0; s == RG_OK && n > 1 && k < n; k++) {
        const long from = v->corner[k], to = v->corner[(k + 1) % n], most = g->count; /* the least long has no labs */
        if (from > most || from < -most || to > most || to < -most)
            return rg_fail(RG_EFORMAT, r->why, v->where, "%.*s: a facet of vertex %ld, they end at %d",
                           RG_SHOWN(e->name),
                           from > most || from < -most ? from : to, (int)g->count);
        const long p = labs(from), q = labs(to);
        if (v->corner[k] > 0) s = facet_side(r, e, g->x[p - 1], g->x[q - 1]);
    }
    return s;
}

static rg_status grid_lines(reader *r, const entity *e, const grid *g)
{
    const int32_t m = (int32_t)e->rows, n = (int32_t)e->columns;
    rg_status s = RG_OK;
    if (e->rows < 2 || e->columns < 2 || e->rows > g->count || e->columns > g->count ||
        e->rows * e->columns != g->count)
        return rg_fail(RG_EFORMAT, r->why, e->where, "%.*s: a mesh of %ld by %ld with %d vertices", RG_SHOWN(e->name),
                       e->rows, e->columns,
                       (int)g->count);
    for (int32_t i = 0; i < m; i++)
        for (int32_t j = 0; s == RG_OK && j < n; j++) {
            const int down = i + 1 < m || e->flags & CLOSED, right = j + 1 < n || e->flags & CLOSED_ACROSS;
            if (down) s = facet_side(r, e, g->x[i * n + j], g->x[(i + 1) % m * n + j]);
            if (s == RG_OK && right) s = facet_side(r, e, g->x[i * n + j], g->x[i * n + (j + 1) % n]);
        }
    return s;
}

static rg_status one_vertex(reader *r, entity *e, const entity *v, grid *g)
{
    if (!(e->flags & (GRID | FACETS)))
        return corner(r, e, e->in_space ? point(v, 0) : (rg_vec3){v->x[0], v->y[0], e->elevation}, v->bulge,
                      v->bulge_line);
    if (e->flags & FACETS && v->flags & OF_FACETS && !(v->flags & FACETS)) return facet(r, e, v, g);
    const rg_status s = RG_MEM_GROW(&r->out->mem, g->x, g->room, (size_t)g->count + 1);
    if (s == RG_OK) g->x[g->count++] = point(v, 0);
    return s;
}

/* POLYLINE, its VERTEX entities, SEQEND. */
static rg_status old_polyline(reader *r, entity *e)
{
    grid g = {.x = NULL};
    rg_status s = groups(r, e, 0);
    inherit(r, e);
    e->in_space = (e->flags & (IN_SPACE | GRID | FACETS)) != 0;
    e->elevation = e->z[0];
    e->rows = e->corner[0], e->columns = e->corner[1];
    const int bends = (e->flags & (FITTED | SPLINE)) != 0;
    if (s == RG_OK && bends && !is_hidden(r, e) && !cannot_fold(r, e)) return curved(r, e, "curve", e->where);
    if (bends) tell(&r->curves, e->where);
    e->bulge = 0;
    while (s == RG_OK && (s = next(r)) == RG_OK && rg_slice_is(r->in.value, "VERTEX")) {
        entity v = begin(r);
        s = groups(r, &v, 0);
        if (s == RG_OK && !bends) s = one_vertex(r, e, &v, &g);
    }
    if (s == RG_OK && !rg_slice_is(r->in.value, "SEQEND")) r->in.pending = 1;
    if (s == RG_OK && e->flags & GRID && !bends) s = grid_lines(r, e, &g);
    rg_mem_free(&r->out->mem, g.x);
    return s == RG_OK && !(e->flags & (GRID | FACETS)) && !bends ? close_polyline(r, e) : s;
}

/* 3DFACE: three or four corners, whose sides may each be invisible. */
static rg_status face(reader *r, entity *e)
{
    rg_status s = groups(r, e, 0);
    inherit(r, e);
    e->in_space = 1;
    const rg_vec3 third = point(e, 2), fourth = point(e, 3);
    const int n = third.x == fourth.x && third.y == fourth.y && third.z == fourth.z ? 3 : 4;
    for (int k = 0; s == RG_OK && k < n; k++)
        if (!(e->flags >> k & 1)) s = facet_side(r, e, point(e, k), point(e, (k + 1) % n));
    return s;
}

/* ------------------------------------------------------------------------------------------------ blocks ---- */

/* What an INSERT says of where its block goes. */
typedef struct insert {
    rg_slice name;
    double scale[5]; /* by group code less 41: of x, y, z; then from column to column, from row to row */
    double turn;     /* degrees */
    long count[2];   /* columns, rows */
} insert;

static rg_status entities(reader *r);

static rg_map3 placed(const entity *e, const insert *i, const rg_block *b, long column, long row)
{
    rg_map3 m = rg_map3_after(rg_map3_of_normal(e->normal), rg_map3_shifted(point(e, 0)));
    m = rg_map3_after(m, rg_map3_turned(i->turn));
    m = rg_map3_after(m, rg_map3_shifted((rg_vec3){(double)column * i->scale[3], (double)row * i->scale[4], 0}));
    return rg_map3_after(rg_map3_after(m, rg_map3_scaled(i->scale[0], i->scale[1], i->scale[2])),
                          rg_map3_shifted(rg_vec3_scale(-1, b->base)));
}

/* Reads the block again for every place that it has. */
static rg_status follow(reader *r, const entity *e, const insert *i, const rg_block *b)
{
    const rg_pairs was = r->in;
    const rg_map3 place = r->place;
    const chain here = {e, b, r->inserts};
    rg_status s = RG_OK;
    r->inserts = &here;
    for (long row = 0; s == RG_OK && row < i->count[1]; row++)
        for (long column = 0; s == RG_OK && column < i->count[0]; column++) {
            r->place = rg_map3_after(place, placed(e, i, b, column, row));
            r->in.s = b->s;
            r->in.line = b->line;
            r->in.pending = 0;
            s = entities(r);
        }
    r->in = was;
    r->inserts = here.out;
    r->place = place;
    return s;
}

static rg_status read_insert(reader *r, entity *e)
{
    insert i = {.name = {"", 0}, .scale = {1, 1, 1, 0, 0}, .count = {1, 1}};
    rg_status s;
    while ((s = next(r)) == RG_OK && r->in.code != 0) {
        const long code = r->in.code;
        s = common(r, e);
        if (code == 2) i.name = r->in.value;
        if (s == RG_OK && code == 10) s = number(r, &e->x[0]);
        if (s == RG_OK && code == 20) s = number(r, &e->y[0]);
        if (s == RG_OK && code == 30) s = number(r, &e->z[0]);
        if (s == RG_OK && code >= 41 && code <= 45) s = number(r, &i.scale[code - 41]);
        if (s == RG_OK && code == 50) s = number(r, &i.turn);
        if (s == RG_OK && (code == 70 || code == 71)) s = whole(r, &i.count[code - 70]);
        if (s != RG_OK) return s;
    }
    r->in.pending = 1;
    settle_normal(e);
    if (s != RG_OK || e->on_sheet) return s;
    inherit(r, e);
    const rg_layer *l = e->on;
    /* off alone hides what is on the layer itself */
    if (e->invisible || (l && l->hidden == RG_LAYER_FROZEN)) return is_hidden(r, e), RG_OK;
    for (int k = 0; k < 2; k++)
        if (i.count[k] < 1) i.count[k] = 1; /* 0 is what some programs write for one */
    const rg_block *b = rg_tables_block(&r->tables, i.name);
    if (!b) return rg_lines_warn(r->out, e->where, "INSERT: there is no block \"%.*s\"", RG_SHOWN(i.name));
    int depth = 0;
    for (const chain *c = r->inserts; c; c = c->out, depth++)
        if (c->block == b)
            return rg_fail(RG_EFORMAT, r->why, e->where, "INSERT: the block \"%.*s\" repeats itself", RG_SHOWN(i.name));
    if (depth == MOST_NESTED) return rg_fail(RG_EFORMAT, r->why, e->where, "INSERT: blocks are nested too deep");
    return follow(r, e, &i, b);
}

/* ---------------------------------------------------------------------------------------------- sections ---- */

/* A curve, or a ring: circles mark vertices in many drawings, as in svg.c. */
static rg_status read_curve(reader *r, entity *e, int is_ring)
{
    int kind;
    const rg_status s = pass_over(r, e);
    inherit(r, e);
    if (s != RG_OK || e->on_sheet || is_hidden(r, e)) return s;
    const int harmless = is_ring ? kind_of(r, e, &kind) != RG_BORDER : cannot_fold(r, e);
    if (!harmless) return curved(r, e, "curve", e->where);
    tell(&r->curves, e->where);
    return RG_OK;
}

static rg_status read_entity(reader *r)
{
    static const char *const curves[] = {"CIRCLE", "ELLIPSE", "ARC", "SPLINE", "HELIX"};
    entity e = begin(r);
    for (size_t i = 0; i < sizeof curves / sizeof *curves; i++)
        if (rg_slice_is(e.name, curves[i])) return read_curve(r, &e, i < 2);
    if (rg_slice_is(e.name, "POLYLINE")) return old_polyline(r, &e);
    if (rg_slice_is(e.name, "LWPOLYLINE")) return light_polyline(r, &e);
    if (rg_slice_is(e.name, "3DFACE")) return face(r, &e);
    if (rg_slice_is(e.name, "INSERT")) return read_insert(r, &e);
    if (rg_slice_is(e.name, "LINE")) {
        const rg_status s = groups(r, &e, 0);
        e.in_space = 1; /* the ends of a LINE are those of the drawing, whatever its plane */
        inherit(r, &e);
        return s == RG_OK ? segment(r, &e, point(&e, 0), point(&e, 1), 0) : s;
    }
    const rg_status s = pass_over(r, &e);
    inherit(r, &e);
    if (s != RG_OK || e.on_sheet || rg_slice_is(e.name, "SEQEND") || rg_slice_is(e.name, "ATTRIB") || is_hidden(r, &e))
        return s;
    leave_out(r, e.name, e.where);
    return RG_OK;
}

static rg_status entities(reader *r)
{
    for (rg_status s;;) {
        if ((s = next(r)) != RG_OK) return s;
        if (r->in.code != 0) continue;
        if (rg_slice_is(r->in.value, "ENDSEC") || rg_slice_is(r->in.value, "ENDBLK")) return RG_OK;
        if (rg_slice_is(r->in.value, "EOF")) return r->in.pending = 1, RG_OK;
        if ((s = read_entity(r)) != RG_OK) return s;
    }
}

/* $INSUNITS in metres; 0: none. */
static double metres_of(long unit)
{
    static const double metres[] = {0,     0.0254, 0.3048, 1609.344, 1e-3, 0.01, 1,   1000, 2.54e-8, 2.54e-5, 0.9144,
                                    1e-10, 1e-9,   1e-6,   0.1,      10,   100,  1e9};
    return unit > 0 && unit < (long)(sizeof metres / sizeof *metres) ? metres[unit] : 0;
}

static rg_status header(reader *r)
{
    int is_unit = 0;
    for (rg_status s;;) {
        if ((s = next(r)) != RG_OK) return s;
        if (r->in.code == 0) return r->in.pending = rg_slice_is(r->in.value, "EOF"), RG_OK;
        if (r->in.code == 9) is_unit = rg_slice_is(r->in.value, "$INSUNITS");
        long unit;
        if (is_unit && r->in.code == 70) {
            if ((s = whole(r, &unit)) != RG_OK) return s;
            r->out->metres = metres_of(unit);
        }
    }
}

static rg_status sections(reader *r)
{
    int section = 0, seen = 0;
    for (rg_status s;;) {
        if ((s = next(r)) != RG_OK) return s;
        if (r->in.code == 0 && rg_slice_is(r->in.value, "EOF")) break;
        const int name = section && r->in.code == 2;
        section = r->in.code == 0 && rg_slice_is(r->in.value, "SECTION");
        if (name && rg_slice_is(r->in.value, "HEADER") && (s = header(r)) != RG_OK) return s;
        if (name && rg_slice_is(r->in.value, "TABLES") &&
            (s = rg_tables_read_layers(&r->tables, &r->in, &r->out->mem)) != RG_OK) return s;
        if (name && rg_slice_is(r->in.value, "BLOCKS") &&
            (s = rg_tables_read_blocks(&r->tables, &r->in, &r->out->mem)) != RG_OK) return s;
        if (name && rg_slice_is(r->in.value, "ENTITIES")) {
            seen = 1;
            if ((s = entities(r)) != RG_OK) return s;
        }
    }
    if (!seen) return rg_fail(RG_EFORMAT, r->why, r->in.line, "no section ENTITIES: nothing is drawn");
    return RG_OK;
}

/* ------------------------------------------------------------------------------------------------ the whole ---- */

/* What was left out, each kind told once. */
static rg_status tell_all(reader *r)
{
    rg_status s = RG_OK;
    const struct { const tally *t; const char *format; } kinds[] = {
        {&r->invisible, "invisible: %d left out, the first here"},
        {&r->curves, "circles, and curves of auxiliary lines, are left out: %d, the first here"},
        {&r->unwanted, "left out as --line asks: %d lines, the first here"}};
    for (int32_t i = 0; s == RG_OK && i < r->tables.layers; i++) {
        const rg_layer *l = &r->tables.layer[i];
        if (l->lines)
            s = rg_lines_warn(r->out, l->where, "layer \"%.*s\" is %s: what is on it is left out (%d), the first here",
                              RG_SHOWN(l->name),
                              l->hidden == RG_LAYER_OFF ? "switched off" : "frozen", (int)l->lines);
    }
    for (size_t i = 0; s == RG_OK && i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].t->count) s = rg_lines_warn(r->out, kinds[i].t->where, kinds[i].format, (int)kinds[i].t->count);
    for (int i = 0; s == RG_OK && i < MOST_LEFT_OUT && r->left_out[i].count; i++)
        s = rg_lines_warn(r->out, r->left_out[i].where, "%.*s is not read: %d left out, the first here",
                          RG_SHOWN(r->left_out[i].name), (int)r->left_out[i].count);
    return s;
}

static rg_status nothing_drawn(const reader *r)
{
    const rg_layer *hidden = NULL;
    for (int32_t i = 0; i < r->tables.layers; i++)
        if (r->tables.layer[i].lines && !hidden) hidden = &r->tables.layer[i];
    if (hidden)
        return rg_fail(RG_EFORMAT, r->why, hidden->where,
                       "no lines: the layers that they are on are switched off or frozen, this one is on \"%.*s\"",
                       RG_SHOWN(hidden->name));
    if (r->invisible.count)
        return rg_fail(RG_EFORMAT, r->why, r->invisible.where, "no lines: what is drawn is invisible");
    if (r->left_out[0].count)
        return rg_fail(RG_EFORMAT, r->why, r->left_out[0].where,
                       "no LINE, LWPOLYLINE, POLYLINE or 3DFACE in the drawing, but %.*s, which is not read",
                       RG_SHOWN(r->left_out[0].name));
    return rg_fail(RG_EFORMAT, r->why, r->in.line, "no LINE, LWPOLYLINE, POLYLINE or 3DFACE in the drawing");
}

rg_status rg_dxf_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop,
                      const rg_reading *settings, rg_lines *out, rg_diag *why)
{
    reader r = {.out = out, .why = why, .settings = settings,
                .in = {.s = bytes, .end = (const char *)bytes + size, .why = why, .out = out},
                .place = {rg_mat3_identity(), {0, 0, 0}}};
    rg_lines_init(out, mem);
    out->stop = stop;
    rg_status s = size ? sections(&r) : rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    if (s == RG_OK && out->count == 0) s = nothing_drawn(&r);
    if (s == RG_OK) s = tell_all(&r);
    if (s == RG_OK) s = rg_space_flatten(&r.space, out, settings->merge, why);
    if (s == RG_OK) s = rg_space_border(&r.space, out);
    rg_tables_free(&r.tables, mem);
    rg_space_free(&r.space, mem);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
