/* plates.h -- facets as plates that can meet: convex parts, and a tree of them.
 * Uses  mesh.h pose.h        Used by  contact.c sweep.c near.c front.c */
#ifndef RG_PLATES_H
#define RG_PLATES_H

#include "mesh/mesh.h"
#include "pose/pose.h"

/* A crossing counts from this part of the sheet's size on: drawings are rounded to some 1e-5 of it, and paper is
 * thicker. */
#define RG_CONTACT_TOLERANCE 1e-4
/* Between two states the way is not known; what that leaves open may be added, but not to more than this part of the
 * sheet's size: with frames so far apart that more is open, a crossing could be anything. */
#define RG_CONTACT_BETWEEN 1e-3

/* Facets about a common corner: a crossing over less of the sheet's size is how the corner is rounded. And layers that
 * lie on each other over less of it are beside each other. */
#define RG_CONTACT_STRETCH 1e-3

/* The most corners of one part, so that a pair of parts fits into fixed room; facets of more are cut. */
enum { RG_PLATE_CORNERS = 32 };

typedef struct rg_plates_node {
    int32_t part;  /* of a leaf; -1: not a leaf, its left child is the next node */
    int32_t right; /* the other child */
    int32_t end;   /* the node after the last one below it */
} rg_plates_node;

/* Parts are convex on the pattern that they were made from; facets that are convex are one part. Lives as long as the
 * mesh, which it borrows. Read only once made: any number of threads may share it. */
typedef struct rg_plates {
    rg_memory mem;
    const rg_mesh *mesh;
    double size;                         /* of the sheet: its diagonal over sqrt(2), the side of a square; file units */
    int32_t parts;
    int32_t *facet;                      /* [parts] */
    int32_t *start, *vertex;             /* [parts + 1] counter-clockwise corners of a part */
    int32_t *first;                      /* [nf + 1] the parts of a facet stand together */
    int32_t nodes;                       /* 2 parts - 1 */
    /* parents before children; neighbours on the sheet are neighbours in the tree */
    rg_plates_node *node;
    int32_t borders, *border;            /* edges of the sheet's border */
} rg_plates;

/* RG_ENOMEM: *p is zeroed. */
rg_status rg_plates_init(const rg_mesh *m, rg_plates *p);
void rg_plates_free(rg_plates *p);

/* How many corners two facets have in common, counted up to 2; *v: one of them, -1: none. */
int32_t rg_plates_shared(const rg_mesh *m, int32_t f, int32_t g, int32_t *v);
/* The middle of a facet's corners in the pattern, file coordinates. */
rg_vec2 rg_plates_middle(const rg_mesh *m, int32_t f);

/* The sheet in one state, as rg_pose_facets and rg_pose_vertices place it. */
typedef struct rg_plates_state {
    const rg_vec2 *X;      /* [nv] the pattern */
    const rg_place *place; /* [nf] */
    const rg_vec3 *x;      /* [nv] */
} rg_plates_state;

typedef struct rg_box { rg_vec3 low, high; } rg_box;

/* Written with ?: as fmin takes care of NaN, which costs more than all the rest. A place that is NaN is missed; the
 * motion is not closed then, which is told elsewhere. */
static inline void rg_box_take_in(rg_box *box, rg_vec3 x)
{
    box->low.x = x.x < box->low.x ? x.x : box->low.x;
    box->low.y = x.y < box->low.y ? x.y : box->low.y;
    box->low.z = x.z < box->low.z ? x.z : box->low.z;
    box->high.x = x.x > box->high.x ? x.x : box->high.x;
    box->high.y = x.y > box->high.y ? x.y : box->high.y;
    box->high.z = x.z > box->high.z ? x.z : box->high.z;
}

/* Goes down the tree as far as two nodes may have to do with each other: meet is called for every two leaves i, k that
 * are reached, always in the same order. */
typedef struct rg_plates_walk {
    const rg_plates *p;
    /* zero: nothing below the one has to do with anything below the other */
    int (*may)(void *ctx, int32_t i, int32_t k);
    void (*meet)(void *ctx, int32_t i, int32_t k);
    void *ctx;
} rg_plates_walk;
void rg_plates_walk_pairs(const rg_plates_walk *w);

/* box[nodes]: out, around the parts as placed by x[nv], and then around all below a node. */
void rg_plates_boxes(const rg_plates *p, const rg_vec3 *x, rg_box *box);
/* box: grown around the parts as placed by y[nv], too. */
void rg_plates_boxes_take_in(const rg_plates *p, const rg_vec3 *y, rg_box *box);

#endif
