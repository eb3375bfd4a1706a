#include "motion/attempt.h"
#include "base/clock.h"
#include "base/status.h"
#include "base/text.h"
#include "fold/chord.h"
#include "fold/tuning.h"
#include "motion/diagnose.h"
#include "motion/forth.h"
#include "motion/rest.h"

#include <stdio.h>
#include <string.h>

/* The largest turn between two frames at a steady pace, against the mean, that is even enough; and how often it is set right. */
static const double UNEVEN = 1.1;
static const int TIMES_SET_RIGHT = 5;

void rg_attempt_free(rg_attempt *t)
{
    if (!t->mem.resize) return;
    if (t->relax) rg_relax_free(t->relax);
    if (t->symmetry) rg_symmetry_free(t->symmetry);
    if (t->trace) rg_trace_free(t->trace);
    rg_mesh_free(&t->mesh);
    RG_MEM_FREE(&t->mem, t->relax, t->trace, t->symmetry, t->target, t->from, t->rho, t->flat, t->due, t->vertex,
                t->crease);
    rg_gaps_free(&t->gaps, &t->mem);
    memset(t, 0, sizeof *t);
}

static rg_status make_room(rg_attempt *t, const rg_mesh *m)
{
    const size_t N = (size_t)m->N;
    return RG_MEM_ARRAYS(&t->mem, RG_ARRAY(t->target, N), RG_ARRAY(t->from, N), RG_ARRAY(t->vertex, (size_t)m->M),
                         RG_ARRAY(t->crease, N));
}

/* ------------------------------------------------------------------------------------- what it came to ---- */

/* The states that the path is made of: nodes of a relaxation, frames of what went straight on. */
static int32_t states(const rg_attempt *t) { return t->relax ? t->relax->nodes : t->count; }

static const double *state(const rg_attempt *t, int32_t k)
{
    return t->relax ? t->relax->node + (size_t)k * (size_t)t->relax->n : t->rho + (size_t)k * (size_t)t->mesh.N;
}

/* The last state in the direction of the motion. */
static const double *last_state(const rg_attempt *t) { return state(t, t->backwards ? 0 : states(t) - 1); }

static double way(const rg_attempt *t, int32_t i)
{
    const double w = t->target[i] - t->from[i];
    return isnan(w) ? 0 : w;
}

static double beyond(const rg_attempt *t, const double *rho)
{
    double most = 0;
    for (int32_t i = 0; i < t->mesh.N; i++) most = fmax(most, fabs(rho[i]) - RG_PI);
    return most;
}

static double displacement(const rg_attempt *t, const double *z)
{
    return t->relax ? rg_freedom_farthest(&t->relax->freedom, z + t->relax->N) : 0;
}

/* Mean of what was done of each crease's way, none counted for more than all of it or less than nothing. */
static double score(const rg_attempt *t, const double *rho)
{
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < t->mesh.N; i++) {
        if (way(t, i) == 0) continue;
        sum += fmin(1, fmax(0, (rho[i] - t->from[i]) / way(t, i)));
        n++;
    }
    return n ? sum / n : 1;
}

/* Facets that pass through each other at a crease are no motion: it stops before that, wherever it would have come out. */
static void cut_back(rg_attempt *t)
{
    int32_t *n = t->relax ? &t->relax->nodes : &t->count, good = 0;
    while (good < *n && beyond(t, state(t, good)) <= MOST_OVER) good++;
    for (int32_t j = 0; !t->relax && j < t->gaps.count && t->gaps.after[j] < good; j++)
        if (!(beyond(t, t->gaps.rho + (size_t)j * (size_t)t->mesh.N) <= MOST_OVER)) good = t->gaps.after[j] + 1;
    if (good == *n) return;
    *n = good > 0 ? good : 1;
    while (!t->relax && t->gaps.count > 0 && t->gaps.after[t->gaps.count - 1] >= *n - 1) t->gaps.count--;
    const size_t used = strlen(t->reason);
    if (t->outcome == RG_FOLDED) rg_text(t->reason, sizeof t->reason, "creases go past half a turn on the way");
    else rg_text(t->reason + used, sizeof t->reason - used, "; from there on creases go past half a turn");
    t->outcome = RG_STOPPED;
}

/* Short of the whole way, a mean is what is asked for. It counts only where no crease is on the wrong side of flat there; one that has
 * not left flat yet may come later, which is known of a path that goes on to the end. */
static void judge(rg_attempt *t, const double *rho)
{
    const double to = fabs(t->to);
    int32_t wrong = 0;
    if (t->outcome != RG_FOLDED || to == 0 || to == 1) return;
    for (int32_t i = 0; i < t->mesh.N; i++) {
        if (way(t, i) == 0) continue;
        const double part = (rho[i] - t->from[i]) / way(t, i);
        t->strays += !t->backwards && !(part > LEFT_FLAT);
        wrong += !(part >= -LEFT_FLAT);
    }
    if (wrong) t->outcome = RG_STOPPED;
    rg_text(t->reason, sizeof t->reason, "as far as was asked for%s", wrong ? ", but with creases on the wrong side of flat" : "");
}

/* Everything that attempts are compared by. */
static void measure(rg_attempt *t)
{
    cut_back(t);
    t->score = score(t, last_state(t));
    t->moved_at_end = displacement(t, last_state(t));
    for (int32_t k = 0; k < states(t); k++) {
        const double *z = state(t, k);
        t->overfold = fmax(t->overfold, beyond(t, z));
        t->moved = fmax(t->moved, displacement(t, z));
        for (int32_t i = 0; i < t->mesh.N; i++)
            if (way(t, i) != 0 && (z[i] - t->from[i]) / way(t, i) < 0) t->wrong = fmax(t->wrong, fabs(z[i] - t->from[i]));
    }
}

double rg_attempt_largest_angle(const rg_attempt *t, int32_t i)
{
    double most = 0;
    for (int32_t k = 0; k < states(t); k++) most = fmax(most, fabs(state(t, k)[i]));
    return most;
}

/* ------------------------------------------------------------------------------------------ straight on ---- */

static rg_status run_forth(rg_attempt *t, rg_straight *f, int32_t parts, rg_trace *trace, rg_watch *watch)
{
    rg_gaps_free(&t->gaps, &t->mem);
    const rg_status s = rg_forth_run(f, &t->mem, parts, watch, t->rho, &t->count, &t->gaps, &t->outcome, t->due, trace);
    if (watch->cancelled) t->outcome = RG_STOPPED;
    return s;
}

/* How far such a run goes before it comes to rest; s_rest stays as it is where it does not. */
static rg_status find_rest(const rg_mesh *drawn, const rg_settings *settings, rg_watch *watch, double *s_rest)
{
    const rg_memory mem = rg_mem_default(settings->memory);
    rg_straight *f = NULL;
    rg_mesh m;
    rg_step_info info = {0};
    double *rho = rg_mem_array(&mem, (size_t)drawn->N, sizeof *rho), *t = rg_mem_array(&mem, (size_t)drawn->N, sizeof *t);
    rg_status s = rho && t ? rg_mesh_copy(drawn, &m) : RG_ENOMEM;
    if (s == RG_OK) s = rg_straight_from_mesh(&m, settings, &f, NULL);
    for (int found = 0; s == RG_OK && !found && info.outcome == RG_RUNNING; found = rg_rest_find(f, rho, t, s_rest)) {
        s = rg_straight_step(f, &info);
        if (rg_watch_tell(watch, info.progress)) break;
    }
    rg_straight_destroy(f);
    RG_MEM_FREE(&mem, rho, t);
    return s;
}

/* Room for the path of f. */
static rg_status keep_path(rg_attempt *t, const rg_straight *f, int32_t frames)
{
    t->due = rg_mem_array(&t->mem, (size_t)frames + 1, sizeof *t->due);
    t->trace = rg_mem_array(&t->mem, 1, sizeof *t->trace);
    return t->due && t->trace ? rg_trace_init(t->trace, &t->mem, f) : RG_ENOMEM;
}

rg_status rg_attempt_straight(rg_attempt *t, rg_mesh *m, const rg_settings *settings, int32_t most_steps, int keeps, rg_watch *watch,
                              rg_diag *why)
{
    const double begun = rg_seconds();
    rg_settings mine = *settings;
    rg_straight *f = NULL;
    double s_rest = NAN;
    memset(t, 0, sizeof *t);
    t->mem = rg_mem_default(settings->memory);
    rg_status s = settings->rest && rg_rest_is_open(m) ? find_rest(m, settings, watch, &s_rest) : RG_OK;
    const int rests = s_rest < fabs(settings->to);
    if (rests) mine.to = copysign(s_rest, settings->to);
    t->to = mine.to;
    const int32_t parts = rg_forth_parts(&mine);
    mine.frames = (mine.frames - 1) * parts + 1;
    if (s == RG_OK) s = rg_straight_from_mesh(m, &mine, &f, why);
    else rg_mesh_free(m);
    if (s != RG_OK) return s;
    s = make_room(t, &f->mesh);
    t->rho = rg_mem_array(&t->mem, ((size_t)settings->frames + 1) * (size_t)f->mesh.N, sizeof *t->rho);
    if (!t->rho) s = RG_ENOMEM;
    if (s == RG_OK) rg_straight_set_most_steps(f, most_steps);
    if (s == RG_OK && keeps) s = keep_path(t, f, settings->frames);
    if (s == RG_OK) s = run_forth(t, f, parts, t->trace, watch);
    if (s == RG_OK) {
        memcpy(t->target, f->drive.target, (size_t)f->mesh.N * sizeof *t->target);
        for (int32_t i = f->limit.first_added; i < f->mesh.N; i++) t->target[i] = NAN;
        rg_text(t->reason, sizeof t->reason, "%.190s", watch->cancelled ? "interrupted" : f->reason);
        if (t->outcome == RG_STOPPED && f->mesh.N > 0)
            s = rg_diagnose_blocking(f, t->vertex, &t->vertices, t->crease, &t->creases);
        static const char *const methods[] = {"auto", "euler", "newton", "heun", "rk4", "adaptive"};
        static const char *const solvers[] = {"auto", "cg", "cholesky", "svd"};
        t->method = methods[f->settings.method];
        t->solver = solvers[rg_straight_solver(f)];
        t->cost = rg_straight_cost(f);
        t->mesh = f->mesh;
        memset(&f->mesh, 0, sizeof f->mesh);
        measure(t);
        judge(t, last_state(t));
        if (rests && t->outcome == RG_FOLDED) {
            t->outcome = RG_RESTS;
            rg_text(t->reason, sizeof t->reason, "undriven creases leave its end open: it rests at %.0f %%", 100 * s_rest);
        }
    }
    rg_straight_destroy(f);
    if (s != RG_OK) {
        rg_attempt_free(t);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    t->cost.seconds = rg_seconds() - begun;
    return RG_OK;
}

/* -------------------------------------------------------------------------------------------- relaxed ---- */

static rg_status make_relaxed(rg_attempt *t, const rg_settings *settings, const rg_relaxation *how)
{
    rg_settings mine = *settings;
    double *end = rg_mem_array(&t->mem, (size_t)t->mesh.N, sizeof *end);
    t->relax = rg_mem_array(&t->mem, 1, sizeof *t->relax);
    rg_status s = end && t->relax ? RG_OK : RG_ENOMEM;
    if (s == RG_OK && t->backwards) {
        mine.to = copysign(1, settings->to); /* from folded, the way is the whole of it, of which a part is read off */
        for (int32_t i = 0; i < t->mesh.N; i++) end[i] = isnan(t->target[i]) ? NAN : t->from[i];
        double *begin = rg_mem_array(&t->mem, (size_t)t->mesh.N, sizeof *begin);
        for (int32_t i = 0; begin && i < t->mesh.N; i++) begin[i] = isnan(t->target[i]) ? 0 : t->target[i];
        s = begin ? rg_relax_init(t->relax, &t->mesh, &mine, how, begin, end) : RG_ENOMEM;
        rg_mem_free(&t->mem, begin);
    } else if (s == RG_OK) {
        s = rg_relax_init(t->relax, &t->mesh, &mine, how, t->from, t->target);
    }
    rg_mem_free(&t->mem, end);
    return s;
}

/* The relaxation to its end, or to where it waits; and what comes of it. */
static rg_status run_relaxed(rg_attempt *t, rg_watch *watch)
{
    rg_relax *F = t->relax;
    const double begun = rg_seconds();
    while (F->outcome == RG_RUNNING) {
        rg_relax_step(F);
        if (rg_watch_tell(watch, F->s_end > 0 ? F->s / F->s_end : 1)) break;
    }
    t->outcome = watch->cancelled || (t->backwards && !F->landed) ? RG_STOPPED : F->outcome;
    rg_text(t->reason, sizeof t->reason, "%.190s", watch->cancelled ? "interrupted" : F->reason);
    if (t->outcome == RG_STOPPED) {
        const rg_status s = rg_diagnose_relaxed(F, t->vertex, &t->vertices, t->crease, &t->creases);
        if (s != RG_OK) return s;
    }
    measure(t);
    /* Backwards, a way that does not lead to its beginning is no motion. */
    if (t->backwards && t->outcome != RG_FOLDED) t->score = -1;
    if (t->is_from_flat) {
        const double to = t->backwards ? 1 - fabs(t->to) : fabs(t->to);
        double *z = rg_mem_array(&t->mem, (size_t)F->n, sizeof *z);
        if (!z) return RG_ENOMEM;
        rg_chord_at(F, fmin(to, F->node_s[F->nodes - 1]), z);
        judge(t, z);
        rg_mem_free(&t->mem, z);
    }
    t->work = F->work;
    const rg_least *A = &F->J.A, *by_orbits = &F->orbits.A;
    t->cost = (rg_cost){F->steps, A->solves + by_orbits->solves, A->iterations + by_orbits->iterations,
                        A->factorizations + by_orbits->factorizations, F->assemblies, t->cost.seconds + rg_seconds() - begun};
    return RG_OK;
}

rg_status rg_attempt_go_on(rg_attempt *t, double work, rg_watch *watch, rg_diag *why)
{
    rg_relax_go_on(t->relax, work);
    const rg_status s = run_relaxed(t, watch);
    return s == RG_OK ? s : rg_fail(s, why, 0, "%s", rg_status_text(s));
}

rg_status rg_attempt_relaxed(rg_attempt *t, rg_mesh *m, const rg_settings *settings, const rg_relaxation *how, const double *from,
                             const double *target, const rg_symmetry *G, int backwards, double budget, rg_watch *watch, rg_diag *why)
{
    const double begun = rg_seconds();
    memset(t, 0, sizeof *t);
    t->mem = rg_mem_default(settings->memory);
    t->to = settings->to;
    t->backwards = backwards;
    t->is_from_flat = !from;
    t->method = "relaxed";
    t->solver = "cholesky";
    t->mesh = *m;
    memset(m, 0, sizeof *m);
    rg_status s = make_room(t, &t->mesh);
    if (s == RG_OK) {
        memcpy(t->target, target, (size_t)t->mesh.N * sizeof *target);
        if (from) memcpy(t->from, from, (size_t)t->mesh.N * sizeof *from);
        s = make_relaxed(t, settings, how);
    }
    if (s == RG_OK && G && G->order > 1) {
        t->symmetry = rg_mem_array(&t->mem, 1, sizeof *t->symmetry);
        s = t->symmetry ? rg_symmetry_on(t->symmetry, G, &t->mesh) : RG_ENOMEM;
        if (s == RG_OK) s = rg_relax_keep(t->relax, t->symmetry);
    }
    if (s == RG_OK) {
        t->relax->budget = budget;
        t->cost.seconds = rg_seconds() - begun;
        s = run_relaxed(t, watch);
    }
    if (s == RG_OK) return s;
    rg_attempt_free(t);
    return rg_fail(s, why, 0, "%s", rg_status_text(s));
}

/* -------------------------------------------------------------------------------------------- frames ---- */

/* Progress at frames that are even in the largest angle that a crease turns, from s0 to s1, both ways round. */
static void pace_steadily(const rg_attempt *t, double s0, double s1, int32_t frames, double *due)
{
    const rg_relax *F = t->relax;
    const double low = fmin(s0, s1), high = fmax(s0, s1);
    double all = 0, done = 0;
    for (int pass = 0, next = 1; pass < 2; pass++)
        for (int32_t k = 1; k < F->nodes; k++) {
            const double a = fmax(low, F->node_s[k - 1]), b = fmin(high, F->node_s[k]), whole = F->node_s[k] - F->node_s[k - 1];
            double turned = 0;
            if (!(b > a)) continue;
            for (int32_t i = 0; i < F->N; i++) turned = fmax(turned, fabs(state(t, k)[i] - state(t, k - 1)[i]));
            turned *= (b - a) / whole;
            if (pass == 0) {
                all += turned;
                continue;
            }
            for (; next < frames - 1 && done + turned >= all * next / (frames - 1); next++)
                due[next] = a + (b - a) * (turned > 0 ? (all * next / (frames - 1) - done) / turned : 1);
            done += turned;
        }
    due[0] = low;
    due[frames - 1] = high;
    for (int32_t i = 0, j = frames - 1; s0 > s1 && i < j; i++, j--) {
        const double d = due[i];
        due[i] = due[j];
        due[j] = d;
    }
}

/* What reads states off a relaxed path; z[n]: scratch. */
typedef struct chord_reader { rg_attempt *t; double *z; } chord_reader;

static int read_chord(void *ctx, double progress, double *rho, rg_vec2 *X)
{
    const chord_reader *c = ctx;
    rg_relax *F = c->t->relax;
    rg_chord_at(F, progress, c->z);
    memcpy(rho, c->z, (size_t)F->N * sizeof *rho);
    if (c->t->flat) rg_freedom_move(&F->freedom, c->z + F->N, X);
    return 1;
}

static rg_status read_off(rg_attempt *t, const double *due)
{
    const size_t N = (size_t)t->mesh.N, nv = (size_t)t->mesh.nv;
    chord_reader c = {t, rg_mem_array(&t->mem, (size_t)t->relax->n, sizeof *c.z)};
    for (size_t k = 0; c.z && k < (size_t)t->count; k++) read_chord(&c, due[k], t->rho + k * N, t->flat ? t->flat + k * nv : NULL);
    rg_mem_free(&t->mem, c.z);
    return c.z ? RG_OK : RG_ENOMEM;
}

/* Between frames that were read off. */
static rg_status fill_gaps(rg_attempt *t, const double *due, rg_path_reader *read, void *ctx)
{
    rg_gap_filler q;
    rg_status s = rg_gap_filler_init(&q, &t->mem, t->mesh.N, t->mesh.nv, t->flat != NULL, read, ctx);
    if (s == RG_OK) s = rg_gaps_fill(&q, &t->gaps, t->rho, due, t->count);
    rg_gap_filler_free(&q);
    return s;
}

static rg_status fill_chords(rg_attempt *t)
{
    chord_reader c = {t, rg_mem_array(&t->mem, (size_t)t->relax->n, sizeof *c.z)};
    const rg_status s = c.z ? fill_gaps(t, t->due, read_chord, &c) : RG_ENOMEM;
    rg_mem_free(&t->mem, c.z);
    return s;
}

/* Frames read off tell how fast the path really goes between its nodes: due[t->count] is set right by it. Non-zero: it was off by more
 * than UNEVEN. */
static int set_right(const rg_attempt *t, double *due, double *was, double *sum)
{
    const size_t N = (size_t)t->mesh.N;
    const int32_t last = t->count - 1;
    double most = 0;
    sum[0] = 0;
    for (int32_t k = 1; k <= last; k++) {
        double turned = 0;
        for (size_t i = 0; i < N; i++) turned = fmax(turned, fabs(t->rho[(size_t)k * N + i] - t->rho[(size_t)(k - 1) * N + i]));
        most = fmax(most, turned);
        sum[k] = sum[k - 1] + turned;
    }
    if (!(most * last > UNEVEN * sum[last])) return 0;
    memcpy(was, due, (size_t)t->count * sizeof *due);
    for (int32_t j = 1, k = 1; j < last; j++) {
        const double want = sum[last] * j / last;
        while (k < last && sum[k] < want) k++;
        due[j] = was[k - 1] + (was[k] - was[k - 1]) * (sum[k] > sum[k - 1] ? (want - sum[k - 1]) / (sum[k] - sum[k - 1]) : 1);
    }
    return 1;
}

static rg_status read_steadily_off(rg_attempt *t, double *due)
{
    double *was = rg_mem_array(&t->mem, (size_t)t->count, sizeof *was), *sum = rg_mem_array(&t->mem, (size_t)t->count, sizeof *sum);
    rg_status s = was && sum ? read_off(t, due) : RG_ENOMEM;
    for (int n = 0; s == RG_OK && n < TIMES_SET_RIGHT && set_right(t, due, was, sum); n++) s = read_off(t, due);
    RG_MEM_FREE(&t->mem, was, sum);
    return s;
}

/* Progress at frames that are even in the largest angle that a crease turns, as `count` states at even progress 0 ... to tell it.
 * due[frames]: out. sum[count]: scratch. */
static void pace_by_states(const double *rho, size_t N, int32_t count, double to, int32_t frames, double *sum, double *due)
{
    for (int32_t k = 1; k < count; k++) {
        double turned = 0;
        for (size_t i = 0; i < N; i++) turned = fmax(turned, fabs(rho[(size_t)k * N + i] - rho[(size_t)(k - 1) * N + i]));
        sum[k] = sum[k - 1] + turned;
    }
    for (int32_t j = 1, k = 1; j < frames; j++) {
        const double want = sum[count - 1] * j / (frames - 1);
        while (k < count - 1 && sum[k] < want) k++;
        const double part = sum[k] > sum[k - 1] ? (want - sum[k - 1]) / (sum[k] - sum[k - 1]) : 1;
        due[j] = to * (k - 1 + fmin(1, part)) / (count - 1);
    }
    due[frames - 1] = to;
}

/* What went straight on knows its frames only. They tell how fast it goes; with frames that are due accordingly it goes the same
 * way again. */
static rg_status read_steadily(rg_attempt *t, const rg_settings *settings)
{
    rg_settings mine = *settings;
    const int32_t frames = settings->frames, parts = rg_forth_parts(settings);
    double *sum = rg_mem_array(&t->mem, (size_t)t->count, sizeof *sum);
    double *due = rg_mem_array(&t->mem, (size_t)(frames - 1) * (size_t)parts + 1, sizeof *due);
    rg_mesh copy = {0};
    rg_straight *f = NULL;
    rg_watch nobody = {0};
    const rg_outcome outcome = t->outcome;
    mine.to = t->to;
    mine.frames = (frames - 1) * parts + 1;
    rg_status s = sum && due ? rg_mesh_copy(&t->mesh, &copy) : RG_ENOMEM;
    if (s == RG_OK) {
        pace_by_states(t->rho, (size_t)t->mesh.N, t->count, fabs(t->to), frames, sum, due);
        for (int32_t k = frames - 1; k > 0; k--) /* from the last on, none is in another one's place */
            for (int32_t i = parts; i > 0; i--) due[(k - 1) * parts + i] = due[k - 1] + (due[k] - due[k - 1]) * ((double)i / parts);
        s = rg_straight_from_mesh(&copy, &mine, &f, NULL);
    }
    if (s == RG_OK) rg_straight_set_due(f, due);
    if (s == RG_OK) s = run_forth(t, f, parts, NULL, &nobody);
    t->outcome = outcome;
    rg_straight_destroy(f);
    RG_MEM_FREE(&t->mem, sum, due);
    return s;
}

rg_status rg_attempt_from_path(rg_attempt *t, rg_mesh *m, const rg_settings *settings, const double *target,
                               rg_path_reader *read, void *ctx, rg_diag *why)
{
    const int32_t frames = settings->frames;
    const double to = fabs(settings->to);
    memset(t, 0, sizeof *t);
    t->mem = rg_mem_default(settings->memory);
    t->to = settings->to;
    t->mesh = *m;
    memset(m, 0, sizeof *m);
    const size_t N = (size_t)t->mesh.N, nv = (size_t)t->mesh.nv;
    rg_status s = make_room(t, &t->mesh);
    double *due = rg_mem_array(&t->mem, (size_t)frames, sizeof *due), *was = rg_mem_array(&t->mem, (size_t)frames, sizeof *was);
    double *sum = rg_mem_array(&t->mem, (size_t)frames, sizeof *sum);
    t->rho = rg_mem_array(&t->mem, ((size_t)frames + 1) * N, sizeof *t->rho);
    t->flat = rg_mem_array(&t->mem, ((size_t)frames + 1) * nv, sizeof *t->flat);
    if (!due || !was || !sum || !t->rho || !t->flat) s = RG_ENOMEM;
    for (int32_t k = 0; due && k < frames; k++) due[k] = to * ((double)k / (frames - 1));
    for (int more = settings->pace == RG_PACE_STEADY ? TIMES_SET_RIGHT : 0; s == RG_OK; more--) {
        for (t->count = 0; t->count < frames; t->count++)
            read(ctx, due[t->count], t->rho + (size_t)t->count * N, t->flat + (size_t)t->count * nv);
        if (more == 0 || !set_right(t, due, was, sum)) break;
    }
    if (s == RG_OK) s = fill_gaps(t, due, read, ctx);
    RG_MEM_FREE(&t->mem, due, was, sum);
    if (s != RG_OK) {
        rg_attempt_free(t);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    memcpy(t->target, target, N * sizeof *target);
    t->outcome = RG_FOLDED;
    t->is_read = 1;
    measure(t);
    for (int32_t k = 0; k < t->count; k++)
        for (size_t v = 0; v < nv; v++)
            t->moved = fmax(t->moved, rg_vec2_length(rg_vec2_sub(t->flat[(size_t)k * nv + v], t->mesh.X[v])));
    judge(t, last_state(t));
    return RG_OK;
}

void rg_attempt_forget_frames(rg_attempt *t)
{
    if (!t->relax) return;
    RG_MEM_FREE(&t->mem, t->rho, t->flat, t->due);
    t->rho = t->due = NULL, t->flat = NULL, t->count = 0;
    rg_gaps_free(&t->gaps, &t->mem);
}

rg_status rg_attempt_read(rg_attempt *t, const rg_settings *settings)
{
    const rg_relax *F = t->relax;
    const int32_t frames = settings->frames;
    if (t->is_read) return RG_OK;
    if (!F && settings->pace == RG_PACE_STEADY && t->outcome != RG_STOPPED && t->count == frames) return read_steadily(t, settings);
    if (!F || t->rho) return RG_OK;
    const double to = fabs(settings->to), last = F->node_s[F->nodes - 1];
    const double s0 = t->backwards ? 1 : 0, s1 = t->backwards ? 1 - to : t->outcome == RG_FOLDED ? fmin(last, to) : last;
    double *const due = t->due = rg_mem_array(&t->mem, (size_t)frames + 1, sizeof *due);
    t->rho = rg_mem_array(&t->mem, ((size_t)frames + 1) * (size_t)t->mesh.N, sizeof *t->rho);
    if (F->U > 0) t->flat = rg_mem_array(&t->mem, ((size_t)frames + 1) * (size_t)t->mesh.nv, sizeof *t->flat);
    rg_status s = due && t->rho && (t->flat || F->U == 0) ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) {
        /* Stopped short, frames keep the pace that the whole way would have had. */
        for (t->count = 0; t->count < frames; t->count++) {
            const double d = s0 + (t->backwards ? -to : to) * ((double)t->count / (frames - 1));
            if (!t->backwards && t->outcome != RG_FOLDED && !(d < last)) break;
            due[t->count] = fmin(d, last);
        }
        if (t->count < frames) due[t->count++] = s1;
        else if (to == 1) due[t->backwards ? 0 : frames - 1] = last; /* the end itself */
        if (settings->pace == RG_PACE_STEADY && t->count > 1) {
            pace_steadily(t, s0, s1, t->count, due);
            s = read_steadily_off(t, due);
        } else {
            s = read_off(t, due);
        }
    }
    return s == RG_OK ? fill_chords(t) : s;
}
