/* seen.h -- the order in which facets came to lie on each other, as the frames before show it.
 * Uses  layers.h pose.h        Used by  passage.c, motion */
#ifndef RG_SEEN_H
#define RG_SEEN_H

#include "layers/layers.h"
#include "pose/pose.h"

/* A motion's frames. */
typedef struct rg_seen_frames {
    const rg_mesh *mesh;
    const rg_tree *tree;
    const double *rho;   /* [count][mesh->N] */
    const rg_vec2 *flat; /* [count][mesh->nv] the pattern of each; NULL: mesh->X in all of them */
    int32_t count;       /* the last one lies flat */
} rg_seen_frames;

/* wish[l->pairs.count]: out, > 0 where the second facet of a pair lay above the first when both were last apart, < 0
 * below; 0: they never were. l: layers of the last frame, of the same mesh. RG_ENOMEM. */
rg_status rg_seen_order(const rg_layers *l, const rg_seen_frames *m, double *wish);

#endif
