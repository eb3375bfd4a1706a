#include "fold/closing.h"
#include "fold/tuning.h"

#include <string.h>

double rg_closing_progress(const rg_relax *F, const double *rho, double *least)
{
    double sum = 0;
    *least = F->driven ? INFINITY : 1;
    for (int32_t i = 0; i < F->N; i++) {
        if (F->slope[i] == 0) continue;
        const double part = fmin(1, (rho[i] - F->from[i]) * F->slope[i]);
        sum += part;
        *least = fmin(*least, part);
    }
    return F->driven ? sum / F->driven : 1;
}

void rg_closing_even_out(rg_relax *F, double *z)
{
    if (!F->symmetry) return;
    rg_symmetry_mean(F->symmetry, z);
    rg_freedom_mean(&F->freedom, F->symmetry, z + F->N, F->spare);
}

/* -------------------------------------------------- the constraint; evenly: one of each orbit, if that tells all -- */

static rg_coupled *system_of(rg_relax *F, int evenly) { return evenly && F->by_orbits ? &F->orbits : &F->J; }

double rg_closing_assemble(rg_relax *F, const double *z, int evenly, double *off)
{
    F->assemblies++;
    return rg_coupled_assemble(system_of(F, evenly), z, z + F->N, off);
}

void rg_closing_renew(rg_relax *F, int evenly, double damping)
{
    rg_coupled *J = system_of(F, evenly);
    /* A factorisation is worth its flops; filling and solving go with the entries. */
    F->work += 1.5e-9 * J->A.L.S.flops + 6e-7 * J->A.start[J->A.columns];
    for (int32_t i = 0; evenly && i < F->N; i++) F->scale[i] = F->scale[F->symmetry->crease_orbit[i]];
    J->A.damping = damping;
    rg_coupled_renew(J, F->scale);
}

void rg_closing_solve(rg_relax *F, int evenly, const double *y, const double *r, double *x)
{
    rg_coupled_solve(system_of(F, evenly), y, r, x);
}

/* ---------------------------------------------------------------------------------------------- closing ---- */

static void stiffen(rg_relax *F, double by)
{
    for (int32_t i = 0; i < F->N; i++) F->scale[i] *= by;
}

double rg_closing_project_slope(rg_relax *F, const double *z, int evenly)
{
    double left = 0, all = 0;
    for (int32_t i = 0; i < F->n; i++) {
        const int counts = i < F->N && F->slope[i] != 0 && (z[i] - F->from[i]) * F->slope[i] < 1;
        F->g[i] = counts ? F->scale[i] * F->slope[i] / F->driven : 0;
    }
    rg_closing_solve(F, evenly, F->g, NULL, F->t);
    for (int32_t i = 0; i < F->n; i++) {
        F->t[i] = F->g[i] - F->t[i];
        left += F->t[i] * F->g[i];
        all += F->g[i] * F->g[i];
    }
    return left > LEAST_LEFT * all ? left : 0;
}

/* Works off r and r' as assembled, to first order, eqs. (14), (19) with no wish; and where s is a number what progress
 * is off it by, as one more row: with the wish along the part of the slope of progress that the constraint leaves over.
 * renew zero: with the matrix of a state so near that nothing is lost by it. */
static void correct_once(rg_relax *F, double s, double *z, int evenly, int renew)
{
    const int held = !isnan(s);
    double least, along = 0, by = 0;
    if (renew) rg_closing_renew(F, evenly, F->damping * F->closure);
    rg_closing_solve(F, evenly, NULL, F->K.r, F->dz);
    if (held && renew) F->left = rg_closing_project_slope(F, z, evenly);
    for (int32_t i = 0; held && i < F->n; i++) along += F->g[i] * F->dz[i];
    if (held && F->left > 0) by = (s - rg_closing_progress(F, z, &least) + along) / F->left;
    for (int32_t i = 0; i < F->n; i++) {
        if (held) F->dz[i] -= by * F->t[i];
        F->dz[i] *= F->scale[i];
    }
    if (evenly && !F->by_orbits) rg_closing_even_out(F, F->dz);
    for (int32_t i = 0; i < F->n; i++) z[i] -= F->dz[i];
}

/* Will a correction with the matrix of the last one, which took `before` to closure, do? As much farther off as that
 * one was, it leaves as large a part. */
static int is_near(double closure, double before, double tol) { return closure * closure <= tol * before; }

static int is_within(const rg_relax *F, const rg_leash *by)
{
    double far = 0;
    for (int32_t i = 0; by && i < F->N; i++) far = fmax(far, fabs(F->trial[i] - F->z[i] - by->f * F->chord[i]));
    return !by || far <= by->farthest;
}

int rg_closing_correct(rg_relax *F, double *z, double s, int32_t most, const rg_leash *by)
{
    double before = INFINITY, least = INFINITY, off;
    int poor = 0, evenly = F->symmetry != NULL, closes = 0, stiff = 0, near = 0;
    for (int32_t n = 0;; n++) {
        F->closure = rg_closing_assemble(F, z, evenly, &off);
        closes = F->closure <= F->tol && off <= F->tol;
        if (closes || n >= most || !(F->closure <= MOST_OPEN) || !is_within(F, by)) break;
        if (evenly && F->closure > STILL_CLOSES * before) {
            evenly = F->by_orbits;
            if (!stiff && F->U > 0) {
                stiffen(F, STIFF);
                least = INFINITY; /* another system */
            }
            stiff = F->U > 0;
        }
        poor = F->closure > BETTER_CLOSED * least ? poor + 1 : 0;
        if (poor >= MOST_POOR_MOVING || (poor > 0 && fabs(F->closure - before) <= OUT_OF_REACH * before)) break;
        least = fmin(least, F->closure);
        near = is_near(F->closure, before, F->tol);
        before = F->closure;
        correct_once(F, s, z, evenly, n == 0 || !near);
    }
    if (stiff) stiffen(F, 1 / STIFF);
    return closes && is_within(F, by);
}

int rg_closing_on_pattern(rg_relax *F, double *rho)
{
    double *z = F->trial;
    memcpy(z, rho, (size_t)F->N * sizeof *rho);
    memset(z + F->N, 0, (size_t)F->U * sizeof *z);
    if (rg_closing_assemble(F, z, 0, NULL) <= F->tol) return 1;
    for (int32_t i = 0; i < F->N; i++) F->scale[i] = 1;
    for (int32_t i = F->N; i < F->n; i++) F->scale[i] *= FIXED;
    int closed = rg_closing_correct(F, z, NAN, CORRECTIONS, NULL);
    for (int32_t i = F->N; i < F->n; i++) F->scale[i] /= FIXED;
    memset(z + F->N, 0, (size_t)F->U * sizeof *z);
    closed = closed && rg_closing_assemble(F, z, 0, NULL) <= F->tol;
    for (int32_t i = 0; i < F->N; i++) closed = closed && fabs(z[i] - rho[i]) <= END_OFF;
    if (closed) memcpy(rho, z, (size_t)F->N * sizeof *rho);
    return closed;
}

/* ------------------------------------------------------------------------------------- between two nodes ---- */

/* Creases past half a turn, farther than they are at a and b, are put back and give way less than the others: how many.
 * What is allowed there is allowed between, else states near them would not come nearer to them. */
static int32_t put_back(rg_relax *F, const double *a, const double *b, double *z)
{
    int32_t held = 0;
    for (int32_t i = 0; i < F->N; i++) {
        const double most = fmax(RG_PI, fmax(fabs(a[i]), fabs(b[i])));
        if (!(fabs(z[i]) > most + BEYOND / 10)) continue;
        z[i] = copysign(most, z[i]);
        F->scale[i] = HELD_GIVES;
        held++;
    }
    return held;
}

int rg_closing_between(rg_relax *F, const double *a, const double *b, double s, int32_t most, double *z, double *best)
{
    double least_closure = INFINITY, before = INFINITY, off, least;
    int evenly = F->symmetry != NULL;
    int32_t held = 0;
    for (int32_t i = 0; i < F->N; i++) F->scale[i] = 1;
    for (int32_t i = F->N; i < F->n; i++) F->scale[i] = F->how.compliance * F->freedom.reach[i - F->N];
    F->damping = DAMPING;
    for (int32_t n = 0; n < most; n++) {
        const int32_t more = put_back(F, a, b, z);
        held += more;
        const double closure = F->closure = rg_closing_assemble(F, z, evenly, &off);
        if (!(closure <= MOST_OPEN)) break;
        if (off <= F->tol && (isnan(s) || fabs(rg_closing_progress(F, z, &least) - s) <= SAME_PROGRESS)) {
            const int no_better = closure <= F->tol && closure > 0.5 * least_closure;
            if (closure < least_closure) {
                memcpy(best, z, (size_t)F->n * sizeof *z);
                least_closure = closure;
            }
            if (closure <= CLOSE_ENOUGH * F->tol || no_better) break;
        }
        const int renew = n == 0 || more > 0 || !is_near(closure, before, CLOSE_ENOUGH * F->tol);
        if (evenly && !F->by_orbits && closure > STILL_CLOSES * before) {
            evenly = 0;
            if (F->U > 0) stiffen(F, STIFF);
        }
        if (held && closure > HARDLY_CLOSES * before) F->damping *= LESS_DAMPING;
        before = closure;
        correct_once(F, s, z, evenly, renew);
    }
    F->damping = 0;
    if (!(least_closure <= F->tol)) return 0;
    memcpy(z, best, (size_t)F->n * sizeof *z);
    F->closure = least_closure;
    return 1;
}
