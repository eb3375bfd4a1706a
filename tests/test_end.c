/* unfold/end.c: which parts lie behind a third facet, found again point by point; rows that say the same; layers that
 * have passed each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "draw.h"
#include "layers/layers.h"
#include "mesh/mesh.h"
#include "unfold/end.h"

/* ------------------------------------------------------------------------------------------------- flat ends ---- */

typedef struct flat_end {
    rg_mesh mesh;
    rg_linkage P;
    rg_layers *layers;
    rg_end end;
} flat_end;

static int lies_over(void *ctx, int32_t f, int32_t g)
{
    const flat_end *w = ctx;
    const rg_flat *flat = &w->layers->flat;
    const int turned = flat->up[flat->facet_of[w->P.tree.order[0]]];
    return -turned * rg_layers_above(w->layers, flat->facet_of[f], flat->facet_of[g]);
}

/* In triangles, in the first of its orders. */
static void make(const char *path, flat_end *w)
{
    const rg_memory mem = rg_mem_default(NULL);
    const rg_end_rules rules = {1, 1};
    rg_pattern *p = NULL;
    rg_mesh drawn;
    double angle[400], z[2000] = {0};
    assert_int_equal(rg_pattern_read(path, NULL, &p, NULL), RG_OK);
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &drawn, NULL), RG_OK);
    assert_int_equal(rg_triangulate_all(&drawn, &w->mesh), RG_OK);
    assert_true(w->mesh.N <= 400);
    for (int32_t i = 0; i < w->mesh.N; i++) {
        const double target = w->mesh.target[w->mesh.crease_edge[i]];
        angle[i] = z[i] = i < w->mesh.N - w->mesh.added && !isnan(target) ? target : 0;
    }
    assert_int_equal(rg_layers_of_mesh(&w->mesh, angle, 0, &mem, NULL, &w->layers, NULL), RG_OK);
    assert_int_equal(w->layers->info.state, RG_LAYERS_VALID);
    assert_int_equal(rg_layers_choose(w->layers, 0), RG_OK);
    assert_int_equal(rg_linkage_init(&w->P, &mem, &w->mesh), RG_OK);
    assert_true(w->P.n <= 2000);
    assert_int_equal(rg_end_init(&w->end, &mem, &w->P, z, &rules, &(rg_end_order){lies_over, w, NULL}), RG_OK);
    rg_mesh_free(&drawn);
    rg_pattern_destroy(p);
}

static void take_away(flat_end *w)
{
    rg_end_free(&w->end);
    rg_end_free(&w->end);
    rg_linkage_free(&w->P);
    rg_layers_destroy(w->layers);
    rg_mesh_free(&w->mesh);
}

/* ---------------------------------------------------------------------------------------------------- behind ---- */

static int corners_at(const rg_mesh *m, int32_t f, int32_t a, int32_t b)
{
    int n = 0;
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
        n += m->facet_vertex[j] == a || m->facet_vertex[j] == b;
    return n;
}

/* Least distance of a point inside the edges of a facet as it lies, over its longest edge; negative: outside. */
static double inside(const flat_end *w, int32_t f, rg_vec2 x)
{
    const int32_t *v = w->mesh.facet_vertex + w->mesh.facet_start[f];
    const rg_vec2 *p = w->end.x;
    const double way = rg_vec2_turn(p[v[0]], p[v[1]], p[v[2]]) > 0 ? 1 : -1;
    double least = INFINITY;
    for (int k = 0; k < 3; k++) {
        const rg_vec2 a = p[v[k]], b = p[v[(k + 1) % 3]];
        least = fmin(least, way * rg_vec2_turn(a, b, x) / rg_vec2_length(rg_vec2_sub(b, a)));
    }
    return least;
}

/* Does a facet lie between f and g at x that has not both of v nor both of u? 2: one does if rounding says so. */
static int between(const flat_end *w, int32_t f, int32_t g, rg_vec2 x, const int32_t *v, const int32_t *u)
{
    const int32_t nf = w->mesh.nf;
    const signed char *over = w->end.sides.over;
    const int side = over[f * nf + g], of_v = v[0] == v[1] ? 1 : 2;
    int found = 0;
    for (int32_t h = 0; side != 0 && h < nf; h++) {
        if (over[f * nf + h] != side || over[h * nf + g] != side) continue;
        if (corners_at(&w->mesh, h, v[0], v[1]) == of_v || (u && corners_at(&w->mesh, h, u[0], u[1]) == 2)) continue;
        const double in = inside(w, h, x);
        if (in > 1e-6 * w->mesh.size) return 1;
        if (in > -1e-6 * w->mesh.size) found = 2;
    }
    return found;
}

static void what_lies_behind_a_third(void **state)
{
    (void)state;
    static const char *const files[] = {"patterns/bird.opx", "patterns/fish.opx", "patterns/frog.opx",
        "patterns/crane.opx", "patterns/miura.opx"};
    int behind[2] = {0}, open[2] = {0};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        flat_end w = {.layers = NULL};
        make(files[k], &w);
        const rg_mesh *m = &w.mesh;
        const rg_vec2 *x = w.end.x;
        for (int32_t v = 0; v < m->nv; v++)
            for (int32_t g = 0; g < m->nf; g++) {
                if (corners_at(m, g, v, v)) continue;
                const int32_t both[2] = {v, v};
                int want = 0;
                for (int32_t f = 0; f < m->nf && want != 1; f++) {
                    const int here = corners_at(m, f, v, v) ? between(&w, f, g, x[v], both, NULL) : 0;
                    if (here) want = here;
                }
                if (want == 2) continue;
                assert_int_equal(w.end.sides.corner_behind[(size_t)v * (size_t)m->nf + (size_t)g], want);
                want ? behind[0]++ : open[0]++;
            }
        for (int32_t a = 0; a < m->ne; a++)
            for (int32_t b = 0; b < a; b++) {
                const int32_t *v = m->edge[a], *u = m->edge[b];
                const double p = rg_vec2_turn(x[v[0]], x[v[1]], x[u[0]]), q = rg_vec2_turn(x[v[0]], x[v[1]], x[u[1]]);
                const double r = rg_vec2_turn(x[u[0]], x[u[1]], x[v[0]]), s = rg_vec2_turn(x[u[0]], x[u[1]], x[v[1]]);
                const double none = 1e-6 * m->size * m->size;
                const double nearest = fmin(fmin(fabs(p), fabs(q)), fmin(fabs(r), fabs(s)));
                if (nearest < none) continue; /* they may touch there only */
                int want = 0;
                if (p * q < 0 && r * s < 0) {
                    const double t = p / (p - q);
                    const rg_vec2 at = {x[u[0]].x + t * (x[u[1]].x - x[u[0]].x),
                        x[u[0]].y + t * (x[u[1]].y - x[u[0]].y)};
                    for (int i = 0; i < 4 && want != 1; i++) {
                        const int32_t f = m->edge_facet[a][i / 2], g = m->edge_facet[b][i % 2];
                        const int here = f >= 0 && g >= 0 ? between(&w, f, g, at, v, u) : 0;
                        if (here) want = here;
                    }
                }
                if (want == 2) continue;
                assert_int_equal(w.end.sides.edge_behind[(size_t)a * (size_t)m->ne + (size_t)b], want);
                want ? behind[1]++ : open[1]++;
            }
        take_away(&w);
    }
    for (int k = 0; k < 2; k++) assert_true(behind[k] > 100 && open[k] > 100);
}

/* ------------------------------------------------------------------------------------------------------ rows ---- */

/* What two rows say along a direction that has nothing to do with either, at any positions, is the same. */
static int say_the_same(const rg_end_row *a, const rg_end_row *b, int32_t nv)
{
    unsigned seed = 3;
    if (a->kind != b->kind || a->frame != b->frame || rg_vec3_length(rg_vec3_sub(a->n, b->n)) > 1e-9) return 0;
    for (int k = 0; k < 3; k++) {
        double of_a = 0, of_b = 0;
        for (int32_t v = 0; v < nv; v++) {
            const double at = noise(&seed);
            for (int32_t i = 0; i < a->terms; i++) of_a += a->v[i] == v ? a->weight[i] * at : 0;
            for (int32_t i = 0; i < b->terms; i++) of_b += b->v[i] == v ? b->weight[i] * at : 0;
        }
        if (fabs(of_a - of_b) > 1e-9) return 0;
    }
    return 1;
}

static void no_row_says_what_another_says(void **state)
{
    (void)state;
    flat_end w = {.layers = NULL};
    make("patterns/bird.opx", &w);
    assert_true(w.end.count > 20);
    for (int32_t i = 0; i < w.end.count; i++)
        for (int32_t j = 0; j < i; j++) assert_false(say_the_same(&w.end.row[i], &w.end.row[j], w.mesh.nv));
    take_away(&w);
}

/* ----------------------------------------------------------------------------------------------------- upset ---- */

/* Two flaps on the middle of a strip, the second over the end of the first. */
static int second_over_first(void *ctx, int32_t f, int32_t g)
{
    const int *height = ctx;
    return (height[f] > height[g]) - (height[f] < height[g]);
}

static void layers_that_have_passed_each_other(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    const rg_end_rules rules = {0, 0};
    static const struct { double first, second; int upset; } cases[] = {
        {0, 0, 0}, {-0.02, -0.1, 0}, {0, 0.05, 1}, /* the second has gone through the first and the middle */
        {-0.02, -0.004, 1},                        /* under the first, all where they overlap */
        {0.05, -0.02, 1}};                         /* the first has gone through the middle */
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 1, 0.4);
    draw(&l, RG_VALLEY, 0.25, 0, 0.25, 0.4);
    draw(&l, RG_VALLEY, 0.7, 0, 0.7, 0.4);
    rg_pattern *p = pattern_of(&l);
    rg_mesh drawn, m;
    rg_linkage P;
    rg_end end;
    double z[100] = {0}, flat[100] = {0};
    int height[20], first = -1, second = -1;
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &drawn, NULL), RG_OK);
    assert_int_equal(rg_triangulate_all(&drawn, &m), RG_OK);
    assert_int_equal(rg_linkage_init(&P, &mem, &m), RG_OK);
    assert_true(P.n <= 100 && m.nf <= 20);
    for (int32_t i = 0; i < m.N; i++) {
        const double x = m.X[m.edge[m.crease_edge[i]][0]].x, y = m.X[m.edge[m.crease_edge[i]][1]].x;
        if (fabs(x - 0.25) < 1e-9 && fabs(y - 0.25) < 1e-9) first = i;
        if (fabs(x - 0.7) < 1e-9 && fabs(y - 0.7) < 1e-9) second = i;
    }
    assert_true(first >= 0 && second >= 0);
    flat[first] = flat[second] = RG_PI;
    for (int32_t f = 0; f < m.nf; f++) {
        double x = 0;
        for (int32_t j = m.facet_start[f]; j < m.facet_start[f + 1]; j++) x += m.X[m.facet_vertex[j]].x / 3;
        height[f] = x < 0.25 ? 1 : x > 0.7 ? 2 : 0;
    }
    const int turned = height[P.tree.order[0]] == 0 ? 1 : -1; /* seen with the front of that facet up */
    for (int32_t f = 0; f < m.nf; f++) height[f] *= turned;
    assert_int_equal(rg_end_init(&end, &mem, &P, flat, &rules, &(rg_end_order){second_over_first, height, NULL}), RG_OK);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        memcpy(z, flat, sizeof z);
        z[first] += cases[k].first, z[second] += cases[k].second;
        rg_linkage_put(&P, z);
        if (rg_end_is_upset(&end, &P) != cases[k].upset) fail_msg("case %d", (int)k);
    }
    rg_end_free(&end);
    rg_linkage_free(&P);
    rg_mesh_free(&m);
    rg_mesh_free(&drawn);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_lies_behind_a_third),
        cmocka_unit_test(no_row_says_what_another_says),
        cmocka_unit_test(layers_that_have_passed_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
