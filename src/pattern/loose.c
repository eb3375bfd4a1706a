#include "pattern/loose.h"
#include "base/memory.h"

#include <math.h>

/* Ends that are told, before the rest is counted only. */
enum { MOST_WARNINGS = 20 };

/* What would have joined a loose end: the tolerance, rounded up to two digits; more than SENSIBLE joins what is no
 * gap. */
static const double SENSIBLE = 0.02;
/* A vertex that is hardly farther than the nearest line is what the end was meant to meet: joined to the line beside
 * it, both would be one vertex, somewhere between them. */
static const double HARDLY_FARTHER = 2;

/* A loose end, of edge e at vertex v, that is told. How far the nearest line is that does not end there, and the
 * nearest vertex that is no end of its own: INFINITY where that is more than can be sensible. */
typedef struct loose { int32_t e, v; double line, vertex; int is_end; } loose;

/* Those that are told, by x: a strip of the drawing knows the first of them that is in it or to the right of it. */
enum { STRIPS = 64 };
typedef struct strips {
    loose *by_x[MOST_WARNINGS];
    int n, first[STRIPS];
    double left, per_strip;
} strips;

static void fill(const rg_graph *g, loose *told, int n, strips *s)
{
    s->n = 0;
    for (int i = 0; i < n; i++) {
        int k = s->n;
        if (!told[i].is_end) continue;
        for (; k > 0 && g->X[s->by_x[k - 1]->v].x > g->X[told[i].v].x; k--) s->by_x[k] = s->by_x[k - 1];
        s->by_x[k] = &told[i];
        s->n++;
    }
    if (s->n == 0) return;
    s->left = g->X[s->by_x[0]->v].x;
    s->per_strip = STRIPS / (g->X[s->by_x[s->n - 1]->v].x - s->left + SENSIBLE * g->size);
    for (int i = 0, k = 0; i < STRIPS; i++) {
        while (k < s->n && (g->X[s->by_x[k]->v].x - s->left) * s->per_strip < i) k++;
        s->first[i] = k;
    }
}

/* All that are told and not to the left of x are this one and those after it. */
static int first_from(const strips *s, double x)
{
    const double strip = (x - s->left) * s->per_strip;
    return strip < 1 ? 0 : strip >= STRIPS ? s->first[STRIPS - 1] : s->first[(int)strip];
}

static void find_nearest_lines(const rg_graph *g, const strips *s)
{
    const double most = SENSIBLE * g->size;
    for (int32_t e = 0; s->n > 0 && e < g->ne; e++) {
        const rg_vec2 a = g->X[g->E[e].v[0]], b = g->X[g->E[e].v[1]], d = rg_vec2_sub(b, a);
        const rg_vec2 low = {(a.x < b.x ? a.x : b.x) - most, (a.y < b.y ? a.y : b.y) - most};
        const rg_vec2 high = {(a.x < b.x ? b.x : a.x) + most, (a.y < b.y ? b.y : a.y) + most};
        for (int i = first_from(s, low.x); i < s->n && g->X[s->by_x[i]->v].x <= high.x; i++) {
            loose *l = s->by_x[i];
            const rg_vec2 x = g->X[l->v], r = rg_vec2_sub(x, a);
            if (e == l->e || x.x < low.x || x.y < low.y || x.y > high.y) continue;
            const double part = fmin(1, fmax(0, rg_vec2_dot(r, d) / rg_vec2_dot(d, d)));
            l->line = fmin(l->line, hypot(r.x - part * d.x, r.y - part * d.y));
        }
    }
}

static void find_nearest_vertices(const rg_graph *g, const strips *s)
{
    const double most = HARDLY_FARTHER * SENSIBLE * g->size, wide = 2 * most; /* rounding leaves none out */
    for (int32_t v = 0; s->n > 0 && v < g->nv; v++) {
        const rg_vec2 x = g->X[v];
        for (int i = first_from(s, x.x - wide); i < s->n && g->X[s->by_x[i]->v].x <= x.x + wide; i++) {
            loose *l = s->by_x[i];
            const rg_vec2 r = rg_vec2_sub(g->X[l->v], x);
            const int32_t *own = g->E[l->e].v;
            if (fabs(r.x) > most || fabs(r.y) > most || v == own[0] || v == own[1]) continue;
            l->vertex = fmin(l->vertex, hypot(r.x, r.y));
        }
    }
}

static rg_status warn_loose(const rg_graph *g, rg_lines *lines, const loose *l)
{
    const rg_vec2 at = rg_lines_own(lines, g->X[l->v], g->size);
    const int is_vertex = l->vertex <= HARDLY_FARTHER * l->line;
    const double far = is_vertex ? l->vertex : l->line, part = far / g->size;
    if (!(part <= SENSIBLE))
        return rg_lines_warn(lines, g->E[l->e].where, "a loose end at (%.6g, %.6g) is left out", at.x, at.y);
    const double digit = pow(10, floor(log10(part)) - 1);
    const double merge = ceil(part / digit * (1 + 1e-9)) * digit;
    if (is_vertex)
        return rg_lines_warn(lines, g->E[l->e].where,
                             "a loose end at (%.6g, %.6g) is left out: the next line is %.2g away, a corner %.2g; "
                             "--merge %.2g joins them", at.x, at.y, l->line, far, merge);
    return rg_lines_warn(lines, g->E[l->e].where,
                         "a loose end at (%.6g, %.6g) is left out: the next line is %.2g away; --merge %.2g joins them",
                         at.x, at.y, far, merge);
}

static rg_status warn_of_all_loose(const rg_graph *g, rg_lines *lines, loose *told, int32_t count)
{
    const int n = count < MOST_WARNINGS ? (int)count : MOST_WARNINGS;
    rg_status s = RG_OK;
    strips by_x;
    fill(g, told, n, &by_x);
    find_nearest_lines(g, &by_x);
    find_nearest_vertices(g, &by_x);
    for (int i = 0; s == RG_OK && i < n; i++) s = warn_loose(g, lines, &told[i]);
    if (s == RG_OK && count > n) s = rg_lines_warn(lines, 0, "%d more loose ends are left out", (int)(count - n));
    return s;
}

/* Edges that end in the middle of a facet, or outside the sheet, from their free ends inwards. `sum` adds up the
 * edges at a vertex, so that the last one of a vertex is known without a list. */
rg_status rg_loose_drop(rg_graph *g, rg_lines *lines)
{
    struct { int64_t sum; int32_t degree; } *at;
    unsigned char *drop;
    rg_status s = RG_MEM_ARRAYS(&g->mem, RG_ARRAY(at, (size_t)g->nv), RG_ARRAY(drop, (size_t)g->ne));
    for (int32_t e = 0; s == RG_OK && e < g->ne; e++)
        for (int i = 0; i < 2; i++) {
            if (e + RG_SOON < g->ne) rg_mem_soon(&at[g->E[e + RG_SOON].v[i]]);
            at[g->E[e].v[i]].degree++;
            at[g->E[e].v[i]].sum += e;
        }
    loose told[MOST_WARNINGS];
    int32_t count = 0, lone = 0; /* lone: vertices without an edge */
    for (int32_t v = 0; s == RG_OK && v < g->nv; v++) lone += at[v].degree == 0;
    for (int32_t start = 0; s == RG_OK && start < g->nv; start++)
        for (int32_t v = start; at[v].degree == 1;) {
            const int32_t e = (int32_t)at[v].sum, w = g->E[e].v[0] == v ? g->E[e].v[1] : g->E[e].v[0];
            drop[e] = 1;
            at[v].degree--, at[w].degree--;
            at[w].sum -= e;
            g->loose += g->E[e].assignment != RG_BORDER;
            if (count < MOST_WARNINGS) told[count] = (loose){e, v, INFINITY, INFINITY, v == start};
            count++;
            v = w;
        }
    if (s == RG_OK) s = warn_of_all_loose(g, lines, told, count);
    if (s == RG_OK && count + lone > 0) s = rg_graph_compact(g, drop);
    RG_MEM_FREE(&g->mem, at, drop);
    return s;
}
