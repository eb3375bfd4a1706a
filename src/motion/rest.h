/* rest.h -- where a motion whose end its undriven creases leave open comes to rest.
 * Paper    Fig. 10 (c), the pleated hypar        Uses  straight.h        Used by  attempt.c
 *
 * Driven creases pull towards their targets, undriven ones towards flat, all by their lengths l. The sheet rests where
 *
 *     E = sum over driven creases of l (rho - target)^2 + w sum over undriven ones of l rho^2
 *
 * is least along its motion: one dot product a node. */
#ifndef RG_REST_H
#define RG_REST_H

#include "fold/straight.h"

/* Does the pattern leave open where some crease ends? */
int rg_rest_is_open(const rg_mesh *m);
/* The progress at which f rests, if that is between its last two nodes. Zero: it is not. rho[N], t[N]: scratch. Only
 * for one system that steps adaptively. */
int rg_rest_find(const rg_straight *f, double *rho, double *t, double *s);

#endif
