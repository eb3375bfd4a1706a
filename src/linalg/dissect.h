/* dissect.h -- nested dissection: a graph is parted by few of its nodes, each part again, and parts are eliminated
 * before what parts them, so that nothing fills in between them.
 * Paper    the backslash of eq. (15)        Uses  separator.h        Used by  symbolic.c
 *
 *   A. George: Nested dissection of a regular finite element mesh. SIAM J. Numer. Anal. 10 (1973).
 *   B. Hendrickson, E. Rothberg: Improving the run time and quality of nested dissection ordering. SIAM J. Sci. Comput.
 *     20 (1998): nodes that have the same neighbours as one. */
#ifndef RG_DISSECT_H
#define RG_DISSECT_H

#include "base/memory.h"

/* start[n + 1], to: the neighbours of each node, both ways, without itself.
 * set[n]: out, to which set each node belongs: sets are to be eliminated by rising number, each in any order.
 * Returns how many sets there are, -1: out of memory. The same graph gives the same sets. */
int32_t rg_dissect(const rg_memory *mem, int32_t n, const int32_t *start, const int32_t *to, int32_t *set);

#endif
