#include "motion/unfolding.h"
#include "base/clock.h"
#include "base/status.h"
#include "contact/course.h"
#include "motion/ending.h"
#include "motion/measure.h"
#include "unfold/unfold.h"

#include <stdio.h>
#include <string.h>

/* Work, multiplications, by effort: some 10 s of one core, and 10 minutes. A step costs as much as there is of a sheet,
 * so one of more triangles than these gets more, in proportion, but not more than what some thousand need, a minute. */
static const double MOST_WORK[] = {0, 5e10, 3e12};
static const int32_t TRIANGLES = 250;
static const double MOST_TIMES = 4;
/* Of more triangles it is not looked for: that work gets nowhere then, setting out takes seconds that nobody can end,
 * and tables of pairs of edges grow to gigabytes. The most that was unfolded so far has some 400. */
static const int32_t MOST_TRIANGLES = 2500;

/* As a part of that: for facets cut by short diagonals, where nothing came of long ones. */
static const double PART_OF_SHORT = 0.5;

/* What moving a vertex of the pattern by the shortest line at it counts, in radians of a crease, as in relax.h. */
static const double GIVE = 1;

/* Where not all of the ways between frames could be proved free, another motion is looked for until it has cost so many
 * times as much. */
static const double AGAIN = 3;

/* A path is looked at in so many states, evenly in percent, whatever frames are asked for: what is chosen must not
 * depend on them. */
static const int32_t LOOKED_AT = 121;

/* The first state, of frames and what lies between them, in which facets cross, or before which they do on the way; -1:
 * none, or the watch (NULL: nobody's) stopped it before it came to one. */
static rg_status first_crossing(const rg_attempt *t, rg_watch *watch, int32_t *frame)
{
    const rg_mesh *m = &t->mesh;
    rg_course course = {0};
    rg_tree tree = {0};
    rg_place *place;
    rg_vec3 *x;
    rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(place, (size_t)m->nf), RG_ARRAY(x, (size_t)m->nv));
    if (s == RG_OK) s = rg_tree_init(m, -1, &tree);
    if (s == RG_OK) s = rg_course_init(m, &course);
    *frame = -1;
    const int32_t all = t->count + t->gaps.count;
    for (int32_t k = 0, j = 0; s == RG_OK && k + j < all && course.found.first < 0;) {
        if (watch && rg_watch_asked(watch)) break;
        const int gap = j < t->gaps.count && t->gaps.after[j] < k;
        const int32_t at = gap ? j++ : k++;
        const double *rho = gap ? rg_gaps_angles(&t->gaps, m, at) : rg_attempt_angles(t, at);
        const rg_vec2 *X = gap ? rg_gaps_pattern(&t->gaps, m, at) : rg_attempt_pattern(t, at);
        rg_pose_facets(m, X, &tree, rho, place);
        rg_pose_vertices(m, X, &tree, place, x);
        s = rg_course_add(&course, &(rg_plates_state){X, place, x}, !gap);
    }
    if (s == RG_OK && course.found.states == all) s = rg_course_end(&course);
    if (s == RG_OK) *frame = course.found.first;
    rg_course_free(&course);
    rg_tree_free(&tree);
    RG_MEM_FREE(&t->mem, place, x);
    return s;
}

/* The same of the path itself; of what went straight on, of its frames and what it kept between them. */
rg_status rg_unfolding_crosses(rg_attempt *t, const rg_settings *settings, rg_watch *watch, int32_t *frame)
{
    rg_settings look = *settings;
    look.frames = LOOKED_AT;
    look.pace = RG_PACE_PERCENT;
    rg_status s = rg_attempt_read(t, &look);
    if (s == RG_OK) s = first_crossing(t, watch, frame);
    rg_attempt_forget_frames(t);
    return s;
}

const char *const RG_UNFOLDED = "unfolded without contact";

static int read(void *ctx, double progress, double *rho, rg_vec2 *X)
{
    rg_unfold_read(ctx, progress, rho, X);
    return 1;
}

static rg_status triangulate(const rg_mesh *none, int shorter, rg_mesh *m)
{
    return shorter ? rg_triangulate_short(none, m) : rg_triangulate_all(none, m);
}

/* Do short diagonals make another mesh? */
static rg_status differ(const rg_mesh *none, int *yes)
{
    rg_mesh m[2];
    *yes = 0;
    rg_status s = triangulate(none, 0, &m[0]);
    if (s != RG_OK) return s;
    s = triangulate(none, 1, &m[1]);
    if (s == RG_OK) *yes = m[0].ne != m[1].ne || memcmp(m[0].edge, m[1].edge, (size_t)m[0].ne * sizeof *m[0].edge) != 0;
    rg_mesh_free(&m[0]);
    if (s == RG_OK) rg_mesh_free(&m[1]);
    return s;
}

/* What unfolding found, as an attempt. */
static rg_status take_over(rg_attempt *t, rg_unfold *u, const rg_mesh *none, const rg_settings *s, int shorter,
                           rg_diag *why)
{
    rg_mesh m;
    const double sign = s->to < 0 ? -1 : 1;
    rg_status status = triangulate(none, shorter, &m);
    if (status != RG_OK) return status;
    double *target = rg_mem_array(&u->mem, (size_t)m.N, sizeof *target);
    if (!target) {
        rg_mesh_free(&m);
        return RG_ENOMEM;
    }
    for (int32_t i = 0; i < m.N; i++) target[i] = i < m.N - m.added ? sign * m.target[m.crease_edge[i]] : NAN;
    status = rg_attempt_from_path(t, &m, s, target, read, u, why);
    rg_mem_free(&u->mem, target);
    if (status != RG_OK) return status;
    snprintf(t->reason, sizeof t->reason, "unfolded from its flat end without contact, and read backwards");
    t->method = "unfold";
    t->solver = "cholesky";
    t->cost.steps = u->steps;
    return RG_OK;
}

static void adopt(rg_search *c, rg_attempt *t, const char *how, int shorter)
{
    rg_attempt_free(&c->best);
    c->best = *t;
    memset(t, 0, sizeof *t);
    c->triangulation = c->best.mesh.added ? "all" : "none";
    c->why_triangulated = "a motion in which facets do not pass through each other bends them";
    c->rung = RG_UNFOLDED;
    c->direction = "backward";
    c->compliance = GIVE;
    snprintf(c->strategy, sizeof c->strategy, "%.140s%s", how, shorter ? ", short diagonals" : "");
}

rg_status rg_unfolding_judge(const rg_attempt *t, const rg_settings *s, rg_watch *watch, int *is_free,
                             int32_t *unproved, rg_diag *why)
{
    rg_motion m = {.mem = t->mem, .settings = *s, .mesh = t->mesh, .target = t->target, .from = t->from,
                   .rho = t->rho, .flat = t->flat, .gaps = t->gaps};
    m.frame = rg_mem_array(&m.mem, (size_t)t->count, sizeof *m.frame);
    m.report.frame_count = t->count;
    m.report.frames = m.frame;
    rg_status status = m.frame ? rg_tree_init(&m.mesh, -1, &m.tree) : RG_ENOMEM;
    if (status == RG_OK) status = rg_measure_frames(&m, watch);
    if (status == RG_OK) status = rg_ending_find(&m, watch, why);
    *is_free = status == RG_OK && m.report.contact == RG_CONTACT_FREE;
    *unproved = m.report.contact_unproved;
    if (m.tree.mem.resize) rg_tree_free(&m.tree);
    rg_layers_destroy(m.layers);
    RG_MEM_FREE(&m.mem, m.side, m.frame);
    return status;
}

/* Who takes what unfolding finds. */
typedef struct taker {
    const rg_mesh *none;
    const rg_settings *settings;
    rg_watch *watch;
    rg_diag *why;
    int shorter;
    rg_attempt found; /* the first of which all is proved free, or else the first */
    char how[160];
} taker;

static int stop(void *ctx, double done)
{
    rg_watch *w = ((taker *)ctx)->watch;
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, done < 0 ? 0 : done > 1 ? 1 : done) != 0;
    return w->cancelled;
}

/* What is free between its states is looked at once more as it is read; and of a part of the way all creases are to
 * have left flat. */
static rg_status accept(void *ctx, rg_unfold *u, int *yes)
{
    taker *k = ctx;
    rg_attempt t = {0};
    rg_settings look = *k->settings;
    int is_free = 0;
    int32_t unproved = 0;
    look.frames = LOOKED_AT;
    look.pace = RG_PACE_PERCENT;
    rg_status s = take_over(&t, u, k->none, &look, k->shorter, k->why);
    if (s == RG_OK) s = rg_unfolding_judge(&t, &look, k->watch, &is_free, &unproved, k->why);
    const int good = s == RG_OK && is_free && !k->watch->cancelled && rg_search_is_folded(&t);
    rg_attempt_free(&t);
    *yes = good && unproved == 0;
    if (!good || !(*yes || !k->found.mem.resize)) return s;
    rg_attempt_free(&k->found);
    memcpy(k->how, u->how, sizeof k->how);
    s = take_over(&k->found, u, k->none, k->settings, k->shorter, k->why);
    u->most = fmin(u->most, AGAIN * u->work);
    return s;
}

rg_status rg_unfolding_run(rg_search *c, const rg_mesh *none, const rg_settings *s, double part, rg_watch *watch,
                           rg_diag *why)
{
    /* It bends facets and moves the pattern. */
    if (s->adjust == 0 || s->triangulate == RG_TRIANGULATE_NONE) return RG_OK;
    const rg_memory mem = rg_mem_default(s->memory);
    const double begun = rg_seconds();
    const int32_t triangles = none->facet_start[none->nf] - 2 * none->nf;
    if (triangles > MOST_TRIANGLES) return RG_OK;
    const double most = part * MOST_WORK[s->effort] * fmin(MOST_TIMES, fmax(1, (double)triangles / TRIANGLES));
    taker k = {.none = none, .settings = s, .watch = watch, .why = why};
    int two;
    rg_status status = differ(none, &two);
    for (k.shorter = 0; status == RG_OK && k.shorter <= two && !k.found.mem.resize && !watch->cancelled; k.shorter++) {
        const double work = k.shorter ? PART_OF_SHORT * most : most;
        const rg_unfold_wish wish = {s->to < 0 ? -1 : 1, s->layer_order, k.shorter, work, stop, accept, &k};
        rg_unfold u;
        status = rg_unfold_run(&u, &mem, none, &wish);
        c->tries += u.tries;
        rg_unfold_free(&u);
    }
    if (status == RG_OK && k.found.mem.resize && !watch->cancelled) adopt(c, &k.found, k.how, k.shorter > 1);
    c->cost.seconds += rg_seconds() - begun;
    rg_attempt_free(&k.found);
    return status == RG_ENOMEM ? rg_fail(status, why, 0, "%s", rg_status_text(status)) : status;
}

rg_status rg_unfolding_wanted(rg_search *c, const rg_mesh *none, const rg_settings *s, const rg_watch *watch,
                              int *wanted, rg_diag *why)
{
    int32_t crossing = -1;
    *wanted = 0;
    if (s->contact != RG_CONTACT_AVOID || s->effort == RG_EFFORT_FAST || s->to == 0 || watch->cancelled) return RG_OK;
    if (none->still) return RG_OK; /* its end is no flat one */
    const int stopped = c->best.outcome == RG_STOPPED;
    rg_watch looking = *watch; /* whoever ends this look is asked again later */
    const rg_status status = stopped ? RG_OK : rg_unfolding_crosses(&c->best, s, &looking, &crossing);
    *wanted = status == RG_OK && !looking.cancelled && (stopped || crossing >= 0);
    return status == RG_ENOMEM ? rg_fail(status, why, 0, "%s", rg_status_text(status)) : status;
}
