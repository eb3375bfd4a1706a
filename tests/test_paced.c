/* Frames made anew for films and pages: even in the largest turn, closed, the ends as they were. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* these four first */
#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "write/paced.h"

#include <limits.h>
#include <string.h>

static rg_motion *motion_of(const char *kind, int32_t n, rg_settings s)
{
    rg_diag why = {0, ""};
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    if (rg_generate_pattern(kind, n, 0, 0, NULL, &p, &why) != RG_OK) fail_msg("%s: %s", kind, why.text);
    s.contact = RG_CONTACT_IGNORE;
    const rg_status made = rg_motion_create(p, &s, NULL, NULL, &m, &why);
    rg_pattern_destroy(p);
    if (made != RG_OK) fail_msg("%s: %s", kind, why.text);
    return m;
}

static double largest_turn(const rg_motion *m, int32_t k)
{
    double most = 0;
    for (int32_t i = 0; i < m->mesh.N; i++)
        most = fmax(most, fabs(rg_motion_angles(m, k + 1)[i] - rg_motion_angles(m, k)[i]));
    return most;
}

/* Each edge is as long in space as in that frame's pattern, whichever facets it was reached over. */
static double strain(const rg_motion *m, int32_t k)
{
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x);
    const rg_vec2 *X = rg_motion_pattern(m, k);
    double most = 0;
    assert_int_equal(rg_motion_place(m, k, x), RG_OK);
    for (int32_t e = 0; e < m->mesh.ne; e++) {
        const int32_t *v = m->mesh.edge[e];
        const double flat = rg_vec2_length(rg_vec2_sub(X[v[1]], X[v[0]]));
        const double off = fabs(rg_vec3_length(rg_vec3_sub(x[v[1]], x[v[0]])) / flat - 1);
        if (!(off <= most)) most = off;
    }
    free(x);
    return most;
}

static const struct { const char *kind; int32_t n; double adjust;
} SAMPLES[] = {{"bird", 0, RG_ADJUST_AUTO},
               {"miura", 4, RG_ADJUST_AUTO},
               {"closed-adjust", 0, RG_ADJUST_AUTO},
               {"fish", 0, RG_ADJUST_AUTO},
               {"waterbomb", 3, RG_ADJUST_AUTO}};
enum { SAMPLE_COUNT = sizeof SAMPLES / sizeof *SAMPLES, FRAMES = 41 };

static void frames_are_even_and_closed(void **state)
{
    (void)state;
    int moved = 0;
    for (int i = 0; i < SAMPLE_COUNT; i++) {
        rg_settings s = rg_settings_default();
        s.frames = FRAMES;
        s.adjust = SAMPLES[i].adjust;
        rg_motion *m = motion_of(SAMPLES[i].kind, SAMPLES[i].n, s), paced;
        const int32_t last = m->report.frame_count - 1;
        const size_t N = (size_t)m->mesh.N, nv = (size_t)m->mesh.nv;
        assert_int_equal(rg_paced_init(&paced, m), RG_OK);
        assert_int_equal(paced.report.frame_count, last + 1);
        for (int32_t k = 0; k <= last; k += last) {
            assert_memory_equal(rg_motion_angles(&paced, k), rg_motion_angles(m, k), N * sizeof(double));
            assert_memory_equal(rg_motion_pattern(&paced, k), rg_motion_pattern(m, k), nv * sizeof(rg_vec2));
            near(paced.frame[k].percent, m->frame[k].percent, 0);
        }
        double sum = 0, most = 0, uneven = 0, whole = 0;
        for (int32_t k = 0; k < last; k++) {
            sum += largest_turn(&paced, k);
            most = fmax(most, largest_turn(&paced, k));
            whole += largest_turn(m, k);
            uneven = fmax(uneven, largest_turn(m, k));
            assert_true(paced.frame[k + 1].percent >= paced.frame[k].percent - 0.5);
        }
        /* The ways are cut elsewhere than at m's frames, so that a turn may be a little shorter than its share, and
         * none is longer. */
        assert_true(most <= 1.02 * whole / last);
        assert_true(most <= 1.25 * sum / last);
        assert_true(most <= 1.02 * uneven);
        for (int32_t k = 0; k <= last; k++) {
            const double off = strain(&paced, k);
            assert_true(off <= fmax(1e-9, 10 * strain(m, k)));
            assert_true(paced.frame[k].closure_residual <= s.tol);
            moved |= memcmp(rg_motion_pattern(&paced, k), m->mesh.X, nv * sizeof(rg_vec2)) != 0;
        }
        rg_paced_free(&paced, m);
        rg_motion_destroy(m);
    }
    assert_true(moved); /* of the samples one is that rolls */
}

static void short_motions_are_left(void **state)
{
    (void)state;
    rg_settings s = rg_settings_default();
    s.frames = 2;
    rg_motion *m = motion_of("bird", 0, s), paced;
    assert_int_equal(rg_paced_init(&paced, m), RG_OK);
    assert_ptr_equal(paced.rho, m->rho);
    rg_paced_free(&paced, m);
    rg_motion_destroy(m);
}

/* The k-th allocation fails, until none does: nothing is kept, and m is as it was. */
static void memory_may_run_short(void **state)
{
    (void)state;
    counted c = {LONG_MAX, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    rg_settings s = rg_settings_default();
    s.memory = &mem;
    s.frames = 5;
    rg_motion *m = motion_of("closed-adjust", 0, s), paced;
    const long before = c.out;
    for (long left = 0;; left++) {
        c.left = left;
        const rg_status status = rg_paced_init(&paced, m);
        c.left = LONG_MAX;
        rg_paced_free(&paced, m);
        assert_int_equal(c.out, before);
        if (status == RG_OK) break;
        assert_int_equal(status, RG_ENOMEM);
        assert_true(left < 10000);
    }
    rg_motion_destroy(m);
    assert_int_equal(c.out, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_even_and_closed),
        cmocka_unit_test(short_motions_are_left),
        cmocka_unit_test(memory_may_run_short),
    };
    return cmocka_run_group_tests_name("paced", tests, NULL, NULL);
}
