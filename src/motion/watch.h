/* watch.h -- who is told how far it is, and asked whether to go on.
 * Used by  attempt.c forth.c search.c and what they are called by; assemble.c create.c keeping.c */
#ifndef RG_WATCH_H
#define RG_WATCH_H

#include "rigami.h"

/* Tells how far it is, 0 ... 1, and asks whether to go on; asks the race it is part of, too. */
typedef struct rg_watch {
    rg_progress progress; /* NULL: nobody watches */
    void *ctx;
    int (*given_up)(void *ctx); /* NULL: never */
    void *given_up_ctx;
    int cancelled;
} rg_watch;

/* A caller who is told how far it is, never less than before: what is tried in several ways begins anew. Its
 * rg_progress is rg_watch_rising. */
typedef struct rg_rising {
    rg_progress progress; /* NULL: nobody is told */
    void *ctx;
    double most; /* that was told */
} rg_rising;
int rg_watch_rising(void *rising, double done);

/* Tells that so much is done. Non-zero: it is to end. */
int rg_watch_tell(rg_watch *w, double done);
/* Is it to end? Tells nothing new. The watch as a stop: rg_stop = {rg_watch_asked, watch}. */
int rg_watch_asked(void *watch);

#endif
