/* sheet.h -- is the graph one sheet without holes, where is its border, and which vertices only break a straight line.
 * Paper    section 1 (a sheet of paper is a disk)        Uses  planar.h faces.h        Used by  build.c */
#ifndef RG_SHEET_H
#define RG_SHEET_H

#include "pattern/faces.h"
#include "pattern/graph.h"

/* Counts of the graph as it is go to `info`, with whether it is a disk. Then exactly the edges of the outer border have
 * 'B', and vertices of two edges of one assignment in a straight line are dissolved: `tol` is how far off it they may
 * be. walk: of the graph, made here where it is none yet; its star follows, its faces do not.
 * rim[g->nv]: out, whether a vertex is on the border; the caller's, also after a failure. RG_ENOMEM. */
rg_status rg_sheet_from_graph(rg_graph *g, rg_walk *walk, double tol, rg_lines *lines, rg_pattern_info *info,
                              unsigned char **rim);

#endif
