/* Symmetry kept in motions, and told in their reports: judged by a measure that shares no code with what keeps it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "corpus.h"
#include "motions.h"

#include "asymmetry.h"
#include "generate/generate.h"

/* Degrees: what cannot be seen. */
static const double LIMIT = 0.01;

/* Two creases of a strip of three panels, the second one behind the first by so many radians times t (1 - t). */
static void behind(const rg_mesh *m, double t, double *rho, void *ctx)
{
    all_alike(m, t, rho, NULL);
    rho[1] -= *(const double *)ctx * t * (1 - t);
}

/* The measure itself: what is put in comes out. */
static void the_measure(void **state)
{
    (void)state;
    const double widths[] = {1, 1.25, 1};
    double off[] = {0, 1e-4, 0.2};
    for (int k = 0; k < 3; k++) {
        rg_lines l = strip(3, widths, "VV", 2.385);
        rg_motion *m = motion_by(&l, 5, behind, &off[k]);
        const asymmetry a = asymmetry_measured(m, LIMIT);
        assert_int_equal(a.elements, 4);
        assert_int_equal(a.mirrors, 2);
        assert_int_equal(a.kept, k < 2 ? 4 : 2); /* a mirror along the strip takes every crease to itself */
        near(a.all, off[k] / 4 / RG_DEG, 1e-12);
        near(a.most, k < 2 ? a.all : 0, 1e-12);
        rg_motion_destroy(m);
    }
    const double uneven[] = {1, 1.25, 1.5};
    rg_lines l = strip(3, uneven, "VV", 2.385);
    rg_motion *m = motion_by(&l, 5, behind, &off[0]);
    assert_int_equal(asymmetry_measured(m, LIMIT).elements, 2);
    rg_motion_destroy(m);
    l = strip(3, widths, "VM", 2.385);
    m = motion_by(&l, 5, behind, &off[0]);
    assert_int_equal(asymmetry_measured(m, LIMIT).elements, 2);
    rg_motion_destroy(m);
}

static rg_motion *folded(rg_pattern *p, rg_symmetry_kept symmetry)
{
    rg_settings s = rg_settings_default();
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    s.frames = 31;
    s.contact = RG_CONTACT_REPORT; /* which of the two motions is looked at */
    s.symmetry = symmetry;
    const rg_status status = rg_motion_create(p, &s, NULL, NULL, &m, &why);
    rg_pattern_destroy(p);
    if (status != RG_OK) fail_msg("%s", why.text);
    return m;
}

static rg_pattern *generated(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    return pattern_of(&l);
}

/* Folds to the end, has what the pattern has, and says so. Takes m over. */
static void keeps(rg_motion *m, const char *name, int order)
{
    const rg_report *r = rg_motion_report(m);
    const asymmetry a = asymmetry_measured(m, LIMIT);
    if (r->outcome != RG_FOLDED || a.kept != order || r->symmetry != order)
        print_error("%s: %s; %d elements, %d kept, %d told\n", name, r->reason, a.elements, a.kept, (int)r->symmetry);
    assert_int_equal(r->outcome, RG_FOLDED);
    assert_int_equal(a.elements, order);
    assert_int_equal(a.kept, order);
    assert_int_equal(r->symmetry, order);
    below(a.most, LIMIT);
    near(r->max_asymmetry_deg, a.most, 1e-9);
    rg_motion_destroy(m);
}

static void patterns_of_our_own(void **state)
{
    (void)state;
    static const struct { const char *kind; int n, order; } made[] = {
        {"boxpleat", 16, 4}, {"boxpleat", 8, 4}, {"crane", 0, 2}, {"open-sink", 0, 4}, {"tatou", 0, 4}, {"frog", 0, 4}, {"bird", 0, 4}};
    for (size_t k = 0; k < sizeof made / sizeof *made; k++)
        keeps(folded(generated(made[k].kind, made[k].n), RG_SYMMETRY_AUTO), made[k].kind, made[k].order);
}

/* Box pleats are folded by all their symmetry with few added creases that hardly roll; not asked for, what is told is true as
 * well. */
static void asked_for_or_not(void **state)
{
    (void)state;
    rg_motion *with = folded(generated("boxpleat", 16), RG_SYMMETRY_AUTO);
    below(rg_motion_report(with)->max_adjustment, 0.01);
    assert_int_equal(rg_motion_report(with)->added_creases, 28);
    rg_motion_destroy(with);
    static const char *const kinds[] = {"boxpleat", "tatou", "crane"};
    for (int k = 0; k < 3; k++) {
        rg_motion *without = folded(generated(kinds[k], 0), RG_SYMMETRY_OFF);
        assert_int_equal(rg_motion_report(without)->symmetry, asymmetry_measured(without, LIMIT).kept);
        rg_motion_destroy(without);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_measure), cmocka_unit_test(patterns_of_our_own), cmocka_unit_test(asked_for_or_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
