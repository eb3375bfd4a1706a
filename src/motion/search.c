#include "motion/search.h"
#include "base/race.h"
#include "base/status.h"
#include "fold/tuning.h"
#include "mesh/symmetry.h"
#include "motion/cuts.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The facets as drawn, or cut: so that inside angles are split, or by the shortest diagonals. Either folds patterns that the
 * other does not. */
typedef enum cut { AS_DRAWN, SPLIT, SHORT } cut;

typedef struct rung {
    const char *name;
    int straight;
    cut how;
    rg_relaxation relaxation;
    int backwards;
    double part;       /* of the work that one try may cost */
    rg_effort from;    /* the effort that it takes */
} rung;

/* Measured on 97 real patterns, each rung alone: no rung folds all of them, and no other rung folded any more. Rungs that move
 * the pattern least come first; backwards is as good as forwards and quicker. */
static const rung LADDER[] = {
    {"straight", 1, AS_DRAWN, {0, 0, 0, 0}, 0, 1, RG_EFFORT_FAST},
    {"straight, triangulated", 1, SPLIT, {0, 0, 0, 0}, 0, 1, RG_EFFORT_FAST},
    {"relaxed, pattern fixed", 0, AS_DRAWN, {0, 0, 0, 0}, 0, 0.3, RG_EFFORT_FAST},
    {"relaxed, pattern fixed, triangulated", 0, SPLIT, {0, 0, 0, 0}, 0, 0.3, RG_EFFORT_FAST},
    {"relaxed 0.25", 0, SPLIT, {0.25, 0.1, 0, 0}, 0, 1, RG_EFFORT_FAST},
    {"relaxed 0.5", 0, SPLIT, {0.5, 0.1, 0, 0}, 1, 1, RG_EFFORT_FAST},
    {"relaxed 1", 0, SPLIT, {1, 0.1, 0, 0}, 0, 1, RG_EFFORT_NORMAL},
    {"relaxed 1, short diagonals", 0, SHORT, {1, 0.1, 0, 0}, 1, 1, RG_EFFORT_NORMAL},
    {"relaxed 0.5, short diagonals", 0, SHORT, {0.5, 0.1, 0, 0}, 0, 1, RG_EFFORT_NORMAL},
    {"relaxed 1", 0, SPLIT, {1, 0.1, 0, 0}, 1, 1, RG_EFFORT_NORMAL},
    {"relaxed 2", 0, SPLIT, {2, 0.1, 0, 0}, 0, 1, RG_EFFORT_NORMAL},
    {"adjusted, kept flat-foldable", 0, SPLIT, {0, 0.1, 1, 0}, 0, 1, RG_EFFORT_THOROUGH},
    {"relaxed 0.5", 0, SPLIT, {0.5, 0.1, 0, 0}, 0, 1, RG_EFFORT_THOROUGH},
    {"relaxed 0.5, short diagonals", 0, SHORT, {0.5, 0.1, 0, 0}, 1, 1, RG_EFFORT_THOROUGH},
    {"relaxed 1, short diagonals", 0, SHORT, {1, 0.1, 0, 0}, 0, 1, RG_EFFORT_THOROUGH},
    {"relaxed 2", 0, SPLIT, {2, 0.1, 0, 0}, 1, 1, RG_EFFORT_THOROUGH},
    {"relaxed 4", 0, SPLIT, {4, 0.1, 0, 0}, 0, 1, RG_EFFORT_THOROUGH},
};
enum { RUNGS = sizeof LADDER / sizeof *LADDER, MOST_GROUPS = 8, MOST_JOBS = MOST_GROUPS * RUNGS };
void rg_cost_add(rg_cost *sum, const rg_cost *c)
{
    sum->steps += c->steps;
    sum->solves += c->solves;
    sum->iterations += c->iterations;
    sum->factorizations += c->factorizations;
    sum->assemblies += c->assemblies;
    sum->seconds += c->seconds;
}

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

/* One try that counts. */
static void note(rg_search *q, const char *name, int backwards, double compliance, int32_t symmetry, const rg_attempt *t)
{
    q->tries++;
    rg_cost_add(&q->cost, &t->cost);
    q->work += t->work;
    if (q->tried_count == RG_MOST_TRIED) return;
    rg_try *one = &q->tried[q->tried_count++];
    *one = (rg_try){.rung = name, .direction = backwards ? "backward" : "forward", .compliance = compliance, .symmetry = symmetry,
                    .added = t->mesh.added, .outcome = t->outcome, .percent = 100 * fmax(0, t->score), .seconds = t->cost.seconds};
    snprintf(one->reason, sizeof one->reason, "%s", t->reason);
}

/* ------------------------------------------------------------------------------------------- which is better ---- */

/* Does all of its way end on a pattern that is not the one given? */
static int ends_elsewhere(const rg_attempt *t) { return fabs(t->to) == 1 && !(t->moved_at_end <= ON_THE_PATTERN * t->mesh.size); }

enum { OVERFOLDED = 1, ELSEWHERE, FOLDED };

static int rank(const rg_attempt *t)
{
    if (t->outcome == RG_STOPPED) return 0;
    return t->overfold > OVERFOLD || t->strays > 0 ? OVERFOLDED : ends_elsewhere(t) ? ELSEWHERE : FOLDED;
}

int rg_search_is_folded(const rg_attempt *t) { return rank(t) >= ELSEWHERE; }

static int is_better(const rg_attempt *t, const rg_attempt *old)
{
    const int mine = rank(t), its = old->mem.resize ? rank(old) : -1;
    if (mine != its) return mine > its;
    if (mine == FOLDED) return t->moved < old->moved;
    if (mine == ELSEWHERE) return t->moved_at_end < old->moved_at_end;
    if (mine == OVERFOLDED) return t->strays < old->strays;
    return t->score > old->score + (t->moved > 0 && old->moved == 0 ? WORTH_MOVING : 0);
}

/* ------------------------------------------------------------------------------------------------- one try ---- */

typedef struct job { int32_t rung, group; } job;

/* What all tries of a search share. */
typedef struct ladder {
    const rg_problem *problem;
    const rg_settings *settings;
    rg_watch *watch;           /* of the calling thread */
    int triangles;             /* all facets are triangles as they are */
    int moves;                 /* the pattern may be moved */
    rg_symmetry group[MOST_GROUPS]; /* of the facets as drawn: the largest first, the last of order 1 */
    int32_t groups;
    job job[MOST_JOBS];        /* the rungs that apply, group by group */
    int32_t jobs;
    rg_attempt *attempt;       /* [jobs] */
    double told;               /* progress, 0 ... 1 */
    rg_status status;          /* of the first try that failed for another reason than folding */
    rg_diag why;
} ladder;

static rg_status copy_mesh(const rg_mesh *m, const rg_symmetry *G, cut how, const unsigned char *which, rg_mesh *out)
{
    return how ? rg_triangulate_orbits(m, G, which, how == SHORT, out) : rg_mesh_copy(m, out);
}

static cut cut_of(const ladder *l, const rung *r)
{
    return l->triangles || l->settings->triangulate == RG_TRIANGULATE_NONE ? AS_DRAWN : r->how;
}

/* One try: a rung, the symmetry kept, its relaxation and what work it may take, which facets are cut (NULL: all). */
static rg_status try_rung(const ladder *l, const rung *r, const rg_symmetry *G, const rg_relaxation *how, double work,
                          const unsigned char *which, rg_watch *watch, rg_attempt *t, rg_diag *why)
{
    const rg_problem *p = l->problem;
    const double sign = l->settings->to < 0 ? -1 : 1;
    const cut cuts = cut_of(l, r);
    rg_mesh m;
    rg_status s = copy_mesh(p->drawn, G, cuts, which, &m);
    if (s != RG_OK) return s;
    if (r->straight) {
        rg_settings mine = *l->settings;
        mine.triangulate = cuts ? RG_TRIANGULATE_ALL : RG_TRIANGULATE_NONE;
        /* Asked for by a method, it may take its time; as one of several rungs it must not. */
        return rg_attempt_straight(t, &m, &mine, cuts && mine.method == RG_METHOD_AUTO ? MOST_STEPS_TRIANGULATED : 0, p->keeps, watch,
                                   why);
    }
    const rg_memory mem = rg_mem_default(l->settings->memory);
    double *from = rg_mem_array(&mem, (size_t)m.N, sizeof *from), *to = rg_mem_array(&mem, (size_t)m.N, sizeof *to);
    for (int32_t i = 0; from && to && i < m.N; i++) {
        const int drawn = i < p->drawn->N;
        from[i] = drawn && p->from ? p->from[i] : 0;
        to[i] = !drawn ? NAN : p->to ? p->to[i] : sign * m.target[m.crease_edge[i]];
    }
    if (from && to) s = rg_attempt_relaxed(t, &m, l->settings, how, p->from ? from : NULL, to, G, r->backwards,
                                           work, watch, why);
    else s = RG_ENOMEM;
    rg_mesh_free(&m);
    RG_MEM_FREE(&mem, from, to);
    return s;
}

static double work_of(const ladder *l, const rung *r) { return r->part * MOST_WORK[l->settings->effort]; }

static rg_relaxation relaxation_of(const ladder *l, const rung *r)
{
    rg_relaxation how = r->relaxation;
    if (how.gain > 0 && l->settings->adjust >= 0) how.gain = l->settings->adjust;
    return how;
}

/* ------------------------------------------------------------------------------------------------ the ladder ---- */

/* Is this rung one for these settings and this problem, and not the same as another one below it? */
static int applies(const ladder *l, const rung *r)
{
    const rg_settings *s = l->settings;
    const int may_cut = !l->triangles && s->triangulate != RG_TRIANGULATE_NONE;
    const int must_cut = !l->triangles && s->triangulate == RG_TRIANGULATE_ALL;
    const int moves = r->relaxation.gain > 0 || r->relaxation.compliance > 0;
    if (r->from > s->effort || (must_cut && r->how == AS_DRAWN)) return 0;
    if (!may_cut && (r->how == SHORT || (r->how == SPLIT && !moves))) return 0;
    if (r->straight) return !l->problem->from && !l->problem->to;
    if (s->method != RG_METHOD_AUTO && s->adjust == 0) return 0; /* asked for a method and for nothing else */
    if (moves && (s->adjust == 0 || !l->moves)) return 0;
    return !r->backwards || (l->problem->end_is_known && s->to != 0);
}

typedef struct job_watch { rg_race *race; int32_t job; } job_watch;

static int asks_race(void *ctx)
{
    const job_watch *w = ctx;
    return rg_race_given_up(w->race, w->job);
}

/* What is told never runs backwards, whichever try it is of. */
static int tell(void *ctx, double done)
{
    ladder *l = ctx;
    rg_watch *w = l->watch;
    l->told = fmax(l->told, done);
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, l->told) != 0;
    return w->cancelled;
}

static int run_job(void *ctx, rg_race *race, int32_t k, int in_calling_thread)
{
    ladder *l = ctx;
    const rung *r = &LADDER[l->job[k].rung];
    const rg_relaxation how = relaxation_of(l, r);
    job_watch mine = {race, k};
    rg_watch watch = {in_calling_thread ? tell : NULL, l, asks_race, &mine, 0};
    rg_diag why = {0, ""};
    const rg_status s = try_rung(l, r, &l->group[l->job[k].group], &how, work_of(l, r), NULL, &watch, &l->attempt[k], &why);
    if (s != RG_OK) {
        l->status = s;
        l->why = why;
    }
    if (s != RG_OK || (in_calling_thread && l->watch->cancelled)) return -1;
    return !watch.cancelled && rank(&l->attempt[k]) == FOLDED;
}

/* In the calling thread, while it waits: is all of it to end? */
static int look_up(void *ctx) { return tell(ctx, 0); }

static int workers(const ladder *l)
{
    const rg_settings *s = l->settings;
    if (s->memory || l->problem->drawn->N > MOST_CREASES_AT_ONCE) return 1; /* somebody's allocator may not be for two threads */
    if (s->threads) return s->threads > 1 ? 2 : 1;
    return sysconf(_SC_NPROCESSORS_ONLN) > 1 ? 2 : 1;
}

static void keep(rg_search *q, const ladder *l, int32_t k)
{
    const rung *r = &LADDER[l->job[k].rung];
    const cut cuts = cut_of(l, r);
    const int may_leave = l->settings->triangulate == RG_TRIANGULATE_AUTO;
    q->best = l->attempt[k];
    memset(&l->attempt[k], 0, sizeof *l->attempt);
    q->job = l->job[k].rung;
    q->group = l->job[k].group;
    q->rung = r->name;
    q->direction = r->backwards ? "backward" : "forward";
    q->compliance = r->relaxation.compliance;
    q->triangulation = cuts ? "all" : "none";
    q->why_triangulated = !may_leave ? "asked for" : cuts ? "stops short without added creases" : "folds without added creases";
    if (cuts == AS_DRAWN && q->best.outcome == RG_STOPPED && may_leave && !l->triangles)
        q->why_triangulated = "added creases get it no further";
    snprintf(q->strategy, sizeof q->strategy, "%s%s", r->name, r->backwards ? ", unfolded from its end" : "");
}

/* Where no try folds, the best of those that were ended early may show how far it comes after all. */
static rg_status go_on(ladder *l, rg_diag *why)
{
    int32_t best = -1;
    for (int32_t j = 0; j < l->jobs; j++) {
        const rg_attempt *t = &l->attempt[j];
        if (t->mem.resize && t->relax && t->relax->waits && (best < 0 || is_better(t, &l->attempt[best]))) best = j;
    }
    rg_watch watch = {.progress = tell, .ctx = l};
    return best >= 0 ? rg_attempt_go_on(&l->attempt[best], MOST_WORK[l->settings->effort], &watch, why) : RG_OK;
}

static rg_status climb(rg_search *q, ladder *l, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(l->settings->memory);
    int32_t done, best = -1;
    rg_race_rules rules = {l->jobs, workers(l), run_job, look_up, l};
    l->attempt = rg_mem_array(&mem, (size_t)l->jobs, sizeof *l->attempt);
    if (!l->attempt) return RG_ENOMEM;
    const int32_t winner = rg_race_run(&rules, &done);
    if (l->status == RG_OK && winner < 0 && !l->watch->cancelled) l->status = go_on(l, &l->why);
    if (l->status == RG_OK) {
        const int32_t counted = done ? done : l->jobs; /* ended: what there is */
        for (int32_t j = 0; j < counted; j++) {
            if (!l->attempt[j].mem.resize) continue;
            const rung *r = &LADDER[l->job[j].rung];
            note(q, r->name, r->backwards, r->relaxation.compliance, l->group[l->job[j].group].order, &l->attempt[j]);
            if (winner < 0 && (best < 0 || is_better(&l->attempt[j], &l->attempt[best]))) best = j;
        }
        if (winner >= 0) best = winner;
        if (best >= 0 && (!q->best.mem.resize || is_better(&l->attempt[best], &q->best))) {
            rg_attempt_free(&q->best);
            keep(q, l, best);
        }
    } else {
        if (why) *why = l->why;
    }
    for (int32_t j = 0; j < l->jobs; j++) rg_attempt_free(&l->attempt[j]);
    rg_mem_free(&mem, l->attempt);
    l->attempt = NULL;
    return l->status;
}

/* ------------------------------------------------------------------------------------------------ retraction ---- */

/* Up to two more tries like the one that is kept, at once. The second one counts only where the first one is taken, in a chain, or
 * only where it is not, as another choice: what is taken is the same as if one had been made after the other. */
typedef struct retries {
    rg_search *q;
    ladder *l;
    const rung *r;
    int32_t count;
    int is_chain, is_fewer;         /* is_fewer: cuts are saved, and not compliance */
    double work;                    /* that each may take */
    rg_relaxation how[2];
    const unsigned char *which[2];  /* facets to cut; NULL: all */
    rg_attempt t[2];
    rg_status status[2];
    rg_diag why[2];
} retries;

static int is_retraction(const retries *R, const rg_attempt *t)
{
    const rg_attempt *best = &R->q->best;
    if (rank(t) < ELSEWHERE || rank(t) < rank(best)) return 0;
    return R->is_fewer ? t->mesh.added < best->mesh.added && t->moved <= LITTLE_MORE * best->moved : t->moved < best->moved;
}

static int run_retry(void *ctx, rg_race *race, int32_t k, int in_calling_thread)
{
    retries *R = ctx;
    job_watch mine = {race, k};
    rg_watch watch = {in_calling_thread ? tell : NULL, R->l, asks_race, &mine, 0};
    R->status[k] = try_rung(R->l, R->r, &R->l->group[R->q->group], &R->how[k], R->work, R->which[k], &watch, &R->t[k], &R->why[k]);
    if (R->status[k] != RG_OK || (in_calling_thread && R->l->watch->cancelled)) return -1;
    const int is = !watch.cancelled && is_retraction(R, &R->t[k]);
    return R->is_chain ? (k == 0 && !is ? -1 : 0) : is;
}

static int look_up_for_retries(void *ctx)
{
    retries *R = ctx;
    return look_up(R->l);
}

/* *taken: out, which of them is kept now, the second one of a chain if both are; -1: none. */
static rg_status retry(retries *R, int32_t *taken, rg_diag *why)
{
    rg_search *q = R->q;
    rg_race_rules rules = {R->count, workers(R->l), run_retry, look_up_for_retries, R};
    R->work = fmin(work_of(R->l, R->r), RETRIED_WORK * q->best.work);
    int32_t done;
    rg_status s = RG_OK;
    rg_race_run(&rules, &done);
    *taken = -1;
    for (int32_t k = 0; k < R->count; k++) {
        const int counts = R->t[k].mem.resize && (k == 0 || R->is_chain == (*taken == 0));
        if (R->status[k] != RG_OK && s == RG_OK && (k == 0 || R->is_chain == (*taken == 0))) {
            s = R->status[k];
            if (why) *why = R->why[k];
        }
        if (counts && s == RG_OK) {
            note(q, R->r->name, R->r->backwards, R->how[k].compliance, R->l->group[q->group].order, &R->t[k]);
            if (is_retraction(R, &R->t[k])) {
                rg_attempt_free(&q->best);
                q->best = R->t[k];
                memset(&R->t[k], 0, sizeof R->t[k]);
                *taken = k;
            }
        }
        rg_attempt_free(&R->t[k]);
    }
    return s;
}

/* The pattern should give way no more than it has to: half as readily, while that still folds and moves it less. */
static rg_status stiffen(rg_search *q, ladder *l, const rung *r, rg_relaxation *how, rg_diag *why)
{
    rg_status s = RG_OK;
    const int32_t most = how->compliance > 0 ? LESS_COMPLIANCE[l->settings->effort] : 0;
    int all = 1;
    for (int32_t n = 0; s == RG_OK && all && n < most && !l->watch->cancelled; n += 2) {
        int32_t taken;
        retries R = {.q = q, .l = l, .r = r, .count = most - n < 2 ? 1 : 2, .is_chain = 1, .how = {*how, *how}};
        R.how[0].farthest = R.how[1].farthest = q->best.moved;
        R.how[0].compliance /= 2;
        R.how[1].compliance /= 4;
        s = retry(&R, &taken, why);
        if (taken >= 0) *how = R.how[taken];
        all = taken == 1;
    }
    q->compliance = how->compliance;
    return s;
}

/* What is to be cut in the k-th try of the pruning, if there is anything to be tried; else in a later one. */
typedef struct pruning { int32_t k, fewer; } pruning;

static pruning after_failure(pruning p, int32_t bends) { return (pruning){p.k + 1, p.k == 0 ? bends / 2 : p.fewer / 2}; }

static int next_cuts(rg_cuts *cuts, pruning *p, int32_t tries, unsigned char *which)
{
    for (; p->k < tries && p->fewer > 0; *p = after_failure(*p, cuts->bends)) {
        if (p->k) rg_cuts_all_but(cuts, p->fewer);
        if (cuts->cut <= 0 || cuts->cut >= cuts->bends) continue;
        memcpy(which, cuts->which, (size_t)cuts->none->nf);
        return 1;
    }
    return 0;
}

/* No more creases should be added than have to be. First those of the facets that bend, or for a straight motion those at the
 * vertices that blocked it as drawn; then without those that bend least, half of them at once or, where that does not fold or
 * moves the pattern more, half as many. */
static rg_status prune(rg_search *q, ladder *l, const rung *r, const rg_relaxation *how, const int32_t *vertex,
                       int32_t vertices, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(l->settings->memory);
    const int32_t tries = (r->straight ? FEWER_STRAIGHT : FEWER_CUTS)[l->settings->effort];
    const size_t facets = (size_t)l->problem->drawn->nf;
    unsigned char *which = rg_mem_array(&mem, 2 * facets, sizeof *which);
    rg_cuts cuts;
    rg_status s = rg_cuts_init(&cuts, &mem, l->problem->drawn, &l->group[q->group], &q->best);
    if (s == RG_OK && !which) s = RG_ENOMEM;
    pruning p = {0, cuts.bends};
    if (s == RG_OK && r->straight) rg_cuts_around(&cuts, vertex, vertices);
    else if (s == RG_OK) rg_cuts_bending(&cuts, HARDLY_BENT);
    while (s == RG_OK && !l->watch->cancelled && next_cuts(&cuts, &p, tries, which)) {
        retries R = {.q = q, .l = l, .r = r, .count = 1, .is_fewer = 1, .how = {*how, *how}, .which = {which, which + facets}};
        pruning of[2] = {p, after_failure(p, cuts.bends)};
        int32_t taken;
        R.how[0].farthest = R.how[1].farthest = LITTLE_MORE * q->best.moved;
        if (next_cuts(&cuts, &of[1], tries, which + facets)) R.count = 2;
        s = retry(&R, &taken, why);
        p = after_failure(of[R.count - 1], cuts.bends);
        if (s != RG_OK || taken < 0) continue;
        q->triangulation = "some";
        q->why_triangulated = "stops short without added creases; facets that hardly bend stay whole";
        rg_cuts_measure(&cuts, &q->best);
        const int32_t half = cuts.bends / 2;
        p = (pruning){of[taken].k + 1, of[taken].k == 0 || of[taken].fewer > half ? half : of[taken].fewer};
    }
    rg_cuts_free(&cuts);
    rg_mem_free(&mem, which);
    return s;
}

static rg_status retract(rg_search *q, ladder *l, const int32_t *vertex, int32_t vertices, rg_diag *why)
{
    const rung *r = &LADDER[q->job];
    rg_relaxation how = relaxation_of(l, r);
    rg_status s = stiffen(q, l, r, &how, why);
    if (s == RG_OK && q->best.mesh.added > l->problem->drawn->added && l->settings->triangulate == RG_TRIANGULATE_AUTO)
        s = prune(q, l, r, &how, vertex, vertices, why);
    return s;
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
static rg_status find_groups(ladder *l)
{
    const rg_settings *s = l->settings;
    const rg_memory mem = rg_mem_default(s->memory);
    rg_symmetry whole;
    rg_subgroup list[MOST_GROUPS];
    rg_status status = rg_symmetry_find(&whole, &mem, l->problem->drawn);
    if (status != RG_OK) return status;
    int32_t n = rg_symmetry_subgroups(&whole, list, MOST_GROUPS);
    const int none = s->symmetry == RG_SYMMETRY_OFF || l->problem->from || l->problem->to || l->problem->drawn->still;
    if (none) n = 1;
    if (none || list[n - 1].order > 1) list[n - 1] = (rg_subgroup){whole.turns, -1, 1};
    for (int32_t k = 0; status == RG_OK && k < n; k++) {
        rg_symmetry *G = &l->group[l->groups];
        int skipped = 0;
        status = rg_symmetry_part(G, &whole, list[k].every, list[k].mirror);
        if (status == RG_OK && G->order > 1 && s->triangulate == RG_TRIANGULATE_ALL) status = leaves_whole(l->problem->drawn, G, &skipped);
        if (status == RG_OK && !skipped) l->groups++;
        else rg_symmetry_free(G);
    }
    rg_symmetry_free(&whole);
    return status;
}

/* Rungs go group by group. The largest group and none get all of them, what lies between those that are tried at the least. */
static void list_jobs(ladder *l)
{
    for (int32_t g = 0; g < l->groups; g++)
        for (int32_t k = 0; k < RUNGS; k++) {
            const rung *r = &LADDER[k];
            const int between = g > 0 && g + 1 < l->groups;
            if (!applies(l, r) || (between && r->from > RG_EFFORT_FAST)) continue;
            if (r->straight && (r->how == AS_DRAWN || g > 0)) continue; /* as drawn: tried before, and once is enough */
            l->job[l->jobs++] = (job){k, g};
        }
}

/* Straight on as drawn folds most tessellations: nothing is tried beside it. *vertex: out, what blocked it. */
static rg_status first_of_all(rg_search *q, ladder *l, int32_t **vertex, int32_t *vertices, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(l->settings->memory);
    const rg_relaxation none = {0};
    rg_status s;
    if (!applies(l, LADDER)) return RG_OK;
    rg_watch watch = {.progress = tell, .ctx = l};
    s = try_rung(l, LADDER, NULL, &none, 0, NULL, &watch, &q->best, why);
    if (s != RG_OK) return s;
    rg_attempt first = q->best;
    l->attempt = &first;
    l->job[0] = (job){0, l->groups - 1};
    keep(q, l, 0);
    l->attempt = NULL;
    note(q, LADDER->name, 0, 0, 1, &q->best);
    *vertices = q->best.vertices;
    *vertex = rg_mem_array(&mem, (size_t)*vertices, sizeof **vertex);
    if (*vertex) memcpy(*vertex, q->best.vertex, (size_t)*vertices * sizeof **vertex);
    return *vertex ? RG_OK : RG_ENOMEM;
}

rg_status rg_search_run(rg_search *q, const rg_problem *p, const rg_settings *s, rg_watch *watch, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    int32_t *vertex = NULL, vertices = 0;
    memset(q, 0, sizeof *q);
    ladder *l = rg_mem_array(&mem, 1, sizeof *l);
    if (!l) return RG_ENOMEM;
    l->problem = p, l->settings = s, l->watch = watch;
    l->triangles = 1;
    l->moves = end_is_definite(p);
    for (int32_t f = 0; f < p->drawn->nf; f++) l->triangles &= p->drawn->facet_start[f + 1] - p->drawn->facet_start[f] == 3;
    rg_status status = find_groups(l);
    if (status == RG_OK) status = first_of_all(q, l, &vertex, &vertices, why);
    if (status == RG_OK && !(q->tries && rank(&q->best) == FOLDED) && !watch->cancelled) {
        list_jobs(l);
        if (l->jobs > 0) status = climb(q, l, why);
        else if (q->tries == 0) status = rg_fail(RG_EARG, why, 0, "with these settings there is nothing to try");
    }
    if (status == RG_OK && q->best.mem.resize && rank(&q->best) >= ELSEWHERE && !watch->cancelled) status = retract(q, l, vertex, vertices, why);
    if (status == RG_OK && watch->cancelled && q->best.outcome == RG_STOPPED)
        snprintf(q->best.reason, sizeof q->best.reason, "interrupted");
    for (int32_t g = 0; g < l->groups; g++) rg_symmetry_free(&l->group[g]);
    RG_MEM_FREE(&mem, l, vertex);
    if (status != RG_OK) rg_attempt_free(&q->best);
    return status;
}
