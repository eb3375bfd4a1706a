/* base/number.c: numbers as text, in any locale. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/number.h"
#include "base/text.h"
#include "comma.h"
#include "near.h"

static void scans(const char *text, size_t used, double value)
{
    double v = 17;
    assert_int_equal(rg_number_scan(text, strlen(text), &v), used);
    if (!used) near(v, 17, 0);
    else if (isinf(value)) assert_true(v == value);
    else near(v, value, 0);
}

static void the_longest_number_is_read(void **state)
{
    (void)state;
    scans("12.5", 4, 12.5);
    scans("12.5.25", 4, 12.5); /* svg's way to save a blank */
    scans("-.5-3", 3, -0.5);
    scans("+7.", 3, 7);
    scans("1e3", 3, 1000);
    scans("1E-15x", 5, 1e-15);
    scans("1e", 1, 1);
    scans("1e+", 1, 1);
    scans("3em", 1, 3);
    scans("0x10", 1, 0);
    scans("1e999", 5, INFINITY);
    scans(".", 0, 0);
    scans("-", 0, 0);
    scans("-.", 0, 0);
    scans("e5", 0, 0);
    scans("", 0, 0);
    scans("inf", 0, 0);
    scans("nan", 0, 0);
    double v;
    assert_int_equal(rg_number_scan("12345", 3, &v), 3); /* no further than it may */
    near(v, 123, 0);
}

/* However many digits, it is the nearest double: the C library is the judge, in its own locale. */
static void numbers_of_any_length(void **state)
{
    (void)state;
    enum { LONGEST = 3000 };
    char text[LONGEST + 40];
    double v;
    unsigned seed = 3;
    for (int k = 0; k < 2000; k++) {
        const int n = 1 + (int)(LONGEST * fabs(noise(&seed))), point = k % 3 ? (int)(n * fabs(noise(&seed))) : -1, zeros = k % 5 ? 0 : n / 2;
        int at = k % 2;
        if (at) text[0] = '-';
        for (int i = 0; i < n; i++) {
            if (i == point) text[at++] = '.';
            text[at++] = i < zeros ? '0' : (char)('0' + (int)(9.99 * fabs(noise(&seed))));
        }
        if (k % 4 == 0) at += sprintf(text + at, "e%d", (int)(n * noise(&seed)));
        text[at] = 0;
        const double value = strtod(text, NULL);
        assert_int_equal(rg_number_scan(text, (size_t)at, &v), at);
        if (isinf(value)) assert_true(v == value);
        else near(v, value, 0);
    }
    /* Half-way between 1 and the next double, and a trifle more, after 800 digits. */
    int at = sprintf(text, "1.00000000000000011102230246251565404236316680908203125");
    memset(text + at, '0', 800);
    strcpy(text + at + 800, "1");
    assert_int_equal(rg_number_scan(text, strlen(text), &v), strlen(text));
    assert_true(v == 1 + DBL_EPSILON);
    text[at + 800] = '0';
    assert_int_equal(rg_number_scan(text, strlen(text), &v), strlen(text));
    assert_true(v == 1);
}

static void whole_texts(void **state)
{
    (void)state;
    double v;
    long n;
    assert_true(rg_number_parse(" \t7.25\r\n", 8, &v));
    near(v, 7.25, 0);
    assert_false(rg_number_parse("7 25", 4, &v));
    assert_false(rg_number_parse("", 0, &v));
    assert_false(rg_number_parse("  ", 2, &v));
    assert_true(rg_number_parse("NaN", 3, &v) && isnan(v));
    assert_true(rg_number_parse("-Infinity", 9, &v) && v < 0 && isinf(v));
    assert_true(rg_number_whole(" -12 ", 5, &n));
    assert_int_equal(n, -12);
    assert_false(rg_number_whole("1.0", 3, &n));
    assert_false(rg_number_whole("99999999999999999999", 20, &n));
    assert_false(rg_number_whole("", 0, &n));
}

static void numbers_come_back(void **state)
{
    (void)state;
    char text[RG_NUMBER_ROOM];
    unsigned seed = 7;
    for (int i = 0; i < 20000; i++) {
        double x = noise(&seed), back;
        const int scale = (int)(150 * noise(&seed));
        x = ldexp(x + noise(&seed) * 1e-9, 2 * scale);
        rg_number_print(text, x);
        assert_int_equal(rg_number_scan(text, strlen(text), &back), strlen(text));
        near(back, x, 0);
    }
    assert_string_equal(rg_number_print(text, -0.0), "0");
    assert_string_equal(rg_number_print(text, 0.1), "0.1");
    assert_string_equal(rg_number_print(text, -2.5), "-2.5");
    assert_int_equal(strlen(rg_number_print(text, -1.2345678901234567e-300)) < RG_NUMBER_ROOM, 1);
}

/* As printf and strtod have it between them: of 15, 16 and 17 digits as few as come back. */
static void is_shortest(double x)
{
    char text[RG_NUMBER_ROOM], want[RG_NUMBER_ROOM];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(want, sizeof want, "%.*g", digits, x + 0.0); /* -0 is 0 */
        if (strtod(want, NULL) == x) break;
    }
    assert_string_equal(rg_number_print(text, x), want);
}

/* Near powers of two, where numbers lie closer on one side, and of ten, where digits are carried; halves; all sizes. */
static void numbers_are_short(void **state)
{
    (void)state;
    unsigned seed = 5;
    for (int e = -1074; e < 1024; e++) {
        const double x = ldexp(1, e);
        is_shortest(x);
        is_shortest(-nextafter(x, 0));
        is_shortest(nextafter(x, INFINITY));
        is_shortest(ldexp(2 + noise(&seed), e < 1020 ? e : 1020));
    }
    for (int e = -60; e < 30; e++) {
        double low = pow(10, e), high = low;
        for (int k = 0; k < 60; k++, low = nextafter(low, 0), high = nextafter(high, INFINITY)) {
            is_shortest(low);
            is_shortest(-high);
        }
        for (int k = 0; k < 100; k++) is_shortest(floor(500 + 500 * noise(&seed)) * pow(10, e));
    }
    for (int k = 1; k < 2000; k++) is_shortest(k / 2048.0 + 1e12), is_shortest(k / 64.0), is_shortest(1e15 + k / 8.0);
}

/* A decimal comma in the user's language changes nothing. */
static void a_decimal_comma_changes_nothing(void **state)
{
    char folder[] = "/tmp/rigami-locale-XXXXXX", command[100];
    assert_non_null(mkdtemp(folder));
    const int found = comma_set(folder) != NULL;
    if (found) {
        char text[20];
        snprintf(text, sizeof text, "%.1f", 0.5);
        assert_string_equal(text, "0,5"); /* it is in force */
        the_longest_number_is_read(state);
        whole_texts(state);
        numbers_come_back(state);
        rg_text(text, sizeof text, "%.1f", 0.5);
        assert_string_equal(text, "0.5"); /* what is told people, too */
        snprintf(text, sizeof text, "%.1f", 0.5);
        assert_string_equal(text, "0,5"); /* and the caller's is as it was */
    }
    setlocale(LC_ALL, "C");
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
    if (found) return;
    print_message("SKIPPED: no locale with a decimal comma on this machine\n");
    skip();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_longest_number_is_read), cmocka_unit_test(numbers_of_any_length), cmocka_unit_test(whole_texts),
                                       cmocka_unit_test(numbers_come_back),
                                       cmocka_unit_test(numbers_are_short), cmocka_unit_test(a_decimal_comma_changes_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
