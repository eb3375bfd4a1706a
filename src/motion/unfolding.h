/* unfolding.h -- a motion in which no facets pass through each other, where the plain one is none.
 * Paper    section 4's future work        Uses  search.h unfold.h course.h        Used by  create.c stages.c */
#ifndef RG_UNFOLDING_H
#define RG_UNFOLDING_H

#include "motion/search.h"

extern const char *const RG_UNFOLDED; /* the rung of what was found so */

/* *wanted: out, non-zero where what was chosen does not fold, or crosses, and something else is to be looked for. */
rg_status rg_unfolding_wanted(rg_search *c, const rg_mesh *none, const rg_settings *s, const rg_watch *watch,
                              int *wanted, rg_diag *why);
/* Looks for one, which *c, that may be empty, becomes. part: of the work that may be spent. RG_OK also when there is
 * none. */
rg_status rg_unfolding_run(rg_search *c, const rg_mesh *none, const rg_settings *s, double part, rg_watch *watch,
                           rg_diag *why);
/* The first of evenly spaced states of a path in which facets cross; -1: none. Frames that can be read off again are
 * let go. */
rg_status rg_unfolding_crosses(rg_attempt *t, const rg_settings *s, rg_watch *watch, int32_t *frame);

/* As it will be judged in the end, in its frames and between them: facets cross nowhere, and come in the order that
 * they lie in. *unproved: out, ways between states of which neither is sure. watch NULL: nobody's. RG_ENOMEM. */
rg_status rg_unfolding_judge(const rg_attempt *t, const rg_settings *s, rg_watch *watch, int *is_free,
                             int32_t *unproved, rg_diag *why);

#endif
