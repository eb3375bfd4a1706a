/* dxffile.h -- the crease pattern as it was folded, adjusted and triangulated, for cutters.
 * Uses  motion.h save/dxf.h        Used by  output.c */
#ifndef RG_DXFFILE_H
#define RG_DXFFILE_H

#include "motion/motion.h"
#include <stdio.h>

/* The pattern of the last frame; `frame` and `p` are not looked at. RG_ENOMEM. */
rg_status rg_dxffile_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
