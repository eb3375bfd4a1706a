/* jacobi.h -- block-Jacobi: the 3 x 3 diagonal blocks of C C^T, inverted where they can be.
 * Paper    section 4 (the preconditioner is ours)        Uses  sparse.h        Used by  project.c */
#ifndef RG_JACOBI_H
#define RG_JACOBI_H

#include "linalg/sparse.h"

typedef struct rg_jacobi {
    rg_memory mem;
    int32_t M;
    double (*inverse)[6]; /* [M] xx xy xz yy yz zz of the pseudo-inverse of C_k C_k^T */
} rg_jacobi;

rg_status rg_jacobi_init(rg_jacobi *P, const rg_memory *mem, int32_t M);
void rg_jacobi_free(rg_jacobi *P);

/* Takes the numbers of C. Flat paper makes a block of rank 2: the direction that no crease can turn is left out, so
 * that a residual along it neither drives nor disturbs the iteration. */
void rg_jacobi_update(rg_jacobi *P, const rg_sparse *C);
/* z = P r, both [3M] */
void rg_jacobi_apply(const void *P, const double *r, double *z);

#endif
