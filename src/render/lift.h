/* lift.h -- facets that lie on each other, moved apart for the eye, so that each frame shows paper on paper.
 * Paper    section 4        Uses  motion.h ending.h coplanar.h stack.h        Used by  frames.c html.c
 *
 * Who is on top follows from the motion: facets that come to lie in one plane are ordered by where they lay a little
 * before, and stay in that order for as long as they lie there. So frames are taken one after the other. A flat end is
 * shown in an order that paper can have, where there is one. */
#ifndef RG_LIFT_H
#define RG_LIFT_H

#include "motion/motion.h"
#include "mesh/triangles.h"

typedef struct rg_lift rg_lift;

/* `m` and `t` are kept by reference. RG_ENOMEM. Owner: the caller, rg_lift_destroy (NULL is fine). */
rg_status rg_lift_create(const rg_memory *mem, const rg_motion *m, const rg_triangles *t, rg_lift **layers);
/* The next frame, the first call takes frame 0:
 *   x[nv]     out, positions
 *   lift[nf]  out, how far each facet is to be moved when it is drawn; no more than RG_LIFT_MOST of the sheet's size
 * RG_ENOMEM; RG_EARG after the last frame. */
rg_status rg_lift_next(rg_lift *l, rg_vec3 *x, rg_vec3 *lift);
void rg_lift_destroy(rg_lift *l);

#define RG_LIFT_MOST 5e-4

#endif
