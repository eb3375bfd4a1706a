/* integrate.h -- steps of higher order along the motion.
 * Paper    eq. (10), for which it takes Euler's method        Uses  system.h        Used by  order.c fixed.c straight.c
 *
 * The motion is drho/ds = t(rho): progress s instead of time, the wish projected at rho (9) and scaled to ds = 1. C has
 * the rank it ought to have on the path only, so t is asked for at closed points, and every stage is closed first. */
#ifndef RG_INTEGRATE_H
#define RG_INTEGRATE_H

#include "fold/system.h"

/* t[N]: out, t at rho, closed, of progress s. near: rho is where C was assembled last, and the factor will do. Returns
 * the part of the wish that was left over; 0: none. */
double rg_integrate_tangent(rg_straight *f, const double *rho, double s, int near, double *t);

/* From f->rho, where f->t is t, to f->trial, closed, at progress f->s + ds, by Heun's method or the classical
 * Runge-Kutta's. Non-zero: done. */
int rg_integrate_heun(rg_straight *f, double ds);
int rg_integrate_rk4(rg_straight *f, double ds);

/* One node more on f->path, as far on as the error allows: predicted by the polynomial through the last nodes, closed,
 * and where there is more than one way to go, set right by Adams's formula of the order that the nodes allow.
 * Zero: the smooth way ends at the last node. */
int rg_integrate_advance(rg_straight *f);
/* f->trial = the path at progress s, closed to tolerance: read off the polynomial, which costs no solve, or, where that
 * is not close enough, corrected; Euler's chords are not closed. The nodes stay as they are. Zero: not found. */
int rg_integrate_read_off(rg_straight *f, double s);

#endif
