/* places.h -- where a motion is to be written: whether it can be, before any work, and writing it.
 * Uses  progress.h say.h        Used by  cmd_fold.c cmd_draw.c */
#ifndef PLACES_H
#define PLACES_H

#include "options.h"
#include "progress.h"

/* Of an output: that it is no input. Returns an exit status; what is wrong has been said. */
int places_check_alone(const options *o, const char *output);
/* Both return an exit status; what is wrong has been said. */
int places_check(const options *o);
/* All outputs are tried, whatever becomes of one; the report comes last, as it tells how long they took. written: out,
 * the files that are there now, borrowed: its own list, [o->outputs], and its report. */
int places_write(const options *o, const rg_motion *m, progress *bar, options *written);

#endif
