/* stepping.c -- a motion state by state, for callers that own the loop: rigami.h, rg_fold.
 *
 * The search happens in create: what folds a pattern is known only when it has come to its end. A step then goes to the next frame of
 * the motion that was found, which is the one that rg_motion_create finds, to the bit. */
#include "base/settings.h"
#include "base/status.h"
#include "motion/fold.h"

#include <string.h>

/* ------------------------------------------------------------------------------------------- making one ---- */

static void let_go(const rg_memory *mem, rg_shared *s)
{
    if (!s || atomic_fetch_sub(&s->holders, 1) > 1) return;
    rg_motion_destroy(s->motion);
    rg_mem_free(mem, s);
}

void rg_fold_destroy(rg_fold *f)
{
    if (!f) return;
    const rg_memory mem = f->mem;
    void *block[] = {f->rho, f->flat, f->place, f->x};
    for (int i = 0; i < 4; i++) rg_mem_free(&mem, block[i]);
    let_go(&mem, f->shared);
    rg_mem_free(&mem, f);
}

static rg_status make_room(rg_fold *f)
{
    const rg_mesh *m = &f->shared->motion->mesh;
    f->rho = rg_mem_array(&f->mem, (size_t)m->N, sizeof *f->rho);
    f->flat = rg_mem_array(&f->mem, (size_t)m->nv, sizeof *f->flat);
    f->place = rg_mem_array(&f->mem, (size_t)m->nf, sizeof *f->place);
    f->x = rg_mem_array(&f->mem, (size_t)m->nv, sizeof *f->x);
    return f->rho && f->flat && f->place && f->x ? RG_OK : RG_ENOMEM;
}

/* The present state is that of the track. */
static const rg_step_info *stand(rg_fold *f)
{
    const rg_motion *m = f->shared->motion;
    const rg_report *r = &m->report;
    const int is_last = f->at == r->frame_count - 1;
    memcpy(f->rho, rg_motion_angles(m, f->at), (size_t)m->mesh.N * sizeof *f->rho);
    memcpy(f->flat, rg_motion_pattern(m, f->at), (size_t)m->mesh.nv * sizeof *f->flat);
    rg_pose_facets(&m->mesh, f->flat, &m->tree, f->rho, f->place);
    rg_pose_vertices(&m->mesh, f->flat, &m->tree, f->place, f->x);
    f->info = (rg_step_info){.outcome = is_last ? r->outcome : RG_RUNNING, .progress = m->frame[f->at].percent / 100, .frame = f->at,
                             .closure = m->frame[f->at].closure_residual, .frames = r->frame_count, .reason = is_last ? r->reason : ""};
    if (is_last && r->outcome == RG_STOPPED) {
        f->info.blocking_vertex_count = r->blocking_vertex_count, f->info.blocking_crease_count = r->blocking_crease_count;
        f->info.blocking_vertices = r->blocking_vertices, f->info.blocking_creases = r->blocking_creases;
    }
    return &f->info;
}

rg_status rg_fold_create(const rg_pattern *p, const rg_settings *given, rg_progress progress, void *ctx, rg_fold **fold, rg_diag *why)
{
    rg_settings settings;
    rg_status s = rg_settings_take(given, &settings, why);
    if (s != RG_OK) return s;
    const rg_memory mem = rg_mem_default(settings.memory);
    rg_fold *f = rg_mem_array(&mem, 1, sizeof *f);
    if (!f) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    f->mem = mem;
    f->settings = settings;
    f->shared = rg_mem_array(&mem, 1, sizeof *f->shared);
    s = f->shared ? RG_OK : rg_fail(RG_ENOMEM, why, 0, "out of memory");
    if (s == RG_OK) {
        atomic_init(&f->shared->holders, 1);
        s = rg_motion_create(p, &settings, progress, ctx, &f->shared->motion, why);
    }
    if (s == RG_OK) s = make_room(f);
    if (s == RG_OK) {
        stand(f);
        *fold = f;
        return RG_OK;
    }
    rg_fold_destroy(f);
    return s == RG_ENOMEM ? rg_fail(s, why, 0, "out of memory") : s;
}

/* ------------------------------------------------------------------------------------------------ moving ---- */

const rg_step_info *rg_fold_get_info(const rg_fold *f) { return &f->info; }

const rg_step_info *rg_fold_step(rg_fold *f)
{
    if (f->at < f->shared->motion->report.frame_count - 1) f->at++;
    return stand(f);
}

const rg_step_info *rg_fold_step_back(rg_fold *f)
{
    if (f->at > 0) f->at--;
    return stand(f);
}

/* ------------------------------------------------------------------------------------- the present state ---- */

const rg_motion *rg_fold_motion(const rg_fold *f) { return f->shared->motion; }

const double *rg_fold_angles(const rg_fold *f, int32_t *creases)
{
    if (creases) *creases = f->shared->motion->mesh.N;
    return f->rho;
}

const double (*rg_fold_positions(const rg_fold *f, int32_t *vertices))[3]
{
    if (vertices) *vertices = f->shared->motion->mesh.nv;
    return (const double(*)[3])f->x;
}

const double (*rg_fold_flat(const rg_fold *f, int32_t *vertices))[2]
{
    if (vertices) *vertices = f->shared->motion->mesh.nv;
    return (const double(*)[2])f->flat;
}

const rg_transform *rg_fold_transforms(const rg_fold *f, int32_t *facets)
{
    if (facets) *facets = f->shared->motion->mesh.nf;
    return (const rg_transform *)(const void *)f->place;
}
