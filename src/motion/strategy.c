#include "motion/strategy.h"
#include "base/status.h"
#include "motion/cuts.h"

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
/* How often fewer cuts are tried then, of a flow and straight on; a facet that bends by less (radians) may stay whole, if no
 * vertex goes much farther. */
static const int32_t FEWER_CUTS[] = {0, 3, 8}, FEWER_STRAIGHT[] = {0, 8, 24};
/* Groups that are tried: the largest ones, and at last the one that asks for nothing. */
enum { MOST_GROUPS = 4 };
static const double HARDLY_BENT = 10 * RG_DEG, LITTLE_MORE = 1.1;

static rg_status copy_mesh(const rg_mesh *m, cut how, const unsigned char *which, const rg_symmetry *G, rg_mesh *out)
{
    return how ? rg_triangulate_orbits(m, G, which, how == SHORT, out) : rg_mesh_copy(m, out);
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

/* Short of the end, what moves the pattern must come this much farther than what leaves it as it is. */
static const double WORTH_MOVING = 0.1;

static int is_better(const rg_take *t, const rg_take *old)
{
    const int mine = rank(t), its = old->mem.resize ? rank(old) : -1;
    if (mine != its) return mine > its;
    return mine == 2 ? t->moved < old->moved : mine == 1 ? t->strays < old->strays : t->score > old->score + (t->moved > 0 && old->moved == 0 ? WORTH_MOVING : 0);
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

/* What is tried, besides the law: the symmetry kept; how facets are cut, and which, NULL: all; straight on, with no law; whether the motion is
 * found from its end; and the work that is left, and may be spent on one try. */
typedef struct way {
    const rg_symmetry *G;
    cut how;
    const unsigned char *which;
    int straight, back;
    double left, work;
} way;

static rg_status straight_once(rg_take *t, const rg_mesh *none, const rg_settings *s, const way *w, rg_watch *watch, rg_diag *why)
{
    rg_mesh m;
    rg_settings mine = *s;
    mine.triangulate = w->how ? RG_TRIANGULATE_ALL : RG_TRIANGULATE_NONE;
    const rg_status status = copy_mesh(none, w->how, w->which, w->G, &m);
    return status == RG_OK ? rg_take_straight(t, &m, &mine, watch, why) : status;
}

/* One flow by one law, from flat or, back, from the folded end to flat. */
static rg_status flow_once(rg_take *t, const rg_mesh *none, const rg_settings *s, const rg_flow_law *law, const way *w,
                           rg_watch *watch, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    const double sign = s->to < 0 ? -1 : 1, budget = fmin(w->left, w->work);
    rg_mesh m;
    rg_status status = copy_mesh(none, w->how, w->which, w->G, &m);
    if (status != RG_OK) return status;
    double *target = rg_mem_array(&mem, (size_t)m.N, sizeof *target), *end = rg_mem_array(&mem, (size_t)m.N, sizeof *end);
    double *flat = rg_mem_array(&mem, (size_t)m.N, sizeof *flat);
    if (target && end && flat) {
        for (int32_t i = 0; i < m.N; i++) {
            target[i] = i < m.N - m.added ? sign * m.target[m.crease_edge[i]] : NAN;
            end[i] = isnan(target[i]) ? 0 : target[i];
        }
        if (!w->back) {
            status = rg_take_flow(t, &m, s, law, NULL, target, w->G, budget, watch, why);
        } else {
            for (int32_t i = 0; i < m.N; i++) flat[i] = isnan(target[i]) ? NAN : 0;
            status = rg_take_flow(t, &m, s, law, end, flat, w->G, budget, watch, why);
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

static rg_status once(rg_take *t, const rg_mesh *none, const rg_settings *s, const rg_flow_law *law, way *w, rg_watch *watch,
                      rg_diag *why)
{
    const rg_status status = w->straight ? straight_once(t, none, s, w, watch, why) : flow_once(t, none, s, law, w, watch, why);
    if (status == RG_OK) w->left -= t->work;
    return status;
}

/* Fewer creases are added: is *t still as good? Takes it over. */
static int take_fewer(rg_choice *c, rg_take *t)
{
    c->tries++;
    add_cost(&c->cost, &t->cost);
    if (!(rank(t) == 2 && t->mesh.added < c->take.mesh.added && t->moved <= LITTLE_MORE * c->take.moved)) {
        rg_take_free(t);
        return 0;
    }
    rg_take_free(&c->take);
    c->take = *t;
    c->triangulation = "some";
    c->why_triangulated = "stops short without added creases; facets that hardly bend stay whole";
    return 1;
}

/* No more creases should be added than have to be: what folds with all facets cut, with fewer. First with those that cuts say;
 * then without those that bend least, half of them at once or, where that does not fold or moves the pattern more, half as
 * many. */
static rg_status prune(rg_choice *c, rg_cuts *cuts, const rg_settings *s, way *w, rg_watch *watch, rg_diag *why)
{
    const int32_t tries = (w->straight ? FEWER_STRAIGHT : FEWER_CUTS)[s->effort];
    rg_status status = RG_OK;
    int32_t fewer = cuts->bends;
    for (int32_t k = 0; status == RG_OK && k < tries && fewer > 0 && w->left > 0 && !watch->cancelled; k++) {
        const rg_flow_law law = c->take.law;
        int folds = 0;
        if (k) rg_cuts_all_but(cuts, fewer);
        w->which = cuts->which;
        if (cuts->cut > 0 && cuts->cut < cuts->bends) {
            rg_take t;
            status = once(&t, cuts->none, s, &law, w, watch, why);
            folds = status == RG_OK && take_fewer(c, &t);
        }
        if (folds) rg_cuts_measure(cuts, &c->take);
        const int32_t half = cuts->bends / 2;
        fewer = k == 0 || (folds && fewer > half) ? half : folds ? fewer : fewer / 2;
    }
    w->which = NULL;
    return status;
}

static rg_status straight(rg_choice *c, const rg_mesh *none, const rg_settings *s, int may_leave, rg_watch *watch, rg_diag *why,
                          int *done)
{
    const way w = {.how = AS_DRAWN};
    rg_take t;
    const rg_status status = straight_once(&t, none, s, &w, watch, why);
    if (status != RG_OK) return status;
    *done = consider(c, &t, "none", may_leave ? "folds without added creases" : "asked for", "straight on") || watch->cancelled;
    return RG_OK;
}

static rg_status straight_cut(rg_choice *c, const rg_mesh *none, const rg_settings *s, const rg_symmetry *G, int may_leave,
                              rg_watch *watch, rg_diag *why, int *done)
{
    const rg_memory mem = rg_mem_default(s->memory);
    const int32_t vertices = c->take.vertices;
    int32_t *vertex = rg_mem_array(&mem, (size_t)vertices, sizeof *vertex);
    way w = {.G = G, .how = SPLITTING, .straight = 1, .left = 1};
    rg_take t;
    rg_cuts cuts;
    if (!vertex) return RG_ENOMEM;
    for (int32_t i = 0; i < vertices; i++) vertex[i] = c->take.vertex[i];
    rg_status status = straight_once(&t, none, s, &w, watch, why);
    if (status == RG_OK)
        *done = consider(c, &t, "all", may_leave ? "stops short without added creases" : "asked for", "straight on, triangulated");
    if (status == RG_OK && *done && may_leave) {
        status = rg_cuts_init(&cuts, &mem, none, w.G, &c->take);
        if (status == RG_OK) {
            rg_cuts_around(&cuts, vertex, vertices); /* that may be all it takes */
            status = prune(c, &cuts, s, &w, watch, why);
        }
        rg_cuts_free(&cuts);
    }
    rg_mem_free(&mem, vertex);
    *done |= watch->cancelled;
    return status;
}

static void describe(const rg_flow_law *law, cut how, int back, char *text, size_t room)
{
    const char *moves = law->give > 0 ? "joint flow, the pattern gives way" : law->gain > 0 ? "flow with adjusted creases" : "flow";
    const char *cuts = how == SPLITTING ? ", triangulated" : how == SHORT ? ", triangulated by short diagonals" : "";
    snprintf(text, room, "%s%s%s%s%s", moves, cuts, law->kawasaki ? ", kept flat-foldable" : "",
             law->attempts ? ", several starts" : "", back ? ", unfolded from its end" : "");
}

static rg_status try_flow(rg_choice *c, const rg_mesh *none, const rg_settings *s, const rg_flow_law *law, way *w, rg_watch *watch,
                          rg_diag *why, int *folds)
{
    rg_take t;
    char text[160];
    const rg_status status = once(&t, none, s, law, w, watch, why);
    if (status != RG_OK) return status;
    describe(law, w->how, w->back, text, sizeof text);
    const char *cause = w->how                                    ? "stops short without added creases"
                        : s->triangulate == RG_TRIANGULATE_AUTO ? "folds without added creases"
                                                                : "asked for";
    *folds = consider(c, &t, w->how ? "all" : "none", cause, text);
    return RG_OK;
}

/* The pattern should give way no more than it has to: half as readily, while that still folds and moves it less. */
static rg_status economise(rg_choice *c, const rg_mesh *none, const rg_settings *s, rg_flow_law law, way *w, rg_watch *watch,
                           rg_diag *why)
{
    rg_status status = RG_OK;
    for (int n = 0, folds = 1; n < LESS_GIVE[s->effort] && folds && w->left > 0 && !watch->cancelled && status == RG_OK; n++) {
        law.give /= 2;
        status = try_flow(c, none, s, &law, w, watch, why, &folds);
    }
    return status;
}

/* The same of a flow: facets that hardly bend may stay whole. */
static rg_status prune_flow(rg_choice *c, const rg_mesh *none, const rg_settings *s, way *w, rg_watch *watch, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    rg_cuts cuts;
    rg_status status = rg_cuts_init(&cuts, &mem, none, w->G, &c->take);
    if (status == RG_OK && c->take.mesh.added > 0) {
        rg_cuts_bending(&cuts, HARDLY_BENT);
        status = prune(c, &cuts, s, w, watch, why);
    }
    rg_cuts_free(&cuts);
    return status;
}

static rg_status flow(rg_choice *c, const rg_mesh *none, const rg_settings *s, const rg_symmetry *G, int all, int may_leave,
                      rg_watch *watch, rg_diag *why, int *done)
{
    int folds = 0;
    rg_flow_law law;
    rg_status status = RG_OK;
    way w = {.G = G, .how = AS_DRAWN, .left = MOST_WORK[s->effort]};
    if (all && may_leave && rg_strategy_law(s, 0, &law, &w.work) > 0) {
        status = try_flow(c, none, s, &law, &w, watch, why, &folds);
        *done |= folds;
        if (status != RG_OK || folds) return status;
    }
    for (int32_t n = 0, use; (use = rg_strategy_law(s, n, &law, &w.work)) >= 0; n++)
        for (int k = 0; use && k < 4; k++) {
            const int shorter = k / 2;
            w.back = k % 2;
            w.how = !all ? AS_DRAWN : shorter ? SHORT : SPLITTING;
            if (w.back && !(law.give > 0 && s->to != 0)) continue;
            if (shorter && (!all || law.gain == 0)) continue;
            if (!(w.left > 0) || watch->cancelled) return RG_OK;
            status = try_flow(c, none, s, &law, &w, watch, why, &folds);
            if (status != RG_OK) return status;
            if (!folds) continue;
            *done = 1;
            if (law.give > 0) status = economise(c, none, s, law, &w, watch, why);
            if (status == RG_OK && may_leave) status = prune_flow(c, none, s, &w, watch, why);
            return status;
        }
    return RG_OK;
}

static rg_status in_group(rg_choice *c, const rg_mesh *none, const rg_settings *s, const rg_symmetry *G, int triangles,
                          rg_watch *watch, rg_diag *why, int *done)
{
    const int may_add = s->triangulate != RG_TRIANGULATE_NONE, may_leave = s->triangulate != RG_TRIANGULATE_ALL;
    rg_status status = RG_OK;
    if (may_add && !triangles) status = straight_cut(c, none, s, G, may_leave, watch, why, done);
    /* Who asks for a method and no adjustment asks for that and nothing else. */
    if (status == RG_OK && !*done && !(s->method != RG_METHOD_AUTO && s->adjust == 0))
        status = flow(c, none, s, G, may_add && !triangles, may_leave, watch, why, done);
    return status;
}

/* Who asks for triangles gets them: groups under which a facet has to stay whole are no answer then. */
static rg_status leaves_whole(const rg_mesh *none, const rg_symmetry *G, int *whole)
{
    rg_mesh m;
    const rg_status status = rg_triangulate_orbits(none, G, NULL, 0, &m);
    if (status != RG_OK) return status;
    *whole = 0;
    for (int32_t f = 0; f < m.nf; f++) *whole |= m.facet_start[f + 1] - m.facet_start[f] > 3;
    rg_mesh_free(&m);
    return RG_OK;
}

/* The pattern's symmetry is kept, or as much of it as folds. */
static rg_status by_groups(rg_choice *c, const rg_mesh *none, const rg_settings *s, int triangles, rg_watch *watch, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    rg_symmetry whole, G;
    rg_subgroup list[MOST_GROUPS];
    int done = 0;
    rg_status status = rg_symmetry_find(&whole, &mem, none);
    if (status != RG_OK) return status;
    int32_t n = rg_symmetry_subgroups(&whole, list, MOST_GROUPS);
    if (s->symmetry == RG_SYMMETRY_OFF) n = 1;
    if (s->symmetry == RG_SYMMETRY_OFF || list[n - 1].order > 1) list[n - 1] = (rg_subgroup){whole.turns, -1, 1};
    for (int32_t k = 0; status == RG_OK && k < n && !done && !watch->cancelled; k++) {
        status = rg_symmetry_part(&G, &whole, list[k].every, list[k].mirror);
        int skipped = 0;
        if (status == RG_OK && G.order > 1 && s->triangulate == RG_TRIANGULATE_ALL) status = leaves_whole(none, &G, &skipped);
        if (status == RG_OK && !skipped) status = in_group(c, none, s, &G, triangles, watch, why, &done);
        rg_symmetry_free(&G);
    }
    rg_symmetry_free(&whole);
    return status;
}

rg_status rg_strategy_run(rg_choice *c, const rg_mesh *none, const rg_settings *s, rg_watch *watch, rg_diag *why)
{
    const int may_add = s->triangulate != RG_TRIANGULATE_NONE, may_leave = s->triangulate != RG_TRIANGULATE_ALL;
    int triangles = 1, done = 0;
    for (int32_t f = 0; f < none->nf; f++) triangles &= none->facet_start[f + 1] - none->facet_start[f] == 3;
    memset(c, 0, sizeof *c);
    rg_status status = RG_OK;
    if (may_leave || triangles)
        status = straight(c, none, s, may_add && may_leave, watch, why, &done);
    if (status == RG_OK && !done) status = by_groups(c, none, s, triangles, watch, why);
    if (status == RG_OK && c->take.outcome != RG_FOLDED && strcmp(c->triangulation, "none") == 0 && may_add && may_leave && !triangles)
        c->why_triangulated = "added creases get it no further";
    /* Of a search that was cut short the best so far is kept, which need not be the try that was cut short. */
    if (status == RG_OK && watch->cancelled && c->take.outcome != RG_FOLDED)
        snprintf(c->take.reason, sizeof c->take.reason, "interrupted");
    if (status != RG_OK) rg_take_free(&c->take);
    return status;
}
