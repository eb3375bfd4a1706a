/* clock.h -- seconds that pass, whatever the clock on the wall is set to: for reports; nothing is decided by them but
 * when to stop trying. */
#ifndef RG_CLOCK_H
#define RG_CLOCK_H

#include <time.h>

static inline double rg_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
