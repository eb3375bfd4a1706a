/* crossed.h -- rows that part facets which have begun to cross, by the code that judges states.
 * Uses  contact.h nearest.h proximity.h        Used by  open.c stride.c
 *
 * Where layers lie all but on each other, sides and distances are as good as rounding lets them be, and a pair may be a
 * little on its wrong side without their knowing. What has begun to cross is parted along the shortest way while that
 * is still short. */
#ifndef RG_CROSSED_H
#define RG_CROSSED_H

#include "contact/contact.h"
#include "unfold/nearest.h"
#include "unfold/proximity.h"

enum { RG_CROSSED_MOST = 256 }; /* pairs at a time: a state with more is lost */

typedef struct rg_crossed {
    const rg_plates *plates; /* borrowed */
    rg_contact_work *look;   /* borrowed */
    rg_contact_hit hit[RG_CROSSED_MOST];
} rg_crossed;

/* One row for each pair that crosses deeper than rounding where P is put; the parts that meet are glued in near.
 * RG_ENOMEM. */
rg_status rg_crossed_add(rg_crossed *c, const rg_linkage *P, rg_proximity *near, rg_nearest *q);

#endif
