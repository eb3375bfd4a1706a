/* kinematics/coupled.c with a symmetry against the whole system that it stands for: in states of motions that have a symmetry, what one vertex of an
 * orbit needs is what all need, and the least even step is the least step. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "draw.h"
#include "generate/generate.h"
#include "kinematics/coupled.h"
#include "motion/motion.h"

static rg_motion *folded(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_settings s = rg_settings_default();
    rg_lines l;
    rg_motion *m = NULL;
    rg_diag why;
    s.frames = 9;
    s.contact = RG_CONTACT_REPORT; /* facets may pass through each other: what is looked for is symmetry */
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    rg_pattern *p = pattern_of(&l);
    if (rg_motion_create(p, &s, NULL, NULL, &m, &why) != RG_OK) fail_msg("%s", why.text);
    rg_pattern_destroy(p);
    return m;
}

/* How far a frame's vertices went, as its freedom's u. */
static void ways_of(const rg_freedom *f, const rg_vec2 *X, double *u)
{
    for (int32_t i = 0; i < f->U; i++) u[i] = rg_vec2_dot(rg_vec2_sub(X[f->vertex[i]], f->mesh->X[f->vertex[i]]), f->direction[i]);
}

typedef struct whole_and_orbits { rg_symmetry G; rg_freedom f; rg_constraint K; rg_coupled J, O; } whole_and_orbits;

static double size(int32_t n, const double *x)
{
    double sum = 0;
    for (int32_t i = 0; i < n; i++) sum += x[i] * x[i];
    return sqrt(sum);
}

/* In frame k: x by orbits is even, does in every row of the whole system what was asked for, and is as long as the least that
 * does. */
static void agrees(const rg_motion *m, int32_t k, int kawasaki, unsigned *seed)
{
    const rg_mesh *mesh = &m->mesh;
    const rg_memory mem = rg_mem_default(NULL);
    whole_and_orbits s;
    assert_int_equal(rg_symmetry_find(&s.G, &mem, mesh), RG_OK);
    assert_int_equal(rg_freedom_init(&s.f, &mem, mesh, 1), RG_OK);
    assert_int_equal(rg_constraint_init_moving(&s.K, &mem, mesh, &s.f, kawasaki), RG_OK);
    assert_int_equal(rg_coupled_init(&s.J, &mem, &s.K, NULL), RG_OK);
    assert_int_equal(rg_coupled_init(&s.O, &mem, &s.K, &s.G), RG_OK);
    const int32_t N = mesh->N, U = s.f.U, n = N + U, rows = s.J.A.rows;
    assert_true(s.G.order > 1 && s.O.A.columns < n * 3 / 4 && s.O.A.rows < rows * 3 / 4);
    double *u = calloc((size_t)U, sizeof *u), *scale = calloc((size_t)n, sizeof *scale), *z = calloc((size_t)n, sizeof *z);
    double *x = calloc((size_t)n, sizeof *x), *whole = calloc((size_t)n, sizeof *whole);
    double *is = calloc((size_t)rows, sizeof *is), *should = calloc((size_t)rows, sizeof *should);
    rg_vec2 *d = calloc((size_t)mesh->nv, sizeof *d);
    assert_true(u && scale && z && x && whole && is && should && d);
    ways_of(&s.f, rg_motion_pattern(m, k), u);
    rg_freedom_mean(&s.f, &s.G, u, d);
    for (int32_t i = 0; i < N; i++) scale[i] = 1 + 0.3 * noise(seed), z[i] = noise(seed);
    for (int32_t i = 0; i < U; i++) scale[N + i] = 0.5 * s.f.reach[i], z[N + i] = noise(seed);
    rg_symmetry_mean(&s.G, scale);
    rg_symmetry_mean(&s.G, z);
    rg_freedom_mean(&s.f, &s.G, z + N, d);

    const double some = rg_coupled_assemble(&s.O, rg_motion_angles(m, k), u, NULL);
    const double all = rg_coupled_assemble(&s.J, rg_motion_angles(m, k), u, NULL);
    below(all, 1e-8);
    near(some, all, 1e-8);
    rg_coupled_renew(&s.O, scale);
    rg_coupled_solve(&s.O, z, NULL, x);
    rg_coupled_renew(&s.J, scale);
    rg_least_mul(&s.J.A, z, should);
    rg_least_mul(&s.J.A, x, is);
    for (int32_t i = 0; i < rows; i++) near(is[i], should[i], 1e-7 * size(rows, should) + 1e-9);
    near(rg_symmetry_off(&s.G, x), 0, 0);
    memcpy(whole, x, (size_t)n * sizeof *x);
    rg_freedom_mean(&s.f, &s.G, whole + N, d);
    for (int32_t i = 0; i < n; i++) near(whole[i], x[i], 1e-9 * size(n, x));
    rg_least_solve(&s.J.A, should, whole);
    near(size(n, x), size(n, whole), 1e-6 * size(n, whole));

    free(u), free(scale), free(z), free(x), free(whole), free(is), free(should), free(d);
    rg_coupled_free(&s.O);
    rg_coupled_free(&s.O);
    rg_coupled_free(&s.J);
    rg_constraint_free(&s.K);
    rg_freedom_free(&s.f);
    rg_symmetry_free(&s.G);
}

static void stands_for_the_whole(void **state)
{
    (void)state;
    static const struct { const char *kind; int32_t n; } made[] = {{"boxpleat", 16}, {"crane", 0}, {"open-sink", 0}, {"frog", 0}, {"bird", 0}};
    unsigned seed = 31;
    for (size_t k = 0; k < sizeof made / sizeof *made; k++) {
        rg_motion *m = folded(made[k].kind, made[k].n);
        assert_true(rg_motion_report(m)->symmetry > 1);
        for (int32_t frame = 2; frame < 7; frame += 2)
            for (int kawasaki = 0; kawasaki < 2; kawasaki++) agrees(m, frame, kawasaki, &seed);
        rg_motion_destroy(m);
    }
}

static void memory_runs_short(void **state)
{
    (void)state;
    rg_motion *m = folded("frog", 0);
    counted c = {.left = 1000000};
    const rg_memory mem = {counted_resize, &c}, plain = rg_mem_default(NULL);
    rg_symmetry G;
    rg_freedom f;
    rg_constraint K;
    rg_coupled O;
    assert_int_equal(rg_symmetry_find(&G, &plain, &m->mesh), RG_OK);
    assert_int_equal(rg_freedom_init(&f, &plain, &m->mesh, 1), RG_OK);
    assert_int_equal(rg_constraint_init_moving(&K, &plain, &m->mesh, &f, 0), RG_OK);
    const long held = c.out;
    for (long k = 0;; k++) {
        c.left = k;
        const rg_status s = rg_coupled_init(&O, &mem, &K, &G);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(c.out, held);
    }
    rg_coupled_free(&O);
    rg_constraint_free(&K);
    assert_int_equal(c.out, 0);
    rg_freedom_free(&f);
    rg_symmetry_free(&G);
    rg_motion_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(stands_for_the_whole), cmocka_unit_test(memory_runs_short)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
