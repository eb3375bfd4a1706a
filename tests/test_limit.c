/* fold/limit.c: what creases may turn, against the same said anew; and that motions keep to it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "folded.h"
#include "folding.h"
#include "fold/system.h"
#include "generate/generate.h"

static rg_mesh triangulated(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    rg_mesh m;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    rg_pattern *p = pattern_of(&l);
    rg_mesh drawn = mesh_of(p);
    assert_int_equal(rg_triangulate_all(&drawn, &m), RG_OK);
    rg_mesh_free(&drawn);
    rg_pattern_destroy(p);
    return m;
}

static int share_a_facet(const rg_mesh *m, int32_t i, int32_t k)
{
    const int32_t *f = m->edge_facet[m->crease_edge[i]], *g = m->edge_facet[m->crease_edge[k]];
    return f[0] == g[0] || f[0] == g[1] || f[1] == g[0] || f[1] == g[1];
}

/* An added crease, beside one that turned by rho, has only half a turn less that left to turn the same way. */
static void bounds(const rg_mesh *m, const double *rho, int32_t i, double *low, double *high)
{
    double up = 0, down = 0;
    for (int32_t k = 0; k < m->N && i >= m->N - m->added; k++) {
        if (k == i || !share_a_facet(m, i, k)) continue;
        if (rho[k] > up) up = rho[k];
        if (-rho[k] > down) down = -rho[k];
    }
    *high = RG_PI - up > 0 ? RG_PI - up : 0;
    *low = down - RG_PI < 0 ? down - RG_PI : 0;
}

static void pulled_back_to_what_is_left(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh m = triangulated("boxpleat", 8);
    rg_limit l;
    assert_true(m.added > 0);
    assert_int_equal(rg_limit_init(&l, &mem, &m), RG_OK);
    double *rho = calloc((size_t)m.N, sizeof *rho), *pull = calloc((size_t)m.N, sizeof *pull);
    assert_true(rho && pull);
    unsigned seed = 7;
    int added = 0, drawn = 0, beyond = 0;
    for (int turn = 0; turn < 50; turn++) {
        double most = 0;
        for (int32_t i = 0; i < m.N; i++) rho[i] = (turn % 2 ? 3.4 : 1.9) * noise(&seed);
        const double worst = rg_limit_pull(&l, rho, pull);
        for (int32_t i = 0; i < m.N; i++) {
            double low, high;
            bounds(&m, rho, i, &low, &high);
            const double to = rho[i] < low ? low : rho[i] > high ? high : rho[i];
            near(pull[i], to - rho[i], 1e-14);
            if (fabs(pull[i]) > most) most = fabs(pull[i]);
            drawn += i < m.N - m.added && pull[i] != 0;
            added += i >= m.N - m.added && pull[i] != 0 && fabs(rho[i]) < RG_PI;
            beyond += high == 0 || low == 0;
        }
        near(worst, most, 0);
    }
    if (!(drawn > 50 && added > 100 && beyond > 0)) fail_msg("too few were tried: %d, %d, %d", drawn, added, beyond);
    free(rho);
    free(pull);
    rg_limit_free(&l);
    rg_limit_free(&l);
    rg_mesh_free(&m);
}

/* Methods that close every step also pull it back, to a twentieth of a degree: what is wished no further than that stops instead. */
static void motions_keep_to_it(void **state)
{
    (void)state;
    static const char *const kinds[] = {"closed-split", "tatou"};
    static const rg_method methods[] = {RG_METHOD_NEWTON, RG_METHOD_ADAPTIVE};
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 2; j++) {
            const rg_memory mem = rg_mem_default(NULL);
            rg_settings s = rg_settings_default();
            rg_lines l;
            s.triangulate = RG_TRIANGULATE_ALL;
            s.method = methods[j];
            s.frames = 30;
            assert_int_equal(rg_generate_lines(kinds[k], 0, 0, 0, &mem, &l, NULL), RG_OK);
            rg_pattern *p = pattern_of(&l);
            rg_straight *f = fold_of(p, &s);
            double worst = 0, most = 0;
            assert_int_equal(f->apart.parts, 0);
            assert_true(f->mesh.added > 0);
            for (rg_step_info i; next_frame(f, &i);)
                for (int32_t c = 0; c < f->mesh.N; c++) {
                    double low, high;
                    bounds(&f->mesh, f->rho, c, &low, &high);
                    worst = fmax(worst, fmax(low - f->rho[c], f->rho[c] - high));
                    if (c >= f->mesh.N - f->mesh.added) most = fmax(most, fabs(f->rho[c]));
                }
            below(worst, 0.1 * RG_DEG);
            assert_true(most > 10 * RG_DEG); /* they do turn */
            rg_straight_destroy(f);
            rg_pattern_destroy(p);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pulled_back_to_what_is_left),
        cmocka_unit_test(motions_keep_to_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
