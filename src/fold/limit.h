/* limit.h -- the two penalties against local self-intersection.
 * Paper    section 4        Uses  drive.h mesh.h        Used by  relax.c system.c
 *
 * One keeps every crease within [-pi, pi], so that two facets at a crease do not pass through each other. The other
 * keeps an added crease within what its neighbours leave: where an original crease next to it has turned by rho > 0,
 * two facets already stand at pi - rho, and turning the third the same way by more than that runs it through the first.
 * Both are wishes, as in the paper, not walls: at the flat start the linear step must be free to be wrong-sided for a
 * moment. */
#ifndef RG_LIMIT_H
#define RG_LIMIT_H

#include "fold/drive.h"

typedef struct rg_limit {
    rg_memory mem;
    int32_t N, first_added;
    int32_t (*neighbour)[4]; /* [added] the other creases of the two triangles at an added crease, -1: none */
} rg_limit;

rg_status rg_limit_init(rg_limit *l, const rg_memory *mem, const rg_mesh *m);
void rg_limit_free(rg_limit *l);

/* pull[N]: out, how far each crease is from where it may be, radians, signed towards it; 0 within the limits. Returns
 * the largest magnitude. */
double rg_limit_pull(const rg_limit *l, const double *rho, double *pull);

#endif
