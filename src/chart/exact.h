/* exact.h -- folded states in closed form, of sheets whose interior vertices all have four creases and fold flat.
 * Paper    none; degree-4 vertices as in Hull, "Project Origami"        Uses  drive.h        Used by  reference.c
 *
 * At such a vertex opposite creases fold alike but for the sign of one, and the tangents of half the angles of the two
 * pairs keep their ratio, whichever way it folds. Along a connected sheet every crease then is
 *
 *     tan(rho_i / 2) = c_i tan u,      0 <= u <= pi / 2
 *
 * and the sheet folds if the ratios agree around every facet. No equation of the paper is used here. */
#ifndef RG_EXACT_H
#define RG_EXACT_H

#include "fold/drive.h"

typedef struct rg_exact {
    rg_memory mem;
    int32_t N;
    int found;  /* zero: this sheet has no such form */
    double *c;  /* [N] */
} rg_exact;

/* RG_ENOMEM; RG_OK also where nothing is found. Owner: the caller, rg_exact_free. */
rg_status rg_exact_init(rg_exact *x, const rg_memory *mem, const rg_mesh *m);
void rg_exact_free(rg_exact *x);
/* rho[N]: out, at progress s of the drive, 0 ... 1. */
void rg_exact_at(const rg_exact *x, const rg_drive *d, double s, double *rho);

#endif
