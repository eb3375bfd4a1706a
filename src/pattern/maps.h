/* maps.h -- the turns and mirrors that take a drawing to itself.
 * Uses  pattern.h        Used by  alike.c mesh/symmetry.c */
#ifndef RG_MAPS_H
#define RG_MAPS_H

#include "pattern/pattern.h"

/* Vertices that are as near as this part of the sheet's size are in one place: of 97 real patterns, drawings by hand
 * keep their symmetry that well, and no two vertices that go to the same place are let through. */
#define RG_SAME_PLACE 3e-3

/* Multiplies by the unit number c + i s, about the middle, after taking the conjugate if it is a mirror. */
typedef struct rg_map {
    double c, s;
    int mirror;
    int keeps; /* every crease goes to one that folds alike; zero: mountains go to valleys and the other way round */
} rg_map;

typedef struct rg_maps {
    rg_memory mem;
    rg_vec2 middle;  /* the mean of the vertices */
    int32_t nv, ne;
    int32_t count;   /* 1 or more: the one by nothing is the first; 0: no vertices, or all in one place */
    rg_map *map;     /* [count] */
    int32_t *vertex; /* [count][nv] where each goes: permutations */
    int32_t *edge;   /* [count][ne] */
} rg_maps;

/* Of nv points X and ne edges E. A vertex goes to the nearest one within `tol`, a length, and no two to the same.
 * Borders go to borders, creases to those with the same, or the opposite, assignment and target. RG_ENOMEM. Owner: the
 * caller, rg_maps_free. */
rg_status rg_maps_find(rg_maps *g, const rg_memory *mem, int32_t nv, const rg_vec2 *X, int32_t ne, const rg_edge *E,
                       double tol);
void rg_maps_free(rg_maps *g);

#endif
