#include "motion/ladder.h"
#include "fold/tuning.h"

#include <stdio.h>
#include <unistd.h>

/* ------------------------------------------------------------------------------------------- which is better ---- */

/* Does all of its way end on a pattern that is not the one given? */
static int ends_elsewhere(const rg_attempt *t)
{
    return fabs(t->to) == 1 && !(t->moved_at_end <= ON_THE_PATTERN * t->mesh.size);
}

int rg_ladder_rank(const rg_attempt *t)
{
    if (t->outcome == RG_STOPPED) return RG_STOPS;
    if (t->overfold > OVERFOLD || t->strays > 0) return RG_OVERFOLDED;
    return ends_elsewhere(t) ? RG_ELSEWHERE : RG_WELL;
}

int rg_ladder_is_better(const rg_attempt *t, const rg_attempt *old)
{
    const int mine = rg_ladder_rank(t), its = old->mem.resize ? rg_ladder_rank(old) : -1;
    if (mine != its) return mine > its;
    if (mine == RG_WELL) return t->moved < old->moved;
    if (mine == RG_ELSEWHERE) return t->moved_at_end < old->moved_at_end;
    if (mine == RG_OVERFOLDED) return t->strays < old->strays;
    return t->score > old->score + (t->moved > 0 && old->moved == 0 ? WORTH_MOVING : 0);
}

void rg_cost_add(rg_cost *sum, const rg_cost *c)
{
    sum->steps += c->steps;
    sum->solves += c->solves;
    sum->iterations += c->iterations;
    sum->factorizations += c->factorizations;
    sum->assemblies += c->assemblies;
    sum->seconds += c->seconds;
}

void rg_ladder_note(rg_search *q, const rg_ladder_try *one, const rg_attempt *t)
{
    q->tries++;
    rg_cost_add(&q->cost, &t->cost);
    if (q->tried_count == RG_MOST_TRIED) return;
    rg_try *told = &q->tried[q->tried_count++];
    *told = (rg_try){.rung = one->r->name, .direction = one->r->backwards ? "backward" : "forward",
                     .compliance = one->how.compliance, .symmetry = one->G ? one->G->order : 1,
                     .added = t->mesh.added, .outcome = t->outcome, .percent = 100 * fmax(0, t->score),
                     .seconds = t->cost.seconds};
    snprintf(told->reason, sizeof told->reason, "%s", t->reason);
}

/* --------------------------------------------------------------------------------------------------- one try ---- */

rg_cut_how rg_ladder_cut(const rg_ladder *l, const rg_rung *r)
{
    return l->triangles || l->settings->triangulate == RG_TRIANGULATE_NONE ? RG_AS_DRAWN : r->how;
}

rg_ladder_try rg_ladder_plain(const rg_ladder *l, const rg_rung *r, const rg_symmetry *G)
{
    rg_ladder_try one = {r, G, r->relaxation, r->part * MOST_WORK[l->settings->effort], NULL};
    if (one.how.gain > 0 && l->settings->adjust >= 0) one.how.gain = l->settings->adjust;
    return one;
}

static rg_status try_straight(const rg_ladder *l, rg_mesh *m, rg_cut_how cuts, rg_watch *watch, rg_attempt *t,
                              rg_diag *why)
{
    rg_settings mine = *l->settings;
    mine.triangulate = cuts ? RG_TRIANGULATE_ALL : RG_TRIANGULATE_NONE;
    /* Asked for by a method, it may take its time; as one of several rungs it must not. */
    const int32_t most_steps = cuts && mine.method == RG_METHOD_AUTO ? MOST_STEPS_TRIANGULATED : 0;
    return rg_attempt_straight(t, m, &mine, most_steps, l->problem->keeps, watch, why);
}

static rg_status try_relaxed(const rg_ladder *l, rg_mesh *m, const rg_ladder_try *one, rg_watch *watch, rg_attempt *t,
                             rg_diag *why)
{
    const rg_problem *p = l->problem;
    const double sign = l->settings->to < 0 ? -1 : 1;
    const rg_memory mem = rg_mem_default(l->settings->memory);
    double *from, *to;
    rg_status s = RG_MEM_ARRAYS(&mem, RG_ARRAY(from, (size_t)m->N), RG_ARRAY(to, (size_t)m->N));
    for (int32_t i = 0; s == RG_OK && i < m->N; i++) {
        const int drawn = i < p->drawn->N;
        from[i] = drawn && p->from ? p->from[i] : 0;
        to[i] = !drawn ? NAN : p->to ? p->to[i] : sign * m->target[m->crease_edge[i]];
    }
    const rg_relaxed_try how = {one->how, p->from ? from : NULL, to, one->G, one->r->backwards, one->work};
    if (s == RG_OK) s = rg_attempt_relaxed(t, m, l->settings, &how, watch, why);
    rg_mesh_free(m);
    RG_MEM_FREE(&mem, from, to);
    return s;
}

rg_status rg_ladder_make(const rg_ladder *l, const rg_ladder_try *one, rg_watch *watch, rg_attempt *t, rg_diag *why)
{
    const rg_mesh *drawn = l->problem->drawn;
    const rg_cut_how cuts = rg_ladder_cut(l, one->r);
    rg_mesh m;
    const rg_status s = cuts ? rg_triangulate_orbits(drawn, one->G, one->which, cuts == RG_CUT_SHORT, &m)
                             : rg_mesh_copy(drawn, &m);
    if (s != RG_OK) return s;
    return one->r->straight ? try_straight(l, &m, cuts, watch, t, why) : try_relaxed(l, &m, one, watch, t, why);
}

/* ------------------------------------------------------------------------------------------- several at once ---- */

typedef struct job { rg_race *race; int32_t k; } job;

static int is_given_up(void *ctx)
{
    const job *j = ctx;
    return rg_race_given_up(j->race, j->k);
}

int rg_ladder_tell(void *ladder, double done)
{
    rg_ladder *l = ladder;
    rg_watch *w = l->watch;
    l->told = fmax(l->told, done);
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, l->told) != 0;
    return w->cancelled;
}

rg_status rg_ladder_race(rg_ladder *l, const rg_ladder_try *one, rg_race *race, int32_t k, int in_calling_thread,
                         rg_attempt *t, int *ended, rg_diag *why)
{
    job mine = {race, k};
    rg_watch watch = {in_calling_thread ? rg_ladder_tell : NULL, l, is_given_up, &mine, 0};
    const rg_status s = rg_ladder_make(l, one, &watch, t, why);
    *ended = watch.cancelled;
    return s;
}

int rg_ladder_workers(const rg_ladder *l)
{
    const rg_settings *s = l->settings;
    if (s->memory) return 1; /* somebody's allocator may not be for two threads */
    if (l->problem->drawn->N > MOST_CREASES_AT_ONCE) return 1;
    if (s->threads) return s->threads > 1 ? 2 : 1;
    return sysconf(_SC_NPROCESSORS_ONLN) > 1 ? 2 : 1;
}
