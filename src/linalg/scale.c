#include "linalg/scale.h"

#include <string.h>

/* The least pivot. At a vertex whose creases have turned by rho the third one is about rho^2, the residual along it as
 * well, and its rounding of 1e-16 is worth a step of 1e-16 / rho: down to 3e-6 that is below any tolerance, and from there
 * on so is the residual. */
static const double LEAST_PIVOT = 1e-11;

rg_status rg_scale_init(rg_scale *S, const rg_memory *mem, const rg_sparse *C)
{
    memset(S, 0, sizeof *S);
    S->mem = *mem;
    S->B = *C;
    S->B.x = rg_mem_array(mem, (size_t)C->start[C->M], sizeof *S->B.x);
    S->inverse = rg_mem_array(mem, (size_t)C->M, sizeof *S->inverse);
    if (S->B.x && S->inverse) return RG_OK;
    rg_scale_free(S);
    return RG_ENOMEM;
}

void rg_scale_free(rg_scale *S)
{
    if (!S->mem.resize) return;
    rg_mem_free(&S->mem, S->B.x);
    rg_mem_free(&S->mem, S->inverse);
    memset(S, 0, sizeof *S);
}

static double inverse_root(double pivot)
{
    return pivot > LEAST_PIVOT ? 1 / sqrt(pivot) : 0;
}

/* The first crease of a loop is e_x, so xx >= 1, and two neighbours are never in line: only the third pivot can go. */
static void invert(rg_vec3 diagonal, double xy, double xz, double yz, double *w)
{
    double a = inverse_root(diagonal.x), l21 = xy * a, l31 = xz * a;
    double b = inverse_root(diagonal.y - l21 * l21), l32 = (yz - l31 * l21) * b;
    double c = inverse_root(diagonal.z - l31 * l31 - l32 * l32);
    w[0] = a;
    w[1] = -l21 * a * b;
    w[2] = b;
    w[3] = -(l31 * a + l32 * w[1]) * c;
    w[4] = -l32 * b * c;
    w[5] = c;
}

void rg_scale_update(rg_scale *S, const rg_sparse *C)
{
    for (int32_t k = 0; k < C->M; k++) {
        rg_vec3 d = {0, 0, 0};
        double xy = 0, xz = 0, yz = 0, *w = S->inverse[k];
        for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) {
            rg_vec3 v = C->x[j];
            d.x += v.x * v.x, d.y += v.y * v.y, d.z += v.z * v.z;
            xy += v.x * v.y, xz += v.x * v.z, yz += v.y * v.z;
        }
        invert(d, xy, xz, yz, w);
        for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) {
            rg_vec3 v = C->x[j];
            S->B.x[j] = (rg_vec3){w[0] * v.x, w[1] * v.x + w[2] * v.y, w[3] * v.x + w[4] * v.y + w[5] * v.z};
        }
    }
}

void rg_scale_rows(const rg_scale *S, double *b)
{
    for (int32_t k = 0; k < S->B.M; k++) {
        const double *w = S->inverse[k];
        double *v = b + 3 * k;
        v[2] = w[3] * v[0] + w[4] * v[1] + w[5] * v[2];
        v[1] = w[1] * v[0] + w[2] * v[1];
        v[0] = w[0] * v[0];
    }
}

void rg_scale_rows_t(const rg_scale *S, double *y)
{
    for (int32_t k = 0; k < S->B.M; k++) {
        const double *w = S->inverse[k];
        double *v = y + 3 * k;
        v[0] = w[0] * v[0] + w[1] * v[1] + w[3] * v[2];
        v[1] = w[2] * v[1] + w[4] * v[2];
        v[2] = w[5] * v[2];
    }
}
