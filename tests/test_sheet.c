/* pattern/sheet.c: one sheet or not, its border by topology, vertices that only break a straight line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "draw.h"
#include "mesh/mesh.h"

/* `way` turns and mirrors what a case draws, so that none hangs on where the first line lies. */
static rg_pattern *turned(rg_lines *l, int way)
{
    for (int32_t i = 0; way >= 4 && i < l->count; i++) l->line[i].a.x *= -1, l->line[i].b.x *= -1;
    for (int32_t i = 0, j = l->count - 1; way % 2 && i < j; i++, j--) {
        const rg_line t = l->line[i];
        l->line[i] = l->line[j], l->line[j] = t;
    }
    draw_moved(l, 1, way, 0.3 * way, -way);
    return pattern_of(l);
}

static rg_pattern_info info_of(const rg_pattern *p)
{
    rg_pattern_info info;
    info = *rg_pattern_get_info(p);
    return info;
}

static void counts(const rg_pattern *p, int V, int E, int F, int N, int M, int N0)
{
    const rg_pattern_info info = info_of(p);
    assert_int_equal(info.vertices, V);
    assert_int_equal(info.edges, E);
    assert_int_equal(info.facets, F);
    assert_int_equal(info.creases, N);
    assert_int_equal(info.interior_vertices, M);
    assert_int_equal(info.boundary_edges, N0);
    assert_int_equal(info.degrees_of_freedom, N - 3 * M);
}

static void is_disk(const rg_pattern *p)
{
    const rg_pattern_info info = info_of(p);
    if (!info.is_disk) print_error("%s\n", info.not_disk);
    assert_int_equal(info.is_disk, 1);
    assert_string_equal(info.not_disk, "");
}

/* Whatever was dissolved, each vertex knows all edges that end at it, once around by their directions. */
static void stars_are_whole(const rg_pattern *p)
{
    int32_t ends = 0;
    for (int32_t v = 0; v < p->nv; v++) {
        double before = -INFINITY;
        for (int32_t j = p->star_start[v]; j < p->star_start[v + 1]; j++, ends++) {
            const int32_t *end = p->E[p->star[j]].v;
            assert_true(end[0] == v || end[1] == v);
            const rg_vec2 d = rg_vec2_sub(p->X[end[end[0] == v]], p->X[v]);
            const double angle = atan2(d.y, d.x);
            assert_true(angle > before);
            before = angle;
        }
    }
    assert_int_equal(ends, 2 * p->ne);
}

/* Refused as a sheet, in those words, and so by what would fold it. */
static void no_disk(const rg_pattern *p, const char *words)
{
    const rg_pattern_info info = info_of(p);
    rg_memory mem = rg_mem_default(NULL);
    rg_mesh m;
    rg_diag why = {0, ""};
    assert_int_equal(info.is_disk, 0);
    if (!strstr(info.not_disk, words)) fail_msg("\"%s\", where \"%s\" was due", info.not_disk, words);
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, &why), RG_ESHEET);
    assert_non_null(strstr(why.text, words));
}

static void plain_sheets(void **state)
{
    (void)state;
    for (int way = 0; way < 8; way++) {
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 3, 2);
        rg_pattern *p = turned(&l, way);
        is_disk(p);
        counts(p, 4, 4, 1, 0, 0, 4);
        rg_pattern_destroy(p);
        l = drawing();
        draw_box(&l, 0, 0, 3, 2);
        draw(&l, RG_VALLEY, 1, 0, 2.25, 2);
        draw(&l, RG_MOUNTAIN, 0, 0.7, 3, 1.385);
        p = turned(&l, way);
        is_disk(p);
        counts(p, 9, 12, 4, 4, 1, 8);
        rg_pattern_destroy(p);
    }
}

/* Real files draw parts of their rim as creases, or guides on it. */
static void border_by_topology(void **state)
{
    (void)state;
    for (int way = 0; way < 8; way++) {
        rg_lines l = drawing();
        draw(&l, RG_MOUNTAIN, 0, 0, 3, 0);
        draw(&l, RG_BORDER, 3, 0, 3, 2);
        draw(&l, RG_UNASSIGNED, 3, 2, 0, 2);
        draw(&l, RG_VALLEY, 0, 2, 0, 0);
        draw(&l, RG_VALLEY, 1, 0, 2.25, 2);
        rg_pattern *p = turned(&l, way);
        is_disk(p);
        counts(p, 6, 7, 2, 1, 0, 6);
        for (int32_t e = 0; e < p->ne; e++) {
            const int rim = p->rim[p->E[e].v[0]] && p->rim[p->E[e].v[1]] && p->E[e].where != 5;
            assert_int_equal(p->E[e].assignment == RG_BORDER, rim);
            if (rim) assert_true(isnan(p->E[e].target));
        }
        assert_int_equal(p->lines.warnings, 1);
        assert_non_null(strstr(p->lines.warning[0].text, "5 creases on the outside")); /* the two long sides are cut in two */
        rg_pattern_destroy(p);
    }
}

static void what_is_no_disk(void **state)
{
    (void)state;
    for (int way = 0; way < 8; way++)
        for (int kind = 0; kind < 12; kind++) {
            static const char *const words[] = {"more than one piece", "touches itself", "one line only", "hole",
                "slit", "slit", "hang together with nothing", "facet touches itself", "no lines that enclose", "no lines that enclose",
                "hole", "one line only"};
            rg_lines l = drawing();
            if (kind != 8 && kind != 9) draw_box(&l, 0, 0, 3, 2);
            switch (kind) {
            case 0: draw_box(&l, 5, 0, 6, 1); break;                    /* beside it */
            case 1: draw_box(&l, 3, 2, 4, 3); break;                    /* at one corner */
            case 2: draw_box(&l, 5, 0, 6, 1), draw(&l, RG_BORDER, 3, 0, 5, 0); break;
            case 3: draw_box(&l, 1, 0.5, 2, 1.5); break;                /* a window, which nothing holds */
            case 4: draw(&l, RG_BORDER, 1, 0, 1, 2); break;             /* cut in two */
            case 5: draw(&l, RG_VALLEY, 0, 1, 3, 1), draw(&l, RG_BORDER, 1, 0, 1, 1); break; /* cut up to a crease */
            case 6:                                                     /* creases that touch nothing */
                draw(&l, RG_VALLEY, 1, 1, 2, 1), draw(&l, RG_VALLEY, 2, 1, 1.5, 1.5), draw(&l, RG_MOUNTAIN, 1.5, 1.5, 1, 1);
                break;
            case 7:                                                     /* creases that hang at one point of the rim */
                draw(&l, RG_VALLEY, 0, 0, 2, 1), draw(&l, RG_VALLEY, 2, 1, 1.5, 1.5), draw(&l, RG_MOUNTAIN, 1.5, 1.5, 0, 0);
                break;
            case 8: break;                                              /* nothing */
            case 9: draw(&l, RG_BORDER, 0, 0, 3, 0), draw(&l, RG_BORDER, 3, 0, 3, 2), draw(&l, RG_VALLEY, 3, 2, 0, 2); break; /* open */
            case 10:                                                    /* a window with creases to the rim */
                draw_box(&l, 1, 0.5, 2, 1.5);
                draw(&l, RG_VALLEY, 0, 0, 1, 0.5), draw(&l, RG_VALLEY, 3, 0, 2, 0.5), draw(&l, RG_VALLEY, 3, 2, 2, 1.5);
                break;
            case 11: draw_box(&l, 5, 0, 6, 1), draw(&l, RG_VALLEY, 2.5, 0, 4, 0.5), draw(&l, RG_VALLEY, 4, 0.5, 5, 0.5); break;
            }
            rg_pattern *p = turned(&l, way);
            no_disk(p, words[kind]);
            rg_pattern_destroy(p);
        }
}

/* The message says where: a window at (1, 0.5) ... (2, 1.5). */
static void the_place_is_told(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 3, 2);
    draw_box(&l, 1, 0.5, 2, 1.5);
    rg_pattern *p = pattern_of(&l);
    const char *at = strchr(info_of(p).not_disk, '(');
    double x, y;
    char copy[240];
    assert_non_null(at);
    snprintf(copy, sizeof copy, "%s", info_of(p).not_disk);
    assert_int_equal(sscanf(strchr(copy, '('), "(%lf, %lf)", &x, &y), 2);
    assert_true((x == 1 || x == 2) && (y == 0.5 || y == 1.5));
    rg_pattern_destroy(p);
}

/* ------------------------------------------------------------------------------------- straight-through vertices ---- */

/* Two lines in one, with what they are and what comes out; 0: the vertex stays. */
static void two_lines_in_one(void **state)
{
    (void)state;
    static const struct { char first, second, one; } cases[] = {
        {'M', 'M', 'M'}, {'V', 'V', 'V'}, {'U', 'U', 'U'}, {'U', 'M', 'M'}, {'V', 'U', 'V'}, {'M', 'V', 0}};
    for (int way = 0; way < 8; way++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            rg_lines l = drawing();
            draw_box(&l, 0, 0, 3, 2);
            draw(&l, cases[i].first, 0, 0.4, 1.2, 0.4 + 0.3 * 1.2);
            draw(&l, cases[i].second, 1.2, 0.4 + 0.3 * 1.2, 3, 0.4 + 0.3 * 3);
            rg_pattern *p = turned(&l, way);
            const int stays = cases[i].one == 0;
            counts(p, 7, 8, 2, 1 + stays, stays, 6);
            assert_int_equal(p->nv, 6 + stays);
            for (int32_t e = 0; e < p->ne; e++)
                if (p->E[e].assignment != RG_BORDER && !stays) {
                    assert_int_equal(p->E[e].assignment, cases[i].one);
                    if (cases[i].one == 'U') assert_true(isnan(p->E[e].target));
                    else near(p->E[e].target, cases[i].one == 'V' ? RG_PI : -RG_PI, 0);
                }
            rg_pattern_destroy(p);
        }
}

/* A corner stays, however the drawing lies; so does a bend of more than a degree in lines hardly longer than the tolerance. */
static void corners_stay(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 1, 1);
        const double bend = kind == 0 ? 0.3 : kind == 1 ? 4e-5 : 1e-5, x = kind < 2 ? 0.5 : 4e-4;
        draw(&l, RG_VALLEY, 0, 0.5, x, 0.5 + bend); /* 1e-5: within the tolerance, but more than a degree */
        draw(&l, RG_VALLEY, x, 0.5 + bend, kind < 2 ? 1 : 8e-4, 0.5);
        if (kind == 2) draw(&l, RG_VALLEY, 8e-4, 0.5, 0.3, 0);
        rg_pattern *p = pattern_of(&l);
        assert_int_equal(info_of(p).interior_vertices, kind == 2 ? 2 : 1);
        rg_pattern_destroy(p);
    }
}

/* Lines in many short parts, border and creases, drawn in no order. */
static void chains(void **state)
{
    (void)state;
    for (unsigned round = 0; round < 20; round++) {
        enum { PARTS = 97 };
        unsigned seed = round;
        int order[2 * PARTS];
        rg_lines l = drawing();
        for (int i = 0; i < 2 * PARTS; i++) order[i] = i;
        for (int i = 2 * PARTS - 1; i > 0; i--) {
            const int j = whole_noise(&seed, i + 1), t = order[i];
            order[i] = order[j], order[j] = t;
        }
        draw(&l, RG_BORDER, 3, 0, 3, 2), draw(&l, RG_BORDER, 3, 2, 0, 2), draw(&l, RG_BORDER, 0, 2, 0, 0);
        for (int i = 0; i < 2 * PARTS; i++) { /* along the bottom, and across the sheet */
            const int k = order[i] % PARTS, across = order[i] >= PARTS;
            const double t = 3.0 * k / PARTS, u = 3.0 * (k + 1) / PARTS, slope = across ? 0.5 : 0;
            const int back = noise(&seed) < 0;
            draw(&l, across ? RG_VALLEY : RG_BORDER, back ? u : t, across * 0.25 + slope * (back ? u : t), back ? t : u, across * 0.25 + slope * (back ? t : u));
        }
        rg_pattern *p = turned(&l, (int)round % 8);
        is_disk(p);
        counts(p, 4 + 2 + 2 * (PARTS - 1), 6 + 2 * (PARTS - 1) + 1, 2, 1, 0, 6);
        stars_are_whole(p);
        rg_pattern_destroy(p);
    }
}

/* A round border in thousands of parts, each vertex so little off its neighbours' line that it may go. Taken together
 * they drifted away: one edge stood for an arc that swelled to several times the tolerance. */
static void nothing_drifts_beyond_the_tolerance(void **state)
{
    (void)state;
    static const int parts[] = {300, 1000, 3000, 10000};
    for (int k = 0; k < 4; k++) {
        const int n = parts[k];
        rg_lines l = drawing();
        rg_vec2 *x = malloc((size_t)n * sizeof *x);
        for (int i = 0; i < n; i++) x[i] = (rg_vec2){cos(2 * RG_PI * i / n), sin(2 * RG_PI * i / n)};
        draw_polygon(&l, RG_BORDER, x, n);
        draw(&l, RG_VALLEY, x[0].x, x[0].y, x[n / 2].x, x[n / 2].y);
        rg_pattern *p = pattern_of(&l);
        is_disk(p);
        for (int i = 0; i < n; i++) {
            double off = INFINITY;
            for (int32_t e = 0; e < p->ne; e++) {
                const rg_vec2 a = p->X[p->E[e].v[0]], d = rg_vec2_sub(p->X[p->E[e].v[1]], a), r = rg_vec2_sub(x[i], a);
                const double t = fmin(1, fmax(0, rg_vec2_dot(r, d) / rg_vec2_dot(d, d)));
                off = fmin(off, hypot(r.x - t * d.x, r.y - t * d.y));
            }
            below(off, 2 * 2e-5 * (1 + 1e-9));
        }
        if (n >= 1000) assert_true(p->nv < n);
        stars_are_whole(p);
        rg_pattern_destroy(p);
        free(x);
    }
}

/* A sheet of any facets: where its graph is in one piece without loose parts, it is a disk, and Euler's formula holds
 * before and after straight-through vertices are gone. */
static void patchworks(void **state)
{
    (void)state;
    unsigned seed = 41;
    int disks = 0, others = 0;
    for (int round = 0; round < 300; round++) {
        rg_lines l = drawing();
        draw_patchwork(&l, 2 + round % 6, 0.1 + 0.08 * (round % 9), &seed);
        rg_pattern *p = pattern_of(&l);
        const rg_pattern_info info = info_of(p);
        stars_are_whole(p);
        if (info.is_disk) {
            assert_int_equal(info.vertices - info.edges + info.facets, 1);
            assert_int_equal(p->nv - p->ne + info.facets, 1);
            assert_int_equal(info.interior_vertices + info.boundary_edges, p->nv);
            int32_t straight = 0;
            for (int32_t v = 0; v < p->nv; v++) {
                if (p->star_start[v + 1] - p->star_start[v] != 2) continue;
                const rg_edge *e = &p->E[p->star[p->star_start[v]]], *f = &p->E[p->star[p->star_start[v] + 1]];
                const rg_vec2 a = p->X[e->v[e->v[0] == v]], b = p->X[f->v[f->v[0] == v]];
                straight += e->assignment == f->assignment && fabs(rg_vec2_turn(a, p->X[v], b)) < 1e-9;
            }
            assert_int_equal(straight, 0);
            disks++;
        } else {
            assert_true(strlen(info.not_disk) > 10);
            others++;
        }
        rg_pattern_destroy(p);
    }
    assert_true(disks > 100 && others > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_sheets),
        cmocka_unit_test(border_by_topology),
        cmocka_unit_test(what_is_no_disk),
        cmocka_unit_test(the_place_is_told),
        cmocka_unit_test(two_lines_in_one),
        cmocka_unit_test(corners_stay),
        cmocka_unit_test(chains),
        cmocka_unit_test(nothing_drifts_beyond_the_tolerance),
        cmocka_unit_test(patchworks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
