/* pose/pose.c: positions by spanning trees, against distances, reflections and dihedral angles found without them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "folded.h"
#include "pose/pose.h"

enum { MOST = 400 };

typedef struct posed { rg_place place[MOST]; rg_vec3 x[MOST]; double gap; } posed;

static posed pose_with(const rg_mesh *m, const rg_vec2 *X, const double *rho, int32_t fixed)
{
    posed p;
    assert_true(m->nf <= MOST && m->nv <= MOST);
    rg_tree t;
    assert_int_equal(rg_tree_init(m, fixed, &t), RG_OK);
    rg_pose_facets(m, X, &t, rho, p.place);
    rg_pose_vertices(m, X, &t, p.place, p.x);
    p.gap = rg_pose_gap(X, &t, p.place);
    rg_tree_free(&t);
    return p;
}

static posed pose(const rg_mesh *m, const double *rho, int32_t fixed) { return pose_with(m, m->X, rho, fixed); }

static rg_vec3 carried(const rg_place *p, rg_vec2 x)
{
    return (rg_vec3){p->R.c[0].x * x.x + p->R.c[1].x * x.y + p->t.x, p->R.c[0].y * x.x + p->R.c[1].y * x.y + p->t.y,
                     p->R.c[0].z * x.x + p->R.c[1].z * x.y + p->t.z};
}

static double apart(rg_vec3 a, rg_vec3 b) { return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z)); }

/* Every facet keeps its shape, its hinges stay closed, and creases fold by rho, a valley towards the front. */
static void folds_rigidly(const rg_mesh *m, const posed *p, const double *rho, double tol)
{
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
            for (int32_t k = m->facet_start[f]; k < j; k++) {
                const int32_t a = m->facet_vertex[j], b = m->facet_vertex[k];
                const double flat = hypot(m->X[a].x - m->X[b].x, m->X[a].y - m->X[b].y);
                near(apart(carried(&p->place[f], m->X[a]), carried(&p->place[f], m->X[b])), flat, tol);
                near(apart(p->x[a], p->x[b]), flat, tol);
            }
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t e = m->crease_edge[i], *v = m->edge[e];
        const rg_place *left = &p->place[m->edge_facet[e][0]], *right = &p->place[m->edge_facet[e][1]];
        const rg_vec3 d = {p->x[v[1]].x - p->x[v[0]].x, p->x[v[1]].y - p->x[v[0]].y, p->x[v[1]].z - p->x[v[0]].z};
        const rg_vec3 n = right->R.c[2], w = left->R.c[2]; /* where the fronts look */
        const rg_vec3 c = {n.y * w.z - n.z * w.y, n.z * w.x - n.x * w.z, n.x * w.y - n.y * w.x};
        const double sine = (c.x * d.x + c.y * d.y + c.z * d.z) / apart(p->x[v[0]], p->x[v[1]]);
        near(remainder(atan2(sine, n.x * w.x + n.y * w.y + n.z * w.z) - rho[i], 2 * RG_PI), 0, 10 * tol);
        for (int end = 0; end < 2; end++) near(apart(carried(left, m->X[v[end]]), carried(right, m->X[v[end]])), 0, tol);
    }
}

/* Six times the volume of four points: its sign tells a shape from its mirror image. */
static double volume(const rg_vec3 *x, int32_t a, int32_t b, int32_t c, int32_t d)
{
    const rg_vec3 u = rg_vec3_sub(x[b], x[a]), v = rg_vec3_sub(x[c], x[a]), w = rg_vec3_sub(x[d], x[a]);
    return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) + u.z * (v.x * w.y - v.y * w.x);
}

/* From any facet as the fixed one, the folded sheet is the same shape: all distances, and not mirrored. */
static void any_tree(const rg_mesh *m, const double *rho, double tol)
{
    const posed first = pose(m, rho, -1);
    unsigned seed = 11;
    folds_rigidly(m, &first, rho, tol);
    for (int32_t f = 0; f < m->nf; f += 1 + m->nf / 7) {
        const posed p = pose(m, rho, f);
        for (int32_t a = 0; a < m->nv; a++)
            for (int32_t b = 0; b < a; b++) near(apart(p.x[a], p.x[b]), apart(first.x[a], first.x[b]), tol);
        for (int k = 0; k < 50; k++) {
            int32_t v[4];
            for (int i = 0; i < 4; i++) v[i] = whole_noise(&seed, m->nv);
            near(volume(p.x, v[0], v[1], v[2], v[3]), volume(first.x, v[0], v[1], v[2], v[3]), 100 * tol);
        }
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) { /* it has not moved */
            const int32_t v = m->facet_vertex[j];
            near(p.x[v].x, m->X[v].x, 0);
            near(p.x[v].y, m->X[v].y, 0);
            near(p.x[v].z, 0, 0);
        }
        below(p.gap, tol);
        below(rg_pose_strain(m, m->X, p.x), tol);
    }
}

static void miura(void **state)
{
    (void)state;
    static const double angles[] = {0, 0.01, 1.2, 2.385, 3.1, RG_PI};
    for (int i = 0; i < 6; i++) {
        rg_pattern *p = draw_miura(7, 1.1);
        rg_mesh m = mesh_of(p);
        double rho[MOST];
        miura_angles(&m, 1.1, angles[i], rho);
        any_tree(&m, rho, 1e-12);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

/* Creases that do not meet close at any angles: a fan of them from the border. */
static void creases_that_do_not_meet(void **state)
{
    (void)state;
    for (unsigned round = 0; round < 20; round++) {
        unsigned seed = round;
        double rho[20];
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 3, 2);
        for (int i = 0; i < 9; i++) draw(&l, RG_VALLEY, 0.3 * (i + 1) + 0.1 * noise(&seed), 0, 0.3 * (i + 1) + 0.1 * noise(&seed), 2);
        draw_moved(&l, 1.25, round, 5, 7);
        rg_pattern *p = pattern_of(&l);
        rg_mesh m = mesh_of(p);
        for (int i = 0; i < 9; i++) rho[i] = 3 * noise(&seed);
        any_tree(&m, rho, 1e-12);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

/* A vertex of degree 4 by its closed form, drawn as it is, creases numbered as they come. */
static void degree_4(void **state)
{
    (void)state;
    unsigned seed = 14;
    for (int round = 0; round < 100; round++) {
        const double a = RG_PI / 2 * (1 + 0.7 * noise(&seed)), b = RG_PI / 2 * (1 + 0.7 * noise(&seed));
        double theta[4], fold[4], rho[4], angle = noise(&seed);
        rg_vec2 rim[12];
        int n = 0;
        rg_lines l = drawing();
        degree4(a, b, round % 2, tan(1.5 * noise(&seed)), theta, fold);
        for (int i = 0; i < 4; i++) {
            draw(&l, RG_VALLEY, 0, 0, cos(angle), sin(angle));
            for (int k = 0; k < 3; k++, angle += theta[i] / 3) rim[n++] = (rg_vec2){cos(angle), sin(angle)};
        }
        draw_polygon(&l, RG_BORDER, rim, n);
        rg_pattern *p = pattern_of(&l);
        rg_mesh m = mesh_of(p);
        assert_int_equal(m.N, 4);
        for (int32_t i = 0; i < 4; i++) rho[i] = fold[p->E[m.crease_edge[i]].where - 1];
        any_tree(&m, rho, 1e-11);
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

/* Folded flat, a facet lies where the reflections on the way to it put it: complex numbers, z -> u conj(z) + w over a line,
 * one line after the other, by the shortest way over edges. */
typedef struct mirror { double ux, uy, wx, wy; int flipped; } mirror; /* z -> u z + w, or of conj z */

static rg_vec2 mirrored(const mirror *k, rg_vec2 z)
{
    const double y = k->flipped ? -z.y : z.y;
    return (rg_vec2){k->ux * z.x - k->uy * y + k->wx, k->ux * y + k->uy * z.x + k->wy};
}

static void flat_folded_is_reflections(void **state)
{
    (void)state;
    static const double alphas[] = {0.5, 1.1, 1.4};
    for (int round = 0; round < 3; round++) {
        rg_pattern *p = draw_miura(6, alphas[round]);
        rg_mesh m = mesh_of(p);
        double rho[MOST];
        mirror way[MOST];
        int done[MOST] = {0};
        miura_angles(&m, alphas[round], RG_PI, rho);
        const posed folded = pose(&m, rho, 0);
        way[0] = (mirror){1, 0, 0, 0, 0};
        done[0] = 1;
        for (int more = 1; more;) {
            more = 0;
            for (int32_t i = 0; i < m.N; i++)
                for (int side = 0; side < 2; side++) {
                    const int32_t e = m.crease_edge[i], f = m.edge_facet[e][side], g = m.edge_facet[e][!side];
                    if (!done[f] || done[g]) continue;
                    /* The facet over e is as f would carry it, mirrored at where f carries the line: the map that sends both
                     * ends there and has the other orientation. u = d / conj(D) or d / D. */
                    const rg_vec2 A = m.X[m.edge[e][0]], B = m.X[m.edge[e][1]], a = mirrored(&way[f], A), b = mirrored(&way[f], B);
                    mirror k = {0, 0, 0, 0, !way[f].flipped};
                    const double Dx = B.x - A.x, Dy = k.flipped ? A.y - B.y : B.y - A.y, dx = b.x - a.x, dy = b.y - a.y, DD = Dx * Dx + Dy * Dy;
                    k.ux = (dx * Dx + dy * Dy) / DD;
                    k.uy = (dy * Dx - dx * Dy) / DD;
                    const rg_vec2 at = mirrored(&k, A);
                    k.wx = a.x - at.x, k.wy = a.y - at.y;
                    way[g] = k;
                    done[g] = 1;
                    more = 1;
                }
        }
        for (int32_t f = 0; f < m.nf; f++) {
            assert_true(done[f]);
            for (int32_t j = m.facet_start[f]; j < m.facet_start[f + 1]; j++) {
                const int32_t v = m.facet_vertex[j];
                const rg_vec2 z = mirrored(&way[f], m.X[v]);
                near(folded.x[v].x, z.x, 1e-12);
                near(folded.x[v].y, z.y, 1e-12);
                near(folded.x[v].z, 0, 1e-13);
            }
            near(folded.place[f].R.c[2].z, way[f].flipped ? -1 : 1, 1e-13);
        }
        rg_mesh_free(&m);
        rg_pattern_destroy(p);
    }
}

/* One crease: the picture that everybody has of it. */
static void a_valley_lifts(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 2, 1);
    draw(&l, RG_VALLEY, 1, 0, 1, 1);
    rg_pattern *p = pattern_of(&l);
    rg_mesh m = mesh_of(p);
    for (int32_t fixed = 0; fixed < 2; fixed++) {
        const double rho = 0.7;
        const posed up = pose(&m, &rho, fixed);
        for (int32_t v = 0; v < m.nv; v++) {
            const rg_vec2 at = m.X[v];
            int held = at.x == 1;
            for (int32_t j = m.facet_start[fixed]; j < m.facet_start[fixed + 1]; j++) held |= m.facet_vertex[j] == v;
            near(up.x[v].x, held ? at.x : 1 + (at.x - 1) * cos(rho), 1e-15);
            near(up.x[v].y, at.y, 1e-15);
            near(up.x[v].z, held ? 0 : sin(rho), 1e-15);
        }
    }
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

/* What does not close: the gap is the largest distance of any two facets' placements of a vertex, also of facets that only
 * touch there. Comparing neighbours over an edge alone missed where their small gaps add up. */
static void gaps(void **state)
{
    (void)state;
    unsigned seed = 15;
    int corners = 0;
    for (int round = 0; round < 300; round++) {
        rg_lines l = drawing();
        draw_patchwork(&l, 2 + round % 4, 0.1 + 0.06 * (round % 8), &seed);
        rg_pattern *p = pattern_of(&l);
        rg_memory mem = rg_mem_default(NULL);
        rg_mesh m;
        if (rg_mesh_from_pattern(p, &mem, &m, NULL) == RG_OK) {
            double rho[MOST], most = 0, neighbours = 0, strain = 0;
            for (int32_t i = 0; i < m.N; i++) rho[i] = noise(&seed) * (round % 3 ? 0.1 : 2);
            const posed k = pose(&m, rho, -1);
            for (int32_t f = 0; f < m.nf; f++)
                for (int32_t g = 0; g < f; g++)
                    for (int32_t i = m.facet_start[f]; i < m.facet_start[f + 1]; i++)
                        for (int32_t j = m.facet_start[g]; j < m.facet_start[g + 1]; j++) {
                            const int32_t v = m.facet_vertex[i];
                            if (v != m.facet_vertex[j]) continue;
                            most = fmax(most, apart(carried(&k.place[f], m.X[v]), carried(&k.place[g], m.X[v])));
                        }
            for (int32_t e = 0; e < m.ne; e++) {
                const int32_t a = m.edge[e][0], b = m.edge[e][1];
                strain = fmax(strain, fabs(apart(k.x[a], k.x[b]) / hypot(m.X[a].x - m.X[b].x, m.X[a].y - m.X[b].y) - 1));
                if (m.edge_crease[e] < 0) continue;
                for (int end = 0; end < 2; end++) {
                    const rg_vec2 x = m.X[m.edge[e][end]];
                    neighbours = fmax(neighbours, apart(carried(&k.place[m.edge_facet[e][0]], x), carried(&k.place[m.edge_facet[e][1]], x)));
                }
            }
            near(k.gap, most, 1e-12);
            near(rg_pose_strain(&m, m.X, k.x), strain, 1e-12);
            corners += most > neighbours * 1.000001;
            rg_mesh_free(&m);
        }
        rg_pattern_destroy(p);
    }
    assert_true(corners > 10);
}

/* A moved pattern with the same angles: all is taken from X, nothing from the mesh's own. */
static void another_pattern(void **state)
{
    (void)state;
    rg_pattern *p = draw_miura(5, 1.1);
    rg_mesh m = mesh_of(p);
    double rho[MOST];
    rg_vec2 X[MOST];
    miura_angles(&m, 1.1, 1.9, rho);
    for (int32_t v = 0; v < m.nv; v++) X[v] = (rg_vec2){2.385 * m.X[v].x, 2.385 * m.X[v].y};
    const posed one = pose(&m, rho, 3), other = pose_with(&m, X, rho, 3);
    for (int32_t v = 0; v < m.nv; v++) {
        near(other.x[v].x, 2.385 * one.x[v].x, 1e-12);
        near(other.x[v].y, 2.385 * one.x[v].y, 1e-12);
        near(other.x[v].z, 2.385 * one.x[v].z, 1e-12);
    }
    below(other.gap, 1e-12);
    below(rg_pose_strain(&m, X, other.x), 1e-12);
    near(rg_pose_strain(&m, m.X, other.x), 1.385, 1e-12);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

static void trees(void **state)
{
    (void)state;
    rg_pattern *p = draw_miura(5, 1.1);
    rg_mesh m = mesh_of(p);
    rg_tree t;
    assert_int_equal(rg_tree_init(&m, m.nf, &t), RG_EARG);
    assert_int_equal(rg_tree_init(&m, -2, &t), RG_EARG);
    assert_int_equal(rg_tree_init(&m, -1, &t), RG_OK);
    int32_t seen[MOST] = {0};
    assert_int_equal(t.nf, m.nf);
    for (int32_t i = 0; i < t.nf; i++) { /* parents before children, each facet once, over an edge of its own */
        const int32_t f = t.order[i], e = t.via[f];
        assert_int_equal(seen[f]++, 0);
        if (i == 0) {
            assert_int_equal(e, -1);
            continue;
        }
        assert_true(m.edge_facet[e][0] == f || m.edge_facet[e][1] == f);
        assert_int_equal(seen[m.edge_facet[e][m.edge_facet[e][0] == f]], 1);
    }
    /* 5 x 5 cells: the one in the middle stays, the rest leans half a lean to one side. */
    rg_vec2 centre = {0, 0};
    const int32_t f = t.order[0];
    for (int32_t j = m.facet_start[f]; j < m.facet_start[f + 1]; j++) centre.x += m.X[m.facet_vertex[j]].x / 4, centre.y += m.X[m.facet_vertex[j]].y / 4;
    near(centre.x, 2.5 * 1.25 + 0.5 / tan(1.1), 1e-12);
    near(centre.y, 2.5, 1e-12);
    rg_tree_free(&t);
    rg_tree_free(&t);
    for (long k = 0; k < 2; k++) {
        counted c = {k, 0, 0};
        rg_memory was = m.mem;
        m.mem = (rg_memory){counted_resize, &c};
        assert_int_equal(rg_tree_init(&m, 0, &t), RG_ENOMEM);
        m.mem = was;
        assert_int_equal(c.out, 0);
    }
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

static void nan_is_not_lost(void **state)
{
    (void)state;
    rg_pattern *p = draw_miura(4, 1.1);
    rg_mesh m = mesh_of(p);
    double rho[MOST];
    for (int32_t i = 0; i < m.N; i++) {
        miura_angles(&m, 1.1, 0.8, rho);
        rho[i] = NAN;
        const posed k = pose(&m, rho, -1);
        rg_tree t;
        assert_int_equal(rg_tree_init(&m, -1, &t), RG_OK);
        int used = 0;
        for (int32_t f = 0; f < m.nf; f++) used |= t.via[f] == m.crease_edge[i];
        rg_tree_free(&t);
        if (!used) continue; /* no way leads over it */
        assert_true(isnan(k.gap));
        assert_true(isnan(rg_pose_strain(&m, m.X, k.x)));
    }
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(miura),
        cmocka_unit_test(creases_that_do_not_meet),
        cmocka_unit_test(degree_4),
        cmocka_unit_test(flat_folded_is_reflections),
        cmocka_unit_test(a_valley_lifts),
        cmocka_unit_test(gaps),
        cmocka_unit_test(another_pattern),
        cmocka_unit_test(trees),
        cmocka_unit_test(nan_is_not_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
