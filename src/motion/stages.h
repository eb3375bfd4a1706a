/* stages.h -- a motion in stages, where none is free all at once: what simple folds leave first, all its creases
 * together, then those simple folds one after the other, as a folder would.
 * Paper    section 4: models that "intersect themselves before folded", its future work
 * Uses  undone.h overlay.h search.h unfolding.h        Used by  create.c
 *
 * Simple folds are undone from the flat end as far as there are any (layers/simple.h). What is left is folded as any
 * pattern is, to the order of layers that the folds go on from. A simple fold is a turn of one body about one line,
 * which is free. */
#ifndef RG_STAGES_H
#define RG_STAGES_H

#include "motion/motion.h"
#include "motion/search.h"

/* Looks for one, which *c becomes. RG_OK also when there is none. Owner of *q: the caller, rg_motion_free_stages, also
 * after a failure. */
rg_status rg_stages_try(rg_stages *q, rg_search *c, const rg_mesh *none, const rg_settings *s, rg_watch *watch,
                        rg_diag *why);

#endif
