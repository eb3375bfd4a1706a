/* given.h -- is the pattern of a motion the one that was given?
 * Uses  record.h faults.h pattern.h        Used by  certificate.c */
#ifndef RG_GIVEN_H
#define RG_GIVEN_H

#include "pattern/pattern.h"
#include "verify/faults.h"
#include "verify/record.h"

/* Every line of the motion's pattern that was not added lies on lines of the given one that fold the same way, and
 * every line of that one on those. */
void rg_given_check(const rg_record *r, const rg_pattern *given, rg_faults *all);

#endif
