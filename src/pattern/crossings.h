/* crossings.h -- where edges of a drawing cross, and where vertices lie on them.
 * Uses  splitter.h        Used by  planar.c */
#ifndef RG_CROSSINGS_H
#define RG_CROSSINGS_H

#include "pattern/splitter.h"

/* Looks at all that is fresh, of a drawing within these corners, and puts into s->cuts where edges are to be cut;
 * vertices that are made for it are among the points. RG_EFORMAT: too many, s->too_many says of what. RG_ENOMEM,
 * RG_ECANCELLED. */
rg_status rg_crossings_find(rg_splitter *s, rg_vec2 low, rg_vec2 high);
/* What it has kept for the next time. */
void rg_crossings_free(rg_splitter *s);

#endif
