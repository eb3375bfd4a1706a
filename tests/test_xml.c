#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"

#include "read/xml.h"

#include <libxml/parser.h>
#include <libxml/xmlmemory.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* libxml2's memory, of which only so many requests are granted. */
static long left;

static void *some(size_t n) { return left-- > 0 ? malloc(n) : NULL; }
static void *more(void *p, size_t n) { return left-- > 0 ? realloc(p, n) : NULL; }
static char *copy(const char *s) { return left-- > 0 ? strdup(s) : NULL; }

/* Once libxml2 told a reader whose memory ran out that the file is not well-formed, and wrote about it to standard error. */
static void want_of_memory_is_told_as_such(void **state)
{
    (void)state;
    static const char text[] = "<?xml version=\"1.0\"?>\n<java><object class=\"a\"><void property=\"x\">"
                               "text &amp; more</void></object></java>\n";
    FILE *said = tmpfile();
    const int before = dup(STDERR_FILENO);
    int refused = 0, wrong = 0;
    rg_status s = RG_ENOMEM;
    assert_non_null(said);
    assert_true(before >= 0);
    fflush(stderr);
    assert_true(dup2(fileno(said), STDERR_FILENO) >= 0);
    for (long k = 0; k < 1000 && (s != RG_OK || left < 0); k++) {
        rg_xml *doc = NULL;
        rg_diag why = {0, ""};
        left = k;
        s = rg_xml_parse(text, sizeof text - 1, RG_XML_NO_TYPE, NULL, &doc, &why);
        refused += s == RG_ENOMEM;
        wrong += s != RG_OK && s != RG_ENOMEM;
        if (s == RG_OK) wrong += !rg_xml_is(rg_xml_root(doc), "java");
        rg_xml_free(doc);
    }
    fflush(stderr);
    assert_true(dup2(before, STDERR_FILENO) >= 0);
    close(before);
    assert_int_equal(s, RG_OK);
    assert_int_equal(wrong, 0);
    assert_true(refused > 10);
    assert_int_equal(lseek(fileno(said), 0, SEEK_END), 0);
    fclose(said);
    left = 1000000;
}

/* Somebody else's way of hearing of errors is there again afterwards. */
static void hear(void *ctx, xmlErrorPtr e)
{
    (void)ctx, (void)e;
}

static void who_listens_goes_on_listening(void **state)
{
    (void)state;
    int his = 0;
    rg_xml *doc = NULL;
    rg_diag why = {0, ""};
    xmlSetStructuredErrorFunc(&his, (xmlStructuredErrorFunc)hear);
    assert_int_equal(rg_xml_parse("<a><b></a>", 10, RG_XML_NO_TYPE, NULL, &doc, &why), RG_EFORMAT);
    assert_int_equal(why.line, 1);
    assert_ptr_equal(xmlStructuredErrorContext, &his);
    assert_true(xmlStructuredError == (xmlStructuredErrorFunc)hear);
    xmlSetStructuredErrorFunc(NULL, NULL);
}

int main(void)
{
    left = 1000000;
    xmlMemSetup(free, some, more, copy);
    xmlInitParser();
    const struct CMUnitTest tests[] = {cmocka_unit_test(want_of_memory_is_told_as_such),
                                       cmocka_unit_test(who_listens_goes_on_listening)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
