/* proximity.h -- which corners are near which triangles, which edges near which, and whether they meet while they move.
 * Uses  contact/near.h        Used by  crossed.c open.c sides.c stride.c
 *
 * Two triangles are as near as a corner of one to the other, or an edge of one to an edge of the other. Left out is
 * what the hinges keep apart: what shares a vertex, and the two facets of a crease. Conservative advancement: Mirtich,
 * 1996. */
#ifndef RG_PROXIMITY_H
#define RG_PROXIMITY_H

#include "contact/near.h"

/* A corner (kind 0: v[0], weight 1) against a triangle (v[1..3], weights -w), or an edge (kind 1: v[0], v[1]) against
 * an edge (v[2], v[3]): the closest points are apart by the sum of weight[i] p[v[i]]. */
typedef struct rg_close_pair {
    int32_t kind, i, j; /* vertex and facet, or the two edges, i > j */
    int32_t v[4];
    double weight[4];
    double d;           /* distance */
    rg_vec3 n;          /* unit, from the second to the first; zero where they touch */
} rg_close_pair;

typedef struct rg_proximity {
    rg_memory mem;
    const rg_mesh *mesh; /* borrowed: triangles */
    /* [nv][nf], [ne][ne], i > j: flags of a pair, of which RG_PROXIMITY_APART is set here */
    unsigned char *corner, *edge;
    rg_plates plates;
    rg_near_work work;
    rg_close_pair *pair;
    size_t room;
    int32_t count;
} rg_proximity;

enum {
    RG_PROXIMITY_APART = 1, /* kept apart by a hinge */
    RG_PROXIMITY_GLUED = 2, /* its layers lie on each other */
    RG_PROXIMITY_ABOVE = 4, /* when last apart, the first part was on the side that the second's normal points to, */
    RG_PROXIMITY_BELOW = 8, /* on the other: of edges, the normal of both, first by second */
    RG_PROXIMITY_PUSHED = 16, /* while it opened, its row pushed; */
    RG_PROXIMITY_LAYER = 32   /* a row of the end speaks of it */
};

rg_status rg_proximity_init(rg_proximity *n, const rg_memory *mem, const rg_mesh *m);
void rg_proximity_free(rg_proximity *n);
/* The flags of a pair. */
unsigned char *rg_proximity_flags(rg_proximity *n, int32_t kind, int32_t i, int32_t j);
/* n->pair[n->count]: all pairs nearer than `least` at p[nv]; of edges whose shortest line ends at a corner, which is as
 * near to what is beside the edge, only those nearer than `touching`. RG_ENOMEM: more room was needed. */
rg_status rg_proximity_find(rg_proximity *n, const rg_vec3 *p, double least, double touching);
/* Both ends of the shortest line are inside their edges. */
int rg_proximity_is_inside(const rg_close_pair *at);
/* *at: out, a pair as it is at p, where it need not be near. Returns its distance. */
double rg_proximity_distance(const rg_proximity *n, int32_t kind, int32_t i, int32_t j, const rg_vec3 *p,
                             rg_close_pair *at);
/* From the second of the closest points to the first, when vertices are at p. */
rg_vec3 rg_proximity_apart(const rg_close_pair *at, const rg_vec3 *p);
/* The same over at->d. */
rg_vec3 rg_proximity_direction(const rg_close_pair *at, const rg_vec3 *p);

/* Vertices go from p to q along straight lines. Returns the part of it, 1: all, that can be gone before a pair, none of
 * the glued ones, is nearer than `gap` of its distance at p. It errs to the safe side: a pair that takes too many
 * advances counts as one that meets. */
double rg_proximity_meet(rg_proximity *n, const rg_vec3 *p, const rg_vec3 *q, double gap);

#endif
