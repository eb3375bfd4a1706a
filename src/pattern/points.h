/* points.h -- points that grow into vertices: what is nearer than a tolerance is one vertex.
 * Uses  base        Used by  build.c planar.c */
#ifndef RG_POINTS_H
#define RG_POINTS_H

#include "base/memory.h"
#include "base/vec.h"

typedef struct rg_spread { rg_vec2 sum; int32_t count; } rg_spread; /* of the points of a vertex, about the first one */

typedef struct rg_points {
    rg_memory mem;
    rg_vec2 *X;        /* [count] */
    int32_t count;
    double tol;        /* distance; 0 merges equal points only */
    double merged_max; /* largest distance merged so far */
    double cell;
    rg_vec2 origin;
    int32_t *next, *head; /* chains of a hash table over square cells */
    rg_spread *spread;    /* until the points have settled; later ones are not moved */
    int is_settled;
    size_t room, next_room, spread_room, heads;
} rg_points;

/* `size`: of the box that holds the points, with `origin` its lower left corner. RG_ENOMEM.
 * Owner: the caller, rg_points_free, also after a failure. */
rg_status rg_points_init(rg_points *p, const rg_memory *mem, rg_vec2 origin, double size, double tol);
void rg_points_free(rg_points *p);
/* The vertex within the tolerance of x, the nearest if there are several, or a new one. RG_ENOMEM. */
rg_status rg_points_add(rg_points *p, rg_vec2 x, int32_t *vertex);
/* That x will be added: memory is on its way then. First where it is to be looked for; and `soon`, before it is added,
 * what is there. Changes nothing. */
void rg_points_expect(const rg_points *p, rg_vec2 x, int soon);
/* Takes the newest vertex out again. */
void rg_points_forget(rg_points *p);
/* Moves every vertex to the mean of the points that it was made of, and merges those that are within the tolerance
 * then.
 * now[count]: out, the vertex that each one has become. RG_ENOMEM. */
rg_status rg_points_settle(rg_points *p, int32_t *now);

/* Smallest distance of two of n points, INFINITY for fewer than two; `at`: one of them (may be NULL). RG_ENOMEM. */
rg_status rg_points_nearest(const rg_memory *mem, const rg_vec2 *X, int32_t n, double *distance, int32_t *at);

#endif
