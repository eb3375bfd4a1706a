/* verdict.h -- what came of a fold, as a folder would say it: what, where in the coordinates of the file, why, what to
 * do next.
 * Uses  say.h        Used by  cmd_fold.c */
#ifndef VERDICT_H
#define VERDICT_H

#include "options.h"

/* Of a motion that stopped short, one line on standard error; p: the pattern that it stopped at. */
void verdict_say(const options *o, const char *name, const rg_pattern *p, const rg_motion *m);
/* The same of one that reaches its end through itself: from where on, which facets first, why if that is known. */
void verdict_say_contact(const options *o, const char *name, const rg_pattern *p, const rg_motion *m);
/* Of creases that no angle was asked of: how many end as mountains, drawn as valleys, or the other way; silent for none. */
void verdict_say_open(const char *name, const rg_motion *m);
/* A coordinate as people write it: what is 0 but for rounding, over the sheet's size, is 0. */
double verdict_tidy(double x, double size);
/* Outputs and report of `o`, those that were written, on one line, with `lead` before them; an empty text: there are
 * none. */
void verdict_files(const options *o, const char *lead, char *text, size_t room);

#endif
