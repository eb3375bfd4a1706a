#include "fold/straight.h"
#include "base/clock.h"
#include "base/status.h"
#include "fold/apart.h"
#include "fold/integrate.h"
#include "fold/fixed.h"
#include "fold/start.h"
#include "fold/tuning.h"

#include <stdio.h>
#include <string.h>

/* The one system of all creases, and what its time loop works on. */
static rg_status make_system(rg_straight *f, rg_diag *why)
{
    const rg_memory *mem = &f->mem;
    rg_status s = rg_project_init(&f->P, mem, &f->K, f->settings.solver);
    if (s == RG_EABSENT) return rg_fail(s, why, 0, "this build has no such solver: it was made with GPL=0");
    if (s == RG_OK) s = rg_path_init(&f->path, mem, f->mesh.N);
    double **array[] = {&f->trial, &f->wish, &f->t, &f->pull, &f->best, &f->end, &f->largest,
                        &f->k[0], &f->k[1], &f->k[2]};
    for (int i = 0; i < 10; i++)
        if (!(*array[i] = rg_mem_array(mem, (size_t)f->mesh.N, sizeof(double))) && s == RG_OK) s = RG_ENOMEM;
    if (s != RG_OK) return s;
    if (f->mesh.N <= 3 * f->mesh.M) f->settings.tol = fmin(f->settings.tol, LOOSEST_OVERCONSTRAINED);
    for (int32_t i = 0; i < f->mesh.N; i++) f->end[i] = isnan(f->drive.target[i]) ? 0 : f->drive.target[i];
    f->end_is_closed = rg_constraint_closure(&f->K, f->end, NULL) <= f->settings.tol;
    return RG_OK;
}

/* The state of one system at a progress it has passed, scratch; NULL: not known. What it stands at stays. */
static const double *between(rg_straight *f, double s)
{
    const double closure = f->closure;
    if (f->path.count < 2 || s < f->path.node[0].s) return NULL;
    const int known = rg_integrate_read_off(f, s);
    f->closure = closure;
    return known ? f->trial : NULL;
}

/* What components are made, stepped, read off and destroyed by. */
static const rg_apart_of OF_SYSTEMS = {rg_straight_from_mesh_together, rg_straight_step, between, rg_straight_destroy};

static rg_status create(rg_mesh *m, const rg_settings *settings, int apart, rg_straight **fold, rg_diag *why)
{
    rg_memory mem = rg_mem_default(settings->memory);
    rg_straight *f = rg_mem_array(&mem, 1, sizeof *f);
    if (!f) {
        rg_mesh_free(m);
        return RG_ENOMEM;
    }
    rg_status s = RG_OK;
    f->mem = mem;
    f->self = f;
    f->settings = *settings;
    if (f->settings.method == RG_METHOD_AUTO) f->settings.method = RG_METHOD_ADAPTIVE;
    f->smooth = f->settings.method == RG_METHOD_ADAPTIVE;
    f->mesh = *m;
    memset(m, 0, sizeof *m);
    f->s_end = fabs(settings->to);
    f->ds = INFINITY;
    f->rho = rg_mem_array(&mem, (size_t)f->mesh.N, sizeof *f->rho);
    s = f->rho ? rg_constraint_init(&f->K, &mem, &f->mesh) : RG_ENOMEM;
    if (s == RG_OK) s = rg_drive_init(&f->drive, &mem, &f->mesh, settings->to < 0 ? -1 : 1);
    if (s == RG_OK) s = rg_limit_init(&f->limit, &mem, &f->mesh);
    if (s == RG_OK && apart) s = rg_apart_init(&f->apart, &OF_SYSTEMS, &mem, &f->mesh, settings, why);
    if (s == RG_OK && f->apart.parts == 0) s = make_system(f, why);
    if (s == RG_OK) *fold = f;
    else rg_straight_destroy(f);
    return s;
}

rg_status rg_straight_from_mesh(rg_mesh *m, const rg_settings *settings, rg_straight **fold, rg_diag *why)
{
    return create(m, settings, 1, fold, why);
}

rg_status rg_straight_from_mesh_together(rg_mesh *m, const rg_settings *settings, rg_straight **fold, rg_diag *why)
{
    return create(m, settings, 0, fold, why);
}

rg_status rg_straight_create(const rg_pattern *p, const rg_settings *settings, rg_straight **fold, rg_diag *why)
{
    rg_memory mem = rg_mem_default(settings->memory);
    rg_mesh m, all;
    rg_status s = rg_mesh_from_pattern(p, &mem, &m, why);
    if (s == RG_OK && settings->triangulate == RG_TRIANGULATE_ALL) {
        s = rg_triangulate_all(&m, &all);
        rg_mesh_free(&m);
        m = all;
    }
    return s == RG_OK ? rg_straight_from_mesh(&m, settings, fold, why) : s;
}

void rg_straight_destroy(rg_straight *f)
{
    if (!f) return;
    rg_memory mem = f->mem;
    rg_mesh_free(&f->mesh);
    rg_constraint_free(&f->K);
    rg_project_free(&f->P);
    rg_drive_free(&f->drive);
    rg_limit_free(&f->limit);
    rg_apart_free(&f->apart);
    rg_path_free(&f->path);
    double *array[] = {f->rho, f->trial, f->wish, f->t, f->pull, f->best, f->end, f->largest,
                       f->k[0], f->k[1], f->k[2]};
    for (int i = 0; i < 11; i++) rg_mem_free(&mem, array[i]);
    rg_mem_free(&mem, f);
}

int32_t rg_straight_systems(const rg_straight *f, rg_straight *const **system)
{
    *system = f->apart.parts ? f->apart.part : &f->self;
    return f->apart.parts ? f->apart.parts : 1;
}

rg_cost rg_straight_cost(const rg_straight *f)
{
    rg_cost sum = {.seconds = f->seconds_solving};
    rg_straight *const *system;
    for (int32_t p = rg_straight_systems(f, &system); p-- > 0;) {
        const rg_straight *g = system[p];
        sum.steps += g->steps;
        sum.solves += g->P.solves;
        sum.iterations += g->P.iterations;
        sum.factorizations += g->P.factorizations;
        sum.assemblies += g->assemblies;
    }
    return sum;
}

void rg_straight_largest(const rg_straight *f, double *largest)
{
    rg_straight *const *system;
    for (int32_t p = rg_straight_systems(f, &system); p-- > 0;)
        for (int32_t i = 0; i < system[p]->mesh.N; i++)
            largest[f->apart.parts ? f->apart.crease[f->apart.start[p] + i] : i] = system[p]->largest[i];
}

rg_solver rg_straight_solver(const rg_straight *f)
{
    rg_straight *const *system, *most = NULL;
    for (int32_t p = rg_straight_systems(f, &system); p-- > 0;)
        if (!most || system[p]->mesh.N > most->mesh.N) most = system[p];
    return most->P.solver;
}

void rg_straight_set_most_steps(rg_straight *f, int32_t most)
{
    f->most_steps = most;
    for (int32_t p = 0; p < f->apart.parts; p++) f->apart.part[p]->most_steps = most;
}

void rg_straight_stand(rg_straight *f, const double *rho, double s, int32_t frame)
{
    f->smooth = 0;
    f->stands = 0;
    f->steps = 2;
    f->frame = frame;
    rg_path_clear(&f->path);
    rg_path_insert(&f->path, s, rho, NULL);
    rg_straight_accept(f, rho, s);
}

void rg_straight_set_due(rg_straight *f, const double *due)
{
    f->due = due;
    for (int32_t p = 0; p < f->apart.parts; p++) f->apart.part[p]->due = due;
}

static void leave_flat(rg_straight *f)
{
    double s1 = fmin(FIRST_ANGLE / RG_PI, f->s_end / 2);
    rg_path_insert(&f->path, 0, f->rho, NULL);
    if (f->settings.method == RG_METHOD_EULER) return;
    if (!rg_start_leave_flat(f, s1)) {
        rg_straight_stop(f, "no way off the flat state was found");
        return;
    }
    const int has_t = rg_integrate_tangent(f, f->rho, f->s, 0, f->t) > 0;
    f->smooth = f->smooth && has_t;
    f->h = f->s;
    f->order = 1;
    rg_path_insert(&f->path, f->s, f->rho, has_t ? f->t : NULL);
    rg_straight_accept(f, f->path.node[0].rho, 0); /* frames may lie before that node */
}

/* Why no more nodes are to be made; NULL: they are. */
static const char *is_over(rg_straight *f)
{
    const double s = f->path.node[f->path.count - 1].s;
    const double could = MOST_CREEPING * f->settings.step / RG_PI;
    const double part = LEAST_WAY_PART * (f->graded ? fmin(could, fmin(s, 1 - s)) : could);
    const double most = fmax(MOST_STRAIGHT_STEPS, MOST_STRAIGHT_WAYS * RG_PI / f->settings.step);
    if (s - f->idle_s >= fmin(LEAST_WAY, part)) f->idle = 0, f->idle_s = s;
    if (f->steps > (f->most_steps ? f->most_steps : most)) return "the number of steps ran out";
    if (f->idle++ < MOST_CREEPING) return NULL;
    return "the facets leave hardly any way on: it goes on in steps too small to get anywhere";
}

/* Another node: is it to be made? What is read off between nodes is no step, so that the way does not depend on frames;
 * and the frames up to the last node are read before it ends there. */
static int may_step(rg_straight *f)
{
    const char *why = is_over(f);
    if (!why) {
        f->steps++;
        return 1;
    }
    if (f->smooth && !f->path_ended) {
        f->path_ended = 1;
    } else {
        const rg_node *last = &f->path.node[f->path.count - 1];
        rg_straight_accept(f, last->rho, last->s);
        rg_straight_stop(f, why);
    }
    return 0;
}

/* The next frame off the nodes, or another node where they do not reach it yet. */
static void go_on(rg_straight *f)
{
    rg_path *p = &f->path;
    const double goal = rg_straight_frame_progress(f, f->frame), last = p->node[p->count - 1].s;
    const int32_t beyond = f->smooth ? RG_PATH_WINDOW / 2 : 1;
    const int ended = f->path_ended || last >= f->s_end || !f->smooth;
    const int reached = goal <= last && (ended || (p->count > beyond && goal <= p->node[p->count - beyond].s));
    if (reached && goal < f->stands) {
        rg_straight_accept(f, f->rho, goal);
    } else if (reached && rg_integrate_read_off(f, goal)) {
        rg_straight_accept(f, f->trial, goal);
    } else if (reached && !f->smooth) { /* where nothing between two nodes closes: the nearer one that is not behind */
        int32_t first, n;
        rg_path_around(p, goal, &first, &n);
        const rg_node *a = &p->node[first], *b = a + n - 1;
        const rg_node *at = goal - a->s < b->s - goal && f->s <= a->s ? a : b;
        rg_straight_accept(f, at->rho, goal);
        f->stands = at->s;
    } else if (!reached && f->smooth && !ended) {
        if (may_step(f)) f->path_ended = !rg_integrate_advance(f);
    } else if (f->smooth) { /* from the last node that can be read off on, step by step */
        f->smooth = 0;
        rg_path_cut(p, goal);
    } else if (may_step(f)) {
        rg_straight_accept(f, p->node[p->count - 1].rho, last);
        if (f->settings.method == RG_METHOD_EULER) rg_fixed_euler(f);
        else rg_fixed_newton(f);
    }
}

int rg_straight_between(rg_straight *f, double s, double *rho)
{
    if (f->apart.parts > 0) return rg_apart_between(&f->apart, s, rho);
    const double *at = between(f, s);
    if (at) memcpy(rho, at, (size_t)f->mesh.N * sizeof *rho);
    return at != NULL;
}

/* The newest node counts for what creases turn at the most. */
static void note_node(rg_straight *f)
{
    const double *rho = f->path.node[f->path.count - 1].rho;
    for (int32_t i = 0; i < f->mesh.N; i++)
        if (fabs(rho[i]) > f->largest[i]) f->largest[i] = fabs(rho[i]);
}

/* One step of one system. Returns the frame that it ends on, -1: none. */
static int32_t step(rg_straight *f)
{
    if (f->steps == 0) return 0; /* the flat state is the first frame */
    if (f->drive.count == 0 || f->s_end == 0) { /* nothing to fold: flat is what all frames are */
        f->s = rg_straight_frame_progress(f, f->frame);
        return f->frame;
    }
    const int32_t before = f->steps;
    if (f->path.count == 0) leave_flat(f);
    else go_on(f);
    if (f->steps > before) note_node(f);
    return f->outcome == RG_RUNNING && f->s >= rg_straight_frame_progress(f, f->frame) ? f->frame : -1;
}

/* The same for several. */
static int32_t step_apart(rg_straight *f)
{
    const int32_t last = f->settings.frames - 1;
    int reached, done = 1;
    rg_apart_step(&f->apart, f->frame, &reached, &f->outcome);
    f->s = rg_apart_gather(&f->apart, f->rho, &f->closure);
    if (f->outcome != RG_RUNNING) rg_apart_tell(&f->apart, f->reason, sizeof f->reason);
    for (int32_t p = 0; p < f->apart.parts; p++) done &= f->apart.part[p]->frame > last;
    return done ? last : reached ? f->frame : -1;
}

rg_status rg_straight_step(rg_straight *f, rg_step_info *info)
{
    const rg_cost was = rg_straight_cost(f);
    int32_t frame = -1;
    double from = rg_seconds();
    if (f->outcome == RG_RUNNING) {
        frame = f->apart.parts ? step_apart(f) : step(f);
        if (frame >= 0) f->frame = frame + 1;
        if (f->outcome == RG_RUNNING && f->frame == f->settings.frames) {
            f->outcome = RG_FOLDED;
            if (f->s_end >= 1) rg_straight_stop(f, "all frames are made");
        }
        f->steps += f->steps < 2;
    }
    f->seconds_solving += rg_seconds() - from;
    const rg_cost is = rg_straight_cost(f);
    *info = (rg_step_info){.outcome = f->outcome, .progress = f->s, .frame = frame, .closure = f->closure,
                           .frames = f->settings.frames, .solves = (int32_t)(is.solves - was.solves),
                           .iterations = (int32_t)(is.iterations - was.iterations),
                           .reason = f->outcome == RG_RUNNING ? "" : f->reason};
    return RG_OK;
}
