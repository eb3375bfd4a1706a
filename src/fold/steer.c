#include "fold/steer.h"
#include "base/lanes.h"
#include "fold/blame.h"
#include "fold/start.h"
#include "fold/tuning.h"

#include <string.h>

rg_status rg_steer_init(rg_steer *F, const rg_memory *mem, const rg_mesh *m, const rg_settings *s)
{
    memset(F, 0, sizeof *F);
    F->mem = *mem;
    F->mesh = *m;
    F->step = s->step;
    F->tol = s->tol;
    F->reason = "";
    const size_t N = (size_t)m->N;
    double **array[] = {&F->target, &F->from, &F->gradient, &F->along, &F->ray, &F->rho, &F->out, &F->trial, &F->wish,
                        &F->t, &F->pull, &F->k[0], &F->k[1], &F->k[2]};
    rg_mesh copy;
    rg_settings mine = *s;
    rg_status status = rg_constraint_init(&F->K, mem, m);
    if (status == RG_OK) status = rg_project_init(&F->P, mem, &F->K, s->solver);
    if (status == RG_OK) status = rg_limit_init(&F->limit, mem, m);
    if (status == RG_OK) status = rg_mesh_copy(m, &copy);
    mine.method = RG_METHOD_NEWTON;
    mine.memory = mem;
    if (status == RG_OK) status = rg_straight_from_mesh_together(&copy, &mine, &F->start, NULL);
    F->role = rg_mem_array(mem, N, 1);
    F->held = rg_mem_array(mem, N, 1);
    F->force = rg_mem_array(mem, (size_t)m->M, sizeof *F->force);
    int ok = F->role && F->held && F->force;
    for (int i = 0; i < 14; i++) ok &= (*array[i] = rg_mem_array(mem, N, sizeof(double))) != NULL;
    return status == RG_OK && !ok ? RG_ENOMEM : status;
}

void rg_steer_free(rg_steer *F)
{
    if (!F->mem.resize) return;
    rg_constraint_free(&F->K);
    rg_project_free(&F->P);
    rg_limit_free(&F->limit);
    rg_straight_destroy(F->start);
    void *block[] = {F->role, F->held, F->target, F->from, F->gradient, F->along, F->ray, F->rho, F->out, F->trial,
                     F->wish, F->t, F->pull, F->k[0], F->k[1], F->k[2], F->force};
    for (int i = 0; i < 17; i++) rg_mem_free(&F->mem, block[i]);
    memset(F, 0, sizeof *F);
}

static int is_driven(const rg_steer *F, int32_t i) { return F->role[i] == RG_ROLE_DRIVEN; }

static double way(const rg_steer *F, int32_t i) { return F->target[i] - F->from[i]; }

/* -------------------------------------------------------------------------------------------------- closing ---- */

/* The creases whose columns are not asked. */
static void hold_still(rg_steer *F)
{
    for (int32_t i = 0; i < F->K.C.N; i++) F->K.still[i] = F->held[i] || F->role[i] >= RG_ROLE_DRIVEN;
    rg_constraint_set_still(&F->K);
}

static double progress(const rg_steer *F, const double *rho)
{
    double s = 0;
    for (int32_t i = 0; i < F->K.C.N; i++) s += F->gradient[i] * (rho[i] - F->from[i]);
    return s;
}

/* trial closed, what is still as it is; progress held at s, NAN: nobody asks. Zero: it does not close. eq. (14) */
static int close_trial(rg_steer *F, double s, double *trial)
{
    const int holds = !isnan(s) && F->driven == 0 && F->steepness > 0;
    double before = INFINITY;
    int poor = 0;
    for (int32_t n = 0;; n++) {
        rg_cg_report rep;
        F->closure = rg_constraint_assemble(&F->K, trial);
        const double off = holds ? s - progress(F, trial) : 0;
        if (F->closure <= F->tol && fabs(off) <= SAME_PROGRESS &&
            (F->closure > STILL_CLOSES * before || n >= CORRECTIONS)) return 1;
        if (n >= CORRECTIONS || !(F->closure <= MOST_OPEN)) return F->closure <= F->tol && fabs(off) <= SAME_PROGRESS;
        poor = F->closure > BETTER_CLOSED * before && F->closure > 10 * F->tol ? poor + 1 : 0;
        if (poor >= MOST_POOR) return 0;
        before = F->closure;
        rg_project_renew(&F->P);
        memset(F->P.y, 0, 3 * (size_t)F->K.C.M * sizeof *F->P.y);
        for (int32_t i = 0; holds && i < F->K.C.N; i++) F->wish[i] = off / F->steepness * F->along[i];
        if (rg_project_step(&F->P, &F->K, holds ? F->wish : NULL, 1, holds ? F->along : NULL, F->wish, DIRECTION_SOLVED,
                            &rep) != RG_OK) return 0;
        for (int32_t i = 0; i < F->K.C.N; i++) trial[i] += F->wish[i];
    }
}

double rg_steer_close(rg_steer *F, const double *theta, int32_t c, double *rho)
{
    rg_constraint_set_theta(&F->K, theta ? theta : F->mesh.loop_theta);
    memset(F->K.still, 0, (size_t)F->K.C.N);
    if (c >= 0) F->K.still[c] = 1;
    rg_constraint_set_still(&F->K);
    return close_trial(F, NAN, rho) ? F->closure : NAN;
}

/* --------------------------------------------------------------------------------------------------- a leg ---- */

/* Progress where nobody is driven: the mean part of the ways of those that have one. */
static void set_gradient(rg_steer *F)
{
    F->driven = F->wishing = 0;
    F->steepness = 0;
    for (int32_t i = 0; i < F->K.C.N; i++) {
        F->driven += is_driven(F, i);
        F->wishing += F->role[i] == RG_ROLE_WISHES && way(F, i) != 0;
    }
    memset(F->gradient, 0, (size_t)F->K.C.N * sizeof *F->gradient);
    for (int32_t i = 0; i < F->K.C.N; i++)
        if (F->driven == 0 && F->role[i] == RG_ROLE_WISHES && way(F, i) != 0)
            F->gradient[i] = 1 / (F->wishing * way(F, i));
    for (int32_t i = 0; i < F->K.C.N; i++) F->steepness = hypot(F->steepness, F->gradient[i]);
    for (int32_t i = 0; i < F->K.C.N; i++) F->along[i] = F->steepness > 0 ? F->gradient[i] / F->steepness : 0;
}

static void stop(rg_steer *F, rg_outcome outcome, const char *reason)
{
    F->outcome = outcome;
    F->reason = reason;
}

/* Driven creases of x where they are at progress s. */
static void put_driven(const rg_steer *F, double s, double *x)
{
    for (int32_t i = 0; i < F->K.C.N; i++)
        if (is_driven(F, i)) x[i] = s == 1 ? F->target[i] : F->from[i] + s * way(F, i);
}

/* Off flat paper: the branch is the one that the assignments lead to. */
static int leave_flat(rg_steer *F)
{
    const int32_t N = F->K.C.N;
    rg_straight *f = F->start;
    double mean = 0;
    for (int32_t i = 0; i < N; i++) {
        const int counts = F->driven ? is_driven(F, i) : F->role[i] == RG_ROLE_WISHES;
        F->trial[i] = counts ? F->target[i] : NAN;
        f->K.still[i] = F->role[i] == RG_ROLE_STILL;
    }
    rg_constraint_set_still(&f->K);
    rg_drive_aim(&f->drive, &f->mesh, F->trial, f->K.still);
    for (int32_t i = 0; i < N; i++)
        mean += rg_drive_is_driven(&f->drive, i) ? fabs(f->drive.target[i]) / f->drive.count : 0;
    if (!(mean > 0)) return 0;
    F->ray_s = fmin(FIRST_ANGLE / mean, 0.5);
    if (!rg_start_leave_flat(f, F->ray_s)) return 0;
    memcpy(F->ray, f->rho, (size_t)N * sizeof *F->ray);
    put_driven(F, F->ray_s, F->ray);
    hold_still(F);
    if (!close_trial(F, F->ray_s, F->ray) || !(rg_lanes_largest(N, F->ray) <= FARTHEST_OFF_FLAT)) return 0;
    memcpy(F->rho, F->ray, (size_t)N * sizeof *F->rho);
    F->s = F->ray_s;
    return 1;
}

void rg_steer_begin(rg_steer *F, const double *theta, const double *rho)
{
    const int32_t N = F->K.C.N;
    rg_constraint_set_theta(&F->K, theta ? theta : F->mesh.loop_theta);
    memcpy(F->rho, rho, (size_t)N * sizeof *rho);
    memcpy(F->from, rho, (size_t)N * sizeof *rho);
    memcpy(F->out, rho, (size_t)N * sizeof *rho);
    memset(F->held, 0, (size_t)N);
    F->s = F->ray_s = 0;
    F->h = INFINITY;
    F->outcome = RG_RUNNING;
    F->reason = "";
    set_gradient(F);
    hold_still(F);
    F->closure = rg_constraint_closure(&F->K, rho, NULL);
    int moves = F->wishing > 0;
    for (int32_t i = 0; i < N; i++) moves |= is_driven(F, i) && way(F, i) != 0;
    if (!moves) stop(F, RG_FOLDED, "every crease is where it shall be");
    else if (rg_lanes_largest(N, rho) <= IS_FLAT && !leave_flat(F))
        stop(F, RG_STOPPED, "no way off the flat state was found");
}

/* ---------------------------------------------------------------------------------------------------- a step ---- */

/* t[N]: out, drho/ds at rho, closed, of progress s. Zero: there is none. eq. (9) */
static int tangent(rg_steer *F, const double *rho, double s, double *t)
{
    const int32_t N = F->K.C.N, stills = F->K.stills;
    rg_cg_report rep;
    for (int32_t i = 0; i < N; i++) F->wish[i] = is_driven(F, i) ? way(F, i) : 0;
    F->K.stills = 0;
    rg_constraint_assemble(&F->K, rho);
    rg_sparse_mul(&F->K.C, F->wish, F->K.r); /* C_D drho_D */
    F->K.stills = stills;
    rg_constraint_forget_still(&F->K);
    rg_project_renew(&F->P);
    for (int32_t i = 0; i < N; i++)
        if (F->role[i] == RG_ROLE_WISHES && !F->held[i])
            F->wish[i] = (F->target[i] - rho[i]) / fmax(1 - s, NEAREST_TARGET);
    memset(F->P.y, 0, 3 * (size_t)F->K.C.M * sizeof *F->P.y);
    if (rg_project_step(&F->P, &F->K, F->wish, 1, NULL, t, DIRECTION_SOLVED, &rep) != RG_OK) return 0;
    if (F->driven) return 1;
    double along = 0;
    for (int32_t i = 0; i < N; i++) along += F->gradient[i] * t[i];
    if (!(along > LEAST_EFFICIENCY)) return 0;
    for (int32_t i = 0; i < N; i++) t[i] /= along;
    return 1;
}

/* trial = rho + ds k, closed at progress s; next: t there. */
static int stage(rg_steer *F, double ds, const double *k, double s, double *next)
{
    for (int32_t i = 0; i < F->K.C.N; i++) F->trial[i] = F->rho[i] + ds * k[i];
    put_driven(F, s, F->trial);
    return close_trial(F, s, F->trial) && tangent(F, F->trial, s, next);
}

/* The classical method of Runge and Kutta from s to s + ds, into trial; where it has no direction at its end,
 * Euler's. */
static int try_step(rg_steer *F, double ds)
{
    const int32_t N = F->K.C.N;
    const double *k1 = F->t, *k2 = F->k[0], *k3 = F->k[1], *k4 = F->k[2];
    const int whole = stage(F, ds / 2, k1, F->s + ds / 2, F->k[0]) && stage(F, ds / 2, k2, F->s + ds / 2, F->k[1]) &&
                      stage(F, ds, k3, F->s + ds, F->k[2]);
    for (int32_t i = 0; i < N; i++)
        F->trial[i] = F->rho[i] + (whole ? ds / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) : ds * k1[i]);
    put_driven(F, F->s + ds, F->trial);
    for (int32_t i = 0; i < N; i++)
        if (F->held[i]) F->trial[i] = copysign(RG_PI, F->trial[i]);
    return close_trial(F, F->s + ds, F->trial);
}

/* Creases that trial takes past half a turn are held there; how many are new. */
static int32_t hold_what_overfolds(rg_steer *F)
{
    int32_t more = 0;
    for (int32_t i = 0; i < F->K.C.N; i++) {
        if (F->held[i] || F->role[i] >= RG_ROLE_DRIVEN || fabs(F->trial[i]) <= RG_PI + PAST) continue;
        F->held[i] = 1;
        more++;
    }
    if (more) hold_still(F);
    return more;
}

/* Is trial where the tangent leads, to first order? */
static int is_on_branch(const rg_steer *F, double ds)
{
    double off = 0, far = 0;
    for (int32_t i = 0; i < F->K.C.N; i++) {
        const double d = fabs(F->trial[i] - F->rho[i] - ds * F->t[i]), t = fabs(ds * F->t[i]);
        if (!(d <= off)) off = d;
        if (!(t <= far)) far = t;
    }
    return off <= FARTHEST_CORRECTION * far + LITTLE_STRAIGHT;
}

static void accept(rg_steer *F, double s)
{
    memcpy(F->rho, F->trial, (size_t)F->K.C.N * sizeof *F->rho);
    F->s = s;
    F->steps++;
}

/* Where all that wish are near their targets, in `at`: there, if that closes. */
static int land(rg_steer *F, double goal, const double *at)
{
    double *end = F->pull;
    if (F->driven || goal < 1) return 0;
    for (int32_t i = 0; i < F->K.C.N; i++) {
        if (F->role[i] == RG_ROLE_FREE && i < F->mesh.N - F->mesh.added) return 0;
        if (F->role[i] == RG_ROLE_WISHES && !(fabs(F->target[i] - at[i]) <= LANDING)) return 0;
        end[i] = F->role[i] == RG_ROLE_WISHES ? F->target[i] : F->role[i] == RG_ROLE_FREE ? 0 : F->rho[i];
    }
    const double closure = rg_constraint_closure(&F->K, end, NULL);
    if (!(closure <= F->tol)) return 0;
    F->closure = closure;
    memcpy(F->trial, end, (size_t)F->K.C.N * sizeof *end);
    accept(F, 1);
    return 1;
}

/* One step towards goal. */
static void go_on(rg_steer *F, double goal)
{
    const double left = goal - F->s;
    memset(F->held, 0, (size_t)F->K.C.N);
    hold_still(F);
    if (land(F, goal, F->rho)) return;
    for (int32_t round = 0; round < ROUNDS; round++) {
        if (!tangent(F, F->rho, F->s, F->t)) break;
        const double fastest = rg_lanes_largest(F->K.C.N, F->t);
        double ds = fmin(fmin(F->h, left), F->step / fastest);
        if (left - ds < SHORTEST) ds = left;
        int made = 0;
        for (; !made && ds > fmin(SHORTEST, left / 2); ds /= made ? 1 : 2)
            made = try_step(F, ds) && is_on_branch(F, ds);
        if (!made) break;
        if (ds == left && land(F, goal, F->trial)) return; /* the end itself, which a step may be past by its error */
        if (round + 1 < ROUNDS && hold_what_overfolds(F)) continue;
        F->h = ds == left ? fmax(F->h, 2 * ds) : 2 * ds;
        accept(F, ds == left ? goal : F->s + ds);
        return;
    }
    stop(F, RG_STOPPED, "no motion that the facets allow goes any further");
}

void rg_steer_to(rg_steer *F, double goal)
{
    const int32_t N = F->K.C.N;
    if (goal < F->ray_s) { /* so near flat what closes is homogeneous: a ray */
        for (int32_t i = 0; i < N; i++) F->out[i] = F->trial[i] = goal / F->ray_s * F->ray[i];
        put_driven(F, goal, F->trial);
        memset(F->held, 0, (size_t)N);
        hold_still(F);
        if (close_trial(F, goal, F->trial)) memcpy(F->out, F->trial, (size_t)N * sizeof *F->out);
        return;
    }
    while (F->outcome == RG_RUNNING && F->s < goal) go_on(F, goal);
    memcpy(F->out, F->rho, (size_t)N * sizeof *F->out);
    F->closure = rg_constraint_closure(&F->K, F->out, NULL);
    if (F->outcome == RG_RUNNING && F->s >= 1) stop(F, RG_FOLDED, "every driven crease is where it shall be");
}

/* ---------------------------------------------------------------------------------------------------- blame ---- */

void rg_steer_blame(rg_steer *F, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases)
{
    const rg_sparse *C = &F->K.C;
    rg_cg_report rep;
    *vertices = *creases = 0;
    for (int32_t i = 0; i < C->N; i++) {
        F->wish[i] = F->role[i] == RG_ROLE_DRIVEN || F->role[i] == RG_ROLE_WISHES ? F->target[i] - F->rho[i] : 0;
        F->K.still[i] = F->role[i] == RG_ROLE_STILL;
        if (fabs(F->wish[i]) > ARRIVED * fabs(way(F, i))) crease[(*creases)++] = i;
    }
    rg_constraint_set_still(&F->K);
    rg_constraint_assemble(&F->K, F->rho);
    rg_project_renew(&F->P);
    memset(F->P.y, 0, 3 * (size_t)C->M * sizeof *F->P.y);
    const rg_status s = rg_project_step(&F->P, &F->K, F->wish, 0, NULL, F->t, DIRECTION_SOLVED, &rep); /* eq. (15): y */
    if (s == RG_OK) *vertices = rg_blame_vertices(&F->mesh, C->x, F->P.y, F->force, vertex);
}

/* --------------------------------------------------------------------------------------------------- keeping ---- */

rg_status rg_steer_kept_init(rg_steer_kept *k, const rg_memory *mem, int32_t N)
{
    *k = (rg_steer_kept){.number = rg_mem_array(mem, 5 * (size_t)N, sizeof *k->number),
                         .role = rg_mem_array(mem, (size_t)N, 1), .reason = ""};
    if (k->number && k->role) return RG_OK;
    rg_steer_kept_free(k, mem);
    return RG_ENOMEM;
}

void rg_steer_kept_free(rg_steer_kept *k, const rg_memory *mem)
{
    rg_mem_free(mem, k->number);
    rg_mem_free(mem, k->role);
    *k = (rg_steer_kept){0};
}

void rg_steer_keep(const rg_steer *F, rg_steer_kept *k)
{
    const size_t N = (size_t)F->K.C.N;
    const double *const number[] = {F->target, F->from, F->ray, F->rho, F->out};
    for (size_t i = 0; i < 5; i++) memcpy(k->number + i * N, number[i], N * sizeof(double));
    memcpy(k->role, F->role, N);
    k->ray_s = F->ray_s, k->s = F->s, k->h = F->h, k->closure = F->closure;
    k->outcome = F->outcome, k->reason = F->reason;
}

void rg_steer_return(rg_steer *F, const double *theta, const rg_steer_kept *k)
{
    const size_t N = (size_t)F->K.C.N;
    double *const number[] = {F->target, F->from, F->ray, F->rho, F->out};
    rg_constraint_set_theta(&F->K, theta ? theta : F->mesh.loop_theta);
    for (size_t i = 0; i < 5; i++) memcpy(number[i], k->number + i * N, N * sizeof(double));
    memcpy(F->role, k->role, N);
    F->ray_s = k->ray_s, F->s = k->s, F->h = k->h, F->closure = k->closure;
    F->outcome = k->outcome, F->reason = k->reason;
    memset(F->held, 0, N);
    set_gradient(F);
    hold_still(F);
}
