/* blame.h -- which vertices resist a step, and how hard.
 * Paper    eq. (15): its multipliers y        Uses  mesh.h        Used by  steer.c, motion/diagnose.c */
#ifndef RG_BLAME_H
#define RG_BLAME_H

#include "mesh/mesh.h"

typedef struct rg_force { double size; int32_t k; } rg_force;

/* Of C, block by block along mesh->loop_crease, and y[3M]: the vertices whose reactions turn their creases the most,
 * strongest first, by number.
 * by[M]: scratch; vertex: out, room for all. Returns how many: no list too long to read. */
int32_t rg_blame_vertices(const rg_mesh *m, const rg_vec3 *C, const double *y, rg_force *by, int32_t *vertex);

#endif
