/* cg.h -- the hand-written conjugate gradient.
 * Paper    section 4; the backslash of eq. (15)        Uses  sparse.h        Used by  project.c
 *
 * Solves C C^T y = b for the step x = C^T y it is wanted for. Flat paper, flat-folded paper and every quad mesh make C
 * C^T singular, and a residual r of eq. (14) need not lie in its range; the textbook recurrence, which assumes that it
 * does, then drifts away. So the recurrence here is that of the least-squares form (CGLS; Hestenes and Stiefel 1952,
 * section 10, on A = P^(1/2) C): it minimises (b - C x)^T P (b - C x) over growing Krylov spaces of C C^T, with the
 * same two products an iteration, and gives the pseudo-inverse answer x = C^+ b whenever b is in the range. */
#ifndef RG_CG_H
#define RG_CG_H

#include "linalg/sparse.h"

typedef enum rg_cg_stop {
    RG_CG_CONVERGED,     /* ||b - C x||_P <= tol ||b||_P */
    RG_CG_LEAST_SQUARES, /* what is left of b is out of reach: C^T P (b - C x) = 0 to tolerance */
    RG_CG_MAX_ITERATIONS,
    RG_CG_BREAKDOWN /* a curvature that is not positive: nothing left to move, or NaN */
} rg_cg_stop;


typedef struct rg_cg_report {
    rg_cg_stop stop;
    int32_t iterations;
} rg_cg_report;

typedef struct rg_cg_work {
    rg_memory mem;
    int32_t M, N;
    double *r, *z, *u, *q, *w; /* [3M] */
    double *s, *p;             /* [N] */
} rg_cg_work;

rg_status rg_cg_work_init(rg_cg_work *w, const rg_memory *mem, int32_t M, int32_t N);
void rg_cg_work_free(rg_cg_work *w);

typedef void rg_apply(const void *ctx, const double *in, double *out);

/* y[3M]    in   where to start (zero is always right); dropped if it is no better than zero
 *          out  a solution; y is not unique where C C^T is singular, x is
 * x[N]     out  C^T y
 * hold     unit vector [N] that x is kept orthogonal to, C being used as C (I - n n^T); NULL: none. x is then that part
 *          of C^T y.
 * P        a positive semi-definite preconditioner, [3M] -> [3M], close to the inverse of C C^T
 * Allocates nothing. One work per thread. */
void rg_cg_solve(const rg_sparse *C, rg_apply *P, const void *ctx, const double *hold, const double *b, double *y,
                 double *x, double tol, int32_t max_iterations, rg_cg_work *w, rg_cg_report *rep);

/* z[N] = G r, r[3M] */
typedef void rg_apply_pinv(void *ctx, const double *r, double *z);

/* Least squares again, min ||b - B x||, from a G that is nearly the pseudo-inverse of B: G r is the step that would end
 * it, and where it does not, the next step is made conjugate to it (B p orthogonal to the B p before: conjugate
 * gradients where G B is symmetric, conjugate residuals where it is nearly so). It stops on the length of that step or,
 * where steps become shorter regularly, of what the next one would be, in radians, not on a residual: where a sheet is
 * over-constrained some of the residual, as small as rounding, is out of reach, and whoever chases it freezes the
 * sheet.
 *   x[N]      out  the solution, in the range of G
 *   relative  stop at this part of the first step's length
 *   absolute  stop at this length
 * Allocates nothing. One work per thread. */
void rg_cg_refine(const rg_sparse *B, rg_apply_pinv *G, void *ctx, const double *b, double *x, double relative,
                  double absolute, int32_t max_iterations, rg_cg_work *w, rg_cg_report *rep);

#endif
