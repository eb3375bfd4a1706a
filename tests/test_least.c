/* linalg/least.c: the least step that does what it must, by what defines it, for matrices of full rank and of less. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
#include "linalg/least.h"
#include "near.h"

enum { ROWS = 60, COLUMNS = 120 };

/* A dense copy, row by row. */
typedef struct dense { int32_t rows, columns; double a[ROWS][COLUMNS]; } dense;

static dense copy_of(const rg_least *A)
{
    dense d = {A->rows, A->columns, {{0}}};
    for (int32_t c = 0; c < A->columns; c++)
        for (int32_t j = A->start[c]; j < A->start[c + 1]; j++) d.a[A->row[j]][c] = A->x[j];
    return d;
}

static void times(const dense *d, const double *x, double *y)
{
    for (int32_t i = 0; i < d->rows; i++) {
        y[i] = 0;
        for (int32_t j = 0; j < d->columns; j++) y[i] += d->a[i][j] * x[j];
    }
}

/* Some rows of each column, now and then none. */
static rg_least random_step(const rg_memory *mem, int32_t rows, int32_t columns, unsigned *seed)
{
    rg_least A;
    int32_t start[COLUMNS + 1] = {0}, row[COLUMNS * 5];
    for (int32_t c = 0; c < columns; c++) {
        int32_t at = start[c];
        for (int32_t i = 0; i < rows; i++)
            if (at - start[c] < 5 && noise(seed) > 1 - 6.0 / rows) row[at++] = i;
        start[c + 1] = at;
    }
    assert_int_equal(rg_least_init(&A, mem, rows, columns, start, row), RG_OK);
    for (int32_t j = 0; j < start[columns]; j++) A.x[j] = noise(seed);
    return A;
}

/* Makes x the one answer: A x = b, and x has no part that A does not feel, as it is A^T of something. That something is found
 * here by elimination with complete pivoting of A A^T, not by the library. */
static void project_on_rows(const dense *d, const double *x, double *onto)
{
    const int32_t m = d->rows;
    static double G[ROWS][ROWS + 1];
    double y[ROWS] = {0};
    int32_t of[ROWS], rank = 0;
    for (int32_t i = 0; i < m; i++) {
        of[i] = i;
        for (int32_t j = 0; j < m; j++) {
            G[i][j] = 0;
            for (int32_t k = 0; k < d->columns; k++) G[i][j] += d->a[i][k] * d->a[j][k];
        }
        G[i][m] = 0;
        for (int32_t k = 0; k < d->columns; k++) G[i][m] += d->a[i][k] * x[k];
    }
    for (; rank < m; rank++) {
        int32_t r = rank, c = rank;
        for (int32_t i = rank; i < m; i++)
            for (int32_t j = rank; j < m; j++)
                if (fabs(G[i][of[j]]) > fabs(G[r][of[c]])) r = i, c = j;
        if (!(fabs(G[r][of[c]]) > 1e-10)) break;
        for (int32_t j = 0; j <= m; j++) {
            const double swap = G[rank][j];
            G[rank][j] = G[r][j];
            G[r][j] = swap;
        }
        const int32_t column = of[c];
        of[c] = of[rank];
        of[rank] = column;
        for (int32_t i = 0; i < m; i++) {
            const double by = i == rank ? 0 : G[i][column] / G[rank][column];
            for (int32_t j = 0; j <= m && by != 0; j++) G[i][j] -= by * G[rank][j];
        }
    }
    for (int32_t i = 0; i < rank; i++) y[of[i]] = G[i][m] / G[i][of[i]];
    for (int32_t k = 0; k < d->columns; k++) {
        onto[k] = 0;
        for (int32_t i = 0; i < m; i++) onto[k] += d->a[i][k] * y[i];
    }
}

static void is_least(rg_least *A, const double *b, double tol)
{
    const dense d = copy_of(A);
    double x[COLUMNS], onto[COLUMNS], Ax[ROWS], back[COLUMNS];
    rg_least_renew(A);
    rg_least_solve(A, b, x);
    times(&d, x, Ax);
    for (int32_t i = 0; i < A->rows; i++) near(Ax[i], b[i], tol);
    project_on_rows(&d, x, onto);
    for (int32_t i = 0; i < A->columns; i++) near(x[i], onto[i], tol);
    rg_least_mul_t(A, A->y, back);
    for (int32_t i = 0; i < A->columns; i++) near(x[i], back[i], tol);
}

static void wanted(const rg_least *A, unsigned *seed, double *b)
{
    const dense d = copy_of(A);
    double x[COLUMNS];
    for (int32_t i = 0; i < A->columns; i++) x[i] = noise(seed);
    times(&d, x, b);
}

static void products(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 3;
    for (int round = 0; round < 20; round++) {
        rg_least A = random_step(&mem, 1 + 3 * round, 2 + 5 * round, &seed);
        const dense d = copy_of(&A);
        double x[COLUMNS], y[ROWS], z[COLUMNS], Ax[ROWS], Aty[COLUMNS];
        for (int32_t i = 0; i < A.columns; i++) x[i] = noise(&seed);
        for (int32_t i = 0; i < A.rows; i++) y[i] = noise(&seed);
        rg_least_mul(&A, x, Ax);
        times(&d, x, z);
        for (int32_t i = 0; i < A.rows; i++) near(Ax[i], z[i], 1e-14);
        rg_least_mul_t(&A, y, Aty);
        for (int32_t c = 0; c < A.columns; c++) {
            double sum = 0;
            for (int32_t i = 0; i < A.rows; i++) sum += d.a[i][c] * y[i];
            near(Aty[c], sum, 1e-14);
        }
        rg_least_free(&A);
        rg_least_free(&A);
    }
}

static void wide_and_narrow(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 4;
    for (int round = 0; round < 40; round++) { /* more rows than columns: never of full rank */
        const int32_t rows = 2 + round, columns = round % 2 ? 3 + round / 2 : 5 + 2 * round;
        rg_least A = random_step(&mem, rows, columns, &seed);
        double b[ROWS];
        for (int again = 0; again < 3; again++) {
            wanted(&A, &seed, b);
            is_least(&A, b, 1e-8);
            for (int32_t j = 0; j < A.start[A.columns]; j++) A.x[j] = noise(&seed);
        }
        rg_least_free(&A);
    }
}

/* Flat paper: every third row has nothing but zeros, others are copies of their neighbours. */
static void zero_rows_and_double_rows(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 5;
    for (int round = 0; round < 20; round++) {
        const int32_t m = 3 * (2 + round % 8), n = 2 * m + round;
        int32_t start[COLUMNS + 1], row[COLUMNS * 3];
        rg_least A;
        for (int32_t c = 0; c <= n; c++) start[c] = 3 * c;
        for (int32_t c = 0; c < n; c++)
            for (int32_t i = 0; i < 3; i++) row[3 * c + i] = 3 * (c % (m / 3)) + i;
        assert_int_equal(rg_least_init(&A, &mem, m, n, start, row), RG_OK);
        for (int32_t c = 0; c < n; c++) {
            A.x[3 * c] = noise(&seed);
            A.x[3 * c + 1] = c % 3 ? A.x[3 * c] : noise(&seed);
            if (round % 2) A.x[3 * c + 1] = A.x[3 * c];
        }
        double b[ROWS];
        wanted(&A, &seed, b);
        is_least(&A, b, 1e-9);
        memset(b, 0, sizeof b);
        is_least(&A, b, 0);
        rg_least_free(&A);
    }
}

/* Rows of length 1, where there are any entries. */
static void even_out(rg_least *A)
{
    double square[ROWS] = {0};
    for (int32_t j = 0; j < A->start[A->columns]; j++) square[A->row[j]] += A->x[j] * A->x[j];
    for (int32_t j = 0; j < A->start[A->columns]; j++) A->x[j] /= sqrt(square[A->row[j]]);
}

/* What no column can do is left alone: the step is that for the part of b within reach, by A^T A x = A^T b. */
static void out_of_reach(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 6;
    for (int round = 0; round < 30; round++) {
        const int32_t rows = 4 + round;
        rg_least A = random_step(&mem, rows, 2 + round / 3, &seed);
        even_out(&A);
        const dense d = copy_of(&A);
        double b[ROWS], x[COLUMNS], Ax[ROWS], onto[COLUMNS], was = 0, is = 0;
        for (int32_t i = 0; i < rows; i++) b[i] = noise(&seed);
        rg_least_renew(&A);
        rg_least_solve(&A, b, x);
        times(&d, x, Ax);
        for (int32_t i = 0; i < rows; i++) was += b[i] * b[i], is += (b[i] - Ax[i]) * (b[i] - Ax[i]);
        below(is, was * (1 + 1e-9));
        project_on_rows(&d, x, onto);
        for (int32_t i = 0; i < A.columns; i++) near(x[i], onto[i], 1e-8);
        for (int32_t c = 0; c < A.columns; c++) {
            double left = 0;
            for (int32_t i = 0; i < rows; i++) left += d.a[i][c] * (b[i] - Ax[i]);
            near(left, 0, 1e-7);
        }
        rg_least_free(&A);
    }
}

/* Damped, x is where the slope of |A x - b|^2 + damping |x|^2 is zero, whether b can be reached or not. */
static void damped(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 77;
    for (int k = 0; k < 8; k++) {
        rg_least A = random_step(&mem, k % 2 ? 40 : 25, k % 2 ? 25 : 60, &seed);
        for (int32_t j = A.start[4]; k >= 4 && j < A.start[A.columns]; j++) A.x[j] *= 1e-5; /* hardly any column reaches */
        const dense d = copy_of(&A);
        double b[ROWS], x[COLUMNS], Ax[ROWS], size = 0;
        for (int32_t i = 0; i < A.rows; i++) b[i] = noise(&seed);
        for (double damping = 1e-6; damping < 1; damping *= 30) {
            A.damping = damping;
            rg_least_renew(&A);
            rg_least_solve(&A, b, x);
            times(&d, x, Ax);
            for (int32_t c = 0; c < A.columns; c++) {
                double slope = damping * x[c];
                for (int32_t i = 0; i < A.rows; i++) slope += d.a[i][c] * (Ax[i] - b[i]);
                near(slope, 0, 1e-14 / damping); /* rounding over the least pivot */
                size = fmax(size, fabs(x[c]));
            }
        }
        assert_true(size > 1e-3);
        rg_least_free(&A);
    }
}

static void not_a_number(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 7;
    rg_least A = random_step(&mem, 12, 30, &seed);
    double b[ROWS], x[COLUMNS];
    wanted(&A, &seed, b);
    A.x[5] = NAN;
    rg_least_renew(&A);
    rg_least_solve(&A, b, x); /* ends */
    A.x[5] = 0.75;
    wanted(&A, &seed, b);
    is_least(&A, b, 1e-8);
    rg_least_free(&A);
}

static void nothing_at_all(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    const int32_t start[4] = {0, 0, 0, 0};
    double b[2] = {0.25, -1.5}, x[3] = {7, 7, 7};
    for (int32_t rows = 0; rows <= 2; rows++) {
        rg_least A;
        assert_int_equal(rg_least_init(&A, &mem, rows, 3, start, start), RG_OK);
        rg_least_renew(&A);
        rg_least_solve(&A, b, x);
        for (int i = 0; i < 3; i++) near(x[i], 0, 0);
        rg_least_free(&A);
    }
}

static void memory(void **state)
{
    (void)state;
    counted c = {1000000, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    unsigned seed = 8;
    int32_t start[11], row[30];
    double b[9], x[10], again[10];
    for (int32_t i = 0; i <= 10; i++) start[i] = 3 * i;
    for (int32_t i = 0; i < 30; i++) row[i] = (i % 3) * 3 + i / 3 % 3;
    rg_least A;
    for (long k = 0;; k++) {
        c.left = k;
        const rg_status s = rg_least_init(&A, &mem, 9, 10, start, row);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(c.out, 0);
    }
    for (int i = 0; i < 30; i++) A.x[i] = noise(&seed);
    for (int i = 0; i < 9; i++) b[i] = noise(&seed);
    c.left = 0;
    const long asked = c.asked;
    rg_least_renew(&A);
    rg_least_solve(&A, b, x);
    rg_least_renew(&A);
    rg_least_solve(&A, b, again);
    assert_memory_equal(x, again, sizeof x);
    assert_int_equal(c.asked, asked);
    rg_least_free(&A);
    assert_int_equal(c.out, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products), cmocka_unit_test(wide_and_narrow), cmocka_unit_test(zero_rows_and_double_rows),
        cmocka_unit_test(out_of_reach), cmocka_unit_test(damped), cmocka_unit_test(not_a_number), cmocka_unit_test(nothing_at_all),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
