/* sparse.h -- the fixed pattern of C: one 3-vector where an interior vertex meets a crease.
 * Paper    eqs. (7), (8)        Used by  kinematics, linalg */
#ifndef RG_SPARSE_H
#define RG_SPARSE_H

#include "base/memory.h"
#include "base/vec.h"

/* Block row k (3 scalar rows) holds x[start[k]] ... x[start[k+1]-1] in columns col[]. A crease ends at two vertices at
 * most, so a column has at most two blocks: C^T gathers through slot[i][0..1], -1 where there is none. */
typedef struct rg_sparse {
    rg_memory mem;
    int32_t M, N;       /* block rows, columns */
    int32_t *start;     /* [M + 1] */
    int32_t *col;       /* [start[M]] */
    int32_t *row;       /* [start[M]] block row of each block */
    int32_t (*slot)[2]; /* [N] */
    rg_vec3 *x;         /* [start[M]] the numbers; all that ever changes */
} rg_sparse;

/* Copies the pattern, x is zero. RG_EARG: a column has more than two blocks. */
rg_status rg_sparse_init(rg_sparse *C, const rg_memory *mem, int32_t M, int32_t N, const int32_t *start,
                         const int32_t *col);
void rg_sparse_free(rg_sparse *C);

/* Block row k of C x. */
static inline rg_vec3 rg_sparse_mul_row(const rg_sparse *C, int32_t k, const double *x)
{
    rg_vec3 sum = {0, 0, 0};
    for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) sum = rg_vec3_axpy(x[C->col[j]], C->x[j], sum);
    return sum;
}
/* y = C x       x[N], y[3M].  One of these is the "pass" that costs are counted in. */
void rg_sparse_mul(const rg_sparse *C, const double *x, double *y);
/* x = C^T y     y[3M], x[N] */
void rg_sparse_mul_t(const rg_sparse *C, const double *y, double *x);

#endif
