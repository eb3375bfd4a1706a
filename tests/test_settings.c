/* base/settings.c, render/picture.c: every member of every struct that callers fill, with numbers that are none, or are out of its range.
 * The ranges are those that rigami.h tells; a member that is in no table here fails, so that none is forgotten. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "base/settings.h"
#include "base/vec.h"
#include "render/picture.h"

#include <float.h>

/* What a member holds. ANY_INT: a flag, of which every value means something. LENT: a pointer, or its context. */
typedef enum kind { SIZE, LENT, BYTES, ANY_INT, INT, DOUBLE } kind;

typedef struct member {
    const char *name;
    size_t at, bytes;
    kind kind;
    double low, high; /* the range, both ends in it */
    int open;         /* non-zero: but for the lower end */
    double besides;   /* one more value; low: none */
} member;

#define AT(type, m) #m, offsetof(type, m), sizeof(((type *)NULL)->m)
#define FLAG(type, m) {AT(type, m), ANY_INT, 0, 0, 0, 0}
#define BORROWED(type, m) {AT(type, m), LENT, 0, 0, 0, 0}
#define WHOLE(type, m, low, high) {AT(type, m), INT, low, high, 0, low}
#define REAL(type, m, low, high) {AT(type, m), DOUBLE, low, high, 0, low}
static const double PI = 3.14159265358979323846;
enum { LARGEST = 512 };

/* ------------------------------------------------------------------------------------------------ the tables ---- */

static const member SETTINGS[] = {
    {AT(rg_settings, size), SIZE, 0, 0, 0, 0},
    BORROWED(rg_settings, memory),
    WHOLE(rg_settings, triangulate, 0, RG_TRIANGULATE_ALL),
    {AT(rg_settings, adjust), DOUBLE, 0, 1, 0, RG_ADJUST_AUTO},
    WHOLE(rg_settings, contact, 0, RG_CONTACT_IGNORE),
    WHOLE(rg_settings, effort, 0, RG_EFFORT_THOROUGH),
    WHOLE(rg_settings, layer_order, -1, INT32_MAX),
    WHOLE(rg_settings, symmetry, 0, RG_SYMMETRY_OFF),
    WHOLE(rg_settings, method, 0, RG_METHOD_ADAPTIVE),
    WHOLE(rg_settings, solver, 0, RG_SOLVER_SVD),
    REAL(rg_settings, step, 1e-7, PI),
    REAL(rg_settings, tol, 1e-13, 0.1),
    REAL(rg_settings, to, -1, 1),
    FLAG(rg_settings, rest),
    WHOLE(rg_settings, frames, 2, INT32_MAX),
    WHOLE(rg_settings, pace, 0, RG_PACE_STEADY),
    WHOLE(rg_settings, threads, 0, INT32_MAX),
    WHOLE(rg_settings, fixed_facet, -1, INT32_MAX),
};

static const member READING[] = {
    {AT(rg_reading, size), SIZE, 0, 0, 0, 0},
    BORROWED(rg_reading, memory),
    REAL(rg_reading, merge, 0, 0.1),
    FLAG(rg_reading, aux_creases),
    FLAG(rg_reading, targets),
    WHOLE(rg_reading, format, 0, RG_FORMAT_ORI),
    WHOLE(rg_reading, file_frame, -1, INT32_MAX),
    FLAG(rg_reading, flip),
    BORROWED(rg_reading, kind),
    WHOLE(rg_reading, kinds, 0, 0), /* none where there is no list */
    WHOLE(rg_reading, sheet, 0, INT32_MAX),
    REAL(rg_reading, unit, 0, 1e9),
    BORROWED(rg_reading, progress),
    BORROWED(rg_reading, progress_ctx),
};

static const member PICTURE[] = {
    {AT(rg_picture, size), SIZE, 0, 0, 0, 0},
    WHOLE(rg_picture, width, 1, 16384),
    WHOLE(rg_picture, height, 1, 16384),
    FLAG(rg_picture, aimed),
    REAL(rg_picture, azimuth, -DBL_MAX, DBL_MAX),
    REAL(rg_picture, elevation, -DBL_MAX, DBL_MAX),
    {AT(rg_picture, zoom), DOUBLE, 0, 1000, 1, 0},
    FLAG(rg_picture, targeted),
    {"target[0]", offsetof(rg_picture, target), sizeof(double), DOUBLE, -DBL_MAX, DBL_MAX, 0, 0},
    {"target[1]", offsetof(rg_picture, target) + sizeof(double), sizeof(double), DOUBLE, -DBL_MAX, DBL_MAX, 0, 0},
    {AT(rg_picture, front), BYTES, 0, 0, 0, 0},
    {AT(rg_picture, back), BYTES, 0, 0, 0, 0},
    {AT(rg_picture, background), BYTES, 0, 0, 0, 0},
    WHOLE(rg_picture, lines, 0, RG_LINES_EDGES),
    REAL(rg_picture, line_width, 0.1, 10),
    REAL(rg_picture, see_through, 0, 0.9),
    FLAG(rg_picture, shadow),
    FLAG(rg_picture, caption),
    BORROWED(rg_picture, title),
    BORROWED(rg_picture, image),
    WHOLE(rg_picture, colour, 0, RG_COLOUR_LAYER),
    REAL(rg_picture, fps, 0.01, 1000),
    REAL(rg_picture, hold, 0, 60),
    REAL(rg_picture, thickness, 0, 1e9),
    WHOLE(rg_picture, loop, 0, RG_LOOP_ONCE),
    BORROWED(rg_picture, progress),
    BORROWED(rg_picture, progress_ctx),
    FLAG(rg_picture, resume),
};

static const member DRAWING[] = {
    {AT(rg_drawing, size), SIZE, 0, 0, 0, 0},
    WHOLE(rg_drawing, vertices, 1, INT32_MAX),
    BORROWED(rg_drawing, at),
    WHOLE(rg_drawing, edges, 1, INT32_MAX),
    BORROWED(rg_drawing, ends),
    BORROWED(rg_drawing, assignment),
    BORROWED(rg_drawing, target),
    REAL(rg_drawing, unit, 0, 1e9),
    BORROWED(rg_drawing, title),
    BORROWED(rg_drawing, author),
};

static const member EXAMPLE[] = {
    {AT(rg_example, size), SIZE, 0, 0, 0, 0},
    {AT(rg_example, n), INT, 2, LARGEST, 0, 0}, /* of a Miura-ori */
    {AT(rg_example, m), INT, 2, LARGEST, 0, 0},
    {AT(rg_example, angle), DOUBLE, (10 - 1e-9) * RG_DEG, (85 + 1e-9) * RG_DEG, 0, 0}, /* rounded */
    {AT(rg_example, side), DOUBLE, 1e-9, 1e9, 0, 0},
    {AT(rg_example, cell), DOUBLE, 1e-9, 1e9, 0, 0},
    {AT(rg_example, unit), DOUBLE, 1e-9, 1e9, 0, 0},
    WHOLE(rg_example, format, 0, RG_FORMAT_DXF), /* those that are written */
    BORROWED(rg_example, memory),
};

/* ------------------------------------------------------------------------------------------- what takes them ---- */

static rg_status take_settings(const void *s, rg_diag *why)
{
    rg_settings out;
    return rg_settings_take(s, &out, why);
}

static rg_status take_reading(const void *s, rg_diag *why)
{
    rg_reading out;
    return rg_reading_take(s, &out, why);
}

static rg_status take_picture(const void *s, rg_diag *why)
{
    rg_picture out;
    return rg_picture_take(s, &out, why);
}

static rg_status take_drawing(const void *s, rg_diag *why)
{
    rg_drawing out;
    return rg_drawing_take(s, &out, why);
}

/* Nothing but the folder is wrong then. */
static rg_status take_example(const void *e, rg_diag *why)
{
    const rg_status s = rg_example_write("miura", e, "/nowhere/x.opx", why);
    return s == RG_EWRITE ? RG_OK : s;
}

static rg_pattern *square(void)
{
    static const double at[4][2] = {{0, 0}, {1.25, 0}, {1.25, 1}, {0, 1}};
    static const int32_t ends[5][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
    rg_drawing d = rg_drawing_default();
    rg_pattern *p = NULL;
    d.vertices = 4, d.edges = 5, d.at = at, d.ends = ends, d.assignment = "BBBBV";
    assert_int_equal(rg_pattern_create(&d, NULL, &p, NULL), RG_OK);
    return p;
}

static rg_motion *folded(const rg_pattern *p)
{
    rg_settings s = rg_settings_default();
    rg_motion *m = NULL;
    s.frames = 2;
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
    return m;
}

static int no_bytes(void *ctx, const void *bytes, size_t size)
{
    (void)ctx, (void)bytes, (void)size;
    fail_msg("something is written");
    return 1;
}
static const rg_sink NOWHERE = {no_bytes, NULL};

/* Each public function that takes the struct, which it is to refuse: untouched results, a sentence. */
static void settings_are_refused(const void *bad)
{
    rg_pattern *p = square();
    const rg_pattern *states[2] = {p, p};
    const rg_driven driven = {4, 0.5};
    rg_motion *m = NULL;
    rg_fold *f = NULL;
    rg_chart *c = NULL;
    rg_diag why[6] = {{0, ""}};
    assert_int_equal(rg_motion_create(p, bad, NULL, NULL, &m, &why[0]), RG_EARG);
    assert_int_equal(rg_motion_create_driven(p, 1, &driven, bad, NULL, NULL, &m, &why[1]), RG_EARG);
    assert_int_equal(rg_motion_create_states(states, 2, bad, NULL, NULL, &m, &why[2]), RG_EARG);
    assert_int_equal(rg_fold_create(p, bad, NULL, NULL, &f, &why[3]), RG_EARG);
    assert_int_equal(rg_fold_create_flat(p, bad, &f, &why[4]), RG_EARG);
    assert_int_equal(rg_chart_create(p, bad, NULL, NULL, &c, &why[5]), RG_EARG);
    for (int k = 0; k < 6; k++) assert_true(why[k].text[0]);
    assert_true(!m && !f && !c);
    rg_pattern_destroy(p);
}

static void reading_is_refused(const void *bad)
{
    static const double at[3][2] = {{0, 0}, {1.25, 0}, {0.5, 1}};
    static const int32_t ends[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    static const char text[] = "1 0 0 1 0\n1 1 0 0 1\n1 0 1 0 0\n";
    rg_drawing d = rg_drawing_default();
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    rg_diag why[7] = {{0, ""}};
    d.vertices = 3, d.edges = 3, d.at = at, d.ends = ends, d.assignment = "BBB";
    assert_int_equal(rg_pattern_create(&d, bad, &p, &why[0]), RG_EARG);
    assert_int_equal(rg_pattern_read("patterns/bird.opx", bad, &p, &why[1]), RG_EARG);
    assert_int_equal(rg_pattern_parse(text, sizeof text - 1, bad, &p, &why[2]), RG_EARG);
    assert_int_equal(rg_generate_pattern("miura", 2, 0, 0, bad, &p, &why[3]), RG_EARG);
    assert_int_equal(rg_motion_read("patterns/bird.opx", bad, &m, &why[4]), RG_EARG);
    assert_int_equal(rg_convert("patterns/bird.opx", "/nowhere/x.cp", RG_FORMAT_CP, bad, NULL, NULL, &why[5]), RG_EARG);
    assert_int_equal(rg_convert_to(text, sizeof text - 1, RG_FORMAT_CP, &NOWHERE, bad, NULL, NULL, &why[6]), RG_EARG);
    for (int k = 0; k < 7; k++) assert_true(why[k].text[0]);
    assert_true(!p && !m);
}

static void picture_is_refused(const void *bad)
{
    rg_pattern *p = square();
    rg_motion *m = folded(p);
    rg_fold *f = NULL;
    rg_diag why[4] = {{0, ""}};
    unsigned char rgb = 77;
    assert_int_equal(rg_fold_create_flat(p, NULL, &f, NULL), RG_OK);
    assert_int_equal(rg_motion_draw(m, 0, bad, &rgb, &why[0]), RG_EARG);
    assert_int_equal(rg_fold_draw(f, bad, &rgb, &why[1]), RG_EARG);
    assert_int_equal(rg_motion_write(m, "/nowhere/x.obj", bad, &why[2]), RG_EARG);
    assert_int_equal(rg_motion_write_to(m, ".obj", -1, &NOWHERE, bad, &why[3]), RG_EARG);
    for (int k = 0; k < 4; k++) assert_true(why[k].text[0]);
    assert_int_equal(rgb, 77);
    rg_fold_destroy(f);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
}

static void drawing_is_refused(const void *bad)
{
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    assert_int_equal(rg_pattern_create(bad, NULL, &p, &why), RG_EARG);
    assert_true(why.text[0]);
    assert_null(p);
}

static void example_is_refused(const void *bad)
{
    rg_diag why = {0, ""};
    assert_int_equal(rg_example_write("miura", bad, "/nowhere/x.opx", &why), RG_EARG);
    assert_true(why.text[0]);
}

/* ------------------------------------------------------------------------------------------------- each of all ---- */

typedef struct kind_of_struct {
    const char *name;
    const member *member;
    int members;
    size_t size;
    rg_status (*take)(const void *s, rg_diag *why);
    void (*refused)(const void *bad);
} kind_of_struct;

#define STRUCT(type, list, take, refused) {#type, list, sizeof(list) / sizeof *(list), sizeof(type), take, refused}
static const kind_of_struct KINDS[] = {
    STRUCT(rg_settings, SETTINGS, take_settings, settings_are_refused),
    STRUCT(rg_reading, READING, take_reading, reading_is_refused),
    STRUCT(rg_picture, PICTURE, take_picture, picture_is_refused),
    STRUCT(rg_drawing, DRAWING, take_drawing, drawing_is_refused),
    STRUCT(rg_example, EXAMPLE, take_example, example_is_refused),
};
enum { KINDS_HERE = sizeof KINDS / sizeof *KINDS };

typedef union any_struct {
    rg_settings settings;
    rg_reading reading;
    rg_picture picture;
    rg_drawing drawing;
    rg_example example;
} any_struct;

/* In range, but for what is in arrays, which are so long. */
enum { ROOM = 1 };
static void usual(int k, any_struct *s)
{
    static const double at[ROOM][2] = {{0, 0}};
    static const int32_t ends[ROOM][2] = {{0, 0}};
    switch (k) {
    case 0: s->settings = rg_settings_default(); break;
    case 1: s->reading = rg_reading_default(); break;
    case 2:
        s->picture = rg_picture_default();
        s->picture.targeted = s->picture.aimed = 1;
        break;
    case 4: s->example = rg_example_default(); break;
    default:
        s->drawing = rg_drawing_default();
        s->drawing.vertices = 1, s->drawing.at = at, s->drawing.edges = 1, s->drawing.ends = ends, s->drawing.assignment = "B";
    }
}

/* Padding is at most seven bytes, and less than the member after it is aligned to. */
static void no_member_is_left_out(void **state)
{
    (void)state;
    for (int k = 0; k < KINDS_HERE; k++) {
        const kind_of_struct *s = &KINDS[k];
        size_t end = 0;
        for (int i = 0; i < s->members; i++) {
            const member *m = &s->member[i];
            const size_t align = m->kind == BYTES ? 1 : m->bytes;
            if (m->at != (end + align - 1) / align * align) fail_msg("%s: before %s there is a member that this test does not know", s->name, m->name);
            end = m->at + m->bytes;
        }
        if (s->size != (end + 7) / 8 * 8) fail_msg("%s: its last member is not %s", s->name, s->member[s->members - 1].name);
    }
}

static int is_in(const member *m, double x)
{
    if (x == m->besides && !m->open) return 1;
    return m->open ? x > m->low && x <= m->high : x >= m->low && x <= m->high;
}

static void put(any_struct *s, const member *m, double x)
{
    const int whole = (int)x;
    if (m->kind == DOUBLE) memcpy((char *)s + m->at, &x, sizeof x);
    else memcpy((char *)s + m->at, &whole, sizeof whole);
}

/* Values of all kinds, and those on either side of both ends of the range. */
static void numbers_in_and_out_of_range(void **state)
{
    (void)state;
    int refused = 0, taken = 0;
    for (int k = 0; k < KINDS_HERE; k++)
        for (int i = 0; i < KINDS[k].members; i++) {
            const member *m = &KINDS[k].member[i];
            if (m->kind < ANY_INT) continue;
            double x[16] = {NAN, INFINITY, -INFINITY, -1, 1e300, -1e300, -0.0, 1e-300, -1e-300, m->low, m->high, m->besides,
                            nextafter(m->low, -INFINITY), nextafter(m->high, INFINITY), nextafter(m->low, INFINITY), -1.5};
            int n = 16;
            if (m->kind != DOUBLE) {
                const double whole[] = {-1, -2, INT32_MAX, INT32_MIN, 0, 1, m->low, m->high, fmax(m->low - 1, INT32_MIN), fmin(m->high + 1, INT32_MAX)};
                memcpy(x, whole, sizeof whole);
                n = 10;
            }
            for (int j = 0; j < n; j++) {
                any_struct s;
                rg_diag why = {0, ""};
                if (KINDS[k].member == DRAWING && m->kind == INT && x[j] > ROOM) continue;
                if (KINDS[k].member == EXAMPLE && x[j] == LARGEST) continue; /* which takes its time */
                usual(k, &s);
                put(&s, m, x[j]);
                const int in = m->kind == ANY_INT || is_in(m, x[j]);
                const rg_status status = KINDS[k].take(&s, &why);
                if (status != (in ? RG_OK : RG_EARG)) fail_msg("%s.%s = %g: %s", KINDS[k].name, m->name, x[j], rg_status_text(status));
                if (!in) assert_true(why.text[0]);
                if (!in) KINDS[k].refused(&s);
                refused += !in, taken += in;
            }
        }
    print_message("%d numbers refused, %d taken\n", refused, taken);
    assert_true(refused > 200 && taken > 150);
}

/* A size of nothing, of a part, of more than is known; and no name for it but that. */
static void sizes(void **state)
{
    (void)state;
    for (int k = 0; k < KINDS_HERE; k++) {
        const size_t bad[] = {0, 1, KINDS[k].size - 1, KINDS[k].size + 1, 100000, SIZE_MAX};
        for (int j = 0; j < 6; j++) {
            any_struct s;
            usual(k, &s);
            memcpy(&s, &bad[j], sizeof bad[j]);
            KINDS[k].refused(&s);
        }
    }
}

/* A camera that does not count need not be one. */
static void what_does_not_count_is_not_looked_at(void **state)
{
    (void)state;
    rg_picture p = rg_picture_default(), out;
    p.target[0] = NAN;
    assert_int_equal(rg_picture_take(&p, &out, NULL), RG_OK);
    p.targeted = 1;
    assert_int_equal(rg_picture_take(&p, &out, NULL), RG_EARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_member_is_left_out), cmocka_unit_test(numbers_in_and_out_of_range), cmocka_unit_test(sizes),
                                       cmocka_unit_test(what_does_not_count_is_not_looked_at)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
