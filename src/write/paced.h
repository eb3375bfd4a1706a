/* paced.h -- a motion's frames made anew, even in the largest angle that a crease turns: for what is looked at.
 * Uses  motion/between.h        Used by  output.c */
#ifndef RG_PACED_H
#define RG_PACED_H

#include "motion/motion.h"

/* Borrows from m all but its frames' own arrays: as many frames, the first and the last one the same, those between
 * them on the chords of m's frames, closed, with the crease that turns most where it is due. A motion that plates do
 * not reach is left as it is. Owner: the caller, rg_paced_free, also after a failure. RG_ENOMEM, RG_EABSENT. */
rg_status rg_paced_init(rg_motion *paced, const rg_motion *m);
void rg_paced_free(rg_motion *paced, const rg_motion *m);

#endif
