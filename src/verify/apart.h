/* apart.h -- on which side of each other pieces are, as they are followed from frame to frame.
 * Uses  pieces.h        Used by  through.c pile.c */
#ifndef RG_APART_H
#define RG_APART_H

#include "verify/pieces.h"

/* The axis, unit, points from piece a to piece b, a < b, as a's facet sees it: its front looks along z. */
typedef struct rg_apart { int32_t a, b; rg_vec3 axis; } rg_apart;

/* Those that are known, by a and then b. A zeroed one is empty. */
typedef struct rg_aparts { rg_memory mem; rg_apart *list; size_t room; int32_t n; } rg_aparts;

/* Adds one behind all others. RG_ENOMEM. */
rg_status rg_aparts_add(rg_aparts *s, int32_t a, int32_t b, rg_vec3 axis);
/* That of a pair, no length: not known. *at goes on from where it was: pairs are to be asked for in their order, from
 * *at = 0 on. */
rg_vec3 rg_aparts_next(const rg_aparts *s, int32_t *at, int32_t a, int32_t b);
void rg_aparts_free(rg_aparts *s);

#endif
