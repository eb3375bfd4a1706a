/* obj.h -- one frame as Wavefront OBJ: facets as the polygons that they are, a group for each side, and creases as
 * comments that name them.
 * Uses  motion.h        Used by  output.c
 *
 * Facet 7 is in groups `front facet7` and, turned over, `back facet7`. After the facets comes a line `#e i j type
 * angle` for each edge, as Freeform Origami and Origami Simulator have it: i, j count vertices from 1, type is 0
 * border, 1 flat or undecided, 2 valley, 3 mountain; angle is that of the frame in degrees, valley positive. */
#ifndef RG_OBJ_H
#define RG_OBJ_H

#include "motion/motion.h"
#include <stdio.h>

/* `p` is not looked at. RG_ENOMEM. */
rg_status rg_obj_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
