#include "pose/pose.h"

#include <string.h>

static int32_t facet_nearest_centre(const rg_mesh *m)
{
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t v = 0; v < m->nv; v++) {
        low = (rg_vec2){fmin(low.x, m->X[v].x), fmin(low.y, m->X[v].y)};
        high = (rg_vec2){fmax(high.x, m->X[v].x), fmax(high.y, m->X[v].y)};
    }
    double least = INFINITY;
    int32_t best = 0;
    for (int32_t f = 0; f < m->nf; f++) {
        rg_vec2 sum = {0, 0};
        int32_t n = m->facet_start[f + 1] - m->facet_start[f];
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            sum.x += m->X[m->facet_vertex[j]].x / n;
            sum.y += m->X[m->facet_vertex[j]].y / n;
        }
        double d = hypot(sum.x - (low.x + high.x) / 2, sum.y - (low.y + high.y) / 2);
        if (d < least) least = d, best = f;
    }
    return best;
}

rg_status rg_tree_init(const rg_mesh *m, int32_t fixed_facet, rg_tree *t)
{
    memset(t, 0, sizeof *t);
    if (fixed_facet < -1 || fixed_facet >= m->nf) return RG_EARG;
    t->mem = m->mem;
    t->nf = m->nf;
    t->order = rg_mem_array(&m->mem, (size_t)m->nf, sizeof *t->order);
    t->via = rg_mem_array(&m->mem, (size_t)m->nf, sizeof *t->via);
    if (!t->order || !t->via) {
        rg_tree_free(t);
        return RG_ENOMEM;
    }
    const int32_t unseen = -2;
    for (int32_t f = 0; f < m->nf; f++) t->via[f] = unseen;
    int32_t first = fixed_facet < 0 ? facet_nearest_centre(m) : fixed_facet, count = 1;
    t->order[0] = first;
    t->via[first] = -1;
    for (int32_t at = 0; at < count; at++) {
        int32_t f = t->order[at];
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            int32_t e = m->facet_edge[j];
            int32_t g = m->edge_facet[e][0] == f ? m->edge_facet[e][1] : m->edge_facet[e][0];
            if (g < 0 || t->via[g] != unseen) continue;
            t->via[g] = e;
            t->order[count++] = g;
        }
    }
    return RG_OK;
}

void rg_tree_free(rg_tree *t)
{
    if (!t->mem.resize) return;
    rg_mem_free(&t->mem, t->order);
    rg_mem_free(&t->mem, t->via);
    memset(t, 0, sizeof *t);
}

/* Rotation by `angle` about the in-plane direction u (Rodrigues). */
static rg_mat3 about(rg_vec2 u, double angle)
{
    double c = cos(angle), s = sin(angle), d = 1 - c;
    return (rg_mat3){{{c + d * u.x * u.x, d * u.x * u.y, -s * u.y},
                      {d * u.x * u.y, c + d * u.y * u.y, s * u.x},
                      {s * u.y, -s * u.x, c}}};
}

static rg_vec3 put(const rg_place *p, rg_vec2 x)
{
    return rg_vec3_axpy(x.x, p->R.c[0], rg_vec3_axpy(x.y, p->R.c[1], p->t));
}

void rg_pose_facets(const rg_mesh *m, const rg_vec2 *X, const rg_tree *t, const double *rho, rg_place *place)
{
    for (int32_t at = 0; at < t->nf; at++) {
        int32_t f = t->order[at], e = t->via[f];
        if (e < 0) {
            place[f] = (rg_place){rg_mat3_identity(), {0, 0, 0}};
            continue;
        }
        /* Going from the right of the edge to its left, a valley (rho > 0) lifts the left facet: a turn by +rho about
         * the edge's direction. The other way round the edge runs backwards too, so the sign is the same. */
        int left = m->edge_facet[e][0] == f;
        const rg_place *from = &place[m->edge_facet[e][left]];
        rg_vec2 a = X[m->edge[e][!left]], u = rg_vec2_sub(X[m->edge[e][left]], a);
        double length = rg_vec2_length(u);
        u = (rg_vec2){u.x / length, u.y / length};
        place[f].R = rg_mat3_mul(from->R, about(u, rho[m->edge_crease[e]]));
        /* The hinge stays: R a + t is the same point on both sides. */
        rg_place turned = {place[f].R, {0, 0, 0}};
        place[f].t = rg_vec3_sub(put(from, a), put(&turned, a));
    }
}

void rg_pose_vertices(const rg_mesh *m, const rg_vec2 *X, const rg_tree *t, const rg_place *place, rg_vec3 *x)
{
    for (int32_t at = t->nf - 1; at >= 0; at--) { /* from the leaves, so that the facet nearest the root has the last word */
        int32_t f = t->order[at];
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
            x[m->facet_vertex[j]] = put(&place[f], X[m->facet_vertex[j]]);
    }
}

/* A new maximum, or NaN as soon as there is one. */
static double larger(double most, double value)
{
    return value <= most || isnan(most) ? most : value;
}

/* The place in the facet lists of the corner that comes after corner j, counter-clockwise, around its vertex: that of the facet
 * over the edge which arrives there; -1: outside. */
static int32_t next_corner(const rg_mesh *m, int32_t f, int32_t j, int32_t *facet)
{
    const int32_t v = m->facet_vertex[j], e = m->facet_edge[j > m->facet_start[f] ? j - 1 : m->facet_start[f + 1] - 1];
    const int32_t g = m->edge_facet[e][m->edge_facet[e][0] == f];
    if (g < 0) return -1;
    int32_t k = m->facet_start[g];
    while (m->facet_vertex[k] != v) k++;
    *facet = g;
    return k;
}

/* Every pair of facets around a vertex, also those that meet in nothing else: small gaps between neighbours add up. */
double rg_pose_gap(const rg_mesh *m, const rg_vec2 *X, const rg_place *place)
{
    double gap = 0;
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const rg_vec2 v = X[m->facet_vertex[j]];
            const rg_vec3 x = put(&place[f], v);
            int32_t g = f, k = next_corner(m, f, j, &g);
            for (; k >= 0 && g != f; k = next_corner(m, g, k, &g)) gap = larger(gap, rg_vec3_length(rg_vec3_sub(x, put(&place[g], v))));
        }
    return gap;
}

double rg_pose_strain(const rg_mesh *m, const rg_vec2 *X, const rg_vec3 *x)
{
    double worst = 0;
    for (int32_t e = 0; e < m->ne; e++) {
        int32_t a = m->edge[e][0], b = m->edge[e][1];
        double s = fabs(rg_vec3_length(rg_vec3_sub(x[b], x[a])) / rg_vec2_length(rg_vec2_sub(X[b], X[a])) - 1);
        worst = larger(worst, s);
    }
    return worst;
}
