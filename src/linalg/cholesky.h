/* cholesky.h -- a sparse factorisation of C C^T + beta I, as a preconditioner that is nearly exact.
 * Paper    the backslash of eq. (15)        Uses  sparse.h, CHOLMOD        Used by  project.c
 *
 * C C^T is singular flat, folded flat and on every quad mesh, so it is factored with a small beta on the diagonal, and
 * cg.c, with this as its preconditioner, takes the two or three steps that undo the beta: the refinement and the care for
 * singular states are the iteration's, written once. */
#ifndef RG_CHOLESKY_H
#define RG_CHOLESKY_H

#include "linalg/sparse.h"

typedef struct rg_cholesky {
    rg_memory mem;
    void *state; /* CHOLMOD's, allocated by CHOLMOD; the order and the pattern of the factor are found once, in init */
} rg_cholesky;

int rg_cholesky_built(void); /* non-zero: this build has it */

/* RG_EABSENT in a build without CHOLMOD. C gives the pattern; it may change its numbers, not its place. */
rg_status rg_cholesky_init(rg_cholesky *L, const rg_memory *mem, const rg_sparse *C);
void rg_cholesky_free(rg_cholesky *L);
/* Factors anew. RG_ENOMEM. */
rg_status rg_cholesky_update(rg_cholesky *L, const rg_sparse *C);
/* z = (C C^T + beta I) \ r, both [3M]; an rg_apply for cg.h. Not for two threads at once. */
void rg_cholesky_apply(const void *L, const double *r, double *z);

#endif
