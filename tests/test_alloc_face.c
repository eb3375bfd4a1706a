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

#include <unistd.h>

/* Where a call asks more often than this, only so many places are tried, spread over all; fewer where it takes a second, and under AddressSanitizer. */
enum { MOST_PLACES = WITH_ASAN ? 40 : 150, MOST_OF_SLOW = WITH_ASAN ? 6 : 15 };

typedef rg_status call(const rg_memory *mem, counted *c);

static void refuse_at(call *f, const char *name, long most)
{
    counted all = {1000000000, 0, 0};
    const rg_memory with_all = {counted_resize, &all};
    const rg_status plain = f(&with_all, &all);
    if (plain != RG_OK) fail_msg("%s, with all memory: %s", name, rg_status_text(plain));
    assert_int_equal(all.out, 0);
    assert_true(all.asked > 0);
    const long stride = all.asked > most ? all.asked / most : 1;
    for (long k = 0; k < all.asked; k += stride) {
        counted c = {k, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        const rg_status s = f(&mem, &c);
        if (s != RG_ENOMEM || c.out != 0) fail_msg("%s: request %ld of %ld refused: %s, %ld blocks left", name, k, all.asked, rg_status_text(s), (long)c.out);
    }
}

static void refuse_everywhere(call *f, const char *name) { refuse_at(f, name, MOST_PLACES); }

/* What is made first has all the memory there is; then as much as `c` had. */
static long unlimited(counted *c)
{
    const long left = c->left;
    c->left = 1000000000;
    return left;
}

static void limited(counted *c, long left)
{
    c->left = left;
    c->asked = 0;
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

/* Between frames of a motion that was relaxed, and by an angle. */
static rg_status read_off_a_path(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    rg_settings s = settings_with(mem);
    rg_pattern *p = generated("closed-split", 0);
    rg_fold *f = NULL, *g = NULL;
    assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f, NULL), RG_OK);
    const double angle = (rg_motion_angles(rg_fold_motion(f), 2)[0] + rg_motion_angles(rg_fold_motion(f), 3)[0]) / 2;
    limited(c, left);
    rg_status status = rg_fold_clone(f, &g);
    if (status == RG_OK) status = rg_fold_go_to(f, 37);
    if (status == RG_OK) status = rg_fold_go_to_angle(g, 0, angle);
    rg_fold_destroy(f);
    rg_fold_destroy(g);
    rg_pattern_destroy(p);
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
        if (status == RG_OK) status = rg_fold_forget(f);
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

static rg_status examples_written(const rg_memory *mem, counted *c)
{
    char folder[] = "/tmp/rigami-example-XXXXXX", path[64];
    rg_example e = rg_example_default();
    e.memory = mem;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/x.fold", folder);
    const long asked = c->asked;
    rg_status status = rg_example_write("miura", &e, path, NULL);
    assert_true(c->asked > asked);
    const rg_sink sink = {drop, &(size_t){0}};
    if (status == RG_OK) status = rg_example_write_to("miura", &e, &sink, NULL);
    unlink(path);
    assert_int_equal(rmdir(folder), 0);
    return status;
}

/* ---------------------------------------------------------------------------------------- of what is there already ---- */

static rg_pattern *generated_with(const rg_memory *mem, const char *kind, int32_t n)
{
    rg_reading r = rg_reading_default();
    rg_pattern *p = NULL;
    r.memory = mem;
    assert_int_equal(rg_generate_pattern(kind, n, 0, 0, &r, &p, NULL), RG_OK);
    return p;
}

static rg_motion *motion_with(const rg_memory *mem, const rg_pattern *p)
{
    rg_settings s = settings_with(mem);
    rg_motion *m = NULL;
    s.frames = 3;
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
    return m;
}

static rg_status patterns_compared_and_aimed(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    rg_pattern *p = generated_with(mem, "miura", 3), *q = generated_with(mem, "miura", 3);
    const rg_plane *plane = rg_pattern_get_plane(p);
    int32_t crease = 0;
    while (plane->assignment[crease] == 'B') crease++;
    limited(c, left);
    rg_status status = rg_pattern_same_sheet(p, q, NULL);
    if (status == RG_OK) status = rg_pattern_set_target(p, crease, 0.5);
    if (status == RG_OK) status = rg_pattern_pin(p, crease);
    rg_pattern_destroy(q);
    rg_pattern_destroy(p);
    return status;
}

/* Half folded, then folded. */
static rg_status states_of_a_sheet(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    rg_settings s = settings_with(mem);
    rg_pattern *state[2] = {generated("preliminary", 0), generated("preliminary", 0)};
    rg_motion *m = NULL;
    rg_plane plane = *rg_pattern_get_plane(state[0]);
    for (int32_t e = 0; e < plane.edges; e++)
        if (plane.assignment[e] != 'B') assert_int_equal(rg_pattern_set_target(state[0], e, plane.target[e]), RG_OK);
    limited(c, left);
    const rg_status status = rg_motion_create_states((const rg_pattern *const *)state, 2, &s, NULL, NULL, &m, NULL);
    assert_int_equal(m != NULL, status == RG_OK);
    rg_motion_destroy(m);
    for (int k = 0; k < 2; k++) rg_pattern_destroy(state[k]);
    return status;
}

static rg_status ways_to_go(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    rg_pattern *p = generated("miura", 3);
    rg_motion *m = motion_with(mem, p);
    int32_t ways = -1;
    limited(c, left);
    const rg_status status = rg_motion_mobility(m, 1, &ways);
    assert_int_equal(ways, status == RG_OK ? 1 : -1);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
    return status;
}

typedef struct pot { char *byte; size_t n; } pot;

static int pour(void *ctx, const void *bytes, size_t n)
{
    pot *p = ctx;
    p->byte = realloc(p->byte, p->n + n + 1);
    memcpy(p->byte + p->n, bytes, n);
    p->byte[p->n += n] = 0;
    return 0;
}

/* A written motion's bytes, of memory that is not counted; also in a file. */
static pot written_motion(char path[64])
{
    pot text = {NULL, 0};
    const rg_sink sink = {pour, &text};
    rg_pattern *p = generated("miura", 2);
    rg_motion *m = motion_with(NULL, p);
    assert_int_equal(rg_motion_write_to(m, ".fold", -1, &sink, NULL, NULL), RG_OK);
    strcpy(path, "/tmp/rigami-alloc-XXXXXX");
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && write(fd, text.byte, text.n) == (ssize_t)text.n && close(fd) == 0);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
    return text;
}

static rg_status motions_read_again(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    char path[64];
    pot text = written_motion(path);
    rg_reading r = rg_reading_default();
    rg_motion *m = NULL;
    r.memory = mem;
    limited(c, left);
    const rg_status status = rg_motion_read(path, &r, &m, NULL);
    assert_int_equal(m != NULL, status == RG_OK);
    rg_motion_destroy(m);
    unlink(path);
    free(text.byte);
    return status;
}

static rg_status certificates(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    char path[64];
    pot text = written_motion(path);
    rg_certificate *a = NULL, *b = NULL;
    size_t n = 0;
    const rg_sink sink = {drop, &n};
    rg_pattern *p = generated_with(mem, "miura", 2);
    limited(c, left);
    rg_status status = rg_certificate_create(path, p, mem, &a, NULL);
    if (status == RG_OK) status = rg_certificate_parse(text.byte, text.n, p, mem, &b, NULL);
    for (int json = 0; status == RG_OK && json < 2; json++) {
        status = rg_certificate_write_to(a, json, &sink, NULL);
        if (status == RG_OK) status = rg_certificate_write(b, json, path, NULL);
    }
    rg_certificate_destroy(a);
    rg_certificate_destroy(b);
    rg_pattern_destroy(p);
    unlink(path);
    free(text.byte);
    return status;
}

static rg_status conversions(const rg_memory *mem, counted *c)
{
    static const rg_format formats[] = {RG_FORMAT_OPX, RG_FORMAT_CP, RG_FORMAT_FOLD, RG_FORMAT_SVG, RG_FORMAT_DXF};
    const long left = unlimited(c);
    pot text = {NULL, 0};
    const rg_sink in = {pour, &text};
    size_t n = 0;
    const rg_sink out = {drop, &n};
    rg_reading r = rg_reading_default();
    char path[] = "/tmp/rigami-alloc-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && close(fd) == 0);
    assert_int_equal(rg_generate_to("miura", 2, 0, 0, &in, NULL), RG_OK);
    r.memory = mem;
    limited(c, left);
    rg_status status = RG_OK;
    for (int k = 0; status == RG_OK && k < 5; k++) status = rg_convert_to(text.byte, text.n, formats[k], &out, &r, NULL, NULL, NULL);
    if (status == RG_OK) status = rg_convert("patterns/fish.opx", path, RG_FORMAT_CP, &r, NULL, NULL, NULL);
    unlink(path);
    free(text.byte);
    return status;
}

static rg_status what_is_known_to_files(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    rg_pattern *p = generated_with(mem, "miura", 2);
    char path[] = "/tmp/rigami-alloc-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && close(fd) == 0);
    limited(c, left);
    rg_status status = rg_info_write(p, path, NULL);
    if (status == RG_OK) status = rg_info_text(p, 1, path, NULL);
    unlink(path);
    rg_pattern_destroy(p);
    return status;
}

/* Both say RG_EABSENT on a machine that cannot draw. */
static rg_status single_pictures(const rg_memory *mem, counted *c)
{
    const long left = unlimited(c);
    static unsigned char rgb[3 * 32 * 24];
    rg_settings s = settings_with(mem);
    rg_pattern *p = generated("fish", 0);
    rg_picture picture = rg_picture_default();
    rg_fold *f = NULL;
    picture.width = 32, picture.height = 24;
    assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f, NULL), RG_OK);
    limited(c, left);
    rg_status status = rg_motion_draw(rg_fold_motion(f), 2, &picture, rgb, NULL);
    if (status == RG_OK) status = rg_fold_draw(f, &picture, rgb, NULL);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
    return status;
}

/* How often a run is repeated, to be timed, is not the same every time, and so is not how often it asks: early requests are refused, at
 * ever longer distances. */
static rg_settings settings_of_a_chart(const rg_memory *mem)
{
    rg_settings s = settings_with(mem);
    s.frames = 3;
    s.to = 0.3;
    return s;
}

static void charts_made(void)
{
    rg_pattern *p = generated("miura", 2);
    for (long k = 0; k < 5000; k += 1 + k / 4) {
        counted c = {k, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        const rg_settings s = settings_of_a_chart(&mem);
        rg_chart *chart = NULL;
        const rg_status status = rg_chart_create(p, &s, NULL, NULL, &chart, NULL);
        if (status != RG_ENOMEM || c.out != 0 || chart) fail_msg("rg_chart_create: request %ld refused: %s", k, rg_status_text(status));
    }
    rg_pattern_destroy(p);
}

static rg_status charts_written(const rg_memory *mem, counted *c)
{
    static const char *const forms[] = {".csv", ".svg", ".md"};
    const long left = unlimited(c);
    const rg_settings s = settings_of_a_chart(mem);
    rg_pattern *p = generated("miura", 2);
    rg_chart *chart = NULL;
    size_t n = 0;
    const rg_sink sink = {drop, &n};
    char folder[] = "/tmp/rigami-alloc-XXXXXX", path[sizeof folder + 6];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/c.csv", folder);
    assert_int_equal(rg_chart_create(p, &s, NULL, NULL, &chart, NULL), RG_OK);
    limited(c, left);
    rg_status status = RG_OK;
    for (int k = 0; status == RG_OK && k < 3; k++) status = rg_chart_write_to(chart, "t", forms[k], &sink, NULL);
    if (status == RG_OK) status = rg_chart_write(chart, "t", path, NULL);
    rg_chart_destroy(chart);
    unlink(path);
    assert_int_equal(rmdir(folder), 0);
    rg_pattern_destroy(p);
    return status;
}

static void each_of_them(void **state)
{
    (void)state;
    refuse_everywhere(from_arrays, "rg_pattern_create");
    refuse_everywhere(generated_at_once, "rg_generate_pattern");
    refuse_everywhere(examples_written, "rg_example_write and _to");
    refuse_everywhere(moved_fold, "rg_fold_create");
    refuse_everywhere(read_off_a_path, "rg_fold_go_to");
    refuse_everywhere(steered_fold, "rg_fold_drive");
    refuse_everywhere(driven_motion, "rg_motion_create_driven");
    refuse_everywhere(sinks, "sinks");
    refuse_everywhere(patterns_compared_and_aimed, "rg_pattern_same_sheet");
    refuse_everywhere(states_of_a_sheet, "rg_motion_create_states");
    refuse_everywhere(motions_read_again, "rg_motion_read");
    refuse_everywhere(certificates, "rg_certificate_create");
    refuse_everywhere(conversions, "rg_convert");
    refuse_everywhere(what_is_known_to_files, "rg_info_write");
    charts_made();
    refuse_at(charts_written, "rg_chart_write", MOST_OF_SLOW);
    refuse_everywhere(ways_to_go, "rg_motion_mobility");
    counted all = {1000000000, 0, 0};
    const rg_memory mem = {counted_resize, &all};
    if (single_pictures(&mem, &all) == RG_EABSENT) print_message("SKIPPED: rg_motion_draw: nothing to draw with\n");
    else refuse_everywhere(single_pictures, "rg_motion_draw");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_of_them)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
