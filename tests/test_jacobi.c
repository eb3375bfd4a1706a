/* linalg/jacobi.c: each block is the pseudo-inverse of C_k C_k^T, by the four conditions of Penrose. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
#include "linalg/jacobi.h"
#include "near.h"

typedef struct block { double a[3][3]; } block;

static block times(block p, block q)
{
    block r = {{{0}}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) r.a[i][j] += p.a[i][k] * q.a[k][j];
    return r;
}

static double largest(block p)
{
    double most = 0;
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(p.a[i / 3][i % 3]));
    return most;
}

static void same(block p, block q, double tol)
{
    for (int i = 0; i < 9; i++) near(p.a[i / 3][i % 3], q.a[i / 3][i % 3], tol);
}

/* M vertices of n creases of their own. */
static rg_sparse rows(int32_t M, int32_t n)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    int32_t start[50], col[600];
    for (int32_t k = 0; k <= M; k++) start[k] = n * k;
    for (int32_t j = 0; j < n * M; j++) col[j] = j;
    assert_int_equal(rg_sparse_init(&C, &mem, M, n * M, start, col), RG_OK);
    return C;
}

static rg_jacobi jacobi_of(const rg_sparse *C)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_jacobi P;
    assert_int_equal(rg_jacobi_init(&P, &mem, C->M), RG_OK);
    rg_jacobi_update(&P, C);
    return P;
}

static block gram(const rg_sparse *C, int32_t k)
{
    block g = {{{0}}};
    for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) {
        const double v[3] = {C->x[j].x, C->x[j].y, C->x[j].z};
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) g.a[a][b] += v[a] * v[b];
    }
    return g;
}

/* The matrix that rg_jacobi_apply multiplies vertex k with, column by column. */
static block applied(const rg_jacobi *P, int32_t k)
{
    block m;
    double r[150], z[150];
    for (int b = 0; b < 3; b++) {
        memset(r, 0, sizeof r);
        r[3 * k + b] = 1;
        rg_jacobi_apply(P, r, z);
        for (int32_t i = 0; i < 3 * P->M; i++)
            if (i / 3 != k) near(z[i], 0, 0); /* no vertex hears of another */
        for (int a = 0; a < 3; a++) m.a[a][b] = z[3 * k + a];
    }
    return m;
}

/* A P A = A, P A P = P, and both products symmetric: P is the pseudo-inverse of A, and there is only one. `cond` of A
 * within its range limits what rounding leaves. */
static void penrose(block A, block P, double cond)
{
    const double tol = 1e-14 * cond;
    const block AP = times(A, P), PA = times(P, A);
    same(times(AP, A), A, tol * largest(A));
    same(times(PA, P), P, tol * largest(P));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++) {
            near(AP.a[i][j], AP.a[j][i], tol);
            near(PA.a[i][j], PA.a[j][i], tol);
            near(P.a[i][j], P.a[j][i], 1e-15 * largest(P));
        }
}

static double trace(block p) { return p.a[0][0] + p.a[1][1] + p.a[2][2]; }

static void folded_vertices(void **state)
{
    (void)state;
    unsigned seed = 1;
    rg_sparse C = rows(40, 5);
    for (int32_t j = 0; j < 200; j++) C.x[j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
    rg_jacobi P = jacobi_of(&C);
    for (int32_t k = 0; k < 40; k++) {
        const block A = gram(&C, k), Pk = applied(&P, k);
        penrose(A, Pk, largest(A) * largest(Pk) * 9);
        near(trace(times(A, Pk)), 3, 1e-9); /* the rank */
    }
    rg_jacobi_free(&P);
    rg_jacobi_free(&P);
    rg_sparse_free(&C);
}

/* Creases in one plane, any plane: rank 2. In one line: rank 1. None that moves anything: rank 0, and no division. */
static void flat_vertices(void **state)
{
    (void)state;
    unsigned seed = 2;
    rg_sparse C = rows(40, 4);
    for (int32_t k = 0; k < 40; k++) {
        const rg_vec3 u = {noise(&seed), noise(&seed), noise(&seed)}, w = {noise(&seed), noise(&seed), noise(&seed)};
        for (int32_t i = 0; i < 4; i++) {
            const double s = noise(&seed), t = k % 4 == 2 ? 0 : noise(&seed);
            C.x[4 * k + i] = k % 4 == 0   ? (rg_vec3){s, t, 0} /* flat paper, to the letter */
                             : k % 4 == 3 ? (rg_vec3){0, 0, 0}
                                          : rg_vec3_axpy(s, u, rg_vec3_scale(t, w));
        }
    }
    rg_jacobi P = jacobi_of(&C);
    for (int32_t k = 0; k < 40; k++) {
        static const int rank[] = {2, 2, 1, 0};
        const block A = gram(&C, k), Pk = applied(&P, k);
        penrose(A, Pk, fmax(1, largest(A) * largest(Pk) * 9));
        near(trace(times(A, Pk)), rank[k % 4], 1e-9);
    }
    rg_jacobi_free(&P);
    rg_sparse_free(&C);
}

/* A vertex that has hardly left the plane: from where its third direction counts, it is inverted, and well. */
static void nearly_flat_vertices(void **state)
{
    (void)state;
    unsigned seed = 3;
    static const double lift[] = {1e-1, 1e-3, 1e-5, 1e-6};
    for (int round = 0; round < 80; round++) {
        rg_sparse C = rows(1, 5);
        for (int32_t j = 0; j < 5; j++) C.x[j] = (rg_vec3){noise(&seed), noise(&seed), lift[round % 4] * noise(&seed)};
        rg_jacobi P = jacobi_of(&C);
        const block A = gram(&C, 0), Pk = applied(&P, 0);
        const double cond = 9 * largest(A) * largest(Pk);
        const block AP = times(A, Pk);
        near(trace(AP), 3, 1e-14 * cond);
        /* To leading order the inverse's zz entry is one over what of z is not explained by x and y, which is found by
         * taking them out, one after the other. */
        double z[5], x[5], y[5];
        for (int j = 0; j < 5; j++) x[j] = C.x[j].x, y[j] = C.x[j].y, z[j] = C.x[j].z;
        double *take[] = {x, y}, xx = 0, xy = 0, left = 0;
        for (int j = 0; j < 5; j++) xx += x[j] * x[j], xy += x[j] * y[j];
        for (int j = 0; j < 5; j++) y[j] -= xy / xx * x[j];
        for (int twice = 0; twice < 2; twice++)
            for (int i = 0; i < 2; i++) {
                double vv = 0, vz = 0;
                for (int j = 0; j < 5; j++) vv += take[i][j] * take[i][j], vz += take[i][j] * z[j];
                for (int j = 0; j < 5; j++) z[j] -= vz / vv * take[i][j];
            }
        for (int j = 0; j < 5; j++) left += z[j] * z[j];
        near(Pk.a[2][2] * left, 1, 1e-14 * cond);
        rg_jacobi_free(&P);
        rg_sparse_free(&C);
    }
}

static void any_scale(void **state)
{
    (void)state;
    static const double scales[] = {1e-60, 1e-8, 1, 1e8, 1e60};
    for (int i = 0; i < 5; i++)
        for (int flat = 0; flat < 2; flat++) {
            unsigned seed = 4;
            rg_sparse C = rows(1, 5);
            for (int32_t j = 0; j < 5; j++) {
                const double x = noise(&seed), y = noise(&seed), z = noise(&seed);
                C.x[j] = rg_vec3_scale(scales[i], (rg_vec3){x, y, flat ? 0 : z});
            }
            rg_jacobi P = jacobi_of(&C);
            const block A = gram(&C, 0), Pk = applied(&P, 0);
            near(trace(times(A, Pk)), 3 - flat, 1e-10);
            rg_jacobi_free(&P);
            rg_sparse_free(&C);
        }
}

static void nan_is_not_lost(void **state)
{
    (void)state;
    unsigned seed = 5;
    for (int at = 0; at < 9; at++) {
        rg_sparse C = rows(1, 3);
        double r[3] = {1, 1.25, 2.385}, z[3];
        for (int32_t j = 0; j < 3; j++) C.x[j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
        double *entry[] = {&C.x[at / 3].x, &C.x[at / 3].y, &C.x[at / 3].z};
        *entry[at % 3] = NAN;
        rg_jacobi P = jacobi_of(&C);
        rg_jacobi_apply(&P, r, z);
        assert_true(isnan(z[0] + z[1] + z[2]));
        rg_jacobi_free(&P);
        rg_sparse_free(&C);
    }
}

static void memory(void **state)
{
    (void)state;
    rg_sparse C = rows(3, 4);
    counted c = {0, 0, 0};
    rg_memory mem = {counted_resize, &c};
    rg_jacobi P;
    assert_int_equal(rg_jacobi_init(&P, &mem, 3), RG_ENOMEM);
    rg_jacobi_free(&P);
    c.left = 100;
    assert_int_equal(rg_jacobi_init(&P, &mem, 3), RG_OK);
    const long asked = c.asked;
    double r[9] = {0}, z[9];
    rg_jacobi_update(&P, &C);
    rg_jacobi_apply(&P, r, z);
    assert_int_equal(c.asked, asked);
    rg_jacobi_free(&P);
    assert_int_equal(c.out, 0);
    rg_sparse_free(&C);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(folded_vertices),
        cmocka_unit_test(flat_vertices),
        cmocka_unit_test(nearly_flat_vertices),
        cmocka_unit_test(any_scale),
        cmocka_unit_test(nan_is_not_lost),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
