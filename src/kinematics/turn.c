#include "kinematics/turn.h"
#include "base/lanes.h"

/* pi / 2 in three parts (Cody and Waite): the first two have so few bits that their product with a small integer is
 * exact. */
static const double TWO_OVER_PI = 0.63661977236758134308;
static const double PART1 = 1.57079632673412561417, PART2 = 6.07710050630396597660e-11;
static const double PART3 = 2.02226624879595063154e-21;
/* Adding and taking away 3/2 2^52 rounds to an integer, which is then in the lowest bits. */
static const double ROUND = 6755399441055744.0;

RG_WIDE void rg_turn_creases(int32_t n, const double *angle, double *c, double *s)
{
    for (int32_t i = 0; i < n; i += 4) {
        rg_quad x = *(const rg_quad_anywhere *)(angle + i);
        rg_quad shifted = x * TWO_OVER_PI + ROUND, q = shifted - ROUND;
        rg_quad_int quarter = (rg_quad_int)shifted;
        rg_quad r = ((x - q * PART1) - q * PART2) - q * PART3, z = r * r;
        /* The minimax polynomials of |r| <= pi / 4 that everybody uses, of degree 13 and 14. */
        rg_quad sine = 1.58969099521155010221e-10 * z - 2.50507602534068634195e-08;
        sine = sine * z + 2.75573137070700676789e-06;
        sine = sine * z - 1.98412698298579493134e-04;
        sine = sine * z + 8.33333333332248946124e-03;
        sine = sine * z - 1.66666666666666324348e-01;
        sine = r + r * (z * sine);
        rg_quad cosine = 2.08757232129817482790e-09 - 1.13596475577881948265e-11 * z;
        cosine = cosine * z - 2.75573143513906633035e-07;
        cosine = cosine * z + 2.48015872894767294178e-05;
        cosine = cosine * z - 1.38888888888741095749e-03;
        cosine = cosine * z + 4.16666666666666019037e-02;
        cosine = 1 - (0.5 * z - z * z * cosine);
        /* Each quarter turn takes (cos, sin) to (-sin, cos). */
        rg_quad_int odd = -(quarter & 1);
        rg_quad_int minus_sine = (quarter & 2) << 62, minus_cosine = ((quarter + 1) & 2) << 62;
        rg_quad_int a = (rg_quad_int)sine, b = (rg_quad_int)cosine;
        *(rg_quad_anywhere *)(s + i) = (rg_quad)(((odd & b) | (~odd & a)) ^ minus_sine);
        *(rg_quad_anywhere *)(c + i) = (rg_quad)(((odd & a) | (~odd & b)) ^ minus_cosine);
    }
}
