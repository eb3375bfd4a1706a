/* plane.h -- what a pattern lends of itself, in arrays of one kind each.
 * Uses  pattern.h        Used by  build.c */
#ifndef RG_PLANE_OF_PATTERN_H
#define RG_PLANE_OF_PATTERN_H

#include "pattern/pattern.h"

/* Fills p->plane and its arrays from all that else is known of p; facets only where it is one sheet. RG_ENOMEM. */
rg_status rg_plane_lend(struct rg_pattern *p);
void rg_plane_free(struct rg_pattern *p);

#endif
