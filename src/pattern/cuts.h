/* cuts.h -- edges of a drawing that are cut, all at once.
 * Uses  splitter.h        Used by  planar.c */
#ifndef RG_CUTS_H
#define RG_CUTS_H

#include "pattern/splitter.h"

/* Makes the cuts of s->cuts. What is cut, and bent by it, is fresh then, the rest is not. RG_ENOMEM. */
rg_status rg_cuts_make(rg_splitter *s);

#endif
