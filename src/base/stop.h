/* stop.h -- whether what goes on is to be ended, asked now and then by what takes long.
 * Used by  lines, read, layers, motion */
#ifndef RG_STOP_H
#define RG_STOP_H

#include <stddef.h>

typedef struct rg_stop {
    int (*asked)(void *ctx); /* non-zero: it is; called in the thread that was given it */
    void *ctx;
} rg_stop;

/* stop NULL: nobody can end it. */
static inline int rg_stop_asked(const rg_stop *stop) { return stop && stop->asked(stop->ctx); }

#endif
