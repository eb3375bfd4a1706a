/* race.h -- several tries at one thing, some of them at the same time; the lowest that succeeds wins.
 * Used by  ladder.h, and through it search.c retract.c
 *
 * Which tries are run to their end, and what comes of it, does not depend on timing: a try is only given up when a
 * lower one has succeeded, so every try up to the winner has been run to its end. */
#ifndef RG_RACE_H
#define RG_RACE_H

#include "rigami.h"
#include <stdatomic.h>

/* Asked by a try now and then, from any thread: is it to give up? */
typedef struct rg_race rg_race;
int rg_race_given_up(const rg_race *r, int32_t job);

typedef struct rg_race_rules {
    int32_t jobs;
    int workers; /* 1: all in the calling thread; 2: one more thread */
    /* positive: success; zero: no success; negative: end the race. mine: non-zero in the calling thread */
    int (*run)(void *ctx, rg_race *r, int32_t job, int mine);
    /* called in the calling thread while it waits; non-zero: end the race */
    int (*wait)(void *ctx);
    void *ctx;
} rg_race_rules;

/* The lowest job that succeeded, -1: none, or the race was ended. *done: out, jobs 0 ... *done - 1 have all been run to
 * their end. Where a thread cannot be made, all is done in the calling one. */
int32_t rg_race_run(const rg_race_rules *rules, int32_t *done);

#endif
