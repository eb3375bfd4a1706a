/* table.c -- what a chart says, as a table for programs and as one for people. */
#include "base/number.h"
#include "chart/chart.h"

static void number(double x, FILE *out)
{
    char text[RG_NUMBER_ROOM];
    if (isnan(x)) return; /* an empty field */
    fputs(rg_number_print(text, x), out);
}

static void field(double x, FILE *out)
{
    fputc(',', out);
    number(x, out);
}

/* To three digits: "%g" would take the locale's decimal point. */
static double rounded(double x)
{
    if (!(fabs(x) > 0 && fabs(x) < INFINITY)) return x;
    const double unit = pow(10, floor(log10(fabs(x))) - 2);
    return unit < 1 ? round(x / unit) / round(1 / unit) : round(x / unit) * unit;
}

/* A number for people: two digits and a power of ten where it is small. */
static void brief(double x, FILE *out)
{
    if (isnan(x)) fputs("-", out);
    else if (x != 0 && fabs(x) < 0.01) {
        int power = (int)floor(log10(fabs(x)));
        int digits = (int)lround(fabs(x) * pow(10, 1 - power));
        if (digits == 100) digits = 10, power++;
        fprintf(out, "%d.%de%d", digits / 10, digits % 10, power);
    } else number(rounded(x), out);
}

void rg_chart_csv(const rg_chart *c, const char *title, FILE *out)
{
    fputs("pattern,creases,constraints,method,solver,step_deg,tol_rad,default,outcome,frames,percent,error_rad,"
          "pattern_error,closure_rad,seconds,passes,steps,solves,cg_iterations,factorizations,assemblies\n", out);
    for (int32_t i = 0; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        fputc('"', out);
        for (const char *s = title; *s; s++) fprintf(out, *s == '"' ? "\"\"" : "%c", *s);
        fprintf(out, "\",%d,%d,%s,%s", (int)c->N, 3 * (int)c->M, rg_run_method_name(r->method),
                rg_run_solver_name(r->solver));
        field(r->way.step / RG_DEG, out);
        field(r->way.tol, out);
        fprintf(out, ",%d,%s,%d", i == 0, rg_chart_reached(c, r) ? "reached" : "stopped", (int)r->frames);
        const double numbers[] = {r->percent, r->error, r->pattern_error, r->closure, r->seconds, r->passes};
        for (int k = 0; k < 6; k++) field(numbers[k], out);
        fprintf(out, ",%lld,%lld,%lld,%lld,%lld\n", (long long)r->steps, (long long)r->solves, (long long)r->iterations,
                (long long)r->factorizations, (long long)r->assemblies);
    }
}

/* ---------------------------------------------------------------------------------------------- in words ---- */

static void reference(const rg_chart *c, FILE *out)
{
    const rg_reference *ref = &c->ref;
    fputs("Reference: ", out);
    if (ref->exact) {
        fputs("closed form (every vertex flat-foldable, of degree 4); the sheet closes there to ", out);
        brief(ref->closure, out);
        fputs(" rad.\n\n", out);
        return;
    }
    if (ref->frames.count < 2) {
        fputs("none: steps cut shorter and shorter do not get from flat to the next frame, or to different ones.\n\n",
              out);
        return;
    }
    fputs("rk4 with graded steps, halved; the path changed by", out);
    for (int32_t n = 1; n < ref->halvings; n++) {
        fputs(n > 1 ? ", " : " ", out);
        brief(ref->change[n], out);
    }
    fputs(" rad; its error is about ", out);
    brief(ref->error, out);
    fputs(" rad.\n\n", out);
    if (ref->frames.count < c->settings.frames)
        fprintf(out, "It is known for %d of %d frames: errors are those of these.\n\n", (int)ref->frames.count,
                (int)c->settings.frames);
}

static void verdict(const rg_chart *c, FILE *out)
{
    if (c->runs == 0) return;
    const rg_run *a = &c->run[0], *quick = rg_chart_best(c, 0), *lean = rg_chart_best(c, 1);
    if (!rg_chart_reached(c, a) || !quick || !lean) {
        fprintf(out, "The default, %s with %s, stops short.\n\n", rg_run_method_name(a->method),
                rg_run_solver_name(a->solver));
        return;
    }
    fprintf(out, "The default is %s with %s: ", rg_run_method_name(a->method), rg_run_solver_name(a->solver));
    brief(a->error, out);
    fputs(" rad off in ", out);
    brief(1000 * a->seconds, out);
    fputs(" ms, ", out);
    brief(a->passes, out);
    fputs(" passes. As accurate, the quickest takes ", out);
    brief(1000 * quick->seconds, out);
    fprintf(out, " ms (%s, %s), the default ", rg_run_method_name(quick->method), rg_run_solver_name(quick->solver));
    brief(a->seconds / quick->seconds, out);
    fputs(" times that; the leanest ", out);
    brief(lean->passes, out);
    fprintf(out, " passes (%s, %s), the default ", rg_run_method_name(lean->method), rg_run_solver_name(lean->solver));
    brief(a->passes / lean->passes, out);
    fputs(" times that.\n\n", out);
}

static void runs(const rg_chart *c, FILE *out)
{
    int32_t stopped = 0;
    for (int32_t i = 1; i < c->runs; i++) stopped += !rg_chart_reached(c, &c->run[i]);
    fprintf(out, "Of %d runs %d stopped short", (int)c->runs, (int)stopped);
    for (int32_t i = 1, n = 0; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (rg_chart_reached(c, r)) continue;
        fprintf(out, "%s%s with %s at ", n++ ? "; " : ": ", rg_run_method_name(r->method),
                rg_run_solver_name(r->solver));
        brief(r->percent, out);
        fputs(" percent, step ", out);
        brief(r->way.step / RG_DEG, out);
    }
    fputs(". The default, and those that none beats both in time and in error:\n\n", out);
    fputs("| method | solver | step, deg | tol | error, rad | closure, rad | ms | passes | steps | solves |\n"
          "|---|---|---|---|---|---|---|---|---|---|\n", out);
    for (int32_t i = 0; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (i > 0 && !rg_chart_on_front(c, i)) continue;
        fprintf(out, "| %s%s | %s | ", i == 0 ? "**default** " : "", rg_run_method_name(r->method),
                rg_run_solver_name(r->solver));
        if (r->method == RG_METHOD_ADAPTIVE) fputs("-", out);
        else brief(r->way.step / RG_DEG, out);
        fputs(" | ", out);
        brief(r->way.tol, out);
        fputs(" | ", out);
        brief(r->error, out);
        fputs(" | ", out);
        brief(r->closure, out);
        fputs(" | ", out);
        brief(1000 * r->seconds, out);
        fputs(" | ", out);
        brief(r->passes, out);
        fprintf(out, " | %lld | %lld |\n", (long long)r->steps, (long long)r->solves);
    }
    fputs("\n", out);
}

static void slope(const rg_slope *s, FILE *out)
{
    if (s->exact) fputs("exact", out);
    else brief(isnan(s->slope) ? NAN : round(100 * s->slope) / 100, out);
}

static void orders(const rg_chart *c, FILE *out)
{
    fputs("Observed order from ", out);
    brief(100 * c->from, out);
    fputs(" to ", out);
    brief(100 * c->to, out);
    fputs(" percent:\n\n| method | of the formula alone | as it folds |\n|---|---|---|\n", out);
    for (int j = 0; j < RG_ORDERS; j++) {
        fprintf(out, "| %s | ", rg_run_method_name(c->order[j].method));
        slope(&c->order[j].open, out);
        fputs(" | ", out);
        slope(&c->order[j].closed, out);
        fputs(" |\n", out);
    }
    fputs("\n", out);
}

static void off_on_the_way(const rg_relaxed *R, FILE *out)
{
    fputs(" On the way:\n\n| percent |", out);
    for (int j = 0; j < RG_RELAXED_PERCENTS; j++) fprintf(out, " %d |", rg_relaxed_percent[j]);
    fputs("\n|---|---|---|---|---|---|---|\n| angles, rad |", out);
    for (int j = 0; j < RG_RELAXED_PERCENTS; j++) fputc(' ', out), brief(R->off[j], out), fputs(" |", out);
    fputs("\n| pattern, of the sheet |", out);
    for (int j = 0; j < RG_RELAXED_PERCENTS; j++) fputc(' ', out), brief(R->pattern_off[j], out), fputs(" |", out);
}

/* Of the relaxed stepper: its path by steps halved, what the default is off by, its order. */
static void relaxed(const rg_chart *c, FILE *out)
{
    const rg_relaxed *R = &c->relaxed;
    const rg_run *d = &R->run[RG_RELAXED_DEFAULT], *last = &R->run[R->points - 1];
    fprintf(out, "Nothing folds straight on; what folds is %s", R->strategy);
    if (R->best.relax->U > 0) {
        fputs(", the pattern moving by up to ", out);
        brief(100 * R->best.moved / R->best.mesh.size, out);
        fputs(" % of the sheet", out);
    }
    fprintf(out, ", %d creases added, a symmetry of order %d kept.\n", (int)R->best.mesh.added,
            R->best.symmetry ? (int)R->best.symmetry->order : 1);
    fputs("Reference: the same with steps of ", out);
    brief(last->way.step / RG_DEG, out);
    fputs(" degrees.", out);
    if (R->order > 0 && R->error <= d->error) {
        fputs(" Its own error, if changes go on to fall as they did, is ", out);
        brief(R->error, out);
        fputs(" rad; observed order: ", out);
        brief(round(100 * R->order) / 100, out);
        fputs(" of the angles, ", out);
        brief(isnan(R->pattern_order) ? NAN : round(100 * R->pattern_order) / 100, out);
        fputs(" of the pattern.", out);
    } else {
        fputs(" The path has not converged there: changes hardly fall with the step (order ", out);
        brief(isnan(R->order) ? NAN : round(100 * R->order) / 100, out);
        fputs(" of the angles, ", out);
        brief(isnan(R->pattern_order) ? NAN : round(100 * R->pattern_order) / 100, out);
        fputs(" of the pattern), and errors are differences from it, not from a limit.", out);
    }
    if (R->finer_stops) {
        fputs(" Half that step stops at ", out);
        brief(R->run[R->points].percent, out);
        fprintf(out, " percent: %s.", R->reason);
    }
    fputs("\n\nThe default, relaxed with steps of ", out);
    brief(d->way.step / RG_DEG, out);
    if (d == last) {
        fputs(" degrees, is itself the finest that folds: what it is off by is not known. It takes ", out);
    } else {
        fputs(" degrees, is off by ", out);
        brief(d->error, out);
        fputs(" rad and ", out);
        brief(d->pattern_error, out);
        fputs(" of the sheet, in ", out);
    }
    brief(1000 * d->seconds, out);
    fputs(" ms, ", out);
    brief(d->passes, out);
    fputs(" passes.", out);
    if (d != last) off_on_the_way(R, out);
    fputs("\n\n| step, deg | outcome | angles off, rad | changed by | pattern off | changed by | closure, rad | ms | "
          "passes | steps |\n|---|---|---|---|---|---|---|---|---|---|\n", out);
    for (int32_t k = 0; k < R->points; k++) {
        const rg_run *r = &R->run[k];
        const double numbers[] = {r->error, R->change[k], r->pattern_error, R->pattern_change[k], r->closure,
                                  1000 * r->seconds, r->passes};
        fputs("| ", out);
        brief(r->way.step / RG_DEG, out);
        fprintf(out, " | %s |", rg_chart_reached(c, r) ? k + 1 == R->points ? "reference" : "reached" : "stopped");
        for (int j = 0; j < 7; j++) fputc(' ', out), brief(numbers[j], out), fputs(" |", out);
        fprintf(out, " %lld |\n", (long long)r->steps);
    }
    fputs("\n", out);
}

/* Straight on, all that is to be said is how far it comes. */
static void straight_on(const rg_chart *c, FILE *out)
{
    int32_t tried = 0, reached = 0;
    double farthest = 0;
    for (int32_t i = c->relaxed.points + 1; i < c->runs; i++) {
        tried++;
        reached += rg_chart_reached(c, &c->run[i]);
        farthest = fmax(farthest, c->run[i].percent);
    }
    fprintf(out, "Straight on, %d of %d runs stop short, the farthest at ", (int)(tried - reached), (int)tried);
    brief(farthest, out);
    fputs(" percent.\n\n", out);
}

static void model(const char *name, const rg_model *o, FILE *out)
{
    fprintf(out, "| %s | %d | %d | ", name, (int)o->unknowns, (int)o->constraints);
    brief(o->ways < 0 ? NAN : o->ways, out);
    fprintf(out, " | %s | ", o->run.outcome == RG_FOLDED ? "reached" : "stopped");
    brief(o->run.error, out);
    fputs(" | ", out);
    brief(o->run.closure, out);
    fputs(" | ", out);
    brief(o->bend / RG_DEG, out);
    fputs(" | ", out);
    brief(1000 * o->run.seconds, out);
    fputs(" | ", out);
    brief(o->run.passes, out);
    fputs(" |\n", out);
}

static void models(const rg_chart *c, FILE *out)
{
    fputs("| model | unknowns | constraints | mobility | outcome | path off, rad | closure, rad | facets bend, deg "
          "| ms | passes |\n|---|---|---|---|---|---|---|---|---|---|\n", out);
    model("facets as drawn", &c->none, out);
    model("all triangles", &c->all, out);
    fprintf(out, "| bars and hinges | %d | %d bars, %d hinges | | | | | | | |\n\n", 3 * (int)c->nodes,
            (int)c->edges_all, (int)c->all.unknowns);
    fprintf(out, "Symmetries: %d; they leave %d of %d creases and %d of %d vertices to solve for.\n",
            (int)c->alike.order,
            (int)c->alike.creases, (int)c->none.unknowns, (int)c->alike.vertices, (int)c->none.constraints / 3);
}

/* Cost of avoidance against depth of crossing. */
static void contact(const rg_chart *c, FILE *out)
{
    static const char *const name[RG_TOUCHES] = {"left as they are", "kept apart"};
    const rg_touch *left = &c->touch[RG_TOUCH_LEFT];
    fputs("\nFacets that would pass through each other:\n\n| | seconds | times those | folded | crosses from "
          "| depth, of the sheet | frames | added creases |\n|---|---|---|---|---|---|---|---|\n", out);
    for (int k = 0; k < RG_TOUCHES; k++) {
        const rg_touch *t = &c->touch[k];
        if (!(t->seconds > 0)) continue;
        fprintf(out, "| %s | ", name[k]);
        brief(t->seconds, out);
        fprintf(out, " | ");
        brief(t->seconds / left->seconds, out);
        fprintf(out, " | %.1f %% | ", t->percent);
        if (t->crosses) fprintf(out, "%.1f %% | %.2g | %d", t->from, t->depth, (int)t->frames);
        else fputs("nowhere | 0 | 0", out);
        fprintf(out, " | %d |\n", (int)t->added);
    }
}

void rg_chart_words(const rg_chart *c, const char *title, FILE *out)
{
    fprintf(out, "## %s\n\n%d creases%s, %d constraints, %d frames.\n", title, (int)c->N,
            c->triangulated ? ", facets cut into triangles" : "", 3 * (int)c->M, (int)c->settings.frames);
    if (c->relaxed.folds) {
        relaxed(c, out);
        models(c, out);
        contact(c, out);
        fputs("\n", out);
        straight_on(c, out);
        return;
    }
    reference(c, out);
    verdict(c, out);
    orders(c, out);
    models(c, out);
    contact(c, out);
    fputs("\n", out);
    runs(c, out);
}
