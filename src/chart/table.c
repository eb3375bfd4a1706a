/* table.c -- what a chart says, as a table for programs and as one for people. */
#include "base/number.h"
#include "chart/chart.h"

#include <stdarg.h>

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

/* Words with numbers: ~ is a double, as by `brief`, # an int, $ a string. */
static void put(FILE *out, const char *words, ...)
{
    va_list args;
    va_start(args, words);
    for (; *words; words++)
        if (*words == '~') brief(va_arg(args, double), out);
        else if (*words == '#') fprintf(out, "%d", va_arg(args, int));
        else if (*words == '$') fputs(va_arg(args, const char *), out);
        else fputc(*words, out);
    va_end(args);
}

static void reference(const rg_chart *c, FILE *out)
{
    const rg_reference *ref = &c->ref;
    const int known = (int)ref->frames.count, frames = (int)c->settings.frames;
    fputs("Reference: ", out);
    if (ref->exact) {
        put(out, "closed form (every vertex flat-foldable, of degree 4); the sheet closes there to ~ rad.\n\n",
            ref->closure);
        return;
    }
    if (known < 2) {
        fputs("none: steps cut shorter and shorter do not get from flat to the next frame, or to different ones.\n\n",
              out);
        return;
    }
    fputs("rk4 with graded steps, halved; the path changed by", out);
    for (int32_t n = 1; n < ref->halvings; n++) put(out, n > 1 ? ", ~" : " ~", ref->change[n]);
    put(out, " rad; its error is about ~ rad.\n\n", ref->error);
    if (known < frames) put(out, "It is known for # of # frames: errors are those of these.\n\n", known, frames);
}

static const char *method(const rg_run *r) { return rg_run_method_name(r->method); }
static const char *solver(const rg_run *r) { return rg_run_solver_name(r->solver); }

static void verdict(const rg_chart *c, FILE *out)
{
    if (c->runs == 0) return;
    const rg_run *a = &c->run[0], *quick = rg_chart_best(c, 0), *lean = rg_chart_best(c, 1);
    if (!rg_chart_reached(c, a) || !quick || !lean) {
        put(out, "The default, $ with $, stops short.\n\n", method(a), solver(a));
        return;
    }
    put(out, "The default is $ with $: ~ rad off in ~ ms, ~ passes. ", method(a), solver(a), a->error,
        1000 * a->seconds, a->passes);
    put(out, "As accurate, the quickest takes ~ ms ($, $), the default ~ times that; ", 1000 * quick->seconds,
        method(quick), solver(quick), a->seconds / quick->seconds);
    put(out, "the leanest ~ passes ($, $), the default ~ times that.\n\n", lean->passes, method(lean), solver(lean),
        a->passes / lean->passes);
}

static void runs(const rg_chart *c, FILE *out)
{
    int32_t stopped = 0;
    for (int32_t i = 1; i < c->runs; i++) stopped += !rg_chart_reached(c, &c->run[i]);
    put(out, "Of # runs # stopped short", (int)c->runs, (int)stopped);
    for (int32_t i = 1, n = 0; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (rg_chart_reached(c, r)) continue;
        put(out, "$$ with $ at ~ percent, step ~", n++ ? "; " : ": ", method(r), solver(r), r->percent,
            r->way.step / RG_DEG);
    }
    fputs(". The default, and those that none beats both in time and in error:\n\n"
          "| method | solver | step, deg | tol | error, rad | closure, rad | ms | passes | steps | solves |\n"
          "|---|---|---|---|---|---|---|---|---|---|\n", out);
    for (int32_t i = 0; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (i > 0 && !rg_chart_on_front(c, i)) continue;
        const double step = r->method == RG_METHOD_ADAPTIVE ? NAN : r->way.step / RG_DEG;
        put(out, "| $$ | $ | ~ | ~ | ~ | ~ | ~ | ~", i == 0 ? "**default** " : "", method(r), solver(r), step,
            r->way.tol, r->error, r->closure, 1000 * r->seconds, r->passes);
        fprintf(out, " | %lld | %lld |\n", (long long)r->steps, (long long)r->solves);
    }
    fputs("\n", out);
}

/* An order of convergence. */
static double order(double x) { return isnan(x) ? NAN : round(100 * x) / 100; }

static void slope(const rg_slope *s, FILE *out) { put(out, s->exact ? "exact" : "~", order(s->slope)); }

static void orders(const rg_chart *c, FILE *out)
{
    put(out, "Observed order from ~ to ~ percent:\n\n", 100 * c->from, 100 * c->to);
    fputs("| method | of the formula alone | as it folds |\n|---|---|---|\n", out);
    for (int j = 0; j < RG_ORDERS; j++) {
        put(out, "| $ | ", rg_run_method_name(c->order[j].method));
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
    for (int j = 0; j < RG_RELAXED_PERCENTS; j++) put(out, " ~ |", R->off[j]);
    fputs("\n| pattern, of the sheet |", out);
    for (int j = 0; j < RG_RELAXED_PERCENTS; j++) put(out, " ~ |", R->pattern_off[j]);
}

/* Of the relaxed stepper: its path by steps halved, what the default is off by, its order. */
static void relaxed(const rg_chart *c, FILE *out)
{
    const rg_relaxed *R = &c->relaxed;
    const rg_run *d = &R->run[RG_RELAXED_DEFAULT], *last = &R->run[R->points - 1];
    put(out, "Nothing folds straight on; what folds is $", R->strategy);
    if (R->best.relax->U > 0)
        put(out, ", the pattern moving by up to ~ % of the sheet", 100 * R->best.moved / R->best.mesh.size);
    put(out, ", # creases added, a symmetry of order # kept.\n", (int)R->best.mesh.added,
        R->best.symmetry ? (int)R->best.symmetry->order : 1);
    put(out, "Reference: the same with steps of ~ degrees.", last->way.step / RG_DEG);
    if (R->order > 0 && R->error <= d->error)
        put(out, " Its own error, if changes go on to fall as they did, is ~ rad; observed order: ~ of the angles, "
                 "~ of the pattern.", R->error, order(R->order), order(R->pattern_order));
    else
        put(out, " The path has not converged there: changes hardly fall with the step (order ~ of the angles, "
                 "~ of the pattern), and errors are differences from it, not from a limit.", order(R->order),
            order(R->pattern_order));
    if (R->finer_stops) put(out, " Half that step stops at ~ percent: $.", R->run[R->points].percent, R->reason);
    put(out, "\n\nThe default, relaxed with steps of ~ degrees, is ", d->way.step / RG_DEG);
    if (d == last) fputs("itself the finest that folds: what it is off by is not known. It takes ", out);
    else put(out, "off by ~ rad and ~ of the sheet, in ", d->error, d->pattern_error);
    put(out, "~ ms, ~ passes.", 1000 * d->seconds, d->passes);
    if (d != last) off_on_the_way(R, out);
    fputs("\n\n| step, deg | outcome | angles off, rad | changed by | pattern off | changed by | closure, rad | ms | "
          "passes | steps |\n|---|---|---|---|---|---|---|---|---|---|\n", out);
    for (int32_t k = 0; k < R->points; k++) {
        const rg_run *r = &R->run[k];
        const char *how = !rg_chart_reached(c, r) ? "stopped" : k + 1 == R->points ? "reference" : "reached";
        put(out, "| ~ | $ | ~ | ~ | ~ | ~ | ~ | ~ | ~ |", r->way.step / RG_DEG, how, r->error, R->change[k],
            r->pattern_error, R->pattern_change[k], r->closure, 1000 * r->seconds, r->passes);
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
    put(out, "Straight on, # of # runs stop short, the farthest at ~ percent.\n\n", (int)(tried - reached), (int)tried,
        farthest);
}

static void model(const char *name, const rg_model *o, FILE *out)
{
    const rg_run *r = &o->run;
    put(out, "| $ | # | # | ~ | $ | ~ | ~ | ~ | ~ | ~ |\n", name, (int)o->unknowns, (int)o->constraints,
        o->ways < 0 ? NAN : o->ways, r->outcome == RG_FOLDED ? "reached" : "stopped", r->error, r->closure,
        o->bend / RG_DEG, 1000 * r->seconds, r->passes);
}

static void models(const rg_chart *c, FILE *out)
{
    fputs("| model | unknowns | constraints | mobility | outcome | path off, rad | closure, rad | facets bend, deg "
          "| ms | passes |\n|---|---|---|---|---|---|---|---|---|---|\n", out);
    model("facets as drawn", &c->none, out);
    model("all triangles", &c->all, out);
    put(out, "| bars and hinges | # | # bars, # hinges | | | | | | | |\n\n", 3 * (int)c->nodes, (int)c->edges_all,
        (int)c->all.unknowns);
    put(out, "Symmetries: #; they leave # of # creases and # of # vertices to solve for.\n", (int)c->alike.order,
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
        put(out, "| $ | ~ | ~", name[k], t->seconds, t->seconds / left->seconds);
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
