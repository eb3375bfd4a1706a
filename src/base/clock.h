/* clock.h -- seconds on the wall, for reports; nothing is decided by them but when to stop trying. */
#ifndef RG_CLOCK_H
#define RG_CLOCK_H

#include <time.h>

static inline double rg_seconds(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
