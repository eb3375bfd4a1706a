/* closed.h -- closed vertices: creases made by folding through two layers at once, which lock a rigid sheet.
 * Paper    section 3.1, Fig. 7        Uses  check.h        Used by  pattern.c */
#ifndef RG_CLOSED_H
#define RG_CLOSED_H

#include "pattern/pattern.h"

/* Fills p->closed with every closed triple of creases, by vertex, and p->info.closed_vertices. RG_ENOMEM. */
rg_status rg_closed_find(struct rg_pattern *p);

#endif
