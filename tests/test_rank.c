/* linalg/rank.c: the pseudo-inverse by what defines it: what is left is out of reach, and nothing is moved in vain. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
#include "linalg/rank.h"
#include "near.h"

enum { MOST = 120 };

/* A strip of M vertices: each has `own` creases of its own and shares one with the next. */
static rg_sparse strip(int32_t M, int32_t own, unsigned seed)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    int32_t start[MOST], col[10 * MOST], n = 0, blocks = 0;
    for (int32_t k = 0; k < M; k++) {
        start[k] = blocks;
        if (k) col[blocks++] = n - 1;
        for (int32_t i = 0; i < own + (k < M - 1); i++) col[blocks++] = n++;
    }
    start[M] = blocks;
    assert_int_equal(rg_sparse_init(&C, &mem, M, n, start, col), RG_OK);
    for (int32_t j = 0; j < blocks; j++) C.x[j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
    return C;
}

static rg_pinv pinv_of(const rg_sparse *C, const double *hold)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_pinv P;
    if (!rg_pinv_built()) {
        print_message("SKIPPED: built with GPL=0, no GSL\n");
        skip();
    }
    assert_int_equal(rg_pinv_init(&P, &mem, C->M, C->N), RG_OK);
    assert_int_equal(rg_pinv_update(&P, C, hold), RG_OK);
    return P;
}

static double dot(const double *a, const double *b, int32_t n)
{
    double sum = 0;
    for (int32_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void without(double *x, const double *hold, int32_t n)
{
    const double along = hold ? dot(x, hold, n) : 0;
    for (int32_t i = 0; hold && i < n; i++) x[i] -= along * hold[i];
}

/* With A = C (I - n n^T): A^T (b - A x) = 0, and x = A^T y, so that x has no part that A does not feel. These two make x
 * the pseudo-inverse's answer, whatever the rank. */
static void defines(const rg_sparse *C, const double *hold, const double *b, double tol)
{
    rg_pinv P = pinv_of(C, hold);
    double x[MOST], y[MOST], Ax[MOST], left[MOST], back[MOST];
    rg_pinv_apply(&P, b, x, y);
    memcpy(left, x, sizeof left);
    without(left, hold, C->N);
    rg_sparse_mul(C, left, Ax);
    for (int32_t i = 0; i < 3 * C->M; i++) left[i] = b[i] - Ax[i];
    rg_sparse_mul_t(C, left, back);
    without(back, hold, C->N);
    for (int32_t i = 0; i < C->N; i++) near(back[i], 0, tol);
    rg_sparse_mul_t(C, y, back);
    without(back, hold, C->N);
    for (int32_t i = 0; i < C->N; i++) near(back[i], x[i], tol);
    if (hold) near(dot(x, hold, C->N), 0, tol);
    rg_pinv_free(&P);
}

static void any_b(double *b, int32_t n, unsigned seed)
{
    for (int32_t i = 0; i < n; i++) b[i] = noise(&seed);
}

static void wide_and_tall(void **state)
{
    (void)state;
    double b[MOST], hold[MOST];
    for (unsigned round = 0; round < 30; round++) {
        const int32_t M = 1 + (int32_t)round % 9, own = 1 + (int32_t)round % 5; /* own < 2: more rows than columns */
        rg_sparse C = strip(M, own, round);
        any_b(b, 3 * M, round + 100);
        any_b(hold, C.N, round + 200);
        const double length = sqrt(dot(hold, hold, C.N));
        for (int32_t i = 0; i < C.N; i++) hold[i] /= length;
        defines(&C, NULL, b, 1e-9);
        if (C.N > 1) defines(&C, hold, b, 1e-8);
        rg_sparse_free(&C);
    }
}

/* Rank, where it is known: full, flat, all creases of a vertex on one line, all numbers zero, one crease taken away. */
static void ranks(void **state)
{
    (void)state;
    double b[MOST];
    for (int kind = 0; kind < 5; kind++) {
        rg_sparse C = strip(6, 4, 17);
        const int32_t blocks = C.start[6];
        any_b(b, 18, 5);
        for (int32_t j = 0; j < blocks; j++) {
            if (kind == 1) C.x[j].z = 0;
            if (kind == 2 && C.row[j] == 3) C.x[j] = rg_vec3_scale(C.x[j].x, (rg_vec3){0.3, -0.5, 0.7});
            if (kind == 3) C.x[j] = (rg_vec3){0, 0, 0};
            if (kind == 4 && C.row[j] == 5 && j > C.start[5] + 1) C.x[j] = (rg_vec3){0, 0, 0}; /* two creases are left there */
        }
        static const int rank[] = {18, 12, 16, 0, 17};
        rg_pinv P = pinv_of(&C, NULL);
        assert_int_equal(P.rank, rank[kind]);
        rg_pinv_free(&P);
        defines(&C, NULL, b, 1e-10);
        rg_sparse_free(&C);
    }
}

/* Held along a crease that nothing else can replace, the rank falls by one. */
static void holding_takes_a_direction(void **state)
{
    (void)state;
    rg_sparse C = strip(1, 3, 4);
    double hold[3] = {0.6, 0, 0.8}, b[3] = {1, 1.25, -0.3};
    rg_pinv P = pinv_of(&C, NULL);
    assert_int_equal(P.rank, 3);
    assert_int_equal(rg_pinv_update(&P, &C, hold), RG_OK);
    assert_int_equal(P.rank, 2);
    rg_pinv_free(&P);
    defines(&C, hold, b, 1e-12);
    rg_sparse_free(&C);
}

static void nothing_to_solve(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    rg_pinv P;
    const int32_t start[] = {0}, col[] = {0};
    rg_sparse C;
    if (!rg_pinv_built()) {
        print_message("SKIPPED: built with GPL=0, no GSL\n");
        assert_int_equal(rg_pinv_init(&P, &mem, 2, 3), RG_EABSENT);
        rg_pinv_free(&P);
        skip();
    }
    double x[2] = {7, 7}, b = 0, y = 0;
    assert_int_equal(rg_sparse_init(&C, &mem, 0, 2, start, col), RG_OK);
    assert_int_equal(rg_pinv_init(&P, &mem, 0, 2), RG_OK);
    assert_int_equal(rg_pinv_update(&P, &C, NULL), RG_OK);
    rg_pinv_apply(&P, &b, x, &y);
    near(x[0], 0, 0);
    near(x[1], 0, 0);
    rg_pinv_free(&P);
    rg_sparse_free(&C);
}

static void memory(void **state)
{
    (void)state;
    rg_sparse C = strip(6, 4, 17);
    double b[MOST], x[MOST], y[MOST];
    any_b(b, 18, 5);
    rg_pinv probe = pinv_of(&C, NULL); /* skips where there is none */
    rg_pinv_free(&probe);
    rg_status s = RG_ENOMEM;
    for (long k = 0; s != RG_OK; k++) {
        counted c = {k, 0, 0};
        rg_memory mem = {counted_resize, &c};
        rg_pinv P;
        assert_true(k < 30);
        s = rg_pinv_init(&P, &mem, C.M, C.N);
        assert_true(s == RG_OK || s == RG_ENOMEM);
        const long asked = c.asked;
        if (s == RG_OK) {
            assert_int_equal(rg_pinv_update(&P, &C, NULL), RG_OK);
            rg_pinv_apply(&P, b, x, y);
            assert_int_equal(c.asked, asked);
        }
        rg_pinv_free(&P);
        assert_int_equal(c.out, 0);
    }
    rg_sparse_free(&C);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wide_and_tall),
        cmocka_unit_test(ranks),
        cmocka_unit_test(holding_takes_a_direction),
        cmocka_unit_test(nothing_to_solve),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
