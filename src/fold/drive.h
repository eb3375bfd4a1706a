/* drive.h -- what the creases wish for: drho0.
 * Paper    section 2 (drho0 "calculated by mountain-valley value of the fold edges"), eq. (10)
 * Uses  mesh.h        Used by  exact.c limit.c system.c
 *
 * Progress s is the mean of rho_i / target_i over the driven creases: 0 flat, 1 folded. The wish for a small ds is
 *
 *     drho0_i = ds (target_i - rho_i) / (1 - s)        target 0 for creases that triangulation added
 *
 * At the start that is the paper's constant rate; later a crease that has run ahead is asked for less, one that lags
 * for more, one beyond its target to come back, so that all arrive together where the paper lets them. Near the end the
 * wish points straight at the folded state, which is the exact direction there: the constraint is homogeneous in what
 * is left of the angles, as it is homogeneous in the angles at the start. */
#ifndef RG_DRIVE_H
#define RG_DRIVE_H

#include "mesh/mesh.h"

typedef struct rg_drive {
    rg_memory mem;
    int32_t N, count;  /* creases; driven ones */
    double *target;    /* [N] radians; 0 for added creases, NAN for creases that wish nothing */
    /* [N] the way each is to turn when it leaves flat: its target or, where it has none, its assignment; 0: either */
    double *lean;
    double *gradient;  /* [N] ds/drho_i: 1 / (count target_i), 0 for creases not driven */
    double *along;     /* [N] the gradient over its length */
    double steepness;  /* its length, 1/radian */
} rg_drive;

/* sign: +1, or -1 with mountain and valley exchanged */
rg_status rg_drive_init(rg_drive *d, const rg_memory *mem, const rg_mesh *m, double sign);
void rg_drive_free(rg_drive *d);
/* Other targets, [N] radians, NAN: none, and creases that stay flat, still[N]; the rest follows from them. Allocates
 * nothing. */
void rg_drive_aim(rg_drive *d, const rg_mesh *m, const double *target, const unsigned char *still);

int rg_drive_is_driven(const rg_drive *d, int32_t crease);
double rg_drive_progress(const rg_drive *d, const double *rho);
/* wish[N]: out, for ds = 1: scale it. s: the progress of rho, < 1. */
void rg_drive_wish(const rg_drive *d, const double *rho, double s, double *wish);

#endif
