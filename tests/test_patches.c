/* Pieces of facets where layers lie on each other in a circle: with them, each cell of the overlap shows the facet that
 * is on top. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* these four first */
#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "motion/ending.h"
#include "write/patches.h"

#include <limits.h>

static rg_motion *motion_of(const char *kind, const rg_memory *mem)
{
    rg_diag why = {0, ""};
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    rg_settings s = rg_settings_default();
    s.memory = mem;
    s.frames = 8;
    if (rg_generate_pattern(kind, 0, 0, 0, NULL, &p, &why) != RG_OK ||
        rg_motion_create(p, &s, NULL, NULL, &m, &why) != RG_OK)
        fail_msg("%s: %s", kind, why.text);
    rg_pattern_destroy(p);
    return m;
}

static int is_inside(const rg_vec2 *x, int32_t n, rg_vec2 p)
{
    int odd = 0;
    for (int32_t i = 0, k = n - 1; i < n; k = i++)
        if ((x[i].y > p.y) != (x[k].y > p.y) && p.x < x[i].x + (p.y - x[i].y) / (x[k].y - x[i].y) * (x[k].x - x[i].x))
            odd = !odd;
    return odd;
}

/* How high a facet is over a point of the plane: by its level, or by a piece of it there; side: the highest or the
 * lowest. */
static int32_t height(const rg_patches *p, const rg_layers *l, const int32_t *level, int32_t f, rg_vec2 point, int side)
{
    int32_t best = level[f];
    for (int32_t k = 0; k < p->count; k++) {
        rg_vec2 in_plane[20];
        const int32_t n = p->start[k + 1] - p->start[k];
        if (p->facet[k] != l->flat.part[l->flat.part_start[f]]) continue;
        assert_true(n <= 20);
        for (int32_t i = 0; i < n; i++) in_plane[i] = rg_isometry_apply(&l->flat.place[f], p->corner[p->start[k] + i]);
        if (is_inside(in_plane, n, point) && side * p->raise[k] > 0) best = level[f] + p->raise[k];
    }
    return best;
}

/* Returns how many cells would show a wrong facet without the pieces. */
static int check(const char *kind)
{
    rg_motion *m = motion_of(kind, NULL);
    const rg_layers *l = rg_ending_layers(m, m->report.frame_count - 1);
    rg_patches p;
    int wrong = 0;
    assert_non_null(l);
    const rg_cells *c = &l->cells;
    int32_t *level = calloc((size_t)l->flat.nf, sizeof *level);
    assert_true(rg_layers_levels(l, level, NULL) > 0);
    assert_int_equal(rg_patches_init(&p, &l->mem, l), RG_OK);
    for (int32_t k = 0; k < c->faces.count; k++)
        for (int side = -1; side <= 1; side += 2) {
            int32_t seen = -1, bare = -1, truth = -1;
            for (int32_t i = c->over_start[k]; i < c->over_start[k + 1]; i++) {
                const int32_t f = c->over[i];
                int outer = 1;
                for (int32_t j = c->over_start[k]; j < c->over_start[k + 1]; j++)
                    outer &= c->over[j] == f || side * rg_layers_above(l, c->over[j], f) > 0;
                if (outer) truth = f;
                if (bare < 0 || side * (level[f] - level[bare]) > 0) bare = f;
                if (seen < 0 || side * (height(&p, l, level, f, c->point[k], side) -
                                        height(&p, l, level, seen, c->point[k], side)) >
                                    0)
                    seen = f;
            }
            assert_int_equal(seen, truth);
            wrong += bare != truth;
        }
    /* A piece runs as its facet does, and its sides on the border of the facet are that facet's. */
    for (int32_t k = 0; k < p.count; k++) {
        double area = 0;
        for (int32_t i = p.start[k], j = p.start[k + 1] - 1; i < p.start[k + 1]; j = i++) {
            area += rg_vec2_cross(p.corner[j], p.corner[i]) / 2;
            if (p.edge[j] < 0) continue;
            const rg_vec2 a = m->mesh.X[m->mesh.edge[p.edge[j]][0]],
                          d = rg_vec2_sub(m->mesh.X[m->mesh.edge[p.edge[j]][1]], a);
            near(rg_vec2_cross(d, rg_vec2_sub(p.corner[j], a)) / rg_vec2_dot(d, d), 0, 1e-6);
            near(rg_vec2_cross(d, rg_vec2_sub(p.corner[i], a)) / rg_vec2_dot(d, d), 0, 1e-6);
        }
        assert_true(area > 0);
    }
    rg_patches_free(&p);
    free(level);
    rg_motion_destroy(m);
    return wrong;
}

static void every_cell_shows_what_is_on_top(void **state)
{
    (void)state;
    assert_true(check("tatou") > 0); /* its four flaps lie on each other in a circle */
    assert_int_equal(check("bird"), 0);
    assert_int_equal(check("preliminary"), 0);
}

static void memory_may_run_short(void **state)
{
    (void)state;
    rg_motion *m = motion_of("tatou", NULL);
    const rg_layers *l = rg_ending_layers(m, m->report.frame_count - 1);
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        rg_patches p;
        const rg_memory mem = {counted_resize, &c};
        const rg_status s = rg_patches_init(&p, &mem, l);
        assert_int_equal(s == RG_OK, p.count > 0 && c.left >= 0);
        rg_patches_free(&p);
        assert_int_equal(c.out, 0);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
    }
    rg_motion_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_cell_shows_what_is_on_top),
                                       cmocka_unit_test(memory_may_run_short)};
    return cmocka_run_group_tests_name("patches", tests, NULL, NULL);
}
