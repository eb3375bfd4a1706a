/* interrupt.h -- signals and time limits: what ends the program does so within a second, and leaves nothing half done.
 * Uses  options.h say.h        Used by  rigami.c progress.c, the commands that fold
 *
 * SIGINT, SIGTERM, SIGHUP and what limits and batch systems send, unless the caller has them ignored, end the program
 * with status 1. A thread of its own sees to it: it removes what outputs have left of temporary files, says what was
 * not done, and ends the process, whatever the others are at. */
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include "options.h"

/* From now on: a pipe or a file that takes no more is an error of writing; signals are obeyed. Also in a child after
 * fork(). */
void interrupt_init(void);
/* The outputs of this command, borrowed until the program ends; NULL: it has none. */
void interrupt_outputs(const options *o);
/* From now on it takes that many seconds more before a signal ends the program: time to stop folding, interrupt_came(),
 * and to write what there is. A second signal ends it at once. */
void interrupt_hold(double seconds);
/* From now on again at once; what came before still has its time. */
void interrupt_release(void);
/* What the program is at, borrowed, for the message; NULL: nothing in particular. */
void interrupt_doing(const char *what);
/* That many seconds from now it is as if a signal came, but for writing, which has as long again, and half a minute at
 * the least. */
void interrupt_after(double seconds);
/* Non-zero: stop. */
int interrupt_came(void);
/* Non-zero: it was the time. */
int interrupt_time_is_up(void);

/* Seconds that an interrupted fold has for what there is to write. The whole takes less than one: to give back the two
 * gigabytes of a large pattern takes up to half of one on a busy machine. */
#define INTERRUPT_GRACE 0.4

#endif
