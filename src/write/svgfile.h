/* svgfile.h -- the crease pattern as it was folded, as a drawing.
 * Paper    section 3.1 (closed vertices), 3.2 (added creases), 3.3 (adjusted creases)
 * Uses  motion.h pattern/closed.h        Used by  output.c
 *
 * Mountain red, valley blue, border black, undecided magenta, flat and added creases grey; a ring around each closed
 * vertex, a disc on each vertex that holds a run that stopped. Where creases were adjusted, it is the pattern of the
 * frame that lies farthest from the one given. y is turned round, as svg's runs down; x keeps its values. */
#ifndef RG_SVGFILE_H
#define RG_SVGFILE_H

#include "motion/motion.h"
#include <stdio.h>

/* `frame` and `p` are not looked at. RG_ENOMEM. */
rg_status rg_svgfile_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
