#include "kinematics/project.h"
#include "base/lanes.h"

#include <string.h>

/* Block-Jacobi CG needs about 0.7 n^2 iterations on an n x n sheet, that is some 0.2 N; the cap only ends what will
 * never end. */
static const int32_t ITERATIONS_PER_CREASE = 4;
static const int32_t ITERATIONS_AT_LEAST = 2000;
/* From this many creases on a sparse factorisation beats the iteration. */
static const int32_t CHOLESKY_FROM = 16;
/* The part of what is held that the sheet can do; below this it is rounding. */
static const double LEAST_LEFT = 1e-9;
/* A factor of the same numbers takes a few iterations, one of others soon more than a new one would cost. */
static const int32_t DIRECT_ITERATIONS = 200, STALE_ITERATIONS = 12;

rg_status rg_project_init(rg_project *P, const rg_memory *mem, const rg_constraint *K, rg_solver solver)
{
    const int32_t M = K->C.M, N = K->C.N;
    memset(P, 0, sizeof *P);
    P->mem = *mem;
    if (solver == RG_SOLVER_AUTO) solver = N >= CHOLESKY_FROM ? RG_SOLVER_CHOLESKY : RG_SOLVER_CG;
    P->solver = solver;
    rg_status s = rg_jacobi_init(&P->jacobi, mem, M);
    if (s == RG_OK) s = rg_cg_work_init(&P->cg, mem, M, N);
    if (s == RG_OK) s = rg_scale_init(&P->scale, mem, &K->C);
    if (s == RG_OK && solver == RG_SOLVER_CHOLESKY) s = rg_cholesky_init(&P->cholesky, mem, &K->C, RG_SHAPE_AUTO);
    if (s == RG_OK && solver == RG_SOLVER_SVD) s = rg_pinv_init(&P->pinv, mem, M, N);
    if (s == RG_OK) s = RG_MEM_ARRAYS(mem, RG_ARRAY(P->b, 3 * (size_t)M), RG_ARRAY(P->y, 3 * (size_t)M),
                                      RG_ARRAY(P->x, (size_t)N), RG_ARRAY(P->u, 3 * (size_t)M),
                                      RG_ARRAY(P->q, (size_t)N));
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
    rg_scale_free(&P->scale);
    RG_MEM_FREE(&mem, P->b, P->y, P->x, P->u, P->q);
    memset(P, 0, sizeof *P);
}

void rg_project_renew(rg_project *P)
{
    P->fresh = P->factored = P->stale = 0;
}

void rg_project_renew_near(rg_project *P)
{
    P->fresh = 0;
    P->stale = P->factored;
}

/* With more equations than creases it is the exception that a step can be taken at all: n is in the row space of B but
 * for beta, and 1 - v.u below is all rounding. By columns that case is like any other. */
static int by_columns(const rg_project *P)
{
    return P->held && P->cholesky.shape == RG_SHAPE_COLUMNS && P->scale.B.N <= 3 * P->scale.B.M;
}

/* z = B^T P r. With n held, B (I - n n^T) takes the place of B, and P + u u^T / (1 - v.u) that of P, v = B n, u = P v;
 * or by columns, A = B^T B + beta I, z = A \ B^T r less the multiple of q = A \ n that makes it orthogonal to n. */
static void pinv_held(void *project, const double *r, double *z)
{
    rg_project *P = project;
    const int32_t M = P->scale.B.M, N = P->scale.B.N;
    double *y = P->y;
    if (by_columns(P)) {
        rg_sparse_mul_t(&P->scale.B, r, z);
        rg_cholesky_solve(&P->cholesky, z);
        double c = rg_lanes_dot(N, P->held, z) / P->left;
        for (int32_t i = 0; i < N; i++) z[i] -= c * P->q[i];
        return;
    }
    rg_cholesky_apply(&P->cholesky, r, y);
    if (P->held) {
        double c = rg_lanes_dot(3 * M, P->u, r) / P->left;
        rg_lanes_add(3 * M, c, P->u, y);
    }
    rg_sparse_mul_t(&P->scale.B, y, z);
    if (!P->held) return;
    double along = rg_lanes_dot(N, P->held, z);
    rg_lanes_add(N, -along, P->held, z);
}

static void hold_on(rg_project *P, const double *hold)
{
    P->held = hold;
    if (!hold || P->u_of == hold) return;
    P->u_of = hold;
    if (by_columns(P)) {
        memcpy(P->q, hold, (size_t)P->scale.B.N * sizeof *hold);
        rg_cholesky_solve(&P->cholesky, P->q);
        P->left = rg_lanes_dot(P->scale.B.N, hold, P->q);
        return;
    }
    rg_sparse_mul(&P->cholesky.B, hold, P->y);
    rg_cholesky_apply(&P->cholesky, P->y, P->u);
    P->left = fmax(1 - rg_lanes_dot(3 * P->scale.B.M, P->y, P->u), LEAST_LEFT);
}

static rg_status factor(rg_project *P, const double *hold)
{
    rg_status s = RG_OK;
    if (P->solver == RG_SOLVER_SVD) s = rg_pinv_update(&P->pinv, &P->scale.B, hold);
    else rg_cholesky_update(&P->cholesky, &P->scale.B);
    P->factorizations++;
    P->factored = s == RG_OK;
    P->stale = 0;
    P->u_of = NULL;
    P->held = P->solver == RG_SOLVER_SVD ? hold : NULL;
    return s;
}

static rg_status prepare(rg_project *P, const rg_constraint *K, const double *hold)
{
    rg_status s = RG_OK;
    if (!P->fresh && P->solver == RG_SOLVER_CG) rg_jacobi_update(&P->jacobi, &K->C);
    else if (!P->fresh) rg_scale_update(&P->scale, &K->C);
    P->fresh = 1;
    if (P->solver == RG_SOLVER_CG) return s;
    if (!P->factored || (P->solver == RG_SOLVER_SVD && (P->stale || P->held != hold))) s = factor(P, hold);
    if (s == RG_OK && P->solver == RG_SOLVER_CHOLESKY && P->held != hold) hold_on(P, hold);
    return s;
}

/* x = B^+ b, orthogonal to hold. */
static rg_status solve_direct(rg_project *P, const double *hold, const double *b, double *x, double relative,
                              double absolute, rg_cg_report *rep)
{
    rg_cg_refine(&P->scale.B, pinv_held, P, b, x, relative, absolute, P->stale ? STALE_ITERATIONS : DIRECT_ITERATIONS,
                 &P->cg, rep);
    P->iterations += rep->iterations;
    if (!P->stale || rep->stop == RG_CG_CONVERGED) return RG_OK;
    rg_status s = factor(P, hold);
    if (s != RG_OK) return s;
    hold_on(P, hold);
    rg_cg_refine(&P->scale.B, pinv_held, P, b, x, relative, absolute, DIRECT_ITERATIONS, &P->cg, rep);
    P->iterations += rep->iterations;
    return RG_OK;
}

/* x = C^+ b, orthogonal to hold, with b in P->b and y in P->y. */
static rg_status solve_any(rg_project *P, const rg_constraint *K, const double *hold, double *x, double relative,
                           double absolute, rg_cg_report *rep)
{
    if (P->solver == RG_SOLVER_CG) {
        const int32_t many = ITERATIONS_PER_CREASE * K->C.N;
        const int32_t most = many > ITERATIONS_AT_LEAST ? many : ITERATIONS_AT_LEAST;
        rg_cg_solve(&K->C, rg_jacobi_apply, &P->jacobi, hold, P->b, P->y, x, relative, most, /* eq. (15) */
                    &P->cg, rep);
        P->iterations += rep->iterations;
        return RG_OK;
    }
    rg_scale_rows(&P->scale, P->b);
    if (P->solver == RG_SOLVER_CHOLESKY) return solve_direct(P, hold, P->b, x, relative, absolute, rep);
    rg_pinv_apply(&P->pinv, P->b, x, P->y);
    rg_scale_rows_t(&P->scale, P->y);
    *rep = (rg_cg_report){RG_CG_CONVERGED, 0};
    return RG_OK;
}

static rg_status step(rg_project *P, const rg_constraint *K, const double *drho0, int feed, const double *hold,
                      double *drho, double tol, rg_cg_report *rep)
{
    const int32_t M = K->C.M, N = K->C.N;
    if (drho0) rg_sparse_mul(&K->C, drho0, P->b);
    else memset(P->b, 0, 3 * (size_t)M * sizeof *P->b);
    if (feed)
        for (int32_t i = 0; i < 3 * M; i++) P->b[i] += K->r[i]; /* b = r + C drho0              eq. (14) */
    rg_status s = solve_any(P, K, hold, P->x, tol, 0, rep);      /* x = C^+ b                             */
    for (int32_t i = 0; i < N; i++)
        drho[i] = (drho0 ? drho0[i] : 0) - P->x[i]; /* drho0 - C^+ (r + C drho0)   eqs. (9), (15) */
    return s;
}

rg_status rg_project_step(rg_project *P, const rg_constraint *K, const double *drho0, int feed,
                          const double *hold, double *drho, double tol, rg_cg_report *rep)
{
    rg_status s = prepare(P, K, hold);
    if (s == RG_OK) s = step(P, K, drho0, feed, hold, drho, tol, rep);
    P->solves++;
    if (s != RG_OK || P->solver != RG_SOLVER_CHOLESKY || feed || hold) return s;
    rg_sparse_mul(&P->scale.B, P->x, P->b); /* y = P B x of x = B^T y */
    rg_cholesky_apply(&P->cholesky, P->b, P->y);
    rg_scale_rows_t(&P->scale, P->y);
    return s;
}

rg_status rg_project_tangent(rg_project *P, const rg_constraint *K, const double *wish, double *t, double tol,
                             rg_cg_report *rep)
{
    rg_status s = prepare(P, K, NULL);
    P->solves++;
    return s == RG_OK ? step(P, K, wish, 0, NULL, t, tol, rep) : s;
}
