/* stage.h -- a motion put before the camera: it turns as little as it can, and shows its symmetry and most of its
 * paper.
 * Paper    section 4        Uses  motion.h maps.h        Used by  render, write
 *
 * A motion has one facet that stays where it is, so that all others seem to swing round it. On the stage it is the
 * sheet as a whole that stays: each frame is turned to lie as near as it can to the frame before (Horn, "Closed-form
 * solution of absolute orientation using unit quaternions", 1987), and a little to where the sheet lay when it was
 * flat, with its middle at the origin. What is alike stays so: a sheet that folds symmetrically keeps its axis where it
 * was. The camera then needs never turn. */
#ifndef RG_STAGE_H
#define RG_STAGE_H

#include "motion/motion.h"

typedef struct rg_stage {
    rg_memory mem;
    const rg_motion *motion;
    rg_place *place;           /* [frame_count] where each frame is put */
    /* of the camera, the same for all frames, radians; roll: counter-clockwise, as it holds itself */
    double azimuth, elevation, roll;
    int turned; /* non-zero: it lies on its front, so that what it folds rises towards the one who looks */
} rg_stage;

/* `m` is kept by reference. p: its view, and if it says so one that is chosen. RG_ENOMEM. Owner: the caller,
 * rg_stage_free, also after a failure. */
rg_status rg_stage_init(const rg_memory *mem, const rg_motion *m, const rg_picture *p, rg_stage *s);
void rg_stage_free(rg_stage *s);
/* x[n]: positions in that frame of the motion, in and out. */
void rg_stage_put(const rg_stage *s, int32_t frame, rg_vec3 *x, int32_t n);
/* d[n]: the same for what has a direction and no place. */
void rg_stage_turn(const rg_stage *s, int32_t frame, rg_vec3 *d, int32_t n);

#endif
