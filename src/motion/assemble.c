#include "motion/assemble.h"
#include "base/clock.h"
#include "base/settings.h"
#include "base/status.h"
#include "motion/ending.h"
#include "motion/measure.h"

#include <stdio.h>
#include <string.h>

/* A vertex that is this part of the sheet off where an attempt has it has not moved. */
static const double IN_PLACE = 1e-12;
/* A way this short, radians, is what a drawing does not close by. */
static const double NO_WAY = 0.02;

/* ------------------------------------------------------------------------------------------------ the mesh ---- */

/* Creases of states first: those that attempts added come last, and are the mesh's added ones. */
static rg_status make_mesh(rg_motion *m, const rg_states *q, rg_diag *why)
{
    rg_lines l;
    rg_status s = RG_OK;
    rg_lines_init(&l, &m->mem);
    l.merge = q->merge;
    for (int32_t k = 0; s == RG_OK && k < q->count; k++) s = rg_overlay_draw(&l, &q->state[k], 0, NULL);
    for (int32_t j = 0; s == RG_OK && j < q->stretches; j++)
        s = rg_overlay_draw(&l, &q->stretch[j].attempt.mesh, 1, NULL);
    if (s == RG_OK) return rg_overlay_mesh(&l, q->asked, &m->mesh, why);
    rg_lines_free(&l);
    return s;
}

/* The last state's assignments and targets; `made` says which creases are some state's. */
static void assign(rg_motion *m, const rg_mesh *last, const rg_overlay *o, const unsigned char *made)
{
    rg_mesh *mesh = &m->mesh;
    for (int32_t i = 0; i < mesh->N; i++) {
        const int32_t e = mesh->crease_edge[i], of = o->crease[i] < 0 ? -1 : last->crease_edge[o->crease[i]];
        mesh->assignment[e] = of < 0 ? RG_FLAT : last->assignment[of];
        mesh->target[e] = of < 0 ? NAN : last->target[of];
        m->target[i] = of >= 0 ? m->settings.to * last->target[of] : made[i] ? 0 : NAN;
    }
    while (mesh->added < mesh->N && !made[mesh->N - 1 - mesh->added]) mesh->added++;
}

static rg_status aim(rg_motion *m, const rg_states *q)
{
    const int32_t N = m->mesh.N;
    unsigned char *made;
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(made, (size_t)N), RG_ARRAY(m->target, (size_t)N),
                                RG_ARRAY(m->from, (size_t)N));
    for (int32_t k = 0; s == RG_OK && k < q->count; k++) {
        rg_overlay o;
        s = rg_overlay_init(&o, &m->mesh, &q->state[k], q->tol);
        for (int32_t i = 0; s == RG_OK && i < N; i++) made[i] |= o.crease[i] >= 0;
        if (s == RG_OK && k == q->count - 1) assign(m, &q->state[k], &o, made);
        rg_overlay_free(&o);
    }
    rg_mem_free(&m->mem, made);
    return s;
}

/* -------------------------------------------------------------------------------------------------- frames ---- */

/* Does the attempt have the mesh's vertices where the mesh has them? X[nv]: scratch. */
static int in_place(const rg_motion *m, const rg_overlay *o, const rg_attempt *t, rg_vec2 *X)
{
    if (t->flat) return 0;
    rg_overlay_points(o, t->mesh.X, X);
    for (int32_t v = 0; v < m->mesh.nv; v++)
        if (!(rg_vec2_length(rg_vec2_sub(X[v], m->mesh.X[v])) <= IN_PLACE * m->mesh.size)) return 0;
    return 1;
}

/* Mean and least part of its creases' ways that an attempt has done at a frame. */
static double part_done(const rg_attempt *t, int32_t frame, double *least)
{
    const double *rho = rg_attempt_angles(t, frame);
    double sum = 0;
    int32_t n = 0;
    *least = INFINITY;
    for (int32_t i = 0; i < t->mesh.N; i++) {
        const double way = t->target[i] - t->from[i];
        if (!(fabs(way) > NO_WAY)) continue;
        const double part = fmin(1, (rho[i] - t->from[i]) / way); /* none for more than all of it */
        sum += part;
        *least = fmin(*least, part);
        n++;
    }
    if (!n) *least = t->count > 1 ? (double)frame / (t->count - 1) : 1;
    return n ? sum / n : *least;
}

/* Frame k of stretch j, as frame f of the motion. */
static void put(rg_motion *m, const rg_states *q, const rg_stretch *s, const rg_overlay *o, int32_t k, int32_t f)
{
    const rg_attempt *t = &s->attempt;
    const int32_t frame = rg_stretch_frame(s, k), ways = q->count - 1;
    double least, done = part_done(t, frame, &least);
    rg_overlay_angles(o, rg_attempt_angles(t, frame), m->rho + (size_t)f * (size_t)m->mesh.N);
    if (m->flat) rg_overlay_points(o, rg_attempt_pattern(t, frame), m->flat + (size_t)f * (size_t)m->mesh.nv);
    if (s->backwards) done = fmin(1, 1 - done), least = done;
    m->frame[f].percent = 100 * (s->begin + done * (s->end - s->begin)) / ways;
    m->report.folded_percent = m->frame[f].percent;
    m->report.least_folded_percent = 100 * (s->begin + least * (s->end - s->begin)) / ways;
}

/* What the attempt that stopped is held by, as vertices and creases of the motion. */
static rg_status block(rg_motion *m, const rg_attempt *t, const rg_overlay *o)
{
    rg_report *r = &m->report;
    const rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->blocking_vertex, (size_t)t->vertices),
                                      RG_ARRAY(m->blocking_crease, (size_t)m->mesh.N),
                                      RG_ARRAY(m->blocking_at, (size_t)t->vertices));
    if (s != RG_OK) return s;
    for (int32_t n = 0; n < t->vertices; n++)
        for (int32_t v = 0; v < m->mesh.nv && r->blocking_vertex_count < t->vertices; v++) {
            if (o->spot[v].n != 1 || o->spot[v].at[0] != t->vertex[n]) continue;
            rg_motion_drawn(m, m->mesh.X[v], m->blocking_at[r->blocking_vertex_count]);
            m->blocking_vertex[r->blocking_vertex_count++] = v;
        }
    for (int32_t i = 0; i < m->mesh.N; i++)
        for (int32_t n = 0; n < t->creases; n++)
            if (o->crease[i] == t->crease[n]) m->blocking_crease[r->blocking_crease_count++] = i;
    r->blocking_vertices = m->blocking_vertex;
    r->blocking_creases = m->blocking_crease;
    r->blocking_at = (const double(*)[2])m->blocking_at;
    return RG_OK;
}

/* The states before frame k of a stretch, as those before frame f of the motion. rho[N], X[nv]: scratch. */
static rg_status put_between(rg_motion *m, const rg_stretch *s, const rg_overlay *o, int32_t k, int32_t f, double *rho,
                             rg_vec2 *X)
{
    const rg_attempt *t = &s->attempt;
    const rg_gaps *g = &t->gaps;
    const int32_t frame = rg_stretch_frame(s, k), after = s->backwards ? frame : frame - 1;
    rg_status status = RG_OK;
    if (s->end_only || f == 0) return RG_OK;
    for (int32_t i = 0; status == RG_OK && i < g->count; i++) {
        const int32_t j = s->backwards ? g->count - 1 - i : i;
        if (g->after[j] != after) continue;
        rg_overlay_angles(o, rg_gaps_angles(g, &t->mesh, j), rho);
        rg_overlay_points(o, rg_gaps_pattern(g, &t->mesh, j), X);
        status = rg_gaps_add(&m->gaps, &m->mem, &m->mesh, f - 1, rho, m->flat ? X : NULL);
    }
    return status;
}

static rg_status put_stretch(rg_motion *m, const rg_states *q, const rg_stretch *s, const rg_overlay *o)
{
    double *rho;
    rg_vec2 *X;
    rg_status status = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(rho, (size_t)m->mesh.N), RG_ARRAY(X, (size_t)m->mesh.nv));
    for (int32_t k = 0; status == RG_OK && k < rg_stretch_frames(s); k++) {
        const int32_t f = m->report.frame_count++;
        status = put_between(m, s, o, k, f, rho, X);
        put(m, q, s, o, k, f);
    }
    RG_MEM_FREE(&m->mem, rho, X);
    return status;
}

static rg_status fill(rg_motion *m, const rg_states *q, const rg_overlay *o)
{
    const size_t N = (size_t)m->mesh.N, nv = (size_t)m->mesh.nv;
    rg_report *r = &m->report;
    int moves = 0;
    size_t frames = 0;
    rg_vec2 *X = rg_mem_array(&m->mem, nv, sizeof *X);
    if (!X) return RG_ENOMEM;
    for (int32_t j = 0; j < q->stretches; j++) {
        frames += (size_t)rg_stretch_frames(&q->stretch[j]);
        moves |= !in_place(m, &o[j], &q->stretch[j].attempt, X);
    }
    rg_mem_free(&m->mem, X);
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->rho, frames * N), RG_ARRAY(m->frame, frames),
                                RG_ARRAY(m->state_frame, (size_t)q->count), RG_ARRAY(m->by_flat, (size_t)q->count));
    if (s == RG_OK && moves) s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->flat, frames * nv));
    for (int32_t j = 0; s == RG_OK && j < q->stretches; j++) {
        s = put_stretch(m, q, &q->stretch[j], &o[j]);
        if (s == RG_OK && q->stretch[j].reaches >= 0) m->state_frame[r->states_reached++] = r->frame_count - 1;
    }
    if (s != RG_OK) return s;
    memcpy(m->from, m->rho, N * sizeof *m->from);
    memcpy(m->by_flat, q->by_flat, (size_t)q->by_flat_count * sizeof *m->by_flat);
    return block(m, &q->stretch[q->stretches - 1].attempt, &o[q->stretches - 1]);
}

static void tell(rg_motion *m, const rg_states *q)
{
    rg_report *r = &m->report;
    const rg_attempt *last = &q->stretch[q->stretches - 1].attempt;
    for (int32_t j = 0; j < q->stretches; j++) {
        r->adjust_gain = fmax(r->adjust_gain, q->stretch[j].gain);
        r->compliance = fmax(r->compliance, q->stretch[j].compliance);
    }
    r->frames = m->frame;
    r->states = q->count;
    r->state_frame = m->state_frame;
    r->by_flat = m->by_flat;
    r->by_flat_count = q->by_flat_count;
    r->outcome = q->outcome;
    snprintf(r->reason, sizeof r->reason, "%s", q->reason);
    r->method = last->method, r->solver = last->solver;
    r->triangulation = m->mesh.added ? "all" : "none";
    r->why_triangulated = m->mesh.added ? "stops short without added creases" : "goes without added creases";
    rg_search_tell(m, q->tries, &q->cost);
    const char *how = q->by_flat_count == 0              ? "directly from state to state"
                      : q->by_flat_count == q->count - 1 ? "through flat"
                                                         : "directly and through flat";
    snprintf(r->strategy, sizeof r->strategy, "%s%s", how,
             r->adjust_gain > 0 || r->compliance > 0 ? ", the pattern gives way" : "");
}

rg_status rg_assemble_frames(rg_motion *m, const rg_states *q, rg_diag *why)
{
    rg_status s = make_mesh(m, q, why);
    if (s == RG_OK) s = aim(m, q);
    if (s != RG_OK) return s;
    rg_overlay *o = rg_mem_array(&m->mem, (size_t)q->stretches, sizeof *o);
    if (!o) return RG_ENOMEM;
    for (int32_t j = 0; s == RG_OK && j < q->stretches; j++)
        s = rg_overlay_init(&o[j], &m->mesh, &q->stretch[j].attempt.mesh, q->tol);
    if (s == RG_OK) s = fill(m, q, o);
    if (s == RG_OK) tell(m, q);
    for (int32_t j = 0; j < q->stretches; j++) rg_overlay_free(&o[j]);
    rg_mem_free(&m->mem, o);
    return s;
}

/* ---------------------------------------------------------------------------------------------- the motion ---- */

/* Measuring goes by angles from one state to one other; of a sequence, it is the way that counts. */
static rg_status measure(rg_motion *m, rg_watch *watch)
{
    rg_report *r = &m->report;
    const double folded = r->folded_percent, least = r->least_folded_percent;
    double *percent = rg_mem_array(&m->mem, (size_t)r->frame_count, sizeof *percent);
    if (!percent) return RG_ENOMEM;
    for (int32_t k = 0; k < r->frame_count; k++) percent[k] = m->frame[k].percent;
    const rg_status s = rg_measure_frames(m, watch);
    for (int32_t k = 0; k < r->frame_count; k++) m->frame[k].percent = percent[k];
    r->folded_percent = folded;
    r->least_folded_percent = least;
    rg_mem_free(&m->mem, percent);
    return s;
}

static rg_status make(rg_motion *m, const rg_states *q, const rg_pattern *last, rg_watch *watch, rg_diag *why)
{
    rg_status s = rg_motion_name(m, rg_pattern_get_info(last));
    if (s == RG_OK) s = rg_assemble_frames(m, q, why);
    if (s != RG_OK) return s;
    s = rg_motion_lend(m);
    if (s == RG_OK) s = rg_motion_hang(m, why);
    if (s == RG_OK) s = measure(m, watch);
    return s == RG_OK ? rg_ending_find(m, watch, why) : s;
}

rg_status rg_motion_create_states(const rg_pattern *const *states, int32_t count, const rg_settings *given,
                                  rg_progress progress, void *ctx, rg_motion **motion, rg_diag *why)
{
    const double begun = rg_seconds();
    rg_settings mine, *const settings = &mine;
    if (count < 1) return rg_fail(RG_EARG, why, 0, "there must be at least one state");
    if (count == 1) return rg_motion_create(states[0], given, progress, ctx, motion, why);
    rg_status s = rg_settings_take(given, settings, why);
    if (s != RG_OK) return s;
    const rg_memory mem = rg_mem_default(settings->memory);
    rg_motion *m = rg_mem_array(&mem, 1, sizeof *m);
    if (!m) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->mem = mem;
    m->settings = *settings;
    m->source.y_down = states[0]->lines.y_down;
    rg_states q;
    rg_rising told = {progress, ctx, 0};
    rg_watch watch = {.progress = progress ? rg_watch_rising : NULL, .ctx = &told};
    s = rg_states_run(&q, states, count, settings, watch.progress, &told, why);
    if (s == RG_OK) s = make(m, &q, states[count - 1], &watch, why);
    rg_states_free(&q);
    if (s != RG_OK) {
        rg_motion_destroy(m);
        return s == RG_ENOMEM ? rg_fail(s, why, 0, "out of memory") : s;
    }
    m->report.seconds_total = rg_seconds() - begun;
    *motion = m;
    return RG_OK;
}
