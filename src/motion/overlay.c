#include "motion/overlay.h"
#include "pattern/build.h"
#include "base/status.h"

#include <string.h>

/* An added crease bent by less than this, radians, is as good as flat. */
static const double BENT = 1e-9;

rg_status rg_overlay_draw(rg_lines *l, const rg_mesh *m, int added_only, const double *rho)
{
    rg_status s = RG_OK;
    for (int32_t e = 0; s == RG_OK && e < m->ne; e++) {
        const int32_t i = m->edge_crease[e];
        if (added_only && i < m->N - m->added) continue;
        if (added_only && rho && !(fabs(rho[i]) > BENT)) continue;
        s = rg_lines_add(l, m->X[m->edge[e][0]], m->X[m->edge[e][1]], i < 0 ? RG_BORDER : RG_UNASSIGNED, 0);
    }
    return s;
}

rg_status rg_overlay_mesh(rg_lines *l, double merge, rg_mesh *m, rg_diag *why)
{
    rg_reading reading = rg_reading_default();
    const rg_memory mem = l->mem;
    rg_pattern *p = NULL;
    memset(m, 0, sizeof *m);
    reading.merge = merge;
    rg_status s = rg_pattern_from_lines(l, &reading, &p, why);
    if (s == RG_OK) s = rg_mesh_from_pattern(p, &mem, m, why);
    rg_pattern_destroy(p);
    return s;
}

/* ------------------------------------------------------------------------------------------------- places ---- */

static int at_vertex(const rg_mesh *m, rg_vec2 x, double tol, rg_spot *spot)
{
    double nearest = tol;
    for (int32_t v = 0; v < m->nv; v++) {
        const double d = rg_vec2_length(rg_vec2_sub(m->X[v], x));
        if (!(d <= nearest)) continue;
        nearest = d;
        *spot = (rg_spot){1, {v, -1, -1}, {1, 0, 0}};
    }
    return spot->n > 0;
}

static int on_edge(const rg_mesh *m, rg_vec2 x, double tol, rg_spot *spot)
{
    double nearest = tol;
    for (int32_t e = 0; e < m->ne; e++) {
        const rg_vec2 a = m->X[m->edge[e][0]], along = rg_vec2_sub(m->X[m->edge[e][1]], a), to = rg_vec2_sub(x, a);
        const double length = rg_vec2_length(along), part = rg_vec2_dot(along, to) / (length * length);
        const double off = fabs(rg_vec2_cross(along, to)) / length;
        if (!(off <= nearest && part > 0 && part < 1)) continue;
        nearest = off;
        *spot = (rg_spot){2, {m->edge[e][0], m->edge[e][1], -1}, {1 - part, part, 0}};
    }
    return spot->n > 0;
}

/* The triangle that x is deepest in. */
static void in_triangle(const rg_mesh *m, rg_vec2 x, rg_spot *spot)
{
    double deepest = -INFINITY;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t *v = m->facet_vertex + m->facet_start[f];
        const rg_vec2 a = m->X[v[0]], b = m->X[v[1]], c = m->X[v[2]];
        const double all = rg_vec2_turn(a, b, c);
        const double w[3] = {rg_vec2_turn(x, b, c) / all, rg_vec2_turn(a, x, c) / all, rg_vec2_turn(a, b, x) / all};
        const double depth = fmin(w[0], fmin(w[1], w[2]));
        if (!(depth > deepest)) continue;
        deepest = depth;
        *spot = (rg_spot){3, {v[0], v[1], v[2]}, {w[0], w[1], w[2]}};
    }
}

/* The crease of the coarse mesh that has both spots on it, -1: none. */
static int32_t shared(const rg_mesh *m, const int32_t *start, const int32_t *edge, const rg_spot *a, const rg_spot *b)
{
    int32_t end[2] = {a->at[0], -1};
    for (int32_t i = 1; i < a->n + b->n; i++) {
        const int32_t v = i < a->n ? a->at[i] : b->at[i - a->n];
        if (v == end[0] || v == end[1]) continue;
        if (end[1] >= 0) return -1;
        end[1] = v;
    }
    for (int32_t j = start[end[0]]; j < start[end[0] + 1]; j++) {
        const int32_t *v = m->edge[edge[j]];
        if (end[1] >= 0 && (v[0] == end[1] || v[1] == end[1])) return m->edge_crease[edge[j]];
    }
    return -1;
}

/* Edges of each vertex: edge[start[v]] ... edge[start[v + 1] - 1]. start[nv + 2], edge[2 ne]: out. */
static void stars(const rg_mesh *m, int32_t *start, int32_t *edge)
{
    for (int32_t e = 0; e < m->ne; e++)
        for (int k = 0; k < 2; k++) start[m->edge[e][k] + 2]++;
    for (int32_t v = 0; v < m->nv; v++) start[v + 2] += start[v + 1];
    for (int32_t e = 0; e < m->ne; e++)
        for (int k = 0; k < 2; k++) edge[start[m->edge[e][k] + 1]++] = e;
}

rg_status rg_overlay_init(rg_overlay *o, const rg_mesh *fine, const rg_mesh *coarse, double tol)
{
    const rg_memory *mem = &fine->mem;
    rg_mesh triangles; /* numbers old edges and creases as `coarse` does */
    memset(o, 0, sizeof *o);
    rg_status s = rg_triangulate_all(coarse, &triangles);
    if (s != RG_OK) return s;
    o->mem = *mem;
    o->nv = fine->nv;
    o->N = fine->N;
    int32_t *start, *edge;
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(start, (size_t)coarse->nv + 2), RG_ARRAY(edge, 2 * (size_t)triangles.ne),
                      RG_ARRAY(o->spot, (size_t)fine->nv), RG_ARRAY(o->crease, (size_t)fine->N));
    for (int32_t v = 0; s == RG_OK && v < fine->nv; v++)
        if (!at_vertex(coarse, fine->X[v], tol, &o->spot[v]) && !on_edge(coarse, fine->X[v], tol, &o->spot[v]))
            in_triangle(&triangles, fine->X[v], &o->spot[v]);
    if (s == RG_OK) stars(&triangles, start, edge);
    for (int32_t i = 0; s == RG_OK && i < fine->N; i++) {
        const int32_t *v = fine->edge[fine->crease_edge[i]];
        const int32_t c = shared(&triangles, start, edge, &o->spot[v[0]], &o->spot[v[1]]);
        o->crease[i] = c < coarse->N ? c : -1;
    }
    RG_MEM_FREE(mem, start, edge);
    rg_mesh_free(&triangles);
    return s;
}

void rg_overlay_free(rg_overlay *o)
{
    if (!o->mem.resize) return;
    RG_MEM_FREE(&o->mem, o->spot, o->crease);
    memset(o, 0, sizeof *o);
}

void rg_overlay_angles(const rg_overlay *o, const double *of_coarse, double *of_fine)
{
    for (int32_t i = 0; i < o->N; i++) of_fine[i] = o->crease[i] < 0 ? 0 : of_coarse[o->crease[i]];
}

void rg_overlay_points(const rg_overlay *o, const rg_vec2 *coarse, rg_vec2 *X)
{
    for (int32_t v = 0; v < o->nv; v++) {
        const rg_spot *p = &o->spot[v];
        X[v] = p->n == 1 ? coarse[p->at[0]] : (rg_vec2){0, 0};
        for (int32_t i = 0; p->n > 1 && i < p->n; i++) {
            X[v].x += p->weight[i] * coarse[p->at[i]].x;
            X[v].y += p->weight[i] * coarse[p->at[i]].y;
        }
    }
}
