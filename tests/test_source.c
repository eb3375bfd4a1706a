/* pattern/source.c: vertices, edges and facets have the numbers of the file that they come from. And what a pattern
 * says of lines that it leaves out or joins, and takes as a target. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "pattern/pattern.h"
#include "pattern/source.h"

static rg_pattern *parsed(const char *text, double merge)
{
    rg_pattern *p = NULL;
    rg_reading r = rg_reading_default();
    rg_diag why = {0, ""};
    if (merge > 0) r.merge = merge;
    if (rg_pattern_parse(text, strlen(text), &r, &p, &why) != RG_OK) fail_msg("%s", why.text);
    return p;
}

static int32_t vertex_at(const rg_pattern *p, double x, double y)
{
    for (int32_t v = 0; v < p->nv; v++)
        if (fabs(p->X[v].x - x) < 1e-9 && fabs(p->X[v].y - y) < 1e-9) return v;
    fail_msg("there is no vertex at (%g, %g)", x, y);
    return -1;
}

/* ------------------------------------------------------------------------------------------------- numbers ---- */

/* A strip of four squares. The creases' lower ends are drawn twice, as 4 ... 6 by the border and 10 ... 12 by them. */
#define STRIP                                                                                       \
    "{\"file_spec\": 1.2,"                                                                          \
    " \"vertices_coords\": [[0,0],[4,0],[4,1],[0,1],[1,0],[2,0],[3,0],[1,1],[2,1],[3,1],"           \
    "  [1,0],[2,0],[3,0]],"                                                                         \
    " \"edges_vertices\": [[0,4],[4,5],[5,6],[6,1],[1,2],[2,9],[9,8],[8,7],[7,3],[3,0],"            \
    "  [10,7],[11,8],[12,9]],"                                                                      \
    " \"edges_assignment\": [\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"M\",\"V\",\"M\"]"

static void the_lowest_of_several_numbers(void **state)
{
    (void)state;
    rg_pattern *p = parsed(STRIP "}", 0);
    assert_int_equal(p->nv, 10);
    for (int k = 0; k < 3; k++) assert_int_equal(p->source.vertex[vertex_at(p, 1 + k, 0)], 4 + k);
    for (int k = 0; k < 3; k++) assert_int_equal(p->source.vertex[vertex_at(p, 1 + k, 1)], 7 + k);
    /* In the order of the file. */
    for (int32_t v = 1; v < p->nv; v++) assert_true(p->source.vertex[v] > p->source.vertex[v - 1]);
    rg_pattern_destroy(p);
}

/* Which of the four squares each facet is: by its leftmost corner. */
static void squares(rg_pattern *p, int square[4])
{
    const rg_plane *plane = rg_pattern_get_plane(p);
    assert_int_equal(plane->facets, 4);
    for (int f = 0; f < 4; f++) {
        double left = INFINITY;
        for (int32_t j = p->facet_start[f]; j < p->facet_start[f + 1]; j++)
            left = fmin(left, p->X[p->facet_vertex[j]].x);
        square[f] = (int)left;
    }
}

/* Facets that the file lists come first, in its order, the others after them in the order that they would have
 * without. */
static void facets_in_the_order_of_the_file(void **state)
{
    (void)state;
    static const char *const lists[] = {"", ", \"faces_vertices\": [[5,6,9,8]]",
        ", \"faces_vertices\": [[6,1,2,9],[0,4,7,3]]"};
    static const int listed[][2] = {{-1, -1}, {2, -1}, {3, 0}};
    int own[4];
    for (int k = 0; k < 3; k++) {
        char text[2000];
        int now[4], n = 0;
        snprintf(text, sizeof text, "%s%s}", STRIP, lists[k]);
        rg_pattern *p = parsed(text, 0);
        squares(p, k ? now : own);
        for (; k && n < 2 && listed[k][n] >= 0; n++) assert_int_equal(now[n], listed[k][n]);
        for (int f = 0; k && f < 4; f++)
            if (own[f] != listed[k][0] && own[f] != listed[k][1]) assert_int_equal(now[n++], own[f]);
        assert_int_equal(n, k ? 4 : 0);
        rg_pattern_destroy(p);
    }
}

/* Of a finer pattern, each number is that of what it is a part of. */
static void numbers_follow(void **state)
{
    (void)state;
    rg_source s = {.mem = rg_mem_default(NULL), .nv = 3, .ne = 2};
    s.vertex = rg_mem_array(&s.mem, 3, sizeof *s.vertex);
    s.edge = rg_mem_array(&s.mem, 2, sizeof *s.edge);
    s.where = rg_mem_array(&s.mem, 2, sizeof *s.where);
    assert_true(s.vertex && s.edge && s.where);
    for (int32_t k = 0; k < 3; k++) s.vertex[k] = 10 + k;
    for (int32_t k = 0; k < 2; k++) s.edge[k] = 20 + k, s.where[k] = 30 + k;
    assert_int_equal(rg_source_follow(&s, 4, (const int32_t[]){2, 0, -1, 3}, 3, (const int32_t[]){1, 0, -1}), RG_OK);
    assert_int_equal(s.nv, 4);
    assert_int_equal(s.ne, 3);
    assert_memory_equal(s.vertex, ((const int32_t[]){12, 10, -1, -1}), 4 * sizeof *s.vertex);
    assert_memory_equal(s.edge, ((const int32_t[]){21, 20, -1}), 3 * sizeof *s.edge);
    assert_memory_equal(s.where, ((const int32_t[]){31, 30, 0}), 3 * sizeof *s.where);
    rg_source_free(&s);
}

/* A motion's creases know which line of the drawing they are, and how far each turns from frame to frame, whichever
 * way. */
static void of_a_motion(void **state)
{
    (void)state;
    for (int valley = 0; valley < 2; valley++) {
        char text[200];
        snprintf(text, sizeof text, "1 0 0 9 0\n1 9 0 9 9\n%d 2 0 2 9\n1 9 9 0 9\n1 0 9 0 0\n", valley ? 3 : 2);
        rg_pattern *p = parsed(text, 0);
        rg_settings s = rg_settings_default();
        rg_motion *m = NULL;
        rg_crease crease;
        s.frames = 7;
        assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
        const rg_report *r = rg_motion_report(m);
        assert_int_equal(r->outcome, RG_FOLDED);
        near(r->max_leap_deg, 30, 1e-9);
        near(r->max_wrong_side_deg, 0, 0);
        assert_int_equal(rg_motion_crease(m, 0, &crease), RG_OK);
        assert_int_equal(crease.line, 3);
        assert_int_equal(crease.assignment, valley ? RG_VALLEY : RG_MOUNTAIN);
        rg_motion_destroy(m);
        rg_pattern_destroy(p);
    }
}

/* ----------------------------------------------------------------------------------------------- what is said ---- */

#define BOX "1 0 0 10 0\n1 10 0 10 10\n1 10 10 0 10\n1 0 10 0 0\n"

/* Of a drawing that has no crease left, how many it had is told; of one with creases, those without length are no
 * matter. */
static void creases_without_length(void **state)
{
    (void)state;
    static const struct { const char *text; int creases, lost; } cases[] = {{BOX "2 3 3 3 3\n3 4 4 4 4\n", 0, 2},
        {BOX, 0, 0}, {BOX "2 3 3 3 3\n2 0 0 10 10\n", 1, 0}};
    for (int k = 0; k < 3; k++) {
        rg_pattern *p = parsed(cases[k].text, 0);
        assert_int_equal(p->info.creases, cases[k].creases);
        assert_int_equal(p->info.lost_creases, cases[k].lost);
        rg_pattern_destroy(p);
    }
}

/* One loose end is one warning, and no other says that there are no more. */
static void one_loose_end_is_told_once(void **state)
{
    (void)state;
    rg_pattern *p = parsed(BOX "2 0 0 10 10\n3 5 0 5 2\n", 0);
    const rg_diag *list;
    assert_int_equal(rg_pattern_warnings(p, &list), 1);
    assert_non_null(strstr(list[0].text, "a loose end at (5, 2)"));
    rg_pattern_destroy(p);
}

/* What is off a line by less than the part of the sheet that --merge says is on it, whatever the sheet's size. */
static void merging_goes_by_the_size(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[400];
        const double size = k ? 1000 : 0.001, off = 0.004 * size;
        for (int is_on = 0; is_on < 2; is_on++) {
            snprintf(text, sizeof text, "1 0 0 %g %g\n1 %g %g %g 0\n1 %g 0 %g %g\n1 %g %g 0 %g\n1 0 %g 0 0\n",
                size / 2, -off, size / 2, -off, size, size, size, size,
                     size, size, size, size);
            rg_pattern *p = parsed(text, is_on ? 0.005 : 0.001);
            assert_int_equal(p->nv, is_on ? 4 : 5);
            rg_pattern_destroy(p);
        }
    }
}

static void targets_that_may_be(void **state)
{
    (void)state;
    rg_pattern *p = parsed(BOX "2 0 0 10 10\n", 0);
    const rg_plane *plane = rg_pattern_get_plane(p);
    const int32_t e = rg_pattern_edge_at(p, (const double[]){5, 5});
    assert_true(e >= 0 && plane->assignment[e] == RG_MOUNTAIN);
    static const double may[] = {1, -1, RG_PI, -RG_PI, 0}, may_not[] = {3.2, -3.2, NAN, 2e9};
    for (size_t k = 0; k < sizeof may / sizeof *may; k++) {
        assert_int_equal(rg_pattern_set_target(p, e, may[k]), RG_OK);
        near(p->target[e], may[k], 0);
        near(p->E[e].target, may[k], 0);
    }
    for (size_t k = 0; k < sizeof may_not / sizeof *may_not; k++)
        assert_int_equal(rg_pattern_set_target(p, e, may_not[k]), RG_EARG);
    near(p->target[e], 0, 0);
    assert_int_equal(rg_pattern_set_target(p, e, RG_FREE), RG_OK);
    assert_true(isnan(p->target[e]));
    assert_int_equal(rg_pattern_set_target(p, p->ne, 1), RG_EARG);
    assert_int_equal(rg_pattern_set_target(p, -1, 1), RG_EARG);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_lowest_of_several_numbers),
        cmocka_unit_test(facets_in_the_order_of_the_file),
        cmocka_unit_test(numbers_follow),
        cmocka_unit_test(of_a_motion),
        cmocka_unit_test(creases_without_length),
        cmocka_unit_test(one_loose_end_is_told_once),
        cmocka_unit_test(merging_goes_by_the_size),
        cmocka_unit_test(targets_that_may_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
