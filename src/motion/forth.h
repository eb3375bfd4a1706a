/* forth.h -- a run straight on, kept as frames and the states between them.
 * Uses  gaps.h trace.h watch.h        Used by  attempt.c frames.c
 *
 * What lies between two frames is read off the nodes that are there when the second one is; these are let go as the run
 * goes on, so that frames which are far from each other are made with others between. */
#ifndef RG_FORTH_H
#define RG_FORTH_H

#include "fold/trace.h"
#include "motion/gaps.h"
#include "motion/watch.h"

typedef struct rg_forth {
    rg_straight *f;
    int32_t parts;      /* f is made with (frames - 1) parts + 1 frames, of which every parts-th is one */
    rg_trace *trace;    /* out, its path; NULL: not asked for */
    double *rho;        /* [frames + 1][N] out, frames */
    double *due;        /* [frames + 1] out, the progress of each; NULL: not asked for */
    rg_gaps *gaps;      /* out, more of them */
    int32_t count;      /* out, of frames */
    rg_outcome outcome; /* out */
} rg_forth;

/* Each way from frame to frame is to be cut into so many. 1 where steps are made to land on frames: what the user has
 * chosen should not become another method. */
int32_t rg_forth_parts(const rg_settings *s);
/* Runs to the end, or until the watch has it stop. RG_ENOMEM. */
rg_status rg_forth_run(rg_forth *r, const rg_memory *mem, rg_watch *watch);

#endif
