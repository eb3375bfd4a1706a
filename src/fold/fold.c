#include "fold/fold.h"
#include "base/status.h"
#include "fold/integrate.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

/* The first step off the flat state, as mean angle: far above rounding, where the branches are apart, and far below
 * where they bend. */
static const double FIRST_ANGLE = 0.01;
/* Steps smaller than this part of the whole way are no progress. */
static const double SMALLEST_STEP = 1e-6;
static const int32_t MOST_STEPS = 20000;
/* So many steps must reach a frame, or gain this much of the way, or, with steps that are small by order, this part of what
 * they could, or of what lies behind or before them: a motion that only creeps is over. */
static const int32_t MOST_IDLE = 60;
static const double LEAST_GAIN = 1e-3, LEAST_PART = 0.01;
static const double SOLVE_TOLERANCE = 1e-8;
static const int32_t CORRECTIONS = 8;
/* A correction this much longer than the step it corrects has left the branch. */
static const double FARTHEST_CORRECTION = 0.5;
/* How strongly a limit pulls, per step; and how often again, where more than this is left. */
static const double LIMIT_GAIN = 0.5;
static const int32_t MOST_PULLS = 12;
static const double LITTLE_PULL = 1e-3;
/* Within this of its target every crease counts as arrived: the exit status's 1 %. */
static const double ARRIVED = 0.01;

static double seconds(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double largest(int32_t n, const double *a)
{
    double most = 0;
    for (int32_t i = 0; i < n; i++)
        if (!(fabs(a[i]) <= most)) most = fabs(a[i]);
    return most;
}

static rg_status check_settings(const rg_settings *s, rg_diag *why)
{
    if (!(s->step > 0 && s->step <= RG_PI)) return rg_fail(RG_EARG, why, 0, "the step must be above 0 and at most 180 degrees");
    if (!(s->tol >= 1e-14 && s->tol <= 0.1)) return rg_fail(RG_EARG, why, 0, "the tolerance must be within 1e-14 and 0.1");
    if (!(fabs(s->to) <= 1)) return rg_fail(RG_EARG, why, 0, "the end must be within -100 and 100 percent");
    if (s->frames < 2) return rg_fail(RG_EARG, why, 0, "there must be at least 2 frames");
    return RG_OK;
}

/* The one system of all creases, and what its time loop works on. */
static rg_status make_system(rg_fold *f, rg_diag *why)
{
    const rg_memory *mem = &f->mem;
    rg_status s = rg_project_init(&f->P, mem, &f->K, f->settings.solver);
    if (s == RG_EABSENT) return rg_fail(s, why, 0, "this build has no such solver: it was made with GPL=0");
    if (s == RG_OK && f->smooth) s = rg_path_init(&f->path, mem, f->mesh.N);
    double **array[] = {&f->trial, &f->wish, &f->t, &f->pull, &f->best, &f->end, &f->k[0], &f->k[1], &f->k[2]};
    for (int i = 0; i < 9; i++)
        if (!(*array[i] = rg_mem_array(mem, (size_t)f->mesh.N, sizeof(double))) && s == RG_OK) s = RG_ENOMEM;
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < f->mesh.N; i++) f->end[i] = isnan(f->drive.target[i]) ? 0 : f->drive.target[i];
    f->end_is_closed = rg_constraint_closure(&f->K, f->end, NULL) <= f->settings.tol;
    return RG_OK;
}

static rg_status create(rg_mesh *m, const rg_settings *settings, int apart, rg_fold **fold, rg_diag *why)
{
    rg_memory mem = rg_mem_default(settings->memory);
    rg_status s = check_settings(settings, why);
    rg_fold *f = s == RG_OK ? rg_mem_array(&mem, 1, sizeof *f) : NULL;
    if (!f) {
        rg_mesh_free(m);
        return s != RG_OK ? s : RG_ENOMEM;
    }
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
    if (s == RG_OK && apart) s = rg_apart_init(&f->apart, &mem, &f->mesh, settings, why);
    if (s == RG_OK && f->apart.parts == 0) s = make_system(f, why);
    if (s == RG_OK) *fold = f;
    else rg_fold_destroy(f);
    return s;
}

rg_status rg_fold_from_mesh(rg_mesh *m, const rg_settings *settings, rg_fold **fold, rg_diag *why)
{
    return create(m, settings, 1, fold, why);
}

rg_status rg_fold_from_mesh_together(rg_mesh *m, const rg_settings *settings, rg_fold **fold, rg_diag *why)
{
    return create(m, settings, 0, fold, why);
}

rg_status rg_fold_create(const rg_pattern *p, const rg_settings *settings, rg_fold **fold, rg_diag *why)
{
    rg_memory mem = rg_mem_default(settings->memory);
    rg_mesh m, all;
    rg_status s = rg_mesh_from_pattern(p, &mem, &m, why);
    if (s == RG_OK && settings->triangulate == RG_TRIANGULATE_ALL) {
        s = rg_triangulate_all(&m, &all);
        rg_mesh_free(&m);
        m = all;
    }
    return s == RG_OK ? rg_fold_from_mesh(&m, settings, fold, why) : s;
}

void rg_fold_destroy(rg_fold *f)
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
    double *array[] = {f->rho, f->trial, f->wish, f->t, f->pull, f->best, f->end, f->k[0], f->k[1], f->k[2]};
    for (int i = 0; i < 10; i++) rg_mem_free(&mem, array[i]);
    rg_mem_free(&mem, f);
}

const double *rg_fold_angles(const rg_fold *f, int32_t *creases)
{
    if (creases) *creases = f->mesh.N;
    return f->rho;
}

int32_t rg_fold_systems(const rg_fold *f, rg_fold *const **system)
{
    *system = f->apart.parts ? f->apart.part : &f->self;
    return f->apart.parts ? f->apart.parts : 1;
}

rg_cost rg_fold_cost(const rg_fold *f)
{
    rg_cost sum = {.seconds = f->seconds_solving};
    rg_fold *const *system;
    for (int32_t p = rg_fold_systems(f, &system); p-- > 0;) {
        const rg_fold *g = system[p];
        sum.steps += g->steps;
        sum.solves += g->P.solves;
        sum.iterations += g->P.iterations;
        sum.factorizations += g->P.factorizations;
        sum.assemblies += g->assemblies;
    }
    return sum;
}

rg_solver rg_fold_solver(const rg_fold *f)
{
    rg_fold *const *system, *most = NULL;
    for (int32_t p = rg_fold_systems(f, &system); p-- > 0;)
        if (!most || system[p]->mesh.N > most->mesh.N) most = system[p];
    return most->P.solver;
}

double rg_fold_frame_progress(const rg_fold *f, int32_t frame)
{
    return f->s_end * frame / (f->settings.frames - 1);
}

static void accept(rg_fold *f, const double *rho, double s)
{
    memcpy(f->rho, rho, (size_t)f->mesh.N * sizeof *rho);
    f->s = s;
}

static void stop(rg_fold *f, const char *why)
{
    int arrived = f->s_end >= 1;
    for (int32_t i = 0; i < f->mesh.N && arrived; i++)
        if (rg_drive_is_driven(&f->drive, i)) arrived = fabs(f->rho[i] / f->drive.target[i] - 1) <= ARRIVED;
    f->outcome = arrived ? RG_FOLDED : RG_STOPPED;
    snprintf(f->reason, sizeof f->reason, "%s%s", why,
             arrived ? "; every crease is within 1 % of its target" : "");
}

/* Creases beyond their limits are pulled back, along what the constraint allows; f->trial is then corrected. */
static int pull_back(rg_fold *f, double least, double gain)
{
    rg_cg_report rep;
    if (!(rg_limit_pull(&f->limit, f->trial, f->pull) > least)) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++) f->pull[i] *= gain;
    if (rg_project_step(&f->P, &f->K, f->pull, 0, NULL, f->pull, SOLVE_TOLERANCE, &rep) != RG_OK) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++) f->trial[i] += f->pull[i];
    return 1;
}

/* The folded state itself, where it is within a step and straight ahead. */
static int land(rg_fold *f)
{
    const int32_t N = f->mesh.N;
    double far = 0, refused = 0, wished = 0, left = 1 - f->s;
    if (f->s_end < 1 || !f->end_is_closed || f->frame < f->settings.frames - 1) return 0;
    for (int32_t i = 0; i < N; i++) {
        double d = f->end[i] - f->rho[i];
        far = fmax(far, fabs(d));
        wished += d * d;
        refused += (d - left * f->t[i]) * (d - left * f->t[i]);
    }
    /* The wish points straight at the end; near it the constraint agrees up to second order. */
    if (!(far <= f->settings.step && refused <= 0.01 * wished)) return 0;
    accept(f, f->end, 1);
    f->closure = rg_constraint_closure(&f->K, f->rho, NULL);
    return 1;
}

/* A step of the method's own kind from f->rho along f->t to f->trial, closed. Beyond a limit, and where a stage has no
 * direction, as in the folded state, Euler's is the method: it can be pulled back. */
static int try_step(rg_fold *f, double ds)
{
    int higher = f->settings.method == RG_METHOD_HEUN  ? rg_integrate_heun(f, ds)
                 : f->settings.method == RG_METHOD_RK4 ? rg_integrate_rk4(f, ds)
                                                       : 0;
    if (higher && !(rg_limit_pull(&f->limit, f->trial, f->pull) > 0)) return 1;
    for (int32_t i = 0; i < f->mesh.N; i++) f->trial[i] = f->rho[i] + ds * f->t[i];
    pull_back(f, 0, LIMIT_GAIN);
    int closed = rg_newton_correct(f, f->s + ds, CORRECTIONS);
    for (int32_t n = 0; n < MOST_PULLS && closed && pull_back(f, LITTLE_PULL, 1); n++) closed = rg_newton_correct(f, f->s + ds, CORRECTIONS);
    return closed;
}

static void step_newton(rg_fold *f)
{
    const int32_t N = f->mesh.N;
    const double goal = rg_fold_frame_progress(f, f->frame);
    if (!(rg_integrate_tangent(f, f->rho, f->s, 0, f->t) > 0)) {
        stop(f, "no motion that the facets allow folds any further");
        return;
    }
    if (land(f)) return;
    double fastest = largest(N, f->t), most = f->settings.step / fastest;
    const double left = goal - f->s;
    double ds = fmin(f->ds, most);
    if (!(ds < left - SMALLEST_STEP)) ds = left; /* leaves no rest that would be too small a step */
    for (;; ds /= 2) {
        if (!(ds > SMALLEST_STEP)) {
            stop(f, "the facets leave no way on: even the smallest step does not close");
            return;
        }
        double way = ds * fastest, strayed = 0;
        if (!try_step(f, ds)) continue;
        for (int32_t i = 0; i < N; i++) {
            double d = fabs(f->trial[i] - f->rho[i] - ds * f->t[i]);
            if (!(d <= strayed)) strayed = d;
        }
        if (strayed <= FARTHEST_CORRECTION * way + 1e-6) break;
    }
    int whole = ds >= left;
    f->ds = whole ? fmax(2 * ds, f->ds == INFINITY ? 0 : f->ds) : 2 * ds;
    accept(f, f->trial, whole ? goal : f->s + ds);
}

/* One solve, no correction: the paper's eq. (14) and nothing else. */
static void step_euler(rg_fold *f)
{
    const int32_t N = f->mesh.N;
    const double goal = rg_fold_frame_progress(f, f->frame);
    rg_cg_report rep;
    rg_constraint_assemble(&f->K, f->rho);
    f->assemblies++;
    rg_project_renew(&f->P);
    rg_drive_wish(&f->drive, f->rho, fmin(f->s, 1 - SMALLEST_STEP), f->wish);
    double h = fmin(f->settings.step / fmax(largest(N, f->wish), 1e-300), 1);
    rg_limit_pull(&f->limit, f->rho, f->pull);
    for (int32_t i = 0; i < N; i++) f->wish[i] = h * f->wish[i] + LIMIT_GAIN * f->pull[i];
    if (rg_project_step(&f->P, &f->K, f->wish, 1, NULL, f->t, SOLVE_TOLERANCE, &rep) != RG_OK) { /* eqs. (14), (15) */
        stop(f, "the solver failed");
        return;
    }
    double ds = rg_drive_progress(&f->drive, f->t), part = 1, way = largest(N, f->t);
    if (!(way <= RG_PI)) {
        stop(f, "the step diverged");
        return;
    }
    if (f->s + ds > goal - SMALLEST_STEP && ds > 0) part = (goal - f->s) / ds;
    if (!(part * way > SMALLEST_STEP * f->settings.step)) {
        stop(f, "no motion that the facets allow folds any further");
        return;
    }
    for (int32_t i = 0; i < N; i++) f->trial[i] = f->rho[i] + part * f->t[i]; /* eq. (10) */
    accept(f, f->trial, part != 1 ? goal : f->s + ds);
    f->closure = rg_constraint_closure(&f->K, f->rho, NULL);
}

static void leave_flat(rg_fold *f)
{
    double s1 = fmin(FIRST_ANGLE / RG_PI, rg_fold_frame_progress(f, f->frame));
    if (f->smooth) rg_path_insert(&f->path, 0, f->rho, NULL);
    if (!rg_start_leave_flat(f, s1)) {
        stop(f, "no way off the flat state was found");
        return;
    }
    if (f->smooth && !(rg_integrate_tangent(f, f->rho, f->s, 0, f->t) > 0)) f->smooth = 0;
    if (f->smooth) rg_path_insert(&f->path, f->s, f->rho, f->t);
    f->h = f->s;
    f->order = 1;
}

/* The next frame off the nodes, or another node where they do not reach it yet. */
static void step_adaptive(rg_fold *f)
{
    rg_path *p = &f->path;
    const double goal = rg_fold_frame_progress(f, f->frame);
    const int32_t beyond = RG_PATH_WINDOW / 2;
    double last = p->node[p->count - 1].s;
    int ended = f->path_ended || last >= f->s_end;
    int reached = goal <= last && (ended || (p->count > beyond && goal <= p->node[p->count - beyond].s));
    if (reached && rg_integrate_read_off(f, goal)) {
        accept(f, f->trial, goal);
        return;
    }
    if (!reached && !ended) {
        f->steps++;
        f->path_ended = !rg_integrate_advance(f);
        return;
    }
    f->smooth = 0; /* from the last node on, or from the last frame if that is all there is, step by step */
    if (!reached) accept(f, p->node[p->count - 1].rho, last);
}

static int creeps(rg_fold *f)
{
    const double s = f->smooth && f->path.count > 0 ? f->path.node[f->path.count - 1].s : f->s;
    const double could = MOST_IDLE * f->settings.step / RG_PI;
    if (s - f->idle_s >= fmin(LEAST_GAIN, LEAST_PART * fmin(could, fmin(s, 1 - s)))) f->idle = 0, f->idle_s = s;
    return f->idle++ >= MOST_IDLE;
}

/* One step of one system. Returns the frame that it ends on, -1: none. */
static int32_t step(rg_fold *f)
{
    if (f->steps == 0) return 0; /* the flat state is the first frame */
    if (f->drive.count == 0 || f->s_end == 0) { /* nothing to fold: flat is where it ends */
        f->s = f->s_end;
        f->outcome = RG_FOLDED;
        return f->settings.frames - 1;
    }
    if (f->steps - f->frame > MOST_STEPS) { /* besides those that frames ask for */
        stop(f, "the number of steps ran out");
    } else if (creeps(f)) {
        stop(f, "the facets leave hardly any way on: it goes on in steps too small to get anywhere");
    } else {
        if (f->settings.method == RG_METHOD_EULER) step_euler(f);
        else if (f->steps == 1 && f->s == 0) leave_flat(f);
        else if (f->smooth) step_adaptive(f);
        else step_newton(f);
        if (f->outcome == RG_RUNNING && f->s >= rg_fold_frame_progress(f, f->frame)) return f->frame;
    }
    return -1;
}

/* The same for several. */
static int32_t step_apart(rg_fold *f)
{
    const int32_t last = f->settings.frames - 1;
    int reached, done = 1;
    rg_apart_step(&f->apart, f->frame, &reached, &f->outcome);
    f->s = rg_apart_gather(&f->apart, f->rho, &f->closure);
    if (f->outcome != RG_RUNNING) rg_apart_tell(&f->apart, f->reason, sizeof f->reason);
    for (int32_t p = 0; p < f->apart.parts; p++) done &= f->apart.part[p]->frame > last;
    return done ? last : reached ? f->frame : -1;
}

rg_status rg_fold_step(rg_fold *f, rg_step_info *info)
{
    const rg_cost was = rg_fold_cost(f);
    int32_t frame = -1;
    double from = seconds();
    if (f->outcome == RG_RUNNING) {
        frame = f->apart.parts ? step_apart(f) : step(f);
        if (frame >= 0) f->frame = frame + 1, f->idle = 0;
        if (f->outcome == RG_RUNNING && f->frame == f->settings.frames) {
            f->outcome = RG_FOLDED;
            if (f->s_end >= 1) stop(f, "all frames are made");
        }
        f->steps += !f->smooth || f->steps < 2;
    }
    f->seconds_solving += seconds() - from;
    const rg_cost is = rg_fold_cost(f);
    *info = (rg_step_info){f->outcome, f->s, frame, f->closure, (int32_t)(is.solves - was.solves),
                           (int32_t)(is.iterations - was.iterations)};
    return RG_OK;
}
