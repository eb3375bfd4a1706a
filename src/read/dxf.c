#include "read/dxf.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/status.h"
#include "read/affine.h"
#include "read/colour.h"
#include "read/kinds.h"
#include "read/plane.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OFF = 1, FROZEN }; /* layers that are not seen */
enum { BY_BLOCK = 0, BY_LAYER = 256, WHITE = 7, MOST_LAYERS = 4096 };
/* What INSERT repeats is bounded in sum, counted in pairs, and so is how deep blocks stand in each other. */
enum { MOST_REPEATED = 1 << 22, OF_SEGMENT = 8, MOST_NESTED = 64 };
/* Kinds of entities that are told by name when they are left out. */
enum { MOST_LEFT_OUT = 24 };
/* Coordinates in space lie in a plane if they are off it by less than this part of their size: digits of a text. */
static const double FLATNESS = 1e-9;

typedef struct slice { const char *s; size_t n; } slice;
typedef struct layer { slice name, dash; int colour, hidden; int32_t lines, where; } layer; /* lines: left out, the first at `where` */
typedef struct block { slice name; rg_vec3 base; const char *s; int32_t line, order; } block; /* s: its first entity */

/* What of an entity has been read so far. */
typedef struct entity {
    slice name, layer, dash;
    int32_t where;
    long colour, flags, rgb; /* rgb -1: none */
    long corner[4];          /* of a facet of a mesh: vertices from 1, negative: the side after it is not drawn; 0: none */
    long rows, columns;      /* of a mesh */
    double x[4], y[4], z[4]; /* by group code less 10; of a vertex [0] */
    double elevation, bulge; /* bulge: of the side after the last corner */
    rg_vec3 normal;          /* of its plane; what is drawn in space has none */
    int points, in_space, invisible;
    int on_sheet;            /* of a layout: paper to print on */
    int32_t bulge_line;
    rg_vec3 first, last;
} entity;

typedef struct tally { slice name; int32_t count, where; } tally;

/* The INSERT that are being followed, inmost first. */
typedef struct chain { const entity *insert; const block *block; const struct chain *out; } chain;

/* Where a block goes: x' = A x + t. */
typedef struct place { rg_mat3 A; rg_vec3 t; } place;

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    const rg_reading *settings;
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
    place place;   /* of the block that is read */
    int64_t repeated;
    rg_vec3 *space; /* both ends of every line */
    size_t space_room;
    int32_t *side; /* lines that are sides of facets, and of no kind by name or colour */
    int32_t sides;
    size_t side_room;
    int is_spatial; /* some z is not 0 */
    int told_sheet;
    tally left_out[MOST_LEFT_OUT], invisible, curves, unwanted;
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

static void tell(tally *t, int32_t where)
{
    if (!t->count++) t->where = where;
}

/* Entities that are no lines, by their kind; those beyond the most are counted with the last. */
static void leave_out(reader *r, slice name, int32_t where)
{
    int i = 0;
    while (i < MOST_LEFT_OUT - 1 && r->left_out[i].count && !(r->left_out[i].name.n == name.n && memcmp(r->left_out[i].name.s, name.s, name.n) == 0)) i++;
    if (!r->left_out[i].count) r->left_out[i].name = name;
    tell(&r->left_out[i], where);
}

static layer *layer_of(const reader *r, slice name)
{
    for (int32_t i = r->layer_count - 1; i >= 0; i--)
        if (r->layers[i].name.n == name.n && memcmp(r->layers[i].name.s, name.s, name.n) == 0) return &r->layers[i];
    return NULL;
}

static long layer_colour(const reader *r, slice name)
{
    const layer *l = layer_of(r, name);
    return l ? l->colour : WHITE;
}

/* The name of its pattern of dashes. */
static slice dash_of(const reader *r, const entity *e)
{
    const layer *l = layer_of(r, e->layer);
    if (e->dash.n && !is(e->dash, "BYLAYER") && !is(e->dash, "ByLayer")) return e->dash;
    return l && l->dash.n ? l->dash : (slice){"CONTINUOUS", 10};
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

/* A colour of 24 bits as CSS writes it, else the number in the index. */
static slice colour_name(const reader *r, const entity *e, char text[16])
{
    if (e->rgb >= 0) snprintf(text, 16, "#%06lx", e->rgb & 0xffffffL);
    else snprintf(text, 16, "%d", (int)(e->colour == BY_LAYER ? layer_colour(r, e->layer) : e->colour));
    return (slice){text, strlen(text)};
}

/* What a line of this entity stands for: as the user says, by its layer's name, by its colour. */
static char kind_of(const reader *r, const entity *e, int *kind)
{
    char text[16];
    const slice name[RG_TRAIT_SORTS] = {colour_name(r, e, text), e->layer, dash_of(r, e)};
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
    return rg_colour_index_assignment((int)(e->colour == BY_LAYER ? layer_colour(r, e->layer) : e->colour));
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
    layer *l = layer_of(r, e->layer);
    if (e->invisible) return tell(&r->invisible, e->where), 1;
    if (!l || !l->hidden) return 0;
    if (!l->lines++) l->where = e->where;
    return 1;
}

/* ---------------------------------------------------------------------------------------------- entities ---- */

/* The plane that an entity is drawn in, by its normal: AutoCAD's arbitrary axis algorithm. */
static rg_mat3 plane_of(rg_vec3 n)
{
    static const rg_vec3 y = {0, 1, 0}, z = {0, 0, 1};
    const double nearly = 1.0 / 64; /* part of that algorithm */
    if (n.x == 0 && n.y == 0 && n.z > 0) return rg_mat3_identity();
    n = rg_vec3_scale(1 / rg_vec3_length(n), n);
    rg_vec3 x = rg_vec3_cross(fabs(n.x) < nearly && fabs(n.y) < nearly ? y : z, n);
    x = rg_vec3_scale(1 / rg_vec3_length(x), x);
    return (rg_mat3){{x, rg_vec3_cross(n, x), n}};
}

static rg_vec3 place_point(const reader *r, const entity *e, rg_vec3 x)
{
    if (!e->in_space) x = rg_mat3_mul_vec(plane_of(e->normal), x);
    return rg_vec3_add(rg_mat3_mul_vec(r->place.A, x), r->place.t);
}

/* letter 0: the entity's own. */
static rg_status segment(reader *r, const entity *e, rg_vec3 a, rg_vec3 b, char letter)
{
    if (e->on_sheet)
        return r->told_sheet++ ? RG_OK : rg_lines_warn(r->out, e->where, "what is drawn on a layout's paper is left out");
    if (is_hidden(r, e)) return RG_OK;
    int kind;
    char text[16];
    const char own = kind_of(r, e, &kind), assignment = letter && kind < 0 ? letter : own;
    const slice colour = colour_name(r, e, text), dash = dash_of(r, e);
    if (kind >= 0) r->out->kinds_used |= UINT64_C(1) << kind;
    rg_status s = rg_lines_trait(r->out, RG_BY_COLOUR, colour.s, colour.n, assignment);
    if (s == RG_OK) s = rg_lines_trait(r->out, RG_BY_LAYER, e->layer.s, e->layer.n, assignment);
    if (s == RG_OK) s = rg_lines_trait(r->out, RG_BY_DASH, dash.s, dash.n, assignment);
    if (assignment == RG_LEFT_OUT) return tell(&r->unwanted, e->where), s;
    a = place_point(r, e, a);
    b = place_point(r, e, b);
    if (!isfinite(a.x + a.y + a.z + b.x + b.y + b.z))
        return rg_lines_warn(r->out, e->where, "a line is dropped: a coordinate is not a finite number");
    if (s == RG_OK) s = charge(r, OF_SEGMENT);
    if (s == RG_OK)
        s = rg_mem_grow(&r->out->mem, (void **)&r->space, &r->space_room, 2 * ((size_t)r->out->count + 1), sizeof *r->space);
    if (s == RG_OK) s = rg_lines_add(r->out, (rg_vec2){a.x, a.y}, (rg_vec2){b.x, b.y}, assignment, e->where);
    if (s != RG_OK) return s;
    r->space[2 * r->out->count - 2] = a;
    r->space[2 * r->out->count - 1] = b;
    r->is_spatial |= a.z != 0 || b.z != 0;
    return RG_OK;
}

static rg_status curved(const reader *r, const entity *e, const char *what, int32_t where)
{
    return rg_fail(RG_EFORMAT, r->why, where, "%.*s: a %s, where paper folds along straight lines only; --line %.*s=none leaves out what is on its layer",
                   show(e->name), e->name.s, what, show(e->layer), e->layer.s);
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
    if (r->code == 8) e->layer = r->value;
    if (r->code == 6) e->dash = r->value;
    if (r->code == 62) s = whole(r, &e->colour);
    if (r->code == 420) s = whole(r, &e->rgb);
    if (r->code == 60 && (s = whole(r, &paper)) == RG_OK) e->invisible = paper == 1;
    if (r->code == 67 && (s = whole(r, &paper)) == RG_OK) e->on_sheet = paper != 0;
    if (r->code == 210) s = number(r, &e->normal.x);
    if (r->code == 220) s = number(r, &e->normal.y);
    if (r->code == 230) s = number(r, &e->normal.z);
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
    while ((s = next(r)) == RG_OK && r->code != 0) {
        s = common(r, e);
        if (s == RG_OK && r->code == 70) s = whole(r, &e->flags);
        if (s == RG_OK && r->code >= 71 && r->code <= 74) s = whole(r, &e->corner[r->code - 71]);
        if (s == RG_OK && r->code == 38) s = number(r, &e->elevation);
        if (r->code == 10 && corners) {
            if (s == RG_OK && open) s = corner(r, e, (rg_vec3){e->x[0], e->y[0], e->elevation}, bulge, bulge_line);
            open = 1;
            bulge = 0;
        }
        if (s == RG_OK && r->code >= 10 && r->code <= 13) s = number(r, &e->x[r->code - 10]);
        if (s == RG_OK && r->code >= 20 && r->code <= 23) s = number(r, &e->y[r->code - 20]);
        if (s == RG_OK && r->code >= 30 && r->code <= 33) s = number(r, &e->z[r->code - 30]);
        if (s == RG_OK && r->code == 42 && (s = number(r, &bulge)) == RG_OK) bulge_line = r->line;
        if (s != RG_OK) return s;
    }
    r->pending = 1;
    settle_normal(e);
    if (s == RG_OK && open) s = corner(r, e, (rg_vec3){e->x[0], e->y[0], e->elevation}, bulge, bulge_line);
    if (!corners) e->bulge = bulge, e->bulge_line = bulge_line;
    return s;
}

/* What is of no use here: only whom it belongs to is read. */
static rg_status pass_over(reader *r, entity *e)
{
    rg_status s;
    while ((s = next(r)) == RG_OK && r->code != 0)
        if ((s = common(r, e)) != RG_OK) return s;
    r->pending = 1;
    return s;
}

static entity begin(const reader *r)
{
    return (entity){.name = r->value, .where = r->line, .colour = BY_LAYER, .rgb = -1, .layer = {"", 0}, .dash = {"", 0},
                    .normal = {0, 0, 1}};
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

static rg_status close_polyline(reader *r, entity *e)
{
    return e->flags & 1 && e->points > 2 ? side(r, e, e->first) : RG_OK;
}

/* Read twice: what holds for all corners may stand behind them. */
static rg_status light_polyline(reader *r, entity *e)
{
    const reader was = *r;
    rg_status s = groups(r, e, 0);
    if (s != RG_OK) return s;
    return_to(r, &was);
    inherit(r, e);
    e->bulge = 0;
    s = groups(r, e, 1);
    return s == RG_OK ? close_polyline(r, e) : s;
}

/* Flags of a POLYLINE, and of its VERTEX. */
enum { CLOSED = 1, FITTED = 2, SPLINE = 4, IN_SPACE = 8, GRID = 16, CLOSED_ACROSS = 32, FACETS = 64, OF_FACETS = 128 };

/* The vertices of a mesh. */
typedef struct grid { rg_vec3 *x; int32_t count; size_t room; } grid;

/* Sides of facets: a crease, or border where they are the sheet's, unless layer or colour says mountain, valley or the like. */
static rg_status facet_side(reader *r, const entity *e, rg_vec3 a, rg_vec3 b)
{
    int kind;
    const int32_t before = r->out->count;
    const int plain = kind_of(r, e, &kind) == RG_BORDER && kind < 0;
    rg_status s = segment(r, e, a, b, plain ? RG_UNASSIGNED : 0);
    if (s != RG_OK || !plain || r->out->count == before) return s;
    s = rg_mem_grow(&r->out->mem, (void **)&r->side, &r->side_room, (size_t)r->sides + 1, sizeof *r->side);
    if (s == RG_OK) r->side[r->sides++] = before;
    return s;
}

static rg_status facet(reader *r, const entity *e, const entity *v, const grid *g)
{
    rg_status s = RG_OK;
    int n = 0;
    while (n < 4 && v->corner[n]) n++;
    for (int k = 0; s == RG_OK && n > 1 && k < n; k++) {
        const long from = v->corner[k], to = v->corner[(k + 1) % n], most = g->count; /* the least long has no labs */
        if (from > most || from < -most || to > most || to < -most)
            return rg_fail(RG_EFORMAT, r->why, v->where, "%.*s: a facet of vertex %ld, they end at %d", show(e->name), e->name.s,
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
    if (e->rows < 2 || e->columns < 2 || e->rows > g->count || e->columns > g->count || e->rows * e->columns != g->count)
        return rg_fail(RG_EFORMAT, r->why, e->where, "%.*s: a mesh of %ld by %ld with %d vertices", show(e->name), e->name.s, e->rows, e->columns,
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
    if (!(e->flags & (GRID | FACETS))) return corner(r, e, e->in_space ? point(v, 0) : (rg_vec3){v->x[0], v->y[0], e->elevation}, v->bulge, v->bulge_line);
    if (e->flags & FACETS && v->flags & OF_FACETS && !(v->flags & FACETS)) return facet(r, e, v, g);
    const rg_status s = rg_mem_grow(&r->out->mem, (void **)&g->x, &g->room, (size_t)g->count + 1, sizeof *g->x);
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
    while (s == RG_OK && (s = next(r)) == RG_OK && is(r->value, "VERTEX")) {
        entity v = begin(r);
        s = groups(r, &v, 0);
        if (s == RG_OK && !bends) s = one_vertex(r, e, &v, &g);
    }
    if (s == RG_OK && !is(r->value, "SEQEND")) r->pending = 1;
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
    slice name;
    double scale[5]; /* by group code less 41: of x, y, z; then from column to column, from row to row */
    double turn;     /* degrees */
    long count[2];   /* columns, rows */
} insert;

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

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

/* p after q. */
static place after(place p, place q)
{
    return (place){rg_mat3_mul(p.A, q.A), rg_vec3_add(rg_mat3_mul_vec(p.A, q.t), p.t)};
}

static place shifted(rg_vec3 t) { return (place){rg_mat3_identity(), t}; }
static place scaled(double x, double y, double z) { return (place){{{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}, {0, 0, 0}}; }

static place placed(const entity *e, const insert *i, const block *b, long column, long row)
{
    const rg_affine turn = rg_affine_turn(i->turn);
    place m = after((place){plane_of(e->normal), {0, 0, 0}}, shifted(point(e, 0)));
    m = after(m, (place){{{{turn.a, turn.b, 0}, {turn.c, turn.d, 0}, {0, 0, 1}}}, {0, 0, 0}});
    m = after(m, shifted((rg_vec3){(double)column * i->scale[3], (double)row * i->scale[4], 0}));
    return after(after(m, scaled(i->scale[0], i->scale[1], i->scale[2])), shifted(rg_vec3_scale(-1, b->base)));
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
            r->place = after(was.place, placed(e, i, b, column, row));
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
        if (s == RG_OK && code == 30) s = number(r, &e->z[0]);
        if (s == RG_OK && code >= 41 && code <= 45) s = number(r, &i.scale[code - 41]);
        if (s == RG_OK && code == 50) s = number(r, &i.turn);
        if (s == RG_OK && (code == 70 || code == 71)) s = whole(r, &i.count[code - 70]);
        if (s != RG_OK) return s;
    }
    r->pending = 1;
    settle_normal(e);
    if (s != RG_OK || e->on_sheet) return s;
    inherit(r, e);
    const layer *l = layer_of(r, e->layer);
    if (e->invisible || (l && l->hidden == FROZEN)) return is_hidden(r, e), RG_OK; /* off alone hides what is on the layer itself */
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
        if (open && r->code == 30) s = number(r, &open->base.z);
        if (s != RG_OK) return s;
    }
    if (r->block_count > 0) qsort(r->blocks, (size_t)r->block_count, sizeof *r->blocks, by_block_name);
    return RG_OK;
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
        if (is(e.name, curves[i])) return read_curve(r, &e, i < 2);
    if (is(e.name, "POLYLINE")) return old_polyline(r, &e);
    if (is(e.name, "LWPOLYLINE")) return light_polyline(r, &e);
    if (is(e.name, "3DFACE")) return face(r, &e);
    if (is(e.name, "INSERT")) return read_insert(r, &e);
    if (is(e.name, "LINE")) {
        const rg_status s = groups(r, &e, 0);
        e.in_space = 1; /* the ends of a LINE are those of the drawing, whatever its plane */
        inherit(r, &e);
        return s == RG_OK ? segment(r, &e, point(&e, 0), point(&e, 1), 0) : s;
    }
    const rg_status s = pass_over(r, &e);
    inherit(r, &e);
    if (s != RG_OK || e.on_sheet || is(e.name, "SEQEND") || is(e.name, "ATTRIB") || is_hidden(r, &e)) return s;
    leave_out(r, e.name, e.where);
    return RG_OK;
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
        if (r->code == 0) return r->pending = is(r->value, "EOF"), RG_OK;
        if (r->code == 9) is_unit = is(r->value, "$INSUNITS");
        long unit;
        if (is_unit && r->code == 70) {
            if ((s = whole(r, &unit)) != RG_OK) return s;
            r->out->metres = metres_of(unit);
        }
    }
}

/* The table of layers, for what lines take from it. */
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
            *l = (layer){.name = {"", 0}, .dash = {"", 0}, .colour = WHITE};
        }
        if (l && r->code == 2) l->name = r->value;
        if (l && r->code == 6) l->dash = r->value;
        if (l && r->code == 70) {
            long flags;
            if ((s = whole(r, &flags)) != RG_OK) return s;
            if (flags & 1) l->hidden = FROZEN;
        }
        if (l && r->code == 62) {
            long colour;
            if ((s = whole(r, &colour)) != RG_OK) return s;
            l->colour = colour > -256 && colour < 0 ? (int)-colour : (int)(colour & 255);
            if (colour < 0 && !l->hidden) l->hidden = OFF;
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
        if (name && is(r->value, "HEADER") && (s = header(r)) != RG_OK) return s;
        if (name && is(r->value, "TABLES") && (s = tables(r)) != RG_OK) return s;
        if (name && is(r->value, "BLOCKS") && (s = blocks(r)) != RG_OK) return s;
        if (name && is(r->value, "ENTITIES")) {
            seen = 1;
            if ((s = entities(r)) != RG_OK) return s;
        }
    }
    if (!seen) return rg_fail(RG_EFORMAT, r->why, r->line, "no section ENTITIES: nothing is drawn");
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
    for (int32_t i = 0; s == RG_OK && i < r->layer_count; i++) {
        const layer *l = &r->layers[i];
        if (l->lines)
            s = rg_lines_warn(r->out, l->where, "layer \"%.*s\" is %s: what is on it is left out (%d), the first here", show(l->name), l->name.s,
                              l->hidden == OFF ? "switched off" : "frozen", (int)l->lines);
    }
    for (size_t i = 0; s == RG_OK && i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].t->count) s = rg_lines_warn(r->out, kinds[i].t->where, kinds[i].format, (int)kinds[i].t->count);
    for (int i = 0; s == RG_OK && i < MOST_LEFT_OUT && r->left_out[i].count; i++)
        s = rg_lines_warn(r->out, r->left_out[i].where, "%.*s is not read: %d left out, the first here", show(r->left_out[i].name),
                          r->left_out[i].name.s, (int)r->left_out[i].count);
    return s;
}

typedef struct ends { rg_vec2 low, high; int32_t line; } ends;

static int compare_points(rg_vec2 a, rg_vec2 b) { return a.x != b.x ? (a.x > b.x) - (a.x < b.x) : (a.y > b.y) - (a.y < b.y); }

static int by_ends(const void *a, const void *b)
{
    const ends *p = a, *q = b;
    const int low = compare_points(p->low, q->low), high = low ? low : compare_points(p->high, q->high);
    return high ? high : (p->line > q->line) - (p->line < q->line);
}

/* A side that only one facet has is the sheet's border. */
static rg_status find_border(reader *r)
{
    if (r->sides == 0) return RG_OK;
    ends *e = rg_mem_array(&r->out->mem, (size_t)r->sides, sizeof *e);
    if (!e) return RG_ENOMEM;
    for (int32_t i = 0; i < r->sides; i++) {
        const rg_line *l = &r->out->line[r->side[i]];
        const int turned = compare_points(l->a, l->b) > 0;
        e[i] = (ends){turned ? l->b : l->a, turned ? l->a : l->b, r->side[i]};
    }
    qsort(e, (size_t)r->sides, sizeof *e, by_ends);
    for (int32_t i = 0, end; i < r->sides; i = end) {
        for (end = i + 1; end < r->sides && compare_points(e[i].low, e[end].low) == 0 && compare_points(e[i].high, e[end].high) == 0;) end++;
        if (end == i + 1) r->out->line[e[i].line].assignment = RG_BORDER;
    }
    rg_mem_free(&r->out->mem, e);
    return RG_OK;
}

/* The first line that is not in the plane of those before it. */
static int32_t first_off(const reader *r, double tol)
{
    const rg_vec3 o = r->space[0];
    rg_vec3 along = {0, 0, 0}, normal = along;
    for (int32_t i = 0; i < 2 * r->out->count; i++) {
        const rg_vec3 x = rg_vec3_sub(r->space[i], o);
        if (!(rg_vec3_length(along) > tol)) along = x;
        else if (!(rg_vec3_length(normal) > tol * rg_vec3_length(along))) normal = rg_vec3_cross(along, x);
        else if (fabs(rg_vec3_dot(normal, x)) > tol * rg_vec3_length(normal)) return i / 2;
    }
    return 0;
}

/* Drawings in space lie in a plane, as sheets do before they are folded. */
static rg_status flatten(reader *r)
{
    rg_level p;
    const int32_t n = r->out->count;
    double size = 0;
    if (!r->is_spatial || n == 0) return RG_OK;
    int32_t *pair = rg_mem_array(&r->out->mem, 2 * (size_t)n, sizeof *pair);
    if (!pair) return RG_ENOMEM;
    for (int32_t i = 0; i < 2 * n; i++) {
        pair[i] = i;
        size = fmax(size, rg_vec3_length(rg_vec3_sub(r->space[i], r->space[0])));
    }
    const int flat = rg_plane_find(r->space, 2 * n, pair, n, FLATNESS, r->settings->merge, &p);
    rg_mem_free(&r->out->mem, pair);
    if (!flat) {
        const int32_t i = first_off(r, r->settings->merge * size);
        return rg_fail(RG_EFORMAT, r->why, r->out->line[i].where, "this line leaves the plane of those before it, at z = %.6g: a flat drawing is needed",
                       fabs(r->space[2 * i].z) > fabs(r->space[2 * i + 1].z) ? r->space[2 * i].z : r->space[2 * i + 1].z);
    }
    for (int32_t i = 0; i < n; i++) {
        const rg_vec3 a = r->space[2 * i], b = r->space[2 * i + 1];
        r->out->line[i].a = (rg_vec2){rg_vec3_dot(p.e1, a), rg_vec3_dot(p.e2, a)};
        r->out->line[i].b = (rg_vec2){rg_vec3_dot(p.e1, b), rg_vec3_dot(p.e2, b)};
    }
    return flat == 2 ? RG_OK : rg_lines_warn(r->out, 0, "the drawing is off a plane by up to %.3g, and taken for flat", p.off);
}

static rg_status nothing_drawn(const reader *r)
{
    const layer *hidden = NULL;
    for (int32_t i = 0; i < r->layer_count; i++)
        if (r->layers[i].lines && !hidden) hidden = &r->layers[i];
    if (hidden)
        return rg_fail(RG_EFORMAT, r->why, hidden->where, "no lines: the layers that they are on are switched off or frozen, this one is on \"%.*s\"",
                       show(hidden->name), hidden->name.s);
    if (r->invisible.count) return rg_fail(RG_EFORMAT, r->why, r->invisible.where, "no lines: what is drawn is invisible");
    if (r->left_out[0].count)
        return rg_fail(RG_EFORMAT, r->why, r->left_out[0].where, "no LINE, LWPOLYLINE, POLYLINE or 3DFACE in the drawing, but %.*s, which is not read",
                       show(r->left_out[0].name), r->left_out[0].name.s);
    return rg_fail(RG_EFORMAT, r->why, r->line, "no LINE, LWPOLYLINE, POLYLINE or 3DFACE in the drawing");
}

rg_status rg_dxf_read(const void *bytes, size_t size, const rg_memory *mem, const rg_reading *settings, rg_lines *out, rg_diag *why)
{
    reader r = {.out = out, .why = why, .settings = settings, .s = bytes, .end = (const char *)bytes + size,
                .place = {rg_mat3_identity(), {0, 0, 0}}};
    rg_lines_init(out, mem);
    rg_status s = size ? sections(&r) : rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    if (s == RG_OK && out->count == 0) s = nothing_drawn(&r);
    if (s == RG_OK) s = tell_all(&r);
    if (s == RG_OK) s = flatten(&r);
    if (s == RG_OK) s = find_border(&r);
    rg_mem_free(mem, r.layers);
    rg_mem_free(mem, r.blocks);
    rg_mem_free(mem, r.space);
    rg_mem_free(mem, r.side);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
