/* folding.h -- a fold in progress, for tests.  Include after counted.h and draw.h. */
#ifndef FOLDING_H
#define FOLDING_H

#include "fold/straight.h"

static inline rg_straight *fold_of(const rg_pattern *p, const rg_settings *s)
{
    rg_straight *f = NULL;
    rg_diag why = {0, ""};
    rg_status status = rg_straight_create(p, s, &f, &why);
    if (status == RG_EABSENT) {
        print_message("SKIPPED: %s\n", why.text);
        skip();
    }
    if (status != RG_OK) fail_msg("status %d: %s", status, why.text);
    return f;
}

/* Steps on to the next frame; zero: there is none. */
static inline int next_frame(rg_straight *f, rg_step_info *i)
{
    do assert_int_equal(rg_straight_step(f, i), RG_OK);
    while (i->frame < 0 && i->outcome == RG_RUNNING);
    return i->frame >= 0;
}

/* The k-th allocation fails, k = 0, 1, 2, ... until a fold of p can be made: each time it is told, and nothing is kept. */
static inline void starves_cleanly(const rg_pattern *p, rg_settings s)
{
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        s.memory = &mem;
        rg_straight *f = NULL;
        rg_diag why = {0, ""};
        const rg_status status = rg_straight_create(p, &s, &f, &why);
        rg_straight_destroy(f);
        assert_int_equal(c.out, 0);
        if (status == RG_OK) break;
        assert_int_equal(status, RG_ENOMEM);
        assert_null(f);
    }
}

#endif
