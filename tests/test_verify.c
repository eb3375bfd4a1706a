/* verify/: motions of our own are found to be what they are, and what was done to one is found out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "near.h"

#include "counted.h"
#include "rigami.h"
#include "written.h"

/* Free of crossing, and folded flat at the end. */
static const char *const names[] = {"bird", "fish", "preliminary", "waterbomb-base", "tatou", "open-sink", "miura"};
enum { NAMES = sizeof names / sizeof *names };

static json_t *motion[NAMES];
static char written[300];

static rg_pattern *pattern_named(const char *name)
{
    char path[200];
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    snprintf(path, sizeof path, "patterns/%s.opx", name);
    if (rg_pattern_read(path, NULL, &p, &why) != RG_OK) fail_msg("%s: %s", path, why.text);
    return p;
}

static void write_json(const json_t *j) { assert_int_equal(json_dump_file(j, written, JSON_REAL_PRECISION(17)), 0); }

/* What is found of the file; `given` NULL: of any pattern. */
static rg_certificate *judge(const rg_pattern *given)
{
    rg_certificate *c = NULL;
    rg_diag why = {0, ""};
    if (rg_certificate_create(written, given, NULL, &c, &why) != RG_OK) fail_msg("%s", why.text);
    return c;
}

/* text: out, of the first fault, and its frame; "" where there is none. */
static int is_valid(const json_t *j, char text[200], int *frame)
{
    const rg_fault *list;
    rg_certificate_info info;
    write_json(j);
    rg_certificate *c = judge(NULL);
    info = *rg_certificate_get_info(c);
    const int32_t n = rg_certificate_faults(c, &list);
    snprintf(text, 200, "%s", n > 0 ? list[0].text : "");
    *frame = n > 0 ? list[0].frame : -1;
    rg_certificate_destroy(c);
    assert_int_equal(info.valid, n == 0);
    return info.valid;
}

static int is_refused(const json_t *j)
{
    char text[200];
    int frame;
    return !is_valid(j, text, &frame);
}

static void fold(int n, rg_settings s)
{
    rg_diag why = {0, ""};
    rg_motion *m = NULL;
    rg_pattern *p = pattern_named(names[n]);
    if (rg_motion_create(p, &s, NULL, NULL, &m, &why) != RG_OK) fail_msg("%s: %s", names[n], why.text);
    if (rg_motion_write(m, written, NULL, &why) != RG_OK) fail_msg("%s: %s", written, why.text);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
}

static int set_up(void **state)
{
    if (written_begin(state) != 0) return -1;
    written_path("motion.fold", written);
    for (int n = 0; n < NAMES; n++) {
        fold(n, rg_settings_default());
        motion[n] = json_load_file(written, 0, NULL);
        if (!motion[n]) return -1;
    }
    return 0;
}

static int tear_down(void **state)
{
    for (int n = 0; n < NAMES; n++) json_decref(motion[n]);
    return written_end(state);
}

static int whole(unsigned *seed, int n) { return (int)((noise(seed) + 1) / 2 * n); }

static json_t *frames_of(json_t *j) { return json_object_get(j, "file_frames"); }
static json_t *last_of(json_t *j) { return json_array_get(frames_of(j), json_array_size(frames_of(j)) - 1); }

static double size_of(const json_t *j)
{
    double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
    const json_t *x;
    size_t i;
    json_array_foreach(json_object_get(j, "vertices_coords"), i, x)
        for (size_t k = 0; k < 2; k++) {
            low[k] = fmin(low[k], json_number_value(json_array_get(x, k)));
            high[k] = fmax(high[k], json_number_value(json_array_get(x, k)));
        }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

/* ---------------------------------------------------------------------------------- as it is ---- */

static void motions_are_valid(void **state)
{
    (void)state;
    for (int n = 0; n < NAMES; n++) {
        rg_certificate_info info;
        rg_pattern *p = pattern_named(names[n]);
        write_json(motion[n]);
        rg_certificate *c = judge(p);
        const rg_fault *list;
        if (rg_certificate_faults(c, &list) > 0)
            fail_msg("%s, frame %d: %s", names[n], (int)list[0].frame, list[0].text);
        info = *rg_certificate_get_info(c);
        assert_true(info.valid && info.ends_flat && info.layer_pairs > 5);
        assert_int_equal(info.frames, 60);
        assert_int_equal(info.faults, 0);
        below(info.max_rigid, 1e-10);
        below(info.max_sheet, 1e-10);
        below(info.max_closure, 1e-9);
        below(info.between_depth, 1e-3);
        near(info.contact_depth, 0, 0);
        rg_certificate_destroy(c);
        rg_pattern_destroy(p);
    }
}

/* Frames that are few, the other way round, half the way: all of them are motions. */
static void other_ways_are_valid(void **state)
{
    (void)state;
    char why[200];
    int frame;
    for (int k = 0; k < 3; k++) {
        rg_settings s = rg_settings_default();
        s.to = k == 0 ? -1 : k == 1 ? 0.5 : 1;
        s.frames = k == 2 ? 150 : 60;
        fold(0, s);
        json_t *j = json_load_file(written, 0, NULL);
        if (!is_valid(j, why, &frame)) fail_msg("%d: %s", k, why);
        json_decref(j);
    }
}

/* The waterbomb tessellation goes through itself. */
static void crossing_is_refused(void **state)
{
    (void)state;
    rg_diag why = {0, ""};
    rg_pattern *p = pattern_named("waterbomb");
    rg_motion *m = NULL;
    rg_settings s = rg_settings_default();
    s.contact = RG_CONTACT_REPORT; /* the motion that crosses, not one that was found to be free */
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, &why), RG_OK);
    assert_int_equal(rg_motion_write(m, written, NULL, &why), RG_OK);
    rg_certificate *c = judge(p);
    rg_certificate_info info;
    info = *rg_certificate_get_info(c);
    assert_false(info.valid);
    near(info.contact_depth, rg_motion_report(m)->contact_depth, 1e-9);
    const rg_fault *list;
    assert_true(rg_certificate_faults(c, &list) > 0);
    assert_int_equal(list[0].frame, rg_motion_report(m)->first_contact_frame);
    assert_non_null(strstr(list[0].text, "cross"));
    rg_certificate_destroy(c);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
}

static void another_pattern_is_refused(void **state)
{
    (void)state;
    rg_pattern *fish = pattern_named("fish");
    write_json(motion[0]);
    rg_certificate *c = judge(fish);
    rg_certificate_info info;
    info = *rg_certificate_get_info(c);
    assert_false(info.valid);
    rg_certificate_destroy(c);
    rg_pattern_destroy(fish);
}

/* Two flaps on both sides of a square, turned up by angles in degrees. */
static void add_frame(json_t *frames, double left, double right)
{
    const double deg = 3.14159265358979323846 / 180, c = cos(left * deg), s = sin(left * deg), d = cos(right * deg),
        t = sin(right * deg);
    const double x[8][3] = {{1 - c, 0, s}, {1, 0, 0}, {2, 0, 0}, {2 + d, 0, t}, {2 + d, 1, t}, {2, 1, 0}, {1, 1, 0},
                            {1 - c, 1, s}};
    json_t *all = json_array();
    for (int v = 0; v < 8; v++) json_array_append_new(all, json_pack("[fff]", x[v][0], x[v][1], x[v][2]));
    json_array_append_new(frames, json_pack("{so s[iiiiiiiiff] sf}", "vertices_coords", all, "edges_foldAngle", 0, 0, 0,
                                            0, 0, 0, 0, 0, left, right,
                                            "rigami:percent", (left + right) / 3.6));
}

/* Of no frame yet. */
static json_t *flaps(void)
{
    json_t *j =
        json_pack("{s[[ii][ii][ii][ii][ii][ii][ii][ii]] s[[ii][ii][ii][ii][ii][ii][ii][ii][ii][ii]] s[ssssssssss] "
                  "s[iiiiiiiiii] s[[iiii][iiii][iiii]] s[]}",
                          "vertices_coords", 0, 0, 1, 0, 2, 0, 3, 0, 3, 1, 2, 1, 1, 1, 0, 1, "edges_vertices", 0, 1, 1,
                              2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7,
                          7, 0, 1, 6, 2, 5, "edges_assignment", "B", "B", "B", "B", "B", "B", "B", "B", "V", "V",
                              "edges_foldAngle", 0, 0, 0, 0, 0,
                          0, 0, 0, 180, 180, "faces_vertices", 0, 1, 6, 7, 1, 2, 5, 6, 2, 3, 4, 5, "file_frames");
    assert_non_null(j);
    return j;
}

/* One flap down, the other over it; and then, at once, the other way round, though neither state crosses. */
static void passing_between_frames_is_found(void **state)
{
    (void)state;
    char text[200];
    int frame;
    json_t *j = flaps();
    for (int k = 0; k <= 11; k++) add_frame(frames_of(j), 15 * k, 0);
    for (int k = 1; k <= 17; k++) add_frame(frames_of(j), 165, 5 * k);
    if (!is_valid(j, text, &frame)) fail_msg("frame %d: %s", frame, text);
    add_frame(frames_of(j), 85, 165);
    assert_false(is_valid(j, text, &frame));
    assert_non_null(strstr(text, "pass through each other"));
    assert_int_equal(frame, 29);
    json_decref(j);
}

/* The first frame with a fault that says so; -1: none. */
static int frame_of_fault(const json_t *j, const char *what)
{
    const rg_fault *list;
    int frame = -1;
    write_json(j);
    rg_certificate *c = judge(NULL);
    for (int32_t n = rg_certificate_faults(c, &list), i = 0; i < n && frame < 0; i++)
        if (strstr(list[i].text, what)) frame = list[i].frame;
    rg_certificate_destroy(c);
    return frame;
}

/* One flap down, the other over it, and both flat; then the lower one is lifted, through the upper one, of which
 * neither that state nor the way to it shows anything. It is known from how they came to lie, however long ago. */
static void layers_that_change_places_are_found(void **state)
{
    (void)state;
    for (int first = 0; first < 2; first++) /* the one that lies below */
        for (int lifted = 0; lifted < 2; lifted++) {
            json_t *j = flaps();
            for (int k = 0; k <= 24; k++) {
                const int a = 15 * (k < 12 ? k : 12), b = 15 * (k > 12 ? k - 12 : 0);
                add_frame(frames_of(j), first ? b : a, first ? a : b);
            }
            for (int k = 0; k < 3; k++) add_frame(frames_of(j), 180, 180);
            for (int k = 1; k < 4; k++)
                add_frame(frames_of(j), lifted ? 180 : 180 - 15 * k, lifted ? 180 - 15 * k : 180);
            assert_int_equal(frame_of_fault(j, "the other way round"), first == lifted ? 28 : -1);
            assert_int_equal(frame_of_fault(j, "cross"), -1);
            assert_int_equal(frame_of_fault(j, "pass through"), -1);
            json_decref(j);
        }
}

/* ---------------------------------------------------------------------------------- mutated ---- */

enum { TIMES = 100 };

static void a_moved_vertex_is_found(void **state)
{
    (void)state;
    unsigned seed = 41;
    for (int k = 0; k < TIMES; k++) {
        json_t *j = json_deep_copy(motion[k % NAMES]), *frame = json_array_get(frames_of(j), (size_t)whole(&seed, 60));
        json_t *all = json_object_get(frame, "vertices_coords"),
            *x = json_array_get(all, (size_t)whole(&seed, (int)json_array_size(all)));
        double d[3] = {noise(&seed), noise(&seed), noise(&seed)};
        const double by = 1e-3 * size_of(j) / sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (size_t i = 0; i < 3; i++)
            json_array_set_new(x, i, json_real(json_number_value(json_array_get(x, i)) + by * d[i]));
        assert_true(is_refused(j));
        json_decref(j);
    }
}

/* A file of two frames has what lies between them, and is known as well by it; what is done to that is found out, too. */
static void what_lies_between_frames_is_looked_at(void **state)
{
    (void)state;
    unsigned seed = 53;
    char text[200];
    int frame;
    rg_certificate_info info;
    for (int n = 0; n < NAMES; n++) {
        rg_settings s = rg_settings_default();
        s.frames = 2;
        fold(n, s);
        rg_certificate *c = judge(NULL);
        info = *rg_certificate_get_info(c);
        rg_certificate_destroy(c);
        assert_true(info.valid);
        assert_int_equal(info.frames, 2);
        assert_true(info.between >= 40);
        assert_true(info.max_leap_deg <= 5 + 1e-9);
        json_t *j = json_load_file(written, 0, NULL), *between = json_object_get(json_array_get(frames_of(j), 0), "rigami:between");
        assert_int_equal(json_array_size(between), info.between);
        for (int k = 0; k < 10; k++) {
            json_t *bad = json_deep_copy(j), *of = json_object_get(json_array_get(frames_of(bad), 0), "rigami:between");
            json_t *all = json_object_get(json_array_get(of, (size_t)whole(&seed, info.between)), "vertices_coords");
            json_t *x = json_array_get(all, (size_t)whole(&seed, (int)json_array_size(all)));
            json_array_set_new(x, 2, json_real(json_number_value(json_array_get(x, 2)) + 1e-3 * size_of(j)));
            assert_false(is_valid(bad, text, &frame));
            assert_int_equal(frame, 1);
            assert_non_null(strstr(text, "(in a state before that frame)"));
            json_decref(bad);
        }
        json_t *last = json_array_get(frames_of(j), 1);
        json_object_set(last, "rigami:between", between);
        assert_false(is_valid(j, text, &frame));
        json_object_del(last, "rigami:between");
        assert_true(is_valid(j, text, &frame));
        json_object_del(json_array_get(frames_of(j), 0), "rigami:between");
        assert_false(is_valid(j, text, &frame));
        assert_non_null(strstr(text, "leap"));
        json_decref(j);
    }
}

static void exchanged_frames_are_found(void **state)
{
    (void)state;
    unsigned seed = 43;
    for (int k = 0; k < TIMES; k++) {
        json_t *j = json_deep_copy(motion[k % NAMES]), *frames = frames_of(j);
        const int a = whole(&seed, 60), b = (a + 1 + whole(&seed, 59)) % 60;
        json_t *x = json_incref(json_array_get(frames, (size_t)a)), *y = json_incref(json_array_get(frames, (size_t)b));
        if (k % 2) { /* what they hold is exchanged, not what they say of how far they are */
            json_t *p = json_incref(json_object_get(x, "rigami:percent")),
                *q = json_incref(json_object_get(y, "rigami:percent"));
            json_object_set_new(x, "rigami:percent", q);
            json_object_set_new(y, "rigami:percent", p);
        }
        json_array_set_new(frames, (size_t)a, y);
        json_array_set_new(frames, (size_t)b, x);
        assert_true(is_refused(j));
        json_decref(j);
    }
}

static void a_reversed_order_is_found(void **state)
{
    (void)state;
    unsigned seed = 47;
    int missed = 0;
    for (int k = 0; k < TIMES; k++) {
        json_t *j = json_deep_copy(motion[k % NAMES]), *all = json_object_get(last_of(j), "faceOrders");
        assert_true(json_array_size(all) > 0);
        json_t *row = json_array_get(all, (size_t)whole(&seed, (int)json_array_size(all)));
        json_array_set_new(row, 2, json_integer(-json_integer_value(json_array_get(row, 2))));
        if (!is_refused(j)) {
            missed++;
            print_error("%s: the order of %d and %d\n", names[k % NAMES],
                        (int)json_integer_value(json_array_get(row, 0)),
                        (int)json_integer_value(json_array_get(row, 1)));
        }
        json_decref(j);
    }
    assert_int_equal(missed, 0);
}

/* Other things that may be done to a file. */
static void other_changes_are_found(void **state)
{
    (void)state;
    unsigned seed = 53;
    for (int k = 0; k < TIMES; k++) {
        json_t *j = json_deep_copy(motion[k % NAMES]), *frame = json_array_get(frames_of(j),
                                                                               (size_t)(5 + whole(&seed, 50)));
        json_t *letters = json_object_get(j, "edges_assignment"), *angles = json_object_get(frame, "edges_foldAngle");
        size_t e;
        do e = (size_t)whole(&seed, (int)json_array_size(letters));
        while (!strchr("MV", json_string_value(json_array_get(letters, e))[0]));
        switch (k / NAMES % 5) {
        case 0: json_array_set_new(angles, e, json_real(json_number_value(json_array_get(angles, e)) + 0.1)); break;
        case 1: json_array_set_new(letters, e, json_string(json_string_value(json_array_get(letters, e))[0] == 'M' ? "V"
                                                           : "M")); break;
        case 2: json_object_del(last_of(j), "faceOrders"); break;
        case 3: json_array_set_new(json_object_get(j, "faces_vertices"), 0,
                                   json_deep_copy(json_array_get(json_object_get(j, "faces_vertices"), 1))); break;
        case 4: { /* a sheet that is another one in this frame */
            json_t *flat = json_deep_copy(json_object_get(j, "vertices_coords")), *x = json_array_get(flat, 0);
            json_array_set_new(x, 0, json_real(json_number_value(json_array_get(x, 0)) + 1e-3 * size_of(j)));
            json_object_set_new(frame, "rigami:vertices_flatCoords", flat);
        }
        }
        assert_true(is_refused(j));
        json_decref(j);
    }
}

/* A disc that goes twice round its middle has a border, flat facets and corners that close, and is no sheet. */
static void what_no_flat_sheet_is_is_found(void **state)
{
    (void)state;
    enum { AROUND = 8 };
    static const int at[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0, 0}};
    char text[200];
    int frame;
    json_t *flat = json_array(), *ends = json_array(), *letters = json_array(), *angles = json_array(),
           *facets = json_array(), *places = json_array();
    for (int v = 0; v <= AROUND; v++) {
        const int *x = v < AROUND ? at[v % 4] : at[4];
        json_array_append_new(flat, json_pack("[ii]", x[0], x[1]));
        json_array_append_new(places, json_pack("[iii]", x[0], x[1], 0));
    }
    for (int e = 0; e < 2 * AROUND; e++) {
        json_array_append_new(ends, e < AROUND ? json_pack("[ii]", AROUND, e)
                                               : json_pack("[ii]", e - AROUND, (e + 1) % AROUND));
        json_array_append_new(letters, json_string(e < AROUND ? "F" : "B"));
        json_array_append_new(angles, json_integer(0));
        if (e < AROUND) json_array_append_new(facets, json_pack("[iii]", AROUND, e, (e + 1) % AROUND));
    }
    json_t *j = json_pack("{s:o, s:o, s:o, s:O, s:o, s:[{s:O, s:o}, {s:o, s:o}]}", "vertices_coords", flat,
                          "edges_vertices", ends, "edges_assignment", letters, "edges_foldAngle", angles,
                          "faces_vertices", facets, "file_frames", "vertices_coords", places, "edges_foldAngle",
                          json_deep_copy(angles), "vertices_coords", json_deep_copy(places), "edges_foldAngle", angles);
    json_decref(places);
    assert_non_null(j);
    assert_false(is_valid(j, text, &frame));
    assert_string_equal(text, "lie over each other in the pattern");
    json_decref(j);
    /* One facet as a star of five points. */
    json_t *star = json_pack("{s:[[ii],[ii],[ii],[ii],[ii]], s:[[ii],[ii],[ii],[ii],[ii]], s:[sssss], s:[iiiii], "
                             "s:[[iiiii]], s:[{s:[[iii],[iii],[iii],[iii],[iii]], s:[iiiii]}]}",
                             "vertices_coords", 10, 0, -8, 6, 3, -9, 3, 9, -8, -6, "edges_vertices", 0, 1, 1, 2, 2, 3, 3,
                             4, 4, 0, "edges_assignment", "B", "B", "B", "B", "B", "edges_foldAngle", 0, 0, 0, 0, 0,
                             "faces_vertices", 0, 1, 2, 3, 4, "file_frames", "vertices_coords", 10, 0, 0, -8, 6, 0, 3,
                             -9, 0, 3, 9, 0, -8, -6, 0, "edges_foldAngle", 0, 0, 0, 0, 0);
    assert_non_null(star);
    assert_false(is_valid(star, text, &frame));
    assert_string_equal(text, "is no simple polygon in the pattern");
    json_decref(star);
}

/* What is said to be added is no mountain and no valley, which would then be free to end as it likes. */
static void what_is_said_to_be_added_is_looked_at(void **state)
{
    (void)state;
    json_t *j = json_deep_copy(motion[0]), *letters = json_object_get(j, "edges_assignment"), *added = json_array();
    for (size_t e = 0; e < json_array_size(letters); e++) {
        const char *letter = json_string_value(json_array_get(letters, e));
        if (strchr("MV", letter[0])) json_array_set_new(letters, e, json_string(letter[0] == 'M' ? "V" : "M"));
        json_array_append_new(added, json_true());
    }
    json_object_set_new(j, "rigami:edges_added", added);
    assert_true(is_refused(j));
    json_decref(j);
}

/* The most that was asked for at a time. */
typedef struct asked { size_t most; } asked;

static void *asking_resize(void *ctx, void *block, size_t bytes)
{
    asked *a = ctx;
    if (bytes == 0) {
        free(block);
        return NULL;
    }
    if (bytes > a->most) a->most = bytes;
    return realloc(block, bytes);
}

/* A file that names more states than it has takes no room for them. */
static void states_that_are_not_there_take_no_room(void **state)
{
    (void)state;
    enum { STATES = 100000, MOST = 16 << 20 };
    for (int inside = 0; inside < 2; inside++) {
        json_t *j = json_deep_copy(motion[0]), *list = inside ? json_array() : frames_of(j);
        for (int k = 0; k < STATES; k++)
            json_array_append_new(list, inside ? json_integer(0) : json_pack("{s:[[ii]]}", "vertices_coords", 0, 0));
        if (inside) json_object_set_new(json_array_get(frames_of(j), 1), "rigami:between", list);
        write_json(j);
        json_decref(j);
        asked a = {0};
        const rg_memory mem = {asking_resize, &a};
        rg_certificate *c = NULL;
        rg_motion *m = NULL;
        rg_diag why = {0, ""};
        rg_reading r = rg_reading_default();
        r.memory = &mem;
        assert_int_equal(rg_certificate_create(written, NULL, &mem, &c, &why), RG_EFORMAT);
        assert_non_null(strstr(why.text, "vertices_coords"));
        if (!inside) assert_int_equal(rg_motion_read(written, &r, &m, &why), RG_EFORMAT);
        assert_true(a.most < MOST);
    }
}

/* Frames left out: what the rest shows is leaps. */
static void a_leap_is_found(void **state)
{
    (void)state;
    json_t *j = json_deep_copy(motion[0]);
    for (int k = 0; k < 56; k++) json_array_remove(frames_of(j), 2);
    assert_true(is_refused(j));
    json_decref(j);
}

static void what_is_no_motion_cannot_be_read(void **state)
{
    (void)state;
    static const char *const text[] = {"", "[]", "{}", "{\"vertices_coords\": [[0, 0]]}", "not JSON at all"};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        FILE *f = fopen(written, "w");
        assert_non_null(f);
        fputs(text[k], f);
        fclose(f);
        rg_certificate *c = NULL;
        rg_diag why = {0, ""};
        assert_int_equal(rg_certificate_create(written, NULL, NULL, &c, &why), RG_EFORMAT);
        assert_null(c);
        assert_true(why.text[0]);
    }
    rg_certificate *c = NULL;
    rg_diag why = {0, ""};
    assert_int_equal(rg_certificate_create("/nowhere/at/all.fold", NULL, NULL, &c, &why), RG_EREAD);
    /* Each key that a motion needs is missed. */
    const char *const key[] = {"vertices_coords", "edges_vertices", "edges_assignment", "edges_foldAngle",
                               "faces_vertices", "file_frames"};
    for (size_t k = 0; k < sizeof key / sizeof *key; k++) {
        json_t *j = json_deep_copy(motion[1]);
        json_object_del(j, key[k]);
        write_json(j);
        assert_int_equal(rg_certificate_create(written, NULL, NULL, &c, &why), RG_EFORMAT);
        assert_non_null(strstr(why.text, key[k]));
        json_decref(j);
    }
}

static void starves_cleanly(void **state)
{
    (void)state;
    write_json(motion[1]);
    for (long left = 0;; left += left < 60 ? 1 : 17) {
        counted count = {left, 0, 0};
        const rg_memory mem = {counted_resize, &count};
        rg_certificate *c = NULL;
        const rg_status status = rg_certificate_create(written, NULL, &mem, &c, NULL);
        rg_certificate_destroy(c);
        assert_int_equal(count.out, 0);
        if (status == RG_OK) break;
        assert_int_equal(status, RG_ENOMEM);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motions_are_valid),
        cmocka_unit_test(other_ways_are_valid),
        cmocka_unit_test(crossing_is_refused),
        cmocka_unit_test(another_pattern_is_refused),
        cmocka_unit_test(passing_between_frames_is_found),
        cmocka_unit_test(layers_that_change_places_are_found),
        cmocka_unit_test(a_moved_vertex_is_found),
        cmocka_unit_test(what_lies_between_frames_is_looked_at),
        cmocka_unit_test(exchanged_frames_are_found),
        cmocka_unit_test(a_reversed_order_is_found),
        cmocka_unit_test(other_changes_are_found),
        cmocka_unit_test(a_leap_is_found),
        cmocka_unit_test(what_no_flat_sheet_is_is_found),
        cmocka_unit_test(what_is_said_to_be_added_is_looked_at),
        cmocka_unit_test(states_that_are_not_there_take_no_room),
        cmocka_unit_test(what_is_no_motion_cannot_be_read),
        cmocka_unit_test(starves_cleanly),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
