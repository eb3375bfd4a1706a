/* flat.h -- the sheet folded flat: where each facet goes, and which side of it is up.
 * Source   J. Justin, "Towards a mathematical theory of origami" (1989): an isometric flat map is made by reflections
 * Uses  undriven.h        Used by  cells.c
 *
 * The facets here are those that were drawn: facets of the mesh that only added creases part, which are not
 * folded, are one. */
#ifndef RG_LAYERS_FLAT_H
#define RG_LAYERS_FLAT_H

#include "layers/undriven.h"

typedef struct rg_isometry { rg_vec2 c[2], t; } rg_isometry; /* of the plane: x -> x.x c[0] + x.y c[1] + t */

static inline rg_vec2 rg_isometry_apply(const rg_isometry *q, rg_vec2 x)
{
    return (rg_vec2){x.x * q->c[0].x + x.y * q->c[1].x + q->t.x, x.x * q->c[0].y + x.y * q->c[1].y + q->t.y};
}

typedef enum rg_flat_state {
    RG_FLAT_END,     /* there is one */
    RG_FLAT_ANGLE,   /* a crease ends neither flat nor folded by half a turn: edge `at_edge` */
    RG_FLAT_OPEN,    /* the facets round a vertex do not come back to where they began: vertex `at_vertex` */
    RG_FLAT_UNTOLD   /* the same, but perhaps they would if creases without a target were folded otherwise */
} rg_flat_state;

typedef struct rg_flat {
    rg_memory mem;
    rg_flat_state state;
    int32_t at_edge, at_vertex;
    int32_t nf;
    int32_t *facet_of;     /* [mesh nf] the facet here that a facet of the mesh is part of */
    int32_t *part_start, *part; /* [nf + 1]: facets of the mesh that each is made of */
    int32_t *start, *edge; /* [nf + 1], mesh edges round each facet, added ones left out */
    int32_t (*beside)[2];  /* [mesh ne] as edge_facet of the mesh, of the facets here; both the same: an added crease */
    signed char *up;       /* [nf] +1: the front is up, as it is for facet `root`; -1: the back */
    signed char *turn;     /* [mesh ne] 0: border, or stays flat; +1 valley, -1 mountain, RG_TURN_EITHER */
    rg_isometry *place;    /* [nf] from the pattern to the plane */
    rg_vec2 *x;            /* [mesh nv] vertices in the plane: the mean over their facets */
    rg_vec2 *middle;       /* [nf] a facet's centroid, in the pattern */
    double gap;            /* farthest that a facet puts a vertex from there; by rounding of the drawing, file units */
    int32_t root;          /* the facet that stays where it is */
} rg_flat;

/* m: the sheet, triangulated or not. angle[m->N]: where each crease ends, radians; NAN: not said, see undriven.h.
 * RG_ENOMEM. Owner: the caller, rg_flat_free, also after a failure. If `state` is not RG_FLAT_END, what follows `nf`
 * may be missing. */
rg_status rg_flat_init(rg_flat *f, const rg_memory *mem, const rg_mesh *m, const double *angle);
void rg_flat_free(rg_flat *f);

#endif
