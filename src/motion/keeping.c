/* keeping.c -- states of a fold to come back to, folds like it, and tracks made motions: rigami.h, rg_fold_snapshot and
 * others. */
#include "base/clock.h"
#include "base/settings.h"
#include "base/status.h"
#include "motion/ending.h"
#include "motion/fold.h"
#include "motion/measure.h"
#include "pattern/source.h"

#include <stdio.h>
#include <string.h>

/* -------------------------------------------------------------------------------------------------- copies ---- */

/* All of a fold but its engines and its motion. */
struct rg_snapshot {
    rg_memory mem;
    rg_shared *of;       /* held, so that no other one can take its place */
    int steered, aimed, between;
    int32_t first, at;
    double closure, progress;
    double *rho;         /* [N] the present state */
    rg_vec2 *flat;       /* [nv] */
    rg_ending ending;
    rg_track track;
    int steers;
    rg_steer_kept leg;
};

void rg_snapshot_destroy(rg_snapshot *s)
{
    if (!s) return;
    const rg_memory mem = s->mem;
    RG_MEM_FREE(&mem, s->rho, s->flat, s->ending.vertex, s->ending.crease, s->track.rho, s->track.flat,
                s->track.progress, s->track.closure);
    if (s->steers) rg_steer_kept_free(&s->leg, &mem);
    rg_shared_let_go(&mem, s->of);
    rg_mem_free(&mem, s);
}

rg_status rg_fold_snapshot(const rg_fold *f, rg_snapshot **snapshot)
{
    const rg_mesh *m = rg_fold_mesh(f);
    const size_t N = (size_t)m->N, nv = (size_t)m->nv, n = f->steered ? (size_t)f->track.count : 0;
    rg_snapshot *s = rg_mem_array(&f->mem, 1, sizeof *s);
    if (!s) return RG_ENOMEM;
    *s = (rg_snapshot){.mem = f->mem, .of = f->shared, .steered = f->steered, .aimed = f->aimed, .between = f->between,
                       .first = f->first, .at = f->at, .closure = f->closure, .progress = f->progress, .rho = f->rho,
                       .flat = f->flat, .ending = f->ending, .track = f->track};
    atomic_fetch_add(&f->shared->holders, 1);
    s->track.count = (int32_t)n;
    rg_ending *e = &s->ending;
    rg_track *t = &s->track;
    rg_status status = RG_MEM_COPIES(&f->mem, RG_ARRAY(s->rho, N), RG_ARRAY(s->flat, nv),
                                     RG_ARRAY(e->vertex, (size_t)e->vertices),
                                     RG_ARRAY(e->crease, (size_t)e->creases), RG_ARRAY(t->rho, n * N),
                                     RG_ARRAY(t->flat, n * nv), RG_ARRAY(t->progress, n), RG_ARRAY(t->closure, n));
    if (status == RG_OK && f->steer) {
        status = rg_steer_kept_init(&s->leg, &f->mem, m->N);
        s->steers = status == RG_OK;
        if (s->steers) rg_steer_keep(f->steer, &s->leg);
    }
    if (status == RG_OK) *snapshot = s;
    else rg_snapshot_destroy(s);
    return status;
}

rg_status rg_fold_restore(rg_fold *f, const rg_snapshot *s)
{
    const rg_mesh *m = rg_fold_mesh(f);
    const size_t N = (size_t)m->N, nv = (size_t)m->nv, n = (size_t)s->track.count;
    const rg_ending *e = &s->ending;
    if (s->of != f->shared) return RG_EARG;
    rg_status status = s->steers ? rg_fold_make_steer(f) : RG_OK;
    if (status == RG_OK && s->steered) status = rg_fold_own_track(f, s->aimed ? s->track.count : s->first + 1);
    if (status != RG_OK) return status;
    f->steered = s->steered, f->aimed = s->aimed, f->between = s->between, f->first = s->first, f->at = s->at;
    f->closure = s->closure, f->progress = s->progress;
    f->ending.outcome = e->outcome, f->ending.reason = e->reason;
    f->ending.vertices = e->vertices, f->ending.creases = e->creases;
    memcpy(f->rho, s->rho, N * sizeof *s->rho);
    memcpy(f->flat, s->flat, nv * sizeof *s->flat);
    memcpy(f->ending.vertex, e->vertex, (size_t)e->vertices * sizeof *e->vertex);
    memcpy(f->ending.crease, e->crease, (size_t)e->creases * sizeof *e->crease);
    f->track.count = s->track.count;
    if (n > 0) rg_track_copy(&f->track, &s->track, m);
    if (s->steers) {
        /* The leg's pattern; of one that is still to begin, that of where it will. */
        const rg_vec2 *X = s->steered ? rg_fold_pattern(f, s->aimed ? s->track.count - 1 : s->first) : m->X;
        rg_mesh_sectors(m, X, f->theta);
        rg_steer_return(f->steer, f->theta, &s->leg);
    } else if (f->steer) {
        rg_fold_aim_as_found(f);
    }
    rg_fold_look(f);
    return RG_OK;
}

rg_status rg_fold_clone(const rg_fold *f, rg_fold **clone)
{
    rg_snapshot *s = NULL;
    rg_fold *g = NULL;
    rg_status status = rg_fold_snapshot(f, &s);
    if (status == RG_OK) status = rg_fold_on(f->shared, &f->mem, &f->settings, &g);
    if (status == RG_OK) status = rg_fold_restore(g, s);
    rg_snapshot_destroy(s);
    if (status == RG_OK) *clone = g;
    else rg_fold_destroy(g);
    return status;
}

/* --------------------------------------------------------------------------------------------- a motion of it ---- */

/* A leg begins with no progress. */
static int begins_leg(const rg_fold *f, int32_t k) { return k == 0 || rg_fold_progress(f, k) == 0; }

static int32_t legs_of(const rg_fold *f)
{
    int32_t legs = 0;
    for (int32_t k = 0; f->steered && k < rg_fold_states(f); k++) legs += begins_leg(f, k);
    /* one that was set, and no step has begun, goes on from the last state */
    return legs + (f->steered && f->aimed && !begins_leg(f, rg_fold_states(f) - 1));
}

/* What its creases aim at, and from where. Of several legs each aims elsewhere, and nothing is aimed at by all. */
static void set_aims(rg_motion *m, const rg_fold *f)
{
    const rg_motion *old = f->shared->motion;
    const double *last = rg_fold_state(f, rg_fold_states(f) - 1);
    const int one = legs_of(f) == 1;
    for (int32_t i = 0; i < m->mesh.N; i++) {
        m->from[i] = !f->steered ? old->from[i] : f->aimed ? last[i] : f->steer->from[i];
        m->target[i] = old->target[i];
        if (!f->steered) continue;
        const int counts = f->steer->role[i] == RG_ROLE_WISHES || f->steer->role[i] == RG_ROLE_DRIVEN;
        m->target[i] = counts ? f->steer->target[i] : NAN;
        m->mesh.target[m->mesh.crease_edge[i]] = one ? m->target[i] : NAN;
    }
}

/* Measuring goes by the angles of the last leg; of several, it is the way that counts, and each is as long as any
 * other. */
static void set_percent(rg_motion *m, const rg_fold *f, int32_t every)
{
    const int32_t legs = legs_of(f), states = rg_fold_states(f);
    double way = 0;
    for (int32_t k = 0, leg = -1, frame = 0; legs > 1 && k < states; k++) {
        leg += begins_leg(f, k);
        way = fmax(way, leg + rg_fold_progress(f, k));
        if (k % every == 0 || k == states - 1) m->frame[frame++].percent = m->report.folded_percent = 100 * way / legs;
    }
    if (legs > 1) m->report.least_folded_percent = m->report.folded_percent;
}

static void tell_found(rg_report *r, const rg_report *old)
{
    r->method = old->method, r->solver = old->solver;
    r->rung = old->rung, r->direction = old->direction;
    memcpy(r->strategy, old->strategy, sizeof r->strategy);
    r->outcome = old->outcome;
    memcpy(r->reason, old->reason, sizeof r->reason);
    r->tries = old->tries;
    r->blocking_vertex_count = old->blocking_vertex_count, r->blocking_crease_count = old->blocking_crease_count;
}

static void tell_steered(rg_report *r, const rg_fold *f)
{
    const rg_project *P = &f->steer->P;
    const rg_ending *e = &f->ending;
    r->method = r->rung = "steered", r->direction = "forward";
    r->solver = P->solver == RG_SOLVER_CG ? "cg" : P->solver == RG_SOLVER_SVD ? "svd" : "cholesky";
    snprintf(r->strategy, sizeof r->strategy, "driven creases, and least motion of the others");
    r->outcome = e->outcome;
    snprintf(r->reason, sizeof r->reason, "%s", e->outcome == RG_RUNNING ? "as far as it was taken" : e->reason);
    r->steps = f->steer->steps, r->solves = P->solves, r->cg_iterations = P->iterations;
    r->factorizations = P->factorizations;
    r->tries = 1;
    r->blocking_vertex_count = e->outcome == RG_STOPPED ? e->vertices : 0;
    r->blocking_crease_count = e->outcome == RG_STOPPED ? e->creases : 0;
}

static void set_report(rg_motion *m, const rg_fold *f)
{
    rg_report *r = &m->report;
    const rg_report *old = &f->shared->motion->report;
    const int32_t *vertex = f->steered ? f->ending.vertex : old->blocking_vertices;
    const int32_t *crease = f->steered ? f->ending.crease : old->blocking_creases;
    r->added_creases = m->mesh.added, r->unknowns = m->mesh.N, r->constraints = 3 * m->mesh.M;
    r->triangulation = old->triangulation, r->why_triangulated = old->why_triangulated;
    if (f->steered) tell_steered(r, f);
    else tell_found(r, old);
    memcpy(m->blocking_vertex, vertex, (size_t)r->blocking_vertex_count * sizeof *vertex);
    memcpy(m->blocking_crease, crease, (size_t)r->blocking_crease_count * sizeof *crease);
    for (int32_t k = 0; k < r->blocking_vertex_count; k++)
        rg_motion_drawn(m, m->mesh.X[m->blocking_vertex[k]], m->blocking_at[k]);
    r->blocking_vertices = m->blocking_vertex, r->blocking_creases = m->blocking_crease;
    r->blocking_at = (const double(*)[2])m->blocking_at;
}

/* What reads states off a track, between one of its states and the next, which are as far apart as `way` says. */
typedef struct track_reader { rg_fold *f; int32_t k; double way; rg_status s; } track_reader;

static int read_track(void *ctx, double way, double *rho, rg_vec2 *X)
{
    track_reader *q = ctx;
    int closes = 0;
    if (q->s == RG_OK) q->s = rg_fold_read_between(q->f, q->k, way / q->way, rho, X, &closes);
    return closes;
}

/* Did the motion that was found go from there to the next? Then it has what lies between them. */
static int is_found(const rg_fold *f, int32_t k)
{
    const rg_motion *old = f->shared->motion;
    const size_t bytes = 2 * (size_t)rg_fold_mesh(f)->N * sizeof(double);
    return k + 1 < old->report.frame_count && memcmp(rg_fold_state(f, k), rg_motion_angles(old, k), bytes) == 0;
}

/* Between states k and k + 1 of the track, after that frame. Half a turn of a crease counts as a whole way: legs are as
 * long as they like. */
static rg_status fill_between(rg_motion *m, rg_gap_filler *q, track_reader *r, int32_t k, int32_t frame)
{
    const rg_motion *old = r->f->shared->motion;
    const double *a = rg_fold_state(r->f, k), *b = rg_fold_state(r->f, k + 1);
    const int found = is_found(r->f, k);
    rg_status s = RG_OK;
    for (int32_t j = 0; found && s == RG_OK && j < old->gaps.count; j++)
        if (old->gaps.after[j] == k)
            s = rg_gaps_add(&m->gaps, &m->mem, &m->mesh, frame, rg_gaps_angles(&old->gaps, &old->mesh, j),
                            q->moves ? rg_gaps_pattern(&old->gaps, &old->mesh, j) : NULL);
    if (s != RG_OK || found) return s;
    r->k = k;
    r->way = rg_gaps_turn(m->mesh.N, a, b) / RG_PI;
    if (r->way > 0) s = rg_gap_fill(q, frame, 0, a, r->way, b);
    return s == RG_OK ? r->s : s;
}

/* Every so many states of the track is a frame, and so is the last; others lie between. f: a clone, by which it is
 * read. */
static rg_status fill_track(rg_motion *m, rg_fold *f, int32_t every, int moved)
{
    const size_t N = (size_t)m->mesh.N, nv = (size_t)m->mesh.nv;
    const int32_t states = rg_fold_states(f);
    track_reader r = {.f = f};
    rg_gap_filler q;
    rg_status s = rg_gap_filler_init(&q, &m->mem, &m->mesh, &m->gaps, moved, read_track, &r);
    for (int32_t k = 0, frame = -1; s == RG_OK && k < states; k++) {
        const double *rho = rg_fold_state(f, k);
        const rg_vec2 *X = moved ? rg_fold_pattern(f, k) : NULL;
        if (k % every == 0 || k == states - 1) {
            frame++;
            memcpy(m->rho + (size_t)frame * N, rho, N * sizeof *rho);
            if (moved) memcpy(m->flat + (size_t)frame * nv, X, nv * sizeof *X);
        } else {
            s = rg_gaps_add(&m->gaps, &m->mem, &m->mesh, frame, rho, X);
        }
        if (s == RG_OK && k + 1 < states) s = fill_between(m, &q, &r, k, frame);
    }
    rg_gap_filler_free(&q);
    return s;
}

static rg_status fill(rg_motion *m, const rg_fold *f, int32_t every)
{
    const rg_motion *old = f->shared->motion;
    const size_t N = (size_t)m->mesh.N, M = (size_t)m->mesh.M, nv = (size_t)m->mesh.nv;
    const int32_t states = rg_fold_states(f);
    const size_t n = ((size_t)states + (size_t)every - 2) / (size_t)every + 1;
    int moved = old->gaps.flat != NULL;
    for (int32_t k = 0; k < states; k++) moved |= memcmp(rg_fold_pattern(f, k), m->mesh.X, nv * sizeof(rg_vec2)) != 0;
    m->report.frame_count = (int32_t)n;
    rg_status s = rg_motion_name(m, &old->info);
    if (s == RG_OK) s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->target, N), RG_ARRAY(m->from, N), RG_ARRAY(m->rho, n * N),
                                      RG_ARRAY(m->frame, n), RG_ARRAY(m->blocking_vertex, M),
                                      RG_ARRAY(m->blocking_crease, N), RG_ARRAY(m->blocking_at, M));
    if (s == RG_OK && moved) s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->flat, n * nv));
    if (s != RG_OK) return s;
    m->report.frames = m->frame;
    rg_fold *reader = NULL;
    s = rg_fold_clone(f, &reader);
    if (s == RG_OK) s = fill_track(m, reader, every, moved);
    rg_fold_destroy(reader);
    set_aims(m, f);
    set_report(m, f);
    return s;
}

/* watch: asked while it is measured; NULL: nobody. */
static rg_status record(const rg_fold *f, int32_t every, rg_watch *watch, rg_motion **motion, rg_diag *why)
{
    const double begun = rg_seconds();
    rg_motion *m = rg_mem_array(&f->mem, 1, sizeof *m);
    if (!m) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->mem = f->mem;
    m->settings = f->settings;
    rg_status s = rg_mesh_copy(rg_fold_mesh(f), &m->mesh);
    if (s == RG_OK) s = rg_source_copy(&f->shared->motion->source, &m->mem, &m->source);
    if (s == RG_OK) s = fill(m, f, every);
    if (s == RG_OK) s = rg_motion_hang(m, why);
    if (s == RG_OK) s = rg_motion_lend(m);
    if (s == RG_OK) s = rg_measure_frames(m, watch);
    if (s == RG_OK) set_percent(m, f, every);
    if (s == RG_OK) s = rg_ending_find(m, watch, why);
    if (s != RG_OK) {
        rg_motion_destroy(m);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    m->report.seconds_total = rg_seconds() - begun;
    *motion = m;
    return RG_OK;
}

rg_status rg_fold_record(const rg_fold *f, rg_motion **motion, rg_diag *why)
{
    return record(f, 1, NULL, motion, why);
}

/* ---------------------------------------------------------------------------------------------- driven at once ---- */

/* Into how many ways each of those from frame to frame is cut: driven creases turn evenly. */
static int32_t parts_of(int32_t count, const rg_driven *driven, const rg_settings *s)
{
    double most = 0;
    for (int32_t i = 0; i < count; i++) most = fmax(most, fabs(driven[i].radians));
    return rg_gaps_parts(s->frames - 1, 1, most);
}

/* Drives edges of the pattern, to those angles. */
static rg_status drive_edges(rg_fold *f, const rg_pattern *p, int32_t count, const rg_driven *driven, rg_diag *why)
{
    int32_t *crease;
    double *angle;
    rg_status s = RG_MEM_ARRAYS(&f->mem, RG_ARRAY(crease, (size_t)count), RG_ARRAY(angle, (size_t)count));
    if (s != RG_OK) return rg_fail(s, why, 0, "out of memory");
    for (int32_t n = 0; s == RG_OK && n < count; n++) {
        const int32_t e = driven[n].edge;
        crease[n] = e >= 0 && e < p->ne ? rg_fold_mesh(f)->edge_crease[e] : -1;
        angle[n] = driven[n].radians;
        if (crease[n] < 0) s = rg_fail(RG_EARG, why, 0, "edge %d is no crease", (int)e);
        else if (!(fabs(angle[n]) <= RG_PI))
            s = rg_fail(RG_EARG, why, 0, "an angle of %g is not within -pi and pi", angle[n]);
    }
    const rg_status driven_so = s == RG_OK ? rg_fold_drive(f, count, crease, angle) : RG_OK;
    if (driven_so != RG_OK) s = rg_fail(driven_so, why, 0, "%s", rg_status_text(driven_so));
    RG_MEM_FREE(&f->mem, crease, angle);
    return s;
}

/* One try, on facets as drawn or cut. */
static rg_status drive(const rg_pattern *p, int32_t count, const rg_driven *driven, const rg_settings *s,
                       rg_watch *watch, rg_motion **motion, rg_diag *why)
{
    rg_fold *f = NULL;
    const int32_t every = parts_of(count, driven, s);
    rg_settings finer = *s;
    finer.frames = (s->frames - 1) * every + 1;
    rg_status status = rg_fold_create_flat(p, &finer, &f, why);
    if (status != RG_OK) return status;
    status = drive_edges(f, p, count, driven, why);
    while (status == RG_OK && rg_fold_step(f)->outcome == RG_RUNNING)
        if (rg_watch_tell(watch, f->progress)) break;
    if (status == RG_OK) status = record(f, every, watch, motion, why);
    if (status == RG_OK) (*motion)->settings.frames = s->frames;
    rg_fold_destroy(f);
    return status;
}

static int is_better(const rg_motion *a, const rg_motion *b)
{
    return a->report.outcome == RG_FOLDED || a->report.folded_percent > b->report.folded_percent;
}

rg_status rg_motion_create_driven(const rg_pattern *p, int32_t count, const rg_driven *driven, const rg_settings *given,
                                  rg_progress progress, void *ctx, rg_motion **motion, rg_diag *why)
{
    const double begun = rg_seconds();
    rg_settings s;
    rg_motion *m = NULL, *cut = NULL;
    rg_rising told = {progress, ctx, 0};
    rg_watch watch = {.progress = rg_watch_rising, .ctx = &told};
    rg_status status = rg_settings_take(given, &s, why);
    if (status == RG_OK && count < 1) status = rg_fail(RG_EARG, why, 0, "nothing is driven");
    if (status == RG_OK) status = drive(p, count, driven, &s, &watch, &m, why);
    const int stopped = status == RG_OK && m->report.outcome == RG_STOPPED && !watch.cancelled;
    if (stopped && s.triangulate == RG_TRIANGULATE_AUTO) {
        s.triangulate = RG_TRIANGULATE_ALL;
        status = drive(p, count, driven, &s, &watch, &cut, why);
        if (status == RG_OK && is_better(cut, m)) {
            rg_motion *t = m;
            m = cut;
            cut = t;
            m->report.tries = 2;
            m->report.why_triangulated = "stops short without added creases";
        }
        rg_motion_destroy(cut);
    }
    if (status != RG_OK) {
        rg_motion_destroy(m);
        return status;
    }
    rg_report *r = &m->report;
    if (watch.cancelled && r->outcome != RG_FOLDED) {
        r->outcome = RG_STOPPED;
        snprintf(r->reason, sizeof r->reason, "interrupted");
    }
    r->seconds_total = rg_seconds() - begun;
    *motion = m;
    return RG_OK;
}
