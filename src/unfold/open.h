/* open.h -- from the flat-folded end to a state a little open, in which no layer has passed through another.
 * Uses  crossed.h end.h proximity.h nearest.h        Used by  passage.c */
#ifndef RG_OPEN_H
#define RG_OPEN_H

#include "unfold/crossed.h"
#include "unfold/end.h"
#include "unfold/proximity.h"

typedef struct rg_open_way {
    double part;      /* of its angle that a crease is wished open by */
    double hard;      /* compliance of the rows: of drawings that are rounded, rows contradict each other */
    double margin;    /* that each crease has to be open by, radians; 0: what the rows lock stays at half a turn */
    /* Non-zero: it is opened by very little first, and then more and more, up to part or as far as nothing crosses,
     * closed at each step; what rows are wished open by goes with that, and its square. */
    int grow;
    int repair;       /* times that near parts are pushed apart by their side at most */
} rg_open_way;

typedef struct rg_opening {
    /* All borrowed. */
    rg_linkage *P;
    const rg_end *end;
    const rg_open_way *way;
    rg_crossed *crossed;
    rg_proximity *near; /* its flags are left as they are */
    rg_nearest *q;
    double until;       /* of rg_nearest_work(q): where that ends it, it is as near as it came */
    rg_status (*keep)(void *ctx, const double *z); /* called, where it grows, with each state on the way */
    void *ctx;
    /* Out. */
    double *z;          /* [n] */
    double angle;       /* closure, radians */
    double worst;       /* the least signed distance of a near pair, negative: on its wrong side */
} rg_opening;

/* RG_ENOMEM. */
rg_status rg_open(rg_opening *o);

#endif
