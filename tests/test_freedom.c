/* kinematics/freedom.c: the outline of the sheet stays, whatever its vertices do. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "folded.h"
#include "generate/generate.h"
#include "kinematics/freedom.h"

static rg_mesh patch(int n, unsigned *seed, int turned)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh m = {0};
    while (!m.nv) {
        rg_lines l = drawing();
        draw_patchwork(&l, n, 0.05, seed);
        draw_moved(&l, 1, turned, 0, 0);
        rg_pattern *p = pattern_of(&l);
        if (rg_mesh_from_pattern(p, &mem, &m, NULL) != RG_OK) memset(&m, 0, sizeof m);
        rg_pattern_destroy(p);
    }
    return m;
}

static rg_freedom freedom_of(const rg_mesh *m, int movable)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_freedom f;
    assert_int_equal(rg_freedom_init(&f, &mem, m, movable), RG_OK);
    return f;
}

/* 2: inside, 1: on a straight side, 0: corner; of the square 0 ... n, turned. */
static int ways_there(rg_vec2 x, int n, double turned, double *off)
{
    const double a = cos(turned) * x.x + sin(turned) * x.y, b = cos(turned) * x.y - sin(turned) * x.x;
    const int at_a = fabs(a) < 1e-6 || fabs(a - n) < 1e-6, at_b = fabs(b) < 1e-6 || fabs(b - n) < 1e-6;
    *off = fmin(fmin(fabs(a), fabs(a - n)), fmin(fabs(b), fabs(b - n)));
    return 2 - at_a - at_b;
}

static void outline(void **state)
{
    (void)state;
    unsigned seed = 21;
    for (int round = 0; round < 20; round++) {
        const int n = 3 + round % 4;
        rg_mesh m = patch(n, &seed, round);
        rg_freedom f = freedom_of(&m, 1);
        rg_vec2 *X = calloc((size_t)m.nv, sizeof *X);
        double *u = calloc((size_t)f.U, sizeof *u), off;
        int32_t ways = 0;
        assert_true(X && u);
        for (int32_t i = 0; i < f.U; i++) u[i] = 0.1 * noise(&seed);
        rg_freedom_move(&f, u, X);
        for (int32_t v = 0; v < m.nv; v++) {
            const int there = ways_there(m.X[v], n, round, &off);
            const double moved = rg_vec2_length(rg_vec2_sub(X[v], m.X[v]));
            assert_int_equal((f.way[v][0] >= 0) + (f.way[v][1] >= 0), there);
            ways += there;
            for (int i = 0; i < 2; i++)
                if (f.way[v][i] >= 0) assert_int_equal(f.vertex[f.way[v][i]], v);
            if (there == 0) near(moved, 0, 0);
            else assert_true(moved > 1e-5);
            if (there == 1) assert_int_equal(ways_there(X[v], n, round, &off), 1);
            if (there == 1) near(off, 0, 1e-12);
            if (there == 1) near(moved, fabs(u[f.way[v][0]]), 1e-13);
            if (there == 2) near(moved, hypot(u[f.way[v][0]], u[f.way[v][1]]), 1e-13);
        }
        assert_int_equal(ways, f.U);
        memset(u, 0, (size_t)f.U * sizeof *u);
        rg_freedom_move(&f, u, X);
        assert_memory_equal(X, m.X, (size_t)m.nv * sizeof *X);
        free(u);
        free(X);
        rg_freedom_free(&f);
        rg_freedom_free(&f);
        rg_mesh_free(&m);
    }
}

/* The shortest line drawn, not one that triangulation added. */
static void reach(void **state)
{
    (void)state;
    unsigned seed = 22;
    for (int round = 0; round < 10; round++) {
        rg_mesh drawn = patch(4, &seed, 0), m;
        assert_int_equal(rg_triangulate_all(&drawn, &m), RG_OK);
        rg_freedom f = freedom_of(&m, 1), g = freedom_of(&drawn, 1);
        assert_int_equal(f.U, g.U);
        for (int32_t i = 0; i < f.U; i++) {
            double least = INFINITY;
            for (int32_t e = 0; e < drawn.ne; e++)
                if (drawn.edge[e][0] == f.vertex[i] || drawn.edge[e][1] == f.vertex[i])
                    least = fmin(least, rg_vec2_length(rg_vec2_sub(drawn.X[drawn.edge[e][0]], drawn.X[drawn.edge[e][1]])));
            near(f.reach[i], least, 0);
            near(g.reach[i], least, 0);
            near(rg_vec2_length(f.direction[i]), 1, 1e-14);
        }
        rg_freedom_free(&f);
        rg_freedom_free(&g);
        rg_mesh_free(&m);
        rg_mesh_free(&drawn);
    }
}

/* A vertex is carried to the opposite side of each facet around it: that one turns over, and is told. */
static void facets_turned_over(void **state)
{
    (void)state;
    unsigned seed = 23;
    rg_mesh m = patch(4, &seed, 1);
    rg_freedom f = freedom_of(&m, 1);
    double *u = calloc((size_t)f.U, sizeof *u);
    rg_vec2 *X = calloc((size_t)m.nv, sizeof *X);
    int tried = 0;
    assert_true(u && X);
    rg_freedom_move(&f, u, X);
    assert_true(rg_freedom_room(&f, X, 0.1, NULL));
    assert_true(rg_freedom_room(&f, X, 1, NULL));
    for (int32_t k = 0; k < m.nf; k++)
        for (int32_t j = m.facet_start[k]; j < m.facet_start[k + 1] && m.facet_start[k + 1] - m.facet_start[k] == 3; j++) {
            const int32_t first = m.facet_start[k], i = j - first, v = m.facet_vertex[j];
            if (f.way[v][1] < 0) continue;
            const rg_vec2 a = m.X[m.facet_vertex[first + (i + 1) % 3]], b = m.X[m.facet_vertex[first + (i + 2) % 3]];
            const rg_vec2 to = {(a.x + b.x) / 2, (a.y + b.y) / 2}, by = rg_vec2_sub(to, m.X[v]);
            for (double t = 0.85; t < 1.5; t += 0.3) {
                memset(u, 0, (size_t)f.U * sizeof *u);
                u[f.way[v][0]] = t * by.x;
                u[f.way[v][1]] = t * by.y;
                rg_freedom_move(&f, u, X);
                assert_int_equal(rg_freedom_room(&f, X, 0.2, NULL), 0); /* t of its height is gone */
                if (t > 1) assert_int_equal(rg_freedom_room(&f, X, 0, NULL), 0);
                tried++;
            }
        }
    assert_true(tried > 30);
    X[f.vertex[0]].x = NAN;
    assert_int_equal(rg_freedom_room(&f, X, 0.1, NULL), 0);
    free(X);
    free(u);
    rg_freedom_free(&f);
    rg_mesh_free(&m);
}

static void what_stays(void **state)
{
    (void)state;
    unsigned seed = 24;
    rg_mesh m = patch(3, &seed, 0);
    rg_freedom f = freedom_of(&m, 0);
    assert_int_equal(f.U, 0);
    for (int32_t v = 0; v < m.nv; v++) assert_true(f.way[v][0] < 0 && f.way[v][1] < 0);
    rg_freedom_free(&f);
    rg_mesh_free(&m);
}

static void memory(void **state)
{
    (void)state;
    unsigned seed = 25;
    counted c = {0, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    rg_mesh m = patch(3, &seed, 0);
    rg_freedom f;
    for (long k = 0;; k++) {
        c.left = k;
        const rg_status s = rg_freedom_init(&f, &mem, &m, 1);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(c.out, 0);
    }
    rg_freedom_free(&f);
    assert_int_equal(c.out, 0);
    rg_mesh_free(&m);
}

/* A sheet of paper moved by its mean is the same sheet from every side of the group; the outline stays. */
static void means(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    static const char *const kinds[] = {"boxpleat", "tatou", "waterbomb"};
    static const int32_t orders[] = {4, 4, 2}, sizes[] = {8, 0, 4};
    unsigned seed = 23;
    for (int k = 0; k < 3; k++) {
        rg_lines l;
        assert_int_equal(rg_generate_lines(kinds[k], sizes[k], 0, 0, &mem, &l, NULL), RG_OK);
        draw_moved(&l, 1, 0.3, 0, 0);
        rg_pattern *p = pattern_of(&l);
        rg_mesh m = mesh_of(p);
        rg_freedom f = freedom_of(&m, 1);
        rg_symmetry G;
        assert_int_equal(rg_symmetry_find(&G, &mem, &m), RG_OK);
        assert_int_equal(G.order, orders[k]);
        double *u = calloc((size_t)f.U, sizeof *u), *again = calloc((size_t)f.U, sizeof *again), size = 0, mean = 0;
        rg_vec2 *d = calloc((size_t)m.nv, sizeof *d), *X = calloc((size_t)m.nv, sizeof *X);
        assert_true(u && again && d && X);
        for (int32_t i = 0; i < f.U; i++) {
            u[i] = 5e-3 * m.size * noise(&seed);
            size += u[i] * u[i];
        }
        rg_freedom_mean(&f, &G, u, d);
        for (int32_t i = 0; i < f.U; i++) mean += u[i] * u[i];
        assert_true(mean > 0.02 * size && mean < size); /* a projection: shorter, and not nothing */
        rg_freedom_move(&f, u, X);
        for (int32_t g = 0; g < G.order; g++)
            for (int32_t v = 0; v < m.nv; v++) {
                const rg_vec2 x = rg_vec2_sub(X[v], G.middle), y = rg_vec2_sub(X[G.vertex[g * m.nv + v]], G.middle);
                near(G.A[g][0][0] * x.x + G.A[g][0][1] * x.y, y.x, 1e-12 * m.size);
                near(G.A[g][1][0] * x.x + G.A[g][1][1] * x.y, y.y, 1e-12 * m.size);
            }
        memcpy(again, u, (size_t)f.U * sizeof *u);
        rg_freedom_mean(&f, &G, again, d);
        for (int32_t i = 0; i < f.U; i++) near(again[i], u[i], 1e-14 * m.size);
        free(u);
        free(again);
        free(d);
        free(X);
        rg_symmetry_free(&G);
        rg_freedom_free(&f);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outline), cmocka_unit_test(reach), cmocka_unit_test(facets_turned_over), cmocka_unit_test(what_stays),
        cmocka_unit_test(means),   cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
