/* turn.h -- rotations as unit quaternions, for those who interpolate between frames.
 * Uses  base        Used by  write/gltf.c write/html.c */
#ifndef RG_TURN_H
#define RG_TURN_H

#include "base/vec.h"

typedef struct rg_turn { double x, y, z, w; } rg_turn;

/* R: a rotation. Of the two quaternions that mean it, the one nearer to `before`. */
rg_turn rg_turn_from_matrix(const rg_mat3 *R, rg_turn before);

#endif
