#include "motion/states.h"
#include "base/status.h"

#include <stdio.h>
#include <string.h>

/* Two drawings of one point are each within the tolerance of where it ought to be; below the least, points are the same. */
static const double TWO_DRAWINGS = 2, LEAST_MERGE = 1e-9;
/* Closing a state on the lines of two drawings may turn creases by this much, radians; beyond, it is another state. */
static const double SAME_STATE = 0.02;
/* What all ways on may cost, in what one may. */
static const double MOST_WORK = 2.5;
/* Beyond half a turn by more than this, facets pass through each other. */
static const double OVERFOLD = 0.1 * RG_DEG;

int32_t rg_stretch_frames(const rg_stretch *s)
{
    return s->end_only ? s->end_only > 0 : s->take.count - 1;
}

int32_t rg_stretch_frame(const rg_stretch *s, int32_t k)
{
    const int32_t last = s->take.count - 1, forwards = s->end_only ? last : k + 1;
    return s->backwards ? last - forwards : forwards;
}

void rg_states_free(rg_states *q)
{
    if (!q->mem.resize) return;
    for (int32_t k = 0; q->state && k < q->count; k++) rg_mesh_free(&q->state[k]);
    for (int32_t j = 0; j < q->stretches; j++) rg_take_free(&q->stretch[j].take);
    rg_mem_free(&q->mem, q->state);
    rg_mem_free(&q->mem, q->stretch);
    rg_mem_free(&q->mem, q->by_flat);
    memset(q, 0, sizeof *q);
}

/* --------------------------------------------------------------------------------------- where we are ---- */

/* The end of what was walked so far. */
static const double *angles_now(const rg_states *q, const rg_mesh **mesh)
{
    const rg_stretch *last = &q->stretch[q->stretches - 1];
    *mesh = &last->take.mesh;
    return last->take.rho + (size_t)(last->backwards ? 0 : last->take.count - 1) * (size_t)last->take.mesh.N;
}

static int is_folded(const rg_take *t) { return t->outcome == RG_FOLDED && t->overfold <= OVERFOLD; }

/* Takes *t over. */
static void walk(rg_states *q, rg_take *t, int backwards, double begin, double end, int32_t reaches)
{
    q->stretch[q->stretches++] = (rg_stretch){*t, backwards, 0, begin, end, reaches};
    memset(t, 0, sizeof *t);
}

static void add_cost(rg_states *q, const rg_cost *c)
{
    q->cost.steps += c->steps;
    q->cost.solves += c->solves;
    q->cost.iterations += c->iterations;
    q->cost.factorizations += c->factorizations;
    q->cost.assemblies += c->assemblies;
    q->cost.seconds += c->seconds;
}

/* Makes up for the rounding of drawings: works off what rho[N] does not close by, eq. (14). *closes: zero if nothing, or only
 * another state does; rho is then left as it is. */
static rg_status close_up(const rg_states *q, const rg_mesh *m, double *rho, int *closes)
{
    const rg_flow_law still = {.stubborn = 1};
    rg_flow F;
    rg_status s = rg_flow_init(&F, m, &q->settings, &still, rho, rho);
    if (s != RG_OK) return s;
    *closes = rg_joint_assemble(&F.J, rho, F.u, NULL) <= F.tol;
    if (!*closes && rg_flow_at(&F, 0) && F.closure <= F.tol) {
        *closes = 1;
        for (int32_t i = 0; i < m->N; i++) *closes &= fabs(F.trial[i] - rho[i]) <= SAME_STATE;
        if (*closes) memcpy(rho, F.trial, (size_t)m->N * sizeof *rho);
    }
    rg_flow_free(&F);
    return RG_OK;
}

/* A take of one frame: the state as its pattern says, which closes. */
static rg_status stand(const rg_states *q, const rg_mesh *m, const double *rho, rg_take *t)
{
    const size_t N = (size_t)m->N;
    memset(t, 0, sizeof *t);
    t->mem = q->mem;
    t->outcome = RG_FOLDED;
    t->method = "joint", t->solver = "none";
    rg_status s = rg_mesh_copy(m, &t->mesh);
    t->rho = rg_mem_array(&q->mem, N, sizeof *rho);
    t->from = rg_mem_array(&q->mem, N, sizeof *rho);
    t->target = rg_mem_array(&q->mem, N, sizeof *rho);
    if (s == RG_OK && t->rho && t->from && t->target) {
        memcpy(t->rho, rho, N * sizeof *rho);
        memcpy(t->target, rho, N * sizeof *rho);
        t->count = 1;
        return RG_OK;
    }
    rg_take_free(t);
    return RG_ENOMEM;
}

/* How a state folds from flat, by whatever folds it. */
static rg_status fold_alone(rg_states *q, int32_t k, int32_t frames, rg_watch *watch, rg_take *t, rg_diag *why)
{
    rg_settings s = q->settings;
    rg_choice c;
    s.frames = frames > 2 ? frames : 2;
    const rg_status status = rg_strategy_run(&c, &q->state[k], &s, watch, why);
    if (status != RG_OK) return status;
    add_cost(q, &c.cost);
    q->tries += c.tries;
    *t = c.take;
    return RG_OK;
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
    rg_watch watch = {tell, &progress, 0};
    rg_take t;
    int closes = 0, known = 1;
    double *rho = rg_mem_array(&q->mem, (size_t)m->N, sizeof *rho);
    if (!rho) return RG_ENOMEM;
    for (int32_t i = 0; i < m->N; i++) {
        rho[i] = q->settings.to * m->target[m->crease_edge[i]];
        known &= !isnan(rho[i]);
    }
    rg_status s = known ? close_up(q, m, rho, &closes) : RG_OK;
    if (s == RG_OK) s = closes ? stand(q, m, rho, &t) : fold_alone(q, 0, 2, &watch, &t, why);
    rg_mem_free(&q->mem, rho);
    if (s != RG_OK) return s;
    walk(q, &t, 0, 0, 0, 0);
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
    int from_closes, to_closes, from_flat, to_flat, triangles;
} leg;

static void leg_free(const rg_states *q, leg *w)
{
    rg_mesh_free(&w->mesh);
    rg_mem_free(&q->mem, w->from);
    rg_mem_free(&q->mem, w->to);
}

/* `coarse`'s angles, of[coarse->N], or its targets where of is NULL, as those of w->mesh. */
static rg_status angles_of(const rg_states *q, const leg *w, const rg_mesh *coarse, const double *of, double *rho)
{
    rg_overlay o;
    double *target = rg_mem_array(&q->mem, (size_t)coarse->N, sizeof *target);
    rg_status s = rg_overlay_init(&o, &w->mesh, coarse, q->tol);
    if (!target) s = RG_ENOMEM;
    for (int32_t i = 0; s == RG_OK && i < coarse->N; i++) target[i] = q->settings.to * coarse->target[coarse->crease_edge[i]];
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
        w->mesh.target[w->mesh.crease_edge[i]] = target == 0 ? NAN : target;
        w->mesh.assignment[w->mesh.crease_edge[i]] = target > 0 ? RG_VALLEY : target < 0 ? RG_MOUNTAIN : target == 0 ? RG_FLAT : RG_UNASSIGNED;
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
    w->triangles = 1;
    rg_lines_init(&l, &q->mem);
    l.merge = q->merge;
    rg_status s = rg_overlay_draw(&l, &q->state[k], 0, NULL);
    if (s == RG_OK) s = rg_overlay_draw(&l, next, 0, NULL);
    if (s == RG_OK) s = rg_overlay_draw(&l, now, 1, rho);
    if (s != RG_OK) rg_lines_free(&l);
    else s = rg_overlay_mesh(&l, &q->settings, &w->mesh, why);
    if (s != RG_OK) return s;
    w->from = rg_mem_array(&q->mem, (size_t)w->mesh.N, sizeof *w->from);
    w->to = rg_mem_array(&q->mem, (size_t)w->mesh.N, sizeof *w->to);
    if (!w->from || !w->to) return RG_ENOMEM;
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
    for (int32_t f = 0; f < w->mesh.nf; f++) w->triangles &= w->mesh.facet_start[f + 1] - w->mesh.facet_start[f] == 3;
    s = close_up(q, &w->mesh, w->from, &w->from_closes);
    if (s == RG_OK && known) s = close_up(q, &w->mesh, w->to, &w->to_closes);
    for (int32_t i = 0; !w->to_closes && i < w->mesh.N; i++) /* what a state does not close by is no way to go */
        if (fabs(w->to[i] - w->from[i]) <= SAME_STATE) w->to[i] = w->from[i];
    return s;
}

/* One law of the flow, from `from` to `to` or the other way around. */
static rg_status flow(const rg_states *q, const leg *w, const rg_flow_law *law, int all, int back, double work, rg_watch *watch,
                      rg_take *t, rg_diag *why)
{
    rg_settings settings = q->settings;
    rg_mesh m;
    settings.frames = w->frames;
    rg_status s = all ? rg_triangulate_all(&w->mesh, &m) : rg_mesh_copy(&w->mesh, &m);
    if (s != RG_OK) return s;
    double *from = rg_mem_array(&q->mem, (size_t)m.N, sizeof *from), *to = rg_mem_array(&q->mem, (size_t)m.N, sizeof *to);
    if (from && to) {
        for (int32_t i = 0; i < m.N; i++) {
            const int added = i >= w->mesh.N;
            from[i] = added ? 0 : back ? w->to[i] : w->from[i];
            to[i] = added ? NAN : back ? w->from[i] : w->to[i];
        }
        s = rg_take_flow(t, &m, &settings, law, from, to, NULL, work, watch, why);
    } else {
        rg_mesh_free(&m);
        s = RG_ENOMEM;
    }
    rg_mem_free(&q->mem, from);
    rg_mem_free(&q->mem, to);
    return s;
}

/* Is this way of trying one for these settings and this leg? */
static int applies(const rg_states *q, const leg *w, const rg_flow_law *law, int all, int back)
{
    const rg_triangulation cut = q->settings.triangulate;
    const int moves = law->gain > 0 || law->give > 0, may_cut = cut != RG_TRIANGULATE_NONE && !w->triangles;
    if (all ? !may_cut : cut == RG_TRIANGULATE_ALL && !w->triangles) return 0;
    if (moves && !all && may_cut) return 0;
    return !back || w->to_closes;
}

/* *best: the first that arrives, else the one forwards that comes farthest; its law is all zero where there is none. */
static rg_status direct(rg_states *q, const leg *w, rg_watch *watch, rg_take *best, int *backwards, rg_diag *why)
{
    rg_flow_law law;
    double work, spent = 0;
    rg_status s = RG_OK;
    for (int32_t n = 0, may; s == RG_OK && (may = rg_strategy_law(&q->settings, n, &law, &work)) >= 0; n++)
        for (int way = 0; may && s == RG_OK && way < 4; way++) {
            const int all = way / 2, back = way % 2;
            rg_take t;
            if (!applies(q, w, &law, all, back) || watch->cancelled || spent > MOST_WORK * work) continue;
            s = flow(q, w, &law, all, back, work, watch, &t, why);
            if (s != RG_OK) break;
            spent += t.work;
            q->tries++;
            add_cost(q, &t.cost);
            const int done = is_folded(&t);
            if (!done && (back || (best->mem.resize && !(t.score > best->score)))) {
                rg_take_free(&t);
                continue;
            }
            rg_take_free(best);
            *best = t;
            *backwards = back;
            if (done) return RG_OK;
        }
    return s;
}

/* ------------------------------------------------------------------------------------------------- legs ---- */

/* State k as it folds, backwards, then the next one, if that comes farther than `farthest` of the way. Either may be flat. */
static rg_status through_flat(rg_states *q, const leg *w, double farthest, rg_watch *watch, int *done, rg_diag *why)
{
    const int32_t k = w->k, all = w->frames - 1, down = w->from_flat ? 0 : w->to_flat ? all : all / 2, up = all - down;
    const double middle = k + (w->from_flat ? 0 : w->to_flat ? 1 : 0.5);
    rg_take unfold = {0}, fold = {0};
    rg_status s = w->from_flat ? RG_OK : fold_alone(q, k, down + 1, watch, &unfold, why);
    if (s == RG_OK && !w->from_flat && !is_folded(&unfold)) goto out;
    if (s == RG_OK && !w->to_flat) s = fold_alone(q, k + 1, up + 1, watch, &fold, why);
    if (s != RG_OK) goto out;
    const int arrives = w->to_flat || is_folded(&fold);
    if (!arrives && !(middle - k + (k + 1 - middle) * fold.score > farthest)) goto out;
    *done = 1;
    if (!w->from_flat) {
        walk(q, &unfold, 1, k, middle, w->to_flat ? k + 1 : -1);
        if (!down) q->stretch[q->stretches - 1].end_only = -1;
    }
    if (!w->to_flat) walk(q, &fold, 0, middle, k + 1, arrives ? k + 1 : -1);
    if (!w->from_flat && !w->to_flat) q->by_flat[q->by_flat_count++] = k + 1;
out:
    rg_take_free(&unfold);
    rg_take_free(&fold);
    return s;
}

/* A way of nothing takes its time too. */
static void fill_up(rg_take *t, int32_t frames)
{
    const size_t N = (size_t)t->mesh.N, nv = (size_t)t->mesh.nv;
    for (; t->count < frames; t->count++) {
        memcpy(t->rho + (size_t)t->count * N, t->rho + (size_t)(t->count - 1) * N, N * sizeof *t->rho);
        if (t->flat) memcpy(t->flat + (size_t)t->count * nv, t->flat + (size_t)(t->count - 1) * nv, nv * sizeof *t->flat);
    }
}

static rg_status go(rg_states *q, int32_t k, int32_t frames, rg_diag *why)
{
    share progress = {q, k};
    rg_watch watch = {tell, &progress, 0};
    rg_take best = {0};
    leg w;
    int backwards = 0, done = 0;
    rg_status s = leg_init(q, &w, k, frames, why);
    const int one_is_flat = w.from_flat != w.to_flat;
    if (s == RG_OK && one_is_flat) s = through_flat(q, &w, 1, &watch, &done, why);
    if (s == RG_OK && !done && w.from_closes) s = direct(q, &w, &watch, &best, &backwards, why);
    const int arrives = s == RG_OK && best.mem.resize && is_folded(&best);
    if (arrives) fill_up(&best, frames);
    if (s == RG_OK && !done && !arrives && !one_is_flat && !watch.cancelled)
        s = through_flat(q, &w, best.mem.resize ? best.score : -1, &watch, &done, why);
    if (s == RG_OK && !done) {
        if (!best.mem.resize) stop(q, k, "neither state closes on the lines of both");
        else walk(q, &best, backwards, k, k + 1, arrives ? k + 1 : -1);
    }
    if (s == RG_OK && q->outcome == RG_RUNNING) {
        const rg_stretch *last = &q->stretch[q->stretches - 1];
        if (last->reaches < 0) stop(q, k, watch.cancelled ? "interrupted" : last->take.reason);
    }
    rg_take_free(&best);
    leg_free(q, &w);
    return s;
}

static rg_status prepare(rg_states *q, const rg_pattern *const *pattern, rg_diag *why)
{
    const rg_settings *s = &q->settings;
    q->state = rg_mem_array(&q->mem, (size_t)q->count, sizeof *q->state);
    q->stretch = rg_mem_array(&q->mem, 2 * (size_t)q->count, sizeof *q->stretch);
    q->by_flat = rg_mem_array(&q->mem, (size_t)q->count, sizeof *q->by_flat);
    if (!q->state || !q->stretch || !q->by_flat) return RG_ENOMEM;
    for (int32_t k = 0; k < q->count; k++) {
        rg_diag where = {0, ""};
        rg_status status = rg_pattern_same_sheet(pattern[0], pattern[k], s, &where);
        if (status != RG_OK) return rg_fail(status, why, 0, "state %d: %s", (int)k + 1, where.text);
        q->merge = fmax(q->merge, pattern[k]->lines.merge);
        status = rg_mesh_from_pattern(pattern[k], &q->mem, &q->state[k], why);
        if (status != RG_OK) return status;
    }
    const double merge = s->merge == RG_MERGE_DEFAULT && q->merge > 0 ? q->merge : s->merge;
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
    snprintf(q->reason, sizeof q->reason, "folded%s%s", q->by_flat_count ? "; unfolded to flat where the direct way is blocked" : "",
             q->stretch[0].take.outcome == RG_FOLDED ? "" : "; from the first state only as far as it folds");
    return RG_OK;
}
