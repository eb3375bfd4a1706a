/* reference.h -- the path that methods are measured against, and how well it is known.
 * Uses  exact.h run.h        Used by  chart.c order.c
 *
 * The closed form where there is one. Else the classical Runge-Kutta's steps, graded towards the flat and the folded
 * state where the path bends at the scale of its distance from them, halved until halving changes nothing. */
#ifndef RG_REFERENCE_H
#define RG_REFERENCE_H

#include "chart/exact.h"
#include "chart/run.h"

enum { RG_HALVINGS = 6 };

typedef struct rg_reference {
    rg_memory mem;
    rg_frames frames;
    int exact;                 /* closed form */
    double closure;            /* of the closed form, which knows nothing of it */
    int32_t halvings;
    double grade[RG_HALVINGS]; /* of each try */
    double change[RG_HALVINGS]; /* against the try before; NAN for the first */
    double error;              /* as far as can be told, radians; INFINITY: nothing can */
} rg_reference;

/* RG_OK also where the path ends early: frames.count tells. Owner: the caller, rg_reference_free. */
rg_status rg_reference_make(rg_reference *ref, const rg_memory *mem, const rg_mesh *m, const rg_settings *s,
                            rg_diag *why);
void rg_reference_free(rg_reference *ref);

#endif
