/* loose.h -- edges that end in the middle of a facet: taken out, and told with what would have joined them.
 * Uses  graph.h lines/lines.h        Used by  planar.c */
#ifndef RG_LOOSE_H
#define RG_LOOSE_H

#include "pattern/graph.h"

/* Takes out edges that end in the middle of a facet, or outside of the sheet, from their free ends inwards; the lines
 * are warned of each, of many by their number. RG_ENOMEM. */
rg_status rg_loose_drop(rg_graph *g, rg_lines *lines);

#endif
