#include "motion/stages.h"
#include "base/status.h"
#include "fold/tuning.h"
#include "motion/overlay.h"
#include "motion/rectify.h"
#include "motion/undone.h"
#include "motion/unfolding.h"

#include <stdio.h>
#include <string.h>

/* What is left is folded from its end, in the order that the simple folds go on from; or in any, where others may go on
 * from that; or as plainly as it goes. The first two may cost these parts of the work of the whole. */
typedef enum way_to_fold { BY_NUMBER, ANY_ORDER, PLAIN } way_to_fold;
static const double PART_OF_WORK[] = {1, 0.3};
/* ... and the last is for what has at most this part of the creases: of the whole it was tried, and crosses or
 * stops. */
static const double PART_FOR_PLAIN = 0.5;
/* States in which the first stage is read off at least, evenly in the largest angle that turns: frames are some of
 * them. */
static const int32_t LEAST_READ = 121;
/* A simple fold has half the frames that as much turning has otherwise: its states between frames are known. */
static const double A_SIMPLE_FOLD = RG_PI / 2;
/* Facets put a vertex apart by this part of the sheet's size at most, in frames of the first stage. */
static const double CLOSED = 1e-11;
/* The first stage ends in its flat state, radians and parts of the sheet's size. */
static const double AT_END = 1e-6;
/* Of the drawing's size: points that are the same, in one drawing and in two. */
static const double SAME_POINT = 1e-9, TWO_DRAWINGS = 4e-5;

typedef struct work {
    rg_memory mem;
    const rg_settings *settings;
    rg_undone u;             /* the simple folds, and what is left to be folded before them */
    rg_mesh base;            /* what is folded first, all at once */
    rg_search search;        /* ... and how; its frames are read off */
    rg_mesh fine;            /* of the whole motion */
    rg_vec2 *X;              /* [fine nv] the pattern that closes */
    rg_overlay of_base, of_drawn; /* of fine */
    int32_t *stage;          /* [fine N] as rg_simple's */
    double *end;             /* [fine N] */
    int32_t frames, *first_frame; /* [stages + 2] */
    double *begins;               /* [stages + 2] in frames, where they need not be whole numbers */
} work;

static void work_free(work *w)
{
    rg_undone_free(&w->u);
    if (w->base.mem.resize) rg_mesh_free(&w->base);
    if (w->fine.mem.resize) rg_mesh_free(&w->fine);
    rg_attempt_free(&w->search.best);
    rg_overlay_free(&w->of_base);
    rg_overlay_free(&w->of_drawn);
    RG_MEM_FREE(&w->mem, w->X, w->stage, w->end, w->first_frame, w->begins);
}

/* ------------------------------------------------------------------------------------------- the first stage ---- */

/* The creases of the first stage alone. */
static rg_status draw_base(work *w, rg_diag *why)
{
    const rg_mesh *m = &w->u.drawn;
    rg_lines l;
    rg_status s = RG_OK;
    rg_lines_init(&l, &w->mem);
    for (int32_t e = 0; s == RG_OK && e < m->ne; e++) {
        const int32_t i = m->edge_crease[e];
        if (i >= 0 && w->u.simple.stage[e] != 0) continue;
        const char letter = i < 0 ? RG_BORDER : w->u.sign * w->u.angle[i] > 0 ? RG_VALLEY : RG_MOUNTAIN;
        s = rg_lines_add(&l, m->X[m->edge[e][0]], m->X[m->edge[e][1]], letter, 0);
    }
    if (s == RG_OK) return rg_overlay_mesh(&l, SAME_POINT, &w->base, why);
    rg_lines_free(&l);
    return s;
}

/* Frames that are read off a path between its states do not close as well everywhere; of many, those are left out. */
static rg_status drop_open_frames(rg_attempt *t)
{
    const rg_mesh *m = &t->mesh;
    const size_t N = (size_t)m->N, nv = (size_t)m->nv;
    rg_tree tree = {0};
    rg_place *place = rg_mem_array(&t->mem, (size_t)m->nf, sizeof *place);
    const rg_status s = place ? rg_tree_init(m, -1, &tree) : RG_ENOMEM;
    int32_t kept = 0;
    for (int32_t k = 0; s == RG_OK && k < t->count; k++) {
        const double *rho = rg_attempt_angles(t, k);
        const rg_vec2 *X = rg_attempt_pattern(t, k);
        rg_pose_facets(m, X, &tree, rho, place);
        if (!(rg_pose_gap(X, &tree, place) <= CLOSED * m->size)) continue;
        memmove(t->rho + (size_t)kept * N, rho, N * sizeof *rho);
        if (t->flat) memmove(t->flat + (size_t)kept * nv, X, nv * sizeof *X);
        kept++;
    }
    if (s == RG_OK) t->count = kept;
    rg_gaps_free(&t->gaps, &t->mem);
    if (tree.mem.resize) rg_tree_free(&tree);
    rg_mem_free(&t->mem, place);
    return s;
}

/* Is what was found folded, free, exactly on the pattern at its end, and, unless that is known, in the order that is
 * needed? */
static rg_status is_good(work *w, rg_search *c, int order_is_known, int *good)
{
    rg_attempt *t = &c->best;
    int32_t crossing = -1;
    *good = 0;
    if (!t->mem.resize || !rg_search_is_folded(t) || t->outcome != RG_FOLDED) return RG_OK;
    rg_settings read = *w->settings;
    read.frames = w->settings->frames > LEAST_READ ? w->settings->frames : LEAST_READ;
    read.pace = RG_PACE_STEADY;
    rg_status s = rg_unfolding_crosses(t, w->settings, NULL, &crossing);
    if (s == RG_OK && crossing < 0) s = rg_attempt_read(t, &read);
    if (s == RG_OK && crossing < 0) s = drop_open_frames(t);
    if (s != RG_OK || crossing >= 0 || t->count < LEAST_READ / 2) return s;
    const rg_mesh *m = &t->mesh;
    const double *rho = rg_attempt_angles(t, t->count - 1);
    const rg_vec2 *X = rg_attempt_pattern(t, t->count - 1);
    for (int32_t i = 0; i < m->N; i++) {
        const double end = i < m->N - m->added ? w->u.sign * m->target[m->crease_edge[i]] : 0;
        if (!(fabs(rho[i] - end) <= AT_END)) return RG_OK;
    }
    for (int32_t v = 0; v < m->nv; v++)
        if (!(rg_vec2_length(rg_vec2_sub(X[v], m->X[v])) <= AT_END * m->size)) return RG_OK;
    *good = order_is_known;
    return order_is_known ? RG_OK : rg_undone_go_on(&w->u, t, good);
}

/* One way to fold the first stage. */
static rg_status fold_by(work *w, way_to_fold how, rg_watch *watch, int *good, rg_diag *why)
{
    const rg_problem problem = {&w->base, NULL, NULL, 1, 0};
    rg_search c = {0};
    rg_settings with = *w->settings;
    int64_t number = -1;
    rg_status s = how == BY_NUMBER ? rg_undone_number(&w->u, &w->base, &number) : RG_OK;
    if (how == BY_NUMBER && number < 0) return s;
    if (how == PLAIN && !(w->u.simple.base <= PART_FOR_PLAIN * w->u.none->N)) return s;
    with.layer_order = (int32_t)number;
    with.frames = with.frames > LEAST_READ ? with.frames : LEAST_READ;
    with.pace = RG_PACE_STEADY;
    if (s == RG_OK && how != PLAIN) s = rg_unfolding_run(&c, &w->base, &with, PART_OF_WORK[how], watch, why);
    if (s == RG_OK && how == PLAIN) {
        with.effort = RG_EFFORT_FAST;
        s = rg_search_run(&c, &problem, &with, watch, why);
    }
    c.tries += w->search.tries;
    rg_cost_add(&c.cost, &w->search.cost);
    rg_attempt_free(&w->search.best);
    w->search = c;
    return s == RG_OK ? is_good(w, &w->search, how == BY_NUMBER, good) : s;
}

static rg_status fold_base(work *w, rg_watch *watch, int *good, rg_diag *why)
{
    const int may_bend = w->settings->adjust != 0 && w->settings->triangulate != RG_TRIANGULATE_NONE;
    rg_status s = RG_OK;
    *good = 0;
    for (int how = may_bend ? BY_NUMBER : PLAIN; s == RG_OK && !*good && how <= PLAIN && !watch->cancelled; how++)
        s = fold_by(w, how, watch, good, why);
    return s;
}

/* -------------------------------------------------------------------------------------------- one mesh for all ---- */

/* The creases of `drawn`, and those that were added to fold what comes first. */
static rg_status make_mesh(work *w, rg_diag *why)
{
    const rg_mesh *t = &w->search.best.mesh;
    rg_lines l;
    if (!t->mem.resize || t->added == 0) return rg_mesh_copy(&w->u.drawn, &w->fine);
    rg_lines_init(&l, &w->mem);
    rg_status s = rg_overlay_draw(&l, &w->u.drawn, 0, NULL);
    if (s == RG_OK) s = rg_overlay_draw(&l, t, 1, NULL);
    if (s == RG_OK) return rg_overlay_mesh(&l, RG_MERGE_DEFAULT, &w->fine, why);
    rg_lines_free(&l);
    return s;
}

/* Which crease of the drawing each is a part of, when it is folded, and how far. */
static rg_status overlay(work *w)
{
    rg_mesh *m = &w->fine;
    const double tol = TWO_DRAWINGS * w->u.drawn.size;
    rg_status s = rg_overlay_init(&w->of_drawn, m, &w->u.drawn, tol);
    if (s == RG_OK && w->u.simple.base > 0) s = rg_overlay_init(&w->of_base, m, &w->search.best.mesh, tol);
    if (s == RG_OK) s = RG_MEM_ARRAYS(&w->mem, RG_ARRAY(w->stage, (size_t)m->N), RG_ARRAY(w->end, (size_t)m->N),
                                      RG_ARRAY(w->X, (size_t)m->nv));
    if (s != RG_OK) return s;
    memcpy(w->X, m->X, (size_t)m->nv * sizeof *m->X);
    if (w->u.moved > 0) rg_overlay_points(&w->of_drawn, w->u.none->X, m->X);
    rg_mesh_sectors(m, m->X, m->loop_theta);
    int32_t last = -1;
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t c = w->of_drawn.crease[i], e = m->crease_edge[i], of = c < 0 ? -1 : w->u.drawn.crease_edge[c];
        w->stage[i] = c < 0 ? -1 : w->u.simple.stage[of];
        w->end[i] = c < 0 ? 0 : w->u.angle[c];
        m->assignment[e] = c < 0 ? RG_FLAT : w->u.drawn.assignment[of];
        m->target[e] = c < 0 ? NAN : w->u.drawn.target[of];
        if (c >= 0) last = i;
    }
    m->added = m->N - 1 - last;
    return RG_OK;
}

/* Which vertices and edges of the drawing they are. */
static rg_status trace(const work *w, rg_stages *q)
{
    const rg_mesh *m = &w->fine, *d = &w->u.drawn;
    const double tol = TWO_DRAWINGS * d->size;
    if (m->N == d->N && m->nv == d->nv) return RG_OK;
    if (RG_MEM_ARRAYS(&q->mem, RG_ARRAY(q->vertex, (size_t)m->nv),
                      RG_ARRAY(q->edge, (size_t)m->ne)) != RG_OK) return RG_ENOMEM;
    for (int32_t v = 0; v < m->nv; v++) q->vertex[v] = w->of_drawn.spot[v].n == 1 ? w->of_drawn.spot[v].at[0] : -1;
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t i = m->edge_crease[e];
        q->edge[e] = i < 0 || w->of_drawn.crease[i] < 0 ? -1 : d->crease_edge[w->of_drawn.crease[i]];
        for (int32_t g = 0; i < 0 && g < d->ne && q->edge[e] < 0; g++) {
            if (d->edge_crease[g] >= 0) continue;
            const rg_vec2 a = d->X[d->edge[g][0]], b = d->X[d->edge[g][1]];
            const rg_vec2 p = w->X[m->edge[e][0]], r = w->X[m->edge[e][1]], x = {(p.x + r.x) / 2, (p.y + r.y) / 2};
            const int on_line = fabs(rg_vec2_turn(a, b, x)) <= tol * rg_vec2_length(rg_vec2_sub(b, a));
            if (on_line && rg_vec2_dot(rg_vec2_sub(x, a), rg_vec2_sub(x, b)) < 0) q->edge[e] = g;
        }
    }
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------------------- frames ---- */

/* How far creases turn in the first stage: the sum of the most that one turns from state to state. */
static double turned_at_first(const rg_attempt *t)
{
    double sum = 0;
    for (int32_t k = 1; k < t->count; k++)
        sum += rg_gaps_turn(t->mesh.N, rg_attempt_angles(t, k - 1), rg_attempt_angles(t, k));
    return sum;
}

/* Frames are even in the largest angle that a crease turns, but for simple folds; the states between stages are frames,
 * where there are enough of them for each stage to have one. */
static rg_status share_frames(work *w)
{
    const int32_t stages = w->u.simple.stages, legs = w->settings->frames - 1;
    const double first = w->u.simple.base > 0 ? turned_at_first(&w->search.best) : 0;
    const double all = first + A_SIMPLE_FOLD * stages;
    w->frames = w->settings->frames;
    if (RG_MEM_ARRAYS(&w->mem, RG_ARRAY(w->first_frame, (size_t)stages + 2),
                      RG_ARRAY(w->begins, (size_t)stages + 2)) != RG_OK) return RG_ENOMEM;
    int enough = 1;
    for (int32_t j = 0; j <= stages; j++) {
        w->begins[j + 1] = legs * (first + A_SIMPLE_FOLD * j) / all;
        w->first_frame[j + 1] = (int32_t)lround(w->begins[j + 1]);
        enough &= w->first_frame[j + 1] > w->first_frame[j] || w->begins[j + 1] == 0;
    }
    for (int32_t j = 0; enough && j <= stages; j++) w->begins[j + 1] = w->first_frame[j + 1];
    return RG_OK;
}

/* As rg_path_reader. What is a frame but for rounding is one. */
static int read(void *ctx, double progress, double *rho, rg_vec2 *X)
{
    const work *w = ctx;
    const rg_attempt *t = &w->search.best;
    const double *first = w->begins;
    double k = progress * (w->frames - 1);
    if (fabs(k - round(k)) <= 1e-9 * w->frames) k = round(k);
    int32_t j = 0;
    while (j < w->u.simple.stages && k > first[j + 1]) j++;
    const double done = first[j + 1] > first[j] ? (k - first[j]) / (first[j + 1] - first[j]) : 1;
    const int32_t at = j == 0 && w->u.simple.base > 0 ? (int32_t)lround(done * (t->count - 1)) : -1;
    memcpy(X, w->X, (size_t)w->fine.nv * sizeof *X);
    if (at >= 0 && at < t->count - 1) {
        rg_overlay_angles(&w->of_base, t->rho + (size_t)at * (size_t)t->mesh.N, rho);
        if (t->flat) rg_overlay_points(&w->of_base, t->flat + (size_t)at * (size_t)t->mesh.nv, X);
        return 1;
    }
    for (int32_t i = 0; i < w->fine.N; i++) {
        if (w->stage[i] < 0 || w->stage[i] > j) rho[i] = 0;
        else rho[i] = w->stage[i] == j && j > 0 ? done * w->end[i] : w->end[i];
    }
    return 1;
}

/* ----------------------------------------------------------------------------------------------- what is told ---- */

/* Is crease i of the motion made by fold f, f < 0: at first? */
static int made_by(const work *w, int32_t i, const rg_simple_fold *f)
{
    if (!f) return w->stage[i] == 0;
    if (w->stage[i] != f->stage) return 0;
    const int32_t *g = w->u.drawn.edge_facet[w->u.drawn.crease_edge[w->of_drawn.crease[i]]];
    return f->moves[g[0]] != f->moves[g[1]];
}

static int32_t list_creases(const work *w, const rg_simple_fold *f, int32_t *crease)
{
    int32_t n = 0;
    for (int32_t i = 0; i < w->fine.N; i++)
        if (made_by(w, i, f)) crease[n++] = i;
    return n;
}

static rg_status tell(const work *w, rg_stages *q)
{
    const rg_simple *p = &w->u.simple;
    const int32_t at_once = p->base > 0;
    int32_t n = 0;
    q->mem = w->mem;
    if (RG_MEM_ARRAYS(&q->mem, RG_ARRAY(q->stage, (size_t)p->stages + 1), RG_ARRAY(q->fold, (size_t)p->folds),
                      RG_ARRAY(q->crease, (size_t)w->fine.N)) != RG_OK) return RG_ENOMEM;
    q->count = p->stages + at_once;
    if (at_once) {
        q->stage[0] = (rg_folding_stage){.crease = q->crease, .creases = list_creases(w, NULL, q->crease)};
        n = q->stage[0].creases;
    }
    for (int32_t k = 0; k < p->folds; k++) {
        const rg_simple_fold *f = &p->fold[k];
        rg_folding_stage *s = &q->stage[f->stage - 1 + at_once];
        q->fold[k] = (rg_simple_turn){.crease = q->crease + n, .creases = list_creases(w, f, q->crease + n),
                                      .over = f->over, .line = {{f->a.x, f->a.y}, {f->b.x, f->b.y}}};
        if (s->folds++ == 0) s->fold = &q->fold[k], s->crease = q->crease + n;
        s->creases += q->fold[k].creases;
        n += q->fold[k].creases;
    }
    for (int32_t j = 0; j < q->count; j++) {
        q->stage[j].first_frame = w->first_frame[j + !at_once];
        q->stage[j].last_frame = w->first_frame[j + !at_once + 1];
    }
    return trace(w, q);
}

static void adopt(work *w, rg_search *c, rg_attempt *t)
{
    const rg_search *b = &w->search;
    const rg_simple *p = &w->u.simple;
    t->method = b->best.mem.resize ? b->best.method : "simple folds";
    t->solver = b->best.mem.resize ? b->best.solver : "none";
    t->cost.steps = b->best.cost.steps, t->cost.seconds = b->best.cost.seconds;
    const int stages = (int)p->stages, folds = (int)p->folds;
    if (p->base > 0)
        snprintf(t->reason, sizeof t->reason, "folded in %d stages: %d of %d creases at once, then %d simple folds",
                 stages + 1, (int)p->base, (int)w->u.none->N, folds);
    else snprintf(t->reason, sizeof t->reason, "folded in %d stages: %d simple folds", stages, folds);
    rg_attempt_free(&c->best);
    c->best = *t;
    memset(t, 0, sizeof *t);
    c->triangulation = c->best.mesh.added == 0 ? "none" : b->triangulation;
    c->why_triangulated = c->best.mesh.added == 0 ? "goes without added creases" : b->why_triangulated;
    c->rung = "in stages";
    c->direction = "forward";
    c->compliance = b->compliance;
    snprintf(c->strategy, sizeof c->strategy, "in stages%s%.130s", p->base > 0 ? ", the first " : "",
             p->base > 0 ? b->strategy : "");
}

/* What is left is folded; then it is put together. */
static rg_status fold(work *w, rg_stages *q, rg_search *c, rg_watch *watch, rg_diag *why)
{
    rg_attempt t = {0};
    int32_t unproved;
    int good = 1;
    rg_settings with = *w->settings;
    with.pace = RG_PACE_PERCENT; /* `read` has its own */
    rg_status s = RG_OK;
    if (w->u.simple.base > 0) s = draw_base(w, why);
    if (s == RG_OK && w->u.simple.base > 0) s = fold_base(w, watch, &good, why);
    rg_cost_add(&c->cost, &w->search.cost);
    c->tries += w->search.tries;
    if (s != RG_OK || !good) return s;
    s = make_mesh(w, why);
    if (s == RG_OK) s = overlay(w);
    if (s == RG_OK) s = share_frames(w);
    rg_mesh m = {0};
    double *target = rg_mem_array(&w->mem, (size_t)w->fine.N, sizeof *target);
    if (!target && s == RG_OK) s = RG_ENOMEM;
    for (int32_t i = 0; s == RG_OK && i < w->fine.N; i++)
        target[i] = w->u.sign * w->fine.target[w->fine.crease_edge[i]];
    if (s == RG_OK) s = rg_mesh_copy(&w->fine, &m);
    if (s == RG_OK) s = rg_attempt_from_path(&t, &m, &with, target, read, w, why);
    if (s == RG_OK) s = rg_unfolding_judge(&t, &with, NULL, &good, &unproved, why);
    if (s == RG_OK && good) {
        s = tell(w, q);
        if (s == RG_OK) adopt(w, c, &t);
    }
    rg_attempt_free(&t);
    rg_mem_free(&w->mem, target);
    return s;
}

rg_status rg_stages_try(rg_stages *q, rg_search *c, const rg_mesh *none, const rg_settings *s, rg_watch *watch,
                        rg_diag *why)
{
    work w = {.mem = rg_mem_default(s->memory), .settings = s};
    memset(q, 0, sizeof *q);
    if (fabs(s->to) != 1 || watch->cancelled) return RG_OK;
    const rg_stop stop = {rg_watch_asked, watch};
    rg_status status = rg_undone_init(&w.u, none, s, &stop);
    const double most = s->adjust != 0 ? ON_THE_PATTERN * none->size : 0; /* that vertices may move by */
    const int closes = w.u.off <= RG_RECTIFIED && w.u.moved <= most;
    if (status == RG_OK && w.u.simple.folds > 0 && closes) status = fold(&w, q, c, watch, why);
    work_free(&w);
    return status == RG_ENOMEM ? rg_fail(status, why, 0, "out of memory") : status;
}
