/* measure.h -- everything that a report says of frames, from their fold angles and patterns alone.
 * Uses  motion.h loop.h        Used by  assemble.c create.c */
#ifndef RG_MEASURE_H
#define RG_MEASURE_H

#include "motion/motion.h"

/* Fills m->frame and the measurements of m->report; m->tree, m->target, m->from and the frames are there. RG_ENOMEM. */
rg_status rg_measure_frames(rg_motion *m);

#endif
