/* home.h -- the last of unfolding: from a state that is nearly flat straight to flat.
 * Uses  track.h stride.h        Used by  passage.c */
#ifndef RG_HOME_H
#define RG_HOME_H

#include "unfold/track.h"

/* From near flat on nothing can be met: half of z[n], and flat. */
rg_status rg_home_finish(rg_track *p, const double *z);
/* Where steps fail before: z[n], the last state of the path, goes straight home as long as it closes and nothing
 * crosses. *home: out; zero: the path is as it was. RG_ENOMEM. */
rg_status rg_home_go(rg_track *p, const double *z, int *home);

#endif
