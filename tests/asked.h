/* asked.h -- who is asked whether to go on: progress rises below 1, and the end comes at the time wished.
 * Include after cmocka.h. */
#ifndef ASKED_H
#define ASKED_H

typedef struct asked { int times, end_at; double last; } asked;

static inline int answer(void *ctx, double progress)
{
    asked *a = ctx;
    assert_true(progress >= a->last && progress < 1);
    a->last = progress;
    return a->times++ == a->end_at;
}

#endif
