/* pieces.h -- the sheets of a drawing that has several, and the choice of one.
 * Uses  planar.h faces.h classes.h        Used by  build.c */
#ifndef RG_PIECES_H
#define RG_PIECES_H

#include "pattern/faces.h"
#include "pattern/graph.h"

/* Finds the sheets of the graph: pieces that hang together and lie in no other one; what lies in a sheet is its own.
 * *piece: out, [*pieces] in the order of the file, the caller's, also after a failure. `take` above 0: only that one,
 * from 1, stays in the graph, whose size becomes its. walk: out, of the graph where all of it stays, the caller's, also
 * after a failure. RG_EARG: there is no such sheet, why->text; RG_ENOMEM. */
rg_status rg_pieces_find(rg_graph *g, const rg_lines *lines, int32_t take, rg_walk *walk, rg_piece **piece,
                         int32_t *pieces, rg_diag *why);

#endif
