/* create.c -- from a pattern to its motion: the search, its frames, what is told of them. */
#include "base/clock.h"
#include "base/settings.h"
#include "base/status.h"
#include "base/text.h"
#include "motion/ending.h"
#include "motion/fold.h"
#include "motion/measure.h"
#include "motion/motion.h"
#include "motion/search.h"
#include "motion/stages.h"
#include "motion/unfolding.h"
#include "pattern/source.h"

#include <stdio.h>
#include <string.h>

/* A crease below the first has not left flat; within the second of half a turn it is at its limit. */
static const double LOCKED = 1e-6, AT_LIMIT = 0.5 * RG_DEG;

/* What a motion without contact may cost where there is one in stages, as a part of what it may else: of those that are
 * found at all then, none costs more than an eighth. */
static const double PART_WITH_STAGES = 0.15;

/* A place is the same though it was computed in another way: a part of the sheet's size. */
static const double SAME_VERTEX = 1e-9;

/* Of the creases that are held short: how many are locked flat, how many vertices' creases are at half a turn. */
static void count_held(const rg_motion *m, int32_t *locked, int32_t *at_limit)
{
    const double *rho = rg_motion_angles(m, m->report.frame_count - 1);
    *locked = *at_limit = 0;
    for (int32_t i = 0; i < m->report.blocking_crease_count; i++)
        *locked += fabs(rho[m->report.blocking_creases[i]]) <= LOCKED;
    for (int32_t i = 0; i < m->mesh.N - m->mesh.added; i++) *at_limit += fabs(rho[i]) >= RG_PI - AT_LIMIT;
}

/* A vertex that cannot be as it should: one that holds the fold, else any that misses its own targets, else any.
 * Theorems of folding flat do not count where only a part of the way is asked for. */
static void find_theorem(rg_motion *m, const rg_pattern *p)
{
    rg_report *r = &m->report;
    const rg_unfoldable *found = NULL;
    int best = 0;
    for (int32_t i = 0; i < p->unfoldables; i++) {
        const rg_unfoldable *u = &p->unfoldable[i];
        int rank = u->theorem == RG_TARGETS ? 2 : fabs(m->settings.to) == 1 ? 1 : 0;
        for (int32_t k = 0; rank > 0 && rank < 3 && k < r->blocking_vertex_count; k++) {
            const rg_vec2 at = m->mesh.X[r->blocking_vertices[k]];
            if (hypot(u->x - at.x, u->y - at.y) <= SAME_VERTEX * m->mesh.size) rank = 3;
        }
        if (rank > best) best = rank, found = u;
    }
    if (r->outcome != RG_STOPPED || !found) return;
    m->theorem = *found;
    r->theorem = &m->theorem;
}

/* Where and why the kept try is held, in words: the strongest vertex and what it is, the creases, what may help. */
static rg_status explain(rg_motion *m, const rg_pattern *p)
{
    rg_report *r = &m->report;
    if (r->outcome != RG_STOPPED || !r->blocking_vertex_count) return RG_OK;
    const rg_vec2 at = m->mesh.X[r->blocking_vertices[0]];
    const double x = r->blocking_at[0][0], y = r->blocking_at[0][1];
    int32_t creases = 0, closed = 0, locked, at_limit, ways;
    const rg_status s = rg_motion_mobility(m, r->frame_count - 1, &ways);
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < m->mesh.N - m->mesh.added; i++) {
        const int32_t *end = m->mesh.edge[m->mesh.crease_edge[i]];
        creases += end[0] == r->blocking_vertices[0] || end[1] == r->blocking_vertices[0];
    }
    for (int32_t i = 0; i < p->closed_triples; i++)
        closed |= hypot(p->closed[i].x - at.x, p->closed[i].y - at.y) <= SAME_VERTEX * m->mesh.size;
    count_held(m, &locked, &at_limit);
    const char *help = m->settings.triangulate == RG_TRIANGULATE_NONE ? "added creases may help"
                       : m->settings.adjust == 0                      ? "adjusting creases may help"
                                                                      : "nothing known helps";
    const size_t used = strlen(r->reason);
    rg_text(r->reason + used, sizeof r->reason - used,
            "; ways the sheet could go to first order: %d; held most at (%.6g, %.6g), a %svertex of %d creases "
            "(%d free); creases of the sheet locked flat: %d, at half a turn: %d; %s",
            (int)ways, x, y, closed ? "closed " : "", (int)creases, (int)(creases > 3 ? creases - 3 : 0), (int)locked,
            (int)at_limit, help);
    return RG_OK;
}

/* What the kept try has becomes the motion's; path: out, the rest of it, where it can be read off again; may be
 * NULL. */
static void take_over(rg_motion *m, rg_search *c, rg_attempt *path)
{
    rg_report *r = &m->report;
    rg_attempt *t = &c->best;
    m->mesh = t->mesh;
    m->target = t->target, m->from = t->from, m->rho = t->rho, m->flat = t->flat, m->gaps = t->gaps;
    m->blocking_vertex = t->vertex, m->blocking_crease = t->crease;
    r->blocking_vertex_count = t->vertices, r->blocking_crease_count = t->creases;
    r->frame_count = t->count;
    r->outcome = t->outcome;
    rg_text(r->reason, sizeof r->reason, "%s", t->reason);
    r->method = t->method, r->solver = t->solver;
    r->adjust_gain = t->relax ? t->relax->how.gain : 0;
    r->compliance = c->compliance;
    r->rung = c->rung, r->direction = c->direction;
    r->seconds_of_winning_try = t->cost.seconds;
    memset(&t->mesh, 0, sizeof t->mesh);
    t->target = t->from = t->rho = NULL, t->flat = NULL, t->vertex = t->crease = NULL;
    memset(&t->gaps, 0, sizeof t->gaps);
    if (path && t->due) {
        *path = *t;
        memset(t, 0, sizeof *t);
    }
    rg_attempt_free(t);
}

static rg_status adopt(rg_motion *m, rg_search *c, rg_attempt *path)
{
    rg_report *r = &m->report;
    take_over(m, c, path);
    r->triangulation = c->triangulation;
    r->why_triangulated = c->why_triangulated;
    rg_text(r->strategy, sizeof r->strategy, "%s", c->strategy);
    rg_search_tell(m, c->tries, &c->cost);
    const rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->tried, (size_t)c->tried_count),
                                      RG_ARRAY(m->frame, (size_t)r->frame_count),
                                      RG_ARRAY(m->blocking_at, (size_t)r->blocking_vertex_count));
    if (s != RG_OK) return s;
    memcpy(m->tried, c->tried, (size_t)c->tried_count * sizeof *m->tried);
    r->tried = m->tried;
    r->tried_count = c->tried_count;
    for (int32_t k = 0; k < r->blocking_vertex_count; k++)
        rg_motion_drawn(m, m->mesh.X[m->blocking_vertex[k]], m->blocking_at[k]);
    r->blocking_vertices = m->blocking_vertex;
    r->blocking_creases = m->blocking_crease;
    r->blocking_at = (const double(*)[2])m->blocking_at;
    r->frames = m->frame;
    return RG_OK;
}

/* In stages costs little, and is had first; all at once is better, and is looked for all the same, but not for as
 * long. */
static rg_status without_contact(rg_search *c, rg_stages *stages, const rg_mesh *none, const rg_settings *s,
                                 rg_watch *watch, rg_diag *why)
{
    rg_status status = rg_stages_try(stages, c, none, s, watch, why);
    const int had = stages->count > 0;
    if (status == RG_OK && !watch->cancelled)
        status = rg_unfolding_run(c, none, s, had ? PART_WITH_STAGES : 1, watch, why);
    if (had && c->rung == RG_UNFOLDED) rg_motion_free_stages(stages);
    return status;
}

/* The stages, as the report lends them; and what is whose in the file, where their mesh is finer than the pattern's. */
static rg_status adopt_stages(rg_motion *m, rg_stages *q)
{
    rg_report *r = &m->report;
    m->stages = *q;
    memset(q, 0, sizeof *q);
    r->stages = m->stages.count;
    r->stage = m->stages.stage;
    for (int32_t j = 0; j < r->stages; j++) /* their folds stand one after the other */
        for (int32_t k = 0; k < r->stage[j].folds; k++)
            for (int i = 0; m->source.y_down && i < 2; i++) {
                double *y = &m->stages.fold[r->stage[j].fold - m->stages.fold + k].line[i][1];
                *y = 0 - *y;
            }
    if (!m->stages.vertex) return RG_OK;
    return rg_source_follow(&m->source, m->mesh.nv, m->stages.vertex, m->mesh.ne, m->stages.edge);
}

/* Fills the mesh, the frames and what is told of how they were found. */
static rg_status find(rg_motion *m, const rg_pattern *p, rg_watch *watch, rg_attempt *path, rg_diag *why)
{
    const rg_settings *settings = &m->settings;
    rg_search search = {0};
    rg_stages stages = {0};
    rg_mesh none = {0};
    int wanted = 0;
    rg_status s = rg_mesh_from_pattern(p, &m->mem, &none, why);
    const rg_problem problem = {&none, NULL, NULL, 1, path != NULL};
    if (s == RG_OK) s = rg_search_run(&search, &problem, settings, watch, why);
    if (s == RG_OK) s = rg_unfolding_wanted(&search, &none, settings, watch, &wanted, why);
    if (s == RG_OK && wanted) s = without_contact(&search, &stages, &none, settings, watch, why);
    if (s == RG_OK) s = rg_attempt_read(&search.best, settings);
    if (s == RG_OK) s = adopt(m, &search, path);
    if (s == RG_OK) s = adopt_stages(m, &stages);
    rg_motion_free_stages(&stages);
    rg_attempt_free(&search.best);
    rg_mesh_free(&none);
    return s;
}

/* There is no crease left of those that are drawn. */
static void tell_lost(rg_report *r)
{
    const int lost = (int)r->pattern->lost_creases;
    r->outcome = RG_STOPPED;
    if (lost == 1)
        rg_text(r->reason, sizeof r->reason,
                "no crease is left to fold: the only one drawn ends short of the next line, or lies on the border");
    else
        rg_text(r->reason, sizeof r->reason,
                "no crease is left to fold: all %d that are drawn end short of the next line, or lie on the border",
                lost);
}

rg_status rg_motion_with_path(const rg_pattern *p, const rg_settings *given, rg_progress progress, void *ctx,
                              rg_motion **motion, rg_attempt *path, rg_diag *why)
{
    const double begun = rg_seconds();
    rg_settings mine, *const settings = &mine;
    rg_status s = rg_settings_take(given, settings, why);
    if (s != RG_OK) return s;
    const rg_memory mem = rg_mem_default(settings->memory);
    rg_motion *m = rg_mem_array(&mem, 1, sizeof *m);
    if (!m) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->mem = mem;
    m->settings = *settings;
    const rg_report *r = &m->report;
    rg_rising told = {progress, ctx, 0};
    rg_watch watch = {.progress = progress ? rg_watch_rising : NULL, .ctx = &told};
    s = rg_motion_name(m, rg_pattern_get_info(p));
    if (s == RG_OK) s = rg_source_copy(&p->source, &mem, &m->source);
    if (s == RG_OK) s = find(m, p, &watch, path, why);
    if (s == RG_OK) s = rg_motion_lend(m);
    if (s == RG_OK) s = rg_motion_hang(m, why);
    if (s == RG_OK) s = rg_measure_frames(m, &watch);
    if (s == RG_OK) s = rg_ending_find(m, &watch, why);
    if (s == RG_OK && !watch.cancelled) find_theorem(m, p);
    if (s == RG_OK && !watch.cancelled) s = explain(m, p);
    if (s == RG_OK && r->pattern->creases == 0 && r->pattern->lost_creases > 0) tell_lost(&m->report);
    if (s != RG_OK) {
        if (path) rg_attempt_free(path);
        rg_motion_destroy(m);
        return s == RG_ENOMEM ? rg_fail(s, why, 0, "out of memory") : s;
    }
    m->report.seconds_total = rg_seconds() - begun;
    *motion = m;
    return RG_OK;
}

rg_status rg_motion_create(const rg_pattern *p, const rg_settings *settings, rg_progress progress, void *ctx,
                           rg_motion **motion, rg_diag *why)
{
    return rg_motion_with_path(p, settings, progress, ctx, motion, NULL, why);
}

/* ---------------------------------------------------------------------------------------- flat, to be steered ---- */

static rg_status lay_out(rg_motion *m, const rg_pattern *p, rg_diag *why)
{
    rg_report *r = &m->report;
    const int cuts = m->settings.triangulate == RG_TRIANGULATE_ALL;
    rg_mesh none = {0};
    rg_status s = rg_motion_name(m, rg_pattern_get_info(p));
    if (s == RG_OK) s = rg_source_copy(&p->source, &m->mem, &m->source);
    if (s == RG_OK) s = rg_mesh_from_pattern(p, &m->mem, &none, why);
    if (s == RG_OK) s = cuts ? rg_triangulate_all(&none, &m->mesh) : rg_mesh_copy(&none, &m->mesh);
    rg_mesh_free(&none);
    if (s != RG_OK) return s;
    const size_t N = (size_t)m->mesh.N;
    if (RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->target, N), RG_ARRAY(m->from, N), RG_ARRAY(m->rho, N),
                      RG_ARRAY(m->frame, 1)) != RG_OK) return RG_ENOMEM;
    for (int32_t i = 0; i < m->mesh.N; i++)
        m->target[i] = i < m->mesh.N - m->mesh.added ? m->settings.to * m->mesh.target[m->mesh.crease_edge[i]] : NAN;
    r->frame_count = 1;
    r->frames = m->frame;
    r->added_creases = m->mesh.added, r->unknowns = m->mesh.N, r->constraints = 3 * m->mesh.M;
    r->triangulation = cuts ? "all" : "none";
    r->why_triangulated = cuts ? "asked for" : "as drawn";
    r->method = r->solver = r->rung = r->direction = r->layers = r->layer_orders = r->layers_reason = "";
    r->outcome = RG_RUNNING;
    s = rg_motion_hang(m, why);
    if (s == RG_OK) s = rg_motion_lend(m);
    return s == RG_OK ? rg_measure_frames(m, NULL) : s;
}

rg_status rg_motion_unfolded(const rg_pattern *p, const rg_settings *settings, rg_motion **motion, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(settings->memory);
    rg_motion *m = rg_mem_array(&mem, 1, sizeof *m);
    if (!m) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->mem = mem;
    m->settings = *settings;
    const rg_status s = lay_out(m, p, why);
    if (s == RG_OK) *motion = m;
    else rg_motion_destroy(m);
    return s == RG_ENOMEM ? rg_fail(s, why, 0, "out of memory") : s;
}
