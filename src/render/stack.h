/* stack.h -- the order of facets that lie on each other in one plane, from where each lay a moment before.
 * Uses  pose.h triangles.h        Used by  lift.c */
#ifndef RG_STACK_H
#define RG_STACK_H

#include "pose/pose.h"
#include "mesh/triangles.h"

typedef struct rg_stack_sample { int32_t row, column, facet; double height; } rg_stack_sample;
typedef struct rg_stack_pair { int32_t a, b, above; } rg_stack_pair; /* a < b; +1: b lies above a, -1: below */

typedef struct rg_stack {
    rg_memory mem;
    const rg_mesh *mesh;
    const rg_triangles *triangles;
    double spacing;           /* of the grid on which facets are compared */
    rg_stack_sample *sample, *sorted; /* facets over each grid point; to sort them */
    int32_t *place;           /* of the next sample of each row or column */
    rg_stack_pair *pair;      /* neighbours in a pile */
    int32_t samples, pairs;
    size_t sample_room, sorted_room, place_room, pair_room;
    int32_t *below;           /* [nf] facets right under each that have no level yet */
    int32_t *rank;            /* [nf] of each in its group */
    int32_t *start, *upper;   /* [group + 1] by rank, [upper_room] those right above each */
    size_t upper_room;
    int32_t *queue;           /* [nf] */
    double *height;           /* [nf] mean height of each before, to cut a circle where it is lowest */
    int32_t *count;           /* [nf] */
} rg_stack;

/* `m` and `t` are kept by reference. RG_ENOMEM. Owner: the caller, rg_stack_free, also after a failure. */
rg_status rg_stack_init(rg_stack *s, const rg_memory *mem, const rg_mesh *m, const rg_triangles *t);
/* Orders the n facets in facet[], all in the plane through `base` with normal `up`.
 *   x[nv]      positions
 *   back[nf]   from where a facet is to where it was when the facets were apart
 *   level[nf]  out, for these facets only: 0 the lowest; every facet is above all that it lies upon
 *   levels     out, how many levels there are; 1: no facet lies on another
 * Facets are compared on a grid of about 40 000 + 16 nf points for all of the sheet: overlaps that no point falls on
 * are not seen. Where the order runs in a circle (as the flaps of a closed box do), it is cut at the facet that lay
 * lowest; also then no two facets that lie on each other have the same level. RG_ENOMEM. */
rg_status rg_stack_order(rg_stack *s, const int32_t *facet, int32_t n, rg_vec3 base, rg_vec3 up, const rg_vec3 *x,
                         const rg_place *back, int32_t *level, int32_t *levels);
void rg_stack_free(rg_stack *s);

#endif
