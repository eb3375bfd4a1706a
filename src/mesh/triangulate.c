#include "base/memory.h"
#include "mesh/connect.h"
#include "mesh/inside.h"
#include "mesh/polygon.h"

#include <string.h>

/* An ear with an angle of a smaller sine is a sliver, whose hinges are ill-conditioned: taken only where there is no
 * other. An ear at an inside angle waits even longer, for one that leaves it to be split. */
static const double SLIVER = 0.02, OF_SLIVER = 1e6, OF_INSIDE = 1e20;

/* Of cutting off that corner; short diagonals first, as they bend a facet least. INFINITY: not possible. */
static double score(const rg_polygon *p, int32_t i)
{
    const int32_t before = (i + p->n - 1) % p->n, after = (i + 1) % p->n;
    const double least = rg_polygon_least_sine(p, before, i, after);
    if (!(least > 0)) return INFINITY;
    const double diagonal = rg_vec2_length(rg_vec2_sub(p->X[p->v[after]], p->X[p->v[before]]));
    return (least >= SLIVER ? diagonal : OF_SLIVER * diagonal / least) * (p->inside[i] ? OF_INSIDE : 1);
}

static int32_t best_ear(const rg_polygon *p, const double *of)
{
    int32_t best = -1;
    for (int32_t i = 0; i < p->n; i++)
        if (of[i] < INFINITY && (best < 0 || of[i] < of[best])) best = i;
    return best;
}

static void remove_corner(rg_polygon *p, double *of, int32_t i, int32_t diagonal)
{
    p->e[(i + p->n - 1) % p->n] = diagonal;
    const size_t rest = (size_t)(p->n - i - 1);
    memmove(p->v + i, p->v + i + 1, rest * sizeof *p->v);
    memmove(p->e + i, p->e + i + 1, rest * sizeof *p->e);
    memmove(p->inside + i, p->inside + i + 1, rest);
    memmove(of + i, of + i + 1, rest * sizeof *of);
    p->n--;
}

static void put_ear(rg_mesh *m, const rg_polygon *p, int32_t i, int32_t diagonal)
{
    const int32_t before = (i + p->n - 1) % p->n, after = (i + 1) % p->n;
    rg_polygon_add_triangle(m, (int32_t[]){p->v[before], p->v[i], p->v[after]}, (int32_t[]){p->e[before], p->e[i], diagonal});
}

/* What is left of a facet, as a facet. */
static void put_rest(rg_mesh *m, const rg_polygon *p)
{
    const int32_t at = m->facet_start[m->nf];
    memcpy(m->facet_vertex + at, p->v, (size_t)p->n * sizeof *p->v);
    memcpy(m->facet_edge + at, p->e, (size_t)p->n * sizeof *p->e);
    m->facet_start[++m->nf] = at + p->n;
}

/* Cuts off ears until a triangle is left. A facet whose corners lie so close to one line that no ear can be told from a
 * sliver without area stays as it is: it is planar and needs no added crease. */
static void cut_ears(rg_mesh *m, rg_polygon *p, double *of)
{
    for (int32_t i = 0; i < p->n; i++) of[i] = score(p, i);
    while (p->n > 3) {
        int32_t ear = best_ear(p, of);
        if (ear < 0) { /* a corner that was cut off may have been in the way of another ear */
            for (int32_t i = 0; i < p->n; i++) of[i] = score(p, i);
            ear = best_ear(p, of);
        }
        if (ear < 0) break;
        const int32_t before = (ear + p->n - 1) % p->n, after = (ear + 1) % p->n;
        const int32_t diagonal = rg_polygon_add_diagonal(m, p->v[after], p->v[before]);
        p->inside[before] = p->inside[after] = 0;
        put_ear(m, p, ear, diagonal);
        remove_corner(p, of, ear, diagonal);
        const int32_t left = (ear + p->n - 1) % p->n, right = ear % p->n;
        of[left] = score(p, left);
        of[right] = score(p, right);
    }
    put_rest(m, p);
}

static void cut_facets(const rg_mesh *m, int split, const unsigned char *which, unsigned char *inside, rg_polygon *p,
                       rg_polygon_work *w, double *of, rg_mesh *out)
{
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t first = m->facet_start[f];
        p->n = m->facet_start[f + 1] - first;
        p->inside = inside + first;
        memcpy(p->v, m->facet_vertex + first, (size_t)p->n * sizeof *p->v);
        memcpy(p->e, m->facet_edge + first, (size_t)p->n * sizeof *p->e);
        if (which && !which[f]) put_rest(out, p);
        else if (!split || !rg_polygon_cut(p, w, out)) cut_ears(out, p, of);
    }
}

static rg_status cut_all(const rg_mesh *m, int split, const unsigned char *which, int32_t most, rg_mesh *out)
{
    const size_t n = (size_t)most, table = (size_t)(most < RG_POLYGON_LARGEST ? most : RG_POLYGON_LARGEST);
    unsigned char *inside = rg_mem_array(&m->mem, (size_t)m->facet_start[m->nf], 1);
    double *of = rg_mem_array(&m->mem, n, sizeof *of);
    rg_polygon p = {.X = out->X, .v = rg_mem_array(&m->mem, n, sizeof *p.v), .e = rg_mem_array(&m->mem, n, sizeof *p.e)};
    rg_polygon_work w = {rg_mem_array(&m->mem, table * table, sizeof *w.cost), rg_mem_array(&m->mem, table * table, sizeof *w.apex)};
    rg_status s = inside && of && p.v && p.e && w.cost && w.apex ? RG_OK : RG_ENOMEM;
    if (s == RG_OK && split) s = rg_inside_find(m, inside);
    if (s == RG_OK) cut_facets(m, split, which, inside, &p, &w, of, out);
    void *block[] = {inside, of, p.v, p.e, w.cost, w.apex};
    for (int i = 0; i < 6; i++) rg_mem_free(&m->mem, block[i]);
    return s;
}

static rg_status triangulate(const rg_mesh *m, int split, const unsigned char *which, rg_mesh *out)
{
    int32_t most = 3, more = 0;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t n = m->facet_start[f + 1] - m->facet_start[f];
        most = n > most ? n : most;
        more += n - 3;
    }
    const size_t ne = (size_t)m->ne + (size_t)more, nf = (size_t)m->nf + (size_t)more, corners = 3 * nf;
    memset(out, 0, sizeof *out);
    out->mem = m->mem;
    out->size = m->size;
    out->nv = m->nv;
    out->ne = m->ne;
    out->added = m->added;
    out->X = rg_mem_array(&m->mem, (size_t)m->nv, sizeof *out->X);
    out->edge = rg_mem_array(&m->mem, ne, sizeof *out->edge);
    out->assignment = rg_mem_array(&m->mem, ne, 1);
    out->target = rg_mem_array(&m->mem, ne, sizeof *out->target);
    out->facet_start = rg_mem_array(&m->mem, nf + 1, sizeof *out->facet_start);
    out->facet_vertex = rg_mem_array(&m->mem, corners, sizeof *out->facet_vertex);
    out->facet_edge = rg_mem_array(&m->mem, corners, sizeof *out->facet_edge);
    rg_status s = RG_ENOMEM;
    if (out->X && out->edge && out->assignment && out->target && out->facet_start && out->facet_vertex && out->facet_edge) {
        memcpy(out->X, m->X, (size_t)m->nv * sizeof *out->X);
        memcpy(out->edge, m->edge, (size_t)m->ne * sizeof *out->edge);
        memcpy(out->assignment, m->assignment, (size_t)m->ne);
        memcpy(out->target, m->target, (size_t)m->ne * sizeof *out->target);
        s = cut_all(m, split, which, most, out);
    }
    if (s == RG_OK) s = rg_mesh_connect(out);
    if (s != RG_OK) rg_mesh_free(out);
    return s;
}

rg_status rg_triangulate_all(const rg_mesh *m, rg_mesh *out) { return triangulate(m, 1, NULL, out); }

rg_status rg_triangulate_short(const rg_mesh *m, rg_mesh *out) { return triangulate(m, 0, NULL, out); }

rg_status rg_triangulate_some(const rg_mesh *m, const unsigned char *which, int shorter, rg_mesh *out)
{
    return triangulate(m, !shorter, which, out);
}
