#include "motion/motion.h"
#include "base/status.h"
#include "motion/diagnose.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

static double seconds(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A new maximum, or NaN as soon as there is one. */
static double larger(double most, double value)
{
    return value <= most || isnan(most) ? most : value;
}

static void free_run(rg_motion *m)
{
    rg_mesh_free(&m->mesh);
    rg_tree_free(&m->tree);
    void *block[] = {m->rho, m->flat, m->frame, m->blocking_vertex, m->blocking_crease, m->blocking_at};
    for (int i = 0; i < 6; i++) rg_mem_free(&m->mem, block[i]);
    m->rho = NULL, m->flat = NULL, m->frame = NULL, m->blocking_vertex = NULL, m->blocking_crease = NULL, m->blocking_at = NULL;
}

void rg_motion_destroy(rg_motion *m)
{
    if (!m) return;
    rg_memory mem = m->mem;
    free_run(m);
    rg_mem_free(&mem, m->title);
    rg_mem_free(&mem, m->author);
    rg_mem_free(&mem, m);
}

const rg_report *rg_motion_report(const rg_motion *m) { return &m->report; }

void rg_motion_get_sheet(const rg_motion *m, rg_sheet *sheet)
{
    *sheet = (rg_sheet){m->mesh.nv, m->mesh.N, m->mesh.nf, m->mesh.facet_start, m->mesh.facet_vertex,
                        (const double(*)[2])m->mesh.X};
}

const double *rg_motion_angles(const rg_motion *m, int32_t frame)
{
    return frame < 0 || frame >= m->report.frame_count ? NULL : m->rho + (size_t)frame * (size_t)m->mesh.N;
}

const rg_vec2 *rg_motion_pattern(const rg_motion *m, int32_t frame)
{
    return m->flat ? m->flat + (size_t)frame * (size_t)m->mesh.nv : m->mesh.X;
}

const double (*rg_motion_flat(const rg_motion *m, int32_t frame))[2]
{
    return rg_motion_angles(m, frame) ? (const double(*)[2])rg_motion_pattern(m, frame) : NULL;
}

rg_status rg_motion_place(const rg_motion *m, int32_t frame, rg_vec3 *x)
{
    rg_place *place = rg_mem_array(&m->mem, (size_t)m->mesh.nf, sizeof *place);
    if (!place) return RG_ENOMEM;
    const rg_vec2 *X = rg_motion_pattern(m, frame);
    rg_pose_facets(&m->mesh, X, &m->tree, rg_motion_angles(m, frame), place);
    rg_pose_vertices(&m->mesh, X, &m->tree, place, x);
    rg_mem_free(&m->mem, place);
    return RG_OK;
}

rg_status rg_motion_pose(const rg_motion *m, int32_t frame, double (*xyz)[3])
{
    if (!rg_motion_angles(m, frame)) return RG_EARG;
    return rg_motion_place(m, frame, (rg_vec3 *)xyz);
}

/* Everything the report says of the frames, from their fold angles alone. */
static rg_status measure(rg_motion *m, rg_fold *f)
{
    rg_report *r = &m->report;
    const int32_t N = m->mesh.N;
    rg_place *place = rg_mem_array(&m->mem, (size_t)m->mesh.nf, sizeof *place);
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    rg_status s = place && x ? RG_OK : RG_ENOMEM;
    for (int32_t k = 0; s == RG_OK && k < r->frame_count; k++) {
        const double *rho = rg_motion_angles(m, k);
        double sum = 0, least = INFINITY;
        int32_t wrong = 0;
        for (int32_t i = 0; i < N; i++) {
            if (f->drive.target[i] == 0 || isnan(f->drive.target[i])) continue;
            double part = 100 * fabs(rho[i]) / fabs(f->drive.target[i]);
            sum += part;
            least = fmin(least, part);
            wrong += rho[i] * f->drive.target[i] < 0 && part > 1e-4;
            r->max_overfold_deg = larger(r->max_overfold_deg, (fabs(rho[i]) - RG_PI) / RG_DEG);
        }
        m->frame[k].percent = f->drive.count ? sum / f->drive.count : k ? 100 : 0;
        m->frame[k].closure_residual = rg_constraint_closure(&f->K, rho, NULL);
        r->max_closure_residual = larger(r->max_closure_residual, m->frame[k].closure_residual);
        const rg_vec2 *X = rg_motion_pattern(m, k);
        rg_pose_facets(&m->mesh, X, &m->tree, rho, place);
        rg_pose_vertices(&m->mesh, X, &m->tree, place, x);
        r->max_edge_strain = larger(r->max_edge_strain, rg_pose_strain(&m->mesh, X, x));
        r->max_strain_from_original = larger(r->max_strain_from_original, rg_pose_strain(&m->mesh, m->mesh.X, x));
        r->max_facet_gap = larger(r->max_facet_gap, rg_pose_gap(&m->mesh, X, place) / m->mesh.size);
        r->folded_percent = m->frame[k].percent;
        r->least_folded_percent = f->drive.count ? least : r->folded_percent;
        r->wrong_side_creases = wrong;
    }
    r->frames = m->frame;
    rg_mem_free(&m->mem, place);
    rg_mem_free(&m->mem, x);
    return s;
}

static rg_status blocking(rg_motion *m, rg_fold *f)
{
    rg_report *r = &m->report;
    m->blocking_vertex = rg_mem_array(&m->mem, (size_t)f->mesh.M, sizeof *m->blocking_vertex);
    m->blocking_crease = rg_mem_array(&m->mem, (size_t)f->mesh.N, sizeof *m->blocking_crease);
    m->blocking_at = rg_mem_array(&m->mem, (size_t)f->mesh.M, sizeof *m->blocking_at);
    if (!m->blocking_vertex || !m->blocking_crease || !m->blocking_at) return RG_ENOMEM;
    rg_status s = rg_diagnose_blocking(f, m->blocking_vertex, &r->blocking_vertex_count, m->blocking_crease,
                                       &r->blocking_crease_count);
    for (int32_t k = 0; k < r->blocking_vertex_count; k++) {
        rg_vec2 at = f->mesh.X[m->blocking_vertex[k]];
        m->blocking_at[k][0] = at.x;
        m->blocking_at[k][1] = at.y;
    }
    r->blocking_vertices = m->blocking_vertex;
    r->blocking_creases = m->blocking_crease;
    r->blocking_at = (const double(*)[2])m->blocking_at;
    return s;
}

static void keep(rg_motion *m, const rg_fold *f, int32_t *count)
{
    memcpy(m->rho + (size_t)*count * (size_t)f->mesh.N, f->rho, (size_t)f->mesh.N * sizeof *f->rho);
    ++*count;
}

/* One run with the triangulation that the settings name; adds its costs to the report. */
static rg_status run(rg_motion *m, const rg_pattern *p, const rg_settings *settings, rg_progress progress, void *ctx,
                     int *cancelled, rg_diag *why)
{
    rg_report *r = &m->report;
    rg_fold *f = NULL;
    rg_step_info info = {0};
    int32_t count = 0;
    rg_status s = rg_fold_create(p, settings, &f, why);
    if (s != RG_OK) return s;
    const int32_t N = f->mesh.N;
    m->rho = rg_mem_array(&m->mem, (size_t)(settings->frames + 1) * (size_t)N, sizeof *m->rho);
    m->frame = rg_mem_array(&m->mem, (size_t)(settings->frames + 1), sizeof *m->frame);
    s = m->rho && m->frame ? rg_tree_init(&f->mesh, settings->fixed_facet, &m->tree) : RG_ENOMEM;
    if (s == RG_EARG)
        rg_fail(s, why, 0, "there is no facet %d: the facets are 0 to %d", (int)settings->fixed_facet, (int)f->mesh.nf - 1);
    if (s != RG_OK) goto out;

    double kept = -1;
    while (info.outcome == RG_RUNNING && !*cancelled) {
        s = rg_fold_step(f, &info);
        if (s != RG_OK) goto out;
        if (info.frame >= 0) {
            keep(m, f, &count);
            kept = f->s;
        }
        if (progress && f->s_end > 0) *cancelled = progress(ctx, info.progress / f->s_end) != 0;
    }
    if (f->s != kept) keep(m, f, &count); /* where a run ends short is its last frame */
    r->frame_count = count;
    r->outcome = *cancelled ? RG_STOPPED : info.outcome;
    snprintf(r->reason, sizeof r->reason, "%s", *cancelled ? "interrupted" : f->reason);
    if (r->outcome == RG_STOPPED && (s = blocking(m, f)) != RG_OK) goto out;

    s = rg_diagnose_components(&f->mesh, &m->mem, &r->components);
    r->added_creases = f->mesh.added;
    r->unknowns = N;
    r->constraints = 3 * f->mesh.M;
    r->triangulation = settings->triangulate == RG_TRIANGULATE_ALL ? "all" : "none";
    r->method = f->settings.method == RG_METHOD_EULER ? "euler" : "newton";
    r->solver = f->P.solver == RG_SOLVER_CHOLESKY ? "cholesky" : f->P.solver == RG_SOLVER_SVD ? "svd" : "cg";
    r->steps += f->steps;
    r->solves += f->P.solves;
    r->cg_iterations += f->P.iterations;
    r->factorizations += f->P.factorizations;
    r->assemblies += f->assemblies;
    r->seconds_solving += f->seconds_solving;
    m->mesh = f->mesh;
    memset(&f->mesh, 0, sizeof f->mesh);
    if (s == RG_OK) s = measure(m, f);
out:
    rg_fold_destroy(f);
    return s;
}

/* Forgets what a run found, but not what it cost. */
static void begin_again(rg_motion *m)
{
    rg_report was = m->report;
    free_run(m);
    memset(&m->report, 0, sizeof m->report);
    m->report.pattern = was.pattern;
    m->report.steps = was.steps, m->report.solves = was.solves, m->report.cg_iterations = was.cg_iterations;
    m->report.factorizations = was.factorizations, m->report.assemblies = was.assemblies;
    m->report.seconds_solving = was.seconds_solving;
}

rg_status rg_motion_create(const rg_pattern *p, const rg_settings *settings, rg_progress progress, void *ctx,
                           rg_motion **motion, rg_diag *why)
{
    double from = seconds();
    rg_memory mem = rg_mem_default(settings->memory);
    if (settings->frames < 2) return rg_fail(RG_EARG, why, 0, "there must be at least 2 frames");
    rg_motion *m = rg_mem_array(&mem, 1, sizeof *m);
    if (!m) return RG_ENOMEM;
    m->mem = mem;
    m->settings = *settings;
    rg_report *r = &m->report;
    rg_pattern_get_info(p, &r->pattern);
    m->title = rg_mem_string(&mem, r->pattern.title);
    m->author = rg_mem_string(&mem, r->pattern.author);
    if (!m->title || !m->author) {
        rg_motion_destroy(m);
        return RG_ENOMEM;
    }
    r->pattern.title = m->title;
    r->pattern.author = m->author;

    rg_settings tried = *settings;
    int cancelled = 0, automatic = settings->triangulate == RG_TRIANGULATE_AUTO;
    if (automatic) tried.triangulate = RG_TRIANGULATE_NONE;
    rg_status s = run(m, p, &tried, progress, ctx, &cancelled, why);
    const char *reason = automatic ? "folds without added creases" : "asked for";
    if (s == RG_OK && automatic && r->outcome != RG_FOLDED && !cancelled) {
        double plain = r->folded_percent;
        tried.triangulate = RG_TRIANGULATE_ALL;
        begin_again(m);
        s = run(m, p, &tried, progress, ctx, &cancelled, why);
        reason = "stops short without added creases";
        if (s == RG_OK && r->outcome != RG_FOLDED && !cancelled && r->added_creases > 0 && !(r->folded_percent > plain)) {
            tried.triangulate = RG_TRIANGULATE_NONE;
            begin_again(m);
            s = run(m, p, &tried, progress, ctx, &cancelled, why);
            reason = "added creases get it no further";
        }
    }
    if (s != RG_OK) {
        rg_motion_destroy(m);
        return s;
    }
    r->why_triangulated = reason;
    r->seconds_total = seconds() - from;
    *motion = m;
    return RG_OK;
}
