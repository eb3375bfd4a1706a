/* motion/stepping.c: the stepping face reaches what a whole motion reaches, by the same frames, to the bit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "draw.h"
#include "generate/generate.h"

static rg_pattern *generated(const char *kind)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    assert_int_equal(rg_generate_lines(kind, 0, 0, 0, &mem, &l, NULL), RG_OK);
    return pattern_of(&l);
}

static void as_a_whole_motion(void **state)
{
    (void)state;
    static const char *const kinds[] = {"bird", "frog", "closed-adjust", "hypar", "tatou", "preliminary"};
    for (int k = 0; k < 6; k++) {
        rg_settings s = rg_settings_default();
        rg_pattern *p = generated(kinds[k]);
        rg_motion *m = NULL;
        rg_fold *f = NULL;
        rg_step_info info = {0};
        rg_diag why;
        s.frames = 17;
        s.contact = RG_CONTACT_REPORT;
        assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, &why), RG_OK);
        assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f, &why), RG_OK);
        const rg_report *r = rg_motion_report(m);
        int32_t frames = 0, creases = 0;
        for (const rg_step_info *i = rg_fold_get_info(f);; i = rg_fold_step(f)) {
            assert_int_equal(i->frame, frames);
            near(i->progress, r->frames[frames].percent / 100, 0);
            const double *rho = rg_fold_angles(f, &creases);
            assert_memory_equal(rho, rg_motion_angles(m, frames), (size_t)creases * sizeof *rho);
            frames++;
            info = *i;
            if (i->outcome != RG_RUNNING) break;
        }
        assert_int_equal(frames, r->frame_count);
        assert_int_equal(info.outcome, r->outcome);
        info = *rg_fold_step(f); /* it stays there */
        assert_int_equal(info.frame, frames - 1);
        assert_int_equal(info.outcome, r->outcome);
        rg_fold_destroy(f);
        rg_motion_destroy(m);
        rg_pattern_destroy(p);
    }
    rg_fold_destroy(NULL);
}

static int at_once(void *ctx, double progress)
{
    ++*(int *)ctx;
    return progress >= 0;
}

static void watched(void **state)
{
    (void)state;
    rg_settings s = rg_settings_default();
    rg_pattern *p = generated("frog");
    rg_fold *f = NULL;
    rg_step_info info = {0};
    int calls = 0;
    assert_int_equal(rg_fold_create(p, &s, at_once, &calls, &f, NULL), RG_OK);
    assert_true(calls > 0);
    for (info = *rg_fold_get_info(f); info.outcome == RG_RUNNING;) info = *rg_fold_step(f);
    assert_int_equal(info.outcome, RG_STOPPED);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(as_a_whole_motion), cmocka_unit_test(watched)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
