/* read/opx.c: both dialects of ORIPA's files, and what breaks naive readers of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/memory.h"
#include "counted.h"
#include "near.h"
#include "read/opx.h"

/* ------------------------------------------------------------------------------------- files made up here ---- */

typedef struct text { char *s; size_t n, room; } text;

static void put(text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(text *t, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    if (t->n + (size_t)n + 1 > t->room) {
        t->room = 2 * t->room + (size_t)n + 4096;
        t->s = realloc(t->s, t->room);
        assert_non_null(t->s);
    }
    va_start(args, format);
    t->n += (size_t)vsnprintf(t->s + t->n, t->room - t->n, format, args);
    va_end(args);
}

typedef enum dialect { JAVA6, JAVA7 } dialect;

/* Java 6 as found in the wild has a blank before every line's end. */
static void open_file(text *t, dialect d, int length)
{
    const char *blank = d == JAVA6 ? " \n" : "\n";
    put(t, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>%s", blank);
    put(t, "<java version=\"%s\" class=\"java.beans.XMLDecoder\">%s", d == JAVA6 ? "1.5.0_06" : "21.0.2", blank);
    put(t, "<object class=\"oripa.DataSet\"%s>%s", d == JAVA6 ? "" : " id=\"DataSet0\"", blank);
    if (d == JAVA6) put(t, "<void property=\"lines\">%s", blank);
    else put(t, "<void class=\"oripa.DataSet\" method=\"getField\"><string>lines</string>\n<void method=\"set\"><object idref=\"DataSet0\"/>\n");
    put(t, "<array class=\"oripa.OriLineProxy\" length=\"%d\">%s", length, blank);
}

static void close_file(text *t, dialect d)
{
    put(t, "</array>\n%s</object>\n</java>\n", d == JAVA6 ? "</void>\n" : "</void>\n</void>\n");
}

/* One line as ORIPA writes it: properties of value 0 are left out. Coordinates are texts: they shall be read as spelt. */
static void put_line(text *t, int index, int type, const char *x0, const char *y0, const char *x1, const char *y1)
{
    const char *names[] = {"x0", "x1", "y0", "y1"}, *values[] = {x0, x1, y0, y1};
    put(t, "<void index=\"%d\">\n<object class=\"oripa.OriLineProxy\">\n", index);
    if (type) put(t, "<void property=\"type\">\n<int>%d</int>\n</void>\n", type);
    for (int i = 0; i < 4; i++)
        if (values[i]) put(t, "<void property=\"%s\">\n<double>%s</double>\n</void>\n", names[i], values[i]);
    put(t, "</object>\n</void>\n");
}

static int line_in(const text *t, const char *needle) /* of the text's end after that needle's first place */
{
    const char *at = strstr(t->s, needle);
    int line = 1;
    assert_non_null(at);
    for (const char *c = t->s; c < at; c++) line += *c == '\n';
    return line;
}

static rg_status read_bytes(const void *bytes, size_t n, rg_lines *l, rg_diag *why)
{
    rg_memory mem = rg_mem_default(NULL);
    if (why) *why = (rg_diag){-1, ""};
    return rg_opx_read(bytes, n, &mem, NULL, l, why);
}

static rg_lines read_ok(const text *t)
{
    rg_lines l;
    rg_diag why;
    rg_status s = read_bytes(t->s, t->n, &l, &why);
    if (s != RG_OK) print_error("line %d: %s\n", why.line, why.text);
    assert_int_equal(s, RG_OK);
    return l;
}

/* Refused, at that line, with those words in the message. */
static void refused(const text *t, int line, const char *words)
{
    rg_lines l;
    rg_diag why;
    assert_int_equal(read_bytes(t->s, t->n, &l, &why), RG_EFORMAT);
    if (!strstr(why.text, words) || why.line != line) {
        print_error("line %d: %s\nnot line %d: ... %s\n", why.line, why.text, line, words);
        fail();
    }
    assert_null(strchr(why.text, '\n'));
    assert_null(l.line);
    assert_int_equal(read_bytes(t->s, t->n, &l, NULL), RG_EFORMAT); /* nobody asked why */
}

static text load(const char *name)
{
    text t = {0};
    char path[200];
    snprintf(path, sizeof path, "patterns/bad/%s", name);
    FILE *f = fopen(path, "rb");
    if (!f) fail_msg("%s is missing", path);
    t.room = 1 << 20;
    t.s = malloc(t.room);
    assert_non_null(t.s);
    t.n = fread(t.s, 1, t.room - 1, f);
    t.s[t.n] = 0;
    fclose(f);
    return t;
}

/* ------------------------------------------------------------------------------------------- what is read ---- */

static void is_line(const rg_lines *l, int i, char assignment, double x0, double y0, double x1, double y1)
{
    assert_true(i < l->count);
    assert_int_equal(l->line[i].assignment, assignment);
    near(l->line[i].a.x, x0, 0);
    near(l->line[i].a.y, y0, 0);
    near(l->line[i].b.x, x1, 0);
    near(l->line[i].b.y, y1, 0);
    assert_true(isnan(l->line[i].target));
}

/* y points down in the file and up here; the assignments are kept, which is the same paper seen from its front. */
static void both_dialects_say_the_same(void **state)
{
    (void)state;
    for (dialect d = JAVA6; d <= JAVA7; d++) {
        text t = {0};
        open_file(&t, d, 6);
        put_line(&t, 0, 1, "-200.0", "-123.456", "200.0", "-123.456");
        put_line(&t, 1, 2, "17.25", "3.5", "-0.1", "99.875");
        put_line(&t, 2, 3, NULL, "3.5", "-0.1", NULL);
        put_line(&t, 3, 0, "1.0E-15", "-2.5E2", "7.105427357601002E-15", "1.7976931348623157E5");
        put_line(&t, 4, 4, "-0.0", "1", "+2.", ".5");
        put_line(&t, 5, 9, "1e1", "1", "2", "3");
        close_file(&t, d);
        rg_lines l = read_ok(&t);
        assert_int_equal(l.count, 6);
        is_line(&l, 0, RG_BORDER, -200, 123.456, 200, 123.456);
        is_line(&l, 1, RG_MOUNTAIN, 17.25, -3.5, -0.1, -99.875);
        is_line(&l, 2, RG_VALLEY, 0, -3.5, -0.1, 0);
        is_line(&l, 3, RG_FLAT, 1e-15, 250, 7.105427357601002e-15, -179769.31348623157);
        is_line(&l, 4, RG_UNASSIGNED, 0, -1, 2, -0.5);
        is_line(&l, 5, RG_CUT, 10, -1, 2, -3);
        assert_int_equal(l.line[0].where, line_in(&t, "<void index=\"0\""));
        assert_int_equal(l.line[4].where, line_in(&t, "<void index=\"4\""));
        assert_int_equal(l.warnings, 0);
        rg_lines_free(&l);
        free(t.s);
    }
}

/* A line of which every property is 0 is an element without content; a null entry leaves a hole in the indices. */
static void empty_and_missing_entries(void **state)
{
    (void)state;
    text t = load("self-closed.opx");
    rg_lines l = read_ok(&t);
    assert_int_equal(l.count, 3);
    is_line(&l, 0, RG_FLAT, 0, 0, 0, 0);
    is_line(&l, 1, RG_MOUNTAIN, 0, 0, 31.5, 0);
    is_line(&l, 2, RG_BORDER, 4, -3, 2, -1);
    rg_lines_free(&l);
    free(t.s);
}

/* Properties are known by name: this file has them in another order, and some that nobody knows. */
static void order_does_not_matter(void **state)
{
    (void)state;
    text t = load("shuffled.opx");
    rg_lines l = read_ok(&t);
    assert_int_equal(l.count, 1);
    is_line(&l, 0, RG_VALLEY, 11, -22, 33, -44);
    assert_string_equal(l.title, "Shuffled");
    rg_lines_free(&l);
    free(t.s);
}

/* ORIPA wrote NaN into a few files that people still fold. The line goes, the rest stays, and it is said. */
static void lines_that_are_nowhere_are_dropped(void **state)
{
    (void)state;
    static const char *const bad[] = {"NaN", "Infinity", "-Infinity", "1.0E999"};
    for (int i = 0; i < 4; i++) {
        text t = {0};
        open_file(&t, i % 2 ? JAVA7 : JAVA6, 3);
        put_line(&t, 0, 1, "1", "2", "3", "4");
        put_line(&t, 7, 2, "1", "2", i == 3 ? bad[i] : "3", i == 3 ? "4" : bad[i]);
        put_line(&t, 8, 3, "5", "6", "7", "8");
        close_file(&t, i % 2 ? JAVA7 : JAVA6);
        rg_lines l = read_ok(&t);
        assert_int_equal(l.count, 2);
        is_line(&l, 1, RG_VALLEY, 5, -6, 7, -8);
        assert_int_equal(l.warnings, 1);
        assert_int_equal(l.warning[0].line, line_in(&t, "<void index=\"7\""));
        assert_non_null(strstr(l.warning[0].text, "line 7 "));
        assert_non_null(strstr(l.warning[0].text, i == 3 ? "x1" : "y1"));
        rg_lines_free(&l);
        free(t.s);
    }
}

static void metadata_of_both_dialects(void **state)
{
    (void)state;
    static const char *const names[] = {"title", "editorName", "originalAuthorName", "reference", "memo"};
    for (dialect d = JAVA6; d <= JAVA7; d++) {
        text t = {0};
        open_file(&t, d, 0);
        put(&t, "</array>\n</void>\n%s", d == JAVA7 ? "</void>\n" : "");
        put(&t, "<void property=\"mainVersion\"><int>1</int></void>\n<void property=\"paperSize\"><double>400.0</double></void>\n");
        for (int i = 0; i < 5; i++) {
            const char *value = i == 0 ? "K\xc3\xb6nig &amp; \xe6\x8a\x98\xe3\x82\x8a\xe7\xb4\x99 45\xc2\xb0"
                                : i == 1 ? "" : i == 2 ? "a<char code=\"#1\"/>b<char code=\"#1f\"/>" : i == 3 ? "O&apos;Neill"
                                                                                                  : "one\ntwo\n";
            if (d == JAVA6) put(&t, "<void property=\"%s\">\n<string>%s</string>\n</void>\n", names[i], value);
            else put(&t, "<void class=\"oripa.DataSet\" method=\"getField\"><string>%s</string>\n<void method=\"set\">"
                         "<object idref=\"DataSet0\"/><string>%s</string></void></void>\n", names[i], value);
        }
        put(&t, "</object>\n</java>\n");
        rg_lines l = read_ok(&t);
        assert_int_equal(l.count, 0);
        assert_string_equal(l.title, "K\xc3\xb6nig & \xe6\x8a\x98\xe3\x82\x8a\xe7\xb4\x99 45\xc2\xb0");
        assert_string_equal(l.editor, "");
        assert_string_equal(l.author, "a\001b\037");
        assert_string_equal(l.reference, "O'Neill");
        assert_string_equal(l.memo, "one\ntwo\n");
        rg_lines_free(&l);
        free(t.s);
    }
}

/* A character that the code leaves no room for in a byte, and codes that are none, are blanks. */
static void control_characters(void **state)
{
    (void)state;
    text t = load("characters.opx");
    rg_lines l = read_ok(&t);
    assert_string_equal(l.title, "a\001\tb   c");
    rg_lines_free(&l);
    free(t.s);
}

/* A comment within a number or a name hid what follows it from a reader that takes the first child for the text. */
static void comments_are_nothing(void **state)
{
    (void)state;
    text t = load("comments.opx");
    rg_lines l = read_ok(&t);
    assert_int_equal(l.count, 1);
    is_line(&l, 0, RG_MOUNTAIN, 12.5, 0, 0, -3);
    assert_string_equal(l.title, "plain title");
    rg_lines_free(&l);
    free(t.s);
}

static void newer_versions_are_told(void **state)
{
    (void)state;
    text t = {0};
    open_file(&t, JAVA6, 0);
    put(&t, "</array></void>\n<void property=\"mainVersion\">\n<int>3</int></void></object></java>");
    rg_lines l = read_ok(&t);
    assert_int_equal(l.warnings, 1);
    assert_int_equal(l.warning[0].line, line_in(&t, "<int>3"));
    rg_lines_free(&l);
    free(t.s);
}

/* A byte-order mark, or UTF-16, is the encoding's business. */
static void byte_order_marks(void **state)
{
    (void)state;
    text t = load("byte-order-mark.opx"), wide = {0};
    assert_memory_equal(t.s, "\xef\xbb\xbf", 3);
    rg_lines l = read_ok(&t);
    is_line(&l, 0, RG_MOUNTAIN, -1.5, 0, 1.5, 0);
    rg_lines_free(&l);
    /* the same in UTF-16 */
    const char *from = strstr(t.s, "<java");
    wide.s = malloc(2 * t.n + 2);
    wide.s[wide.n++] = '\xff', wide.s[wide.n++] = '\xfe';
    for (; *from; from++) wide.s[wide.n++] = *from, wide.s[wide.n++] = 0;
    l = read_ok(&wide);
    is_line(&l, 0, RG_MOUNTAIN, -1.5, 0, 1.5, 0);
    rg_lines_free(&l);
    free(t.s);
    free(wide.s);
}

/* ------------------------------------------------------------------------------------------- what is not ---- */

static void bad_values_have_a_line(void **state)
{
    (void)state;
    static const struct { const char *property, *value, *words; } bad[] = {
        {"type", "<int>5</int>", "5"}, {"type", "<int>-1</int>", "-1"}, {"type", "<int>10</int>", "10"},
        {"type", "<int>two</int>", "two"}, {"type", "<int></int>", "type"}, {"type", "<double>2.0</double>", "2.0"},
        {"type", "<int>2x</int>", "2x"}, {"type", "<int>99999999999999999999</int>", "type"},
        {"type", "<int>4294967298</int>", "4294967298"},
        {"x0", "<double>12,5</double>", "12,5"}, {"y0", "<double></double>", "y0"}, {"x1", "<double>0x10</double>", "0x10"},
        {"y1", "<double>1.0.0</double>", "1.0.0"}, {"y1", "<double>nan</double>", "nan"}, {"x0", "<double>inf</double>", "inf"},
        {"x0", "<double>1 2</double>", "1 2"}, {"x0", "<double>-</double>", "x0"}, {"x0", "<double>Infinityx</double>", "Infinityx"},
        {"x0", "<null/>", "x0"}, {"x0", "<double>e5</double>", "e5"}, {"x0", "<double>1e</double>", "1e"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dialect d = i % 2 ? JAVA7 : JAVA6;
        text t = {0};
        open_file(&t, d, 2);
        put_line(&t, 0, 1, "1", "2", "3", "4");
        put(&t, "<void index=\"1\">\n<object class=\"oripa.OriLineProxy\">\n<void property=\"%s\">\n%s\n</void></object></void>", bad[i].property, bad[i].value);
        close_file(&t, d);
        refused(&t, line_in(&t, bad[i].value), bad[i].words);
        free(t.s);
    }
}

/* Line numbers of libxml2's elements end at 65535; a message must still name the line. */
static void lines_far_down(void **state)
{
    (void)state;
    text t = {0};
    open_file(&t, JAVA7, 9000);
    for (int i = 0; i < 9000; i++) put_line(&t, i, 1 + i % 3, "1", "2", "3", i == 8990 ? "NaN" : "4");
    text bad = {0};
    put(&bad, "%s", t.s);
    close_file(&t, JAVA7);
    rg_lines l = read_ok(&t);
    assert_int_equal(l.count, 8999);
    assert_int_equal(l.warnings, 1);
    assert_true(l.warning[0].line > 100000);
    assert_int_equal(l.warning[0].line, line_in(&t, "<void index=\"8990\""));
    assert_int_equal(l.line[8900].where, line_in(&t, "<void index=\"8900\""));
    rg_lines_free(&l);
    put_line(&bad, 9000, 7, "1", "2", "3", "4");
    close_file(&bad, JAVA7);
    refused(&bad, line_in(&bad, "<int>7"), "7");
    free(t.s);
    free(bad.s);
}

static void entries_without_an_index(void **state)
{
    (void)state;
    static const char *const bad[] = {"<void>\n</void>", "<void index=\"\"/>", "<void index=\"-3\"/>", "<void index=\"1e3\"/>",
                                      "<void index=\"2147483648000\"/>", "<object class=\"oripa.OriLineProxy\"/>",
                                      "<void index=\"0\"><string>a line</string></void>"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        text t = {0};
        open_file(&t, JAVA6, 1);
        put(&t, "%s\n", bad[i]);
        close_file(&t, JAVA6);
        refused(&t, line_in(&t, bad[i]), "entry");
        free(t.s);
    }
}

/* Entities that open into gigabytes, a file fetched from elsewhere, or only a document type: no ORIPA file has one. */
static void document_types_are_refused(void **state)
{
    (void)state;
    static const char *const names[] = {"entity-bomb.opx", "entity-quadratic.opx", "entity-attribute.opx", "external-entity.opx", "doctype.opx"};
    for (int i = 0; i < 5; i++) {
        text t = load(names[i]);
        rg_lines l;
        rg_diag why;
        assert_int_equal(read_bytes(t.s, t.n, &l, &why), RG_EFORMAT);
        if (!strstr(why.text, "document type") || why.line != line_in(&t, "<!DOCTYPE")) {
            print_error("%s:%d: %s\n", names[i], why.line, why.text);
            fail();
        }
        free(t.s);
    }
}

static void nesting_ends(void **state)
{
    (void)state;
    text t = {0};
    open_file(&t, JAVA6, 1);
    for (int i = 0; i < 200000; i++) put(&t, "<void>");
    rg_lines l;
    rg_diag why;
    assert_int_equal(read_bytes(t.s, t.n, &l, &why), RG_EFORMAT);
    assert_true(why.text[0] && why.line > 0);
    free(t.s);
}

/* Whatever is cut off, the answer is a message, never half a pattern. */
static void every_truncation_is_refused(void **state)
{
    (void)state;
    for (dialect d = JAVA6; d <= JAVA7; d++) {
        text t = {0};
        open_file(&t, d, 1);
        put_line(&t, 0, 1, "1", "2", "3", "4");
        close_file(&t, d);
        const size_t whole = (size_t)(strstr(t.s, "</java>") - t.s) + 7;
        for (size_t n = 0; n < whole; n++) {
            rg_lines l;
            rg_diag why;
            char *exact = malloc(n + 1); /* a block of the right size, so that reading past its end is noticed */
            memcpy(exact, t.s, n);
            rg_status s = read_bytes(exact, n, &l, &why);
            if (s != RG_EFORMAT || !why.text[0]) fail_msg("cut at %zu: status %d, %s", n, s, why.text);
            free(exact);
        }
        free(t.s);
    }
}

/* Bytes turned at random: a message or a pattern, and nothing else. What may happen besides shows under the sanitizers. */
static void damaged_files(void **state)
{
    (void)state;
    text t = {0};
    unsigned seed = 20;
    int read = 0, told = 0;
    open_file(&t, JAVA7, 3);
    put_line(&t, 0, 1, "1.25", "2", "3", "4");
    put_line(&t, 1, 2, "1.25", "2", NULL, "-4.0E-17");
    put(&t, "<void index=\"2\"><object class=\"oripa.OriLineProxy\"/></void>\n");
    close_file(&t, JAVA7);
    for (int round = 0; round < 4000; round++) {
        char *copy = malloc(t.n);
        memcpy(copy, t.s, t.n);
        for (int i = 0; i <= round % 4; i++)
            copy[(size_t)((noise(&seed) + 1) / 2 * (double)t.n)] = (char)(128 + 127 * noise(&seed));
        rg_lines l;
        rg_diag why;
        rg_status s = read_bytes(copy, t.n, &l, &why);
        assert_true(s == RG_OK || s == RG_EFORMAT);
        assert_true(s == RG_OK || (why.text[0] && why.line >= 0));
        s == RG_OK ? read++ : told++;
        if (s == RG_OK) rg_lines_free(&l);
        free(copy);
    }
    assert_true(read > 40 && told > 1000);
    free(t.s);
}

static void other_roots(void **state)
{
    (void)state;
    static const struct { const char *xml, *words; int line; } bad[] = {
        {"", "empty", 0},
        {"\n\n<svg xmlns=\"http://www.w3.org/2000/svg\"/>", "<svg>", 3},
        {"<object class=\"oripa.DataSet\"/>", "<object>", 1},
        {"<java/>", "oripa.DataSet", 1},
        {"<java>\n<object class=\"java.util.Vector\"/>\n</java>", "oripa.DataSet", 1},
        {"<java>\n<object class=\"oripa.DataSet\"/>\n</java>", "no list of lines", 2},
        {"<java>\n<object class=\"oripa.DataSet\">\n<void property=\"lines\"><null/></void></object>\n</java>", "no list of lines", 2},
        {"<java>\n<object class=\"oripa.DataSet\"><void property=\"lines\"><array/></void>\n<void property=\"lines\"><array/></void></object></java>",
         "second", 3},
        {"1 -200 -200 200 -200\n", "XML", 1},
        {"{\"file_spec\": 1.1}", "XML", 1},
        {"<java>\n</jav>", "XML", 2},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        text t = {0};
        put(&t, "%s", bad[i].xml);
        refused(&t, bad[i].line, bad[i].words);
        free(t.s);
    }
    static const char zeros[64] = {0};
    rg_lines l;
    rg_diag why;
    assert_int_equal(read_bytes(zeros, sizeof zeros, &l, &why), RG_EFORMAT);
}

static void memory_runs_short(void **state)
{
    (void)state;
    text t = {0};
    open_file(&t, JAVA6, 40);
    for (int i = 0; i < 40; i++) put_line(&t, i, 1, "1", "2", i % 4 ? "3" : "NaN", "4");
    put(&t, "</array></void><void property=\"title\"><string>one</string></void><void property=\"memo\"><string>two</string></void></object></java>");
    long k = 0;
    for (rg_status s = RG_ENOMEM; s != RG_OK; k++) {
        counted c = {k, 0, 0};
        rg_memory mem = {counted_resize, &c};
        rg_lines l;
        rg_diag why;
        s = rg_opx_read(t.s, t.n, &mem, NULL, &l, &why);
        assert_true(s == RG_OK || s == RG_ENOMEM);
        assert_true(k < 100);
        if (s == RG_OK) rg_lines_free(&l);
        assert_int_equal(c.out, 0);
    }
    assert_true(k > 4);
    free(t.s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_dialects_say_the_same),
        cmocka_unit_test(empty_and_missing_entries),
        cmocka_unit_test(order_does_not_matter),
        cmocka_unit_test(lines_that_are_nowhere_are_dropped),
        cmocka_unit_test(metadata_of_both_dialects),
        cmocka_unit_test(control_characters),
        cmocka_unit_test(comments_are_nothing),
        cmocka_unit_test(newer_versions_are_told),
        cmocka_unit_test(byte_order_marks),
        cmocka_unit_test(bad_values_have_a_line),
        cmocka_unit_test(lines_far_down),
        cmocka_unit_test(entries_without_an_index),
        cmocka_unit_test(document_types_are_refused),
        cmocka_unit_test(nesting_ends),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(damaged_files),
        cmocka_unit_test(other_roots),
        cmocka_unit_test(memory_runs_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
