#include "linalg/cg.h"
#include "base/lanes.h"

#include <string.h>

/* Least squares is declared when C^T P (b - C x), against C^T P b, is this much smaller than the tolerance asked for: a
 * slow mode has a small C^T P r too, and must not be taken for one that is out of reach. */
static const double LEAST_SQUARES_MARGIN = 1e-3;

rg_status rg_cg_work_init(rg_cg_work *w, const rg_memory *mem, int32_t M, int32_t N)
{
    memset(w, 0, sizeof *w);
    w->mem = *mem;
    w->M = M;
    w->N = N;
    const size_t m = 3 * (size_t)M, n = (size_t)N;
    return RG_MEM_ARRAYS(mem, RG_ARRAY(w->r, m), RG_ARRAY(w->z, m), RG_ARRAY(w->u, m), RG_ARRAY(w->q, m),
                         RG_ARRAY(w->w, m), RG_ARRAY(w->s, n), RG_ARRAY(w->p, n));
}

void rg_cg_work_free(rg_cg_work *w)
{
    if (!w->mem.resize) return;
    RG_MEM_FREE(&w->mem, w->r, w->z, w->u, w->q, w->w, w->s, w->p);
    memset(w, 0, sizeof *w);
}

/* r = b - C x */
static void residual(const rg_sparse *C, const double *b, const double *x, double *r)
{
    rg_sparse_mul(C, x, r);
    for (int32_t i = 0; i < 3 * C->M; i++) r[i] = b[i] - r[i];
}

/* The directions of an earlier solve count for nothing, but nothing times what is no number would be none. */
static void forget_directions(int32_t n, double *p, int32_t m, double *q)
{
    memset(p, 0, (size_t)n * sizeof *p);
    memset(q, 0, (size_t)m * sizeof *q);
}

/* x = (I - n n^T) C^T y */
static void mul_t_held(const rg_sparse *C, const double *hold, const double *y, double *x)
{
    rg_sparse_mul_t(C, y, x);
    if (!hold) return;
    double along = rg_lanes_dot(C->N, hold, x);
    for (int32_t i = 0; i < C->N; i++) x[i] -= along * hold[i];
}

void rg_cg_solve(const rg_sparse *C, rg_apply *P, const void *ctx, const double *hold, const double *b, double *y,
                 double *x, double tol, int32_t max_iterations, rg_cg_work *k, rg_cg_report *rep)
{
    const int32_t m = 3 * C->M, n = C->N;
    double *r = k->r, *z = k->z, *u = k->u, *q = k->q, *w = k->w, *s = k->s, *p = k->p;

    forget_directions(n, p, m, q);
    P(ctx, b, z);
    const double target = tol * sqrt(rg_lanes_dot(m, b, z));
    mul_t_held(C, hold, z, s);
    const double all = sqrt(rg_lanes_dot(n, s, s));

    mul_t_held(C, hold, y, x);
    residual(C, b, x, r);
    P(ctx, r, u);
    if (!(rg_lanes_dot(m, r, u) < rg_lanes_dot(m, b, z))) { /* the start is no better than none */
        memset(y, 0, (size_t)m * sizeof *y);
        memset(x, 0, (size_t)n * sizeof *x);
        memcpy(r, b, (size_t)m * sizeof *r);
    } else {
        memcpy(z, u, (size_t)m * sizeof *z);
    }

    rep->stop = RG_CG_MAX_ITERATIONS;
    rep->iterations = 0;
    double gamma = 0;
    for (;;) {
        mul_t_held(C, hold, z, s);
        double old = gamma, left = sqrt(fmax(rg_lanes_dot(m, r, z), 0));
        gamma = rg_lanes_dot(n, s, s);
        if (left <= target) {
            rep->stop = RG_CG_CONVERGED;
            break;
        }
        if (sqrt(gamma) <= LEAST_SQUARES_MARGIN * tol * all) {
            rep->stop = RG_CG_LEAST_SQUARES;
            break;
        }
        if (rep->iterations >= max_iterations) break;
        double beta = rep->iterations ? gamma / old : 0;
        for (int32_t i = 0; i < n; i++) p[i] = s[i] + beta * p[i];
        for (int32_t i = 0; i < m; i++) q[i] = z[i] + beta * q[i]; /* p = C^T q */
        rg_sparse_mul(C, p, w);
        P(ctx, w, u);
        double curvature = rg_lanes_dot(m, w, u);
        if (!(curvature > 0)) {
            rep->stop = RG_CG_BREAKDOWN;
            break;
        }
        double alpha = gamma / curvature;
        for (int32_t i = 0; i < n; i++) x[i] += alpha * p[i];
        for (int32_t i = 0; i < m; i++) {
            y[i] += alpha * q[i];
            r[i] -= alpha * w[i];
            z[i] -= alpha * u[i];
        }
        rep->iterations++;
    }
    mul_t_held(C, hold, y, x);
}

/* So many steps in a row none of which is shorter than half the shortest before: that is rounding. */
static const int32_t STALLED = 6;
/* Steps that grow shorter as regularly as the last two: the next would be shorter than what is asked for by this factor
 * at the least, and is not looked at. */
static const double UNSEEN = 10;
/* A step this much shorter than the first, against a residual that is out of reach, may have lost its direction. */
static const double ROUNDED = 1e-5;

void rg_cg_refine(const rg_sparse *B, rg_apply_pinv *G, void *ctx, const double *b, double *x, double relative,
                  double absolute, int32_t max_iterations, rg_cg_work *k, rg_cg_report *rep)
{
    const int32_t m = 3 * B->M, n = B->N;
    double *r = k->r, *w = k->w, *u = k->u, *z = k->s, *p = k->p;
    double curvature = 0, shortest = INFINITY, first = 0, before = 0, target = absolute;
    int32_t since = 0;

    forget_directions(n, p, m, w);
    memset(x, 0, (size_t)n * sizeof *x);
    memcpy(r, b, (size_t)m * sizeof *r);
    rep->stop = RG_CG_MAX_ITERATIONS;
    for (rep->iterations = 0;; rep->iterations++) {
        G(ctx, r, z);
        double length = sqrt(rg_lanes_dot(n, z, z));
        if (rep->iterations == 0) first = length, target = fmax(absolute, relative * length);
        if (length <= 0.5 * shortest) shortest = length, since = 0;
        else since++;
        if (length <= target || since >= STALLED) {
            if (length <= target)
                for (int32_t i = 0; i < n; i++) x[i] += z[i];
            rep->stop = length <= target ? RG_CG_CONVERGED : RG_CG_LEAST_SQUARES;
            break;
        }
        if (rep->iterations >= max_iterations) break;
        rg_sparse_mul(B, z, u);
        double beta = rep->iterations ? -rg_lanes_dot(m, u, w) / curvature : 0;
        rg_lanes_add_to(n, beta, z, p);
        rg_lanes_add_to(m, beta, u, w); /* w = B p */
        curvature = rg_lanes_dot(m, w, w);
        double gain = rg_lanes_dot(m, r, w), alpha = gain / curvature;
        if (!(curvature > 0 && gain > 0)) { /* rounding, if the steps have become short */
            rep->stop = length <= ROUNDED * first ? RG_CG_LEAST_SQUARES : RG_CG_BREAKDOWN;
            break;
        }
        rg_lanes_add(n, alpha, p, x);
        rg_lanes_add(m, -alpha, w, r);
        if (before > 0 && UNSEEN * length * (length / before) <= target) {
            rep->iterations++;
            rep->stop = RG_CG_CONVERGED;
            break;
        }
        before = length;
    }
}
