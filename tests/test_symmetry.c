/* mesh/symmetry.c and cuts by orbit: polygons within polygons, made with known symmetries; generated patterns; drawings that
 * are nearly so. Where an element takes a thing is found again by where it lies. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "draw.h"
#include "generate/generate.h"
#include "mesh/symmetry.h"
#include "pattern/alike.h"

enum { MOST = 4000 };

/* A regular polygon of paper with a smaller one of creases in it, turned by `twist`, which spokes join to the corners. off: how
 * far the first inner corner lies beside its place. */
static rg_lines ring(int n, double turned, double twist, double off)
{
    rg_lines l = drawing();
    rg_vec2 out[64], in[64];
    for (int k = 0; k < n; k++) {
        const double a = 2 * RG_PI * k / n + turned, b = a + twist;
        out[k] = (rg_vec2){1.25 + 2.385 * cos(a), -7.5 + 2.385 * sin(a)};
        in[k] = (rg_vec2){1.25 + 1.1 * cos(b) + (k ? 0 : off), -7.5 + 1.1 * sin(b)};
    }
    draw_polygon(&l, RG_BORDER, out, n);
    draw_polygon(&l, RG_MOUNTAIN, in, n);
    for (int k = 0; k < n; k++) draw(&l, RG_VALLEY, in[k].x, in[k].y, out[k].x, out[k].y);
    return l;
}

static rg_mesh mesh_of(rg_lines *l)
{
    rg_pattern *p = pattern_of(l);
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh m;
    rg_diag why;
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, &why), RG_OK);
    rg_pattern_destroy(p);
    return m;
}

static rg_mesh generated(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    return mesh_of(&l);
}

static rg_symmetry of(const rg_mesh *m)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_symmetry G;
    assert_int_equal(rg_symmetry_find(&G, &mem, m), RG_OK);
    return G;
}

static rg_vec2 by(const rg_symmetry *G, int32_t g, rg_vec2 d)
{
    return (rg_vec2){G->A[g][0][0] * d.x + G->A[g][0][1] * d.y, G->A[g][1][0] * d.x + G->A[g][1][1] * d.y};
}

static rg_vec2 centre(const rg_mesh *m, int32_t f)
{
    rg_vec2 sum = {0, 0};
    const int32_t n = m->facet_start[f + 1] - m->facet_start[f];
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
        sum.x += m->X[m->facet_vertex[j]].x / n, sum.y += m->X[m->facet_vertex[j]].y / n;
    return sum;
}

static void goes_there(const rg_symmetry *G, int32_t g, rg_vec2 from, rg_vec2 to, double tol)
{
    const rg_vec2 x = by(G, g, rg_vec2_sub(from, G->middle)), y = rg_vec2_sub(to, G->middle);
    near(x.x, y.x, tol);
    near(x.y, y.y, tol);
}

static void permutes(const int32_t *to, int32_t n)
{
    static unsigned char taken[MOST];
    assert_true(n <= MOST);
    memset(taken, 0, sizeof taken);
    for (int32_t i = 0; i < n; i++) {
        assert_in_range(to[i], 0, n - 1);
        assert_false(taken[to[i]]);
        taken[to[i]] = 1;
    }
}

/* Every element takes everything to what lies at its image, one to one; creases to those that fold alike. */
static void is_symmetry(const rg_symmetry *G, const rg_mesh *m, double tol)
{
    for (int32_t g = 0; g < G->order; g++) {
        const int32_t *vertex = G->vertex + (size_t)g * (size_t)m->nv, *edge = G->edge + (size_t)g * (size_t)m->ne;
        const int32_t *crease = G->crease + (size_t)g * (size_t)m->N, *facet = G->facet + (size_t)g * (size_t)m->nf;
        const double det = G->A[g][0][0] * G->A[g][1][1] - G->A[g][0][1] * G->A[g][1][0];
        near(det, g < G->turns ? 1 : -1, 1e-15);
        permutes(vertex, m->nv);
        permutes(edge, m->ne);
        permutes(crease, m->N);
        permutes(facet, m->nf);
        for (int32_t v = 0; v < m->nv; v++) goes_there(G, g, m->X[v], m->X[vertex[v]], tol);
        for (int32_t f = 0; f < m->nf; f++) goes_there(G, g, centre(m, f), centre(m, facet[f]), tol);
        for (int32_t e = 0; e < m->ne; e++) {
            const int32_t a = vertex[m->edge[e][0]], b = vertex[m->edge[e][1]], *to = m->edge[edge[e]];
            assert_true((to[0] == a && to[1] == b) || (to[0] == b && to[1] == a));
            assert_int_equal(m->assignment[edge[e]], m->assignment[e]);
        }
        for (int32_t i = 0; i < m->N; i++) assert_int_equal(m->crease_edge[crease[i]], edge[m->crease_edge[i]]);
    }
}

/* Turns and mirrors of a ring: all mirrors where it is not twisted. */
static void groups(void **state)
{
    (void)state;
    for (int n = 3; n <= 12; n++)
        for (int k = 0; k < 4; k++) {
            rg_lines l = ring(n, 0.3 * (k / 2), 0.1 * (k % 2), 0);
            rg_mesh m = mesh_of(&l);
            rg_symmetry G = of(&m);
            assert_int_equal(G.turns, n);
            assert_int_equal(G.order, k % 2 ? n : 2 * n);
            is_symmetry(&G, &m, 1e-12);
            int32_t orbits = 0;
            for (int32_t i = 0; i < m.N; i++) orbits += G.crease_orbit[i] == i;
            assert_int_equal(orbits, 2);
            rg_symmetry_free(&G);
            rg_mesh_free(&m);
        }
}

/* Off by less than a drawing by hand may be, the group is the same and its matrices are exact; by more there is none but
 * the mirror through the corner that is off along it. */
static void by_hand(void **state)
{
    (void)state;
    const double off[] = {1e-6, 4e-3, 0.2};
    for (int k = 0; k < 3; k++) {
        rg_lines l = ring(6, 0, 0, off[k]);
        rg_mesh m = mesh_of(&l);
        rg_symmetry G = of(&m);
        assert_int_equal(G.order, k < 2 ? 12 : 2);
        is_symmetry(&G, &m, k < 2 ? off[k] : 1e-12);
        for (int32_t g = 0; g < G.order; g++) { /* powers of the least turn */
            near(G.A[g][0][0] * G.A[g][0][0] + G.A[g][1][0] * G.A[g][1][0], 1, 1e-15);
            if (g < G.turns) near(atan2(G.A[g][1][0], G.A[g][0][0]), remainder(2 * RG_PI * g / G.turns, 2 * RG_PI), 1e-14);
        }
        rg_symmetry_free(&G);
        rg_mesh_free(&m);
    }
}

static int32_t divisors(int32_t n)
{
    int32_t count = 0;
    for (int32_t d = 1; d <= n; d++) count += n % d == 0;
    return count;
}

/* Every part is closed: the product of two of its elements, vertex by vertex, is one of it. */
static void parts(void **state)
{
    (void)state;
    for (int n = 3; n <= 8; n++) {
        rg_lines l = ring(n, 0.3, 0, 0);
        rg_mesh m = mesh_of(&l);
        rg_symmetry G = of(&m);
        rg_subgroup part[64];
        const int32_t count = rg_symmetry_subgroups(&G, part, 64);
        assert_int_equal(count, 2 * divisors(n) + (n % 2 ? 0 : divisors(n / 2)));
        assert_int_equal(part[0].order, 2 * n);
        assert_int_equal(part[1].order, n);
        assert_int_equal(part[1].mirror, -1);
        assert_int_equal(part[count - 1].order, 1);
        for (int32_t k = 0; k < count; k++) {
            rg_symmetry P;
            if (k) assert_true(part[k].order <= part[k - 1].order);
            assert_int_equal(rg_symmetry_part(&P, &G, part[k].every, part[k].mirror), RG_OK);
            assert_int_equal(P.order, part[k].order);
            is_symmetry(&P, &m, 1e-12);
            for (int32_t a = 0; a < P.order; a++)
                for (int32_t b = 0; b < P.order; b++) {
                    int found = 0;
                    for (int32_t c = 0; c < P.order; c++) {
                        int same = 1;
                        for (int32_t v = 0; v < m.nv; v++) same &= P.vertex[a * m.nv + P.vertex[b * m.nv + v]] == P.vertex[c * m.nv + v];
                        found += same;
                    }
                    assert_int_equal(found, 1);
                }
            rg_symmetry_free(&P);
        }
        rg_subgroup few[2];
        assert_int_equal(rg_symmetry_subgroups(&G, few, 2), 2);
        assert_memory_equal(few, part, sizeof few);
        rg_symmetry_free(&G);
        rg_mesh_free(&m);
    }
}

/* ------------------------------------------------------------------------------------------------------- cuts ---- */

static double area(const rg_mesh *m, int32_t f)
{
    double twice = 0;
    const int32_t first = m->facet_start[f];
    for (int32_t j = first + 1; j + 1 < m->facet_start[f + 1]; j++)
        twice += rg_vec2_turn(m->X[m->facet_vertex[first]], m->X[m->facet_vertex[j]], m->X[m->facet_vertex[j + 1]]);
    return twice / 2;
}

/* The same sheet, old numbers kept, no facet turned over, and the symmetry is that of what was cut. What the group does not
 * take to itself is cut into triangles. Returns how many creases were added. */
static int32_t cuts(const rg_mesh *m, const rg_symmetry *G, int shorter, double tol)
{
    rg_mesh t;
    rg_symmetry on;
    double was = 0, is = 0;
    assert_int_equal(rg_triangulate_orbits(m, G, NULL, shorter, &t), RG_OK);
    assert_int_equal(rg_symmetry_on(&on, G, &t), RG_OK);
    is_symmetry(&on, &t, tol);
    for (int32_t f = 0; f < m->nf; f++) was += area(m, f);
    for (int32_t f = 0; f < t.nf; f++) {
        assert_true(area(&t, f) > 0);
        is += area(&t, f);
        int fixed = 0;
        for (int32_t g = 1; g < G->order; g++) fixed |= on.facet[(size_t)g * (size_t)t.nf + (size_t)f] == f;
        if (!fixed) assert_int_equal(t.facet_start[f + 1] - t.facet_start[f], 3);
    }
    near(is, was, 1e-11 * was);
    assert_int_equal(t.nf - m->nf, t.added - m->added);
    assert_int_equal(t.N - m->N, t.added - m->added);
    assert_int_equal(t.M, m->M);
    assert_memory_equal(t.edge, m->edge, (size_t)m->ne * sizeof *m->edge);
    assert_memory_equal(t.crease_edge, m->crease_edge, (size_t)m->N * sizeof *m->crease_edge);
    const int32_t added = t.added;
    rg_symmetry_free(&on);
    rg_mesh_free(&t);
    return added;
}

static int32_t cuts_whole(rg_mesh *m, double tol)
{
    rg_symmetry G = of(m);
    const int32_t added = cuts(m, &G, 0, tol);
    cuts(m, &G, 1, tol);
    rg_symmetry_free(&G);
    rg_mesh_free(m);
    return added;
}

/* The polygon in the middle of a ring: under all its turns, and of its mirrors, it is whole where its diagonals cross their
 * images. The trapezoids round it stay whole under mirrors. */
static void rings(void **state)
{
    (void)state;
    for (int n = 3; n <= 12; n++)
        for (int k = 0; k < 4; k++) {
            rg_lines l = ring(n, 0.3 * (k / 2), 0.1 * (k % 2), 0);
            rg_mesh m = mesh_of(&l);
            /* with 4, 6, ... corners every other one can be cut off, though not by an orbit of all turns */
            assert_int_equal(cuts_whole(&m, 1e-12), k % 2 ? n : 0);
        }
}

/* Under half of its turns the polygon in the middle loses every other corner, and goes on as one of half as many. */
static void rings_by_parts(void **state)
{
    (void)state;
    for (int n = 4; n <= 12; n += 2) {
        rg_lines l = ring(n, 0.3, 0.1, 0);
        rg_mesh m = mesh_of(&l);
        rg_symmetry G = of(&m), P;
        assert_int_equal(rg_symmetry_part(&P, &G, 2, -1), RG_OK);
        const int32_t added = cuts(&m, &P, 0, 1e-12);
        assert_int_equal(added, n + (n == 4 ? 1 : n / 2)); /* of a square both ears have the same diagonal */
        rg_symmetry_free(&P);
        assert_int_equal(rg_symmetry_part(&P, &G, n, -1), RG_OK);
        assert_int_equal(cuts(&m, &P, 0, 1e-12), n + n - 3);
        rg_symmetry_free(&P);
        rg_symmetry_free(&G);
        rg_mesh_free(&m);
    }
}

/* Facets that a mirror takes to themselves: with corners on the line, beside it, and with corners that point inwards. Drawn
 * as a sheet with one crease far from it, so that the facet is what it is. */
static void across_a_mirror(void **state)
{
    (void)state;
    static const struct { int n; rg_vec2 x[12]; int32_t added; } half[] = {
        {3, {{0, 0}, {1, 0.5}, {0, 2}}, 1},                                       /* a kite */
        {2, {{1, 0}, {0.7, 1}}, 0},                                               /* a trapezoid */
        {3, {{1, 0}, {1.5, 1}, {0.7, 2}}, 1},                                     /* two trapezoids */
        {3, {{1, 0}, {0.3, 1}, {1.1, 2}}, 1},                                     /* with a waist: nothing can be cut off */
        {4, {{0, 0.5}, {1, 0}, {0.8, 1}, {0, 1.5}}, 2},                           /* an arrow head */
        {5, {{1, 0}, {1.7, 0.5}, {0.4, 1}, {1.2, 1.6}, {0.7, 2}}, 3},
    };
    for (size_t k = 0; k < sizeof half / sizeof *half; k++)
        for (int shorter = 0; shorter < 2; shorter++) {
            rg_lines l = drawing();
            rg_vec2 x[24];
            int n = 0;
            for (int i = 0; i < half[k].n; i++) x[n++] = half[k].x[i];
            for (int i = half[k].n - 1; i >= 0; i--)
                if (half[k].x[i].x > 0) x[n++] = (rg_vec2){-half[k].x[i].x, half[k].x[i].y};
            draw_polygon(&l, RG_MOUNTAIN, x, n);
            draw_box(&l, -3, -3, 3, 5);
            const int32_t low = half[k].x[0].x > 0 ? 0 : 1, right = low;
            draw(&l, RG_VALLEY, x[right].x, x[right].y, 3, -3);
            const int32_t left = half[k].x[0].x > 0 ? n - 1 : n - 1;
            draw(&l, RG_VALLEY, x[left].x, x[left].y, -3, -3);
            rg_mesh m = mesh_of(&l);
            rg_symmetry G = of(&m);
            assert_int_equal(G.order, 2);
            unsigned char which[8] = {0};
            for (int32_t f = 0; f < m.nf; f++) which[f] = m.facet_start[f + 1] - m.facet_start[f] == n && fabs(area(&m, f)) < 9;
            rg_mesh t;
            assert_int_equal(rg_triangulate_orbits(&m, &G, which, shorter, &t), RG_OK);
            if (t.added < half[k].added) print_error("%d: %d added\n", (int)k, t.added);
            assert_true(t.added >= half[k].added);
            rg_mesh_free(&t);
            cuts(&m, &G, shorter, 1e-12);
            rg_symmetry_free(&G);
            rg_mesh_free(&m);
        }
}

static void generated_ones(void **state)
{
    (void)state;
    static const struct { const char *kind; int n; } kinds[] = {{"miura", 6}, {"waterbomb", 4}, {"boxpleat", 4}, {"tatou", 0}, {"crane", 0},
                                                                 {"resch", 3}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        rg_mesh m = generated(kinds[k].kind, kinds[k].n);
        cuts_whole(&m, 1e-9 * m.size);
    }
    rg_mesh m = generated("boxpleat", 16);
    assert_int_equal(cuts_whole(&m, 1e-9 * m.size), 28);
}

/* With no symmetry, or none asked for, cuts are those that they always were. */
static void without(void **state)
{
    (void)state;
    rg_mesh m = generated("boxpleat", 4), a, b;
    rg_symmetry G = of(&m), one;
    assert_int_equal(rg_symmetry_part(&one, &G, G.turns, -1), RG_OK);
    for (int k = 0; k < 4; k++) {
        assert_int_equal(rg_triangulate_some(&m, NULL, k % 2, &a), RG_OK);
        assert_int_equal(rg_triangulate_orbits(&m, k / 2 ? &one : NULL, NULL, k % 2, &b), RG_OK);
        assert_int_equal(a.ne, b.ne);
        assert_int_equal(a.nf, b.nf);
        assert_memory_equal(a.edge, b.edge, (size_t)a.ne * sizeof *a.edge);
        assert_memory_equal(a.facet_vertex, b.facet_vertex, (size_t)a.facet_start[a.nf] * sizeof *a.facet_vertex);
        assert_memory_equal(a.facet_edge, b.facet_edge, (size_t)a.facet_start[a.nf] * sizeof *a.facet_edge);
        rg_mesh_free(&a);
        rg_mesh_free(&b);
    }
    rg_symmetry_free(&one);
    rg_symmetry_free(&G);
    rg_mesh_free(&m);
}

/* Of drawings by hand the images of a cut lie as their facets do. */
static void cuts_by_hand(void **state)
{
    (void)state;
    rg_lines l = ring(5, 0.3, 0.1, 4e-3);
    rg_mesh m = mesh_of(&l);
    assert_int_equal(cuts_whole(&m, 4e-3), 5);
}

/* Elements of one mesh on another with the same vertices, which they do not take to itself. */
static void elements_of_another_mesh(void **state)
{
    (void)state;
    rg_mesh m[2];
    for (int k = 0; k < 2; k++) {
        rg_lines l = drawing();
        draw_box(&l, -1, -1, 1, 1);
        for (int spoke = 0; spoke < (k ? 3 : 4); spoke++)
            draw(&l, RG_VALLEY, 0, 0, spoke % 3 ? 1 : -1, spoke / 2 ? 1 : -1);
        m[k] = mesh_of(&l);
        assert_int_equal(m[k].nv, 5);
        assert_memory_equal(m[k].X, m[0].X, 5 * sizeof *m[k].X);
    }
    rg_symmetry G = of(&m[0]), other;
    assert_int_equal(G.order, 8);
    assert_int_equal(rg_symmetry_on(&other, &G, &m[0]), RG_OK);
    rg_symmetry_free(&other);
    assert_int_equal(rg_symmetry_on(&other, &G, &m[1]), RG_EARG);
    assert_int_equal(other.order, 0);
    rg_symmetry_free(&G);
    for (int k = 0; k < 2; k++) rg_mesh_free(&m[k]);
}

/* ------------------------------------------------------------------------------------------------------ means ---- */

static void means(void **state)
{
    (void)state;
    unsigned seed = 7;
    for (int n = 3; n <= 12; n++) {
        rg_lines l = ring(n, 0.3, 0, 0);
        rg_mesh m = mesh_of(&l);
        rg_symmetry G = of(&m);
        double x[MOST], again[MOST], sum = 0, mean = 0;
        rg_vec2 d[MOST], twice[MOST];
        for (int32_t i = 0; i < m.N; i++) sum += x[i] = noise(&seed);
        for (int32_t v = 0; v < m.nv; v++) d[v] = (rg_vec2){noise(&seed), noise(&seed)};
        assert_true(rg_symmetry_off(&G, x) > 0.1);
        rg_symmetry_mean(&G, x);
        near(rg_symmetry_off(&G, x), 0, 0);
        for (int32_t i = 0; i < m.N; i++) mean += x[i];
        near(mean, sum, 1e-13 * m.N);
        memcpy(again, x, sizeof x);
        rg_symmetry_mean(&G, again);
        assert_memory_equal(again, x, (size_t)m.N * sizeof *x);
        rg_symmetry_mean_vectors(&G, d);
        for (int32_t g = 0; g < G.order; g++)
            for (int32_t v = 0; v < m.nv; v++) {
                const rg_vec2 there = d[G.vertex[g * m.nv + v]], turned = by(&G, g, d[v]);
                near(there.x, turned.x, 1e-14);
                near(there.y, turned.y, 1e-14);
            }
        memcpy(twice, d, sizeof d);
        rg_symmetry_mean_vectors(&G, twice);
        for (int32_t v = 0; v < m.nv; v++) {
            near(twice[v].x, d[v].x, 1e-14);
            near(twice[v].y, d[v].y, 1e-14);
        }
        x[1] = NAN;
        assert_true(isnan(rg_symmetry_off(&G, x)));
        rg_symmetry_free(&G);
        rg_mesh_free(&m);
    }
}

/* What is moved with the group is its own mean: a vertex goes outwards by its distance. */
static void means_keep_what_is_alike(void **state)
{
    (void)state;
    rg_lines l = ring(7, 0.3, 0, 0);
    rg_mesh m = mesh_of(&l);
    rg_symmetry G = of(&m);
    rg_vec2 d[MOST];
    for (int32_t v = 0; v < m.nv; v++) d[v] = rg_vec2_sub(m.X[v], G.middle);
    rg_symmetry_mean_vectors(&G, d);
    for (int32_t v = 0; v < m.nv; v++) {
        near(d[v].x, m.X[v].x - G.middle.x, 1e-14);
        near(d[v].y, m.X[v].y - G.middle.y, 1e-14);
    }
    rg_symmetry_free(&G);
    rg_mesh_free(&m);
}

static void memory_runs_short(void **state)
{
    (void)state;
    rg_lines l = ring(6, 0.3, 0, 0);
    rg_mesh m = mesh_of(&l), t;
    counted c = {.left = 1000000};
    const rg_memory mem = {counted_resize, &c};
    rg_symmetry G, P;
    rg_status s = RG_ENOMEM;
    for (long k = 0; s == RG_ENOMEM; k++) {
        c.left = k;
        s = rg_symmetry_find(&G, &mem, &m);
        if (s == RG_ENOMEM) assert_int_equal(c.out, 0);
        assert_true(k < 200);
    }
    assert_int_equal(s, RG_OK);
    const long held = c.out;
    s = RG_ENOMEM;
    for (long k = 0; s == RG_ENOMEM; k++) {
        c.left = k;
        s = rg_symmetry_part(&P, &G, 2, 0);
        if (s == RG_ENOMEM) assert_int_equal(c.out, held);
    }
    assert_int_equal(s, RG_OK);
    const long both = c.out;
    rg_mesh counted_mesh = m;
    counted_mesh.mem = mem;
    s = RG_ENOMEM;
    for (long k = 0; s == RG_ENOMEM; k++) {
        c.left = k;
        s = rg_triangulate_orbits(&counted_mesh, &P, NULL, 0, &t);
        if (s == RG_ENOMEM) assert_int_equal(c.out, both);
        assert_true(k < 400);
    }
    assert_int_equal(s, RG_OK);
    rg_mesh_free(&t);
    rg_symmetry_free(&P);
    rg_symmetry_free(&G);
    assert_int_equal(c.out, 0);
    rg_mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups),          cmocka_unit_test(by_hand),        cmocka_unit_test(parts),
        cmocka_unit_test(rings),           cmocka_unit_test(rings_by_parts), cmocka_unit_test(across_a_mirror),
        cmocka_unit_test(generated_ones),  cmocka_unit_test(without),        cmocka_unit_test(cuts_by_hand),  cmocka_unit_test(elements_of_another_mesh),
        cmocka_unit_test(means),           cmocka_unit_test(means_keep_what_is_alike),
        cmocka_unit_test(memory_runs_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
