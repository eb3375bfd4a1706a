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
/* So many steps must gain this much of the way, or, with steps that are small by order, this part of what they could:
 * a motion that only creeps is over. */
static const int32_t CREEP_STEPS = 200;
static const double CREEP_GAIN = 1e-3, CREEP_PART = 0.01;
static const double SOLVE_TOLERANCE = 1e-8;
static const int32_t CORRECTIONS = 8;
/* A correction this much longer than the step it corrects has left the branch. */
static const double FARTHEST_CORRECTION = 0.5;
/* How strongly a limit pulls, per step. */
static const double LIMIT_GAIN = 0.5;
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

rg_status rg_fold_from_mesh(rg_mesh *m, const rg_settings *settings, rg_fold **fold, rg_diag *why)
{
    rg_memory mem = rg_mem_default(settings->memory);
    rg_status s = check_settings(settings, why);
    rg_fold *f = s == RG_OK ? rg_mem_array(&mem, 1, sizeof *f) : NULL;
    if (!f) {
        rg_mesh_free(m);
        return s != RG_OK ? s : RG_ENOMEM;
    }
    f->mem = mem;
    f->settings = *settings;
    if (f->settings.method == RG_METHOD_AUTO) f->settings.method = RG_METHOD_ADAPTIVE;
    f->smooth = f->settings.method == RG_METHOD_ADAPTIVE;
    f->mesh = *m;
    memset(m, 0, sizeof *m);
    const int32_t N = f->mesh.N;
    s = rg_constraint_init(&f->K, &mem, &f->mesh);
    if (s == RG_OK) s = rg_project_init(&f->P, &mem, &f->K, settings->solver);
    if (s == RG_EABSENT) rg_fail(s, why, 0, "this build has no such solver: it was made with GPL=0");
    if (s == RG_OK) s = rg_drive_init(&f->drive, &mem, &f->mesh, settings->to < 0 ? -1 : 1);
    if (s == RG_OK) s = rg_limit_init(&f->limit, &mem, &f->mesh);
    if (s == RG_OK && f->smooth) s = rg_path_init(&f->path, &mem, N);
    double **array[] = {&f->rho, &f->trial, &f->wish, &f->t, &f->pull, &f->best, &f->end, &f->k[0], &f->k[1], &f->k[2]};
    for (int i = 0; i < 10; i++)
        if (!(*array[i] = rg_mem_array(&mem, (size_t)N, sizeof(double))) && s == RG_OK) s = RG_ENOMEM;
    if (s != RG_OK) {
        rg_fold_destroy(f);
        return s;
    }
    for (int32_t i = 0; i < N; i++) f->end[i] = isnan(f->drive.target[i]) ? 0 : f->drive.target[i];
    f->end_is_closed = rg_constraint_closure(&f->K, f->end, NULL) <= f->settings.tol;
    f->s_end = fabs(settings->to);
    f->ds = INFINITY;
    *fold = f;
    return RG_OK;
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
static int pull_back(rg_fold *f)
{
    rg_cg_report rep;
    if (rg_limit_pull(&f->limit, f->trial, f->pull) <= 0) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++) f->pull[i] *= LIMIT_GAIN;
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
    pull_back(f);
    return rg_newton_correct(f, f->s + ds, CORRECTIONS);
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
    if (f->steps - f->creep_steps < CREEP_STEPS) return 0;
    const double s = f->smooth && f->path.count > 0 ? f->path.node[f->path.count - 1].s : f->s;
    const double gain = s - f->creep_s, could = CREEP_STEPS * f->settings.step / RG_PI;
    f->creep_steps = f->steps;
    f->creep_s = s;
    return !(gain >= fmin(CREEP_GAIN, CREEP_PART * could));
}

rg_status rg_fold_step(rg_fold *f, rg_step_info *info)
{
    int64_t solves = f->P.solves, iterations = f->P.iterations;
    int32_t frame = -1;
    double from = seconds();
    if (f->outcome == RG_RUNNING) {
        if (f->steps == 0) {
            frame = 0; /* the flat state is the first frame */
        } else if (f->drive.count == 0 || f->s_end == 0) {
            f->s = f->s_end; /* nothing to fold: flat is where it ends */
            f->frame = f->settings.frames - 1;
            frame = f->frame;
            f->outcome = RG_FOLDED;
        } else if (f->steps - f->frame > MOST_STEPS) { /* besides those that frames ask for */
            stop(f, "the number of steps ran out");
        } else if (creeps(f)) {
            stop(f, "it goes on in steps too small to get anywhere");
        } else {
            if (f->settings.method == RG_METHOD_EULER) step_euler(f);
            else if (f->steps == 1 && f->s == 0) leave_flat(f);
            else if (f->smooth) step_adaptive(f);
            else step_newton(f);
            if (f->outcome == RG_RUNNING && f->s >= rg_fold_frame_progress(f, f->frame)) frame = f->frame;
        }
        if (frame >= 0) f->frame = frame + 1;
        if (f->outcome == RG_RUNNING && f->frame == f->settings.frames) {
            f->outcome = RG_FOLDED;
            if (f->s_end >= 1) stop(f, "all frames are made");
        }
        f->steps += !f->smooth || f->steps < 2;
    }
    f->seconds_solving += seconds() - from;
    *info = (rg_step_info){f->outcome, f->s, frame, f->closure, (int32_t)(f->P.solves - solves),
                           (int32_t)(f->P.iterations - iterations)};
    return RG_OK;
}
