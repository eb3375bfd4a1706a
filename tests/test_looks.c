/* What pictures can show beside the paper: outlines, shadow, a printed image, light through facets, captions, colours that tell. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "motions.h"
#include "photo.h"
#include "render/caption.h"
#include "render/tint.h"

static double darkness(const photo *p, int x, int y) { return (double)(255 * 3 - pixel(p, x, y)[0] - pixel(p, x, y)[1] - pixel(p, x, y)[2]); }

/* Two panels at a crease of that kind, folded by rho. One that is drawn flat is none, so it is made what an added one is. */
static rg_motion *hinge(char kind, double rho)
{
    static const double width[] = {1, 1.2};
    rg_lines l = strip(2, width, "V", 1.5);
    rg_motion *m = motion_by(&l, 1, all_alike, NULL);
    assert_int_equal(m->mesh.N, 1);
    m->mesh.assignment[m->mesh.crease_edge[0]] = kind;
    m->rho[0] = rho;
    return m;
}

/* Aims the camera so that it looks from that direction, given as the motion has it. */
static void aim_at(rg_picture *p, const rg_motion *m, rg_vec3 from)
{
    photo first = take(m, 0, *p, NULL);
    const rg_vec3 d = rg_mat3_mul_vec(first.place.R, from);
    free(first.rgb);
    p->aimed = 1;
    p->azimuth = atan2(d.y, d.x);
    p->elevation = asin(d.z / rg_vec3_length(d));
}

/* Pixels that are much darker than any paper. */
static int dark_pixels(const photo *p)
{
    int n = 0;
    for (int y = 0; y < p->picture.height; y++)
        for (int x = 0; x < p->picture.width; x++) n += darkness(p, x, y) > 500;
    return n;
}

/* An added crease is a line where the sheet turns away there, and only there. The background is white, all else that is dark is rim. */
static void an_added_crease_is_a_line_where_it_is_the_outline(void **state)
{
    (void)state;
    int dark[2];
    for (int outline = 0; outline < 2; outline++) {
        rg_motion *m = hinge('F', 60 * RG_DEG);
        rg_picture p = plain(1200, 960);
        memset(p.background, 255, 3);
        p.lines = RG_LINES_CREASES;
        rg_place place[2];
        rg_pose_facets(&m->mesh, m->mesh.X, &m->tree, m->rho, place);
        /* Between both fronts, or before one and behind the other. */
        aim_at(&p, m, rg_vec3_axpy(outline ? -1 : 1, place[1].R.c[2], place[0].R.c[2]));
        photo a = take(m, 0, p, NULL);
        p.lines = RG_LINES_NONE;
        photo b = take(m, 0, p, NULL);
        /* The line itself: on the crease's middle, darker than without lines. */
        const rg_vec2 at = seen(&a, (rg_vec3){1, 0.75, 0});
        double most = 0;
        for (int i = -2; i <= 2; i++)
            for (int j = -2; j <= 2; j++) {
                const int x = (int)(a.camera.half_width + at.x) + i, y = (int)(a.camera.half_height - at.y) + j;
                most = fmax(most, darkness(&a, x, y) - darkness(&b, x, y));
            }
        dark[outline] = most > 100;
        assert_true(dark_pixels(&a) > 50 && dark_pixels(&b) == 0); /* the rim, always */
        free(a.rgb);
        free(b.rgb);
        rg_motion_destroy(m);
    }
    assert_false(dark[0]);
    assert_true(dark[1]);
}

/* The shadow makes the background darker, more near the sheet than at the picture's corners, and nothing else. */
static void the_shadow_is_on_the_floor(void **state)
{
    (void)state;
    rg_motion *m = hinge('V', 70 * RG_DEG);
    rg_picture p = plain(320, 240);
    p.elevation = 40 * RG_DEG;
    photo without = take(m, 0, p, NULL);
    p.shadow = 1;
    photo with = take(m, 0, p, NULL);
    int darker = 0;
    for (int y = 0; y < p.height; y++)
        for (int x = 0; x < p.width; x++) {
            const unsigned char *a = pixel(&without, x, y), *b = pixel(&with, x, y);
            for (int k = 0; k < 3; k++) assert_true(b[k] <= a[k]);
            darker += b[2] + 8 < a[2];
        }
    assert_true(darker > 500);
    /* Soft: a step from pixel to pixel of the floor is small. */
    for (int y = 0; y < p.height; y++)
        for (int x = 0; x + 1 < p.width; x++)
            if (is_background(&without, x, y) && is_background(&without, x + 1, y))
                assert_true(abs(pixel(&with, x, y)[2] - pixel(&with, x + 1, y)[2]) <= 8);
    p.elevation = -40 * RG_DEG; /* from below there is no floor */
    photo below_it = take(m, 0, p, NULL);
    p.shadow = 0;
    photo plain_below = take(m, 0, p, NULL);
    assert_memory_equal(below_it.rgb, plain_below.rgb, 3 * (size_t)p.width * (size_t)p.height);
    free(without.rgb), free(with.rgb), free(below_it.rgb), free(plain_below.rgb);
    rg_motion_destroy(m);
}

/* A picture of four colours on the front: each quarter of the pattern shows its own, wherever it has been folded to; the back is paper. */
static void an_image_is_printed_on_the_front(void **state)
{
    (void)state;
    static const unsigned char quarters[16] = {250, 0, 0, 255, 0, 250, 0, 255, 0, 0, 250, 255, 0, 0, 0, 0}; /* the last one is clear */
    static const int expected[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}};
    const rg_print print = {quarters, 2, 2};
    rg_motion *m = hinge('V', 50 * RG_DEG);
    rg_picture p = plain(400, 300);
    aim_at(&p, m, (rg_vec3){-0.2, -0.1, 1});
    photo a = take(m, 0, p, &print), paper = take(m, 0, p, NULL);
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x);
    rg_place place[2];
    assert_non_null(x);
    rg_pose_facets(&m->mesh, m->mesh.X, &m->tree, m->rho, place);
    for (int i = 0; i < 4; i++) { /* upper left, upper right, lower left, lower right of 2.2 x 1.5, the crease at 1 */
        const rg_vec2 at = {i % 2 ? 1.7 : 0.5, i / 2 ? 0.3 : 1.2};
        const rg_place *f = &place[facet_at(&m->mesh, at.x, at.y)];
        const rg_vec2 s = seen(&a, rg_vec3_add(rg_mat3_mul_vec(f->R, (rg_vec3){at.x, at.y, 0}), f->t));
        const int px = (int)(a.camera.half_width + s.x), py = (int)(a.camera.half_height - s.y);
        const unsigned char *c = pixel(&a, px, py);
        if (expected[i][0] < 0) assert_memory_equal(c, pixel(&paper, px, py), 3);
        for (int k = 0; k < 3 && expected[i][0] >= 0; k++) assert_true(expected[i][k] ? c[k] > 150 : c[k] == 0);
    }
    p.azimuth += RG_PI;
    p.elevation = -p.elevation;
    photo back = take(m, 0, p, &print), back_paper = take(m, 0, p, NULL);
    assert_memory_equal(back.rgb, back_paper.rgb, 3 * (size_t)p.width * (size_t)p.height);
    free(a.rgb), free(paper.rgb), free(back.rgb), free(back_paper.rgb), free(x);
    rg_motion_destroy(m);
}

/* Where light goes through, one facet lets so much of the background pass, two let pass less, whichever is in front. */
static void light_goes_through_facets(void **state)
{
    (void)state;
    static const double width[] = {1.4, 0.7};
    rg_lines l = strip(2, width, "V", 1);
    rg_motion *m = motion_by(&l, 1, all_alike, NULL);
    m->rho[0] = 179.9 * RG_DEG; /* the second panel covers half of the first */
    rg_picture p = plain(300, 240);
    memset(p.background, 0, 3);
    memset(p.front, 200, 3), memset(p.back, 200, 3);
    p.see_through = 0.5;
    double level[2][2];
    for (int side = 0; side < 2; side++) {
        aim_at(&p, m, (rg_vec3){0, 0, side ? -1 : 1});
        photo a = take(m, 0, p, NULL);
        for (int both = 0; both < 2; both++) {
            const rg_vec2 s = seen(&a, (rg_vec3){both ? 1.05 : 0.3, 0.5, 0});
            level[side][both] = pixel(&a, (int)(a.camera.half_width + s.x), (int)(a.camera.half_height - s.y))[1];
        }
        free(a.rgb);
    }
    for (int side = 0; side < 2; side++) {
        assert_true(level[side][0] > 60 && level[side][0] < 110); /* half of 200, with its light */
        assert_true(level[side][1] > 1.15 * level[side][0]);      /* three quarters, dimmed */
    }
    near(level[0][1], level[1][1], 8);
    rg_motion_destroy(m);
}

static void the_camera_looks_at_its_target(void **state)
{
    (void)state;
    double alpha = 65 * RG_DEG;
    rg_lines l = miura(5, 4, 1, 1.25, alpha);
    rg_motion *m = motion_by(&l, 1, miura_folds, &alpha);
    rg_picture p = plain(300, 200);
    const int32_t f = 7, first = m->mesh.facet_start[f];
    rg_vec2 at = {0, 0};
    for (int j = 0; j < 4; j++) { /* a place in a parallelogram: 0.4, 0.3, 0.2, 0.1 of its corners */
        const rg_vec2 X = m->mesh.X[m->mesh.facet_vertex[first + j]];
        at.x += (0.4 - 0.1 * j) * X.x, at.y += (0.4 - 0.1 * j) * X.y;
    }
    p.targeted = 1, p.target[0] = at.x, p.target[1] = at.y;
    p.zoom = 5;
    photo a = take(m, 0, p, NULL);
    rg_place *place = calloc((size_t)m->mesh.nf, sizeof *place);
    assert_non_null(place);
    rg_pose_facets(&m->mesh, m->mesh.X, &m->tree, m->rho, place);
    const rg_vec2 s = seen(&a, rg_vec3_add(rg_mat3_mul_vec(place[f].R, (rg_vec3){at.x, at.y, 0}), place[f].t));
    near(s.x, 0, 1e-6);
    near(s.y, 0, 1e-6);
    free(a.rgb);
    free(place);
    rg_motion_destroy(m);
}

/* Read back by its dots: one line at the bottom, at the left and at the right; nothing else of the picture changes. */
static void captions_are_written_below(void **state)
{
    (void)state;
    enum { W = 90, H = 40 };
    unsigned char rgb[3 * W * H], ink[3], dark[3] = {0, 0, 0};
    memset(rgb, 7, sizeof rgb);
    rg_caption_ink((const unsigned char[]){10, 20, 30}, ink);
    assert_true(ink[0] > 200);
    rg_caption_draw("I\xc3\xa9L", "1", ink, W, H, rgb);
    const int top = H - 10;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const int on = rgb[3 * (y * W + x)] != 7, in = y >= top && y < top + 7 && ((x >= 3 && x < 3 + 17) || (x >= W - 3 - 5 && x < W - 3));
            assert_true(in || !on);
        }
    for (int y = 0; y < 7; y++) { /* the stem of the I, the stem of the L, the stem of the 1 */
        assert_int_equal(rgb[3 * ((top + y) * W + 3 + 2)], ink[0]);
        assert_int_equal(rgb[3 * ((top + y) * W + 3 + 12)], ink[0]);
        assert_int_equal(rgb[3 * ((top + y) * W + W - 3 - 5 + 2)], ink[0]);
    }
    /* No room: the right one stays, nothing is written beyond the picture. */
    memset(rgb, 7, sizeof rgb);
    rg_caption_draw("a very long title that does not fit in here", "100 %", ink, W, H, rgb);
    rg_caption_draw("x", "y", dark, 3, 3, rgb);
    assert_true(rg_caption_height(W, H) > 7 && rg_caption_height(3000, 3000) > rg_caption_height(300, 300));
}

/* Speed: of a strip whose creases turn one after the other the facets at the one that turns are bright, all others dark. */
static void colours_tell_what_moves(void **state)
{
    (void)state;
    static const double width[] = {1, 1, 1, 1};
    rg_lines l = strip(4, width, "VMV", 1.7);
    rg_motion *m = motion_by(&l, 31, one_by_one, NULL);
    const rg_tint_scale t = rg_tint_of(m, RG_COLOUR_SPEED);
    unsigned char rgb[4][3], least[3];
    rg_vec3 lift[4] = {{0, 0, 0}};
    near(t.most, 3 * RG_PI / 30, 1e-9);
    rg_tint_facets(&t, m, 0, lift, rgb); /* nothing has moved yet */
    memcpy(least, rgb[0], 3);
    for (int32_t k = 5; k <= 25; k += 10) {
        const int moving = k / 10; /* crease 0, 1, 2: between panels `moving` and the next */
        rg_tint_facets(&t, m, k, lift, rgb);
        for (int i = 0; i < 4; i++) {
            const int32_t f = facet_at(&m->mesh, i + 0.5, 1);
            assert_int_equal(memcmp(rgb[f], least, 3) != 0, i == moving || i == moving + 1);
        }
    }
    const rg_tint_scale strain = rg_tint_of(m, RG_COLOUR_STRAIN); /* rigid: none, and rounding is not blown up */
    rg_tint_facets(&strain, m, 20, lift, rgb);
    for (int i = 0; i < 4; i++) assert_memory_equal(rgb[i], least, 3);
    const rg_tint_scale layer = rg_tint_of(m, RG_COLOUR_LAYER);
    for (int i = 0; i < 4; i++) lift[i].z = (i - 1.5) * 1e-4;
    rg_tint_facets(&layer, m, 20, lift, rgb);
    for (int i = 0; i < 3; i++) assert_true(rgb[i][0] + rgb[i][1] < rgb[i + 1][0] + rgb[i + 1][1]);
    rg_motion_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_added_crease_is_a_line_where_it_is_the_outline),
        cmocka_unit_test(the_shadow_is_on_the_floor),
        cmocka_unit_test(an_image_is_printed_on_the_front),
        cmocka_unit_test(light_goes_through_facets),
        cmocka_unit_test(the_camera_looks_at_its_target),
        cmocka_unit_test(captions_are_written_below),
        cmocka_unit_test(colours_tell_what_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
