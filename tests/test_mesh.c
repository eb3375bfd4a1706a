/* mesh/facets.c, mesh/connect.c: facets, creases, interior vertices and their sector angles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "folded.h"

static double area(const rg_mesh *m, int32_t f)
{
    double twice = 0;
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
        const int32_t k = j + 1 < m->facet_start[f + 1] ? j + 1 : m->facet_start[f];
        twice += rg_vec2_cross(m->X[m->facet_vertex[j]], m->X[m->facet_vertex[k]]);
    }
    return twice / 2;
}

/* What every mesh must be, whatever it is made from. */
static void is_mesh(const rg_mesh *m, double sheet)
{
    double sum = 0;
    int32_t *sides = calloc((size_t)m->ne, sizeof *sides);
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t n = m->facet_start[f + 1] - m->facet_start[f];
        assert_true(n >= 3);
        assert_true(area(m, f) > 0);
        sum += area(m, f);
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const int32_t k = j + 1 < m->facet_start[f + 1] ? j + 1 : m->facet_start[f], e = m->facet_edge[j];
            const int back = m->edge[e][0] != m->facet_vertex[j];
            assert_int_equal(m->edge[e][back], m->facet_vertex[j]);
            assert_int_equal(m->edge[e][!back], m->facet_vertex[k]);
            assert_int_equal(m->edge_facet[e][back], f); /* left of the edge in its direction, right of it the other way */
            sides[e]++;
        }
    }
    near(sum, sheet, 1e-12 * sheet);
    int32_t creases = 0;
    for (int32_t e = 0; e < m->ne; e++) {
        assert_int_equal(sides[e], 1 + (m->edge_crease[e] >= 0));
        assert_int_equal(m->assignment[e] == RG_BORDER, m->edge_crease[e] < 0);
        if (m->edge_crease[e] < 0) continue;
        assert_int_equal(m->crease_edge[m->edge_crease[e]], e);
        creases++;
    }
    assert_int_equal(creases, m->N);
    assert_int_equal(m->ne, m->N + m->N0);
    assert_int_equal(m->nv - m->ne + m->nf, 1);
    assert_int_equal(m->nv, m->M + m->N0); /* the border of a disk has as many vertices as edges */
    free(sides);
}

/* The loop of an interior vertex: all its creases, counter-clockwise, with the angles between them, once round. */
static void has_loops(const rg_mesh *m)
{
    int32_t last = -1;
    assert_int_equal(m->loop_start[0], 0);
    for (int32_t k = 0; k < m->M; k++) {
        const int32_t v = m->inner_vertex[k], start = m->loop_start[k], n = m->loop_start[k + 1] - start;
        double sum = 0, turned = 0, first = 0;
        int32_t degree = 0;
        assert_true(v > last);
        last = v;
        for (int32_t e = 0; e < m->ne; e++) degree += m->edge[e][0] == v || m->edge[e][1] == v;
        assert_int_equal(n, degree);
        for (int32_t i = 0; i < n; i++) {
            const int32_t e = m->crease_edge[m->loop_crease[start + i]];
            assert_true(m->edge[e][0] == v || m->edge[e][1] == v);
            const rg_vec2 d = rg_vec2_sub(m->X[m->edge[e][m->edge[e][0] == v]], m->X[v]);
            const double angle = atan2(d.y, d.x);
            if (i == 0) first = angle;
            near(remainder(angle - first - turned, 2 * RG_PI), 0, 1e-9);
            turned += m->loop_theta[start + i];
            assert_true(m->loop_theta[start + i] > 0 && m->loop_theta[start + i] < 2 * RG_PI);
            sum += m->loop_theta[start + i];
        }
        near(sum, 2 * RG_PI, 1e-11);
    }
}

static void patchworks(void **state)
{
    (void)state;
    unsigned seed = 2385;
    int meshes = 0, concave = 0;
    for (int round = 0; round < 250; round++) {
        const int n = 2 + round % 7;
        rg_lines l = drawing();
        draw_patchwork(&l, n, 0.05 * (round % 12), &seed);
        draw_moved(&l, 1.25, 0.7 * round, 3, -2);
        rg_pattern *p = pattern_of(&l);
        rg_pattern_info info;
        info = *rg_pattern_get_info(p);
        if (info.is_disk) {
            rg_mesh m = mesh_of(p);
            is_mesh(&m, n * n * 1.25 * 1.25);
            has_loops(&m);
            assert_int_equal(m.N, info.creases);
            assert_int_equal(m.M, info.interior_vertices);
            assert_int_equal(m.N0, info.boundary_edges);
            assert_int_equal(m.nf, info.facets);
            near(m.size, info.size, 0);
            for (int32_t k = 0; k < m.loop_start[m.M]; k++) concave += m.loop_theta[k] > RG_PI + 1e-3;
            for (int32_t i = 0; i < m.N; i++) {
                const int32_t e = m.crease_edge[i];
                near(m.target[e], m.assignment[e] == RG_VALLEY ? RG_PI : -RG_PI, 0);
            }
            rg_mesh_free(&m);
            rg_mesh_free(&m); /* nothing left to free */
            meshes++;
        }
        rg_pattern_destroy(p);
    }
    assert_true(meshes > 150 && concave > 100);
}

/* The numbers of a grid are known without any of this. */
static void a_grid(void **state)
{
    (void)state;
    const int n = 7, k = 5;
    rg_lines l = drawing();
    for (int i = 0; i <= n; i++) draw(&l, i % n ? RG_VALLEY : RG_BORDER, 1.25 * i, 0, 1.25 * i, 0.7 * k);
    for (int j = 0; j <= k; j++) draw(&l, j % k ? RG_MOUNTAIN : RG_BORDER, 0, 0.7 * j, 1.25 * n, 0.7 * j);
    rg_pattern *p = pattern_of(&l);
    rg_mesh m = mesh_of(p);
    is_mesh(&m, 1.25 * n * 0.7 * k);
    has_loops(&m);
    assert_int_equal(m.M, (n - 1) * (k - 1));
    assert_int_equal(m.N, (n - 1) * k + n * (k - 1));
    assert_int_equal(m.N0, 2 * (n + k));
    assert_int_equal(m.nf, n * k);
    assert_int_equal(m.added, 0);
    for (int32_t i = 0; i < m.loop_start[m.M]; i++) near(m.loop_theta[i], RG_PI / 2, 1e-12);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

/* No interior vertex, and no crease: still a mesh. */
static void the_least_there_is(void **state)
{
    (void)state;
    for (int creases = 0; creases < 2; creases++) {
        rg_lines l = drawing();
        const rg_vec2 corner[] = {{0, 0}, {2.385, 0}, {1, 1.25}};
        draw_polygon(&l, RG_BORDER, corner, 3);
        if (creases) draw(&l, RG_VALLEY, 0, 0, (2.385 + 1) / 2, 0.625);
        rg_pattern *p = pattern_of(&l);
        rg_mesh m = mesh_of(p);
        is_mesh(&m, 2.385 * 1.25 / 2);
        assert_int_equal(m.N, creases);
        assert_int_equal(m.M, 0);
        assert_int_equal(m.nf, 1 + creases);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patchworks),
        cmocka_unit_test(a_grid),
        cmocka_unit_test(the_least_there_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
