/* loop.h -- one vertex: walking round it, from facet to facet, back to the start.
 * Paper    eqs. (1)-(6), (13), Fig. 3        Used by  constraint.c coupled.c measure.c */
#ifndef RG_LOOP_H
#define RG_LOOP_H

#include "base/vec.h"
#include <stdint.h>

typedef struct rg_turn { double cos, sin; } rg_turn;

/* A <- A chi,  chi = R_x(rho) R_z(theta): over one crease and on to the next.                    eq. (1), Fig. 3 */
static inline rg_mat3 rg_loop_advance(rg_mat3 A, rg_turn rho, rg_turn theta)
{
    rg_vec3 y = rg_vec3_axpy(rho.cos, A.c[1], rg_vec3_scale(rho.sin, A.c[2]));
    rg_vec3 z = rg_vec3_axpy(rho.cos, A.c[2], rg_vec3_scale(-rho.sin, A.c[1]));
    rg_vec3 x = rg_vec3_axpy(theta.cos, A.c[0], rg_vec3_scale(theta.sin, y));
    y = rg_vec3_axpy(theta.cos, y, rg_vec3_scale(-theta.sin, A.c[0]));
    return (rg_mat3){{x, y, z}};
}

/* F = chi_1 ... chi_n of a vertex of n creases, and its derivatives.
 *   crease[n]  in   crease numbers counter-clockwise
 *   rho[]      in   cosine and sine of the fold angle, by crease number
 *   theta[n]   in   cosine and sine of the sector angle behind each crease
 *   c[n]       out  axial vector (b, c, a) of dF/drho_i F^T; NULL: not wanted
 * With A_i = chi_1 ... chi_(i-1), dF/drho_i = [A_i e_x]x F: column i of C_k is where crease i points now, seen from the
 * first facet. At F = I this is the a, b, c of eq. (5), and no derivative of a matrix is ever formed. */
rg_mat3 rg_loop_walk(int32_t n, const int32_t *crease, const rg_turn *rho, const rg_turn *theta, rg_vec3 *c);

/* (r_b, r_c, r_a): the axial vector of the skew part of F.                                             eq. (13) */
rg_vec3 rg_loop_residual(rg_mat3 F);

/* The rotation angle of F, 0 ... pi; unlike the skew part it is not blind to half turns. */
double rg_loop_angle(rg_mat3 F);

#endif
