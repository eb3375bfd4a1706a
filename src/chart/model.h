/* model.h -- how much of a model a sheet needs.
 * Paper    section 3.2 (what triangulation adds)        Uses  run.h        Used by  chart.c */
#ifndef RG_MODEL_H
#define RG_MODEL_H

#include "chart/run.h"

/* One way to model a sheet. */
typedef struct rg_model {
    int32_t unknowns, constraints;
    int32_t ways;       /* that it can go half way, to first order; -1: not known */
    rg_run run;         /* by the default method; run.error: of the creases drawn */
    double bend;        /* the most an added crease folds in a frame, radians */
} rg_model;

/* Folds m, of which `drawn` creases are compared with the reference's frames. RG_ENOMEM. */
rg_status rg_model_fold(rg_model *o, const rg_mesh *m, const rg_settings *s, int32_t drawn, const rg_frames *with,
                        rg_diag *why);

#endif
