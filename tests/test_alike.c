/* pattern/alike.c: stars of creases on regular polygons, made with known symmetries; tessellations; drawings that
 * are nearly so; real ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "corpus.h"
#include "counted.h"
#include "draw.h"
#include "near.h"

#include "base/vec.h"
#include "pattern/alike.h"

enum { PLAIN, CHIRAL, EXCHANGED, ISO_AREA };

typedef struct star { int n, kind; double turned, off; } star;

/* Where the ray at that angle meets the polygon, all turned about a point that is not the origin. */
static rg_vec2 on_rim(const star *s, double angle)
{
    const double sector = 2 * RG_PI / s->n, within = fmod(angle + 4 * RG_PI, sector) - sector / 2;
    const double r = 2.385 * cos(sector / 2) / cos(within);
    return (rg_vec2){1.25 + r * cos(angle + s->turned), -7.5 + r * sin(angle + s->turned)};
}

/* Corners at multiples of the sector, creases on both sides of them, by the kind of star. */
static rg_pattern *drawn(const star *s, const rg_memory *mem)
{
    char text[40000];
    size_t n = 0;
    const rg_vec2 o = {1.25, -7.5};
    for (int k = 0; k < s->n; k++) {
        const double corner = 2 * RG_PI * k / s->n;
        const rg_vec2 a = on_rim(s, corner), b = on_rim(s, 2 * RG_PI * (k + 1) / s->n);
        const double beside = fmin(0.21, RG_PI / s->n / 2);
        const rg_vec2 p = on_rim(s, corner + beside), q = on_rim(s, corner - beside);
        const int first = s->kind == ISO_AREA && k % 2 ? 3 : 2;
        n += (size_t)snprintf(text + n, sizeof text - n, "1 %.17g %.17g %.17g %.17g\n", a.x, a.y, b.x, b.y);
        n += (size_t)snprintf(text + n, sizeof text - n, "%d %.17g %.17g %.17g %.17g\n", first, o.x, o.y,
                              p.x + (k == 0 ? s->off : 0), p.y);
        if (s->kind == PLAIN || s->kind == EXCHANGED)
            n += (size_t)snprintf(text + n, sizeof text - n, "%d %.17g %.17g %.17g %.17g\n", s->kind == PLAIN ? 2 : 3, o.x, o.y, q.x, q.y);
    }
    rg_reading settings = rg_reading_default();
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    settings.memory = mem;
    settings.flip = 1; /* .cp has y downwards */
    if (rg_pattern_parse(text, n, &settings, &p, &why) != RG_OK) fail_msg("%s", why.text);
    return p;
}

static rg_alike alike(star s)
{
    rg_pattern *p = drawn(&s, NULL);
    rg_alike a;
    assert_int_equal(rg_alike_find(p, &a), RG_OK);
    rg_pattern_destroy(p);
    return a;
}

/* n lines, evenly spread, of which one goes through the corner at `turned`. */
static void are_mirrors(const rg_likeness *l, const star *s)
{
    assert_int_equal(l->mirrors, s->n);
    for (int32_t i = 0; i < l->mirrors && i < RG_MOST_MIRRORS; i++) {
        if (i > 0) assert_true(l->mirror[i] > l->mirror[i - 1]);
        assert_true(l->mirror[i] >= 0 && l->mirror[i] < 180);
        const double steps = (l->mirror[i] - s->turned / RG_DEG) / (180.0 / s->n);
        near(steps, round(steps), 1e-9);
    }
}

/* All creases in one, and the vertex in the middle. */
static void one_orbit(const rg_alike *a, int creases)
{
    assert_int_equal(a->order, creases);
    assert_int_equal(a->creases, 1);
    assert_int_equal(a->vertices, 1);
}

static void stars(void **state)
{
    (void)state;
    for (int n = 3; n <= 12; n++)
        for (int turned = 0; turned < 2; turned++) {
            star s = {n, PLAIN, 0.3 * turned, 0};
            rg_alike a = alike(s);
            assert_int_equal(a.same.turns, n);
            are_mirrors(&a.same, &s);
            one_orbit(&a, 2 * n);
            assert_int_equal(a.exchanged.turns + a.exchanged.mirrors, 0);

            s.kind = CHIRAL;
            a = alike(s);
            assert_int_equal(a.same.turns, n);
            assert_int_equal(a.same.mirrors + a.exchanged.turns + a.exchanged.mirrors, 0);
            one_orbit(&a, n);

            s.kind = EXCHANGED;
            a = alike(s);
            assert_int_equal(a.same.turns, n);
            assert_int_equal(a.same.mirrors + a.exchanged.turns, 0);
            are_mirrors(&a.exchanged, &s);
            one_orbit(&a, 2 * n);

            if (n % 2) continue;
            s.kind = ISO_AREA;
            a = alike(s);
            assert_int_equal(a.same.turns, n / 2);
            assert_int_equal(a.exchanged.turns, n / 2);
            assert_int_equal(a.same.mirrors + a.exchanged.mirrors, 0);
            one_orbit(&a, n);
        }
}

/* More mirrors than are listed: the first ones are, with none left out between. */
static void many(void **state)
{
    (void)state;
    const star s = {60, PLAIN, 0, 0};
    const rg_alike a = alike(s);
    assert_int_equal(a.same.turns, 60);
    are_mirrors(&a.same, &s);
    for (int32_t i = 0; i < RG_MOST_MIRRORS; i++) near(a.same.mirror[i], 3 * i, 1e-9);
    one_orbit(&a, 120);
}

static rg_alike alike_file(const char *path)
{
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    rg_alike a;
    if (rg_pattern_read(path, NULL, &p, &why) != RG_OK) fail_msg("%s: %s", path, why.text);
    assert_int_equal(rg_alike_find(p, &a), RG_OK);
    rg_pattern_destroy(p);
    return a;
}

static rg_alike alike_kind(const char *kind, int32_t n)
{
    char path[] = "/tmp/rigami-alike-XXXXXX";
    rg_diag why = {0, ""};
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    close(fd);
    if (rg_generate(kind, n, 0, 0, path, &why) != RG_OK) fail_msg("%s: %s", kind, why.text);
    const rg_alike a = alike_file(path);
    remove(path);
    return a;
}

static void leave(rg_alike a, int order, int creases, int vertices)
{
    assert_int_equal(a.order, order);
    assert_int_equal(a.creases, creases);
    assert_int_equal(a.vertices, vertices);
}

/* Counted by hand, or by Burnside's lemma: as many orbits as a symmetry leaves things where they are, in the mean. */
static void orbits(void **state)
{
    (void)state;
    leave(alike_kind("bird", 0), 4, 5, 2);           /* both diagonals are mirrors */
    leave(alike_kind("waterbomb-base", 0), 4, 2, 1); /* both middle lines: one mountain or two of them, four valleys */
    for (int n = 2; n <= 32; n += 6) {               /* one mirror, in a straight line of n creases and n - 1 vertices */
        const rg_alike a = alike_kind("miura", n);
        assert_int_equal(a.same.mirrors + a.exchanged.mirrors, 1);
        leave(a, 2, (2 * n * (n - 1) + n) / 2, ((n - 1) * (n - 1) + n - 1) / 2);
    }
}

static void real_ones(void **state)
{
    (void)state;
    char path[400];
    leave(alike_file(corpus("opx/square-fish.opx", path, sizeof path)), 2, 6, 2);
    /* A quarter turn: 12 vertices, and 36 creases, are 3 and 9 of four each. */
    const rg_alike a = alike_file(corpus("foldability/058-ku-color-change-pinwheel-1.fold", path, sizeof path));
    assert_int_equal(a.same.turns, 4);
    leave(a, 4, 9, 3);
}

/* Two creases much nearer to each other than what counts as one place: each vertex still goes to its own image. */
static void short_edges(void **state)
{
    (void)state;
    rg_lines l = drawing();
    const double x[] = {-1.25, -4e-5, 4e-5, 1.25};
    for (int i = 0; i < 3; i++)
        for (int side = 0; side < 2; side++) draw(&l, RG_BORDER, x[i], 0.7 * side, x[i + 1], 0.7 * side);
    for (int i = 0; i < 4; i++) draw(&l, i % 3 ? RG_VALLEY : RG_BORDER, x[i], 0, x[i], 0.7);
    rg_reading s = rg_reading_default();
    s.merge = 1e-9;
    rg_pattern *p = pattern_with(&l, &s);
    rg_alike a;
    assert_int_equal(rg_alike_find(p, &a), RG_OK);
    assert_int_equal(a.same.turns, 2);
    assert_int_equal(a.same.mirrors, 2);
    leave(a, 4, 1, 0);
    rg_pattern_destroy(p);
}

/* One crease that ends a little beside where it should: within the tolerance nothing changes, beyond it all is lost. */
static void drawings_by_hand(void **state)
{
    (void)state;
    star s = {4, PLAIN, 0, 1e-5};
    assert_int_equal(alike(s).same.turns, 4);
    s.off = 0.2; /* along the crease nearly: what is off is a fifth of it */
    const rg_alike a = alike(s);
    assert_int_equal(a.same.turns, 1);
    assert_int_equal(a.same.mirrors, 0);
    assert_int_equal(a.order, 1);
    assert_int_equal(a.creases, 8);
}

static void memory_runs_short(void **state)
{
    (void)state;
    const star s = {5, PLAIN, 0.3, 0};
    counted c = {.left = 1000000};
    const rg_memory mem = {counted_resize, &c};
    rg_pattern *p = drawn(&s, &mem);
    rg_alike a;
    const long before = c.out;
    rg_status status = RG_ENOMEM;
    for (long k = 0; status == RG_ENOMEM; k++) {
        c.left = k;
        status = rg_alike_find(p, &a);
        assert_int_equal(c.out, before);
        assert_true(k < 100);
    }
    assert_int_equal(status, RG_OK);
    assert_int_equal(a.same.turns, 5);
    rg_pattern_destroy(p);
    assert_int_equal(c.out, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stars),       cmocka_unit_test(many),      cmocka_unit_test(orbits),
        cmocka_unit_test(short_edges), cmocka_unit_test(real_ones), cmocka_unit_test(drawings_by_hand),
        cmocka_unit_test(memory_runs_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
