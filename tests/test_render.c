/* render/: layers of facets that lie on each other; pictures read back against what geometry says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "motions.h"
#include "render/camera.h"
#include "render/gl.h"
#include "render/lift.h"
#include "render/render.h"

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

/* Crease after crease, so that what lies flat stays so for many frames: creases[i] moves in part i of the time. */
static void one_by_one(const rg_mesh *m, double t, double *rho, void *ctx)
{
    (void)ctx;
    for (int32_t i = 0; i < m->N; i++) {
        const double x = m->X[m->edge[m->crease_edge[i]][0]].x; /* creases at 1, 2, 3 */
        rho[i] = RG_PI * mountain_or_valley(m, i) * fmin(1, fmax(0, 3 * t - (x - 1)));
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
    if (rg_pattern_read("patterns/four-crane.opx", &s, &cp, &why) != RG_OK) fail_msg("%s", why.text);
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

static void skip_without_gl(void)
{
    rg_diag why = {0, ""};
    if (rg_gl_check(&why) == RG_OK) return;
    printf("SKIPPED: %s\n", why.text);
    skip();
}

typedef struct photo {
    rg_picture picture;
    rg_camera camera;
    unsigned char *rgb;
} photo;

static photo take(const rg_motion *m, int32_t frame, rg_picture picture)
{
    photo p = {.picture = picture};
    rg_triangles t;
    rg_render *r = NULL;
    rg_diag why = {0, ""};
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x);
    p.rgb = calloc((size_t)picture.width * (size_t)picture.height, 3);
    assert_true(x && p.rgb);
    assert_int_equal(rg_triangles_init(NULL, &m->mesh, &t), RG_OK);
    if (rg_camera_fit(m, &picture, &p.camera, &why) != RG_OK) fail_msg("%s", why.text);
    if (rg_render_create(NULL, &m->mesh, &t, &picture, &r, &why) != RG_OK) fail_msg("%s", why.text);
    assert_int_equal(rg_motion_place(m, frame, x), RG_OK);
    if (rg_render_frame(r, x, NULL, &p.camera, p.rgb, &why) != RG_OK) fail_msg("%s", why.text);
    rg_render_destroy(r);
    rg_triangles_free(&t);
    free(x);
    return p;
}

static const unsigned char *pixel(const photo *p, int x, int y) { return p->rgb + 3 * ((size_t)y * (size_t)p->picture.width + (size_t)x); }

static int is_background(const photo *p, int x, int y) { return memcmp(pixel(p, x, y), p->picture.background, 3) == 0; }

static rg_picture plain(int32_t width, int32_t height)
{
    rg_picture p = rg_picture_default();
    p.width = width;
    p.height = height;
    p.creases = 0;
    return p;
}

/* A pinhole camera, written down anew: along the axis, the picture's plane is where a unit is c->scale pixels. */
static rg_vec2 seen(const rg_camera *c, rg_vec3 x)
{
    const double d[3] = {x.x - c->eye.x, x.y - c->eye.y, x.z - c->eye.z};
    const double away = -(d[0] * c->back.x + d[1] * c->back.y + d[2] * c->back.z);
    return (rg_vec2){c->scale * (d[0] * c->right.x + d[1] * c->right.y + d[2] * c->right.z) / away,
                     c->scale * (d[0] * c->up.x + d[1] * c->up.y + d[2] * c->up.z) / away};
}

/* A flat sheet covers as many pixels as its corners span, partly covered ones by their part; also over several tiles. */
static void covered_area_is_the_projected_one(void **state)
{
    (void)state;
    skip_without_gl();
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
        photo p = take(m, 0, picture);
        const rg_vec2 at[] = {seen(&p.camera, (rg_vec3){0, 0, 0}), seen(&p.camera, (rg_vec3){2.05, 0, 0}),
                              seen(&p.camera, (rg_vec3){2.05, 1.37, 0}), seen(&p.camera, (rg_vec3){0, 1.37, 0})};
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
    skip_without_gl();
    static const double width[] = {1, 0.9};
    rg_lines l = strip(2, width, "V", 1);
    rg_motion *m = motion_by(&l, 1, all_alike, NULL);
    for (int32_t c = 0; c < m->mesh.N; c++) m->rho[c] = 0;
    for (int way = -1; way <= 1; way += 2) {
        rg_picture picture = plain(160, 120);
        picture.elevation = way * 70 * RG_DEG;
        photo p = take(m, 0, picture);
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
    picture.azimuth = 0;
    picture.elevation = 60 * RG_DEG;
    for (int turn = 0; turn < 2; turn++) {
        picture.azimuth = turn * RG_PI;
        photo p = take(m, 0, picture);
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

/* Over all frames nothing touches the rim, and the motion fills the picture in one direction but for the margin. */
static void the_whole_motion_is_in_the_picture(void **state)
{
    (void)state;
    skip_without_gl();
    static const int32_t size[][2] = {{240, 180}, {120, 260}};
    double alpha = 70 * RG_DEG;
    for (int i = 0; i < 2; i++) {
        rg_lines l = miura(5, 4, 1, 1.25, alpha);
        rg_motion *m = motion_by(&l, 12, miura_folds, &alpha);
        rg_picture picture = plain(size[i][0], size[i][1]);
        picture.creases = 1;
        int left = picture.width, right = 0, top = picture.height, bottom = 0;
        for (int32_t k = 0; k < 12; k++) {
            photo p = take(m, k, picture);
            for (int y = 0; y < picture.height; y++)
                for (int x = 0; x < picture.width; x++) {
                    if (is_background(&p, x, y)) continue;
                    left = x < left ? x : left, right = x > right ? x : right;
                    top = y < top ? y : top, bottom = y > bottom ? y : bottom;
                }
            free(p.rgb);
        }
        const double w = picture.width, h = picture.height;
        assert_true(left > 0.03 * w && right < 0.97 * w && top > 0.03 * h && bottom < 0.97 * h);
        assert_true(right - left > 0.87 * w || bottom - top > 0.87 * h);
        near(0.5 * (left + right) / w, 0.5, 0.02); /* in the middle */
        near(0.5 * (top + bottom) / h, 0.5, 0.02);
        rg_motion_destroy(m);
    }
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
    skip_without_gl();
    static const double width[] = {1, 1, 1};
    rg_lines l = strip(3, width, "MV", 2);
    rg_motion *m = motion_by(&l, 2, all_alike, NULL);
    rg_picture picture = rg_picture_default();
    picture.width = 640;
    picture.height = 480;
    int red, blue;
    photo p = take(m, 0, picture);
    count_inks(&p, &red, &blue);
    const rg_vec2 a = seen(&p.camera, (rg_vec3){1, 0, 0}), b = seen(&p.camera, (rg_vec3){1, 2, 0});
    const double length = rg_vec2_length(rg_vec2_sub(a, b));
    assert_true(red > 0.5 * length && red < 3 * length);
    assert_true(blue > 0.5 * length && blue < 3 * length);
    free(p.rgb);
    picture.creases = 0;
    p = take(m, 0, picture);
    count_inks(&p, &red, &blue);
    assert_int_equal(red + blue, 0);
    free(p.rgb);
    rg_motion_destroy(m);

    /* The last two panels are folded back over the first one, which hides their mountain from below. */
    static const double hiding[] = {1.4, 0.7, 0.5};
    rg_lines h = strip(3, hiding, "VM", 2);
    m = motion_by(&h, 1, all_alike, NULL);
    for (int32_t i = 0; i < m->mesh.N; i++) m->rho[i] = mountain_or_valley(&m->mesh, i) > 0 ? 178 * RG_DEG : -1e-3;
    picture.creases = 1;
    picture.elevation = 89 * RG_DEG;
    p = take(m, 0, picture);
    count_inks(&p, &red, &blue);
    assert_true(red > 100);
    free(p.rgb);
    picture.elevation = -89 * RG_DEG;
    p = take(m, 0, picture);
    count_inks(&p, &red, &blue);
    assert_int_equal(red, 0);
    assert_true(blue > 100);
    free(p.rgb);
    rg_motion_destroy(m);
}

static void pictures_repeat(void **state)
{
    (void)state;
    skip_without_gl();
    double alpha = 55 * RG_DEG;
    rg_lines l = miura(6, 5, 1, 1, alpha);
    rg_motion *m = motion_by(&l, 5, miura_folds, &alpha);
    rg_picture picture = plain(333, 222);
    picture.creases = 1;
    photo a = take(m, 3, picture), b = take(m, 3, picture);
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
    for (int i = 0; i < 12; i++) {
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
        }
        rg_camera c;
        rg_diag why = {0, ""};
        assert_int_equal(rg_camera_fit(m, &p, &c, &why), RG_EARG);
        assert_true(strlen(why.text) > 10);
    }
    rg_motion_destroy(m);
}

/* The k-th allocation fails: nothing leaks. Once made, a frame allocates nothing of ours. */
static void shortage_is_told(void **state)
{
    (void)state;
    skip_without_gl();
    double alpha = 55 * RG_DEG;
    rg_lines l = miura(3, 3, 1, 1, alpha);
    rg_motion *m = motion_by(&l, 3, miura_folds, &alpha);
    rg_picture picture = plain(40, 30);
    rg_camera c;
    assert_int_equal(rg_camera_fit(m, &picture, &c, NULL), RG_OK);
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x), *lift = calloc((size_t)m->mesh.nf, sizeof *lift);
    unsigned char rgb[3 * 40 * 30];
    rg_status s = RG_ENOMEM;
    for (long k = 0; s != RG_OK; k++) {
        counted count = {k, 0, 0};
        const rg_memory mem = {counted_resize, &count};
        rg_triangles t;
        rg_lift *y = NULL;
        rg_render *r = NULL;
        m->mesh.mem = mem;
        s = rg_triangles_init(&mem, &m->mesh, &t);
        if (s == RG_OK) s = rg_lift_create(&mem, m, &t, &y);
        for (int i = 0; s == RG_OK && i < 3; i++) s = rg_lift_next(y, x, lift);
        if (s == RG_OK) s = rg_render_create(&mem, &m->mesh, &t, &picture, &r, NULL);
        if (s == RG_OK) {
            const long asked = count.asked;
            s = rg_render_frame(r, x, lift, &c, rgb, NULL);
            assert_int_equal(count.asked, asked);
        } else {
            assert_int_equal(s, RG_ENOMEM);
        }
        rg_render_destroy(r);
        rg_lift_destroy(y);
        rg_triangles_free(&t);
        assert_int_equal(count.out, 0);
        assert_true(k < 1000);
    }
    m->mesh.mem = m->mem;
    free(x);
    free(lift);
    rg_motion_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strips_are_piled_as_paper_is),
        cmocka_unit_test(layers_stay_in_order),
        cmocka_unit_test(flat_miura_has_no_two_facets_in_one_place),
        cmocka_unit_test(facets_that_run_in_circles_are_apart_too),
        cmocka_unit_test(a_circle_of_flaps_is_cut),
        cmocka_unit_test(covered_area_is_the_projected_one),
        cmocka_unit_test(each_side_has_its_colour),
        cmocka_unit_test(the_whole_motion_is_in_the_picture),
        cmocka_unit_test(creases_are_drawn_where_they_are_seen),
        cmocka_unit_test(pictures_repeat),
        cmocka_unit_test(wrong_pictures_are_refused),
        cmocka_unit_test(shortage_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
