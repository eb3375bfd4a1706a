/* simple.h -- how a flat-folded sheet comes apart, simple fold by simple fold: layers on one side of a line, the
 * topmost or the lowest there, turned back over it.
 * Source   E. Arkin, M. Bender, E. Demaine et al., "When can you fold a map?" (2004): simple folds
 * Uses  layers.h        Used by  motion
 *
 * Folded flat, a line, one side of it, and up or down: layers that lie all on that side, are joined to the others only
 * by folded creases on the line, and have none of the others over them (under them), turn as one body by half a turn
 * about the line. Nothing is in their way, as all else lies in the plane or on the other side of it. What remains is
 * folded flat with fewer creases, in an order that is known: what was turned lies the other way round, and on top (at
 * the bottom). */
#ifndef RG_LAYERS_SIMPLE_H
#define RG_LAYERS_SIMPLE_H

#include "layers/layers.h"

/* One body that turns about one line. Folding is what undoing does, backwards. */
typedef struct rg_simple_fold {
    int32_t stage;      /* in the order of folding, from 1; those of one stage go at once */
    int32_t creases;    /* how many it makes */
    int up;             /* the layers go over (+1) or under (-1) the others, as `above` of the base means it */
    int over;           /* the same seen with the front of flat.root up: +1 a valley fold, -1 a mountain fold */
    rg_vec2 a, b;       /* the stretch of the line of its creases, in the plane of flat.h as all is folded before */
    unsigned char *moves; /* [nf] facets that turn */
} rg_simple_fold;

typedef struct rg_simple {
    rg_memory mem;
    int32_t nf, ne;
    int32_t stages;
    rg_simple_fold *fold; /* [folds] rising by stage */
    int32_t folds;
    size_t room;
    int32_t *stage;       /* [mesh ne] when the edge is folded: 0 before all simple folds; -1: never */
    int32_t base;         /* creases of stage 0 */
    signed char *above;   /* [nf][nf] the order in that base: +1: facet g lies above f, where they overlap */
    int up;               /* in the base the front of flat.root looks up (+1) or down (-1), as `above` means it */
} rg_simple;

/* l: an order is chosen; of a mesh without added creases. RG_OK also where no fold is simple: folds is 0; so it is
 * where that takes more work than is allowed, and once `stop` was asked for. RG_ENOMEM. Owner: the caller,
 * rg_simple_free, also after a failure. */
rg_status rg_simple_find(rg_simple *q, const rg_memory *mem, const rg_layers *l, const rg_stop *stop);
void rg_simple_free(rg_simple *q);

#endif
