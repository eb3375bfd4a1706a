/* How many ways a folded sheet can go: against singular values, and against what is known of tessellations. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "folded.h"
#include "generate/generate.h"
#include "kinematics/mobility.h"
#include "motion/motion.h"

#ifdef RG_GPL
#include <gsl/gsl_linalg.h>
#endif

static rg_motion *motion_of(const char *kind, int32_t n, rg_triangulation triangulate, double to)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_settings s = rg_settings_default();
    rg_lines l;
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    s.triangulate = triangulate;
    s.frames = 7;
    s.to = to;
    s.adjust = 0;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, &why), RG_OK);
    rg_pattern *p = pattern_of(&l);
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, &why), RG_OK);
    rg_pattern_destroy(p);
    return m;
}

static int32_t ways_in(const rg_motion *m, int32_t frame)
{
    int32_t ways = -1;
    assert_int_equal(rg_motion_mobility(m, frame, &ways), RG_OK);
    return ways;
}

#ifdef RG_GPL
/* How F = chi_1 ... chi_n of each vertex, multiplied out as in Fig. 3, turns with each crease, by central differences, and their
 * singular values. */
static void turn_at(const rg_mesh *m, int32_t k, const double *rho, double *r)
{
    turn3 F = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) F = times(F, chi(rho[m->loop_crease[j]], m->loop_theta[j]));
    r[0] = (F.a[2][1] - F.a[1][2]) / 2, r[1] = (F.a[0][2] - F.a[2][0]) / 2, r[2] = (F.a[1][0] - F.a[0][1]) / 2;
}

static int32_t ways_by_singular_values(const rg_mesh *m, const double *rho)
{
    const size_t N = (size_t)m->N, rows = 3 * (size_t)m->M, tall = rows > N ? rows : N, wide = rows > N ? N : rows;
    const double h = 1e-5;
    gsl_matrix *A = gsl_matrix_calloc(tall, wide), *V = gsl_matrix_alloc(wide, wide);
    gsl_vector *S = gsl_vector_alloc(wide), *work = gsl_vector_alloc(wide);
    double *at = malloc(N * sizeof *at);
    assert_true(A && V && S && work && at);
    memcpy(at, rho, N * sizeof *at);
    for (int32_t k = 0; k < m->M; k++)
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
            const int32_t i = m->loop_crease[j];
            double more[3], less[3];
            at[i] = rho[i] + h, turn_at(m, k, at, more);
            at[i] = rho[i] - h, turn_at(m, k, at, less);
            at[i] = rho[i];
            for (size_t a = 0; a < 3; a++) {
                const size_t row = 3 * (size_t)k + a, col = (size_t)i;
                gsl_matrix_set(A, rows > N ? row : col, rows > N ? col : row, (more[a] - less[a]) / (2 * h));
            }
        }
    gsl_linalg_SV_decomp(A, V, S, work);
    int32_t rank = 0;
    for (size_t i = 0; i < wide; i++) rank += gsl_vector_get(S, i) > 1e-7; /* differences are good to 1e-10 */
    gsl_matrix_free(A), gsl_matrix_free(V), gsl_vector_free(S), gsl_vector_free(work), free(at);
    return m->N - rank;
}
#endif

static void agrees_with_singular_values(void **state)
{
    (void)state;
#ifndef RG_GPL
    print_message("SKIPPED: built with GPL=0, no GSL to compare with\n");
    skip();
#else
    static const struct { const char *kind; int32_t n; rg_triangulation triangulate; double to; } run[] = {
        {"miura", 2, RG_TRIANGULATE_NONE, 1}, {"miura", 5, RG_TRIANGULATE_NONE, 1}, {"miura", 5, RG_TRIANGULATE_ALL, 0.7},
        {"waterbomb", 2, RG_TRIANGULATE_NONE, 1}, {"kresling", 5, RG_TRIANGULATE_ALL, 0.2}, {"yoshimura", 3, RG_TRIANGULATE_NONE, 0.3},
        {"random", 5, RG_TRIANGULATE_NONE, 1}};
    for (size_t k = 0; k < sizeof run / sizeof *run; k++) {
        rg_motion *m = motion_of(run[k].kind, run[k].n, run[k].triangulate, run[k].to);
        for (int32_t f = 0; f < m->report.frame_count; f++)
            assert_int_equal(ways_in(m, f), ways_by_singular_values(&m->mesh, rg_motion_angles(m, f)));
        rg_motion_destroy(m);
    }
#endif
}

/* A Miura-ori of plates goes one way, whatever N - 3M says; flat, each vertex has two equations, and they are independent;
 * cut into triangles any sheet goes N0 - 3 ways. */
static void tessellations_go_the_ways_they_are_known_to(void **state)
{
    (void)state;
    for (int32_t n = 4; n <= 24; n += 5) {
        rg_motion *m = motion_of("miura", n, RG_TRIANGULATE_NONE, 0.9);
        assert_int_equal(m->report.outcome, RG_FOLDED);
        assert_int_equal(ways_in(m, 0), m->mesh.N - 2 * m->mesh.M);
        for (int32_t f = 1; f < m->report.frame_count; f++) assert_int_equal(ways_in(m, f), 1);
        rg_motion_destroy(m);
        m = motion_of("miura", n, RG_TRIANGULATE_ALL, 0.9);
        for (int32_t f = 1; f < m->report.frame_count; f++) assert_int_equal(ways_in(m, f), m->mesh.N0 - 3);
        rg_motion_destroy(m);
    }
}

static void there_is_no_other_frame(void **state)
{
    (void)state;
    int32_t ways = 7;
    rg_motion *m = motion_of("miura", 3, RG_TRIANGULATE_NONE, 1);
    assert_int_equal(rg_motion_mobility(m, -1, &ways), RG_EARG);
    assert_int_equal(rg_motion_mobility(m, m->report.frame_count, &ways), RG_EARG);
    assert_int_equal(ways, 7);
    rg_motion_destroy(m);
}

/* A sheet without a vertex, and one without a crease. */
static void nothing_constrains_a_single_crease(void **state)
{
    (void)state;
    for (int crease = 0; crease < 2; crease++) {
        rg_lines l = drawing();
        rg_motion *m = NULL;
        rg_settings s = rg_settings_default();
        draw_box(&l, 0, 0, 2, 1);
        if (crease) draw(&l, 'V', 1, 0, 1, 1);
        rg_pattern *p = pattern_of(&l);
        assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
        assert_int_equal(ways_in(m, 1), crease);
        rg_motion_destroy(m);
        rg_pattern_destroy(p);
    }
}

static void want_of_memory_is_told(void **state)
{
    (void)state;
    rg_motion *m = motion_of("miura", 4, RG_TRIANGULATE_NONE, 1);
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        const rg_memory mem = m->mesh.mem;
        int32_t ways = -1;
        m->mesh.mem = (rg_memory){counted_resize, &c};
        const rg_status s = rg_mobility(&m->mesh, rg_motion_pattern(m, 3), rg_motion_angles(m, 3), &ways);
        m->mesh.mem = mem;
        assert_int_equal(c.out, 0);
        if (s == RG_OK) {
            assert_int_equal(ways, 1);
            break;
        }
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(ways, -1);
    }
    rg_motion_destroy(m);
}

/* At another pattern of the same mesh it is that one's creases which count: where they all lie in one line, flat paper bends about it in
 * one way less than it has creases. */
static void another_pattern(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, -1, -1, 1, 1);
    for (int k = 0; k < 4; k++) draw(&l, k % 2 ? RG_VALLEY : RG_MOUNTAIN, 0, 0, k < 2 ? -1 : 1, k % 3 ? 1 : -1);
    rg_pattern *p = pattern_of(&l);
    rg_mesh m = mesh_of(p);
    rg_vec2 X[5];
    int32_t ways;
    const double rho[4] = {0};
    assert_int_equal(m.nv, 5);
    assert_int_equal(rg_mobility(&m, NULL, rho, &ways), RG_OK);
    assert_int_equal(ways, 2);
    memcpy(X, m.X, sizeof X);
    assert_int_equal(rg_mobility(&m, X, rho, &ways), RG_OK);
    assert_int_equal(ways, 2);
    for (int v = 0; v < 5; v++) X[v].y = 0;
    assert_int_equal(rg_mobility(&m, X, rho, &ways), RG_OK);
    assert_int_equal(ways, 3);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_singular_values),
        cmocka_unit_test(tessellations_go_the_ways_they_are_known_to),
        cmocka_unit_test(another_pattern),
        cmocka_unit_test(there_is_no_other_frame),
        cmocka_unit_test(nothing_constrains_a_single_crease),
        cmocka_unit_test(want_of_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
