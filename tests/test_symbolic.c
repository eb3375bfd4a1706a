/* Orders and patterns of factors, against elimination on a dense matrix of yes and no, and against what textbooks promise. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

#include <cmocka.h>

#include "counted.h"
#include "linalg/dissect.h"
#include "linalg/separator.h"
#include "linalg/symbolic.h"
#include "near.h"

/* A symmetric pattern: rows of the upper triangle by columns, or of both; without the diagonal where that is asked for. */
typedef struct pattern { int32_t n, *start, *row; } pattern;

static void pattern_free(pattern *p)
{
    free(p->start);
    free(p->row);
}

typedef int joined(const void *ctx, int32_t i, int32_t j);

static pattern pattern_of(int32_t n, joined *has, const void *ctx, int upper, int diagonal)
{
    pattern p = {n, calloc((size_t)n + 1, sizeof(int32_t)), NULL};
    size_t room = 0, at = 0;
    for (int32_t j = 0; j < n; j++) {
        for (int32_t i = 0; i < (upper ? j + 1 : n); i++) {
            if (i == j ? !diagonal : !has(ctx, i, j)) continue;
            if (at == room) p.row = realloc(p.row, (room = 2 * room + 64) * sizeof *p.row);
            p.row[at++] = i;
        }
        p.start[j + 1] = (int32_t)at;
    }
    return p;
}

static int by_matrix(const void *ctx, int32_t i, int32_t j)
{
    const unsigned char *const *a = ctx;
    return a[i][j];
}

/* The neighbours of each vertex of a grid of side x side, eight at the most, and itself. */
static pattern grid(int32_t side, int itself)
{
    const size_t n = (size_t)side * (size_t)side;
    pattern p = {side * side, calloc(n + 1, sizeof(int32_t)), calloc(9 * n, sizeof(int32_t))};
    int32_t at = 0;
    for (int32_t y = 0; y < side; y++)
        for (int32_t x = 0; x < side; x++) {
            for (int32_t v = y - 1; v <= y + 1; v++)
                for (int32_t u = x - 1; u <= x + 1; u++)
                    if (v >= 0 && v < side && u >= 0 && u < side && (itself || u != x || v != y)) p.row[at++] = v * side + u;
            p.start[y * side + x + 1] = at;
        }
    return p;
}

enum { MOST = 120 };
static unsigned char A[MOST][MOST];

static void clear(void) { memset(A, 0, sizeof A); }
static void join(int32_t i, int32_t j) { A[i][j] = A[j][i] = 1; }

/* What S says, against eliminating one unknown after the other. */
static void compare(int32_t n, const rg_symbolic *S)
{
    static unsigned char L[MOST][MOST];
    int32_t at[MOST];
    assert_int_equal(S->n, n);
    for (int32_t i = 0; i < n; i++) at[i] = -1;
    for (int32_t i = 0; i < n; i++) {
        assert_in_range(S->place[i], 0, n - 1);
        assert_int_equal(at[S->place[i]], -1);
        at[S->place[i]] = i;
    }
    for (int32_t i = 0; i < n; i++)
        for (int32_t j = 0; j < n; j++) L[i][j] = i == j || A[at[i]][at[j]];
    double flops = 0, entries = 0;
    for (int32_t k = 0; k < n; k++) {
        double below = 0;
        for (int32_t i = k; i < n; i++) {
            below += L[i][k];
            for (int32_t j = k + 1; j < n; j++) L[i][j] |= L[i][k] && L[j][k];
        }
        entries += below;
        flops += below * below;
    }
    near(S->entries, entries, 0);
    near(S->flops, flops, 0);
    assert_int_equal(S->column[0], 0);
    assert_int_equal(S->column[S->count], n);
    assert_int_equal(S->start[0], 0);
    assert_int_equal(S->panel[0], 0);
    for (int32_t s = 0; s < S->count; s++) {
        const int32_t wide = S->column[s + 1] - S->column[s], tall = S->start[s + 1] - S->start[s], *row = S->row + S->start[s];
        assert_true(wide > 0 && tall >= wide);
        assert_int_equal(S->panel[s + 1] - S->panel[s], wide * rg_symbolic_stride(S, s));
        assert_in_range(rg_symbolic_stride(S, s), tall, tall + 3);
        assert_int_equal(rg_symbolic_stride(S, s) % 4, 0);
        for (int32_t i = 0; i < wide; i++) assert_int_equal(row[i], S->column[s] + i);
        for (int32_t i = 1; i < tall; i++) assert_true(row[i] > row[i - 1]);
        assert_true(row[tall - 1] < n);
        for (int32_t k = S->column[s]; k < S->column[s + 1]; k++) {
            assert_int_equal(S->of[k], s);
            for (int32_t i = k, r = 0; i < n; i++) { /* each number of L has its place */
                if (!L[i][k]) continue;
                while (r < tall && row[r] < i) r++;
                assert_true(r < tall && row[r] == i);
            }
        }
        for (int32_t i = wide; i < tall; i++) { /* and each row is there for one column at the least */
            int found = 0;
            for (int32_t k = S->column[s]; k < S->column[s + 1]; k++) found |= L[row[i]][k];
            assert_true(found);
        }
    }
}

static void check(int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    const unsigned char *rows[MOST];
    for (int32_t i = 0; i < n; i++) rows[i] = A[i];
    for (int k = 0; k < 3; k++) {
        pattern p = pattern_of(n, by_matrix, rows, k > 0, k < 2);
        rg_symbolic S;
        assert_int_equal(rg_symbolic_init(&S, &mem, n, p.start, p.row), RG_OK);
        compare(n, &S);
        rg_symbolic_free(&S);
        pattern_free(&p);
    }
}

static void patterns_are_those_of_elimination(void **state)
{
    (void)state;
    unsigned seed = 3;
    for (int trial = 0; trial < 60; trial++) {
        const int32_t n = 1 + trial * 2;
        const double few = trial % 4 == 0 ? 0.5 : trial % 4 == 1 ? 1.5 : trial % 4 == 2 ? 3 : 20; /* neighbours */
        clear();
        for (int32_t i = 0; i < n; i++)
            for (int32_t j = 0; j < i; j++)
                if (noise(&seed) > 1 - 2 * few / n) join(i, j);
        check(n);
    }
}

static void particular_patterns(void **state)
{
    (void)state;
    clear(); /* none */
    check(0);
    check(1);
    check(7);
    for (int32_t i = 1; i < 50; i++) join(i - 1, i); /* a path, a ring, a star, a tree, all, three cliques in a row */
    check(50);
    join(0, 49);
    check(50);
    clear();
    for (int32_t i = 0; i < 60; i++)
        if (i != 17) join(17, i);
    check(60);
    clear();
    for (int32_t i = 1; i < 100; i++) join(i, (i - 1) / 3);
    check(100);
    clear();
    for (int32_t i = 0; i < 40; i++)
        for (int32_t j = 0; j < i; j++) join(i, j);
    check(40);
    clear();
    for (int32_t i = 0; i < 60; i++)
        for (int32_t j = 0; j < i; j++)
            if (i / 20 == j / 20 || (i % 20 == 0 && i - j == 1)) join(i, j);
    check(60);
}

/* George's dissection of a grid of m x m, along its lines, takes 829/84 m^3 multiplications, and as many additions; without
 * knowing where vertices lie that is come by within a twentieth. */
static void a_large_grid_costs_what_dissection_promises(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    const double side = 240;
    pattern p = grid((int32_t)side, 1);
    rg_symbolic S, again;
    assert_int_equal(rg_symbolic_init(&S, &mem, p.n, p.start, p.row), RG_OK);
    below(S.flops, 1.05 * 2 * 829.0 / 84 * side * side * side);
    assert_int_equal(rg_symbolic_init(&again, &mem, p.n, p.start, p.row), RG_OK);
    assert_memory_equal(S.place, again.place, (size_t)p.n * sizeof *S.place);
    assert_int_equal(S.count, again.count);
    assert_memory_equal(S.row, again.row, (size_t)S.start[S.count] * sizeof *S.row);
    rg_symbolic_free(&S);
    rg_symbolic_free(&again);
    pattern_free(&p);
}

/* A grid is cut along a line, nearly: side nodes are the fewest that halve it. */
static void separators_separate(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    for (int32_t side = 3; side <= 96; side *= 2) {
        pattern p = grid(side, 0);
        rg_weighted g;
        assert_true(rg_weighted_init(&g, &mem, p.n, p.start[p.n]));
        memcpy(g.start, p.start, ((size_t)p.n + 1) * sizeof *p.start);
        memcpy(g.to, p.row, (size_t)p.start[p.n] * sizeof *p.row);
        for (int32_t i = 0; i < p.n; i++) g.weight[i] = 1;
        for (int32_t i = 0; i < p.start[p.n]; i++) g.edge[i] = 1;
        g.total = p.n;
        int32_t *part = calloc((size_t)p.n, sizeof *part), count[3] = {0};
        assert_true(rg_separate(&g, &mem, part));
        for (int32_t v = 0; v < p.n; v++) {
            assert_in_range(part[v], 0, 2);
            count[part[v]]++;
            for (int32_t j = p.start[v]; j < p.start[v + 1]; j++)
                assert_false((part[v] == 0 && part[p.row[j]] == 1) || (part[v] == 1 && part[p.row[j]] == 0));
        }
        below(count[2], 1.1 * side);
        if (side > 3) below(fmax(count[0], count[1]), 0.6 * p.n + 1);
        free(part);
        rg_weighted_free(&g, &mem);
        pattern_free(&p);
    }
}

/* Sets eliminated by rising number, as unknowns would be, make a tree that is as low as parts are small: of 4096 nodes parts of
 * three fifths at the most are 200 after six levels. */
static void sets_are_of_a_low_tree(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    pattern p = grid(64, 0);
    int32_t *set = calloc((size_t)p.n, sizeof *set);
    const int32_t sets = rg_dissect(&mem, p.n, p.start, p.row, set);
    assert_in_range(sets, 2 * p.n / 200 - 1, MOST);
    clear();
    for (int32_t v = 0; v < p.n; v++) {
        assert_in_range(set[v], 0, sets - 1);
        for (int32_t j = p.start[v]; j < p.start[v + 1]; j++) join(set[v], set[p.row[j]]);
    }
    int32_t height[MOST] = {0}, highest = 0;
    for (int32_t k = 0; k < sets; k++) {
        int32_t parent = k + 1;
        while (parent < sets && !A[k][parent]) parent++;
        if (height[k] > highest) highest = height[k];
        if (parent == sets) continue;
        if (height[k] >= height[parent]) height[parent] = height[k] + 1;
        for (int32_t j = parent + 1; j < sets; j++)
            if (A[k][j]) join(parent, j);
    }
    assert_in_range(highest, 4, 6);
    free(set);
    pattern_free(&p);
}

static void out_of_memory_is_told(void **state)
{
    (void)state;
    counted c = {1000000, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    pattern p = grid(24, 0);
    int32_t *set = calloc((size_t)p.n, sizeof *set);
    assert_true(rg_dissect(&mem, p.n, p.start, p.row, set) > 1);
    const long asked = c.asked;
    for (long k = 0; k < asked; k++) {
        c.left = k;
        assert_int_equal(rg_dissect(&mem, p.n, p.start, p.row, set), -1);
        assert_int_equal(c.out, 0);
    }
    rg_symbolic S;
    for (long k = 0;; k++) {
        c.left = k;
        const rg_status s = rg_symbolic_init(&S, &mem, p.n, p.start, p.row);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(c.out, 0);
    }
    rg_symbolic_free(&S);
    assert_int_equal(c.out, 0);
    free(set);
    pattern_free(&p);
}

/* METIS, for one, takes the process's signals while it works. */
static const int watched[] = {SIGTERM, SIGABRT, SIGINT, SIGSEGV, SIGFPE};
enum { WATCHED = 5 };
static volatile sig_atomic_t ticks, taken;

static void ours(int signal) { (void)signal; }
static void tick(int signal)
{
    struct sigaction now;
    (void)signal;
    ticks++;
    for (int i = 0; i < WATCHED; i++) taken |= sigaction(watched[i], NULL, &now) != 0 || now.sa_handler != ours;
}

static void signals_are_left_alone(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    struct sigaction before[WATCHED], alarm, act = {.sa_handler = ours};
    pattern p = grid(220, 1);
    rg_symbolic S;
    for (int i = 0; i < WATCHED; i++) sigaction(watched[i], &act, &before[i]);
    act.sa_handler = tick;
    sigaction(SIGPROF, &act, &alarm);
    struct itimerval each = {{0, 500}, {0, 500}}, never = {{0, 0}, {0, 0}};
    ticks = taken = 0;
    setitimer(ITIMER_PROF, &each, NULL);
    const rg_status s = rg_symbolic_init(&S, &mem, p.n, p.start, p.row);
    setitimer(ITIMER_PROF, &never, NULL);
    tick(0);
    sigaction(SIGPROF, &alarm, NULL);
    for (int i = 0; i < WATCHED; i++) sigaction(watched[i], &before[i], NULL);
    assert_int_equal(s, RG_OK);
    assert_int_equal(taken, 0);
    assert_true(ticks > 10);
    rg_symbolic_free(&S);
    pattern_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_are_those_of_elimination), cmocka_unit_test(particular_patterns),
        cmocka_unit_test(a_large_grid_costs_what_dissection_promises), cmocka_unit_test(separators_separate),
        cmocka_unit_test(sets_are_of_a_low_tree), cmocka_unit_test(out_of_memory_is_told),
        cmocka_unit_test(signals_are_left_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
