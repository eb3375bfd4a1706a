/* undone.h -- simple folds undone from the flat end, and the order of layers that what is left has to be folded to.
 * Uses  simple.h attempt.h seen.h        Used by  stages.c */
#ifndef RG_UNDONE_H
#define RG_UNDONE_H

#include "layers/layers.h"
#include "layers/simple.h"
#include "motion/attempt.h"

typedef struct rg_undone {
    rg_memory mem;
    const rg_mesh *none;         /* borrowed: the facets as drawn */
    double sign;                 /* -1: mountain and valley exchanged */
    int chooses;                 /* non-zero: the order of the end is not given */
    const rg_stop *stop;         /* borrowed; once it was asked for, there are none */
    double *angle;               /* [none N] of the end */
    rg_layers *layers;
    uint64_t *which;             /* [parts] the order chosen */
    rg_simple simple;            /* no folds: there are none */
    rg_mesh drawn;               /* as none, on the pattern on which its simple folds close */
    double moved, off;           /* by that, file units; what does not close on it, as rg_rectify has them */
} rg_undone;

/* RG_OK also where there are no simple folds. Owner: the caller, rg_undone_free, also after a failure. RG_ENOMEM. */
rg_status rg_undone_init(rg_undone *u, const rg_mesh *none, const rg_settings *s, const rg_stop *stop);
void rg_undone_free(rg_undone *u);
/* The number that the order to be folded to has, of those of `base`'s triangles; -1: none. RG_ENOMEM. */
rg_status rg_undone_number(const rg_undone *u, const rg_mesh *base, int64_t *number);
/* Does t, of what is left, come to an order that simple folds go on from? Then they are u->simple. RG_ENOMEM. */
rg_status rg_undone_go_on(rg_undone *u, const rg_attempt *t, int *do_they);

#endif
