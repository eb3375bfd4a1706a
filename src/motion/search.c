#include "motion/search.h"
#include "base/status.h"
#include "fold/tuning.h"
#include "motion/retract.h"

#include <stdio.h>
#include <string.h>

/* Measured on 97 real patterns, each rung alone: no rung folds all of them, and no other rung folded any more. Rungs
 * that move the pattern least come first; backwards is as good as forwards and quicker. */
static const rg_rung LADDER[] = {
    {"straight", 1, RG_AS_DRAWN, {0, 0, 0, 0}, 0, 1, RG_EFFORT_FAST},
    {"straight, triangulated", 1, RG_CUT_SPLIT, {0, 0, 0, 0}, 0, 1, RG_EFFORT_FAST},
    {"relaxed, pattern fixed", 0, RG_AS_DRAWN, {0, 0, 0, 0}, 0, 0.3, RG_EFFORT_FAST},
    {"relaxed, pattern fixed, triangulated", 0, RG_CUT_SPLIT, {0, 0, 0, 0}, 0, 0.3, RG_EFFORT_FAST},
    {"relaxed 0.25", 0, RG_CUT_SPLIT, {0.25, 0.1, 0, 0}, 0, 1, RG_EFFORT_FAST},
    {"relaxed 0.5", 0, RG_CUT_SPLIT, {0.5, 0.1, 0, 0}, 1, 1, RG_EFFORT_FAST},
    {"relaxed 1", 0, RG_CUT_SPLIT, {1, 0.1, 0, 0}, 0, 1, RG_EFFORT_NORMAL},
    {"relaxed 1, short diagonals", 0, RG_CUT_SHORT, {1, 0.1, 0, 0}, 1, 1, RG_EFFORT_NORMAL},
    {"relaxed 0.5, short diagonals", 0, RG_CUT_SHORT, {0.5, 0.1, 0, 0}, 0, 1, RG_EFFORT_NORMAL},
    {"relaxed 1", 0, RG_CUT_SPLIT, {1, 0.1, 0, 0}, 1, 1, RG_EFFORT_NORMAL},
    {"relaxed 2", 0, RG_CUT_SPLIT, {2, 0.1, 0, 0}, 0, 1, RG_EFFORT_NORMAL},
    {"adjusted, kept flat-foldable", 0, RG_CUT_SPLIT, {0, 0.1, 1, 0}, 0, 1, RG_EFFORT_THOROUGH},
    {"relaxed 0.5", 0, RG_CUT_SPLIT, {0.5, 0.1, 0, 0}, 0, 1, RG_EFFORT_THOROUGH},
    {"relaxed 0.5, short diagonals", 0, RG_CUT_SHORT, {0.5, 0.1, 0, 0}, 1, 1, RG_EFFORT_THOROUGH},
    {"relaxed 1, short diagonals", 0, RG_CUT_SHORT, {1, 0.1, 0, 0}, 0, 1, RG_EFFORT_THOROUGH},
    {"relaxed 2", 0, RG_CUT_SPLIT, {2, 0.1, 0, 0}, 1, 1, RG_EFFORT_THOROUGH},
    {"relaxed 4", 0, RG_CUT_SPLIT, {4, 0.1, 0, 0}, 0, 1, RG_EFFORT_THOROUGH},
};
enum { RUNGS = sizeof LADDER / sizeof *LADDER };

void rg_search_tell(rg_motion *m, int32_t tries, const rg_cost *cost)
{
    rg_report *r = &m->report;
    r->tries = tries;
    r->steps = cost->steps, r->solves = cost->solves, r->cg_iterations = cost->iterations;
    r->factorizations = cost->factorizations, r->assemblies = cost->assemblies;
    r->seconds_solving = cost->seconds;
    r->added_creases = m->mesh.added;
    r->unknowns = m->mesh.N;
    r->constraints = 3 * m->mesh.M;
}

int rg_search_is_folded(const rg_attempt *t) { return rg_ladder_rank(t) >= RG_ELSEWHERE; }

/* ------------------------------------------------------------------------------------------------ the ladder ---- */

/* Is this rung one for these settings and this problem, and not the same as another one below it? */
static int applies(const rg_ladder *l, const rg_rung *r)
{
    const rg_settings *s = l->settings;
    const int may_cut = !l->triangles && s->triangulate != RG_TRIANGULATE_NONE;
    const int must_cut = !l->triangles && s->triangulate == RG_TRIANGULATE_ALL;
    const int moves = r->relaxation.gain > 0 || r->relaxation.compliance > 0;
    if (r->from > s->effort || (must_cut && r->how == RG_AS_DRAWN)) return 0;
    if (!may_cut && (r->how == RG_CUT_SHORT || (r->how == RG_CUT_SPLIT && !moves))) return 0;
    if (r->straight) return !l->problem->from && !l->problem->to;
    if (s->method != RG_METHOD_AUTO && s->adjust == 0) return 0; /* asked for a method and for nothing else */
    if (moves && (s->adjust == 0 || !l->moves)) return 0;
    return !r->backwards || (l->problem->end_is_known && s->to != 0);
}

/* The k-th try, with group j of symmetries. */
typedef struct job { const rg_rung *r; int32_t j; } job;

/* Tries that go up the ladder at once. */
typedef struct climb {
    rg_ladder *l;
    job job[RG_MOST_GROUPS * RUNGS]; /* the rungs that apply, group by group */
    int32_t jobs;
    rg_attempt *t;             /* [jobs] */
    rg_status status;          /* of the first try that failed for another reason than folding */
    rg_diag why;
} climb;

static rg_ladder_try try_of(const climb *c, int32_t k)
{
    return rg_ladder_plain(c->l, c->job[k].r, &c->l->group[c->job[k].j]);
}

static int run(void *ctx, rg_race *race, int32_t k, int in_calling_thread)
{
    climb *c = ctx;
    const rg_ladder_try one = try_of(c, k);
    rg_diag why = {0, ""};
    int ended;
    const rg_status s = rg_ladder_race(c->l, &one, race, k, in_calling_thread, &c->t[k], &ended, &why);
    if (s != RG_OK) c->status = s, c->why = why;
    if (s != RG_OK || (in_calling_thread && c->l->watch->cancelled)) return -1;
    return !ended && rg_ladder_rank(&c->t[k]) == RG_WELL;
}

static int look_up(void *ctx) { return rg_ladder_tell(((climb *)ctx)->l, 0); }

/* *t, which is taken over, is the best now. */
static void keep(rg_search *q, rg_ladder *l, const rg_rung *r, const rg_symmetry *G, rg_attempt *t)
{
    const int cuts = rg_ladder_cut(l, r) != RG_AS_DRAWN;
    const int may_leave = l->settings->triangulate == RG_TRIANGULATE_AUTO;
    rg_attempt_free(&q->best);
    q->best = *t;
    memset(t, 0, sizeof *t);
    l->kept = r;
    l->kept_group = G;
    q->rung = r->name;
    q->direction = r->backwards ? "backward" : "forward";
    q->compliance = r->relaxation.compliance;
    q->triangulation = cuts ? "all" : "none";
    q->why_triangulated = !may_leave ? "asked for"
                          : cuts     ? "stops short without added creases"
                                     : "folds without added creases";
    if (!cuts && q->best.outcome == RG_STOPPED && may_leave && !l->triangles)
        q->why_triangulated = "added creases get it no further";
    snprintf(q->strategy, sizeof q->strategy, "%s%s", r->name, r->backwards ? ", unfolded from its end" : "");
}

/* Of the tries that were ended early and may still go on, the one that is farthest on its way; -1: there is none.
 * Backwards only what comes all the way is a motion: one that is not yet half way there is left. */
static int32_t farthest_that_waits(const climb *c)
{
    int32_t best = -1;
    for (int32_t k = 0; k < c->jobs; k++) {
        const rg_relax *F = c->t[k].relax;
        if (!F || !F->waits || (c->t[k].backwards && F->s < HALF_WAY)) continue;
        if (best < 0 || F->s > c->t[best].relax->s) best = k;
    }
    return best;
}

/* Where no try folds, what was ended early goes on, the farthest first: it may fold after all, or show how far it
 * comes. */
static rg_status go_on(climb *c)
{
    double work = MORE_WORK * MOST_WORK[c->l->settings->effort];
    rg_watch watch = {.progress = rg_ladder_tell, .ctx = c->l};
    for (int32_t k; work > 0 && !watch.cancelled && (k = farthest_that_waits(c)) >= 0;) {
        rg_attempt *t = &c->t[k];
        const double before = t->relax->work;
        const rg_status s = rg_attempt_go_on(t, work, &watch, &c->why);
        if (s != RG_OK || rg_ladder_rank(t) == RG_WELL) return s;
        work -= t->relax->work - before;
    }
    return RG_OK;
}

/* Tells of the first `count` tries; the winner is kept, or where there is none (-1) what is best. */
static void take_best(rg_search *q, climb *c, int32_t count, int32_t winner)
{
    int32_t best = winner;
    for (int32_t k = 0; k < count; k++) {
        const rg_ladder_try one = try_of(c, k);
        if (!c->t[k].mem.resize) continue;
        rg_ladder_note(q, &one, &c->t[k]);
        if (winner < 0 && (best < 0 || rg_ladder_is_better(&c->t[k], &c->t[best]))) best = k;
    }
    if (best >= 0 && (!q->best.mem.resize || rg_ladder_is_better(&c->t[best], &q->best)))
        keep(q, c->l, c->job[best].r, &c->l->group[c->job[best].j], &c->t[best]);
}

static rg_status go_up(rg_search *q, climb *c, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(c->l->settings->memory);
    int32_t done;
    rg_race_rules rules = {c->jobs, rg_ladder_workers(c->l), run, look_up, c};
    c->t = rg_mem_array(&mem, (size_t)c->jobs, sizeof *c->t);
    if (!c->t) return RG_ENOMEM;
    const int32_t winner = rg_race_run(&rules, &done);
    if (c->status == RG_OK && winner < 0 && !c->l->watch->cancelled) c->status = go_on(c);
    if (c->status == RG_OK) take_best(q, c, done ? done : c->jobs, winner); /* ended: what there is */
    else if (why) *why = c->why;
    for (int32_t k = 0; k < c->jobs; k++) rg_attempt_free(&c->t[k]);
    rg_mem_free(&mem, c->t);
    return c->status;
}

/* -------------------------------------------------------------------------------------------------- all of it ---- */

/* Does the pattern say of every crease where it ends? One that does not is not moved: where it ends is open. */
static int end_is_definite(const rg_problem *p)
{
    for (int32_t i = 0; i < p->drawn->N - p->drawn->added; i++)
        if (isnan(p->to ? p->to[i] : p->drawn->target[p->drawn->crease_edge[i]])) return 0;
    return 1;
}

/* Who asks for triangles gets them: groups under which a facet has to stay whole are no answer then. */
static rg_status leaves_whole(const rg_mesh *drawn, const rg_symmetry *G, int *whole)
{
    rg_mesh m;
    const rg_status status = rg_triangulate_orbits(drawn, G, NULL, 0, &m);
    *whole = 0;
    if (status != RG_OK) return status;
    for (int32_t f = 0; f < m.nf; f++) *whole |= m.facet_start[f + 1] - m.facet_start[f] > 3;
    rg_mesh_free(&m);
    return RG_OK;
}

/* The symmetries to keep: the pattern's own, then parts of it, then none. Between two states there is none to keep. */
static rg_status find_groups(rg_ladder *l)
{
    const rg_settings *s = l->settings;
    const rg_memory mem = rg_mem_default(s->memory);
    rg_symmetry whole;
    rg_subgroup list[RG_MOST_GROUPS];
    rg_status status = rg_symmetry_find(&whole, &mem, l->problem->drawn);
    if (status != RG_OK) return status;
    int32_t n = rg_symmetry_subgroups(&whole, list, RG_MOST_GROUPS);
    const int none = s->symmetry == RG_SYMMETRY_OFF || l->problem->from || l->problem->to || l->problem->drawn->still;
    if (none) n = 1;
    if (none || list[n - 1].order > 1) list[n - 1] = (rg_subgroup){whole.turns, -1, 1};
    for (int32_t k = 0; status == RG_OK && k < n; k++) {
        rg_symmetry *G = &l->group[l->groups];
        int skipped = 0;
        status = rg_symmetry_part(G, &whole, list[k].every, list[k].mirror);
        if (status == RG_OK && G->order > 1 && s->triangulate == RG_TRIANGULATE_ALL)
            status = leaves_whole(l->problem->drawn, G, &skipped);
        if (status == RG_OK && !skipped) l->groups++;
        else rg_symmetry_free(G);
    }
    rg_symmetry_free(&whole);
    return status;
}

/* Rungs go group by group. The largest group and none get all of them, what lies between only those of little
 * effort. */
static void list_jobs(climb *c)
{
    const rg_ladder *l = c->l;
    for (int32_t g = 0; g < l->groups; g++)
        for (const rg_rung *r = LADDER; r < LADDER + RUNGS; r++) {
            const int between = g > 0 && g + 1 < l->groups;
            if (!applies(l, r) || (between && r->from > RG_EFFORT_FAST)) continue;
            if (r->straight && (r->how == RG_AS_DRAWN || g > 0)) continue; /* tried before, and once is enough */
            c->job[c->jobs++] = (job){r, g};
        }
}

/* All rungs but the first. */
static rg_status try_all(rg_search *q, rg_ladder *l, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(l->settings->memory);
    climb *c = rg_mem_array(&mem, 1, sizeof *c);
    rg_status s = c ? RG_OK : RG_ENOMEM;
    if (c) c->l = l, list_jobs(c);
    if (c && c->jobs > 0) s = go_up(q, c, why);
    else if (c && q->tries == 0) s = rg_fail(RG_EARG, why, 0, "with these settings there is nothing to try");
    rg_mem_free(&mem, c);
    return s;
}

/* Straight on as drawn folds most tessellations: nothing is tried beside it. */
static rg_status try_first(rg_search *q, rg_ladder *l, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(l->settings->memory);
    const rg_ladder_try one = {.r = LADDER};
    rg_watch watch = {.progress = rg_ladder_tell, .ctx = l};
    rg_attempt t;
    if (!applies(l, LADDER)) return RG_OK;
    const rg_status s = rg_ladder_make(l, &one, &watch, &t, why);
    if (s != RG_OK) return s;
    rg_ladder_note(q, &one, &t);
    keep(q, l, LADDER, &l->group[l->groups - 1], &t);
    l->blocked = q->best.vertex;
    l->blocked_count = q->best.vertices;
    return RG_MEM_COPIES(&mem, RG_ARRAY(l->blocked, (size_t)l->blocked_count));
}

rg_status rg_search_run(rg_search *q, const rg_problem *p, const rg_settings *s, rg_watch *watch, rg_diag *why)
{
    rg_ladder l = {.problem = p, .settings = s, .watch = watch, .triangles = 1, .moves = end_is_definite(p)};
    const rg_memory mem = rg_mem_default(s->memory);
    memset(q, 0, sizeof *q);
    for (int32_t f = 0; f < p->drawn->nf; f++)
        l.triangles &= p->drawn->facet_start[f + 1] - p->drawn->facet_start[f] == 3;
    rg_status status = find_groups(&l);
    if (status == RG_OK) status = try_first(q, &l, why);
    const int well = q->tries && rg_ladder_rank(&q->best) == RG_WELL;
    if (status == RG_OK && !well && !watch->cancelled) status = try_all(q, &l, why);
    if (status == RG_OK && q->best.mem.resize && rg_search_is_folded(&q->best) && !watch->cancelled)
        status = rg_retract(q, &l, why);
    if (status == RG_OK && watch->cancelled && q->best.outcome == RG_STOPPED)
        snprintf(q->best.reason, sizeof q->best.reason, "interrupted");
    for (int32_t g = 0; g < l.groups; g++) rg_symmetry_free(&l.group[g]);
    rg_mem_free(&mem, l.blocked);
    if (status != RG_OK) rg_attempt_free(&q->best);
    return status;
}
