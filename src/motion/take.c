#include "motion/take.h"
#include "base/clock.h"
#include "base/status.h"
#include "motion/diagnose.h"

#include <stdio.h>
#include <string.h>

/* Beyond half a turn by more than that, facets at a crease have passed through each other. */
static const double MOST_OVER = RG_DEG;
/* A crease that did less than this part of its way has not left flat. */
static const double LEFT_FLAT = 1e-6;
/* What was asked for is there within 1 %. */
static const double OFF_THE_MEAN = 0.01;

void rg_take_free(rg_take *t)
{
    if (!t->mem.resize) return;
    rg_mesh_free(&t->mesh);
    void *block[] = {t->target, t->from, t->rho, t->flat, t->vertex, t->crease};
    for (int i = 0; i < 6; i++) rg_mem_free(&t->mem, block[i]);
    memset(t, 0, sizeof *t);
}

static rg_status make_room(rg_take *t, const rg_mesh *m, int32_t frames, int moves)
{
    const size_t N = (size_t)m->N, nv = (size_t)m->nv, room = (size_t)frames + 1;
    t->target = rg_mem_array(&t->mem, N, sizeof *t->target);
    t->from = rg_mem_array(&t->mem, N, sizeof *t->from);
    t->rho = rg_mem_array(&t->mem, room * N, sizeof *t->rho);
    t->vertex = rg_mem_array(&t->mem, (size_t)m->M, sizeof *t->vertex);
    t->crease = rg_mem_array(&t->mem, N, sizeof *t->crease);
    if (moves) t->flat = rg_mem_array(&t->mem, room * nv, sizeof *t->flat);
    return t->target && t->from && t->rho && t->vertex && t->crease && (t->flat || !moves) ? RG_OK : RG_ENOMEM;
}

/* Mean of what was done of each crease's way, none counted for more than all of it or less than nothing. */
static double score(const rg_take *t)
{
    const double *rho = t->rho + (size_t)(t->count - 1) * (size_t)t->mesh.N;
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < t->mesh.N; i++) {
        const double way = t->target[i] - t->from[i];
        if (isnan(way) || way == 0) continue;
        sum += fmin(1, fmax(0, (rho[i] - t->from[i]) / way));
        n++;
    }
    return n ? sum / n : 1;
}

/* The most that a crease of frame k is beyond half a turn. */
static double beyond(const rg_take *t, int32_t k)
{
    double most = 0;
    for (int32_t i = 0; i < t->mesh.N; i++)
        most = fmax(most, fabs(t->rho[(size_t)k * (size_t)t->mesh.N + (size_t)i]) - RG_PI);
    return most;
}

static double overfold(const rg_take *t)
{
    double most = 0;
    for (int32_t k = 0; k < t->count; k++) most = fmax(most, beyond(t, k));
    return most;
}

/* Facets that pass through each other at a crease are no motion: it stops before that, wherever it would have come out. */
static void cut_back(rg_take *t)
{
    int32_t good = 0;
    while (good < t->count && beyond(t, good) <= MOST_OVER) good++;
    if (good == t->count) return;
    t->count = good > 0 ? good : 1;
    if (t->outcome == RG_FOLDED) snprintf(t->reason, sizeof t->reason, "creases go past half a turn on the way");
    else {
        const size_t used = strlen(t->reason);
        snprintf(t->reason + used, sizeof t->reason - used, "; from there on creases go past half a turn");
    }
    t->outcome = RG_STOPPED;
}

/* Short of the whole way, a mean is what is asked for: is it one of creases that are all on their way? Those on the wrong
 * side of flat count in it by what they are, and may make more of it than was asked for. */
static void judge(rg_take *t)
{
    const double to = fabs(t->to);
    const double *rho = t->rho + (size_t)(t->count - 1) * (size_t)t->mesh.N;
    double mean = 0;
    int32_t driven = 0;
    if (t->outcome != RG_FOLDED || to == 0 || to == 1) return;
    for (int32_t i = 0; i < t->mesh.N; i++) {
        const double way = t->target[i] - t->from[i], part = (rho[i] - t->from[i]) / way;
        if (isnan(way) || way == 0) continue;
        t->strays += !(part > LEFT_FLAT);
        mean += fabs(part);
        driven++;
    }
    if (driven == 0) return;
    const int as_asked = fabs(mean / driven - to) <= OFF_THE_MEAN;
    t->outcome = as_asked ? RG_FOLDED : RG_STOPPED;
    snprintf(t->reason, sizeof t->reason, "as far as was asked for%s", as_asked ? "" : ", but with creases on the wrong side of flat");
}

static double moved(const rg_take *t)
{
    double most = 0;
    for (int32_t k = 0; t->flat && k < t->count; k++)
        for (int32_t v = 0; v < t->mesh.nv; v++)
            most = fmax(most, rg_vec2_length(rg_vec2_sub(t->flat[(size_t)k * (size_t)t->mesh.nv + (size_t)v], t->mesh.X[v])));
    return most;
}

static void keep(rg_take *t, const double *rho, const rg_vec2 *X)
{
    memcpy(t->rho + (size_t)t->count * (size_t)t->mesh.N, rho, (size_t)t->mesh.N * sizeof *rho);
    if (t->flat) memcpy(t->flat + (size_t)t->count * (size_t)t->mesh.nv, X, (size_t)t->mesh.nv * sizeof *X);
    t->count++;
}

static int is_cancelled(rg_watch *w, double done)
{
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, fmin(1, fmax(0, done))) != 0;
    return w->cancelled;
}

rg_status rg_take_straight(rg_take *t, rg_mesh *m, const rg_settings *settings, rg_watch *watch, rg_diag *why)
{
    const double begun = rg_seconds();
    rg_fold *f = NULL;
    rg_step_info info = {0};
    memset(t, 0, sizeof *t);
    t->mem = rg_mem_default(settings->memory);
    t->to = settings->to;
    rg_status s = rg_fold_from_mesh(m, settings, &f, why);
    if (s != RG_OK) return s;
    s = make_room(t, &f->mesh, settings->frames, 0);
    double kept = -1;
    while (s == RG_OK && info.outcome == RG_RUNNING) {
        s = rg_fold_step(f, &info);
        if (s == RG_OK && info.frame >= 0) {
            memcpy(t->rho + (size_t)t->count++ * (size_t)f->mesh.N, f->rho, (size_t)f->mesh.N * sizeof *f->rho);
            kept = f->s;
        }
        if (is_cancelled(watch, f->s_end > 0 ? info.progress / f->s_end : 1)) break;
    }
    if (s == RG_OK) {
        memcpy(t->target, f->drive.target, (size_t)f->mesh.N * sizeof *t->target);
        for (int32_t i = f->limit.first_added; i < f->mesh.N; i++) t->target[i] = NAN;
        t->outcome = watch->cancelled ? RG_STOPPED : info.outcome;
        snprintf(t->reason, sizeof t->reason, "%.190s", watch->cancelled ? "interrupted" : f->reason);
        if (t->outcome == RG_STOPPED && f->mesh.N > 0)
            s = rg_diagnose_blocking(f, t->vertex, &t->vertices, t->crease, &t->creases);
        if (f->s != kept) memcpy(t->rho + (size_t)t->count++ * (size_t)f->mesh.N, f->rho, (size_t)f->mesh.N * sizeof *f->rho);
        static const char *const methods[] = {"auto", "euler", "newton", "heun", "rk4", "adaptive"};
        static const char *const solvers[] = {"auto", "cg", "cholesky", "svd"};
        t->method = methods[f->settings.method];
        t->solver = solvers[rg_fold_solver(f)];
        t->cost = rg_fold_cost(f);
        t->mesh = f->mesh;
        memset(&f->mesh, 0, sizeof f->mesh);
        cut_back(t);
        t->score = score(t);
        t->overfold = overfold(t);
        judge(t);
    }
    rg_fold_destroy(f);
    if (s != RG_OK) {
        rg_take_free(t);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    t->cost.seconds = rg_seconds() - begun;
    return RG_OK;
}

/* The frames that the last step went past: the first of them is due at progress `first`. frame: the next one due. */
static void keep_passed(rg_take *t, rg_flow *F, double first, int32_t frames, int32_t *frame)
{
    for (; *frame < frames; ++*frame) {
        const double due = first + (F->s_end - first) * *frame / (frames - 1);
        if (!(F->s >= due) && !(F->landed && *frame < frames)) break;
        if (!rg_flow_at(F, fmin(due, F->s))) break;
        keep(t, F->trial, F->J.X);
    }
}

rg_status rg_take_flow(rg_take *t, rg_mesh *m, const rg_settings *settings, const rg_flow_law *law, const double *from,
                       const double *target, const rg_symmetry *G, double budget, rg_watch *watch, rg_diag *why)
{
    const double begun = rg_seconds();
    /* From folded, the way is the whole of it, of which the last part is asked for. */
    const double first = from ? 1 - fabs(settings->to) : 0;
    const int32_t given = first > 0 ? 0 : 1;
    rg_settings mine = *settings;
    rg_flow F;
    rg_symmetry on = {0};
    int32_t frame = given, attempt = 0;
    if (from) mine.to = copysign(1, settings->to);
    memset(t, 0, sizeof *t);
    t->mem = rg_mem_default(settings->memory);
    t->to = settings->to;
    t->mesh = *m;
    memset(m, 0, sizeof *m);
    t->law = *law;
    rg_status s = make_room(t, &t->mesh, settings->frames, law->gain > 0 || law->give > 0);
    if (s == RG_OK && G && G->order > 1) s = rg_symmetry_on(&on, G, &t->mesh);
    if (s == RG_OK) s = rg_flow_init(&F, &t->mesh, &mine, law, from, target);
    if (s != RG_OK) {
        rg_symmetry_free(&on);
        rg_take_free(t);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    F.budget = budget;
    F.symmetry = on.order > 1 ? &on : NULL;
    memcpy(t->target, target, (size_t)F.N * sizeof *target);
    memcpy(t->from, F.from, (size_t)F.N * sizeof *target);
    if (given) keep(t, F.rho, F.J.X);
    while (F.outcome == RG_RUNNING) {
        rg_flow_step(&F);
        if (F.attempt != attempt) {
            attempt = F.attempt;
            frame = t->count = given;
        }
        if (F.proper || F.landed) keep_passed(t, &F, first, settings->frames, &frame);
        if (is_cancelled(watch, F.s_end > 0 ? F.s / F.s_end : 1)) break;
    }
    if (s == RG_OK) {
        t->outcome = watch->cancelled ? RG_STOPPED : F.outcome;
        snprintf(t->reason, sizeof t->reason, "%.190s", watch->cancelled ? "interrupted" : F.reason);
        if (t->outcome == RG_STOPPED || t->count < settings->frames) {
            rg_joint_assemble(&F.J, F.rho, F.u, NULL);
            if (t->count > settings->frames) t->count = settings->frames;
            keep(t, F.rho, F.J.X);
        } else if (F.landed) { /* a step may have gone past the last frame before it landed */
            rg_joint_assemble(&F.J, F.rho, F.u, NULL);
            t->count = settings->frames - 1;
            keep(t, F.rho, F.J.X);
        }
        cut_back(t);
        t->score = score(t);
        t->overfold = overfold(t);
        t->moved = moved(t);
        if (!from) judge(t);
        if (t->outcome == RG_STOPPED) s = rg_diagnose_flow(&F, t->vertex, &t->vertices, t->crease, &t->creases);
        t->work = F.work;
        t->method = "joint";
        t->solver = "cholesky";
        t->cost = (rg_cost){F.steps, F.J.A.solves, F.J.A.iterations, F.J.A.factorizations, F.assemblies, 0};
    }
    rg_flow_free(&F);
    rg_symmetry_free(&on);
    if (s != RG_OK) {
        rg_take_free(t);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    t->cost.seconds = rg_seconds() - begun;
    return RG_OK;
}

rg_status rg_take_read(rg_take *t, rg_mesh *m, const rg_settings *settings, const double *target,
                       void (*read)(void *ctx, double progress, double *rho, rg_vec2 *X), void *ctx, rg_diag *why)
{
    memset(t, 0, sizeof *t);
    t->mem = rg_mem_default(settings->memory);
    t->to = settings->to;
    t->mesh = *m;
    memset(m, 0, sizeof *m);
    const rg_status s = make_room(t, &t->mesh, settings->frames, 1);
    if (s != RG_OK) {
        rg_take_free(t);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    memcpy(t->target, target, (size_t)t->mesh.N * sizeof *target);
    for (; t->count < settings->frames; t->count++)
        read(ctx, fabs(settings->to) * t->count / (settings->frames - 1), t->rho + (size_t)t->count * (size_t)t->mesh.N,
             t->flat + (size_t)t->count * (size_t)t->mesh.nv);
    t->outcome = RG_FOLDED;
    t->score = score(t);
    t->overfold = overfold(t);
    t->moved = moved(t);
    judge(t);
    return RG_OK;
}

static void swap(void *a, void *b, size_t bytes)
{
    unsigned char *x = a, *y = b;
    for (size_t i = 0; i < bytes; i++) {
        const unsigned char was = x[i];
        x[i] = y[i];
        y[i] = was;
    }
}

void rg_take_turn_round(rg_take *t, const double *target)
{
    const size_t N = (size_t)t->mesh.N, nv = (size_t)t->mesh.nv;
    if (t->outcome != RG_FOLDED) {
        t->score = -1;
        return;
    }
    for (size_t i = 0, j = (size_t)t->count - 1; i < j; i++, j--) {
        swap(t->rho + i * N, t->rho + j * N, N * sizeof *t->rho);
        if (t->flat) swap(t->flat + i * nv, t->flat + j * nv, nv * sizeof *t->flat);
    }
    memcpy(t->target, target, N * sizeof *target);
    memset(t->from, 0, N * sizeof *t->from);
    judge(t);
    t->strays = 0; /* what is left behind comes after: this way is known to go on to the end */
}
