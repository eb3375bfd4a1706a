#include "pose/lie.h"

/* Half a turn, but for rounding: which way it was made does not show. */
static const double HALF_TURN = RG_PI - 1e-6;

void rg_lie_angles(const rg_mesh *m, const rg_vec3 *x, const double *before, rg_vec3 *normal, double *rho)
{
    for (int32_t f = 0; f < m->nf; f++) normal[f] = rg_pose_normal(m, f, x);
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t e = m->crease_edge[i];
        const rg_vec3 left = normal[m->edge_facet[e][0]], right = normal[m->edge_facet[e][1]];
        const rg_vec3 along = rg_vec3_sub(x[m->edge[e][1]], x[m->edge[e][0]]);
        const double length = rg_vec3_length(along);
        const double sine = length > 0 ? -rg_vec3_dot(rg_vec3_cross(left, right), along) / length : 0;
        const double angle = atan2(sine, rg_vec3_dot(left, right));
        if (before) rho[i] = before[i] + remainder(angle - before[i], 2 * RG_PI);
        else rho[i] = fabs(angle) >= HALF_TURN && m->target[e] * angle < 0 ? -angle : angle;
    }
}

void rg_lie_facets(const rg_mesh *m, const rg_vec2 *X, const rg_vec3 *x, rg_place *place)
{
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t a = m->facet_vertex[m->facet_start[f]], b = m->facet_vertex[m->facet_start[f] + 1];
        const rg_vec2 flat = rg_vec2_sub(X[b], X[a]);
        const rg_vec3 n = rg_pose_normal(m, f, x);
        rg_vec3 e = rg_vec3_sub(x[b], x[a]);
        e = rg_vec3_axpy(-rg_vec3_dot(e, n), n, e);
        const double length = rg_vec2_length(flat), there = rg_vec3_length(e);
        const rg_vec2 u = length > 0 ? (rg_vec2){flat.x / length, flat.y / length} : (rg_vec2){1, 0};
        e = there > 0 ? rg_vec3_scale(1 / there, e) : (rg_vec3){1, 0, 0};
        const rg_vec3 side = rg_vec3_cross(n, e);
        /* The flat side u goes to e, its left to side. */
        const rg_vec3 first = rg_vec3_axpy(u.x, e, rg_vec3_scale(-u.y, side));
        const rg_mat3 R = {{first, rg_vec3_axpy(u.y, e, rg_vec3_scale(u.x, side)), n}};
        place[f] = (rg_place){R, rg_vec3_sub(x[a], rg_mat3_mul_vec(R, (rg_vec3){X[a].x, X[a].y, 0}))};
    }
}
