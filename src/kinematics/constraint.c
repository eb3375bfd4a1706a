#include "kinematics/constraint.h"

#include <string.h>

rg_status rg_constraint_init(rg_constraint *K, const rg_memory *mem, const rg_mesh *m)
{
    memset(K, 0, sizeof *K);
    rg_status s = rg_sparse_init(&K->C, mem, m->M, m->N, m->loop_start, m->loop_crease);
    if (s != RG_OK) return s;
    K->mem = *mem;
    int32_t blocks = m->loop_start[m->M];
    K->r = rg_mem_array(mem, 3 * (size_t)m->M, sizeof *K->r);
    K->theta = rg_mem_array(mem, (size_t)blocks, sizeof *K->theta);
    K->rho = rg_mem_array(mem, (size_t)m->N, sizeof *K->rho);
    if (!K->r || !K->theta || !K->rho) {
        rg_constraint_free(K);
        return RG_ENOMEM;
    }
    for (int32_t j = 0; j < blocks; j++) K->theta[j] = (rg_turn){cos(m->loop_theta[j]), sin(m->loop_theta[j])};
    return RG_OK;
}

void rg_constraint_free(rg_constraint *K)
{
    if (!K->mem.resize) return;
    rg_memory mem = K->mem;
    rg_sparse_free(&K->C);
    rg_mem_free(&mem, K->r);
    rg_mem_free(&mem, K->theta);
    rg_mem_free(&mem, K->rho);
    memset(K, 0, sizeof *K);
}

static void turn_creases(rg_constraint *K, const double *rho)
{
    for (int32_t i = 0; i < K->C.N; i++) K->rho[i] = (rg_turn){cos(rho[i]), sin(rho[i])};
}

/* A maximum that a NaN wins. */
static double larger(double a, double b)
{
    return b <= a || isnan(a) ? a : b;
}

double rg_constraint_assemble(rg_constraint *K, const double *rho)
{
    rg_sparse *C = &K->C;
    double worst = 0;
    turn_creases(K, rho);
    for (int32_t k = 0; k < C->M; k++) { /* rows of C_k: eqs. (6), (7); one below the other: eq. (8) */
        int32_t j = C->start[k];
        rg_mat3 F = rg_loop_walk(C->start[k + 1] - j, C->col + j, K->rho, K->theta + j, C->x + j);
        rg_vec3 r = rg_loop_residual(F);
        K->r[3 * k] = r.x; /* eq. (12) */
        K->r[3 * k + 1] = r.y;
        K->r[3 * k + 2] = r.z;
        worst = larger(worst, rg_loop_angle(F));
    }
    return worst;
}

double rg_constraint_closure(rg_constraint *K, const double *rho, int32_t *at)
{
    const rg_sparse *C = &K->C;
    double worst = 0;
    if (at) *at = -1;
    turn_creases(K, rho);
    for (int32_t k = 0; k < C->M; k++) {
        int32_t j = C->start[k];
        double angle = rg_loop_angle(rg_loop_walk(C->start[k + 1] - j, C->col + j, K->rho, K->theta + j, NULL));
        if (angle <= worst) continue;
        worst = angle;
        if (at) *at = k;
        if (isnan(angle)) break;
    }
    return worst;
}
