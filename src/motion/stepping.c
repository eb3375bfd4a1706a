/* stepping.c -- a motion frame by frame, for callers that own the loop: rigami.h, rg_fold.
 *
 * The search happens in create: what folds a pattern is known only when it has come to its end. A step then goes to the next frame of
 * the motion that was found, which is the one that rg_motion_create finds, to the bit. */
#include "base/status.h"
#include "motion/motion.h"

struct rg_fold {
    rg_memory mem;
    rg_motion *motion; /* owned */
    int32_t frame;     /* the one that it is at; -1: before the first step */
};

rg_status rg_fold_create_watched(const rg_pattern *p, const rg_settings *s, rg_progress progress, void *ctx, rg_fold **fold,
                                 rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    rg_fold *f = rg_mem_array(&mem, 1, sizeof *f);
    if (!f) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    f->mem = mem;
    f->frame = -1;
    const rg_status status = rg_motion_create(p, s, progress, ctx, &f->motion, why);
    if (status == RG_OK) *fold = f;
    else rg_mem_free(&mem, f);
    return status;
}

rg_status rg_fold_create(const rg_pattern *p, const rg_settings *s, rg_fold **fold, rg_diag *why)
{
    return rg_fold_create_watched(p, s, NULL, NULL, fold, why);
}

void rg_fold_destroy(rg_fold *f)
{
    if (!f) return;
    const rg_memory mem = f->mem;
    rg_motion_destroy(f->motion);
    rg_mem_free(&mem, f);
}

const rg_motion *rg_fold_motion(const rg_fold *f) { return f->motion; }

rg_status rg_fold_step(rg_fold *f, rg_step_info *info)
{
    const rg_report *r = &f->motion->report;
    const int32_t last = r->frame_count - 1;
    const int moves = f->frame < last;
    if (moves) f->frame++;
    *info = (rg_step_info){.outcome = f->frame < last ? RG_RUNNING : r->outcome,
                           .progress = r->frames[f->frame].percent / 100,
                           .frame = moves ? f->frame : -1,
                           .closure = r->frames[f->frame].closure_residual};
    return RG_OK;
}

const double *rg_fold_angles(const rg_fold *f, int32_t *creases)
{
    if (creases) *creases = f->motion->mesh.N;
    return rg_motion_angles(f->motion, f->frame < 0 ? 0 : f->frame);
}
