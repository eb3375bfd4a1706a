/* mesh/polygon.c and inside.c: which diagonals a facet has, against crossings counted; which angles stay inside ones when facets are cut. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "near.h"

#include "folded.h"
#include "generate/generate.h"
#include "mesh/inside.h"
#include "mesh/polygon.h"

enum { MOST = 12 };

static double side_of(rg_vec2 a, rg_vec2 b, rg_vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

static int cross(rg_vec2 a, rg_vec2 b, rg_vec2 c, rg_vec2 d)
{
    return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

/* By a ray to the right. */
static int is_within(const rg_vec2 *x, int n, rg_vec2 p)
{
    int in = 0;
    for (int i = 0; i < n; i++) {
        const rg_vec2 a = x[i], b = x[(i + 1) % n];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
    return in;
}

/* Polygons seen whole from a point within, of any shape besides. */
static void diagonals_are_those_that_cross_nothing(void **state)
{
    (void)state;
    unsigned seed = 17;
    int is = 0, is_not = 0;
    for (int round = 0; round < 400; round++) {
        const int n = 4 + round % (MOST - 3);
        rg_vec2 x[MOST];
        int32_t v[MOST], e[MOST];
        unsigned char inside[MOST] = {0};
        for (int i = 0; i < n; i++) {
            const double angle = 2 * RG_PI * (i + 0.4 * noise(&seed)) / n, r = round % 3 ? 1.1 + noise(&seed) : 5 + noise(&seed);
            x[i] = (rg_vec2){3 + r * cos(angle), r * sin(angle) - 7};
            v[i] = e[i] = i;
        }
        const rg_polygon p = {x, n, v, e, inside};
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                if (i == j || (i + 1) % n == j || (j + 1) % n == i) continue;
                int want = is_within(x, n, (rg_vec2){(x[i].x + x[j].x) / 2, (x[i].y + x[j].y) / 2});
                for (int k = 0; k < n; k++) want &= !cross(x[i], x[j], x[k], x[(k + 1) % n]) || k == i || k == j || (k + 1) % n == i || (k + 1) % n == j;
                assert_int_equal(rg_polygon_has_diagonal(&p, i, j) != 0, want);
                is += want, is_not += !want;
            }
    }
    assert_true(is > 1000 && is_not > 1000);
}

/* The edge that ends the corner at place j of facet f on the other side: the one before it round the facet. */
static int32_t edge_before(const rg_mesh *m, int32_t f, int32_t j)
{
    return m->facet_edge[j > m->facet_start[f] ? j - 1 : m->facet_start[f + 1] - 1];
}

/* Where the facet of a closed vertex is cut, the inside angle is one still if it is whole, and none if it is cut through. */
static void cutting_leaves_whole_angles_what_they_were(void **state)
{
    (void)state;
    static const struct { const char *kind; int32_t n; } kinds[] = {{"closed-split", 0}, {"closed-adjust", 0}, {"boxpleat", 8}, {"frog", 0}, {"four-crane", 0}, {"crane", 0}};
    const rg_memory mem = rg_mem_default(NULL);
    int whole = 0, cut = 0;
    for (int k = 0; k < 6; k++) {
        rg_lines l;
        assert_int_equal(rg_generate_lines(kinds[k].kind, kinds[k].n, 0, 0, &mem, &l, NULL), RG_OK);
        rg_pattern *p = pattern_of(&l);
        rg_mesh m = mesh_of(p), t;
        assert_int_equal(rg_triangulate_all(&m, &t), RG_OK);
        unsigned char *was = calloc((size_t)m.facet_start[m.nf] + 1, 1), *is = calloc((size_t)t.facet_start[t.nf] + 1, 1);
        assert_true(was && is);
        assert_int_equal(rg_inside_find(&m, was), RG_OK);
        assert_int_equal(rg_inside_find(&t, is), RG_OK);
        for (int32_t f = 0; f < m.nf; f++)
            for (int32_t j = m.facet_start[f]; j < m.facet_start[f + 1]; j++) {
                int found = 0;
                for (int32_t g = 0; g < t.nf; g++)
                    for (int32_t i = t.facet_start[g]; i < t.facet_start[g + 1]; i++) {
                        if (t.facet_vertex[i] != m.facet_vertex[j] || t.facet_edge[i] != m.facet_edge[j] || edge_before(&t, g, i) != edge_before(&m, f, j)) continue;
                        assert_int_equal(is[i] != 0, was[j] != 0);
                        found = 1;
                        whole += was[j] != 0;
                    }
                cut += was[j] && !found;
            }
        int flags = 0, old = 0;
        for (int32_t i = 0; i < t.facet_start[t.nf]; i++) flags += is[i] != 0;
        for (int32_t j = 0; j < m.facet_start[m.nf]; j++) old += was[j] != 0;
        assert_true(flags <= old);
        free(was);
        free(is);
        rg_mesh_free(&t);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
    assert_true(whole > 5 && cut > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diagonals_are_those_that_cross_nothing),
        cmocka_unit_test(cutting_leaves_whole_angles_what_they_were),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
