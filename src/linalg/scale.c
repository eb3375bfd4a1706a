#include "linalg/scale.h"
#include "base/lanes.h"

#include <string.h>

/* The least pivot. At a vertex whose creases have turned by rho the third one is about rho^2, the residual along it as
 * well, and its rounding of 1e-16 is worth a step of 1e-16 / rho: down to 3e-6 that is below any tolerance, and from
 * there on so is the residual. */
static const double LEAST_PIVOT = 1e-11;

rg_status rg_scale_init(rg_scale *S, const rg_memory *mem, const rg_sparse *C)
{
    memset(S, 0, sizeof *S);
    S->mem = *mem;
    S->B = *C;
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(S->B.x, (size_t)C->start[C->M]),
                                      RG_ARRAY(S->inverse, (size_t)C->M));
    if (s != RG_OK) rg_scale_free(S);
    return s;
}

void rg_scale_free(rg_scale *S)
{
    if (!S->mem.resize) return;
    RG_MEM_FREE(&S->mem, S->B.x, S->inverse);
    memset(S, 0, sizeof *S);
}

/* What is of four vertices at once: roots and quotients of one alone would wait for each other. */
RG_WITHIN void inverse_root(const rg_quad *pivot, rg_quad *root)
{
    for (int i = 0; i < 4; i++) (*root)[i] = (*pivot)[i] > LEAST_PIVOT ? 1 / sqrt((*pivot)[i]) : 0;
}

/* d: xx, yy, zz, xy, xz, yz of C C^T at each; w: six numbers of the inverse of its factor. The first crease of a loop
 * is e_x, so xx >= 1, and two neighbours are never in line: only the third pivot can go. */
RG_WITHIN void invert(const rg_quad *d, rg_quad *w)
{
    rg_quad a = {0}, b = {0}, c = {0};
    inverse_root(&d[0], &a);
    const rg_quad l21 = d[3] * a, l31 = d[4] * a, second = d[1] - l21 * l21;
    inverse_root(&second, &b);
    const rg_quad l32 = (d[5] - l31 * l21) * b, third = d[2] - l31 * l31 - l32 * l32;
    inverse_root(&third, &c);
    w[0] = a;
    w[1] = -l21 * a * b;
    w[2] = b;
    w[3] = -(l31 * a + l32 * w[1]) * c;
    w[4] = -l32 * b * c;
    w[5] = c;
}

RG_WIDE void rg_scale_update(rg_scale *S, const rg_sparse *C)
{
    for (int32_t first = 0; first < C->M; first += 4) {
        const int32_t n = C->M - first < 4 ? C->M - first : 4;
        rg_quad d[6] = {{0}}, inverse[6];
        for (int32_t i = 0; i < n; i++) {
            rg_vec3 square = {0, 0, 0};
            double xy = 0, xz = 0, yz = 0;
            for (int32_t j = C->start[first + i]; j < C->start[first + i + 1]; j++) {
                const rg_vec3 v = C->x[j];
                square.x += v.x * v.x, square.y += v.y * v.y, square.z += v.z * v.z;
                xy += v.x * v.y, xz += v.x * v.z, yz += v.y * v.z;
            }
            d[0][i] = square.x, d[1][i] = square.y, d[2][i] = square.z, d[3][i] = xy, d[4][i] = xz, d[5][i] = yz;
        }
        invert(d, inverse);
        for (int32_t i = 0; i < n; i++) {
            double *w = S->inverse[first + i];
            for (int k = 0; k < 6; k++) w[k] = inverse[k][i];
            for (int32_t j = C->start[first + i]; j < C->start[first + i + 1]; j++) {
                const rg_vec3 v = C->x[j];
                S->B.x[j] = (rg_vec3){w[0] * v.x, w[1] * v.x + w[2] * v.y, w[3] * v.x + w[4] * v.y + w[5] * v.z};
            }
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
