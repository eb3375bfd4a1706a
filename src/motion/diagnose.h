/* diagnose.h -- where a run that stopped is held.
 * Paper    sections 3.1, 4 (which models "get stuck")        Uses  straight.h relax.h        Used by  attempt.c */
#ifndef RG_DIAGNOSE_H
#define RG_DIAGNOSE_H

#include "fold/relax.h"
#include "fold/straight.h"

/* At the state f->rho:
 *   vertex[M]  out  vertex numbers that resist the wish most, strongest first, component by component: y of eq. (15) is
 *                   the reaction with which each vertex turns the wish into the allowed step
 *   crease[N]  out  crease numbers that are short of their target and not let any nearer
 * Returns RG_ENOMEM, or RG_OK with the counts. */
rg_status rg_diagnose_blocking(rg_straight *f, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases);

/* The same at F->z. */
rg_status rg_diagnose_relaxed(rg_relax *F, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases);

#endif
