/* sides.h -- on which side of each other near parts of the sheet belong, by the order of layers in the flat end.
 * Uses  linkage.h proximity.h        Used by  end.c stride.c
 *
 * As long as two layers are all but on each other, their distance does not tell whether they have passed through one
 * another; the order does. Once they are apart, distance and conservative advancement keep them so. */
#ifndef RG_SIDES_H
#define RG_SIDES_H

#include "base/stop.h"
#include "unfold/proximity.h"
#include "unfold/linkage.h"

typedef struct rg_sides {
    rg_memory mem;
    const rg_mesh *mesh;    /* borrowed */
    signed char *up;        /* [nf] +1: the facet's front is up in the flat end; -1: its back */
    signed char *over;      /* [nf][nf] +1: the first lies over the second, -1: under it, 0: they don't overlap */
    /* [nv][nf] of all facets at the vertex that overlap the facet: +1 all over it, -1 all under; 0: neither; from 10,
     * 13, 16 on with the edge of the facet that the vertex lies on: over it, under it, and inside that folded edge;
     * outside it, partly over and partly under the facet */
    signed char *corner;
    signed char *edge;      /* [ne][ne] the same of the facets at either edge */
    /* The same pairs: non-zero: a third facet lies between the two where they meet, so that what it keeps apart from
     * either is apart. */
    unsigned char *corner_behind, *edge_behind;
} rg_sides;

/* up and over are zero, to be filled, then rg_sides_finish with the positions x[nv] in the plane. RG_ENOMEM. Owner: the
 * caller, rg_sides_free. */
rg_status rg_sides_init(rg_sides *s, const rg_memory *mem, const rg_mesh *m);
void rg_sides_finish(rg_sides *s, const rg_vec2 *x, const rg_stop *stop);
void rg_sides_free(rg_sides *s);

/* Non-zero: the pair, found at P->p, has a side: *n, out, points from its second part to the first in the order's
 * sense, and *d is how far along it they are apart, negative where they have passed. Where a corner goes round an edge,
 * at->weight is of the point of that edge. */
int rg_sides_tell(const rg_sides *s, const rg_linkage *P, rg_close_pair *at, rg_vec3 *n, double *d);
/* Non-zero: a third facet lies between the two parts of the pair. */
int rg_sides_is_behind(const rg_sides *s, const rg_close_pair *at);

#endif
