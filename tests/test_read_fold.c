/* read/fold.c: versions, letters, angles, frames, planes, sides; what is missing is completed, what is wrong has its place. */
#include "reading.h"

#define SQUARE "\"vertices_coords\":[[0,0],[4,0],[4,4],[0,4]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]]"
#define FACES ",\"faces_vertices\":[[0,1,2],[0,2,3]]"
#define CLOCKWISE ",\"faces_vertices\":[[2,1,0],[3,2,0]]"

static rg_lines read_fold(const char *text) { return read_ok(text, RG_FORMAT_FOLD, NULL); }

static void letters(const char *text, const char *want)
{
    rg_lines l = read_fold(text);
    assert_int_equal(l.count, strlen(want));
    for (int32_t i = 0; i < l.count; i++) assert_int_equal(l.line[i].assignment, want[i]);
    rg_lines_free(&l);
}

/* The target of the last edge, degrees. */
static void last_target(const char *text, const rg_reading *s, double want)
{
    rg_lines l = read_ok(text, RG_FORMAT_FOLD, s);
    const double target = l.line[l.count - 1].target;
    if (isnan(want)) assert_true(isnan(target));
    else near(target / RG_DEG, want, 1e-12);
    rg_lines_free(&l);
}

static void letters_of_all_kinds(void **state)
{
    (void)state;
    letters("{" SQUARE FACES ",\"edges_assignment\":[\"B\",\"b\",\"B\",\"B\",\"M\"]}", "BBBBM");
    letters("{" SQUARE ",\"edges_assignment\":[\"v\",\"m\",\"f\",\"u\",null]}", "VMFUU");
    letters("{" SQUARE ",\"edges_assignment\":[\"J\",\"j\",\"C\",\"c\",\"U\"]}", "FFBBU");
    rg_lines l = read_fold("{" SQUARE FACES ",\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\"],\"file_title\":\"t\",\"file_author\":\"a\",\"frame_title\":\"no\"}");
    is_line(&l, 0, 'B', 0, 0, 4, 0, NAN); /* y points up */
    is_line(&l, 4, 'M', 0, 0, 4, 4, NAN);
    assert_string_equal(l.title, "t");
    assert_string_equal(l.author, "a");
    assert_int_equal(l.warnings, 0);
    rg_lines_free(&l);
}

static void what_is_missing(void **state)
{
    (void)state;
    letters("{" SQUARE "}", "UUUUU");
    letters("{" SQUARE FACES "}", "BBBBU");
    letters("{" SQUARE ",\"edges_foldAngle\":[0,0,null,0,-30]}", "UUUUM"); /* 0 may be the border, or nothing */
    letters("{" SQUARE FACES ",\"edges_foldAngle\":[0,0,0,0,90]}", "BBBBV");
    letters("{" SQUARE FACES ",\"edges_foldAngle\":[0,0,0,0,0]}", "BBBBF");
    /* Edges from faces, in the order of their vertices. */
    rg_lines l = read_fold("{\"vertices_coords\":[[0,0],[4,0],[4,4],[0,4]]" FACES "}");
    assert_int_equal(l.count, 5);
    is_line(&l, 0, 'B', 0, 0, 4, 0, NAN);
    is_line(&l, 1, 'U', 0, 0, 4, 4, NAN);
    is_line(&l, 4, 'B', 4, 4, 0, 4, NAN);
    rg_lines_free(&l);
    letters("{\"vertices_coords\":[[0,0],[4,0],[4,4],[0,4]],\"edges_vertices\":[]" FACES "}", "BUBBB");
    refused("{\"vertices_coords\":[[0,0],[4,0]]}", RG_FORMAT_FOLD, NULL, 1, "edges_vertices");
    refused("{\"edges_vertices\":[[0,1]]}", RG_FORMAT_FOLD, NULL, 1, "vertices_coords");
}

#define ONE(letter, angle) "{" SQUARE ",\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\"," letter "],\"edges_foldAngle\":[0,0,0,0," angle "]}"

static void angles(void **state)
{
    (void)state;
    rg_reading s = rg_reading_default();
    last_target(ONE("\"V\"", "180"), NULL, NAN); /* the assignment says that already */
    last_target(ONE("\"M\"", "-180"), NULL, NAN);
    last_target(ONE("\"M\"", "-30.5"), NULL, -30.5);
    last_target(ONE("\"V\"", "180.00000001"), NULL, NAN); /* rounding of single precision */
    last_target(ONE("\"U\"", "0"), NULL, NAN);            /* no wish */
    last_target(ONE("\"U\"", "45"), NULL, 45);
    last_target(ONE("\"F\"", "45"), NULL, NAN);
    last_target(ONE("\"V\"", "null"), NULL, NAN);
    rg_lines free_one = read_fold("{" SQUARE ",\"edges_assignment\":[\"M\",\"B\",\"B\",\"B\",\"V\"],\"edges_foldAngle\":[-90,0,0,0,null]}");
    assert_true(free_one.line[4].target == RG_FREE); /* null beside others that are given: it follows */
    near(free_one.line[0].target / RG_DEG, -90, 1e-12);
    rg_lines_free(&free_one);
    last_target(ONE("\"V\"", "0"), NULL, NAN); /* all are 0: it is the flat sheet that is described */
    last_target("{" SQUARE ",\"edges_assignment\":[\"M\",\"B\",\"B\",\"B\",\"V\"],\"edges_foldAngle\":[-90,0,0,0,0]}", NULL, 0);
    last_target("{" SQUARE ",\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\"],\"edges_foldAngles\":[0,0,0,0,-77]}", NULL, -77); /* 1.0 */
    s.targets = 0;
    last_target(ONE("\"M\"", "-30.5"), &s, NAN);
    last_target(ONE("\"U\"", "45"), &s, NAN);
    rg_lines l = read_fold(ONE("\"M\"", "30"));
    is_line(&l, 4, 'M', 0, 0, 4, 4, -30);
    assert_true(warned(&l, "edges_foldAngle[4]"));
    rg_lines_free(&l);
    refused(ONE("\"M\"", "\"30\""), RG_FORMAT_FOLD, NULL, 1, "edges_foldAngle[4]");
    refused(ONE("\"M\"", "-200"), RG_FORMAT_FOLD, NULL, 1, "edges_foldAngle[4]");
}

/* Hardly off a plane: read, and told how far. A form that is folded shows by the lengths of its edges. */
static void nearly_flat(void **state)
{
    (void)state;
    const char *form = "{\"vertices_coords\":[[0,0,0],[4,0,0],[4,%g,3],[0,%g,3]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],"
                       "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"V\"]}";
    char text[400];
    snprintf(text, sizeof text, form, 0.0, 0.004);
    rg_lines l = read_fold(text);
    is_line(&l, 4, 'V', 0, 0, 4, -3, NAN);
    assert_true(warned(&l, "off a plane by up to 0.004"));
    rg_lines_free(&l);
    snprintf(text, sizeof text, form, 0.0, 0.4);
    refused(text, RG_FORMAT_FOLD, NULL, 1, "a folded form");
    rg_reading s = rg_reading_default();
    s.merge = 0.01; /* and it is for the user to say how far */
    l = read_ok(text, RG_FORMAT_FOLD, &s);
    assert_true(warned(&l, "off a plane"));
    rg_lines_free(&l);
}

/* A program that draws downwards: one paper, whether its faces are listed or not. */
static void who_draws_down(void **state)
{
    (void)state;
    const char *form = "{\"file_creator\":\"%s\",\"vertices_coords\":[[0,0],[8,0],[8,6],[0,6]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],"
                       "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\"]%s}";
    const char *faces = ",\"faces_vertices\":[[0,2,1],[0,3,2]]"; /* clockwise where y points up */
    for (int i = 0; i < 2; i++) {
        char text[500];
        snprintf(text, sizeof text, form, "Oriedita", i ? faces : "");
        rg_lines l = read_fold(text);
        is_line(&l, 4, 'M', 0, 0, 8, -6, NAN);
        assert_true(l.y_down && l.warnings == 0);
        rg_lines_free(&l);
        snprintf(text, sizeof text, form, "somebody", i ? faces : "");
        l = read_fold(text);
        is_line(&l, 4, i ? 'V' : 'M', 0, 0, 8, 6, NAN);
        assert_int_equal(warned(&l, "--flip"), !i);
        rg_lines_free(&l);
    }
}

static void radians(void **state)
{
    (void)state;
    rg_lines l = read_fold(ONE("\"V\"", "3.14159265"));
    assert_true(warned(&l, "radians"));
    near(l.line[4].target, RG_PI, 1e-7);
    rg_lines_free(&l);
    l = read_fold(ONE("\"V\"", "1.5"));
    assert_true(warned(&l, "radians"));
    near(l.line[4].target / RG_DEG, 1.5, 1e-12);
    rg_lines_free(&l);
    l = read_fold(ONE("\"V\"", "3.2"));
    assert_int_equal(l.warnings, 1);
    assert_true(warned(&l, "--flip")); /* no faces, and a program that is not known */
    rg_lines_free(&l);
}

#define MARKED ",\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\"],\"edges_foldAngle\":[0,0,0,0,-60]"

/* Clockwise faces show the back: drawn as it is, mountain is valley. Turned round as well, the front is seen again. */
static void sides(void **state)
{
    (void)state;
    rg_lines l = read_fold("{" SQUARE FACES MARKED "}");
    is_line(&l, 4, 'M', 0, 0, 4, 4, -60);
    assert_int_equal(l.warnings, 0);
    rg_lines_free(&l);
    l = read_fold("{" SQUARE CLOCKWISE MARKED "}");
    is_line(&l, 4, 'V', 0, 0, 4, 4, 60);
    assert_true(warned(&l, "clockwise"));
    rg_lines_free(&l);
    rg_reading s = rg_reading_default();
    s.flip = 1;
    l = read_ok("{" SQUARE CLOCKWISE MARKED "}", RG_FORMAT_FOLD, &s);
    is_line(&l, 4, 'M', 0, 0, 4, -4, -60);
    assert_int_equal(l.warnings, 0);
    rg_lines_free(&l);
    l = read_ok("{" SQUARE FACES MARKED "}", RG_FORMAT_FOLD, &s);
    is_line(&l, 4, 'V', 0, 0, 4, -4, 60);
    rg_lines_free(&l);
    /* One face the wrong way round is a slip, and the others decide. */
    l = read_fold("{" SQUARE ",\"faces_vertices\":[[2,1,0],[0,2,3]]" MARKED "}");
    assert_true(warned(&l, "1 faces run counter-clockwise and 1 clockwise"));
    rg_lines_free(&l);
}

#define NO_COORDS "\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]]" FACES MARKED

static void planes_and_folded_forms(void **state)
{
    (void)state;
    /* Seen from the tip of +y, x is to the right and z comes down. */
    rg_lines l = read_fold("{\"vertices_coords\":[[0,7,0],[4,7,0],[4,7,-4],[0,7,-4]]," NO_COORDS ",\"frame_classes\":[\"foldedForm\"]}");
    is_line(&l, 4, 'M', 0, 0, 4, 4, -60);
    rg_lines_free(&l);
    l = read_fold("{\"vertices_coords\":[[0,7,0],[4,7,0],[4,7,4],[0,7,4]]," NO_COORDS "}");
    is_line(&l, 4, 'V', 0, 0, 4, -4, 60);
    rg_lines_free(&l);
    l = read_fold("{\"vertices_coords\":[[1,0,0],[1,4,0],[1,4,4],[1,0,4]]," NO_COORDS "}");
    is_line(&l, 4, 'M', 0, 0, 4, 4, -60);
    rg_lines_free(&l);
    l = read_fold("{\"vertices_coords\":[[0,0,0],[4,0],[4,4,0],[0,4]],\"edges_vertices\":[[0,2],[2,3]]}"); /* rows of two kinds */
    assert_int_equal(l.count, 2);
    rg_lines_free(&l);
    /* Any plane: lengths and turns are kept. */
    l = read_fold("{\"vertices_coords\":[[1,1,0],[3,1,2],[2,4,2],[0,4,0]]," NO_COORDS "}");
    assert_true(l.line[4].assignment == 'M' || l.line[4].assignment == 'V');
    near(hypot(l.line[0].b.x - l.line[0].a.x, l.line[0].b.y - l.line[0].a.y), sqrt(8), 1e-12);
    near(hypot(l.line[4].b.x - l.line[4].a.x, l.line[4].b.y - l.line[4].a.y), sqrt(14), 1e-12);
    near(rg_vec2_dot(rg_vec2_sub(l.line[0].b, l.line[0].a), rg_vec2_sub(l.line[3].a, l.line[3].b)), -2, 1e-12);
    rg_lines_free(&l);
    refused("{\"vertices_coords\":[[0,0,0],[4,0,0],[4,4,0],[0,4,1]]," NO_COORDS "}", RG_FORMAT_FOLD, NULL, 1, "folded form");
    /* Folded flat along the diagonal: vertex 3 lies on vertex 1, and one face is turned over. */
    refused("{\"vertices_coords\":[[0,0],[4,0],[4,4],[4,0]]," NO_COORDS "}", RG_FORMAT_FOLD, NULL, 1, "faces_vertices[1]: a folded form");
}

#define CP "\"vertices_coords\":[[0,0],[4,0],[4,4],[0,4]]"
#define SPACE "\"vertices_coords\":[[0,0,0],[4,0,0],[4,4,0],[0,4,1]]"

static void frames(void **state)
{
    (void)state;
    rg_reading s = rg_reading_default();
    const char *text = "{\"file_title\":\"whole\"," SPACE "," NO_COORDS ",\"file_frames\":["
        "{\"frame_inherit\":true,\"frame_parent\":0,\"vertices_coords\":[[0,0],[2,0],[2,2],[0,2]],\"frame_title\":\"one\"},"
        "{\"frame_inherit\":true,\"frame_parent\":1,\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"V\"]},"
        "{\"vertices_coords\":[[0,0],[1,0]],\"edges_vertices\":[[0,1]]},"
        "{\"frame_inherit\":true,\"frame_parent\":4},{\"frame_inherit\":true,\"frame_parent\":9}, 5]}";
    rg_lines l = read_fold(text); /* the key frame is folded, so the first flat one */
    is_line(&l, 4, 'M', 0, 0, 2, 2, -60);
    assert_string_equal(l.title, "whole");
    rg_lines_free(&l);
    s.file_frame = 2;
    l = read_ok(text, RG_FORMAT_FOLD, &s);
    is_line(&l, 4, 'V', 0, 0, 2, 2, 60); /* the sign of an inherited angle gives way to the assignment */
    rg_lines_free(&l);
    s.file_frame = 3;
    l = read_ok(text, RG_FORMAT_FOLD, &s);
    assert_int_equal(l.count, 1); /* nothing is inherited that is not asked for */
    rg_lines_free(&l);
    s.file_frame = 0;
    refused(text, RG_FORMAT_FOLD, &s, 1, "folded form");
    s.file_frame = 4;
    refused(text, RG_FORMAT_FOLD, &s, 1, "without end");
    s.file_frame = 5;
    refused(text, RG_FORMAT_FOLD, &s, 1, "no frame 9");
    s.file_frame = 6;
    refused(text, RG_FORMAT_FOLD, &s, 1, "file_frames[5]");
    s.file_frame = 7;
    refused(text, RG_FORMAT_FOLD, &s, 1, "no frame 7");
    l = read_fold("{\"file_spec\":1.1,\"file_frames\":[{\"frame_classes\":[\"creasePattern\"]," CP "," NO_COORDS "}]}");
    is_line(&l, 4, 'M', 0, 0, 4, 4, -60);
    rg_lines_free(&l);
    /* A drawing that is wrong is not passed over for a later one. */
    refused("{" CP ",\"edges_vertices\":[[0,9]],\"file_frames\":[{" CP "," NO_COORDS "}]}", RG_FORMAT_FOLD, NULL, 1, "edges_vertices[0][1]");
    refused("{\"file_frames\":[{\"frame_title\":\"x\"},{}]}", RG_FORMAT_FOLD, NULL, 1, "vertices_coords");
    refused("{" SPACE "," NO_COORDS ",\"file_frames\":[{}]}", RG_FORMAT_FOLD, NULL, 1, "folded form");
}

static void places_of_errors(void **state)
{
    (void)state;
    const struct { const char *text; int line; const char *words; } wrong[] = {
        {"{" CP ",\"edges_vertices\":[[0,1],[1,4]]}", 1, "edges_vertices[1][1]: there is no vertex 4"},
        {"{" CP ",\"edges_vertices\":[[0,-1]]}", 1, "edges_vertices[0][1]"},
        {"{" CP ",\"edges_vertices\":[[0,1.5]]}", 1, "edges_vertices[0][1]: no vertex number"},
        {"{" CP ",\"edges_vertices\":[[0,1,2]]}", 1, "edges_vertices[0]"},
        {"{" CP ",\"edges_vertices\":{\"0\":[0,1]}}", 1, "edges_vertices: no list"},
        {"{" CP ",\"edges_vertices\":[null]}", 1, "edges_vertices[0]"},
        {"{\"vertices_coords\":[[0,0],[1]],\"edges_vertices\":[[0,1]]}", 1, "vertices_coords[1]"},
        {"{\"vertices_coords\":[[0,0],[1,\"2\"]],\"edges_vertices\":[[0,1]]}", 1, "vertices_coords[1]"},
        {"{\"vertices_coords\":[[0,0],[1,1e200]],\"edges_vertices\":[[0,1]]}", 1, "vertices_coords[1]: 1e+200"},
        {"{" SQUARE ",\"edges_assignment\":[\"B\",\"B\",\"X\",\"B\",\"M\"]}", 1, "edges_assignment[2]"},
        {"{" SQUARE ",\"edges_assignment\":[\"B\",\"\",\"B\",\"B\",\"M\"]}", 1, "edges_assignment[1]"},
        {"{" SQUARE ",\"edges_assignment\":[\"B\",\"B\"]}", 1, "edges_assignment: 2 of them for 5 edges"},
        {"{" SQUARE ",\"edges_foldAngle\":[0]}", 1, "edges_foldAngle: 1 of them"},
        {"{" SQUARE ",\"faces_vertices\":[[0,1]]}", 1, "faces_vertices[0]"},
        {"{" SQUARE ",\"faces_vertices\":[[0,1,2],[0,2,7]]}", 1, "faces_vertices[1][2]"},
        {"{\n" SQUARE ",\n\"x\":NaN}", 3, "not well-formed JSON"},
        {"{\n" SQUARE ",\n\"vertices_coords\":[]}", 3, "duplicate"},
        {"{\"a\":1e400," SQUARE "}", 1, "overflow"},
        {"{\"a\":123456789012345678901234567890}", 1, "too big"},
        {"{\"a\":\"\\ud800\"}", 1, "not well-formed JSON"},
        {"{\"a\":\"\xff\"}", 1, "not well-formed JSON"},
        {"[]", 1, "no object"},
        {"{}x", 1, "not well-formed JSON"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) refused(wrong[i].text, RG_FORMAT_FOLD, NULL, wrong[i].line, wrong[i].words);
}

/* Lines of errors, of warnings, and of what is read, whatever stands before them: texts with brackets, frames within. */
static void lines_of_the_file(void **state)
{
    (void)state;
    refused("{\n\"note\":\"] } \\\" [ {\", \"more\":{\"edges_vertices\":[1,\n{\"a\":[]}]},\n\"vertices_coords\":[[0,0],\n[1,0]],\n"
            "\"edges_vertices\" :\n[ [0,1] ,\n[0,\n7]]}", RG_FORMAT_FOLD, NULL, 9, "edges_vertices[1][1]");
    refused("{\"vertices_coords\":[[0,0],[1,0]],\n\"file_frames\":[{},\n{\"frame_parent\":1,\"frame_inherit\":true}]}", RG_FORMAT_FOLD, NULL, 1, "no");
    rg_reading s = rg_reading_default();
    s.file_frame = 2;
    const char *inherits = "{\"file_frames\":[\n{\"vertices_coords\":[[0,0],\n[1,0]],\n\"edges_vertices\":[[0,1],\n[1,2]]},\n"
                           "{\"frame_parent\":1,\"frame_inherit\":true,\n\"edges_assignment\":[\"M\"]}]}";
    refused(inherits, RG_FORMAT_FOLD, &s, 5, "file_frames[0].edges_vertices[1][1]");
    refused("{\"file_frames\":[{\"frame_parent\":8,\n\"frame_inherit\":true},\n{\"frame_parent\":1,\"frame_inherit\":true}]}", RG_FORMAT_FOLD, &s, 1,
            "file_frames[0].frame_parent: there is no frame 8");
    refused("{\"file_frames\":[{},\n7]}", RG_FORMAT_FOLD, &s, 2, "file_frames[1]");
    rg_lines l = read_fold("{\"vertices_coords\":[[0,0],[4,0],[0,4]],\n\"edges_vertices\":[\n[0,1],[1,2],\n\n[2,0]],\"edges_assignment\":[\"B\",\"M\",\"B\"],\n"
                           "\"edges_foldAngle\":[0,\n90,0]}");
    const int32_t want[] = {3, 3, 5};
    for (int i = 0; i < 3; i++) assert_int_equal(l.line[i].where, want[i]);
    assert_int_equal(l.warnings, 2);
    assert_true(warned(&l, "edges_foldAngle[1]") && warned(&l, "--flip"));
    assert_int_equal(l.warning[0].line, 7);
    rg_lines_free(&l);
}

static void depth_and_truncation(void **state)
{
    (void)state;
    char *deep = malloc(400001);
    assert_non_null(deep);
    memset(deep, '[', 200000);
    memset(deep + 200000, ']', 200000);
    deep[400000] = 0;
    memcpy(deep, "{\"a\":", 5);
    refused(deep, RG_FORMAT_FOLD, NULL, 1, "not well-formed JSON");
    free(deep);
    const char *whole = "{" SQUARE FACES MARKED "}";
    for (size_t n = 1; n < strlen(whole); n++) {
        rg_lines l;
        rg_diag why;
        assert_int_equal(read_text(whole, n, RG_FORMAT_FOLD, NULL, &l, &why), RG_EFORMAT);
        assert_int_equal(why.line, 1);
    }
}

/* Frames inherit from each other, and each has what all of them have: what is long was put together anew for each. */
static void frames_that_inherit_much(void **state)
{
    (void)state;
    enum { KEYS = 30000, FRAMES = 1000, CHAIN = 95 };
    char *text = malloc(KEYS * 16 + FRAMES * 60 + 100);
    assert_non_null(text);
    size_t n = (size_t)sprintf(text, "{\"file_spec\":1.1");
    for (int i = 0; i < KEYS; i++) n += (size_t)sprintf(text + n, ",\"k%d\":0", i);
    n += (size_t)sprintf(text + n, ",\"file_frames\":[");
    for (int i = 0; i < FRAMES; i++)
        n += (size_t)sprintf(text + n, "%s{\"frame_inherit\":true,\"frame_parent\":%d}", i ? "," : "", i < CHAIN ? i : CHAIN);
    sprintf(text + n, "]}");
    refused(text, RG_FORMAT_FOLD, NULL, 1, "no vertices_coords");
    free(text);
}

/* A flat frame is looked for behind folded ones, but not behind all that a file can make of a long one. */
static void frames_that_are_folded(void **state)
{
    (void)state;
    for (int many = 0; many < 2; many++) {
        const int vertices = many ? 20001 : 9, frames = 900;
        char *text = malloc((size_t)vertices * 60 + (size_t)frames * 60 + 500);
        assert_non_null(text);
        size_t n = (size_t)sprintf(text, "{\"vertices_coords\":[[0,0,0]");
        for (int i = 1; i < vertices; i++) n += (size_t)sprintf(text + n, ",[%d,%d,%d]", i % 100, i / 100 + i * 3 % 4, i * 7 % 5);
        n += (size_t)sprintf(text + n, "],\"edges_vertices\":[[0,1]");
        for (int i = 2; i < vertices; i++) n += (size_t)sprintf(text + n, ",[%d,%d]", i - 1, i);
        n += (size_t)sprintf(text + n, "],\"file_frames\":[");
        for (int i = 0; i < frames; i++) n += (size_t)sprintf(text + n, "{\"frame_inherit\":true,\"frame_parent\":0},");
        sprintf(text + n, "{\"vertices_coords\":[[0,0],[1,0]],\"edges_vertices\":[[0,1]],\"edges_assignment\":[\"V\"]}]}");
        if (many) refused(text, RG_FORMAT_FOLD, NULL, 1, "a folded form");
        else letters(text, "V");
        free(text);
    }
}

/* Without edges_vertices, the edges are the sides of the faces in an order that the file knows nothing of. */
static void numbers_of_edges_are_those_of_the_file(void **state)
{
    (void)state;
    static const char corners[] = "{\"vertices_coords\":[[0,0],[4,0],[4,4],[0,4]]" FACES;
    char text[400];
    snprintf(text, sizeof text, "%s,\"edges_foldAngle\":[0,0,90,0,0]}", corners);
    refused(text, RG_FORMAT_FOLD, NULL, 1, "edges_foldAngle: there are no edges_vertices to say which edges these are");
    snprintf(text, sizeof text, "%s,\"edges_vertices\":[],\"edges_assignment\":[],\"edges_foldAngle\":[]}", corners);
    letters(text, "BUBBB");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_of_all_kinds), cmocka_unit_test(what_is_missing), cmocka_unit_test(angles), cmocka_unit_test(nearly_flat), cmocka_unit_test(who_draws_down), cmocka_unit_test(radians),
        cmocka_unit_test(sides), cmocka_unit_test(planes_and_folded_forms), cmocka_unit_test(frames),
        cmocka_unit_test(frames_that_inherit_much), cmocka_unit_test(frames_that_are_folded),
        cmocka_unit_test(numbers_of_edges_are_those_of_the_file), cmocka_unit_test(places_of_errors), cmocka_unit_test(lines_of_the_file), cmocka_unit_test(depth_and_truncation)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
