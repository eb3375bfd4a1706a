#include "linalg/sparse.h"

#include <string.h>

rg_status rg_sparse_init(rg_sparse *C, const rg_memory *mem, int32_t M, int32_t N, const int32_t *start,
                         const int32_t *col)
{
    size_t blocks = (size_t)start[M];
    memset(C, 0, sizeof *C);
    C->mem = *mem;
    C->M = M;
    C->N = N;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(C->start, (size_t)M + 1), RG_ARRAY(C->col, blocks), RG_ARRAY(C->row, blocks),
                      RG_ARRAY(C->slot, (size_t)N), RG_ARRAY(C->x, blocks)) != RG_OK) {
        rg_sparse_free(C);
        return RG_ENOMEM;
    }
    memcpy(C->start, start, ((size_t)M + 1) * sizeof *start);
    memcpy(C->col, col, blocks * sizeof *col);
    for (int32_t i = 0; i < N; i++) C->slot[i][0] = C->slot[i][1] = -1;
    for (int32_t k = 0; k < M; k++)
        for (int32_t j = start[k]; j < start[k + 1]; j++) {
            int32_t *slot = C->slot[col[j]];
            C->row[j] = k;
            if (slot[0] < 0) slot[0] = j;
            else if (slot[1] < 0) slot[1] = j;
            else {
                rg_sparse_free(C);
                return RG_EARG;
            }
        }
    return RG_OK;
}

void rg_sparse_free(rg_sparse *C)
{
    if (!C->mem.resize) return;
    rg_memory mem = C->mem;
    RG_MEM_FREE(&mem, C->start, C->col, C->row, C->slot, C->x);
    memset(C, 0, sizeof *C);
}

void rg_sparse_mul(const rg_sparse *C, const double *x, double *y)
{
    for (int32_t k = 0; k < C->M; k++) {
        rg_vec3 sum = rg_sparse_mul_row(C, k, x);
        y[3 * k] = sum.x;
        y[3 * k + 1] = sum.y;
        y[3 * k + 2] = sum.z;
    }
}

void rg_sparse_mul_t(const rg_sparse *C, const double *y, double *x)
{
    memset(x, 0, (size_t)C->N * sizeof *x);
    for (int32_t k = 0; k < C->M; k++) {
        rg_vec3 v = {y[3 * k], y[3 * k + 1], y[3 * k + 2]};
        for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) x[C->col[j]] += rg_vec3_dot(C->x[j], v);
    }
}
