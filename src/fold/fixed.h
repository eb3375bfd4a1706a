/* fixed.h -- one node more on the path, a step from the last one: the methods that go on from step to step.
 * Paper    eqs. (10), (14), section 4        Uses  system.h        Used by  straight.c */
#ifndef RG_FIXED_H
#define RG_FIXED_H

#include "fold/system.h"

/* A step of newton, heun or rk4, closed, what is beyond a limit pulled back; or the end of the fold, f->reason says
 * why. */
void rg_fixed_newton(rg_straight *f);
/* The paper's: one solve, no correction. */
void rg_fixed_euler(rg_straight *f);

#endif
