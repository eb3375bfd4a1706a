/* frames.h -- the frames of a motion as pictures, drawn by several threads.
 * Paper    section 4        Uses  render.h lift.h        Used by  draw.c film.c */
#ifndef RG_FRAMES_H
#define RG_FRAMES_H

#include "motion/motion.h"
#include "render/print.h"

typedef struct rg_frames {
    rg_picture picture;
    const rg_print *print; /* on the paper's front; NULL: nothing */
    int32_t first, step; /* frames first, first + step, ... to the last one */
    int32_t threads;     /* at most; 0: as many as there are processors */
    int in_order;        /* take() is called for one frame after the other, else by several threads at once */
    /* rgb: rows of picture.width pixels of 3 bytes, top row first, borrowed. mem: the motion's allocator, to be used by
     * one thread at a time. A status other than RG_OK ends it all. */
    rg_status (*take)(void *ctx, const rg_memory *mem, int32_t frame, const unsigned char *rgb, rg_diag *why);
    int (*has)(void *ctx, int32_t frame); /* non-zero: this frame need not be drawn; under a lock, one at a time. NULL:
                                           * all are drawn. Not with in_order */
    void *ctx;
} rg_frames;

/* The pictures do not depend on how many threads draw them, and no signal is handled by these. RG_EARG: see
 * rg_picture_check; RG_EABSENT, RG_ENOMEM, or what take() said first. */
rg_status rg_frames_draw(const rg_motion *m, const rg_frames *f, rg_diag *why);

#endif
