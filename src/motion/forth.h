/* forth.h -- a run straight on, kept as frames and the states between them.
 * Uses  gaps.h trace.h watch.h        Used by  attempt.c
 *
 * What lies between two frames is read off the nodes that are there when the second one is; these are let go as the run goes on, so
 * that frames which are far from each other are made with others between. */
#ifndef RG_FORTH_H
#define RG_FORTH_H

#include "fold/trace.h"
#include "motion/gaps.h"
#include "motion/watch.h"

/* Each way from frame to frame is to be cut into so many: a run of (frames - 1) parts + 1 frames. 1 where steps are made to land on
 * frames: what the user has chosen should not become another method. */
int32_t rg_forth_parts(const rg_settings *s);
/* Runs f, which is made with so many frames, to its end, or until the watch has it stop. rho[frames + 1][N], *count, *outcome: out;
 * *g: out, more of it. due[frames + 1]: out, the progress of each; trace: out, its path; NULL: not asked for. RG_ENOMEM. */
rg_status rg_forth_run(rg_straight *f, const rg_memory *mem, int32_t parts, rg_watch *watch, double *rho, int32_t *count, rg_gaps *g,
                       rg_outcome *outcome, double *due, rg_trace *trace);

#endif
