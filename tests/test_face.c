/* The public face beside files: patterns from arrays, what is lent, settings that are refused, output to a sink, one picture of one state. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "rigami.h"
#include "written.h"

#include <unistd.h>

/* A waterbomb base, in the caller's arrays. */
static const double corner[9][2] = {{0, 0}, {1.25, 0}, {2.5, 0}, {2.5, 1.25}, {2.5, 2.5}, {1.25, 2.5}, {0, 2.5}, {0, 1.25}, {1.25, 1.25}};
static const int32_t ends[16][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 0}, {8, 0}, {8, 2}, {8, 4}, {8, 6}, {8, 3}, {8, 7}, {8, 1}, {8, 5}};
static const char letters[] = "BBBBBBBBVVVVMM";

static rg_drawing base(void)
{
    rg_drawing d = rg_drawing_default();
    d.vertices = 9;
    d.edges = 14;
    d.at = corner;
    d.ends = ends;
    d.assignment = letters;
    d.title = "Base";
    return d;
}

static rg_pattern *pattern_of(const rg_drawing *d)
{
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    if (rg_pattern_create(d, NULL, &p, &why) != RG_OK) fail_msg("%s", why.text);
    return p;
}

/* ------------------------------------------------------------------------------------------------------ arrays ---- */

static void from_arrays_and_back(void **state)
{
    (void)state;
    double target[14];
    for (int e = 0; e < 14; e++) target[e] = NAN;
    target[9] = 1.25, target[13] = RG_FREE;
    rg_drawing d = base();
    d.target = target;
    rg_pattern *p = pattern_of(&d);
    const rg_pattern_info *i = rg_pattern_get_info(p);
    const rg_plane *q = rg_pattern_get_plane(p);
    assert_string_equal(i->title, "Base");
    assert_int_equal(i->creases, 6);
    /* Straight-through vertices of the border are gone: it is what is folded. */
    assert_int_equal(q->vertices, 7);
    assert_int_equal(q->edges, 12);
    assert_int_equal(q->facets, 6);
    int32_t corners = 0, found = 0;
    for (int32_t e = 0; e < q->edges; e++) {
        const double *a = q->at[q->ends[e][0]], *b = q->at[q->ends[e][1]];
        const int32_t line = q->line[e] - 1;
        assert_in_range(line, 0, 13);
        assert_int_equal(q->assignment[e], letters[line]);
        assert_int_equal(rg_pattern_edge_between(p, q->ends[e][0], q->ends[e][1]), e);
        assert_int_equal(rg_pattern_edge_between(p, q->ends[e][1], q->ends[e][0]), e);
        assert_int_equal(rg_pattern_edge_at(p, (const double[]){0.6 * a[0] + 0.4 * b[0] + 1e-4, 0.6 * a[1] + 0.4 * b[1]}), e);
        const double wish = letters[line] == 'M' ? -3.14159265358979 : 3.14159265358979;
        if (q->assignment[e] == 'B' || line == 13) assert_true(isnan(q->target[e]));
        else near(q->target[e], line == 9 ? 1.25 : wish, 1e-14);
        found++;
    }
    assert_int_equal(found, 12);
    for (int32_t f = 0; f < q->facets; f++) corners += q->facet_start[f + 1] - q->facet_start[f];
    assert_int_equal(corners, q->facet_start[q->facets]);
    assert_int_equal(corners, 2 * 6 + 6); /* each crease is of two facets, each border edge of one */
    assert_int_equal(rg_pattern_edge_between(p, 0, 0), -1);
    assert_int_equal(rg_pattern_edge_between(p, -1, 99), -1);
    assert_int_equal(rg_pattern_edge_at(p, (const double[]){1.25, 0.6}), -1);
    assert_int_equal(rg_pattern_set_target(p, -1, 0), RG_EARG);
    assert_int_equal(rg_pattern_set_target(p, 0, 1), RG_EARG); /* the border */
    rg_pattern_destroy(p);
}

/* The sheet that is folded: edges of the pattern first, creases in their order, added ones last. */
static void sheet_of(int cuts)
{
    rg_pattern *p = NULL;
    rg_settings s = rg_settings_default();
    rg_motion *m = NULL;
    assert_int_equal(rg_generate_pattern("miura", 3, 0, 0, NULL, &p, NULL), RG_OK);
    s.triangulate = cuts ? RG_TRIANGULATE_ALL : RG_TRIANGULATE_NONE;
    s.frames = 3;
    s.to = 0.5;
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
    const rg_plane *q = rg_pattern_get_plane(p);
    const rg_sheet *h = rg_motion_get_sheet(m);
    int32_t crease = 0;
    assert_int_equal(h->added > 0, cuts);
    for (int32_t e = 0; e < q->edges; e++) {
        assert_memory_equal(h->ends[e], q->ends[e], sizeof *q->ends);
        assert_int_equal(h->edge_crease[e], q->assignment[e] == 'B' ? -1 : crease++);
    }
    assert_int_equal(crease, h->creases - h->added);
    for (int32_t i = 0; i < h->creases; i++) {
        rg_crease c;
        assert_int_equal(rg_motion_crease(m, i, &c), RG_OK);
        assert_int_equal(c.edge, h->crease_edge[i]);
        assert_int_equal(c.added, i >= h->creases - h->added);
        assert_int_equal(rg_motion_crease_between(m, c.vertices[1], c.vertices[0]), i);
        const double middle[2] = {(c.at[0][0] + c.at[1][0]) / 2, (c.at[0][1] + c.at[1][1]) / 2};
        if (!c.added) assert_int_equal(rg_motion_crease_at(m, middle), i);
    }
    /* Its triangles: facet by facet, with its corners, counter-clockwise, as large together as it is. */
    assert_int_equal(h->facet_triangle[0], 0);
    assert_int_equal(h->facet_triangle[h->facets], h->triangles);
    for (int32_t f = 0; f < h->facets; f++) {
        double area = 0, sum = 0;
        const int32_t from = h->facet_start[f], to = h->facet_start[f + 1];
        assert_int_equal(h->facet_triangle[f + 1] - h->facet_triangle[f], to - from - 2);
        for (int32_t j = from; j < to; j++) {
            const double *a = h->flat[h->facet_vertex[j]], *b = h->flat[h->facet_vertex[j + 1 < to ? j + 1 : from]];
            area += (a[0] * b[1] - a[1] * b[0]) / 2;
        }
        for (int32_t t = h->facet_triangle[f]; t < h->facet_triangle[f + 1]; t++) {
            const double *a = h->flat[h->triangle[t][0]], *b = h->flat[h->triangle[t][1]], *c = h->flat[h->triangle[t][2]];
            const double one = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
            assert_true(one > 0);
            sum += one;
            for (int k = 0; k < 3; k++) {
                int32_t j = from;
                while (j < to && h->facet_vertex[j] != h->triangle[t][k]) j++;
                assert_true(j < to);
            }
        }
        near(sum, area, 1e-12 * area);
    }
    assert_int_equal(rg_motion_crease(m, h->creases, NULL), RG_EARG);
    assert_int_equal(rg_motion_crease_at(m, (const double[]){1e9, 0}), -1);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
}

static void the_sheet_goes_on_from_the_pattern(void **state)
{
    (void)state;
    for (int cuts = 0; cuts < 2; cuts++) sheet_of(cuts);
}

/* ------------------------------------------------------------------------------------------- what is refused ---- */

static void drawings_that_are_none(void **state)
{
    (void)state;
    static const int32_t wild[14][2] = {{0, 99}};
    static const double nowhere[9][2] = {{NAN, 0}};
    double target[14] = {0};
    for (int k = 0; k < 9; k++) {
        rg_drawing d = base();
        rg_pattern *p = NULL;
        rg_diag why = {0, ""};
        target[5] = k == 0 ? 4 : 0;
        switch (k) {
        case 0: d.target = target; break;
        case 1: d.ends = wild; break;
        case 2: d.at = nowhere; break;
        case 3: d.assignment = "BBBBxBBBVVVVMM"; break;
        case 4: d.vertices = 0; break;
        case 5: d.edges = 0; break;
        case 6: d.size = 3; break;
        case 7: d.size = 10000; break;
        default: d.unit = NAN; break;
        }
        assert_int_equal(rg_pattern_create(&d, NULL, &p, &why), RG_EARG);
        assert_true(why.text[0]);
        assert_null(p);
    }
}

/* Each number out of its range, and each that is none, by whatever takes it. */
static void settings_out_of_range(void **state)
{
    (void)state;
    rg_drawing d = base();
    rg_pattern *p = pattern_of(&d);
    const double bad[] = {NAN, INFINITY, -INFINITY, -2, 400};
    for (int k = 0; k < 5; k++)
        for (int field = 0; field < 4; field++) {
            rg_settings s = rg_settings_default();
            rg_motion *m = NULL;
            rg_fold *f = NULL;
            rg_chart *c = NULL;
            double *const to[] = {&s.step, &s.tol, &s.to, &s.adjust};
            *to[field] = bad[k];
            assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_EARG);
            assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f, NULL), RG_EARG);
            assert_int_equal(rg_fold_create_flat(p, &s, &f, NULL), RG_EARG);
            assert_int_equal(rg_chart_create(p, &s, NULL, NULL, &c, NULL), RG_EARG);
        }
    rg_settings s = rg_settings_default();
    rg_fold *f = NULL;
    s.frames = 1;
    assert_int_equal(rg_fold_create_flat(p, &s, &f, NULL), RG_EARG);
    s = rg_settings_default();
    s.solver = (rg_solver)17;
    assert_int_equal(rg_fold_create_flat(p, &s, &f, NULL), RG_EARG);
    s = rg_settings_default();
    s.size = 0;
    assert_int_equal(rg_fold_create_flat(p, &s, &f, NULL), RG_EARG);
    rg_reading r = rg_reading_default();
    rg_pattern *none = NULL;
    r.unit = NAN;
    assert_int_equal(rg_pattern_parse("x", 1, &r, &none, NULL), RG_EARG);
    rg_pattern_destroy(p);
}

/* A caller that was compiled with a shorter struct: the rest is as usual, and nothing behind it is touched. */
static void defaults_for_a_shorter_struct(void **state)
{
    (void)state;
    unsigned char room[sizeof(rg_settings) + 8];
    memset(room, 0xa5, sizeof room);
    rg_settings_init((rg_settings *)(void *)room, offsetof(rg_settings, threads));
    for (size_t i = offsetof(rg_settings, threads); i < sizeof room; i++) assert_int_equal(room[i], 0xa5);
    const rg_settings usual = rg_settings_default();
    assert_memory_equal(room + sizeof(size_t), (const unsigned char *)&usual + sizeof(size_t), offsetof(rg_settings, threads) - sizeof(size_t));
    assert_int_equal(rg_version_number(), RG_VERSION_NUMBER);
    char text[40];
    snprintf(text, sizeof text, "%d.%d.%d", RG_VERSION_MAJOR, RG_VERSION_MINOR, RG_VERSION_PATCH);
    assert_string_equal(text, rg_version());
}

/* ------------------------------------------------------------------------------------------------------- sinks ---- */

typedef struct pot { unsigned char *byte; size_t n; int refuses; } pot;

static int pour(void *ctx, const void *bytes, size_t size)
{
    pot *p = ctx;
    if (p->refuses) return 1;
    p->byte = realloc(p->byte, p->n + size + 1);
    memcpy(p->byte + p->n, bytes, size);
    p->n += size;
    return 0;
}

static void empty(pot *p)
{
    free(p->byte);
    *p = (pot){0};
}

/* What a sink got is what the file has. */
static void is_the_file(const pot *p, const char *path)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    unsigned char *bytes = malloc(p->n + 2);
    const size_t n = fread(bytes, 1, p->n + 1, f);
    fclose(f);
    assert_int_equal(n, p->n);
    assert_memory_equal(bytes, p->byte, n);
    free(bytes);
}

static void every_writer_to_a_sink(void **state)
{
    (void)state;
    rg_drawing d = base();
    rg_pattern *cp = pattern_of(&d);
    rg_settings s = rg_settings_default();
    rg_picture picture = rg_picture_default();
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    char path[300];
    pot p = {0};
    const rg_sink sink = {pour, &p};
    s.frames = 4;
    picture.width = 80, picture.height = 60;
    assert_int_equal(rg_motion_create(cp, &s, NULL, NULL, &m, NULL), RG_OK);
    static const char *const forms[] = {".fold", ".obj", ".stl", ".glb", ".gltf", ".csv", ".svg", ".dxf", ".html", ".png", ".gif", ".apng", ".mp4"};
    for (int k = 0; k < 13; k++) {
        char name[20];
        snprintf(name, sizeof name, "x%s", forms[k]);
        if (rg_output_check(name, &why) == RG_EABSENT) {
            print_message("SKIPPED: %s: %s\n", forms[k], why.text);
            continue;
        }
        if (rg_motion_write_to(m, forms[k], -1, &sink, &picture, &why) != RG_OK) fail_msg("%s: %s", forms[k], why.text);
        if (rg_motion_write(m, written_path(name, path), &picture, &why) != RG_OK) fail_msg("%s: %s", forms[k], why.text);
        is_the_file(&p, path);
        unlink(path);
        empty(&p);
        p.refuses = 1;
        assert_int_equal(rg_motion_write_to(m, forms[k], -1, &sink, &picture, &why), RG_EWRITE);
        empty(&p);
    }
    assert_int_equal(rg_motion_write_to(m, ".obj", 1, &sink, NULL, &why), RG_OK);
    char *text = calloc(p.n + 1, 1);
    assert_non_null(text);
    memcpy(text, p.byte, p.n);
    assert_non_null(strstr(text, "frame 1,"));
    free(text);
    empty(&p);
    static const char *const none[] = {"", ".", "obj", ".xyz", "x.obj", "/tmp/", ".%d.png"};
    for (int k = 0; k < 7; k++) assert_int_equal(rg_motion_write_to(m, none[k], -1, &sink, NULL, &why), RG_EARG);
    assert_int_equal(rg_motion_write_to(m, ".obj", 4, &sink, NULL, &why), RG_EARG);
    assert_int_equal(p.n, 0);

    assert_int_equal(rg_report_write_to(m, 0.5, 1e6, &sink, &why), RG_OK);
    assert_int_equal(rg_report_write(m, 0.5, 1e6, written_path("r.json", path), &why), RG_OK);
    is_the_file(&p, path);
    empty(&p);
    assert_int_equal(rg_info_write_to(cp, &sink, &why), RG_OK);
    assert_int_equal(rg_info_write(cp, written_path("i.json", path), &why), RG_OK);
    is_the_file(&p, path);
    empty(&p);
    assert_int_equal(rg_info_text_to(cp, 1, &sink, &why), RG_OK);
    assert_int_equal(rg_info_text(cp, 1, written_path("i.txt", path), &why), RG_OK);
    is_the_file(&p, path);
    empty(&p);

    /* A generated file, converted in memory, judged in memory. */
    static const rg_format formats[] = {RG_FORMAT_OPX, RG_FORMAT_CP, RG_FORMAT_FOLD, RG_FORMAT_SVG, RG_FORMAT_DXF};
    pot q = {0};
    const rg_sink second = {pour, &q};
    rg_pattern *bird = NULL;
    assert_int_equal(rg_generate_to("bird", 0, 0, 0, &sink, &why), RG_OK);
    assert_int_equal(rg_generate_pattern("bird", 0, 0, 0, NULL, &bird, &why), RG_OK);
    for (int k = 0; k < 5; k++) {
        rg_pattern *back = NULL;
        assert_int_equal(rg_convert_to(p.byte, p.n, formats[k], &second, NULL, NULL, NULL, &why), RG_OK);
        assert_int_equal(rg_pattern_parse(q.byte, q.n, NULL, &back, &why), RG_OK);
        assert_int_equal(rg_pattern_get_info(back)->creases, rg_pattern_get_info(bird)->creases);
        rg_pattern_destroy(back);
        empty(&q);
    }
    rg_pattern_destroy(bird);
    assert_int_equal(rg_convert_to(p.byte, p.n, RG_FORMAT_AUTO, &second, NULL, NULL, NULL, &why), RG_EARG);
    /* An example is the generated file; in another format and size, it is what its file is. */
    rg_example e = rg_example_default();
    assert_int_equal(rg_example_write_to("bird", NULL, &second, &why), RG_OK);
    assert_int_equal(q.n, p.n);
    assert_memory_equal(q.byte, p.byte, p.n);
    empty(&q);
    e.format = RG_FORMAT_DXF, e.side = 7;
    assert_int_equal(rg_example_write_to("bird", &e, &second, &why), RG_OK);
    assert_int_equal(rg_example_write("bird", &e, written_path("e.dxf", path), &why), RG_OK);
    is_the_file(&q, path);
    empty(&q);
    e.format = RG_FORMAT_ORI;
    assert_int_equal(rg_example_write_to("bird", &e, &second, &why), RG_EARG);
    assert_int_equal(q.n, 0);
    empty(&p);
    rg_certificate *c = NULL;
    assert_int_equal(rg_motion_write_to(m, ".fold", -1, &sink, NULL, &why), RG_OK);
    assert_int_equal(rg_certificate_parse(p.byte, p.n, cp, NULL, &c, &why), RG_OK);
    assert_int_equal(rg_certificate_get_info(c)->frames, 4);
    for (int json = 0; json < 2; json++) {
        empty(&p);
        assert_int_equal(rg_certificate_write_to(c, json, &sink, &why), RG_OK);
        assert_true(p.n > 10);
    }
    empty(&p);
    rg_certificate_destroy(c);
    rg_motion_destroy(m);
    rg_pattern_destroy(cp);
}

/* ------------------------------------------------------------------------------------------- watched, cancelled ---- */

typedef struct watcher { int calls, stop_at; double last; } watcher;

static int watch(void *ctx, double progress)
{
    watcher *w = ctx;
    assert_true(progress >= w->last && progress <= 1);
    w->last = progress;
    return w->calls++ >= w->stop_at;
}

static void reading_and_writing_are_watched(void **state)
{
    (void)state;
    rg_reading r = rg_reading_default();
    rg_pattern *cp = NULL;
    rg_motion *m = NULL;
    watcher w = {0, 100, 0};
    pot p = {0};
    const rg_sink sink = {pour, &p};
    r.progress = watch, r.progress_ctx = &w;
    assert_int_equal(rg_pattern_read("patterns/bird.opx", &r, &cp, NULL), RG_OK);
    assert_true(w.calls > 0);
    rg_settings s = rg_settings_default();
    s.frames = 6;
    assert_int_equal(rg_motion_create(cp, &s, NULL, NULL, &m, NULL), RG_OK);
    rg_pattern_destroy(cp);
    cp = NULL;
    w = (watcher){0, 0, 0};
    assert_int_equal(rg_pattern_read("patterns/bird.opx", &r, &cp, NULL), RG_ECANCELLED);
    assert_null(cp);
    static const char *const forms[] = {".fold", ".csv", ".glb", ".html", ".obj", ".png", ".gif", ".apng"};
    for (int k = 0; k < 8; k++)
        for (int stop = 0; stop < 3; stop++) {
            rg_picture picture = rg_picture_default();
            picture.width = 80, picture.height = 60;
            picture.progress = watch, picture.progress_ctx = &w;
            if (stop == 2 && k >= 4) continue; /* one frame */
            w = (watcher){0, stop == 2 ? 3 : stop ? 0 : 1000, 0}; /* not at all; at once; in the middle */
            assert_int_equal(rg_motion_write_to(m, forms[k], -1, &sink, &picture, NULL), stop ? RG_ECANCELLED : RG_OK);
            assert_true(w.calls > (stop == 2 ? 3 : 0));
            assert_int_equal(p.n > 0, !stop);
            empty(&p);
        }
    rg_motion_destroy(m);
}

/* ----------------------------------------------------------------------------------------------------- pixels ---- */

static void one_picture_of_one_state(void **state)
{
    (void)state;
    enum { W = 120, H = 90 };
    rg_drawing d = base();
    rg_pattern *cp = pattern_of(&d);
    rg_settings s = rg_settings_default();
    rg_picture picture = rg_picture_default();
    rg_fold *f = NULL;
    rg_diag why = {0, ""};
    static unsigned char rgb[3][3 * W * H + 1];
    picture.width = W, picture.height = H, picture.shadow = 0;
    s.frames = 9;
    assert_int_equal(rg_fold_create(cp, &s, NULL, NULL, &f, NULL), RG_OK);
    rgb[0][3 * W * H] = 77;
    const rg_status drawn = rg_fold_draw(f, &picture, rgb[0], &why);
    if (drawn == RG_EABSENT) print_message("SKIPPED: %s\n", why.text);
    if (drawn == RG_OK) {
        for (int k = 0; k < 5; k++) rg_fold_step(f);
        assert_int_equal(rg_fold_draw(f, &picture, rgb[1], &why), RG_OK);
        assert_int_equal(rg_motion_draw(rg_fold_motion(f), 5, &picture, rgb[2], &why), RG_OK);
        assert_memory_equal(rgb[1], rgb[2], 3 * W * H);
        assert_memory_not_equal(rgb[0], rgb[1], 3 * W * H);
        assert_int_equal(rgb[0][3 * W * H], 77);
        int paper = 0;
        for (int i = 0; i < W * H; i++) paper += memcmp(rgb[0] + 3 * i, picture.background, 3) != 0;
        assert_true(paper > W * H / 5); /* framed on it alone */
        assert_int_equal(rg_motion_draw(rg_fold_motion(f), 9, &picture, rgb[2], &why), RG_EARG);
        picture.zoom = NAN;
        assert_int_equal(rg_fold_draw(f, &picture, rgb[1], &why), RG_EARG);
    }
    rg_fold_destroy(f);
    rg_pattern_destroy(cp);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_arrays_and_back), cmocka_unit_test(the_sheet_goes_on_from_the_pattern), cmocka_unit_test(drawings_that_are_none),
        cmocka_unit_test(settings_out_of_range), cmocka_unit_test(defaults_for_a_shorter_struct), cmocka_unit_test(every_writer_to_a_sink),
        cmocka_unit_test(reading_and_writing_are_watched), cmocka_unit_test(one_picture_of_one_state)};
    return cmocka_run_group_tests(tests, written_begin, written_end);
}
