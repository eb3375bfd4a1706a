/* search.h -- what is tried, in which order, until the pattern folds; and which attempt is kept.
 * Paper    sections 3.1 to 3.4        Uses  ladder.h retract.h        Used by  the other files of this room; chart
 *
 * The ladder: as drawn; triangulated; relaxed, the pattern moving ever more readily, from flat or from the folded end.
 * The lowest rung that folds wins; if none does, what came farthest is kept. Then the retraction: of what folds, the
 * compliance of the pattern and the added creases are reduced while the motion still exists. One table and one loop for
 * a pattern that folds from flat and for the way from one folded state to the next. */
#ifndef RG_SEARCH_H
#define RG_SEARCH_H

#include "motion/ladder.h"

/* RG_OK also when no attempt folds. Owner: the caller, rg_attempt_free of `best`, whose frames are not read off yet. */
rg_status rg_search_run(rg_search *q, const rg_problem *p, const rg_settings *s, rg_watch *watch, rg_diag *why);
/* Is t what was asked for, with no crease past half a turn and none left behind? */
int rg_search_is_folded(const rg_attempt *t);
/* Fills what m->report says of the effort and of the size of m->mesh. */
void rg_search_tell(rg_motion *m, int32_t tries, const rg_cost *cost);

#endif
