/* cut.h -- a separator made the least one near by.
 * Used by  separator.c
 *
 * Of the nodes near the separator those of least weight are found that part the rest: as much as can flow from one part
 * to the other, no more through a node than it weighs (Menger's theorem). Each node has two sides, in and out.
 *   E. Dinic: Algorithm for solution of a problem of maximum flow in networks with power estimation. Soviet Math. Dokl.
 *     11 (1970). */
#ifndef RG_CUT_H
#define RG_CUT_H

#include "linalg/weighted.h"

/* p, weighed, becomes better, or stays as it is. spare[n]: scratch. Zero: out of memory, p is as it was. */
int rg_cut(rg_parting *p, const rg_memory *mem, int32_t *spare);

#endif
