/* open.h -- from the flat-folded end to a state a little open, in which no layer has passed through another.
 * Uses  crossed.h end.h proximity.h nearest.h        Used by  passage.c */
#ifndef RG_OPEN_H
#define RG_OPEN_H

#include "unfold/crossed.h"
#include "unfold/end.h"
#include "unfold/proximity.h"

typedef struct rg_open_way {
    double part;      /* of its angle that a crease is wished open by */
    double give;      /* of the pattern: w of stride.h */
    double hard;      /* compliance of the rows: of drawings that are rounded, rows contradict each other */
    double margin;    /* that each crease has to be open by, radians; 0: creases that the rows lock stay at half a turn */
    int scaled;       /* what rows are wished open by goes with part, and its square */
    int grow;         /* non-zero: it is opened by very little first, and then more and more, up to part or as far as nothing
                       * crosses; closed at each step */
    int repair;       /* times that near parts are pushed apart by their side at most */
} rg_open_way;

typedef struct rg_open_result {
    double angle;     /* closure, radians */
    double worst;     /* the least signed distance of a near pair, negative: on its wrong side */
    double least;     /* the least gap of a row */
} rg_open_result;

typedef rg_status (*rg_open_keep)(void *ctx, const double *z);

/* z[n]: out. keep: called, where it grows, with each state on the way. budget: of work; where that ends it is as near as it came. near: its flags are left as they are. RG_ENOMEM. */
rg_status rg_open(rg_linkage *P, const rg_end *e, const rg_open_way *way, double budget, rg_crossed *crossed, rg_proximity *near,
                  rg_nearest *q, double *z, rg_open_keep keep, void *ctx, rg_open_result *result);
/* Pushes near parts of a state near the end apart, by their sides: at least `want`, if it can be `soft`. q->scale is set. */
rg_status rg_open_repair(rg_linkage *P, const rg_end *e, double want, double soft, double margin, int32_t most, double budget, rg_proximity *near,
                         rg_nearest *q, double *z, rg_open_result *result);

#endif
