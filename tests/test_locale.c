/* A host's language, and the user's: with a decimal comma every number is read and written as without, in every format, by the library in a
 * host that called setlocale(), and by the program in such an environment. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "comma.h"
#include "folder.h"
#include "near.h"

#include "rigami.h"

#include <stdlib.h>
#include <sys/wait.h>

static char folder[] = "/tmp/rigami-locale-XXXXXX";
static const char *locale; /* NULL: there is none */

typedef struct pot { char *bytes; size_t n; } pot;

static int pour(void *ctx, const void *bytes, size_t n)
{
    pot *p = ctx;
    p->bytes = realloc(p->bytes, p->n + n + 1);
    assert_non_null(p->bytes);
    memcpy(p->bytes + p->n, bytes, n);
    p->bytes[p->n += n] = 0;
    return 0;
}

static void empty(pot *p)
{
    free(p->bytes);
    *p = (pot){NULL, 0};
}

static int same(const pot *p, const pot *q) { return p->n == q->n && p->n > 0 && memcmp(p->bytes, q->bytes, p->n) == 0; }

/* ----------------------------------------------------------------------------------------------------- library ---- */

static const char *const MOTIONS[] = {".fold", ".csv", ".svg", ".dxf", ".obj", ".stl", ".glb", ".gltf", ".html"};
enum { FORMATS = RG_FORMAT_DXF, FORMS = sizeof MOTIONS / sizeof *MOTIONS, ALL = FORMATS + FORMS + 1 };

/* Everything that numbers go through: a pattern with coordinates that are no whole numbers to every format, read back from each; what is told
 * of it; folded, in steps that are none, and written in every form. */
static void make_all(pot made[ALL])
{
    rg_pattern *cp = NULL;
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    pot *at = made;
    pot source = {NULL, 0};
    FILE *f = fopen("patterns/crane.opx", "rb");
    assert_non_null(f);
    for (char text[4096]; !feof(f);) pour(&source, text, fread(text, 1, sizeof text, f));
    fclose(f);
    for (rg_format to = RG_FORMAT_OPX; to <= RG_FORMAT_DXF; to++, at++) {
        const rg_sink sink = {pour, at};
        assert_int_equal(rg_convert_to(source.bytes, source.n, to, &sink, NULL, NULL, NULL, &why), RG_OK);
        assert_int_equal(rg_pattern_parse(at->bytes, at->n, NULL, &cp, &why), RG_OK);
        near(rg_pattern_get_info(cp)->size, 400, 1e-9);
        rg_pattern_destroy(cp);
        cp = NULL;
    }
    empty(&source);
    assert_int_equal(rg_generate_pattern("miura", 3, 3, 61.5 * acos(-1) / 180, NULL, &cp, &why), RG_OK);
    rg_settings s = rg_settings_default();
    s.frames = 3;
    s.step = 2.5 * acos(-1) / 180;
    assert_int_equal(rg_motion_create(cp, &s, NULL, NULL, &m, &why), RG_OK);
    for (int k = 0; k < FORMS; k++, at++) assert_int_equal(rg_motion_write_to(m, MOTIONS[k], -1, &(rg_sink){pour, at}, NULL, &why), RG_OK);
    rg_motion_destroy(m);
    assert_int_equal(rg_info_text_to(cp, 1, &(rg_sink){pour, at++}, &why), RG_OK);
    assert_ptr_equal(at, made + ALL);
    rg_pattern_destroy(cp);
}

static void what_the_library_writes(void **state)
{
    (void)state;
    if (!locale) skip();
    pot plain[ALL] = {{NULL, 0}}, comma[ALL] = {{NULL, 0}};
    assert_string_equal(setlocale(LC_ALL, "C"), "C");
    make_all(plain);
    assert_non_null(setlocale(LC_ALL, locale));
    char text[20];
    snprintf(text, sizeof text, "%.1f", 0.5);
    assert_string_equal(text, "0,5"); /* it is in force */
    make_all(comma);
    snprintf(text, sizeof text, "%.1f", 0.5);
    assert_string_equal(text, "0,5"); /* and is still so: the host's, and nothing was done to it */
    for (int k = 0; k < ALL; k++) {
        if (!same(&plain[k], &comma[k])) fail_msg("output %d of %d is not the same", k, ALL);
        empty(&plain[k]), empty(&comma[k]);
    }
    setlocale(LC_ALL, "C");
}

/* ----------------------------------------------------------------------------------------------------- program ---- */

/* What commands print in that language, with the program in $R and a folder in $D. */
static pot run(const char *language, const char *commands)
{
    const char *program = getenv("RIGAMI");
    char command[600];
    pot p = {NULL, 0};
    snprintf(command, sizeof command, "LC_ALL=%s R='%s' D=%s; export LC_ALL; { %s; } 2>&1", language, program && *program ? program : "./rigami",
             folder, commands);
    FILE *f = popen(command, "r");
    assert_non_null(f);
    for (char text[4096]; !feof(f);) pour(&p, text, fread(text, 1, sizeof text, f));
    const int status = pclose(f);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail_msg("%s: %s", command, p.bytes ? p.bytes : "");
    return p;
}

static void what_the_program_writes(void **state)
{
    (void)state;
    if (!locale) skip();
    static const char *const commands[] = {
        "$R info patterns/crane.opx",
        "$R gen miura 3 --angle 61.5 -q -o $D/a.fold && cat $D/a.fold",
        "$R convert patterns/crane.opx -q -o $D/a.svg && $R convert $D/a.svg --merge 1.5e-3 -q -o $D/a.dxf && cat $D/a.svg $D/a.dxf",
        "$R fold patterns/bird.opx --step 2.5 --to 62.5 --frames 3 -q -o $D/a.csv -o $D/b.fold >$D/r; s=$?; cat $D/r $D/a.csv $D/b.fold; test $s -lt 2"};
    for (size_t k = 0; k < sizeof commands / sizeof *commands; k++) {
        pot plain = run("C", commands[k]), comma = run(locale, commands[k]);
        if (!same(&plain, &comma)) fail_msg("%s: not the same", commands[k]);
        empty(&plain), empty(&comma);
    }
}

/* --------------------------------------------------------------------------------------------------------- all ---- */

static int begin_all(void **state)
{
    (void)state;
    if (!mkdtemp(folder)) return -1;
    locale = comma_set(folder);
    setlocale(LC_ALL, "C");
    if (!locale) print_message("SKIPPED: no locale with a decimal comma on this machine\n");
    return 0;
}

static int end_all(void **state)
{
    (void)state;
    char here[4096];
    if (!getcwd(here, sizeof here) || folder_remove(folder) != 0) return -1;
    return chdir(here);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_the_library_writes), cmocka_unit_test(what_the_program_writes)};
    return cmocka_run_group_tests(tests, begin_all, end_all);
}
