/* chart.h -- speed against accuracy of one pattern: every method with every solver, over a range of steps.
 * Uses  reference.h order.h relaxed.h touch.h model.h alike.h        Used by  table.c plot.c */
#ifndef RG_CHART_H
#define RG_CHART_H

#include "chart/model.h"
#include "chart/order.h"
#include "chart/reference.h"
#include "chart/relaxed.h"
#include "chart/touch.h"
#include "pattern/alike.h"

#include <stdio.h>

/* Curves: 4 methods by step and 1 by tolerance with 3 solvers each, 5 points a curve; the relaxed stepper's; and the
 * default. */
enum { RG_CHART_POINTS = 5, RG_CHART_RUNS = 5 * 3 * RG_CHART_POINTS + RG_RELAXED_POINTS + 1 };

struct rg_chart {
    rg_memory mem;
    rg_settings settings;
    int32_t nv, N, M, added, frames;
    int triangulated;
    rg_reference ref;
    rg_relaxed relaxed;         /* where nothing folds straight on; then N, M, added are of its sheet, ref is empty */
    int32_t runs;
    rg_run run[RG_CHART_RUNS];  /* curve by curve; the first is the default */
    rg_order order[RG_ORDERS];
    double from, to;            /* progress: the stretch that the orders are of */
    rg_touch touch[RG_TOUCHES]; /* facets left as they are, and kept out of each other's way */
    rg_model none, all;
    int32_t edges_all, nodes;   /* of the sheet cut into triangles */
    rg_alike alike;             /* of the sheet as drawn */
};

/* It went all the way, to every frame. */
int rg_chart_reached(const rg_chart *c, const rg_run *r);
/* The least cost, in seconds or in passes, among runs as accurate as the default; NULL: the default stops short. */
const rg_run *rg_chart_best(const rg_chart *c, int in_passes);
/* Non-zero: no run is both quicker and nearer to the path than run i. */
int rg_chart_on_front(const rg_chart *c, int32_t i);
/* Non-zero: run i is of the curve that run i - 1 is of. */
int rg_chart_same_curve(const rg_chart *c, int32_t i);

/* table.c, plot.c: `out` is written to; its errors are the caller's to look at. */
void rg_chart_csv(const rg_chart *c, const char *title, FILE *out);
void rg_chart_words(const rg_chart *c, const char *title, FILE *out);
void rg_chart_svg(const rg_chart *c, const char *title, FILE *out);

#endif
