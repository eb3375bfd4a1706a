/* Sums of squares of sparse rows, against a dense matrix and elimination by Gauss; rows that come, go, and do not fit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
#include "linalg/normal.h"
#include "near.h"

enum { N = 40 };

/* b <- A \ b */
static void eliminate(double A[N][N], double *b)
{
    for (int i = 0; i < N; i++)
        for (int k = i + 1; k < N; k++) {
            const double f = A[k][i] / A[i][i];
            for (int j = i; j < N; j++) A[k][j] -= f * A[i][j];
            b[k] -= f * b[i];
        }
    for (int i = N - 1; i >= 0; i--) {
        for (int j = i + 1; j < N; j++) b[i] -= A[i][j] * b[j];
        b[i] /= A[i][i];
    }
}

/* A list's rows with their weights: into L.x and, from the numbers that were given, into A. */
static void lay(const rg_normal *n, const rg_rows *rows, const rg_slots *slots, const double *w, double A[N][N])
{
    rg_normal_add(rows, slots, w, n->L.x);
    for (int32_t i = 0; i < slots->rows; i++)
        for (int32_t p = rows->start[i]; p < rows->start[i + 1]; p++)
            for (int32_t q = rows->start[i]; q < rows->start[i + 1]; q++)
                A[rows->col[p]][rows->col[q]] += (w ? w[i] : 1) * rows->x[p] * rows->x[q];
}

static void against_dense(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_normal n;
    rg_rows chain, more;
    rg_slots chain_slots = {0}, more_slots = {0};
    unsigned seed = 29;
    int fits;
    assert_int_equal(rg_normal_init(&n, &mem, N), RG_OK);
    assert_int_equal(rg_rows_init(&chain, &mem), RG_OK);
    assert_int_equal(rg_rows_init(&more, &mem), RG_OK);
    for (int32_t j = 0; j < N; j++) {
        const int32_t col[] = {j, (j + 1) % N, (j + 2) % N};
        const double x[] = {1.5 + noise(&seed), noise(&seed), noise(&seed)};
        assert_int_equal(rg_rows_add(&chain, 3, col, x), RG_OK);
    }
    const rg_rows *lists[] = {&chain, &more};
    assert_int_equal(rg_normal_analyse(&n, lists, 1), RG_OK);
    assert_int_equal(rg_normal_find(&n, &chain, &chain_slots, &fits), RG_OK);
    assert_true(fits);
    for (int round = 0; round < 3; round++) {
        const int32_t far[] = {3, 17, 31, 3}, near_by[] = {5, 6};
        const double x[] = {noise(&seed), noise(&seed), noise(&seed), 0.4};
        assert_int_equal(rg_rows_add(&more, 2, near_by, x), RG_OK);
        assert_int_equal(rg_normal_find(&n, &more, &more_slots, &fits), RG_OK);
        assert_true(fits); /* what is filled in has its place too */
        assert_int_equal(rg_rows_add(&more, 4, far, x), RG_OK);
        near(rg_rows_dot(&more, more.count - 1, (double[N]){[3] = 2, [17] = 1}), 2 * (x[0] + x[3]) + x[1], 1e-14); /* 3 twice: added up */
        assert_int_equal(rg_normal_find(&n, &more, &more_slots, &fits), RG_OK);
        assert_int_equal(fits, round > 0);
        if (!fits) {
            assert_int_equal(more_slots.rows, 1);
            assert_int_equal(rg_normal_analyse(&n, lists, 2), RG_OK);
            chain_slots.rows = more_slots.rows = 0, chain_slots.used = more_slots.used = 0;
            assert_int_equal(rg_normal_find(&n, &chain, &chain_slots, &fits), RG_OK);
            assert_int_equal(rg_normal_find(&n, &more, &more_slots, &fits), RG_OK);
            assert_true(fits);
        }
        double A[N][N] = {{0}}, b[N], y[N], w[8];
        for (int i = 0; i < 8; i++) w[i] = i == 1 ? 0 : 1.5 + noise(&seed);
        rg_supernodal_clear(&n.L);
        lay(&n, &chain, &chain_slots, NULL, A);
        lay(&n, &more, &more_slots, w, A);
        for (int j = 0; j < N; j++) {
            A[j][j] += 0.25;
            n.L.x[n.diagonal[j]] += 0.25;
            b[j] = y[j] = noise(&seed);
        }
        assert_true(rg_supernodal_factor(&n.L, 0));
        rg_supernodal_solve(&n.L, y);
        eliminate(A, b);
        for (int j = 0; j < N; j++) near(y[j], b[j], 1e-11);
    }
    assert_int_equal(n.analyses, 2);
    rg_normal_free_slots(&mem, &chain_slots);
    rg_normal_free_slots(&mem, &more_slots);
    rg_rows_free(&chain);
    rg_rows_free(&more);
    rg_normal_free(&n);
}

static rg_status all_of_it(const rg_memory *mem)
{
    rg_normal n = {0};
    rg_rows rows = {0};
    rg_slots slots = {0};
    const int32_t col[] = {0, 1, 2};
    const double x[] = {1, 2, 3};
    int fits = 1;
    rg_status s = rg_normal_init(&n, mem, N);
    if (s == RG_OK) s = rg_rows_init(&rows, mem);
    for (int i = 0; i < 40 && s == RG_OK; i++) s = rg_rows_add(&rows, 3, col, x);
    const rg_rows *lists[] = {&rows};
    if (s == RG_OK) s = rg_normal_analyse(&n, lists, 1);
    if (s == RG_OK) s = rg_normal_find(&n, &rows, &slots, &fits);
    assert_true(fits);
    rg_normal_free_slots(mem, &slots);
    rg_rows_free(&rows);
    rg_normal_free(&n);
    return s;
}

static void without_memory(void **state)
{
    (void)state;
    long k = 0;
    rg_status s = RG_ENOMEM;
    for (; s != RG_OK; k++) {
        counted c = {.left = k};
        const rg_memory mem = {counted_resize, &c};
        s = all_of_it(&mem);
        assert_true(s == RG_OK || s == RG_ENOMEM);
        assert_int_equal(c.out, 0);
        assert_true(k < 1000);
    }
    assert_true(k > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(against_dense), cmocka_unit_test(without_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
