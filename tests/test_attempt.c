/* motion/attempt.c: a path from the folded end is a motion from flat, of which a part may be asked for; frames are read off the path,
 * which does not depend on how many there are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "near.h"

#include "folded.h"
#include "generate/generate.h"
#include "motion/attempt.h"

enum { FRAMES = 9 };

static rg_mesh generated(const char *kind)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    assert_int_equal(rg_generate_lines(kind, 0, 0, 0, &mem, &l, NULL), RG_OK);
    rg_pattern *p = pattern_of(&l);
    const rg_mesh m = mesh_of(p);
    rg_pattern_destroy(p);
    return m;
}

/* Mean of rho over target. */
static double mean(const rg_attempt *t, int32_t frame)
{
    double sum = 0;
    for (int32_t i = 0; i < t->mesh.N; i++) sum += t->rho[(size_t)frame * (size_t)t->mesh.N + (size_t)i] / t->target[i];
    return sum / t->mesh.N;
}

static rg_attempt attempt(const char *kind, const rg_settings *s, const rg_relaxation *how, int backwards)
{
    rg_mesh drawn = generated(kind), m;
    rg_watch watch = {0};
    rg_attempt t;
    if (how->compliance > 0) {
        assert_int_equal(rg_triangulate_all(&drawn, &m), RG_OK);
        rg_mesh_free(&drawn);
    } else {
        m = drawn;
    }
    double *folded = calloc((size_t)m.N, sizeof *folded);
    assert_non_null(folded);
    for (int32_t i = 0; i < m.N; i++)
        folded[i] = i < m.N - m.added ? (s->to < 0 ? -1 : 1) * m.target[m.crease_edge[i]] : NAN;
    const rg_relaxed_try one = {.how = *how, .target = folded, .backwards = backwards};
    assert_int_equal(rg_attempt_relaxed(&t, &m, s, &one, &watch, NULL), RG_OK);
    assert_int_equal(t.outcome, RG_FOLDED);
    assert_int_equal(rg_attempt_read(&t, s), RG_OK);
    free(folded);
    return t;
}

static void from_its_end(void **state)
{
    (void)state;
    static const double part[] = {1, 0.5, -0.25, 0.9};
    for (int k = 0; k < 4; k++) {
        rg_settings s = rg_settings_default();
        const rg_relaxation stiff = {0};
        s.to = part[k];
        s.frames = FRAMES;
        rg_attempt t = attempt(k % 2 ? "fish" : "bird", &s, &stiff, 1);
        assert_int_equal(t.count, FRAMES);
        for (int32_t f = 0; f < FRAMES; f++) near(mean(&t, f), fabs(s.to) * f / (FRAMES - 1), 1e-6);
        for (int32_t i = 0; i < t.mesh.N; i++) {
            near(t.rho[i], 0, 1e-9);
            if (k == 0) near(t.rho[(FRAMES - 1) * t.mesh.N + i], t.target[i], 1e-9);
        }
        rg_attempt_free(&t);
    }
}

/* The same percent, the same bits, whether there are many frames or few. */
static void frames_are_read_off(void **state)
{
    (void)state;
    static const struct { const char *kind; rg_relaxation how; } made[] = {{"frog", {1, 0.1, 0, 0}}, {"bird", {0, 0, 0, 0}}, {"four-crane", {0.5, 0.1, 0, 0}}};
    for (int k = 0; k < 3; k++) {
        rg_settings few = rg_settings_default(), many = few;
        few.frames = 5, many.frames = 33;
        rg_attempt a = attempt(made[k].kind, &few, &made[k].how, k == 2), b = attempt(made[k].kind, &many, &made[k].how, k == 2);
        const size_t N = (size_t)a.mesh.N;
        assert_int_equal(a.count, 5);
        assert_int_equal(b.count, 33);
        for (size_t f = 0; f < 5; f++) assert_memory_equal(a.rho + f * N, b.rho + 8 * f * N, N * sizeof *a.rho);
        rg_attempt_free(&a);
        rg_attempt_free(&b);
    }
}

/* Even in the largest angle that a crease turns: no frame turns one by much more than the mean, and less with more frames. */
static void steadily(void **state)
{
    (void)state;
    static const struct { const char *kind; rg_relaxation how; int backwards; } made[] = {
        {"frog", {1, 0.1, 0, 0}, 0}, {"four-crane", {0.5, 0.1, 0, 0}, 1}, {"boxpleat", {1, 0.1, 0, 0}, 0}};
    for (int k = 0; k < 3; k++)
        for (int frames = 61; frames <= 2401; frames = frames == 61 ? 601 : frames + 1800) {
            rg_settings s = rg_settings_default();
            s.pace = RG_PACE_STEADY;
            s.frames = frames;
            rg_attempt t = attempt(made[k].kind, &s, &made[k].how, made[k].backwards);
            double all = 0, most = 0;
            assert_int_equal(t.count, frames);
            for (int f = 1; f < frames; f++) {
                double turned = 0;
                for (int32_t i = 0; i < t.mesh.N; i++)
                    turned = fmax(turned, fabs(t.rho[f * t.mesh.N + i] - t.rho[(f - 1) * t.mesh.N + i]));
                all += turned;
                most = fmax(most, turned);
            }
            below(most, 3 * all / (frames - 1));
            rg_attempt_free(&t);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(from_its_end), cmocka_unit_test(frames_are_read_off), cmocka_unit_test(steadily)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
