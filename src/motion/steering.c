/* steering.c -- new aims on the way: rigami.h, rg_fold_drive and others.
 *
 * A leg begins where the fold stood when something was set, with the first step after that, and goes on the pattern
 * that the state has. What was passed before stays in the track. All room is made when something is set: a step asks
 * for none. */
#include "motion/fold.h"

#include <string.h>

/* ------------------------------------------------------------------------------------------------- room ---- */

void rg_track_copy(rg_track *to, const rg_track *from, const rg_mesh *m)
{
    const size_t n = (size_t)from->count, N = (size_t)m->N, nv = (size_t)m->nv;
    memcpy(to->rho, from->rho, n * N * sizeof *to->rho);
    memcpy(to->flat, from->flat, n * nv * sizeof *to->flat);
    memcpy(to->progress, from->progress, n * sizeof *to->progress);
    memcpy(to->closure, from->closure, n * sizeof *to->closure);
}

static rg_status grow(rg_fold *f, int32_t states)
{
    const size_t N = (size_t)rg_fold_mesh(f)->N, nv = (size_t)rg_fold_mesh(f)->nv, n = (size_t)states;
    rg_track *t = &f->track, more = {.count = t->count, .room = states};
    if (states <= t->room) return RG_OK;
    const rg_status s = RG_MEM_ARRAYS(&f->mem, RG_ARRAY(more.rho, n * N), RG_ARRAY(more.flat, n * nv),
                                      RG_ARRAY(more.progress, n), RG_ARRAY(more.closure, n));
    if (s != RG_OK) return s;
    if (t->count > 0) rg_track_copy(&more, t, rg_fold_mesh(f));
    RG_MEM_FREE(&f->mem, t->rho, t->flat, t->progress, t->closure);
    *t = more;
    return RG_OK;
}

static void append(rg_fold *f, const double *rho, const rg_vec2 *flat, double progress, double closure)
{
    const size_t N = (size_t)rg_fold_mesh(f)->N, nv = (size_t)rg_fold_mesh(f)->nv;
    rg_track *t = &f->track;
    memcpy(t->rho + (size_t)t->count * N, rho, N * sizeof *rho);
    memcpy(t->flat + (size_t)t->count * nv, flat, nv * sizeof *flat);
    t->progress[t->count] = progress;
    t->closure[t->count++] = closure;
}

rg_status rg_fold_own_track(rg_fold *f, int32_t states)
{
    if (f->settings.frames > INT32_MAX - 1 - states) return RG_ENOMEM;
    const rg_status s = grow(f, states + 1 + f->settings.frames);
    if (s != RG_OK || f->steered) return s;
    const rg_motion *m = f->shared->motion;
    for (int32_t k = 0; k <= f->at; k++)
        append(f, rg_fold_state(f, k), rg_fold_pattern(f, k), rg_fold_progress(f, k), m->frame[k].closure_residual);
    f->steered = 1;
    f->ending.outcome = RG_RUNNING;
    f->ending.reason = "";
    return RG_OK;
}

void rg_fold_aim_as_found(rg_fold *f)
{
    const rg_motion *m = f->shared->motion;
    for (int32_t i = 0; i < m->mesh.N; i++) {
        const int still = m->mesh.still && m->mesh.still[m->mesh.crease_edge[i]];
        f->steer->role[i] = still ? RG_ROLE_STILL : isnan(m->target[i]) ? RG_ROLE_FREE : RG_ROLE_WISHES;
        f->steer->target[i] = isnan(m->target[i]) ? 0 : m->target[i];
    }
}

rg_status rg_fold_make_steer(rg_fold *f)
{
    if (f->steer) return RG_OK;
    rg_steer *steer = rg_mem_array(&f->mem, 1, sizeof *steer);
    if (!steer) return RG_ENOMEM;
    const rg_status s = rg_steer_init(steer, &f->mem, rg_fold_mesh(f), &f->settings);
    if (s == RG_OK) {
        f->steer = steer;
        rg_fold_aim_as_found(f);
    } else {
        rg_steer_free(steer);
        rg_mem_free(&f->mem, steer);
    }
    return s;
}

/* ------------------------------------------------------------------------------------------------ a leg ---- */

/* From the last state of the track; the fold may have been taken back before it. */
static void begin(rg_fold *f)
{
    f->first = f->track.count - 1;
    f->track.progress[f->first] = 0;
    if (f->at == f->first) f->progress = 0;
    rg_mesh_sectors(rg_fold_mesh(f), rg_fold_pattern(f, f->first), f->theta);
    rg_steer_begin(f->steer, f->theta, rg_fold_state(f, f->first));
    f->aimed = 0;
}

static void end(rg_fold *f)
{
    f->ending.outcome = f->steer->outcome;
    f->ending.reason = f->steer->reason;
    if (f->ending.outcome == RG_STOPPED)
        rg_steer_blame(f->steer, f->ending.vertex, &f->ending.vertices, f->ending.crease, &f->ending.creases);
}

void rg_fold_advance(rg_fold *f)
{
    if (f->aimed) begin(f);
    rg_steer *F = f->steer;
    const int32_t last = f->settings.frames - 1, next = f->track.count - f->first;
    const double before = f->track.progress[f->track.count - 1];
    if (F->outcome == RG_RUNNING) rg_steer_to(F, next >= last ? 1 : (double)next / last);
    const int stopped = F->outcome == RG_STOPPED, ended = F->outcome == RG_FOLDED; /* at once, if nothing is to move */
    const double s = stopped ? F->s : ended || next >= last ? 1 : (double)next / last;
    if (stopped ? s > before : next <= last) append(f, F->out, rg_fold_pattern(f, f->first), s, F->closure);
    if (F->outcome != RG_RUNNING) end(f);
}

/* Room for what comes after the present state, before anything is changed. */
static rg_status prepare(rg_fold *f)
{
    rg_status s = rg_fold_make_steer(f);
    if (s == RG_OK) s = rg_fold_own_track(f, f->at + 1);
    return s;
}

/* The rest of the track no longer holds; the present state is its last one. */
static rg_status aim(rg_fold *f)
{
    f->track.count = f->at + 1;
    if (f->between) append(f, f->rho, f->flat, f->progress, f->closure);
    f->at = f->track.count - 1;
    f->between = 0;
    f->ending.outcome = RG_RUNNING;
    f->ending.reason = "";
    f->aimed = 1;
    rg_fold_look(f);
    return RG_OK;
}

rg_status rg_fold_forget(rg_fold *f)
{
    const rg_status s = prepare(f);
    if (s != RG_OK) return s;
    f->track.count = 0;
    append(f, f->rho, f->flat, 0, f->closure);
    f->at = f->first = f->between = 0;
    f->progress = 0;
    return aim(f);
}

static int is_angle(double x) { return fabs(x) <= RG_PI; }

/* What was driven is nobody's any more. */
static void end_driving(rg_steer *F)
{
    for (int32_t i = 0; i < F->K.C.N; i++)
        if (F->role[i] == RG_ROLE_DRIVEN) F->role[i] = RG_ROLE_FREE;
}

rg_status rg_fold_drive(rg_fold *f, int32_t count, const int32_t *creases, const double *radians)
{
    const int32_t N = rg_fold_mesh(f)->N;
    if (count < 1) return RG_EARG;
    for (int32_t k = 0; k < count; k++)
        if (creases[k] < 0 || creases[k] >= N || !is_angle(radians[k])) return RG_EARG;
    const rg_status s = prepare(f);
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < N; i++)
        if (f->steer->role[i] != RG_ROLE_STILL) f->steer->role[i] = RG_ROLE_FREE;
    for (int32_t k = 0; k < count; k++) {
        f->steer->role[creases[k]] = RG_ROLE_DRIVEN;
        f->steer->target[creases[k]] = radians[k];
    }
    return aim(f);
}

rg_status rg_fold_set_target(rg_fold *f, int32_t c, double radians)
{
    if (c < 0 || c >= rg_fold_mesh(f)->N || !(is_angle(radians) || radians == RG_FREE)) return RG_EARG;
    const rg_status s = prepare(f);
    if (s != RG_OK) return s;
    end_driving(f->steer);
    f->steer->role[c] = radians == RG_FREE ? RG_ROLE_FREE : RG_ROLE_WISHES;
    f->steer->target[c] = radians == RG_FREE ? 0 : radians;
    return aim(f);
}

rg_status rg_fold_pin(rg_fold *f, int32_t c)
{
    if (c < 0 || c >= rg_fold_mesh(f)->N) return RG_EARG;
    const rg_status s = prepare(f);
    if (s != RG_OK) return s;
    f->steer->role[c] = RG_ROLE_STILL;
    return aim(f);
}
