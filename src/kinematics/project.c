#include "kinematics/project.h"

#include <string.h>

/* Block-Jacobi CG needs about 0.7 n^2 iterations on an n x n sheet, that is some 0.2 N; the cap only ends what will
 * never end. */
static const int32_t ITERATIONS_PER_CREASE = 4;
static const int32_t ITERATIONS_AT_LEAST = 2000;
/* Above this many creases a sparse factorisation beats the iteration (it is even between 176 and 736). */
static const int32_t CHOLESKY_FROM = 400;

rg_status rg_project_init(rg_project *P, const rg_memory *mem, const rg_constraint *K, rg_solver solver)
{
    const int32_t M = K->C.M, N = K->C.N;
    memset(P, 0, sizeof *P);
    P->mem = *mem;
    if (solver == RG_SOLVER_AUTO) solver = N >= CHOLESKY_FROM && rg_cholesky_built() ? RG_SOLVER_CHOLESKY : RG_SOLVER_CG;
    P->solver = solver;
    rg_status s = rg_jacobi_init(&P->jacobi, mem, M);
    if (s == RG_OK) s = rg_cg_work_init(&P->cg, mem, M, N);
    if (s == RG_OK && solver == RG_SOLVER_CHOLESKY) s = rg_cholesky_init(&P->cholesky, mem, &K->C);
    if (s == RG_OK && solver == RG_SOLVER_SVD) s = rg_pinv_init(&P->pinv, mem, M, N);
    P->b = rg_mem_array(mem, 3 * (size_t)M, sizeof *P->b);
    P->y = rg_mem_array(mem, 3 * (size_t)M, sizeof *P->y);
    P->x = rg_mem_array(mem, (size_t)N, sizeof *P->x);
    if (s == RG_OK && (!P->b || !P->y || !P->x)) s = RG_ENOMEM;
    if (s != RG_OK) rg_project_free(P);
    return s;
}

void rg_project_free(rg_project *P)
{
    if (!P->mem.resize) return;
    rg_memory mem = P->mem;
    rg_jacobi_free(&P->jacobi);
    rg_cholesky_free(&P->cholesky);
    rg_pinv_free(&P->pinv);
    rg_cg_work_free(&P->cg);
    rg_mem_free(&mem, P->b);
    rg_mem_free(&mem, P->y);
    rg_mem_free(&mem, P->x);
    memset(P, 0, sizeof *P);
}

void rg_project_renew(rg_project *P)
{
    P->fresh = 0;
}

static rg_status renew(rg_project *P, const rg_constraint *K, const double *hold)
{
    rg_status s = RG_OK;
    if (P->fresh && (P->solver != RG_SOLVER_SVD || P->held == hold)) return s;
    P->held = hold;
    if (P->solver == RG_SOLVER_SVD) s = rg_pinv_update(&P->pinv, &K->C, hold);
    else rg_jacobi_update(&P->jacobi, &K->C);
    if (P->solver == RG_SOLVER_CHOLESKY) s = rg_cholesky_update(&P->cholesky, &K->C);
    if (P->solver != RG_SOLVER_CG) P->factorizations++;
    P->fresh = s == RG_OK;
    return s;
}

rg_status rg_project_step(rg_project *P, const rg_constraint *K, const double *drho0, int feed,
                          const double *hold, double *drho, double tol, rg_cg_report *rep)
{
    const int32_t M = K->C.M, N = K->C.N;
    rg_status s = renew(P, K, hold);
    if (s != RG_OK) return s;

    if (drho0) rg_sparse_mul(&K->C, drho0, P->b);
    else memset(P->b, 0, 3 * (size_t)M * sizeof *P->b);
    if (feed)
        for (int32_t i = 0; i < 3 * M; i++) P->b[i] += K->r[i]; /* b = r + C drho0              eq. (14) */

    if (P->solver == RG_SOLVER_SVD) {
        rg_pinv_apply(&P->pinv, P->b, P->x, P->y);
        *rep = (rg_cg_report){RG_CG_CONVERGED, 0, 0, 0};
    } else {
        int32_t most = ITERATIONS_PER_CREASE * N > ITERATIONS_AT_LEAST ? ITERATIONS_PER_CREASE * N : ITERATIONS_AT_LEAST;
        int direct = P->solver == RG_SOLVER_CHOLESKY;
        rg_cg_solve(&K->C, direct ? rg_cholesky_apply : rg_jacobi_apply, direct ? (const void *)&P->cholesky : &P->jacobi,
                    hold, P->b, P->y, P->x, tol, most, &P->cg, rep); /* y = (C C^T) \ b, x = C^T y          eq. (15) */
    }
    for (int32_t i = 0; i < N; i++) drho[i] = (drho0 ? drho0[i] : 0) - P->x[i]; /* drho0 - C^+ (r + C drho0)   eqs. (9), (15) */
    P->solves++;
    P->iterations += rep->iterations;
    return RG_OK;
}
