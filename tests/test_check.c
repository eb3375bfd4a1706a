/* pattern/check.c, pattern/closed.c: sector angles, degree, Kawasaki, Maekawa, closed vertices, on drawn single vertices
 * whose angles and assignments are known before they are drawn. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "draw.h"
#include "pattern/check.h"

enum { MOST = 12 };

typedef struct vertex { int n; double theta[MOST]; char letter[MOST]; double from, length[MOST]; } vertex;

/* theta[i] is the angle from spoke i to spoke i + 1; a ring of border joins the spokes' ends. */
static rg_pattern *draw_vertex(const vertex *w, double x, double y)
{
    rg_lines l = drawing();
    rg_vec2 rim[3 * MOST];
    int at = 0;
    double angle = w->from;
    for (int i = 0; i < w->n; i++) {
        const rg_vec2 end = {x + w->length[i] * cos(angle), y + w->length[i] * sin(angle)};
        draw(&l, w->letter[i], x, y, end.x, end.y);
        rim[at++] = end;
        const int steps = w->theta[i] > 1.2 ? 3 : 1; /* so that the border goes round the vertex in wide sectors too */
        for (int k = 1; k < steps; k++) {
            const double a = angle + w->theta[i] * k / steps;
            rim[at++] = (rg_vec2){x + 2.5 * cos(a), y + 2.5 * sin(a)};
        }
        angle += w->theta[i];
    }
    draw_polygon(&l, RG_BORDER, rim, at);
    return pattern_of(&l);
}

static int32_t centre_of(const rg_pattern *p)
{
    int32_t inner = -1;
    for (int32_t v = 0; v < p->nv; v++) {
        if (p->rim[v]) continue;
        assert_int_equal(inner, -1);
        inner = v;
    }
    assert_true(inner >= 0);
    return inner;
}

static void any_lengths(vertex *w, unsigned *seed)
{
    w->from = 3 * noise(seed);
    for (int i = 0; i < w->n; i++) w->length[i] = 2 + 0.5 * noise(seed);
}

/* Sectors that add up to 2 pi, none under 1/30 of it. */
static void any_angles(vertex *w, unsigned *seed)
{
    double sum = 0;
    for (int i = 0; i < w->n; i++) sum += w->theta[i] = 1.3 + noise(seed);
    for (int i = 0; i < w->n; i++) w->theta[i] *= 2 * RG_PI / sum;
}

static rg_pattern_info info_of(const rg_pattern *p)
{
    rg_pattern_info info;
    info = *rg_pattern_get_info(p);
    return info;
}

static int has(const rg_pattern *p, rg_theorem theorem, double *by)
{
    const rg_unfoldable *list;
    const int32_t n = rg_pattern_unfoldable(p, &list);
    for (int32_t i = 0; i < n; i++) {
        if (list[i].theorem != theorem) continue;
        const rg_vec2 at = p->X[list[i].vertex];
        near(list[i].x, at.x, 0);
        near(list[i].y, at.y, 0);
        assert_int_equal(list[i].vertex, centre_of(p));
        *by = list[i].by;
        return 1;
    }
    return 0;
}

static void sectors_go_round_once(void **state)
{
    (void)state;
    unsigned seed = 8;
    for (int round = 0; round < 300; round++) {
        vertex w = {.n = 3 + round % (MOST - 3)};
        any_angles(&w, &seed);
        any_lengths(&w, &seed);
        for (int i = 0; i < w.n; i++) w.letter[i] = RG_UNASSIGNED;
        rg_pattern *p = draw_vertex(&w, 3 * noise(&seed), noise(&seed));
        const int32_t v = centre_of(p), *star = p->star + p->star_start[v];
        double theta[MOST], sum = 0;
        assert_int_equal(p->star_start[v + 1] - p->star_start[v], w.n);
        rg_check_sectors(p, v, theta);
        for (int i = 0; i < w.n; i++) {
            near(theta[i], w.theta[p->E[star[i]].where - 1], 1e-12);
            sum += theta[i];
            assert_int_equal(p->E[star[(i + 1) % w.n]].where, p->E[star[i]].where % w.n + 1); /* counter-clockwise */
        }
        near(sum, 2 * RG_PI, 1e-12);
        rg_pattern_destroy(p);
    }
}

/* Every other angle adds up to pi, and then one is off by a known amount, which it has from its neighbour. */
static void kawasaki(void **state)
{
    (void)state;
    unsigned seed = 9;
    static const double off[] = {0, 1e-9, 0.005, 0.0099, 0.0101, 0.3, 17};
    for (int round = 0; round < 280; round++) {
        vertex w = {.n = 4 + 2 * (round % 5)};
        const double degrees = off[round % 7];
        any_angles(&w, &seed);
        for (int odd = 0; odd < 2; odd++) {
            double sum = 0;
            for (int i = odd; i < w.n; i += 2) sum += w.theta[i];
            for (int i = odd; i < w.n; i += 2) w.theta[i] *= RG_PI / sum;
        }
        w.theta[1] += degrees * RG_DEG;
        w.theta[2] -= degrees * RG_DEG;
        if (w.theta[2] < 0.02) continue;
        any_lengths(&w, &seed);
        for (int i = 0; i < w.n; i++) w.letter[i] = RG_UNASSIGNED;
        rg_pattern *p = draw_vertex(&w, noise(&seed), noise(&seed));
        double by = 0;
        assert_int_equal(has(p, RG_KAWASAKI, &by), degrees > 0.01);
        if (degrees > 0.01) near(by, degrees, 1e-9);
        near(info_of(p).kawasaki_max_deg, degrees, 1e-9);
        assert_int_equal(has(p, RG_MAEKAWA, &by) || has(p, RG_DEGREE, &by), 0);
        rg_pattern_destroy(p);
    }
}

static void maekawa_and_degree(void **state)
{
    (void)state;
    unsigned seed = 10;
    int violations = 0;
    for (int round = 0; round < 400; round++) {
        vertex w = {.n = 3 + round % 8};
        int mountains = 0, valleys = 0;
        any_angles(&w, &seed);
        any_lengths(&w, &seed);
        for (int i = 0; i < w.n; i++) {
            w.letter[i] = "MVMVMVU"[whole_noise(&seed, round % 3 ? 6 : 7)];
            mountains += w.letter[i] == 'M', valleys += w.letter[i] == 'V';
        }
        rg_pattern *p = draw_vertex(&w, noise(&seed), noise(&seed));
        const int known = mountains + valleys == w.n, excess = abs(mountains - valleys), wrong = known && excess != 2;
        double by = -1;
        assert_int_equal(info_of(p).maekawa_violations, wrong);
        assert_int_equal(has(p, RG_DEGREE, &by), w.n % 2);
        if (w.n % 2) near(by, w.n, 0);
        assert_int_equal(has(p, RG_MAEKAWA, &by), wrong && w.n % 2 == 0); /* an odd vertex is named for its degree only */
        if (wrong && w.n % 2 == 0) near(by, excess, 0);
        assert_int_equal(info_of(p).mountains, mountains);
        assert_int_equal(info_of(p).valleys, valleys);
        assert_int_equal(info_of(p).unassigned, w.n - mountains - valleys);
        violations += wrong;
        rg_pattern_destroy(p);
    }
    assert_true(violations > 50);
}

/* A sector smaller than both beside it, between creases folded the same way, by how much; two letters where it matters. */
static void big_little_big(void **state)
{
    (void)state;
    unsigned seed = 13;
    int shut_in = 0;
    for (int round = 0; round < 600; round++) {
        vertex w = {.n = 3 + round % 6};
        double expected = 0;
        any_angles(&w, &seed);
        if (round % 3 == 0) { /* a sector as small as its neighbour shuts nothing in, one smaller by more than rounding does */
            const double off = (round % 2 ? 0.3 : -0.3) * w.theta[0] + (round % 4 < 2 ? 0.004 : 0.03) * RG_DEG;
            w.theta[1] = w.theta[0] + (round % 6 < 2 ? off : (round % 4 < 2 ? 0.004 : 0.03) * RG_DEG);
            double rest = 2 * RG_PI - w.theta[0] - w.theta[1], sum = 0;
            for (int i = 2; i < w.n; i++) sum += w.theta[i];
            for (int i = 2; i < w.n; i++) w.theta[i] *= rest / sum;
        }
        any_lengths(&w, &seed);
        for (int i = 0; i < w.n; i++) w.letter[i] = "MVMVU"[whole_noise(&seed, 5)];
        for (int i = 0; i < w.n; i++) {
            const double before = w.theta[(i + w.n - 1) % w.n], after = w.theta[(i + 1) % w.n], beside = before < after ? before : after;
            if (w.letter[i] == 'U' || w.letter[i] != w.letter[(i + 1) % w.n]) continue;
            if (beside - w.theta[i] > 0.01 * RG_DEG && beside - w.theta[i] > expected) expected = beside - w.theta[i];
        }
        rg_pattern *p = draw_vertex(&w, noise(&seed), noise(&seed));
        double by = 0;
        assert_int_equal(has(p, RG_BIG_LITTLE_BIG, &by), w.n % 2 == 0 && expected > 0);
        if (w.n % 2 == 0) near(by, expected / RG_DEG, 1e-9);
        shut_in += by > 0;
        rg_pattern_destroy(p);
    }
    assert_true(shut_in > 50 && shut_in < 280);
}

/* A crease that bends, or turns from mountain to valley on the way. */
/* Four creases in two straight lines: folded along one of them the paper closes, folded at one crease alone it misses itself by
 * the whole of that angle. */
static void targets_that_contradict(void **state)
{
    (void)state;
    const struct { double deg[4], miss; } c[] = {
        {{70, 0, 70, 0}, 0}, {{70, 0, 0, 0}, 70}, {{-140, 0, -140, 0}, 0}, {{-60, 0, -90, 0}, 30}, {{0, 0, 0, 12}, 12}, {{0, 40, 0, 39.5}, 0}};
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        rg_lines l = drawing();
        const rg_vec2 end[] = {{2, 0}, {0, 2}, {-2, 0}, {0, -2}};
        draw_polygon(&l, RG_BORDER, end, 4);
        for (int k = 0; k < 4; k++) {
            draw(&l, c[i].deg[k] < 0 ? 'M' : 'V', 0, 0, end[k].x, end[k].y);
            l.line[4 + k].target = c[i].deg[k] * RG_DEG;
        }
        rg_pattern *p = pattern_of(&l);
        const rg_unfoldable *u;
        const int32_t n = rg_pattern_unfoldable(p, &u);
        double by = 0;
        for (int32_t k = 0; k < n; k++)
            if (u[k].theorem == RG_TARGETS) by = u[k].by;
        near(by, c[i].miss, 1e-9);
        rg_pattern_destroy(p);
    }
}

static void two_creases(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        vertex w = {.n = 2, .theta = {RG_PI, RG_PI}, .letter = {'M', "VMV"[kind]}, .length = {2, 2.25}};
        double by;
        if (kind) w.theta[0] -= 0.2, w.theta[1] += 0.2;
        rg_pattern *p = draw_vertex(&w, 0.1, 0.2);
        assert_int_equal(has(p, RG_KAWASAKI, &by), kind != 0);
        if (kind) near(by, 0.2 / RG_DEG, 1e-9);
        assert_int_equal(has(p, RG_MAEKAWA, &by), kind != 1); /* two mountains are an excess of two */
        rg_pattern_destroy(p);
    }
}

static void at(const vertex *w, double x, double y, int spoke, const double end[2])
{
    double angle = w->from;
    for (int i = 0; i < spoke; i++) angle += w->theta[i];
    near(end[0], x + w->length[spoke] * cos(angle), 1e-9);
    near(end[1], y + w->length[spoke] * sin(angle), 1e-9);
}

/* Angles in steps of 15 degrees, so that neighbours are often equal, and then not quite: closed triples as the paper says
 * them, counted from what was drawn. */
static void closed_vertices(void **state)
{
    (void)state;
    unsigned seed = 12;
    int closed = 0, open = 0;
    for (int round = 0; round < 1500; round++) {
        vertex w = {.n = 3 + round % 6};
        int steps = 24;
        double moved = 0;
        for (int i = 0; i < w.n - 1; i++) {
            const int most = steps - (w.n - 1 - i), step = 1 + whole_noise(&seed, most < 6 ? most : 6);
            w.theta[i] = 15 * RG_DEG * step;
            steps -= step;
        }
        w.theta[w.n - 1] = 15 * RG_DEG * steps;
        if (round % 2) {
            moved = (round % 4 == 1 ? 0.004 : 0.03) * RG_DEG;
            w.theta[0] += moved;
            w.theta[w.n - 1] -= moved;
        }
        any_lengths(&w, &seed);
        for (int i = 0; i < w.n; i++) w.letter[i] = "MVMVU"[whole_noise(&seed, round % 3 ? 4 : 5)];
        const double x = noise(&seed), y = noise(&seed);
        rg_pattern *p = draw_vertex(&w, x, y);
        const rg_closed *list;
        const int32_t n = rg_pattern_closed(p, &list);
        int expected = 0, found = 0;
        for (int c = 0; c < w.n; c++) {
            const int a = (c + w.n - 1) % w.n, b = (c + 1) % w.n;
            const int all = w.letter[a] != 'U' && w.letter[b] != 'U' && w.letter[c] != 'U';
            if (!all || w.letter[a] == w.letter[b] || fabs(w.theta[a] - w.theta[c]) > 0.01 * RG_DEG) continue;
            expected++;
            for (int32_t k = 0; k < n; k++) {
                const double dx = list[k].c[0] - x, dy = list[k].c[1] - y;
                double angle = w.from;
                for (int i = 0; i < c; i++) angle += w.theta[i];
                if (fabs(remainder(atan2(dy, dx) - angle, 2 * RG_PI)) > 1e-9) continue;
                found++;
                at(&w, x, y, c, list[k].c);
                at(&w, x, y, a, list[k].a);
                at(&w, x, y, b, list[k].b);
                near(list[k].inside_angle, w.letter[a] != w.letter[c] ? w.theta[a] : w.theta[c], 1e-12);
                near(list[k].x, x, 1e-12);
                near(list[k].y, y, 1e-12);
                assert_int_equal(list[k].vertex, centre_of(p));
            }
        }
        assert_int_equal(n, expected);
        assert_int_equal(found, expected);
        assert_int_equal(info_of(p).closed_vertices, expected > 0);
        expected ? closed++ : open++;
        rg_pattern_destroy(p);
    }
    assert_true(closed > 200 && open > 200);
}

/* Vertices of the border are not asked. */
static void the_border_folds_freely(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 2, 2);
    draw(&l, RG_MOUNTAIN, 1, 0, 0, 1.385);
    draw(&l, RG_MOUNTAIN, 1, 0, 1.25, 2);
    draw(&l, RG_VALLEY, 1, 0, 2, 1.7);
    rg_pattern *p = pattern_of(&l);
    const rg_unfoldable *list;
    assert_int_equal(rg_pattern_unfoldable(p, &list), 0);
    assert_int_equal(info_of(p).maekawa_violations, 0);
    near(info_of(p).kawasaki_max_deg, 0, 0);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sectors_go_round_once),
        cmocka_unit_test(kawasaki),
        cmocka_unit_test(maekawa_and_degree),
        cmocka_unit_test(big_little_big),
        cmocka_unit_test(targets_that_contradict), cmocka_unit_test(two_creases),
        cmocka_unit_test(closed_vertices),
        cmocka_unit_test(the_border_folds_freely),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
