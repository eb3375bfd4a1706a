/* check.h -- can a vertex fold flat: degree, Kawasaki's theorem, Maekawa's theorem, big-little-big.
 * Paper    section 3.3, eq. (16) is Kawasaki's        Uses  pattern.h        Used by  facets.c build.c closed.c */
#ifndef RG_CHECK_H
#define RG_CHECK_H

#include "pattern/pattern.h"

/* Sector angles theta[i] of interior vertex v, from edge star[i] to the next one counter-clockwise; they add up to
 * 2 pi. theta: room for the vertex's degree. */
void rg_check_sectors(const struct rg_pattern *p, int32_t v, double *theta);
/* The most edges that meet at a vertex, at least 1. */
int32_t rg_check_most_edges(const struct rg_pattern *p);
/* What meets at one vertex is compared with each other: so many creases still take seconds, and no model has a tenth of
 * them. */
enum { RG_MOST_AT_A_VERTEX = 1000 };
/* A vertex at which more meet than that, and which therefore is not folded; -1: there is none. */
int32_t rg_check_crowded(const struct rg_pattern *p);
/* "1200 creases meet at (0.5, 2), and no more than 1000 at one vertex are folded" */
void rg_check_crowded_text(const struct rg_pattern *p, int32_t v, char text[200]);
/* Fills p->unfoldable, and the counts and the Kawasaki residual of p->info. RG_ENOMEM. */
rg_status rg_check_vertices(struct rg_pattern *p);

#endif
