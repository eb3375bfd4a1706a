/* stl.h -- one frame as binary STL, facets cut into triangles; with a thickness, a closed solid to print.
 * Uses  motion.h solid.h mesh/triangles.h        Used by  output.c
 *
 * Little-endian, single precision, as the format has it: positions are about the sheet's middle, exact to 1e-7 of their
 * size. In millimetres where the file says what its unit is, else in the file's. */
#ifndef RG_STL_H
#define RG_STL_H

#include "motion/motion.h"
#include <stdio.h>

/* p->thickness above 0: plates so thick, joined at the creases (solid.h). RG_ENOMEM. */
rg_status rg_stl_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
