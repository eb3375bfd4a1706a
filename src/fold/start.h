/* start.h -- leaving the flat state.
 * Paper    section 2: where C is singular        Uses  system.h        Used by  steer.c straight.c */
#ifndef RG_START_H
#define RG_START_H

#include "fold/system.h"

/* Leaves the flat state along the branch that mountain and valley ask for. On return f->rho is closed, at
 * progress s1, with as few creases on the wrong side as could be found; RG_FOLDED-like success is non-zero. */
int rg_start_leave_flat(rg_straight *f, double s1);

#endif
