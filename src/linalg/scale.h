/* scale.h -- the rows of each vertex made orthonormal: B = S C, S one 3 x 3 block a vertex.
 * Paper    eqs. (9), (11): the same equations in other words        Uses  sparse.h        Used by  mobility.c project.c
 *
 * Near flat and near flat-folded the third row of a vertex is as small as the fold angles, and C C^T as badly
 * conditioned as their squares; with B_k B_k^T = I that is gone, and B B^T no worse there than anywhere else. What
 * solves C x = b solves B x = S b. */
#ifndef RG_SCALE_H
#define RG_SCALE_H

#include "linalg/sparse.h"

typedef struct rg_scale {
    rg_memory mem;
    rg_sparse B;            /* the pattern is borrowed from C, the numbers are its own */
    double (*inverse)[6];   /* [M] 11 21 22 31 32 33 of the inverse of the Cholesky factor of C_k C_k^T */
} rg_scale;

rg_status rg_scale_init(rg_scale *S, const rg_memory *mem, const rg_sparse *C);
void rg_scale_free(rg_scale *S);

/* Takes the numbers of C. A direction that no crease of a vertex can turn, as the third one in flat paper, becomes a
 * row of zeros. */
void rg_scale_update(rg_scale *S, const rg_sparse *C);
/* b <- S b                b[3M] */
void rg_scale_rows(const rg_scale *S, double *b);
/* y <- S^T y              y[3M]: what B^T y = x takes to C^T y = x */
void rg_scale_rows_t(const rg_scale *S, double *y);

#endif
