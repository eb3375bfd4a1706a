/* retract.h -- a motion that was found, with less compliance of the pattern and fewer added creases, while it still
 * folds.
 * Paper    sections 3.2, 3.3        Uses  ladder.h cuts.h        Used by  search.c */
#ifndef RG_RETRACT_H
#define RG_RETRACT_H

#include "motion/ladder.h"

/* What is kept in *q, of l->kept, becomes what is found to do with less. */
rg_status rg_retract(rg_search *q, rg_ladder *l, rg_diag *why);

#endif
