/* motion/take.c: a flow from the folded end, turned round, is a motion from flat, of which a part may be asked for. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "near.h"

#include "folded.h"
#include "generate/generate.h"
#include "motion/take.h"

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
static double mean(const rg_take *t, int32_t frame)
{
    double sum = 0;
    for (int32_t i = 0; i < t->mesh.N; i++) sum += t->rho[(size_t)frame * (size_t)t->mesh.N + (size_t)i] / t->target[i];
    return sum / t->mesh.N;
}

static void from_its_end(void **state)
{
    (void)state;
    static const double part[] = {1, 0.5, -0.25, 0.9};
    for (int k = 0; k < 4; k++) {
        rg_mesh m = generated(k % 2 ? "fish" : "bird");
        rg_settings s = rg_settings_default();
        const rg_flow_law law = {.stubborn = 0.2};
        rg_watch watch = {0};
        rg_take t;
        s.to = part[k];
        s.frames = FRAMES;
        double *folded = calloc((size_t)m.N, sizeof *folded), *flat = calloc((size_t)m.N, sizeof *flat);
        assert_true(folded && flat);
        for (int32_t i = 0; i < m.N; i++) folded[i] = (s.to < 0 ? -1 : 1) * m.target[m.crease_edge[i]];
        assert_int_equal(rg_take_flow(&t, &m, &s, &law, folded, flat, NULL, 0, &watch, NULL), RG_OK);
        assert_int_equal(t.outcome, RG_FOLDED);
        rg_take_turn_round(&t, folded);
        assert_int_equal(t.outcome, RG_FOLDED);
        assert_int_equal(t.count, FRAMES);
        for (int32_t f = 0; f < FRAMES; f++) near(mean(&t, f), fabs(s.to) * f / (FRAMES - 1), 1e-4);
        for (int32_t i = 0; i < t.mesh.N; i++) {
            near(t.rho[i], 0, 1e-9);
            if (k == 0) near(t.rho[(FRAMES - 1) * t.mesh.N + i], folded[i], 1e-9);
        }
        rg_take_free(&t);
        free(folded);
        free(flat);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(from_its_end)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
