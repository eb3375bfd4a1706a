/* closing.h -- a state and its progress, brought to close: the corrections of a relaxation.
 * Paper    eqs. (14), (19)        Uses  relaxation.h        Used by  chord.c relax.c states.c
 *
 * evenly non-zero: of each orbit of the symmetry that is kept one is solved for, if that tells all. */
#ifndef RG_CLOSING_H
#define RG_CLOSING_H

#include "fold/relaxation.h"

/* Mean part of the creases' ways, none counted for more than the whole of it: who goes too far may come back. *least:
 * out. */
double rg_closing_progress(const rg_relax *F, const double *rho, double *least);
/* A step, or a state before it is closed: what the symmetry leaves of it. Of steps that an even state allows the mean
 * is allowed as well. */
void rg_closing_even_out(rg_relax *F, double *z);
/* r and r' at z. Returns what is open, radians; *off: out, the largest |r'| (may be NULL). */
double rg_closing_assemble(rg_relax *F, const double *z, int evenly, double *off);
/* A at what was assembled last, columns times F->scale. */
void rg_closing_renew(rg_relax *F, int evenly, double damping);
/* x = A^+ (A y + r) in scaled unknowns; y, r NULL: nothing. eqs. (14), (15), (19) */
void rg_closing_solve(rg_relax *F, int evenly, const double *y, const double *r, double *x);
/* F->t: what A leaves over of the slope of progress at z, F->g, in scaled unknowns; A is renewed. Returns how much that
 * is. */
double rg_closing_project_slope(rg_relax *F, const double *z, int evenly);

/* Part f of the chord from F->z, which a correction may change by so much, radians. */
typedef struct rg_leash { double f, farthest; } rg_leash;
/* z closed in at most so many corrections, at progress s; s NAN: whatever becomes of progress. leash NULL: changed by
 * anything. Zero: it does not close, or not within its leash. What a drawing is uneven by is left to each vertex, where
 * even corrections get no further. */
int rg_closing_correct(rg_relax *F, double *z, double s, int32_t most, const rg_leash *by);
/* z, between the states a and b, closed as well as rounding lets it in at most so many corrections, damped, at progress
 * s; s NAN: whatever becomes of progress. best[n]: scratch. Zero: it does not close. F->scale is lost. */
int rg_closing_between(rg_relax *F, const double *a, const double *b, double s, int32_t most, double *z, double *best);
/* rho[N] closed on the pattern given: a drawing's rounding is made up for by the creases, a little. Zero: it is off by
 * more than that, and rho is left as it is. */
int rg_closing_on_pattern(rg_relax *F, double *rho);

#endif
