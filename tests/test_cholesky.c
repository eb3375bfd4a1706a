/* The direct solvers, by rows and by columns and by singular values, against each other and against properties that need
 * none of them, on regular, singular and inconsistent systems. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "linalg/cg.h"
#include "linalg/cholesky.h"
#include "linalg/rank.h"
#include "linalg/scale.h"
#include "near.h"

enum { MOST = 400 };

/* A grid of M x M vertices of degree 4: fewer creases than equations; the first crease of each loop is e_x, as in C. */
typedef struct grid { rg_sparse C; rg_scale S; int32_t start[82], col[MOST]; } grid;

static void grid_init(grid *g, int32_t side, int flat, unsigned seed)
{
    rg_memory mem = rg_mem_default(NULL);
    int32_t across = side * (side + 1), blocks = 0;
    for (int32_t i = 0; i < side; i++)
        for (int32_t j = 0; j < side; j++) {
            g->start[i * side + j] = blocks;
            int32_t left = i * (side + 1) + j, below = across + j * (side + 1) + i;
            int32_t col[] = {left, below, left + 1, below + 1};
            for (int a = 0; a < 4; a++) g->col[blocks++] = col[a];
        }
    g->start[side * side] = blocks;
    assert_int_equal(rg_sparse_init(&g->C, &mem, side * side, 2 * across, g->start, g->col), RG_OK);
    for (int32_t j = 0; j < blocks; j++) {
        double x = noise(&seed), y = noise(&seed), z = noise(&seed);
        g->C.x[j] = j % 4 == 0 ? (rg_vec3){1, 0, 0} : (rg_vec3){x, y, flat ? 0 : z};
    }
    assert_int_equal(rg_scale_init(&g->S, &mem, &g->C), RG_OK);
    rg_scale_update(&g->S, &g->C);
}

static void grid_free(grid *g)
{
    rg_scale_free(&g->S);
    rg_sparse_free(&g->C);
}

static double length(int32_t n, const double *a)
{
    double sum = 0;
    for (int32_t i = 0; i < n; i++) sum += a[i] * a[i];
    return sqrt(sum);
}

static void needs_svd(void)
{
    if (rg_pinv_built()) return;
    print_message("SKIPPED: built with GPL=0, no GSL\n");
    skip();
}

static void scaled_rows_are_orthonormal(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        grid g;
        grid_init(&g, 3, flat, 7);
        for (int32_t k = 0; k < g.C.M; k++) {
            double G[3][3] = {{0}};
            for (int32_t j = g.C.start[k]; j < g.C.start[k + 1]; j++) {
                double v[3] = {g.S.B.x[j].x, g.S.B.x[j].y, g.S.B.x[j].z};
                for (int a = 0; a < 3; a++)
                    for (int b = 0; b < 3; b++) G[a][b] += v[a] * v[b];
            }
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) near(G[a][b], a == b && !(flat && a == 2), 1e-14);
        }
        /* S (C x) = B x, and C^T (S^T y) = B^T y */
        double x[MOST], y[3 * 9], b[3 * 9], c[3 * 9], s[MOST], t[MOST];
        unsigned seed = 3;
        for (int i = 0; i < g.C.N; i++) x[i] = noise(&seed);
        for (int i = 0; i < 27; i++) y[i] = noise(&seed);
        rg_sparse_mul(&g.C, x, b);
        rg_scale_rows(&g.S, b);
        rg_sparse_mul(&g.S.B, x, c);
        for (int i = 0; i < 27; i++) near(b[i], c[i], 1e-13);
        rg_sparse_mul_t(&g.S.B, y, s);
        rg_scale_rows_t(&g.S, y);
        rg_sparse_mul_t(&g.C, y, t);
        for (int i = 0; i < g.C.N; i++) near(s[i], t[i], 1e-13);
        grid_free(&g);
    }
}

typedef struct solver { rg_cholesky L; const rg_sparse *B; } solver;

static void pinv(void *ctx, const double *r, double *z)
{
    solver *s = ctx;
    double y[3 * 81];
    rg_cholesky_apply(&s->L, r, y);
    rg_sparse_mul_t(s->B, y, z);
}

/* x = B^+ b by each of the three. */
static void three_solutions(const grid *g, const double *b, double x[3][MOST])
{
    rg_memory mem = rg_mem_default(NULL);
    const rg_sparse *B = &g->S.B;
    rg_cg_work w;
    rg_cg_report rep;
    assert_int_equal(rg_cg_work_init(&w, &mem, B->M, B->N), RG_OK);
    for (int shape = 0; shape < 2; shape++) {
        solver s = {.B = B};
        assert_int_equal(rg_cholesky_init(&s.L, &mem, B, shape ? RG_SHAPE_COLUMNS : RG_SHAPE_ROWS), RG_OK);
        rg_cholesky_update(&s.L, B);
        memset(x[shape], 0, sizeof x[shape]);
        rg_cg_refine(B, pinv, &s, b, x[shape], 1e-13, 0, 100, &w, &rep);
        assert_in_range(rep.stop, RG_CG_CONVERGED, RG_CG_LEAST_SQUARES);
        assert_in_range(rep.iterations, 0, 12);
        rg_cholesky_free(&s.L);
    }
    rg_cg_work_free(&w);
    rg_pinv svd;
    double y[3 * 81];
    assert_int_equal(rg_pinv_init(&svd, &mem, B->M, B->N), RG_OK);
    assert_int_equal(rg_pinv_update(&svd, B, NULL), RG_OK);
    rg_pinv_apply(&svd, b, x[2], y);
    rg_pinv_free(&svd);
}

static void rows_columns_and_singular_values_agree(void **state)
{
    (void)state;
    needs_svd();
    for (int flat = 0; flat < 2; flat++)
        for (int fits = 0; fits < 2; fits++) {
            grid g;
            grid_init(&g, 7, flat, 11);
            unsigned seed = 5;
            double b[3 * 49], x[3][MOST], c[3 * 49], s[MOST], v[MOST];
            assert_true(g.C.N < 3 * g.C.M);
            for (int i = 0; i < g.C.N; i++) v[i] = noise(&seed);
            for (int i = 0; i < 3 * g.C.M; i++) b[i] = noise(&seed);
            if (fits) rg_sparse_mul(&g.S.B, v, b);
            three_solutions(&g, b, x);
            for (int k = 0; k < 3; k++) {
                rg_sparse_mul(&g.S.B, x[k], c); /* the normal equations, B^T (b - B x) = 0 */
                for (int i = 0; i < 3 * g.C.M; i++) c[i] = b[i] - c[i];
                rg_sparse_mul_t(&g.S.B, c, s);
                double off = k < 2 && !fits ? 1e-5 : 1e-11; /* what is out of reach is amplified by 1 / beta */
                below(length(g.C.N, s), off);
                if (fits) below(length(3 * g.C.M, c), 1e-11);
                for (int i = 0; i < g.C.N; i++) near(x[k][i], x[2][i], 1e-5);
            }
            grid_free(&g);
        }
}

/* (B B^T + beta I) P r = r, whichever shape P comes from. */
static void apply_inverts(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    for (int flat = 0; flat < 2; flat++)
        for (int shape = 0; shape < 2; shape++) {
            grid g;
            rg_cholesky L;
            double v[MOST], x[MOST], r[3 * 25], y[3 * 25], c[3 * 25];
            unsigned seed = 17;
            grid_init(&g, 5, flat, 13);
            for (int i = 0; i < g.C.N; i++) v[i] = noise(&seed);
            rg_sparse_mul(&g.S.B, v, r);
            assert_int_equal(rg_cholesky_init(&L, &mem, &g.S.B, shape ? RG_SHAPE_COLUMNS : RG_SHAPE_ROWS), RG_OK);
            rg_cholesky_update(&L, &g.S.B);
            rg_cholesky_apply(&L, r, y);
            rg_sparse_mul_t(&g.S.B, y, x);
            rg_sparse_mul(&g.S.B, x, c);
            for (int i = 0; i < 75; i++) near(c[i] + L.beta * y[i], r[i], 1e-15 / L.beta);
            rg_cholesky_free(&L);
            grid_free(&g);
        }
}

/* What the sheet can do stays out of B^T P r, also with the factor of another state: that is what lets it be kept. */
static void a_stale_factor_moves_nothing_along_what_is_free(void **state)
{
    (void)state;
    needs_svd();
    rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    rg_scale S;
    rg_cholesky L;
    int32_t start[] = {0, 5}, col[] = {0, 1, 2, 3, 4};
    unsigned seed = 23;
    assert_int_equal(rg_sparse_init(&C, &mem, 1, 5, start, col), RG_OK);
    assert_int_equal(rg_scale_init(&S, &mem, &C), RG_OK);
    C.x[0] = (rg_vec3){1, 0, 0};
    for (int j = 1; j < 5; j++) C.x[j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
    rg_scale_update(&S, &C);
    for (int shape = 0; shape < 2; shape++) {
        assert_int_equal(rg_cholesky_init(&L, &mem, &S.B, shape ? RG_SHAPE_COLUMNS : RG_SHAPE_ROWS), RG_OK);
        rg_cholesky_update(&L, &S.B);
        for (int j = 1; j < 5; j++) S.B.x[j].x += 0.05 * noise(&seed);
        double r[3] = {0.3, -1.25, 2.385}, y[3], z[5], b[3];
        rg_cholesky_apply(&L, r, y);
        rg_sparse_mul_t(&S.B, y, z);
        rg_pinv svd;
        double x[5], yy[3]; /* the part of z in the row space is all of z */
        rg_sparse_mul(&S.B, z, b);
        assert_int_equal(rg_pinv_init(&svd, &mem, 1, 5), RG_OK);
        assert_int_equal(rg_pinv_update(&svd, &S.B, NULL), RG_OK);
        rg_pinv_apply(&svd, b, x, yy);
        for (int i = 0; i < 5; i++) near(x[i], z[i], 1e-12);
        rg_pinv_free(&svd);
        rg_cholesky_free(&L);
        rg_scale_update(&S, &C);
    }
    rg_scale_free(&S);
    rg_sparse_free(&C);
}

static void a_crease_at_no_vertex_is_left_alone(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    rg_cholesky L;
    int32_t start[] = {0, 3}, col[] = {0, 2, 3};
    double r[3] = {0.5, 2.385, 0}, y[3], z[4];
    assert_int_equal(rg_sparse_init(&C, &mem, 1, 4, start, col), RG_OK);
    C.x[0] = (rg_vec3){1, 0, 0}, C.x[1] = (rg_vec3){0, 1, 0}, C.x[2] = (rg_vec3){0.6, 0.8, 0};
    for (int shape = 0; shape < 2; shape++) {
        assert_int_equal(rg_cholesky_init(&L, &mem, &C, shape ? RG_SHAPE_COLUMNS : RG_SHAPE_ROWS), RG_OK);
        rg_cholesky_update(&L, &C);
        rg_cholesky_apply(&L, r, y);
        rg_sparse_mul_t(&C, y, z);
        near(z[1], 0, 0);
        rg_sparse_mul(&C, z, r);
        near(r[0], 0.5, 1e-15 / L.beta);
        near(r[1], 2.385, 1e-15 / L.beta);
        rg_cholesky_free(&L);
    }
    rg_sparse_free(&C);
}

static void no_vertex_at_all(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    rg_cholesky L;
    int32_t start[] = {0}, col[] = {0};
    assert_int_equal(rg_sparse_init(&C, &mem, 0, 2, start, col), RG_OK);
    assert_int_equal(rg_cholesky_init(&L, &mem, &C, RG_SHAPE_AUTO), RG_OK);
    rg_cholesky_update(&L, &C);
    double none[3] = {0};
    rg_cholesky_apply(&L, none, none);
    rg_cholesky_free(&L);
    rg_sparse_free(&C);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scaled_rows_are_orthonormal),
        cmocka_unit_test(rows_columns_and_singular_values_agree),
        cmocka_unit_test(apply_inverts),
        cmocka_unit_test(a_stale_factor_moves_nothing_along_what_is_free),
        cmocka_unit_test(a_crease_at_no_vertex_is_left_alone),
        cmocka_unit_test(no_vertex_at_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
