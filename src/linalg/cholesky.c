#include "linalg/cholesky.h"

#include <string.h>

#ifdef RG_GPL
#include <cholmod.h>

/* beta: rounding in a factor of norm 2 or so is some 1e-15 and must not make a pivot negative; what is far above beta is
 * not disturbed. Where a pivot still fails, beta grows by the factor below and the factorisation is repeated. */
static const double BETA = 1e-12, BETA_GROWTH = 100, BETA_LARGEST = 1e-2;

typedef struct state {
    cholmod_common common;
    cholmod_sparse *A; /* C by columns */
    cholmod_factor *L;
    cholmod_dense *b, *z, *work[2];
} state;

int rg_cholesky_built(void) { return 1; }

rg_status rg_cholesky_init(rg_cholesky *L, const rg_memory *mem, const rg_sparse *C)
{
    memset(L, 0, sizeof *L);
    L->mem = *mem;
    if (C->M == 0) return RG_OK;
    state *k = L->state = rg_mem_array(mem, 1, sizeof *k);
    if (!k) return RG_ENOMEM;
    cholmod_common *cc = &k->common;
    cholmod_start(cc);
    cc->print = 0;
    cc->final_ll = 1;
    size_t m = 3 * (size_t)C->M, n = (size_t)C->N;
    k->A = cholmod_allocate_sparse(m, n, 3 * (size_t)C->start[C->M], 0, 1, 0, CHOLMOD_REAL, cc);
    k->b = cholmod_allocate_dense(m, 1, m, CHOLMOD_REAL, cc);
    if (!k->A || !k->b) goto fail;
    int *start = k->A->p, *row = k->A->i, at = 0;
    for (int32_t i = 0; i < C->N; i++) {
        start[i] = at;
        int32_t s0 = C->slot[i][0], s1 = C->slot[i][1];
        if (s0 >= 0 && s1 >= 0 && C->row[s0] > C->row[s1]) s0 = C->slot[i][1], s1 = C->slot[i][0];
        if (s0 >= 0)
            for (int a = 0; a < 3; a++) row[at++] = 3 * C->row[s0] + a;
        if (s1 >= 0)
            for (int a = 0; a < 3; a++) row[at++] = 3 * C->row[s1] + a;
    }
    start[C->N] = at;
    k->L = cholmod_analyze(k->A, cc);
    if (!k->L) goto fail;
    return RG_OK;
fail:
    rg_cholesky_free(L);
    return RG_ENOMEM;
}

void rg_cholesky_free(rg_cholesky *L)
{
    state *k = L->state;
    if (k) {
        cholmod_free_sparse(&k->A, &k->common);
        cholmod_free_factor(&k->L, &k->common);
        cholmod_free_dense(&k->b, &k->common);
        cholmod_free_dense(&k->z, &k->common);
        cholmod_free_dense(&k->work[0], &k->common);
        cholmod_free_dense(&k->work[1], &k->common);
        cholmod_finish(&k->common);
        rg_mem_free(&L->mem, k);
    }
    memset(L, 0, sizeof *L);
}

rg_status rg_cholesky_update(rg_cholesky *L, const rg_sparse *C)
{
    state *k = L->state;
    if (!k) return RG_OK;
    const int *start = k->A->p, *row = k->A->i;
    double *x = k->A->x;
    for (int32_t i = 0; i < C->N; i++)
        for (int side = 0; side < 2; side++) {
            int32_t s = C->slot[i][side];
            if (s < 0) continue;
            int at = start[i] + (start[i + 1] - start[i] == 6 && row[start[i]] != 3 * C->row[s] ? 3 : 0);
            x[at] = C->x[s].x;
            x[at + 1] = C->x[s].y;
            x[at + 2] = C->x[s].z;
        }
    for (double beta = BETA; beta <= BETA_LARGEST; beta *= BETA_GROWTH) {
        double shift[2] = {beta, 0};
        if (!cholmod_factorize_p(k->A, shift, NULL, 0, k->L, &k->common)) return RG_ENOMEM;
        if (k->L->minor == k->L->n) return RG_OK;
    }
    return RG_OK; /* NaN in C: whoever solves with it sees NaN come out */
}

void rg_cholesky_apply(const void *ctx, const double *r, double *z)
{
    const rg_cholesky *L = ctx;
    state *k = L->state;
    if (!k) return;
    size_t bytes = k->b->nrow * sizeof *z;
    memcpy(k->b->x, r, bytes);
    if (cholmod_solve2(CHOLMOD_A, k->L, k->b, NULL, &k->z, NULL, &k->work[0], &k->work[1], &k->common))
        memcpy(z, k->z->x, bytes);
    else
        memcpy(z, r, bytes); /* out of memory: still a preconditioner, though a poor one */
}

#else

int rg_cholesky_built(void) { return 0; }
rg_status rg_cholesky_init(rg_cholesky *L, const rg_memory *mem, const rg_sparse *C)
{
    (void)mem, (void)C;
    memset(L, 0, sizeof *L);
    return RG_EABSENT;
}
void rg_cholesky_free(rg_cholesky *L) { (void)L; }
rg_status rg_cholesky_update(rg_cholesky *L, const rg_sparse *C) { (void)L, (void)C; return RG_EABSENT; }
void rg_cholesky_apply(const void *L, const double *r, double *z) { (void)L, (void)r, (void)z; }

#endif
