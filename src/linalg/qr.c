#include "linalg/qr.h"

#ifdef RG_GPL
#include <SuiteSparseQR_C.h>

int rg_qr_built(void) { return 1; }

/* Upright, so that there is less to eliminate: B where there are more rows than creases, else B^T. */
static cholmod_sparse *upright(const rg_sparse *B, cholmod_common *cc)
{
    const size_t rows = 3 * (size_t)B->M, columns = (size_t)B->N, blocks = (size_t)B->start[B->M];
    const int turned = columns > rows;
    cholmod_triplet *T = cholmod_l_allocate_triplet(turned ? columns : rows, turned ? rows : columns, 3 * blocks, 0, CHOLMOD_REAL, cc);
    if (!T) return NULL;
    SuiteSparse_long *i = turned ? T->j : T->i, *j = turned ? T->i : T->j;
    double *x = T->x;
    for (size_t b = 0; b < blocks; b++) {
        const double v[3] = {B->x[b].x, B->x[b].y, B->x[b].z};
        for (size_t a = 0; a < 3; a++) i[3 * b + a] = 3 * B->row[b] + (int)a, j[3 * b + a] = B->col[b], x[3 * b + a] = v[a];
    }
    T->nnz = 3 * blocks;
    cholmod_sparse *A = cholmod_l_triplet_to_sparse(T, 0, cc);
    cholmod_l_free_triplet(&T, cc);
    return A;
}

rg_status rg_qr_rank(const rg_sparse *B, double cut, int32_t *rank)
{
    cholmod_common cc;
    *rank = 0;
    if (B->M == 0 || B->N == 0) return RG_OK;
    cholmod_l_start(&cc);
    cc.print = 0;
    cc.SPQR_nthreads = 1;
    cholmod_sparse *A = upright(B, &cc);
    /* The default may ask METIS, which takes the process's signals. */
    const SuiteSparse_long found =
        A ? SuiteSparseQR_C(SPQR_ORDERING_COLAMD, cut, 0, 0, A, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, &cc) : -1;
    const int failed = found < 0 || cc.status < CHOLMOD_OK;
    cholmod_l_free_sparse(&A, &cc);
    cholmod_l_finish(&cc);
    if (failed) return RG_ENOMEM;
    *rank = (int32_t)found;
    return RG_OK;
}

#else

int rg_qr_built(void) { return 0; }
rg_status rg_qr_rank(const rg_sparse *B, double cut, int32_t *rank)
{
    (void)B, (void)cut, (void)rank;
    return RG_EABSENT;
}

#endif
