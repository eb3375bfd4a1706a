#include "base/race.h"

#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

/* What the waiting thread waits by: a clock that nobody sets, where the system can wait by it. */
#if defined(_POSIX_CLOCK_SELECTION) && _POSIX_CLOCK_SELECTION > 0
static const clockid_t BY = CLOCK_MONOTONIC;
static int set_clock(pthread_condattr_t *a) { return pthread_condattr_setclock(a, BY); }
#else
static const clockid_t BY = CLOCK_REALTIME;
static int set_clock(pthread_condattr_t *a) { return (void)a, 0; }
#endif

/* How often the waiting thread looks up, nanoseconds. */
static const long LOOK_UP = 20000000;

struct rg_race {
    const rg_race_rules *rules;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int32_t next, running; /* under the lock */
    atomic_int winner;     /* the lowest that succeeded, or jobs */
    atomic_int ended;
};

int rg_race_given_up(const rg_race *r, int32_t job)
{
    return atomic_load(&r->ended) || atomic_load(&r->winner) < job;
}

/* Takes one job after the other, those below the winner only. */
static void work(rg_race *r, int mine)
{
    pthread_mutex_lock(&r->lock);
    while (!atomic_load(&r->ended) && r->next < atomic_load(&r->winner)) {
        const int32_t job = r->next++;
        r->running++;
        pthread_mutex_unlock(&r->lock);
        const int is = r->rules->run(r->rules->ctx, r, job, mine);
        pthread_mutex_lock(&r->lock);
        r->running--;
        if (is < 0) atomic_store(&r->ended, 1);
        if (is > 0 && job < atomic_load(&r->winner)) atomic_store(&r->winner, job);
        pthread_cond_broadcast(&r->changed);
    }
    pthread_mutex_unlock(&r->lock);
}

static void *work_in_thread(void *race)
{
    work(race, 0);
    return NULL;
}

/* Signals go to the threads of the program, whose handlers know of no other. */
static int make_thread(pthread_t *thread, rg_race *r)
{
    sigset_t all, before;
    sigfillset(&all);
    if (pthread_sigmask(SIG_SETMASK, &all, &before) != 0) return 0;
    const int made = pthread_create(thread, NULL, work_in_thread, r) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return made;
}

static void wait_for_others(rg_race *r)
{
    pthread_mutex_lock(&r->lock);
    while (r->running > 0) {
        struct timespec until;
        clock_gettime(BY, &until);
        until.tv_nsec += LOOK_UP;
        if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
        pthread_cond_timedwait(&r->changed, &r->lock, &until);
        if (r->rules->wait && r->rules->wait(r->rules->ctx)) atomic_store(&r->ended, 1);
    }
    pthread_mutex_unlock(&r->lock);
}

int32_t rg_race_run(const rg_race_rules *rules, int32_t *done)
{
    rg_race r = {.rules = rules};
    pthread_t other;
    int has_other = 0;
    atomic_init(&r.winner, rules->jobs);
    atomic_init(&r.ended, 0);
    pthread_mutex_init(&r.lock, NULL);
    pthread_condattr_t by;
    pthread_condattr_init(&by);
    set_clock(&by);
    pthread_cond_init(&r.changed, &by);
    pthread_condattr_destroy(&by);
    if (rules->workers > 1 && rules->jobs > 1) has_other = make_thread(&other, &r);
    work(&r, 1);
    wait_for_others(&r);
    if (has_other) pthread_join(other, NULL);
    pthread_cond_destroy(&r.changed);
    pthread_mutex_destroy(&r.lock);
    const int32_t winner = atomic_load(&r.winner), ended = atomic_load(&r.ended);
    *done = ended ? 0 : winner < rules->jobs ? winner + 1 : rules->jobs;
    return ended || winner == rules->jobs ? -1 : winner;
}
