#include "motion/retract.h"
#include "fold/tuning.h"
#include "motion/cuts.h"

#include <string.h>

/* Up to two more tries like the one that is kept, at once. In a chain the second counts only where the first is taken;
 * else it is another choice, and counts only where the first is not. So what is taken is the same as if one had been
 * made after the other. */
typedef struct retries {
    rg_search *q;
    rg_ladder *l;
    int32_t count;
    int is_chain, is_fewer;         /* is_fewer: cuts are saved, and not compliance */
    rg_ladder_try one[2];
    rg_attempt t[2];
    rg_status status[2];
    rg_diag why[2];
} retries;

static int is_retraction(const retries *R, const rg_attempt *t)
{
    const rg_attempt *best = &R->q->best;
    if (rg_ladder_rank(t) < RG_ELSEWHERE || rg_ladder_rank(t) < rg_ladder_rank(best)) return 0;
    if (!R->is_fewer) return t->moved < best->moved;
    return t->mesh.added < best->mesh.added && t->moved <= LITTLE_MORE * best->moved;
}

static int run(void *ctx, rg_race *race, int32_t k, int in_calling_thread)
{
    retries *R = ctx;
    int ended;
    R->status[k] = rg_ladder_race(R->l, &R->one[k], race, k, in_calling_thread, &R->t[k], &ended, &R->why[k]);
    if (R->status[k] != RG_OK || (in_calling_thread && R->l->watch->cancelled)) return -1;
    const int is = !ended && is_retraction(R, &R->t[k]);
    return R->is_chain ? (k == 0 && !is ? -1 : 0) : is;
}

static int look_up(void *ctx) { return rg_ladder_tell(((retries *)ctx)->l, 0); }

/* *taken: out, which of them is kept now, the second one of a chain if both are; -1: none. */
static rg_status retry(retries *R, int32_t *taken, rg_diag *why)
{
    rg_search *q = R->q;
    rg_race_rules rules = {R->count, rg_ladder_workers(R->l), run, look_up, R};
    int32_t done;
    rg_status s = RG_OK;
    for (int k = 0; k < 2; k++) R->one[k].work = fmin(R->one[k].work, RETRIED_WORK * q->best.work);
    rg_race_run(&rules, &done);
    *taken = -1;
    for (int32_t k = 0; k < R->count; k++) {
        const int counts = k == 0 || R->is_chain == (*taken == 0);
        if (R->status[k] != RG_OK && s == RG_OK && counts) {
            s = R->status[k];
            if (why) *why = R->why[k];
        }
        if (counts && R->t[k].mem.resize && s == RG_OK) {
            rg_ladder_note(q, &R->one[k], &R->t[k]);
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
static rg_status stiffen(rg_search *q, rg_ladder *l, rg_ladder_try *now, rg_diag *why)
{
    rg_status s = RG_OK;
    const int32_t most = now->how.compliance > 0 ? LESS_COMPLIANCE[l->settings->effort] : 0;
    int all = 1;
    for (int32_t n = 0; s == RG_OK && all && n < most && !l->watch->cancelled; n += 2) {
        int32_t taken;
        retries R = {.q = q, .l = l, .count = most - n < 2 ? 1 : 2, .is_chain = 1, .one = {*now, *now}};
        for (int k = 0; k < 2; k++) R.one[k].how.farthest = q->best.moved;
        R.one[0].how.compliance /= 2;
        R.one[1].how.compliance /= 4;
        s = retry(&R, &taken, why);
        if (taken >= 0) now->how = R.one[taken].how;
        all = taken == 1;
    }
    q->compliance = now->how.compliance;
    return s;
}

typedef struct pruning { int32_t k, fewer; } pruning;

static pruning after_failure(pruning p, int32_t bends)
{
    return (pruning){p.k + 1, p.k == 0 ? bends / 2 : p.fewer / 2};
}

/* What is to be cut in the k-th try of the pruning, if there is anything to be tried; else in a later one. */
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

/* No more creases should be added than have to be. First those of the facets that bend, or for a straight motion those
 * at the vertices that blocked it as drawn; then without those that bend least, half of them at once or, where that
 * does not fold or moves the pattern more, half as many. */
static rg_status prune(rg_search *q, rg_ladder *l, const rg_ladder_try *now, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(l->settings->memory);
    const int straight = now->r->straight;
    const int32_t tries = (straight ? FEWER_STRAIGHT : FEWER_CUTS)[l->settings->effort];
    const size_t facets = (size_t)l->problem->drawn->nf;
    unsigned char *which = rg_mem_array(&mem, 2 * facets, sizeof *which);
    rg_cuts cuts;
    rg_status s = rg_cuts_init(&cuts, &mem, l->problem->drawn, now->G, &q->best);
    if (s == RG_OK && !which) s = RG_ENOMEM;
    pruning p = {0, cuts.bends};
    if (s == RG_OK && straight) rg_cuts_around(&cuts, l->blocked, l->blocked_count);
    else if (s == RG_OK) rg_cuts_bending(&cuts, HARDLY_BENT);
    while (s == RG_OK && !l->watch->cancelled && next_cuts(&cuts, &p, tries, which)) {
        retries R = {.q = q, .l = l, .count = 1, .is_fewer = 1, .one = {*now, *now}};
        pruning of[2] = {p, after_failure(p, cuts.bends)};
        int32_t taken;
        for (size_t k = 0; k < 2; k++) {
            R.one[k].how.farthest = LITTLE_MORE * q->best.moved;
            R.one[k].which = which + k * facets;
        }
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

rg_status rg_retract(rg_search *q, rg_ladder *l, rg_diag *why)
{
    rg_ladder_try now = rg_ladder_plain(l, l->kept, l->kept_group);
    rg_status s = stiffen(q, l, &now, why);
    if (s == RG_OK && q->best.mesh.added > l->problem->drawn->added && l->settings->triangulate == RG_TRIANGULATE_AUTO)
        s = prune(q, l, &now, why);
    return s;
}
