/* passage.h -- one try of a motion without contact: from the flat end, in one order of its layers, or from flat.
 * Uses  layers.h course.h open.h stride.h landing.h home.h track.h seen.h        Used by  unfold.c
 *
 * From the end: it is opened a little, unfolded to flat with contacts as hard rows, and landed from where it was
 * opened. From flat: folded with the same rows, which jams more often but needs no order, and landed in the one that it
 * came to. */
#ifndef RG_PASSAGE_H
#define RG_PASSAGE_H

#include "layers/layers.h"
#include "unfold/open.h"
#include "unfold/track.h"
#include "unfold/stride.h"

/* How the end is opened, and which rows it has. */
typedef struct rg_passage_way {
    rg_open_way open;
    rg_end_rules rules;
} rg_passage_way;

typedef struct rg_passage {
    rg_memory mem;
    rg_mesh mesh;          /* owned: triangles, its size 1 */
    rg_linkage P;
    rg_nearest q;
    rg_track track;          /* from flat to the end, where the last try came through */
    rg_crossed crossed;
    rg_layers *layers;     /* of mesh; NULL: there is no flat end. Who tries chooses an order */
    int any_order;         /* non-zero: it may be landed in another order than the one that was begun from */
    int (*stop)(void *ctx, double done); /* non-zero: give up; NULL: nobody asks */
    void *ctx;
    /* Of the last try. */
    int as_seen;           /* the order is not the one that was begun from */
    double landed;         /* progress to which it was followed from where it opened; beyond, the order is all */
    double spent, until;   /* of work, multiplications; and the most */
    int32_t steps;         /* of all tries */
} rg_passage;

/* none: the facets as drawn. sign: +1, -1: mountain and valley exchanged. shorter: non-zero: facets are cut by short
 * diagonals. stop, ctx: as above. RG_OK also where there is no flat end. RG_ENOMEM. Owner: the caller,
 * rg_passage_free, also after a failure. */
rg_status rg_passage_init(rg_passage *w, const rg_memory *mem, const rg_mesh *none, double sign, int shorter,
                          int (*stop)(void *ctx, double done), void *ctx);
void rg_passage_free(rg_passage *w);
/* *through: out, w->track is a motion. RG_ENOMEM. */
rg_status rg_passage_from_end(rg_passage *w, const rg_passage_way *way, double budget, int *through);
rg_status rg_passage_from_flat(rg_passage *w, double budget, int *through);

#endif
