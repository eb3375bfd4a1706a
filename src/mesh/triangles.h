/* triangles.h -- every facet as triangles, for drawing and for measuring overlaps; facets need not be convex.
 * Uses  mesh.h        Used by  motion, render, write */
#ifndef RG_TRIANGLES_H
#define RG_TRIANGLES_H

#include "mesh/mesh.h"

typedef struct rg_triangles {
    rg_memory mem;
    int32_t *start;   /* [nf + 1]: triangles of facet f are start[f] ... start[f + 1] - 1 */
    int32_t (*v)[3];  /* vertices, counter-clockwise in the pattern */
    int32_t *largest; /* [nf]: the largest of them in the pattern, the one to measure with */
} rg_triangles;

/* Owner: the caller, rg_triangles_free; *t is zeroed on failure. RG_ENOMEM. */
rg_status rg_triangles_init(const rg_memory *mem, const rg_mesh *m, rg_triangles *t);
void rg_triangles_free(rg_triangles *t);

#endif
