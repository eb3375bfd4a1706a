#define _GNU_SOURCE /* pipe2 */
#include "interrupt.h"
#include "say.h"
#include "seconds.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { WATCHER_STACK = 256 * 1024 };
enum {
    NOTHING,
    AT_ONCE,
    WITH_GRACE,
    SET_TIME
}; /* what wakes the watcher: a signal, with the phase that it came in, or a time */
/* Seconds, and part of the time allowed, that folding may take to find out that it is over: more is a solve that cannot
 * be asked. */
static const double TO_FIND_OUT = 2, PART_TO_FIND_OUT = 0.1;
/* Seconds that writing what there is has after that, if it is less than the time allowed: a film of sixty frames
 * takes some three. What takes longer may be a pipe that nobody reads. */
static const double TO_WRITE = 30;

/* Milliseconds that the program's own thread has to stand still in, before what it left is taken away; and seconds that
 * it stands. */
enum { TO_STAND = 100, STANDS = 2 };

static pthread_t worker;                 /* the program's own thread */
static sem_t stands;
static atomic_int signals;              /* that came */
static int wake[2] = {-1, -1};          /* a byte a signal */
static int has_watcher;
enum { READING, HELD, WRITING };         /* ends at once; has its grace; ends at once, but not because it is time */
static atomic_int phase, time_is_up;
static _Atomic double grace, time_allowed, end_at; /* end_at: seconds_now(), 0: never */
static _Atomic(const options *) outputs;
static _Atomic(const char *) doing;
static struct stat old;                  /* what was there when that was begun, if anything was */
static int is_old_there;

/* ---------------------------------------------------------------------------------------------- the end ---- */

/* What is at a path is another file than when it was begun to be written: it has its place already. */
static int is_written(const char *path)
{
    struct stat now;
    if (stat(path, &now) != 0) return 0;
    return !is_old_there || now.st_ino != old.st_ino || now.st_dev != old.st_dev;
}

/* Standard error may be a pipe that nobody reads. */
static void say_last(const char *why)
{
    char line[PATH_MAX + 200];
    struct pollfd err = {.fd = STDERR_FILENO, .events = POLLOUT};
    const char *what = doing;
    if (what && is_written(what)) what = NULL;
    const int n = snprintf(line, sizeof line, "rigami: %s%s%s%s\n", why, what ? ": " : "", what ? what : "",
                           what ? " is not written" : "");
    for (char *c = line; *c && c[1]; c++)
        if ((unsigned char)*c < 32 || *c == 127) *c = '?';
    const size_t length = n < (int)sizeof line ? (size_t)n : sizeof line - 1;
    if (poll(&err, 1, 0) > 0 && write(STDERR_FILENO, line, length) < 0) return;
}

/* In the program's own thread: it does nothing more, as a file may be given a name between what is taken away and the
 * end. It may hold a lock that the watcher waits for, though it should not: then it is over all the same. */
static void stand_still(int number)
{
    (void)number;
    sem_post(&stands);
    nanosleep(&(struct timespec){STANDS, 0}, NULL);
    _exit(ENDS_SHORT);
}

static void stop_worker(void)
{
    if (pthread_kill(worker, SIGURG) != 0) return;
    for (int k = 0; k < TO_STAND && sem_trywait(&stands) != 0; k++) nanosleep(&(struct timespec){0, 1000000}, NULL);
}

static void end(const char *why)
{
    stop_worker();
    const options *o = outputs; /* read now: until it stood it may have done with them */
    for (int i = 0; o && i < o->outputs; i++) rg_output_sweep(o->output[i], 1);
    if (o && o->report) rg_output_sweep(o->report, 1);
    say_last(why);
    _exit(ENDS_SHORT);
}

/* Milliseconds until that time; -1: for ever. */
static int until(double time)
{
    return !(time > 0) ? -1 : (int)fmin(INT_MAX, fmax(0, ceil(1000 * (time - seconds_now()))));
}

/* Waits for a signal. AT_ONCE, WITH_GRACE; NOTHING: none came before that time. */
static int wait_for_signal(double time)
{
    struct pollfd awake = {.fd = wake[0], .events = POLLIN};
    char byte;
    for (;;) {
        const int ready = poll(&awake, 1, until(time));
        if (ready > 0 && read(wake[0], &byte, 1) == 1) {
            if (byte != SET_TIME) return byte;
            time = end_at;
        }
        if (ready == 0 && time > 0 && seconds_now() >= time) return NOTHING;
    }
}

static void end_in_time(void)
{
    char why[80];
    snprintf(why, sizeof why, "not done within %g seconds", time_allowed);
    end_at = 0;
    if (phase == READING) end(why);
    if (phase == HELD) {
        time_is_up = 1;
        if (wait_for_signal(seconds_now() + fmax(TO_FIND_OUT, PART_TO_FIND_OUT * time_allowed))) end("interrupted");
        if (phase == HELD) end(why); /* else what there is is being written */
    }
    end(wait_for_signal(seconds_now() + fmax(TO_WRITE, time_allowed)) ? "interrupted" : why);
}

static sem_t is_up;

static void *watch(void *unused)
{
    (void)unused;
    int what;
    free(malloc(1)); /* memory of its own, for which it need not wait for a thread that stands still */
    sem_post(&is_up);
    what = wait_for_signal(end_at);
    if (what == NOTHING) end_in_time();
    if (what == WITH_GRACE) wait_for_signal(seconds_now() + grace);
    end("interrupted");
    return NULL;
}

/* ---------------------------------------------------------------------------------------------- signals ---- */

static void on_signal(int number)
{
    const int error = errno;
    (void)number;
    signals++;
    /* With no thread to be had, it is the second one that ends what is held. */
    if (!has_watcher && (phase != HELD || signals > 1)) _exit(ENDS_SHORT);
    const char word = phase == HELD ? WITH_GRACE : AT_ONCE;
    if (has_watcher && write(wake[1], &word, 1) < 0) _exit(ENDS_SHORT);
    errno = error;
}

/* Signals are left to the thread of the program. */
static int make_watcher(void)
{
    sigset_t all, before;
    pthread_attr_t attributes;
    pthread_t thread;
    if (sem_init(&is_up, 0, 0) != 0) return 0;
    if (pthread_attr_init(&attributes) != 0) return 0;
    pthread_attr_setstacksize(&attributes, WATCHER_STACK);
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const int made = pthread_create(&thread, &attributes, watch, NULL) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pthread_attr_destroy(&attributes);
    /* What forks next must not find it half made: a lock that it holds then is held in the child for ever. */
    while (made && sem_wait(&is_up) != 0 && errno == EINTR) {}
    return made;
}

void interrupt_init(void)
{
    /* Whatever asks a program to end: a person, the system, a batch system before its time is over, a limit or a clock
     * that whoever started it has set. SIGQUIT is for who wants to see where it is. */
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2};
    enum { NUMBERS = sizeof numbers / sizeof *numbers };
    struct sigaction act, was;
    sigset_t ours, before;
    sigemptyset(&ours);
    for (int i = 0; i < NUMBERS; i++) sigaddset(&ours, numbers[i]);
    pthread_sigmask(SIG_BLOCK, &ours, &before);
    for (int k = 0; k < 2; k++)
        if (wake[k] >= 0) close(wake[k]);
    signals = 0;
    time_is_up = 0;
    phase = READING;
    end_at = 0;
    outputs = NULL;
    doing = NULL;
    worker = pthread_self();
    memset(&act, 0, sizeof act);
    act.sa_handler = stand_still;
    sigfillset(&act.sa_mask);
    sigaction(SIGURG, &act, NULL);
    has_watcher = sem_init(&stands, 0, 0) == 0 && pipe2(wake, O_CLOEXEC) == 0 && make_watcher();
    memset(&act, 0, sizeof act);
    act.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &act, NULL);
    sigaction(SIGXFSZ, &act, NULL);
    act.sa_handler = on_signal;
    act.sa_flags = SA_RESTART; /* so that what is being written is written */
    for (int i = 0; i < NUMBERS; i++)
        if (sigaction(numbers[i], NULL, &was) == 0 && was.sa_handler != SIG_IGN) sigaction(numbers[i], &act, NULL);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void interrupt_outputs(const options *o) { outputs = o; }

void interrupt_hold(double seconds)
{
    grace = seconds;
    phase = HELD;
}

void interrupt_release(void) { phase = WRITING; }
void interrupt_doing(const char *what)
{
    doing = NULL; /* while what it is about changes */
    is_old_there = what && stat(what, &old) == 0;
    doing = what;
}

/* Called before anything else is going on: the thread is waked so that it looks at the clock. */
void interrupt_after(double seconds)
{
    time_allowed = seconds;
    end_at = seconds_now() + seconds;
    if (has_watcher && write(wake[1], &(char){SET_TIME}, 1) < 0) has_watcher = 0;
}

int interrupt_came(void) { return signals > 0 || time_is_up; }
int interrupt_time_is_up(void) { return time_is_up; }
