/* separator.h -- few nodes of a graph that part the rest in two.
 * Used by  dissect.c
 *
 * Found on a coarse copy of the graph and refined on finer and finer ones.
 *   G. Karypis, V. Kumar: A fast and high quality multilevel scheme for partitioning irregular graphs. SIAM J. Sci.
 *     Comput. 20 (1998): coarsening by heavy edges.
 *   C. Fiduccia, R. Mattheyses: A linear-time heuristic for improving network partitions. 19th Design Automation
 *     Conference (1982).
 *   B. Hendrickson, E. Rothberg: Improving the run time and quality of nested dissection ordering. SIAM J. Sci. Comput.
 *     20 (1998): refining the separator of nodes itself. */
#ifndef RG_SEPARATOR_H
#define RG_SEPARATOR_H

#include "linalg/weighted.h"

/* part[n]: out, 0, 1 or RG_SEPARATOR; no edge joins 0 and 1. A part may come out empty. Zero: out of memory. */
int rg_separate(const rg_weighted *g, const rg_memory *mem, int32_t *part);

#endif
