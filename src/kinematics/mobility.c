#include "kinematics/mobility.h"
#include "linalg/qr.h"
#include "linalg/scale.h"

/* Equations of an over-constrained sheet that say the same thing twice differ by what the state is off, some 1e-13,
 * over the slowest mode; the slowest mode of a large sheet is some 1e-5. */
static const double CUT = 1e-7;

rg_status rg_mobility(const rg_mesh *m, const rg_vec2 *X, const double *rho, int32_t *ways)
{
    rg_constraint K = {0};
    rg_scale S = {0};
    int32_t rank;
    rg_status s = rg_constraint_init(&K, &m->mem, m);
    if (s == RG_OK && X) s = rg_constraint_set_pattern(&K, m, X);
    if (s == RG_OK) s = rg_scale_init(&S, &m->mem, &K.C);
    if (s == RG_OK) {
        rg_constraint_assemble(&K, rho);
        rg_scale_update(&S, &K.C);
        s = rg_qr_rank(&S.B, CUT, &rank);
    }
    if (s == RG_OK) *ways = m->N - K.stills - rank;
    rg_scale_free(&S);
    rg_constraint_free(&K);
    return s;
}
