/* pattern/pieces.c, source.c, and what is told of loose ends: several sheets in a drawing, and whose numbers are whose. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "draw.h"
#include "pattern/build.h"
#include "mesh/mesh.h"
#include "pattern/source.h"

static rg_pattern_info info_of(const rg_pattern *p)
{
    rg_pattern_info i;
    i = *rg_pattern_get_info(p);
    return i;
}

static int warned(const rg_pattern *p, const char *words)
{
    const rg_diag *w;
    const int32_t n = rg_pattern_warnings(p, &w);
    for (int32_t i = 0; i < n; i++)
        if (strstr(w[i].text, words)) return 1;
    return 0;
}

/* Two squares, of which the second has a smaller one inside: that is a hole of it, and no sheet. */
static rg_lines two_sheets(void)
{
    rg_lines l = drawing();
    l.y_down = 1;
    draw(&l, 'V', 20, 1, 27, 8);
    draw_box(&l, 0, 0, 3, 3);
    draw(&l, 'M', 0, 0, 3, 3);
    draw_box(&l, 20, 1, 27, 8);
    draw_box(&l, 23, 2, 24, 3);
    return l;
}

static void one_of_several(void **state)
{
    (void)state;
    rg_reading s = rg_reading_default();
    for (int32_t k = 0; k <= 2; k++) {
        rg_lines l = two_sheets();
        s.sheet = k;
        rg_pattern *p = pattern_with(&l, &s);
        const rg_pattern_info i = info_of(p);
        const rg_piece *piece;
        assert_int_equal(i.sheets, 2);
        assert_int_equal(rg_pattern_pieces(p, &piece), 2);
        near(piece[0].low[0], 20, 0); /* its line came first */
        near(piece[0].low[1], -8, 0); /* as the file has y */
        near(piece[0].high[1], -1, 0);
        assert_int_equal(piece[1].lines, 5);
        if (k == 0) assert_true(!i.is_disk && strstr(i.not_disk, "--sheet N takes one of the 2"));
        if (k == 1) assert_true(!i.is_disk && strstr(i.not_disk, "hole") && i.size == 7);
        if (k == 2) assert_true(i.is_disk && i.mountains == 1 && i.valleys == 0 && i.size == 3 && i.vertices == 4);
        rg_pattern_destroy(p);
    }
    rg_lines l = two_sheets();
    rg_pattern *p = NULL;
    rg_diag why;
    s.sheet = 3;
    assert_int_equal(rg_pattern_from_lines(&l, &s, &p, &why), RG_EARG);
    assert_non_null(strstr(why.text, "there is no sheet 3: the drawing has 2"));
}

/* The size that tolerances are parts of is the longer side of the sheet taken, not of the drawing. */
static void size_is_that_of_the_sheet_taken(void **state)
{
    (void)state;
    rg_reading s = rg_reading_default();
    static const double size[] = {9, 4};
    for (int32_t k = 1; k <= 2; k++) {
        rg_lines l = drawing();
        draw_box(&l, 100, 2, 109, 5);
        draw_box(&l, 40, -3, 42, 1);
        s.sheet = k;
        rg_pattern *p = pattern_with(&l, &s);
        near(info_of(p).size, size[k - 1], 0);
        rg_pattern_destroy(p);
    }
}

/* A mountain and a valley on one line: told where they begin to lie on each other, whichever is longer, by the line of the other. */
static void doubles_are_told_where_they_begin(void **state)
{
    (void)state;
    for (int turn = 0; turn < 2; turn++) {
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 10, 8);
        draw(&l, 'M', turn ? 10 : 0, 3, turn ? 0 : 10, 3);
        draw(&l, 'V', 4, 3, 7, 3);
        rg_pattern *p = pattern_of(&l);
        assert_true(warned(p, turn ? "mountain and valley drawn on one line from (7, 3)" : "mountain and valley drawn on one line from (4, 3)"));
        assert_int_equal(info_of(p).valleys, 0);
        rg_pattern_destroy(p);
    }
}

/* Of many such lines the first few are told, and how many more there are. */
static void more_doubles_are_counted(void **state)
{
    (void)state;
    enum { DOUBLES = 60 };
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 10, DOUBLES + 1);
    for (int i = 1; i <= DOUBLES; i++) draw(&l, 'M', 0, i, 10, i), draw(&l, 'V', 0, i, 10, i);
    rg_pattern *p = pattern_of(&l);
    const rg_diag *w;
    const int32_t n = rg_pattern_warnings(p, &w);
    int told = 0, more = 0;
    for (int32_t i = 0; i < n; i++) {
        told += strstr(w[i].text, "mountain and valley drawn on one line") != NULL;
        if (strstr(w[i].text, "more lines are drawn as mountain and as valley")) more = atoi(w[i].text);
    }
    assert_true(told > 0 && more > 0);
    assert_int_equal(told + more, DOUBLES);
    rg_pattern_destroy(p);
}

/* A crease that ends short of the border: how far, and the tolerance that it tells does join it. */
static void loose_ends(void **state)
{
    (void)state;
    for (int again = 0; again < 2; again++) {
        static double merge;
        rg_reading s = rg_reading_default();
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 7, 5);
        draw(&l, 'M', 2.5, 0.0625, 2.5, 4.9375);
        if (again) s.merge = merge;
        rg_pattern *p = pattern_with(&l, &s);
        assert_int_equal(info_of(p).creases, again);
        assert_int_equal(info_of(p).lost_creases, !again);
        const rg_diag *w;
        if (!again) {
            double far = 0;
            assert_true(rg_pattern_warnings(p, &w) > 0 && warned(p, "loose end"));
            assert_int_equal(sscanf(strstr(w[0].text, "the next line"), "the next line is %lf away; --merge %lf joins", &far, &merge), 2);
            near(far, 0.0625, 0.001);
            assert_true(merge * 7 >= 0.0625 && merge * 7 < 0.07);
        }
        rg_pattern_destroy(p);
    }
}

/* All the parts of a total are counted. */
static void slits_are_counted(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 7, 5);
    draw(&l, 'B', 0, 0, 3, 2);
    draw(&l, 'M', 3, 2, 7, 5);
    rg_pattern *p = pattern_of(&l);
    const rg_pattern_info i = info_of(p);
    assert_int_equal(i.creases, i.mountains + i.valleys + i.unassigned + i.flat + i.cuts);
    assert_int_equal(i.cuts, 1);
    rg_pattern_destroy(p);
}

static rg_pattern *parsed(const char *text)
{
    rg_reading s = rg_reading_default();
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    if (rg_pattern_parse(text, strlen(text), &s, &p, &why) != RG_OK) print_error("%s\n", why.text);
    assert_non_null(p);
    return p;
}

#define COORDS "\"vertices_coords\":[[4,3],[0,0],[4,0],[0,3],[1,0],[1,3]]"

/* Numbers of a FOLD file stay what they are; those that had to change are known. */
static void numbers_stay(void **state)
{
    (void)state;
    rg_pattern *p = parsed("{" COORDS ",\"edges_vertices\":[[4,5],[1,4],[4,2],[2,0],[0,5],[5,3],[3,1]],\"edges_assignment\":[\"V\",\"B\",\"B\",\"B\",\"B\",\"B\",\"B\"],"
                           "\"faces_vertices\":[[4,2,0,5],[1,4,5,3]]}");
    rg_memory mem = rg_mem_default(NULL);
    rg_mesh m;
    rg_diag why;
    int32_t face[2];
    assert_int_equal(p->source.nv, 6);
    for (int32_t v = 0; v < 6; v++) assert_int_equal(p->source.vertex[v], v);
    for (int32_t e = 0; e < 7; e++) assert_int_equal(p->source.edge[e], e);
    assert_int_equal(rg_mesh_from_pattern(p, &mem, &m, &why), RG_OK);
    assert_int_equal(rg_source_faces(&p->source, m.nf, m.facet_start, m.facet_vertex, face), RG_OK);
    assert_true(face[0] == 0 && face[1] == 1);
    near(m.X[m.facet_vertex[0]].x >= 1, 1, 0); /* the right one is the first, as in the file */
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
    /* A vertex that only breaks a line goes, and a crossing comes. */
    p = parsed("{" COORDS ",\"edges_vertices\":[[3,2],[1,4],[4,2],[2,0],[0,5],[5,3],[3,1],[1,0]],\"edges_assignment\":[\"V\",\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"M\"]}");
    assert_int_equal(p->nv, 5);
    const int32_t want[] = {0, 1, 2, 3, -1};
    for (int32_t v = 0; v < 5; v++) assert_int_equal(p->source.vertex[v], want[v]);
    for (int32_t e = 1; e < p->ne; e++) assert_true(p->source.edge[e] >= p->source.edge[e - 1]);
    assert_int_equal(p->source.edge[0], 0);
    assert_int_equal(p->source.edge[1], 0); /* both halves of the first */
    rg_pattern_destroy(p);
}

/* Squares in squares, the inmost first: each asked all others, and those what lies around them. */
static void many_parts_in_each_other(void **state)
{
    (void)state;
    enum { SQUARES = 10000 };
    rg_lines l = drawing();
    rg_reading s = rg_reading_default();
    for (int i = 1; i <= SQUARES; i++) draw_box(&l, -i, -i, i, i);
    draw_box(&l, 2 * SQUARES, 0, 2 * SQUARES + 9, 9);
    s.merge = 1e-7;
    rg_pattern *p = pattern_with(&l, &s);
    const rg_piece *piece;
    assert_int_equal(rg_pattern_pieces(p, &piece), 2);
    assert_int_equal(piece[0].lines, 4 * SQUARES);
    assert_int_equal(piece[1].lines, 4);
    near(piece[0].high[0], SQUARES, 0);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_of_several), cmocka_unit_test(loose_ends), cmocka_unit_test(slits_are_counted),
                                       cmocka_unit_test(numbers_stay),
                                       cmocka_unit_test(size_is_that_of_the_sheet_taken), cmocka_unit_test(doubles_are_told_where_they_begin),
                                       cmocka_unit_test(more_doubles_are_counted), cmocka_unit_test(many_parts_in_each_other)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
