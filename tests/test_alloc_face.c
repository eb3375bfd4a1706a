/* The public face with memory that runs short at every place where it asks: nothing lost, nothing half made, RG_ENOMEM. What test_alloc.c
 * does for reading, searching and writing to files, for patterns from arrays, folds that are moved and steered, tangents and sinks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
#include "near.h"
#include "rigami.h"

/* Where a call asks more often than this, only so many places are tried, spread over all. */
enum { MOST_PLACES = 150 };

typedef rg_status call(const rg_memory *mem, counted *c);

static void refuse_everywhere(call *f, const char *name)
{
    counted all = {1000000000, 0, 0};
    const rg_memory with_all = {counted_resize, &all};
    const rg_status plain = f(&with_all, &all);
    if (plain != RG_OK) fail_msg("%s, with all memory: %s", name, rg_status_text(plain));
    assert_int_equal(all.out, 0);
    assert_true(all.asked > 0);
    const long stride = all.asked > MOST_PLACES ? all.asked / MOST_PLACES : 1;
    for (long k = 0; k < all.asked; k += stride) {
        counted c = {k, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        const rg_status s = f(&mem, &c);
        if (s != RG_ENOMEM || c.out != 0) fail_msg("%s: request %ld of %ld refused: %s, %ld blocks left", name, k, all.asked, rg_status_text(s), (long)c.out);
    }
}

/* With memory of its own. */
static rg_pattern *generated(const char *kind, int32_t n)
{
    rg_pattern *p = NULL;
    assert_int_equal(rg_generate_pattern(kind, n, 0, 0, NULL, &p, NULL), RG_OK);
    return p;
}

static rg_settings settings_with(const rg_memory *mem)
{
    rg_settings s = rg_settings_default();
    s.memory = mem;
    s.frames = 5;
    s.effort = RG_EFFORT_FAST;
    return s;
}

static rg_status from_arrays(const rg_memory *mem, counted *c)
{
    static const double at[4][2] = {{0, 0}, {1.25, 0}, {1.25, 1}, {0, 1}};
    static const int32_t ends[5][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
    rg_drawing d = rg_drawing_default();
    rg_reading r = rg_reading_default();
    rg_pattern *p = NULL;
    (void)c;
    d.vertices = 4, d.edges = 5, d.at = at, d.ends = ends, d.assignment = "BBBBV", d.title = "t", d.author = "a";
    r.memory = mem;
    rg_status s = rg_pattern_create(&d, &r, &p, NULL);
    assert_int_equal(p != NULL, s == RG_OK);
    for (int32_t e = 0; s == RG_OK && e < 5; e++)
        if (rg_pattern_get_plane(p)->assignment[e] == 'V') s = rg_pattern_pin(p, e);
    rg_pattern_destroy(p);
    return s;
}

static rg_status generated_at_once(const rg_memory *mem, counted *c)
{
    rg_reading r = rg_reading_default();
    rg_pattern *p = NULL;
    (void)c;
    r.memory = mem;
    const rg_status s = rg_generate_pattern("miura", 3, 0, 0, &r, &p, NULL);
    assert_int_equal(p != NULL, s == RG_OK);
    rg_pattern_destroy(p);
    return s;
}

/* Found, gone to anywhere, cloned, kept, recorded, its tangent taken. */
static rg_status moved_fold(const rg_memory *mem, counted *c)
{
    rg_settings s = settings_with(mem);
    rg_pattern *p = generated("miura", 2);
    rg_fold *f = NULL, *g = NULL;
    rg_snapshot *kept = NULL;
    rg_motion *m = NULL;
    rg_tangent *t = NULL;
    int32_t freedoms;
    (void)c;
    rg_status status = rg_fold_create(p, &s, NULL, NULL, &f, NULL);
    assert_int_equal(f != NULL, status == RG_OK);
    rg_pattern_destroy(p);
    if (status == RG_OK) status = rg_fold_go_to(f, 37);
    if (status == RG_OK) status = rg_fold_go_to_angle(f, 0, rg_motion_angles(rg_fold_motion(f), 2)[0] * 0.9);
    if (status == RG_OK) status = rg_fold_snapshot(f, &kept);
    if (status == RG_OK) status = rg_fold_clone(f, &g);
    if (status == RG_OK) status = rg_fold_restore(g, kept);
    if (status == RG_OK) status = rg_fold_record(f, &m, NULL);
    if (status == RG_OK) status = rg_fold_tangent(f, &t);
    if (status == RG_OK) status = rg_tangent_basis(t, &freedoms, NULL);
    rg_tangent_destroy(t);
    t = NULL;
    if (status == RG_OK) status = rg_motion_tangent(m, 1, &t);
    rg_tangent_destroy(t);
    rg_motion_destroy(m);
    rg_snapshot_destroy(kept);
    rg_fold_destroy(g);
    rg_fold_destroy(f);
    return status;
}

static rg_status steered_fold(const rg_memory *mem, counted *c)
{
    rg_settings s = settings_with(mem);
    rg_pattern *p = generated("miura", 2);
    rg_fold *f = NULL, *g = NULL;
    rg_snapshot *kept = NULL;
    rg_motion *m = NULL;
    const int32_t crease = 1;
    (void)c;
    rg_status status = rg_fold_create_flat(p, &s, &f, NULL);
    assert_int_equal(f != NULL, status == RG_OK);
    if (status == RG_OK) {
        const double to = 0.8, on = 1.2;
        status = rg_fold_drive(f, 1, &crease, &to);
        for (int k = 0; status == RG_OK && k < 4; k++) rg_fold_step(f);
        if (status == RG_OK) status = rg_fold_go_to(f, 61);
        if (status == RG_OK) status = rg_fold_pin(f, 0);
        if (status == RG_OK) status = rg_fold_set_target(f, 0, RG_FREE);
        if (status == RG_OK) status = rg_fold_drive(f, 1, &crease, &on);
        if (status == RG_OK) rg_fold_step(f);
        if (status == RG_OK) status = rg_fold_snapshot(f, &kept);
        if (status == RG_OK) status = rg_fold_clone(f, &g);
        if (status == RG_OK) status = rg_fold_restore(f, kept);
        if (status == RG_OK) status = rg_fold_record(g, &m, NULL);
    }
    rg_motion_destroy(m);
    rg_snapshot_destroy(kept);
    rg_fold_destroy(g);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
    return status;
}

static rg_status driven_motion(const rg_memory *mem, counted *c)
{
    rg_settings s = settings_with(mem);
    rg_pattern *p = generated("closed-adjust", 0); /* it stops as drawn, and is cut */
    const rg_plane *plane = rg_pattern_get_plane(p);
    rg_driven one = {0, 0};
    rg_motion *m = NULL;
    (void)c;
    while (plane->assignment[one.edge] == 'B') one.edge++;
    one.radians = plane->assignment[one.edge] == 'V' ? 0.5 : -0.5;
    const rg_status status = rg_motion_create_driven(p, 1, &one, &s, NULL, NULL, &m, NULL);
    assert_int_equal(m != NULL, status == RG_OK);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
    return status;
}

static int drop(void *ctx, const void *bytes, size_t n)
{
    (void)bytes;
    *(size_t *)ctx += n;
    return 0;
}

/* Every writer that needs no pictures, with the memory of what it writes. */
static rg_status sinks(const rg_memory *mem, counted *c)
{
    static const char *const forms[] = {".fold", ".obj", ".csv", ".svg", ".stl", ".glb", ".html"};
    rg_settings s = settings_with(mem);
    rg_reading r = rg_reading_default();
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    size_t n = 0;
    const rg_sink sink = {drop, &n};
    (void)c;
    r.memory = mem;
    rg_status status = rg_generate_pattern("miura", 2, 0, 0, &r, &p, NULL);
    if (status == RG_OK) status = rg_motion_create(p, &s, NULL, NULL, &m, NULL);
    for (int k = 0; status == RG_OK && k < 7; k++) status = rg_motion_write_to(m, forms[k], -1, &sink, NULL, NULL);
    if (status == RG_OK) status = rg_report_write_to(m, 0, 0, &sink, NULL);
    if (status == RG_OK) status = rg_info_write_to(p, &sink, NULL);
    if (status == RG_OK) status = rg_info_text_to(p, 1, &sink, NULL);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
    return status;
}

static void each_of_them(void **state)
{
    (void)state;
    refuse_everywhere(from_arrays, "rg_pattern_create");
    refuse_everywhere(generated_at_once, "rg_generate_pattern");
    refuse_everywhere(moved_fold, "rg_fold_create");
    refuse_everywhere(steered_fold, "rg_fold_drive");
    refuse_everywhere(driven_motion, "rg_motion_create_driven");
    refuse_everywhere(sinks, "sinks");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_of_them)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
