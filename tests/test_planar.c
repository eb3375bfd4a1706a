/* pattern/planar.c: the graph of lines as drawn, against exact arithmetic, formulas of counting, and brute force. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "asked.h"

#include "draw.h"
#include "pattern/build.h"
#include "pattern/faces.h"
#include "pattern/planar.h"
#include "pattern/points.h"

static rg_graph graph_of(rg_lines *l, double merge)
{
    rg_reading s = rg_reading_default();
    rg_graph g;
    rg_diag why = {0, ""};
    s.merge = merge;
    rg_status status = rg_planar_from_lines(l, &s, &g, &why);
    if (status != RG_OK) print_error("%s\n", why.text);
    assert_int_equal(status, RG_OK);
    return g;
}

/* Facets with the paper on their left, found by walking. */
static int32_t count_facets(const rg_graph *g)
{
    rg_star star;
    rg_faces faces;
    int32_t n = 0;
    assert_int_equal(rg_star_init(&star, &g->mem, g->nv, g->ne, g->X, g->E), RG_OK);
    assert_int_equal(rg_faces_init(&faces, &g->mem, g->nv, g->ne, g->X, g->E, star.start, star.edge), RG_OK);
    for (int32_t k = 0; k < faces.count; k++) n += !(faces.area[k] < 0);
    rg_star_free(&star);
    rg_faces_free(&faces);
    return n;
}

static int root(int *up, int v)
{
    while (up[v] != v) v = up[v] = up[up[v]];
    return v;
}

static int32_t count_pieces(const rg_graph *g)
{
    int *up = malloc((size_t)(g->nv + 1) * sizeof *up), n = g->nv;
    for (int v = 0; v < g->nv; v++) up[v] = v;
    for (int32_t e = 0; e < g->ne; e++) {
        const int a = root(up, g->E[e].v[0]), b = root(up, g->E[e].v[1]);
        if (a != b) up[a] = b, n--;
    }
    free(up);
    return n;
}

/* --------------------------------------------------------------------------- an exact graph, by rational points ---- */

enum { MOST = 40, POINTS = 3000 };

typedef struct ratio { int64_t x, y, d; } ratio; /* (x / d, y / d), in lowest terms */
typedef struct segment { int64_t a[2], b[2]; char letter; } segment;
typedef struct exact_edge { int v[2], line; } exact_edge;
typedef struct exact { ratio p[POINTS]; int points; exact_edge e[POINTS]; int edges, degree[POINTS]; } exact;

static int64_t divisor(int64_t a, int64_t b)
{
    a = a < 0 ? -a : a, b = b < 0 ? -b : b;
    while (b) {
        const int64_t t = a % b;
        a = b, b = t;
    }
    return a;
}

static int point(exact *g, int64_t x, int64_t y, int64_t d)
{
    if (d < 0) x = -x, y = -y, d = -d;
    const int64_t k = divisor(divisor(x, y), d);
    const ratio r = {x / k, y / k, d / k};
    for (int i = 0; i < g->points; i++)
        if (g->p[i].x == r.x && g->p[i].y == r.y && g->p[i].d == r.d) return i;
    assert_true(g->points < POINTS);
    g->p[g->points] = r;
    return g->points++;
}

static int weight(char letter) { return letter == 'B' ? 2 : letter == 'M' || letter == 'V'; }

static void exact_segment(exact *g, const segment *s, int n, int i)
{
    const int64_t rx = s[i].b[0] - s[i].a[0], ry = s[i].b[1] - s[i].a[1];
    int on[4 * MOST], count = 0;
    if (!rx && !ry) return;
    on[count++] = point(g, s[i].a[0], s[i].a[1], 1);
    on[count++] = point(g, s[i].b[0], s[i].b[1], 1);
    for (int j = 0; j < n; j++) {
        const int64_t qx = s[j].b[0] - s[j].a[0], qy = s[j].b[1] - s[j].a[1], wx = s[j].a[0] - s[i].a[0], wy = s[j].a[1] - s[i].a[1];
        int64_t d = rx * qy - ry * qx, t = wx * qy - wy * qx, u = wx * ry - wy * rx;
        if (j == i || (!qx && !qy)) continue;
        if (d == 0 && u == 0) { /* on one line: the other's ends, where they are within this one */
            for (int end = 0; end < 2; end++) {
                const int64_t *x = end ? s[j].b : s[j].a, along = (x[0] - s[i].a[0]) * rx + (x[1] - s[i].a[1]) * ry;
                if (along >= 0 && along <= rx * rx + ry * ry) on[count++] = point(g, x[0], x[1], 1);
            }
            continue;
        }
        if (d < 0) d = -d, t = -t, u = -u;
        if (d == 0 || t < 0 || t > d || u < 0 || u > d) continue;
        on[count++] = point(g, s[i].a[0] * d + t * rx, s[i].a[1] * d + t * ry, d);
    }
    for (int k = 1; k < count; k++) /* by place along the segment */
        for (int m = k; m > 0; m--) {
            const ratio *p = &g->p[on[m - 1]], *q = &g->p[on[m]];
            if ((p->x * rx + p->y * ry) * q->d <= (q->x * rx + q->y * ry) * p->d) break;
            const int t = on[m];
            on[m] = on[m - 1], on[m - 1] = t;
        }
    for (int k = 1; k < count; k++) {
        const int low = on[k - 1] < on[k] ? on[k - 1] : on[k], high = on[k - 1] + on[k] - low;
        int e = 0;
        if (low == high) continue;
        while (e < g->edges && (g->e[e].v[0] != low || g->e[e].v[1] != high)) e++;
        assert_true(e < POINTS);
        if (e == g->edges) g->e[g->edges++] = (exact_edge){{low, high}, i};
        else if (weight(s[i].letter) > weight(s[g->e[e].line].letter)) g->e[e].line = i;
    }
}

static void exact_peel(exact *g)
{
    for (int more = 1; more;) {
        more = 0;
        memset(g->degree, 0, sizeof g->degree);
        for (int e = 0; e < g->edges; e++) g->degree[g->e[e].v[0]]++, g->degree[g->e[e].v[1]]++;
        for (int e = 0; e < g->edges; e++) {
            if (g->degree[g->e[e].v[0]] > 1 && g->degree[g->e[e].v[1]] > 1) continue;
            g->e[e--] = g->e[--g->edges];
            more = 1;
            break;
        }
    }
}

/* The vertex of the graph at an exact point. */
static int32_t vertex_at(const rg_graph *g, const ratio *p)
{
    const rg_vec2 x = {(double)p->x / (double)p->d, (double)p->y / (double)p->d};
    for (int32_t v = 0; v < g->nv; v++)
        if (rg_vec2_length(rg_vec2_sub(g->X[v], x)) < 1e-9) return v;
    fail_msg("no vertex at (%.9g, %.9g)", x.x, x.y);
    return -1;
}

static void compare(const rg_graph *g, const exact *x)
{
    int32_t vertices = 0;
    for (int v = 0; v < x->points; v++) vertices += x->degree[v] > 0;
    assert_int_equal(g->nv, vertices);
    assert_int_equal(g->ne, x->edges);
    assert_int_equal(count_facets(g), g->ne - g->nv + count_pieces(g)); /* V - E + F = 1 + pieces, F with the outside */
    for (int e = 0; e < x->edges; e++) {
        const int32_t a = vertex_at(g, &x->p[x->e[e].v[0]]), b = vertex_at(g, &x->p[x->e[e].v[1]]);
        int32_t i = 0;
        while (i < g->ne && !((g->E[i].v[0] == a && g->E[i].v[1] == b) || (g->E[i].v[0] == b && g->E[i].v[1] == a))) i++;
        if (i == g->ne) fail_msg("an edge from (%g, %g) is missing", g->X[a].x, g->X[a].y);
        assert_int_equal(g->E[i].where, x->e[e].line + 1);
    }
}

/* Ends on a coarse grid: lines that overlap, end on each other, cross three at a time, lie double. Fractions of a grid
 * of 16 are no nearer to each other than 4e-6, so that a tolerance of 1e-9 merges what is equal and nothing else. */
static void against_exact_arithmetic(void **state)
{
    (void)state;
    unsigned seed = 2385;
    static exact x;
    int with_edges = 0;
    for (int round = 0; round < 600; round++) {
        const int n = 4 + round % (MOST - 4), span = 3 + round % 14;
        segment s[MOST];
        rg_lines l = drawing();
        memset(&x, 0, sizeof x);
        for (int i = 0; i < n; i++) {
            for (int k = 0; k < 2; k++) s[i].a[k] = whole_noise(&seed, span), s[i].b[k] = whole_noise(&seed, span);
            if (i % 3 == 0) s[i].b[i % 2] = s[i].a[i % 2]; /* many on one line */
            s[i].letter = "BMVU"[whole_noise(&seed, 4)];
            draw(&l, s[i].letter, (double)s[i].a[0], (double)s[i].a[1], (double)s[i].b[0], (double)s[i].b[1]);
        }
        for (int i = 0; i < n; i++) exact_segment(&x, s, n, i);
        exact_peel(&x);
        rg_graph g = graph_of(&l, 1e-9);
        compare(&g, &x);
        with_edges += x.edges > 20;
        rg_graph_free(&g);
        rg_lines_free(&l);
    }
    assert_true(with_edges > 200);
}

/* --------------------------------------------------------------------------------------------------- many lines ---- */

static int64_t side(const int64_t *a, const int64_t *b, const int64_t *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static int crossing(const segment *s, const segment *t)
{
    for (int k = 0; k < 2; k++) {
        const int64_t low = s->a[k] < s->b[k] ? s->a[k] : s->b[k], high = s->a[k] + s->b[k] - low;
        if ((t->a[k] < low && t->b[k] < low) || (t->a[k] > high && t->b[k] > high)) return 0;
    }
    const int64_t sa = side(t->a, t->b, s->a), sb = side(t->a, t->b, s->b), ta = side(s->a, s->b, t->a), tb = side(s->a, s->b, t->b);
    assert_true(sa && sb && ta && tb); /* the seed gives no line that ends on another */
    return (sa < 0) != (sb < 0) && (ta < 0) != (tb < 0);
}

/* 6,667 triangles strewn about: every crossing adds one vertex and two edges. Counted pair by pair in whole numbers. */
static void twenty_thousand_lines(void **state)
{
    (void)state;
    enum { TRIANGLES = 6667, LINES = 3 * TRIANGLES };
    static segment s[LINES];
    static int up[TRIANGLES];
    unsigned seed = 125;
    rg_lines l = drawing();
    for (int t = 0; t < TRIANGLES; t++) {
        int64_t x[3][2];
        const int64_t cx = whole_noise(&seed, 1 << 24), cy = whole_noise(&seed, 1 << 24);
        for (int k = 0; k < 3; k++) {
            x[k][0] = cx + whole_noise(&seed, 1 << 20), x[k][1] = cy + whole_noise(&seed, 1 << 20);
        }
        for (int k = 0; k < 3; k++) {
            segment *side_k = &s[3 * t + k];
            memcpy(side_k->a, x[k], sizeof x[k]);
            memcpy(side_k->b, x[(k + 1) % 3], sizeof x[k]);
            draw(&l, RG_MOUNTAIN, (double)side_k->a[0], (double)side_k->a[1], (double)side_k->b[0], (double)side_k->b[1]);
        }
        up[t] = t;
    }
    int32_t crossings = 0, pieces = TRIANGLES;
    for (int i = 0; i < LINES; i++)
        for (int j = i - i % 3 + 3; j < LINES; j++) {
            if (!crossing(&s[i], &s[j])) continue;
            crossings++;
            const int a = root(up, i / 3), b = root(up, j / 3);
            if (a != b) up[a] = b, pieces--;
        }
    rg_graph g = graph_of(&l, 1e-13);
    assert_true(crossings > 50000 && pieces > 10);
    assert_int_equal(g.nv, LINES + crossings);
    assert_int_equal(g.ne, LINES + 2 * crossings);
    assert_int_equal(count_facets(&g), g.ne - g.nv + pieces);
    rg_graph_free(&g);
    rg_lines_free(&l);
}

/* A size that a comparison of every pair would not end at: 5 * 10^10 pairs. */
static void a_large_grid(void **state)
{
    (void)state;
    const int n = 400;
    rg_lines l = drawing();
    for (int i = 0; i <= n; i++)
        for (int j = 0; j < n; j++) {
            const int rim = i == 0 || i == n;
            draw(&l, rim ? RG_BORDER : RG_VALLEY, j, i, j + 1, i);
            draw(&l, rim ? RG_BORDER : RG_MOUNTAIN, i, j, i, j + 1);
        }
    rg_graph g = graph_of(&l, 2e-5);
    assert_int_equal(g.nv, (n + 1) * (n + 1));
    assert_int_equal(g.ne, 2 * n * (n + 1));
    assert_int_equal(count_facets(&g), n * n);
    near(g.merged_max, 0, 0);
    rg_graph_free(&g);
    rg_lines_free(&l);
}

/* Box pleats drawn with long lines: n lines each way and both diagonals of every cell, which meet in the cells' middle. */
static void long_lines_on_a_grid(void **state)
{
    (void)state;
    const int n = 40;
    rg_lines l = drawing();
    for (int i = 0; i <= n; i++) {
        draw(&l, i % n ? RG_VALLEY : RG_BORDER, 0, i / 7.0, n / 7.0, i / 7.0);
        draw(&l, i % n ? RG_VALLEY : RG_BORDER, i / 7.0, 0, i / 7.0, n / 7.0);
    }
    for (int i = 1 - n; i < n; i++) {
        const double low = i > 0 ? i : 0, high = i > 0 ? n : n + i;
        draw(&l, RG_MOUNTAIN, low / 7, (low - i) / 7, high / 7, (high - i) / 7);
        draw(&l, RG_MOUNTAIN, (n - low) / 7, (low - i) / 7, (n - high) / 7, (high - i) / 7);
    }
    rg_graph g = graph_of(&l, 2e-5);
    assert_int_equal(g.nv, (n + 1) * (n + 1) + n * n);
    assert_int_equal(g.ne, 2 * n * (n + 1) + 4 * n * n);
    assert_int_equal(count_facets(&g), 4 * n * n);
    rg_graph_free(&g);
    rg_lines_free(&l);
}

/* What is left out does not count for the size, which contact and layers of what is left are measured by. */
static void what_is_left_out_has_no_size(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 3, 2);
    draw(&l, RG_VALLEY, 0, 0, 3, 2);
    draw(&l, RG_VALLEY, 5000, 5000, 5100, 5000);
    rg_graph g = graph_of(&l, 2e-5);
    assert_int_equal(g.nv, 4);
    assert_true(g.size == 3);
    rg_graph_free(&g);
    rg_lines_free(&l);
    /* Nothing is left: points, and no edge between them. */
    rg_vec2 X[2] = {{0, 0}, {1, 0}};
    l = drawing();
    rg_star star;
    assert_int_equal(rg_star_init(&star, &l.mem, 2, 0, X, NULL), RG_OK);
    for (int v = 0; v <= 2; v++) assert_int_equal(star.start[v], 0);
    rg_star_free(&star);
    rg_lines_free(&l);
}

/* Lines that meet at thousandths of a degree, from left to right: two of them cross where their order is turned over. */
static void nearly_parallel_lines(void **state)
{
    (void)state;
    enum { N = 60 };
    for (unsigned round = 0; round < 20; round++) {
        unsigned seed = round;
        int to[N], crossings = 0;
        const double apart = round % 2 ? 1e-5 : 1e-3;
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 1, 1);
        for (int i = 0; i < N; i++) to[i] = i;
        for (int i = N - 1; i > 0; i--) {
            const int j = whole_noise(&seed, i + 1), t = to[i];
            to[i] = to[j], to[j] = t;
        }
        for (int i = 0; i < N; i++) /* no three through one point */
            draw(&l, RG_VALLEY, 0, 0.4 + apart * (i + 0.3 * noise(&seed)), 1, 0.4 + apart * (to[i] + 0.3 * noise(&seed)));
        for (int i = 0; i < N; i++)
            for (int j = i + 1; j < N; j++) crossings += to[i] > to[j];
        rg_graph g = graph_of(&l, 1e-13);
        assert_int_equal(g.nv, 4 + 2 * N + crossings);
        assert_int_equal(g.ne, 4 + 3 * N + 2 * crossings);
        assert_int_equal(count_facets(&g), 1 + N + crossings);
        rg_graph_free(&g);
        rg_lines_free(&l);
    }
}

/* ----------------------------------------------------------------------------------------------------- tolerance ---- */

/* A crease that ends short of its neighbour, or beyond it, by `gap` parts of the tolerance. */
static void gaps(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++)
        for (int far = 0; far < 2; far++) {
            const double tol = 10 * 2e-5, gap = (far ? 1.7 : 0.6) * tol;
            rg_lines l = drawing();
            draw_box(&l, 0, 0, 10, 10);
            draw(&l, RG_VALLEY, 0, 3.1, 4.25, 5.5);
            if (kind == 0) draw(&l, RG_VALLEY, 4.25 + 0.6 * gap, 5.5 + 0.8 * gap, 10, 6); /* end to end */
            if (kind == 1) draw(&l, RG_VALLEY, 4.25, 5.5, 10 - gap, 6);                   /* short of the border */
            if (kind == 2) draw(&l, RG_VALLEY, 4.25, 5.5, 10 + gap, 6);                   /* beyond it */
            if (kind == 3) {                                                              /* short of a crease's inside */
                draw(&l, RG_VALLEY, 4.25, 5.5, 10, 6);
                draw(&l, RG_MOUNTAIN, 2.125, 4.3 - gap * hypot(4.25, 2.4) / 4.25, 2.125, 0);
            }
            rg_graph g = graph_of(&l, 2e-5);
            const int32_t met = kind == 3 ? 9 : 7, apart[] = {6, 5, 7, 8}, told[] = {2, 2, 1, 1};
            assert_int_equal(g.nv, far ? apart[kind] : met);
            assert_int_equal(l.warnings, far ? told[kind] : 0);
            if (!far && kind == 0) near(g.merged_max, gap, 1e-12);
            rg_graph_free(&g);
            rg_lines_free(&l);
        }
}

/* What the drawing says of itself: the largest gap closed, the smallest distance left. */
static void merged_and_kept(void **state)
{
    (void)state;
    unsigned seed = 77;
    for (int round = 0; round < 30; round++) {
        rg_lines l = drawing();
        double gap = 0;
        draw_box(&l, 0, 0, 1, 1);
        for (int i = 0; i < 6; i++) { /* a hub of creases that miss its centre, one by more than the others */
            const double a = i + 0.4 * noise(&seed), d = i == 0 ? 1.1e-5 : 1e-6 * (noise(&seed) + 1), to = a + noise(&seed);
            const double x = 0.5 + cos(to) * d, y = 0.5 + sin(to) * d;
            draw(&l, RG_VALLEY, x, y, 0.5 + 0.45 * cos(a), 0.5 + 0.45 * sin(a));
            for (int j = 4; j < l.count - 1; j++) /* the first one makes the vertex */
                gap = j == 4 ? fmax(gap, hypot(x - l.line[j].a.x, y - l.line[j].a.y)) : gap;
        }
        for (int i = 0; i < 6; i++) { /* a ring round it, so that nothing hangs loose */
            rg_vec2 a = l.line[4 + i].b, b = l.line[4 + (i + 1) % 6].b;
            draw(&l, RG_MOUNTAIN, a.x, a.y, b.x, b.y);
        }
        rg_graph g = graph_of(&l, 2e-5);
        assert_int_equal(g.nv, 4 + 7);
        near(g.merged_max, gap, 1e-12);
        double nearest = INFINITY;
        for (int32_t i = 0; i < g.nv; i++)
            for (int32_t j = 0; j < i; j++) nearest = fmin(nearest, rg_vec2_length(rg_vec2_sub(g.X[i], g.X[j])));
        rg_graph_free(&g);
        rg_pattern *p = pattern_of(&l);
        rg_pattern_info info;
        info = *rg_pattern_get_info(p);
        near(info.kept_min, nearest, 1e-15);
        near(info.merged_max, gap, 1e-12);
        near(info.size, 1, 0);
        rg_pattern_destroy(p);
    }
}

/* Points so dense that vertices, moved to the mean of theirs, come within the tolerance of each other: left so, an
 * edge beside them was cut at one and then at the other, without end. */
static void crowds_settle(void **state)
{
    (void)state;
    enum { N = 600 };
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 55;
    for (int round = 0; round < 40; round++) {
        const double tol = 0.01 * (1 + round % 10);
        rg_points p;
        int32_t at[N], now[N];
        rg_vec2 x[N];
        assert_int_equal(rg_points_init(&p, &mem, (rg_vec2){-1, -1}, 2, tol), RG_OK);
        for (int i = 0; i < N; i++) {
            x[i] = (rg_vec2){noise(&seed), noise(&seed)};
            assert_int_equal(rg_points_add(&p, x[i], &at[i]), RG_OK);
            below(rg_vec2_length(rg_vec2_sub(p.X[at[i]], x[i])), tol);
        }
        assert_int_equal(rg_points_settle(&p, now), RG_OK);
        double nearest = INFINITY, found;
        for (int32_t i = 0; i < p.count; i++)
            for (int32_t j = 0; j < i; j++) nearest = fmin(nearest, rg_vec2_length(rg_vec2_sub(p.X[i], p.X[j])));
        assert_true(nearest > tol);
        assert_int_equal(rg_points_nearest(&mem, p.X, p.count, &found, NULL), RG_OK);
        near(found, nearest, 1e-15);
        int seen[N] = {0};
        for (int i = 0; i < N; i++) {
            assert_in_range(now[at[i]], 0, p.count - 1);
            seen[now[at[i]]] = 1;
        }
        for (int32_t v = 0; v < p.count; v++) assert_true(seen[v]);
        rg_points_free(&p);
    }
}

/* The graph that comes of any drawing is plane: by brute force, no edge crosses another, none passes a vertex nearer than
 * the tolerance, none is there twice, none ends loose. */
static void is_plane(const rg_graph *g, double tol)
{
    int *degree = calloc((size_t)g->nv + 1, sizeof *degree);
    for (int32_t e = 0; e < g->ne; e++) {
        const int32_t *p = g->E[e].v;
        const rg_vec2 a = g->X[p[0]], b = g->X[p[1]];
        degree[p[0]]++, degree[p[1]]++;
        assert_true(p[0] != p[1]);
        for (int32_t f = 0; f < e; f++) {
            const int32_t *q = g->E[f].v;
            const int shared = (p[0] == q[0]) + (p[0] == q[1]) + (p[1] == q[0]) + (p[1] == q[1]);
            assert_true(shared < 2);
            if (shared) continue;
            const rg_vec2 c = g->X[q[0]], d = g->X[q[1]];
            const double ca = rg_vec2_turn(c, d, a), cb = rg_vec2_turn(c, d, b), ac = rg_vec2_turn(a, b, c), ad = rg_vec2_turn(a, b, d);
            const double rounding = 1e-14; /* of twice an area in drawings of size 8 */
            if (fmin(fmin(fabs(ca), fabs(cb)), fmin(fabs(ac), fabs(ad))) < rounding) continue;
            if (ca * cb < 0 && ac * ad < 0) fail_msg("edges cross near (%.9g, %.9g)", a.x, a.y);
        }
        for (int32_t v = 0; v < g->nv; v++) {
            if (v == p[0] || v == p[1]) continue;
            const rg_vec2 d = rg_vec2_sub(b, a), r = rg_vec2_sub(g->X[v], a);
            const double along = rg_vec2_dot(r, d) / rg_vec2_dot(d, d);
            if (along <= 0 || along >= 1) continue;
            const double from_a = rg_vec2_length(r), from_b = rg_vec2_length(rg_vec2_sub(g->X[v], b));
            assert_true(from_a > tol * (1 - 1e-9) && from_b > tol * (1 - 1e-9));
            if (fmax(from_a, from_b) >= rg_vec2_length(d)) continue; /* beside an end */
            const double off = fabs(rg_vec2_cross(d, r)) / rg_vec2_length(d);
            if (!(off > tol * (1 - 1e-9))) fail_msg("an edge passes (%.9g, %.9g) at %g of the tolerance", g->X[v].x, g->X[v].y, off / tol);
        }
    }
    for (int32_t v = 0; v < g->nv; v++) assert_true(degree[v] >= 2);
    free(degree);
}

/* Grid lines drawn by a shaky hand: ends miss by parts of the tolerance and by several of it. */
static void shaky_drawings_become_plane(void **state)
{
    (void)state;
    unsigned seed = 99;
    int large = 0;
    for (int round = 0; round < 400; round++) {
        rg_lines l = drawing();
        const double shake = (round % 5 + 0.2) * 1e-3;
        const int n = 10 + round % 40;
        for (int i = 0; i < n; i++) {
            double x[4];
            for (int k = 0; k < 4; k++) x[k] = whole_noise(&seed, 9) + shake * noise(&seed);
            if (i % 2) x[2 + i / 2 % 2] = x[i / 2 % 2] + shake * noise(&seed);
            draw(&l, RG_VALLEY, x[0], x[1], x[2], x[3]);
        }
        rg_graph g = graph_of(&l, 1.25e-4); /* 1e-3 of 8 */
        is_plane(&g, 1.25e-4 * g.size);
        assert_int_equal(count_facets(&g), g.ne - g.nv + count_pieces(&g));
        large += g.ne > 100;
        rg_graph_free(&g);
        rg_lines_free(&l);
    }
    assert_true(large > 60);
}

/* ------------------------------------------------------------------------------------------------- what is drawn ---- */

static void counts_do_not_depend_on_place_turn_and_size(void **state)
{
    (void)state;
    for (unsigned round = 0; round < 25; round++) {
        rg_pattern_info first = {0}, info;
        for (int way = 0; way < 6; way++) {
            static const struct { double scale, angle, dx, dy; } moves[] = {
                {1, 0, 0, 0}, {1, 0.8, 0, 0}, {1e-9, 2.5, 3e-9, 1e-8}, {3e7, -1.1, 4e9, -7e8}, {0.37, RG_PI / 2, -300, 200}, {1e60, 0.2, 0, 0}};
            unsigned seed = round;
            rg_lines l = drawing();
            draw_box(&l, 0, 0, 3, 2);
            for (int i = 0; i < 14; i++) {
                const double t = 3 * (noise(&seed) + 1) / 2, u = 3 * (noise(&seed) + 1) / 2;
                draw(&l, i % 3 ? RG_MOUNTAIN : RG_VALLEY, t, 0, i % 2 ? u : 3, i % 2 ? 2 : u * 2 / 3);
            }
            draw_moved(&l, moves[way].scale, moves[way].angle, moves[way].dx, moves[way].dy);
            rg_pattern *p = pattern_of(&l);
            info = *rg_pattern_get_info(p);
            if (way == 0) first = info;
            assert_int_equal(info.vertices, first.vertices);
            assert_int_equal(info.edges, first.edges);
            assert_int_equal(info.facets, first.facets);
            assert_int_equal(info.creases, first.creases);
            assert_int_equal(info.interior_vertices, first.interior_vertices);
            assert_int_equal(info.boundary_edges, first.boundary_edges);
            assert_int_equal(info.mountains, first.mountains);
            assert_int_equal(info.closed_vertices, first.closed_vertices);
            assert_int_equal(info.is_disk, 1);
            near(info.kept_min / moves[way].scale, first.kept_min, 1e-6 * first.kept_min);
            near(info.kawasaki_max_deg, first.kawasaki_max_deg, 1e-4);
            rg_pattern_destroy(p);
        }
        assert_true(first.interior_vertices > 5);
    }
}

/* Where lines lie on each other, the border goes before mountain and valley, these before the rest, the first before
 * the second; and mountain on valley is said. */
static void doubles_by_rank(void **state)
{
    (void)state;
    static const char *const drawn[] = {"MB", "BV", "UM", "VU", "MV", "VM", "UVM", "UU", "UBM"};
    static const char stays[] = {'B', 'B', 'M', 'V', 'M', 'V', 'V', 'U', 'B'};
    for (int i = 0; i < 9; i++) {
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 2, 2);
        const int n = (int)strlen(drawn[i]);
        for (int k = 0; k < n; k++) { /* each longer than the last one, and the other way round */
            const double far = 2 - 0.25 * (n - 1 - k), x0 = k % 2 ? far : 0, x1 = k % 2 ? 0 : far;
            draw(&l, drawn[i][k], x0, 1, x1, 1);
        }
        rg_graph g = graph_of(&l, 2e-5);
        int at_left = 0, clash = (strchr(drawn[i], 'M') && strchr(drawn[i], 'V') && !strchr(drawn[i], 'B'));
        for (int32_t e = 0; e < g.ne; e++)
            for (int k = 0; k < 2; k++)
                if (g.X[g.E[e].v[k]].x == 0 && g.X[g.E[e].v[k]].y == 1 && g.X[g.E[e].v[!k]].x > 0.1) {
                    at_left++;
                    assert_int_equal(g.E[e].assignment, stays[i]);
                }
        assert_int_equal(at_left, 1);
        assert_int_equal(l.warnings > 0, clash);
        rg_graph_free(&g);
        rg_lines_free(&l);
    }
}

/* Lines nested in one line, slanting, the longest drawn last: as many pieces as there are ends to cut at, each of the line of
 * highest rank over it. Cut at all ends one by one, these would be 800 million pieces. */
static void lines_nested_in_one(void **state)
{
    (void)state;
    enum { N = 20000 };
    const double dx = 0.6, dy = 0.8;
    rg_lines l = drawing();
    rg_graph g;
    rg_diag why = {0, ""};
    for (int i = 0; i < N; i++) {
        const double from = 1000.0 - i * 0.05, to = 1001.0 + i * 0.05, a = i % 2 ? from : to, b = i % 2 ? to : from;
        draw(&l, i == N / 2 ? RG_BORDER : i == N / 4 ? RG_VALLEY : RG_UNASSIGNED, a * dx, a * dy, b * dx, b * dy);
    }
    assert_int_equal(rg_planar_from_all_lines(&l, 1e-9, NULL, &g, &why), RG_OK);
    assert_int_equal(g.nv, 2 * N);
    assert_int_equal(g.ne, 2 * N - 1);
    int32_t border = 0, valley = 0;
    double length = 0;
    for (int32_t e = 0; e < g.ne; e++) {
        const double one = rg_vec2_length(rg_vec2_sub(g.X[g.E[e].v[1]], g.X[g.E[e].v[0]]));
        assert_true(one < 1.1);
        border += g.E[e].assignment == RG_BORDER;
        valley += g.E[e].assignment == RG_VALLEY;
        length += one;
    }
    near(length, 1 + 0.1 * (N - 1), 1e-6);
    assert_int_equal(border, 2 * (N / 2) + 1);
    assert_int_equal(valley, 0); /* below the border */
    rg_graph_free(&g);
    rg_lines_free(&l);
}

/* A drawing made to cost hours, of lines that almost lie on each other, is refused. */
static void too_many_in_one_place(void **state)
{
    (void)state;
    rg_lines l = drawing();
    rg_graph g;
    rg_diag why = {0, ""};
    unsigned seed = 3;
    for (int i = 0; i < 25000; i++) draw(&l, RG_UNASSIGNED, -1, 1e-3 * noise(&seed), 1, 1e-3 * noise(&seed));
    assert_int_equal(rg_planar_from_all_lines(&l, 1e-12, NULL, &g, &why), RG_EFORMAT);
    assert_true(strstr(why.text, "too many") != NULL);
    rg_graph_free(&g);
    rg_lines_free(&l);
}

/* An allocator that knows how much is out, and how much was at the most. */
typedef struct weighed { size_t out, most; } weighed;

static void *weigh(void *ctx, void *block, size_t bytes)
{
    enum { HEAD = 16 };
    weighed *w = ctx;
    char *from = block ? (char *)block - HEAD : NULL;
    size_t was = 0;
    if (from) memcpy(&was, from, sizeof was);
    w->out += bytes - was;
    if (w->out > w->most) w->most = w->out;
    if (bytes == 0) return free(from), NULL;
    char *to = realloc(from, bytes + HEAD);
    assert_non_null(to);
    memcpy(to, &bytes, sizeof bytes);
    return to + HEAD;
}

/* Billions of crossings are seen to come: nothing is kept of them. */
static void crossings_are_guessed_before_they_are_kept(void **state)
{
    (void)state;
    enum { LONG = 100000 };
    weighed w = {0, 0};
    const rg_memory mem = {weigh, &w};
    rg_lines l;
    rg_graph g;
    rg_diag why = {0, ""};
    unsigned seed = 11;
    rg_lines_init(&l, &mem);
    for (int i = 0; i < LONG; i++) draw(&l, RG_UNASSIGNED, noise(&seed), -1, noise(&seed), 1);
    const size_t drawn = w.out;
    assert_int_equal(rg_planar_from_all_lines(&l, 1e-9, NULL, &g, &why), RG_EFORMAT);
    assert_non_null(strstr(why.text, "too many crossings"));
    assert_true(w.most < drawn + 1000 * LONG);
    rg_graph_free(&g);
    rg_lines_free(&l);
    assert_int_equal(w.out, 0);
}

/* Pieces that cuts leave where they were are not looked at again, nor is what is far from all that is new. So what comes out is put in
 * again, where all is new: nothing is left to cut, to merge or to drop, whatever the tolerance. */
static void what_is_plane_stays_as_it_is(void **state)
{
    (void)state;
    static const double merge[] = {1e-3, 1e-4, 1e-5, 1e-9};
    for (unsigned k = 0; k < 8; k++) {
        unsigned seed = 100 + k;
        rg_lines l = drawing();
        for (int i = 0; i < 400; i++) { /* over all of the sheet, or most of them in a corner of it */
            const double part = k < 4 || i < 50 ? 1 : 0.1;
            draw(&l, RG_VALLEY, part * noise(&seed), noise(&seed), part * noise(&seed), noise(&seed));
        }
        rg_graph g = {0}, h = {0};
        rg_diag why;
        assert_int_equal(rg_planar_from_all_lines(&l, merge[k % 4], NULL, &g, &why), RG_OK);
        assert_true(g.ne > 5000);
        rg_lines again = drawing();
        for (int32_t e = 0; e < g.ne; e++) {
            const rg_vec2 a = g.X[g.E[e].v[0]], b = g.X[g.E[e].v[1]];
            draw(&again, RG_VALLEY, a.x, a.y, b.x, b.y);
        }
        assert_int_equal(rg_planar_from_all_lines(&again, merge[k % 4] * (1 - 1e-9), NULL, &h, &why), RG_OK);
        assert_int_equal(h.nv, g.nv);
        assert_int_equal(h.ne, g.ne);
        rg_graph_free(&g);
        rg_graph_free(&h);
        rg_lines_free(&l);
        rg_lines_free(&again);
    }
}

/* A large drawing is asked for all along whether to go on, and can be ended each time; nothing is kept of it then. */
static void it_can_be_ended_in_the_middle(void **state)
{
    (void)state;
    enum { LONG = 1000, EVER = 1 << 30 };
    asked a = {0, EVER, 0};
    int all = EVER;
    for (int end_at = EVER; end_at >= 0; end_at = end_at == EVER ? all - 1 : end_at - 1 - all / 30) {
        weighed w = {0, 0};
        const rg_memory mem = {weigh, &w};
        rg_reading s = rg_reading_default();
        rg_lines l;
        rg_graph g;
        rg_diag why = {0, ""};
        unsigned seed = 17;
        rg_lines_init(&l, &mem);
        for (int i = 0; i < LONG; i++) draw(&l, RG_VALLEY, noise(&seed), noise(&seed), noise(&seed), noise(&seed));
        a = (asked){0, end_at, 0};
        s.progress = answer, s.progress_ctx = &a;
        assert_int_equal(rg_planar_from_lines(&l, &s, &g, &why), end_at == EVER ? RG_OK : RG_ECANCELLED);
        if (end_at == EVER) all = a.times;
        else assert_true(a.times == end_at + 1 && why.text[0]);
        rg_graph_free(&g);
        rg_lines_free(&l);
        assert_int_equal(w.out, 0);
    }
    assert_true(all > 50 && all < 5000);
}

static void what_is_left_out_is_said(void **state)
{
    (void)state;
    rg_reading s = rg_reading_default();
    for (int aux = 0; aux < 2; aux++) {
        rg_lines l = drawing();
        rg_graph g;
        draw_box(&l, 0, 0, 2, 2);
        draw(&l, RG_FLAT, 0, 1, 2, 1);
        draw(&l, RG_CUT, 0, 0, 2, 2);
        draw(&l, RG_VALLEY, 1, 0, 1, 0.3); /* ends nowhere */
        draw(&l, RG_VALLEY, 1.5, 1.5, 1.5, 1.5);
        s.aux_creases = aux;
        assert_int_equal(rg_planar_from_lines(&l, &s, &g, NULL), RG_OK);
        assert_int_equal(g.nv, 5 + 2 * aux);
        assert_int_equal(g.ne, 5 + 3 * aux);
        assert_int_equal(l.warnings, 3);
        const int where[] = {8, 6, 7};
        for (int i = 0; i < 3; i++) assert_int_equal(l.warning[i].line, where[i]);
        rg_graph_free(&g);
        rg_lines_free(&l);
    }
}

/* Thousands of faults of one kind are a few sentences and a number. */
/* A gap is told from whichever side, as far as what joins it is sensible; a corner beside the line is told with it. */
static void gaps_are_told_with_what_joins_them(void **state)
{
    (void)state;
    static const double end[8][2] = {{0.3, 0.51}, {0.7, 0.49}, {0.51, 0.2}, {0.49, 0.8}, {0.3, 0.53}, {0.7, 0.47}, {0.53, 0.2}, {0.47, 0.8}};
    for (int k = 0; k < 16; k++) {
        const double *x = end[k % 8];
        const int upright = k / 2 % 2, gap = k / 4 % 2, corner = k >= 8; /* 0.01, which is sensible, or 0.03 */
        rg_reading s = rg_reading_default();
        rg_lines l = drawing();
        rg_graph g;
        char says[80];
        draw_box(&l, 0, 0, 1, 1);
        if (upright) draw(&l, RG_VALLEY, 0.5, 0, 0.5, 1);
        else draw(&l, RG_VALLEY, 0, 0.5, 1, 0.5);
        if (corner && upright) draw(&l, RG_VALLEY, 0.5, x[1] + 0.012, x[0] < 0.5 ? 1 : 0, x[1] + 0.012);
        if (corner && !upright) draw(&l, RG_VALLEY, x[0] + 0.012, 0.5, x[0] + 0.012, x[1] < 0.5 ? 1 : 0);
        if (upright) draw(&l, RG_MOUNTAIN, x[0] < 0.5 ? 0 : 1, x[1], x[0], x[1]);
        else draw(&l, RG_MOUNTAIN, x[0], x[1] < 0.5 ? 0 : 1, x[0], x[1]);
        assert_int_equal(rg_planar_from_lines(&l, &s, &g, NULL), RG_OK);
        assert_int_equal(l.warnings, 1);
        if (gap) snprintf(says, sizeof says, "is left out");
        else snprintf(says, sizeof says, corner ? "the next line is 0.01 away, a corner 0.016; --merge 0.016 joins" : "the next line is 0.01 away; --merge 0.01");
        if (!strstr(l.warning[0].text, says)) fail_msg("%d: \"%s\", not \"%s\"", k, l.warning[0].text, says);
        assert_int_equal(strstr(l.warning[0].text, "away") == NULL, gap);
        rg_graph_free(&g);
        rg_lines_free(&l);
    }
}

static void faults_do_not_flood(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 1, 1);
    for (int i = 0; i < 3000; i++) {
        draw(&l, RG_VALLEY, 0.0003 * i, 0, 0.0003 * i, 0.5);
        draw(&l, RG_VALLEY, 0.0003 * i, 0.7, 0.0003 * i, 0.7);
        draw(&l, RG_MOUNTAIN, 0.0003 * i, 0, 0.0003 * i, 0.5);
    }
    rg_graph g = graph_of(&l, 2e-5);
    assert_true(l.warnings > 3 && l.warnings < 100);
    rg_graph_free(&g);
    rg_lines_free(&l);
}

static void no_lines_and_hopeless_ones(void **state)
{
    (void)state;
    rg_reading s = rg_reading_default();
    rg_graph g;
    rg_diag why;
    rg_lines l = drawing();
    assert_int_equal(rg_planar_from_lines(&l, &s, &g, &why), RG_OK);
    assert_int_equal(g.nv, 0);
    rg_graph_free(&g);
    draw(&l, RG_VALLEY, 3, 3, 3, 3);
    assert_int_equal(rg_planar_from_lines(&l, &s, &g, &why), RG_OK);
    assert_int_equal(g.ne, 0);
    rg_graph_free(&g);
    draw(&l, RG_VALLEY, 3, 3, 1e200, 3);
    assert_int_equal(rg_planar_from_lines(&l, &s, &g, &why), RG_EFORMAT);
    assert_non_null(strstr(why.text, "too large"));
    rg_graph_free(&g);
    rg_lines_free(&l);
    l = drawing();
    draw_box(&l, 0, 0, 1e-120, 1e-120);
    assert_int_equal(rg_planar_from_lines(&l, &s, &g, &why), RG_EFORMAT);
    assert_non_null(strstr(why.text, "too small"));
    rg_graph_free(&g);
    rg_lines_free(&l);
}

/* Three panels that lie on each other in the end: folded like a letter the middle one is between, rolled up the last one
 * goes through the first fold. That is seen whatever the size, or the size is refused: it was told both ways. */
static void contact_does_not_depend_on_size(void **state)
{
    (void)state;
    static const double sizes[] = {1, 1e-12, 1e12, 1e-59, 1e69, 1e-99, 1e100, 1e150};
    for (int k = 0; k < 8; k++)
        for (int rolled = 0; rolled < 2; rolled++) {
            const double size = sizes[k];
            rg_reading r = rg_reading_default();
            rg_settings s = rg_settings_default();
            rg_pattern *p = NULL;
            rg_motion *m = NULL;
            rg_lines l = drawing();
            draw_box(&l, 0, 0, 2.7 * size, size);
            draw(&l, RG_VALLEY, size, 0, size, size);
            draw(&l, rolled ? RG_VALLEY : RG_MOUNTAIN, 1.7 * size, 0, 1.7 * size, size);
            const rg_status status = rg_pattern_from_lines(&l, &r, &p, NULL);
            assert_int_equal(status, k < 5 ? RG_OK : RG_EFORMAT);
            if (status != RG_OK) continue;
            s.contact = RG_CONTACT_REPORT;
            assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
            const rg_report *q = rg_motion_report(m);
            assert_int_equal(q->contact, rolled ? RG_CONTACT_CROSSES : RG_CONTACT_FREE);
            near(q->contact_depth, rolled ? 0.244668 : 0, 1e-3);
            assert_string_equal(q->layers, rolled ? "none" : "valid");
            rg_motion_destroy(m);
            rg_pattern_destroy(p);
        }
}

static void merge_out_of_range(void **state)
{
    (void)state;
    static const double merge[] = {-1e-9, 0.101, 1, NAN, INFINITY};
    static const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const int32_t side[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    for (int i = 0; i < 5; i++) {
        rg_reading s = rg_reading_default();
        rg_drawing d = rg_drawing_default();
        rg_pattern *p = NULL;
        d.vertices = d.edges = 4, d.at = corner, d.ends = side, d.assignment = "BBBB";
        s.merge = merge[i];
        assert_int_equal(rg_pattern_create(&d, &s, &p, NULL), RG_EARG);
        assert_null(p);
    }
}

/* Many lines on one: of each part the one that was drawn first stays. */
static void the_first_of_many_on_one_line_stays(void **state)
{
    (void)state;
    enum { MANY = 150, LONG = 97 };
    unsigned seed = 11;
    for (int round = 0; round < 10; round++) {
        int from[MANY], to[MANY];
        rg_lines l = drawing();
        for (int i = 0; i < MANY; i++) {
            from[i] = whole_noise(&seed, LONG), to[i] = from[i] + 1 + whole_noise(&seed, LONG - from[i]);
            if (i == MANY - 1) from[i] = 0, to[i] = LONG; /* all of it, so that none hangs loose */
            draw(&l, 'M', from[i], 5, to[i], 5);
        }
        draw_box(&l, 0, 0, LONG, 10);
        rg_graph g = graph_of(&l, 1e-9);
        int seen = 0;
        double length = 0;
        for (int32_t e = 0; e < g.ne; e++) {
            const rg_vec2 a = g.X[g.E[e].v[0]], b = g.X[g.E[e].v[1]];
            if (a.y != 5 || b.y != 5) continue;
            int first = 0;
            while (!(from[first] < (a.x + b.x) / 2 && (a.x + b.x) / 2 < to[first])) first++;
            assert_int_equal(g.E[e].where, first + 1);
            length += fabs(a.x - b.x);
            seen++;
        }
        near(length, LONG, 1e-9);
        assert_true(seen >= 1);
        rg_graph_free(&g);
        rg_lines_free(&l);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_exact_arithmetic),
        cmocka_unit_test(twenty_thousand_lines),
        cmocka_unit_test(a_large_grid),
        cmocka_unit_test(long_lines_on_a_grid),
        cmocka_unit_test(nearly_parallel_lines),
        cmocka_unit_test(gaps),
        cmocka_unit_test(merged_and_kept),
        cmocka_unit_test(crowds_settle),
        cmocka_unit_test(shaky_drawings_become_plane),
        cmocka_unit_test(counts_do_not_depend_on_place_turn_and_size),
        cmocka_unit_test(doubles_by_rank),
        cmocka_unit_test(lines_nested_in_one),
        cmocka_unit_test(the_first_of_many_on_one_line_stays),
        cmocka_unit_test(too_many_in_one_place),
        cmocka_unit_test(crossings_are_guessed_before_they_are_kept),
        cmocka_unit_test(it_can_be_ended_in_the_middle), cmocka_unit_test(what_is_plane_stays_as_it_is),
        cmocka_unit_test(what_is_left_out_is_said),
        cmocka_unit_test(gaps_are_told_with_what_joins_them), cmocka_unit_test(faults_do_not_flood),
        cmocka_unit_test(what_is_left_out_has_no_size), cmocka_unit_test(no_lines_and_hopeless_ones), cmocka_unit_test(contact_does_not_depend_on_size),
        cmocka_unit_test(merge_out_of_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
