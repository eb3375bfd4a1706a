/* newton.c -- drift worked off: eq. (14) again and again until every vertex closes. */
#include "fold/newton.h"
#include "fold/tuning.h"

#include <string.h>

/* Eq. (14) with the wish for what progress is off. It is held to the letter: without that, an over-constrained sheet,
 * whose C has one more rank off the path than on it, would trade progress for closure and creep. */
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
    const double usual = near ? CORRECTION_SOLVED_NEAR : CORRECTION_SOLVED;
    const double tol = f->settings.tol, solve_tol = most_corrections == 1 ? SOLVED_ONCE : usual;
    const double far = f->mesh.N <= 3 * f->mesh.M ? SAME_FACTOR_OVERCONSTRAINED : SAME_FACTOR;
    double before = INFINITY;
    int poor = 0;
    if (!near) f->moved = INFINITY;
    for (int32_t n = 0;; n++) {
        f->closure = rg_constraint_assemble(&f->K, f->trial);
        f->assemblies++;
        if (f->moved <= far && (n == 0 || f->closure <= STILL_CLOSES * before)) rg_project_renew_near(&f->P);
        else rg_project_renew(&f->P);
        double off = s - rg_drive_progress(&f->drive, f->trial);
        int closed = f->closure <= tol && fabs(off) <= SAME_PROGRESS;
        if (closed && (f->closure <= ROUNDING || f->closure > STILL_CLOSES * before || n >= most_corrections)) return 1;
        if (n >= most_corrections || !(f->closure <= MOST_OPEN)) return 0;
        poor = f->closure > BETTER_CLOSED * before && f->closure > 10 * tol ? poor + 1 : 0;
        if (poor >= MOST_POOR) return 0;
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
