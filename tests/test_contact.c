/* contact/: crossings, their depth, contact on the way and nearest points, against brute force on plain arrays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "folded.h"
#include "contact/contact.h"
#include "contact/course.h"
#include "contact/near.h"
#include "contact/sweep.h"

/* ---------------------------------------------------------------------------- brute force ---- */

typedef double point[3];
typedef point triangle[3];

static double inner(const point a, const point b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void minus(const point a, const point b, point out)
{
    for (int k = 0; k < 3; k++) out[k] = a[k] - b[k];
}

static void outer(const point a, const point b, point out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Six times the volume of a tetrahedron: which side of abc d lies on. */
static double volume(const point a, const point b, const point c, const point d)
{
    point e, f, g, n;
    minus(b, a, e), minus(c, a, f), minus(d, a, g);
    outer(e, f, n);
    return inner(n, g);
}

/* The segment pq goes through the inside of the triangle. */
static int pierces(const point p, const point q, triangle t)
{
    const double s = volume(t[0], t[1], t[2], p), e = volume(t[0], t[1], t[2], q);
    if (!(s * e < 0)) return 0;
    const double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
    return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

static int cross(triangle a, triangle b)
{
    for (int k = 0; k < 3; k++)
        if (pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a)) return 1;
    return 0;
}

static void random_point(unsigned *seed, point p)
{
    for (int k = 0; k < 3; k++) p[k] = noise(seed);
}

static void random_triangle(unsigned *seed, triangle t)
{
    for (int k = 0; k < 3; k++) random_point(seed, t[k]);
}

static double depth(triangle a, triangle b, rg_vec3 *axis)
{
    rg_vec3 x[6];
    memcpy(x, a, sizeof(triangle));
    memcpy(x + 3, b, sizeof(triangle));
    const rg_plate A = {3, x, rg_depth_normal(x, 3)}, B = {3, x + 3, rg_depth_normal(x + 3, 3)};
    return rg_depth_of(&A, &B, 0, axis);
}

static void moved(triangle t, rg_vec3 u, double by, triangle out)
{
    for (int k = 0; k < 3; k++) {
        out[k][0] = t[k][0] + by * u.x;
        out[k][1] = t[k][1] + by * u.y;
        out[k][2] = t[k][2] + by * u.z;
    }
}

/* Crossing is a matter of edges that go through insides; the depth is what parts, and nothing shorter does. */
static void random_pairs(void **state)
{
    (void)state;
    unsigned seed = 11;
    int crossing = 0, apart = 0;
    for (int k = 0; k < 20000; k++) {
        triangle a, b, c;
        rg_vec3 axis = {0, 0, 0};
        random_triangle(&seed, a);
        random_triangle(&seed, b);
        const double d = depth(a, b, &axis);
        assert_true(d >= 0);
        if (cross(a, b) != (d > 0)) assert_true(d < 1e-12 && !cross(a, b));
        crossing += d > 0;
        apart += d == 0;
        if (!(d > 1e-9)) continue;
        near(rg_vec3_length(axis), 1, 1e-12);
        for (int q = 0; q < 5; q++) {
            rg_vec3 u = {noise(&seed), noise(&seed), noise(&seed)};
            u = rg_vec3_scale(1 / rg_vec3_length(u), u);
            moved(b, u, 0.999 * d, c);
            assert_true(cross(a, c));
        }
        moved(b, axis, 1.001 * d, c);
        int parted = !cross(a, c);
        moved(b, axis, -1.001 * d, c);
        assert_true(parted || !cross(a, c));
    }
    assert_true(crossing > 1000 && apart > 1000);
}

/* Touching is no depth: layers in one plane, a common corner, a common edge, a corner on a face, an edge on an edge. */
static void degenerate_pairs(void **state)
{
    (void)state;
    unsigned seed = 12;
    for (int k = 0; k < 4000; k++) {
        triangle a, b;
        double w[3] = {1 + noise(&seed), 1 + noise(&seed), 1 + noise(&seed)};
        const double all = w[0] + w[1] + w[2];
        random_triangle(&seed, a);
        random_triangle(&seed, b);
        point n, e, f, d;
        minus(a[1], a[0], e), minus(a[2], a[0], f);
        outer(e, f, n);
        const double area = sqrt(inner(n, n));
        if (!(area > 0.05)) continue;
        if (k % 4 == 0) { /* in a's plane */
            for (int i = 0; i < 3; i++) {
                const double s = noise(&seed), t = noise(&seed);
                for (int q = 0; q < 3; q++) b[i][q] = a[0][q] + s * e[q] + t * f[q];
            }
        } else if (k % 4 == 1) { /* hinged at an edge, at any angle */
            memcpy(b[0], a[0], sizeof(point));
            memcpy(b[1], a[1], sizeof(point));
        } else { /* all on one side of a's plane, one corner in it: inside a, or at a corner of it */
            for (int i = 0; i < 3; i++) {
                minus(b[i], a[0], d);
                const double h = inner(d, n) / area;
                for (int q = 0; q < 3; q++) b[i][q] += (fabs(h) - h) * n[q] / area;
            }
            for (int q = 0; q < 3; q++)
                b[0][q] = k % 4 == 2 ? (w[0] * a[0][q] + w[1] * a[1][q] + w[2] * a[2][q]) / all : a[2][q];
        }
        below(depth(a, b, NULL), 1e-12);
        below(depth(b, a, NULL), 1e-12);
    }
}

static void known_depths(void **state)
{
    (void)state;
    triangle floor = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, knife = {{1, 0.8, -0.1}, {1, 1.2, -0.1}, {1, 1, 1}};
    near(depth(floor, knife, NULL), 0.1, 1e-12);
    /* From a common corner on, through the middle: cos and sin of the half angle over the distance. */
    triangle a = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, b = {{0, 0, 0}, {1, 1, -0.5}, {1, 1, 0.5}};
    near(depth(a, b, NULL), 0.5 / sqrt(4.5), 1e-12);
}

/* About a common corner, turned anyhow: they cross over a stretch from the corner on if an edge of one goes through the
 * other. */
static void stretches_about_a_corner(void **state)
{
    (void)state;
    unsigned seed = 17;
    int crossing = 0;
    for (int k = 0; k < 4000; k++) {
        triangle a, b;
        rg_vec3 x[2][3];
        random_triangle(&seed, a);
        random_triangle(&seed, b);
        memcpy(b[k % 3], a[k / 3 % 3], sizeof(point)); /* whichever of their corners it is */
        memcpy(x[0], a, sizeof a);
        memcpy(x[1], b, sizeof b);
        const rg_plate A = {3, x[0], rg_depth_normal(x[0], 3)}, B = {3, x[1], rg_depth_normal(x[1], 3)};
        const double stretch = rg_depth_stretch(&A, &B), other = rg_depth_stretch(&B, &A);
        near(stretch, other, 1e-9);
        if (depth(a, b, NULL) > 1e-6) {
            assert_true(stretch > 1e-6);
            crossing++;
        }
    }
    assert_true(crossing > 300);
}

/* ---------------------------------------------------------------------------------- sheets ---- */

/* A strip of facets between slanted creases: any fold angles close, as there is no vertex inside. */
static rg_mesh strip(int n, unsigned *seed)
{
    rg_lines l = drawing();
    double low = 0, high = 0.1;
    draw(&l, RG_BORDER, low, 0, high, 1);
    for (int k = 0; k < n; k++) {
        const double next = low + 0.5 + 0.3 * noise(seed), top = high + 0.5 + 0.3 * noise(seed);
        draw(&l, RG_BORDER, low, 0, next, 0);
        draw(&l, RG_BORDER, high, 1, top, 1);
        draw(&l, k + 1 < n ? RG_VALLEY : RG_BORDER, next, 0, top, 1);
        low = next, high = top;
    }
    rg_pattern *p = pattern_of(&l);
    rg_mesh m = mesh_of(p);
    rg_pattern_destroy(p);
    return m;
}

enum { MOST = 64 };
typedef struct posed { rg_place place[MOST]; rg_vec3 x[2 * MOST]; } posed;

static void pose(const rg_mesh *m, const rg_tree *t, const double *rho, posed *p)
{
    assert_true(m->nf <= MOST && m->nv <= 2 * MOST);
    rg_pose_facets(m, m->X, t, rho, p->place);
    rg_pose_vertices(m, m->X, t, p->place, p->x);
}

/* The tree leaves nothing out, counts nothing twice, and what is told to show its front does not cross. */
static void strips_cross_as_their_pairs_do(void **state)
{
    (void)state;
    unsigned seed = 5;
    int crossing = 0, fronts = 0;
    for (int k = 0; k < 60; k++) {
        rg_mesh m = strip(4 + k % 20, &seed);
        rg_tree t;
        rg_plates p;
        rg_contact_work w;
        double rho[MOST];
        posed s;
        assert_int_equal(rg_tree_init(&m, -1, &t), RG_OK);
        assert_int_equal(rg_plates_init(&m, &p), RG_OK);
        assert_int_equal(rg_contact_work_init(&p, &w), RG_OK);
        for (int32_t i = 0; i < m.N; i++) rho[i] = (k % 3 ? 3.1 : 0.6) * noise(&seed);
        pose(&m, &t, rho, &s);
        rg_contact_hit hit[MOST * MOST], deepest, again;
        const int32_t n = rg_contact_pairs(&p, s.x, 1e-4, &w, hit, MOST * MOST, &deepest);
        int32_t found = 0;
        double most = 0;
        for (int32_t f = 0; f < m.nf; f++)
            for (int32_t g = f + 1; g < m.nf; g++) {
                const double d = rg_contact_depth(&p, s.x, f, g, 1e-4);
                int32_t listed = -1;
                for (int32_t i = 0; i < n; i++)
                    if (hit[i].facet[0] == f && hit[i].facet[1] == g) listed = i;
                assert_int_equal(listed >= 0, d > 0);
                if (d > 0) near(hit[listed].depth, d, 1e-12);
                found += d > 0;
                most = fmax(most, d);
            }
        assert_int_equal(n, found);
        near(deepest.depth, most, 1e-12);
        assert_int_equal(rg_contact_deepest(&p, s.x, 1e-4, &w, &again), n > 0);
        if (n > 0) near(again.depth, most, 1e-12);
        crossing += n > 0;
        const int front = rg_front_shows(&p, s.x, w.normal, p.parts, &w.front);
        if (front) assert_int_equal(n, 0);
        fronts += front;
        rg_contact_work_free(&w);
        rg_plates_free(&p);
        rg_tree_free(&t);
        rg_mesh_free(&m);
    }
    assert_true(crossing > 10 && fronts > 5);
}

/* A facet that is not convex: what stands in its notch does not cross it, what goes through its arm does. One sheet: an
 * L, and a square tongue on one of its arms that is folded round. */
static void notches_are_open(void **state)
{
    (void)state;
    rg_lines l = drawing();
    const double at[8][2] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}, {0, 0}};
    for (int k = 0; k < 6; k++) draw(&l, RG_BORDER, at[k][0], at[k][1], at[(k + 1) % 6][0], at[(k + 1) % 6][1]);
    rg_pattern *pattern = pattern_of(&l);
    rg_mesh m = mesh_of(pattern);
    rg_plates p;
    assert_int_equal(rg_plates_init(&m, &p), RG_OK);
    assert_int_equal(m.nf, 1);
    assert_int_equal(p.parts, 2);
    double area = 0;
    for (int32_t a = 0; a < p.parts; a++)
        for (int32_t j = p.start[a] + 1; j + 1 < p.start[a + 1]; j++)
            area += rg_vec2_turn(m.X[p.vertex[p.start[a]]], m.X[p.vertex[j]], m.X[p.vertex[j + 1]]) / 2;
    near(area, 5, 1e-12);
    rg_plates_free(&p);
    rg_mesh_free(&m);
    rg_pattern_destroy(pattern);
}

/* A Miura-ori shows its front all the way, whatever its size, and so do its steps, up to the flat end. */
static rg_sweep_found step_of(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, double depth,
                              rg_sweep_work *w)
{
    rg_sweep_found found;
    assert_int_equal(rg_sweep_step(p, from, to, depth, w, &found), RG_OK);
    return found;
}

static void miura_shows_its_front(void **state)
{
    (void)state;
    const double alpha = 1.1;
    rg_pattern *pattern = draw_miura(6, alpha);
    rg_mesh m = mesh_of(pattern);
    rg_tree t;
    rg_plates p;
    rg_contact_work w;
    rg_sweep_work sw;
    double rho[200];
    posed s[2];
    assert_true(m.N <= 200);
    assert_int_equal(rg_tree_init(&m, -1, &t), RG_OK);
    assert_int_equal(rg_plates_init(&m, &p), RG_OK);
    assert_int_equal(rg_contact_work_init(&p, &w), RG_OK);
    assert_int_equal(rg_sweep_work_init(&p, &sw), RG_OK);
    enum { STEPS = 200 };
    for (int k = 0; k <= STEPS; k++) {
        miura_angles(&m, alpha, RG_PI * k / STEPS, rho);
        pose(&m, &t, rho, &s[k % 2]);
        assert_int_equal(rg_contact_pairs(&p, s[k % 2].x, RG_CONTACT_TOLERANCE, &w, NULL, 0, NULL), 0);
        assert_int_equal(rg_front_shows(&p, s[k % 2].x, w.normal, p.parts, &w.front), k < STEPS);
        if (k == 0) continue;
        const rg_plates_state from = {m.X, s[(k + 1) % 2].place, s[(k + 1) % 2].x},
            to = {m.X, s[k % 2].place, s[k % 2].x};
        const rg_sweep_found found = step_of(&p, &from, &to, RG_CONTACT_TOLERANCE, &sw);
        assert_int_equal(found.verdict, RG_SWEEP_FREE);
        assert_true(found.in_front);
    }
    rg_sweep_work_free(&sw);
    rg_contact_work_free(&w);
    rg_plates_free(&p);
    rg_tree_free(&t);
    rg_mesh_free(&m);
    rg_pattern_destroy(pattern);
}

/* ------------------------------------------------------------------------- two loose plates ---- */

/* Two triangles of one "sheet" that nothing holds together, or a common corner: the mesh as far as contact/ looks at
 * it. */
typedef struct loose {
    rg_mesh m;
    rg_vec2 X[6];
    int32_t edge[6][2], side[6][2], start[3], vertex[6], facet_edge[6], crease[6];
} loose;

static void make_loose(loose *l, const rg_vec2 X[6], int shared)
{
    memset(l, 0, sizeof *l);
    memcpy(l->X, X, sizeof l->X);
    for (int k = 0; k < 6; k++) {
        l->vertex[k] = k == 3 && shared ? 0 : k;
        l->crease[k] = 0; /* no border: two plates are no sheet of which the front could be seen at once */
        l->facet_edge[k] = k;
        l->side[k][0] = k / 3;
        l->side[k][1] = -1;
    }
    for (int k = 0; k < 6; k++) {
        l->edge[k][0] = l->vertex[k];
        l->edge[k][1] = l->vertex[k / 3 * 3 + (k + 1) % 3];
    }
    l->start[1] = 3, l->start[2] = 6;
    l->m = (rg_mesh){.mem = rg_mem_default(NULL), .nv = 6, .ne = 6, .nf = 2, .X = l->X, .edge = l->edge,
                     .edge_facet = l->side,
                     .facet_start = l->start, .facet_vertex = l->vertex, .facet_edge = l->facet_edge,
                         .edge_crease = l->crease};
}

static rg_mat3 turned_about(rg_vec3 axis, double angle)
{
    const double c = cos(angle), s = sin(angle), k = 1 - c, n = rg_vec3_length(axis), x = axis.x / n, y = axis.y / n,
        z = axis.z / n;
    return (rg_mat3){{{c + x * x * k, x * y * k + z * s, x * z * k - y * s},
                      {x * y * k - z * s, c + y * y * k, y * z * k + x * s},
                      {x * z * k + y * s, y * z * k - x * s, c + z * z * k}}};
}

static void place_all(const loose *l, const rg_place place[2], rg_vec3 x[6])
{
    for (int f = 0; f < 2; f++)
        for (int k = 0; k < 3; k++) {
            const int32_t v = l->vertex[3 * f + k];
            x[v] = rg_vec3_add(rg_mat3_mul_vec(place[f].R, (rg_vec3){l->X[v].x, l->X[v].y, 0}), place[f].t);
        }
}

static rg_sweep_found sweep_of(const loose *l, const rg_place from[2], const rg_place to[2], double allowed,
                               double *size)
{
    rg_plates p;
    rg_sweep_work w;
    rg_vec3 x[6] = {{0, 0, 0}}, y[6] = {{0, 0, 0}};
    assert_int_equal(rg_plates_init(&l->m, &p), RG_OK);
    assert_int_equal(rg_sweep_work_init(&p, &w), RG_OK);
    place_all(l, from, x);
    place_all(l, to, y);
    const rg_plates_state a = {l->X, from, x}, b = {l->X, to, y};
    const rg_sweep_found found = step_of(&p, &a, &b, allowed, &w);
    *size = p.size;
    rg_sweep_work_free(&w);
    rg_plates_free(&p);
    return found;
}

/* The second triangle goes on a screw, about some line and along it, or turns about a common corner, and both together
 * swing about some other axis, which says nothing: sampled densely, what is free never crosses, and contact is where it
 * is told to be. */
static void moving_pairs(void **state)
{
    (void)state;
    unsigned seed = 3;
    int outcome[3] = {0, 0, 0}, through = 0;
    for (int k = 0; k < 20000; k++) {
        const int shared = k % 3 == 0;
        rg_vec2 X[6];
        for (int i = 0; i < 6; i++) X[i] = (rg_vec2){noise(&seed), noise(&seed)};
        if (!(rg_vec2_turn(X[0], X[1], X[2]) > 0.1 && rg_vec2_turn(shared ? X[0] : X[3], X[4], X[5]) > 0.1)) continue;
        loose l;
        make_loose(&l, X, shared);
        const rg_vec3 axis = {noise(&seed), noise(&seed), noise(&seed)},
            swing = {noise(&seed), noise(&seed), noise(&seed)};
        const rg_vec3 tilt = {noise(&seed), noise(&seed), noise(&seed)};
        const rg_vec3 begin = {noise(&seed), noise(&seed), 1.5 * noise(&seed)};
        const double angle = 0.7 * (1 + noise(&seed)), by = 1.5 * noise(&seed);
        const rg_vec3 pivot = shared ? (rg_vec3){X[0].x, X[0].y, 0} : (rg_vec3){noise(&seed), noise(&seed),
                                                                                noise(&seed)};
        const rg_mat3 Q = turned_about(tilt, 3 * noise(&seed));
        rg_place at[2][2];
        triangle a, b;
        double size;
        /* The place at time t, as the first sees it: turned(t) (Q x + begin - pivot) + pivot + t lift, the lift along
         * the axis. */
        const rg_vec3 start = shared ? rg_vec3_sub(pivot, rg_mat3_mul_vec(Q, pivot)) : begin;
        const rg_vec3 lift = rg_vec3_scale(shared ? 0 : noise(&seed), axis);
        for (int end = 0; end < 2; end++) {
            const rg_mat3 T = turned_about(axis, end * angle), G = turned_about(swing, end * by);
            const rg_vec3 t = rg_vec3_add(rg_mat3_mul_vec(T, rg_vec3_sub(start, pivot)),
                                          rg_vec3_axpy(end, lift, pivot));
            at[end][0] = (rg_place){G, {end * 0.3, 0, 0}};
            at[end][1].R = rg_mat3_mul(G, rg_mat3_mul(T, Q));
            at[end][1].t = rg_vec3_add(rg_mat3_mul_vec(G, t), at[end][0].t);
        }
        const double allowed = 1e-3;
        const rg_sweep_found found = sweep_of(&l, at[0], at[1], allowed, &size);
        if (found.time > 0) outcome[found.verdict]++;
        assert_true(found.time >= 0 && found.time <= 1);
        enum { SAMPLES = 200 };
        for (int i = 0; i <= SAMPLES + 1; i++) {
            const double t = i <= SAMPLES ? found.time * i / SAMPLES : found.time;
            const rg_mat3 T = turned_about(axis, t * angle);
            for (int c = 0; c < 3; c++) {
                const rg_vec2 p = X[l.vertex[c]], q = X[l.vertex[3 + c]];
                const rg_vec3 x = rg_vec3_add(rg_mat3_mul_vec(Q, (rg_vec3){q.x, q.y, 0}), start);
                const rg_vec3 y = rg_vec3_add(rg_mat3_mul_vec(T, rg_vec3_sub(x, pivot)), rg_vec3_axpy(t, lift, pivot));
                a[c][0] = p.x, a[c][1] = p.y, a[c][2] = 0;
                b[c][0] = y.x, b[c][1] = y.y, b[c][2] = y.z;
            }
            /* else it begins with a crossing */
            if (found.time > 0)
                below(depth(a, b, NULL), allowed * size * (1 + 1e-9));
        }
        /* At the time told it is as deep as is allowed, to one part in fifty; or else as far from the side on which it
         * was: a tip that pokes through the other, or a plate that goes through it all at once, is not deep. */
        if (found.verdict != RG_SWEEP_CONTACT || depth(a, b, NULL) >= 0.98 * allowed * size) continue;
        double top = INFINITY, low = -INFINITY;
        for (int c = 0; c < 3; c++) {
            top = fmin(top, rg_vec3_dot(found.axis, (rg_vec3){a[c][0], a[c][1], a[c][2]}));
            low = fmax(low, rg_vec3_dot(found.axis, (rg_vec3){b[c][0], b[c][1], b[c][2]}));
        }
        near(low - top, allowed * size, 0.02 * allowed * size);
        through++;
    }
    assert_true(outcome[RG_SWEEP_FREE] > 200 && outcome[RG_SWEEP_CONTACT] > 200);
    assert_int_equal(outcome[RG_SWEEP_GAVE_UP], 0);
    assert_true(through > 0 && through < 50);
}

static double box_of(const rg_vec2 *X, int32_t n)
{
    rg_vec2 low = X[0], high = X[0];
    for (int32_t i = 1; i < n; i++) {
        low = (rg_vec2){fmin(low.x, X[i].x), fmin(low.y, X[i].y)};
        high = (rg_vec2){fmax(high.x, X[i].x), fmax(high.y, X[i].y)};
    }
    return hypot(high.x - low.x, high.y - low.y) / sqrt(2);
}

/* Two triangles of a mesh by themselves, swept. Returns zero: the two of one crease. */
static int sweep_two(const rg_mesh *m, const posed s[2], int32_t f, int32_t g, double allowed, rg_sweep_found *found)
{
    const int32_t *v = m->facet_vertex + m->facet_start[f], *w = m->facet_vertex + m->facet_start[g];
    int32_t shared = 0, from = 0, at = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (v[i] == w[k]) shared++, from = i, at = k;
    if (shared > 1) return 0;
    rg_vec2 X[6];
    for (int i = 0; i < 3; i++) X[i] = m->X[v[(from + i) % 3]], X[3 + i] = m->X[w[(at + i) % 3]];
    loose l;
    make_loose(&l, X, shared);
    const rg_place begin[2] = {s[0].place[f], s[0].place[g]}, end[2] = {s[1].place[f], s[1].place[g]};
    double size;
    *found = sweep_of(&l, begin, end, allowed / box_of(X, 6), &size);
    return 1;
}

/* What comes first of all is what comes first of all pairs by themselves. */
static rg_sweep_verdict compare_to_pairs(const rg_mesh *m, const posed s[2])
{
    rg_plates p;
    rg_sweep_work w;
    assert_int_equal(rg_plates_init(m, &p), RG_OK);
    assert_int_equal(rg_sweep_work_init(&p, &w), RG_OK);
    const rg_plates_state from = {m->X, s[0].place, s[0].x}, to = {m->X, s[1].place, s[1].x};
    const double allowed = 1e-3;
    const rg_sweep_found all = step_of(&p, &from, &to, allowed / p.size, &w);
    rg_sweep_found first = {.verdict = RG_SWEEP_FREE, .time = 1}, one;
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t g = f + 1; g < m->nf; g++)
            if (sweep_two(m, s, f, g, allowed, &one) && one.verdict != RG_SWEEP_FREE &&
                (one.time < first.time || first.verdict == RG_SWEEP_FREE))
                first = one;
    assert_int_equal(all.verdict, first.verdict);
    near(all.time, first.time, 1e-3);
    rg_sweep_work_free(&w);
    rg_plates_free(&p);
    return first.verdict;
}

/* Of a strip that rolls up, the tree and its balls leave nothing out. */
static void strips_sweep_as_their_pairs_do(void **state)
{
    (void)state;
    unsigned seed = 61;
    int outcome[3] = {0, 0, 0};
    for (int k = 0; k < 150; k++) {
        rg_mesh plain = strip(7, &seed), m;
        rg_tree t;
        posed s[2];
        double rho[MOST];
        assert_int_equal(rg_triangulate_all(&plain, &m), RG_OK);
        assert_int_equal(rg_tree_init(&m, k % m.nf, &t), RG_OK);
        for (int32_t i = 0; i < m.N; i++) rho[i] = i < plain.N ? 0.9 + 0.2 * noise(&seed) : 0;
        pose(&m, &t, rho, &s[0]);
        for (int32_t i = 0; i < m.N; i++) rho[i] += i < plain.N ? 0.25 + 0.2 * noise(&seed) : 0;
        pose(&m, &t, rho, &s[1]);
        outcome[compare_to_pairs(&m, s)]++;
        rg_tree_free(&t);
        rg_mesh_free(&m);
        rg_mesh_free(&plain);
    }
    assert_true(outcome[RG_SWEEP_FREE] > 10 && outcome[RG_SWEEP_CONTACT] > 10);
}

enum { CROWD = 12 };
typedef struct crowd {
    rg_mesh m;
    rg_vec2 X[3 * CROWD];
    int32_t edge[3 * CROWD][2], side[3 * CROWD][2], start[CROWD + 1], vertex[3 * CROWD], facet_edge[3 * CROWD],
        crease[3 * CROWD];
} crowd;

/* Small loose triangles that fly through each other, each its own way and turning otherwise than its neighbours of the
 * tree. */
static void crowds_sweep_as_their_pairs_do(void **state)
{
    (void)state;
    unsigned seed = 67;
    int outcome[3] = {0, 0, 0};
    for (int k = 0; k < 300; k++) {
        static crowd c;
        posed s[2];
        memset(&c, 0, sizeof c);
        for (int i = 0; i < 3 * CROWD; i++) {
            const double turn = 2 * RG_PI / 3 * (i % 3);
            c.X[i] = (rg_vec2){0.1 * (i / 3) + 0.2 * cos(turn) + 0.04 * noise(&seed),
                               0.2 * sin(turn) + 0.04 * noise(&seed)};
            c.vertex[i] = c.facet_edge[i] = i;
            c.edge[i][0] = i, c.edge[i][1] = i / 3 * 3 + (i + 1) % 3;
            c.side[i][0] = i / 3, c.side[i][1] = -1;
        }
        for (int f = 0; f <= CROWD; f++) c.start[f] = 3 * f;
        c.m = (rg_mesh){.mem = rg_mem_default(NULL), .nv = 3 * CROWD, .ne = 3 * CROWD, .nf = CROWD, .X = c.X,
                        .edge = c.edge, .edge_facet = c.side,
                        .facet_start = c.start, .facet_vertex = c.vertex, .facet_edge = c.facet_edge,
                            .edge_crease = c.crease};
        for (int f = 0; f < CROWD; f++) {
            const rg_vec3 tilt = {noise(&seed), noise(&seed), noise(&seed)},
                axis = {noise(&seed), noise(&seed), noise(&seed)};
            s[0].place[f] = (rg_place){turned_about(tilt, 3 * noise(&seed)),
                                       {3 * noise(&seed), 3 * noise(&seed), 3 * noise(&seed)}};
            s[1].place[f].R = rg_mat3_mul(turned_about(axis, 0.75 * noise(&seed)), s[0].place[f].R);
            s[1].place[f].t = rg_vec3_add(s[0].place[f].t, (rg_vec3){3 * noise(&seed), 3 * noise(&seed),
                                                                     3 * noise(&seed)});
        }
        for (int i = 0; i < 3 * CROWD; i++)
            for (int end = 0; end < 2; end++)
                s[end].x[i] = rg_vec3_add(rg_mat3_mul_vec(s[end].place[i / 3].R, (rg_vec3){c.X[i].x, c.X[i].y, 0}),
                                          s[end].place[i / 3].t);
        outcome[compare_to_pairs(&c.m, s)]++;
    }
    assert_true(outcome[RG_SWEEP_FREE] > 10 && outcome[RG_SWEEP_CONTACT] > 10);
}

/* Seen from its front at once, as long as no corner's arc is higher than half of what is allowed: facets of one by a
 * half turn by half of the angle, so that it is that of h = (1 + 1/4)^(1/2) / 2 (angle / 2)^2 / 8. */
static void arcs_are_low_enough_to_be_seen_at_once(void **state)
{
    (void)state;
    for (int upright = 0; upright < 2; upright++)
        for (int too_far = 0; too_far < 2; too_far++) {
            rg_lines l = drawing();
            draw_box(&l, 0, 0, 1, 1);
            if (upright) draw(&l, RG_VALLEY, 0.5, 0, 0.5, 1);
            else draw(&l, RG_VALLEY, 0, 0.5, 1, 0.5);
            rg_pattern *d = pattern_of(&l);
            rg_mesh m = mesh_of(d);
            rg_tree t;
            rg_plates p;
            rg_sweep_work w;
            posed s[2];
            const double allowed = 1e-3, most = 2 * sqrt(8 * allowed / 2 / (sqrt(1.25) / 2));
            assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
            assert_int_equal(rg_plates_init(&m, &p), RG_OK);
            assert_int_equal(rg_sweep_work_init(&p, &w), RG_OK);
            pose(&m, &t, (const double[]){0.3}, &s[0]);
            pose(&m, &t, (const double[]){0.3 + (too_far ? 1.01 : 0.99) * most}, &s[1]);
            const rg_plates_state from = {m.X, s[0].place, s[0].x}, to = {m.X, s[1].place, s[1].x};
            const rg_sweep_found found = step_of(&p, &from, &to, allowed, &w);
            assert_int_equal(found.verdict, RG_SWEEP_FREE);
            assert_int_equal(found.in_front, !too_far);
            rg_sweep_work_free(&w);
            rg_plates_free(&p);
            rg_tree_free(&t);
            rg_mesh_free(&m);
            rg_pattern_destroy(d);
        }
}

/* Layers as near as this that move together are passed in few steps; a leap is neither free nor contact. */
static void layers_that_swing_together(void **state)
{
    (void)state;
    loose l;
    double size;
    make_loose(&l, (const rg_vec2[6]){{0, 0}, {1, 0}, {0, 1}, {0.1, 0.1}, {0.6, 0.1}, {0.1, 0.6}}, 0);
    rg_place from[2], to[2];
    for (int f = 0; f < 2; f++) {
        from[f] = (rg_place){rg_mat3_identity(), {0, 0, 2e-5 * f}};
        to[f].R = turned_about((rg_vec3){1, 2, 0.5}, 0.6);
        to[f].t = rg_vec3_add(rg_mat3_mul_vec(to[f].R, from[f].t), (rg_vec3){0.2, 0, 0});
    }
    rg_sweep_found found = sweep_of(&l, from, to, RG_CONTACT_TOLERANCE, &size);
    assert_int_equal(found.verdict, RG_SWEEP_FREE);
    below(found.advancements, 4);
    to[1].R = turned_about((rg_vec3){1, 2, 0.5}, 2.6);
    assert_int_equal(sweep_of(&l, from, to, RG_CONTACT_TOLERANCE, &size).verdict, RG_SWEEP_GAVE_UP);
}

/* States of a motion, one after the other: the first that crosses, and how far on the way to it. A hinge goes past half
 * a turn at a moment that is known, and shows it in no state. */
static void the_first_crossing_of_a_motion(void **state)
{
    (void)state;
    unsigned seed = 21;
    for (int k = 0; k < 12; k++) {
        const int goes_past = k % 2;
        rg_mesh m = strip(goes_past ? 2 : 2 + k % 3, &seed); /* a third facet could be met before */
        rg_tree t;
        rg_course c;
        posed s;
        const double begin = 0.11 * k, turn = 0.1, most = goes_past ? 3.4 : 2.95;
        int states = 0, past = -1;
        assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
        assert_int_equal(rg_course_init(&m, &c), RG_OK);
        for (double a = begin; a <= most; a += turn, states++) {
            double rho[MOST] = {a};
            for (int32_t i = 1; i < m.N; i++) rho[i] = (i % 2 ? -0.02 : 0.02) * a; /* the others hardly move */
            pose(&m, &t, rho, &s);
            const rg_plates_state now = {m.X, s.place, s.x};
            assert_int_equal(rg_course_add(&c, &now, 1), RG_OK);
            if (past < 0 && a > RG_PI) past = states;
        }
        assert_int_equal(rg_course_end(&c), RG_OK);
        assert_int_equal(c.found.states, states);
        if (goes_past) {
            assert_true(past > 0 && c.found.between);
            assert_int_equal(c.found.first, past);
            assert_int_equal(c.found.facet[0] + c.found.facet[1], 1); /* those at the first crease */
            near(c.found.time, (RG_PI - (begin + (past - 1) * turn)) / turn, 1e-9);
            assert_int_equal(c.found.ways, past);
        } else {
            assert_int_equal(c.found.first, -1);
            assert_int_equal(c.found.ways, states - 1);
            assert_int_equal(c.found.crossing, 0);
        }
        assert_int_equal(c.found.unproved, 0);
        rg_course_free(&c);
        rg_course_free(&c);
        rg_tree_free(&t);
        rg_mesh_free(&m);
    }
}

/* What a way between two states crosses by less than it may bend is no crossing for sure: it is told as not proved. */
static void what_a_way_may_bend_is_not_held_against_it(void **state)
{
    (void)state;
    for (int narrow = 0; narrow < 2; narrow++) {
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 1, 1);
        draw(&l, RG_VALLEY, narrow ? 0.01 : 0.2, 0, narrow ? 0.01 : 0.2, 1);
        rg_pattern *d = pattern_of(&l);
        rg_mesh m = mesh_of(d);
        rg_tree t;
        rg_course c;
        posed s;
        assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
        assert_int_equal(rg_course_init(&m, &c), RG_OK);
        /* The last state is 0.04 beyond: 4e-4 deep, and 8e-3. The wider facet's corner bends by up to 0.01 from state
         * to state. */
        for (double rho = 2.28; rho < 3.25; rho += 0.1) {
            pose(&m, &t, &rho, &s);
            const rg_plates_state now = {m.X, s.place, s.x};
            assert_int_equal(rg_course_add(&c, &now, 1), RG_OK);
        }
        assert_int_equal(rg_course_end(&c), RG_OK);
        assert_int_equal(c.found.states, 10);
        assert_int_equal(c.found.first, narrow ? -1 : 9);
        assert_int_equal(c.found.unproved, narrow);
        assert_int_equal(c.found.first_unproved, narrow ? 9 : -1);
        rg_course_free(&c);
        rg_tree_free(&t);
        rg_mesh_free(&m);
        rg_pattern_destroy(d);
    }
}

/* A strip of three squares with two valleys across it. */
static rg_pattern *two_flaps(void)
{
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 3, 1);
    draw(&l, RG_VALLEY, 1, 0, 1, 1);
    draw(&l, RG_VALLEY, 2, 0, 2, 1);
    return pattern_of(&l);
}

/* Two flaps that close through each other, and open again: how many frames cross, and which is the deepest, state by state.
 * What lies between frames counts for what crosses first alone. */
static void the_deepest_of_all_frames(void **state)
{
    (void)state;
    rg_pattern *d = two_flaps();
    rg_mesh m = mesh_of(d);
    for (int every = 1; every <= 3; every++) {
        rg_tree t;
        rg_course c;
        rg_plates p;
        rg_contact_work w;
        posed s;
        int crossing = 0, deepest_state = -1, first = -1, pairs = 0;
        double depth = 0;
        assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
        assert_int_equal(rg_course_init(&m, &c), RG_OK);
        assert_int_equal(rg_plates_init(&m, &p), RG_OK);
        assert_int_equal(rg_contact_work_init(&p, &w), RG_OK);
        for (int k = 0; k <= 40; k++) {
            const double a = 1.5 + 1.4 * sin(RG_PI * k / 40);
            rg_contact_hit hit;
            pose(&m, &t, (const double[]){a, 0.9 * a}, &s);
            const int is_frame = k % every == 0, crosses = rg_contact_deepest(&p, s.x, RG_CONTACT_TOLERANCE, &w, &hit);
            assert_int_equal(rg_course_add(&c, &(rg_plates_state){m.X, s.place, s.x}, is_frame), RG_OK);
            if (crosses && first < 0) first = k;
            if (!is_frame || !crosses) continue;
            crossing++;
            if (!(hit.depth > depth)) continue;
            depth = hit.depth;
            deepest_state = k;
            pairs = rg_contact_pairs(&p, s.x, RG_CONTACT_TOLERANCE, &w, NULL, 0, NULL);
        }
        assert_int_equal(rg_course_end(&c), RG_OK);
        assert_true(crossing > 5 && depth > 0.01 && deepest_state != first);
        assert_int_equal(c.found.crossing, crossing);
        assert_int_equal(c.found.deepest_state, deepest_state);
        near(c.found.deepest.depth, depth, 1e-12);
        assert_int_equal(c.found.deepest.facet[0] + c.found.deepest.facet[1], 2); /* the flaps, 0 and 2 */
        assert_int_equal(c.found.pairs, pairs);
        assert_true(c.found.first >= 0 && c.found.first <= first);
        rg_contact_work_free(&w);
        rg_plates_free(&p);
        rg_course_free(&c);
        rg_tree_free(&t);
    }
    rg_mesh_free(&m);
    rg_pattern_destroy(d);
}

/* One flap down, the other over it, and both flat; then one of them is lifted. If it is the lower one, it goes through
 * the upper one, of which no state and no depth shows anything. */
static void layers_change_places(void **state)
{
    (void)state;
    rg_pattern *d = two_flaps();
    rg_mesh m = mesh_of(d);
    for (int first = 0; first < 2; first++)
        for (int lifted = 0; lifted < 2; lifted++) {
            rg_tree t;
            rg_course c;
            posed s;
            assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
            assert_int_equal(rg_course_init(&m, &c), RG_OK);
            for (int k = 0; k <= 30; k++) {
                const double turn = RG_PI / 12;
                double rho[2];
                rho[first] = turn * (k < 12 ? k : 12);
                rho[!first] = turn * (k < 12 ? 0 : k < 24 ? k - 12 : 12);
                if (k > 27) rho[lifted] = turn * (12 - (k - 27));
                pose(&m, &t, rho, &s);
                assert_int_equal(rg_course_add(&c, &(rg_plates_state){m.X, s.place, s.x}, 1), RG_OK);
            }
            assert_int_equal(rg_course_end(&c), RG_OK);
            assert_int_equal(c.found.crossing, 0);
            assert_int_equal(c.found.first, first == lifted ? 28 : -1);
            assert_int_equal(c.found.between, first == lifted);
            /* and they are known to be on their sides */
            for (int32_t i = 0; first != lifted && i < c.sweep.n_before; i++) {
                int32_t facet[2];
                assert_int_not_equal(rg_course_side(&c, i, facet), 0);
            }
            if (first != lifted) assert_true(c.sweep.n_before > 0);
            rg_course_free(&c);
            rg_tree_free(&t);
        }
    rg_mesh_free(&m);
    rg_pattern_destroy(d);
}

/* As near before half a turn as it is beyond it, it may have stayed before: what counts is the lesser of both. */
static void a_hair_before_half_a_turn(void **state)
{
    (void)state;
    static const struct { double before, after; rg_sweep_verdict verdict; } all[] = {
        {0.001, 0.4, RG_SWEEP_FREE}, {0.4, 0.001, RG_SWEEP_FREE}, {0.3, 0.4, RG_SWEEP_CONTACT},
            {0.4, 0.3, RG_SWEEP_CONTACT}};
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 1, 1);
    draw(&l, RG_VALLEY, 0.5, 0, 0.5, 1);
    rg_pattern *d = pattern_of(&l);
    rg_mesh m = mesh_of(d);
    rg_tree t;
    rg_plates p;
    rg_sweep_work w;
    posed s[2];
    assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
    assert_int_equal(rg_plates_init(&m, &p), RG_OK);
    assert_int_equal(rg_sweep_work_init(&p, &w), RG_OK);
    const rg_plates_state from = {m.X, s[0].place, s[0].x}, to = {m.X, s[1].place, s[1].x};
    for (int k = 0; k < 4; k++) {
        pose(&m, &t, (const double[]){RG_PI - all[k].before}, &s[0]);
        pose(&m, &t, (const double[]){RG_PI + all[k].after}, &s[1]);
        assert_int_equal(step_of(&p, &from, &to, 0.01, &w).verdict, all[k].verdict);
    }
    rg_sweep_work_free(&w);
    rg_plates_free(&p);
    rg_tree_free(&t);
    rg_mesh_free(&m);
    rg_pattern_destroy(d);
}

/* The box of a part is that of its corners, and of a node that of what is below it: no wider, or more is looked at than
 * need be. */
static void boxes_fit(void **state)
{
    (void)state;
    unsigned seed = 13;
    for (int k = 0; k < 10; k++) {
        rg_mesh m = strip(5 + k, &seed);
        rg_tree t;
        rg_plates p;
        posed s;
        double rho[MOST];
        assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
        assert_int_equal(rg_plates_init(&m, &p), RG_OK);
        for (int32_t i = 0; i < m.N; i++) rho[i] = 2 * noise(&seed);
        pose(&m, &t, rho, &s);
        rg_box *box = calloc((size_t)p.nodes, sizeof *box);
        assert_non_null(box);
        rg_plates_boxes(&p, s.x, box);
        for (int32_t n = 0; n < p.nodes; n++) {
            const int32_t a = p.node[n].part;
            if (a < 0) continue;
            rg_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
            for (int32_t j = p.start[a]; j < p.start[a + 1]; j++) {
                const rg_vec3 x = s.x[p.vertex[j]];
                low = (rg_vec3){fmin(low.x, x.x), fmin(low.y, x.y), fmin(low.z, x.z)};
                high = (rg_vec3){fmax(high.x, x.x), fmax(high.y, x.y), fmax(high.z, x.z)};
            }
            const double is[] = {box[n].low.x, box[n].low.y, box[n].low.z, box[n].high.x, box[n].high.y, box[n].high.z};
            const double want[] = {low.x, low.y, low.z, high.x, high.y, high.z};
            for (int i = 0; i < 6; i++) near(is[i], want[i], 0);
        }
        free(box);
        rg_plates_free(&p);
        rg_tree_free(&t);
        rg_mesh_free(&m);
    }
}

/* A hinge past half a turn is as deep in itself as its smaller facet reaches, whichever that is, and not as the larger
 * one. */
static void a_narrow_flap_is_not_deep(void **state)
{
    (void)state;
    for (int side = 0; side < 2; side++)
        for (int allowed = 0; allowed < 2; allowed++) {
            rg_lines l = drawing();
            draw_box(&l, 0, 0, 1, 1);
            draw(&l, RG_VALLEY, side ? 0.9 : 0.1, 0, side ? 0.9 : 0.1, 1);
            rg_pattern *d = pattern_of(&l);
            rg_mesh m = mesh_of(d);
            rg_tree t;
            rg_plates p;
            rg_sweep_work w;
            posed s[2];
            assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
            assert_int_equal(rg_plates_init(&m, &p), RG_OK);
            assert_int_equal(rg_sweep_work_init(&p, &w), RG_OK);
            /* 0.1 wide and at least 0.14 beyond: 0.014 deep, where the other facet would be 0.127. */
            const double depth = allowed ? 0.05 : 0.01;
            const rg_plates_state from = {m.X, s[0].place, s[0].x}, to = {m.X, s[1].place, s[1].x};
            pose(&m, &t, (const double[]){3.0}, &s[0]);
            pose(&m, &t, (const double[]){3.3}, &s[1]);
            assert_int_equal(step_of(&p, &from, &to, depth, &w).verdict, allowed ? RG_SWEEP_FREE : RG_SWEEP_CONTACT);
            rg_sweep_work_free(&w);
            rg_plates_free(&p);
            rg_tree_free(&t);
            rg_mesh_free(&m);
            rg_pattern_destroy(d);
        }
}

/* A hinge that goes past half a turn goes through itself, though no state shows it. */
static void hinges_stop_at_half_a_turn(void **state)
{
    (void)state;
    unsigned seed = 9;
    rg_mesh m = strip(2, &seed);
    rg_tree t;
    rg_plates p;
    rg_sweep_work w;
    posed s[2];
    assert_int_equal(rg_tree_init(&m, 0, &t), RG_OK);
    assert_int_equal(rg_plates_init(&m, &p), RG_OK);
    assert_int_equal(rg_sweep_work_init(&p, &w), RG_OK);
    const rg_plates_state from = {m.X, s[0].place, s[0].x}, to = {m.X, s[1].place, s[1].x};
    pose(&m, &t, (const double[]){3.0}, &s[0]);
    pose(&m, &t, (const double[]){RG_PI}, &s[1]);
    assert_int_equal(step_of(&p, &from, &to, RG_CONTACT_TOLERANCE, &w).verdict, RG_SWEEP_FREE);
    pose(&m, &t, (const double[]){3.3}, &s[1]);
    const rg_sweep_found found = step_of(&p, &from, &to, RG_CONTACT_TOLERANCE, &w);
    assert_int_equal(found.verdict, RG_SWEEP_CONTACT);
    near(found.time, (RG_PI - 3.0) / 0.3, 1e-9);
    pose(&m, &t, (const double[]){-3.1}, &s[0]);
    pose(&m, &t, (const double[]){-3.1}, &s[1]);
    assert_int_equal(step_of(&p, &from, &to, RG_CONTACT_TOLERANCE, &w).verdict, RG_SWEEP_FREE);
    rg_sweep_work_free(&w);
    rg_plates_free(&p);
    rg_tree_free(&t);
    rg_mesh_free(&m);
}

/* ---------------------------------------------------------------------------------- nearest ---- */

/* A nearest point of a triangle: no corner of it lies on p's side of the plane through it across the way to p. Of two
 * edges: the way stands on both. */
static void nearest_points(void **state)
{
    (void)state;
    unsigned seed = 21;
    int inside = 0, beside = 0, both = 0;
    for (int k = 0; k < 20000; k++) {
        rg_vec3 x[4], n;
        for (int i = 0; i < 4; i++) x[i] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
        double w[3], s, t;
        double d = rg_near_triangle(x[0], x[1], x[2], x[3], w, &n);
        rg_vec3 q = rg_vec3_axpy(w[0], x[1], rg_vec3_axpy(w[1], x[2], rg_vec3_scale(w[2], x[3])));
        near(w[0] + w[1] + w[2], 1, 1e-12);
        assert_true(w[0] >= -1e-15 && w[1] >= -1e-15 && w[2] >= -1e-15);
        near(rg_vec3_dot(n, rg_vec3_sub(x[0], q)), d, 1e-12);
        for (int i = 1; i < 4; i++) below(rg_vec3_dot(rg_vec3_sub(x[0], q), rg_vec3_sub(x[i], q)), 1e-12);
        inside += w[0] > 0 && w[1] > 0 && w[2] > 0;
        beside += !(w[0] > 0 && w[1] > 0 && w[2] > 0);
        d = rg_near_segments(x[0], x[1], x[2], x[3], &s, &t, &n);
        const rg_vec3 p = rg_vec3_axpy(s, rg_vec3_sub(x[1], x[0]), x[0]);
        q = rg_vec3_axpy(t, rg_vec3_sub(x[3], x[2]), x[2]);
        assert_true(s >= 0 && s <= 1 && t >= 0 && t <= 1);
        const rg_vec3 v = rg_vec3_sub(p, q);
        near(rg_vec3_dot(n, v), d, 1e-12);
        near(rg_vec3_length(v), d, 1e-12);
        for (int i = 0; i < 2; i++) {
            assert_true(rg_vec3_dot(v, rg_vec3_sub(x[i], p)) >= -1e-12);
            below(rg_vec3_dot(v, rg_vec3_sub(x[2 + i], q)), 1e-12);
        }
        both += s > 0 && s < 1 && t > 0 && t < 1;
    }
    assert_true(inside > 500 && beside > 500 && both > 500);
}

/* ----------------------------------------------------------------------------------- memory ---- */

static void starves_cleanly_and_looks_for_nothing(void **state)
{
    (void)state;
    unsigned seed = 77;
    rg_mesh m = strip(9, &seed);
    rg_tree t;
    posed s;
    double rho[MOST];
    assert_int_equal(rg_tree_init(&m, -1, &t), RG_OK);
    for (int32_t i = 0; i < m.N; i++) rho[i] = 3 * noise(&seed);
    pose(&m, &t, rho, &s);
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        rg_mesh starved = m;
        starved.mem = (rg_memory){counted_resize, &c};
        rg_plates p = {0};
        rg_contact_work w = {0};
        rg_sweep_work sw = {0};
        rg_near_work nw = {0};
        rg_status status = rg_plates_init(&starved, &p);
        if (status == RG_OK) status = rg_contact_work_init(&p, &w);
        if (status == RG_OK) status = rg_sweep_work_init(&p, &sw);
        if (status == RG_OK) status = rg_near_work_init(&p, &nw);
        if (status == RG_OK) {
            const long asked = c.asked;
            const rg_plates_state at = {m.X, s.place, s.x};
            rg_contact_hit deepest;
            rg_contact_pairs(&p, s.x, RG_CONTACT_TOLERANCE, &w, NULL, 0, &deepest);
            rg_contact_deepest(&p, s.x, RG_CONTACT_TOLERANCE, &w, &deepest);
            assert_int_equal(c.asked, asked);
            rg_sweep_found found;
            status = rg_sweep_step(&p, &at, &at, RG_CONTACT_TOLERANCE, &sw, &found);
            rg_sweep_go_on(&sw);
        }
        rg_near_work_free(&nw);
        rg_sweep_work_free(&sw);
        rg_contact_work_free(&w);
        rg_plates_free(&p);
        assert_int_equal(c.out, 0);
        if (status == RG_OK) break;
        assert_int_equal(status, RG_ENOMEM);
    }
    rg_tree_free(&t);
    rg_mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_pairs),
        cmocka_unit_test(degenerate_pairs),
        cmocka_unit_test(known_depths),
        cmocka_unit_test(stretches_about_a_corner),
        cmocka_unit_test(strips_cross_as_their_pairs_do),
        cmocka_unit_test(notches_are_open),
        cmocka_unit_test(miura_shows_its_front),
        cmocka_unit_test(moving_pairs),
        cmocka_unit_test(strips_sweep_as_their_pairs_do),
        cmocka_unit_test(crowds_sweep_as_their_pairs_do),
        cmocka_unit_test(arcs_are_low_enough_to_be_seen_at_once),
        cmocka_unit_test(layers_that_swing_together),
        cmocka_unit_test(hinges_stop_at_half_a_turn),
        cmocka_unit_test(a_narrow_flap_is_not_deep),
        cmocka_unit_test(boxes_fit),
        cmocka_unit_test(a_hair_before_half_a_turn),
        cmocka_unit_test(the_deepest_of_all_frames), cmocka_unit_test(layers_change_places),
        cmocka_unit_test(the_first_crossing_of_a_motion),
        cmocka_unit_test(what_a_way_may_bend_is_not_held_against_it),
        cmocka_unit_test(nearest_points),
        cmocka_unit_test(starves_cleanly_and_looks_for_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
