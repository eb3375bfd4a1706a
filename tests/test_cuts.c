/* motion/cuts.c: which facet an added crease belongs to, found again by where it lies; what is cut next is what was asked for. */
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
#include "motion/cuts.h"

enum { FRAMES = 2, MOST = 400 };

static rg_mesh generated(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    rg_pattern *p = pattern_of(&l);
    const rg_mesh m = mesh_of(p);
    rg_pattern_destroy(p);
    return m;
}

static int is_corner(const rg_mesh *m, int32_t f, int32_t v)
{
    for (int32_t k = m->facet_start[f]; k < m->facet_start[f + 1]; k++)
        if (m->facet_vertex[k] == v) return 1;
    return 0;
}

/* The facet that a diagonal lies in: the one that has both its ends. */
static int32_t facet_of(const rg_mesh *none, const int32_t e[2])
{
    int32_t found = -1;
    for (int32_t f = 0; f < none->nf; f++)
        if (is_corner(none, f, e[0]) && is_corner(none, f, e[1])) {
            assert_int_equal(found, -1);
            found = f;
        }
    return found;
}

/* Each crease bends by its own number of milliradians, as 7919 is prime, in one frame this way, in the next one half as much the other way. */
static rg_attempt bent(const rg_mesh *none, const unsigned char *which)
{
    rg_attempt t = {.mem = rg_mem_default(NULL), .count = FRAMES};
    assert_int_equal(which ? rg_triangulate_some(none, which, 0, &t.mesh) : rg_triangulate_all(none, &t.mesh), RG_OK);
    t.rho = rg_mem_array(&t.mem, FRAMES * (size_t)t.mesh.N, sizeof *t.rho);
    assert_non_null(t.rho);
    for (int32_t i = 0; i < t.mesh.N; i++) {
        t.rho[i] = -1e-3 * (1 + (7919 * i) % t.mesh.N);
        t.rho[t.mesh.N + i] = -t.rho[i] / 2;
    }
    return t;
}

static void measured(const rg_cuts *c, const rg_attempt *t)
{
    double bend[MOST];
    int32_t n = 0;
    assert_true(c->none->nf <= MOST);
    for (int32_t f = 0; f < c->none->nf; f++) bend[f] = -1;
    for (int32_t i = t->mesh.N - t->mesh.added; i < t->mesh.N; i++) {
        double *of = &bend[facet_of(c->none, t->mesh.edge[t->mesh.crease_edge[i]])];
        *of = fmax(*of, fabs(t->rho[i]));
    }
    for (int32_t f = 0; f < c->none->nf; f++) {
        near(c->bend[f], bend[f], 0);
        n += bend[f] >= 0;
    }
    assert_int_equal(c->bends, n);
}

static int32_t count(const rg_cuts *c)
{
    int32_t n = 0;
    for (int32_t f = 0; f < c->none->nf; f++) n += c->which[f] != 0;
    assert_int_equal(c->cut, n);
    return n;
}

/* Each time what bends least is left whole, and what is left of it is measured anew. */
static void by_bending(void **state)
{
    (void)state;
    static const struct { const char *kind; int32_t n; } made[] = {{"miura", 5}, {"tatou", 0}, {"boxpleat", 6}, {"random", 6}};
    const rg_memory mem = rg_mem_default(NULL);
    for (int k = 0; k < 4; k++) {
        const rg_mesh none = generated(made[k].kind, made[k].n);
        rg_mesh drawn = none;
        rg_attempt t = bent(&none, NULL);
        rg_cuts c;
        assert_int_equal(rg_cuts_init(&c, &mem, &none, NULL, &t), RG_OK);
        measured(&c, &t);
        for (int round = 0; round < 4 && c.bends > 1; round++) {
            const int32_t had = c.bends;
            double least = INFINITY, most = 0;
            rg_cuts_all_but(&c, had / 3 + 1);
            assert_int_equal(count(&c), had - had / 3 - 1);
            for (int32_t f = 0; f < none.nf; f++) {
                if (c.which[f]) least = fmin(least, c.bend[f]);
                else most = fmax(most, c.bend[f]);
            }
            assert_true(most <= least);
            rg_cuts_bending(&c, least);
            assert_int_equal(count(&c), had - had / 3 - 1);
            rg_cuts_bending(&c, nextafter(least, 1e9));
            assert_true(count(&c) < had - had / 3 - 1);
            rg_cuts_all_but(&c, had / 3 + 1);
            rg_attempt_free(&t);
            t = bent(&none, c.which);
            rg_cuts_measure(&c, &t);
            measured(&c, &t);
        }
        rg_cuts_all_but(&c, none.nf + 1);
        assert_int_equal(count(&c), 0);
        rg_attempt_free(&t);
        rg_cuts_free(&c);
        rg_cuts_free(&c);
        rg_mesh_free(&drawn);
    }
}

static void around_vertices(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh none = generated("boxpleat", 6);
    rg_attempt t = bent(&none, NULL);
    rg_cuts c;
    assert_int_equal(rg_cuts_init(&c, &mem, &none, NULL, &t), RG_OK);
    rg_cuts_around(&c, none.inner_vertex, 0);
    assert_int_equal(count(&c), 0);
    const int32_t at[2] = {none.inner_vertex[1], none.inner_vertex[none.M - 1]};
    rg_cuts_around(&c, at, 2);
    assert_true(count(&c) > 0 && c.cut < c.bends);
    for (int32_t f = 0; f < none.nf; f++) {
        const int quad = none.facet_start[f + 1] - none.facet_start[f] > 3;
        assert_int_equal(c.which[f] != 0, quad && (is_corner(&none, f, at[0]) || is_corner(&none, f, at[1])));
    }
    rg_cuts_free(&c);
    rg_attempt_free(&t);
    rg_mesh_free(&none);
}

/* By orbit: a facet bends as the one of its orbit does that bends most, and is cut with all of them or not at all. */
static void by_orbit(void **state)
{
    (void)state;
    static const struct { const char *kind; int32_t n; } made[] = {{"miura", 6}, {"tatou", 0}, {"boxpleat", 16}, {"crane", 0}};
    const rg_memory mem = rg_mem_default(NULL);
    for (int k = 0; k < 4; k++) {
        rg_mesh none = generated(made[k].kind, made[k].n);
        rg_symmetry G;
        rg_attempt t = {.mem = mem, .count = 1};
        rg_cuts c;
        double bend[MOST];
        assert_int_equal(rg_symmetry_find(&G, &mem, &none), RG_OK);
        assert_true(G.order > 1);
        assert_int_equal(rg_triangulate_orbits(&none, &G, NULL, 0, &t.mesh), RG_OK);
        assert_true(t.mesh.added > 0);
        t.rho = rg_mem_array(&t.mem, (size_t)t.mesh.N, sizeof *t.rho);
        assert_non_null(t.rho);
        for (int32_t f = 0; f < none.nf; f++) bend[f] = -1;
        for (int32_t i = 0; i < t.mesh.N; i++) {
            t.rho[i] = -1e-3 * (1 + (7919 * i) % t.mesh.N);
            if (i < none.N) continue;
            double *of = &bend[facet_of(&none, t.mesh.edge[t.mesh.crease_edge[i]])];
            *of = fmax(*of, fabs(t.rho[i]));
        }
        for (int32_t g = 1; g < G.order; g++) /* the most of an orbit spreads to all of it */
            for (int round = 0; round < 3; round++)
                for (int32_t f = 0; f < none.nf; f++) {
                    double *of = &bend[G.facet[g * none.nf + f]];
                    *of = bend[f] = fmax(*of, bend[f]);
                }
        assert_int_equal(rg_cuts_init(&c, &mem, &none, &G, &t), RG_OK);
        for (int32_t f = 0; f < none.nf; f++) near(c.bend[f], bend[f], 0);
        for (int32_t n = 0; n <= c.bends; n++) {
            rg_cuts_all_but(&c, n);
            assert_true(count(&c) <= c.bends - n && count(&c) > c.bends - n - G.order);
            for (int32_t f = 0; f < none.nf; f++) assert_int_equal(c.which[f] != 0, c.which[G.facet_orbit[f]] != 0);
        }
        rg_cuts_around(&c, none.inner_vertex, 1);
        for (int32_t f = 0; f < none.nf; f++) {
            int at = 0;
            for (int32_t g = 0; g < G.order; g++) at |= is_corner(&none, G.facet[g * none.nf + f], none.inner_vertex[0]);
            assert_int_equal(c.which[f] != 0, at && bend[f] >= 0);
        }
        count(&c);
        rg_cuts_free(&c);
        rg_attempt_free(&t);
        rg_symmetry_free(&G);
        rg_mesh_free(&none);
    }
}

static void memory(void **state)
{
    (void)state;
    counted n = {0, 0, 0};
    const rg_memory mem = {counted_resize, &n};
    rg_mesh none = generated("tatou", 0);
    rg_attempt t = bent(&none, NULL);
    rg_cuts c;
    for (long k = 0;; k++) {
        n.left = k;
        const rg_status s = rg_cuts_init(&c, &mem, &none, NULL, &t);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(n.out, 0);
    }
    rg_cuts_free(&c);
    assert_int_equal(n.out, 0);
    rg_attempt_free(&t);
    rg_mesh_free(&none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_bending), cmocka_unit_test(around_vertices), cmocka_unit_test(by_orbit),
                                       cmocka_unit_test(memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
