/* layers.h -- which facets lie on which where the sheet is folded flat: how many ways there are, any one of them, or
 * why none.
 * Source   as constraint.h; orders of pairs and their solution by parts: J. Ku's Flat-Folder
 * Uses  blame.h        Used by  motion, render, write */
#ifndef RG_LAYERS_H
#define RG_LAYERS_H

#include "layers/blame.h"

enum { RG_LAYERS_NAMED = 16 }; /* facets that a reason names */

struct rg_layers {
    rg_memory mem;
    rg_mesh mesh;
    rg_flat flat;
    rg_cells cells;
    rg_pairs pairs;
    rg_constraints constraints;
    rg_orders orders;          /* what is the same in all orders; then, after a choice, one of them */
    int32_t settled;           /* pairs that are the same in all */
    rg_parts parts;
    rg_layers_info info;
    char *count;
    int y_down;                /* the file's y runs the other way */
    int32_t where[RG_LAYERS_NAMED];
    double where_at[RG_LAYERS_NAMED][2];
};

/* Of a sheet whose creases end at angle[m->N], radians; NAN: not said. m: triangulated or not; it is copied. y_down:
 * the file's y runs the other way, in which places are told. RG_OK whatever is found, see l->info; RG_ENOMEM. */
rg_status rg_layers_of_mesh(const rg_mesh *m, const double *angle, int y_down, const rg_memory *mem,
                            const rg_stop *stop, rg_layers **layers, rg_diag *why);

/* Sets l->orders.value to the order whose parts have the numbers which[l->parts.count] (NULL: all 0). RG_ENOMEM;
 * RG_EARG: there is none. Scratch of the handle is used: one thread at a time. */
rg_status rg_layers_choose(rg_layers *l, const uint64_t *which);

/* The same with an order near wish[l->pairs.count], see rg_parts_choose_near. */
rg_status rg_layers_choose_near(rg_layers *l, const double *wish);

/* After a choice: +1: facet g lies above f (in the plane of flat.h, seen with the front of facet flat.root up), -1:
 * below, 0: they do not overlap. */
static inline int rg_layers_above(const rg_layers *l, int32_t f, int32_t g)
{
    const int32_t pair = f == g ? -1 : rg_pairs_find(&l->pairs, f, g);
    return pair < 0 ? 0 : f < g ? l->orders.value[pair] : -l->orders.value[pair];
}

/* The same of facets i and j of the mesh that the layers were made of, which parts of the facets here may be. */
int rg_layers_above_of_mesh(const rg_layers *l, int32_t i, int32_t j);
/* level[l->flat.nf]: out, after a choice: 0 the lowest; every facet is higher than all that it lies on. Returns how
 * many levels there are. Where facets lie on each other in a circle, as the flaps of a closed box do, it is cut where
 * few pairs come to be the wrong way round: `cuts` (may be NULL) says how often. Two facets that overlap still have
 * different levels. RG_ENOMEM: -1. */
int32_t rg_layers_levels(const rg_layers *l, int32_t *level, int32_t *cuts);

/* As the report says it. */
const char *rg_layers_state_name(rg_layers_state s);

#endif
