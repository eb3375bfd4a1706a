/* measure.h -- everything that a report says of frames, from their fold angles and patterns alone.
 * Uses  motion.h loop.h course.h watch.h        Used by  assemble.c create.c ending.c keeping.c unfolding.c */
#ifndef RG_MEASURE_H
#define RG_MEASURE_H

#include "motion/motion.h"
#include "motion/watch.h"

/* Fills m->frame and the measurements of m->report; m->tree, m->target, m->from and the frames are there. Once
 * the watch (NULL: nobody's) says so, contact is not looked for any more. RG_ENOMEM. */
rg_status rg_measure_frames(rg_motion *m, rg_watch *watch);
/* Of a state: the mean of what was done of each driven crease's way, percent; `none`: where none is driven. */
double rg_measure_percent(const rg_motion *m, const double *rho, double none);
/* The report's contact is of these two facets. */
void rg_measure_place(rg_motion *m, const int32_t facet[2]);

#endif
