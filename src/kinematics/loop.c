#include "kinematics/loop.h"

rg_mat3 rg_loop_walk(int32_t n, const int32_t *crease, const rg_turn *rho, const rg_turn *theta, rg_vec3 *c)
{
    rg_mat3 A = rg_mat3_identity();
    for (int32_t i = 0; i < n; i++) {
        if (c) c[i] = A.c[0];                              /* (b, c, a)_i = A_i e_x     eqs. (2)-(5) */
        A = rg_loop_advance(A, rho[crease[i]], theta[i]);  /* F = chi_1 ... chi_n       eq. (1)      */
    }
    return A;
}

rg_vec3 rg_loop_residual(rg_mat3 F)
{
    return (rg_vec3){(F.c[1].z - F.c[2].y) / 2, (F.c[2].x - F.c[0].z) / 2, (F.c[0].y - F.c[1].x) / 2}; /* eq. (13) */
}

double rg_loop_angle(rg_mat3 F)
{
    double sine = rg_vec3_length(rg_loop_residual(F));
    return atan2(sine, (F.c[0].x + F.c[1].y + F.c[2].z - 1) / 2);
}
