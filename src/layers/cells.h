/* cells.h -- the folded sheet's creases and borders in the plane, cut at each other: segments, and cells between them.
 * Uses  flat.h planar.h faces.h        Used by  pairs.c
 *
 * The same facets lie over all of a cell; the same edges lie along all of a segment. */
#ifndef RG_LAYERS_CELLS_H
#define RG_LAYERS_CELLS_H

#include "base/stop.h"
#include "layers/flat.h"
#include "pattern/faces.h"
#include "pattern/planar.h"

typedef struct rg_cells {
    rg_memory mem;
    double tol;            /* points nearer than that are one, file units */
    rg_graph graph;        /* its edges are the segments */
    rg_faces faces;        /* its faces are the cells, and the outside */
    int32_t *along_start;  /* [segments + 1] */
    int32_t *along;        /* edges of the mesh that lie along a segment */
    int32_t *across_start; /* [segments + 1] */
    int32_t *across;       /* facets whose inside a segment runs through, rising */
    rg_vec2 *point;        /* [cells] a point well inside each */
    int32_t *over_start;   /* [cells + 1] */
    int32_t *over;         /* facets over a cell, rising; none over one that is no wider than rounding */
} rg_cells;

/* m, f: as folded flat; f->state is RG_FLAT_END. RG_EFORMAT: lines lie too close to tell apart, why->text; RG_ENOMEM.
 * Owner: the caller, rg_cells_free, also after a failure. */
rg_status rg_cells_init(rg_cells *c, const rg_memory *mem, const rg_mesh *m, const rg_flat *f, const rg_stop *stop,
                        rg_diag *why);
void rg_cells_free(rg_cells *c);

#endif
