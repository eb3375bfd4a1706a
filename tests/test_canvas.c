/* render/canvas.c, render/raster.c: the nearest triangle at each sample, by OpenGL in a child, by us, and against plain geometry. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "render/canvas.h"
#include "render/raster.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { WIDTH = 150, HEIGHT = 110, TRIANGLES = 60 };

static double chance(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

/* Triangles of all sizes and slopes, some beyond the canvas. */
static void fill(rg_canvas *c, uint32_t seed)
{
    for (int t = 0; t < TRIANGLES; t++) {
        const double x = 1.2 * WIDTH * chance(&seed) - 0.1 * WIDTH, y = 1.2 * HEIGHT * chance(&seed) - 0.1 * HEIGHT, size = 4 + 60 * chance(&seed);
        for (int k = 0; k < 3; k++) {
            c->vertex[3 * t + k] = (rg_gl_vertex){(float)(x + size * (chance(&seed) - 0.5)), (float)(y + size * (chance(&seed) - 0.5)),
                                                  (float)(0.05 + 0.9 * chance(&seed)), 1 + (uint32_t)t};
            c->corner[3 * t + k] = (uint32_t)(3 * t + k);
        }
    }
}

static rg_canvas make(int by_gl)
{
    rg_canvas c;
    const rg_memory mem = rg_mem_default(NULL);
    assert_int_equal(rg_canvas_init(&mem, WIDTH, HEIGHT, 3 * TRIANGLES, 3 * TRIANGLES, by_gl, &c), RG_OK);
    fill(&c, 7);
    return c;
}

/* Which triangle is nearest at the middle of a sample, by barycentric coordinates. *close: an edge or another triangle is so near that
 * rounding decides. */
static uint32_t nearest_at(const rg_canvas *c, double x, double y, int *close)
{
    double best = 1;
    uint32_t mark = 0;
    *close = 0;
    for (int t = 0; t < TRIANGLES; t++) {
        const rg_gl_vertex *v = &c->vertex[3 * t];
        const double ux = (double)v[1].x - v[0].x, uy = (double)v[1].y - v[0].y, wx = (double)v[2].x - v[0].x, wy = (double)v[2].y - v[0].y;
        const double px = x - v[0].x, py = y - v[0].y, whole = ux * wy - uy * wx;
        const double b = (px * wy - py * wx) / whole, d = (ux * py - uy * px) / whole, least = fmin(fmin(b, d), 1 - b - d);
        const double longest = fmax(hypot(ux, uy), fmax(hypot(wx, wy), hypot(ux - wx, uy - wy)));
        if (fabs(least) * fabs(whole) / longest < 0.02) *close = 1; /* of a sample */
        if (!(least > 0)) continue;
        const double z = v[0].z + b * ((double)v[1].z - v[0].z) + d * ((double)v[2].z - v[0].z);
        if (fabs(z - best) < 1e-5) *close = 1;
        if (z < best) best = z, mark = v[0].mark;
    }
    return mark;
}

static int wrong(const rg_canvas *c, int *close)
{
    int n = 0;
    *close = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            int near_by;
            const uint32_t mark = nearest_at(c, x + 0.5, y + 0.5, &near_by);
            *close += near_by;
            n += !near_by && c->mark[y * WIDTH + x] != mark;
        }
    return n;
}

static void ours_sees_what_is_nearest(void **state)
{
    (void)state;
    rg_canvas c = make(0);
    int close;
    assert_int_equal(c.child, 0);
    rg_canvas_draw(&c, 3 * TRIANGLES, 0, 0, WIDTH, HEIGHT);
    assert_int_equal(wrong(&c, &close), 0);
    assert_true(close < 0.1 * WIDTH * HEIGHT);
    rg_canvas_free(&c);
}

/* In parts: each shows what the whole shows there. */
static void parts_are_parts_of_the_whole(void **state)
{
    (void)state;
    for (int by_gl = 0; by_gl < 2; by_gl++) {
        rg_canvas c = make(by_gl), part = make(by_gl);
        rg_canvas_draw(&c, 3 * TRIANGLES, 0, 0, WIDTH, HEIGHT);
        for (int y = 0; y < HEIGHT; y += 40)
            for (int x = 0; x < WIDTH; x += 64) {
                const int w = WIDTH - x < 64 ? WIDTH - x : 64, h = HEIGHT - y < 40 ? HEIGHT - y : 40;
                rg_canvas_draw(&part, 3 * TRIANGLES, x, y, w, h);
                for (int i = 0; i < h; i++)
                    assert_memory_equal(part.mark + i * WIDTH, c.mark + (y + i) * WIDTH + x, (size_t)w * sizeof *c.mark);
            }
        rg_canvas_free(&c);
        rg_canvas_free(&part);
    }
}

/* Two triangles that share an edge leave no gap and no sample to both, wherever the edge runs. */
static void an_edge_has_no_gap(void **state)
{
    (void)state;
    uint32_t seed = 3;
    for (int turn = 0; turn < 200; turn++) {
        rg_gl_vertex v[4];
        for (int k = 0; k < 4; k++) {
            const double angle = 2 * 3.14159265358979 * (k + 0.8 * chance(&seed)) / 4;
            v[k] = (rg_gl_vertex){(float)(32 + 25 * cos(angle)), (float)(32 + 25 * sin(angle)), 0.5f, 1};
        }
        if (turn % 3 == 0) for (int k = 0; k < 4; k++) v[k].x = floorf(v[k].x) + 0.5f, v[k].y = floorf(v[k].y) + 0.5f; /* on middles */
        const uint32_t two[6] = {0, 1, 2, 0, 2, 3}, other[6] = {1, 2, 3, 1, 3, 0};
        static uint32_t a[64 * 64], b[64 * 64];
        static double depth[64 * 64];
        rg_raster_draw(&(rg_gl_scene){v, two, 6}, 0, 0, 64, 64, a, depth, 64);
        rg_raster_draw(&(rg_gl_scene){v, other, 6}, 0, 0, 64, 64, b, depth, 64);
        assert_memory_equal(a, b, sizeof a); /* cut the other way it is the same quadrilateral */
    }
}

static int differ(const rg_canvas *a, const rg_canvas *b)
{
    int n = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) n += a->mark[i] != b->mark[i];
    return n;
}

static void opengl_sees_the_same(void **state)
{
    (void)state;
    if (rg_gl_check(NULL) != RG_OK) {
        printf("SKIPPED: built with GL=none\n");
        skip();
    }
    rg_canvas gl = make(1), ours = make(0);
    int close;
    assert_true(gl.child > 0);
    for (uint32_t seed = 0; seed < 5; seed++) {
        fill(&gl, seed), fill(&ours, seed);
        rg_canvas_draw(&gl, 3 * TRIANGLES, 0, 0, WIDTH, HEIGHT);
        assert_true(gl.child > 0); /* it was OpenGL */
        rg_canvas_draw(&ours, 3 * TRIANGLES, 0, 0, WIDTH, HEIGHT);
        assert_int_equal(wrong(&gl, &close), 0);
        assert_true(differ(&gl, &ours) < WIDTH * HEIGHT / 200);
    }
    rg_canvas_free(&gl);
    rg_canvas_free(&ours);
}

/* However the child ends, the picture is made, no signal comes, and no process is left. */
static void a_child_that_ends_is_no_loss(void **state)
{
    (void)state;
    static const int signals[] = {SIGKILL, SIGSEGV, SIGTERM};
    if (rg_gl_check(NULL) != RG_OK) {
        printf("SKIPPED: built with GL=none\n");
        skip();
    }
    rg_canvas ours = make(0);
    rg_canvas_draw(&ours, 3 * TRIANGLES, 0, 0, WIDTH, HEIGHT);
    for (int i = 0; i < 6; i++) {
        rg_canvas c = make(1);
        assert_true(c.child > 0);
        if (i >= 3) rg_canvas_draw(&c, 3 * TRIANGLES, 0, 0, WIDTH, HEIGHT); /* once it is at work */
        kill((pid_t)c.child, signals[i % 3]);
        if (i % 2) nanosleep(&(struct timespec){0, 50000000}, NULL);
        for (int again = 0; again < 2; again++) {
            rg_canvas_draw(&c, 3 * TRIANGLES, 0, 0, WIDTH, HEIGHT);
            assert_true(differ(&c, &ours) < WIDTH * HEIGHT / 200);
        }
        assert_int_equal(c.child, 0);
        assert_int_equal(differ(&c, &ours), 0);
        rg_canvas_free(&c);
    }
    rg_canvas_free(&ours);
    errno = 0;
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static void shortage_is_told(void **state)
{
    (void)state;
    rg_status s = RG_ENOMEM;
    for (long k = 0; s != RG_OK; k++) {
        counted count = {k, 0, 0};
        const rg_memory mem = {counted_resize, &count};
        rg_canvas c;
        s = rg_canvas_init(&mem, WIDTH, HEIGHT, 3 * TRIANGLES, 3 * TRIANGLES, 0, &c);
        assert_true(s == RG_OK || s == RG_ENOMEM);
        rg_canvas_free(&c);
        assert_int_equal(count.out, 0);
        assert_true(k < 10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ours_sees_what_is_nearest), cmocka_unit_test(parts_are_parts_of_the_whole),
        cmocka_unit_test(an_edge_has_no_gap),        cmocka_unit_test(opengl_sees_the_same),
        cmocka_unit_test(a_child_that_ends_is_no_loss), cmocka_unit_test(shortage_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
