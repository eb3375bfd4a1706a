/* landing.h -- from a state a little open back into the flat end, step by step.
 * Uses  stride.h open.h        Used by  passage.c
 *
 * Creases are open by e, to first order, and the pattern has moved by e^2: so each step wishes e to become less by a
 * part of itself, and lets each distance become less by a part of itself. What is left when e is small rests on the
 * order of layers alone. */
#ifndef RG_LANDING_H
#define RG_LANDING_H

#include "unfold/stride.h"

/* s is at the state that was opened; it is left at the last one. keep: called with each state that was reached.
 * *left: out, the part of their angle that creases are still open by, in the mean. RG_ENOMEM. */
rg_status rg_landing_run(rg_stride *s, const double *end, rg_status (*keep)(void *ctx, const double *z), void *ctx,
                         double *left);

#endif
