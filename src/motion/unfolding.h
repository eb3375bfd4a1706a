/* unfolding.h -- a motion in which no facets pass through each other, where the plain one is none.
 * Paper    section 4's future work        Uses  search.h unfold.h contact.h        Used by  create.c */
#ifndef RG_UNFOLDING_H
#define RG_UNFOLDING_H

#include "motion/search.h"

/* Looks for one where what was chosen does not fold, or crosses; *c becomes it if there is. RG_OK also when there is none. */
rg_status rg_unfolding_try(rg_search *c, const rg_mesh *none, const rg_settings *s, rg_watch *watch, rg_diag *why);

#endif
