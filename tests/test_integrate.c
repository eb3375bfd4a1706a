/* The nodes of a path and the polynomials through them, against polynomials that are known. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
#include "fold/path.h"
#include "near.h"

/* Two polynomials of degree d with coefficients that have entropy, and their slopes. */
static void curve(int d, double s, double *rho, double *t)
{
    unsigned seed = 41;
    for (int k = 0; k < 2; k++) {
        rho[k] = t[k] = 0;
        for (int i = 0; i <= d; i++) {
            double c = noise(&seed);
            rho[k] += c * pow(s, i);
            if (i) t[k] += c * i * pow(s, i - 1);
        }
    }
}

static const double AT[] = {0, 0.11, 0.19, 0.34, 0.4, 0.55};

static void fill(rg_path *p, int d, int without)
{
    rg_memory mem = rg_mem_default(NULL);
    assert_int_equal(rg_path_init(p, &mem, 2), RG_OK);
    static const int order[] = {3, 0, 5, 1, 4, 2}; /* nodes come in any order */
    for (int i = 0; i < 6; i++) {
        double rho[2], t[2];
        curve(d, AT[order[i]], rho, t);
        rg_path_insert(p, AT[order[i]], rho, order[i] == without ? NULL : t);
    }
    for (int i = 0; i < 6; i++) near(p->node[i].s, AT[i], 0);
}

static void the_polynomial_is_found_again(void **state)
{
    (void)state;
    for (int without = -1; without < 6; without += 3) {
        const int d = without < 0 ? 11 : 10;
        rg_path p;
        fill(&p, d, without);
        for (double s = 0.003; s < 0.6; s += 0.017) {
            double rho[2], t[2], want[2], slope[2];
            curve(d, s, want, slope);
            rg_path_evaluate(&p, 0, 6, s, rho, t);
            for (int k = 0; k < 2; k++) {
                near(rho[k], want[k], 1e-12);
                near(t[k], slope[k], 1e-10);
            }
        }
        double rho[2], t[2], want[2], slope[2]; /* on a node, to the bit */
        curve(d, AT[1], want, slope);
        rg_path_evaluate(&p, 0, 6, AT[1], rho, t);
        near(rho[0], want[0], 0);
        near(t[1], slope[1], 0);
        rg_path_free(&p);
    }
}

/* One degree more than the conditions allow: what is off is the product of the distances, times the leading coefficient. */
static void what_is_off_is_the_reach(void **state)
{
    (void)state;
    rg_path p;
    fill(&p, 12, -1);
    unsigned seed = 41;
    double leading = 0;
    for (int i = 0; i <= 12; i++) leading = noise(&seed);
    for (double s = 0.47; s < 0.9; s += 0.07) {
        double rho[2], want[2], slope[2], reach = rg_path_reach(&p, 0, 6, s, 2);
        curve(12, s, want, slope);
        rg_path_evaluate(&p, 0, 6, s, rho, NULL);
        near(fabs(want[0] - rho[0]), fabs(leading) * reach, 1e-6 * reach); /* rounding is amplified out there */
    }
    rg_path_free(&p);
}

static void integrals_are_exact(void **state)
{
    (void)state;
    rg_path p;
    fill(&p, 6, -1); /* t is of degree 5: six values tell it */
    double w[6], rho[2], t[2], from[2], to[2];
    rg_path_integral(&p, 0, 6, 0.55, 0.7, w);
    curve(6, 0.55, from, t);
    curve(6, 0.7, to, t);
    for (int k = 0; k < 2; k++) {
        rho[k] = from[k];
        for (int i = 0; i < 6; i++) rho[k] += w[i] * p.node[i].t[k];
        near(rho[k], to[k], 1e-12);
    }
    rg_path_free(&p);
}

static void the_oldest_makes_room(void **state)
{
    (void)state;
    rg_memory mem = rg_mem_default(NULL);
    rg_path p;
    assert_int_equal(rg_path_init(&p, &mem, 1), RG_OK);
    for (int i = 0; i < 40; i++) {
        double rho = 1.25 * i, t = 1.25;
        rg_path_insert(&p, i, &rho, &t);
    }
    assert_int_equal(p.count, RG_PATH_NODES);
    for (int i = 0; i < p.count; i++) {
        near(p.node[i].s, 40 - RG_PATH_NODES + i, 0);
        near(p.node[i].rho[0], 1.25 * p.node[i].s, 0);
    }
    int32_t first, n;
    rg_path_window(&p, 33.5, &first, &n);
    assert_int_equal(n, RG_PATH_WINDOW);
    near(p.node[first].s, 31, 0);
    near(p.node[first + n - 1].s, 36, 0);
    rg_path_free(&p);
}

static void memory_may_be_short(void **state)
{
    (void)state;
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        rg_memory mem = {counted_resize, &c};
        rg_path p;
        rg_status s = rg_path_init(&p, &mem, 7);
        if (s == RG_OK) rg_path_free(&p);
        assert_int_equal(c.out, 0);
        if (s == RG_OK) break;
        assert_int_equal(s, RG_ENOMEM);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_polynomial_is_found_again), cmocka_unit_test(what_is_off_is_the_reach),
        cmocka_unit_test(integrals_are_exact),           cmocka_unit_test(the_oldest_makes_room),
        cmocka_unit_test(memory_may_be_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
