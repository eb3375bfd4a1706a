/* lie.h -- the other way round: from positions to fold angles and places of facets.
 * Uses  pose.h        Used by  motion, files/motion.c */
#ifndef RG_LIE_H
#define RG_LIE_H

#include "pose/pose.h"

/* rho[N]: out, fold angles of a sheet that lies so; before[N]: those of the frame before, whose half turns they go on
 * from; NULL: the creases' targets say which half turn is meant. normal[nf]: scratch. */
void rg_lie_angles(const rg_mesh *m, const rg_vec3 *x, const double *before, rg_vec3 *normal, double *rho);
/* place[nf]: out, the plate nearest to each facet as it lies: its first side and its normal are kept. */
void rg_lie_facets(const rg_mesh *m, const rg_vec2 *X, const rg_vec3 *x, rg_place *place);

#endif
