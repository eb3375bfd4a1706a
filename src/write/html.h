/* html.h -- the motion as one page: turn it, fold and unfold it, without a network.
 * Uses  motion.h pose/turn.h render/layers.h write/page.html        Used by  output.c
 *
 * The page poses facets by the turns and shifts of the frames, between frames by turning on; where creases were adjusted
 * facets change shape, and it has the positions of vertices instead. Facets that lie on each other are drawn apart. */
#ifndef RG_HTML_H
#define RG_HTML_H

#include "motion/motion.h"
#include <stdio.h>

/* All frames, in the colours and from the side of *p; `frame` is not looked at. RG_ENOMEM. */
rg_status rg_html_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
