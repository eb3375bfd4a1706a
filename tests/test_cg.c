/* The conjugate gradient against a pseudo-inverse by singular values (GSL), on regular, singular and inconsistent systems. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "linalg/cg.h"
#include "linalg/jacobi.h"
#include "near.h"

#ifdef RG_GPL
#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#endif

/* A strip of M vertices: vertex k has its own `own` creases and shares one with the next vertex. */
typedef struct strip { rg_sparse C; int32_t start[40], col[400]; } strip;

static void strip_init(strip *s, int32_t M, int32_t own, unsigned seed)
{
    rg_memory mem = rg_mem_default(NULL);
    int32_t n = 0, blocks = 0;
    for (int32_t k = 0; k < M; k++) {
        s->start[k] = blocks;
        if (k) s->col[blocks++] = n - 1; /* shared with the one before */
        for (int32_t i = 0; i <= own; i++) s->col[blocks++] = n++;
    }
    s->start[M] = blocks;
    assert_int_equal(rg_sparse_init(&s->C, &mem, M, n, s->start, s->col), RG_OK);
    for (int32_t j = 0; j < blocks; j++) s->C.x[j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
}

/* x = C^+ b and the least norm of b - C x, by GSL alone. */
static double pseudo_inverse(const rg_sparse *C, const double *b, double *x)
{
#ifdef RG_GPL
    size_t m = 3 * (size_t)C->M, n = (size_t)C->N;
    gsl_matrix *A = gsl_matrix_calloc(n, m), *V = gsl_matrix_alloc(m, m); /* A = C^T, tall here */
    gsl_vector *S = gsl_vector_alloc(m), *w = gsl_vector_alloc(m);
    assert_true(n >= m);
    for (int32_t k = 0; k < C->M; k++)
        for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) {
            gsl_matrix_set(A, (size_t)C->col[j], 3 * (size_t)k, C->x[j].x);
            gsl_matrix_set(A, (size_t)C->col[j], 3 * (size_t)k + 1, C->x[j].y);
            gsl_matrix_set(A, (size_t)C->col[j], 3 * (size_t)k + 2, C->x[j].z);
        }
    gsl_matrix *keep = gsl_matrix_alloc(n, m);
    gsl_matrix_memcpy(keep, A);
    gsl_linalg_SV_decomp_jacobi(A, V, S);
    memset(x, 0, n * sizeof *x);
    for (size_t i = 0; i < m; i++) {
        double s = gsl_vector_get(S, i), c = 0;
        if (s <= 1e-12 * gsl_vector_get(S, 0)) continue;
        for (size_t k = 0; k < m; k++) c += gsl_matrix_get(V, k, i) * b[k];
        for (size_t k = 0; k < n; k++) x[k] += c / s * gsl_matrix_get(A, k, i);
    }
    double norm = 0;
    for (size_t r = 0; r < m; r++) {
        double left = b[r];
        for (size_t k = 0; k < n; k++) left -= gsl_matrix_get(keep, k, r) * x[k];
        norm += left * left;
    }
    gsl_matrix_free(A), gsl_matrix_free(V), gsl_matrix_free(keep), gsl_vector_free(S), gsl_vector_free(w);
    return sqrt(norm);
#else
    (void)C, (void)b, (void)x;
    print_message("SKIPPED: built with GPL=0, no GSL to compare with\n");
    skip();
    return 0;
#endif
}

static void solve(const rg_sparse *C, const double *b, double tol, double *x, rg_cg_report *rep)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_cg_work w;
    rg_jacobi P;
    double y[120] = {0};
    assert_int_equal(rg_cg_work_init(&w, &mem, C->M, C->N), RG_OK);
    assert_int_equal(rg_jacobi_init(&P, &mem, C->M), RG_OK);
    rg_jacobi_update(&P, C);
    rg_cg_solve(C, rg_jacobi_apply, &P, NULL, b, y, x, tol, 5000, &w, rep);
    double back[400];
    rg_sparse_mul_t(C, y, back); /* x is C^T y, also as returned */
    for (int32_t i = 0; i < C->N; i++) near(back[i], x[i], 0);
    rg_cg_work_free(&w);
    rg_jacobi_free(&P);
}

static void mul_and_mul_t_are_adjoint(void **state)
{
    (void)state;
    strip s;
    strip_init(&s, 6, 4, 7);
    unsigned seed = 11;
    double x[60], y[18], Cx[18], Cty[60], left = 0, right = 0;
    for (int i = 0; i < s.C.N; i++) x[i] = noise(&seed);
    for (int i = 0; i < 18; i++) y[i] = noise(&seed);
    rg_sparse_mul(&s.C, x, Cx);
    rg_sparse_mul_t(&s.C, y, Cty);
    for (int i = 0; i < 18; i++) left += y[i] * Cx[i];
    for (int i = 0; i < s.C.N; i++) right += x[i] * Cty[i];
    near(left, right, 1e-13);
    rg_sparse_free(&s.C);
}

static void a_column_with_three_blocks_is_refused(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    int32_t start[] = {0, 1, 2, 3}, col[] = {0, 0, 0};
    assert_int_equal(rg_sparse_init(&C, &mem, 3, 1, start, col), RG_EARG);
}

/* |b - C x| */
static double left_over(const rg_sparse *C, const double *b, const double *x)
{
    double Cx[24], sum = 0;
    assert_true(3 * C->M <= 24);
    rg_sparse_mul(C, x, Cx);
    for (int i = 0; i < 3 * C->M; i++) sum += (b[i] - Cx[i]) * (b[i] - Cx[i]);
    return sqrt(sum);
}

static void regular_system_gives_pseudo_inverse(void **state)
{
    (void)state;
    strip s;
    strip_init(&s, 8, 4, 3);
    unsigned seed = 5;
    double b[24], x[60], truth[60];
    rg_cg_report rep;
    for (int i = 0; i < 24; i++) b[i] = noise(&seed);
    pseudo_inverse(&s.C, b, truth);
    solve(&s.C, b, 1e-13, x, &rep);
    assert_int_equal(rep.stop, RG_CG_CONVERGED);
    below(left_over(&s.C, b, x), 1e-11);
    for (int i = 0; i < s.C.N; i++) near(x[i], truth[i], 1e-10);
    rg_sparse_free(&s.C);
}

/* Flat paper: no crease has a third component, so a third of the rows are zero. */
static void flat_state_consistent(void **state)
{
    (void)state;
    strip s;
    strip_init(&s, 8, 4, 3);
    for (int j = 0; j < s.start[8]; j++) s.C.x[j].z = 0;
    unsigned seed = 5;
    double b[24], x[60], truth[60], wish[60];
    rg_cg_report rep;
    for (int i = 0; i < s.C.N; i++) wish[i] = noise(&seed);
    rg_sparse_mul(&s.C, wish, b);
    below(pseudo_inverse(&s.C, b, truth), 1e-13);
    solve(&s.C, b, 1e-13, x, &rep);
    assert_int_equal(rep.stop, RG_CG_CONVERGED);
    for (int i = 0; i < s.C.N; i++) near(x[i], truth[i], 1e-10);
    rg_sparse_free(&s.C);
}

/* A right side out of reach: the part in reach is solved, the rest is named. */
static void flat_state_inconsistent(void **state)
{
    (void)state;
    strip s;
    strip_init(&s, 8, 4, 3);
    for (int j = 0; j < s.start[8]; j++) s.C.x[j].z = 0;
    unsigned seed = 5;
    double b[24], x[60], truth[60];
    rg_cg_report rep;
    for (int i = 0; i < 24; i++) b[i] = noise(&seed);
    double out_of_reach = pseudo_inverse(&s.C, b, truth);
    solve(&s.C, b, 1e-10, x, &rep);
    assert_in_range(rep.stop, RG_CG_CONVERGED, RG_CG_LEAST_SQUARES);
    near(left_over(&s.C, b, x), out_of_reach, 1e-9);
    assert_true(out_of_reach > 0.1);
    for (int i = 0; i < s.C.N; i++) near(x[i], truth[i], 1e-8);
    rg_sparse_free(&s.C);
}

/* Two vertices share all their creases with opposite signs, as on an over-constrained sheet: C C^T is singular although
 * each of its blocks is regular, and b does not fit. */
static void singular_between_vertices(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    int32_t start[] = {0, 6, 12}, col[] = {0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5};
    double b[6] = {0.3, -0.2, 0.7, -0.3, 0.2, -0.6}, x[6], truth[6];
    rg_cg_report rep;
    unsigned seed = 9;
    assert_int_equal(rg_sparse_init(&C, &mem, 2, 6, start, col), RG_OK);
    for (int j = 0; j < 6; j++) {
        C.x[j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
        C.x[j + 6] = rg_vec3_scale(-1, C.x[j]);
    }
    double out_of_reach = pseudo_inverse(&C, b, truth);
    solve(&C, b, 1e-10, x, &rep);
    near(left_over(&C, b, x), out_of_reach, 1e-9);
    for (int i = 0; i < 6; i++) near(x[i], truth[i], 1e-8);
    rg_sparse_free(&C);
}

static void warm_start_costs_less_and_says_the_same(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    strip s;
    strip_init(&s, 30, 4, 3);
    unsigned seed = 5;
    double b[90], x[200], cold[200], y[90] = {0};
    rg_cg_report first, again;
    rg_cg_work w;
    rg_jacobi P;
    for (int i = 0; i < 90; i++) b[i] = noise(&seed);
    assert_int_equal(rg_cg_work_init(&w, &mem, 30, s.C.N), RG_OK);
    assert_int_equal(rg_jacobi_init(&P, &mem, 30), RG_OK);
    rg_jacobi_update(&P, &s.C);
    rg_cg_solve(&s.C, rg_jacobi_apply, &P, NULL, b, y, cold, 1e-12, 5000, &w, &first);
    for (int i = 0; i < 90; i++) b[i] *= 1 + 1e-6 * noise(&seed);
    rg_cg_solve(&s.C, rg_jacobi_apply, &P, NULL, b, y, x, 1e-12, 5000, &w, &again);
    assert_int_equal(again.stop, RG_CG_CONVERGED);
    assert_true(again.iterations < first.iterations);
    for (int i = 0; i < s.C.N; i++) near(x[i], cold[i], 1e-3);
    rg_cg_work_free(&w);
    rg_jacobi_free(&P);
    rg_sparse_free(&s.C);
}

static void the_reason_has_a_name(void **state)
{
    (void)state;
    strip s;
    strip_init(&s, 8, 4, 3);
    double b[24], x[60], y[24] = {0};
    rg_cg_report rep;
    rg_memory mem = rg_mem_default(NULL);
    rg_cg_work w;
    rg_jacobi P;
    for (int i = 0; i < 24; i++) b[i] = 1;
    assert_int_equal(rg_cg_work_init(&w, &mem, 8, s.C.N), RG_OK);
    assert_int_equal(rg_jacobi_init(&P, &mem, 8), RG_OK);
    rg_jacobi_update(&P, &s.C);
    rg_cg_solve(&s.C, rg_jacobi_apply, &P, NULL, b, y, x, 1e-13, 2, &w, &rep);
    assert_int_equal(rep.stop, RG_CG_MAX_ITERATIONS);
    assert_int_equal(rep.iterations, 2);
    b[3] = NAN;
    memset(y, 0, sizeof y);
    rg_cg_solve(&s.C, rg_jacobi_apply, &P, NULL, b, y, x, 1e-13, 50, &w, &rep);
    assert_int_equal(rep.stop, RG_CG_BREAKDOWN);
    memset(b, 0, sizeof b);
    memset(y, 0, sizeof y);
    rg_cg_solve(&s.C, rg_jacobi_apply, &P, NULL, b, y, x, 1e-13, 50, &w, &rep);
    assert_int_equal(rep.stop, RG_CG_CONVERGED);
    near(x[0], 0, 0);
    rg_cg_work_free(&w);
    rg_jacobi_free(&P);
    rg_sparse_free(&s.C);
}

/* A solve of what is no number leaves nothing behind: the next one gives the bits of a first one. */
static void after_no_number(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    strip s;
    strip_init(&s, 6, 4, 7);
    unsigned seed = 3;
    double b[18], bad[18], x[2][60], y[18];
    for (int i = 0; i < 18; i++) b[i] = noise(&seed), bad[i] = NAN;
    for (int spoilt = 0; spoilt < 2; spoilt++) {
        rg_cg_work w;
        rg_jacobi P;
        rg_cg_report rep;
        assert_int_equal(rg_cg_work_init(&w, &mem, s.C.M, s.C.N), RG_OK);
        assert_int_equal(rg_jacobi_init(&P, &mem, s.C.M), RG_OK);
        rg_jacobi_update(&P, &s.C);
        memset(y, 0, sizeof y);
        if (spoilt) rg_cg_solve(&s.C, rg_jacobi_apply, &P, NULL, bad, y, x[1], 1e-12, 50, &w, &rep);
        memset(y, 0, sizeof y);
        rg_cg_solve(&s.C, rg_jacobi_apply, &P, NULL, b, y, x[spoilt], 1e-12, 500, &w, &rep);
        assert_int_equal(rep.stop, RG_CG_CONVERGED);
        rg_cg_work_free(&w);
        rg_jacobi_free(&P);
    }
    assert_memory_equal(x[0], x[1], (size_t)s.C.N * sizeof **x);
    rg_sparse_free(&s.C);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mul_and_mul_t_are_adjoint),
        cmocka_unit_test(a_column_with_three_blocks_is_refused),
        cmocka_unit_test(regular_system_gives_pseudo_inverse),
        cmocka_unit_test(flat_state_consistent),
        cmocka_unit_test(flat_state_inconsistent),
        cmocka_unit_test(singular_between_vertices),
        cmocka_unit_test(warm_start_costs_less_and_says_the_same),
        cmocka_unit_test(the_reason_has_a_name), cmocka_unit_test(after_no_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
