/* motion/stages, motion/rectify: patterns that go only in stages, or that go so as well. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "draw.h"
#include "by_hand.h"
#include "contact/course.h"
#include "corpus.h"
#include "motion/motion.h"
#include "motion/rectify.h"
#include "motion/stages.h"
#include "written.h"

/* Coordinates as a drawing program writes them, if digits > 0. */
static rg_pattern *folded_by_hand(int folds, unsigned *seed, double digit)
{
    by_hand h;
    by_hand_any(&h, folds, seed);
    for (int32_t i = 0; digit > 0 && i < h.lines.count; i++) {
        double *x[] = {&h.lines.line[i].a.x, &h.lines.line[i].a.y, &h.lines.line[i].b.x, &h.lines.line[i].b.y};
        for (int k = 0; k < 4; k++) *x[k] = digit * round(*x[k] / digit);
    }
    return pattern_of(&h.lines);
}

/* ---- rectify */

typedef struct apart { rg_layers *layers; rg_simple simple; rg_mesh mesh; } apart;

static void take_apart(apart *a, rg_pattern *p)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_diag why = {0, ""};
    assert_int_equal(rg_layers_create(p, NULL, &a->layers, &why), RG_OK);
    assert_int_equal(a->layers->info.state, RG_LAYERS_VALID);
    assert_int_equal(rg_layers_choose(a->layers, NULL), RG_OK);
    assert_int_equal(rg_simple_find(&a->simple, &mem, a->layers, NULL), RG_OK);
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &a->mesh, &why), RG_OK);
}

static void apart_free(apart *a)
{
    rg_simple_free(&a->simple);
    rg_layers_destroy(a->layers);
    rg_mesh_free(&a->mesh);
}

/* How far facets put a vertex apart, reached over different ones, in the middle of a stage. */
static double gap_in_stage(const apart *a, const rg_vec2 *X, int32_t stage, double part)
{
    rg_tree tree;
    double *rho = calloc((size_t)a->mesh.N, sizeof *rho);
    rg_place *place = calloc((size_t)a->mesh.nf, sizeof *place);
    for (int32_t i = 0; i < a->mesh.N; i++) {
        const int32_t e = a->mesh.crease_edge[i], s = a->simple.stage[e];
        rho[i] = s < 0 || s > stage ? 0 : (s == stage ? part : 1) * a->mesh.target[e];
    }
    assert_int_equal(rg_tree_init(&a->mesh, -1, &tree), RG_OK);
    rg_pose_facets(&a->mesh, X, &tree, rho, place);
    const double gap = rg_pose_gap(X, &tree, place) / a->mesh.size;
    rg_tree_free(&tree);
    free(rho);
    free(place);
    return gap;
}

/* A rounded drawing's bodies turn about one line only on the pattern that is found; and that is as near as it was rounded. */
static void rounded_drawings(void **state)
{
    (void)state;
    unsigned seed = 5;
    int mended = 0;
    for (int k = 0; k < 20; k++) {
        rg_pattern *p = folded_by_hand(2 + k % 3, &seed, 1e-6);
        apart a;
        double moved, off, before = 0;
        take_apart(&a, p);
        rg_vec2 *X = calloc((size_t)a.mesh.nv, sizeof *X);
        assert_int_equal(rg_rectify(&a.mesh, &a.simple, X, &moved, &off), RG_OK);
        below(off, RG_RECTIFIED);
        below(moved, 2e-5);
        for (int32_t s = 1; s <= a.simple.stages; s++)
            for (double part = 0.125; part <= 1; part += 0.2) {
                before = fmax(before, gap_in_stage(&a, a.mesh.X, s, part));
                below(gap_in_stage(&a, X, s, part), 1e-11);
            }
        mended += before > 1e-8;
        /* Each vertex of the border is on the border still, corners where they were. */
        for (int32_t e = 0; e < a.mesh.ne; e++)
            for (int i = 0; i < 2 && a.mesh.edge_crease[e] < 0; i++) {
                const int32_t v = a.mesh.edge[e][i];
                near(rg_vec2_turn(a.mesh.X[a.mesh.edge[e][0]], a.mesh.X[a.mesh.edge[e][1]], X[v]), 0, 1e-12);
            }
        free(X);
        apart_free(&a);
        rg_pattern_destroy(p);
    }
    assert_true(mended >= 10);
}

static void exact_drawings_stay(void **state)
{
    (void)state;
    unsigned seed = 21;
    rg_pattern *p = folded_by_hand(3, &seed, 0);
    apart a;
    double moved, off;
    take_apart(&a, p);
    rg_vec2 *X = calloc((size_t)a.mesh.nv, sizeof *X);
    assert_int_equal(rg_rectify(&a.mesh, &a.simple, X, &moved, &off), RG_OK);
    assert_true(moved == 0);
    below(off, RG_RECTIFIED);
    /* What is no flat fold is not made one. */
    a.mesh.X[a.mesh.inner_vertex[0]].x += 0.05;
    a.mesh.X[a.mesh.inner_vertex[0]].y -= 0.03;
    assert_int_equal(rg_rectify(&a.mesh, &a.simple, X, &moved, &off), RG_OK);
    assert_true(moved > 1e-3 || off > RG_RECTIFIED);
    free(X);
    apart_free(&a);
    rg_pattern_destroy(p);
}

/* ---- the motion */

static rg_status make(rg_pattern *p, const rg_settings *s, rg_motion **m, rg_diag *why) { return rg_motion_create(p, s, NULL, NULL, m, why); }

/* Judged by what shares no code with all this. */
static void is_valid(const rg_motion *m)
{
    char path[300], reason[300] = "";
    rg_diag why = {0, ""};
    rg_certificate *c = NULL;
    const rg_fault *fault;
    if (rg_motion_write(m, written_path("x.fold", path), NULL, &why) != RG_OK) fail_msg("%s", why.text);
    if (rg_certificate_create(path, NULL, NULL, &c, &why) != RG_OK) fail_msg("%s", why.text);
    if (rg_certificate_faults(c, &fault) > 0) snprintf(reason, sizeof reason, "frame %d: %s", (int)fault[0].frame, fault[0].text);
    if (!rg_certificate_get_info(c)->valid) fail_msg("%s", reason);
    rg_certificate_destroy(c);
}

/* What every motion in stages has to be, whatever it is of. */
static void is_well(const rg_motion *m, int32_t frames)
{
    const rg_report *r = rg_motion_report(m);
    assert_int_equal(r->outcome, RG_FOLDED);
    assert_int_equal(r->contact, RG_CONTACT_FREE);
    assert_int_equal(r->frame_count, frames);
    below(r->max_closure_residual, 1e-10);
    below(r->max_facet_gap, 1e-10);
    near(r->folded_percent, 100, 1e-9);
    assert_true(r->isometric);
    below(r->max_leap_deg, 90);
    /* Stage after stage, each crease in one of them. */
    int32_t frame = 0, creases = 0;
    for (int32_t k = 0; k < r->stages; k++) {
        const rg_folding_stage *g = &r->stage[k];
        int32_t in_folds = 0;
        assert_int_equal(g->first_frame, frame);
        assert_true(g->last_frame > frame);
        frame = g->last_frame;
        creases += g->creases;
        for (int32_t f = 0; f < g->folds; f++) in_folds += g->fold[f].creases;
        assert_true(g->folds == 0 ? k == 0 : in_folds == g->creases);
        for (int32_t i = 0; i < g->creases; i++) {
            near(rg_motion_angles(m, g->first_frame)[g->crease[i]], 0, 1e-12);
            near(fabs(rg_motion_angles(m, g->last_frame)[g->crease[i]]), RG_PI, 1e-12);
            near(rg_motion_angles(m, g->last_frame)[g->crease[i]], m->target[g->crease[i]], 1e-12);
        }
        /* A simple fold is one turn: its creases are equally far, all others rest. */
        for (int32_t j = g->first_frame; g->folds && j <= g->last_frame; j++) {
            const double turned = fabs(rg_motion_angles(m, j)[g->crease[0]]);
            double all = 0, its = 0;
            for (int32_t i = 0; i < m->mesh.N; i++) all += fabs(rg_motion_angles(m, j)[i] - rg_motion_angles(m, g->first_frame)[i]);
            for (int32_t i = 0; i < g->creases; i++) {
                near(fabs(rg_motion_angles(m, j)[g->crease[i]]), turned, 1e-12);
                its += fabs(rg_motion_angles(m, j)[g->crease[i]]);
            }
            near(all, its, 1e-9);
        }
    }
    assert_int_equal(frame, frames - 1);
    assert_true(creases <= m->mesh.N);
    for (int32_t k = 1; k < frames; k++) assert_true(r->frames[k].percent >= r->frames[k - 1].percent - 1e-9);
    is_valid(m);
}

/* Any three folds over all layers: nobody can fold those at once, plates least of all. */
static void folds_over_all_layers(void **state)
{
    (void)state;
    unsigned seed = 3;
    int in_stages = 0;
    for (int k = 0; k < 12; k++) {
        rg_settings s = rg_settings_default();
        rg_pattern *p = folded_by_hand(3, &seed, 0);
        rg_motion *m = NULL;
        rg_diag why = {0, ""};
        s.adjust = 0; /* on the pattern as it is, so that there is no other way */
        s.frames = 41;
        if (make(p, &s, &m, &why) != RG_OK) fail_msg("%s", why.text);
        const rg_report *r = rg_motion_report(m);
        if (r->stages > 0) {
            assert_string_equal(r->rung, "in stages");
            is_well(m, 41);
            in_stages++;
            rg_motion_destroy(m);
            s.frames = 2; /* fewer than there are stages */
            if (make(p, &s, &m, &why) != RG_OK) fail_msg("%s", why.text);
            assert_int_equal(rg_motion_report(m)->contact, RG_CONTACT_FREE);
            is_valid(m);
        } else {
            assert_true(r->contact == RG_CONTACT_FREE || r->outcome == RG_STOPPED);
        }
        rg_motion_destroy(m);
        rg_pattern_destroy(p);
    }
    print_message("%d of 12 go in stages\n", in_stages);
    assert_true(in_stages >= 6);
}

/* A search that found nothing, and stages all the same. */
static rg_status stage(rg_pattern *p, const rg_settings *s, rg_stages *q, rg_search *c, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    rg_watch nobody = {0};
    rg_mesh none;
    *q = (rg_stages){.count = 0};
    *c = (rg_search){.tries = 0};
    rg_status status = rg_mesh_from_pattern(p, &mem, &none, why);
    if (status != RG_OK) return status;
    status = rg_stages_try(q, c, &none, s, &nobody, why);
    rg_mesh_free(&none);
    return status;
}

static void base_first(void **state)
{
    (void)state;
    rg_settings s = rg_settings_default();
    s.frames = 61;
    for (int in = 0; in < 2; in++) {
        rg_pattern *p = base_and_corner(in ? RG_MOUNTAIN : RG_VALLEY);
        rg_stages q;
        rg_search c;
        rg_diag why = {0, ""};
        if (stage(p, &s, &q, &c, &why) != RG_OK) fail_msg("%s", why.text);
        if (in) {
            assert_int_equal(q.count, 0);
            assert_null(c.best.rho);
        } else {
            assert_int_equal(q.count, 2);
            assert_int_equal(q.stage[0].folds, 0);
            assert_int_equal(q.stage[0].creases, 6);
            assert_int_equal(q.stage[0].first_frame, 0);
            assert_int_equal(q.stage[1].folds, 1);
            assert_in_range(q.stage[1].creases, 1, 3); /* creases added to the base may cut it */
            assert_int_equal(q.stage[1].last_frame, 60);
            const double *end = c.best.rho + 60 * (size_t)c.best.mesh.N;
            for (int32_t i = 0; i < c.best.mesh.N - c.best.mesh.added; i++)
                near(end[i], c.best.mesh.target[c.best.mesh.crease_edge[i]], 1e-12);
        }
        rg_motion_free_stages(&q);
        rg_attempt_free(&c.best);
        rg_pattern_destroy(p);
    }
}

/* Other people's patterns, of which no motion all at once was found when this was written: what simple folds leave is folded free, all
 * frames close, and no facets cross in them or between them. */
static void real_patterns(void **state)
{
    (void)state;
    static const struct { const char *name; int32_t stages; } known[] = {
        {"foldability/319-brown-4x4-d59.fold", 2}, {"foldability/185-brown-4x4-c44.fold", 4}, {"foldability/367-brown-4x4-d107.fold", 3}, {"fold/008-ku-robot.fold", 6}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        char path[1024];
        rg_settings s = rg_settings_default();
        rg_pattern *p = NULL;
        rg_stages q;
        rg_search c;
        rg_diag why = {0, ""};
        if (rg_pattern_read(corpus(known[i].name, path, sizeof path), NULL, &p, &why) != RG_OK) fail_msg("%s: %s", path, why.text);
        s.frames = 301;
        if (stage(p, &s, &q, &c, &why) != RG_OK) fail_msg("%s", why.text);
        print_message("%s: %d stages\n", known[i].name, (int)q.count);
        assert_int_equal(q.count, known[i].stages);
        const rg_mesh *m = &c.best.mesh;
        rg_course course;
        rg_tree tree;
        rg_place *place = calloc((size_t)m->nf, sizeof *place);
        rg_vec3 *x = calloc((size_t)m->nv, sizeof *x);
        assert_int_equal(rg_tree_init(m, -1, &tree), RG_OK);
        assert_int_equal(rg_course_init(m, &course), RG_OK);
        assert_int_equal(c.best.count, 301);
        for (int32_t k = 0; k < c.best.count; k++) {
            const rg_vec2 *X = c.best.flat + (size_t)k * (size_t)m->nv;
            rg_pose_facets(m, X, &tree, c.best.rho + (size_t)k * (size_t)m->N, place);
            rg_pose_vertices(m, X, &tree, place, x);
            below(rg_pose_gap(X, &tree, place) / m->size, 1e-10);
            (void)rg_course_add(&course, &(rg_plates_state){X, place, x}, 1);
        }
        (void)rg_course_end(&course);
        if (course.found.first >= 0) fail_msg("facets %d and %d cross at frame %d", (int)course.found.facet[0], (int)course.found.facet[1], (int)course.found.first);
        rg_course_free(&course);
        rg_tree_free(&tree);
        free(place);
        free(x);
        rg_motion_free_stages(&q);
        rg_attempt_free(&c.best);
        rg_pattern_destroy(p);
    }
}

static void same_bits_and_starving(void **state)
{
    (void)state;
    unsigned seed = 3;
    rg_pattern *p = folded_by_hand(2, &seed, 0);
    rg_settings s = rg_settings_default();
    s.frames = 9;
    s.adjust = 0;
    rg_search first, again;
    rg_stages q, q2;
    rg_diag why = {0, ""};
    assert_int_equal(stage(p, &s, &q, &first, &why), RG_OK);
    assert_true(q.count > 0);
    assert_int_equal(stage(p, &s, &q2, &again, &why), RG_OK);
    assert_int_equal(first.best.count, again.best.count);
    assert_memory_equal(first.best.rho, again.best.rho, (size_t)first.best.count * (size_t)first.best.mesh.N * sizeof(double));
    rg_motion_free_stages(&q);
    rg_motion_free_stages(&q2);
    rg_attempt_free(&first.best);
    rg_attempt_free(&again.best);
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        s.memory = &mem;
        const rg_status status = stage(p, &s, &q, &first, &why);
        rg_motion_free_stages(&q);
        rg_attempt_free(&first.best);
        assert_int_equal(c.out, 0);
        if (status == RG_OK) break;
        assert_int_equal(status, RG_ENOMEM);
    }
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rounded_drawings), cmocka_unit_test(exact_drawings_stay), cmocka_unit_test(folds_over_all_layers),
                                       cmocka_unit_test(base_first), cmocka_unit_test(real_patterns), cmocka_unit_test(same_bits_and_starving)};
    return cmocka_run_group_tests(tests, written_begin, written_end);
}
