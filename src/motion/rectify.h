/* rectify.h -- the pattern nearest to a drawing on which the states that a model is folded through close exactly.
 * Source   Kawasaki's theorem, for every state; J. Justin (1989)
 * Uses     simple.h freedom.h least.h        Used by  stages.c undone.c
 *
 * Drawings are rounded. On one, a vertex that should fold flat does not quite, and creases that should come to lie on
 * one line do so within 1e-5, so that nothing could turn about them: plates take nothing for nearly. Round each vertex,
 * with theta the angles between its creases and s = +1, -1 changing at each folded one:
 *     sum s theta = 0        over all of them, in the state before all simple folds, which is flat
 *     sum s theta = 0, pi    over those that a simple fold turns: the creases where they begin and end lie on one line
 * On a sheet without holes that is all: if every vertex closes in two states, a body that turns about one crease
 * between them turns about all. Solved by Newton's method, each step the least move of the vertices that does it. */
#ifndef RG_RECTIFY_H
#define RG_RECTIFY_H

#include "layers/simple.h"

/* What rounding leaves in a sum of angles, radians. */
#define RG_RECTIFIED 1e-12

/* X[m->nv]: out, the pattern; m->X itself where that closes. m: without added creases.
 *   moved    out, the farthest that a vertex moved, file units
 *   off      out, the largest sum that is left, radians; above RG_RECTIFIED: there is no such pattern near
 * RG_ENOMEM. */
rg_status rg_rectify(const rg_mesh *m, const rg_simple *stages, rg_vec2 *X, double *moved, double *off);

#endif
