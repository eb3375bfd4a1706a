#include "motion/states.h"
#include "base/status.h"
#include "fold/closing.h"

#include <stdio.h>
#include <string.h>

/* Two drawings of a point are each within the tolerance of where it ought to be; below the least, points are the
 * same. */
static const double TWO_DRAWINGS = 2, LEAST_MERGE = 1e-9;
/* Closing a state on the lines of two drawings may turn creases by this much, radians; beyond, it is another state. */
static const double SAME_STATE = 0.02;

int32_t rg_stretch_frames(const rg_stretch *s)
{
    return s->end_only ? s->end_only > 0 : s->attempt.count - 1;
}

int32_t rg_stretch_frame(const rg_stretch *s, int32_t k)
{
    const int32_t last = s->attempt.count - 1, forwards = s->end_only ? last : k + 1;
    return s->backwards ? last - forwards : forwards;
}

void rg_states_free(rg_states *q)
{
    if (!q->mem.resize) return;
    for (int32_t k = 0; q->state && k < q->count; k++) rg_mesh_free(&q->state[k]);
    for (int32_t j = 0; j < q->stretches; j++) rg_attempt_free(&q->stretch[j].attempt);
    RG_MEM_FREE(&q->mem, q->state, q->stretch, q->by_flat);
    memset(q, 0, sizeof *q);
}

/* --------------------------------------------------------------------------------------- where we are ---- */

/* The end of what was walked so far. */
static const double *angles_now(const rg_states *q, const rg_mesh **mesh)
{
    const rg_stretch *last = &q->stretch[q->stretches - 1];
    *mesh = &last->attempt.mesh;
    return rg_attempt_angles(&last->attempt, last->backwards ? 0 : last->attempt.count - 1);
}

/* Takes *t over. */
static void walk(rg_states *q, rg_attempt *t, double compliance, int backwards, double begin, double end,
                 int32_t reaches)
{
    const double gain = t->relax ? t->relax->how.gain : 0;
    q->stretch[q->stretches++] = (rg_stretch){*t, compliance, gain, backwards, 0, begin, end, reaches};
    memset(t, 0, sizeof *t);
}

/* Makes up for the rounding of drawings: works off what rho[N] does not close by, eq. (14). *closes: zero if nothing,
 * or only another state does; rho is then left as it is. */
static rg_status close_up(const rg_states *q, const rg_mesh *m, double *rho, int *closes)
{
    const rg_relaxation still = {0};
    rg_relax F;
    double *closed = rg_mem_array(&q->mem, (size_t)m->N, sizeof *closed);
    if (!closed) return RG_ENOMEM;
    rg_status s = rg_relax_init(&F, m, &q->settings, &still, NULL, rho);
    if (s == RG_OK) {
        memcpy(closed, rho, (size_t)m->N * sizeof *rho);
        *closes = rg_closing_on_pattern(&F, closed);
        for (int32_t i = 0; i < m->N; i++) *closes &= fabs(closed[i] - rho[i]) <= SAME_STATE;
        if (*closes) memcpy(rho, closed, (size_t)m->N * sizeof *rho);
        rg_relax_free(&F);
    }
    rg_mem_free(&q->mem, closed);
    return s;
}

/* An attempt of one frame: the state as its pattern says, which closes. */
static rg_status stand(const rg_states *q, const rg_mesh *m, const double *rho, rg_attempt *t)
{
    const size_t N = (size_t)m->N;
    memset(t, 0, sizeof *t);
    t->mem = q->mem;
    t->outcome = RG_FOLDED;
    t->method = "relaxed", t->solver = "none";
    rg_status s = rg_mesh_copy(m, &t->mesh);
    if (s == RG_OK) s = RG_MEM_ARRAYS(&q->mem, RG_ARRAY(t->rho, N), RG_ARRAY(t->from, N), RG_ARRAY(t->target, N));
    if (s != RG_OK) {
        rg_attempt_free(t);
        return s;
    }
    memcpy(t->rho, rho, N * sizeof *rho);
    memcpy(t->target, rho, N * sizeof *rho);
    t->count = 1;
    return RG_OK;
}

/* One search, its frames read off, counted. */
static rg_status look_for(rg_states *q, const rg_problem *p, int32_t frames, rg_watch *watch, rg_search *found,
                          rg_diag *why)
{
    rg_settings s = q->settings;
    s.frames = frames > 2 ? frames : 2;
    rg_status status = rg_search_run(found, p, &s, watch, why);
    if (status == RG_OK) status = rg_attempt_read(&found->best, &s);
    if (status != RG_OK) rg_attempt_free(&found->best);
    if (status != RG_OK) return status;
    rg_cost_add(&q->cost, &found->cost);
    q->tries += found->tries;
    return RG_OK;
}

/* How a state folds from flat, by whatever folds it. */
static rg_status fold_alone(rg_states *q, int32_t k, int32_t frames, rg_watch *watch, rg_search *found, rg_diag *why)
{
    const rg_problem alone = {&q->state[k], NULL, NULL, 1, 0};
    return look_for(q, &alone, frames, watch, found, why);
}

/* Of the whole way, the one from state to state that is walked now. */
typedef struct share { const rg_states *q; double begin; } share;

static int tell(void *ctx, double progress)
{
    const share *w = ctx;
    return w->q->progress ? w->q->progress(w->q->ctx, (w->begin + progress) / (w->q->count - 1)) : 0;
}

static void stop(rg_states *q, int32_t k, const char *reason)
{
    q->outcome = RG_STOPPED;
    snprintf(q->reason, sizeof q->reason, "from state %d to state %d: %.190s", (int)k + 1, (int)k + 2, reason);
}

/* The first state: as its pattern says, or as far as it folds where that does not close. */
static rg_status begin(rg_states *q, rg_diag *why)
{
    const rg_mesh *m = &q->state[0];
    share progress = {q, 0};
    rg_watch watch = {.progress = tell, .ctx = &progress};
    int closes = 0, known = 1;
    double *rho = rg_mem_array(&q->mem, (size_t)m->N, sizeof *rho);
    if (!rho) return RG_ENOMEM;
    for (int32_t i = 0; i < m->N; i++) {
        rho[i] = q->settings.to * m->target[m->crease_edge[i]];
        known &= !isnan(rho[i]);
    }
    rg_search found = {0};
    rg_status s = known ? close_up(q, m, rho, &closes) : RG_OK;
    if (s == RG_OK) s = closes ? stand(q, m, rho, &found.best) : fold_alone(q, 0, 2, &watch, &found, why);
    rg_mem_free(&q->mem, rho);
    if (s != RG_OK) return s;
    walk(q, &found.best, found.compliance, 0, 0, 0, 0);
    q->stretch[0].end_only = 1;
    if (watch.cancelled) stop(q, 0, "interrupted");
    return RG_OK;
}

/* ------------------------------------------------------------------------------------------- a direct way ---- */

/* From where we are to the next state. */
typedef struct leg {
    int32_t k, frames;
    rg_mesh mesh;       /* the creases of both */
    double *from, *to;  /* [mesh.N] */
    int from_closes, to_closes, from_flat, to_flat;
} leg;

static void leg_free(const rg_states *q, leg *w)
{
    rg_mesh_free(&w->mesh);
    RG_MEM_FREE(&q->mem, w->from, w->to);
}

/* `coarse`'s angles, of[coarse->N], or its targets where of is NULL, as those of w->mesh. */
static rg_status angles_of(const rg_states *q, const leg *w, const rg_mesh *coarse, const double *of, double *rho)
{
    rg_overlay o;
    double *target = rg_mem_array(&q->mem, (size_t)coarse->N, sizeof *target);
    rg_status s = rg_overlay_init(&o, &w->mesh, coarse, q->tol);
    if (!target) s = RG_ENOMEM;
    for (int32_t i = 0; s == RG_OK && i < coarse->N; i++)
        target[i] = q->settings.to * coarse->target[coarse->crease_edge[i]];
    if (s == RG_OK) rg_overlay_angles(&o, of ? of : target, rho);
    rg_overlay_free(&o);
    rg_mem_free(&q->mem, target);
    return s;
}

/* The next state's assignments, by which facets are cut and closed vertices found. */
static void assign(const rg_states *q, leg *w)
{
    for (int32_t i = 0; i < w->mesh.N; i++) {
        const double target = q->settings.to * w->to[i];
        const int32_t e = w->mesh.crease_edge[i];
        w->mesh.target[e] = target == 0 ? NAN : target;
        w->mesh.assignment[e] = target > 0    ? RG_VALLEY
                                : target < 0  ? RG_MOUNTAIN
                                : target == 0 ? RG_FLAT
                                              : RG_UNASSIGNED;
    }
}

static rg_status leg_init(const rg_states *q, leg *w, int32_t k, int32_t frames, rg_diag *why)
{
    const rg_mesh *now, *next = &q->state[k + 1];
    const double *rho = angles_now(q, &now);
    rg_lines l;
    memset(w, 0, sizeof *w);
    w->k = k;
    w->frames = frames;
    rg_lines_init(&l, &q->mem);
    l.merge = q->merge;
    rg_status s = rg_overlay_draw(&l, &q->state[k], 0, NULL);
    if (s == RG_OK) s = rg_overlay_draw(&l, next, 0, NULL);
    if (s == RG_OK) s = rg_overlay_draw(&l, now, 1, rho);
    if (s != RG_OK) rg_lines_free(&l);
    else s = rg_overlay_mesh(&l, q->asked, &w->mesh, why);
    if (s != RG_OK) return s;
    if (RG_MEM_ARRAYS(&q->mem, RG_ARRAY(w->from, (size_t)w->mesh.N),
                      RG_ARRAY(w->to, (size_t)w->mesh.N)) != RG_OK) return RG_ENOMEM;
    s = angles_of(q, w, now, rho, w->from);
    if (s == RG_OK) s = angles_of(q, w, next, NULL, w->to);
    if (s != RG_OK) return s;
    assign(q, w);
    int known = 1;
    w->from_flat = w->to_flat = 1;
    for (int32_t i = 0; i < w->mesh.N; i++) {
        known &= !isnan(w->to[i]);
        w->from_flat &= w->from[i] == 0;
        w->to_flat &= w->to[i] == 0;
    }
    s = close_up(q, &w->mesh, w->from, &w->from_closes);
    if (s == RG_OK && known) s = close_up(q, &w->mesh, w->to, &w->to_closes);
    for (int32_t i = 0; !w->to_closes && i < w->mesh.N; i++) /* what a state does not close by is no way to go */
        if (fabs(w->to[i] - w->from[i]) <= SAME_STATE) w->to[i] = w->from[i];
    return s;
}

/* Straight from state to state. */
static rg_status direct(rg_states *q, const leg *w, rg_watch *watch, rg_search *found, rg_diag *why)
{
    const rg_problem straight = {&w->mesh, w->from, w->to, w->to_closes, 0};
    return look_for(q, &straight, w->frames, watch, found, why);
}

/* ------------------------------------------------------------------------------------------------- legs ---- */

/* State k as it folds, backwards, then the next one, if that comes farther than `farthest` of the way. Either may be
 * flat. */
static rg_status through_flat(rg_states *q, const leg *w, double farthest, rg_watch *watch, int *done, rg_diag *why)
{
    const int32_t k = w->k, all = w->frames - 1, down = w->from_flat ? 0 : w->to_flat ? all : all / 2, up = all - down;
    const double middle = k + (w->from_flat ? 0 : w->to_flat ? 1 : 0.5);
    rg_search unfold = {0}, fold = {0};
    rg_status s = w->from_flat ? RG_OK : fold_alone(q, k, down + 1, watch, &unfold, why);
    if (s == RG_OK && !w->from_flat && !rg_search_is_folded(&unfold.best)) goto out;
    if (s == RG_OK && !w->to_flat) s = fold_alone(q, k + 1, up + 1, watch, &fold, why);
    if (s != RG_OK) goto out;
    const int arrives = w->to_flat || rg_search_is_folded(&fold.best);
    if (!arrives && !(middle - k + (k + 1 - middle) * fold.best.score > farthest)) goto out;
    *done = 1;
    if (!w->from_flat) {
        walk(q, &unfold.best, unfold.compliance, 1, k, middle, w->to_flat ? k + 1 : -1);
        if (!down) q->stretch[q->stretches - 1].end_only = -1;
    }
    if (!w->to_flat) walk(q, &fold.best, fold.compliance, 0, middle, k + 1, arrives ? k + 1 : -1);
    if (!w->from_flat && !w->to_flat) q->by_flat[q->by_flat_count++] = k + 1;
out:
    rg_attempt_free(&unfold.best);
    rg_attempt_free(&fold.best);
    return s;
}

/* A way of nothing takes its time too. */
static rg_status fill_up(rg_attempt *t, int32_t frames)
{
    const size_t N = (size_t)t->mesh.N, nv = (size_t)t->mesh.nv, room = (size_t)frames + 1;
    if (t->count >= frames) return RG_OK;
    double *rho;
    rg_vec2 *flat = NULL;
    rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(rho, room * N));
    if (s == RG_OK && t->flat) s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(flat, room * nv));
    if (s != RG_OK) {
        rg_mem_free(&t->mem, rho);
        return s;
    }
    for (int32_t k = 0; k < frames; k++) {
        const int32_t from = k < t->count ? k : t->count - 1;
        memcpy(rho + (size_t)k * N, rg_attempt_angles(t, from), N * sizeof *rho);
        if (flat) memcpy(flat + (size_t)k * nv, rg_attempt_pattern(t, from), nv * sizeof *flat);
    }
    RG_MEM_FREE(&t->mem, t->rho, t->flat);
    t->rho = rho, t->flat = flat, t->count = frames;
    return RG_OK;
}

static rg_status go(rg_states *q, int32_t k, int32_t frames, rg_diag *why)
{
    share progress = {q, k};
    rg_watch watch = {.progress = tell, .ctx = &progress};
    rg_search found = {0};
    leg w;
    int done = 0;
    rg_status s = leg_init(q, &w, k, frames, why);
    const int one_is_flat = w.from_flat != w.to_flat;
    if (s == RG_OK && one_is_flat) s = through_flat(q, &w, 1, &watch, &done, why);
    if (s == RG_OK && !done && w.from_closes) s = direct(q, &w, &watch, &found, why);
    const int tried = found.best.mem.resize != NULL, arrives = s == RG_OK && tried && rg_search_is_folded(&found.best);
    if (arrives) s = fill_up(&found.best, frames);
    if (s == RG_OK && !done && !arrives && !one_is_flat && !watch.cancelled)
        s = through_flat(q, &w, tried ? found.best.score : -1, &watch, &done, why);
    if (s == RG_OK && !done) {
        if (!tried) stop(q, k, "neither state closes on the lines of both");
        else walk(q, &found.best, found.compliance, 0, k, k + 1, arrives ? k + 1 : -1);
    }
    if (s == RG_OK && q->outcome == RG_RUNNING) {
        const rg_stretch *last = &q->stretch[q->stretches - 1];
        if (last->reaches < 0) stop(q, k, watch.cancelled ? "interrupted" : last->attempt.reason);
    }
    rg_attempt_free(&found.best);
    leg_free(q, &w);
    return s;
}

static rg_status prepare(rg_states *q, const rg_pattern *const *pattern, rg_diag *why)
{
    q->asked = pattern[0]->merge;
    if (RG_MEM_ARRAYS(&q->mem, RG_ARRAY(q->state, (size_t)q->count), RG_ARRAY(q->stretch, 2 * (size_t)q->count),
                      RG_ARRAY(q->by_flat, (size_t)q->count)) != RG_OK) return RG_ENOMEM;
    for (int32_t k = 0; k < q->count; k++) {
        rg_diag where = {0, ""};
        rg_status status = rg_pattern_same_sheet(pattern[0], pattern[k], &where);
        if (status != RG_OK) return rg_fail(status, why, 0, "state %d: %s", (int)k + 1, where.text);
        q->merge = fmax(q->merge, pattern[k]->lines.merge);
        status = rg_mesh_from_pattern(pattern[k], &q->mem, &q->state[k], why);
        if (status != RG_OK) return status;
    }
    const double merge = q->asked == RG_MERGE_DEFAULT && q->merge > 0 ? q->merge : q->asked;
    q->tol = TWO_DRAWINGS * fmax(merge, LEAST_MERGE) * q->state[0].size;
    return RG_OK;
}

rg_status rg_states_run(rg_states *q, const rg_pattern *const *pattern, int32_t count, const rg_settings *s,
                        rg_progress progress, void *ctx, rg_diag *why)
{
    memset(q, 0, sizeof *q);
    q->mem = rg_mem_default(s->memory);
    q->settings = *s;
    q->count = count;
    q->progress = progress;
    q->ctx = ctx;
    const int32_t legs = count - 1;
    if (fabs(s->to) != 1) return rg_fail(RG_EARG, why, 0, "a sequence of states goes to its end: 100 or -100 percent");
    if (s->frames < count) return rg_fail(RG_EARG, why, 0, "%d states need at least %d frames", (int)count, (int)count);
    rg_status status = prepare(q, pattern, why);
    if (status == RG_OK) status = begin(q, why);
    for (int32_t k = 0; status == RG_OK && q->outcome == RG_RUNNING && k < legs; k++)
        status = go(q, k, (s->frames - 1) / legs + (k < (s->frames - 1) % legs) + 1, why);
    if (status != RG_OK || q->outcome != RG_RUNNING) return status;
    q->outcome = RG_FOLDED;
    snprintf(q->reason, sizeof q->reason, "folded%s%s",
             q->by_flat_count ? "; unfolded to flat where the direct way is blocked" : "",
             q->stretch[0].attempt.outcome == RG_FOLDED ? "" : "; from the first state only as far as it folds");
    return RG_OK;
}
