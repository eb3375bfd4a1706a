#include "chart/chart.h"
#include "base/file.h"
#include "base/settings.h"
#include "base/status.h"

#include <stdio.h>
#include <string.h>

/* Largest steps, degrees, of the methods that have one; the others take tolerances. */
static const double STEPS[RG_CHART_POINTS] = {5, 2.5, 1.25, 0.6, 0.3};
static const double TOLERANCES[RG_CHART_POINTS] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
/* Singular values are for small patterns. */
static const int32_t SVD_UP_TO = 32;
/* Errors are the same up to this factor, and below this, radians. */
static const double SAME_ERROR = 1.5, INVISIBLE = 1e-12;
/* A run that takes longer than this, in seconds, is the last of its curve; runs longer than that are not repeated. */
static const double PATIENCE = 0.5;

int rg_chart_reached(const rg_chart *c, const rg_run *r)
{
    return r->outcome == RG_FOLDED && r->frames == c->settings.frames;
}

/* It does the same job: closes to the tolerance asked for in every frame, and is as near to the path, if that is
 * known. */
static int as_accurate(const rg_chart *c, const rg_run *r)
{
    const double error = c->run[0].error;
    return rg_chart_reached(c, r) && r->closure <= c->settings.tol &&
           (isnan(error) || r->error <= fmax(SAME_ERROR * error, INVISIBLE));
}

const rg_run *rg_chart_best(const rg_chart *c, int in_passes)
{
    const rg_run *best = NULL;
    for (int32_t i = 0; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (as_accurate(c, r) && (!best || (in_passes ? r->passes < best->passes : r->seconds < best->seconds)))
            best = r;
    }
    return best;
}

int rg_chart_on_front(const rg_chart *c, int32_t i)
{
    const rg_run *r = &c->run[i];
    if (!rg_chart_reached(c, r) || isnan(r->error)) return 0;
    for (int32_t j = 0; j < c->runs; j++)
        if (j != i && rg_chart_reached(c, &c->run[j]) && c->run[j].seconds <= r->seconds && c->run[j].error <= r->error)
            return 0;
    return 1;
}

int rg_chart_same_curve(const rg_chart *c, int32_t i)
{
    return i > 1 && c->run[i].way.method == c->run[i - 1].way.method &&
        c->run[i].way.solver == c->run[i - 1].way.solver;
}

/* Who watches, and what is done of how much. */
typedef struct watch {
    rg_progress progress;
    void *ctx;
    int done, of, cancelled;
} watch;

static int tick(watch *w)
{
    w->done++;
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, fmin(1, (double)w->done / w->of)) != 0;
    return w->cancelled;
}

static rg_status add_run(rg_chart *c, const rg_mesh *m, const rg_way *way, rg_diag *why)
{
    rg_run *r = &c->run[c->runs];
    rg_status s = rg_run_make(r, m, &c->settings, way, &c->ref.frames, NULL, why);
    if (s == RG_OK) s = rg_run_time(r, m, &c->settings, PATIENCE, why);
    c->runs += s == RG_OK;
    return s;
}

static rg_status curve(rg_chart *c, const rg_mesh *m, rg_method method, rg_solver solver, watch *w, rg_diag *why)
{
    rg_status s = RG_OK;
    for (int p = 0; p < RG_CHART_POINTS && s == RG_OK && !w->cancelled; p++) {
        rg_way way = {method, solver, STEPS[p] * RG_DEG, c->settings.tol, 0};
        if (method == RG_METHOD_ADAPTIVE) way.step = c->settings.step, way.tol = TOLERANCES[p];
        s = add_run(c, m, &way, why);
        if (s != RG_OK || c->run[c->runs - 1].seconds > PATIENCE) break;
    }
    tick(w);
    return s;
}

/* What the program does where nothing folds straight on is its default there, and heads the curve that it is of. */
static void add_relaxed(rg_chart *c)
{
    c->run[c->runs++] = c->relaxed.run[RG_RELAXED_DEFAULT];
    for (int32_t k = 0; k < c->relaxed.points; k++) c->run[c->runs++] = c->relaxed.run[k];
}

static rg_status all_curves(rg_chart *c, const rg_mesh *m, watch *w, rg_diag *why)
{
    static const rg_method methods[] = {RG_METHOD_EULER, RG_METHOD_NEWTON, RG_METHOD_HEUN, RG_METHOD_RK4,
                                        RG_METHOD_ADAPTIVE};
    static const rg_solver solvers[] = {RG_SOLVER_CG, RG_SOLVER_CHOLESKY, RG_SOLVER_SVD};
    const rg_way default_way = {RG_METHOD_AUTO, RG_SOLVER_AUTO, c->settings.step, c->settings.tol, 0};
    rg_status s = RG_OK;
    if (c->relaxed.folds) add_relaxed(c);
    else s = add_run(c, m, &default_way, why);
    for (int j = 0; j < 5; j++)
        for (int k = 0; k < 3; k++) {
            const rg_solver solver = solvers[k];
            if (solver == RG_SOLVER_SVD && (!rg_pinv_built() || m->N > SVD_UP_TO)) continue;
            if (s == RG_OK && !w->cancelled) s = curve(c, m, methods[j], solver, w, why);
        }
    if (c->relaxed.folds) return s;
    /* Again, now that the machine is as busy as it was for the others. */
    return s == RG_OK ? rg_run_time(&c->run[0], m, &c->settings, 2 * PATIENCE, why) : s;
}

/* The sheet as drawn, or cut into triangles if that is asked for, or if it folds so and not as drawn. */
static rg_status choose_mesh(rg_chart *c, const rg_mesh *none, const rg_mesh *all, const rg_mesh **m, int *folds,
                             rg_diag *why)
{
    const rg_way way = {RG_METHOD_AUTO, RG_SOLVER_AUTO, c->settings.step, c->settings.tol, 0};
    rg_run run;
    rg_status s = RG_OK;
    const int may_cut = c->settings.triangulate == RG_TRIANGULATE_AUTO;
    c->triangulated = c->settings.triangulate == RG_TRIANGULATE_ALL;
    s = rg_run_make(&run, c->triangulated ? all : none, &c->settings, &way, NULL, NULL, why);
    *folds = s == RG_OK && run.outcome == RG_FOLDED;
    if (s == RG_OK && !*folds && may_cut) {
        s = rg_run_make(&run, all, &c->settings, &way, NULL, NULL, why);
        *folds = c->triangulated = s == RG_OK && run.outcome == RG_FOLDED;
    }
    *m = c->triangulated ? all : none;
    return s;
}

/* While the relaxed stepper is at it nothing else is done, but whoever watches may end it. */
static int ask(void *ctx, double done)
{
    watch *w = ctx;
    (void)done;
    if (w->progress && !w->cancelled) w->cancelled = w->progress(w->ctx, fmin(1, (double)w->done / w->of)) != 0;
    return w->cancelled;
}

static rg_status measure_relaxed(rg_chart *c, const rg_mesh *none, watch *w, rg_diag *why)
{
    rg_watch mine = {.progress = ask, .ctx = w};
    return rg_relaxed_measure(&c->relaxed, none, &c->settings, &mine, why);
}

static rg_status fill(rg_chart *c, const rg_mesh *none, const rg_mesh *all, watch *w, rg_diag *why)
{
    const rg_mesh *m = none, *sheet;
    int folds = 0;
    rg_status s = choose_mesh(c, none, all, &m, &folds, why);
    if (s == RG_OK && !folds) s = measure_relaxed(c, none, w, why);
    sheet = c->relaxed.folds ? &c->relaxed.best.mesh : m;
    c->nv = none->nv, c->N = sheet->N, c->M = sheet->M, c->added = sheet->added;
    c->nodes = all->nv, c->edges_all = all->ne;
    if (s == RG_OK && !c->relaxed.folds) s = rg_reference_make(&c->ref, &c->mem, m, &c->settings, why);
    tick(w);
    if (s == RG_OK) s = all_curves(c, m, w, why);
    const int32_t frames = c->settings.frames, from = (frames - 1) / 3, to = 2 * (frames - 1) / 3;
    c->from = (double)from / (frames - 1), c->to = (double)to / (frames - 1);
    if (s == RG_OK && !c->relaxed.folds) s = rg_order_measure(c->order, m, &c->settings, &c->ref, from, to, why);
    tick(w);
    if (s == RG_OK) s = rg_model_fold(&c->none, none, &c->settings, none->N, &c->ref.frames, why);
    if (s == RG_OK) s = rg_model_fold(&c->all, all, &c->settings, none->N, &c->ref.frames, why);
    tick(w);
    return s;
}

rg_status rg_chart_create(const rg_pattern *p, const rg_settings *given, rg_progress progress, void *ctx,
                          rg_chart **chart, rg_diag *why)
{
    rg_settings mine, *const settings = &mine;
    const rg_status taken = rg_settings_take(given, settings, why);
    if (taken != RG_OK) return taken;
    const rg_memory mem = rg_mem_default(settings->memory);
    rg_mesh none, all = {0};
    watch w = {progress, ctx, 0, 5 * 3 + 4, 0};
    rg_status s = rg_mesh_from_pattern(p, &mem, &none, why);
    if (s != RG_OK) return s;
    rg_chart *c = rg_mem_array(&mem, 1, sizeof *c);
    if (c) c->mem = mem, c->settings = *settings;
    else s = RG_ENOMEM;
    if (s == RG_OK && none.M == 0)
        s = rg_fail(RG_EARG, why, 0, "no vertex inside the sheet: there is nothing to solve");
    if (s == RG_OK) s = rg_triangulate_all(&none, &all);
    if (s == RG_OK) s = rg_alike_find(p, &c->alike);
    if (s == RG_OK) s = fill(c, &none, &all, &w, why);
    if (s == RG_OK) s = rg_touch_measure(c->touch, p, settings, ask, &w, why);
    tick(&w);
    rg_mesh_free(&none);
    rg_mesh_free(&all);
    if (s != RG_OK) {
        rg_chart_destroy(c);
        return s == RG_ENOMEM ? rg_fail(s, why, 0, "out of memory") : s;
    }
    *chart = c;
    return RG_OK;
}

void rg_chart_destroy(rg_chart *c)
{
    if (!c) return;
    const rg_memory mem = c->mem;
    rg_reference_free(&c->ref);
    rg_relaxed_free(&c->relaxed);
    rg_mem_free(&mem, c);
}

/* form: a name that ends as the form does; "-": words. */
static rg_status write(const rg_chart *c, const char *title, const char *form, const rg_dest *to, rg_diag *why)
{
    const char *dot = strrchr(form, '.');
    rg_file f = {0};
    const int csv = dot && strcmp(dot, ".csv") == 0, svg = dot && strcmp(dot, ".svg") == 0;
    if (!csv && !svg && strcmp(form, "-") != 0 && !(dot && strcmp(dot, ".md") == 0))
        return rg_fail(RG_EARG, why, 0, "%s: a chart is written as .csv, .svg or .md", form);
    rg_status s = rg_file_begin_to(&f, &c->mem, to, why);
    if (s != RG_OK) return s;
    (csv ? rg_chart_csv : svg ? rg_chart_svg : rg_chart_words)(c, title, f.stream);
    return rg_file_commit(&f, why);
}

rg_status rg_chart_write(const rg_chart *c, const char *title, const char *path, rg_diag *why)
{
    return write(c, title, path, &(rg_dest){path, NULL}, why);
}

rg_status rg_chart_write_to(const rg_chart *c, const char *title, const char *form, const rg_sink *sink, rg_diag *why)
{
    return write(c, title, form, &(rg_dest){NULL, sink}, why);
}
