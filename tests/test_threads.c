/* Sixty-four folds in four threads, found, stepped, steered and cloned: each as it is alone, to the bit. For the sanitizer of threads and for
 * helgrind as well; motions are shared between clones in different threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "rigami.h"

#include <pthread.h>
#include <time.h>

enum { FOLDS = 64, THREADS = 4 };

static const struct { const char *kind; int32_t n; } KINDS[] = {{"miura", 2}, {"preliminary", 0}, {"waterbomb", 1}, {"closed-adjust", 0},
                                                                {"waterbomb-base", 0}, {"random", 3}, {"fish", 0}, {"miura", 3}};
enum { KINDS_HERE = sizeof KINDS / sizeof *KINDS };

typedef struct work {
    rg_fold *shared[KINDS_HERE];     /* one of each kind, to be cloned */
    uint64_t alone[KINDS_HERE], found[FOLDS]; /* what angles come to */
    rg_status status[FOLDS];
} work;

typedef struct worker { work *w; int first; } worker;

/* Of all bits, in their order. */
static uint64_t mix(uint64_t h, const rg_fold *f)
{
    int32_t N;
    const double *rho = rg_fold_angles(f, &N);
    for (int32_t i = 0; i < N; i++) {
        uint64_t x;
        memcpy(&x, &rho[i], sizeof x);
        h = (h ^ x) * UINT64_C(0x100000001b3);
        h ^= h >> 29;
    }
    return h;
}

/* Stepped to the end, taken back, one crease driven. */
static rg_status go_through(rg_fold *f, uint64_t *found)
{
    const int32_t c = 0;
    uint64_t h = 0;
    while (rg_fold_step(f)->outcome == RG_RUNNING) h = mix(h, f);
    for (int k = 0; k < 3; k++) rg_fold_step_back(f);
    rg_status s = rg_fold_go_to(f, 21);
    h = mix(h, f);
    const double to = 0.9 * rg_fold_angles(f, NULL)[c];
    if (s == RG_OK) s = rg_fold_drive(f, 1, &c, &to);
    for (int k = 0; s == RG_OK && k < 3; k++) rg_fold_step(f);
    *found = mix(h, f);
    return s;
}

static rg_status fold_kind(int kind, rg_fold **f)
{
    rg_settings s = rg_settings_default();
    rg_pattern *p = NULL;
    s.frames = 6;
    s.effort = RG_EFFORT_FAST;
    rg_status status = rg_generate_pattern(KINDS[kind].kind, KINDS[kind].n, 0, 0, NULL, &p, NULL);
    if (status == RG_OK) status = rg_fold_create(p, &s, NULL, NULL, f, NULL);
    rg_pattern_destroy(p);
    return status;
}

static void *run(void *ctx)
{
    worker *me = ctx;
    for (int k = me->first; k < FOLDS; k += THREADS) {
        const int kind = k / THREADS % KINDS_HERE;
        rg_fold *f = NULL;
        /* Every other one is a clone of one that others clone at the same time. */
        rg_status s = k % 2 ? rg_fold_clone(me->w->shared[kind], &f) : fold_kind(kind, &f);
        if (s == RG_OK) s = go_through(f, &me->w->found[k]);
        rg_fold_destroy(f);
        me->w->status[k] = s;
    }
    return NULL;
}

static void sixty_four_in_four(void **state)
{
    (void)state;
    work *w = calloc(1, sizeof *w);
    worker me[THREADS];
    pthread_t thread[THREADS];
    for (int k = 0; k < KINDS_HERE; k++) {
        rg_fold *f = NULL;
        assert_int_equal(fold_kind(k, &w->shared[k]), RG_OK);
        assert_int_equal(rg_fold_clone(w->shared[k], &f), RG_OK);
        assert_int_equal(go_through(f, &w->alone[k]), RG_OK);
        rg_fold_destroy(f);
    }
    for (int k = 0; k < THREADS; k++) {
        me[k] = (worker){w, k};
        assert_int_equal(pthread_create(&thread[k], NULL, run, &me[k]), 0);
    }
    for (int k = 0; k < THREADS; k++) pthread_join(thread[k], NULL);
    for (int k = 0; k < FOLDS; k++) {
        assert_int_equal(w->status[k], RG_OK);
        assert_true(w->found[k] == w->alone[k / THREADS % KINDS_HERE]);
    }
    for (int k = 0; k < KINDS_HERE; k++) rg_fold_destroy(w->shared[k]);
    free(w);
}

/* The clock on the wall, put back by an hour each time that anybody looks at it. */
static _Atomic long hours;
int timespec_get(struct timespec *t, int base)
{
    *t = (struct timespec){2000000000 - 3600 * ++hours, 0};
    return base;
}

static void a_clock_that_is_set_back(void **state)
{
    (void)state;
    rg_settings s = rg_settings_default();
    s.threads = 2;
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    assert_int_equal(rg_generate_pattern("random", 4, 0, 0, NULL, &p, NULL), RG_OK);
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
    const rg_report *r = rg_motion_report(m);
    assert_true(r->seconds_total >= 0 && r->seconds_solving >= 0);
    for (int32_t k = 0; k < r->tried_count; k++) assert_true(r->tried[k].seconds >= 0);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sixty_four_in_four), cmocka_unit_test(a_clock_that_is_set_back)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
