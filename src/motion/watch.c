#include "motion/watch.h"

#include <math.h>

int rg_watch_rising(void *rising, double done)
{
    rg_rising *r = rising;
    r->most = fmax(r->most, done);
    return r->progress ? r->progress(r->ctx, r->most) : 0;
}

int rg_watch_tell(rg_watch *w, double done)
{
    if (w->given_up && w->given_up(w->given_up_ctx)) w->cancelled = 1;
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, fmin(1, fmax(0, done))) != 0;
    return w->cancelled;
}

int rg_watch_asked(void *watch) { return rg_watch_tell(watch, 1); }
