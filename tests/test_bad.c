/* Files that broke something once, and files that were made to: each is read or refused, in one line that a user can do something with.
 * What `make fuzz` finds is put there. Sanitizers look on in `make asan`. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"

#include "rigami.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char FOLDER[] = "patterns/bad";

static void one_line(const rg_diag *why, const char *name)
{
    assert_true(why->text[0] && why->line >= 0);
    for (const char *c = why->text; *c; c++)
        if (iscntrl((unsigned char)*c)) fail_msg("%s: a control character in \"%s\"", name, why->text);
    /* in UTF-8: CONTROL SEQUENCE INTRODUCER, LINE SEPARATOR */
    if (strstr(why->text, "\xC2\x9B") || strstr(why->text, "\xE2\x80\xA8")) fail_msg("%s: what a terminal obeys in \"%s\"", name, why->text);
}

static void tell(void *name, const rg_diag *warning) { one_line(warning, name); }

/* Converted, where that is done, to something that can be read. */
static void converted_or_refused(const char *path, const char *out, const rg_reading *s)
{
    for (rg_format to = RG_FORMAT_OPX; to <= RG_FORMAT_DXF; to++) {
        rg_diag why = {0, ""};
        rg_status status = rg_convert(path, out, to, s, tell, (void *)path, &why);
        if (status != RG_OK) {
            assert_int_equal(status, RG_EFORMAT);
            one_line(&why, path);
            continue;
        }
        rg_reading as = *s;
        as.format = to;
        status = rg_convert(out, "/dev/null", to, &as, NULL, NULL, &why);
        if (status != RG_OK) fail_msg("%s in format %d cannot be read again: %s", path, (int)to, why.text);
    }
}

/* Read, looked at, converted: with the status of a bad file, where it is one. */
static void read_or_refused(void **state)
{
    (void)state;
    char out[] = "/tmp/rigami-bad-XXXXXX";
    const int fd = mkstemp(out);
    assert_true(fd >= 0);
    close(fd);
    DIR *folder = opendir(FOLDER);
    const rg_reading s = rg_reading_default();
    int files = 0, refused = 0;
    assert_non_null(folder);
    for (const struct dirent *e; (e = readdir(folder));) {
        char path[300];
        rg_pattern *p = NULL;
        rg_diag why = {0, ""};
        if (e->d_name[0] == '.') continue;
        snprintf(path, sizeof path, "%s/%s", FOLDER, e->d_name);
        const rg_status status = rg_pattern_read(path, &s, &p, &why);
        if (status == RG_OK) {
            const rg_diag *warning;
            const int32_t n = rg_pattern_warnings(p, &warning);
            for (int32_t i = 0; i < n; i++) one_line(&warning[i], path);
            assert_int_equal(rg_info_write(p, "/dev/null", &why), RG_OK);
        } else {
            assert_int_equal(status, RG_EFORMAT);
            one_line(&why, path);
            refused++;
        }
        rg_pattern_destroy(p);
        converted_or_refused(path, out, &s);
        files++;
    }
    closedir(folder);
    unlink(out);
    assert_true(files > 10 && refused > 0 && refused < files);
}

/* line -1: any. */
static void is_refused_at(const char *name, int line, const char *words)
{
    char path[300];
    const rg_reading s = rg_reading_default();
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    snprintf(path, sizeof path, "%s/%s", FOLDER, name);
    assert_int_equal(rg_pattern_read(path, &s, &p, &why), RG_EFORMAT);
    if (!strstr(why.text, words) || (line >= 0 && why.line != line))
        fail_msg("%s: line %d: \"%s\", not \"%s\"", name, why.line, why.text, words);
}

static void is_refused(const char *name, const char *words) { is_refused_at(name, -1, words); }

/* Read, with so many lines of each kind. */
static void has_kinds(const char *name, int mountains, int valleys)
{
    char path[300];
    const rg_reading s = rg_reading_default();
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    snprintf(path, sizeof path, "%s/%s", FOLDER, name);
    if (rg_pattern_read(path, &s, &p, &why) != RG_OK) fail_msg("%s: line %d: %s", name, why.line, why.text);
    const rg_pattern_info *i = rg_pattern_get_info(p);
    if (i->mountains != mountains || i->valleys != valleys)
        fail_msg("%s: %d mountains and %d valleys, not %d and %d", name, (int)i->mountains, (int)i->valleys, mountains, valleys);
    rg_pattern_destroy(p);
}

/* A number was shown as the file has it, with what stands in its lines: a file could say anything in the program's name. */
static void what_a_file_says_is_one_line(void **state)
{
    (void)state;
    is_refused("lines-in-number.opx", "which is no number");
}

/* The least of all whole numbers has no absolute value, and passed for a vertex; the product of two sizes can be any number. */
static void numbers_of_vertices_are_within(void **state)
{
    (void)state;
    is_refused("facet-corner.dxf", "a facet of vertex -9223372036854775808, they end at 3");
    is_refused("mesh-size.dxf", "a mesh of 4294967298 by 4294967298 with 4 vertices");
}

/* A value that stands alone is no pattern, and was told as memory that is short. */
static void a_number_is_no_pattern(void **state)
{
    (void)state;
    is_refused("number.fold", "not well-formed JSON");
}

/* Converted to FOLD, such lines left a file that could not be read again. */
static void lines_without_length_are_no_pattern(void **state)
{
    (void)state;
    const rg_reading s = rg_reading_default();
    rg_diag why = {0, ""};
    assert_int_equal(rg_convert("patterns/bad/no-length.cp", "/dev/null", RG_FORMAT_FOLD, &s, NULL, NULL, &why), RG_EFORMAT);
    assert_non_null(strstr(why.text, "no line that has a length"));
}

/* The readers had different limits: what one of them took, FOLD could be written with and not read. */
static void coordinates_have_one_limit(void **state)
{
    (void)state;
    is_refused("large.cp", "a coordinate of 1e+154 is too large to compute with");
}

/* Selectors whose brackets do not end, thousands deep, and whose numbers no computer has are told, and the rest is drawn. */
static void selectors_are_within(void **state)
{
    (void)state;
    static const char *const name[] = {"brackets-in-selector.svg", "number-in-selector.svg"};
    for (int k = 0; k < 2; k++) {
        char path[80];
        const rg_reading r = rg_reading_default();
        rg_pattern *p = NULL;
        rg_diag why = {0, ""};
        snprintf(path, sizeof path, "%s/%s", FOLDER, name[k]);
        assert_int_equal(rg_pattern_read(path, &r, &p, &why), RG_OK);
        assert_int_equal(rg_pattern_get_info(p)->creases, 1);
        const rg_diag *told;
        assert_true(rg_pattern_warnings(p, &told) > 0);
        rg_pattern_destroy(p);
    }
}

/* A sheet without a crease has nothing to fold, and folds: angles between its frames are none. */
static void a_sheet_without_creases_folds(void **state)
{
    (void)state;
    const rg_reading r = rg_reading_default();
    rg_settings settings = rg_settings_default();
    settings.frames = 3;
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    assert_int_equal(rg_pattern_read("patterns/bad/no-creases.fold", &r, &p, &why), RG_OK);
    assert_int_equal(rg_motion_create(p, &settings, NULL, NULL, &m, &why), RG_OK);
    const rg_report *q = rg_motion_report(m);
    assert_int_equal(q->outcome, RG_FOLDED);
    assert_int_equal(q->unknowns, 0);
    assert_int_equal(rg_motion_write(m, "/dev/null", NULL, &why), RG_EARG); /* no form that it names */
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
}

/* What a file says wrongly was forgotten when something was right behind it; what it does not say was made up. */
static void nothing_is_made_up(void **state)
{
    (void)state;
    is_refused_at("two-values.opx", 7, "line type 7 is not one of");
    is_refused_at("no-edges.fold", 4, "no edges_vertices to say which edges these are");
    is_refused_at("loop.svg", 3, "a curve"); /* it has no chord, and passed for a straight line without length */
}

/* Both were told at line 1. */
static void places_are_where_they_are(void **state)
{
    (void)state;
    is_refused_at("version.ori", 3, "\"v9\" is not known");
    is_refused_at("no-list.ori", 3, "lineSegments: there are none");
}

/* A value ended where an entity stood, and a style that one stood for was lost; so were lines. */
static void entities_are_opened_or_refused(void **state)
{
    (void)state;
    has_kinds("entity-in-value.svg", 2, 2); /* diagonals that cross */
    is_refused_at("entity-of-lines.svg", 4, "no plain text");
    is_refused_at("entity-in-entity.svg", 4, "no plain text");
}

/* Numbers of more than 500 characters were two, the flags of an arc one with what follows, and 3000 names of an element
 * weighed less than none. */
static void numbers_of_drawings_are_whole(void **state)
{
    (void)state;
    has_kinds("long-number.svg", 1, 0);
    has_kinds("flags.svg", 0, 0);
    has_kinds("weight-of-selector.svg", 1, 0);
}

/* A LWPOLYLINE in a block forgot the colour of the INSERT; names of layers are the same in small and capital letters. */
static void lines_have_the_colour_of_what_they_are_in(void **state)
{
    (void)state;
    has_kinds("colour-of-block.dxf", 1, 0);
    has_kinds("letters-of-layer.dxf", 1, 0);
}

/* Names that move the cursor, in a warning (read_or_refused) and in what is told of the pattern. */
static void what_is_shown_moves_no_cursor(void **state)
{
    (void)state;
    static const char *const names[] = {"controls.dxf", "characters.opx"};
    for (int k = 0; k < 2; k++) {
        char path[300], out[] = "/tmp/rigami-bad-XXXXXX", text[4000];
        const rg_reading s = rg_reading_default();
        rg_pattern *p = NULL;
        rg_diag why = {0, ""};
        const int fd = mkstemp(out);
        assert_true(fd >= 0);
        snprintf(path, sizeof path, "%s/%s", FOLDER, names[k]);
        assert_int_equal(rg_pattern_read(path, &s, &p, &why), RG_OK);
        assert_int_equal(rg_info_text(p, 1, out, &why), RG_OK);
        FILE *f = fopen(out, "r");
        assert_non_null(f);
        text[fread(text, 1, sizeof text - 1, f)] = 0;
        fclose(f);
        close(fd);
        unlink(out);
        rg_pattern_destroy(p);
        assert_true(text[0]);
        for (const char *c = text; *c; c++)
            if (iscntrl((unsigned char)*c) && *c != '\n') fail_msg("%s: a control character in \"%s\"", path, text);
        assert_null(strstr(text, "\xC2\x9B"));
    }
}

/* The parser compares each with all others, and a hundred thousand took it ten seconds. UTF-16 without a mark is no other text. */
static void what_the_parser_is_slow_at(void **state)
{
    (void)state;
    is_refused_at("attributes.svg", 2, "more than 1000 attributes");
    is_refused("wide.svg", "UTF-16");
}

/* Frames in which the sheet is a point were drawn with a row of points without an end; such as are larger than any sheet took
 * all memory, or left numbers that are none. */
static void frames_have_a_size(void **state)
{
    (void)state;
    static const struct { const char *name, *words; } tries[] = {
        {"one-point.fold", NULL}, {"large-frame.fold", "1e+12 times as large"}, {"largest-frame.fold", "too large to compute with"}};
    for (int k = 0; k < 3; k++) {
        char path[80], folder[] = "/tmp/rigami-bad-XXXXXX", out[60];
        const rg_reading r = rg_reading_default();
        rg_motion *m = NULL;
        rg_diag why = {0, ""};
        snprintf(path, sizeof path, "%s/%s", FOLDER, tries[k].name);
        const rg_status s = rg_motion_read(path, &r, &m, &why);
        if (tries[k].words) {
            assert_int_equal(s, RG_EFORMAT);
            if (!strstr(why.text, tries[k].words)) fail_msg("%s: %s", path, why.text);
            assert_true(why.line > 1);
            one_line(&why, path);
            continue;
        }
        assert_int_equal(s, RG_OK);
        assert_non_null(mkdtemp(folder));
        snprintf(out, sizeof out, "%s/x.html", folder);
        assert_int_equal(rg_motion_write(m, out, NULL, &why), RG_OK);
        unlink(out);
        rmdir(folder);
        rg_motion_destroy(m);
    }
}

/* What folds is what the judge, who knows the file only, finds valid; frames go one way. */
static void what_folds_is_valid(void **state)
{
    (void)state;
    static const struct { const char *name; double to, adjust; rg_effort effort; int symmetry; } fold[] = {
        {"open-angles.fold", 1, RG_ADJUST_AUTO, RG_EFFORT_NORMAL, RG_SYMMETRY_AUTO},
        {"open-angles.fold", -1, RG_ADJUST_AUTO, RG_EFFORT_FAST, RG_SYMMETRY_AUTO},
        {"flat-valley.fold", 1, RG_ADJUST_AUTO, RG_EFFORT_FAST, RG_SYMMETRY_AUTO},
        {"flat-valley.fold", 0.5, RG_ADJUST_AUTO, RG_EFFORT_FAST, RG_SYMMETRY_AUTO},
        {"corner-on-diagonal.fold", 1, RG_ADJUST_AUTO, RG_EFFORT_NORMAL, RG_SYMMETRY_AUTO},
        {"folded-added.fold", 1, RG_ADJUST_AUTO, RG_EFFORT_NORMAL, RG_SYMMETRY_AUTO},
        {"goes-back.fold", 0.01, RG_ADJUST_AUTO, RG_EFFORT_NORMAL, RG_SYMMETRY_OFF},
        {"beyond-its-own.fold", 0.4, 0, RG_EFFORT_NORMAL, RG_SYMMETRY_AUTO},
    };
    char path[40];
    snprintf(path, sizeof path, "/tmp/rigami-bad-%ld.fold", (long)getpid());
    for (size_t k = 0; k < sizeof fold / sizeof *fold; k++) {
        char name[200];
        snprintf(name, sizeof name, "%s/%s", FOLDER, fold[k].name);
        rg_diag why = {0, ""};
        rg_pattern *p = NULL;
        rg_motion *m = NULL;
        rg_certificate *c = NULL;
        rg_settings s = rg_settings_default();
        s.frames = 12;
        s.threads = 1;
        s.to = fold[k].to;
        s.adjust = fold[k].adjust;
        s.effort = fold[k].effort;
        s.symmetry = fold[k].symmetry;
        assert_int_equal(rg_pattern_read(name, NULL, &p, &why), RG_OK);
        assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, &why), RG_OK);
        const rg_report *r = rg_motion_report(m);
        if (r->outcome != RG_FOLDED || r->contact != RG_CONTACT_FREE) fail_msg("%s: %s", name, r->reason);
        near(r->folded_percent, 100 * fabs(s.to), 1);
        for (int32_t i = 1; i < r->frame_count; i++) assert_true(r->frames[i].percent >= r->frames[i - 1].percent - 1e-6);
        assert_int_equal(rg_motion_write(m, path, NULL, &why), RG_OK);
        assert_int_equal(rg_certificate_create(path, p, NULL, &c, &why), RG_OK);
        const rg_fault *fault;
        if (rg_certificate_faults(c, &fault) > 0) fail_msg("%s: %s", name, fault->text);
        rg_certificate_destroy(c);
        rg_motion_destroy(m);
        rg_pattern_destroy(p);
    }
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(read_or_refused),
        cmocka_unit_test(what_a_file_says_is_one_line),
        cmocka_unit_test(numbers_of_vertices_are_within),
        cmocka_unit_test(a_number_is_no_pattern),
        cmocka_unit_test(lines_without_length_are_no_pattern),
        cmocka_unit_test(coordinates_have_one_limit),
        cmocka_unit_test(selectors_are_within),
        cmocka_unit_test(a_sheet_without_creases_folds),
        cmocka_unit_test(nothing_is_made_up),
        cmocka_unit_test(places_are_where_they_are),
        cmocka_unit_test(entities_are_opened_or_refused),
        cmocka_unit_test(numbers_of_drawings_are_whole),
        cmocka_unit_test(lines_have_the_colour_of_what_they_are_in),
        cmocka_unit_test(what_is_shown_moves_no_cursor),
        cmocka_unit_test(frames_have_a_size),
        cmocka_unit_test(what_the_parser_is_slow_at),
        cmocka_unit_test(what_folds_is_valid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
