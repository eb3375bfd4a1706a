/* cholesky.h -- a sparse factorisation, and with it a pseudo-inverse of B that is nearly exact.
 * Paper    the backslash of eq. (15)        Uses  sparse.h supernodal.h        Used by  project.c
 *
 * Flat, folded flat, and everywhere on a sheet with more constraints than creases, B B^T is singular; so is B^T B
 * wherever the sheet can move. A small beta on the diagonal makes both regular, and they are worth the same,
 *
 *     P = (B B^T + beta I)^-1 = (I - B (B^T B + beta I)^-1 B^T) / beta
 *
 * so the cheaper one is factored: columns, unless vertices of many creases fill them up. x = B^T P b is nearly B^+ b,
 * and as B^T is applied last it has no part along what the sheet can do, whatever P is: not even when P is of a state
 * that has been left. Modes of B below beta^(1/2), of which a smooth sheet has few, are left to the iteration in
 * cg.h. */
#ifndef RG_CHOLESKY_H
#define RG_CHOLESKY_H

#include "linalg/sparse.h"
#include "linalg/supernodal.h"

typedef enum rg_shape { RG_SHAPE_AUTO, RG_SHAPE_ROWS, RG_SHAPE_COLUMNS } rg_shape;

typedef struct rg_cholesky {
    rg_memory mem;
    rg_shape shape;       /* ROWS: of B B^T, 3M; COLUMNS: of B^T B, N */
    double beta;          /* on the diagonal, at the last update */
    int64_t factorizations, triangular; /* how often it was factored, and solved with */
    rg_supernodal L;
    int32_t *to;          /* where each product of two numbers of B is added */
    rg_sparse B;          /* what was factored: the pattern is borrowed, the numbers are a copy */
    double *x;            /* [N] scratch */
} rg_cholesky;

/* B gives the pattern; its numbers may change, its place may not. AUTO: the shape that costs less.
 * RG_ENOMEM. */
rg_status rg_cholesky_init(rg_cholesky *P, const rg_memory *mem, const rg_sparse *B, rg_shape shape);
void rg_cholesky_free(rg_cholesky *P);
/* Factors anew. Allocates nothing. */
void rg_cholesky_update(rg_cholesky *P, const rg_sparse *B);
/* y = P r, both [3M], may be the same array. Not for two threads at once. Allocates nothing. */
void rg_cholesky_apply(rg_cholesky *P, const double *r, double *y);
/* x <- (B^T B + beta I) \ x, x[N]; for RG_SHAPE_COLUMNS. */
void rg_cholesky_solve(rg_cholesky *P, double *x);

#endif
