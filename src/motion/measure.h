/* measure.h -- everything that a report says of frames, from their fold angles and patterns alone.
 * Uses  motion.h loop.h attempt.h        Used by  assemble.c create.c keeping.c */
#ifndef RG_MEASURE_H
#define RG_MEASURE_H

#include "motion/attempt.h"

/* Fills m->frame and the measurements of m->report; m->tree, m->target, m->from and the frames are there. Once
 * the watch (NULL: nobody's) says so, contact is not looked for any more. RG_ENOMEM. */
rg_status rg_measure_frames(rg_motion *m, rg_watch *watch);
/* The report's contact is of these two facets. */
void rg_measure_place(rg_motion *m, const int32_t facet[2]);

#endif
