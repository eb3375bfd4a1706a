/* rank.h -- the pseudo-inverse of C by singular values: the truth for small patterns.
 * Paper    eq. (9)        Uses  sparse.h, GSL        Used by  project.c */
#ifndef RG_RANK_H
#define RG_RANK_H

#include "linalg/sparse.h"

typedef struct rg_pinv {
    rg_memory mem;
    int32_t M, N;
    int32_t rank;  /* of C, at the last update */
    void *dense;   /* the arrays GSL works in */
} rg_pinv;

int rg_pinv_built(void); /* non-zero: this build has it */

/* Dense: takes 16 (3M + N) max(3M, N) bytes or so. RG_EABSENT in a build without GSL. */
rg_status rg_pinv_init(rg_pinv *P, const rg_memory *mem, int32_t M, int32_t N);
void rg_pinv_free(rg_pinv *P);
/* hold: unit vector [N], C is then used as C (I - n n^T); NULL: none */
rg_status rg_pinv_update(rg_pinv *P, const rg_sparse *C, const double *hold);
/* x[N] = C^+ b, and y[3M] = (C C^T)^+ b, b[3M] */
void rg_pinv_apply(const rg_pinv *P, const double *b, double *x, double *y);

#endif
