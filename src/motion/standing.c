/* standing.c -- the states of a fold's track, and the one that it stands on: what stepping and steering share. */
#include "motion/fold.h"

#include <string.h>

/* --------------------------------------------------------------------------------------------- the track ---- */

const rg_mesh *rg_fold_mesh(const rg_fold *f) { return &f->shared->motion->mesh; }

int32_t rg_fold_states(const rg_fold *f) { return f->steered ? f->track.count : f->shared->motion->report.frame_count; }

const double *rg_fold_state(const rg_fold *f, int32_t k)
{
    return f->steered ? f->track.rho + (size_t)k * (size_t)rg_fold_mesh(f)->N : rg_motion_angles(f->shared->motion, k);
}

const rg_vec2 *rg_fold_pattern(const rg_fold *f, int32_t k)
{
    const rg_motion *m = f->shared->motion;
    return f->steered ? f->track.flat + (size_t)k * (size_t)m->mesh.nv : rg_motion_pattern(m, k);
}

double rg_fold_progress(const rg_fold *f, int32_t k)
{
    return f->steered ? f->track.progress[k] : f->shared->motion->frame[k].percent / 100;
}

/* ----------------------------------------------------------------------------------------------- standing ---- */

int rg_fold_has_more(const rg_fold *f) { return f->steered && f->ending.outcome == RG_RUNNING; }

/* Linear solves of the engines so far, and their iterations. */
static void count(const rg_fold *f, int64_t *solves, int64_t *iterations)
{
    *solves = *iterations = 0;
    const rg_steer *const steer[] = {f->steer, f->way[0] ? &f->way[0]->steer : NULL};
    for (int i = 0; i < 2; i++)
        if (steer[i]) *solves += steer[i]->P.solves, *iterations += steer[i]->P.iterations;
    if (f->way[1]) *solves += f->way[1]->J.A.solves, *iterations += f->way[1]->J.A.iterations;
}

const rg_step_info *rg_fold_look(rg_fold *f)
{
    const rg_motion *m = f->shared->motion;
    const rg_report *r = &m->report;
    const int is_last = !f->between && f->at == rg_fold_states(f) - 1 && !rg_fold_has_more(f);
    int64_t solves, iterations;
    count(f, &solves, &iterations);
    rg_pose_facets(&m->mesh, f->flat, &m->tree, f->rho, f->place);
    rg_pose_vertices(&m->mesh, f->flat, &m->tree, f->place, f->x);
    f->info = (rg_step_info){.outcome = RG_RUNNING, .progress = f->progress, .frame = f->between ? -1 : f->at,
                             .closure = f->closure, .frames = rg_fold_states(f), .reason = "",
                             .solves = (int32_t)(solves - f->solves),
                             .iterations = (int32_t)(iterations - f->iterations)};
    f->solves = solves, f->iterations = iterations;
    if (!is_last) return &f->info;
    f->info.outcome = f->steered ? f->ending.outcome : r->outcome;
    f->info.reason = f->steered ? f->ending.reason : r->reason;
    if (f->info.outcome != RG_STOPPED) return &f->info;
    f->info.blocking_vertex_count = f->steered ? f->ending.vertices : r->blocking_vertex_count;
    f->info.blocking_crease_count = f->steered ? f->ending.creases : r->blocking_crease_count;
    f->info.blocking_vertices = f->steered ? f->ending.vertex : r->blocking_vertices;
    f->info.blocking_creases = f->steered ? f->ending.crease : r->blocking_creases;
    return &f->info;
}

/* The present state becomes state k of the track. */
const rg_step_info *rg_fold_stand(rg_fold *f, int32_t k)
{
    const rg_mesh *m = rg_fold_mesh(f);
    memcpy(f->rho, rg_fold_state(f, k), (size_t)m->N * sizeof *f->rho);
    memcpy(f->flat, rg_fold_pattern(f, k), (size_t)m->nv * sizeof *f->flat);
    f->at = k;
    f->between = 0;
    f->progress = rg_fold_progress(f, k);
    f->closure = f->steered ? f->track.closure[k] : f->shared->motion->frame[k].closure_residual;
    return rg_fold_look(f);
}
