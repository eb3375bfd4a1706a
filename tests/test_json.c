/* base/: JSON as it is written, read back by another parser; base64. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "base/base64.h"
#include "base/json.h"

#include <jansson.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>

/* What `fill` writes, parsed; the count of bytes has to be right. */
static json_t *written(void (*fill)(rg_json *j, void *ctx), void *ctx)
{
    FILE *f = tmpfile();
    rg_json j, counted;
    json_error_t error;
    assert_non_null(f);
    rg_json_begin(&j, f);
    fill(&j, ctx);
    rg_json_begin(&counted, NULL);
    fill(&counted, ctx);
    assert_int_equal(j.depth, 0);
    assert_int_equal(ftell(f), j.bytes);
    assert_int_equal(counted.bytes, j.bytes);
    rewind(f);
    json_t *read = json_loadf(f, JSON_REJECT_DUPLICATES, &error);
    if (!read) fail_msg("line %d: %s", error.line, error.text);
    fclose(f);
    return read;
}

static double awkward(unsigned *seed)
{
    return noise(seed) * pow(10, 300 * noise(seed));
}

static void numbers(rg_json *j, void *ctx)
{
    unsigned seed = *(unsigned *)ctx;
    rg_json_open(j, NULL, '[');
    for (int i = 0; i < 1000; i++) rg_json_number(j, NULL, awkward(&seed));
    rg_json_close(j);
}

/* In a locale with decimal commas too, where there is one. */
static void numbers_read_back(void **state)
{
    (void)state;
    static const char *const locale[] = {"C", "de_DE.UTF-8", "fr_FR.UTF-8"};
    for (int k = 0; k < 3; k++) {
        if (!setlocale(LC_NUMERIC, locale[k])) continue;
        unsigned seed = 20240229;
        json_t *list = written(numbers, &seed);
        for (size_t i = 0; i < 1000; i++) near(json_number_value(json_array_get(list, i)), awkward(&seed), 0);
        json_decref(list);
    }
    setlocale(LC_NUMERIC, "C");
}

static void all_kinds(rg_json *j, void *ctx)
{
    (void)ctx;
    rg_json_open(j, NULL, '{');
    rg_json_number(j, "nan", NAN);
    rg_json_number(j, "inf", -INFINITY);
    rg_json_integer(j, "large", INT64_MIN);
    rg_json_bool(j, "yes", 1);
    rg_json_bool(j, "no", 0);
    rg_json_string(j, "none", NULL);
    rg_json_open(j, "empty", '[');
    rg_json_close(j);
    rg_json_open_line(j, "nothing", '{');
    rg_json_close(j);
    rg_json_integers(j, "integers", (const int32_t[]){INT32_MIN, 0, INT32_MAX}, 3);
    rg_json_open_line(j, "inner", '[');
    rg_json_numbers(j, NULL, (const double[]){1.25, 2.385}, 2);
    rg_json_open(j, NULL, '{');
    rg_json_integer(j, "deep", 7);
    rg_json_close(j);
    rg_json_close(j);
    rg_json_close(j);
}

static void every_kind_is_there(void **state)
{
    (void)state;
    json_t *j = written(all_kinds, NULL);
    assert_true(json_is_null(json_object_get(j, "nan")));
    assert_true(json_is_null(json_object_get(j, "inf")));
    assert_true(json_is_null(json_object_get(j, "none")));
    assert_true(json_integer_value(json_object_get(j, "large")) == INT64_MIN);
    assert_true(json_is_true(json_object_get(j, "yes")));
    assert_true(json_is_false(json_object_get(j, "no")));
    assert_int_equal(json_array_size(json_object_get(j, "empty")), 0);
    assert_true(json_is_object(json_object_get(j, "nothing")));
    assert_int_equal(json_integer_value(json_array_get(json_object_get(j, "integers"), 0)), INT32_MIN);
    const json_t *inner = json_object_get(j, "inner");
    near(json_number_value(json_array_get(json_array_get(inner, 0), 1)), 2.385, 0);
    assert_int_equal(json_integer_value(json_object_get(json_array_get(inner, 1), "deep")), 7);
    json_decref(j);
}

static void one_string(rg_json *j, void *ctx)
{
    rg_json_open(j, NULL, '[');
    rg_json_string(j, NULL, ctx);
    rg_json_close(j);
}

static void strings_are_kept_or_mended(void **state)
{
    (void)state;
    static const struct { const char *text, *read; } cases[] = {
        {"", ""},
        {"a \"b\" \\ / \b\f\n\r\t \x01\x1f\x7f", NULL},
        {"<script> </script> &", NULL},
        {"\xc3\xa9 \xe6\x8a\x98 \xf0\x9f\xa6\xa2 \xed\x9f\xbf \xee\x80\x80 \xf4\x8f\xbf\xbf", NULL},
        {"\xff", "\xef\xbf\xbd"},
        {"\x80z", "\xef\xbf\xbdz"},
        {"\xc0\xaf", "\xef\xbf\xbd\xef\xbf\xbd"},             /* overlong */
        {"\xe0\x80\xaf", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},
        {"\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"}, /* half of a surrogate pair */
        {"\xf4\x90\x80\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"}, /* above U+10FFFF */
        {"a\xe6\x8a", "a\xef\xbf\xbd\xef\xbf\xbd"},           /* cut off */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[100];
        snprintf(text, sizeof text, "%s", cases[i].text);
        json_t *list = written(one_string, text);
        assert_string_equal(json_string_value(json_array_get(list, 0)), cases[i].read ? cases[i].read : cases[i].text);
        json_decref(list);
    }
}

/* The examples of RFC 4648, section 10, and bytes that need all digits. */
static void base64_is_as_in_the_rfc(void **state)
{
    (void)state;
    static const char *const text[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    const rg_memory mem = rg_mem_default(NULL);
    for (size_t n = 0; n <= 6; n++) {
        char *got = rg_base64_text(&mem, "x,", (const unsigned char *)"foobar", n);
        assert_non_null(got);
        assert_memory_equal(got, "x,", 2);
        assert_string_equal(got + 2, text[n]);
        rg_mem_free(&mem, got);
    }
    char *got = rg_base64_text(&mem, "", (const unsigned char *)"\xfb\xef\xbe\xff\xff\xff", 6);
    assert_string_equal(got, "++++////");
    rg_mem_free(&mem, got);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_read_back), cmocka_unit_test(every_kind_is_there),
                                       cmocka_unit_test(strings_are_kept_or_mended), cmocka_unit_test(base64_is_as_in_the_rfc)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
