/* tangent.h -- the linear algebra of one state, for whoever wants to compute with it.
 * Paper    eqs. (5)-(9), (11)-(13)        Uses  project.h        Used by  motion/tangents.c */
#ifndef RG_TANGENT_H
#define RG_TANGENT_H

#include "kinematics/project.h"

/* At fold angles rho[N] on the pattern X[nv], NULL: that of the mesh; both are copied. RG_ENOMEM. Owner: the caller,
 * rg_tangent_destroy. */
rg_status rg_tangent_at(const rg_mesh *m, const rg_memory *mem, const rg_vec2 *X, const double *rho,
                        rg_tangent **tangent);

#endif
