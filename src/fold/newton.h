/* newton.h -- drift worked off.
 * Paper    eq. (14)        Uses  system.h        Used by  start.c integrate.c fixed.c */
#ifndef RG_NEWTON_H
#define RG_NEWTON_H

#include "fold/system.h"

/* Works off the residual at f->trial, holding progress at `s`: eq. (14) with the wish along f->t only.
 * Non-zero when closed; f->closure is then the closure of f->trial. */
int rg_newton_correct(rg_straight *f, double s, int32_t most);
/* The same. near: the last factorisation was made so near to f->trial that it will do. t: the direction there, with
 * which progress is held at less cost where a sheet has more creases than equations; NULL: not known. */
int rg_newton_close(rg_straight *f, double s, int32_t most, int near, const double *t);

#endif
