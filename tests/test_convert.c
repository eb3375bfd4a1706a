/* files/convert.c, save: what is kept from format to format, what is told to be lost, and that files appear whole. */
#include "corpus.h"
#include "counted.h"
#include "read/value.h"
#include "reading.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

/* ------------------------------------------------------------------------------------------------------- tools ---- */

static char folder[] = "/tmp/rigami-convert-XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[100];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

/* A path in the folder; four may be in use at once. */
static const char *at(const char *name)
{
    static char path[4][200];
    static int next;
    snprintf(path[next = (next + 1) % 4], sizeof path[0], "%s/%s", folder, name);
    return path[next];
}

typedef struct told { int count; char text[50][240]; } told;

static void hear(void *ctx, const rg_diag *warning)
{
    told *t = ctx;
    if (t->count < 50) snprintf(t->text[t->count], sizeof t->text[0], "%s", warning->text);
    t->count++;
}

static int heard(const told *t, const char *words)
{
    for (int i = 0; i < t->count && i < 50; i++)
        if (strstr(t->text[i], words)) return 1;
    return 0;
}

static told convert(const char *in, const char *out, const rg_reading *given)
{
    told t = {0};
    rg_diag why = {0, ""};
    rg_reading s = given ? *given : rg_reading_default();
    const rg_status status = rg_convert(in, out, RG_FORMAT_AUTO, &s, hear, &t, &why);
    if (status != RG_OK) print_error("%s to %s: line %d: %s\n", in, out, why.line, why.text);
    assert_int_equal(status, RG_OK);
    return t;
}

static rg_lines read_lines(const char *path, int keep)
{
    rg_reading s = rg_reading_default();
    rg_lines l;
    rg_diag why = {0, ""};
    const rg_status status = rg_read_file(path, &s, keep, &l, &why);
    if (status != RG_OK) print_error("%s: line %d: %s\n", path, why.line, why.text);
    assert_int_equal(status, RG_OK);
    return l;
}

static const char *write_text(const char *name, const char *text)
{
    const char *path = at(name);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
    return path;
}

static char *load(const char *path)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *text = calloc(1, 1 << 21);
    assert_non_null(text);
    const size_t n = fread(text, 1, (1 << 21) - 1, f);
    fclose(f);
    text[n] = 0;
    return text;
}

static double size_of(const rg_lines *l)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int32_t i = 0; i < l->count; i++)
        for (int k = 0; k < 2; k++) {
            const rg_vec2 x = k ? l->line[i].b : l->line[i].a;
            low[0] = fmin(low[0], x.x), low[1] = fmin(low[1], x.y);
            high[0] = fmax(high[0], x.x), high[1] = fmax(high[1], x.y);
        }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

static rg_vec2 along(const rg_line *l) { return rg_vec2_sub(l->b, l->a); }

/* Whether p and q lie on one line, by how far the ends of the shorter one are off the longer one. */
static int on_one_line(const rg_line *p, const rg_line *q, double tol)
{
    const rg_line *far = rg_vec2_length(along(p)) >= rg_vec2_length(along(q)) ? p : q, *near_by = far == p ? q : p;
    const rg_vec2 d = along(far);
    const double most = tol * rg_vec2_length(d);
    return fabs(rg_vec2_cross(d, rg_vec2_sub(near_by->a, far->a))) <= most && fabs(rg_vec2_cross(d, rg_vec2_sub(near_by->b, far->a))) <= most;
}

/* The length of p that lines of the same assignment in `in` cover. */
static double covered(const rg_line *p, const rg_lines *in, double tol)
{
    const rg_vec2 d = along(p);
    const double length = rg_vec2_length(d);
    double sum = 0;
    for (int32_t i = 0; i < in->count; i++) {
        const rg_line *q = &in->line[i];
        if (q->assignment != p->assignment || !on_one_line(p, q, tol)) continue;
        const double s = rg_vec2_dot(d, rg_vec2_sub(q->a, p->a)) / length, t = rg_vec2_dot(d, rg_vec2_sub(q->b, p->a)) / length;
        sum += fmax(0, fmin(fmax(s, t), length) - fmax(fmin(s, t), 0));
    }
    return sum;
}

/* Every line of p is there in q, perhaps in parts, to 1e-9 of the size; a part may begin and end anywhere. */
static int missing(const char *file, const rg_lines *p, const rg_lines *q)
{
    const double tol = 1e-9 * size_of(p);
    int bad = 0;
    for (int32_t i = 0; i < p->count; i++) {
        const double length = rg_vec2_length(along(&p->line[i]));
        if (length <= tol || covered(&p->line[i], q, tol) >= length - 4 * tol) continue;
        print_error("%s: line %d (%c) is not all there\n", file, (int)i, p->line[i].assignment);
        bad++;
    }
    return bad;
}

/* ------------------------------------------------------------------------------------------------- round trips ---- */

static int same_lines(const rg_lines *p, const rg_lines *q, double tol)
{
    if (p->count != q->count) return 0;
    for (int32_t i = 0; i < p->count; i++) {
        const rg_line *a = &p->line[i], *b = &q->line[i];
        if (a->assignment != b->assignment || isnan(a->target) != isnan(b->target)) return 0;
        if (!isnan(a->target) && !(fabs(a->target - b->target) <= 1e-14)) return 0;
        if (!(rg_vec2_length(rg_vec2_sub(a->a, b->a)) <= tol && rg_vec2_length(rg_vec2_sub(a->b, b->b)) <= tol)) return 0;
    }
    return 1;
}

/* Not one that is a whole number: no two coordinates are alike by accident. Crossings are vertices. */
static const char PLANE[] = "{\"vertices_coords\":[[0.1,0.2],[7.3,-0.4],[7.1,6.9],[-0.3,7.7],[3.3,3.1],[0.2,2.1],[0.9,3.125]],"
    "\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,4],[1,4],[2,4],[3,4],[5,6]],"
    "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\",\"V\",\"M\",\"V\",\"F\"],"
    "\"file_creator\":\"rigami 0\",\"edges_foldAngle\":[0,0,0,0,-180,33.3,-77.125,180,0],\"file_title\":\"a <b> & \\\"c\\\"\",\"file_author\":\"\xC3\x89. \xE6\x8A\x98\","
    "\"file_description\":\"two\\nlines\",\"rigami:editor\":\"ed\",\"rigami:reference\":\"ref\"}";

static void formats_keep_what_they_can(void **state)
{
    (void)state;
    const char *const names[] = {"k.fold", "k.svg", "k.opx", "k.cp"};
    write_text("plane.fold", PLANE);
    rg_lines first = read_lines(at("plane.fold"), 0);
    for (int i = 0; i < 4; i++) {
        const told t = convert(at("plane.fold"), at(names[i]), NULL);
        rg_lines l = read_lines(at(names[i]), 0);
        assert_int_equal(l.count, first.count);
        for (int32_t e = 0; i >= 2 && e < l.count; e++) l.line[e].target = first.line[e].target;
        assert_true(same_lines(&first, &l, 1e-15));
        assert_int_equal(heard(&t, "such fold angles (2)"), i >= 2);
        assert_int_equal(heard(&t, "title, author and other texts (5)"), i == 3);
        assert_int_equal(heard(&t, "editor and reference (2)"), i == 1);
        assert_int_equal(t.count, i == 0 ? 0 : i == 3 ? 2 : 1);
        if (i < 3) {
            assert_string_equal(l.title, "a <b> & \"c\"");
            assert_string_equal(l.author, "\xC3\x89. \xE6\x8A\x98");
            assert_string_equal(l.memo, "two\nlines");
        }
        if (i == 0 || i == 2) {
            assert_string_equal(l.editor, "ed");
            assert_string_equal(l.reference, "ref");
        }
        rg_lines_free(&l);
    }
    rg_lines_free(&first);
}

static void losses_are_told(void **state)
{
    (void)state;
    write_text("u.fold", "{\"vertices_coords\":[[0,0],[1,0],[1,1]],\"edges_vertices\":[[0,1],[1,2],[2,0]],"
                         "\"edges_assignment\":[\"U\",\"U\",\"M\"],\"edges_foldAngle\":[20,0,-180]}");
    told t = convert(at("u.fold"), at("u.cp"), NULL);
    assert_true(heard(&t, ".cp cannot hold unassigned creases, they become auxiliary lines (2)"));
    assert_true(heard(&t, ".cp cannot hold such fold angles (1)"));
    t = convert(at("u.fold"), at("u.svg"), NULL);
    assert_true(heard(&t, ".svg cannot hold such fold angles (1)"));
    rg_lines l = read_lines(at("u.svg"), 0);
    assert_int_equal(l.line[0].assignment, 'U');
    rg_lines_free(&l);
    t = convert(at("u.fold"), at("u.opx"), NULL);
    l = read_lines(at("u.opx"), 0);
    assert_int_equal(l.line[0].assignment, 'U');
    rg_lines_free(&l);
    write_text("cut.opx", "<java><object class=\"oripa.DataSet\"><void property=\"lines\"><array><void index=\"0\"><object>"
                          "<void property=\"type\"><int>9</int></void><void property=\"x0\"><double>1</double></void></object></void></array></void></object></java>");
    t = convert(at("cut.opx"), at("cut.fold"), NULL);
    assert_true(heard(&t, ".fold cannot hold cuts of the folded model"));
    l = read_lines(at("cut.fold"), 0);
    assert_int_equal(l.line[0].assignment, 'F');
    rg_lines_free(&l);
}

/* The chain of all formats over every real .opx file, and back where it began. */
static void a_chain_of_all_formats(void **state)
{
    (void)state;
    char path[4096];
    FILE *f = fopen(corpus("stats.tsv", path, sizeof path), "r");
    int files = 0, bad = 0;
    for (char row[2000]; fgets(row, sizeof row, f);) {
        row[strcspn(row, "\t")] = 0;
        if (strncmp(row, "malformed/", 10) == 0 || strcmp(row, "file") == 0) continue;
        if (strcmp(row, "fold/box-pleat-in-out-wave.fold") == 0) continue; /* covered() looks at each pair of lines */
        files++;
        convert(corpus(row, path, sizeof path), at("1.opx"), NULL);
        convert(at("1.opx"), at("2.fold"), NULL);
        convert(at("2.fold"), at("3.svg"), NULL);
        convert(at("3.svg"), at("4.cp"), NULL);
        convert(at("4.cp"), at("5.opx"), NULL);
        rg_lines p = read_lines(at("1.opx"), 0), q = read_lines(at("5.opx"), 0);
        for (int32_t i = 0; i < p.count; i++) /* .cp cannot hold these */
            if (p.line[i].assignment == 'U') p.line[i].assignment = 'F';
        bad += missing(row, &p, &q) + missing(row, &q, &p);
        rg_lines_free(&p);
        rg_lines_free(&q);
    }
    fclose(f);
    assert_int_equal(files, 45);
    assert_int_equal(bad, 0);
}

/* -------------------------------------------------------------------------------------------------------- FOLD ---- */

/* Faces as they must be: Euler's formula, counter-clockwise, each side an edge, both lists of one mind, areas that add up. */
static void check_faces(const char *path, int32_t faces, double area)
{
    char *text = load(path);
    rg_value *root = NULL;
    rg_diag why;
    assert_int_equal(rg_value_parse(text, strlen(text), NULL, &root, &why), RG_OK);
    const rg_value *fv = rg_value_get(root, "faces_vertices"), *fe = rg_value_get(root, "faces_edges"), *ef = rg_value_get(root, "edges_faces");
    const rg_value *ev = rg_value_get(root, "edges_vertices"), *x = rg_value_get(root, "vertices_coords");
    double sum = 0;
    assert_int_equal(rg_value_count(fv), faces);
    assert_int_equal(rg_value_count(fe), faces);
    assert_int_equal(rg_value_count(ef), rg_value_count(ev));
    for (size_t f = 0; f < rg_value_count(fv); f++) {
        const rg_value *v = rg_value_at(fv, f), *e = rg_value_at(fe, f);
        const size_t n = rg_value_count(v);
        double twice = 0;
        assert_int_equal(rg_value_count(e), n);
        for (size_t k = 0; k < n; k++) {
            int64_t a, b, edge, p, q;
            double ax, ay, bx, by;
            assert_true(rg_value_integer(rg_value_at(v, k), &a) && rg_value_integer(rg_value_at(v, (k + 1) % n), &b));
            assert_true(rg_value_integer(rg_value_at(e, k), &edge));
            const rg_value *ends = rg_value_at(ev, (size_t)edge), *sides = rg_value_at(ef, (size_t)edge);
            assert_true(rg_value_integer(rg_value_at(ends, 0), &p) && rg_value_integer(rg_value_at(ends, 1), &q));
            assert_true((p == a && q == b) || (p == b && q == a));
            int named = 0;
            for (size_t i = 0; i < rg_value_count(sides); i++) {
                int64_t face;
                named += rg_value_integer(rg_value_at(sides, i), &face) && face == (int64_t)f;
            }
            assert_int_equal(named, 1);
            rg_value_number(rg_value_at(rg_value_at(x, (size_t)a), 0), &ax);
            rg_value_number(rg_value_at(rg_value_at(x, (size_t)a), 1), &ay);
            rg_value_number(rg_value_at(rg_value_at(x, (size_t)b), 0), &bx);
            rg_value_number(rg_value_at(rg_value_at(x, (size_t)b), 1), &by);
            twice += ax * by - ay * bx;
        }
        assert_true(twice > 0);
        sum += twice / 2;
    }
    near(sum, area, 1e-9 * area);
    rg_value_free(root);
    free(text);
}

static void faces(void **state)
{
    (void)state;
    /* A square of side 4 with a cross whose lines meet in no vertex, and a loose end in one corner. */
    write_text("cross.cp", "1 0 0 4 0\n1 4 0 4 4\n1 4 4 0 4\n1 0 4 0 0\n2 0 0 4 4\n3 4 0 0 4\n4 2 0 2 0.5\n4 0.2 3.5 3.8 3.5\n");
    told t = convert(at("cross.cp"), at("cross.fold"), NULL);
    assert_int_equal(t.count, 0);
    check_faces(at("cross.fold"), 5, 16); /* the last line cuts off another face, and its ends hang over */
    rg_lines l = read_lines(at("cross.fold"), 0);
    int32_t loose = 0;
    for (int32_t i = 0; i < l.count; i++) loose += l.line[i].assignment == 'F';
    assert_int_equal(loose, 4);
    rg_lines_free(&l);
    /* A slit is a cut. */
    write_text("slit.cp", "1 0 0 4 0\n1 4 0 4 4\n1 4 4 0 4\n1 0 4 0 0\n2 0 0 2 2\n1 2 2 4 4\n");
    convert(at("slit.cp"), at("slit.fold"), NULL);
    check_faces(at("slit.fold"), 2, 16);
    char *text = load(at("slit.fold"));
    assert_non_null(strstr(text, "[\"B\", \"B\", \"B\", \"B\", \"M\", \"C\"]"));
    free(text);
}

/* What else a FOLD file says stays where it still holds, under the same numbers. */
static void extras(void **state)
{
    (void)state;
    const char *whole = "{\"file_spec\":1,\"file_creator\":\"x\",\"vertices_coords\":[[4,4],[0,0],[4,0],[0,4]],\"edges_vertices\":[[1,2],[2,0],[0,3],[3,1],[1,0]],"
        "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\"],\"edges_foldAngles\":[0,0,0,0,-180],\"edges_lengths\":[4,4,4,4,5.65],"
        "\"faces_vertices\":[%s],\"faces_a:colour\":[\"r\",\"g\"],\"faceOrders\":[[0,1,1]],\"edges_a:tag\":[1,2.5,null,true,{\"k\":[]}],"
        "\"vertices_a:tag\":[\"p\",\"q\",\"r\",\"s\"],\"edges_a:short\":[1],\"a:page\":{\"size\":[210,297.5],\"name\":\"A4\"},\"frame_unit\":\"mm\","
        "\"file_frames\":[{\"frame_inherit\":true,\"frame_parent\":0,\"frame_title\":\"second\"}]}";
    char text[2000];
    snprintf(text, sizeof text, whole, "[0,3,1],[1,2,0]");
    write_text("e.fold", text);
    told t = convert(at("e.fold"), at("e2.fold"), NULL);
    char *now = load(at("e2.fold"));
    const char *const kept[] = {"\"faces_a:colour\": [\n  \"r\",\n  \"g\"", "\"faceOrders\"", "\"edges_a:tag\": [\n  1,\n  2.5,\n  null,\n  true,\n  {\"k\": []}",
        "\"vertices_a:tag\": [\n  \"p\"", "297.5", "\"frame_unit\": \"mm\"", "\"second\"", "\"edges_length\"", "\"file_spec\": 1.2", "[4, 4],\n  [0, 0]",
        "[0, 3, 1],\n  [1, 2, 0]", "\"rigami "};
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++)
        if (!strstr(now, kept[i])) fail_msg("no longer there: %s", kept[i]);
    assert_null(strstr(now, "edges_a:short")); /* it never held */
    assert_null(strstr(now, "edges_lengths"));
    assert_null(strstr(now, "foldAngles"));
    assert_true(heard(&t, "1 keys"));
    free(now);
    /* Clockwise faces are turned round, so that what is said of faces and of frames does not hold. */
    snprintf(text, sizeof text, whole, "[1,3,0],[0,2,1]");
    write_text("e.fold", text);
    t = convert(at("e.fold"), at("e2.fold"), NULL);
    now = load(at("e2.fold"));
    assert_null(strstr(now, "faceOrders"));
    assert_null(strstr(now, "a:colour"));
    assert_null(strstr(now, "second"));
    assert_non_null(strstr(now, "vertices_a:tag"));
    assert_non_null(strstr(now, "\"V\"]"));
    assert_true(heard(&t, "4 keys"));
    free(now);
    rg_reading s = rg_reading_default();
    s.file_frame = 1;
    snprintf(text, sizeof text, whole, "[0,3,1],[1,2,0]");
    write_text("e.fold", text);
    convert(at("e.fold"), at("e2.fold"), &s);
    now = load(at("e2.fold"));
    assert_non_null(strstr(now, "\"second\""));
    assert_null(strstr(now, "file_frames"));
    assert_null(strstr(now, "frame_inherit"));
    assert_null(strstr(now, "_source"));
    free(now);
    /* Two of its vertices are one, one is on no line, and two lines cross: which number each had. */
    write_text("e.fold", "{\"vertices_coords\":[[9,9],[0,0],[4,0],[4,4],[0,4],[0,0]],\"edges_vertices\":[[2,4],[5,2],[2,3],[3,4],[4,1],[1,3]],"
               "\"edges_assignment\":[\"V\",\"B\",\"B\",\"B\",\"B\",\"M\"]}");
    convert(at("e.fold"), at("e2.fold"), NULL);
    now = load(at("e2.fold"));
    assert_non_null(strstr(now, "\"vertices_coords\": [\n  [0, 0],\n  [4, 0],\n  [4, 4],\n  [0, 4],\n  [2, 2]"));
    assert_non_null(strstr(now, "\"rigami:vertices_source\": [1, 2, 3, 4, null]"));
    assert_non_null(strstr(now, "\"rigami:edges_source\": [0, 0, 1, 2, 3, 4, 5, 5]"));
    free(now);
}

/* Two lines that cross are four edges, and two that lie on others none: as many as before, and yet others. */
static void as_many_edges_are_not_the_same(void **state)
{
    (void)state;
    write_text("e.fold", "{\"vertices_coords\":[[0,0],[4,0],[4,4],[0,4]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2],[1,3],[0,2],[3,1]],"
               "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"M\",\"V\",\"M\",\"V\"],\"edges_a:name\":[1,2,3,4,5,6,7,8]}");
    const told t = convert(at("e.fold"), at("e2.fold"), NULL);
    char *now = load(at("e2.fold"));
    assert_null(strstr(now, "edges_a:name"));
    assert_non_null(strstr(now, "\"rigami:edges_source\": [0, 1, 2, 3, 4, 4, 5, 5]"));
    assert_true(heard(&t, "1 keys"));
    free(now);
}

/* Ends that miss each other: kept apart to the last digit, unless asked, or where the format is drawn roughly. */
static void gaps(void **state)
{
    (void)state;
    write_text("gap.cp", "1 0 0 4 0\n1 4 0 4 4\n1 4.00002 4 0 4\n1 0 4 0 0\n2 0 0 4 4\n");
    rg_reading s = rg_reading_default();
    told t = convert(at("gap.cp"), at("gap.fold"), NULL);
    assert_true(heard(&t, "miss each other by up to 2e-05"));
    rg_lines l = read_lines(at("gap.fold"), 0);
    near(l.line[2].a.x, 4.00002, 0);
    rg_lines_free(&l);
    char *text = load(at("gap.fold"));
    assert_null(strstr(text, "faces_vertices"));
    free(text);
    s.merge = 2e-5; /* what the message says */
    t = convert(at("gap.cp"), at("gap.fold"), &s);
    assert_int_equal(t.count, 0);
    check_faces(at("gap.fold"), 2, 16 + 2 * 2e-5 / 3); /* the mean of three ends */
    write_text("gap.svg", "<svg><path stroke='#000' d='M0 0H4V4M4.001 4H0V0'/><path stroke='red' d='M0 0L4 4'/></svg>");
    t = convert(at("gap.svg"), at("gap.fold"), NULL);
    assert_true(heard(&t, "are joined"));
    text = load(at("gap.fold"));
    assert_non_null(strstr(text, "faces_vertices"));
    free(text);
}

/* ------------------------------------------------------------------------------------------------------- files ---- */

static int files_in_folder(void)
{
    int n = 0;
    DIR *d = opendir(folder);
    assert_non_null(d);
    while (readdir(d)) n++;
    closedir(d);
    return n;
}

static void files_are_whole_or_not_there(void **state)
{
    (void)state;
    rg_reading s = rg_reading_default();
    rg_diag why = {0, ""};
    write_text("good.cp", "1 0 0 1 1\n");
    write_text("bad.cp", "1 0 0 1 1\n2 0 0\n");
    write_text("old.fold", "old");
    const int before = files_in_folder();
    assert_int_equal(rg_convert(at("bad.cp"), at("old.fold"), RG_FORMAT_AUTO, &s, NULL, NULL, &why), RG_EFORMAT);
    assert_int_equal(why.line, 2);
    assert_int_equal(rg_convert(at("none.cp"), at("old.fold"), RG_FORMAT_AUTO, &s, NULL, NULL, &why), RG_EREAD);
    assert_int_equal(rg_convert(at("good.cp"), at("no/old.fold"), RG_FORMAT_AUTO, &s, NULL, NULL, &why), RG_EWRITE);
    assert_int_equal(rg_convert(at("good.cp"), at("old.ori"), RG_FORMAT_AUTO, &s, NULL, NULL, &why), RG_EARG);
    assert_int_equal(rg_convert(at("good.cp"), at("old"), RG_FORMAT_AUTO, &s, NULL, NULL, &why), RG_EARG);
    assert_non_null(strstr(why.text, ".opx, .cp, .fold, .svg or .dxf"));
    s.merge = NAN;
    assert_int_equal(rg_convert(at("good.cp"), at("old.fold"), RG_FORMAT_AUTO, &s, NULL, NULL, &why), RG_EARG);
    s = rg_reading_default();
    char *text = load(at("old.fold"));
    assert_string_equal(text, "old");
    free(text);
    assert_int_equal(files_in_folder(), before);
    assert_int_equal(rg_convert(at("good.cp"), at("old.fold"), RG_FORMAT_SVG, &s, NULL, NULL, &why), RG_OK);
    text = load(at("old.fold"));
    assert_non_null(strstr(text, "<svg"));
    free(text);
    assert_int_equal(files_in_folder(), before);
    /* Onto itself. */
    assert_int_equal(rg_convert(at("good.cp"), at("good.cp"), RG_FORMAT_AUTO, &s, NULL, NULL, &why), RG_OK);
    rg_lines l = read_lines(at("good.cp"), 0);
    assert_int_equal(l.count, 1);
    rg_lines_free(&l);
}

/* Memory that runs short at any request: RG_ENOMEM, no leak, and what was there before is there still. */
/* What was read is written so that it can be read again, into every format; or it is refused before anything is written. */
static int reads_again(const char *given)
{
    char in[200];
    snprintf(in, sizeof in, "%s", given);
    static const char *const outs[] = {"again.opx", "again.cp", "again.fold", "again.svg", "again.dxf"};
    const rg_reading s = rg_reading_default();
    int written = 0;
    for (int i = 0; i < 5; i++) {
        rg_diag why = {0, ""};
        const char *out = at(outs[i]);
        remove(out);
        const rg_status status = rg_convert(in, out, RG_FORMAT_AUTO, &s, NULL, NULL, &why);
        if (status != RG_OK) {
            assert_int_equal(status, RG_EFORMAT);
            assert_true(why.text[0]);
            assert_int_not_equal(access(out, F_OK), 0);
            continue;
        }
        rg_lines l = read_lines(out, 0);
        assert_true(l.count > 0);
        rg_lines_free(&l);
        written++;
    }
    return written;
}

/* Each could be written in some format that did not take it back: a number that FOLD's reader finds too large, characters that are none in
 * XML, two names of one key of which FOLD knows the newer, a title that looks like another format's key, nothing to draw at all. */
static void what_is_written_can_be_read(void **state)
{
    (void)state;
    assert_int_equal(reads_again(write_text("large.cp", "2 0 0 1e101 1\n3 0 1 2 3\n")), 0);
    assert_int_equal(reads_again(write_text("largest.cp", "2 0 0 1e100 1\n3 0 -1e100 2 3\n1 5 5 6 5\n")), 5);
    assert_int_equal(reads_again(write_text("small.cp", "2 0 0 1e-300 1e-300\n3 0 -1e-300 2e-300 0\n")), 4); /* no faces are looked for in it */
    assert_int_equal(reads_again(write_text("none.cp", "2 0 0 NaN 1\n")), 0);
    static const char *const more[] = {
        "\"file_title\":\"\xEF\xBF\xBE and \xEF\xBF\xBF\",\"file_description\":\"\\u0001\\uffff\\u007f\\r\"",
        "\"edges_lengths\":[1,1,1],\"edges_length\":[1,1,1]",
        "\"file_title\":\"lineSegments\",\"x:lineSegments\":3",
    };
    for (int i = 0; i < 3; i++) {
        char text[600];
        snprintf(text, sizeof text, "{\"vertices_coords\":[[0,0],[1,0],[0,1]],\"edges_vertices\":[[0,1],[1,2],[2,0]],\"edges_assignment\":[\"B\",\"B\",\"B\"],%s}", more[i]);
        assert_int_equal(reads_again(write_text("more.fold", text)), 5);
    }
}

/* Fold angles of at most pi degrees are taken for radians, as some programs write them; but not where this one wrote them. */
static void few_degrees_stay_degrees(void **state)
{
    (void)state;
    const char *in = write_text("few.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><path stroke=\"#000\" d=\"M0 0H2V1H0Z\"/>"
                                           "<path stroke=\"#f00\" opacity=\"0.017453\" d=\"M1 0V1\"/></svg>");
    rg_lines l = read_lines(in, 0);
    const double target = l.line[4].target;
    near(target, -3.14154 * RG_DEG, 1e-7);
    rg_lines_free(&l);
    convert(in, at("few.fold"), NULL);
    l = read_lines(at("few.fold"), 0);
    int found = 0;
    for (int32_t i = 0; i < l.count; i++)
        if (l.line[i].assignment == RG_MOUNTAIN) {
            near(l.line[i].target, target, 1e-12);
            found++;
        }
    assert_int_equal(found, 1);
    rg_lines_free(&l);
}

/* XML readers take no text of more than ten million bytes. What is cut is cut between two characters, and told. */
static void long_texts_are_cut(void **state)
{
    (void)state;
    static const char head[] = "{\"vertices_coords\":[[0,0],[1,0],[0,1]],\"edges_vertices\":[[0,1],[1,2],[2,0]],\"edges_assignment\":[\"B\",\"B\",\"B\"],"
                               "\"file_description\":\"";
    const size_t bytes = 12000000, n = strlen(head);
    char *text = malloc(n + bytes + 3);
    assert_non_null(text);
    strcpy(text, head);
    for (size_t i = 0; i < bytes; i += 3) memcpy(text + n + i, "\xE6\x8A\x98", 3); /* 1,000,000 is in the midst of one */
    strcpy(text + n + bytes, "\"}");
    const char *in = write_text("long.fold", text);
    free(text);
    const told t = convert(in, at("long.opx"), NULL);
    assert_true(heard(&t, "a text is cut after 999999 bytes"));
    rg_lines l = read_lines(at("long.opx"), 0);
    assert_int_equal(strlen(l.memo), 999999);
    rg_lines_free(&l);
    assert_int_equal(reads_again(in), 5);
}

static void memory_runs_short(void **state)
{
    (void)state;
    const char *const names[] = {"m.fold", "m.svg", "m.cp"};
    write_text("plane.fold", PLANE);
    for (int i = 0; i < 3; i++) {
        rg_status status = RG_ENOMEM;
        long k = 0;
        for (; status == RG_ENOMEM; k++) {
            counted c = {.left = k};
            const rg_memory mem = {counted_resize, &c};
            rg_reading s = rg_reading_default();
            rg_diag why = {0, ""};
            s.memory = &mem;
            write_text(names[i], "old");
            status = rg_convert(at("plane.fold"), at(names[i]), RG_FORMAT_AUTO, &s, NULL, NULL, &why);
            assert_int_equal(c.out, 0);
            char *text = load(at(names[i]));
            assert_int_equal(strcmp(text, "old") == 0, status != RG_OK);
            free(text);
            if (status != RG_OK) assert_string_equal(why.text, "out of memory");
        }
        assert_int_equal(status, RG_OK);
        assert_true(k > 10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_keep_what_they_can), cmocka_unit_test(losses_are_told), cmocka_unit_test(a_chain_of_all_formats),
        cmocka_unit_test(faces), cmocka_unit_test(extras), cmocka_unit_test(as_many_edges_are_not_the_same), cmocka_unit_test(gaps), cmocka_unit_test(files_are_whole_or_not_there),
        cmocka_unit_test(what_is_written_can_be_read),
        cmocka_unit_test(few_degrees_stay_degrees), cmocka_unit_test(long_texts_are_cut), cmocka_unit_test(memory_runs_short)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
