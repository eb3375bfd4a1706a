/* unfold.h -- a motion in which no facets pass through each other: unfolded from the flat end, and read backwards.
 * Paper    section 4: models that "intersect themselves before folded", its future work
 * Uses  layers.h contact.h open.h landing.h stride.h        Used by  motion
 *
 * A flat end with an order of its layers is opened a little, unfolded to flat with contacts as hard rows, and, from where it was
 * opened, landed in the end. Several ways to open and several orders are tried; and, where none comes through, folding forwards
 * from flat with the same rows, which jams more often but needs no order. */
#ifndef RG_UNFOLD_H
#define RG_UNFOLD_H

#include "contact/contact.h"
#include "layers/layers.h"
#include "unfold/stride.h"

struct rg_unfold;

typedef struct rg_unfold_wish {
    double sign;        /* +1; -1: mountain and valley exchanged */
    int64_t order;      /* which order of layers; negative: several */
    int shorter;        /* non-zero: facets are cut by short diagonals */
    double budget;      /* of work, multiplications; the same input gives the same result */
    int (*stop)(void *ctx, double done); /* non-zero: give up; NULL: nobody asks */
    rg_status (*accept)(void *ctx, struct rg_unfold *u, int *yes); /* has the last word on what was found; NULL: nobody */
    void *ctx;
} rg_unfold_wish;

typedef enum rg_unfold_outcome {
    RG_UNFOLD_FREE,    /* there is a motion */
    RG_UNFOLD_NO_END,  /* there is no flat end, or no order of its layers */
    RG_UNFOLD_FAILED   /* none of the tries came through */
} rg_unfold_outcome;

typedef struct rg_unfold {
    rg_memory mem;
    rg_mesh mesh;          /* owned: triangles, its size 1 */
    double size;           /* of the sheet, file units */
    rg_linkage P;
    rg_nearest q;
    rg_plates plates;      /* to look at states with code that the steps are not made by */
    rg_contact_work look;
    rg_crossed crossed;
    double *z;             /* [count][n] closed states from flat to the end */
    double *progress;      /* [count] 0 ... 1 */
    size_t z_room, progress_room;
    int32_t count;
    double *end;           /* [n] the end: fold angles, and the pattern nearest to the one drawn that closes */
    double *scratch;       /* [n] */
    rg_vec3 *x;            /* [2][nv] */
    rg_layers *layers;     /* of mesh, the order chosen that the motion has */
    uint64_t *which;       /* [parts] its numbers */
    int as_seen;           /* the order is not the one that was begun from */
    rg_unfold_outcome outcome;
    int32_t tries, steps, refused;
    double opened, landed; /* progress where it was opened; to which it was followed from there. Beyond, the order is all there is */
    double work, most;     /* of multiplications; what ends the search, which who accepts may lower */
    char how[160];
} rg_unfold;

/* none: the facets as drawn. RG_OK also when there is no motion, see outcome. RG_ENOMEM. Owner: the caller, rg_unfold_free, also
 * after a failure. */
rg_status rg_unfold_run(rg_unfold *u, const rg_memory *mem, const rg_mesh *none, const rg_unfold_wish *wish);
void rg_unfold_free(rg_unfold *u);
/* The closed state at a progress between 0 and 1: rho[N], X[nv] in file units. Between two states it is what closes near the
 * straight way between them. Allocates nothing. */
void rg_unfold_read(rg_unfold *u, double progress, double *rho, rg_vec2 *X);

#endif
