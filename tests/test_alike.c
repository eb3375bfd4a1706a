/* pattern/alike.c: stars of creases on regular polygons, made with known symmetries; drawings that are nearly so. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
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
    char text[4000];
    size_t n = 0;
    const rg_vec2 o = {1.25, -7.5};
    for (int k = 0; k < s->n; k++) {
        const double corner = 2 * RG_PI * k / s->n;
        const rg_vec2 a = on_rim(s, corner), b = on_rim(s, 2 * RG_PI * (k + 1) / s->n);
        const rg_vec2 p = on_rim(s, corner + 0.21), q = on_rim(s, corner - 0.21);
        const int first = s->kind == ISO_AREA && k % 2 ? 3 : 2;
        n += (size_t)snprintf(text + n, sizeof text - n, "1 %.17g %.17g %.17g %.17g\n", a.x, a.y, b.x, b.y);
        n += (size_t)snprintf(text + n, sizeof text - n, "%d %.17g %.17g %.17g %.17g\n", first, o.x, o.y,
                              p.x + (k == 0 ? s->off : 0), p.y);
        if (s->kind == PLAIN || s->kind == EXCHANGED)
            n += (size_t)snprintf(text + n, sizeof text - n, "%d %.17g %.17g %.17g %.17g\n", s->kind == PLAIN ? 2 : 3, o.x, o.y, q.x, q.y);
    }
    rg_settings settings = rg_settings_default();
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
    for (int32_t i = 0; i < l->mirrors; i++) {
        if (i > 0) assert_true(l->mirror[i] > l->mirror[i - 1]);
        assert_true(l->mirror[i] >= 0 && l->mirror[i] < 180);
        const double steps = (l->mirror[i] - s->turned / RG_DEG) / (180.0 / s->n);
        near(steps, round(steps), 1e-9);
    }
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
            assert_int_equal(a.exchanged.turns + a.exchanged.mirrors, 0);

            s.kind = CHIRAL;
            a = alike(s);
            assert_int_equal(a.same.turns, n);
            assert_int_equal(a.same.mirrors + a.exchanged.turns + a.exchanged.mirrors, 0);

            s.kind = EXCHANGED;
            a = alike(s);
            assert_int_equal(a.same.turns, n);
            assert_int_equal(a.same.mirrors + a.exchanged.turns, 0);
            are_mirrors(&a.exchanged, &s);

            if (n % 2) continue;
            s.kind = ISO_AREA;
            a = alike(s);
            assert_int_equal(a.same.turns, n / 2);
            assert_int_equal(a.exchanged.turns, n / 2);
            assert_int_equal(a.same.mirrors + a.exchanged.mirrors, 0);
        }
}

/* One crease that ends a little beside where it should: within the tolerance nothing changes, beyond it all is lost. */
static void drawings_by_hand(void **state)
{
    (void)state;
    star s = {4, PLAIN, 0, 1e-5};
    assert_int_equal(alike(s).same.turns, 4);
    s.off = 3e-2;
    const rg_alike a = alike(s);
    assert_int_equal(a.same.turns, 1);
    assert_int_equal(a.same.mirrors, 0);
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(stars), cmocka_unit_test(drawings_by_hand), cmocka_unit_test(memory_runs_short)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
