#include "chart/order.h"
#include "fold/apart.h"
#include "base/clock.h"
#include "fold/integrate.h"

#include <string.h>

/* Steps of the coarsest try; each further one has twice as many. */
static const int32_t FIRST_STEPS = 8;
/* Errors between these tell the order: below is rounding, beyond the step is too long for it. */
static const double ROUNDING = 2e-11, TOO_LONG = 0.03;
/* Every error below this: exact. */
static const double EXACT = 1e-10;
/* The order is that of the finest steps that tell it, so many. */
static const int32_t LAST_POINTS = 3;
/* Seconds after which no finer steps are tried. */
static const double PATIENCE = 1;
static const double CLOSED = 1e-12;

double rg_slope_of(int32_t n, const double *x, const double *y)
{
    double mx = 0, my = 0, xy = 0, xx = 0;
    for (int32_t i = 0; i < n; i++) mx += log(x[i]) / n, my += log(y[i]) / n;
    for (int32_t i = 0; i < n; i++) {
        xy += (log(x[i]) - mx) * (log(y[i]) - my);
        xx += (log(x[i]) - mx) * (log(x[i]) - mx);
    }
    return n >= 2 && xx > 0 ? xy / xx : NAN;
}

/* A fold that stands at a frame of the reference and is to go to progress s_end. */
static rg_status stand(rg_straight **f, const rg_mesh *m, const rg_settings *settings, const rg_reference *ref,
                       int32_t from, double s_end, rg_method method, rg_diag *why)
{
    rg_settings s = *settings;
    rg_mesh copy;
    const double unit = fabs(s.to) / (s.frames - 1);
    s.method = method;
    s.to = s.to < 0 ? -s_end : s_end;
    s.frames = 2;
    s.tol = CLOSED;
    rg_status status = rg_mesh_copy(m, &copy);
    if (status == RG_OK) status = rg_straight_from_mesh(&copy, &s, f, why);
    if (status != RG_OK) return status;
    const rg_apart *a = &(*f)->apart;
    const double *rho = ref->frames.rho + (size_t)from * (size_t)m->N;
    rg_straight *const *system;
    (*f)->frame = 1;
    for (int32_t p = 0, n = rg_straight_systems(*f, &system); p < n; p++) {
        rg_straight *g = system[p];
        for (int32_t i = 0; i < g->mesh.N; i++) g->rho[i] = rho[a->parts ? a->crease[a->start[p] + i] : i];
        rg_straight_stand(g, g->rho, unit * from, 1);
    }
    return RG_OK;
}

/* One step of the formula alone, from rho; k: room for the stages. Zero: no direction. */
static int open_step(rg_straight *f, rg_method method, double h)
{
    const int32_t N = f->mesh.N;
    double *rho = f->rho, *at = f->trial, *k1 = f->t, **k = f->k;
    const int heun = method == RG_METHOD_HEUN, rk4 = method == RG_METHOD_RK4;
    if (!(rg_integrate_tangent(f, rho, f->s, 0, k1) > 0)) return 0;
    for (int j = 0; j < (rk4 ? 3 : heun); j++) {
        const double *before = j ? k[j - 1] : k1, part = rk4 && j < 2 ? 0.5 : 1;
        for (int32_t i = 0; i < N; i++) at[i] = rho[i] + part * h * before[i];
        if (!(rg_integrate_tangent(f, at, f->s + part * h, 0, k[j]) > 0)) return 0;
    }
    for (int32_t i = 0; i < N; i++)
        rho[i] += rk4    ? h / 6 * (k1[i] + 2 * k[0][i] + 2 * k[1][i] + k[2][i])
                  : heun ? h / 2 * (k1[i] + k[0][i])
                         : h * k1[i];
    f->s += h;
    return 1;
}

/* The whole stretch in n steps. Zero: not reached. */
static int go(rg_straight *f, rg_method method, int open, int32_t n)
{
    rg_straight *const *system;
    for (int32_t p = rg_straight_systems(f, &system); p-- > 0;) {
        rg_straight *g = system[p];
        rg_step_info info = {0};
        const double h = (g->s_end - g->s) / n;
        if (g->drive.count == 0) continue;
        for (int32_t k = 0; open && k < n; k++)
            if (!open_step(g, method, h)) return 0;
        g->settings.step = method == RG_METHOD_EULER ? h * RG_PI : RG_PI;
        while (!open && info.outcome == RG_RUNNING && info.frame < 1) {
            g->ds = h * (1 + 1e-9); /* that n of them are enough */
            rg_straight_step(g, &info);
        }
        if (!open && info.frame != 1) return 0;
    }
    if (f->apart.parts) rg_apart_gather(&f->apart, f->rho, &f->closure);
    return 1;
}

static void fit(rg_slope *s)
{
    double x[RG_ORDER_POINTS], y[RG_ORDER_POINTS];
    int32_t n = 0;
    s->exact = s->points > 0;
    for (int32_t p = 0; p < s->points; p++) {
        s->exact &= s->error[p] <= EXACT;
        if (!(s->error[p] >= ROUNDING && s->error[p] <= TOO_LONG)) continue;
        x[n] = ldexp(1, -p);
        y[n++] = s->error[p];
    }
    const int32_t last = n < LAST_POINTS ? n : LAST_POINTS;
    s->slope = s->exact ? NAN : rg_slope_of(last, x + n - last, y + n - last);
}

static rg_status measure(rg_slope *slope, rg_method method, int open, const rg_mesh *m, const rg_settings *s,
                         const rg_reference *ref, int32_t from, int32_t to, rg_diag *why)
{
    const double s_end = fabs(s->to) * to / (s->frames - 1), *goal = ref->frames.rho + (size_t)to * (size_t)m->N;
    const double begun = rg_seconds();
    rg_status status = RG_OK;
    memset(slope, 0, sizeof *slope);
    for (int32_t p = 0; p < RG_ORDER_POINTS && status == RG_OK; p++) {
        rg_straight *f = NULL;
        status = stand(&f, m, s, ref, from, s_end, method, why);
        if (status == RG_OK) {
            double far = go(f, method, open, FIRST_STEPS << p) ? 0 : INFINITY;
            for (int32_t i = 0; i < m->N; i++)
                if (!(fabs(f->rho[i] - goal[i]) <= far)) far = fabs(f->rho[i] - goal[i]);
            slope->error[slope->points++] = far;
        }
        rg_straight_destroy(f);
        if (rg_seconds() - begun > PATIENCE) break;
    }
    fit(slope);
    return status;
}

rg_status rg_order_measure(rg_order order[RG_ORDERS], const rg_mesh *m, const rg_settings *s, const rg_reference *ref,
                           int32_t from, int32_t to, rg_diag *why)
{
    static const rg_method methods[RG_ORDERS] = {RG_METHOD_EULER, RG_METHOD_NEWTON, RG_METHOD_HEUN, RG_METHOD_RK4};
    rg_status status = RG_OK;
    memset(order, 0, RG_ORDERS * sizeof *order);
    for (int j = 0; j < RG_ORDERS; j++) {
        rg_order *o = &order[j];
        o->method = methods[j];
        o->open.slope = o->closed.slope = NAN;
        if (from < 1 || to >= ref->frames.count || from >= to) continue;
        /* Where there are more equations than creases, C has one more rank off the path, and the open formula no way
         * on; and Newton's is Euler's formula. */
        if (m->N > 3 * m->M && methods[j] != RG_METHOD_NEWTON && status == RG_OK)
            status = measure(&o->open, methods[j], 1, m, s, ref, from, to, why);
        if (status == RG_OK) status = measure(&o->closed, methods[j], 0, m, s, ref, from, to, why);
    }
    return status;
}
