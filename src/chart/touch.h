/* touch.h -- what it costs to keep facets out of each other's way, against how deep they cross where they are left as
 * they are.
 * Uses  rigami.h        Used by  chart.h table.c */
#ifndef RG_TOUCH_H
#define RG_TOUCH_H

#include "rigami.h"

/* One motion; seconds 0: it was not made, as who watches ended it. */
typedef struct rg_touch {
    double seconds;
    rg_outcome outcome;
    int crosses;
    double percent, from, depth; /* folded; crosses from, percent; the deepest, over the sheet's size */
    int32_t frames;              /* in which facets cross */
    int32_t added;               /* creases */
} rg_touch;

enum { RG_TOUCH_LEFT, RG_TOUCH_AVOIDED, RG_TOUCHES };

/* Folds it both ways, as `rigami fold` does. RG_ENOMEM. */
rg_status rg_touch_measure(rg_touch touch[RG_TOUCHES], const rg_pattern *p, const rg_settings *s, rg_progress progress,
                           void *ctx, rg_diag *why);

#endif
