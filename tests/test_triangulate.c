/* mesh/triangulate.c: every facet of any shape into triangles, within itself. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "draw.h"
#include "generate/generate.h"
#include "mesh/mesh.h"

static double turn(const rg_mesh *m, int32_t a, int32_t b, int32_t c) { return rg_vec2_turn(m->X[a], m->X[b], m->X[c]); }

/* Do the segments a b and c d, without a shared end, meet? */
static int meet(const rg_mesh *m, int32_t a, int32_t b, int32_t c, int32_t d)
{
    if (a == c || a == d || b == c || b == d) return 0;
    const double ca = turn(m, c, d, a), cb = turn(m, c, d, b), ac = turn(m, a, b, c), ad = turn(m, a, b, d);
    return (ca > 0) != (cb > 0) && (ac > 0) != (ad > 0) && fmin(fabs(ca), fabs(cb)) > 1e-13 && fmin(fabs(ac), fabs(ad)) > 1e-13;
}

/* Is the middle of a diagonal within facet f? An angle sum, which turns once round what it encloses. */
static int encloses(const rg_mesh *m, int32_t f, rg_vec2 x)
{
    double sum = 0;
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
        const int32_t k = j + 1 < m->facet_start[f + 1] ? j + 1 : m->facet_start[f];
        const rg_vec2 a = rg_vec2_sub(m->X[m->facet_vertex[j]], x), b = rg_vec2_sub(m->X[m->facet_vertex[k]], x);
        sum += atan2(rg_vec2_cross(a, b), rg_vec2_dot(a, b));
    }
    return fabs(sum - 2 * RG_PI) < 1e-3;
}

static int32_t facet_with(const rg_mesh *m, int32_t a, int32_t b) /* that has both corners and the middle between them */
{
    const rg_vec2 middle = {(m->X[a].x + m->X[b].x) / 2, (m->X[a].y + m->X[b].y) / 2};
    for (int32_t f = 0; f < m->nf; f++) {
        int corners = 0;
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) corners += m->facet_vertex[j] == a || m->facet_vertex[j] == b;
        if (corners == 2 && encloses(m, f, middle)) return f;
    }
    return -1;
}

/* Triangles of positive area that cover the sheet; the formula of section 3.2; old numbers kept; diagonals within the facet
 * they cut and across nothing. */
static void triangulates_by(rg_status (*cut)(const rg_mesh *, rg_mesh *), const rg_mesh *m, double sheet)
{
    rg_mesh t;
    double sum = 0;
    int32_t corners = 0;
    assert_int_equal(cut(m, &t), RG_OK);
    for (int32_t f = 0; f < m->nf; f++) corners += m->facet_start[f + 1] - m->facet_start[f] - 3;
    assert_int_equal(t.added, corners);
    assert_int_equal(t.nf, m->nf + corners);
    assert_int_equal(t.N, m->N + corners);
    assert_int_equal(t.M, m->M);
    assert_int_equal(t.N0, m->N0);
    assert_int_equal(t.N - 3 * t.M, t.N0 - 3);
    for (int32_t f = 0; f < t.nf; f++) {
        assert_int_equal(t.facet_start[f + 1] - t.facet_start[f], 3);
        const int32_t *v = t.facet_vertex + t.facet_start[f];
        const double twice = turn(&t, v[0], v[1], v[2]);
        assert_true(twice > 0);
        sum += twice / 2;
    }
    near(sum, sheet, 1e-11 * sheet);
    assert_memory_equal(t.edge, m->edge, (size_t)m->ne * sizeof *m->edge);
    assert_memory_equal(t.assignment, m->assignment, (size_t)m->ne);
    assert_memory_equal(t.crease_edge, m->crease_edge, (size_t)m->N * sizeof *m->crease_edge);
    for (int32_t e = m->ne; e < t.ne; e++) {
        assert_int_equal(t.assignment[e], RG_FLAT);
        assert_true(isnan(t.target[e]));
        assert_int_equal(t.edge_crease[e], m->N + e - m->ne);
        const int32_t a = t.edge[e][0], b = t.edge[e][1], f = facet_with(m, a, b);
        assert_true(f >= 0);
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
            assert_false(meet(&t, a, b, m->edge[m->facet_edge[j]][0], m->edge[m->facet_edge[j]][1]));
        for (int32_t g = m->ne; g < e; g++) assert_false(meet(&t, a, b, t.edge[g][0], t.edge[g][1]));
    }
    for (int32_t k = 0; k < t.M; k++) { /* loops of what is new add up too */
        double angle = 0;
        for (int32_t i = t.loop_start[k]; i < t.loop_start[k + 1]; i++) angle += t.loop_theta[i];
        near(angle, 2 * RG_PI, 1e-11);
    }
    rg_mesh_free(&t);
}

static void triangulates(const rg_mesh *m, double sheet)
{
    triangulates_by(rg_triangulate_all, m, sheet);
    triangulates_by(rg_triangulate_short, m, sheet);
}

/* Twice the area of a polygon, halved. */
static double area_of(const rg_vec2 *x, int32_t n)
{
    double twice = 0;
    for (int32_t i = 0; i < n; i++) twice += rg_vec2_turn(x[0], x[i], x[(i + 1) % n]);
    return twice / 2;
}

static void triangulates_lines(rg_lines *l, double sheet)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_mesh m;
    rg_diag why = {0, ""};
    rg_pattern *p = pattern_of(l);
    rg_status s = rg_mesh_from_pattern(p, &mem, &m, &why);
    if (s != RG_OK) print_error("%s\n", why.text);
    assert_int_equal(s, RG_OK);
    triangulates(&m, sheet);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

static void polygon(const rg_vec2 *x, int32_t n)
{
    rg_lines l = drawing();
    draw_polygon(&l, RG_BORDER, x, n);
    triangulates_lines(&l, area_of(x, n));
}

static void patchworks(void **state)
{
    (void)state;
    unsigned seed = 5;
    int done = 0;
    for (int round = 0; round < 200; round++) {
        const int n = 2 + round % 6;
        rg_lines l = drawing();
        draw_patchwork(&l, n, 0.06 * (round % 12), &seed);
        draw_moved(&l, 1, round, 0, 0);
        rg_pattern *p = pattern_of(&l);
        rg_memory mem = rg_mem_default(NULL);
        rg_mesh m;
        if (rg_mesh_from_pattern(p, &mem, &m, NULL) == RG_OK) {
            triangulates(&m, n * n);
            rg_mesh_free(&m);
            done++;
        }
        rg_pattern_destroy(p);
    }
    assert_true(done > 120);
}

/* Facets with hundreds of corners: a star of long spikes, a spiral in which every diagonal is short. */
static void spikes(void **state)
{
    (void)state;
    enum { N = 400 };
    unsigned seed = 6;
    rg_vec2 x[N];
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < N; i++) {
            const double r = i % 2 ? 0.4 + 0.3 * noise(&seed) : 2 + noise(&seed), a = 2 * RG_PI * (i + 0.2 * noise(&seed)) / N;
            x[i] = (rg_vec2){r * cos(a), r * sin(a)};
        }
        polygon(x, N);
    }
}

static void spiral(void **state)
{
    (void)state;
    enum { HALF = 150 };
    rg_vec2 x[2 * HALF];
    for (int i = 0; i < HALF; i++) {
        const double a = 0.17 * i, out = 1 + 0.12 * a, in = out - 0.3;
        x[i] = (rg_vec2){out * cos(a), out * sin(a)};
        x[2 * HALF - 1 - i] = (rg_vec2){in * cos(a), in * sin(a)};
    }
    polygon(x, 2 * HALF);
}

/* Corners in a straight line, where creases of the neighbours end: the facet has them, though they turn nothing. */
static void straight_corners(void **state)
{
    (void)state;
    for (int round = 0; round < 40; round++) {
        unsigned seed = (unsigned)round;
        rg_lines l = drawing();
        const double h = 0.7 + 0.2 * noise(&seed);
        const int below = 1 + round % 30, right = round % 7;
        draw_box(&l, 0, 0, 3, 2);
        draw(&l, RG_VALLEY, 0, h, 3, h);
        for (int i = 0; i < below; i++) draw(&l, RG_MOUNTAIN, 3.0 * (i + 0.5) / below, h, 3.0 * (i + 0.5 + 0.3 * noise(&seed)) / below, 0);
        if (right) draw(&l, RG_MOUNTAIN, 2, h, 2, 2);
        for (int i = 0; i < right; i++) draw(&l, RG_VALLEY, 2, h + (2 - h) * (i + 1.0) / (right + 1), 3, 1.9);
        draw_moved(&l, 1, round, 0, 0);
        triangulates_lines(&l, 6);
    }
}

/* A triangle of which all three sides are broken by ends of creases: no corner but three turns. */
static void a_triangle_of_straight_corners(void **state)
{
    (void)state;
    for (int n = 1; n < 12; n++) {
        rg_lines l = drawing();
        const rg_vec2 c[3] = {{0, 0}, {1.25, 0.1}, {0.4, 1.1}};
        const rg_vec2 outer[3] = {{-2, -1.5}, {4, -1}, {0, 5}};
        draw_polygon(&l, RG_BORDER, outer, 3);
        for (int k = 0; k < 3; k++) {
            const rg_vec2 a = c[k], b = c[(k + 1) % 3];
            draw(&l, RG_VALLEY, a.x, a.y, b.x, b.y);
            draw(&l, RG_VALLEY, a.x, a.y, outer[k].x, outer[k].y);
            for (int i = 1; i <= n; i++) {
                const double t = (double)i / (n + 1);
                draw(&l, RG_MOUNTAIN, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), outer[(k + 1) % 3].x, outer[(k + 1) % 3].y);
            }
        }
        triangulates_lines(&l, area_of(outer, 3));
    }
}

/* Corners just within, on, and just beyond a straight line, by less than anyone draws. */
static void nearly_straight_corners(void **state)
{
    (void)state;
    static const double off[] = {1e-6, 1e-9, 1e-12, 1e-15, 0};
    for (int k = 0; k < 5; k++)
        for (unsigned round = 0; round < 6; round++) {
            unsigned seed = round;
            rg_lines l = drawing();
            double was = 0.8;
            draw_box(&l, 0, 0, 3, 2);
            for (int i = 0; i < 12; i++) { /* each corner holds a crease, so that none is dissolved */
                const double y = i == 11 ? 0.8 : 0.8 + off[k] * noise(&seed), x0 = 3.0 * i / 12, x1 = 3.0 * (i + 1) / 12;
                draw(&l, RG_VALLEY, x0, was, x1, y);
                draw(&l, RG_MOUNTAIN, x1 - 0.125, (was + y) / 2, x1 - 0.1, 0);
                was = y;
            }
            triangulates_lines(&l, 6);
        }
}

static void what_is_triangles_stays(void **state)
{
    (void)state;
    unsigned seed = 4;
    rg_lines l = drawing();
    draw_patchwork(&l, 5, 0, &seed);
    rg_memory mem = rg_mem_default(NULL);
    rg_mesh m, t;
    rg_pattern *p = pattern_of(&l);
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, NULL), RG_OK);
    for (int32_t f = 0; f < m.nf; f++) assert_true(m.facet_start[f + 1] - m.facet_start[f] >= 3);
    assert_int_equal(rg_triangulate_all(&m, &t), RG_OK);
    rg_mesh again;
    assert_int_equal(rg_triangulate_all(&t, &again), RG_OK);
    assert_int_equal(again.added, t.added);
    assert_int_equal(again.N, t.N);
    assert_memory_equal(again.facet_vertex, t.facet_vertex, 3 * (size_t)t.nf * sizeof *t.facet_vertex);
    rg_mesh_free(&again);
    rg_mesh_free(&t);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

/* ------------------------------------------------------------------------------------- inside angles ---- */

enum { SMALL = 8, DIAGONALS = SMALL * (SMALL - 3) / 2 };

static int same_point(const double *x, rg_vec2 y) { return hypot(x[0] - y.x, x[1] - y.y) < 1e-9; }

static char assignment_between(const rg_mesh *m, int32_t a, int32_t b)
{
    for (int32_t e = 0; e < m->ne; e++)
        if ((m->edge[e][0] == a && m->edge[e][1] == b) || (m->edge[e][0] == b && m->edge[e][1] == a)) return m->assignment[e];
    return 0;
}

static int32_t vertex_at(const rg_mesh *m, const double *x)
{
    for (int32_t v = 0; v < m->nv; v++)
        if (same_point(x, m->X[v])) return v;
    return -1;
}

/* Is the corner of facet f at place i the inside angle of a closed triple that the pattern lists? */
static int is_inside(const rg_pattern *p, const rg_mesh *m, int32_t f, int32_t i)
{
    const int32_t n = m->facet_start[f + 1] - m->facet_start[f], *v = m->facet_vertex + m->facet_start[f];
    const rg_vec2 next = m->X[v[(i + 1) % n]], before = m->X[v[(i + n - 1) % n]];
    const rg_closed *list;
    const int32_t count = rg_pattern_closed(p, &list);
    for (int32_t k = 0; k < count; k++) {
        const rg_closed *t = &list[k];
        if (!same_point((double[]){t->x, t->y}, m->X[v[i]])) continue;
        const int32_t a = vertex_at(m, t->a), c = vertex_at(m, t->c);
        const int at_a = assignment_between(m, v[i], a) != assignment_between(m, v[i], c);
        if (at_a && same_point(t->a, next) && same_point(t->c, before)) return 1;
        if (!at_a && same_point(t->c, next) && same_point(t->b, before)) return 1;
    }
    return 0;
}

/* How good a way to cut a facet is: inside angles that stay whole, and the sine of the smallest angle. */
typedef struct quality { int whole; double least; } quality;

static double angle_sine(const rg_mesh *m, int32_t a, int32_t b, int32_t c)
{
    return turn(m, a, b, c) / (rg_vec2_length(rg_vec2_sub(m->X[b], m->X[a])) * rg_vec2_length(rg_vec2_sub(m->X[c], m->X[a])));
}

static int within(const rg_mesh *m, const int32_t *t, int32_t x)
{
    return turn(m, t[0], t[1], x) >= -1e-12 && turn(m, t[1], t[2], x) >= -1e-12 && turn(m, t[2], t[0], x) >= -1e-12;
}

/* joined[i][j]: a side or a diagonal. Three corners that are all joined are a triangle. Zero: not a way to cut it. */
static int judge(const rg_mesh *m, const int32_t *v, int32_t n, int joined[SMALL][SMALL], const int *inside, quality *q)
{
    *q = (quality){0, 1};
    for (int i = 0; i < n; i++) {
        int ends = 0;
        for (int j = 0; j < n; j++) ends += joined[i][j];
        q->whole += inside[i] && ends == 2;
        for (int j = i + 1; j < n; j++)
            for (int k = j + 1; k < n; k++) {
                if (!joined[i][j] || !joined[j][k] || !joined[i][k]) continue;
                const int32_t t[3] = {v[i], v[j], v[k]};
                for (int s = 0; s < 3; s++) q->least = fmin(q->least, angle_sine(m, t[s], t[(s + 1) % 3], t[(s + 2) % 3]));
                if (!(q->least > 1e-10)) return 0;
                for (int x = 0; x < n; x++)
                    if (x != i && x != j && x != k && within(m, t, v[x])) return 0;
            }
    }
    return 1;
}

static int better(quality a, quality b) { return a.whole < b.whole || (a.whole == b.whole && a.least > b.least); }

/* All sets of n - 3 diagonals of which no two cross. */
static void try_all(const rg_mesh *m, const int32_t *v, int32_t n, const int *inside, quality *best)
{
    int from[DIAGONALS], to[DIAGONALS], d = 0;
    *best = (quality){INT32_MAX, 0};
    for (int i = 0; i < n; i++)
        for (int j = i + 2; j < n; j++)
            if (i > 0 || j < n - 1) from[d] = i, to[d++] = j;
    for (unsigned set = 0; set < 1u << d; set++) {
        int joined[SMALL][SMALL] = {{0}}, count = 0, crossed = 0;
        for (int i = 0; i < d; i++) count += set >> i & 1;
        if (count != n - 3) continue;
        for (int i = 0; i < n; i++) joined[i][(i + 1) % n] = joined[(i + 1) % n][i] = 1;
        for (int i = 0; i < d; i++) {
            if (!(set >> i & 1)) continue;
            joined[from[i]][to[i]] = joined[to[i]][from[i]] = 1;
            for (int j = 0; j < i; j++)
                crossed |= (set >> j & 1) && from[j] < from[i] && from[i] < to[j] && to[j] < to[i];
        }
        for (int i = 0; i < d && !crossed; i++)
            for (int j = 0; j < d; j++)
                crossed |= (set >> i & 1) && (set >> j & 1) && from[j] < from[i] && from[i] < to[j] && to[j] < to[i];
        quality q;
        if (!crossed && judge(m, v, n, joined, inside, &q) && better(q, *best)) *best = q;
    }
}

/* What became of a facet: its triangles are those of t, from number first on. */
static quality what_was_done(const rg_mesh *m, int32_t f, const rg_mesh *t, int32_t first, const int *inside)
{
    const int32_t n = m->facet_start[f + 1] - m->facet_start[f], *v = m->facet_vertex + m->facet_start[f];
    quality q = {0, 1};
    for (int32_t i = 0; i < n; i++) {
        int triangles = 0;
        for (int32_t g = first; g < first + n - 2; g++)
            for (int s = 0; s < 3; s++) triangles += t->facet_vertex[t->facet_start[g] + s] == v[i];
        assert_true(triangles > 0);
        q.whole += inside[i] && triangles == 1;
    }
    for (int32_t g = first; g < first + n - 2; g++)
        for (int s = 0; s < 3; s++) {
            const int32_t *w = t->facet_vertex + t->facet_start[g];
            q.least = fmin(q.least, angle_sine(t, w[s], w[(s + 1) % 3], w[(s + 2) % 3]));
        }
    return q;
}

typedef struct tally { int facets, inside, split, large, whole_in_large, whole_in_large_short; } tally;

static void splits_what_can_be(const rg_pattern *p, tally *sum)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh m, t, shorter;
    if (rg_mesh_from_pattern(p, &mem, &m, NULL) != RG_OK) return;
    assert_int_equal(rg_triangulate_all(&m, &t), RG_OK);
    assert_int_equal(rg_triangulate_short(&m, &shorter), RG_OK);
    for (int32_t f = 0, first = 0; f < m.nf; first += m.facet_start[f + 1] - m.facet_start[f] - 2, f++) {
        const int32_t n = m.facet_start[f + 1] - m.facet_start[f];
        int inside[400], any = 0;
        assert_true(n <= 400);
        for (int32_t i = 0; i < n; i++) any += inside[i] = is_inside(p, &m, f, i);
        const quality is = what_was_done(&m, f, &t, first, inside);
        if (n > 64) {
            sum->large++;
            sum->whole_in_large += is.whole;
            sum->whole_in_large_short += what_was_done(&m, f, &shorter, first, inside).whole;
        }
        if (n < 4 || n > (sum->facets % 16 ? 6 : SMALL)) continue; /* eight corners take a while */
        quality best;
        try_all(&m, m.facet_vertex + m.facet_start[f], n, inside, &best);
        assert_int_equal(is.whole, best.whole);
        near(is.least, best.least, 1e-8 * best.least);
        sum->facets++;
        sum->inside += any;
        sum->split += any - is.whole;
    }
    rg_mesh_free(&shorter);
    rg_mesh_free(&t);
    rg_mesh_free(&m);
}

/* Right angles everywhere, of which many are inside angles; edges left out make facets of all shapes. steps: a staircase of
 * cells from corner to corner is one facet. */
static rg_pattern *gaps(int n, double out, int steps, unsigned *seed)
{
    rg_lines l = drawing();
    for (int i = 0; i <= n; i++)
        for (int j = 0; j < n; j++)
            for (int way = 0; way < 2; way++) {
                const int rim = i == 0 || i == n;
                if (!rim && (noise(seed) + 1) / 2 < out) continue;
                if (!rim && steps && j == (way ? i : i - 1)) continue;
                draw(&l, rim ? RG_BORDER : noise(seed) < 0 ? RG_MOUNTAIN : RG_VALLEY, way ? i : j, way ? j : i, way ? i : j + 1, way ? j + 1 : i);
            }
    draw_moved(&l, 1, 0.1 * n, 0, 0);
    return pattern_of(&l);
}

static void inside_angles(void **state)
{
    (void)state;
    unsigned seed = 9;
    tally sum = {0};
    for (int round = 0; round < 60; round++) {
        rg_pattern *p = gaps(3 + round % 6, 0.06 * (round % 6), 0, &seed);
        splits_what_can_be(p, &sum);
        rg_pattern_destroy(p);
    }
    static const char *const kinds[] = {"crane", "frog", "tatou", "boxpleat", "four-crane", "open-sink", "miura"};
    const rg_memory mem = rg_mem_default(NULL);
    for (int k = 0; k < 7; k++) {
        rg_lines l;
        assert_int_equal(rg_generate_lines(kinds[k], 0, 0, 0, &mem, &l, NULL), RG_OK);
        rg_pattern *p = pattern_of(&l);
        splits_what_can_be(p, &sum);
        rg_pattern_destroy(p);
    }
    assert_true(sum.facets > 300 && sum.inside > 300);
    assert_true(sum.split > sum.inside / 4 && sum.split < sum.inside);
}

/* Facets too large for the best of all ways. */
static void inside_angles_of_large_facets(void **state)
{
    (void)state;
    unsigned seed = 10;
    tally sum = {0};
    for (int round = 0; round < 6; round++) {
        rg_pattern *p = gaps(24, 0, 1, &seed);
        splits_what_can_be(p, &sum);
        rg_pattern_destroy(p);
    }
    assert_true(sum.large > 5 && sum.whole_in_large_short > 20);
    assert_true(2 * sum.whole_in_large < sum.whole_in_large_short);
}

/* Equal ways across are chosen by the corners' numbers, not by rounding. */
static void rounding_does_not_choose(void **state)
{
    (void)state;
    rg_mesh t[2];
    for (int k = 0; k < 2; k++) {
        rg_lines l = drawing();
        for (int i = 0; i <= 5; i++)
            for (int j = 0; j < 5; j++) {
                draw(&l, i % 5 ? RG_VALLEY : RG_BORDER, i, j, i, j + 1);
                draw(&l, i % 5 ? RG_VALLEY : RG_BORDER, j, i, j + 1, i);
            }
        draw_moved(&l, k ? 1.7 : 1, k ? 1e-3 : 0, 0, 0);
        const rg_memory mem = rg_mem_default(NULL);
        rg_mesh m;
        rg_pattern *p = pattern_of(&l);
        assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, NULL), RG_OK);
        assert_int_equal(rg_triangulate_all(&m, &t[k]), RG_OK);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
    assert_int_equal(t[0].nf, 50);
    assert_memory_equal(t[0].facet_vertex, t[1].facet_vertex, 150 * sizeof *t[0].facet_vertex);
    for (int k = 0; k < 2; k++) rg_mesh_free(&t[k]);
}

static void memory(void **state)
{
    (void)state;
    counted c = {1000000, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    unsigned seed = 12;
    rg_mesh m, t;
    rg_pattern *p = gaps(6, 0, 0, &seed);
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, NULL), RG_OK);
    const long before = c.out;
    for (long k = 0;; k++) {
        c.left = k;
        const rg_status s = rg_triangulate_all(&m, &t);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_int_equal(c.out, before);
    }
    assert_true(t.added == 36);
    rg_mesh_free(&t);
    rg_mesh_free(&m);
    assert_int_equal(c.out, 0);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patchworks),
        cmocka_unit_test(spikes),
        cmocka_unit_test(spiral),
        cmocka_unit_test(straight_corners),
        cmocka_unit_test(a_triangle_of_straight_corners),
        cmocka_unit_test(nearly_straight_corners),
        cmocka_unit_test(what_is_triangles_stays),
        cmocka_unit_test(inside_angles),
        cmocka_unit_test(inside_angles_of_large_facets),
        cmocka_unit_test(rounding_does_not_choose),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
