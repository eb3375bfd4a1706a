/* newton.c -- drift worked off: eq. (14) again and again until every vertex closes. */
#include "fold/fold.h"

#include <string.h>

/* Each correction gains this factor at the least where Newton's own rate does not gain more. */
static const double SOLVE_TOLERANCE = 1e-5;
/* Progress is held to this; a frame's percent is then exact to 1e-8. */
static const double PROGRESS_TOLERANCE = 1e-10;
/* A correction that leaves more than this part of the residual is not converging; three in a row end the attempt. */
static const double POOR_GAIN = 0.7;

int rg_newton_correct(rg_fold *f, double s, int32_t most)
{
    const int32_t N = f->mesh.N;
    double before = INFINITY;
    int poor = 0;
    for (int32_t n = 0;; n++) {
        f->closure = rg_constraint_assemble(&f->K, f->trial);
        f->assemblies++;
        rg_project_renew(&f->P);
        double off = s - rg_drive_progress(&f->drive, f->trial);
        if (f->closure <= f->settings.tol && fabs(off) <= PROGRESS_TOLERANCE) return 1;
        if (n >= most || !(f->closure <= 3)) return 0;
        poor = f->closure > POOR_GAIN * before && f->closure > 10 * f->settings.tol ? poor + 1 : 0;
        if (poor >= 3) return 0;
        before = f->closure;

        /* Progress is held to the letter: without that, an over-constrained sheet, whose C has one more rank off the
         * path than on it, would trade progress for closure and creep. */
        for (int32_t i = 0; i < N; i++) f->wish[i] = off / f->drive.steepness * f->drive.along[i];
        rg_cg_report rep;
        memset(f->P.y, 0, 3 * (size_t)f->mesh.M * sizeof *f->P.y); /* the last answer has nothing to do with this one */
        if (rg_project_step(&f->P, &f->K, f->wish, 1, f->drive.along, f->wish, SOLVE_TOLERANCE, &rep) != RG_OK) return 0; /* eq. (14) */
        for (int32_t i = 0; i < N; i++) f->trial[i] += f->wish[i];
    }
}
