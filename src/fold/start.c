/* start.c -- leaving the flat state.
 *
 * Flat, C has rank 2 at each vertex: every in-plane combination of rates is allowed to first order, and which of them
 * can go on is a question of second order, sum over i < j of rho_i rho_j (e_i x e_j) = 0 at each vertex. That is a cone
 * of branches through the flat state. A first linear step followed by Newton at a fixed small progress solves these
 * homogeneous equations for the branch nearest to the wish; whether it is the right one shows in its signs. Where a
 * crease comes out on the wrong side the attempt is repeated with that crease asked for more strongly. */
#include "fold/start.h"
#include "fold/newton.h"
#include "fold/tuning.h"

#include <string.h>

/* Sum of the wrong-sided parts, each over the mean; 0: all on the right side. */
static double wrongness(const rg_straight *f, const double *rho, double s1)
{
    double sum = 0;
    for (int32_t i = 0; i < f->mesh.N; i++) {
        if (f->drive.lean[i] == 0) continue;
        double part = rho[i] / f->drive.lean[i] / s1;
        if (!(part >= -HARDLY_TURNS)) sum += fmin(-part, MOST_WRONG);
    }
    return sum;
}

/* t = the wish in f->wish projected at the flat state, scaled to ds/dt = 1. */
static int flat_direction(rg_straight *f)
{
    rg_cg_report rep;
    memset(f->trial, 0, (size_t)f->mesh.N * sizeof *f->trial);
    f->closure = rg_constraint_assemble(&f->K, f->trial);
    f->assemblies++;
    rg_project_renew(&f->P);
    memset(f->P.y, 0, 3 * (size_t)f->mesh.M * sizeof *f->P.y);
    if (rg_project_step(&f->P, &f->K, f->wish, 0, NULL, f->t, DIRECTION_SOLVED, &rep) != RG_OK) return 0; /* eq. (9) */
    double along = rg_drive_progress(&f->drive, f->t);
    if (!(along > 0)) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++) f->t[i] /= along;
    return 1;
}

/* At f->trial, closed: one step of the wish with progress held, then closed again. */
static int slide(rg_straight *f, double s1, double gain)
{
    const int32_t N = f->mesh.N;
    rg_cg_report rep;
    for (int32_t i = 0; i < N; i++) {
        double target = f->drive.target[i];
        f->wish[i] = isnan(target) ? 0 : gain * (s1 * target - f->trial[i]);
    }
    memset(f->P.y, 0, 3 * (size_t)f->mesh.M * sizeof *f->P.y);
    if (rg_project_step(&f->P, &f->K, f->wish, 0, NULL, f->wish, DIRECTION_SOLVED, &rep) != RG_OK) return 0;
    for (int32_t i = 0; i < N; i++) f->trial[i] += f->wish[i];
    return rg_newton_correct(f, s1, CORRECTIONS_OFF_FLAT);
}

int rg_start_leave_flat(rg_straight *f, double s1)
{
    const int32_t N = f->mesh.N;
    const size_t bytes = (size_t)N * sizeof(double);
    double least = INFINITY;
    double *loud = f->pull; /* how strongly each crease is asked */
    for (int32_t i = 0; i < N; i++) loud[i] = 1;

    for (int32_t attempt = 0; attempt < MOST_STARTS && least > 0; attempt++) {
        for (int32_t i = 0; i < N; i++)
            f->wish[i] = loud[i] * f->drive.lean[i];
        if (!flat_direction(f)) break;
        for (int32_t i = 0; i < N; i++) f->trial[i] = s1 * f->t[i];
        int closed = rg_newton_correct(f, s1, CORRECTIONS_OFF_FLAT);
        for (int32_t n = 0; closed && n < SLIDES && wrongness(f, f->trial, s1) > 0; n++)
            closed = slide(f, s1, SLIDE_GAIN);
        double wrong = closed ? wrongness(f, f->trial, s1) : INFINITY;
        if (wrong < least) {
            least = wrong;
            memcpy(f->best, f->trial, bytes);
        }
        for (int32_t i = 0; i < N; i++)
            if (f->drive.lean[i] != 0 && !(f->trial[i] / f->drive.lean[i] >= HARDLY_RIGHT * s1)) loud[i] *= LOUDER;
    }
    if (!(least < INFINITY)) return 0;
    memcpy(f->rho, f->best, bytes);
    f->s = s1; /* it was held there */
    return 1;
}
