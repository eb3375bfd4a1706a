/* supernodal.h -- L L^T = A + beta I for a sparse symmetric A whose pattern stays: the order and the pattern of L are
 * found once, the numbers as often as they change, without an allocation, and always to the same bits.
 * Paper    the backslash of eq. (15)        Uses  symbolic.h        Used by  cholesky.c least.c normal.c
 *
 * Columns of L of (nearly) the same pattern lie together in a dense panel, a supernode, so that nearly all of the work
 * is a product of small dense matrices. A library's factorisation does the same; on panels as small as those of a sheet
 * it spends most of its time on the way into its BLAS (docs/speed.md). */
#ifndef RG_SUPERNODAL_H
#define RG_SUPERNODAL_H

#include "linalg/symbolic.h"

typedef struct rg_supernodal {
    rg_symbolic S;
    double *x;                         /* in: A, by rg_supernodal_slot; out: L, its diagonal inverted */
    int32_t *head, *next, *done, *map, *place; /* scratch of factor */
    double *update, *b;
} rg_supernodal;

/* The pattern of A as in rg_symbolic_init, the diagonal in it.
 * RG_ENOMEM. Owner: the caller, rg_supernodal_free. */
rg_status rg_supernodal_init(rg_supernodal *L, const rg_memory *mem, int32_t n, const int32_t *start,
                             const int32_t *row);
void rg_supernodal_free(rg_supernodal *L);

/* Where A's number at (i, j), which is that at (j, i), belongs in x. */
int32_t rg_supernodal_slot(const rg_supernodal *L, int32_t i, int32_t j);
/* The same for all i, j <= i of n columns, one after the other. Zero: L has no number at one of them, neither of A nor
 * filled in. order, at: [n] scratch. */
int rg_supernodal_find(const rg_supernodal *L, int32_t n, const int32_t *column, int32_t *order, int32_t *at,
                       int32_t *slot);
/* Makes x zero, to be filled with A. */
void rg_supernodal_clear(rg_supernodal *L);
/* Non-zero: done; zero: a pivot is not positive (or NaN), x is spoilt. */
int rg_supernodal_factor(rg_supernodal *L, double beta);
/* b <- (A + beta I) \ b, b[n] */
void rg_supernodal_solve(rg_supernodal *L, double *b);

#endif
