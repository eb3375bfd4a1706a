/* kinematics/constraint.c: C and r of whole sheets, against products of rotation matrices written out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "folded.h"
#include "kinematics/constraint.h"

enum { MOST = 40 };

static rg_constraint constraint_of(const rg_mesh *m)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_constraint K;
    assert_int_equal(rg_constraint_init(&K, &mem, m), RG_OK);
    assert_int_equal(K.C.M, m->M);
    assert_int_equal(K.C.N, m->N);
    return K;
}

/* F of interior vertex k, from the drawing: its creases by their directions, angles between them by these. */
static turn3 vertex_trip(const rg_mesh *m, int32_t k, const double *rho)
{
    const int32_t start = m->loop_start[k], n = m->loop_start[k + 1] - start;
    double fold[MOST], theta[MOST], angle[MOST + 1];
    assert_true(n <= MOST);
    for (int32_t i = 0; i <= n; i++) {
        const int32_t e = m->crease_edge[m->loop_crease[start + i % n]], v = m->inner_vertex[k];
        const rg_vec2 far = m->X[m->edge[e][m->edge[e][0] == v]];
        angle[i] = atan2(far.y - m->X[v].y, far.x - m->X[v].x);
        if (i < n) fold[i] = rho[m->loop_crease[start + i]];
        if (i) theta[i - 1] = fmod(angle[i] - angle[i - 1] + 4 * RG_PI, 2 * RG_PI);
    }
    return round_trip(n, fold, theta);
}

static double trip_angle(turn3 F)
{
    const double x = F.a[2][1] - F.a[1][2], y = F.a[0][2] - F.a[2][0], z = F.a[1][0] - F.a[0][1];
    return atan2(sqrt(x * x + y * y + z * z), F.a[0][0] + F.a[1][1] + F.a[2][2] - 1);
}

/* Every block of C, and r, by central differences at fold angles that do not close. */
static void against_differences(const rg_mesh *m, unsigned *seed)
{
    const double h = 1e-5;
    double *rho = malloc((size_t)(m->N + 1) * sizeof *rho), worst = 0;
    rg_constraint K = constraint_of(m);
    for (int32_t i = 0; i < m->N; i++) rho[i] = 1.385 * noise(seed);
    const double closure = rg_constraint_assemble(&K, rho);
    for (int32_t k = 0; k < m->M; k++) {
        const turn3 F = vertex_trip(m, k, rho);
        worst = fmax(worst, trip_angle(F));
        near(K.r[3 * k], (F.a[2][1] - F.a[1][2]) / 2, 1e-12);
        near(K.r[3 * k + 1], (F.a[0][2] - F.a[2][0]) / 2, 1e-12);
        near(K.r[3 * k + 2], (F.a[1][0] - F.a[0][1]) / 2, 1e-12);
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
            const int32_t crease = m->loop_crease[j];
            const double at = rho[crease];
            double d[3][3] = {{0}};
            rho[crease] = at + h;
            const turn3 more = vertex_trip(m, k, rho);
            rho[crease] = at - h;
            const turn3 less = vertex_trip(m, k, rho);
            rho[crease] = at;
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    for (int c = 0; c < 3; c++) d[a][b] += (more.a[a][c] - less.a[a][c]) / (2 * h) * F.a[b][c];
            near(K.C.x[j].x, d[2][1], 1e-8);
            near(K.C.x[j].y, d[0][2], 1e-8);
            near(K.C.x[j].z, d[1][0], 1e-8);
        }
    }
    near(closure, worst, 1e-12);
    rg_constraint_free(&K);
    rg_constraint_free(&K);
    free(rho);
}

static void any_sheet(void **state)
{
    (void)state;
    unsigned seed = 31;
    int done = 0;
    for (int round = 0; round < 60; round++) {
        rg_lines l = drawing();
        draw_patchwork(&l, 2 + round % 5, 0.05 * (round % 10), &seed);
        rg_pattern *p = pattern_of(&l);
        rg_memory mem = rg_mem_default(NULL);
        rg_mesh m, t;
        if (rg_mesh_from_pattern(p, &mem, &m, NULL) == RG_OK) {
            against_differences(&m, &seed);
            assert_int_equal(rg_triangulate_all(&m, &t), RG_OK);
            against_differences(&t, &seed);
            rg_mesh_free(&t);
            rg_mesh_free(&m);
            done++;
        }
        rg_pattern_destroy(p);
    }
    assert_true(done > 40);
}

/* A whole sheet at angles that are known to close. */
static void miura_closes(void **state)
{
    (void)state;
    static const double alphas[] = {0.6, 1.1, 1.385}, angles[] = {0, 1e-6, 0.4, 1.7, 3.0, 3.14159, RG_PI};
    for (int a = 0; a < 3; a++) {
        rg_pattern *p = draw_miura(5, alphas[a]);
        rg_mesh m = mesh_of(p);
        rg_constraint K = constraint_of(&m);
        double rho[100];
        assert_int_equal(m.M, 16);
        assert_int_equal(m.N, 40);
        for (int i = 0; i < 7; i++) {
            miura_angles(&m, alphas[a], angles[i], rho);
            below(rg_constraint_assemble(&K, rho), 1e-13);
            for (int k = 0; k < 48; k++) below(fabs(K.r[k]), 1e-13);
            int32_t worst = 7;
            below(rg_constraint_closure(&K, rho, &worst), 1e-13);
        }
        miura_angles(&m, alphas[a], 1.7, rho);
        rho[17] += 0.01; /* off at the two ends of one crease, and told so */
        int32_t worst = -1;
        const double closure = rg_constraint_closure(&K, rho, &worst);
        near(closure, 0.01, 1e-4);
        const int32_t v = m.inner_vertex[worst], e = m.crease_edge[17];
        assert_true(v == m.edge[e][0] || v == m.edge[e][1]);
        near(trip_angle(vertex_trip(&m, worst, rho)), closure, 1e-13);
        rg_constraint_free(&K);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

/* Flat: every column lies in the plane, so that each vertex has rank 2; and C rho' = 0 says sum rho' cos = sum rho' sin = 0. */
static void flat_paper_has_rank_two(void **state)
{
    (void)state;
    for (int half = 0; half < 2; half++) { /* flat, and folded flat */
        rg_pattern *p = draw_miura(4, 1.1);
        rg_mesh m = mesh_of(p);
        rg_constraint K = constraint_of(&m);
        double rho[100];
        miura_angles(&m, 1.1, half ? RG_PI : 0, rho);
        rg_constraint_assemble(&K, rho);
        for (int32_t k = 0; k < m.M; k++) {
            double xx = 0, xy = 0, yy = 0;
            for (int32_t j = m.loop_start[k]; j < m.loop_start[k + 1]; j++) {
                const rg_vec3 c = K.C.x[j];
                near(c.z, 0, half ? 1e-15 : 0);
                xx += c.x * c.x, xy += c.x * c.y, yy += c.y * c.y;
            }
            assert_true(xx * yy - xy * xy > 0.1);
        }
        rg_constraint_free(&K);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

/* At a half turn the residual vanishes, the closure is pi: two opposite creases of a cross, each folded by a quarter. */
static void half_turns_are_seen(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, -1, -1, 1, 1);
    draw(&l, RG_VALLEY, -1, 0, 1, 0);
    draw(&l, RG_MOUNTAIN, 0, -1, 0, 1);
    rg_pattern *p = pattern_of(&l);
    rg_mesh m = mesh_of(p);
    rg_constraint K = constraint_of(&m);
    double rho[4] = {0};
    for (int32_t i = 0; i < 4; i++) {
        const int32_t e = m.crease_edge[i];
        if (fabs(m.X[m.edge[e][0]].y - m.X[m.edge[e][1]].y) > 0.5) continue;
        /* Both ends of one line turned the same way about it, seen from the vertex: they do not cancel but add up. */
        rho[i] = m.X[m.edge[e][0]].x + m.X[m.edge[e][1]].x > 0 ? RG_PI / 2 : -RG_PI / 2;
    }
    near(rg_constraint_assemble(&K, rho), RG_PI, 1e-12);
    for (int i = 0; i < 3; i++) near(K.r[i], 0, 1e-15);
    near(rg_constraint_closure(&K, rho, NULL), RG_PI, 1e-12);
    rg_constraint_free(&K);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

static void nan_is_not_lost(void **state)
{
    (void)state;
    rg_pattern *p = draw_miura(4, 1.1);
    rg_mesh m = mesh_of(p);
    rg_constraint K = constraint_of(&m);
    double rho[100];
    for (int32_t i = 0; i < m.N; i++) {
        miura_angles(&m, 1.1, 0.8, rho);
        rho[(i + 7) % m.N] += 0.1;
        rho[i] = i % 2 ? NAN : INFINITY;
        assert_true(isnan(rg_constraint_assemble(&K, rho)));
        int32_t worst = -1;
        assert_true(isnan(rg_constraint_closure(&K, rho, &worst)));
        assert_in_range(worst, 0, m.M - 1);
    }
    rg_constraint_free(&K);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

static void no_interior_vertex(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 2, 1);
    draw(&l, RG_VALLEY, 1, 0, 1.25, 1);
    rg_pattern *p = pattern_of(&l);
    rg_mesh m = mesh_of(p);
    rg_constraint K = constraint_of(&m);
    const double rho = 2.385;
    int32_t worst = 5;
    near(rg_constraint_assemble(&K, &rho), 0, 0);
    near(rg_constraint_closure(&K, &rho, &worst), 0, 0);
    assert_int_equal(worst, -1);
    rg_constraint_free(&K);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

/* Creases that stay as they are have no say: their blocks are zero, the others as before, and they are counted. */
static void still_creases(void **state)
{
    (void)state;
    rg_pattern *p = draw_miura(4, 1.1);
    rg_mesh m = mesh_of(p);
    rg_constraint K = constraint_of(&m), all = constraint_of(&m);
    double rho[100];
    miura_angles(&m, 1.1, 0.8, rho);
    rg_constraint_assemble(&all, rho);
    for (int every = 1; every <= 5; every++) {
        int32_t stills = 0;
        for (int32_t i = 0; i < m.N; i++) stills += K.still[i] = i % every == 0;
        rg_constraint_set_still(&K);
        assert_int_equal(K.stills, stills);
        rg_constraint_assemble(&K, rho);
        for (int32_t j = 0; j < K.C.start[K.C.M]; j++) {
            const int is_still = K.C.col[j] % every == 0;
            near(K.C.x[j].x, is_still ? 0 : all.C.x[j].x, 0);
            near(K.C.x[j].y, is_still ? 0 : all.C.x[j].y, 0);
            near(K.C.x[j].z, is_still ? 0 : all.C.x[j].z, 0);
        }
    }
    rg_constraint_free(&K);
    rg_constraint_free(&all);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

static void memory(void **state)
{
    (void)state;
    rg_pattern *p = draw_miura(4, 1.1);
    rg_mesh m = mesh_of(p);
    double rho[100];
    miura_angles(&m, 1.1, 0.8, rho);
    rg_status s = RG_ENOMEM;
    for (long k = 0; s != RG_OK; k++) {
        counted c = {k, 0, 0};
        rg_memory mem = {counted_resize, &c};
        rg_constraint K;
        assert_true(k < 50);
        s = rg_constraint_init(&K, &mem, &m);
        assert_true(s == RG_OK || s == RG_ENOMEM);
        if (s == RG_OK) {
            const long asked = c.asked;
            rg_constraint_assemble(&K, rho);
            rg_constraint_closure(&K, rho, NULL);
            assert_int_equal(c.asked, asked);
            rg_constraint_free(&K);
        }
        assert_int_equal(c.out, 0);
    }
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_sheet),
        cmocka_unit_test(miura_closes),
        cmocka_unit_test(flat_paper_has_rank_two),
        cmocka_unit_test(half_turns_are_seen),
        cmocka_unit_test(nan_is_not_lost),
        cmocka_unit_test(no_interior_vertex),
        cmocka_unit_test(still_creases),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
