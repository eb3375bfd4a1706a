/* Components folded apart: each as if the others were not there, whatever becomes of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "draw.h"
#include "folding.h"
#include "fold/system.h"
#include "mesh/components.h"

/* A vertex at (x, 1) on a strip two high: creases at 90 +- a and 270 +- (90 - a) degrees, so that it folds flat. */
static void draw_vertex(rg_lines *l, double x, double a, const char *assignment)
{
    const double up = tan(a * RG_DEG), down = tan((90 - a) * RG_DEG);
    const rg_vec2 end[] = {{x + up, 2}, {x - up, 2}, {x - down, 0}, {x + down, 0}};
    for (int i = 0; i < 4; i++) draw(l, assignment[i], x, 1, end[i].x, end[i].y);
}

static const char FOLDS[] = "MVMM", NEVER_FOLDS[] = "MMMM";

/* Places of what is drawn on a strip from 0 to 16: two vertices and a crease that meets none. */
typedef struct strip { double vertex[2], angle[2]; const char *assignment[2]; double crease; } strip;

static rg_pattern *strip_pattern(const strip *s)
{
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 16, 2);
    for (int k = 0; k < 2; k++)
        if (s->vertex[k] > 0) draw_vertex(&l, s->vertex[k], s->angle[k], s->assignment[k]);
    if (s->crease > 0) draw(&l, 'V', s->crease, 0, s->crease, 2);
    return pattern_of(&l);
}

/* The crease of `one` that has the ends of crease i of `many`, -1: none. */
static int32_t same_crease(const rg_mesh *many, int32_t i, const rg_mesh *one)
{
    const int32_t *e = many->edge[many->crease_edge[i]];
    for (int32_t k = 0; k < one->N; k++) {
        const int32_t *g = one->edge[one->crease_edge[k]];
        for (int turn = 0; turn < 2; turn++)
            if (rg_vec2_length(rg_vec2_sub(many->X[e[0]], one->X[g[turn]])) < 1e-9 &&
                rg_vec2_length(rg_vec2_sub(many->X[e[1]], one->X[g[!turn]])) < 1e-9) return k;
    }
    return -1;
}

/* Every frame of the strip is, crease by crease, that of the strips on which each thing is alone. */
static void each_folds_as_if_alone(void **state)
{
    (void)state;
    const strip all = {{3, 11}, {30, 35}, {FOLDS, FOLDS}, 7};
    const strip alone[] = {{{3, 0}, {30, 0}, {FOLDS, NULL}, 0}, {{0, 11}, {0, 35}, {NULL, FOLDS}, 0}, {{0, 0}, {0}, {NULL}, 7}};
    for (int method = RG_METHOD_NEWTON; method <= RG_METHOD_ADAPTIVE; method++) {
        rg_settings s = rg_settings_default();
        s.method = (rg_method)method;
        s.frames = 23;
        rg_pattern *p = strip_pattern(&all), *q[3];
        rg_straight *f = fold_of(p, &s), *g[3];
        for (int k = 0; k < 3; k++) g[k] = fold_of(q[k] = strip_pattern(&alone[k]), &s);
        assert_int_equal(f->apart.parts, 3);
        for (int32_t frame = 0; frame < s.frames; frame++) {
            int32_t seen = 0;
            rg_step_info i;
            assert_true(next_frame(f, &i));
            assert_int_equal(i.frame, frame);
            near(rg_drive_progress(&f->drive, f->rho), (double)frame / (s.frames - 1), 1e-9);
            for (int k = 0; k < 3; k++) {
                assert_true(next_frame(g[k], &i));
                assert_int_equal(i.frame, frame);
                for (int32_t a = 0; a < f->mesh.N; a++) {
                    const int32_t b = same_crease(&f->mesh, a, &g[k]->mesh);
                    if (b < 0) continue;
                    near(f->rho[a], g[k]->rho[b], 1e-9);
                    seen++;
                }
            }
            assert_int_equal(seen, f->mesh.N);
        }
        assert_int_equal(f->outcome, RG_FOLDED);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
        for (int k = 0; k < 3; k++) {
            rg_straight_destroy(g[k]);
            rg_pattern_destroy(q[k]);
        }
    }
}

/* A vertex of four mountains cannot fold; the vertex and the crease beside it come to their end in all frames asked for. */
static void one_that_is_held_does_not_hold_the_others(void **state)
{
    (void)state;
    const strip both = {{3, 11}, {30, 30}, {NEVER_FOLDS, FOLDS}, 7};
    rg_settings s = rg_settings_default();
    rg_pattern *p = strip_pattern(&both);
    rg_straight *f = fold_of(p, &s);
    int32_t frames = 0, last = -1;
    for (rg_step_info i; next_frame(f, &i); frames++) last = i.frame;
    assert_int_equal(f->outcome, RG_STOPPED);
    assert_non_null(strstr(f->reason, "1 of 3 independent parts"));
    assert_int_equal(last, s.frames - 1);
    assert_int_equal(frames, s.frames);
    for (int32_t i = 0; i < f->mesh.N; i++) {
        const int32_t *e = f->mesh.edge[f->mesh.crease_edge[i]];
        const int held = fmin(f->mesh.X[e[0]].x, f->mesh.X[e[1]].x) < 5;
        if (held) assert_true(fabs(f->rho[i]) < RG_PI - 0.1);
        else near(f->rho[i], f->drive.target[i], 1e-9);
    }
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
}

/* What is not to move is no work: the run costs what the vertex that is to move costs alone. */
static void what_does_not_move_is_not_solved(void **state)
{
    (void)state;
    const strip one = {{0, 11}, {0, 30}, {NULL, FOLDS}, 0}, both = {{3, 11}, {30, 30}, {"FFFF", FOLDS}, 0};
    rg_settings s = rg_settings_default();
    rg_pattern *p = strip_pattern(&one), *q = strip_pattern(&both);
    rg_straight *f = fold_of(p, &s), *g = fold_of(q, &s);
    for (rg_step_info i; next_frame(f, &i) && f->outcome == RG_RUNNING;) {}
    for (rg_step_info i; next_frame(g, &i) && g->outcome == RG_RUNNING;) {}
    assert_int_equal(g->outcome, RG_FOLDED);
    assert_true(rg_straight_cost(f).solves > 0);
    assert_int_equal(rg_straight_cost(g).solves, rg_straight_cost(f).solves);
    assert_int_equal(rg_straight_cost(g).assemblies, rg_straight_cost(f).assemblies);
    rg_straight_destroy(f);
    rg_straight_destroy(g);
    rg_pattern_destroy(p);
    rg_pattern_destroy(q);
}

/* Against who can be reached from whom, by a power of "share an interior vertex". */
static void components_are_the_classes_of_reach(void **state)
{
    (void)state;
    unsigned seed = 7;
    for (int round = 0; round < 40; round++) {
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 16, 2);
        for (int k = 0; k < 4; k++) { /* now a vertex, now a crease, now nothing */
            const int what = whole_noise(&seed, 3);
            if (what == 1) draw_vertex(&l, 2 + 4 * k, 45, FOLDS);
            if (what == 2) draw(&l, 'M', 2 + 4 * k, 0, 2 + 4 * k, 2);
        }
        rg_settings s = rg_settings_default();
        rg_pattern *p = pattern_of(&l);
        rg_straight *f = fold_of(p, &s);
        const rg_mesh *m = &f->mesh;
        int reach[16][16] = {{0}}, classes = 0;
        int32_t part[16];
        assert_in_range(m->N, 0, 16);
        for (int32_t i = 0; i < m->N; i++) reach[i][i] = 1;
        for (int32_t k = 0; k < m->M; k++)
            for (int32_t a = m->loop_start[k]; a < m->loop_start[k + 1]; a++)
                for (int32_t b = m->loop_start[k]; b < m->loop_start[k + 1]; b++) reach[m->loop_crease[a]][m->loop_crease[b]] = 1;
        for (int n = 0; n < 4; n++)
            for (int i = 0; i < m->N; i++)
                for (int j = 0; j < m->N; j++)
                    for (int k = 0; k < m->N; k++) reach[i][j] |= reach[i][k] && reach[k][j];
        for (int i = 0; i < m->N; i++) {
            int first = 1;
            for (int j = 0; j < i; j++) first &= !reach[i][j];
            classes += first;
        }
        assert_int_equal(rg_components_find(m, part), classes);
        for (int i = 0; i < m->N; i++)
            for (int j = 0; j < m->N; j++) assert_int_equal(part[i] == part[j], reach[i][j]);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
    }
}

/* Facets that lie beside each other over an added crease limit it: those creases are not taken apart. */
static void added_creases_stay_with_their_limits(void **state)
{
    (void)state;
    const strip pleats = {{0, 0}, {0}, {NULL}, 7};
    rg_settings s = rg_settings_default();
    s.triangulate = RG_TRIANGULATE_ALL;
    rg_pattern *p = strip_pattern(&pleats);
    rg_straight *f = fold_of(p, &s);
    assert_int_equal(f->mesh.N, 3);
    assert_int_equal(f->apart.parts, 0);
    for (rg_step_info i; next_frame(f, &i) && f->outcome == RG_RUNNING;) {}
    assert_int_equal(f->outcome, RG_FOLDED);
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
}

static void want_of_memory_is_told(void **state)
{
    (void)state;
    const strip all = {{3, 11}, {30, 35}, {FOLDS, FOLDS}, 7};
    rg_pattern *p = strip_pattern(&all);
    starves_cleanly(p, rg_settings_default());
    rg_pattern_destroy(p);
}

/* What a crease may turn does not depend on what else is on the sheet: added creases have the same neighbours in their part. */
static void limits_are_those_of_the_sheet(void **state)
{
    (void)state;
    /* Two creases that meet on the border: in the triangle between them no crease is added that would join what is beside it. */
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 16, 2);
    draw_vertex(&l, 3, 30, FOLDS);
    draw_vertex(&l, 11, 35, FOLDS);
    draw(&l, 'V', 7, 0, 6.5, 2);
    draw(&l, 'M', 7, 0, 7.5, 2);
    rg_settings s = rg_settings_default();
    s.triangulate = RG_TRIANGULATE_ALL;
    rg_pattern *p = pattern_of(&l);
    rg_straight *f = fold_of(p, &s);
    rg_limit whole;
    assert_true(f->apart.parts > 1 && f->mesh.added > 4);
    assert_int_equal(rg_limit_init(&whole, &f->mem, &f->mesh), RG_OK);
    double rho[64], pull[64], mine[64], own[64];
    unsigned seed = 3;
    int pulled = 0;
    assert_true(f->mesh.N <= 64);
    for (int turn = 0; turn < 100; turn++) {
        for (int32_t i = 0; i < f->mesh.N; i++) rho[i] = 2.5 * noise(&seed);
        rg_limit_pull(&whole, rho, pull);
        for (int32_t k = 0; k < f->apart.parts; k++) {
            const int32_t *crease = f->apart.crease + f->apart.start[k], n = f->apart.start[k + 1] - f->apart.start[k];
            for (int32_t i = 0; i < n; i++) own[i] = rho[crease[i]];
            rg_limit_pull(&f->apart.part[k]->limit, own, mine);
            for (int32_t i = 0; i < n; i++) {
                near(mine[i], pull[crease[i]], 1e-15);
                pulled += mine[i] != 0;
            }
        }
    }
    assert_true(pulled > 100);
    rg_limit_free(&whole);
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_folds_as_if_alone),
        cmocka_unit_test(one_that_is_held_does_not_hold_the_others),
        cmocka_unit_test(what_does_not_move_is_not_solved),
        cmocka_unit_test(components_are_the_classes_of_reach),
        cmocka_unit_test(added_creases_stay_with_their_limits),
        cmocka_unit_test(want_of_memory_is_told), cmocka_unit_test(limits_are_those_of_the_sheet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
