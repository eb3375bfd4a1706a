/* ending.h -- the layers of a motion's flat end.
 * Uses  motion.h layers.h watch.h        Used by  assemble.c create.c keeping.c unfolding.c; files, render, write */
#ifndef RG_ENDING_H
#define RG_ENDING_H

#include "layers/layers.h"
#include "motion/motion.h"
#include "motion/watch.h"

/* Makes m->layers: of the last frame where it is flat, all creases at 0 or half a turn, else of the end that was aimed
 * at. Takes an order, the one nearest to how the facets lay before, or the first one, and fills what the report says of
 * it; not once the watch (NULL: nobody's) says so. RG_ENOMEM. */
rg_status rg_ending_find(rg_motion *m, rg_watch *watch, rg_diag *why);
/* The order in which the facets lie in that frame: m->layers, an order chosen; NULL: it is not flat, or there is
 * none. */
const rg_layers *rg_ending_layers(const rg_motion *m, int32_t frame);

#endif
