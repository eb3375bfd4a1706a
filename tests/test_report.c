/* write/report.c, info.c: the keys that scripts rely on, what is said of a pattern, to people too. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "motions.h"
#include "written.h"

#include <jansson.h>

static json_t *read_json(const char *name)
{
    size_t n;
    json_error_t error;
    char *text = written_read(name, &n);
    json_t *j = json_loadb(text, n, JSON_REJECT_DUPLICATES, &error);
    if (!j) fail_msg("line %d: %s", error.line, error.text);
    free(text);
    return j;
}

/* Keys of one object, blanks between; '#': numbers, '$': strings, '[': lists, '0': null. */
static void has(const json_t *object, const char *kinds, ...)
{
    va_list keys;
    va_start(keys, kinds);
    for (const char *k = kinds; *k; k++) {
        const char *key = va_arg(keys, const char *);
        const json_t *value = json_object_get(object, key);
        const int right = *k == '#' ? json_is_number(value) : *k == '$' ? json_is_string(value) : *k == '[' ? json_is_array(value)
                                                                                                       : json_is_null(value);
        if (!right) fail_msg("%s is %s", key, value ? "of another type" : "not there");
    }
    va_end(keys);
}

static double number(const json_t *object, const char *key)
{
    if (!json_is_number(json_object_get(object, key))) fail_msg("%s is no number", key);
    return json_number_value(json_object_get(object, key));
}

static void has_pattern_keys(const json_t *j)
{
    has(j, "##########", "vertices", "edges", "creases", "facets", "interior_vertices", "boundary_edges", "degrees_of_freedom",
        "closed_vertices", "kawasaki_max_deg", "maekawa_violations");
}

/* ------------------------------------------------------------------------------------------------ report ---- */

static void report_has_all_keys(void **state)
{
    (void)state;
    double alpha = 1.125;
    char path[300];
    rg_lines l = miura(3, 3, 1.25, 2.385, alpha);
    rg_motion *m = motion_by(&l, 5, miura_folds, &alpha);
    int32_t vertex[] = {3, 1}, crease[] = {2};
    const double where[][2] = {{0.5, 1.25}, {2.385, -1}};
    rg_report *r = &m->report;
    r->method = "newton", r->solver = "cg", r->triangulation = "none", r->why_triangulated = "asked for";
    r->outcome = RG_STOPPED, r->steps = 41, r->solves = 43, r->cg_iterations = (int64_t)1 << 40, r->folded_percent = 71.25;
    r->max_edge_strain = NAN, r->max_facet_gap = INFINITY, r->max_closure_residual = 1.0 / 3;
    r->blocking_vertices = vertex, r->blocking_vertex_count = 2, r->blocking_creases = crease, r->blocking_crease_count = 1;
    r->blocking_at = where;
    r->contact = RG_CONTACT_CROSSES, r->first_contact_frame = 3, r->first_contact_percent = 61.5, r->deepest_contact_frame = -1;
    r->contact_facets[1] = 4, r->contact_at[1][0] = 2.385, r->contact_pairs = 7, r->contact_depth = 0.0125;
    m->frame[3].closure_residual = 0.1;
    snprintf(r->reason, sizeof r->reason, "held at \"one\" vertex");
    assert_int_equal(rg_report_write(m, 0.125, 12345678, written_path("report.json", path), NULL), RG_OK);
    json_t *j = read_json("report.json");
    const json_t *pattern = json_object_get(j, "pattern"), *model = json_object_get(j, "model"), *run = json_object_get(j, "run");
    const json_t *result = json_object_get(j, "result"), *frames = json_object_get(j, "frames");
    assert_string_equal(json_string_value(json_object_get(j, "rigami")), rg_version());
    has_pattern_keys(pattern);
    has(model, "####", "added_creases", "unknowns", "constraints", "components");
    has(run, "$$#########", "method", "solver", "steps", "solves", "cg_iterations", "factorizations", "assemblies", "seconds_total",
        "seconds_solving", "seconds_writing", "peak_bytes");
    has(result, "$$###00###[[$####[[0", "outcome", "reason", "folded_percent", "least_folded_percent", "max_closure_residual",
        "max_edge_strain", "max_facet_gap", "max_overfold_deg", "max_adjustment", "max_strain_from_original", "blocking_vertices",
        "blocking_creases", "contact", "first_contact_frame", "first_contact_percent", "contact_pairs", "contact_depth", "contact_facets",
        "contact_at", "deepest_contact_frame");
    assert_string_equal(json_string_value(json_object_get(result, "contact")), "crosses");
    near(number(result, "first_contact_percent"), 61.5, 0);
    near(number(result, "contact_pairs"), 7, 0);
    near(json_number_value(json_array_get(json_array_get(json_object_get(result, "contact_at"), 1), 0)), 2.385, 0);
    assert_string_equal(json_string_value(json_object_get(result, "outcome")), "stopped");
    assert_string_equal(json_string_value(json_object_get(result, "reason")), "held at \"one\" vertex");
    near(number(result, "max_closure_residual"), 1.0 / 3, 0);
    near(number(result, "folded_percent"), 71.25, 0);
    near(number(run, "cg_iterations"), (double)((int64_t)1 << 40), 0);
    near(number(run, "peak_bytes"), 12345678, 0);
    near(number(run, "seconds_writing"), 0.125, 0);
    near(number(pattern, "interior_vertices"), 4, 0);
    near(number(pattern, "creases"), 12, 0);
    assert_int_equal(json_array_size(json_object_get(result, "blocking_vertices")), 2);
    near(json_number_value(json_array_get(json_object_get(result, "blocking_vertices"), 0)), 3, 0);
    near(json_number_value(json_array_get(json_array_get(json_object_get(result, "blocking_at"), 1), 0)), 2.385, 0);
    const json_t *creases = json_object_get(j, "creases"), *one = json_array_get(creases, 1);
    assert_int_equal(json_array_size(creases), m->mesh.N);
    near(number(one, "number"), 1, 0);
    for (size_t k = 0; k < 2; k++) {
        const int32_t v = m->mesh.edge[m->mesh.crease_edge[1]][k];
        assert_int_equal(json_integer_value(json_array_get(json_object_get(one, "vertices"), k)), v);
        near(json_number_value(json_array_get(json_array_get(json_object_get(one, "at"), k), 1)), m->mesh.X[v].y, 0);
    }
    assert_int_equal(json_string_value(json_object_get(one, "assignment"))[0], m->mesh.assignment[m->mesh.crease_edge[1]]);
    assert_true(json_is_false(json_object_get(one, "added")));
    near(fabs(number(one, "target_deg")), 180, 0);
    assert_int_equal(json_array_size(frames), 5);
    for (size_t k = 0; k < 5; k++) near(number(json_array_get(frames, k), "percent"), 25.0 * (double)k, 0);
    near(number(json_array_get(frames, 3), "closure_residual"), 0.1, 0);
    json_decref(j);
    r->outcome = RG_FOLDED;
    r->contact = RG_CONTACT_FREE, r->first_contact_frame = r->contact_facets[0] = -1, r->first_contact_percent = NAN;
    assert_int_equal(rg_report_write(m, 0, 0, path, NULL), RG_OK);
    j = read_json("report.json");
    has(json_object_get(j, "result"), "00", "first_contact_frame", "first_contact_percent");
    assert_string_equal(json_string_value(json_object_get(json_object_get(j, "result"), "contact")), "free");
    assert_int_equal(json_array_size(json_object_get(json_object_get(j, "result"), "contact_facets")), 0);
    assert_string_equal(json_string_value(json_object_get(json_object_get(j, "result"), "outcome")), "folded");
    json_decref(j);
    rg_motion_destroy(m);
}

static void nowhere_to_write(void **state)
{
    (void)state;
    char path[300];
    rg_diag why = {7, ""};
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 1.25, 2.385);
    rg_pattern *p = pattern_of(&l);
    written_path("none/x.json", path);
    assert_int_equal(rg_info_write(p, path, &why), RG_EWRITE);
    assert_non_null(strstr(why.text, "none/x.json"));
    assert_int_equal(why.line, 0);
    assert_int_equal(rg_info_text(p, 0, path, NULL), RG_EWRITE);
    rg_pattern_destroy(p);
}

/* -------------------------------------------------------------------------------------------------- info ---- */

/* A square with one vertex at (0.1, 0.2) and creases from it at the angles given, degrees. */
static rg_pattern *star(int n, const double *angle, const char *assignment)
{
    rg_lines l = drawing();
    draw_box(&l, -1, -1, 1, 1);
    for (int i = 0; i < n; i++) {
        const double dx = cos(angle[i] * RG_DEG), dy = sin(angle[i] * RG_DEG);
        const double x = 0.1, y = 0.2, to_x = fabs(((dx > 0 ? 1 : -1) - x) / dx), to_y = fabs(((dy > 0 ? 1 : -1) - y) / dy);
        const double t = fmin(to_x, to_y);
        draw(&l, assignment[i], x, y, x + t * dx, y + t * dy);
    }
    return pattern_of(&l);
}

typedef struct expected { int n; double angle[6]; const char *assignment, *theorem; double by; const char *words; } expected;

/* Sector angles and letters are chosen so that exactly one theorem fails. */
static const expected CASES[] = {
    {4, {0, 40, 140, 280}, "MVVV", NULL, 0, "likely"},                                /* 40 + 140 = 100 + 80 */
    {4, {0, 40, 140, 280}, "VVVM", "big-little-big", 40, "smallest angle, by 40 degrees"},
    {4, {0, 40, 140, 280}, "MMVV", "Maekawa", 0, "differ by 0"},
    {4, {0, 40, 145, 280}, "MVVV", "Kawasaki", 5, "Kawasaki"},
    {3, {10, 130, 255}, "MVV", "even degree", 3, "odd number"},
};

static void theorems_are_named(void **state)
{
    (void)state;
    char path[300];
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        const expected *c = &CASES[i];
        rg_pattern *p = star(c->n, c->angle, c->assignment);
        assert_int_equal(rg_info_write(p, written_path("info.json", path), NULL), RG_OK);
        assert_int_equal(rg_info_text(p, 1, written_path("info.txt", path), NULL), RG_OK);
        json_t *j = read_json("info.json"), *list = json_object_get(j, "unfoldable"), *first = json_array_get(list, 0);
        char *text = written_read("info.txt", NULL);
        if (c->theorem && (json_array_size(list) < 1 || strcmp(json_string_value(json_object_get(first, "theorem")), c->theorem) != 0))
            fail_msg("case %d: %s is not told", (int)i, c->theorem);
        if (!strstr(text, c->words)) fail_msg("case %d: %s\nhas no \"%s\"", (int)i, text, c->words);
        has_pattern_keys(j);
        has(j, "[[[", "closed", "unfoldable", "warnings");
        if (c->theorem) {
            near(number(first, "by"), c->by, 1e-9);
            near(json_number_value(json_array_get(json_object_get(first, "coordinates"), 0)), 0.1, 1e-12);
            assert_non_null(strstr(text, "(0.1, 0.2)"));
        } else {
            assert_int_equal(json_array_size(list), 0);
        }
        free(text);
        json_decref(j);
        rg_pattern_destroy(p);
    }
}

/* At a vertex with more than one smallest angle, the worst counts; creases that say nothing break nothing. */
static void big_little_big(void **state)
{
    (void)state;
    const double angle[] = {0, 30, 130, 180, 210, 310}; /* sectors 30 100 50 30 100 50 */
    const rg_unfoldable *list;
    rg_pattern *p = star(6, angle, "MMMMVV"); /* both sectors of 30 lie between a larger 100 and 50 */
    assert_int_equal(rg_pattern_unfoldable(p, &list), 1);
    assert_int_equal(list[0].theorem, RG_BIG_LITTLE_BIG);
    near(list[0].by, 20, 1e-9);
    rg_pattern_destroy(p);
    p = star(6, angle, "MVMMVM"); /* only opposite ones around them */
    assert_int_equal(rg_pattern_unfoldable(p, &list), 0);
    rg_pattern_destroy(p);
    p = star(6, angle, "UUMMVM");
    assert_int_equal(rg_pattern_unfoldable(p, &list), 0);
    rg_pattern_destroy(p);
}

static void closed_vertices_and_warnings_are_listed(void **state)
{
    (void)state;
    char path[300];
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 2.5, 2.385);
    draw(&l, RG_MOUNTAIN, 0, 1.1, 2.5, 1.1);
    draw(&l, RG_MOUNTAIN, 1.2, 0, 1.2, 1.1);
    draw(&l, RG_VALLEY, 1.2, 1.1, 1.2, 2.385);
    draw(&l, RG_VALLEY, 0.3, 0.3, 0.6, 0.7); /* loose */
    rg_pattern *p = pattern_of(&l);
    assert_int_equal(rg_info_write(p, written_path("info.json", path), NULL), RG_OK);
    assert_int_equal(rg_info_text(p, 1, written_path("info.txt", path), NULL), RG_OK);
    json_t *j = read_json("info.json"), *closed = json_object_get(j, "closed"), *warning = json_object_get(j, "warnings");
    char *text = written_read("info.txt", NULL);
    assert_true(json_array_size(closed) > 0);
    near(number(j, "closed_vertices"), 1, 0);
    near(number(json_array_get(closed, 0), "inside_angle_deg"), 90, 1e-9);
    near(json_number_value(json_array_get(json_object_get(json_array_get(closed, 0), "coordinates"), 1)), 1.1, 1e-12);
    assert_int_equal(json_array_size(json_object_get(json_array_get(closed, 0), "creases")), 3);
    int located = 0;
    for (size_t i = 0; i < json_array_size(warning); i++) located += number(json_array_get(warning, i), "line") == 8;
    assert_true(located > 0);
    assert_non_null(strstr(text, "(1.2, 1.1)"));
    assert_non_null(strstr(text, "line 8"));
    assert_non_null(strstr(text, "lock"));
    free(text);
    json_decref(j);
    rg_pattern_destroy(p);
}

/* The number of creases that triangulating adds is a formula in the text; here it is counted. */
static void triangulating_is_foretold(void **state)
{
    (void)state;
    unsigned seed = 77;
    char path[300];
    int disks = 0;
    for (int i = 0; i < 40; i++) {
        rg_lines l = drawing();
        draw_patchwork(&l, 5, 0.3, &seed);
        rg_pattern *p = pattern_of(&l);
        const rg_memory mem = rg_mem_default(NULL);
        rg_mesh m, T;
        assert_int_equal(rg_info_write(p, written_path("info.json", path), NULL), RG_OK);
        json_t *j = read_json("info.json");
        if (json_is_true(json_object_get(j, "is_disk"))) {
            disks++;
            assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, NULL), RG_OK);
            assert_int_equal(rg_triangulate_all(&m, &T), RG_OK);
            near(number(j, "triangulating_adds"), T.added, 0);
            rg_mesh_free(&T);
            rg_mesh_free(&m);
        } else {
            assert_null(json_object_get(j, "triangulating_adds"));
            assert_true(strlen(json_string_value(json_object_get(j, "not_disk"))) > 0);
        }
        json_decref(j);
        rg_pattern_destroy(p);
    }
    assert_true(disks >= 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(report_has_all_keys), cmocka_unit_test(nowhere_to_write), cmocka_unit_test(theorems_are_named),
        cmocka_unit_test(big_little_big),      cmocka_unit_test(closed_vertices_and_warnings_are_listed),
        cmocka_unit_test(triangulating_is_foretold)};
    return cmocka_run_group_tests(tests, written_begin, written_end);
}
