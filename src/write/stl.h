/* stl.h -- one frame as binary STL, facets cut into triangles.
 * Uses  motion.h render/triangles.h        Used by  output.c
 *
 * Little-endian, single precision, as the format has it: positions are exact to 1e-7 of their size. */
#ifndef RG_STL_H
#define RG_STL_H

#include "motion/motion.h"
#include <stdio.h>

/* `p` is not looked at. RG_ENOMEM. */
rg_status rg_stl_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
