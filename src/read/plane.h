/* plane.h -- the one plane that a drawing in space lies in, as far as it does.
 * Uses  vec.h        Used by  fold.c space.c */
#ifndef RG_PLANE_H
#define RG_PLANE_H

#include "base/vec.h"
#include <stdint.h>

typedef struct rg_level {
    rg_vec3 e1, e2; /* axes in the plane, the third one points at the eye; those of space where they can be */
    double off;     /* from the farthest point on one side to that on the other */
    double change;  /* the most that a line's length changes when it is put into the plane */
    int32_t at;     /* that line */
} rg_level;

/* x[n]: points; pair[2 pairs]: the ends of lines. `exact`: off the plane by this part of the size is rounding. `tol`:
 * lines may change their lengths by this part of the size: that keeps a drawing flat that a program has hardly moved,
 * and shows one that is folded. Returns 2: the points lie in that plane but for rounding; 1: they are put into it; 0:
 * they are in none, *p then tells the line that shows it. Planes of two axes of space keep the coordinates. */
int rg_plane_find(const rg_vec3 *x, int32_t n, const int32_t *pair, int32_t pairs, double exact, double tol,
                  rg_level *p);

#endif
