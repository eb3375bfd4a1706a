/* unfold.h -- a motion in which no facets pass through each other: unfolded from the flat end, and read backwards.
 * Paper    section 4: models that "intersect themselves before folded", its future work
 * Uses  passage.h        Used by  motion
 *
 * Several ways to open the flat end and several orders of its layers are tried, and folding from flat. */
#ifndef RG_UNFOLD_H
#define RG_UNFOLD_H

#include "unfold/passage.h"

struct rg_unfold;

typedef struct rg_unfold_wish {
    double sign;        /* +1; -1: mountain and valley exchanged */
    int64_t order;      /* which order of layers; negative: several */
    int shorter;        /* non-zero: facets are cut by short diagonals */
    double budget;      /* of work, multiplications; the same input gives the same result */
    int (*stop)(void *ctx, double done); /* non-zero: give up; NULL: nobody asks */
    /* Has the last word on what was found; NULL: nobody. */
    rg_status (*accept)(void *ctx, struct rg_unfold *u, int *yes);
    void *ctx;
} rg_unfold_wish;

typedef enum rg_unfold_outcome {
    RG_UNFOLD_FREE,    /* there is a motion */
    RG_UNFOLD_NO_END,  /* there is no flat end, or no order of its layers */
    RG_UNFOLD_FAILED   /* none of the tries came through */
} rg_unfold_outcome;

typedef struct rg_unfold {
    rg_memory mem;
    rg_passage pass;          /* the motion: pass.track, in the order pass.layers has chosen */
    double size;           /* of the sheet, file units */
    uint64_t *which;       /* [parts] numbers of an order */
    rg_unfold_outcome outcome;
    int32_t tries, steps;
    double work, most;     /* of multiplications; what ends the search, which who accepts may lower */
    char how[160];
} rg_unfold;

/* none: the facets as drawn. RG_OK also when there is no motion, see outcome. RG_ENOMEM. Owner: the caller,
 * rg_unfold_free, also after a failure. */
rg_status rg_unfold_run(rg_unfold *u, const rg_memory *mem, const rg_mesh *none, const rg_unfold_wish *wish);
void rg_unfold_free(rg_unfold *u);
/* The closed state at a progress between 0 and 1: rho[N], X[nv] in file units, as rg_track_read. Allocates nothing. */
void rg_unfold_read(rg_unfold *u, double progress, double *rho, rg_vec2 *X);

#endif
