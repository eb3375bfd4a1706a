/* turn.h -- cosines and sines of all creases.
 * Paper    Fig. 3        Uses  lanes.h        Used by  constraint.c pose.c */
#ifndef RG_TURN_H
#define RG_TURN_H

#include <stdint.h>

/* c[n], s[n]: cosine and sine of angle[n], radians, to 1.5e-16 for angles within 1e5 (about an ulp; on both sides of 0
 * and of pi alike); NaN for NaN. n is rounded up to four: the arrays have room for that. */
void rg_turn_creases(int32_t n, const double *angle, double *c, double *s);

#endif
