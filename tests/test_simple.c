/* layers/simple: taking flat-folded sheets apart, against all the ways there are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "draw.h"
#include "by_hand.h"
#include "stacked.h"
#include "layers/simple.h"

static rg_layers *layers_of(rg_pattern *p)
{
    rg_layers *l = NULL;
    rg_diag why = {0, ""};
    assert_int_equal(rg_layers_create(p, NULL, &l, &why), RG_OK);
    assert_int_equal(l->info.state, RG_LAYERS_VALID);
    return l;
}

/* ---- brute force: every set of facets, on either side of every line, up and down, one after the other in every order */

enum { MOST_FACETS = 12, MOST_STATES = 4000 };

typedef struct flat_state { unsigned folded; signed char above[MOST_FACETS][MOST_FACETS]; } flat_state;

typedef struct all_ways {
    const rg_mesh *m;
    const double *angle;
    flat_state *seen;
    int count, least;
} all_ways;

static double off_line(rg_vec2 a, rg_vec2 b, rg_vec2 x) { return rg_vec2_turn(a, b, x) / rg_vec2_length(rg_vec2_sub(b, a)); }

/* Convex facets overlap where no side of either parts them. */
static int overlap(const stacked *s, int32_t f, int32_t g)
{
    for (int k = 0; k < 2; k++) {
        const int32_t p = k ? g : f, q = k ? f : g, n = s->m->facet_start[p + 1] - s->m->facet_start[p];
        for (int32_t i = 0; i < n; i++) {
            const rg_vec2 a = s->x[p][i], b = s->x[p][(i + 1) % n];
            double most = -INFINITY;
            for (int32_t j = 0; j < s->m->facet_start[q + 1] - s->m->facet_start[q]; j++)
                most = fmax(most, (s->flipped[p] ? -1 : 1) * off_line(a, b, s->x[q][j]));
            if (most <= 1e-9) return 0;
        }
    }
    return 1;
}

static void try_all(all_ways *w, const flat_state *now);

/* May the facets of `set` turn about the line a b? Then on from there. */
static void turn(all_ways *w, const flat_state *now, const stacked *s, unsigned set, rg_vec2 a, rg_vec2 b, int up)
{
    const rg_mesh *m = w->m;
    flat_state next = *now;
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t e = m->crease_edge[i], f = m->edge_facet[e][0], g = m->edge_facet[e][1];
        if ((set >> f & 1) == (set >> g & 1)) continue;
        if (!(now->folded >> i & 1)) return;
        for (int32_t j = 0; j < m->facet_start[f + 1] - m->facet_start[f]; j++) {
            const int32_t v = m->facet_vertex[m->facet_start[f] + j];
            if ((v == m->edge[e][0] || v == m->edge[e][1]) && fabs(off_line(a, b, s->x[f][j])) > 1e-9) return;
        }
        next.folded &= ~(1u << i);
    }
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t g = 0; g < m->nf; g++) {
            const int mine = set >> f & 1, its = set >> g & 1;
            if (mine && !its && now->above[f][g] == up && overlap(s, f, g)) return;
            if (mine && its) next.above[f][g] = (signed char)-now->above[f][g];
            else if (mine != its) next.above[f][g] = (signed char)(its ? up : -up);
        }
    try_all(w, &next);
}

static void try_all(all_ways *w, const flat_state *now)
{
    const rg_mesh *m = w->m;
    for (int k = 0; k < w->count; k++)
        if (memcmp(&w->seen[k], now, sizeof *now) == 0) return;
    if (w->count == MOST_STATES) fail_msg("more than %d states", MOST_STATES);
    w->seen[w->count++] = *now;
    int left = 0;
    for (int32_t i = 0; i < m->N; i++) left += now->folded >> i & 1;
    if (left < w->least) w->least = left;
    double *angle = calloc((size_t)m->N, sizeof *angle);
    for (int32_t i = 0; i < m->N; i++) angle[i] = now->folded >> i & 1 ? w->angle[i] : 0;
    stacked s;
    stacked_init(&s, m, angle);
    for (int32_t i = 0; i < m->N; i++) {
        if (!(now->folded >> i & 1)) continue;
        const int32_t e = m->crease_edge[i], f = m->edge_facet[e][0];
        rg_vec2 end[2] = {{0, 0}, {0, 0}};
        for (int32_t j = 0; j < m->facet_start[f + 1] - m->facet_start[f]; j++)
            for (int k = 0; k < 2; k++)
                if (m->facet_vertex[m->facet_start[f] + j] == m->edge[e][k]) end[k] = s.x[f][j];
        for (int side = -1; side <= 1; side += 2) {
            unsigned there = 0;
            for (int32_t g = 0; g < m->nf; g++) {
                double least = INFINITY;
                for (int32_t j = 0; j < m->facet_start[g + 1] - m->facet_start[g]; j++) least = fmin(least, side * off_line(end[0], end[1], s.x[g][j]));
                if (least >= -1e-9) there |= 1u << g;
            }
            for (unsigned set = there; set; set = (set - 1) & there) /* every set of them */
                for (int up = -1; up <= 1 && set != (1u << m->nf) - 1; up += 2) turn(w, now, &s, set, end[0], end[1], up);
        }
    }
    stacked_free(&s);
    free(angle);
}

/* The fewest creases that any way of undoing simple folds leaves, for the order chosen. */
static int brute_force(const rg_layers *l, const double *angle)
{
    static flat_state seen[MOST_STATES];
    flat_state begin = {0};
    all_ways w = {&l->mesh, angle, seen, 0, 99};
    assert_true(l->mesh.nf <= MOST_FACETS && l->mesh.N <= 32);
    for (int32_t i = 0; i < l->mesh.N; i++) begin.folded |= (unsigned)(angle[i] != 0) << i;
    for (int32_t f = 0; f < l->mesh.nf; f++)
        for (int32_t g = 0; g < l->mesh.nf; g++) begin.above[f][g] = (signed char)rg_layers_above(l, f, g);
    try_all(&w, &begin);
    return w.least;
}

static double *angles(const rg_mesh *m)
{
    double *angle = calloc((size_t)m->N, sizeof *angle);
    for (int32_t i = 0; i < m->N; i++) angle[i] = m->target[m->crease_edge[i]];
    return angle;
}

/* All orders, up to some. Returns the least that is left in any. */
static int compare(rg_pattern *p, int most_orders)
{
    rg_layers *l = layers_of(p);
    const rg_memory mem = rg_mem_default(NULL);
    uint64_t *which = calloc((size_t)l->parts.count + 1, sizeof *which);
    double *angle = angles(&l->mesh);
    int least = 99;
    for (int k = 0; k < most_orders && rg_layers_which(l, (uint64_t)k, which) == RG_OK; k++) {
        rg_simple q;
        assert_int_equal(rg_layers_choose(l, which), RG_OK);
        assert_int_equal(rg_simple_find(&q, &mem, l, NULL), RG_OK);
        const int brute = brute_force(l, angle);
        if (q.base != brute) fail_msg("%d creases are left, %d need not be; order %d of %s", (int)q.base, brute, k, l->info.count);
        if (q.base < least) least = q.base;
        rg_simple_free(&q);
    }
    free(angle);
    free(which);
    rg_layers_destroy(l);
    return least;
}

/* ---- patterns */

static rg_pattern *strip(const char *folds, double wide)
{
    rg_lines l = drawing();
    const int n = (int)strlen(folds);
    draw_box(&l, 0, 0, (n + 1) * wide, 1);
    for (int i = 0; i < n; i++) draw(&l, folds[i], (i + 1) * wide, 0, (i + 1) * wide, 1);
    return pattern_of(&l);
}

/* A strip of stamps folds up by simple folds if it folds at all (Arkin et al.). */
static void strips(void **state)
{
    (void)state;
    static const char *const folds[] = {"V", "VM", "VV", "VMV", "VVM", "VVV", "MVVM", "VMVMVM", "VVMMVV", "MMVVM", "VVVVV", "MVMMV"};
    for (size_t i = 0; i < sizeof folds / sizeof *folds; i++) {
        rg_pattern *p = strip(folds[i], 0.375);
        assert_int_equal(compare(p, 12), 0);
        rg_pattern_destroy(p);
    }
}

/* All layers over a line, three times: whatever comes of it comes apart again. */
static void any_folds(void **state)
{
    (void)state;
    unsigned seed = 7;
    int checked = 0;
    for (int k = 0; k < 40; k++) {
        by_hand h;
        by_hand_any(&h, 1 + k % 3, &seed);
        rg_pattern *p = pattern_of(&h.lines);
        if (h.n > MOST_FACETS) {
            rg_pattern_destroy(p);
            continue;
        }
        assert_int_equal(compare(p, 6), 0);
        checked++;
        rg_pattern_destroy(p);
    }
    assert_true(checked >= 30);
}

/* A preliminary base has no simple fold; what is folded on from it comes off. */
static void bases(void **state)
{
    (void)state;
    static const struct { const char *path; int left; } known[] = {{"patterns/preliminary.opx", 6}, {"patterns/waterbomb-base.opx", 6}, {"patterns/fish.opx", 8}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        rg_pattern *p = NULL;
        rg_diag why;
        assert_int_equal(rg_pattern_read(known[i].path, NULL, &p, &why), RG_OK);
        assert_int_equal(compare(p, 4), known[i].left);
        rg_pattern_destroy(p);
    }
}

typedef struct table { int32_t nf; const signed char *above; } table;

static int by_table(const void *ctx, int32_t f, int32_t g)
{
    const table *t = ctx;
    return t->above[(size_t)f * (size_t)t->nf + (size_t)g];
}

/* Of larger ones: stages follow each other, each crease has one, and the order of what is left is one that paper can have. */
static void what_is_left_is_valid(void **state)
{
    (void)state;
    unsigned seed = 11;
    const rg_memory mem = rg_mem_default(NULL);
    int some = 0;
    for (int k = 0; k < 12; k++) {
        by_hand h;
        by_hand_any(&h, 4, &seed);
        rg_pattern *p = pattern_of(&h.lines);
        rg_layers *l = layers_of(p);
        rg_simple q;
        assert_int_equal(rg_layers_choose(l, NULL), RG_OK);
        assert_int_equal(rg_simple_find(&q, &mem, l, NULL), RG_OK);
        double *angle = angles(&l->mesh);
        int made = 0, last = 1;
        for (int32_t i = 0; i < q.folds; i++) {
            made += q.fold[i].creases;
            assert_true(q.fold[i].stage == last || q.fold[i].stage == last + 1);
            last = q.fold[i].stage;
        }
        assert_int_equal(q.folds ? last : 0, q.stages);
        assert_int_equal(made + q.base, l->mesh.N);
        for (int32_t i = 0; i < l->mesh.N; i++)
            if (q.stage[l->mesh.crease_edge[i]] > 0) angle[i] = 0;
        stacked s;
        stacked_init(&s, &l->mesh, angle);
        const table t = {q.nf, q.above};
        /* Seen with facet 0's front up, the order may be the other way round. */
        table turned = t;
        signed char *other = calloc((size_t)q.nf * (size_t)q.nf, 1);
        for (size_t i = 0; i < (size_t)q.nf * (size_t)q.nf; i++) other[i] = (signed char)-q.above[i];
        turned.above = other;
        if (!stacked_is_valid(&s, by_table, &t, 300, 6, 1e-4, 5) && !stacked_is_valid(&s, by_table, &turned, 300, 6, 1e-4, 5))
            fail_msg("%s: %d %d %d %d", s.what, (int)s.wrong[0], (int)s.wrong[1], (int)s.wrong[2], (int)s.wrong[3]);
        some += q.base > 0;
        stacked_free(&s);
        free(other);
        free(angle);
        rg_simple_free(&q);
        rg_layers_destroy(l);
        rg_pattern_destroy(p);
    }
    print_message("%d of 12 leave something in their first order\n", some);
}

/* Non-zero from the time on that it has been asked so often. */
static int enough(void *left) { return --*(int *)left < 0; }

/* Ended before the k-th question, k = 0, 1, 2, ..., there are none; else they are the same. */
static void ended_at_any_time(void **state)
{
    (void)state;
    rg_pattern *p = strip("VVMMV", 0.5);
    rg_layers *l = layers_of(p);
    rg_simple all;
    int asked = 0;
    assert_int_equal(rg_layers_choose(l, NULL), RG_OK);
    const rg_memory usual = rg_mem_default(NULL);
    assert_int_equal(rg_simple_find(&all, &usual, l, NULL), RG_OK);
    assert_true(all.folds > 1);
    for (int ended = 1; ended; asked++) {
        counted c = {1000000, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        int left = asked;
        rg_simple q;
        assert_int_equal(rg_simple_find(&q, &mem, l, &(rg_stop){enough, &left}), RG_OK);
        ended = left < 0;
        assert_int_equal(q.folds, ended ? 0 : all.folds);
        for (int32_t k = 0; k < q.folds; k++) assert_int_equal(q.fold[k].stage, all.fold[k].stage);
        rg_simple_free(&q);
        assert_int_equal(c.out, 0);
    }
    assert_true(asked > 10);
    rg_simple_free(&all);
    rg_layers_destroy(l);
    rg_pattern_destroy(p);
}

static void starves(void **state)
{
    (void)state;
    rg_pattern *p = strip("VVM", 0.5);
    rg_layers *l = layers_of(p);
    assert_int_equal(rg_layers_choose(l, NULL), RG_OK);
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        rg_simple q;
        const rg_status s = rg_simple_find(&q, &mem, l, NULL);
        rg_simple_free(&q);
        assert_int_equal(c.out, 0);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
    }
    rg_layers_destroy(l);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(strips), cmocka_unit_test(any_folds), cmocka_unit_test(bases),
                                       cmocka_unit_test(what_is_left_is_valid), cmocka_unit_test(starves),
                                       cmocka_unit_test(ended_at_any_time)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
