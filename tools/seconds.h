/* seconds.h -- a clock that nobody sets.        Used by  interrupt.c places.c progress.c */
#ifndef SECONDS_H
#define SECONDS_H

/* Seconds since some moment, the same one for the whole run. Any thread. */
double seconds_now(void);

#endif
