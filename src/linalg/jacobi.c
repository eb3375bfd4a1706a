#include "linalg/jacobi.h"

#include <float.h>
#include <string.h>

/* A pivot below this part of the block's largest entry is rounding: a crease that has turned by 1e-6 rad lifts the
 * third direction to about 1e-12 of the others, and rounding to about 1e-16. */
static const double RANK_TOLERANCE = 64 * DBL_EPSILON;

rg_status rg_jacobi_init(rg_jacobi *P, const rg_memory *mem, int32_t M)
{
    memset(P, 0, sizeof *P);
    P->mem = *mem;
    P->M = M;
    P->inverse = rg_mem_array(mem, (size_t)M, sizeof *P->inverse);
    return P->inverse ? RG_OK : RG_ENOMEM;
}

void rg_jacobi_free(rg_jacobi *P)
{
    if (P->mem.resize) rg_mem_free(&P->mem, P->inverse);
    memset(P, 0, sizeof *P);
}

/* B = V diag(d) V^T by cyclic Jacobi rotations; five sweeps reach machine precision for any 3 x 3. */
static void eigen3(double B[3][3], double V[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) V[i][j] = i == j;
    for (int sweep = 0; sweep < 8; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                if (B[p][q] == 0) continue;
                double tau = (B[q][q] - B[p][p]) / (2 * B[p][q]);
                double t = (tau >= 0 ? 1 : -1) / (fabs(tau) + hypot(1, tau)), c = 1 / hypot(1, t), s = t * c;
                for (int i = 0; i < 3; i++) {
                    double bp = B[i][p], bq = B[i][q];
                    B[i][p] = c * bp - s * bq;
                    B[i][q] = s * bp + c * bq;
                }
                for (int i = 0; i < 3; i++) {
                    double bp = B[p][i], bq = B[q][i], vp = V[i][p], vq = V[i][q];
                    B[p][i] = c * bp - s * bq;
                    B[q][i] = s * bp + c * bq;
                    V[i][p] = c * vp - s * vq;
                    V[i][q] = s * vp + c * vq;
                }
                B[p][q] = B[q][p] = 0;
            }
}

static void invert(double xx, double xy, double xz, double yy, double yz, double zz, double *out)
{
    double B[3][3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}, V[3][3], d[3];
    eigen3(B, V);
    double largest = fmax(B[0][0], fmax(B[1][1], B[2][2]));
    for (int i = 0; i < 3; i++) d[i] = B[i][i] > RANK_TOLERANCE * largest ? 1 / B[i][i] : 0;
    static const int at[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
    for (int e = 0; e < 6; e++) {
        out[e] = 0;
        for (int i = 0; i < 3; i++) out[e] += d[i] * V[at[e][0]][i] * V[at[e][1]][i];
    }
}

void rg_jacobi_update(rg_jacobi *P, const rg_sparse *C)
{
    for (int32_t k = 0; k < C->M; k++) {
        double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
        for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) {
            rg_vec3 v = C->x[j];
            xx += v.x * v.x, xy += v.x * v.y, xz += v.x * v.z;
            yy += v.y * v.y, yz += v.y * v.z, zz += v.z * v.z;
        }
        double *out = P->inverse[k];
        /* The adjugate is quicker than the eigenvectors; good enough wherever the block is far from singular. */
        double ax = yy * zz - yz * yz, ay = xz * yz - xy * zz, az = xy * yz - xz * yy;
        double det = xx * ax + xy * ay + xz * az, trace = xx + yy + zz;
        if (det > 1e-6 * trace * trace * trace) {
            out[0] = ax / det, out[1] = ay / det, out[2] = az / det;
            out[3] = (xx * zz - xz * xz) / det, out[4] = (xy * xz - xx * yz) / det;
            out[5] = (xx * yy - xy * xy) / det;
        } else {
            invert(xx, xy, xz, yy, yz, zz, out);
        }
    }
}

void rg_jacobi_apply(const void *precond, const double *r, double *z)
{
    const rg_jacobi *P = precond;
    for (int32_t k = 0; k < P->M; k++) {
        const double *a = P->inverse[k], *v = r + 3 * k;
        z[3 * k] = a[0] * v[0] + a[1] * v[1] + a[2] * v[2];
        z[3 * k + 1] = a[1] * v[0] + a[3] * v[1] + a[4] * v[2];
        z[3 * k + 2] = a[2] * v[0] + a[4] * v[1] + a[5] * v[2];
    }
}
