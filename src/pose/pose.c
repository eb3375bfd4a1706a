#include "pose/pose.h"
#include "kinematics/turn.h"

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

/* Going from the right of an edge to its left, a valley (rho > 0) lifts the left facet: a turn by +rho about the edge's
 * direction. The other way round the edge runs backwards too, so the sign is the same. */
static rg_hinge hinge_of(const rg_mesh *m, const rg_vec2 *X, int32_t f, int32_t via)
{
    if (via < 0) return (rg_hinge){f, -1, -1, {0, 0}, 0};
    int left = m->edge_facet[via][0] == f;
    rg_vec2 a = X[m->edge[via][!left]], u = rg_vec2_sub(X[m->edge[via][left]], a);
    double length = sqrt(rg_vec2_dot(u, u));
    u = (rg_vec2){u.x / length, u.y / length};
    return (rg_hinge){f, m->edge_facet[via][left], m->edge_crease[via], u, rg_vec2_cross(u, a)};
}

/* A start that is one ahead of itself while it counts ends where it has to. */
static void find_corners(const rg_mesh *m, int32_t facets, rg_tree *t)
{
    int32_t *start = t->corner_start + 1;
    for (int32_t j = 0; j < m->facet_start[m->nf]; j++) start[m->facet_vertex[j] + 1]++;
    for (int32_t v = 0; v < m->nv; v++) start[v + 1] += start[v];
    for (int32_t at = 0; at < facets; at++)
        for (int32_t f = t->order[at], j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
            t->corner_facet[start[m->facet_vertex[j]]++] = f;
}

rg_status rg_tree_init(const rg_mesh *m, int32_t fixed_facet, rg_tree *t)
{
    memset(t, 0, sizeof *t);
    if (fixed_facet < -1 || fixed_facet >= m->nf) return RG_EARG;
    t->mem = m->mem;
    t->nf = m->nf;
    t->nv = m->nv;
    const size_t nf = (size_t)m->nf;
    const rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(t->order, nf), RG_ARRAY(t->via, nf), RG_ARRAY(t->hinge, nf),
                                      RG_ARRAY(t->corner_start, (size_t)m->nv + 2),
                                      RG_ARRAY(t->corner_facet, (size_t)m->facet_start[m->nf]));
    if (s != RG_OK) return s;
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
    for (int32_t at = 0; at < count; at++) t->hinge[at] = hinge_of(m, m->X, t->order[at], t->via[t->order[at]]);
    find_corners(m, count, t);
    return RG_OK;
}

void rg_tree_free(rg_tree *t)
{
    if (!t->mem.resize) return;
    RG_MEM_FREE(&t->mem, t->order, t->via, t->hinge, t->corner_start, t->corner_facet);
    memset(t, 0, sizeof *t);
}

static rg_vec3 put(const rg_place *p, rg_vec2 x)
{
    return rg_vec3_axpy(x.x, p->R.c[0], rg_vec3_axpy(x.y, p->R.c[1], p->t));
}

/* With e = R u, m = R u turned left, n = R e_z the turn is in the plane of m and n; and the hinge stays: for a point a
 * of it R a + t is the same on both sides. */
static void over_hinge(const rg_place *from, const rg_hinge *h, double c, double s, rg_place *to)
{
    const rg_vec3 *R = from->R.c;
    const rg_vec2 u = h->u;
    const rg_vec3 e = rg_vec3_axpy(u.x, R[0], rg_vec3_scale(u.y, R[1]));
    const rg_vec3 m = rg_vec3_axpy(u.x, R[1], rg_vec3_scale(-u.y, R[0]));
    rg_vec3 turned = rg_vec3_axpy(c, m, rg_vec3_scale(s, R[2]));
    to->R.c[2] = rg_vec3_axpy(c, R[2], rg_vec3_scale(-s, m));
    to->R.c[0] = rg_vec3_axpy(u.x, e, rg_vec3_scale(-u.y, turned));
    to->R.c[1] = rg_vec3_axpy(u.y, e, rg_vec3_scale(u.x, turned));
    to->t = rg_vec3_axpy(h->across, rg_vec3_sub(m, turned), from->t);
}

void rg_pose_facets(const rg_mesh *m, const rg_vec2 *X, const rg_tree *t, const double *rho, rg_place *place)
{
    enum { TOGETHER = 64 }; /* cosines are cheaper by the dozen */
    double angle[TOGETHER] = {0}, c[TOGETHER], s[TOGETHER];
    for (int32_t first = 0; first < t->nf; first += TOGETHER) {
        const int32_t n = t->nf - first < TOGETHER ? t->nf - first : TOGETHER;
        const rg_hinge *hinge = t->hinge + first;
        for (int32_t k = 0; k < n; k++) angle[k] = hinge[k].from < 0 ? 0 : rho[hinge[k].crease];
        rg_turn_creases(TOGETHER, angle, c, s);
        for (int32_t k = 0; k < n; k++) {
            rg_hinge h = hinge[k];
            if (X != m->X) h = hinge_of(m, X, h.facet, t->via[h.facet]);
            if (h.from < 0) place[h.facet] = (rg_place){rg_mat3_identity(), {0, 0, 0}};
            else over_hinge(&place[h.from], &h, c[k], s[k], &place[h.facet]);
        }
    }
}

void rg_pose_vertices(const rg_mesh *m, const rg_vec2 *X, const rg_tree *t, const rg_place *place, rg_vec3 *x)
{
    for (int32_t v = 0; v < m->nv; v++)
        if (t->corner_start[v] < t->corner_start[v + 1]) x[v] = put(&place[t->corner_facet[t->corner_start[v]]], X[v]);
}

/* A new maximum, or NaN as soon as there is one. */
static double larger(double most, double value)
{
    return value <= most || isnan(most) ? most : value;
}

/* Every pair of facets around a vertex, also those that meet in nothing else: small gaps between neighbours add up.
 * Pairs are looked at only where the gaps to the first facet leave room for one that is larger than all so far. */
double rg_pose_gap(const rg_vec2 *X, const rg_tree *t, const rg_place *place)
{
    double gap = 0; /* squared */
    for (int32_t v = 0; v < t->nv; v++) {
        const int32_t *facet = t->corner_facet + t->corner_start[v], n = t->corner_start[v + 1] - t->corner_start[v];
        double from_first = 0;
        for (int32_t a = 1; a < n; a++) {
            const rg_vec3 d = rg_vec3_sub(put(&place[facet[a]], X[v]), put(&place[facet[0]], X[v]));
            from_first = larger(from_first, rg_vec3_dot(d, d));
        }
        if (4 * from_first <= gap) continue;
        gap = larger(gap, from_first);
        for (int32_t a = 1; a < n; a++)
            for (int32_t b = 1; b < a; b++) {
                const rg_vec3 d = rg_vec3_sub(put(&place[facet[a]], X[v]), put(&place[facet[b]], X[v]));
                gap = larger(gap, rg_vec3_dot(d, d));
            }
    }
    return sqrt(gap);
}

double rg_pose_strain(const rg_mesh *m, const rg_vec2 *X, const rg_vec3 *x)
{
    double worst = 0;
    for (int32_t e = 0; e < m->ne; e++) {
        int32_t a = m->edge[e][0], b = m->edge[e][1];
        rg_vec2 d = rg_vec2_sub(X[b], X[a]);
        double s = fabs(rg_vec3_length(rg_vec3_sub(x[b], x[a])) / sqrt(rg_vec2_dot(d, d)) - 1);
        worst = larger(worst, s);
    }
    return worst;
}

rg_vec3 rg_pose_area(const rg_mesh *m, int32_t f, const rg_vec3 *x)
{
    const int32_t first = m->facet_start[f], last = m->facet_start[f + 1];
    const rg_vec3 base = x[m->facet_vertex[first]];
    rg_vec3 n = {0, 0, 0};
    for (int32_t j = first + 1; j + 1 < last; j++)
        n = rg_vec3_add(n, rg_vec3_cross(rg_vec3_sub(x[m->facet_vertex[j]], base),
                                         rg_vec3_sub(x[m->facet_vertex[j + 1]], base)));
    return rg_vec3_scale(0.5, n);
}

rg_vec3 rg_pose_normal(const rg_mesh *m, int32_t f, const rg_vec3 *x)
{
    const rg_vec3 n = rg_pose_area(m, f, x);
    const double length = rg_vec3_length(n);
    return length > 0 ? rg_vec3_scale(1 / length, n) : (rg_vec3){0, 0, 1};
}
