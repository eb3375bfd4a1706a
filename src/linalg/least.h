/* least.h -- the least step that does what it must: min ||x|| with A x = b, for a sparse A of any pattern.
 * Paper    the backslash of eqs. (15), (19): x = A^T {(A A^T) \ b}
 * Uses     supernodal.h        Used by  fold, kinematics, motion
 *
 * Conjugate gradients on A A^T, preconditioned by a factor of A A^T + beta I: a few iterations undo the beta. A A^T is
 * singular flat and folded flat; started from zero the iteration stays in its range, and stops where nothing is left to
 * gain. Damped, min ||A x - b||^2 + damping ||x||^2, one solve with that factor is all. */
#ifndef RG_LEAST_H
#define RG_LEAST_H

#include "linalg/supernodal.h"

typedef struct rg_least {
    rg_memory mem;
    int32_t rows, columns;
    int32_t *start, *row;  /* compressed columns: [columns + 1], [start[columns]] */
    double *x;             /* [start[columns]] the numbers; all that ever changes */
    rg_supernodal L;       /* of A A^T + beta I */
    double damping;        /* of what is renewed and solved from now on; 0: none */
    double beta;           /* at the last renewal */
    double tolerance;      /* part of b, as the preconditioner measures it, that is left: 1e-12, or set by the owner */
    int32_t *to;           /* where each product of two entries of a column goes among the numbers of L */
    double *y, *r, *z, *p, *q; /* [rows] */
    double *t;             /* [columns] */
    int64_t solves, iterations, factorizations;
} rg_least;

/* Copies the pattern, x is zero. RG_ENOMEM. Owner: the caller, rg_least_free. */
rg_status rg_least_init(rg_least *A, const rg_memory *mem, int32_t rows, int32_t columns, const int32_t *start,
                       const int32_t *row);
void rg_least_free(rg_least *A);
/* Tells that x has new numbers. */
void rg_least_renew(rg_least *A);
/* y[rows] = A x[columns]; x = A^T y */
void rg_least_mul(const rg_least *A, const double *x, double *y);
void rg_least_mul_t(const rg_least *A, const double *y, double *x);
/* x[columns]: out. A->y: how hard each row resists. Where no x does what b asks, it is the least of those whose
 * A x comes nearest to b. Allocates nothing. */
void rg_least_solve(rg_least *A, const double *b, double *x);

#endif
