/* strategy.h -- what is tried, in which order, until the pattern folds; and which try is kept.
 * Paper    sections 3.1 to 3.4        Uses  take.h cuts.h        Used by  motion.c
 *
 * First without added creases, then with all facets cut into triangles, each straight on; then, where that is blocked, the
 * flow on triangles: first with the pattern as it is, then with its vertices moving as section 3.3 has it, then giving way
 * more and more. The first that folds is kept, so what moves the pattern least comes first; if none does, the one
 * that came farthest. What folds with all facets cut is then tried with fewer of them cut. */
#ifndef RG_STRATEGY_H
#define RG_STRATEGY_H

#include "motion/take.h"

typedef struct rg_choice {
    rg_take take;
    const char *triangulation, *why_triangulated;
    char strategy[160];
    int32_t tries;
    rg_cost cost; /* of all tries */
} rg_choice;

/* none: the facets as drawn; it is left as it is. RG_OK also when no try folds. Owner: the caller, rg_take_free. */
rg_status rg_strategy_run(rg_choice *c, const rg_mesh *none, const rg_settings *s, rg_watch *watch, rg_diag *why);

/* The flow's law number n, 0 for the plainest, and the work that it may cost. Zero: not with these settings; negative: there
 * are no more. */
int rg_strategy_law(const rg_settings *s, int32_t n, rg_flow_law *law, double *work);

#endif
