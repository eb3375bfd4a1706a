#include "kinematics/mobility.h"
#include "linalg/qr.h"
#include "linalg/scale.h"

/* Equations of an over-constrained sheet that say the same thing twice differ by what the state is off, some 1e-13, over the
 * slowest mode; the slowest mode of a large sheet is some 1e-5. */
static const double CUT = 1e-7;

static rg_status set_pattern(rg_constraint *K, const rg_mesh *m, const rg_vec2 *X)
{
    double *theta = rg_mem_array(&m->mem, (size_t)m->loop_start[m->M], sizeof *theta);
    if (!theta) return RG_ENOMEM;
    for (int32_t k = 0; k < m->M; k++) {
        const int32_t first = m->loop_start[k], last = m->loop_start[k + 1], v = m->inner_vertex[k];
        for (int32_t j = first; j < last; j++) {
            const int32_t *e = m->edge[m->crease_edge[m->loop_crease[j]]];
            const int32_t *g = m->edge[m->crease_edge[m->loop_crease[j + 1 < last ? j + 1 : first]]];
            const rg_vec2 a = rg_vec2_sub(X[e[e[0] == v]], X[v]), b = rg_vec2_sub(X[g[g[0] == v]], X[v]);
            theta[j] = atan2(rg_vec2_cross(a, b), rg_vec2_dot(a, b));
        }
    }
    rg_constraint_set_theta(K, theta);
    rg_mem_free(&m->mem, theta);
    return RG_OK;
}

rg_status rg_mobility(const rg_mesh *m, const rg_vec2 *X, const double *rho, int32_t *ways)
{
    rg_constraint K = {0};
    rg_scale S = {0};
    int32_t rank;
    rg_status s = rg_qr_built() ? rg_constraint_init(&K, &m->mem, m) : RG_EABSENT;
    if (s == RG_OK && X) s = set_pattern(&K, m, X);
    if (s == RG_OK) s = rg_scale_init(&S, &m->mem, &K.C);
    if (s == RG_OK) {
        rg_constraint_assemble(&K, rho);
        rg_scale_update(&S, &K.C);
        s = rg_qr_rank(&S.B, CUT, &rank);
    }
    if (s == RG_OK) *ways = m->N - rank;
    rg_scale_free(&S);
    rg_constraint_free(&K);
    return s;
}
