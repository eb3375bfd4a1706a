/* newton.c -- drift worked off: eq. (14) again and again until every vertex closes. */
#include "fold/newton.h"

#include <string.h>

/* Each correction gains this factor at the least where Newton's own rate does not gain more. */
static const double SOLVE_TOLERANCE = 1e-5, NEAR_SOLVE_TOLERANCE = 1e-4;
/* Where there is one correction only, what it leaves is looked at anyway: the factor is used once. */
static const double ONCE = 1;
/* Progress is held to this; a frame's percent is then exact to 1e-8. */
static const double PROGRESS_TOLERANCE = 1e-10;
/* A correction that leaves more than this part of the residual is not converging; three in a row end the attempt. */
static const double POOR_GAIN = 0.7;
/* One that leaves no less than this is rounding, if it closes to tolerance; if not, the factor is made anew. */
static const double GOOD_GAIN = 0.1;
/* A factor is kept while no crease has moved farther than this since it was made. It is off by as much, against slow
 * modes of 1e-4 or so; and with more equations than creases those that say the same thing twice no longer agree, which
 * the factor takes for a mode of that size, to be seen beside the square root of its beta. */
static const double NEAR = 1e-4, NEAR_OVERCONSTRAINED = 1e-6;
/* Rounding leaves some 1e-15 at a vertex. What closes to the tolerance asked for is corrected down to this as long as
 * that is quick, since angles are off by more than closure is: by its ratio to the slowest mode. */
static const double ROUNDING = 1e-13;

/* Eq. (14) with the wish for what progress is off. It is held to the letter: without that, an over-constrained sheet, whose C
 * has one more rank off the path than on it, would trade progress for closure and creep. */
static int correct_held(rg_straight *f, double off, double tol)
{
    rg_cg_report rep;
    for (int32_t i = 0; i < f->mesh.N; i++) f->wish[i] = off / f->drive.steepness * f->drive.along[i];
    return rg_project_step(&f->P, &f->K, f->wish, 1, f->drive.along, f->wish, tol, &rep) == RG_OK; /* eq. (14) */
}

/* Eq. (14) without a wish; what progress is off after that is made good along t, a motion that the facets allow. */
static int correct_along(rg_straight *f, double off, double tol, const double *t)
{
    rg_cg_report rep;
    if (rg_project_step(&f->P, &f->K, NULL, 1, NULL, f->wish, tol, &rep) != RG_OK) return 0;
    off -= rg_drive_progress(&f->drive, f->wish);
    for (int32_t i = 0; i < f->mesh.N; i++) f->wish[i] += off * t[i];
    return 1;
}

int rg_newton_close(rg_straight *f, double s, int32_t most_corrections, int near, const double *t)
{
    const int32_t N = f->mesh.N;
    const double tol = f->settings.tol, solve_tol = most_corrections == 1 ? ONCE : near ? NEAR_SOLVE_TOLERANCE : SOLVE_TOLERANCE;
    const double far = f->mesh.N <= 3 * f->mesh.M ? NEAR_OVERCONSTRAINED : NEAR;
    double before = INFINITY;
    int poor = 0;
    if (!near) f->moved = INFINITY;
    for (int32_t n = 0;; n++) {
        f->closure = rg_constraint_assemble(&f->K, f->trial);
        f->assemblies++;
        if (f->moved <= far && (n == 0 || f->closure <= GOOD_GAIN * before)) rg_project_renew_near(&f->P);
        else rg_project_renew(&f->P);
        double off = s - rg_drive_progress(&f->drive, f->trial);
        int closed = f->closure <= tol && fabs(off) <= PROGRESS_TOLERANCE;
        if (closed && (f->closure <= ROUNDING || f->closure > GOOD_GAIN * before || n >= most_corrections)) return 1;
        if (n >= most_corrections || !(f->closure <= 3)) return 0;
        poor = f->closure > POOR_GAIN * before && f->closure > 10 * tol ? poor + 1 : 0;
        if (poor >= 3) return 0;
        before = f->closure;

        memset(f->P.y, 0, 3 * (size_t)f->mesh.M * sizeof *f->P.y); /* the last answer has nothing to do with this one */
        if (!(t ? correct_along(f, off, solve_tol, t) : correct_held(f, off, solve_tol))) return 0;
        double most = 0;
        for (int32_t i = 0; i < N; i++) {
            f->trial[i] += f->wish[i];
            if (!(fabs(f->wish[i]) <= most)) most = fabs(f->wish[i]);
        }
        f->moved = f->moved <= far ? f->moved + most : most;
    }
}

int rg_newton_correct(rg_straight *f, double s, int32_t most)
{
    return rg_newton_close(f, s, most, 0, NULL);
}
