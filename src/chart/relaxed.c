#include "chart/relaxed.h"
#include "base/clock.h"
#include "chart/order.h"
#include "fold/chord.h"

#include <stdio.h>
#include <string.h>

const int rg_relaxed_percent[RG_RELAXED_PERCENTS] = {10, 25, 50, 75, 90, 100};
/* Changes above this, radians, are of paths that went different ways, and show no order. */
static const double SAME_WAY = 0.5;
/* Runs that take longer, in seconds, are the last; what is quicker is repeated while all its runs take less. */
static const double LONGEST = 2, PATIENCE = 0.1;
static const int REPEATS = 3;

/* What a run leaves to compare with: [frames] states at even progress. */
typedef struct track { rg_frames rho, pattern; } track;

/* One system's counters, in products with its A: two multiplications and additions a number, as for C. */
static double passes(const rg_least *A)
{
    const double pass = 2.0 * A->start[A->columns];
    return 2 * (double)(A->solves + A->iterations) +
           ((double)A->factorizations * A->L.S.flops + 4 * (double)(A->solves + A->iterations) * A->L.S.entries) / pass;
}

/* Of the whole A, whichever system was solved. */
static double all_passes(const rg_relax *F)
{
    const rg_least *A = &F->J.A, *by_orbits = &F->orbits.A;
    const double whole = A->start[A->columns], orbits = F->by_orbits ? by_orbits->start[by_orbits->columns] : 0;
    return RG_ASSEMBLY_PASSES * (double)F->assemblies + passes(A) +
        (orbits > 0 ? passes(by_orbits) * orbits / whole : 0);
}

/* Frames of the path that F found, and by how much they are open. */
static void read_off(rg_relax *F, const rg_settings *s, const rg_attempt *best, rg_run *r, track *out)
{
    const size_t N = (size_t)F->N, nv = (size_t)F->mesh.nv;
    double *z = F->wish; /* nothing is wished for any more */
    for (int32_t k = 0; k < s->frames; k++) {
        const double part = fabs(s->to) * k / (s->frames - 1), due = best->backwards ? 1 - part : part;
        const double closure = rg_chord_at(F, fmin(due, F->node_s[F->nodes - 1]), z);
        if (!(closure <= r->closure)) r->closure = closure;
        for (size_t i = 0; i < N; i++)
            if (!(fabs(z[i]) - RG_PI <= r->beyond)) r->beyond = fabs(z[i]) - RG_PI;
        memcpy(out->rho.rho + (size_t)k * N, z, N * sizeof *z);
        rg_freedom_move(&F->freedom, z + N, (rg_vec2 *)(void *)(out->pattern.rho + 2 * (size_t)k * nv));
    }
    r->frames = out->rho.count = out->pattern.count = s->frames;
}

/* A stepper like that of `best`, by another step, with room for as many nodes as small steps need. */
static rg_status begin(rg_relax *F, const rg_attempt *best, const rg_settings *s)
{
    const size_t N = (size_t)best->mesh.N;
    double *from, *to;
    rg_status status = RG_MEM_ARRAYS(&best->mem, RG_ARRAY(from, N), RG_ARRAY(to, N));
    for (size_t i = 0; status == RG_OK && i < N; i++) {
        const double goal = best->target[i];
        from[i] = best->backwards && !isnan(goal) ? goal : 0;
        to[i] = !best->backwards || isnan(goal) ? goal : 0;
    }
    memset(F, 0, sizeof *F);
    const double *start = best->backwards ? from : NULL;
    if (status == RG_OK) status = rg_relax_init(F, &best->mesh, s, &best->relax->how, start, to);
    if (status == RG_OK && best->symmetry) status = rg_relax_keep(F, best->symmetry);
    RG_MEM_FREE(&best->mem, from, to);
    return status;
}

static int is_ended(rg_watch *w)
{
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, 0) != 0;
    return w->cancelled;
}

/* Folds like `best`, by another step. out NULL: for its time only. */
static rg_status fold(const rg_attempt *best, const rg_settings *settings, double step, rg_watch *watch, rg_run *r,
                      track *out, char reason[static RG_REASON])
{
    rg_settings s = *settings;
    rg_relax F;
    s.step = step;
    if (best->backwards) s.to = copysign(1, s.to); /* a part of the whole way is read off */
    memset(r, 0, sizeof *r);
    r->way = (rg_way){RG_METHOD_RELAXED, RG_SOLVER_CHOLESKY, step, s.tol, 0};
    r->method = RG_METHOD_RELAXED;
    r->solver = RG_SOLVER_CHOLESKY;
    r->error = r->pattern_error = NAN;
    const double begun = rg_seconds();
    rg_status status = begin(&F, best, &s);
    while (status == RG_OK && F.outcome == RG_RUNNING) {
        rg_relax_step(&F);
        if (is_ended(watch)) break;
    }
    r->seconds = rg_seconds() - begun;
    if (status == RG_OK) {
        const int folded = F.outcome == RG_FOLDED && (F.landed || !best->backwards);
        const rg_least *A = &F.J.A, *by_orbits = &F.orbits.A;
        r->outcome = folded ? RG_FOLDED : RG_STOPPED;
        r->percent = 100 * F.s;
        r->steps = F.steps;
        r->solves = A->solves + by_orbits->solves, r->iterations = A->iterations + by_orbits->iterations;
        r->factorizations = A->factorizations + by_orbits->factorizations, r->assemblies = F.assemblies;
        r->passes = all_passes(&F);
        snprintf(reason, RG_REASON, "%s", F.reason);
        if (out && folded) read_off(&F, settings, best, r, out);
    }
    rg_relax_free(&F);
    return status;
}

/* Again, for its time. */
static rg_status time_it(const rg_attempt *best, const rg_settings *s, rg_watch *watch, rg_run *r)
{
    double all = r->seconds;
    rg_status status = RG_OK;
    for (int n = 1; n < REPEATS && status == RG_OK && all < PATIENCE && !watch->cancelled; n++) {
        rg_run again;
        char reason[RG_REASON];
        status = fold(best, s, r->way.step, watch, &again, NULL, reason);
        all += again.seconds;
        if (status == RG_OK) r->seconds = fmin(r->seconds, again.seconds);
    }
    return status;
}

static double order_of(const rg_relaxed *R, const double *change)
{
    double step[RG_RELAXED_POINTS], y[RG_RELAXED_POINTS];
    int32_t n = 0;
    for (int32_t k = 1; k < R->points; k++) {
        if (!(change[k] > 0 && change[k] <= SAME_WAY)) continue;
        step[n] = R->run[k].way.step;
        y[n++] = change[k];
    }
    return rg_slope_of(n, step, y);
}

/* What is left to go, if changes go on to fall as they did: a geometric series. */
static double left(double change, double order) { return order > 0 ? change / (pow(2, order) - 1) : INFINITY; }

static double off_at(const rg_frames *a, const rg_frames *b, int percent)
{
    const int32_t k = (int32_t)lround(percent * (a->count - 1) / 100.0);
    const size_t at = (size_t)k * (size_t)a->N;
    const rg_frames one = {a->N, 1, 1, a->rho + at}, other = {b->N, 1, 1, b->rho + at};
    return rg_frames_distance(&one, &other);
}

static void compare(rg_relaxed *R, const track *of, double size)
{
    const int32_t last = R->points - 1;
    for (int32_t k = 0; k <= last; k++) {
        rg_run *r = &R->run[k];
        R->change[k] = R->pattern_change[k] = NAN;
        if (r->outcome != RG_FOLDED) continue;
        if (k > 0 && R->run[k - 1].outcome == RG_FOLDED) {
            R->change[k] = rg_frames_distance(&of[k].rho, &of[k - 1].rho);
            R->pattern_change[k] = rg_frames_distance(&of[k].pattern, &of[k - 1].pattern) / size;
        }
        if (k == last) continue;
        r->error = rg_frames_distance(&of[k].rho, &of[last].rho);
        r->pattern_error = rg_frames_distance(&of[k].pattern, &of[last].pattern) / size;
    }
    R->order = order_of(R, R->change);
    R->pattern_order = order_of(R, R->pattern_change);
    R->error = left(R->change[last], R->order);
    R->pattern_error = left(R->pattern_change[last], R->pattern_order);
    for (int j = 0; j < RG_RELAXED_PERCENTS; j++) {
        R->off[j] = off_at(&of[RG_RELAXED_DEFAULT].rho, &of[last].rho, rg_relaxed_percent[j]);
        R->pattern_off[j] = off_at(&of[RG_RELAXED_DEFAULT].pattern, &of[last].pattern, rg_relaxed_percent[j]) / size;
    }
}

/* By steps halved until one stops, for lack of steps or otherwise, or takes too long. */
static rg_status halve(rg_relaxed *R, const rg_settings *s, rg_watch *watch)
{
    const rg_mesh *m = &R->best.mesh;
    track of[RG_RELAXED_POINTS];
    double step = 2 * s->step;
    rg_status status = RG_OK;
    memset(of, 0, sizeof of);
    for (int32_t k = 0; k < RG_RELAXED_POINTS && status == RG_OK && !watch->cancelled; k++, step /= 2) {
        rg_run *r = &R->run[k];
        char reason[RG_REASON];
        status = rg_frames_init(&of[k].rho, &R->mem, m->N, s->frames);
        if (status == RG_OK) status = rg_frames_init(&of[k].pattern, &R->mem, 2 * m->nv, s->frames);
        if (status == RG_OK) status = fold(&R->best, s, step, watch, r, &of[k], reason);
        if (status == RG_OK && k > RG_RELAXED_DEFAULT && r->outcome != RG_FOLDED) {
            R->finer_stops = 1;
            snprintf(R->reason, sizeof R->reason, "%s", reason);
            break;
        }
        const double seconds = r->seconds;
        if (status == RG_OK) status = time_it(&R->best, s, watch, r);
        R->points = k + 1;
        if (seconds > LONGEST) break;
    }
    const int had = status == RG_OK && !watch->cancelled && R->points > RG_RELAXED_DEFAULT;
    R->folds = had && R->run[RG_RELAXED_DEFAULT].outcome == RG_FOLDED;
    if (R->folds) compare(R, of, m->size);
    for (int32_t k = 0; k < RG_RELAXED_POINTS; k++) {
        RG_MEM_FREE(&R->mem, of[k].rho.rho, of[k].pattern.rho);
    }
    return status;
}

rg_status rg_relaxed_measure(rg_relaxed *R, const rg_mesh *drawn, const rg_settings *s, rg_watch *watch, rg_diag *why)
{
    rg_search q;
    const rg_problem problem = {drawn, NULL, NULL, 1, 0};
    memset(R, 0, sizeof *R);
    R->mem = rg_mem_default(s->memory);
    rg_status status = rg_search_run(&q, &problem, s, watch, why);
    if (status != RG_OK) return status;
    R->best = q.best;
    snprintf(R->strategy, sizeof R->strategy, "%s", q.strategy);
    if (R->best.relax && rg_search_is_folded(&R->best) && !watch->cancelled) status = halve(R, s, watch);
    if (status != RG_OK) rg_relaxed_free(R);
    return status;
}

void rg_relaxed_free(rg_relaxed *R)
{
    rg_attempt_free(&R->best);
    memset(R, 0, sizeof *R);
}
