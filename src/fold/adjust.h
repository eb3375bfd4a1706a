/* adjust.h -- where the vertices of closed vertices wish to go.
 * Paper    sections 3.1, 3.3, Fig. 5        Uses  freedom.h closed.h        Used by  relax.c
 *
 * A closed vertex moves in the direction that shrinks its inside angles, by
 *
 *     gain * (shortest line at it) * unevenness,      unevenness = (max |rho_i| - min |rho_i|) / pi over its creases,
 *
 * which is nothing on flat paper and nothing on folded paper. */
#ifndef RG_ADJUST_H
#define RG_ADJUST_H

#include "kinematics/freedom.h"

typedef struct rg_adjust {
    rg_memory mem;
    const rg_freedom *freedom; /* borrowed */
    int32_t count;             /* closed vertices */
    int32_t *k;                /* [count] as interior vertices of the mesh */
    rg_vec2 *direction;        /* [count] unit vectors; 0: its inside angles pull against each other */
} rg_adjust;

/* RG_ENOMEM. Owner: the caller, rg_adjust_free. */
rg_status rg_adjust_init(rg_adjust *a, const rg_memory *mem, const rg_freedom *f);
void rg_adjust_free(rg_adjust *a);
/* u[U]: out, where the pattern would like to be at rho[N], lengths. */
void rg_adjust_wish(const rg_adjust *a, const double *rho, double gain, double *u);

#endif
