#include "motion/strategy.h"
#include "base/status.h"

#include <stdio.h>
#include <string.h>

/* Laws of the flow, those that leave the pattern most as it is first. Found by what folds and what does not among real
 * patterns: no one law folds them all. */
static const rg_flow_law LAWS[] = {
    /* gain give kawasaki together stubborn attempts */
    {0, 0, 0, 0, 0.2, 0},
    {0.1, 0, 1, 0, 0.2, 0},  /* section 3.3 as it stands */
    {0.1, 0.5, 0, 0, 0.3, 0},
    {0.1, 1, 0, 0, 0.2, 0},
    {0.1, 2, 0, 0, 0.3, 0},
    {0.03, 1, 0, 0, 0.3, 0},
    {0.3, 1, 0, 0, 0.2, 0},
    {0.1, 1, 0, 0, 0.3, 10},
    {0.1, 1, 1, 0, 0.3, 0},
    {0.1, 3, 0, 1, 0.3, 0},
    {0.1, 0.5, 0, 0, 0.15, 0},
};
enum { LAW_COUNT = sizeof LAWS / sizeof *LAWS };
/* Laws that are tried, and work that is spent in all and on one, by effort. */
static const int32_t MOST_LAWS[] = {4, LAW_COUNT, LAW_COUNT};
static const double MOST_WORK[] = {8, 90, 1500}, MOST_WORK_OF_ONE[] = {4, 25, 300};

int rg_strategy_law(const rg_settings *s, int32_t n, rg_flow_law *law, double *work)
{
    if (n >= MOST_LAWS[s->effort]) return -1;
    *law = LAWS[n];
    *work = MOST_WORK_OF_ONE[s->effort];
    if (law->gain > 0 && s->adjust > 0) law->gain = s->adjust;
    return s->adjust != 0 || law->gain == 0;
}

/* The facets as drawn, or cut: so that inside angles are split, or by the shortest diagonals. Either folds patterns that the
 * other does not. */
typedef enum cut { AS_DRAWN, SPLITTING, SHORT } cut;

/* How often half as much give is tried when the pattern folds. */
static const int32_t LESS_GIVE[] = {0, 2, 5};
/* How often fewer cuts are tried then; a facet that bends by less (radians) may stay whole, if no vertex goes much farther. */
static const int32_t FEWER_CUTS[] = {0, 2, 4};
static const double HARDLY_BENT = 10 * RG_DEG, LITTLE_MORE = 1.1;

static rg_status copy_mesh(const rg_mesh *m, cut how, const unsigned char *which, rg_mesh *out)
{
    if (which && how) return rg_triangulate_some(m, which, how == SHORT, out);
    return how == SPLITTING ? rg_triangulate_all(m, out) : how == SHORT ? rg_triangulate_short(m, out) : rg_mesh_copy(m, out);
}

static void add_cost(rg_cost *sum, const rg_cost *c)
{
    sum->steps += c->steps;
    sum->solves += c->solves;
    sum->iterations += c->iterations;
    sum->factorizations += c->factorizations;
    sum->assemblies += c->assemblies;
    sum->seconds += c->seconds;
}

/* Beyond half a turn, facets at a crease pass through each other: a try that does so by more is second best; and so is one
 * that goes as far as was asked for with some creases left behind, as it need not be on the way to the folded state. */
static const double OVERFOLD = 0.1 * RG_DEG;

static int rank(const rg_take *t) { return t->outcome != RG_FOLDED ? 0 : t->overfold > OVERFOLD || t->strays > 0 ? 1 : 2; }

static int is_better(const rg_take *t, const rg_take *old)
{
    const int mine = rank(t), its = old->mem.resize ? rank(old) : -1;
    if (mine != its) return mine > its;
    return mine == 2 ? t->moved < old->moved : mine == 1 ? t->strays < old->strays : t->score > old->score;
}

/* Keeps the better of what is kept and *t; takes *t over. Of two that fold the one that moves the pattern less is better.
 * Non-zero: *t folds, and was kept. */
static int consider(rg_choice *c, rg_take *t, const char *triangulation, const char *why, const char *strategy)
{
    add_cost(&c->cost, &t->cost);
    const int folds = rank(t) == 2;
    c->tries++;
    if (!is_better(t, &c->take)) {
        rg_take_free(t);
        return 0;
    }
    rg_take_free(&c->take);
    c->take = *t;
    memset(t, 0, sizeof *t);
    c->triangulation = triangulation;
    c->why_triangulated = why;
    snprintf(c->strategy, sizeof c->strategy, "%s", strategy);
    return folds;
}

static rg_status straight(rg_choice *c, const rg_mesh *none, const rg_settings *s, int all, const char *why_all,
                          rg_watch *watch, rg_diag *why, int *done)
{
    rg_mesh m;
    rg_take t;
    rg_settings mine = *s;
    mine.triangulate = all ? RG_TRIANGULATE_ALL : RG_TRIANGULATE_NONE;
    rg_status status = copy_mesh(none, all ? SPLITTING : AS_DRAWN, NULL, &m);
    if (status == RG_OK) status = rg_take_straight(&t, &m, &mine, watch, why);
    if (status != RG_OK) return status;
    *done = consider(c, &t, all ? "all" : "none", why_all, all ? "straight on, triangulated" : "straight on") || watch->cancelled;
    return RG_OK;
}

static void describe(const rg_flow_law *law, cut how, int back, char *text, size_t room)
{
    const char *moves = law->give > 0 ? "joint flow, the pattern gives way" : law->gain > 0 ? "flow with adjusted creases" : "flow";
    snprintf(text, room, "%s%s%s%s%s", moves, how == SPLITTING ? ", triangulated" : how == SHORT ? ", triangulated by short diagonals" : "", law->kawasaki ? ", kept flat-foldable" : "",
             law->attempts ? ", several starts" : "", back ? ", unfolded from its end" : "");
}

/* What is tried, besides the law: how facets are cut, and which, NULL: all; whether the motion is found from its end; and the
 * work that is left. */
typedef struct way {
    cut how;
    const unsigned char *which;
    int back;
    double left;
} way;

/* One flow by one law, from flat or, back, from the folded end to flat. */
static rg_status flow_once(rg_take *t, const rg_mesh *none, const rg_settings *s, const rg_flow_law *law, const way *w,
                           double budget, rg_watch *watch, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    const double sign = s->to < 0 ? -1 : 1;
    rg_mesh m;
    rg_status status = copy_mesh(none, w->how, w->which, &m);
    if (status != RG_OK) return status;
    double *target = rg_mem_array(&mem, (size_t)m.N, sizeof *target), *end = rg_mem_array(&mem, (size_t)m.N, sizeof *end);
    double *flat = rg_mem_array(&mem, (size_t)m.N, sizeof *flat);
    if (target && end && flat) {
        for (int32_t i = 0; i < m.N; i++) {
            target[i] = i < m.N - m.added ? sign * m.target[m.crease_edge[i]] : NAN;
            end[i] = isnan(target[i]) ? 0 : target[i];
        }
        if (!w->back) {
            status = rg_take_flow(t, &m, s, law, NULL, target, budget, watch, why);
        } else {
            for (int32_t i = 0; i < m.N; i++) flat[i] = isnan(target[i]) ? NAN : 0;
            status = rg_take_flow(t, &m, s, law, end, flat, budget, watch, why);
            if (status == RG_OK) rg_take_turn_round(t, target);
        }
    } else {
        status = RG_ENOMEM;
    }
    rg_mesh_free(&m);
    rg_mem_free(&mem, target);
    rg_mem_free(&mem, end);
    rg_mem_free(&mem, flat);
    return status;
}

static rg_status try_flow(rg_choice *c, const rg_mesh *none, const rg_settings *s, const rg_flow_law *law, way *w, double work,
                          rg_watch *watch, rg_diag *why, int *folds)
{
    rg_take t;
    char text[160];
    const rg_status status = flow_once(&t, none, s, law, w, fmin(w->left, work), watch, why);
    if (status != RG_OK) return status;
    w->left -= t.work;
    describe(law, w->how, w->back, text, sizeof text);
    *folds = consider(c, &t, w->how ? "all" : "none", w->how ? "stops short without added creases"
                    : s->triangulate == RG_TRIANGULATE_AUTO     ? "folds without added creases"
                                                                : "asked for", text);
    return RG_OK;
}

/* The pattern should give way no more than it has to: half as readily, while that still folds and moves it less. */
static rg_status economise(rg_choice *c, const rg_mesh *none, const rg_settings *s, rg_flow_law law, way *w, double work,
                           rg_watch *watch, rg_diag *why)
{
    rg_status status = RG_OK;
    for (int n = 0, folds = 1; n < LESS_GIVE[s->effort] && folds && w->left > 0 && !watch->cancelled && status == RG_OK; n++) {
        law.give /= 2;
        status = try_flow(c, none, s, &law, w, work, watch, why, &folds);
    }
    return status;
}

/* Facets that bend by `least` or more somewhere in the kept motion; how many that is. Added creases come facet by facet. */
static int32_t mark_bending(const rg_take *t, const rg_mesh *none, double least, unsigned char *which)
{
    const size_t N = (size_t)t->mesh.N;
    int32_t i = t->mesh.N - t->mesh.added, n = 0;
    for (int32_t f = 0; f < none->nf; f++) {
        which[f] = 0;
        for (int32_t k = none->facet_start[f] + 3; k < none->facet_start[f + 1] && i < t->mesh.N; k++, i++)
            for (int32_t frame = 0; frame < t->count; frame++)
                which[f] |= fabs(t->rho[(size_t)frame * N + (size_t)i]) >= least;
        n += which[f];
    }
    return n;
}

/* No more creases should be added than have to be: facets that hardly bend stay whole, if it folds then and moves the
 * pattern little more. */
static rg_status prune(rg_choice *c, const rg_mesh *none, const rg_settings *s, way *w, double work, rg_watch *watch, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    unsigned char *which = rg_mem_array(&mem, (size_t)none->nf, 1);
    rg_status status = which ? RG_OK : RG_ENOMEM;
    for (int n = 0; status == RG_OK && n < FEWER_CUTS[s->effort] && w->left > 0 && !watch->cancelled; n++) {
        rg_take t;
        const int32_t bending = mark_bending(&c->take, none, HARDLY_BENT * (n + 1), which);
        if (bending == 0 || c->take.mesh.added == 0) break;
        const rg_flow_law law = c->take.law;
        w->which = which;
        status = flow_once(&t, none, s, &law, w, fmin(w->left, work), watch, why);
        if (status != RG_OK) break;
        w->left -= t.work;
        c->tries++;
        add_cost(&c->cost, &t.cost);
        const int better = rank(&t) == 2 && t.mesh.added < c->take.mesh.added && t.moved <= LITTLE_MORE * c->take.moved;
        if (better) {
            rg_take_free(&c->take);
            c->take = t;
            c->triangulation = "some";
            c->why_triangulated = "stops short without added creases; facets that hardly bend stay whole";
        } else {
            rg_take_free(&t);
            break;
        }
    }
    rg_mem_free(&mem, which);
    return status;
}

static rg_status flow(rg_choice *c, const rg_mesh *none, const rg_settings *s, int all, int may_leave, rg_watch *watch,
                      rg_diag *why)
{
    double work;
    int folds = 0;
    rg_flow_law law;
    rg_status status = RG_OK;
    way w = {AS_DRAWN, NULL, 0, MOST_WORK[s->effort]};
    if (all && may_leave && rg_strategy_law(s, 0, &law, &work) > 0) {
        status = try_flow(c, none, s, &law, &w, work, watch, why, &folds);
        if (status != RG_OK || folds) return status;
    }
    for (int32_t n = 0, use; (use = rg_strategy_law(s, n, &law, &work)) >= 0; n++)
        for (int k = 0; use && k < 4; k++) {
            const int shorter = k / 2;
            w.back = k % 2;
            w.how = !all ? AS_DRAWN : shorter ? SHORT : SPLITTING;
            if (w.back && !(law.give > 0 && s->to != 0)) continue;
            if (shorter && (!all || law.gain == 0)) continue;
            if (!(w.left > 0) || watch->cancelled) return RG_OK;
            status = try_flow(c, none, s, &law, &w, work, watch, why, &folds);
            if (status != RG_OK) return status;
            if (!folds) continue;
            if (law.give > 0) status = economise(c, none, s, law, &w, work, watch, why);
            if (status == RG_OK && may_leave) status = prune(c, none, s, &w, work, watch, why);
            return status;
        }
    return RG_OK;
}

rg_status rg_strategy_run(rg_choice *c, const rg_mesh *none, const rg_settings *s, rg_watch *watch, rg_diag *why)
{
    const int may_add = s->triangulate != RG_TRIANGULATE_NONE, may_leave = s->triangulate != RG_TRIANGULATE_ALL;
    int triangles = 1, done = 0;
    for (int32_t f = 0; f < none->nf; f++) triangles &= none->facet_start[f + 1] - none->facet_start[f] == 3;
    memset(c, 0, sizeof *c);
    rg_status status = RG_OK;
    if (may_leave || triangles)
        status = straight(c, none, s, 0, may_add && may_leave ? "folds without added creases" : "asked for", watch, why, &done);
    if (status == RG_OK && !done && may_add && !triangles)
        status = straight(c, none, s, 1, may_leave ? "stops short without added creases" : "asked for", watch, why, &done);
    /* Who asks for a method and no adjustment asks for that and nothing else. */
    if (status == RG_OK && !done && !(s->method != RG_METHOD_AUTO && s->adjust == 0))
        status = flow(c, none, s, may_add && !triangles, may_leave, watch, why);
    if (status == RG_OK && c->take.outcome != RG_FOLDED && strcmp(c->triangulation, "none") == 0 && may_add && may_leave && !triangles)
        c->why_triangulated = "added creases get it no further";
    if (status != RG_OK) rg_take_free(&c->take);
    return status;
}
