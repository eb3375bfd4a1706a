/* Charts: orders of the methods, the closed form, what is written; and that hard places are judged as they are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "chart/chart.h"
#include "counted.h"
#include "paths.h"
#include "contacts.h"
#include "scenarios.h"

static rg_chart *chart_of(rg_pattern *p, int32_t frames)
{
    rg_settings s = rg_settings_default();
    rg_chart *c = NULL;
    rg_diag why = {0, ""};
    s.frames = frames;
    if (rg_chart_create(p, &s, NULL, NULL, &c, &why) != RG_OK) fail_msg("%s", why.text);
    return c;
}

static const rg_order *order_of(const rg_chart *c, rg_method method)
{
    for (int j = 0; j < RG_ORDERS; j++)
        if (c->order[j].method == method) return &c->order[j];
    return NULL;
}

static void degree4(void **state)
{
    (void)state;
    rg_pattern *p = draw_degree4();
    rg_chart *c = chart_of(p, 31);
    assert_true(c->ref.exact);
    below(c->ref.closure, 1e-14);
    near(order_of(c, RG_METHOD_EULER)->open.slope, 1, 0.2);
    near(order_of(c, RG_METHOD_HEUN)->open.slope, 2, 0.2);
    near(order_of(c, RG_METHOD_RK4)->open.slope, 4, 0.2);
    /* The vertex can go one way only: whoever closes is exact, and eq. (14) has an order more than eq. (10). */
    assert_true(order_of(c, RG_METHOD_NEWTON)->closed.exact);
    assert_true(order_of(c, RG_METHOD_HEUN)->closed.exact);
    assert_true(order_of(c, RG_METHOD_RK4)->closed.exact);
    near(order_of(c, RG_METHOD_EULER)->closed.slope, 2, 0.4);

    assert_int_equal(c->alike.order, 1);
    assert_int_equal(c->alike.creases, c->none.unknowns);
    assert_int_equal(3 * c->alike.vertices, c->none.constraints);

    assert_true(rg_chart_reached(c, &c->run[0]));
    below(c->run[0].error, 1e-9);
    for (int32_t i = 1; i < c->runs; i++) {
        assert_true(rg_chart_reached(c, &c->run[i]));
        assert_true(c->run[i].passes > 0 && c->run[i].seconds > 0);
        if (c->run[i].method != RG_METHOD_EULER) below(c->run[i].error, 1e-5);
        if (c->run[i].method != RG_METHOD_EULER || !rg_chart_same_curve(c, i)) continue;
        assert_true(c->run[i].error < c->run[i - 1].error); /* more cost, less error */
        assert_true(c->run[i].passes > c->run[i - 1].passes);
    }
    const rg_run *lean = rg_chart_best(c, 1);
    assert_non_null(lean);
    below(c->run[0].passes, 1.5 * lean->passes);
    rg_chart_destroy(c);
    rg_pattern_destroy(p);
}

/* Along the freedoms of a sheet the orders are those of the formulas, also as it folds. */
static void order_along_freedoms(void **state)
{
    (void)state;
    /* Six creases: three ways to go. */
    rg_pattern *p = vertex(6, (double[]){3.1, 58.2, 121.7, 187.3, 238.9, 301.4}, "VMVVMV");
    rg_settings s = rg_settings_default();
    rg_memory mem = rg_mem_default(NULL);
    rg_mesh m;
    rg_reference ref;
    rg_order order[RG_ORDERS];
    rg_diag why = {0, ""};
    s.frames = 16;
    s.to = 0.4;
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, &why), RG_OK);
    assert_int_equal(rg_reference_make(&ref, &mem, &m, &s, &why), RG_OK);
    assert_false(ref.exact);
    assert_int_equal(ref.frames.count, s.frames);
    below(ref.error, 1e-11);
    assert_true(ref.halvings >= 2 && ref.change[ref.halvings - 1] >= 0);
    assert_int_equal(rg_order_measure(order, &m, &s, &ref, 5, 14, &why), RG_OK);
    static const double expected[RG_ORDERS] = {1, 1, 2, 4};
    for (int j = 0; j < RG_ORDERS; j++) near(order[j].closed.slope, expected[j], 0.2);
    rg_reference_free(&ref);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

/* What nothing folds straight on has the curve of what does fold it; its default is the one of the program. */
static void where_creases_roll(void **state)
{
    (void)state;
    rg_pattern *p = bent_miura(3, 1.25, 1.25, 1e-3, -1);
    rg_chart *c = chart_of(p, 21);
    const rg_relaxed *R = &c->relaxed;
    assert_true(R->folds);
    assert_true(R->best.relax->U > 0);
    assert_int_equal(c->ref.frames.count, 0);
    assert_int_equal(c->run[0].method, RG_METHOD_RELAXED);
    assert_true(R->points > RG_RELAXED_DEFAULT);
    near(R->run[RG_RELAXED_DEFAULT].way.step, c->settings.step, 1e-15);
    assert_true(isnan(R->run[R->points - 1].error)); /* the reference */
    for (int32_t k = 0; k < R->points; k++) {
        const rg_run *r = &R->run[k];
        if (!rg_chart_reached(c, r)) continue;
        assert_true(r->seconds > 0 && r->passes > 0);
        below(r->closure, c->settings.tol);
        if (k) near(r->way.step, R->run[k - 1].way.step / 2, 1e-15);
        if (k) assert_true(r->steps > R->run[k - 1].steps);
        if (k + 1 < R->points) assert_true(r->error >= 0 && r->error < RG_PI && r->pattern_error >= 0 && r->pattern_error < 0.1);
    }
    /* The same try by the program itself: as many steps, and frames of the same bits. */
    rg_settings s = c->settings;
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    s.contact = RG_CONTACT_IGNORE;
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, &why), RG_OK);
    assert_int_equal(rg_motion_report(m)->outcome, RG_FOLDED);
    assert_string_equal(rg_motion_report(m)->strategy, R->strategy);
    assert_int_equal(R->run[RG_RELAXED_DEFAULT].steps, R->best.relax->steps);
    rg_motion_destroy(m);
    rg_chart_destroy(c);
    rg_pattern_destroy(p);
}

static rg_status measure_with(const rg_mesh *m, counted *c)
{
    const rg_memory mem = {counted_resize, c};
    rg_settings s = rg_settings_default();
    rg_relaxed R;
    rg_watch nobody = {0};
    rg_diag why = {0, ""};
    s.memory = &mem;
    s.frames = 3;
    s.effort = RG_EFFORT_FAST;
    const rg_status status = rg_relaxed_measure(&R, m, &s, &nobody, &why);
    if (status == RG_OK && !R.folds) fail_msg("it does not fold");
    if (status == RG_OK) rg_relaxed_free(&R);
    return status;
}

/* Wherever memory runs short: nothing is lost, and it says so. */
static void curve_without_memory(void **state)
{
    (void)state;
    enum { PLACES = 40 };
    rg_pattern *p = bent_miura(2, 1.25, 1.25, 1e-3, -1);
    rg_memory mem = rg_mem_default(NULL);
    rg_mesh m;
    rg_diag why = {0, ""};
    counted all = {1000000000, 0, 0};
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, &why), RG_OK);
    assert_int_equal(measure_with(&m, &all), RG_OK);
    assert_int_equal(all.out, 0);
    int refused = 0;
    for (int k = 0; k < PLACES; k++) {
        const long let = all.asked * k / PLACES;
        counted c = {let, 0, 0};
        const rg_status status = measure_with(&m, &c); /* finer steps are tried as time allows: a slow run asks for less */
        assert_int_equal(status, c.asked > let ? RG_ENOMEM : RG_OK);
        assert_int_equal(c.out, 0);
        refused += status == RG_ENOMEM;
    }
    assert_true(refused >= PLACES / 4);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

static char *slurp(const char *path)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 20) - 1, f) > 0);
    fclose(f);
    return text;
}

static int count_of(const char *text, char c)
{
    int n = 0;
    for (; *text && *text != '\n'; text++) n += *text == c;
    return n;
}

static void files(void **state)
{
    (void)state;
    char folder[] = "/tmp/rigami-chart-XXXXXX", path[64];
    rg_pattern *p = draw_bird();
    rg_chart *c = chart_of(p, 11);
    rg_diag why = {0, ""};
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/x.csv", folder);
    assert_int_equal(rg_chart_write(c, "a,b", path, &why), RG_OK);
    char *text = slurp(path), *line = text;
    const int commas = count_of(text, ',');
    int lines = 0, defaults = 0;
    for (; *line; line = strchr(line, '\n') + 1, lines++) {
        assert_non_null(strchr(line, '\n'));
        assert_int_equal(count_of(line, ','), commas + (lines > 0)); /* the title has one more, in quotes */
        double step = NAN;
        int is_default = -1;
        char method[20];
        if (lines == 0) continue;
        assert_int_equal(sscanf(line, "\"a,b\",%*d,%*d,%19[a-z0-9],%*[a-z],%lf,%*[^,],%d", method, &step, &is_default), 3);
        assert_true(step > 0 && step <= 180);
        defaults += is_default;
    }
    assert_int_equal(lines, c->runs + 1);
    assert_int_equal(defaults, 1);
    free(text);
    remove(path);
    snprintf(path, sizeof path, "%s/x.svg", folder);
    assert_int_equal(rg_chart_write(c, "<&>", path, &why), RG_OK);
    text = slurp(path);
    assert_int_equal(strncmp(text, "<svg ", 5), 0);
    assert_int_equal(strcmp(text + strlen(text) - 7, "</svg>\n"), 0);
    assert_non_null(strstr(text, "&lt;&amp;"));
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "-2147483648"));
    free(text);
    remove(path);
    snprintf(path, sizeof path, "%s/x.md", folder);
    assert_int_equal(rg_chart_write(c, "x", path, &why), RG_OK);
    text = slurp(path);
    assert_non_null(strstr(text, "Symmetries: 4; they leave 5 of 16 creases and 2 of 5 vertices to solve for."));
    free(text);
    remove(path);
    snprintf(path, sizeof path, "%s/x.pdf", folder);
    assert_int_equal(rg_chart_write(c, "x", path, &why), RG_EARG);
    assert_int_not_equal(access(path, F_OK), 0);
    rmdir(folder);
    rg_chart_destroy(c);
    rg_pattern_destroy(p);
}

/* Steps longer than the way between frames once landed on the folded state before the frames that were due, and steps that
 * ended a rounding short of a frame ended the run: no step was small enough for the rest. */
static void every_frame_is_made(void **state)
{
    (void)state;
    static const double steps[] = {30, 2.5, 0.3};
    for (int i = 0; i < 3; i++) {
        rg_pattern *p = draw_bird();
        rg_settings s = column(RG_METHOD_NEWTON, RG_TRIANGULATE_NONE);
        rg_motion *m = NULL;
        rg_diag why = {0, ""};
        s.step = steps[i] * RG_DEG;
        assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, &why), RG_OK);
        const rg_report *r = rg_motion_report(m);
        assert_int_equal(r->outcome, RG_FOLDED);
        assert_int_equal(r->frame_count, s.frames);
        for (int32_t k = 0; k < r->frame_count; k++) near(r->frames[k].percent, 100.0 * k / (s.frames - 1), 1e-6);
        rg_motion_destroy(m);
        rg_pattern_destroy(p);
    }
}

static const scenario *scenario_called(const char *name)
{
    for (int i = 0; i < SCENARIOS; i++)
        if (strcmp(scenarios[i].name, name) == 0) return &scenarios[i];
    fail_msg("no scenario %s", name);
    return NULL;
}

static void hard_places(void **state)
{
    (void)state;
    cell c = try_cell(scenario_called("all mountains"), RG_METHOD_AUTO);
    assert_int_equal(c.verdict, STOPPED);
    assert_true(c.percent < 50);
    c = try_cell(scenario_called("flat start"), RG_METHOD_AUTO);
    assert_int_equal(c.verdict, REACHED);
    c = try_cell(scenario_called("flat start"), RG_METHOD_EULER); /* eq. (14) closes up to its own second order */
    assert_int_equal(c.verdict, DRIFTED);
}

/* Verdicts are of numbers, whatever the method says. */
static void verdicts(void **state)
{
    (void)state;
    const struct { cell c; int reached, verdict; } known[] = {
        {{.percent = 100, .closure = 1e-12}, 1, REACHED},
        {{.percent = 40, .closure = 1e-12}, 0, STOPPED},
        {{.percent = 100, .closure = 1e-9}, 1, DRIFTED},
        {{.percent = 100, .closure = 1e-9, .strain = 1e-3}, 1, DRIFTED},
        {{.percent = 100, .closure = 1e-12, .strain = 1e-5}, 1, DIVERGED},
        {{.percent = 100, .closure = NAN}, 1, DIVERGED},
        {{.percent = 100, .closure = 0.2}, 1, DIVERGED},
        {{.percent = 100, .closure = 1e-12, .beyond = 5.1}, 1, DIVERGED},
        {{.percent = 100, .closure = 1e-12, .strain = NAN}, 1, DIVERGED},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        cell c = known[i].c;
        judge(&c, known[i].reached);
        assert_int_equal(c.verdict, known[i].verdict);
    }
}

static int stop_at_once(void *ctx, double done)
{
    (void)ctx, (void)done;
    return 1;
}

/* What is in its own way crosses where it is left, and not where that is avoided, which costs something. */
static void contact_is_charted(void **state)
{
    (void)state;
    rg_touch t[RG_TOUCHES];
    rg_diag why = {0, ""};
    const rg_settings s = rg_settings_default();
    rg_pattern *p = draw_by_hand();
    assert_int_equal(rg_touch_measure(t, p, &s, NULL, NULL, &why), RG_OK);
    assert_true(t[RG_TOUCH_LEFT].crosses);
    below(0.01, t[RG_TOUCH_LEFT].depth);
    assert_true(t[RG_TOUCH_LEFT].frames > 0);
    assert_false(t[RG_TOUCH_AVOIDED].crosses);
    below(t[RG_TOUCH_AVOIDED].depth, 1e-300);
    for (int k = 0; k < RG_TOUCHES; k++) {
        assert_int_equal(t[k].outcome, RG_FOLDED);
        near(t[k].percent, 100, 1e-6);
        below(1e-9, t[k].seconds);
    }
    assert_int_equal(rg_touch_measure(t, p, &s, stop_at_once, NULL, &why), RG_OK);
    assert_true(t[RG_TOUCH_LEFT].seconds == 0);
    rg_pattern_destroy(p);
}

/* The sheets of the table of contact, those that take less than a second. */
static void what_is_in_its_own_way(void **state)
{
    (void)state;
    static const char *const quick[] = {"pleats", "letter", "roll", "corner over", "corner under", "bird base", "locked"};
    for (int k = 0; k < CONTACTS; k++)
        for (size_t j = 0; j < sizeof quick / sizeof *quick; j++) {
            if (strcmp(contacts[k].name, quick[j]) != 0) continue;
            const contact_seen x = contact_look(&contacts[k]);
            for (int check = 0; check < CONTACT_CHECKS; check++)
                if (contact_fails(&contacts[k], &x, check)) fail_msg("%s: fails check %d", contacts[k].name, check);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contact_is_charted), cmocka_unit_test(what_is_in_its_own_way),
        cmocka_unit_test(degree4),  cmocka_unit_test(order_along_freedoms), cmocka_unit_test(files),
        cmocka_unit_test(where_creases_roll), cmocka_unit_test(curve_without_memory), cmocka_unit_test(verdicts), cmocka_unit_test(every_frame_is_made),  cmocka_unit_test(hard_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
