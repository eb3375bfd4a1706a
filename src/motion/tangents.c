/* tangents.c -- tangents of motions and folds: rigami.h, rg_motion_tangent and rg_fold_tangent. */
#include "kinematics/tangent.h"
#include "motion/fold.h"

rg_status rg_motion_tangent(const rg_motion *m, int32_t frame, rg_tangent **tangent)
{
    const double *rho = rg_motion_angles(m, frame);
    return rho ? rg_tangent_at(&m->mesh, &m->mem, m->flat ? rg_motion_pattern(m, frame) : NULL, rho, tangent) : RG_EARG;
}

rg_status rg_fold_tangent(const rg_fold *f, rg_tangent **tangent)
{
    return rg_tangent_at(rg_fold_mesh(f), &f->mem, f->flat, f->rho, tangent);
}
