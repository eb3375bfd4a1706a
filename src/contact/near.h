/* near.h -- corners and edges that come near facets and edges they are not part of: what a motion without contact has
 * to watch.
 * Uses  plates.h        Used by  unfold/proximity.c
 *
 * Two plates that do not meet are nearest either at a corner of one and a point of the other, or at points of two
 * edges. */
#ifndef RG_CONTACT_NEAR_H
#define RG_CONTACT_NEAR_H

#include "contact/plates.h"

typedef enum rg_near_kind { RG_NEAR_CORNER, RG_NEAR_EDGES } rg_near_kind;

typedef struct rg_near_work {
    rg_memory mem;
    rg_box *box;   /* [nodes] */
    int32_t *leaf;        /* [parts] its node */
    int32_t *corner_part; /* [nv] the part with which a corner is looked at */
    int32_t *edge_part;   /* [ne] the same of an edge */
    int32_t *side;        /* [corners of parts] the edge to the next corner; -1: a cut */
} rg_near_work;

/* RG_ENOMEM: *w is zeroed. */
rg_status rg_near_work_init(const rg_plates *p, rg_near_work *w);
void rg_near_work_free(rg_near_work *w);

/* Called with each pair of features whose boxes are no farther apart than `reach` at x[nv], or, with y not NULL, on the
 * straight ways from x to y: corner i and part j, or the edges i and j. Each pair once, in an order that depends on
 * nothing but the sheet; also features that have a corner in common. Allocates nothing. */
typedef void rg_near_visitor(void *ctx, rg_near_kind kind, int32_t i, int32_t j);
void rg_near_candidates(const rg_plates *p, const rg_vec3 *x, const rg_vec3 *y, double reach, rg_near_work *w,
                        rg_near_visitor *visit, void *ctx);

/* The nearest points of a triangle and of two segments. weight[3]: of the triangle's corners; s, t: along the
 * segments. Returns the distance; *n: out, unit, from the second to the first, or zero. */
double rg_near_triangle(rg_vec3 p, rg_vec3 a, rg_vec3 b, rg_vec3 c, double weight[3], rg_vec3 *n);
double rg_near_segments(rg_vec3 a, rg_vec3 b, rg_vec3 c, rg_vec3 d, double *s, double *t, rg_vec3 *n);

#endif
