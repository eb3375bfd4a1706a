/* render/: layers of facets that lie on each other; pictures read back against what geometry says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "corpus.h"
#include "motion/ending.h"
#include "counted.h"
#include "motions.h"
#include "photo.h"
#include "render/camera.h"
#include "render/canvas.h"
#include "render/frames.h"
#include "render/gl.h"
#include "render/lift.h"
#include "render/render.h"

#include <dirent.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

/* ------------------------------------------------------------------------------------------------ layers ---- */

/* Height of each facet over the plane z = 0 after all frames: position of its middle and lift. */
typedef struct pile {
    rg_vec3 *x, *lift;
    rg_triangles triangles;
} pile;

static pile pile_after(const rg_motion *m, int32_t frames)
{
    pile p;
    rg_lift *l = NULL;
    p.x = calloc((size_t)m->mesh.nv, sizeof *p.x);
    p.lift = calloc((size_t)m->mesh.nf, sizeof *p.lift);
    assert_true(p.x && p.lift);
    assert_int_equal(rg_triangles_init(NULL, &m->mesh, &p.triangles), RG_OK);
    assert_int_equal(rg_lift_create(&m->mem, m, &p.triangles, &l), RG_OK);
    for (int32_t k = 0; k < frames; k++) {
        assert_int_equal(rg_lift_next(l, p.x, p.lift), RG_OK);
        for (int32_t f = 0; f < m->mesh.nf; f++)
            below(rg_vec3_length(p.lift[f]), (1 + 1e-9) * RG_LIFT_MOST * m->mesh.size);
    }
    if (frames == m->report.frame_count) assert_int_equal(rg_lift_next(l, p.x, p.lift), RG_EARG);
    rg_lift_destroy(l);
    return p;
}

static void pile_free(pile *p)
{
    rg_triangles_free(&p->triangles);
    free(p->x);
    free(p->lift);
}

/* A strip's panels from bottom to top, once it is folded flat over its first panel. */
static void check_strip(int panels, const double *width, const char *assignment, folding fold, int32_t frames,
                        const char *expected)
{
    rg_lines l = strip(panels, width, assignment, 2.385);
    rg_motion *m = motion_by(&l, frames, fold, NULL);
    pile p = pile_after(m, frames);
    double at = 0, height[8];
    for (int i = 0; i < panels; at += width[i++]) {
        const int32_t f = facet_at(&m->mesh, at + 0.5 * width[i], 1);
        assert_true(f >= 0);
        height[i] = p.lift[f].z;
        near(hypot(p.lift[f].x, p.lift[f].y), 0, 1e-9);
    }
    /* The first panel may be the fixed one or not: from below or from above, but one way for all. */
    const int32_t first = facet_at(&m->mesh, 0.5 * width[0], 1);
    rg_vec3 n = rg_vec3_cross(rg_vec3_sub(p.x[m->mesh.facet_vertex[m->mesh.facet_start[first] + 1]],
                                          p.x[m->mesh.facet_vertex[m->mesh.facet_start[first]]]),
                              rg_vec3_sub(p.x[m->mesh.facet_vertex[m->mesh.facet_start[first] + 2]],
                                          p.x[m->mesh.facet_vertex[m->mesh.facet_start[first]]]));
    for (int i = 0; i + 1 < panels; i++) {
        const double step = (height[expected[i + 1] - '0'] - height[expected[i] - '0']) * (n.z > 0 ? 1 : -1);
        if (!(step > 1e-6)) fail_msg("%s of %s, %d frames: panel %c is not above %c", assignment, expected, (int)frames,
                                     expected[i + 1], expected[i]);
    }
    pile_free(&p);
    rg_motion_destroy(m);
}

/* The last crease first, each all the way before the next one. */
static void from_the_end(const rg_mesh *m, double t, double *rho, void *ctx)
{
    (void)ctx;
    for (int32_t i = 0; i < m->N; i++) {
        int32_t later = 0;
        for (int32_t j = 0; j < m->N; j++)
            later += m->X[m->edge[m->crease_edge[j]][0]].x > m->X[m->edge[m->crease_edge[i]][0]].x;
        rho[i] = RG_PI * mountain_or_valley(m, i) * fmin(1, fmax(0, m->N * t - later));
    }
}

/* What paper does: a pleat goes up panel by panel, a roll has its end inside. Also with few frames, where what was before
 * is far from flat. */
static void strips_are_piled_as_paper_is(void **state)
{
    (void)state;
    static const double even[] = {1, 1, 1, 1, 1, 1}, roll[] = {1.25, 1.2, 1.15, 1.1, 1.05, 1.0};
    static const int32_t frames[] = {2, 3, 7, 60};
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        check_strip(2, even, "V", all_alike, frames[i], "01");
        check_strip(2, even, "M", all_alike, frames[i], "10");
        check_strip(6, even, "VMVMV", all_alike, frames[i], "012345");
        check_strip(6, even, "MVMVM", all_alike, frames[i], "543210");
        check_strip(3, roll, "MM", from_the_end, 2 * frames[i] + 1, "120");
        check_strip(5, roll, "VVVV", from_the_end, 4 * frames[i] + 1, "02431");
        check_strip(6, roll, "VVMVV", from_the_end, 5 * frames[i] + 1, "045321");
    }
}

static void layers_stay_in_order(void **state)
{
    (void)state;
    static const double width[] = {1, 1, 1, 1};
    rg_lines l = strip(4, width, "VMV", 1.7);
    rg_motion *m = motion_by(&l, 31, one_by_one, NULL);
    const int32_t a = facet_at(&m->mesh, 0.5, 1), b = facet_at(&m->mesh, 1.5, 1);
    int lying = 0;
    for (int32_t k = 1; k <= 31; k++) {
        pile p = pile_after(m, k);
        rg_place place[4];
        rg_pose_facets(&m->mesh, m->mesh.X, &m->tree, rg_motion_angles(m, k - 1), place);
        if (k >= 11) { /* a and b lie on each other: b on a's front side, from now on */
            const double apart = rg_vec3_dot(place[a].R.c[2], rg_vec3_sub(p.lift[b], p.lift[a]));
            if (!(apart > 1e-6)) fail_msg("frame %d: %g", (int)k - 1, apart);
            lying++;
        } else if (k > 1) { /* nothing lies on anything */
            near(rg_vec3_length(p.lift[a]) + rg_vec3_length(p.lift[b]), 0, 0);
        }
        pile_free(&p);
    }
    assert_int_equal(lying, 21);
    rg_motion_destroy(m);
}

/* Any two facets that share a point when flat-folded, over z = 0, are drawn apart: checked at every facet's middle against
 * all others. turn: length times distance from an edge that makes it inside of another. Returns how many there were. */
static int overlaps_apart(const rg_motion *m, const pile *p, double turn)
{
    int overlaps = 0;
    for (int32_t f = 0; f < m->mesh.nf; f++) {
        rg_vec3 middle = {0, 0, 0};
        const int32_t first = m->mesh.facet_start[f], n = m->mesh.facet_start[f + 1] - first;
        for (int32_t j = 0; j < n; j++) middle = rg_vec3_axpy(1.0 / n, p->x[m->mesh.facet_vertex[first + j]], middle);
        for (int32_t g = 0; g < m->mesh.nf; g++) {
            double least = INFINITY, most = -INFINITY;
            const int32_t from = m->mesh.facet_start[g], k = m->mesh.facet_start[g + 1] - from;
            for (int32_t j = 0; j < k; j++) {
                const rg_vec3 a = p->x[m->mesh.facet_vertex[from + j]], b = p->x[m->mesh.facet_vertex[from + (j + 1) % k]];
                const double at = rg_vec2_turn((rg_vec2){a.x, a.y}, (rg_vec2){b.x, b.y}, (rg_vec2){middle.x, middle.y});
                least = fmin(least, at), most = fmax(most, at);
            }
            if (g == f || !(least > turn || most < -turn)) continue;
            overlaps++;
            if (!(fabs(p->lift[f].z - p->lift[g].z) > 1e-7 * m->mesh.size)) fail_msg("facets %d and %d", (int)f, (int)g);
        }
    }
    return overlaps;
}

static void flat_miura_has_no_two_facets_in_one_place(void **state)
{
    (void)state;
    double alpha = 60 * RG_DEG;
    rg_lines l = miura(7, 6, 1.25, 1, alpha);
    rg_motion *m = motion_by(&l, 30, miura_folds, &alpha);
    rg_place *place = calloc((size_t)m->mesh.nf, sizeof *place);
    assert_non_null(place);
    rg_pose_facets(&m->mesh, m->mesh.X, &m->tree, rg_motion_angles(m, 20), place);
    below(rg_pose_gap(m->mesh.X, &m->tree, place), 1e-9); /* it is a motion */
    pile p = pile_after(m, 30);
    assert_true(overlaps_apart(m, &p, 0.05) > 100);
    pile_free(&p);
    free(place);
    rg_motion_destroy(m);
}

/* The base of four cranes folds through itself, so that no order is right everywhere: facets above and below each other
 * by turns came to one level where the circle was cut, and were seen in stripes of both. */
static void facets_that_run_in_circles_are_apart_too(void **state)
{
    (void)state;
    rg_settings s = rg_settings_default();
    rg_diag why = {0, ""};
    rg_pattern *cp = NULL;
    rg_motion *m = NULL;
    s.frames = 9;
    if (rg_pattern_read("patterns/four-crane.opx", NULL, &cp, &why) != RG_OK) fail_msg("%s", why.text);
    if (rg_motion_create(cp, &s, NULL, NULL, &m, &why) != RG_OK) fail_msg("%s", why.text);
    pile p = pile_after(m, 9);
    for (int32_t v = 0; v < m->mesh.nv; v++) near(p.x[v].z / m->mesh.size, 0, 1e-4);
    assert_true(overlaps_apart(m, &p, 2e-3 * m->mesh.size * m->mesh.size) > 100);
    pile_free(&p);
    rg_motion_destroy(m);
    rg_pattern_destroy(cp);
}

/* Four flaps that close a square, each on the next one: no order of whole facets is right, one is chosen all the same. */
static void pinwheel(const rg_mesh *m, double t, double *rho, void *ctx)
{
    (void)ctx;
    for (int32_t i = 0; i < m->N; i++) rho[i] = t * RG_PI;
}

static void a_circle_of_flaps_is_cut(void **state)
{
    (void)state;
    rg_lines l = drawing();
    const rg_vec2 corner[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < 4; i++) {
        const rg_vec2 a = corner[i], b = corner[(i + 1) % 4], out = {b.y - a.y, a.x - b.x}, along = {b.x - a.x, b.y - a.y};
        draw(&l, RG_VALLEY, a.x, a.y, b.x, b.y);
        draw(&l, RG_BORDER, a.x, a.y, a.x + 0.7 * out.x + 0.1 * along.x, a.y + 0.7 * out.y + 0.1 * along.y);
        draw(&l, RG_BORDER, a.x + 0.7 * out.x + 0.1 * along.x, a.y + 0.7 * out.y + 0.1 * along.y, b.x, b.y);
    }
    rg_motion *m = motion_by(&l, 12, pinwheel, NULL);
    assert_int_equal(m->mesh.nf, 5);
    pile p = pile_after(m, 12), again = pile_after(m, 12);
    assert_memory_equal(p.lift, again.lift, 5 * sizeof *p.lift);
    const int32_t middle = facet_at(&m->mesh, 0.5, 0.5);
    for (int32_t f = 0; f < 5; f++)
        if (f != middle) assert_true(fabs(p.lift[f].z - p.lift[middle].z) > 1e-6);
    pile_free(&p);
    pile_free(&again);
    rg_motion_destroy(m);
}

/* ---------------------------------------------------------------------------------------------- pictures ---- */

/* A flat sheet covers as many pixels as its corners span, partly covered ones by their part; also over several tiles. */
static void covered_area_is_the_projected_one(void **state)
{
    (void)state;
    static const int32_t size[][2] = {{320, 240}, {97, 411}, {1500, 1100}};
    static const double view[][2] = {{-60, 35}, {20, 80}, {130, -25}};
    static const double width[] = {1.25, 0.8};
    for (int i = 0; i < 3; i++) {
        rg_lines l = strip(2, width, "V", 1.37);
        rg_motion *m = motion_by(&l, 1, all_alike, NULL);
        for (int32_t c = 0; c < m->mesh.N; c++) m->rho[c] = 0;
        rg_picture picture = plain(size[i][0], size[i][1]);
        picture.azimuth = view[i][0] * RG_DEG;
        picture.elevation = view[i][1] * RG_DEG;
        photo p = take(m, 0, picture, NULL);
        const rg_vec2 at[] = {seen(&p, (rg_vec3){0, 0, 0}), seen(&p, (rg_vec3){2.05, 0, 0}),
                              seen(&p, (rg_vec3){2.05, 1.37, 0}), seen(&p, (rg_vec3){0, 1.37, 0})};
        const double area = 0.5 * fabs(rg_vec2_turn(at[0], at[1], at[2]) + rg_vec2_turn(at[0], at[2], at[3]));
        const unsigned char *paper = NULL;
        double covered = 0;
        for (int y = 0; y < picture.height; y++)
            for (int x = 0; x < picture.width; x++) /* the colour that is furthest from the background is the paper's */
                if (!paper || abs(pixel(&p, x, y)[2] - picture.background[2]) > abs(paper[2] - picture.background[2]))
                    paper = pixel(&p, x, y);
        for (int y = 0; y < picture.height; y++)
            for (int x = 0; x < picture.width; x++)
                covered += (double)(pixel(&p, x, y)[2] - picture.background[2]) / (paper[2] - picture.background[2]);
        near(covered / area, 1, 4e-3);
        free(p.rgb);
        rg_motion_destroy(m);
    }
}

/* Tints stay those of the paper, whatever the light: a channel is at most the paper's and at least half of it. */
static int shows(const photo *p, int x, int y, const unsigned char paper[3])
{
    const unsigned char *c = pixel(p, x, y);
    double least = INFINITY, most = 0;
    for (int k = 0; k < 3; k++) {
        const double part = (double)c[k] / paper[k];
        least = fmin(least, part), most = fmax(most, part);
    }
    return least > 0.5 && most <= 1 + 1e-9 && most / least < 1.2;
}

static void each_side_has_its_colour(void **state)
{
    (void)state;
    static const double width[] = {1, 0.9};
    rg_lines l = strip(2, width, "V", 1);
    rg_motion *m = motion_by(&l, 1, all_alike, NULL);
    for (int32_t c = 0; c < m->mesh.N; c++) m->rho[c] = 0;
    for (int way = -1; way <= 1; way += 2) {
        rg_picture picture = plain(160, 120);
        picture.elevation = way * 70 * RG_DEG;
        photo p = take(m, 0, picture, NULL);
        assert_true(shows(&p, 80, 60, way > 0 ? picture.front : picture.back));
        assert_false(shows(&p, 80, 60, way > 0 ? picture.back : picture.front));
        free(p.rgb);
    }
    rg_motion_destroy(m);

    /* A valley of 100 degrees shows the front of one panel and the back of the other from its side. */
    rg_lines half = strip(2, width, "V", 1);
    m = motion_by(&half, 1, all_alike, NULL);
    for (int32_t c = 0; c < m->mesh.N; c++) m->rho[c] = 100 * RG_DEG;
    int fronts = 0, backs = 0;
    rg_picture picture = plain(200, 150);
    picture.elevation = 20 * RG_DEG;
    for (int turn = 0; turn < 2; turn++) {
        picture.azimuth = turn * RG_PI;
        photo p = take(m, 0, picture, NULL);
        for (int y = 0; y < 150; y++)
            for (int x = 0; x < 200; x++) {
                fronts += shows(&p, x, y, picture.front);
                backs += !is_background(&p, x, y) && shows(&p, x, y, picture.back);
            }
        free(p.rgb);
    }
    assert_true(fronts > 1000 && backs > 1000);
    rg_motion_destroy(m);
}

typedef struct covered { int left, right, top, bottom; } covered;

static covered covered_by(const photo *p)
{
    covered c = {p->picture.width, 0, p->picture.height, 0};
    for (int y = 0; y < p->picture.height; y++)
        for (int x = 0; x < p->picture.width; x++) {
            if (is_background(p, x, y)) continue;
            c.left = x < c.left ? x : c.left, c.right = x + 1 > c.right ? x + 1 : c.right;
            c.top = y < c.top ? y : c.top, c.bottom = y + 1 > c.bottom ? y + 1 : c.bottom;
        }
    return c;
}

/* WCAG 2.1: relative luminance of sRGB, and the contrast of two. */
static double luminance(const unsigned char c[3])
{
    double linear[3];
    for (int k = 0; k < 3; k++) linear[k] = c[k] / 255.0 <= 0.03928 ? c[k] / 255.0 / 12.92 : pow((c[k] / 255.0 + 0.055) / 1.055, 2.4);
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

static double contrast(const unsigned char a[3], const unsigned char b[3])
{
    const double x = luminance(a), y = luminance(b);
    return (fmax(x, y) + 0.05) / (fmin(x, y) + 0.05);
}

/* In no frame is anything cut off; from frame to frame the camera does not turn and does not jump; the end fills at least 15 % of the
 * picture by its box, in the middle; all paper stands out from what is behind it. */
static void check_film(const rg_motion *m, const char *name, int32_t every)
{
    rg_picture picture = rg_picture_default();
    picture.width = 240, picture.height = 180;
    picture.lines = RG_LINES_NONE;
    picture.shadow = 0;
    const int32_t last = m->report.frame_count - 1;
    photo before = {.rgb = NULL};
    double least = INFINITY, area = 0, off = 0;
    for (int32_t k = last % every; k <= last; k += every) {
        photo p = take(m, k, picture, NULL);
        const covered c = covered_by(&p);
        const double w = picture.width, h = picture.height;
        if (!(c.left > 0.02 * w && c.right < 0.98 * w && c.top > 0.02 * h && c.bottom < 0.98 * h))
            fail_msg("%s, frame %d: cut off: %d ... %d, %d ... %d", name, (int)k, c.left, c.right, c.top, c.bottom);
        area = (c.right - c.left) * (c.bottom - c.top) / (w * h);
        off = fmax(fabs(0.5 * (c.left + c.right) / w - 0.5), fabs(0.5 * (c.top + c.bottom) / h - 0.5));
        if (!(area >= 0.1 && off <= 0.1)) fail_msg("%s, frame %d: covers %g, %g off the middle", name, (int)k, area, off);
        for (int y = 1; y + 1 < picture.height; y++)
            for (int x = 1; x + 1 < picture.width; x++) {
                int inside = !is_background(&p, x, y); /* of a facet: what is behind has no part in its colour */
                for (int i = -1; i < 2; i++)
                    for (int j = -1; j < 2; j++) inside &= memcmp(pixel(&p, x + i, y + j), pixel(&p, x, y), 3) == 0;
                if (inside) least = fmin(least, contrast(pixel(&p, x, y), picture.background));
            }
        if (before.rgb) {
            const double cosine = rg_vec3_dot(before.camera.back, p.camera.back), up = rg_vec3_dot(before.camera.up, p.camera.up);
            const double step = rg_vec3_length(rg_vec3_sub(before.camera.eye, p.camera.eye)) / rg_vec3_length(p.camera.eye);
            assert_true(acos(fmin(1, cosine)) <= every * 3 * RG_DEG && acos(fmin(1, up)) <= every * 3 * RG_DEG);
            if (!(step <= 0.1 * every)) fail_msg("%s, frame %d: the camera jumps by %g", name, (int)k, step);
            free(before.rgb);
        }
        before = p;
    }
    free(before.rgb);
    print_message("%-40s box of the end %4.1f %% of the picture, %4.1f %% off its middle, least contrast %.2f\n", name, 100 * area, 100 * off,
                  least);
    if (!(area >= 0.15)) fail_msg("%s: the end covers %g", name, area);
    if (!(least >= 3)) fail_msg("%s: contrast %g", name, least);
}

static void film_of(const char *path, int32_t every)
{
    rg_settings s = rg_settings_default();
    rg_diag why = {0, ""};
    rg_pattern *cp = NULL;
    rg_motion *m = NULL;
    s.frames = 41;
    s.effort = RG_EFFORT_FAST;
    if (rg_pattern_read(path, NULL, &cp, &why) != RG_OK) fail_msg("%s: %s", path, why.text);
    if (rg_motion_create(cp, &s, NULL, NULL, &m, &why) != RG_OK) fail_msg("%s: %s", path, why.text);
    check_film(m, path, every);
    rg_motion_destroy(m);
    rg_pattern_destroy(cp);
}

static void the_sheet_is_in_the_middle_and_fills_the_picture(void **state)
{
    (void)state;
    DIR *d = opendir("patterns");
    char path[300];
    int films = 0;
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) {
        const char *dot = strrchr(e->d_name, '.');
        if (!dot || strcmp(dot, ".opx") != 0) continue;
        snprintf(path, sizeof path, "patterns/%s", e->d_name);
        film_of(path, 4);
        films++;
    }
    closedir(d);
    assert_true(films >= 15);
}

static void the_same_of_real_patterns(void **state)
{
    (void)state;
    static const char *const names[] = {
        "cp/crane.cp", "fold/017-jorge-tato-coaster.fold", "fold/035-tachioripa-kamehameha.fold", "fold/windmill.fold", "opx/square-fish.opx",
        "foldability/002-traditional-kabuto.fold", "foldability/058-ku-color-change-pinwheel-1.fold", "foldability/074-miuraoripa-miura-ori.fold",
        "foldability/114-kei-kirby.fold", "opx/2x2isoarea.opx"};
    char path[500];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) film_of(corpus(names[i], path, sizeof path), 8);
}

/* The frames lie as near to each other, and a little to the flat sheet, as turning can bring them: then the positions of one and what
 * it is laid on have no moment about their middle, sum of weight * a x b = 0. And they are the frames: distances are those of the motion. */
static void the_stage_turns_as_little_as_it_can(void **state)
{
    (void)state;
    static const double width[] = {1.3, 0.7, 1.1, 0.6};
    rg_lines l = strip(4, width, "VMV", 1.7);
    rg_motion *m = motion_by(&l, 13, one_by_one, NULL);
    const rg_picture picture = plain(80, 60);
    rg_stage stage;
    const int32_t nv = m->mesh.nv;
    rg_vec3 *x = calloc((size_t)nv, sizeof *x), *before = calloc((size_t)nv, sizeof *before), *was = calloc((size_t)nv, sizeof *was);
    rg_vec2 flat = {0, 0};
    double *weight = calloc((size_t)nv, sizeof *weight);
    assert_true(x && before && was && weight);
    for (int i = 0; i < 4; i++) { /* rectangles: a quarter of the area at each corner */
        const int32_t f = facet_at(&m->mesh, (i > 0 ? width[0] : 0) + (i > 1 ? width[1] : 0) + (i > 2 ? width[2] : 0) + 0.5 * width[i], 1);
        for (int32_t j = m->mesh.facet_start[f]; j < m->mesh.facet_start[f + 1]; j++) weight[m->mesh.facet_vertex[j]] += width[i];
    }
    for (int32_t v = 0; v < nv; v++) flat.x += weight[v] * m->mesh.X[v].x / 3.7, flat.y += weight[v] * m->mesh.X[v].y / 3.7; /* the middle */
    for (int32_t v = 0; v < nv; v++) weight[v] /= 3.7 * 4;
    flat.x /= 4, flat.y /= 4;
    assert_int_equal(rg_stage_init(&m->mem, m, &picture, &stage), RG_OK);
    for (int32_t k = 0; k < 13; k++) {
        rg_vec3 moment = {0, 0, 0}, middle = {0, 0, 0};
        assert_int_equal(rg_motion_place(m, k, was), RG_OK);
        memcpy(x, was, (size_t)nv * sizeof *x);
        rg_stage_put(&stage, k, x, nv);
        for (int32_t v = 0; v < nv; v++) {
            middle = rg_vec3_axpy(weight[v], x[v], middle);
            const rg_vec3 lay = {m->mesh.X[v].x - flat.x, m->mesh.X[v].y - flat.y, 0};
            const rg_vec3 on = rg_vec3_axpy(6.0 / 13, lay, before[v]);
            if (k > 0) moment = rg_vec3_axpy(weight[v], rg_vec3_cross(on, x[v]), moment);
            for (int32_t u = 0; u < v; u++)
                near(rg_vec3_length(rg_vec3_sub(x[u], x[v])), rg_vec3_length(rg_vec3_sub(was[u], was[v])), 1e-12);
        }
        near(rg_vec3_length(middle), 0, 1e-12);
        near(rg_vec3_length(moment), 0, 1e-4); /* staying has a small say, see stage.c */
        memcpy(before, x, (size_t)nv * sizeof *x);
    }
    rg_stage_free(&stage);
    free(x), free(before), free(was), free(weight);
    rg_motion_destroy(m);
}

/* A mirror of the pattern is one of its pictures, from flat to folded. */
static void symmetry_is_seen(void **state)
{
    (void)state;
    rg_settings s = rg_settings_default();
    rg_diag why = {0, ""};
    rg_pattern *cp = NULL;
    rg_motion *m = NULL;
    s.frames = 9;
    if (rg_pattern_read("patterns/fish.opx", NULL, &cp, &why) != RG_OK) fail_msg("%s", why.text);
    if (rg_motion_create(cp, &s, NULL, NULL, &m, &why) != RG_OK) fail_msg("%s", why.text);
    for (int32_t k = 0; k < 9; k += 2) {
        rg_picture picture = plain(200, 150);
        picture.aimed = 0;
        photo p = take(m, k, picture, NULL);
        int paper = 0, differ = 0;
        for (int y = 0; y < 150; y++)
            for (int x = 0; x < 100; x++) {
                paper += !is_background(&p, x, y);
                differ += is_background(&p, x, y) != is_background(&p, 199 - x, y);
            }
        if (!(paper > 1000 && differ < 0.03 * paper)) fail_msg("frame %d: %d of %d", (int)k, differ, paper);
        free(p.rgb);
    }
    rg_motion_destroy(m);
    rg_pattern_destroy(cp);
}

static void count_inks(const photo *p, int *red, int *blue)
{
    *red = *blue = 0;
    for (int y = 0; y < p->picture.height; y++)
        for (int x = 0; x < p->picture.width; x++) {
            const unsigned char *c = pixel(p, x, y);
            *red += c[0] > 150 && c[0] > 2 * c[1] && c[0] > 2 * c[2];
            *blue += c[2] > 100 && c[2] > 2 * c[0];
        }
}

/* A mountain across a sheet is a red line, a valley a blue one, about as long as the projected crease; without creases
 * there is neither. A line that another layer covers does not shine through. */
static void creases_are_drawn_where_they_are_seen(void **state)
{
    (void)state;
    static const double width[] = {1, 1, 1};
    rg_lines l = strip(3, width, "MV", 2);
    rg_motion *m = motion_by(&l, 2, all_alike, NULL);
    rg_picture picture = rg_picture_default();
    picture.width = 1280;
    picture.height = 960;
    picture.shadow = 0;
    int red, blue;
    photo p = take(m, 0, picture, NULL);
    count_inks(&p, &red, &blue);
    const rg_vec2 a = seen(&p, (rg_vec3){1, 0, 0}), b = seen(&p, (rg_vec3){1, 2, 0});
    const double length = rg_vec2_length(rg_vec2_sub(a, b));
    assert_true(red > 0.5 * length && red < 3 * length);
    assert_true(blue > 0.5 * length && blue < 3 * length);
    free(p.rgb);
    picture.lines = RG_LINES_NONE;
    p = take(m, 0, picture, NULL);
    count_inks(&p, &red, &blue);
    assert_int_equal(red + blue, 0);
    free(p.rgb);
    rg_motion_destroy(m);

    /* The last two panels are folded back over the first one, which hides their mountain from below. */
    static const double hiding[] = {1.4, 0.7, 0.5};
    rg_lines h = strip(3, hiding, "VM", 2);
    m = motion_by(&h, 1, all_alike, NULL);
    for (int32_t i = 0; i < m->mesh.N; i++) m->rho[i] = mountain_or_valley(&m->mesh, i) > 0 ? 178 * RG_DEG : -1e-3;
    picture.lines = RG_LINES_CREASES;
    p = take(m, 0, picture, NULL);
    const rg_vec3 front = p.place.R.c[2]; /* of the first panel, which is the fixed one */
    free(p.rgb);
    picture.aimed = 1;
    picture.azimuth = atan2(front.y, front.x);
    picture.elevation = asin(front.z);
    p = take(m, 0, picture, NULL);
    count_inks(&p, &red, &blue);
    assert_true(red > 100);
    free(p.rgb);
    picture.azimuth += RG_PI;
    picture.elevation = -picture.elevation;
    p = take(m, 0, picture, NULL);
    count_inks(&p, &red, &blue);
    assert_int_equal(red, 0);
    assert_true(blue > 100);
    free(p.rgb);
    rg_motion_destroy(m);
}

static void pictures_repeat(void **state)
{
    (void)state;
    double alpha = 55 * RG_DEG;
    rg_lines l = miura(6, 5, 1, 1, alpha);
    rg_motion *m = motion_by(&l, 5, miura_folds, &alpha);
    rg_picture picture = plain(333, 222);
    picture.lines = RG_LINES_CREASES;
    photo a = take(m, 3, picture, NULL), b = take(m, 3, picture, NULL);
    assert_memory_equal(a.rgb, b.rgb, 3 * 333 * 222);
    free(a.rgb);
    free(b.rgb);
    rg_motion_destroy(m);
}

static void wrong_pictures_are_refused(void **state)
{
    (void)state;
    static const double width[] = {1, 1};
    rg_lines l = strip(2, width, "V", 1);
    rg_motion *m = motion_by(&l, 2, all_alike, NULL);
    for (int i = 0; i < 19; i++) {
        rg_picture p = rg_picture_default();
        switch (i) {
        case 0: p.width = 0; break;
        case 1: p.height = -5; break;
        case 2: p.width = RG_MAX_PICTURE + 1; break;
        case 3: p.height = INT32_MAX; break;
        case 4: p.azimuth = NAN; break;
        case 5: p.elevation = INFINITY; break;
        case 6: p.zoom = 0; break;
        case 7: p.zoom = NAN; break;
        case 8: p.zoom = 1e30; break;
        case 9: p.fps = 0; break;
        case 10: p.fps = NAN; break;
        case 11: p.fps = 1e6; break;
        case 12: p.line_width = 0; break;
        case 13: p.line_width = NAN; break;
        case 14: p.see_through = 1; break;
        case 15: p.see_through = NAN; break;
        case 16: p.hold = -1; break;
        case 17: p.targeted = 1, p.target[0] = NAN; break;
        case 18: p.targeted = 1, p.target[0] = 77; break; /* beside the sheet */
        }
        rg_camera c[2];
        rg_stage stage;
        rg_diag why = {0, ""};
        assert_int_equal(rg_stage_init(&m->mem, m, &p, &stage), RG_OK);
        assert_int_equal(rg_camera_follow(&stage, &p, c, &why), RG_EARG);
        assert_true(strlen(why.text) > 10);
        rg_stage_free(&stage);
    }
    rg_motion_destroy(m);
}

/* The k-th allocation fails: nothing leaks. Once made, a frame allocates nothing of ours. */
static void shortage_is_told(void **state)
{
    (void)state;
    double alpha = 55 * RG_DEG;
    rg_lines l = miura(3, 3, 1, 1, alpha);
    rg_motion *m = motion_by(&l, 3, miura_folds, &alpha);
    rg_picture picture = plain(40, 30);
    picture.shadow = 1;
    picture.aimed = 0;
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x), *lift = calloc((size_t)m->mesh.nf, sizeof *lift);
    unsigned char rgb[3 * 40 * 30];
    rg_status s = RG_ENOMEM;
    for (long k = 0; s != RG_OK; k++) {
        counted count = {k, 0, 0};
        const rg_memory mem = {counted_resize, &count};
        rg_triangles t = {.start = NULL};
        rg_lift *y = NULL;
        rg_render *r = NULL;
        rg_stage stage;
        rg_camera c[3];
        m->mesh.mem = mem;
        s = rg_stage_init(&mem, m, &picture, &stage);
        if (s == RG_OK) s = rg_camera_follow(&stage, &picture, c, NULL);
        if (s == RG_OK) s = rg_triangles_init(&mem, &m->mesh, &t);
        if (s == RG_OK) s = rg_lift_create(&mem, m, &t, &y);
        for (int i = 0; s == RG_OK && i < 3; i++) s = rg_lift_next(y, x, lift);
        if (s == RG_OK) s = rg_render_create(&mem, &m->mesh, &t, &picture, NULL, &r, NULL);
        if (s == RG_OK) {
            const long asked = count.asked;
            const rg_shot shot = {x, lift, &c[2], NULL, NULL};
            rg_render_frame(r, &shot, rgb);
            assert_int_equal(count.asked, asked);
        } else {
            assert_int_equal(s, RG_ENOMEM);
        }
        rg_render_destroy(r);
        rg_lift_destroy(y);
        if (t.start) rg_triangles_free(&t);
        rg_stage_free(&stage);
        assert_int_equal(count.out, 0);
        assert_true(k < 1000);
    }
    m->mesh.mem = m->mem;
    free(x);
    free(lift);
    rg_motion_destroy(m);
}

/* A facet's corners in the picture, pixels. */
static int32_t outline_of(const photo *p, const rg_motion *m, const rg_vec3 *x, int32_t f, rg_vec2 *corner)
{
    const int32_t first = m->mesh.facet_start[f], n = m->mesh.facet_start[f + 1] - first;
    for (int32_t j = 0; j < n; j++) {
        const rg_vec2 s = seen(p, x[m->mesh.facet_vertex[first + j]]);
        corner[j] = (rg_vec2){p->camera.half_width + s.x, p->camera.half_height - s.y};
    }
    return n;
}

/* +1: the point is inside, -1: outside, 0: nearer to an edge than two pixels. */
static int inside(const rg_vec2 *corner, int32_t n, rg_vec2 at)
{
    int in = -1;
    for (int32_t i = n - 1, j = 0; j < n; i = j++) {
        const rg_vec2 a = corner[i], d = rg_vec2_sub(corner[j], a), r = rg_vec2_sub(at, a);
        const double t = fmin(1, fmax(0, rg_vec2_dot(r, d) / rg_vec2_dot(d, d)));
        if (rg_vec2_length((rg_vec2){r.x - t * d.x, r.y - t * d.y}) < 2) return 0;
        if ((a.y > at.y) != (corner[j].y > at.y) && at.x < a.x + d.x * (at.y - a.y) / d.y) in = -in;
    }
    return in;
}

/* Each facet has a colour of its own. At points of the picture that are well inside, the one that is seen is the one above all others that
 * cover the point, by the order of layers. side: +1 towards the front of the facet that the order is told from, -1 towards its back.
 * Returns at how many points more than one covers. */
static int32_t check_layers_seen(const rg_motion *m, const rg_layers *l, const unsigned char (*tint)[3], int side)
{
    enum { MOST = 64 };
    rg_picture p = plain(300, 240);
    const int32_t last = m->report.frame_count - 1, nf = m->mesh.nf, root = l->flat.part[l->flat.part_start[l->flat.root]];
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x);
    rg_vec2 corner[MOST];
    int32_t piles = 0;
    assert_non_null(x);
    assert_int_equal(rg_motion_place(m, last, x), RG_OK);
    const rg_vec3 up = rg_pose_area(&m->mesh, root, x);
    photo first = take(m, last, p, NULL);
    const rg_vec3 d = rg_mat3_mul_vec(first.place.R, rg_vec3_scale(side / rg_vec3_length(up), up));
    p.azimuth = atan2(d.y, d.x) + 0.1, p.elevation = asin(0.95 * d.z); /* a little from aside */
    photo a = take_as(m, last, p, NULL, tint, l);
    free(first.rgb);
    for (int py = 0; py < p.height; py += 3)
        for (int px = 0; px < p.width; px += 3) {
            int32_t cover[256], n = 0, top = -1, clear = 1;
            for (int32_t f = 0; f < nf && clear; f++) {
                const int in = inside(corner, outline_of(&a, m, x, f, corner), (rg_vec2){px + 0.5, py + 0.5});
                if (in > 0) cover[n++] = f;
                clear = in != 0;
            }
            if (!clear || n == 0) continue;
            for (int32_t i = 0; i < n; i++) {
                int over_all = 1;
                for (int32_t j = 0; j < n; j++) over_all &= i == j || rg_layers_above_of_mesh(l, cover[j], cover[i]) == side;
                if (over_all) top = cover[i];
            }
            assert_true(top >= 0);
            const unsigned char *c = pixel(&a, px, py);
            int32_t best = -1, least = INT32_MAX;
            for (int32_t f = 0; f < nf; f++) { /* light takes as much of each of the three, nearly */
                int32_t off = 0;
                for (int k = 0; k < 2; k++) off += abs(c[k] * 200 - tint[f][k] * c[2]);
                if (off < least) least = off, best = f;
            }
            if (best != top) fail_msg("at %d, %d facet %d is seen, not %d, of %d", px, py, (int)best, (int)top, (int)n);
            piles += n > 1;
        }
    free(a.rgb);
    free(x);
    return piles;
}

/* A tatou ends with four flaps that lie on each other in a circle: no height for each of them shows that. It was drawn with one flap on top,
 * and from below with the wrong side of the paper. */
static void a_flat_end_is_seen_by_its_layers(void **state)
{
    (void)state;
    static const char *const names[] = {"patterns/tatou.opx", "patterns/bird.opx", "patterns/fish.opx"};
    for (int i = 0; i < 3; i++) {
        rg_settings s = rg_settings_default();
        rg_diag why = {0, ""};
        rg_pattern *cp = NULL;
        rg_motion *m = NULL;
        s.frames = 8;
        assert_int_equal(rg_pattern_read(names[i], NULL, &cp, &why), RG_OK);
        assert_int_equal(rg_motion_create(cp, &s, NULL, NULL, &m, &why), RG_OK);
        const rg_layers *l = rg_ending_layers(m, m->report.frame_count - 1);
        assert_non_null(l);
        assert_null(rg_ending_layers(m, 0));
        int32_t cuts = 0, *level = calloc((size_t)l->flat.nf, sizeof *level);
        unsigned char (*tint)[3] = calloc((size_t)m->mesh.nf, sizeof *tint);
        assert_true(level && tint && m->mesh.nf < 36);
        for (int32_t f = 0; f < m->mesh.nf; f++) tint[f][0] = (unsigned char)(40 + f % 6 * 40), tint[f][1] = (unsigned char)(40 + f / 6 * 40), tint[f][2] = 200;
        assert_true(rg_layers_levels(l, level, &cuts) > 1);
        if (i == 0) assert_true(cuts > 0);
        for (int side = -1; side <= 1; side += 2) assert_true(check_layers_seen(m, l, (const unsigned char(*)[3])tint, side) > 300);
        free(level);
        free(tint);
        rg_motion_destroy(m);
        rg_pattern_destroy(cp);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strips_are_piled_as_paper_is),
        cmocka_unit_test(layers_stay_in_order),
        cmocka_unit_test(flat_miura_has_no_two_facets_in_one_place),
        cmocka_unit_test(facets_that_run_in_circles_are_apart_too),
        cmocka_unit_test(a_circle_of_flaps_is_cut),
        cmocka_unit_test(a_flat_end_is_seen_by_its_layers),
        cmocka_unit_test(covered_area_is_the_projected_one),
        cmocka_unit_test(each_side_has_its_colour),
        cmocka_unit_test(the_sheet_is_in_the_middle_and_fills_the_picture),
        cmocka_unit_test(the_same_of_real_patterns),
        cmocka_unit_test(the_stage_turns_as_little_as_it_can),
        cmocka_unit_test(symmetry_is_seen),
        cmocka_unit_test(creases_are_drawn_where_they_are_seen),
        cmocka_unit_test(pictures_repeat),
        cmocka_unit_test(wrong_pictures_are_refused),
        cmocka_unit_test(shortage_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
