/* interior.h -- how hard rows push: a convex quadratic program with signs, by an interior point.
 * Uses  dense.h        Used by  nearest.c
 *
 *     min  1/2 x^T (F F^T + C) x - d^T x,   x >= 0        C diagonal, positive
 *
 * whose x are the multipliers of: min 1/2 |v|^2 + sum s_i^2 / (2 c_i) with F v + s >= d, and v = F^T x. Layers that lie on each
 * other give the same row many times, which sets of active rows cycle on. An interior point does not mind.
 * Newton's matrix F F^T + D, D = C + slack / x, is taken as it is or, where there are many more rows than ways to go, as
 * 1 + F^T D^-1 F (Woodbury).
 * Mehrotra, On the implementation of a primal-dual interior point method, 1992. */
#ifndef RG_INTERIOR_H
#define RG_INTERIOR_H

#include "base/memory.h"

typedef struct rg_interior {
    rg_memory mem;
    int32_t rows, ways;      /* that there is room for */
    double *F, *H, *S, *L, *update;
    double *c, *d;           /* [rows] to be filled in, as is F, by rows that are rg_interior_stride(k) apart */
    double *x, *slack;       /* [rows] out: multipliers; what rows are more than kept by */
    double *v;               /* [ways] out: F^T x */
    double *dx, *dslack, *residual, *both, *small;
    int32_t iterations;      /* of the last call */
    double work, most_work;  /* of all calls: multiplications; what ends one, 0: nothing */
    int (*stop)(void *ctx, double done); /* NULL: nobody asks; non-zero: solve ends with what it has, and so does every call after it */
    void *ctx;
} rg_interior;

/* Makes room for m rows of k ways, keeping nothing. RG_ENOMEM. A zeroed struct with mem set is empty. */
rg_status rg_interior_reserve(rg_interior *q, int32_t m, int32_t k);
void rg_interior_free(rg_interior *q);
/* From one row of F to the next: k filled up, with zeros, to fours. */
static inline size_t rg_interior_stride(int32_t k) { return ((size_t)k + 3) & ~(size_t)3; }
/* Allocates nothing. */
void rg_interior_solve(rg_interior *q, int32_t m, int32_t k);

#endif
