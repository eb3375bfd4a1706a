/* undriven.h -- which of the creases without a target are folded where the sheet lies flat, and which are flat.
 * Source   Kawasaki's theorem: round a vertex that folds flat, angles between folded creases, with signs in turn, add
 *          up to nothing
 * Uses  mesh.h        Used by  flat.c */
#ifndef RG_LAYERS_UNDRIVEN_H
#define RG_LAYERS_UNDRIVEN_H

#include "mesh/mesh.h"

enum { RG_TURN_UNTOLD = 3, RG_TURN_EITHER = 2 };

/* turn[m->ne]: in and out, 0: flat; +1, -1: valley, mountain; RG_TURN_UNTOLD becomes 0 or, folded either way,
 * RG_TURN_EITHER.
 * Vertices that leave no choice are decided first; then the others, with as few folded creases as they allow.
 *   at       out, an interior vertex (of the mesh) that cannot close; -1: each can
 *   guessed  out, non-zero: another choice might have closed there
 * RG_ENOMEM. */
rg_status rg_undriven_decide(const rg_mesh *m, signed char *turn, int32_t *at, int *guessed);

/* By how much interior vertex k does not close with those turns, radians; INFINITY: an odd number of creases fold
 * there. */
double rg_undriven_off(const rg_mesh *m, int32_t k, const signed char *turn);

#endif
