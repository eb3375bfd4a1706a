/* kinematics/loop.c: one vertex, against products of rotation matrices written out and central differences. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "folded.h"
#include "kinematics/loop.h"

enum { MOST = 9 };

static rg_mat3 walk(int n, const double *rho, const double *theta, rg_vec3 *c)
{
    rg_turn cs_rho[MOST], cs_theta[MOST];
    int32_t crease[MOST];
    for (int i = 0; i < n; i++) { /* creases are looked up by number: they have them in another order */
        crease[i] = n - 1 - i;
        cs_rho[n - 1 - i] = (rg_turn){cos(rho[i]), sin(rho[i])};
        cs_theta[i] = (rg_turn){cos(theta[i]), sin(theta[i])};
    }
    return rg_loop_walk(n, crease, cs_rho, cs_theta, c);
}

static double entry(rg_mat3 F, int i, int j)
{
    const rg_vec3 c = F.c[j];
    return i == 0 ? c.x : i == 1 ? c.y : c.z;
}

static void any_vertex(int n, double *rho, double *theta, unsigned *seed)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += theta[i] = 1.4 + noise(seed), rho[i] = 3.3 * noise(seed);
    for (int i = 0; i < n; i++) theta[i] *= 2 * RG_PI / sum;
}

static void the_product(void **state)
{
    (void)state;
    unsigned seed = 3;
    for (int round = 0; round < 200; round++) {
        const int n = 3 + round % (MOST - 2);
        double rho[MOST], theta[MOST];
        any_vertex(n, rho, theta, &seed);
        const rg_mat3 F = walk(n, rho, theta, NULL);
        const turn3 G = round_trip(n, rho, theta);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) near(entry(F, i, j), G.a[i][j], 1e-14);
    }
}

/* dF/drho_i F^T by central differences is skew; its axial vector is what the walk says. */
static void the_derivative(void **state)
{
    (void)state;
    unsigned seed = 4;
    const double h = 1e-5;
    for (int round = 0; round < 100; round++) {
        const int n = 3 + round % (MOST - 2);
        double rho[MOST], theta[MOST];
        rg_vec3 c[MOST];
        any_vertex(n, rho, theta, &seed);
        walk(n, rho, theta, c);
        const turn3 F = round_trip(n, rho, theta);
        for (int k = 0; k < n; k++) {
            const double at = rho[k];
            double d[3][3] = {{0}};
            rho[k] = at + h;
            const turn3 more = round_trip(n, rho, theta);
            rho[k] = at - h;
            const turn3 less = round_trip(n, rho, theta);
            rho[k] = at;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    for (int m = 0; m < 3; m++) d[i][j] += (more.a[i][m] - less.a[i][m]) / (2 * h) * F.a[j][m];
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) near(d[i][j], -d[j][i], 1e-9);
            near(c[k].x, d[2][1], 1e-9);
            near(c[k].y, d[0][2], 1e-9);
            near(c[k].z, d[1][0], 1e-9);
            near(rg_vec3_length(c[k]), 1, 1e-14);
        }
    }
}

/* Flat paper: no crease points out of the plane, and the sectors come round. */
static void flat_is_closed(void **state)
{
    (void)state;
    unsigned seed = 5;
    for (int n = 3; n <= MOST; n++) {
        double rho[MOST], theta[MOST], angle = 0;
        rg_vec3 c[MOST];
        any_vertex(n, rho, theta, &seed);
        memset(rho, 0, sizeof rho);
        const rg_mat3 F = walk(n, rho, theta, c);
        below(rg_loop_angle(F), 1e-14);
        for (int i = 0; i < n; i++) {
            near(c[i].x, cos(angle), 1e-14);
            near(c[i].y, sin(angle), 1e-14);
            near(c[i].z, 0, 0);
            angle += theta[i];
        }
    }
}

/* The closed forms of degree 4, both modes, from flat to folded flat. */
static void degree_4_closes(void **state)
{
    (void)state;
    unsigned seed = 6;
    for (int round = 0; round < 400; round++) {
        const double a = RG_PI / 2 * (1 + 0.9 * noise(&seed)), b = RG_PI / 2 * (1 + 0.9 * noise(&seed)), t = tan(1.57 * noise(&seed));
        double rho[4], theta[4];
        degree4(a, b, round % 2, t, theta, rho);
        below(off_identity(round_trip(4, rho, theta)), 1e-13); /* the formula itself, by the matrices written out */
        const rg_mat3 F = walk(4, rho, theta, NULL);
        below(rg_loop_angle(F), 1e-13);
        const rg_vec3 r = rg_loop_residual(F);
        below(rg_vec3_length(r), 1e-13);
        rho[1] += 1e-3; /* and no other angles close */
        assert_true(rg_loop_angle(walk(4, rho, theta, NULL)) > 5e-4);
    }
}

/* At closed states the columns of C add nothing along a motion that keeps F: the closed form's derivative is in its kernel. */
static void the_motion_is_in_the_kernel(void **state)
{
    (void)state;
    unsigned seed = 7;
    const double h = 1e-5;
    for (int round = 0; round < 100; round++) {
        const double a = RG_PI / 2 * (1 + 0.8 * noise(&seed)), b = RG_PI / 2 * (1 + 0.8 * noise(&seed)), t = noise(&seed);
        double rho[4], more[4], less[4], theta[4];
        rg_vec3 c[4], sum = {0, 0, 0};
        degree4(a, b, round % 2, t, theta, rho);
        degree4(a, b, round % 2, t + h, theta, more);
        degree4(a, b, round % 2, t - h, theta, less);
        walk(4, rho, theta, c);
        for (int i = 0; i < 4; i++) sum = rg_vec3_axpy((more[i] - less[i]) / (2 * h), c[i], sum);
        below(rg_vec3_length(sum), 1e-8);
    }
}

/* A rotation by a known angle about a known axis (Rodrigues, written out). */
static rg_mat3 rotation(const double axis[3], double angle)
{
    const double c = cos(angle), s = sin(angle), x = axis[0], y = axis[1], z = axis[2];
    return (rg_mat3){{{c + x * x * (1 - c), y * x * (1 - c) + z * s, z * x * (1 - c) - y * s},
                      {x * y * (1 - c) - z * s, c + y * y * (1 - c), z * y * (1 - c) + x * s},
                      {x * z * (1 - c) + y * s, y * z * (1 - c) - x * s, c + z * z * (1 - c)}}};
}

/* The residual of eq. (13) is sin(angle) times the axis, blind to half turns; the angle is not. */
static void residual_and_angle(void **state)
{
    (void)state;
    unsigned seed = 8;
    static const double angles[] = {0, 1e-12, 1e-7, 0.3, 1.385, RG_PI / 2, 2.9, RG_PI - 1e-7, RG_PI};
    for (int round = 0; round < 90; round++) {
        double axis[3], length = 0;
        for (int i = 0; i < 3; i++) axis[i] = noise(&seed), length += axis[i] * axis[i];
        for (int i = 0; i < 3; i++) axis[i] /= sqrt(length);
        const double angle = angles[round % 9];
        const rg_mat3 F = rotation(axis, angle);
        const rg_vec3 r = rg_loop_residual(F);
        near(r.x, sin(angle) * axis[0], 1e-15);
        near(r.y, sin(angle) * axis[1], 1e-15);
        near(r.z, sin(angle) * axis[2], 1e-15);
        near(rg_loop_angle(F), angle, 1e-14 + 1e-9 * angle);
    }
}

static void nan_is_not_lost(void **state)
{
    (void)state;
    double rho[4], theta[4];
    degree4(1.1, 1.7, 0, 0.4, theta, rho);
    for (int i = 0; i < 4; i++) {
        double bad[4];
        memcpy(bad, rho, sizeof bad);
        bad[i] = NAN;
        const rg_mat3 F = walk(4, bad, theta, NULL);
        assert_true(isnan(rg_loop_angle(F)));
        assert_true(isnan(rg_vec3_length(rg_loop_residual(F))));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_product),
        cmocka_unit_test(the_derivative),
        cmocka_unit_test(flat_is_closed),
        cmocka_unit_test(degree_4_closes),
        cmocka_unit_test(the_motion_is_in_the_kernel),
        cmocka_unit_test(residual_and_angle),
        cmocka_unit_test(nan_is_not_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
