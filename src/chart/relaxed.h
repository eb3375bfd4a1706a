/* relaxed.h -- the curve of the relaxed stepper, for sheets that no straight method folds: its steps halved, again and
 * again.
 * Paper    eqs. (14), (19) as one system; section 3.3        Uses  run.h search.h        Used by  chart.h
 *
 * The rung of the ladder that folds the sheet is climbed once; what it came to (creases added, symmetry kept, how
 * readily what gives way, from which end) is then folded anew with steps of twice the largest one asked for, with that
 * one, with half of it and so on. The finest is what the others are measured against: there is no closed form, and
 * where the sheet can go many ways only the path's own limit says which one is meant. Angles and pattern are compared
 * at the same progress. */
#ifndef RG_RELAXED_H
#define RG_RELAXED_H

#include "chart/run.h"
#include "motion/search.h"

enum { RG_REASON = 240, RG_RELAXED_POINTS = 9, RG_RELAXED_DEFAULT = 1, RG_RELAXED_PERCENTS = 6 };

typedef struct rg_relaxed {
    rg_memory mem;
    int folds;                /* zero: it does not, or straight on; nothing else is there then */
    char strategy[160];
    rg_attempt best;          /* what every run is made like; owned */
    int32_t points;           /* the last is the reference, whose errors are NAN */
    rg_run run[RG_RELAXED_POINTS];
    int finer_stops;          /* non-zero: half the reference's step stops short, run[points], and that is why: */
    char reason[RG_REASON];
    double change[RG_RELAXED_POINTS];         /* of angles from the run before; NAN: one of them stops */
    double pattern_change[RG_RELAXED_POINTS]; /* the same of the pattern */
    double order, pattern_order; /* by which the changes fall with the step; NAN: none can be seen */
    double error, pattern_error; /* of the reference, as far as can be told; INFINITY: nothing can */
    double off[RG_RELAXED_PERCENTS];          /* of the run by the step asked for, at those percents */
    double pattern_off[RG_RELAXED_PERCENTS];
} rg_relaxed;

extern const int rg_relaxed_percent[RG_RELAXED_PERCENTS];

/* RG_ENOMEM. Owner: the caller, rg_relaxed_free. A watch that ends it leaves `folds` zero. */
rg_status rg_relaxed_measure(rg_relaxed *R, const rg_mesh *drawn, const rg_settings *s, rg_watch *watch, rg_diag *why);
void rg_relaxed_free(rg_relaxed *R);

#endif
