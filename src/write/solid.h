/* solid.h -- the sheet with a thickness, as one closed surface: plates of that thickness, and what joins them along the
 * creases.
 * Uses  motion.h mesh/triangles.h        Used by  stl.c
 *
 * Each facet is there twice, half the thickness above and below where it lies. Along a crease the two upper sides, and
 * the two lower ones, are joined by a strip, round a vertex by a fan, along the border by walls: the surface is closed
 * however it is folded, and the hinges are part of it. On the inside of a fold plates reach into each other by half the
 * thickness times the tangent of half the fold angle, as paper of that thickness would have to be cut away. */
#ifndef RG_SOLID_H
#define RG_SOLID_H

#include "motion/motion.h"
#include "mesh/triangles.h"

/* Called with each triangle, counter-clockwise seen from outside; coordinates are single precision. */
typedef void (*rg_solid_take)(void *ctx, const rg_vec3 corner[3]);

/* x[m->nv]: positions. RG_ENOMEM. */
rg_status rg_solid_make(const rg_memory *mem, const rg_mesh *m, const rg_triangles *t, const rg_vec3 *x,
                        double thickness, rg_solid_take take, void *ctx);

#endif
