/* html.h -- the motion as one page: turn it, fold and unfold it, without a network.
 * Uses  motion.h render/lift.h write/page/        Used by  output.c
 *
 * Frames are the positions of vertices in single precision. The page finds from them how each facet turns and shifts,
 * and between frames turns it on, so that it stays rigid; where creases were adjusted facets change shape, and vertices
 * move straight. Facets that lie on each other are drawn apart. */
#ifndef RG_HTML_H
#define RG_HTML_H

#include "motion/motion.h"
#include <stdio.h>

/* All frames, in the colours and from the side of *p; `frame` is not looked at. RG_ENOMEM. */
rg_status rg_html_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
