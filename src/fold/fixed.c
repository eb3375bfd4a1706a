#include "fold/fixed.h"
#include "base/lanes.h"
#include "fold/integrate.h"
#include "fold/newton.h"
#include "fold/tuning.h"

#include <string.h>

/* Creases beyond their limits are pulled back, along what the constraint allows; f->trial is then corrected. */
static int pull_back(rg_straight *f, double least, double gain)
{
    rg_cg_report rep;
    if (!(rg_limit_pull(&f->limit, f->trial, f->pull) > least)) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++) f->pull[i] *= gain;
    if (rg_project_step(&f->P, &f->K, f->pull, 0, NULL, f->pull, DIRECTION_SOLVED, &rep) != RG_OK) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++) f->trial[i] += f->pull[i];
    return 1;
}

/* The folded state itself, where it is within a step and straight ahead. */
static int land(rg_straight *f)
{
    const int32_t N = f->mesh.N;
    double far = 0, refused = 0, wished = 0, left = 1 - f->s;
    if (f->s_end < 1 || !f->end_is_closed) return 0;
    for (int32_t i = 0; i < N; i++) {
        double d = f->end[i] - f->rho[i];
        far = fmax(far, fabs(d));
        wished += d * d;
        refused += (d - left * f->t[i]) * (d - left * f->t[i]);
    }
    /* The wish points straight at the end; near it the constraint agrees up to second order. */
    if (!(far <= f->settings.step && refused <= 0.01 * wished)) return 0;
    rg_path_insert(&f->path, 1, f->end, NULL);
    return 1;
}

/* A step of the method's own kind from f->rho along f->t to f->trial, closed. Beyond a limit, and where a stage has no
 * direction, as in the folded state, Euler's is the method: it can be pulled back. */
static int try_step(rg_straight *f, double ds)
{
    int higher = f->settings.method == RG_METHOD_HEUN  ? rg_integrate_heun(f, ds)
                 : f->settings.method == RG_METHOD_RK4 ? rg_integrate_rk4(f, ds)
                                                       : 0;
    if (higher && !(rg_limit_pull(&f->limit, f->trial, f->pull) > 0)) return 1;
    rg_constraint_assemble(&f->K, f->rho); /* it may be that of a frame, of which a step knows nothing */
    rg_project_renew(&f->P);
    for (int32_t i = 0; i < f->mesh.N; i++) f->trial[i] = f->rho[i] + ds * f->t[i];
    pull_back(f, 0, LIMIT_GAIN);
    int closed = rg_newton_correct(f, f->s + ds, CORRECTIONS);
    for (int32_t n = 0; n < MOST_PULLS && closed && pull_back(f, LITTLE_PULL, 1); n++)
        closed = rg_newton_correct(f, f->s + ds, CORRECTIONS);
    return closed;
}

/* t at the state, which is the last node: known there, or asked for. */
static int find_tangent(rg_straight *f)
{
    const rg_path *p = &f->path;
    const rg_node *last = p->count > 0 ? &p->node[p->count - 1] : NULL;
    if (!last || !last->has_t) return rg_integrate_tangent(f, f->rho, f->s, 0, f->t) > 0;
    memcpy(f->t, last->t, (size_t)p->N * sizeof *f->t);
    return 1;
}

void rg_fixed_newton(rg_straight *f)
{
    const int32_t N = f->mesh.N;
    if (!find_tangent(f)) {
        rg_straight_stop(f, "no motion that the facets allow folds any further");
        return;
    }
    if (land(f)) return;
    double fastest = rg_lanes_largest(N, f->t), most = f->settings.step / fastest;
    const double left = f->s_end - f->s;
    double ds = fmin(f->ds, most);
    if (!(ds < left - SHORTEST)) ds = left; /* leaves no rest that would be too small a step */
    for (;; ds /= 2) {
        if (!(ds > SHORTEST)) {
            rg_straight_stop(f, "the facets leave no way on: even the smallest step does not close");
            return;
        }
        double way = ds * fastest, strayed = 0;
        if (!try_step(f, ds)) continue;
        for (int32_t i = 0; i < N; i++) {
            double d = fabs(f->trial[i] - f->rho[i] - ds * f->t[i]);
            if (!(d <= strayed)) strayed = d;
        }
        if (strayed <= FARTHEST_CORRECTION * way + LITTLE_STRAIGHT) break;
    }
    if (!(rg_lanes_largest(N, f->trial) <= RG_PI + MOST_OVER)) {
        rg_straight_stop(f, "from there on creases go past half a turn");
        return;
    }
    const double s = ds >= left ? f->s_end : f->s + ds;
    f->ds = 2 * ds;
    const int has_t = s < 1 && rg_integrate_tangent(f, f->trial, s, 0, f->t) > 0;
    rg_path_insert(&f->path, s, f->trial, has_t ? f->t : NULL);
}

/* One solve, no correction: the paper's eq. (14) and nothing else. */
void rg_fixed_euler(rg_straight *f)
{
    const int32_t N = f->mesh.N;
    rg_cg_report rep;
    rg_constraint_assemble(&f->K, f->rho);
    f->assemblies++;
    rg_project_renew(&f->P);
    rg_drive_wish(&f->drive, f->rho, fmin(f->s, 1 - SHORTEST), f->wish);
    double h = fmin(f->settings.step / fmax(rg_lanes_largest(N, f->wish), 1e-300), 1);
    rg_limit_pull(&f->limit, f->rho, f->pull);
    for (int32_t i = 0; i < N; i++) f->wish[i] = h * f->wish[i] + LIMIT_GAIN * f->pull[i];
    if (rg_project_step(&f->P, &f->K, f->wish, 1, NULL, f->t, DIRECTION_SOLVED, &rep) != RG_OK) { /* eqs. (14), (15) */
        rg_straight_stop(f, "the solver failed");
        return;
    }
    double ds = rg_drive_progress(&f->drive, f->t), part = 1, way = rg_lanes_largest(N, f->t);
    if (!(way <= RG_PI)) {
        rg_straight_stop(f, "the step diverged");
        return;
    }
    if (f->s + ds > f->s_end - SHORTEST && ds > 0) part = (f->s_end - f->s) / ds;
    if (!(part * way > SHORTEST * f->settings.step) || !(ds > 0)) {
        rg_straight_stop(f, "no motion that the facets allow folds any further");
        return;
    }
    for (int32_t i = 0; i < N; i++) f->trial[i] = f->rho[i] + part * f->t[i]; /* eq. (10) */
    rg_path_insert(&f->path, part != 1 ? f->s_end : f->s + ds, f->trial, NULL);
}
