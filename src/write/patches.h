/* patches.h -- of a flat end whose layers lie on each other in a circle, the pieces of facets that no one level a facet
 * shows right.
 * Uses  layers/layers.h        Used by  html.c
 *
 * Facets at one height each are in order everywhere but where the circle is cut (rg_layers_levels). There the facet
 * that is on top, or lowest, is drawn once more, over a cell of the overlap, above or below all others. */
#ifndef RG_PATCHES_H
#define RG_PATCHES_H

#include "layers/layers.h"

typedef struct rg_patches {
    rg_memory mem;
    int32_t count;
    int32_t *facet;      /* [count] of the mesh */
    int32_t *raise;      /* [count] levels to raise it by, negative: to lower */
    int32_t *start;      /* [count + 1] into the two that follow */
    int32_t *edge;       /* of the mesh, that lies along the side from a corner to the next; -1: none */
    rg_vec2 *corner;     /* in the pattern, as the facet runs */
    int32_t low, high;   /* two facets of the mesh of different levels, and by how many levels they differ */
    int32_t apart;
    size_t room[5];
} rg_patches;

/* count 0: there is no circle. RG_ENOMEM. Owner: the caller, rg_patches_free, also after a failure. */
rg_status rg_patches_init(rg_patches *p, const rg_memory *mem, const rg_layers *l);
void rg_patches_free(rg_patches *p);

#endif
