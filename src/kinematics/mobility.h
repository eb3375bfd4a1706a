/* mobility.h -- how many ways a folded sheet can go, to first order.
 * Paper    section 3.2, eq. (9): N less the rank of C, where N - 3M is only a guess
 * Uses     constraint.h scale.h qr.h        Used by  motion.c model.c */
#ifndef RG_MOBILITY_H
#define RG_MOBILITY_H

#include "kinematics/constraint.h"

/* At fold angles rho[N] on the pattern X[nv], NULL: that of the mesh. All of its components together. Flat and
 * flat-folded sheets have more ways to first order than they can go; a sheet stuck within 1e-3 of flat may be told as
 * either. RG_ENOMEM. */
rg_status rg_mobility(const rg_mesh *m, const rg_vec2 *X, const double *rho, int32_t *ways);

#endif
