/* read/dxf.c: entities, layers before colours, blocks, and what is refused. */
#include "reading.h"

#define DXF(entities) "999\ncomment\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n2\n0\nLAYER\n2\nred one\n70\n0\n62\n1\n0\nLAYER\n2\nhidden\n62\n-5\n" \
    "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" entities "0\nENDSEC\n0\nEOF\n"
#define LINE(layer, colour) "0\nLINE\n8\n" layer "\n" colour "10\n1.5\n20\n2\n30\n0.0\n11\n3\n21\n4E0\n31\n0.0\n"

static void entities(void **state)
{
    (void)state;
    rg_lines l = read_ok(DXF(LINE("0", "62\n1\n")
                             "0\nLWPOLYLINE\n8\nx\n62\n5\n90\n3\n70\n1\n10\n0\n20\n0\n42\n0.0\n10\n5\n20\n0\n10\n5\n20\n6\n"
                             "0\nTEXT\n10\n1\n1\nnothing\n"
                             "0\nPOLYLINE\n8\nx\n62\n3\n66\n1\n70\n0\n10\n0.0\n20\n0.0\n0\nVERTEX\n10\n1\n20\n1\n0\nVERTEX\n10\n2\n20\n1\n"
                             "0\nVERTEX\n10\n3\n20\n2.5\n0\nSEQEND\n" LINE("0", "")), RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 7);
    is_line(&l, 0, 'M', 1.5, 2, 3, 4, NAN); /* y points up */
    is_line(&l, 1, 'V', 0, 0, 5, 0, NAN);
    is_line(&l, 2, 'V', 5, 0, 5, 6, NAN);
    is_line(&l, 3, 'V', 5, 6, 0, 0, NAN);
    is_line(&l, 4, 'B', 1, 1, 2, 1, NAN);
    is_line(&l, 5, 'B', 2, 1, 3, 2.5, NAN);
    is_line(&l, 6, 'B', 1.5, 2, 3, 4, NAN);
    assert_int_equal(l.line[0].where, 36);
    rg_lines_free(&l);
}

static void layers_and_colours(void **state)
{
    (void)state;
    const struct { const char *entity; char letter; } c[] = {
        {LINE("MountainLine", "62\n5\n"), 'M'}, {LINE("ValleyLine", "62\n1\n"), 'V'}, {LINE("CutLine", "62\n1\n"), 'B'},
        {LINE("my valleys", ""), 'V'}, {LINE("AUX", "62\n1\n"), 'F'}, {LINE("noname", "62\n0\n"), 'F'}, {LINE("noname", "62\n4\n"), 'F'},
        {LINE("0", "62\n250\n"), 'B'}, {LINE("0", "62\n3\n"), 'B'}, {LINE("0", "62\n30\n"), 'M'}, {LINE("0", "62\n170\n"), 'V'},
        {LINE("0", "62\n2\n"), 'V'}, {LINE("red one", ""), 'M'}, {LINE("red one", "62\n256\n"), 'M'},
        {LINE("0", "62\n7\n420\n255\n"), 'V'}, {LINE("0", "420\n16711680\n"), 'M'}};
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char text[600];
        snprintf(text, sizeof text, DXF("%s"), c[i].entity);
        rg_lines l = read_ok(text, RG_FORMAT_DXF, NULL);
        if (l.line[0].assignment != c[i].letter) print_error("%s\n", c[i].entity);
        is_line(&l, 0, c[i].letter, 1.5, 2, 3, 4, NAN);
        rg_lines_free(&l);
    }
}

static void ends_of_lines_and_blanks(void **state)
{
    (void)state;
    rg_lines l = read_ok("  0\r\nSECTION\r\n  2\r\nENTITIES\r\n  0\r\nLINE\r\n 62\r\n     1\r\n 10\r\n  1.5\r\n 20\r\n2\r\n 11\r\n3\r\n 21\r\n4\r\n"
                         "  0\r\nENDSEC\r\n  0\r\nEOF", RG_FORMAT_DXF, NULL);
    is_line(&l, 0, 'M', 1.5, 2, 3, 4, NAN);
    rg_lines_free(&l);
    rg_reading s = rg_reading_default();
    s.flip = 1;
    l = read_ok(DXF(LINE("0", "62\n1\n")), RG_FORMAT_AUTO, &s);
    is_line(&l, 0, 'M', 1.5, -2, 3, -4, NAN);
    rg_lines_free(&l);
    /* Drawn on the back of its plane: x runs the other way, except in a LINE. That is said behind the corners. */
    l = read_ok(DXF("0\nLWPOLYLINE\n10\n1\n20\n2\n10\n3\n20\n4\n10\n5\n20\n4\n210\n0\n220\n0\n230\n-1\n62\n1\n"), RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 2);
    is_line(&l, 0, 'M', -1, 2, -3, 4, NAN);
    is_line(&l, 1, 'M', -3, 4, -5, 4, NAN);
    rg_lines_free(&l);
}

#define BLOCKS(blocks, entities) "0\nSECTION\n2\nBLOCKS\n" blocks "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" entities "0\nENDSEC\n0\nEOF\n"
#define BLOCK(name, base, entities) "0\nBLOCK\n8\n0\n2\n" name "\n70\n0\n" base "3\n" name "\n" entities "0\nENDBLK\n8\n0\n"
#define INSERT(name, more) "0\nINSERT\n2\n" name "\n" more
#define FROM_1_2_TO_3_2(paint) "0\nLINE\n" paint "10\n1\n20\n2\n11\n3\n21\n2\n"

/* A block goes where its INSERT says: base point, scale, rotation, rows and columns, block in block; and is painted so. */
static void blocks(void **state)
{
    (void)state;
    rg_lines l = read_ok(BLOCKS(BLOCK("unit", "10\n1\n20\n1\n", FROM_1_2_TO_3_2("8\n0\n62\n0\n") FROM_1_2_TO_3_2("8\nvalley\n62\n1\n"))
                                BLOCK("two", "", INSERT("UNIT", "8\n0\n62\n0\n10\n100\n20\n0\n50\n90\n")
                                                 "0\nLWPOLYLINE\n62\n5\n10\n0\n20\n0\n10\n7\n20\n0\n"),
                                INSERT("unit", "8\n0\n62\n1\n10\n10\n20\n20\n41\n2\n42\n-3\n")
                                INSERT("two", "8\nborder\n10\n5\n20\n0\n50\n180\n")
                                INSERT("unit", "8\n0\n62\n5\n10\n0\n20\n0\n50\n90\n70\n2\n71\n2\n44\n10\n45\n100\n41\n2\n")
                                INSERT("unit", "8\n0\n62\n1\n10\n10\n20\n0\n230\n-1\n")), RG_FORMAT_DXF, NULL);
    const struct { char letter; double ax, ay, bx, by; } want[] = {
        {'M', 10, 17, 14, 17}, {'V', 10, 17, 14, 17},                       /* 2 (x - 1) + 10, -3 (y - 1) + 20 */
        {'B', -94, 0, -94, -2}, {'V', -94, 0, -94, -2}, {'V', 5, 0, -2, 0}, /* 100 - (y - 1), x - 1; then half a turn about 2.5 */
        {'V', -1, 0, -1, 4}, {'V', -1, 0, -1, 4}, {'V', -1, 10, -1, 14}, {'V', -1, 10, -1, 14},
        {'V', -101, 0, -101, 4}, {'V', -101, 0, -101, 4}, {'V', -101, 10, -101, 14}, {'V', -101, 10, -101, 14},
        {'M', -10, 1, -12, 1}, {'V', -10, 1, -12, 1}};
    assert_int_equal(l.count, sizeof want / sizeof *want);
    assert_int_equal(l.warnings, 0);
    for (int32_t i = 0; i < l.count; i++) is_line(&l, i, want[i].letter, want[i].ax, want[i].ay, want[i].bx, want[i].by, NAN);
    rg_lines_free(&l);
    l = read_ok(BLOCKS("", INSERT("unit", "") LINE("0", "62\n1\n") LINE("0", "67\n1\n")), RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 1);
    assert_true(warned(&l, "no block \"unit\"") && warned(&l, "layout"));
    assert_int_equal(l.warning[0].line, 12);
    rg_lines_free(&l);
    /* An array of no rows is one; what cannot be computed with is left out. */
    l = read_ok(BLOCKS(BLOCK("b", "", FROM_1_2_TO_3_2("")), INSERT("b", "70\n0\n71\n-1\n") INSERT("b", "41\n1e308\n")), RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 1);
    assert_true(warned(&l, "finite"));
    rg_lines_free(&l);
}

/* Without end, or without end for all purposes. */
static void blocks_that_do_not_end(void **state)
{
    (void)state;
    refused(BLOCKS(BLOCK("a", "", INSERT("b", "")) BLOCK("b", "", INSERT("A", "")), INSERT("a", "")), RG_FORMAT_DXF, NULL, 34,
            "\"A\" repeats itself");
    refused(BLOCKS(BLOCK("a", "", ""), INSERT("a", "70\n1000000000\n71\n1000000000\n")), RG_FORMAT_DXF, NULL, 26, "too large");
    refused(BLOCKS(BLOCK("a", "", "0\nARC\n"), INSERT("a", "")), RG_FORMAT_DXF, NULL, 16, "curve");
    char text[20000];
    for (int copies = 1; copies <= 2; copies++) {
        size_t n = (size_t)sprintf(text, "0\nSECTION\n2\nBLOCKS\n" BLOCK("b0", "", FROM_1_2_TO_3_2("")));
        for (int i = 1; i <= 100; i++) {
            n += (size_t)sprintf(text + n, "0\nBLOCK\n2\nb%d\n", i);
            for (int k = 0; k < copies; k++) n += (size_t)sprintf(text + n, INSERT("b%d", ""), i - 1);
            n += (size_t)sprintf(text + n, "0\nENDBLK\n");
        }
        sprintf(text + n, "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nb%d\n0\nENDSEC\n0\nEOF\n", copies == 1 ? 100 : 50);
        refused(text, RG_FORMAT_DXF, NULL, -1, copies == 1 ? "nested too deep" : "too large with all that it repeats");
    }
}

/* Nor is a line drawn ninety thousand times whose layer has a name of a hundred thousand letters. */
static void repeats_of_what_is_long(void **state)
{
    (void)state;
    enum { ROOM = 120000, LETTERS = 100000 };
    char *text = malloc(ROOM), *name = malloc(LETTERS + 1);
    assert_true(text && name);
    memset(name, 'x', LETTERS);
    name[LETTERS] = 0;
    snprintf(text, ROOM, "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n0\nLINE\n8\n%s\n10\n0\n20\n0\n11\n1\n21\n0\n0\nENDBLK\n0\nENDSEC\n"
             "0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nb\n70\n300\n71\n300\n44\n1\n45\n1\n0\nENDSEC\n0\nEOF\n", name);
    refused(text, RG_FORMAT_DXF, NULL, -1, "too large with all that it repeats");
    free(text);
    free(name);
}

#define LAYERS(entities) "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\noff\n70\n0\n62\n-3\n0\nLAYER\n2\ncold\n70\n1\n62\n3\n" \
    "0\nLAYER\n2\ndashes\n70\n0\n62\n7\n6\nDASHED\n0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n" \
    BLOCK("b", "", LINE("0", "") LINE("seen", "")) "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" entities "0\nENDSEC\n0\nEOF\n"

/* Programs draw without what is hidden, and so do we: it is told, once a layer, with how much there is. */
static void hidden_layers(void **state)
{
    (void)state;
    rg_lines l = read_ok(LAYERS(LINE("seen", "") LINE("off", "") LINE("off", "") LINE("cold", "") LINE("seen", "60\n1\n")), RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 1);
    assert_true(warned(&l, "\"off\" is switched off: what is on it is left out (2)") && warned(&l, "\"cold\" is frozen") && warned(&l, "invisible: 1"));
    assert_int_equal(l.warnings, 3);
    rg_lines_free(&l);
    /* What is off hides of a block what has no layer of its own, what is frozen all of it. */
    l = read_ok(LAYERS(INSERT("b", "8\noff\n") INSERT("b", "8\ncold\n")), RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 1);
    rg_lines_free(&l);
    refused(LAYERS(LINE("off", "")), RG_FORMAT_DXF, NULL, -1, "switched off or frozen, this one is on \"off\"");
}

/* One plane of space, wherever it is; else the line that leaves it is named. */
static void planes_of_space(void **state)
{
    (void)state;
    rg_lines l = read_ok(DXF("0\nLINE\n62\n1\n10\n1\n20\n2\n30\n7.5\n11\n3\n21\n5\n31\n7.5\n"), RG_FORMAT_DXF, NULL);
    is_line(&l, 0, 'M', 1, 2, 3, 5, NAN);
    rg_lines_free(&l);
    const char *upright = "0\nLWPOLYLINE\n62\n1\n38\n4\n210\n0\n220\n1\n230\n0\n10\n1\n20\n2\n10\n5\n20\n2\n10\n5\n20\n8\n";
    char text[900];
    snprintf(text, sizeof text, DXF("%s"), upright);
    l = read_ok(text, RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 2);
    near(rg_vec2_length(rg_vec2_sub(l.line[0].b, l.line[0].a)), 4, 1e-12);
    near(rg_vec2_length(rg_vec2_sub(l.line[1].b, l.line[1].a)), 6, 1e-12);
    near(rg_vec2_dot(rg_vec2_sub(l.line[0].b, l.line[0].a), rg_vec2_sub(l.line[1].b, l.line[1].a)), 0, 1e-12);
    rg_lines_free(&l);
    refused(DXF("0\nLWPOLYLINE\n62\n1\n10\n0\n20\n0\n10\n8\n20\n0\n10\n8\n20\n6\n0\nLINE\n62\n1\n10\n0\n20\n0\n30\n0\n11\n8\n21\n6\n31\n3\n"),
            RG_FORMAT_DXF, NULL, 52, "z = 3");
}

/* Facets, of which the sides between two are creases; what is no line is told, by its kind. */
static void facets_and_what_is_left_out(void **state)
{
    (void)state;
#define CORNER(x, y) "0\nVERTEX\n70\n192\n10\n" x "\n20\n" y "\n"
#define FACET(a, b, c) "0\nVERTEX\n70\n128\n71\n" a "\n72\n" b "\n73\n" c "\n"
    rg_lines l = read_ok(DXF("0\nPOLYLINE\n70\n64\n" CORNER("0", "0") CORNER("6", "0") CORNER("6", "4") CORNER("0", "4")
                             FACET("1", "2", "3") FACET("1", "-3", "4") "0\nSEQEND\n"
                             "0\nPOLYLINE\n8\nvalley\n70\n16\n71\n2\n72\n3\n" CORNER("0", "9") CORNER("1", "9") CORNER("2", "9") CORNER("0", "8")
                             CORNER("1", "8") CORNER("2", "8") "0\nSEQEND\n"
                             "0\n3DFACE\n8\nmountain\n70\n2\n10\n0\n20\n0\n11\n1\n21\n0\n12\n1\n22\n1\n13\n1\n23\n1\n"
                             "0\nXLINE\n10\n1\n20\n1\n11\n1\n21\n0\n0\nMLINE\n2\nX\n0\nXLINE\n10\n1\n"), RG_FORMAT_DXF, NULL);
    int count[128] = {0};
    for (int32_t i = 0; i < l.count; i++) count[(int)l.line[i].assignment]++;
    assert_int_equal(count['B'], 3); /* of the two triangles, one side of which is not drawn */
    assert_int_equal(count['U'], 2); /* their common side, twice */
    assert_int_equal(count['V'], 7);
    assert_int_equal(count['M'], 2); /* one of the three is not drawn */
    assert_true(warned(&l, "XLINE is not read: 2 left out") && warned(&l, "MLINE is not read: 1 left out"));
    rg_lines_free(&l);
    refused(DXF("0\nPOLYLINE\n70\n64\n" CORNER("0", "0") FACET("1", "2", "3") "0\nSEQEND\n"), RG_FORMAT_DXF, NULL, -1, "a facet of vertex");
    refused(DXF("0\nHATCH\n2\nANSI31\n"), RG_FORMAT_DXF, NULL, 36, "HATCH, which is not read");
}

/* Curves of what cannot fold do no harm; circles are marks, but for a border. */
static void curves_that_do_no_harm(void **state)
{
    (void)state;
    rg_lines l = read_ok(DXF(LINE("0", "62\n1\n") "0\nARC\n8\naux\n10\n1\n40\n2\n0\nCIRCLE\n62\n1\n10\n3\n0\nSPLINE\n62\n8\n"
                             "0\nLWPOLYLINE\n8\naux\n10\n0\n20\n0\n42\n0.5\n10\n1\n20\n1\n10\n2\n20\n5\n"), RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, 2);
    is_line(&l, 1, 'F', 1, 1, 2, 5, NAN);
    assert_true(warned(&l, "left out: 4"));
    rg_lines_free(&l);
}

static void kinds(void **state)
{
    (void)state;
    const char *const said[] = {"dashes=valley", "colour:red=none", "#0000ff=aux", "dash:DashDot=mountain"};
    rg_reading s = rg_reading_default();
    s.kind = said;
    s.kinds = 4;
    rg_lines l = read_ok(LAYERS(LINE("dashes", "") LINE("0", "62\n1\n") LINE("0", "420\n255\n") LINE("dashes", "6\nDASHDOT\n") LINE("0", "")),
                         RG_FORMAT_DXF, &s);
    assert_int_equal(l.count, 4);
    const char want[] = "VFMB";
    for (int i = 0; i < 4; i++) assert_int_equal(l.line[i].assignment, want[i]);
    assert_true(warned(&l, "left out as --line asks: 1"));
    int found = 0;
    for (int32_t i = 0; i < l.traits; i++)
        found += l.trait[i].sort == RG_BY_DASH && strcmp(l.trait[i].name, "DASHED") == 0 && l.trait[i].count == 1;
    assert_int_equal(found, 1);
    rg_lines_free(&l);
    const char *const other[] = {"0=", "DASHED=fold"};
    rg_diag why;
    for (int i = 0; i < 2; i++) {
        s.kind = &other[i];
        s.kinds = 1;
        assert_int_equal(read_text("0\nEOF\n", 6, RG_FORMAT_DXF, &s, &l, &why), RG_EARG);
        assert_non_null(strstr(why.text, "KEY=KIND"));
    }
    const char *const none[] = {"green=valley"};
    s.kind = none;
    l = read_ok(LAYERS(LINE("dashes", "")), RG_FORMAT_DXF, &s);
    assert_true(warned(&l, "--line green=valley: no line") && warned(&l, "DASHED"));
    rg_lines_free(&l);
}

static void units(void **state)
{
    (void)state;
    rg_lines l = read_ok("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
                         LINE("0", "") "0\nENDSEC\n0\nEOF\n", RG_FORMAT_DXF, NULL);
    near(l.metres, 0.001, 0);
    rg_lines_free(&l);
}

static void refusals(void **state)
{
    (void)state;
    const char *const curves[] = {"ARC", "CIRCLE", "ELLIPSE", "SPLINE"};
    for (int i = 0; i < 4; i++) {
        char text[400];
        snprintf(text, sizeof text, DXF("0\n%s\n10\n1\n"), curves[i]);
        refused(text, RG_FORMAT_DXF, NULL, 36, curves[i]);
    }
    refused(DXF("0\nLWPOLYLINE\n10\n0\n20\n0\n42\n0.5\n10\n1\n20\n1\n"), RG_FORMAT_DXF, NULL, 42, "bulge");
    refused(DXF("0\nPOLYLINE\n70\n4\n"), RG_FORMAT_DXF, NULL, 36, "POLYLINE");
    refused(DXF("0\nLINE\n10\n1,5\n"), RG_FORMAT_DXF, NULL, 38, "\"1,5\"");
    refused(DXF("0\nLINE\n10\nNaN\n"), RG_FORMAT_DXF, NULL, 38, "NaN");
    refused(DXF("0\nLINE\n62\nred\n"), RG_FORMAT_DXF, NULL, 38, "red");
    refused(DXF("0\nLINE\nten\n1\n"), RG_FORMAT_DXF, NULL, 37, "ten");
    refused(DXF("0\nPOINT\n10\n1\n"), RG_FORMAT_DXF, NULL, -1, "no LINE");
    refused("0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n", RG_FORMAT_DXF, NULL, -1, "ENTITIES");
    const char *whole = DXF(LINE("0", "62\n1\n"));
    for (size_t n = 1; n + 2 < strlen(whole); n++) {
        rg_lines l;
        rg_diag why;
        assert_int_equal(read_text(whole, n, RG_FORMAT_DXF, NULL, &l, &why), RG_EFORMAT);
        assert_true(why.line > 0);
    }
}

/* Layers beyond some thousand were not known, and each line looked through all of them, several times. */
static void many_layers(void **state)
{
    (void)state;
    enum { LAYERS = 20000, LINES = 20000 };
    char *text = malloc(LAYERS * 40 + LINES * 50 + 500), *at = text;
    assert_non_null(text);
    at = stpcpy(at, "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n");
    for (int i = 0; i < LAYERS; i++) at += sprintf(at, "0\nLAYER\n2\nlayer %d\n62\n%d\n", i, i % 2 ? 5 : 1);
    at = stpcpy(at, "0\nLAYER\n2\nlayer 7\n62\n1\n"); /* the later one of two counts */
    at = stpcpy(at, "0\nLAYER\n2\nLayer 8\n62\n5\n"); /* and this is another one */
    at = stpcpy(at, "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    for (int i = 0; i < LINES; i++) at += sprintf(at, "0\nLINE\n8\n%s %d\n11\n1\n21\n1\n", i < 10 ? "layer" : "LAYER", i);
    at = stpcpy(at, "0\nENDSEC\n0\nEOF\n");
    rg_lines l = read_ok(text, RG_FORMAT_DXF, NULL);
    assert_int_equal(l.count, LINES);
    for (int32_t i = 0; i < LINES; i++) assert_int_equal(l.line[i].assignment, i % 2 && i != 7 ? 'V' : 'M');
    rg_lines_free(&l);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(entities), cmocka_unit_test(layers_and_colours),
                                       cmocka_unit_test(ends_of_lines_and_blanks), cmocka_unit_test(refusals),
                                       cmocka_unit_test(blocks), cmocka_unit_test(blocks_that_do_not_end), cmocka_unit_test(repeats_of_what_is_long),
                                       cmocka_unit_test(hidden_layers), cmocka_unit_test(planes_of_space),
                                       cmocka_unit_test(facets_and_what_is_left_out), cmocka_unit_test(curves_that_do_no_harm),
                                       cmocka_unit_test(many_layers), cmocka_unit_test(kinds), cmocka_unit_test(units)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
