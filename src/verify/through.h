/* through.h -- whether facets go through each other, in a frame or on the way to the next.
 * Uses  apart.h faults.h        Used by  certificate.c */
#ifndef RG_THROUGH_H
#define RG_THROUGH_H

#include "verify/faults.h"
#include "verify/apart.h"

/* A crossing counts from this part of the sheet on. */
#define RG_THROUGH_LEAST 1e-4
/* Between frames, where the way is only known to be rigid, what bends of the path leave open is added, up to this in
 * all. */
#define RG_THROUGH_MOST 1e-3

typedef struct rg_through {
    double depth;   /* the deepest crossing in a frame, over the sheet's size; 0: none */
    double allowed; /* between frames no crossing deeper than this part of the sheet was let pass */
    /* of pieces that came near each other before the last frame: on which side of each other they come into it */
    rg_aparts sides;
} rg_through;

/* All frames, and all ways between them on which every facet is rigid: of a pair, the second turns steadily, as the
 * first sees it, about a common corner or else on a screw, about one line and along it. A way is halved until each part
 * is proved free by bounds that hold for all of it. They are apart along an axis all the time, or less deep in each
 * other than is allowed; and from axis to axis there is a way on which they stay so: what lies on each other in one
 * plane can't come from above to below, through all frames. RG_ENOMEM; found->sides is to be freed in any case. */
rg_status rg_through_frames(const rg_record *r, const rg_pieces *p, rg_faults *all, rg_through *found);

#endif
