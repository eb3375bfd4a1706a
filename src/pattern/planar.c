#include "pattern/planar.h"
#include "base/status.h"
#include "pattern/loose.h"
#include "pattern/overlap.h"
#include "pattern/points.h"

#include <stdlib.h>
#include <string.h>

/* Splitting moves lines by up to the tolerance, which can make new crossings; each round is rarer than the last. */
enum { MOST_ROUNDS = 40 };
/* Warnings of one kind before the rest is counted only. */
enum { MOST_WARNINGS = 20 };
/* Cuts, and pairs of edges in one cell, of one round: more than any drawing has that is not made to cost hours. */
enum { MOST_CUTS = 1 << 24 };
static const int64_t MOST_PAIRS = (int64_t)1 << 34;
/* Cells that one long line crosses, added up over all: what is kept of them takes 1 GB at the most. */
static const int64_t MOST_ENTRIES = (int64_t)1 << 28;
/* Crossings are guessed from so many pairs of lines, of which so many have to cross to mean anything; that few lines
 * are not asked. */
enum { PAIRS_LOOKED_AT = 200000, TO_MEAN_ANYTHING = 10, FEW_LINES = 3000 };
/* Less than one edge of so many is fresh: then most are far from all that are. */
enum { FEW = 100 };
/* Parts of the size and of the tolerance that rounding moves a crossing off its two lines, and more. */
static const double ROUNDING = 1e-13, OF_TOLERANCE = 1e-3;
/* Cells of the search grid, side by side: memory, and what one long line crosses, stay small. */
static const double MOST_SIDE = 1024;

typedef struct cut { int32_t edge, vertex; double t; } cut;

/* Reading the file is the first half of the work; what comes after this is as good as nothing. */
static const double BEGINS = 0.5, ENDS = 0.95;
/* Pairs, edges or vertices that are looked at before it is asked again whether to go on: a millisecond or less. */
enum { WORK = 10000 };

typedef struct splitter {
    rg_memory mem;
    rg_points points;
    rg_edge *E;
    int32_t ne;
    size_t room;
    unsigned char *fresh; /* [ne] not looked at yet: what was, crosses nothing that was */
    int32_t fresh_count;
    /* [vertices] an edge was cut there, or one that was cut ends there, in this round; NULL: all may be */
    unsigned char *touched;
    double exact;         /* a cut that is no farther off its line than this leaves it where it was */
    int32_t looked_at;    /* vertices below this one as well */
    cut *cuts;
    size_t cut_count, cut_room;
    /* Of vertices from `looked_at` on: the two edges that it was found to be the crossing of, which are cut. */
    int32_t (*parent)[2];
    size_t parent_room;
    const char *too_many; /* of what: RG_EFORMAT */
    const rg_reading *ask; /* its progress, whether to go on; NULL: nobody */
    double progress;
    int64_t work;          /* since it was asked last */
    /* search grid: edges of cell c are in[start[c]] ... in[start[c + 1] - 1] */
    rg_vec2 origin;
    double cell, per_cell; /* a cell's side, and one over it */
    int32_t side[2];
    int32_t *start, *in;
    unsigned char *wanted; /* [cells] something is to be looked at there */
} splitter;

/* So much was done. RG_ECANCELLED: it is to end. */
static inline rg_status done(splitter *s, int64_t work)
{
    s->work += work;
    if (s->work < WORK) return RG_OK;
    s->work = 0;
    return s->ask && s->ask->progress && s->ask->progress(s->ask->progress_ctx, s->progress) ? RG_ECANCELLED : RG_OK;
}

static inline int clamp(double i, int32_t n) { return i < 0 ? 0 : i >= n ? n - 1 : (int)i; }
static inline int32_t column(const splitter *s, double x) { return clamp((x - s->origin.x) * s->per_cell, s->side[0]); }
static inline int32_t row(const splitter *s, double y) { return clamp((y - s->origin.y) * s->per_cell, s->side[1]); }
static inline int32_t cell_of(const splitter *s, rg_vec2 x) { return column(s, x.x) * s->side[1] + row(s, x.y); }

typedef enum visit { MARK, COUNT, FILL } visit;

/* At an edge's cell: marks it as wanted; or where it is, counts the edge there, or puts it in. Returns whether it
 * is. */
static inline int visit_cell(splitter *s, int32_t e, int32_t c, visit what)
{
    if (what == MARK) s->wanted[c] = 1;
    else if (s->wanted[c] && what == FILL) s->in[s->start[c + 1]++] = e;
    else s->start[c + 1] += s->wanted[c];
    return s->wanted[c];
}

/* Cells that near an edge are its as well: more than rounding moves what is computed below. */
static inline double padding(const splitter *s) { return 2 * s->points.tol + 1e-9 * s->cell; }

/* Visits the cells within the tolerance of an edge. Returns whether any of them is wanted. */
static int register_edge(splitter *s, int32_t e, visit what)
{
    int any = 0;
    rg_vec2 a = s->points.X[s->E[e].v[0]], b = s->points.X[s->E[e].v[1]];
    if (a.x > b.x) {
        rg_vec2 t = a;
        a = b;
        b = t;
    }
    const double pad = padding(s);
    const int32_t first = column(s, a.x - pad), last = column(s, b.x + pad);
    const int32_t bottom = row(s, (a.y < b.y ? a.y : b.y) - pad), top = row(s, (a.y < b.y ? b.y : a.y) + pad);
    if (first == last || bottom == top) { /* as most are that are short */
        for (int32_t i = first; i <= last; i++)
            for (int32_t j = bottom; j <= top; j++) any |= visit_cell(s, e, i * s->side[1] + j, what);
        return any;
    }
    for (int32_t i = first; i <= last; i++) {
        double y0 = a.y, y1 = b.y;
        if (b.x - a.x > pad) { /* the part of it in this column */
            const double left = fmax(a.x, s->origin.x + i * s->cell - pad);
            const double right = fmin(b.x, s->origin.x + (i + 1) * s->cell + pad), slope = (b.y - a.y) / (b.x - a.x);
            y0 = a.y + slope * (left - a.x);
            y1 = a.y + slope * (right - a.x);
        }
        const int32_t low = row(s, fmin(y0, y1) - pad), high = row(s, fmax(y0, y1) + pad);
        for (int32_t j = low; j <= high; j++) any |= visit_cell(s, e, i * s->side[1] + j, what);
    }
    return any;
}

/* Of an edge from one cell to the same or the next one, all cells that it is registered at are within so many rows and
 * columns of the first. */
enum { REACH = 2 };
typedef struct place { int16_t column, row; } place; /* MOST_SIDE is less */

/* Whether a cell is within REACH of one that is wanted. *near: out, [cells]. */
static rg_status widen(const splitter *s, unsigned char **near)
{
    const int32_t rows = s->side[1], columns = s->side[0];
    const size_t cells = (size_t)columns * (size_t)rows;
    unsigned char *along = rg_mem_array(&s->mem, cells, 1); /* by rows first, then by columns */
    *near = rg_mem_array(&s->mem, cells, 1);
    const rg_status status = along && *near ? RG_OK : RG_ENOMEM;
    for (int32_t i = 0; status == RG_OK && i < columns; i++)
        for (int32_t j = 0; j < rows; j++)
            for (int32_t k = j - REACH; s->wanted[i * rows + j] && k <= j + REACH; k++)
                if (k >= 0 && k < rows) along[i * rows + k] = 1;
    for (int32_t i = 0; status == RG_OK && i < columns; i++)
        for (int32_t k = i - REACH; k <= i + REACH; k++)
            for (int32_t j = 0; k >= 0 && k < columns && j < rows; j++) (*near)[i * rows + j] |= along[k * rows + j];
    rg_mem_free(&s->mem, along);
    return status;
}

/* The edges in cells that are wanted, in order: list[*n]. Where few are, most edges are told to be elsewhere by the
 * cells of their ends. */
static rg_status count_near(splitter *s, int32_t *list, int32_t *n)
{
    unsigned char *near = NULL;
    const int32_t nv = s->points.count, rows = s->side[1];
    const int few = s->fresh_count < s->ne / FEW && padding(s) < s->cell;
    place *at = few ? rg_mem_array(&s->mem, (size_t)nv, sizeof *at) : NULL;
    rg_status status = !few ? RG_OK : !at ? RG_ENOMEM : widen(s, &near);
    for (int32_t v = 0; status == RG_OK && few && v < nv; v++) {
        const rg_vec2 x = s->points.X[v];
        at[v] = (place){(int16_t)column(s, x.x), (int16_t)row(s, x.y)};
    }
    for (int32_t e = 0; status == RG_OK && e < s->ne; e++) {
        if (few) {
            const place p = at[s->E[e].v[0]], q = at[s->E[e].v[1]];
            if (abs(p.column - q.column) <= 1 && abs(p.row - q.row) <= 1 && !near[p.column * rows + p.row]) continue;
        }
        if (register_edge(s, e, COUNT)) list[(*n)++] = e;
        status = done(s, 1);
    }
    RG_MEM_FREE(&s->mem, at, near);
    return status;
}

/* The edges in each cell that has to be looked at: where an edge or a vertex is new. */
static rg_status build_grid(splitter *s, rg_vec2 low, rg_vec2 high)
{
    const double w = high.x - low.x, h = high.y - low.y, size = fmax(w, h);
    const double side = fmin(ceil(sqrt((double)s->ne)) + 1, MOST_SIDE);
    s->origin = low;
    s->cell = size / side;
    s->per_cell = 1 / s->cell;
    s->side[0] = clamp(ceil(w / s->cell), (int32_t)side) + 1;
    s->side[1] = clamp(ceil(h / s->cell), (int32_t)side) + 1;
    const size_t cells = (size_t)s->side[0] * (size_t)s->side[1];
    RG_MEM_FREE(&s->mem, s->start, s->in, s->wanted);
    s->in = NULL;
    if (RG_MEM_ARRAYS(&s->mem, RG_ARRAY(s->start, cells + 2), RG_ARRAY(s->wanted, cells)) != RG_OK) return RG_ENOMEM;
    for (int32_t e = 0; e < s->ne; e++)
        if (s->fresh[e]) register_edge(s, e, MARK);
    for (int32_t v = s->looked_at; v < s->points.count; v++) s->wanted[cell_of(s, s->points.X[v])] = 1;
    /* counted one to the right, so that the sums are the starts; filling moves each start to its end, so they are put
     * one further to the right before */
    int32_t near = 0;
    int32_t *list = rg_mem_array(&s->mem, (size_t)s->ne, sizeof *list); /* of what is in any of these cells */
    if (!list) return RG_ENOMEM;
    const rg_status counted = count_near(s, list, &near);
    if (counted != RG_OK) {
        rg_mem_free(&s->mem, list);
        return counted;
    }
    int64_t total = 0;
    for (size_t c = 1; c < cells + 2 && total <= MOST_ENTRIES; c++) s->start[c] = (int32_t)(total += s->start[c]);
    if (total > MOST_ENTRIES) s->too_many = "lines that cross the whole drawing";
    else s->in = rg_mem_array(&s->mem, (size_t)total, sizeof *s->in);
    for (size_t c = cells + 1; s->in && c > 0; c--) s->start[c] = s->start[c - 1];
    rg_status status = s->in ? RG_OK : s->too_many ? RG_EFORMAT : RG_ENOMEM;
    for (int32_t k = 0; status == RG_OK && k < near; k++) {
        register_edge(s, list[k], FILL);
        status = done(s, 1 + total / (near + 1)); /* cells that an edge crosses, more or less */
    }
    rg_mem_free(&s->mem, list);
    return status;
}

static rg_status add_cut(splitter *s, int32_t e, int32_t v)
{
    if (s->E[e].v[0] == v || s->E[e].v[1] == v) return RG_OK;
    if (s->cut_count == MOST_CUTS) return s->too_many = "crossings", RG_EFORMAT;
    rg_status status = RG_MEM_GROW(&s->mem, s->cuts, s->cut_room, s->cut_count + 1);
    if (status != RG_OK) return status;
    rg_vec2 a = s->points.X[s->E[e].v[0]], d = rg_vec2_sub(s->points.X[s->E[e].v[1]], a);
    double t = rg_vec2_dot(rg_vec2_sub(s->points.X[v], a), d);
    s->cuts[s->cut_count++] = (cut){e, v, t};
    return RG_OK;
}

/* Where two edges cross inside both, if they do so in cell c. */
static rg_status cross(splitter *s, int32_t e, int32_t f, int32_t c)
{
    const int32_t *p = s->E[e].v, *q = s->E[f].v;
    const rg_vec2 *X = s->points.X, a = X[p[0]], b = X[p[1]], u = X[q[0]], v = X[q[1]];
    const double au = rg_vec2_turn(u, v, a), bu = rg_vec2_turn(u, v, b);
    const double ua = rg_vec2_turn(a, b, u), va = rg_vec2_turn(a, b, v);
    if (!((au < 0) != (bu < 0) && (ua < 0) != (va < 0))) return RG_OK;
    const double t = au / (au - bu);
    if (!(t >= 0 && t <= 1)) return RG_OK;
    const rg_vec2 x = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    if (cell_of(s, x) != c) return RG_OK;
    const int32_t before = s->points.count;
    int32_t vertex;
    rg_status status = rg_points_add(&s->points, x, &vertex);
    if (status == RG_OK && s->points.count > before) {
        const size_t n = (size_t)(vertex - s->looked_at);
        status = RG_MEM_GROW(&s->mem, s->parent, s->parent_room, n + 1);
        if (status == RG_OK) s->parent[n][0] = e, s->parent[n][1] = f;
    }
    if (status == RG_OK) status = add_cut(s, e, vertex);
    if (status == RG_OK) status = add_cut(s, f, vertex);
    return status;
}

static int beside(double a, double b, double u, double v)
{
    return (a < b ? b : a) < (u < v ? u : v) || (u < v ? v : u) < (a < b ? a : b);
}

/* Two edges that are not worth a closer look: they share a vertex, or their boxes are apart. */
static int apart(const splitter *s, const int32_t *p, const int32_t *q)
{
    if (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]) return 1;
    const rg_vec2 a = s->points.X[p[0]], b = s->points.X[p[1]], u = s->points.X[q[0]], v = s->points.X[q[1]];
    return beside(a.x, b.x, u.x, v.x) || beside(a.y, b.y, u.y, v.y);
}

static rg_status find_crossings(splitter *s)
{
    const int32_t cells = s->side[0] * s->side[1];
    int64_t pairs = 0;
    for (int32_t c = 0; c < cells; c++) {
        const int64_t n = s->start[c + 1] - s->start[c];
        pairs += n * (n - 1) / 2;
    }
    if (pairs > MOST_PAIRS) return s->too_many = "lines in one place", RG_EFORMAT;
    const double from = s->progress, left = (ENDS - from) / 2; /* later rounds share the rest */
    const double all = (double)(pairs + s->start[cells] + 1);
    int64_t seen = 0;
    for (int32_t c = 0; c < cells; c++)
        for (int32_t i = s->start[c]; i < s->start[c + 1]; i++) {
            seen += s->start[c + 1] - i;
            s->progress = from + left * fmin(1, (double)seen / all);
            const rg_status asked = done(s, s->start[c + 1] - i);
            if (asked != RG_OK) return asked;
            const int32_t e = s->in[i], is_fresh = s->fresh[e];
            for (int32_t j = i + 1; j < s->start[c + 1]; j++) {
                const int32_t f = s->in[j];
                if (!(is_fresh || s->fresh[f]) || apart(s, s->E[e].v, s->E[f].v)) continue;
                rg_status status = cross(s, e, f, c);
                if (status != RG_OK) return status;
            }
        }
    return RG_OK;
}

/* Is x within the tolerance of an edge's inside, so that it is to be cut there? */
static int is_junction(const splitter *s, const rg_edge *e, rg_vec2 x)
{
    const rg_vec2 a = s->points.X[e->v[0]], d = rg_vec2_sub(s->points.X[e->v[1]], a), r = rg_vec2_sub(x, a);
    const double along = rg_vec2_dot(r, d), from = rg_vec2_dot(r, r), off = rg_vec2_cross(d, r), tol = s->points.tol;
    if (!(along > 0) || off * off > tol * tol * rg_vec2_dot(d, d) * (1 + 1e-9)) return 0; /* most are */
    const double length = rg_vec2_length(d);
    if (!(along < length * length) || !(fabs(off) <= tol * length)) return 0;
    /* Both parts must be shorter than the whole: a vertex beside an end would be cut in again and again. */
    return from < length * length && from < 2 * along;
}

/* Was the vertex found as the crossing of this edge, which is cut there already? */
static int is_parent(const splitter *s, int32_t v, int32_t e, int32_t known)
{
    return v >= known && (s->parent[v - s->looked_at][0] == e || s->parent[v - s->looked_at][1] == e);
}

/* Vertices on edges. `known`: those from here on are crossings of this round. */
static rg_status find_junctions(splitter *s, int32_t known)
{
    for (int32_t v = 0; v < s->points.count; v++) {
        const rg_vec2 x = s->points.X[v];
        const int32_t c = cell_of(s, x);
        for (int32_t i = s->start[c]; i < s->start[c + 1]; i++) {
            const int32_t e = s->in[i];
            const int is_new = v >= s->looked_at || s->fresh[e];
            if (!is_new || is_parent(s, v, e, known) || !is_junction(s, &s->E[e], x)) continue;
            rg_status status = add_cut(s, e, v);
            if (status != RG_OK) return status;
        }
        const rg_status asked = done(s, 1 + s->start[c + 1] - s->start[c]);
        if (asked != RG_OK) return asked;
    }
    return RG_OK;
}

static int by_place(const void *a, const void *b)
{
    const cut *p = a, *q = b;
    if (p->t != q->t) return p->t < q->t ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

/* Edge by edge, along each. *start: out, [ne + 1], where those of an edge begin. */
static rg_status sort_cuts(splitter *s, int32_t **start)
{
    cut *sorted = rg_mem_array(&s->mem, s->cut_count, sizeof *sorted);
    int32_t *at = *start = rg_mem_array(&s->mem, (size_t)s->ne + 2, sizeof *at);
    if (!sorted || !at) {
        rg_mem_free(&s->mem, sorted);
        return RG_ENOMEM;
    }
    for (size_t i = 0; i < s->cut_count; i++) at[s->cuts[i].edge + 2]++;
    for (int32_t e = 0; e < s->ne; e++) at[e + 2] += at[e + 1];
    for (size_t i = 0; i < s->cut_count; i++) sorted[at[s->cuts[i].edge + 1]++] = s->cuts[i];
    for (int32_t e = 0; e < s->ne; e++)
        if (at[e + 1] > at[e] + 1) qsort(sorted + at[e], (size_t)(at[e + 1] - at[e]), sizeof *sorted, by_place);
    rg_mem_free(&s->mem, s->cuts);
    s->cuts = sorted;
    s->cut_room = s->cut_count;
    return RG_OK;
}

static double square_of(const splitter *s, int32_t u, int32_t v)
{
    const rg_vec2 d = rg_vec2_sub(s->points.X[u], s->points.X[v]);
    return rg_vec2_dot(d, d);
}

/* How many of n cuts of an edge to make now: all, or the first alone where vertices lie so near both sides of a short
 * edge that a part between two of them is longer than the whole. Parts get shorter and shorter then, and the rounds
 * end. */
static size_t cuts_to_make(const splitter *s, const rg_edge *e, const cut *cuts, size_t n)
{
    const double whole = square_of(s, e->v[0], e->v[1]);
    for (size_t i = 1; i < n; i++)
        if (!(square_of(s, cuts[i - 1].vertex, cuts[i].vertex) < whole)) return 1;
    return n;
}

/* Whether a cut leaves the edge where it was. A piece between two such ones crosses nothing that the edge does not
 * cross, which has been seen to: it need not be looked at again. Most crossings are so; those that fell to a vertex
 * nearby are not. */
static int stays(const splitter *s, const rg_edge *e, int32_t vertex)
{
    const rg_vec2 a = s->points.X[e->v[0]], d = rg_vec2_sub(s->points.X[e->v[1]], a);
    const double off = rg_vec2_cross(d, rg_vec2_sub(s->points.X[vertex], a));
    return off * off < s->exact * s->exact * rg_vec2_dot(d, d);
}

/* What is cut, and bent by it, is fresh then, the rest is not. */
static rg_status apply_cuts(splitter *s)
{
    rg_edge *E = NULL;
    size_t room = 0;
    int32_t n = 0, *start = NULL, fresh_count = 0;
    unsigned char *fresh, *touched;
    rg_status status = RG_MEM_ARRAYS(&s->mem, RG_ARRAY(fresh, (size_t)s->ne + s->cut_count),
                                     RG_ARRAY(touched, (size_t)s->points.count));
    if (status == RG_OK) status = sort_cuts(s, &start);
    if (status == RG_OK) status = RG_MEM_GROW(&s->mem, E, room, (size_t)s->ne + s->cut_count);
    if (status != RG_OK) {
        RG_MEM_FREE(&s->mem, fresh, touched, start);
        return status;
    }
    for (int32_t e = 0; e < s->ne; e++) {
        rg_edge rest = s->E[e];
        const int32_t count = start[e + 1] - start[e];
        const cut *cuts = s->cuts + start[e];
        const int32_t made = (int32_t)cuts_to_make(s, &rest, cuts, (size_t)count);
        if (count > 0) touched[rest.v[0]] = touched[rest.v[1]] = 1;
        for (int32_t i = 0; i < made; i++) touched[cuts[i].vertex] = 1;
        int bent = made < count; /* from the last cut on; what is still to be cut has to be looked at */
        for (int32_t i = 0; i < made; i++) {
            if (cuts[i].vertex == rest.v[0] || cuts[i].vertex == rest.v[1]) continue;
            const int bends = made < count || !stays(s, &s->E[e], cuts[i].vertex);
            fresh_count += fresh[n] = (unsigned char)(bent || bends);
            bent = bends;
            E[n] = rest;
            E[n++].v[1] = rest.v[0] = cuts[i].vertex;
        }
        fresh_count += fresh[n] = (unsigned char)bent;
        E[n++] = rest;
    }
    RG_MEM_FREE(&s->mem, start, s->E, s->fresh, s->touched);
    s->E = E;
    s->fresh = fresh;
    s->touched = touched;
    s->fresh_count = fresh_count;
    s->room = room;
    s->ne = n;
    return RG_OK;
}

/* ------------------------------------------------------------------------------------------------ doubles */

typedef struct keyed { int32_t high, e; int rank; } keyed; /* of the edges of one lower vertex */

static int by_end(const void *a, const void *b)
{
    const keyed *p = a, *q = b;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    if (p->rank != q->rank) return p->rank < q->rank ? -1 : 1;
    return p->e < q->e ? -1 : p->e > q->e;
}

static int32_t lower(const rg_edge *e) { return e->v[0] < e->v[1] ? e->v[0] : e->v[1]; }

/* Of two edges with the same ends, one is new. */
static int may_be_double(const splitter *s, const rg_edge *e)
{
    return !s->touched || (s->touched[e->v[0]] && s->touched[e->v[1]]);
}

/* Those that may be doubles by their lower vertex, then by the other one. start[nv + 2]: out, where those of a vertex
 * begin. */
static void sort_edges(const splitter *s, int32_t *start, keyed *key)
{
    const int32_t nv = s->points.count;
    for (int32_t e = 0; e < s->ne; e++)
        if (may_be_double(s, &s->E[e])) start[lower(&s->E[e]) + 2]++;
    for (int32_t v = 0; v < nv; v++) start[v + 2] += start[v + 1];
    for (int32_t e = 0; e < s->ne; e++) {
        const rg_edge *edge = &s->E[e];
        if (!may_be_double(s, edge)) continue;
        const int32_t low = lower(edge);
        key[start[low + 1]++] = (keyed){edge->v[0] + edge->v[1] - low, e, rg_overlap_rank(edge->assignment)};
    }
    for (int32_t v = 0; v < nv; v++)
        if (start[v + 1] > start[v] + 1) qsort(key + start[v], (size_t)(start[v + 1] - start[v]), sizeof *key, by_end);
}

/* Of edges with the same ends the first of the highest rank stays: border, then mountain and valley, then the rest. */
static rg_status merge_doubles(splitter *s, rg_lines *lines)
{
    const int32_t nv = s->points.count;
    keyed *key;
    int32_t *start;
    unsigned char *drop;
    rg_status status = RG_MEM_ARRAYS(&s->mem, RG_ARRAY(key, (size_t)s->ne), RG_ARRAY(start, (size_t)nv + 2),
                                     RG_ARRAY(drop, (size_t)s->ne));
    if (status == RG_OK) sort_edges(s, start, key);
    int told = 0;
    for (int32_t v = 0; status == RG_OK && v < nv; v++)
        for (int32_t first = start[v], i = first + 1; status == RG_OK && i < start[v + 1]; i++) {
            if (key[i].high != key[first].high) {
                first = i;
                continue;
            }
            drop[key[i].e] = 1;
            status = rg_overlap_warn(lines, s->points.X, &s->E[key[first].e], &s->E[key[i].e], &told);
        }
    if (status == RG_OK) status = rg_overlap_warn_more(lines, told);
    if (status == RG_OK) {
        int32_t n = 0;
        for (int32_t e = 0; e < s->ne; e++)
            if (!drop[e]) s->fresh[n] = s->fresh[e], s->E[n++] = s->E[e];
        s->ne = n;
    }
    RG_MEM_FREE(&s->mem, key, start, drop);
    return status;
}

/* -------------------------------------------------------------------------------------------------- lines */

static double wish(const rg_line *l)
{
    if (isfinite(l->target)) return l->target;
    if (isinf(l->target)) return NAN; /* free */
    return l->assignment == RG_MOUNTAIN ? -RG_PI : l->assignment == RG_VALLEY ? RG_PI : NAN;
}

/* s NULL: every line is. */
static int is_used(const rg_line *l, const rg_reading *s)
{
    return !s || (l->assignment != RG_CUT && (l->assignment != RG_FLAT || s->aux_creases));
}

/* Warns of a line without length; from the MOST_WARNINGS'th on they are only counted. */
static rg_status without_length(rg_lines *lines, int32_t where, rg_vec2 at, int *told)
{
    if (++*told > MOST_WARNINGS) return RG_OK;
    at = rg_lines_own(lines, at, 0);
    return rg_lines_warn(lines, where, "a line without length at (%.6g, %.6g) is left out", at.x, at.y);
}

/* The line's edge, unless it has no length; a vertex that was made for it goes with it. */
static rg_status add_line(splitter *s, rg_lines *lines, const rg_line *l, char assignment, int *told)
{
    const int32_t count = s->points.count;
    rg_edge e = {{0, 0}, assignment, wish(l), l->where, (int32_t)(l - lines->line)};
    rg_status status = rg_points_add(&s->points, l->a, &e.v[0]);
    if (status == RG_OK) status = rg_points_add(&s->points, l->b, &e.v[1]);
    if (status == RG_OK && e.v[0] == e.v[1]) {
        if (s->points.count > count) rg_points_forget(&s->points);
        return without_length(lines, l->where, l->a, told);
    }
    if (status == RG_OK) status = RG_MEM_GROW(&s->mem, s->E, s->room, (size_t)s->ne + 1);
    if (status == RG_OK) s->E[s->ne++] = e;
    return status;
}

/* Ends that came to lie within the tolerance of each other when vertices moved to the mean of theirs. */
static rg_status settle(splitter *s, rg_lines *lines, int *told)
{
    int32_t *now = rg_mem_array(&s->mem, (size_t)s->points.count, sizeof *now), n = 0;
    rg_status status = now ? rg_points_settle(&s->points, now) : RG_ENOMEM;
    for (int32_t e = 0; status == RG_OK && e < s->ne; e++) {
        rg_edge edge = s->E[e];
        for (int i = 0; i < 2; i++) edge.v[i] = now[edge.v[i]];
        if (edge.v[0] != edge.v[1]) s->E[n++] = edge;
        else status = without_length(lines, edge.where, s->points.X[edge.v[0]], told);
    }
    s->ne = n;
    rg_mem_free(&s->mem, now);
    return status;
}

static rg_status add_lines(splitter *s, rg_lines *lines, const rg_reading *settings)
{
    int32_t cuts = 0, first_cut = 0;
    int told = 0;
    rg_status status = RG_OK;
    for (int32_t i = 0; status == RG_OK && i < lines->count; i++) {
        const rg_line *l = &lines->line[i];
        const char assignment = settings && l->assignment == RG_FLAT ? RG_UNASSIGNED : l->assignment;
        if (settings && l->assignment == RG_CUT && !cuts++) first_cut = l->where;
        if (is_used(l, settings)) status = add_line(s, lines, l, assignment, &told);
        if (status == RG_OK) status = done(s, 1);
    }
    if (status == RG_OK) status = settle(s, lines, &told);
    if (status == RG_OK && told > MOST_WARNINGS)
        status = rg_lines_warn(lines, 0, "%d more lines without length are left out", told - MOST_WARNINGS);
    if (status == RG_OK && cuts)
        status = rg_lines_warn(lines, first_cut, "%d cuts of the folded model are left out", (int)cuts);
    return status;
}

/* A pair of lines, as the numbers of a simple sequence have it: the same every time. */
static int32_t pick(uint64_t *state, int32_t n)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (int32_t)((*state >> 33) % (uint64_t)n);
}

/* Is it to be feared, before anything is kept of them, that there are more crossings than may be? Guessed from pairs of
 * lines. */
static int crosses_too_often(const splitter *s)
{
    uint64_t state = 1;
    int32_t crossing = 0;
    if (s->ne <= FEW_LINES) return 0;
    for (int i = 0; i < PAIRS_LOOKED_AT; i++) {
        const int32_t *p = s->E[pick(&state, s->ne)].v, *q = s->E[pick(&state, s->ne)].v;
        const rg_vec2 *X = s->points.X, a = X[p[0]], b = X[p[1]], u = X[q[0]], v = X[q[1]];
        crossing += rg_vec2_turn(u, v, a) * rg_vec2_turn(u, v, b) < 0 &&
                    rg_vec2_turn(a, b, u) * rg_vec2_turn(a, b, v) < 0;
    }
    /* Two a crossing, which is of n^2 / 2 pairs. Guessed at twice what may be, it is not by chance. */
    const double cuts = (double)s->ne * (double)s->ne * crossing / PAIRS_LOOKED_AT;
    return crossing >= TO_MEAN_ANYTHING && cuts > 2.0 * MOST_CUTS;
}

static rg_status look(splitter *s, rg_vec2 low, rg_vec2 high)
{
    s->cut_count = 0;
    rg_status status = build_grid(s, low, high);
    const int32_t known = s->points.count;
    if (status == RG_OK) status = find_crossings(s);
    if (status == RG_OK) status = find_junctions(s, known);
    s->looked_at = s->points.count;
    return status;
}

static rg_status planarise(splitter *s, rg_lines *lines, rg_vec2 low, rg_vec2 high, rg_diag *why)
{
    const double size = fmax(high.x - low.x, high.y - low.y);
    rg_status status = rg_overlap_resolve(lines, s->points.X, s->points.tol, size, &s->E, &s->ne, &s->room);
    if (status == RG_OK) status = RG_MEM_ARRAYS(&s->mem, RG_ARRAY(s->fresh, (size_t)s->ne));
    if (status == RG_OK) memset(s->fresh, 1, (size_t)s->ne), s->fresh_count = s->ne;
    if (status == RG_OK) status = merge_doubles(s, lines);
    if (status == RG_OK && crosses_too_often(s)) s->too_many = "crossings", status = RG_EFORMAT;
    for (int round = 0; status == RG_OK && s->ne > 0; round++) {
        if (round == MOST_ROUNDS)
            return rg_fail(RG_EFORMAT, why, 0,
                           "lines lie too close together to tell crossings apart: try another --merge");
        if (s->fresh_count == 0) break;
        status = look(s, low, high);
        if (status != RG_OK || !s->cut_count) break;
        status = apply_cuts(s);
        if (status == RG_OK) status = merge_doubles(s, lines);
    }
    if (s->too_many) return rg_fail(RG_EFORMAT, why, 0, "too many %s: this is no crease pattern", s->too_many);
    return status;
}

/* settings NULL: of every line, loose ends too. */
static rg_status graph(rg_lines *lines, const rg_reading *settings, double merge, const rg_reading *ask, rg_graph *g,
                       rg_diag *why)
{
    memset(g, 0, sizeof *g);
    g->mem = lines->mem;
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t i = 0; i < lines->count; i++)
        for (int end = 0; end < 2 && is_used(&lines->line[i], settings); end++) {
            rg_vec2 x = end ? lines->line[i].b : lines->line[i].a;
            low = (rg_vec2){fmin(low.x, x.x), fmin(low.y, x.y)};
            high = (rg_vec2){fmax(high.x, x.x), fmax(high.y, x.y)};
        }
    g->size = high.x >= low.x ? fmax(high.x - low.x, high.y - low.y) : 0;
    if (!isfinite(g->size * g->size))
        return rg_fail(RG_EFORMAT, why, 0, "the coordinates are too large to compute with");
    if (!(g->size > 0)) return RG_OK;
    if (g->size < 1e-100)
        return rg_fail(RG_EFORMAT, why, 0, "the whole drawing is smaller than 1e-100: too small to compute with");

    splitter s = {.mem = g->mem, .ask = ask, .progress = BEGINS};
    rg_status status = rg_points_init(&s.points, &s.mem, low, g->size, merge * g->size);
    s.exact = fmin(ROUNDING * g->size, OF_TOLERANCE * s.points.tol);
    if (status == RG_OK) status = add_lines(&s, lines, settings);
    if (status == RG_OK) status = planarise(&s, lines, low, high, why);
    if (status == RG_OK) {
        g->X = s.points.X;
        g->nv = s.points.count;
        g->E = s.E;
        g->ne = s.ne;
        g->merged_max = s.points.merged_max;
        s.points.X = NULL;
        s.E = NULL;
        if (settings) status = rg_loose_drop(g, lines);
    }
    if (status == RG_ECANCELLED) rg_fail(status, why, 0, "%s", rg_status_text(status));
    rg_points_free(&s.points);
    RG_MEM_FREE(&s.mem, s.E, s.cuts, s.start, s.in, s.wanted, s.fresh, s.touched, s.parent);
    return status;
}

rg_status rg_planar_from_lines(rg_lines *lines, const rg_reading *s, rg_graph *g, rg_diag *why)
{
    return graph(lines, s, s->merge, s, g, why);
}

rg_status rg_planar_from_all_lines(rg_lines *lines, double merge, const rg_reading *ask, rg_graph *g, rg_diag *why)
{
    return graph(lines, NULL, merge, ask, g, why);
}
