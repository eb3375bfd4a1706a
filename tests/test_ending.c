/* motion/ending: the layers of a motion's flat end, as they are reported, written and drawn. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "motion/ending.h"
#include "motions.h"
#include "render/lift.h"
#include "stacked.h"
#include "written.h"

#include <jansson.h>

static rg_motion *fold(const char *path, double to, rg_triangulation t)
{
    rg_settings s = rg_settings_default();
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    s.frames = 9;
    s.to = to;
    s.triangulate = t;
    if (rg_pattern_read(path, NULL, &p, &why) != RG_OK || rg_motion_create(p, &s, NULL, NULL, &m, &why) != RG_OK) fail_msg("%s: %s", path, why.text);
    rg_pattern_destroy(p);
    return m;
}

/* order[f nf + g]: +1: g lies above f. */
typedef struct table { int32_t nf; const signed char *order; const stacked *s; } table;

static int by_table(const void *ctx, int32_t f, int32_t g)
{
    const table *t = ctx;
    return t->order[(size_t)f * (size_t)t->nf + (size_t)g];
}

/* faceOrders of the last of the file's frames, and that no other has any. NULL: neither has the last one. */
static signed char *face_orders(const rg_motion *m, const stacked *s)
{
    char path[300];
    rg_diag why = {0, ""};
    json_error_t error;
    const int32_t nf = m->mesh.nf;
    if (rg_motion_write(m, written_path("x.fold", path), NULL, &why) != RG_OK) fail_msg("%s", why.text);
    json_t *file = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    assert_non_null(file);
    const json_t *frames = json_object_get(file, "file_frames");
    const size_t last = json_array_size(frames) - 1;
    assert_int_equal(last + 1, m->report.frame_count);
    assert_null(json_object_get(file, "faceOrders"));
    for (size_t k = 0; k < last; k++) assert_null(json_object_get(json_array_get(frames, k), "faceOrders"));
    const json_t *orders = json_object_get(json_array_get(frames, last), "faceOrders"), *triple;
    signed char *order = orders ? calloc((size_t)nf * (size_t)nf, 1) : NULL;
    size_t i;
    json_array_foreach(orders, i, triple) {
        assert_int_equal(json_array_size(triple), 3);
        const json_int_t f = json_integer_value(json_array_get(triple, 0)), g = json_integer_value(json_array_get(triple, 1)),
                         side = json_integer_value(json_array_get(triple, 2));
        assert_in_range(f, 0, nf - 1);
        assert_in_range(g, 0, nf - 1);
        assert_true(f != g && (side == 1 || side == -1));
        assert_int_equal(order[g * nf + f], 0);
        /* FOLD: f lies on the side of g to which g's normal points. */
        order[g * nf + f] = (signed char)(s->flipped[g] ? -side : side);
        order[f * nf + g] = (signed char)-order[g * nf + f];
    }
    json_decref(file);
    unlink(path);
    return order;
}

/* The written order is one of paper, for the facets of the file; the picture's layers are in it. circle: facets lie on each other in
 * one, which no heights can show: some pairs are
 * drawn the other way round, and few. */
static void check_end(const char *path, double to, rg_triangulation triangulate, int circle)
{
    rg_motion *m = fold(path, to, triangulate);
    const double *rho = rg_motion_angles(m, m->report.frame_count - 1);
    double *angle = calloc((size_t)m->mesh.N, sizeof *angle);
    stacked s;
    rg_triangles t;
    rg_lift *l = NULL;
    assert_string_equal(m->report.layers, "valid");
    assert_string_equal(m->report.layer_orders, "1");
    for (int32_t i = 0; i < m->mesh.N; i++) angle[i] = RG_PI * round(rho[i] / RG_PI);
    stacked_init(&s, &m->mesh, angle);
    signed char *order = face_orders(m, &s);
    assert_non_null(order);
    const table by = {m->mesh.nf, order, &s};
    if (!stacked_is_valid(&s, by_table, &by, 300, 6, 1e-4 * m->mesh.size, 11))
        fail_msg("%s: %s (%d %d %d %d)", path, s.what, (int)s.wrong[0], (int)s.wrong[1], (int)s.wrong[2], (int)s.wrong[3]);
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x), *lift = calloc((size_t)m->mesh.nf, sizeof *lift);
    assert_int_equal(rg_triangles_init(&m->mem, &m->mesh, &t), RG_OK);
    assert_int_equal(rg_lift_create(&m->mem, m, &t, &l), RG_OK);
    for (int32_t k = 0; k < m->report.frame_count; k++) assert_int_equal(rg_lift_next(l, x, lift), RG_OK);
    /* Up for the piles is where facet 0 has its front. */
    const int32_t *v = m->mesh.facet_vertex;
    rg_vec3 up = rg_vec3_cross(rg_vec3_sub(x[v[1]], x[v[0]]), rg_vec3_sub(x[v[2]], x[v[0]]));
    int compared = 0, wrong = 0;
    for (int32_t f = 0; f < m->mesh.nf; f++)
        for (int32_t g = 0; g < m->mesh.nf; g++) {
            if (order[f * m->mesh.nf + g] <= 0) continue;
            compared++;
            wrong += !(rg_vec3_dot(up, rg_vec3_sub(lift[g], lift[f])) > 0);
        }
    assert_true(compared > 0);
    if (circle ? wrong == 0 || wrong > compared / 4 : wrong != 0) fail_msg("%s: %d of %d pairs are drawn the other way round", path, wrong, compared);
    rg_lift_destroy(l);
    rg_triangles_free(&t);
    free(x);
    free(lift);
    stacked_free(&s);
    free(order);
    free(angle);
    rg_motion_destroy(m);
}

static void flat_ends(void **state)
{
    (void)state;
    check_end("patterns/preliminary.opx", 1, RG_TRIANGULATE_AUTO, 0);
    check_end("patterns/preliminary.opx", -1, RG_TRIANGULATE_AUTO, 0);
    check_end("patterns/preliminary.opx", 1, RG_TRIANGULATE_ALL, 0);
    check_end("patterns/bird.opx", 1, RG_TRIANGULATE_AUTO, 0);
    check_end("patterns/tatou.opx", 1, RG_TRIANGULATE_AUTO, 1);
    check_end("patterns/miura.opx", 1, RG_TRIANGULATE_ALL, 0);
}

static void ends_that_are_none(void **state)
{
    (void)state;
    char path[300];
    rg_diag why = {0, ""};
    rg_motion *m = fold("patterns/miura.opx", 0.5, RG_TRIANGULATE_AUTO);
    assert_string_equal(m->report.layers, "not flat");
    assert_string_equal(m->report.layer_orders, "");
    assert_true(strlen(m->report.layers_reason) > 10);
    assert_null(rg_ending_layers(m, m->report.frame_count - 1));
    assert_int_equal(rg_motion_write(m, written_path("x.fold", path), NULL, &why), RG_OK);
    size_t n;
    char *text = written_read("x.fold", &n);
    assert_null(strstr(text, "faceOrders"));
    free(text);
    rg_motion_destroy(m);
    m = fold("patterns/closed-split.opx", 1, RG_TRIANGULATE_AUTO);
    assert_string_equal(m->report.layers, "none");
    assert_non_null(strstr(m->report.layers_reason, "round in a circle"));
    assert_null(rg_ending_layers(m, m->report.frame_count - 1));
    rg_motion_destroy(m);
}

/* Creases one after the other, from that end of the strip on. */
static void from_one_end(const rg_mesh *m, double t, double *rho, void *ctx)
{
    const int from_the_right = *(const int *)ctx;
    for (int32_t i = 0; i < m->N; i++) {
        int32_t before = 0;
        for (int32_t j = 0; j < m->N; j++) {
            const double d = m->X[m->edge[m->crease_edge[j]][0]].x - m->X[m->edge[m->crease_edge[i]][0]].x;
            before += from_the_right ? d > 0 : d < 0;
        }
        rho[i] = RG_PI * mountain_or_valley(m, i) * fmin(1, fmax(0, m->N * t - before));
    }
}

/* Rolled up, even panels have several orders; the one kept is the one that the motion came in: from the right the end is inside, from
 * the left outside. Seen with the front of the first panel up. */
static void the_order_is_that_of_the_motion(void **state)
{
    (void)state;
    static const double even[] = {1, 1, 1};
    static const char *const expected[2] = {"201", "021"}; /* panels, lowest first */
    for (int right = 0; right < 2; right++) {
        rg_diag why = {0, ""};
        rg_lines lines = strip(3, even, "VV", 2.385);
        rg_motion *m = motion_by(&lines, 31, from_one_end, &right);
        assert_int_equal(rg_ending_find(m, NULL, &why), RG_OK);
        assert_string_equal(m->report.layer_orders, "2");
        const rg_layers *l = rg_ending_layers(m, 30);
        assert_non_null(l);
        int32_t level[3], cuts;
        assert_int_equal(rg_layers_levels(l, level, &cuts), 3);
        const int up = l->flat.up[facet_at(&m->mesh, 0.5, 1)];
        for (int i = 0; i < 3; i++) {
            const int32_t f = facet_at(&m->mesh, expected[right][i] - '0' + 0.5, 1);
            assert_int_equal(level[f], up > 0 ? i : 2 - i);
        }
        rg_motion_destroy(m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(flat_ends), cmocka_unit_test(ends_that_are_none),
                                       cmocka_unit_test(the_order_is_that_of_the_motion)};
    return cmocka_run_group_tests(tests, written_begin, written_end);
}
