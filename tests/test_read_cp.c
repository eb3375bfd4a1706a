/* read/cp.c: codes, blanks, ends of lines, and where a file is wrong. */
#include "reading.h"

static void codes_and_direction(void **state)
{
    (void)state;
    rg_lines l = read_ok("1 -200.0 -200.0 200 -200\n2 1.0E-15 -0.0 3.5 7\n3 0 0 1 2.25\n4 1 2 3 4\n0 5 6 7 8\n", RG_FORMAT_CP, NULL);
    assert_int_equal(l.count, 5);
    is_line(&l, 0, 'B', -200, 200, 200, 200, NAN); /* y points down in the file, assignments stay */
    is_line(&l, 1, 'M', 1e-15, 0, 3.5, -7, NAN);
    is_line(&l, 2, 'V', 0, 0, 1, -2.25, NAN);
    is_line(&l, 3, 'F', 1, -2, 3, -4, NAN);
    is_line(&l, 4, 'F', 5, -6, 7, -8, NAN);
    for (int i = 0; i < 5; i++) assert_int_equal(l.line[i].where, i + 1);
    assert_int_equal(l.warnings, 0);
    rg_lines_free(&l);
    rg_reading s = rg_reading_default();
    s.flip = 1;
    l = read_ok("2 1 2 3 4\n", RG_FORMAT_CP, &s);
    is_line(&l, 0, 'M', 1, 2, 3, 4, NAN);
    rg_lines_free(&l);
}

static void blanks_and_ends(void **state)
{
    (void)state;
    const char *const same[] = {"2 1 2 3 4\n3 5 6 7 8\n", "2 1 2 3 4\r\n3 5 6 7 8\r\n", "2 1 2 3 4\r3 5 6 7 8",
        "\n\n  2\t1   2 \t3 4  \n \n3 5 6 7 8", "\xEF\xBB\xBF\n2 1 2 3 4\n3 5 6 7 8\n"};
    const int where[][2] = {{1, 2}, {1, 2}, {1, 2}, {3, 5}, {2, 3}};
    for (int i = 0; i < 5; i++) {
        rg_lines l = read_ok(same[i], RG_FORMAT_CP, NULL);
        assert_int_equal(l.count, 2);
        is_line(&l, 0, 'M', 1, -2, 3, -4, NAN);
        is_line(&l, 1, 'V', 5, -6, 7, -8, NAN);
        for (int k = 0; k < 2; k++) assert_int_equal(l.line[k].where, where[i][k]);
        rg_lines_free(&l);
    }
}

static void what_is_wrong_and_where(void **state)
{
    (void)state;
    refused("1 0 0 1 1\nMonday 0 0 1 1\n", RG_FORMAT_CP, NULL, 2, "\"Monday\"");
    refused("1 0 0 1 1\r\n\r\n2 0 0 1\r\n", RG_FORMAT_CP, NULL, 3, "4 fields");
    refused("2 0 0 1 1 5\n", RG_FORMAT_CP, NULL, 1, "6 fields");
    refused("2 0 0 1 1,5\n", RG_FORMAT_CP, NULL, 1, "\"1,5\"");
    refused("2 0 0 1 0x10\n", RG_FORMAT_CP, NULL, 1, "\"0x10\"");
    refused("-1 0 0 1 1\n", RG_FORMAT_CP, NULL, 1, "\"-1\"");
    refused("2.0 0 0 1 1\n", RG_FORMAT_CP, NULL, 1, "\"2.0\"");
    refused(" \n\n", RG_FORMAT_CP, NULL, 0, "no lines");
    refused("", RG_FORMAT_CP, NULL, 0, "empty");
}

static void what_is_told(void **state)
{
    (void)state;
    rg_lines l = read_ok("7 0 0 1 1\n2 NaN 0 1 1\n2 0 0 -Infinity 1\n3 0 0 1e999 1\n3 1 1 2 2\n", RG_FORMAT_CP, NULL);
    assert_int_equal(l.count, 2);
    is_line(&l, 0, 'F', 0, 0, 1, -1, NAN);
    is_line(&l, 1, 'V', 1, -1, 2, -2, NAN);
    assert_int_equal(l.warnings, 4);
    for (int i = 0; i < 4; i++) assert_int_equal(l.warning[i].line, i + 1);
    assert_true(warned(&l, "type 7"));
    rg_lines_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(codes_and_direction), cmocka_unit_test(blanks_and_ends),
                                       cmocka_unit_test(what_is_wrong_and_where), cmocka_unit_test(what_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
