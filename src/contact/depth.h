/* depth.h -- how deep two convex plates cross.
 * Uses  vec.h        Used by  contact.c
 *
 * Two plates cross when the overlap of their shadows is positive along every axis of the separating-axis theorem: both
 * normals, and every edge of the one by every edge of the other (Gottschalk, Lin and Manocha 1996, there for boxes).
 * The depth is the least of these overlaps: the shortest way to part them. Plates that touch, or lie in one plane, have
 * depth 0. */
#ifndef RG_DEPTH_H
#define RG_DEPTH_H

#include "base/vec.h"

#include <stdint.h>

typedef struct rg_plate {
    int32_t n;
    const rg_vec3 *x; /* [n] corners */
    rg_vec3 normal;   /* unit length */
} rg_plate;

/* The unit normal of a plane polygon x[n]; zero where it has no area. */
rg_vec3 rg_depth_normal(const rg_vec3 *x, int32_t n);
/* The depth where it is more than `least` >= 0, else 0. axis: out, may be NULL: unit, along which moving b, or back,
 * parts them. */
double rg_depth_of(const rg_plate *a, const rg_plate *b, double least, rg_vec3 *axis);
/* The length over which two plates cross along the line of their planes. */
double rg_depth_stretch(const rg_plate *a, const rg_plate *b);

#endif
