/* pattern/drawing.c: a pattern from the caller's arrays is what the same drawing is in a file. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "pattern/pattern.h"

#include <string.h>

/* A square with a crease of each kind from its middle, and a second one on the first. */
static const double AT[][2] = {{0, 0}, {3, 0}, {3, 2}, {0, 2}, {1.25, 1}};
static const int32_t ENDS[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 0}, {4, 1}, {4, 2}, {4, 3}};
static const double TARGET[] = {NAN, NAN, NAN, NAN, -1.1, 0.7, NAN, NAN};

static rg_drawing square(void)
{
    rg_drawing d = rg_drawing_default();
    d.vertices = 5, d.edges = 8, d.at = AT, d.ends = ENDS, d.assignment = "BBBBMVUF", d.target = TARGET;
    d.title = "a square", d.author = "somebody", d.unit = 0.01;
    return d;
}

static const rg_edge *edge_between(const rg_pattern *p, const double *a, const double *b)
{
    for (int32_t e = 0; e < p->ne; e++) {
        const rg_vec2 x = p->X[p->E[e].v[0]], y = p->X[p->E[e].v[1]];
        if ((x.x == a[0] && x.y == a[1] && y.x == b[0] && y.y == b[1]) || (x.x == b[0] && x.y == b[1] && y.x == a[0] && y.y == a[1])) return &p->E[e];
    }
    fail_msg("there is no edge from (%g, %g) to (%g, %g)", a[0], a[1], b[0], b[1]);
    return NULL;
}

static void is_what_was_drawn(void **state)
{
    (void)state;
    for (int targets = 0; targets < 2; targets++) {
        rg_drawing d = square();
        rg_reading r = rg_reading_default();
        rg_pattern *p = NULL;
        rg_diag why = {0, ""};
        r.targets = targets;
        r.aux_creases = 1;
        assert_int_equal(rg_pattern_create(&d, &r, &p, &why), RG_OK);
        assert_int_equal(p->ne, 8);
        for (int32_t e = 0; e < 8; e++) {
            const rg_edge *q = edge_between(p, AT[ENDS[e][0]], AT[ENDS[e][1]]);
            assert_int_equal(q->assignment, d.assignment[e] == 'F' ? 'U' : d.assignment[e]); /* an auxiliary line that may fold */
            assert_int_equal(q->where, e + 1);
            const double usual = d.assignment[e] == 'M' ? -RG_PI : d.assignment[e] == 'V' ? RG_PI : NAN;
            const double want = targets && !isnan(TARGET[e]) ? TARGET[e] : usual;
            if (isnan(want)) assert_true(isnan(q->target));
            else near(q->target, want, 0);
        }
        const rg_pattern_info *i = rg_pattern_get_info(p);
        assert_true(i->is_disk && i->vertices == 5 && i->creases == 4 && i->interior_vertices == 1);
        assert_string_equal(i->title, "a square");
        assert_string_equal(i->author, "somebody");
        near(i->unit, 0.01, 0);
        near(i->size, 3, 0);
        rg_pattern_destroy(p);
    }
}

static int at_once(void *count, double progress)
{
    (void)progress;
    ++*(int *)count;
    return 1;
}

static void is_refused_or_ended(void **state)
{
    (void)state;
    rg_reading r = rg_reading_default();
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    int asked = 0;
    r.progress = at_once;
    r.progress_ctx = &asked;
    rg_drawing d = square();
    assert_int_equal(rg_pattern_create(&d, &r, &p, &why), RG_ECANCELLED);
    assert_true(asked > 0 && why.text[0]);
    r = rg_reading_default();
    static const int32_t beyond[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 0}, {4, 1}, {4, 2}, {4, 5}};
    static const double lost[][2] = {{0, 0}, {3, 0}, {3, 2}, {0, 2}, {1.25, NAN}};
    d.ends = beyond;
    assert_int_equal(rg_pattern_create(&d, &r, &p, &why), RG_EARG);
    d = square(), d.at = lost;
    assert_int_equal(rg_pattern_create(&d, &r, &p, &why), RG_EARG);
    d = square(), d.assignment = "BBBBMVUX";
    assert_int_equal(rg_pattern_create(&d, &r, &p, &why), RG_EARG);
    d = square(), d.edges = 0;
    assert_int_equal(rg_pattern_create(&d, &r, &p, &why), RG_EARG);
    assert_null(p);
}

static void memory_may_be_short(void **state)
{
    (void)state;
    const rg_drawing d = square();
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        rg_reading r = rg_reading_default();
        rg_pattern *p = NULL;
        rg_diag why = {0, ""};
        r.memory = &mem;
        const rg_status s = rg_pattern_create(&d, &r, &p, &why);
        rg_pattern_destroy(p);
        assert_int_equal(c.out, 0);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
        assert_true(why.text[0]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_what_was_drawn),
        cmocka_unit_test(is_refused_or_ended),
        cmocka_unit_test(memory_may_be_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
