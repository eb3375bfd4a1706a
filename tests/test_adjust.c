/* fold/adjust.c: closed vertices go where their inside angles are smaller, and only while they fold unevenly. */
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
#include "fold/adjust.h"
#include "generate/generate.h"

static rg_pattern *generated(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    return pattern_of(&l);
}

typedef struct sheet { rg_pattern *p; rg_mesh m; rg_freedom f; rg_adjust a; double *rho, *u; } sheet;

/* The mesh and the freedom are borrowed by their addresses. */
static void open_sheet(sheet *s, rg_pattern *p, int triangulated)
{
    const rg_memory mem = rg_mem_default(NULL);
    *s = (sheet){.p = p, .m = mesh_of(p)};
    if (triangulated) {
        rg_mesh drawn = s->m;
        assert_int_equal(rg_triangulate_all(&drawn, &s->m), RG_OK);
        rg_mesh_free(&drawn);
    }
    assert_int_equal(rg_freedom_init(&s->f, &mem, &s->m, 1), RG_OK);
    assert_int_equal(rg_adjust_init(&s->a, &mem, &s->f), RG_OK);
    s->rho = calloc((size_t)s->m.N + 1, sizeof *s->rho);
    s->u = calloc((size_t)s->f.U + 1, sizeof *s->u);
    assert_true(s->rho && s->u);
}

static void close_sheet(sheet *s)
{
    rg_adjust_free(&s->a);
    rg_adjust_free(&s->a);
    rg_freedom_free(&s->f);
    rg_mesh_free(&s->m);
    rg_pattern_destroy(s->p);
    free(s->rho);
    free(s->u);
}

static double angle_between(const double *a, const double *b, double x, double y)
{
    const double p[2] = {a[0] - x, a[1] - y}, q[2] = {b[0] - x, b[1] - y};
    return acos((p[0] * q[0] + p[1] * q[1]) / (hypot(p[0], p[1]) * hypot(q[0], q[1])));
}

static char assignment_to(const rg_pattern *p, const rg_closed *t, const double *end)
{
    for (int32_t e = 0; e < p->ne; e++)
        for (int i = 0; i < 2; i++) {
            const rg_vec2 near_end = p->X[p->E[e].v[i]], far = p->X[p->E[e].v[!i]];
            if (hypot(near_end.x - t->x, near_end.y - t->y) < 1e-9 && hypot(far.x - end[0], far.y - end[1]) < 1e-9)
                return p->E[e].assignment;
        }
    return 0;
}

static double inside(const rg_pattern *p, const rg_closed *t, double dx, double dy)
{
    const double *far = assignment_to(p, t, t->a) != assignment_to(p, t, t->c) ? t->a : t->b;
    return angle_between(far, t->c, t->x + dx, t->y + dy);
}

/* Each inside angle by differences, when the vertex goes h along d: by how much they grow, each over the most that it can. */
static double growth_of_all(const rg_pattern *p, double x, double y, rg_vec2 d, int *count)
{
    const rg_closed *list;
    const int32_t n = rg_pattern_closed(p, &list);
    const double h = 1e-4;
    double sum = 0;
    *count = 0;
    for (int32_t i = 0; i < n; i++) {
        if (hypot(list[i].x - x, list[i].y - y) > 1e-9) continue;
        near(inside(p, &list[i], 0, 0), list[i].inside_angle, 1e-7);
        const double along = (inside(p, &list[i], h * d.x, h * d.y) - inside(p, &list[i], -h * d.x, -h * d.y)) / (2 * h);
        const double gx = (inside(p, &list[i], h, 0) - inside(p, &list[i], -h, 0)) / (2 * h);
        const double gy = (inside(p, &list[i], 0, h) - inside(p, &list[i], 0, -h)) / (2 * h);
        sum += along / hypot(gx, gy);
        ++*count;
    }
    return sum;
}

/* One inside angle: the steepest way down. Two or more: their steepest ways, added. */
static void inside_angles_shrink(void **state)
{
    (void)state;
    static const char *const kinds[] = {"crane", "frog", "open-sink", "boxpleat", "closed-split", "closed-adjust", "four-crane"};
    int single = 0, several = 0;
    for (int k = 0; k < 14; k++) {
        sheet s;
        open_sheet(&s, generated(kinds[k % 7], 0), k >= 7);
        rg_pattern_info info;
        info = *rg_pattern_get_info(s.p);
        assert_int_equal(s.a.count, info.closed_vertices);
        for (int32_t i = 0; i < s.a.count; i++) {
            const rg_vec2 at = s.m.X[s.m.inner_vertex[s.a.k[i]]], d = s.a.direction[i];
            int count;
            if (rg_vec2_length(d) == 0) { /* those that cancel: no way shrinks their sum */
                near(growth_of_all(s.p, at.x, at.y, (rg_vec2){1, 0}, &count), 0, 1e-6);
                near(growth_of_all(s.p, at.x, at.y, (rg_vec2){0, 1}, &count), 0, 1e-6);
                assert_true(count > 1);
                continue;
            }
            near(rg_vec2_length(d), 1, 1e-12);
            const double down = growth_of_all(s.p, at.x, at.y, d, &count);
            const double across = growth_of_all(s.p, at.x, at.y, (rg_vec2){-d.y, d.x}, &count);
            assert_true(count > 0 && down < 0);
            near(across, 0, 1e-6);
            if (count > 1) {
                several++;
                continue;
            }
            near(down, -1, 1e-6);
            single++;
        }
        close_sheet(&s);
    }
    assert_true(single + several > 60 && several > 10);
}

static void nothing_flat_nothing_folded(void **state)
{
    (void)state;
    for (int triangulated = 0; triangulated < 2; triangulated++) {
        unsigned seed = 41;
        sheet s;
        open_sheet(&s, generated("crane", 0), triangulated);
        s.u[0] = 7; /* whatever was there */
        rg_adjust_wish(&s.a, s.rho, 0.1, s.u);
        for (int32_t i = 0; i < s.f.U; i++) near(s.u[i], 0, 0);
        for (int32_t i = 0; i < s.m.N; i++) {
            const char a = s.m.assignment[s.m.crease_edge[i]];
            s.rho[i] = i >= s.m.N - s.m.added ? 0.5 * noise(&seed) : a == RG_MOUNTAIN ? -RG_PI : RG_PI;
            if (i % 3 == 0 && i < s.m.N - s.m.added) s.rho[i] *= 1.01; /* beyond counts as folded */
        }
        rg_adjust_wish(&s.a, s.rho, 0.1, s.u);
        for (int32_t i = 0; i < s.f.U; i++) near(s.u[i], 0, 0);
        close_sheet(&s);
    }
}

/* gain * reach * (most - least) / pi along the direction, and no other vertex wishes anything. */
static void by_how_much(void **state)
{
    (void)state;
    unsigned seed = 42;
    for (int round = 0; round < 8; round++) {
        sheet s;
        open_sheet(&s, generated(round % 2 ? "frog" : "boxpleat", 0), round % 4 > 1);
        const double gain = 0.03 + 0.1 * round;
        double *wish = calloc((size_t)s.f.U, sizeof *wish);
        for (int32_t i = 0; i < s.m.N; i++) s.rho[i] = 2.385 * noise(&seed);
        rg_adjust_wish(&s.a, s.rho, gain, s.u);
        for (int32_t i = 0; i < s.a.count; i++) {
            const int32_t v = s.m.inner_vertex[s.a.k[i]];
            double most = 0, least = RG_PI, reach = INFINITY;
            for (int32_t j = 0; j < s.m.N - s.m.added; j++) {
                const int32_t *e = s.m.edge[s.m.crease_edge[j]];
                if (e[0] != v && e[1] != v) continue;
                most = fmax(most, fabs(s.rho[j]));
                least = fmin(least, fabs(s.rho[j]));
                reach = fmin(reach, rg_vec2_length(rg_vec2_sub(s.m.X[e[0]], s.m.X[e[1]])));
            }
            const double by = gain * reach * (most - least) / RG_PI;
            wish[s.f.way[v][0]] = by * s.a.direction[i].x;
            wish[s.f.way[v][1]] = by * s.a.direction[i].y;
        }
        for (int32_t i = 0; i < s.f.U; i++) near(s.u[i], wish[i], 1e-12 * s.m.size);
        free(wish);
        close_sheet(&s);
    }
}

static void open_ones_wish_nothing(void **state)
{
    (void)state;
    sheet s;
    open_sheet(&s, draw_miura(4, 1.125), 0);
    assert_int_equal(s.a.count, 0);
    miura_angles(&s.m, 1.125, 1, s.rho);
    rg_adjust_wish(&s.a, s.rho, 1, s.u);
    for (int32_t i = 0; i < s.f.U; i++) near(s.u[i], 0, 0);
    close_sheet(&s);
}

static void memory(void **state)
{
    (void)state;
    counted c = {0, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    sheet s;
    open_sheet(&s, generated("frog", 0), 0);
    rg_adjust a;
    for (long k = 0;; k++) {
        c.left = k;
        const rg_status status = rg_adjust_init(&a, &mem, &s.f);
        if (status == RG_OK) break;
        assert_int_equal(status, RG_ENOMEM);
        assert_int_equal(c.out, 0);
    }
    rg_adjust_free(&a);
    assert_int_equal(c.out, 0);
    close_sheet(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inside_angles_shrink), cmocka_unit_test(nothing_flat_nothing_folded), cmocka_unit_test(by_how_much),
        cmocka_unit_test(open_ones_wish_nothing), cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
