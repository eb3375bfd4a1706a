/* kinematics/coupled.c: r and A against products of rotation matrices and sums of angles written out, by differences. */
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
#include "kinematics/coupled.h"

enum { MOST = 40 };

/* Directions of the creases of interior vertex k on the pattern X, and the angles between them; drawn: without added ones. */
static int32_t sectors(const rg_mesh *m, int32_t k, const rg_vec2 *X, int drawn, double *theta, int32_t *crease)
{
    const int32_t v = m->inner_vertex[k];
    double angle[MOST + 1];
    int32_t n = 0;
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
        const int32_t i = m->loop_crease[j], e = m->crease_edge[i];
        if (drawn && i >= m->N - m->added) continue;
        const rg_vec2 far = X[m->edge[e][m->edge[e][0] == v]];
        assert_true(n < MOST);
        angle[n] = atan2(far.y - X[v].y, far.x - X[v].x);
        crease[n++] = i;
    }
    for (int32_t i = 0; i < n; i++) theta[i] = fmod(angle[(i + 1) % n] - angle[i] + 4 * RG_PI, 2 * RG_PI);
    return n;
}

static turn3 trip(const rg_mesh *m, int32_t k, const rg_vec2 *X, const double *rho)
{
    double theta[MOST], fold[MOST];
    int32_t crease[MOST];
    const int32_t n = sectors(m, k, X, 0, theta, crease);
    for (int32_t i = 0; i < n; i++) fold[i] = rho[crease[i]];
    return round_trip(n, fold, theta);
}

static double kawasaki_sum(const rg_mesh *m, int32_t k, const rg_vec2 *X)
{
    double theta[MOST], sum = 0;
    int32_t crease[MOST];
    const int32_t n = sectors(m, k, X, 1, theta, crease);
    for (int32_t i = 0; i < n; i++) sum += i % 2 ? -theta[i] : theta[i];
    return sum;
}

typedef struct sheet { rg_mesh m; rg_freedom f; rg_constraint K; rg_coupled J; double *rho, *u, *scale; rg_vec2 *X; } sheet;

static void open_sheet(sheet *s, int kawasaki, int movable)
{
    const rg_memory mem = rg_mem_default(NULL);
    assert_int_equal(rg_freedom_init(&s->f, &mem, &s->m, movable), RG_OK);
    assert_int_equal(rg_constraint_init_moving(&s->K, &mem, &s->m, &s->f, kawasaki), RG_OK);
    assert_int_equal(rg_coupled_init(&s->J, &mem, &s->K, NULL), RG_OK);
    const size_t n = (size_t)(s->m.N + s->f.U) + 1;
    s->rho = calloc(n, sizeof *s->rho);
    s->u = calloc(n, sizeof *s->u);
    s->scale = calloc(n, sizeof *s->scale);
    s->X = calloc((size_t)s->m.nv, sizeof *s->X);
    assert_true(s->rho && s->u && s->scale && s->X);
    assert_int_equal(s->J.A.rows, 3 * s->m.M + s->K.kept);
    assert_int_equal(s->J.A.columns, s->m.N + s->f.U);
}

static void close_sheet(sheet *s)
{
    rg_coupled_free(&s->J);
    rg_coupled_free(&s->J);
    rg_constraint_free(&s->K);
    rg_constraint_free(&s->K);
    rg_freedom_free(&s->f);
    rg_mesh_free(&s->m);
    free(s->rho);
    free(s->u);
    free(s->scale);
    free(s->X);
}

/* r, all of it, from scratch. */
static void residuals(const sheet *s, double *r)
{
    rg_freedom_move(&s->f, s->u, s->X);
    for (int32_t k = 0; k < s->m.M; k++) {
        const turn3 F = trip(&s->m, k, s->X, s->rho);
        r[3 * k] = (F.a[2][1] - F.a[1][2]) / 2;
        r[3 * k + 1] = (F.a[0][2] - F.a[2][0]) / 2;
        r[3 * k + 2] = (F.a[1][0] - F.a[0][1]) / 2;
        if (s->K.kawasaki[k] >= 0) r[s->K.kawasaki[k]] = kawasaki_sum(&s->m, k, s->X);
    }
}

static double angle_of(turn3 F)
{
    const double x = F.a[2][1] - F.a[1][2], y = F.a[0][2] - F.a[2][0], z = F.a[1][0] - F.a[0][1];
    return atan2(sqrt(x * x + y * y + z * z), F.a[0][0] + F.a[1][1] + F.a[2][2] - 1);
}

static void checks_residual(sheet *s)
{
    double *r = calloc((size_t)s->J.A.rows + 1, sizeof *r), worst = 0, most = 0, off = -1;
    const double closure = rg_coupled_assemble(&s->J, s->rho, s->u, &off);
    residuals(s, r);
    for (int32_t i = 0; i < s->J.A.rows; i++) {
        near(s->K.r[i], r[i], 1e-12);
        if (i >= 3 * s->m.M) most = fmax(most, fabs(r[i]));
    }
    for (int32_t k = 0; k < s->m.M; k++) worst = fmax(worst, angle_of(trip(&s->m, k, s->X, s->rho)));
    near(closure, worst, 1e-7 * (worst < 1e-6) + 1e-12);
    near(off, most, 1e-12);
    free(r);
}

/* A at a state that closes, where eq. (11) is dr: each column by central differences, times its scale. */
static void checks_columns(sheet *s, unsigned *seed)
{
    const int32_t rows = s->J.A.rows, columns = s->J.A.columns;
    const double h = 1e-5;
    double *more = calloc((size_t)rows + 1, sizeof *more), *less = calloc((size_t)rows + 1, sizeof *less);
    double *unit = calloc((size_t)columns + 1, sizeof *unit), *is = calloc((size_t)rows + 1, sizeof *is);
    assert_true(more && less && unit && is);
    for (int32_t i = 0; i < columns; i++) s->scale[i] = 1.25 + noise(seed);
    below(rg_coupled_assemble(&s->J, s->rho, s->u, NULL), 1e-9);
    rg_coupled_renew(&s->J, s->scale);
    for (int32_t c = 0; c < columns; c++) {
        double *x = c < s->m.N ? &s->rho[c] : &s->u[c - s->m.N], at = *x;
        const double by = c < s->m.N ? h : h * s->f.reach[c - s->m.N];
        *x = at + by;
        residuals(s, more);
        *x = at - by;
        residuals(s, less);
        *x = at;
        memset(unit, 0, (size_t)columns * sizeof *unit);
        unit[c] = 1;
        rg_least_mul(&s->J.A, unit, is);
        for (int32_t i = 0; i < rows; i++) {
            const double d = s->scale[c] * (more[i] - less[i]) / (2 * by);
            near(is[i], d, 1e-7 * (1 + fabs(d)));
        }
    }
    free(is);
    free(unit);
    free(less);
    free(more);
}

/* Degree 4 in the middle of a sheet of any outline. */
static rg_mesh one_vertex(const double *theta, unsigned *seed)
{
    rg_lines l = drawing();
    rg_vec2 rim[4];
    double angle = 0.3;
    for (int i = 0; i < 4; i++) {
        const double length = 1.5 + 0.5 * noise(seed);
        rim[i] = (rg_vec2){length * cos(angle), length * sin(angle)};
        draw(&l, i ? RG_VALLEY : RG_MOUNTAIN, 0, 0, rim[i].x, rim[i].y);
        angle += theta[i];
    }
    draw_polygon(&l, RG_BORDER, rim, 4);
    rg_pattern *p = pattern_of(&l);
    rg_mesh m = mesh_of(p);
    rg_pattern_destroy(p);
    return m;
}

static void one_vertex_of_degree_4(void **state)
{
    (void)state;
    unsigned seed = 31;
    for (int round = 0; round < 24; round++) {
        const double a = 0.5 + 0.2 * (round % 4), b = 1.25 + 0.25 * (round % 3), t = 0.1 + 0.4 * (round / 4);
        double theta[4], rho[4];
        int32_t crease[MOST];
        sheet s;
        degree4(a, b, round % 2, t, theta, rho);
        s.m = one_vertex(theta, &seed);
        open_sheet(&s, 1, 1);
        assert_int_equal(s.K.kept, 1);
        double found[MOST];
        sectors(&s.m, 0, s.m.X, 0, found, crease);
        int first = 0; /* of the loop, where the drawing's first is */
        for (int i = 0; i < 4; i++)
            if (s.m.assignment[s.m.crease_edge[crease[i]]] == RG_MOUNTAIN) first = i;
        for (int i = 0; i < 4; i++) s.rho[crease[(first + i) % 4]] = rho[i];
        checks_residual(&s);
        checks_columns(&s, &seed);
        close_sheet(&s);
    }
}

/* Sheets: flat with the pattern moved anyhow, which closes; and a Miura-ori half folded. */
static void sheets(void **state)
{
    (void)state;
    unsigned seed = 32;
    static const char *const kinds[] = {"bird", "fish", "waterbomb", "boxpleat", "crane"};
    const rg_memory mem = rg_mem_default(NULL);
    for (int k = 0; k < 10; k++) {
        rg_lines l;
        sheet s;
        assert_int_equal(rg_generate_lines(kinds[k % 5], k % 5 == 2 ? 2 : k % 5 == 3 ? 6 : 0, 0, 0, &mem, &l, NULL), RG_OK);
        rg_pattern *p = pattern_of(&l);
        s.m = mesh_of(p);
        if (k >= 5) {
            rg_mesh drawn = s.m;
            assert_int_equal(rg_triangulate_all(&drawn, &s.m), RG_OK);
            rg_mesh_free(&drawn);
        }
        open_sheet(&s, 1, 1);
        assert_int_equal(s.K.kept, s.m.M);
        for (int32_t i = 0; i < s.f.U; i++) s.u[i] = 0.05 * s.f.reach[i] * noise(&seed);
        checks_residual(&s);
        if (k % 5 < 3) checks_columns(&s, &seed);
        for (int32_t i = 0; i < s.m.N; i++) s.rho[i] = 2.385 * noise(&seed); /* which does not close */
        checks_residual(&s);
        close_sheet(&s);
        rg_pattern_destroy(p);
    }
}

static void half_folded_miura(void **state)
{
    (void)state;
    unsigned seed = 33;
    for (int round = 0; round < 6; round++) {
        rg_pattern *p = draw_miura(4, 1.125);
        sheet s;
        s.m = mesh_of(p);
        if (round % 2) {
            rg_mesh drawn = s.m;
            assert_int_equal(rg_triangulate_all(&drawn, &s.m), RG_OK);
            rg_mesh_free(&drawn);
        }
        open_sheet(&s, round < 4, 1);
        assert_int_equal(s.K.kept, round < 4 ? 9 : 0);
        miura_angles(&s.m, 1.125, 0.5 + 0.5 * round, s.rho);
        for (int32_t i = s.m.N - s.m.added; i < s.m.N; i++) s.rho[i] = 0;
        checks_residual(&s);
        checks_columns(&s, &seed);
        close_sheet(&s);
        rg_pattern_destroy(p);
    }
}

/* Kawasaki's row only where the drawing obeys it. */
static void which_are_kept(void **state)
{
    (void)state;
    unsigned seed = 34;
    for (int round = 0; round < 8; round++) {
        const double off = (double[]){0, 0.005, 0.05, 0.5}[round % 4], theta[4] = {1 + off, 1.5, RG_PI - 1, RG_PI - 1.5 - off};
        sheet s;
        s.m = one_vertex(theta, &seed);
        open_sheet(&s, round < 4, 1);
        assert_int_equal(s.K.kept, round < 2); /* twice the error is in the sum */
        checks_residual(&s);
        close_sheet(&s);
    }
}

static void a_pattern_that_stays(void **state)
{
    (void)state;
    rg_pattern *p = draw_miura(3, 1.25);
    sheet s;
    s.m = mesh_of(p);
    open_sheet(&s, 1, 0);
    assert_int_equal(s.K.kept, 0);
    assert_int_equal(s.J.A.columns, s.m.N);
    unsigned seed = 35;
    miura_angles(&s.m, 1.25, 1, s.rho);
    checks_residual(&s);
    checks_columns(&s, &seed);
    close_sheet(&s);
    rg_pattern_destroy(p);
}

static void memory(void **state)
{
    (void)state;
    counted c = {1000000, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    rg_pattern *p = draw_miura(3, 1.25);
    rg_mesh m = mesh_of(p);
    rg_freedom f;
    rg_constraint K;
    rg_coupled J;
    assert_int_equal(rg_freedom_init(&f, &mem, &m, 1), RG_OK);
    const long before = c.out;
    for (long k = 0;; k++) {
        c.left = k;
        rg_status s = rg_constraint_init_moving(&K, &mem, &m, &f, 1);
        if (s == RG_OK && (s = rg_coupled_init(&J, &mem, &K, NULL)) != RG_OK) rg_constraint_free(&K);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(c.out, before);
    }
    rg_coupled_free(&J);
    rg_constraint_free(&K);
    rg_freedom_free(&f);
    assert_int_equal(c.out, 0);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_vertex_of_degree_4), cmocka_unit_test(sheets), cmocka_unit_test(half_folded_miura),
        cmocka_unit_test(which_are_kept), cmocka_unit_test(a_pattern_that_stays), cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
