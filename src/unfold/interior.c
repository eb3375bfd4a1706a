#include "unfold/interior.h"
#include "linalg/dense.h"

#include <math.h>
#include <string.h>

/* Columns are read a little past their ends. */
enum { PAD = 8 };
static const int ITERATIONS = 40;
/* Done when complementarity, and what rows miss, is this part of the largest that is asked. */
static const double COMPLEMENTARY = 1e-11, KEPT = 1e-8;
/* The part of the way to the nearest bound that a step goes. */
static const double SHORT_OF_BOUND = 0.995;

/* Newton's matrix is made by ways where there are fewer than this part as many as rows: it is then the cheaper one. */
static const double FEW_WAYS = 0.6;

rg_status rg_interior_reserve(rg_interior *q, int32_t m, int32_t k)
{
    if (m <= q->rows && k <= q->ways) return RG_OK;
    const rg_memory mem = q->mem;
    const rg_interior had = *q;
    if (m > q->rows) m += m / 2;
    else m = q->rows;
    if (k > q->ways) k += k / 2;
    else k = q->ways;
    rg_interior_free(q);
    q->mem = mem;
    q->work = had.work, q->most_work = had.most_work, q->stop = had.stop, q->ctx = had.ctx;
    const size_t rows = rg_interior_stride(m), ways = rg_interior_stride(k), most = (rows > ways ? rows : ways) + PAD;
    q->F = rg_mem_array(&mem, rows * ways, sizeof *q->F);
    q->S = rg_mem_array(&mem, rows * ways, sizeof *q->S);
    q->H = rg_mem_array(&mem, most * most, sizeof *q->H);
    q->L = rg_mem_array(&mem, most * most, sizeof *q->L);
    q->update = rg_mem_array(&mem, RG_DENSE_WIDE * most + PAD, sizeof *q->update);
    double **vector[] = {&q->c, &q->d, &q->x, &q->slack, &q->v, &q->dx, &q->dslack, &q->residual, &q->both, &q->small};
    int ok = q->F && q->S && q->H && q->L && q->update;
    for (int i = 0; i < 10; i++) ok &= (*vector[i] = rg_mem_array(&mem, most, sizeof(double))) != NULL;
    if (ok) q->rows = m, q->ways = k;
    else rg_interior_free(q), q->mem = mem;
    return ok ? RG_OK : RG_ENOMEM;
}

void rg_interior_free(rg_interior *q)
{
    if (!q->mem.resize) return;
    void *block[] = {q->F, q->S, q->H, q->L, q->update, q->c, q->d, q->x, q->slack, q->v, q->dx, q->dslack, q->residual, q->both,
                     q->small};
    for (int i = 0; i < 15; i++) rg_mem_free(&q->mem, block[i]);
    memset(q, 0, sizeof *q);
}

/* What the functions below work on. */
typedef struct problem {
    rg_interior *q;
    int32_t m, k;
    size_t stride, wide; /* of F; of L */
    int by_ways;
} problem;

static const double *row_of(const problem *p, int32_t i) { return p->q->F + (size_t)i * p->stride; }

/* v = F^T x */
static void gather(const problem *p, const double *x, double *v)
{
    memset(v, 0, p->stride * sizeof *v);
    for (int32_t i = 0; i < p->m; i++) {
        const double *f = row_of(p, i), of = x[i];
        for (int32_t j = 0; j < p->k; j++) v[j] += of * f[j];
    }
}

static double dot(int32_t m, const double *x, const double *y)
{
    double sum = 0;
    for (int32_t i = 0; i < m; i++) sum += x[i] * y[i];
    return sum;
}

static double farthest(int32_t m, const double *x, const double *dx, double part)
{
    double step = 1;
    for (int32_t i = 0; i < m; i++)
        if (dx[i] < 0) step = fmin(step, -part * x[i] / dx[i]);
    return step;
}

static double diagonal(const rg_interior *q, int32_t i) { return q->c[i] + q->slack[i] / q->x[i]; }

/* From a lower triangle by rows to one by columns. */
static void turn(const problem *p, int32_t n, size_t room)
{
    rg_interior *q = p->q;
    for (int32_t j = 0; j < n; j++)
        for (int32_t i = j; i < n; i++) q->L[(size_t)j * p->wide + (size_t)i] = q->H[(size_t)i * room + (size_t)j];
}

static int factor(problem *p)
{
    rg_interior *q = p->q;
    const int32_t n = p->by_ways ? p->k : p->m;
    if (p->by_ways) {
        const size_t along = rg_interior_stride(p->m);
        for (int32_t i = 0; i < (int32_t)along; i++) {
            const double part = i < p->m ? 1 / sqrt(diagonal(q, i)) : 0;
            for (int32_t j = 0; j < p->k; j++) q->S[(size_t)j * along + (size_t)i] = i < p->m ? part * row_of(p, i)[j] : 0;
        }
        rg_dense_gram(0, p->k, (int32_t)along, q->S, along, q->H, p->wide);
        turn(p, n, p->wide);
        for (int32_t j = 0; j < n; j++) q->L[(size_t)j * p->wide + (size_t)j] += 1;
        q->work += (double)p->m * n * n / 2;
    } else {
        turn(p, n, p->wide);
        for (int32_t j = 0; j < n; j++) q->L[(size_t)j * p->wide + (size_t)j] += diagonal(q, j);
    }
    q->work += (double)n * n * n / 6;
    return rg_dense_factor(n, q->L, p->wide, q->update);
}

/* Newton's step for: (F F^T + C) x - d - slack = 0, x slack = target; residual is what the first is off, `both` the second
 * over x. */
static void newton(problem *p)
{
    rg_interior *q = p->q;
    for (int32_t i = 0; i < p->m; i++) q->dx[i] = -q->residual[i] + q->both[i];
    if (p->by_ways) {
        for (int32_t i = 0; i < p->m; i++) q->dslack[i] = q->dx[i] / diagonal(q, i);
        gather(p, q->dslack, q->small);
        rg_dense_solve(p->k, q->L, p->wide, q->small);
        for (int32_t i = 0; i < p->m; i++)
            q->dx[i] = (q->dx[i] - rg_dense_dot((int32_t)p->stride, row_of(p, i), q->small)) / diagonal(q, i);
    } else {
        rg_dense_solve(p->m, q->L, p->wide, q->dx);
    }
    for (int32_t i = 0; i < p->m; i++) q->dslack[i] = q->both[i] - q->slack[i] / q->x[i] * q->dx[i];
}

/* residual; returns the largest of it. */
static double off(const problem *p)
{
    rg_interior *q = p->q;
    double most = 0;
    gather(p, q->x, q->v);
    for (int32_t i = 0; i < p->m; i++) {
        q->residual[i] = rg_dense_dot((int32_t)p->stride, row_of(p, i), q->v) + q->c[i] * q->x[i] - q->d[i] - q->slack[i];
        most = fmax(most, fabs(q->residual[i]));
    }
    return most;
}

void rg_interior_solve(rg_interior *q, int32_t m, int32_t k)
{
    problem p = {q, m, k, rg_interior_stride(k), rg_interior_stride(m > k ? m : k) + PAD, k < FEW_WAYS * m};
    double scale = 0;
    for (int32_t i = 0; i < m; i++) scale = fmax(scale, q->d[i]);
    q->iterations = 0;
    memset(q->x, 0, (size_t)m * sizeof *q->x);
    memset(q->v, 0, p.stride * sizeof *q->v);
    memset(q->small, 0, p.stride * sizeof *q->small);
    if (!(scale > 0)) return;
    if (!p.by_ways) {
        rg_dense_gram(0, m, (int32_t)p.stride, q->F, p.stride, q->H, p.wide);
        q->work += (double)m * m * k / 2;
    }
    for (int32_t i = 0; i < m; i++) q->x[i] = scale, q->slack[i] = 0;
    off(&p);
    for (int32_t i = 0; i < m; i++) q->slack[i] = fmax(q->residual[i], scale);
    for (; q->iterations < ITERATIONS; q->iterations++) {
        const double most = off(&p), mu = dot(m, q->x, q->slack) / m;
        if (mu < COMPLEMENTARY * scale * scale && most < KEPT * scale) break;
        if ((q->most_work > 0 && q->work > q->most_work) || (q->stop && q->stop(q->ctx, 0)) || !factor(&p)) break;
        for (int32_t i = 0; i < m; i++) q->both[i] = -q->slack[i];
        newton(&p); /* predictor */
        const double a = fmin(farthest(m, q->x, q->dx, 1), farthest(m, q->slack, q->dslack, 1));
        double after = 0;
        for (int32_t i = 0; i < m; i++) after += (q->x[i] + a * q->dx[i]) * (q->slack[i] + a * q->dslack[i]);
        const double less = after / m / mu, centre = less * less * less * mu;
        for (int32_t i = 0; i < m; i++) q->both[i] = (centre - q->dx[i] * q->dslack[i]) / q->x[i] - q->slack[i];
        newton(&p); /* corrector */
        const double step = fmin(farthest(m, q->x, q->dx, SHORT_OF_BOUND), farthest(m, q->slack, q->dslack, SHORT_OF_BOUND));
        for (int32_t i = 0; i < m; i++) {
            q->x[i] += step * q->dx[i];
            q->slack[i] += step * q->dslack[i];
        }
    }
    gather(&p, q->x, q->v);
}
