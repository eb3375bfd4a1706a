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

void rg_attempt_free(rg_attempt *t)
{
    if (!t->mem.resize) return;
    if (t->relax) rg_relax_free(t->relax);
    if (t->symmetry) rg_symmetry_free(t->symmetry);
    if (t->trace) rg_trace_free(t->trace);
    rg_mesh_free(&t->mesh);
    RG_MEM_FREE(&t->mem, t->relax, t->trace, t->symmetry, t->target, t->from, t->largest, t->rho, t->flat, t->due,
                t->vertex, t->crease);
    rg_gaps_free(&t->gaps, &t->mem);
    memset(t, 0, sizeof *t);
}

static rg_status make_room(rg_attempt *t, const rg_mesh *m)
{
    const size_t N = (size_t)m->N;
    return RG_MEM_ARRAYS(&t->mem, RG_ARRAY(t->target, N), RG_ARRAY(t->from, N), RG_ARRAY(t->vertex, (size_t)m->M),
                         RG_ARRAY(t->crease, N));
}

static rg_status fail(rg_attempt *t, rg_status s, rg_diag *why)
{
    rg_attempt_free(t);
    return rg_fail(s, why, 0, "%s", rg_status_text(s));
}

/* ------------------------------------------------------------------------------------- what it came to ---- */

/* The last state in the direction of the motion. */
static const double *last_state(const rg_attempt *t)
{
    return rg_attempt_state(t, t->backwards ? 0 : rg_attempt_states(t) - 1);
}

/* Is crease i driven? *part: out, of its way, what it has done at rho. */
static int has_way(const rg_attempt *t, int32_t i, const double *rho, double *part)
{
    const double way = t->target[i] - t->from[i];
    *part = (rho[i] - t->from[i]) / way;
    return !isnan(way) && way != 0;
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
    double sum = 0, part;
    int32_t n = 0;
    for (int32_t i = 0; i < t->mesh.N; i++) {
        if (!has_way(t, i, rho, &part)) continue;
        sum += fmin(1, fmax(0, part));
        n++;
    }
    return n ? sum / n : 1;
}

/* Facets that pass through each other at a crease are no motion: it stops before that, wherever it would come out. */
static void cut_back(rg_attempt *t)
{
    int32_t *n = t->relax ? &t->relax->nodes : &t->count, good = 0;
    while (good < *n && beyond(t, rg_attempt_state(t, good)) <= MOST_OVER) good++;
    for (int32_t j = 0; !t->relax && j < t->gaps.count && t->gaps.after[j] < good; j++)
        if (!(beyond(t, rg_gaps_angles(&t->gaps, &t->mesh, j)) <= MOST_OVER)) good = t->gaps.after[j] + 1;
    if (good == *n) return;
    *n = good > 0 ? good : 1;
    while (!t->relax && t->gaps.count > 0 && t->gaps.after[t->gaps.count - 1] >= *n - 1) t->gaps.count--;
    const size_t used = strlen(t->reason);
    if (t->outcome == RG_FOLDED) rg_text(t->reason, sizeof t->reason, "creases go past half a turn on the way");
    else rg_text(t->reason + used, sizeof t->reason - used, "; from there on creases go past half a turn");
    t->outcome = RG_STOPPED;
}

/* A crease that was drawn with an angle of 0 has no way of which it could be short: it counts as there within that part
 * of half a turn. */
static void stays_flat(rg_attempt *t, const double *rho)
{
    int32_t bent = 0;
    for (int32_t i = 0; i < t->mesh.N - t->mesh.added; i++)
        bent += t->target[i] == 0 && t->from[i] == 0 && !(fabs(rho[i]) <= ARRIVED * RG_PI);
    if (!bent) return;
    t->outcome = RG_STOPPED;
    rg_text(t->reason, sizeof t->reason, "folded, but for %d crease%s that should end flat", (int)bent,
            bent == 1 ? "" : "s");
}

/* A part of the way is asked for as a mean. It counts only where no crease is on the wrong side of flat there; one that
 * has not left flat yet may come later, as is known of a path that goes on to the end; and where none makes up, by
 * going beyond its own target, for another. */
static void judge(rg_attempt *t, const double *rho)
{
    const double to = fabs(t->to);
    double part;
    int32_t wrong = 0;
    if (t->outcome != RG_FOLDED || to == 0) return;
    if (to == 1) {
        stays_flat(t, rho);
        return;
    }
    for (int32_t i = 0; i < t->mesh.N; i++) {
        if (!has_way(t, i, rho, &part)) continue;
        t->strays += !t->backwards && !(part > LEFT_FLAT);
        wrong += !(part >= -LEFT_FLAT);
    }
    const int ahead = score(t, rho) < to - ARRIVED;
    if (wrong || ahead) t->outcome = RG_STOPPED;
    rg_text(t->reason, sizeof t->reason, "as far as was asked for%s",
            wrong   ? ", but with creases on the wrong side of flat"
            : ahead ? " only with creases beyond their own targets, and others that lag"
                    : "");
}

/* Everything that attempts are compared by. */
static void measure(rg_attempt *t)
{
    cut_back(t);
    t->score = score(t, last_state(t));
    t->moved_at_end = displacement(t, last_state(t));
    if (t->largest) t->overfold = beyond(t, t->largest);
    for (int32_t k = 0; !t->largest && k < rg_attempt_states(t); k++) {
        t->overfold = fmax(t->overfold, beyond(t, rg_attempt_state(t, k)));
        t->moved = fmax(t->moved, displacement(t, rg_attempt_state(t, k)));
    }
}

double rg_attempt_largest_angle(const rg_attempt *t, int32_t i)
{
    double most = t->largest ? t->largest[i] : 0;
    for (int32_t k = 0; !t->largest && k < rg_attempt_states(t); k++)
        most = fmax(most, fabs(rg_attempt_state(t, k)[i]));
    return most;
}

/* ------------------------------------------------------------------------------------------ straight on ---- */

/* How far such a run goes before it comes to rest; s_rest stays as it is where it does not. */
static rg_status find_rest(const rg_mesh *drawn, const rg_settings *settings, rg_watch *watch, double *s_rest)
{
    const rg_memory mem = rg_mem_default(settings->memory);
    rg_straight *f = NULL;
    rg_mesh m;
    rg_step_info info = {0};
    double *rho, *t;
    rg_status s = RG_MEM_ARRAYS(&mem, RG_ARRAY(rho, (size_t)drawn->N), RG_ARRAY(t, (size_t)drawn->N));
    if (s == RG_OK) s = rg_mesh_copy(drawn, &m);
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
    const rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(t->due, (size_t)frames + 1), RG_ARRAY(t->trace, 1));
    return s == RG_OK ? rg_trace_init(t->trace, &t->mem, f) : s;
}

/* What a run came to; the mesh becomes the attempt's. */
static rg_status end_straight(rg_attempt *t, rg_straight *f, int cancelled)
{
    static const char *const methods[] = {"auto", "euler", "newton", "heun", "rk4", "adaptive"};
    static const char *const solvers[] = {"auto", "cg", "cholesky", "svd"};
    rg_status s = RG_OK;
    memcpy(t->target, f->drive.target, (size_t)f->mesh.N * sizeof *t->target);
    for (int32_t i = f->limit.first_added; i < f->mesh.N; i++) t->target[i] = NAN;
    rg_text(t->reason, sizeof t->reason, "%.190s", cancelled ? "interrupted" : f->reason);
    if (t->outcome == RG_STOPPED && f->mesh.N > 0)
        s = rg_diagnose_blocking(f, t->vertex, &t->vertices, t->crease, &t->creases);
    t->method = methods[f->settings.method];
    t->solver = solvers[rg_straight_solver(f)];
    t->cost = rg_straight_cost(f);
    rg_straight_largest(f, t->largest);
    t->mesh = f->mesh;
    memset(&f->mesh, 0, sizeof f->mesh);
    measure(t);
    judge(t, last_state(t));
    return s;
}

rg_status rg_attempt_straight(rg_attempt *t, rg_mesh *m, const rg_settings *settings, int32_t most_steps, int keeps,
                              rg_watch *watch, rg_diag *why)
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
    t->largest = rg_mem_array(&t->mem, (size_t)f->mesh.N, sizeof *t->largest);
    if (!t->rho || !t->largest) s = RG_ENOMEM;
    if (s == RG_OK) rg_straight_set_most_steps(f, most_steps);
    if (s == RG_OK && keeps) s = keep_path(t, f, settings->frames);
    if (s == RG_OK) s = rg_attempt_run(t, f, parts, t->trace, watch);
    if (s == RG_OK) s = end_straight(t, f, watch->cancelled);
    if (s == RG_OK && rests && t->outcome == RG_FOLDED) {
        t->outcome = RG_RESTS;
        rg_text(t->reason, sizeof t->reason, "undriven creases leave its end open: it rests at %.0f %%", 100 * s_rest);
    }
    rg_straight_destroy(f);
    if (s == RG_OK) t->cost.seconds = rg_seconds() - begun;
    return s == RG_OK ? s : fail(t, s, why);
}

/* -------------------------------------------------------------------------------------------- relaxed ---- */

static rg_status make_relaxed(rg_attempt *t, const rg_settings *settings, const rg_relaxation *how)
{
    const int32_t N = t->mesh.N;
    rg_settings mine = *settings;
    double *begin, *end;
    t->relax = rg_mem_array(&t->mem, 1, sizeof *t->relax);
    if (!t->relax) return RG_ENOMEM;
    if (!t->backwards) return rg_relax_init(t->relax, &t->mesh, &mine, how, t->from, t->target);
    mine.to = copysign(1, settings->to); /* from folded, the way is the whole of it, of which a part is read off */
    rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(begin, (size_t)N), RG_ARRAY(end, (size_t)N));
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < N; i++) {
        const int known = !isnan(t->target[i]);
        begin[i] = known ? t->target[i] : 0;
        end[i] = known ? t->from[i] : NAN;
    }
    s = rg_relax_init(t->relax, &t->mesh, &mine, how, begin, end);
    RG_MEM_FREE(&t->mem, begin, end);
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
                        A->factorizations + by_orbits->factorizations, F->assemblies,
                        t->cost.seconds + rg_seconds() - begun};
    return RG_OK;
}

rg_status rg_attempt_go_on(rg_attempt *t, double work, rg_watch *watch, rg_diag *why)
{
    rg_relax_go_on(t->relax, work);
    const rg_status s = run_relaxed(t, watch);
    return s == RG_OK ? s : rg_fail(s, why, 0, "%s", rg_status_text(s));
}

/* Takes *m over. */
static rg_status begin(rg_attempt *t, rg_mesh *m, const rg_settings *settings)
{
    memset(t, 0, sizeof *t);
    t->mem = rg_mem_default(settings->memory);
    t->to = settings->to;
    t->mesh = *m;
    memset(m, 0, sizeof *m);
    return make_room(t, &t->mesh);
}

rg_status rg_attempt_relaxed(rg_attempt *t, rg_mesh *m, const rg_settings *settings, const rg_relaxed_try *how,
                             rg_watch *watch, rg_diag *why)
{
    const double begun = rg_seconds();
    rg_status s = begin(t, m, settings);
    t->backwards = how->backwards;
    t->is_from_flat = !how->from;
    t->method = "relaxed";
    t->solver = "cholesky";
    if (s == RG_OK) {
        memcpy(t->target, how->target, (size_t)t->mesh.N * sizeof *t->target);
        if (how->from) memcpy(t->from, how->from, (size_t)t->mesh.N * sizeof *t->from);
        s = make_relaxed(t, settings, &how->how);
    }
    if (s == RG_OK && how->keeps && how->keeps->order > 1) {
        t->symmetry = rg_mem_array(&t->mem, 1, sizeof *t->symmetry);
        s = t->symmetry ? rg_symmetry_on(t->symmetry, how->keeps, &t->mesh) : RG_ENOMEM;
        if (s == RG_OK) s = rg_relax_keep(t->relax, t->symmetry);
    }
    if (s == RG_OK) {
        t->relax->budget = how->budget;
        t->cost.seconds = rg_seconds() - begun;
        s = run_relaxed(t, watch);
    }
    return s == RG_OK ? s : fail(t, s, why);
}

/* ------------------------------------------------------------------------------------- found some other way ---- */

rg_status rg_attempt_from_path(rg_attempt *t, rg_mesh *m, const rg_settings *settings, const double *target,
                               rg_path_reader *read, void *ctx, rg_diag *why)
{
    rg_status s = begin(t, m, settings);
    if (s == RG_OK) s = rg_attempt_read_path(t, settings, read, ctx);
    if (s != RG_OK) return fail(t, s, why);
    memcpy(t->target, target, (size_t)t->mesh.N * sizeof *target);
    t->outcome = RG_FOLDED;
    t->is_read = 1;
    measure(t);
    for (int32_t k = 0; k < t->count; k++)
        for (int32_t v = 0; v < t->mesh.nv; v++)
            t->moved = fmax(t->moved, rg_vec2_length(rg_vec2_sub(rg_attempt_pattern(t, k)[v], t->mesh.X[v])));
    judge(t, last_state(t));
    return RG_OK;
}
