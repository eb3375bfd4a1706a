/* interrupt.h -- signals: none ends the program, but for an interrupt while nothing is being folded.
 * Used by  rigami.c, cmd_fold.c */
#ifndef INTERRUPT_H
#define INTERRUPT_H

/* From now on: a pipe or a file that takes no more is an error of writing; SIGINT, SIGTERM and SIGHUP, unless the
 * caller has them ignored, end the program with status 1. */
void interrupt_init(void);
/* From now on the first of them is kept for interrupt_came(), the second ends the program. */
void interrupt_hold(void);
int interrupt_came(void);

#endif
