/* graph.h -- a plane graph, before it is known whether it is a sheet: vertices and edges.
 * Used by  loose.c planar.c build.c pieces.c sheet.c, layers */
#ifndef RG_GRAPH_H
#define RG_GRAPH_H

#include "pattern/pattern.h"

typedef struct rg_graph {
    rg_memory mem;
    rg_vec2 *X; /* [nv] */
    rg_edge *E; /* [ne], in the order of the lines */
    int32_t nv, ne;
    size_t room;
    double size;       /* longer side of the bounding box */
    int32_t loose;     /* creases that were left out as loose ends */
    double merged_max; /* largest distance merged, file units */
} rg_graph;

/* Takes out the edges marked drop[e] != 0 and the vertices that then have none; the size becomes that of what is left.
 * RG_ENOMEM. */
rg_status rg_graph_compact(rg_graph *g, const unsigned char *drop);
void rg_graph_free(rg_graph *g);

#endif
