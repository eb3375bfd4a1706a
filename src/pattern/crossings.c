#include "pattern/crossings.h"
#include "base/lanes.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pairs of edges in one cell, of one round: more than any drawing has that is not made to cost hours. */
static const int64_t MOST_PAIRS = (int64_t)1 << 34;
/* Cells that one long line crosses, added up over all: what is kept of them takes 1 GB at the most. */
static const int64_t MOST_ENTRIES = (int64_t)1 << 28;
/* Cells of the search grid, side by side: memory, and what one long line crosses, stay small. */
static const double MOST_SIDE = 1024;
/* Less than one edge of so many is fresh: then most are far from all that are. */
enum { FEW = 100 };
/* What comes after this part of the time is as good as nothing. */
static const double ENDS = 0.95;

/* --------------------------------------------------------------------------------------------------- grid ---- */

static inline int32_t clamp(double i, int32_t n) { return i < 0 ? 0 : i >= n ? n - 1 : (int32_t)i; }
static inline int32_t column(const rg_splitter *s, double x)
{
    return clamp((x - s->origin.x) * s->per_cell, s->side[0]);
}
static inline int32_t row(const rg_splitter *s, double y)
{
    return clamp((y - s->origin.y) * s->per_cell, s->side[1]);
}
static inline int32_t cell_at(const rg_splitter *s, int32_t i, int32_t j) { return i * s->side[1] + j; }
static inline int32_t cell_of(const rg_splitter *s, rg_vec2 x) { return cell_at(s, column(s, x.x), row(s, x.y)); }

static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most(double a, double b) { return a < b ? b : a; }

/* Cells that near an edge are its as well: more than rounding moves what is computed below. */
static inline double padding(const rg_splitter *s) { return 2 * s->points.tol + 1e-9 * s->cell; }

typedef enum visit { MARK, FILL_NEWS, COUNT, FILL } visit;

/* At the cell of a fresh edge: marks it as wanted, or puts the edge in; of any edge: counts it where the cell is
 * wanted, or puts it in. Returns whether the cell is wanted. */
static inline int visit_cell(rg_splitter *s, int32_t e, int32_t c, visit what)
{
    switch (what) {
    case MARK:
        s->news.start[c + 1]++;
        s->wanted[c] = 1;
        break;
    case FILL_NEWS: s->news.edge[s->news.start[c + 1]++] = e; break;
    case COUNT: s->all.start[c + 1] += s->wanted[c]; break;
    case FILL:
        if (s->wanted[c]) s->all.edge[s->all.start[c + 1]++] = e;
        break;
    }
    return s->wanted[c];
}

static inline int visit_box(rg_splitter *s, int32_t e, const int32_t columns[2], const int32_t rows[2], visit what)
{
    int any = 0;
    for (int32_t i = columns[0]; i <= columns[1]; i++)
        for (int32_t j = rows[0]; j <= rows[1]; j++) any |= visit_cell(s, e, cell_at(s, i, j), what);
    return any;
}

/* Visits the cells within the tolerance of an edge. Returns whether any of them is wanted. */
static int visit_along(rg_splitter *s, int32_t e, visit what)
{
    rg_vec2 a = s->points.X[s->E[e].v[0]], b = s->points.X[s->E[e].v[1]];
    if (a.x > b.x) {
        const rg_vec2 t = a;
        a = b;
        b = t;
    }
    const double pad = padding(s);
    const int32_t columns[2] = {column(s, a.x - pad), column(s, b.x + pad)};
    const int32_t rows[2] = {row(s, least(a.y, b.y) - pad), row(s, most(a.y, b.y) + pad)};
    if (columns[0] == columns[1] || rows[0] == rows[1]) return visit_box(s, e, columns, rows, what);
    const int is_upright = !(b.x - a.x > pad);
    const double slope = is_upright ? 0 : (b.y - a.y) / (b.x - a.x);
    int any = 0;
    for (int32_t i = columns[0]; i <= columns[1]; i++) {
        double y0 = a.y, y1 = b.y;
        if (!is_upright) { /* the part of it in this column */
            const double left = most(a.x, s->origin.x + i * s->cell - pad);
            const double right = least(b.x, s->origin.x + (i + 1) * s->cell + pad);
            y0 = a.y + slope * (left - a.x);
            y1 = a.y + slope * (right - a.x);
        }
        const int32_t column_i[2] = {i, i}, part[2] = {row(s, least(y0, y1) - pad), row(s, most(y0, y1) + pad)};
        any |= visit_box(s, e, column_i, part, what);
    }
    return any;
}

/* From the first of two places to the last, both ends included. */
static inline void span(int32_t p, int32_t q, int32_t range[2])
{
    range[0] = (p < q ? p : q) >> 1;
    range[1] = ((p + 1) >> 1) > ((q + 1) >> 1) ? (p + 1) >> 1 : (q + 1) >> 1;
}

/* The same, sooner where the cells of its ends tell it: as of most that are short. */
static inline int visit_edge(rg_splitter *s, int32_t e, visit what)
{
    const rg_cell_place p = s->place[s->E[e].v[0]], q = s->place[s->E[e].v[1]];
    int32_t columns[2], rows[2];
    if (p.column < 0 || q.column < 0) return visit_along(s, e, what);
    span(p.column, q.column, columns);
    span(p.row, q.row, rows);
    if (what == COUNT && columns[1] - columns[0] <= 1 && rows[1] - rows[0] <= 1) { /* most are far off, later */
        const unsigned char *left = s->wanted + cell_at(s, columns[0], 0);
        const unsigned char *right = s->wanted + cell_at(s, columns[1], 0);
        if (!(left[rows[0]] | left[rows[1]] | right[rows[0]] | right[rows[1]])) return 0;
    }
    if (columns[0] == columns[1] || rows[0] == rows[1]) return visit_box(s, e, columns, rows, what);
    return visit_along(s, e, what);
}

static rg_status find_places(rg_splitter *s)
{
    const double pad = padding(s);
    const rg_status status = RG_MEM_GROW(&s->mem, s->place, s->place_room, (size_t)s->points.count);
    for (int32_t v = s->placed; status == RG_OK && v < s->points.count; v++) {
        const rg_vec2 x = s->points.X[v];
        const int32_t i = column(s, x.x - pad), j = row(s, x.y - pad);
        const int32_t more[2] = {column(s, x.x + pad) - i, row(s, x.y + pad) - j};
        const int is_near = more[0] <= 1 && more[1] <= 1;
        s->place[v] = (rg_cell_place){-1, -1};
        if (is_near) s->place[v] = (rg_cell_place){(int16_t)(2 * i + more[0]), (int16_t)(2 * j + more[1])};
    }
    if (status == RG_OK) s->placed = s->points.count;
    return status;
}

/* Cells for a drawing of so many edges; what was kept of other ones is let go. */
static rg_status lay_grid(rg_splitter *s, rg_vec2 low, rg_vec2 high)
{
    const double w = high.x - low.x, h = high.y - low.y, size = fmax(w, h);
    const double side = fmin(ceil(sqrt((double)s->ne)) + 1, MOST_SIDE), cell = size / side;
    const int32_t sides[2] = {clamp(ceil(w / cell), (int32_t)side) + 1, clamp(ceil(h / cell), (int32_t)side) + 1};
    const size_t cells = (size_t)sides[0] * (size_t)sides[1];
    if (!s->wanted || cell != s->cell || sides[0] != s->side[0] || sides[1] != s->side[1]) {
        RG_MEM_FREE(&s->mem, s->all.start, s->news.start, s->wanted);
        s->origin = low;
        s->cell = cell;
        s->per_cell = 1 / cell;
        memcpy(s->side, sides, sizeof s->side);
        s->placed = 0;
        if (RG_MEM_ARRAYS(&s->mem, RG_ARRAY(s->all.start, cells + 2), RG_ARRAY(s->news.start, cells + 2),
                          RG_ARRAY(s->wanted, cells)) != RG_OK) return RG_ENOMEM;
    } else {
        memset(s->all.start, 0, (cells + 2) * sizeof *s->all.start);
        memset(s->news.start, 0, (cells + 2) * sizeof *s->news.start);
        memset(s->wanted, 0, cells);
    }
    return find_places(s);
}

/* Edges were counted one cell to the right, so that the sums are the starts; filling moves each start to its end, so
 * they are put one further to the right before. */
static rg_status make_starts(rg_splitter *s, rg_cell_edges *l)
{
    const size_t cells = (size_t)s->side[0] * (size_t)s->side[1];
    int64_t total = 0;
    for (size_t c = 1; c < cells + 2 && total <= MOST_ENTRIES; c++) {
        const int32_t here = l->start[c];
        l->start[c] = (int32_t)total;
        total += here;
    }
    if (total > MOST_ENTRIES) return s->too_many = "lines that cross the whole drawing", RG_EFORMAT;
    return RG_MEM_GROW(&s->mem, l->edge, l->room, (size_t)total + 1);
}

/* Edge list[k] is visited next of n that lie here and there: what is read of later ones is asked for. */
static inline int visit_listed(rg_splitter *s, const int32_t *list, int32_t k, int32_t n, visit what)
{
    if (k + 3 * RG_SOON < n) rg_mem_soon(&s->E[list[k + 3 * RG_SOON]]);
    for (int i = 0; k + 2 * RG_SOON < n && i < 2; i++) {
        const int32_t later = s->E[list[k + 2 * RG_SOON]].v[i], soon = s->E[list[k + RG_SOON]].v[i];
        rg_mem_soon(&s->place[later]);
        rg_mem_soon(&s->points.X[soon]);
        if (s->place[soon].column < 0) continue;
        const int32_t c = cell_at(s, s->place[soon].column >> 1, s->place[soon].row >> 1);
        rg_mem_soon(&s->wanted[c]);
        rg_mem_soon(what == FILL ? &s->all.start[c] : &s->news.start[c]);
    }
    return visit_edge(s, list[k], what);
}

/* Where fresh edges are, all in all that they are in; and the cells of new vertices. */
static rg_status find_news(rg_splitter *s)
{
    int32_t *list = NULL, n = 0;
    size_t room = 0;
    rg_status status = RG_MEM_GROW(&s->mem, list, room, (size_t)s->fresh_count);
    for (int32_t e = 0; status == RG_OK && e < s->ne; e++)
        if (s->fresh[e]) list[n++] = e;
    for (int32_t k = 0; status == RG_OK && k < n; k++) {
        visit_listed(s, list, k, n, MARK);
        status = rg_splitter_done(s, 1);
    }
    for (int32_t v = s->looked_at; v < s->points.count; v++) s->wanted[cell_of(s, s->points.X[v])] = 1;
    if (status == RG_OK) status = make_starts(s, &s->news);
    const int64_t total = s->news.start[s->side[0] * s->side[1] + 1];
    const int64_t each = 1 + total / (s->fresh_count + 1); /* cells that one crosses, more or less */
    for (int32_t k = 0; status == RG_OK && k < n; k++) {
        visit_listed(s, list, k, n, FILL_NEWS);
        status = rg_splitter_done(s, each);
    }
    rg_mem_free(&s->mem, list);
    return status;
}

/* All edges in cells where something is to be looked at. */
static rg_status find_all(rg_splitter *s)
{
    const int many = s->fresh_count > s->ne / FEW;
    int32_t *near = NULL, count = 0; /* those that are in any of these cells */
    size_t room = 0;
    rg_status status = RG_OK;
    for (int32_t e = 0; status == RG_OK && e < s->ne; e++) {
        if (e + 2 * RG_SOON < s->ne) {
            const int32_t v = s->E[e + RG_SOON].v[1], i = s->place[v].column >> 1, j = s->place[v].row >> 1;
            rg_mem_soon(&s->place[s->E[e + 2 * RG_SOON].v[1]]);
            if (many) {
                rg_mem_soon(&s->points.X[v]);
                if (i >= 0) rg_mem_soon(&s->wanted[cell_at(s, i, j)]), rg_mem_soon(&s->all.start[cell_at(s, i, j)]);
            }
        }
        if (visit_edge(s, e, COUNT)) {
            status = RG_MEM_GROW(&s->mem, near, room, (size_t)count + 1);
            if (status == RG_OK) near[count++] = e;
        }
        if (status == RG_OK) status = rg_splitter_done(s, 1);
    }
    if (status == RG_OK) status = make_starts(s, &s->all);
    for (int32_t k = 0; status == RG_OK && k < count; k++) {
        visit_listed(s, near, k, count, FILL);
        status = rg_splitter_done(s, 1);
    }
    rg_mem_free(&s->mem, near);
    return status;
}

/* ---------------------------------------------------------------------------------------------- crossings ---- */

static rg_status add_cut(rg_splitter *s, int32_t e, int32_t v)
{
    if (s->E[e].v[0] == v || s->E[e].v[1] == v) return RG_OK;
    if (s->cut_count == RG_MOST_CUTS) return s->too_many = "crossings", RG_EFORMAT;
    rg_status status = RG_MEM_GROW(&s->mem, s->cuts, s->cut_room, s->cut_count + 1);
    if (status != RG_OK) return status;
    rg_vec2 a = s->points.X[s->E[e].v[0]], d = rg_vec2_sub(s->points.X[s->E[e].v[1]], a);
    double t = rg_vec2_dot(rg_vec2_sub(s->points.X[v], a), d);
    s->cuts[s->cut_count++] = (rg_keyed){t, v, e};
    return RG_OK;
}

typedef struct crossing { int32_t e[2]; rg_vec2 x; } crossing; /* of two edges, at x */

/* Whether two edges cross inside both in cell c; *x: where. */
static int crosses(const rg_splitter *s, const int32_t *p, const int32_t *q, int32_t c, rg_vec2 *x)
{
    const rg_vec2 *X = s->points.X, a = X[p[0]], b = X[p[1]], u = X[q[0]], v = X[q[1]];
    const double au = rg_vec2_turn(u, v, a), bu = rg_vec2_turn(u, v, b);
    const double ua = rg_vec2_turn(a, b, u), va = rg_vec2_turn(a, b, v);
    if (!((au < 0) != (bu < 0) && (ua < 0) != (va < 0))) return 0;
    const double t = au / (au - bu);
    if (!(t >= 0 && t <= 1)) return 0;
    *x = (rg_vec2){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    return cell_of(s, *x) == c;
}

/* Edges e and f are cut where they cross, at a vertex nearby or a new one. */
static rg_status cut_crossing(rg_splitter *s, const crossing *k)
{
    const int32_t before = s->points.count;
    int32_t vertex;
    rg_status status = rg_points_add(&s->points, k->x, &vertex);
    if (status == RG_OK && s->points.count > before) {
        const size_t n = (size_t)(vertex - s->looked_at);
        status = RG_MEM_GROW(&s->mem, s->parent, s->parent_room, n + 1);
        if (status == RG_OK) memcpy(s->parent[n], k->e, sizeof k->e);
    }
    if (status == RG_OK) status = add_cut(s, k->e[0], vertex);
    if (status == RG_OK) status = add_cut(s, k->e[1], vertex);
    return status;
}

/* Some of one cell. Where a vertex may be nearby is asked of memory some crossings before it is needed. */
static rg_status cut_crossings(rg_splitter *s, const crossing *k, int32_t n)
{
    rg_status status = RG_OK;
    for (int32_t i = -RG_SOON; status == RG_OK && i < n; i++) {
        const int32_t later = i + RG_SOON, soon = i + RG_SOON / 2;
        if (later < n) rg_points_expect(&s->points, k[later].x, 0);
        if (soon >= 0 && soon < n) rg_points_expect(&s->points, k[soon].x, 1);
        if (i >= 0) status = cut_crossing(s, &k[i]);
    }
    return status;
}

static int beside(double a, double b, double u, double v)
{
    return (a < b ? b : a) < (u < v ? u : v) || (u < v ? v : u) < (a < b ? a : b);
}

/* Two edges that are not worth a closer look: they share a vertex, or their boxes are apart. */
static int apart(const rg_splitter *s, const int32_t *p, const int32_t *q)
{
    if (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]) return 1;
    const rg_vec2 a = s->points.X[p[0]], b = s->points.X[p[1]], u = s->points.X[q[0]], v = s->points.X[q[1]];
    return beside(a.x, b.x, u.x, v.x) || beside(a.y, b.y, u.y, v.y);
}

static rg_status find_crossings(rg_splitter *s, const rg_cell_edges *in)
{
    const int32_t cells = s->side[0] * s->side[1];
    int64_t pairs = 0;
    for (int32_t c = 0; c < cells; c++) {
        const int64_t n = in->start[c + 1] - in->start[c];
        pairs += n * (n - 1) / 2;
    }
    if (pairs > MOST_PAIRS) return s->too_many = "lines in one place", RG_EFORMAT;
    const double from = s->progress, left = (ENDS - from) / 2; /* later rounds share the rest */
    const int32_t entries = in->start[cells];
    const double all = (double)(pairs + entries + 1);
    int64_t seen = 0;
    enum { BATCH = 256 };
    crossing batch[BATCH];
    for (int32_t c = 0; c < cells; c++) {
        rg_status status = RG_OK;
        int32_t n = 0;
        for (int32_t i = in->start[c]; i < in->start[c + 1]; i++) {
            seen += in->start[c + 1] - i;
            s->progress = from + left * fmin(1, (double)seen / all);
            const rg_status asked = rg_splitter_done(s, in->start[c + 1] - i);
            if (asked != RG_OK) return asked;
            const int32_t e = in->edge[i], is_fresh = s->fresh[e];
            if (i + 2 * RG_SOON < entries) rg_mem_soon(&s->E[in->edge[i + 2 * RG_SOON]]);
            if (i + RG_SOON < entries) rg_mem_soon(&s->points.X[s->E[in->edge[i + RG_SOON]].v[1]]);
            for (int32_t j = i + 1; j < in->start[c + 1]; j++) {
                const int32_t f = in->edge[j];
                rg_vec2 x;
                if (!(is_fresh || s->fresh[f]) || apart(s, s->E[e].v, s->E[f].v)) continue;
                if (!crosses(s, s->E[e].v, s->E[f].v, c, &x)) continue;
                batch[n++] = (crossing){{e, f}, x};
                if (n < BATCH) continue;
                status = cut_crossings(s, batch, n);
                if (status != RG_OK) return status;
                n = 0;
            }
        }
        status = cut_crossings(s, batch, n);
        if (status != RG_OK) return status;
    }
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------------- junctions ---- */

/* Is x within the tolerance of an edge's inside, so that it is to be cut there? */
static int is_junction(const rg_splitter *s, const rg_edge *e, rg_vec2 x)
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
static int is_parent(const rg_splitter *s, int32_t v, int32_t e, int32_t known)
{
    return v >= known && (s->parent[v - s->looked_at][0] == e || s->parent[v - s->looked_at][1] == e);
}

/* The edges of one cell side by side, as most of a crowd are told to be far off by what is not exact. */
typedef struct crowd {
    int32_t cell; /* -1: none */
    double *from[2], *way[2], *limit;
} crowd;
/* So few are looked at one by one. */
enum { NO_CROWD = 8 };

static void gather(const rg_splitter *s, const rg_cell_edges *in, int32_t c, crowd *k)
{
    const double tol = s->points.tol;
    for (int32_t i = 0; i < in->start[c + 1] - in->start[c]; i++) {
        const int32_t *v = s->E[in->edge[in->start[c] + i]].v;
        const rg_vec2 a = s->points.X[v[0]], d = rg_vec2_sub(s->points.X[v[1]], a);
        k->from[0][i] = a.x, k->from[1][i] = a.y;
        k->way[0][i] = d.x, k->way[1][i] = d.y;
        k->limit[i] = tol * tol * rg_vec2_dot(d, d) * (1 + 1e-9);
    }
    k->cell = c;
}

/* Those of the first n that x may be a junction of, as is_junction has it at first. hit[n]: out; returns how many. */
RG_WIDE static int32_t find_near(const crowd *k, int32_t n, double x, double y, int32_t *hit)
{
    int32_t hits = 0, i = 0;
    for (; i + 4 <= n; i += 4) {
        const rg_quad dx = *(const rg_quad_anywhere *)(k->way[0] + i), dy = *(const rg_quad_anywhere *)(k->way[1] + i);
        const rg_quad rx = x - *(const rg_quad_anywhere *)(k->from[0] + i);
        const rg_quad ry = y - *(const rg_quad_anywhere *)(k->from[1] + i);
        const rg_quad along = rx * dx + ry * dy, off = dx * ry - dy * rx;
        const rg_quad_int near = (along > 0) & (off * off <= *(const rg_quad_anywhere *)(k->limit + i));
        if (!(near[0] | near[1] | near[2] | near[3])) continue;
        for (int32_t q = 0; q < 4; q++)
            if (near[q]) hit[hits++] = i + q;
    }
    for (; i < n; i++) hit[hits++] = i;
    return hits;
}

/* Of vertex v, if it lies on edge e. */
static rg_status cut_at_junction(rg_splitter *s, int32_t v, int32_t e, int32_t known)
{
    if (is_parent(s, v, e, known) || !is_junction(s, &s->E[e], s->points.X[v])) return RG_OK;
    return add_cut(s, e, v);
}

/* Vertices on edges: new ones on any, old ones on fresh ones. `known`: those from here on are crossings of this
 * round. */
static rg_status find_junctions(rg_splitter *s, const rg_cell_edges *all, int32_t known)
{
    const int32_t cells = s->side[0] * s->side[1];
    int32_t crowded = 0, before = -1, *hit;
    for (int32_t c = 0; c < cells; c++) {
        const int32_t n = all->start[c + 1] - all->start[c];
        crowded = n > crowded ? n : crowded;
    }
    const size_t room = (size_t)crowded;
    crowd k = {.cell = -1};
    rg_status status = RG_MEM_ARRAYS(&s->mem, RG_ARRAY(hit, room), RG_ARRAY(k.from[0], room), RG_ARRAY(k.from[1], room),
                                     RG_ARRAY(k.way[0], room), RG_ARRAY(k.way[1], room), RG_ARRAY(k.limit, room));
    for (int32_t v = 0; status == RG_OK && v < s->points.count; v++) {
        const rg_vec2 x = s->points.X[v];
        const rg_cell_edges *in = v < s->looked_at ? &s->news : all;
        const int32_t c = cell_of(s, x), first = in->start[c], n = in->start[c + 1] - first;
        if (n > NO_CROWD && in == all && c == before) { /* vertices come by cells, as they were found */
            if (k.cell != c) gather(s, all, c, &k);
            const int32_t hits = find_near(&k, n, x.x, x.y, hit);
            for (int32_t i = 0; status == RG_OK && i < hits; i++)
                status = cut_at_junction(s, v, all->edge[first + hit[i]], known);
        } else {
            for (int32_t i = first; status == RG_OK && i < first + n; i++)
                status = cut_at_junction(s, v, in->edge[i], known);
        }
        before = c;
        if (status == RG_OK) status = rg_splitter_done(s, 1 + n);
    }
    RG_MEM_FREE(&s->mem, hit, k.from[0], k.from[1], k.way[0], k.way[1], k.limit);
    return status;
}

rg_status rg_crossings_find(rg_splitter *s, rg_vec2 low, rg_vec2 high)
{
    const int32_t known = s->points.count;
    const int all_fresh = s->fresh_count == s->ne;
    const rg_cell_edges *all = all_fresh ? &s->news : &s->all;
    s->cut_count = 0;
    rg_status status = lay_grid(s, low, high);
    if (status == RG_OK) status = find_news(s);
    if (status == RG_OK && !all_fresh) status = find_all(s);
    if (status == RG_OK) status = find_crossings(s, all);
    if (status == RG_OK) status = find_junctions(s, all, known);
    s->looked_at = s->points.count;
    return status;
}

void rg_crossings_free(rg_splitter *s)
{
    RG_MEM_FREE(&s->mem, s->all.start, s->all.edge, s->news.start, s->news.edge);
    RG_MEM_FREE(&s->mem, s->wanted, s->place, s->parent, s->cuts);
}
