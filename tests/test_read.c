/* read/read.c: which format it is, files and standard input, bytes that are no crease pattern; files damaged at random. */
#include "counted.h"
#include "reading.h"
#include "asked.h"


static const char CP[] = "1 0 0 4 0\n1 4 0 4 4\n1 4 4 0 4\n1 0 4 0 0\n2 0 0 4 4\n";
static const char FOLD[] = "{\"file_spec\":1.1,\"vertices_coords\":[[0,0],[4,0],[4,4],[0,4]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],"
    "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\"],\"edges_foldAngle\":[0,0,0,0,-90.5],\"faces_vertices\":[[0,1,2],[0,2,3]],"
    "\"file_frames\":[{\"frame_inherit\":true,\"frame_parent\":0,\"frame_title\":\"x\"}],\"a:b\":[1,{\"c\":null}]}";
static const char SVG[] = "<?xml version='1.0'?><!-- <java> --><!DOCTYPE svg [<!ENTITY e '>'>]>\n<svg:svg xmlns:svg='http://www.w3.org/2000/svg'>"
    "<svg:style>.m{stroke:#f00} .b{stroke:#000;opacity:1}</svg:style><svg:g transform='scale(2) rotate(90)'><svg:rect class='b' width='4' height='4'/>"
    "<svg:path class='m' opacity='.5' d='M0,0l1e0.5.5-1 H1v2z'/><svg:polyline class='m' points='0 0,4 4'/></svg:g></svg:svg>";
static const char OPX[] = "<java class=\"java.beans.XMLDecoder\"><object class=\"oripa.DataSet\"><void property=\"lines\">"
    "<array class=\"oripa.OriLineProxy\" length=\"1\"><void index=\"0\"><object class=\"oripa.OriLineProxy\"><void property=\"type\"><int>2</int></void>"
    "<void property=\"x0\"><double>1.5</double></void></object></void></array></void></object></java>";
static const char DXF[] = "999\nhello\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nMountain\n10\n0\n20\n0\n11\n4\n21\n4\n0\nLWPOLYLINE\n62\n5\n70\n1\n"
    "10\n0\n20\n0\n10\n1\n20\n1\n10\n2\n20\n5\n0\nENDSEC\n0\nEOF\n";
/* Drawings that repeat their parts. */
static const char USE[] = "<svg><symbol id='s' viewBox='0 0 2 2'><path id='p' stroke='red' d='M0 0L1 1'/></symbol><g id='g' stroke='#00f'><path d='M0 0H2'/>"
    "<use href='#s' width='4' height='4' x='1'/></g><use href='#g' transform='rotate(45)'/>\n<use xlink:href='#p' y='2'/><use href='#nothing'/></svg>";
static const char INSERT[] = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nunit\n10\n1\n20\n1\n0\nLINE\n8\n0\n62\n0\n10\n0\n20\n0\n11\n4\n21\n4\n0\nENDBLK\n"
    "0\nBLOCK\n2\nrow\n0\nINSERT\n2\nunit\n70\n3\n44\n2.5\n50\n90\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nrow\n62\n1\n"
    "41\n2\n42\n-2\n10\n7\n20\n0\n0\nINSERT\n2\nnothing\n0\nENDSEC\n0\nEOF\n";
static const struct { const char *text; rg_format format; const char *name; } samples[] = {
    {CP, RG_FORMAT_CP, "x.cp"}, {FOLD, RG_FORMAT_FOLD, "x.fold"}, {SVG, RG_FORMAT_SVG, "x.svg"}, {OPX, RG_FORMAT_OPX, "x.opx"},
    {DXF, RG_FORMAT_DXF, "x.dxf"}, {USE, RG_FORMAT_SVG, "x.svg"}, {INSERT, RG_FORMAT_DXF, "x.dxf"}};
enum { SAMPLES = sizeof samples / sizeof *samples };

static rg_format format_of(const char *text, size_t n, const char *path, rg_diag *why)
{
    const rg_reading s = rg_reading_default();
    rg_format format;
    return rg_read_format(text, n, path, &s, &format, why) == RG_OK ? format : RG_FORMAT_AUTO;
}

static void content_goes_before_the_name(void **state)
{
    (void)state;
    rg_diag why;
    for (int i = 0; i < SAMPLES; i++)
        for (int k = 0; k < SAMPLES; k++) {
            assert_int_equal(format_of(samples[i].text, strlen(samples[i].text), samples[k].name, &why), samples[i].format);
            assert_int_equal(format_of(samples[i].text, strlen(samples[i].text), NULL, &why), samples[i].format);
        }
    assert_int_equal(format_of("hello", 5, "a.b/x.CP", &why), RG_FORMAT_CP);
    assert_int_equal(format_of("<!-- ", 5, "x.xml", &why), RG_FORMAT_OPX);
    assert_int_equal(format_of("hello", 5, "x.txt", &why), RG_FORMAT_AUTO);
    assert_int_equal(why.line, 1);
    assert_int_equal(format_of("hello", 5, "cp", &why), RG_FORMAT_AUTO);
    assert_int_equal(format_of("<html>", 6, NULL, &why), RG_FORMAT_AUTO);
    assert_int_equal(format_of("<javascript/>", 13, NULL, &why), RG_FORMAT_AUTO);
}

/* Oriedita's own: points in each of their spellings, colours by name and by number. */
static void ori(void **state)
{
    (void)state;
    const char *text = "{\"@version\":\"v1.1\",\"title\":\"lid\",\"lineSegments\":[{\"a\":\"-2.0,1.5\",\"b\":\"3.0,4.0E0\",\"color\":\"RED_1\"},\n"
                       "{\"a\":{\"x\":1,\"y\":2},\"b\":[3,4],\"color\":2},{\"a\":\"0,0\",\"b\":\"1,0\",\"color\":\"CYAN_3\"},\n"
                       "{\"a\":\"0,0\",\"b\":\"0,1\",\"color\":\"BLACK_0\"}],\"circles\":[]}";
    rg_lines l = read_ok(text, RG_FORMAT_AUTO, NULL);
    assert_int_equal(l.count, 4);
    is_line(&l, 0, 'M', -2, -1.5, 3, -4, NAN);
    is_line(&l, 1, 'V', 1, -2, 3, -4, NAN);
    is_line(&l, 2, 'F', 0, 0, 1, 0, NAN);
    is_line(&l, 3, 'B', 0, 0, 0, -1, NAN);
    assert_int_equal(l.line[3].where, 3);
    assert_string_equal(l.title, "lid");
    rg_lines_free(&l);
    refused("{\"@version\":\"v2\",\"lineSegments\":[]}", RG_FORMAT_AUTO, NULL, 1, "\"v2\" is not known");
    refused("{\"lineSegments\":[{\"a\":\"0,0\",\"b\":\"1,0\"},\n{\"a\":\"0;0\",\"b\":\"1,0\"}]}", RG_FORMAT_AUTO, NULL, 2, "lineSegments[1]");
    refused("{\"lineSegments\":[]}", RG_FORMAT_ORI, NULL, 1, "none");
}

static void the_format_asked_for(void **state)
{
    (void)state;
    refused(CP, RG_FORMAT_FOLD, NULL, 1, "JSON");
    refused(FOLD, RG_FORMAT_CP, NULL, 1, "line type");
    refused(FOLD, RG_FORMAT_SVG, NULL, 1, "XML");
    refused(OPX, RG_FORMAT_SVG, NULL, 1, "<java>");
    refused(SVG, RG_FORMAT_OPX, NULL, -1, "document type");
}

static void what_is_no_crease_pattern(void **state)
{
    (void)state;
    const struct { const char *text; size_t n; const char *words; } no[] = {
        {"", 0, "empty"}, {"\xEF\xBB\xBF", 3, "empty"}, {"\x89PNG\r\n\x1a\n", 8, "pixels"}, {"%PDF-1.4", 8, ".svg"},
        {"PK\x03\x04zip", 7, "unpack"}, {"\xFF\xFE<\0", 4, "UTF-16"}, {"AutoCAD Binary DXF\r\n", 20, "ASCII"}, {"\0\0\0\0", 4, "not a crease pattern"}};
    for (size_t i = 0; i < sizeof no / sizeof *no; i++) {
        rg_lines l;
        rg_diag why;
        assert_int_equal(read_text(no[i].text, no[i].n, RG_FORMAT_AUTO, NULL, &l, &why), RG_EFORMAT);
        if (!strstr(why.text, no[i].words)) fail_msg("%s", why.text);
    }
    rg_reading s = rg_reading_default();
    rg_lines l;
    rg_diag why;
    assert_int_equal(rg_read_file("no/such/file.cp", &s, 0, &l, &why), RG_EREAD);
    assert_int_equal(rg_read_file(".", &s, 0, &l, &why), RG_EREAD);
}

static void byte_order_marks(void **state)
{
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        char text[2000];
        snprintf(text, sizeof text, "\xEF\xBB\xBF%s", samples[i].text);
        rg_lines with = read_ok(text, RG_FORMAT_AUTO, NULL), without = read_ok(samples[i].text, RG_FORMAT_AUTO, NULL);
        assert_int_equal(with.count, without.count);
        rg_lines_free(&with);
        rg_lines_free(&without);
    }
}

/* Memory that runs short at any request ends in RG_ENOMEM and leaks nothing. */
static void memory_runs_short(void **state)
{
    (void)state;
    for (int i = 0; i < SAMPLES; i++)
        for (int keep = 0; keep < 2; keep++) {
            rg_status status = RG_ENOMEM;
            long k = 0;
            for (; status == RG_ENOMEM; k++) {
                counted c = {.left = k};
                const rg_memory mem = {counted_resize, &c};
                rg_reading s = rg_reading_default();
                rg_lines l;
                rg_diag why = {0, ""};
                s.memory = &mem;
                status = rg_read_bytes(samples[i].text, strlen(samples[i].text), NULL, &s, keep, &l, &why);
                if (status == RG_OK) {
                    assert_int_equal(l.vertex != NULL, keep && samples[i].format == RG_FORMAT_FOLD);
                    rg_lines_free(&l);
                } else {
                    assert_string_equal(why.text, "out of memory");
                }
                assert_int_equal(c.out, 0);
            }
            assert_int_equal(status, RG_OK);
            assert_true(k > 1);
        }
}

/* One to four places of a good file are spoilt: whatever is read, it ends in a status, one line of words, and finite lines. */
static void damaged_at_random(void **state)
{
    (void)state;
    unsigned seed = 20241;
    int read = 0;
    for (int round = 0; round < 6000; round++) {
        const int i = round % SAMPLES;
        const size_t n = strlen(samples[i].text);
        char text[2000];
        size_t length = n;
        memcpy(text, samples[i].text, n);
        for (int k = 0; k < 1 + round / SAMPLES % 4 && length > 1; k++) {
            const size_t at = (size_t)((noise(&seed) + 1) / 2 * (double)length), from = (size_t)((noise(&seed) + 1) / 2 * (double)length);
            switch ((int)(3 * (noise(&seed) + 1) / 2 * 1.99)) {
            case 0: text[at] = (char)(int)(128 * noise(&seed)); break;
            case 1: text[at] = text[from]; break;
            case 2: text[at] = "0123456789-.e<>\"'{}[],:\n \\"[(size_t)((noise(&seed) + 1) / 2 * 26)]; break;
            case 3: memmove(text + at, text + at + 1, length - at - 1); length--; break;
            case 4: memmove(text + at + 1, text + at, length - at); length++; break;
            default: length = at; break;
            }
        }
        /* In a block of its own, so that a byte read beyond the end is seen. */
        char *block = malloc(length + (length == 0));
        assert_non_null(block);
        memcpy(block, text, length);
        rg_lines l;
        rg_diag why;
        const rg_status s = read_text(block, length, samples[i].format, NULL, &l, &why);
        free(block);
        if (s != RG_OK) {
            assert_int_equal(s, RG_EFORMAT);
            assert_true(why.text[0] && !strchr(why.text, '\n') && why.line >= 0);
            continue;
        }
        read++;
        for (int32_t e = 0; e < l.count; e++) {
            const rg_line *q = &l.line[e];
            assert_true(isfinite(q->a.x) && isfinite(q->a.y) && isfinite(q->b.x) && isfinite(q->b.y));
            assert_non_null(strchr("BMVFUC", q->assignment));
            assert_true(isnan(q->target) || fabs(q->target) <= RG_PI);
        }
        rg_lines_free(&l);
    }
    assert_in_range(read, 300, 5700); /* both ways are taken */
}

/* Many short lines, in each format; `size`: out. Owner: the caller. */
static char *many(rg_format format, int lines, size_t *size)
{
    static const char *const begin[] = {[RG_FORMAT_CP] = "", [RG_FORMAT_OPX] = "<java><object class=\"oripa.DataSet\"><void property=\"lines\"><array>",
        [RG_FORMAT_SVG] = "<svg>", [RG_FORMAT_DXF] = "0\nSECTION\n2\nENTITIES\n", [RG_FORMAT_ORI] = "{\"lineSegments\":[", [RG_FORMAT_FOLD] = "{\"edges_vertices\":["};
    static const char *const end[] = {[RG_FORMAT_CP] = "", [RG_FORMAT_OPX] = "</array></void></object></java>", [RG_FORMAT_SVG] = "</svg>",
        [RG_FORMAT_DXF] = "0\nENDSEC\n0\nEOF\n", [RG_FORMAT_ORI] = "]}", [RG_FORMAT_FOLD] = "]}"};
    const size_t room = 400 * (size_t)lines + 1000;
    char *s = malloc(room);
    size_t at = (size_t)snprintf(s, room, "%s", begin[format]);
    for (int i = 0; i < lines; i++) {
        const char *comma = i < lines - 1 ? "," : "";
        switch (format) {
        case RG_FORMAT_CP: at += (size_t)snprintf(s + at, room - at, "2 %d 0 %d 1\n", i, i); break;
        case RG_FORMAT_OPX:
            at += (size_t)snprintf(s + at, room - at, "<void index=\"%d\"><object><void property=\"type\"><int>2</int></void><void property=\"x0\"><double>%d</double></void>"
                                   "<void property=\"x1\"><double>%d</double></void><void property=\"y1\"><double>1</double></void></object></void>", i, i, i);
            break;
        case RG_FORMAT_SVG: at += (size_t)snprintf(s + at, room - at, "<path stroke=\"red\" d=\"M%d 0V1\"/>", i); break;
        case RG_FORMAT_DXF: at += (size_t)snprintf(s + at, room - at, "0\nLINE\n62\n1\n10\n%d\n20\n0\n11\n%d\n21\n1\n", i, i); break;
        case RG_FORMAT_ORI: at += (size_t)snprintf(s + at, room - at, "{\"a\":\"%d,0\",\"b\":\"%d,1\",\"color\":\"RED_1\"}%s", i, i, comma); break;
        default: at += (size_t)snprintf(s + at, room - at, "[%d,%d]%s", 2 * i, 2 * i + 1, comma); break;
        }
    }
    if (format == RG_FORMAT_FOLD) {
        at += (size_t)snprintf(s + at, room - at, "],\"vertices_coords\":[");
        for (int i = 0; i < lines; i++) at += (size_t)snprintf(s + at, room - at, "[%d,0],[%d,1]%s", i, i, i < lines - 1 ? "," : "");
    }
    at += (size_t)snprintf(s + at, room - at, "%s", end[format]);
    assert_true(at < room);
    *size = at;
    return s;
}

/* A file is asked for all along whether to go on, in every format, and can be ended each time; nothing is kept of it then. */
static void reading_can_be_ended_in_the_middle(void **state)
{
    (void)state;
    static const rg_format formats[] = {RG_FORMAT_CP, RG_FORMAT_OPX, RG_FORMAT_SVG, RG_FORMAT_DXF, RG_FORMAT_FOLD, RG_FORMAT_ORI};
    enum { LINES = 20000, EVER = 1 << 30 };
    for (int f = 0; f < 6; f++) {
        size_t size;
        char *text = many(formats[f], LINES, &size);
        int all = EVER;
        for (int end_at = EVER; end_at >= 0; end_at = end_at == EVER ? all - 1 : end_at - 1 - all / 8) {
            counted c = {1000000000, 0, 0};
            const rg_memory mem = {counted_resize, &c};
            asked a = {0, end_at, 0};
            rg_reading s = rg_reading_default();
            rg_lines l = {.count = 0};
            rg_diag why = {0, ""};
            s.memory = &mem;
            s.format = formats[f];
            s.progress = answer, s.progress_ctx = &a;
            assert_int_equal(rg_read_bytes(text, size, NULL, &s, 0, &l, &why), end_at == EVER ? RG_OK : RG_ECANCELLED);
            if (end_at == EVER) assert_int_equal(l.count, LINES);
            if (end_at == EVER) all = a.times;
            else assert_true(a.times == end_at + 1 && why.text[0] && !strchr(why.text, '\n'));
            rg_lines_free(&l);
            assert_int_equal(c.out, 0);
        }
        assert_true(all >= LINES / 2500 && all < 5000);
        free(text);
    }
}

/* So it is where there are no lines for long. */
static void reading_can_be_ended_between_lines(void **state)
{
    (void)state;
    static const struct { rg_format format; const char *begin, *part, *end; } tries[] = {
        {RG_FORMAT_CP, "1 0 0 1 0\n", " \n", ""},
        {RG_FORMAT_DXF, "", "999\nno line\n", "0\nSECTION\n2\nENTITIES\n0\nLINE\n11\n1\n0\nEOF\n"},
        {RG_FORMAT_SVG, "<svg>", "<g/>\n", "<line stroke='red' x2='1'/></svg>"},
        {RG_FORMAT_FOLD, "{\"vertices_coords\":[[0,0]", ",\n[1,0]", "],\"edges_vertices\":[[0,1]],\"edges_assignment\":[\"M\"]}"}};
    enum { PARTS = 400000 };
    for (size_t f = 0; f < sizeof tries / sizeof *tries; f++) {
        const size_t one = strlen(tries[f].part);
        char *text = malloc(200 + PARTS * one), *at;
        assert_non_null(text);
        at = stpcpy(text, tries[f].begin);
        for (int i = 0; i < PARTS; i++) at = stpcpy(at, tries[f].part);
        at = stpcpy(at, tries[f].end);
        asked a = {0, 1 << 30, 0};
        rg_reading s = rg_reading_default();
        rg_lines l = {.count = 0};
        rg_diag why = {0, ""};
        s.format = tries[f].format;
        s.progress = answer, s.progress_ctx = &a;
        assert_int_equal(rg_read_bytes(text, (size_t)(at - text), NULL, &s, 0, &l, &why), RG_OK);
        assert_int_equal(l.count, 1);
        rg_lines_free(&l);
        const int parser = s.format == RG_FORMAT_SVG ? PARTS / 2000 : s.format == RG_FORMAT_FOLD ? PARTS * 7 >> 18 : 0;
        if (!(a.times > parser + 2 && a.times < 5000)) fail_msg("format %d: asked %d times, by the parser %d", (int)s.format, a.times, parser);
        a = (asked){0, a.times - 1, 0};
        assert_int_equal(rg_read_bytes(text, (size_t)(at - text), NULL, &s, 0, &l, &why), RG_ECANCELLED);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(content_goes_before_the_name), cmocka_unit_test(ori), cmocka_unit_test(the_format_asked_for), cmocka_unit_test(what_is_no_crease_pattern),
        cmocka_unit_test(byte_order_marks), cmocka_unit_test(memory_runs_short), cmocka_unit_test(reading_can_be_ended_in_the_middle), cmocka_unit_test(reading_can_be_ended_between_lines),
        cmocka_unit_test(damaged_at_random)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
