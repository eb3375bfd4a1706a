#include "layers/cells.h"
#include "base/status.h"

#include <stdlib.h>
#include <string.h>

/* Points of the folded sheet that are meant to be one differ by what the file's digits leave: up to 3e-7 of the sheet's
 * size in files as people share them, while the narrowest overlaps that are meant are 3e-5 wide. Real patterns give the
 * same orders from 1e-6 to 1e-5. */
static const double ROUNDED = 3e-6;
/* ... or by more, as facets put a vertex in different places: each of two points may be that far off. */
static const double OFF = 2;
/* A segment's ends may have been moved by the tolerance, and the edge that it lies along by as much. */
static const double NEAR = 2;
/* A cell whose best point is nearer to its border than this many tolerances may be no more than rounding. */
static const double WIDE = 1;

void rg_cells_free(rg_cells *c)
{
    if (!c->mem.resize) return;
    const rg_memory mem = c->mem;
    rg_graph_free(&c->graph);
    rg_faces_free(&c->faces);
    RG_MEM_FREE(&mem, c->along_start, c->along, c->across_start, c->across, c->point, c->over_start, c->over);
    memset(c, 0, sizeof *c);
}

/* ------------------------------------------------------------------------------------------ the graph ---- */

static rg_status draw(rg_cells *c, const rg_mesh *m, const rg_flat *f, rg_diag *why)
{
    rg_lines lines;
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    rg_status s = RG_OK;
    rg_lines_init(&lines, &c->mem);
    for (int32_t e = 0; s == RG_OK && e < m->ne; e++) {
        if (f->beside[e][0] == f->beside[e][1]) continue;
        const rg_vec2 a = f->x[m->edge[e][0]], b = f->x[m->edge[e][1]];
        low = (rg_vec2){fmin(low.x, fmin(a.x, b.x)), fmin(low.y, fmin(a.y, b.y))};
        high = (rg_vec2){fmax(high.x, fmax(a.x, b.x)), fmax(high.y, fmax(a.y, b.y))};
        s = rg_lines_add(&lines, a, b, RG_UNASSIGNED, 0);
    }
    c->tol = fmax(ROUNDED * m->size, OFF * f->gap);
    const double box = fmax(high.x - low.x, high.y - low.y);
    if (s == RG_OK) s = rg_planar_from_all_lines(&lines, c->tol / box, NULL, &c->graph, why);
    rg_lines_free(&lines);
    return s;
}

static rg_status find_faces(rg_cells *c)
{
    rg_star star;
    rg_status s = rg_star_init(&star, &c->mem, c->graph.nv, c->graph.ne, c->graph.X, c->graph.E);
    if (s == RG_OK)
        s = rg_faces_init(&c->faces, &c->mem, c->graph.nv, c->graph.ne, c->graph.X, c->graph.E, star.start, star.edge);
    rg_star_free(&star);
    return s;
}

/* ------------------------------------------------------------------------------- what lies where ---- */

typedef struct box { rg_vec2 low, high; } box;

static box box_of(rg_vec2 a, rg_vec2 b)
{
    return (box){{fmin(a.x, b.x), fmin(a.y, b.y)}, {fmax(a.x, b.x), fmax(a.y, b.y)}};
}

static int in_box(const box *b, rg_vec2 x, double pad)
{
    return x.x >= b->low.x - pad && x.x <= b->high.x + pad && x.y >= b->low.y - pad && x.y <= b->high.y + pad;
}

/* Inside a facet as it lies folded: a ray from x crosses its border an odd number of times. */
static int inside(const rg_mesh *m, const rg_flat *f, int32_t g, rg_vec2 x)
{
    int odd = 0;
    for (int32_t j = f->start[g]; j < f->start[g + 1]; j++) {
        const int32_t *v = m->edge[f->edge[j]];
        const rg_vec2 a = f->x[v[0]], b = f->x[v[1]];
        if ((a.y > x.y) == (b.y > x.y)) continue;
        odd ^= x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x);
    }
    return odd;
}

/* Does the segment a b, short against the edge or as long as it, lie along the edge p q? */
static int lies_along(rg_vec2 p, rg_vec2 q, rg_vec2 a, rg_vec2 b, double tol)
{
    const rg_vec2 d = rg_vec2_sub(q, p), pa = rg_vec2_sub(a, p), pb = rg_vec2_sub(b, p);
    const double n = rg_vec2_length(d), middle = (rg_vec2_dot(d, pa) + rg_vec2_dot(d, pb)) / 2;
    if (!(fabs(rg_vec2_cross(d, pa)) <= tol * n && fabs(rg_vec2_cross(d, pb)) <= tol * n)) return 0;
    return middle > 0 && middle < n * n;
}

typedef struct list { int32_t *item; size_t count, room; } list;

static rg_status append(const rg_memory *mem, list *l, int32_t i)
{
    if (l->count >= INT32_MAX) return RG_ENOMEM;
    const rg_status s = RG_MEM_GROW(mem, l->item, l->room, l->count + 1);
    if (s == RG_OK) l->item[l->count++] = i;
    return s;
}

static int has_edge(const rg_flat *f, const int32_t *edge, size_t n, int32_t g)
{
    for (size_t i = 0; i < n; i++)
        if (f->beside[edge[i]][0] == g || f->beside[edge[i]][1] == g) return 1;
    return 0;
}

static rg_status walk_segments(rg_cells *c, const rg_mesh *m, const rg_flat *f, const box *of_facet,
                               const rg_stop *stop, list *along, list *across)
{
    rg_status s = RG_OK;
    box *of_edge = rg_mem_array(&c->mem, (size_t)m->ne, sizeof *of_edge);
    if (!of_edge) return RG_ENOMEM;
    for (int32_t e = 0; e < m->ne; e++) of_edge[e] = box_of(f->x[m->edge[e][0]], f->x[m->edge[e][1]]);
    for (int32_t i = 0; s == RG_OK && i < c->graph.ne; i++) {
        const rg_vec2 a = c->graph.X[c->graph.E[i].v[0]], b = c->graph.X[c->graph.E[i].v[1]];
        const rg_vec2 x = {(a.x + b.x) / 2, (a.y + b.y) / 2};
        const size_t first = along->count;
        if (rg_stop_asked(stop)) s = RG_EFORMAT;
        for (int32_t e = 0; s == RG_OK && e < m->ne; e++) {
            if (f->beside[e][0] == f->beside[e][1] || !in_box(&of_edge[e], x, NEAR * c->tol)) continue;
            const rg_vec2 from = f->x[m->edge[e][0]], to = f->x[m->edge[e][1]];
            if (lies_along(from, to, a, b, NEAR * c->tol)) s = append(&c->mem, along, e);
        }
        for (int32_t g = 0; s == RG_OK && g < f->nf; g++)
            if (in_box(&of_facet[g], x, 0) && !has_edge(f, along->item + first, along->count - first, g) &&
                inside(m, f, g, x))
                s = append(&c->mem, across, g);
        c->along_start[i + 1] = (int32_t)along->count;
        c->across_start[i + 1] = (int32_t)across->count;
    }
    rg_mem_free(&c->mem, of_edge);
    return s;
}

/* ---------------------------------------------------------------------------------------------- cells ---- */

static int rising(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double clearance(const rg_vec2 *corner, int32_t n, rg_vec2 x)
{
    double least = INFINITY;
    for (int32_t i = 0; i < n; i++) {
        const rg_vec2 a = corner[i], d = rg_vec2_sub(corner[(i + 1) % n], a), r = rg_vec2_sub(x, a);
        const double t = fmin(1, fmax(0, rg_vec2_dot(r, d) / rg_vec2_dot(d, d)));
        least = fmin(least, hypot(r.x - t * d.x, r.y - t * d.y));
    }
    return least;
}

/* A point well inside the polygon: the middle of a stretch of a level line half-way between two corners' levels, the
 * one of these that is farthest from the border. scratch: [2 n]. Returns how far. */
static double best_point(const rg_vec2 *corner, int32_t n, double *scratch, rg_vec2 *point)
{
    double best = 0, *level = scratch, *cut = scratch + n;
    for (int32_t i = 0; i < n; i++) level[i] = corner[i].y;
    qsort(level, (size_t)n, sizeof *level, rising);
    for (int32_t k = 1; k < n; k++) {
        const double y = (level[k - 1] + level[k]) / 2;
        int32_t cuts = 0;
        if (!(level[k] - level[k - 1] > 2 * best)) continue; /* no point of that line is farther from these levels */
        for (int32_t i = 0; i < n; i++) {
            const rg_vec2 a = corner[i], b = corner[(i + 1) % n];
            if ((a.y > y) != (b.y > y)) cut[cuts++] = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        }
        qsort(cut, (size_t)cuts, sizeof *cut, rising);
        for (int32_t i = 0; i + 1 < cuts; i += 2) {
            const rg_vec2 x = {(cut[i] + cut[i + 1]) / 2, y};
            const double d = clearance(corner, n, x);
            if (!(d > best)) continue;
            best = d;
            *point = x;
        }
    }
    return best;
}

static rg_status walk_cells(rg_cells *c, const rg_mesh *m, const rg_flat *f, const box *of_facet, const rg_stop *stop,
                            list *over)
{
    rg_vec2 *corner;
    double *scratch;
    rg_status s = RG_MEM_ARRAYS(&c->mem, RG_ARRAY(corner, 2 * (size_t)c->graph.ne),
                                RG_ARRAY(scratch, 4 * (size_t)c->graph.ne));
    for (int32_t i = 0; s == RG_OK && i < c->faces.count; i++) {
        rg_vec2 x = {0, 0};
        int32_t n = 0, h = c->faces.first[i];
        if (rg_stop_asked(stop)) s = RG_EFORMAT;
        do corner[n++] = c->graph.X[rg_tail(c->graph.E, h)], h = c->faces.next[h];
        while (h != c->faces.first[i]);
        if (c->faces.area[i] > 0 && best_point(corner, n, scratch, &x) > WIDE * c->tol)
            for (int32_t g = 0; s == RG_OK && g < f->nf; g++)
                if (in_box(&of_facet[g], x, 0) && inside(m, f, g, x)) s = append(&c->mem, over, g);
        c->point[i] = x;
        c->over_start[i + 1] = (int32_t)over->count;
    }
    RG_MEM_FREE(&c->mem, corner, scratch);
    return s;
}

rg_status rg_cells_init(rg_cells *c, const rg_memory *mem, const rg_mesh *m, const rg_flat *f, const rg_stop *stop,
                        rg_diag *why)
{
    list along = {0}, across = {0}, over = {0};
    memset(c, 0, sizeof *c);
    c->mem = *mem;
    rg_status s = draw(c, m, f, why);
    if (s == RG_OK) s = find_faces(c);
    if (s != RG_OK) return s;
    const size_t edges = (size_t)c->graph.ne, faces = (size_t)c->faces.count;
    box *of_facet;
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(of_facet, (size_t)f->nf), RG_ARRAY(c->along_start, edges + 1),
                      RG_ARRAY(c->across_start, edges + 1), RG_ARRAY(c->over_start, faces + 1),
                      RG_ARRAY(c->point, faces));
    for (int32_t g = 0; s == RG_OK && g < f->nf; g++) {
        of_facet[g] = (box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
        for (int32_t j = f->start[g]; j < f->start[g + 1]; j++) {
            const box b = box_of(f->x[m->edge[f->edge[j]][0]], f->x[m->edge[f->edge[j]][1]]);
            of_facet[g].low = (rg_vec2){fmin(of_facet[g].low.x, b.low.x), fmin(of_facet[g].low.y, b.low.y)};
            of_facet[g].high = (rg_vec2){fmax(of_facet[g].high.x, b.high.x), fmax(of_facet[g].high.y, b.high.y)};
        }
    }
    list *lists[] = {&along, &across, &over}; /* arrays, also where nothing is in them */
    for (int i = 0; s == RG_OK && i < 3; i++) s = RG_MEM_GROW(mem, lists[i]->item, lists[i]->room, 1);
    if (s == RG_OK) s = walk_segments(c, m, f, of_facet, stop, &along, &across);
    if (s == RG_OK) s = walk_cells(c, m, f, of_facet, stop, &over);
    c->along = along.item, c->across = across.item, c->over = over.item;
    rg_mem_free(mem, of_facet);
    return s;
}
