/* near.h -- corners and edges that come near facets and edges they are not part of: what a motion without contact has to watch.
 * Uses  plates.h        Used by  sweep.c, unfold/proximity.c
 *
 * Two plates that do not meet are nearest either at a corner of one and a point of the other, or at points of two edges. */
#ifndef RG_NEAR_PAIRS_H
#define RG_NEAR_PAIRS_H

#include "contact/plates.h"

typedef enum rg_near_kind { RG_NEAR_CORNER, RG_NEAR_EDGES } rg_near_kind;

/* The distance is n . (sum of weight[i] x[v[i]]); with n and the weights held, its change is that of the distance to first
 * order, as both are where it is least.
 *   corner   v[0] the corner, weight 1; v[1..3] a triangle of the facet, weights -1 together
 *   edges    v[0], v[1] one edge, weights 1 together; v[2], v[3] the other, weights -1 together; both points inside */
typedef struct rg_near_pair {
    rg_near_kind kind;
    int32_t facet[2]; /* a facet of the first feature, the facet or a facet of the second */
    int32_t v[4];
    double weight[4];
    double distance;  /* file units */
    rg_vec3 n;        /* unit, from the second to the first; zero where they touch, then nothing says which way they part */
} rg_near_pair;

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

/* Called with each pair of features whose boxes are no farther apart than `reach` at x[nv], or, with y not NULL, on the straight ways
 * from x to y: corner i and part j, or the edges i and j; of parts a and b. Each pair once, in an order that depends on nothing but the
 * sheet; also features that have a corner in common. Allocates nothing. */
typedef void rg_near_visitor(void *ctx, rg_near_kind kind, int32_t i, int32_t j, int32_t a, int32_t b);
void rg_near_candidates(const rg_plates *p, const rg_vec3 *x, const rg_vec3 *y, double reach, rg_near_work *w, rg_near_visitor *visit,
                        void *ctx);

/* The pairs nearer than `reach` (file units) as vertices are placed by x[nv], each once: no pair of features that have a corner
 * in common, or of the two facets of one crease. Returns how many there are; the first `room` are in pair[], in an order that
 * depends on nothing but the sheet. Allocates nothing. */
int32_t rg_near_find(const rg_plates *p, const rg_vec3 *x, double reach, rg_near_work *w, rg_near_pair *pair, int32_t room);

/* The nearest points of a triangle and of two segments. b[3]: weights of the triangle's corners; s, t: along the segments.
 * Returns the distance; *n: out, unit, from the second to the first, or zero. */
double rg_near_triangle(rg_vec3 p, rg_vec3 a, rg_vec3 b, rg_vec3 c, double weight[3], rg_vec3 *n);
double rg_near_segments(rg_vec3 a, rg_vec3 b, rg_vec3 c, rg_vec3 d, double *s, double *t, rg_vec3 *n);

#endif
