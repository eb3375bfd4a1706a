#include "chart/run.h"
#include "base/clock.h"

#include <string.h>

/* A time is known when it was taken so often and has taken this long in all. */
static const double LONG_ENOUGH = 0.02;
static const int FEWEST_REPEATS = 3, MOST_REPEATS = 100;

const char *rg_run_method_name(rg_method m)
{
    static const char *const names[] = {"auto", "euler", "newton", "heun", "rk4", "adaptive", "relaxed"};
    return names[m];
}

const char *rg_run_solver_name(rg_solver s)
{
    static const char *const names[] = {"auto", "cg", "cholesky", "svd"};
    return names[s];
}

rg_status rg_frames_init(rg_frames *f, const rg_memory *mem, int32_t N, int32_t room)
{
    *f = (rg_frames){N, 0, room, rg_mem_array(mem, (size_t)N * (size_t)room, sizeof *f->rho)};
    return f->rho ? RG_OK : RG_ENOMEM;
}

static double distance(int32_t N, const double *a, const double *b)
{
    double far = 0;
    for (int32_t i = 0; i < N; i++)
        if (!(fabs(a[i] - b[i]) <= far)) far = fabs(a[i] - b[i]);
    return far;
}

double rg_frames_distance(const rg_frames *a, const rg_frames *b)
{
    double far = 0;
    for (int32_t k = 0; k < a->count && k < b->count; k++) {
        const size_t at = (size_t)k * (size_t)a->N;
        const double d = distance(a->N, a->rho + at, b->rho + at);
        if (!(d <= far)) far = d;
    }
    return far;
}

/* What one system's counters say, in its own products with C: two multiplications and additions a number of C. */
static double passes_of_one(const rg_straight *f, double pass)
{
    double sum = RG_ASSEMBLY_PASSES * (double)f->assemblies + 2 * (double)f->P.solves + 2 * (double)f->P.iterations;
    if (f->P.solver == RG_SOLVER_CHOLESKY)
        sum += ((double)f->P.cholesky.factorizations * f->P.cholesky.L.S.flops +
                4 * (double)f->P.cholesky.triangular * f->P.cholesky.L.S.entries) / pass;
    if (f->P.solver == RG_SOLVER_SVD) { /* Golub and Reinsch's count, 4 m^2 n + 8 m n^2 + 9 n^3 */
        const double a = 3.0 * f->mesh.M, b = f->mesh.N, big = fmax(a, b), small = fmin(a, b);
        const double once = 4 * big * big * small + 8 * big * small * small + 9 * small * small * small;
        sum += (double)f->P.factorizations * once / pass;
    }
    return sum;
}

/* In products with the C of all. */
static double passes(const rg_straight *f)
{
    rg_straight *const *system;
    double sum = 0, all = 0;
    for (int32_t p = rg_straight_systems(f, &system); p-- > 0;) {
        const double blocks = system[p]->K.C.start[system[p]->mesh.M], pass = 6 * (blocks > 0 ? blocks : 1);
        sum += pass * passes_of_one(system[p], pass);
        all += pass;
    }
    return sum / all;
}

static void frame(rg_run *r, const rg_straight *f, const rg_frames *with, rg_frames *keep)
{
    const int32_t k = r->frames++, N = f->mesh.N;
    const double closure = rg_constraint_closure((rg_constraint *)&f->K, f->rho, NULL);
    if (!(closure <= r->closure)) r->closure = closure;
    for (int32_t i = 0; i < N; i++)
        if (!(fabs(f->rho[i]) - RG_PI <= r->beyond)) r->beyond = fabs(f->rho[i]) - RG_PI;
    if (with && k < with->count) {
        const double d = distance(N, f->rho, with->rho + (size_t)k * (size_t)N);
        if (!(d <= r->error)) r->error = d;
    }
    if (keep && k < keep->room) {
        memcpy(keep->rho + (size_t)k * (size_t)N, f->rho, (size_t)N * sizeof *f->rho);
        keep->count = k + 1;
    }
}

/* Steps are to be no longer than this part of what lies behind and before them. */
static void grade(rg_straight *f, double part)
{
    rg_straight *const *system;
    for (int32_t p = rg_straight_systems(f, &system); p-- > 0;) {
        rg_straight *g = system[p];
        g->graded = 1;
        if (g->s > 0) g->ds = fmin(g->ds, part * fmin(g->s, fmax(1 - g->s, 1e-4)));
    }
}

/* Is it where it was to go, or was it only to go part of the way? */
static int has_landed(const rg_straight *f)
{
    int landed = 1;
    for (int32_t i = 0; i < f->mesh.N && f->s_end >= 1; i++)
        if (rg_drive_is_driven(&f->drive, i)) landed &= f->rho[i] == f->drive.target[i];
    return landed;
}

rg_status rg_run_make(rg_run *r, const rg_mesh *m, const rg_settings *settings, const rg_way *way,
                      const rg_frames *with, rg_frames *keep, rg_diag *why)
{
    rg_settings s = *settings;
    rg_mesh copy;
    rg_straight *f = NULL;
    rg_step_info info = {0};
    memset(r, 0, sizeof *r);
    r->way = *way;
    r->pattern_error = NAN;
    s.method = way->method;
    s.solver = way->solver;
    s.step = way->step;
    s.tol = way->tol;
    rg_status status = rg_mesh_copy(m, &copy);
    if (status != RG_OK) return status;
    double begun = rg_seconds(), looking = 0; /* at frames, which is not folding */
    status = rg_straight_from_mesh(&copy, &s, &f, why);
    while (status == RG_OK && info.outcome == RG_RUNNING) {
        if (way->grade > 0) grade(f, way->grade);
        status = rg_straight_step(f, &info);
        /* Within 1 % of the end and no way on, or crept up to it beside it: that is the last frame, but not one to
         * measure others by. */
        const int last = info.outcome == RG_FOLDED && r->frames == s.frames - 1 && (info.frame < 0 || !has_landed(f));
        if (info.frame < 0 && !last) continue;
        const double from = rg_seconds();
        frame(r, f, with, last ? NULL : keep);
        looking += rg_seconds() - from;
    }
    r->seconds = rg_seconds() - begun - looking;
    if (status == RG_OK) {
        r->method = f->settings.method;
        const rg_cost cost = rg_straight_cost(f);
        r->solver = rg_straight_solver(f);
        r->outcome = info.outcome;
        r->percent = 100 * info.progress;
        r->passes = passes(f);
        r->steps = cost.steps;
        r->solves = cost.solves;
        r->iterations = cost.iterations;
        r->factorizations = cost.factorizations;
        r->assemblies = cost.assemblies;
        if (!with || with->count < 2) r->error = NAN; /* flat, they are all alike */
    }
    rg_straight_destroy(f);
    return status;
}

rg_status rg_run_time(rg_run *r, const rg_mesh *m, const rg_settings *s, double patience, rg_diag *why)
{
    double all = r->seconds;
    rg_status status = RG_OK;
    for (int n = 1; n < MOST_REPEATS && status == RG_OK && (all < LONG_ENOUGH || n < FEWEST_REPEATS) &&
         all < patience; n++) {
        rg_run again;
        status = rg_run_make(&again, m, s, &r->way, NULL, NULL, why);
        all += again.seconds;
        r->seconds = fmin(r->seconds, again.seconds);
    }
    return status;
}
