/* overlap.h -- the common place of two facets that lie on each other, as polygons.
 * Uses  pairs.h        Used by  layers.c, contact */
#ifndef RG_LAYERS_OVERLAP_H
#define RG_LAYERS_OVERLAP_H

#include "layers/pairs.h"

typedef struct rg_overlaps {
    rg_memory mem;
    int32_t *start;    /* [pairs + 1] into loop: polygons of a pair; one where both facets are convex, but for rounding */
    int32_t *loop;     /* [start[pairs] + 1] into corner */
    rg_vec2 *corner;   /* counter-clockwise round each, where the border turns; in the plane of flat.h, to c->tol */
    int32_t loops, corners;
    size_t loop_room, corner_room;
} rg_overlaps;

/* Of all pairs. RG_ENOMEM. Owner: the caller, rg_overlaps_free, also after a failure. */
rg_status rg_overlaps_init(rg_overlaps *o, const rg_memory *mem, const rg_cells *c, const rg_pairs *p);
void rg_overlaps_free(rg_overlaps *o);

#endif
