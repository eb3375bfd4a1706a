/* kawasaki.h -- Kawasaki's theorem at a vertex: sectors by turns forth and back come to nothing.
 * Paper    eqs. (16)-(18)        Uses  mesh.h        Used by  constraint.c coupled.c */
#ifndef RG_KAWASAKI_H
#define RG_KAWASAKI_H

#include "mesh/mesh.h"

/* +1 and -1 by turns for the sectors between drawn creases of interior vertex k, theta[] along m->loop_crease, summed:
 * *sum, eq. (18); sign[j]: of the direction of its loop entry j in it, eq. (17) (NULL: not asked for). Returns the
 * number of drawn creases. */
int32_t rg_kawasaki_alternate(const rg_mesh *m, int32_t k, const double *theta, double *sum, double *sign);
/* Does it hold at k, but for what a drawing by hand is off? */
int rg_kawasaki_holds(const rg_mesh *m, int32_t k, const double *theta);

#endif
