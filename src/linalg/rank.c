#include "linalg/rank.h"

#include <string.h>

#ifdef RG_GPL
#include <gsl/gsl_linalg.h>

/* An over-constrained sheet that is off its path by the closure tolerance has a singular value of that size where on
 * the path it has a zero; taken for real it would freeze the sheet. The slowest real one of a sheet small enough to
 * come here is above 1e-4. */
static const double CUT = 1e-7;

/* GSL's own allocations end the program when they fail, so it works in ours, through views. */
typedef struct dense {
    size_t tall, small;
    double *u, *v, *x, *s, *work; /* A = U S V^T with A = C or C^T, whichever is tall */
} dense;

int rg_pinv_built(void) { return 1; }

rg_status rg_pinv_init(rg_pinv *P, const rg_memory *mem, int32_t M, int32_t N)
{
    memset(P, 0, sizeof *P);
    P->mem = *mem;
    P->M = M;
    P->N = N;
    if (M == 0 || N == 0) return RG_OK;
    dense *d = P->dense = rg_mem_array(mem, 1, sizeof *d);
    if (!d) return RG_ENOMEM;
    d->tall = (size_t)(3 * M > N ? 3 * M : N);
    d->small = (size_t)(3 * M > N ? N : 3 * M);
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(d->u, d->tall * d->small), RG_ARRAY(d->v, d->small * d->small),
                                      RG_ARRAY(d->x, d->small * d->small), RG_ARRAY(d->s, d->small),
                                      RG_ARRAY(d->work, d->small));
    if (s != RG_OK) rg_pinv_free(P);
    return s;
}

void rg_pinv_free(rg_pinv *P)
{
    if (!P->mem.resize) return;
    dense *d = P->dense;
    if (d) {
        RG_MEM_FREE(&P->mem, d->u, d->v, d->x, d->s, d->work);
        rg_mem_free(&P->mem, d);
    }
    memset(P, 0, sizeof *P);
}

rg_status rg_pinv_update(rg_pinv *P, const rg_sparse *C, const double *hold)
{
    dense *d = P->dense;
    if (!d) return RG_OK;
    int upright = 3 * P->M > P->N; /* A = C, else A = C^T */
    memset(d->u, 0, d->tall * d->small * sizeof *d->u);
    for (int32_t j = 0; j < C->start[C->M]; j++) {
        double x[3] = {C->x[j].x, C->x[j].y, C->x[j].z};
        for (size_t a = 0; a < 3; a++) {
            size_t row = 3 * (size_t)C->row[j] + a, col = (size_t)C->col[j];
            d->u[upright ? row * d->small + col : col * d->small + row] = x[a];
        }
    }
    for (size_t row = 0; hold && row < 3 * (size_t)P->M; row++) {
        size_t across = upright ? 1 : d->small;
        double *a = d->u + (upright ? row * d->small : row), along = 0;
        for (size_t i = 0; i < (size_t)P->N; i++) along += a[i * across] * hold[i];
        for (size_t i = 0; i < (size_t)P->N; i++) a[i * across] -= along * hold[i];
    }
    gsl_matrix_view U = gsl_matrix_view_array(d->u, d->tall, d->small);
    gsl_matrix_view V = gsl_matrix_view_array(d->v, d->small, d->small);
    gsl_matrix_view X = gsl_matrix_view_array(d->x, d->small, d->small);
    gsl_vector_view S = gsl_vector_view_array(d->s, d->small), work = gsl_vector_view_array(d->work, d->small);
    gsl_linalg_SV_decomp_mod(&U.matrix, &X.matrix, &V.matrix, &S.vector, &work.vector);
    double cut = d->s[0] * CUT;
    P->rank = 0;
    for (size_t i = 0; i < d->small; i++)
        if (d->s[i] > cut) P->rank++;
        else d->s[i] = 0;
    return RG_OK;
}

void rg_pinv_apply(const rg_pinv *P, const double *b, double *x, double *y)
{
    const dense *d = P->dense;
    memset(x, 0, (size_t)P->N * sizeof *x);
    memset(y, 0, 3 * (size_t)P->M * sizeof *y);
    if (!d) return;
    int upright = 3 * P->M > P->N;
    const double *rows = upright ? d->u : d->v, *cols = upright ? d->v : d->u; /* C = rows S cols^T */
    size_t m = 3 * (size_t)P->M, n = (size_t)P->N;
    for (size_t i = 0; i < d->small; i++) {
        double s = d->s[i], c = 0;
        if (!(s > 0)) continue;
        for (size_t k = 0; k < m; k++) c += rows[k * d->small + i] * b[k];
        for (size_t k = 0; k < n; k++) x[k] += c / s * cols[k * d->small + i];
        for (size_t k = 0; k < m; k++) y[k] += c / (s * s) * rows[k * d->small + i];
    }
}

#else

int rg_pinv_built(void) { return 0; }
rg_status rg_pinv_init(rg_pinv *P, const rg_memory *mem, int32_t M, int32_t N)
{
    (void)mem, (void)M, (void)N;
    memset(P, 0, sizeof *P);
    return RG_EABSENT;
}
void rg_pinv_free(rg_pinv *P) { (void)P; }
rg_status rg_pinv_update(rg_pinv *P, const rg_sparse *C, const double *hold)
{
    (void)P, (void)C, (void)hold;
    return RG_EABSENT;
}
void rg_pinv_apply(const rg_pinv *P, const double *b, double *x, double *y) { (void)P, (void)b, (void)x, (void)y; }

#endif
