/* fold.h -- the handle behind rigami.h's rg_fold: a track of states, and the one that it stands on.
 * Uses  motion.h        Used by  stepping.c
 *
 * The track is the motion's frames until somebody steers; from then on it is a list of its own, of which the last leg grows step by
 * step. Motions never change, so clones and snapshots share one. */
#ifndef RG_FOLD_H
#define RG_FOLD_H

#include "motion/motion.h"
#include <stdatomic.h>

typedef struct rg_shared {
    rg_motion *motion; /* owned by the last who lets go */
    atomic_int holders;
} rg_shared;

struct rg_fold {
    rg_memory mem;
    rg_settings settings;
    rg_shared *shared;
    int32_t at;        /* the last state of the track that it has passed */
    int between;       /* non-zero: it is beyond that one, before the next */
    double *rho;       /* [N] the present state */
    rg_vec2 *flat;     /* [nv] its pattern */
    rg_place *place;   /* [nf] */
    rg_vec3 *x;        /* [nv] */
    rg_step_info info;
};

#endif
