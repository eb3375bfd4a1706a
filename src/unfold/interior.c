#include "unfold/interior.h"
#include "linalg/dense.h"

#include <math.h>
#include <string.h>

/* Columns are read a little past their ends. */
enum { PAD = 8 };
static const int ITERATIONS = 60;
/* Done when complementarity, and what rows miss, is this part of the largest that is asked. */
static const double COMPLEMENTARY = 1e-11, KEPT = 1e-8;
/* The part of the way to the nearest bound that a step goes. */
static const double SHORT_OF_BOUND = 0.995;
/* The proximal term: E comes to hold by a factor of it over what E E^T is worth along each direction, which near flat
 * is as little as 1e-7 along some; and rounding grows by its inverse. */
static const double EPS = 1e-9;
/* Multipliers begin as so many times what is asked: that is some times what a single row needs; rows that contradict
 * each other need thousands of times as much, which a part of the largest of the last solution tells. */
static const double BEGIN = 100, BEGIN_LAST = 0.03, BEGIN_SLACK = 0.3;
/* What products x t may be, over the centre's, before they are corrected; and what a correction aims at, a longer
 * step. */
static const double OFF_CENTRE = 10, LONGER = 1.5, LONGER_BY = 0.3;
/* On the diagonal where rounding spoils a pivot. */
static const double BETA = 1e-9, BETA_GROWTH = 100, BETA_LARGEST = 1;
/* What adding a number to its place costs, in multiplications of a product of panels. */
static const double LAYING = 4;
static const rg_slots NONE;
/* Iterations that a solution by rows is reckoned to take, where its cost is compared. */
static const double RECKONED = 12;

rg_status rg_interior_init(rg_interior *q, const rg_memory *mem, int32_t n)
{
    memset(q, 0, sizeof *q);
    q->mem = *mem;
    q->n = n;
    const size_t all = (size_t)n;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(q->g, all), RG_ARRAY(q->v, all), RG_ARRAY(q->off, all),
                                RG_ARRAY(q->dv, all));
    if (s == RG_OK) s = rg_rows_init(&q->J, mem);
    if (s == RG_OK) s = rg_rows_init(&q->E, mem);
    if (s == RG_OK) s = rg_rows_init(&q->R, mem);
    if (s == RG_OK) s = rg_normal_init(&q->few, mem, n);
    if (s == RG_OK) s = rg_normal_init(&q->many, mem, n);
    return s;
}

void rg_interior_free(rg_interior *q)
{
    if (!q->mem.resize) return;
    rg_slots *slots[] = {&q->few_J, &q->few_E, &q->many_J, &q->many_E, &q->many_R};
    for (int i = 0; i < 5; i++) rg_normal_free_slots(&q->mem, slots[i]);
    rg_rows_free(&q->J);
    rg_rows_free(&q->E);
    rg_rows_free(&q->R);
    rg_normal_free(&q->few);
    rg_normal_free(&q->many);
    RG_MEM_FREE(&q->mem, q->g, q->c, q->d, q->of, q->x, q->slack, q->v, q->base, q->many_base, q->Z, q->M, q->L, q->dx,
                q->dy, q->update, q->dslack, q->residual, q->both, q->before, q->off, q->dv, q->y, q->Ev, q->weight,
                q->at, q->sum, q->inverse);
    memset(q, 0, sizeof *q);
}

void rg_interior_clear(rg_interior *q)
{
    rg_rows_clear(&q->J);
    rg_rows_clear(&q->E);
    rg_rows_clear(&q->R);
    q->many_R.used = 0;
    q->many_R.rows = q->solved = q->known = 0;
    q->laid = q->factored = q->many_laid = 0;
}

rg_status rg_interior_reserve(rg_interior *q, int32_t m)
{
    if ((size_t)m <= q->rows_room) return RG_OK;
    const size_t n = (size_t)m + (size_t)m / 2;
    RG_MEM_FREE(&q->mem, q->of, q->c, q->d, q->x, q->slack, q->dx, q->dslack, q->residual, q->both, q->before,
                q->inverse);
    const rg_status s = RG_MEM_ARRAYS(&q->mem, RG_ARRAY(q->of, n), RG_ARRAY(q->c, n), RG_ARRAY(q->d, n),
                                      RG_ARRAY(q->x, n), RG_ARRAY(q->slack, n), RG_ARRAY(q->dx, n),
                                      RG_ARRAY(q->dslack, n), RG_ARRAY(q->residual, n), RG_ARRAY(q->both, n),
                                      RG_ARRAY(q->before, n), RG_ARRAY(q->inverse, n));
    q->rows_room = s == RG_OK ? n : 0;
    return s;
}

/* --------------------------------------------------------------------------------------------- G + E^T E / eps ---- */

/* Of one factorisation, and of laying its numbers down. */
static double numbers(const rg_normal *N, const rg_slots *rows)
{
    return N->L.S.flops / 2 + LAYING * (N->L.S.entries + (double)rows->used);
}

/* The numbers of one factorisation that do not depend on rows of R. */
static void lay(const rg_interior *q, const rg_normal *N, const rg_slots *J, const rg_slots *E, double *x)
{
    memset(x, 0, rg_normal_numbers(N) * sizeof *x);
    rg_normal_add(&q->E, E, NULL, x);
    for (size_t i = 0; i < rg_normal_numbers(N); i++) x[i] /= EPS;
    rg_normal_add(&q->J, J, NULL, x);
    for (int32_t j = 0; j < q->n; j++) x[N->diagonal[j]] += q->g[j];
}

/* Zero: not with any beta. */
static int factor(rg_interior *q, rg_normal *N, const double *base, const double *weight)
{
    for (double beta = 0; beta <= BETA_LARGEST; beta = beta > 0 ? beta * BETA_GROWTH : BETA) {
        memcpy(N->L.x, base, rg_normal_numbers(N) * sizeof *base);
        if (weight) rg_normal_add(&q->R, &q->many_R, weight, N->L.x);
        q->work += numbers(N, weight ? &q->many_R : &NONE);
        if (rg_supernodal_factor(&N->L, beta)) return 1;
    }
    return 0;
}

static rg_status lay_few(rg_interior *q)
{
    const rg_rows *lists[] = {&q->J, &q->E};
    rg_status s = RG_OK;
    int fits;
    if (q->laid) return RG_OK;
    if (q->few.L.S.n == 0) {
        s = rg_normal_analyse(&q->few, lists, 2);
        if (s == RG_OK) s = rg_normal_find(&q->few, &q->J, &q->few_J, &fits);
        if (s == RG_OK) s = rg_normal_find(&q->few, &q->E, &q->few_E, &fits);
        const size_t edges = (size_t)q->E.count;
        if (s == RG_OK)
            s = RG_MEM_ARRAYS(&q->mem, RG_ARRAY(q->base, rg_normal_numbers(&q->few)), RG_ARRAY(q->y, edges),
                              RG_ARRAY(q->dy, edges), RG_ARRAY(q->Ev, edges));
        if (s != RG_OK) return s;
    }
    lay(q, &q->few, &q->few_J, &q->few_E, q->base);
    q->laid = 1;
    return RG_OK;
}

/* What is left of G v - E^T y - right is put into q->off; of E v into q->Ev. */
static void saddle(rg_interior *q, const double *v, const double *y)
{
    for (int32_t j = 0; j < q->n; j++) q->off[j] = q->g[j] * v[j];
    for (int32_t i = 0; i < q->J.count; i++) rg_rows_gather(&q->J, i, rg_rows_dot(&q->J, i, v), q->off);
    for (int32_t i = 0; i < q->E.count; i++) {
        q->Ev[i] = rg_rows_dot(&q->E, i, v);
        rg_rows_gather(&q->E, i, -y[i], q->off);
    }
    q->work += LAYING * (double)(q->J.start[q->J.count] + q->E.start[q->E.count]);
}

/* z = the v of G v - E^T y = row, E v = 0: solved, and corrected once. */
static void solve_row(rg_interior *q, int32_t row, double *z)
{
    memset(z, 0, (size_t)q->n * sizeof *z);
    memset(q->y, 0, (size_t)q->E.count * sizeof *q->y);
    for (int pass = 0; pass < 2; pass++) {
        if (pass) saddle(q, z, q->y);
        else {
            memset(q->off, 0, (size_t)q->n * sizeof *q->off);
            memset(q->Ev, 0, (size_t)q->E.count * sizeof *q->Ev);
        }
        rg_rows_gather(&q->R, row, -1, q->off);
        for (int32_t j = 0; j < q->n; j++) q->dv[j] = -q->off[j];
        for (int32_t i = 0; i < q->E.count; i++) rg_rows_gather(&q->E, i, -q->Ev[i] / EPS, q->dv);
        rg_supernodal_solve(&q->few.L, q->dv);
        for (int32_t i = 0; i < q->E.count; i++) q->y[i] -= (q->Ev[i] + rg_rows_dot(&q->E, i, q->dv)) / EPS;
        for (int32_t j = 0; j < q->n; j++) z[j] += q->dv[j];
    }
    q->work += 4 * q->few.L.S.entries;
}

/* --------------------------------------------------------------------------------------------- Newton's matrix ---- */

typedef struct problem {
    rg_interior *q;
    int32_t m;
    size_t wide; /* of M and L */
    int by_rows;
} problem;

/* [m] 1 / D, and by ways its sum over the forms of each row of R. */
static void weigh(problem *p)
{
    rg_interior *q = p->q;
    for (int32_t i = 0; i < p->m; i++) q->inverse[i] = 1 / (q->c[i] + q->slack[i] / q->x[i]);
    if (p->by_rows) return;
    memset(q->weight, 0, (size_t)q->R.count * sizeof *q->weight);
    for (int32_t i = 0; i < p->m; i++) q->weight[q->of[i]] += q->inverse[i];
}

/* v <- v + R^T a; a[m]. Forms of one row are added up first. */
static void spread(problem *p, const double *a, double *v)
{
    rg_interior *q = p->q;
    memset(q->sum, 0, (size_t)q->R.count * sizeof *q->sum);
    for (int32_t i = 0; i < p->m; i++) q->sum[q->of[i]] += a[i];
    for (int32_t k = 0; k < q->R.count; k++)
        if (q->sum[k] != 0) rg_rows_gather(&q->R, k, q->sum[k], v);
}

/* sum[R.count] = R v, of rows that are asked for. */
static void measure(problem *p, const double *v)
{
    rg_interior *q = p->q;
    for (int32_t k = 0; k < q->R.count; k++) q->sum[k] = 0;
    for (int32_t i = 0; i < p->m; i++) q->sum[q->of[i]] = 1;
    for (int32_t k = 0; k < q->R.count; k++)
        if (q->sum[k] != 0) q->sum[k] = rg_rows_dot(&q->R, k, v);
}

/* The column of Z that belongs to a row of R. */
static const double *column(const rg_interior *q, int32_t row) { return q->Z + (size_t)q->at[row] * (size_t)q->n; }

/* Z of the rows that are asked for, M. */
static rg_status set_rows(problem *p)
{
    rg_interior *q = p->q;
    const size_t n = (size_t)q->n, wide = p->wide;
    rg_status s = RG_MEM_GROW(&q->mem, q->Z, q->Z_room, (size_t)(q->solved + p->m) * n);
    const size_t had = q->dense_room;
    if (s == RG_OK && wide * wide > had) {
        size_t again = had;
        s = RG_MEM_GROW(&q->mem, q->M, again, wide * wide);
        if (s == RG_OK) s = RG_MEM_GROW(&q->mem, q->L, q->dense_room, wide * wide);
    }
    if (s == RG_OK) s = RG_MEM_GROW(&q->mem, q->update, q->wide_room, RG_DENSE_WIDE * wide + PAD);
    if (s != RG_OK) return s;
    if (!q->factored) q->factored = factor(q, &q->few, q->base, NULL);
    for (int32_t k = 0; k < p->m; k++)
        if (q->at[q->of[k]] < 0) {
            solve_row(q, q->of[k], q->Z + (size_t)q->solved * n);
            q->at[q->of[k]] = q->solved++;
        }
    for (int32_t k = 0; k < p->m; k++)
        for (int32_t i = k; i < p->m; i++)
            q->M[(size_t)k * wide + (size_t)i] = rg_rows_dot(&q->R, q->of[i], column(q, q->of[k]));
    return RG_OK;
}

/* A pattern in which all rows of R have their place. */
static rg_status set_ways(rg_interior *q)
{
    int fits = q->many.L.S.n > 0;
    rg_status s = RG_OK;
    if (fits) s = rg_normal_find(&q->many, &q->R, &q->many_R, &fits);
    if (s == RG_OK && !fits) {
        const rg_rows *lists[] = {&q->J, &q->E, &q->R};
        rg_slots *slots[] = {&q->many_J, &q->many_E, &q->many_R};
        s = rg_normal_analyse(&q->many, lists, 3);
        for (int i = 0; i < 3 && s == RG_OK; i++) {
            slots[i]->used = 0, slots[i]->rows = 0;
            s = rg_normal_find(&q->many, lists[i], slots[i], &fits);
        }
        q->work += numbers(&q->many, &q->many_R);
        q->many_laid = 0;
    }
    if (s == RG_OK)
        s = RG_MEM_GROW(&q->mem, q->many_base, q->many_base_room, rg_normal_numbers(&q->many));
    q->work += LAYING * (double)q->many_R.used;
    if (s == RG_OK && !q->many_laid) lay(q, &q->many, &q->many_J, &q->many_E, q->many_base);
    q->many_laid = s == RG_OK;
    return s;
}

static int set_matrix(problem *p)
{
    rg_interior *q = p->q;
    weigh(p);
    if (p->by_rows) {
        for (int32_t j = 0; j < p->m; j++) {
            const size_t diagonal = (size_t)j * p->wide + (size_t)j;
            memcpy(q->L + diagonal, q->M + diagonal, (size_t)(p->m - j) * sizeof *q->L);
            q->L[diagonal] += 1 / q->inverse[j];
        }
        q->work += (double)p->m * p->m * p->m / 6;
        return rg_dense_factor(p->m, q->L, p->wide, q->update);
    }
    return factor(q, &q->many, q->many_base, q->weight);
}

/* Newton's step for
 *     G v - E^T y - R^T x = 0,   E v = 0,   R v + C x - d - slack = 0,   x slack = target
 * off, Ev, residual are what the first three are off, `both` the last over x. By rows v is taken to be Z x all the
 * time. */
static void newton(problem *p)
{
    rg_interior *q = p->q;
    const int32_t m = p->m;
    for (int32_t i = 0; i < m; i++) q->dx[i] = -q->residual[i] + q->both[i];
    if (p->by_rows) {
        rg_dense_solve(m, q->L, p->wide, q->dx);
    } else {
        for (int32_t j = 0; j < q->n; j++) q->dv[j] = -q->off[j];
        for (int32_t i = 0; i < q->E.count; i++) rg_rows_gather(&q->E, i, -q->Ev[i] / EPS, q->dv);
        for (int32_t i = 0; i < m; i++) q->dslack[i] = q->dx[i] * q->inverse[i];
        spread(p, q->dslack, q->dv);
        rg_supernodal_solve(&q->many.L, q->dv);
        for (int32_t i = 0; i < q->E.count; i++) q->dy[i] = -(q->Ev[i] + rg_rows_dot(&q->E, i, q->dv)) / EPS;
        measure(p, q->dv);
        for (int32_t i = 0; i < m; i++) q->dx[i] = (q->dx[i] - q->sum[q->of[i]]) * q->inverse[i];
        q->work += 2 * q->many.L.S.entries + LAYING * (double)q->R.start[q->R.count];
    }
    for (int32_t i = 0; i < m; i++) q->dslack[i] = q->both[i] - (1 / q->inverse[i] - q->c[i]) * q->dx[i];
}

/* -------------------------------------------------------------------------------------------------- iterations ---- */

/* v of x, by rows. */
static void gather(problem *p)
{
    rg_interior *q = p->q;
    memset(q->v, 0, (size_t)q->n * sizeof *q->v);
    for (int32_t k = 0; k < p->m; k++) {
        const double *z = column(q, q->of[k]), of = q->x[k];
        for (int32_t j = 0; j < q->n; j++) q->v[j] += of * z[j];
    }
}

/* off, Ev, residual. Returns the largest that a row, or E, misses. */
static double miss(problem *p)
{
    rg_interior *q = p->q;
    double most = 0;
    if (p->by_rows) gather(p);
    else {
        saddle(q, q->v, q->y);
        for (int32_t i = 0; i < p->m; i++) q->residual[i] = -q->x[i];
        spread(p, q->residual, q->off);
        for (int32_t i = 0; i < q->E.count; i++) most = fmax(most, fabs(q->Ev[i]));
    }
    measure(p, q->v);
    for (int32_t i = 0; i < p->m; i++) {
        q->residual[i] = q->sum[q->of[i]] + q->c[i] * q->x[i] - q->d[i] - q->slack[i];
        most = fmax(most, fabs(q->residual[i]));
    }
    return most;
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
        if (-step * dx[i] > part * x[i]) step = -part * x[i] / dx[i];
    return step;
}

static void go(problem *p, double step)
{
    rg_interior *q = p->q;
    for (int32_t i = 0; i < p->m; i++) {
        q->x[i] += step * q->dx[i];
        q->slack[i] += step * q->dslack[i];
    }
    if (p->by_rows) return;
    for (int32_t j = 0; j < q->n; j++) q->v[j] += step * q->dv[j];
    for (int32_t i = 0; i < q->E.count; i++) q->y[i] += step * q->dy[i];
}

static double step_to(const rg_interior *q, int32_t m, double part)
{
    return fmin(farthest(m, q->x, q->dx, part), farthest(m, q->slack, q->dslack, part));
}

/* One more solution with the same matrix, that takes products back to the centre which a longer step would bring far
 * from it (Gondzio, Multiple centrality corrections in a primal-dual method, 1996). */
static void correct(problem *p, double centre)
{
    rg_interior *q = p->q;
    const double had = step_to(q, p->m, 1), aim = fmin(1, LONGER * had + LONGER_BY);
    const double low = centre / OFF_CENTRE, high = centre * OFF_CENTRE;
    memcpy(q->before, q->both, (size_t)p->m * sizeof *q->both);
    for (int32_t i = 0; i < p->m; i++) {
        const double product = (q->x[i] + aim * q->dx[i]) * (q->slack[i] + aim * q->dslack[i]);
        const double more = product < low ? low - product : product > high ? fmax(high - product, -high) : 0;
        q->both[i] += more / q->x[i];
    }
    newton(p);
    if (step_to(q, p->m, 1) >= had) return;
    memcpy(q->both, q->before, (size_t)p->m * sizeof *q->both); /* it was none */
    newton(p);
}

static void begin(problem *p, double scale)
{
    rg_interior *q = p->q;
    const int32_t m = p->m;
    for (int32_t i = 0; i < m; i++) q->x[i] = fmax(BEGIN * scale, BEGIN_LAST * q->largest), q->slack[i] = 0;
    miss(p);
    for (int32_t i = 0; i < m; i++) q->slack[i] = fmax(q->residual[i], BEGIN_SLACK * scale);
}

static void iterate(problem *p, double scale)
{
    rg_interior *q = p->q;
    const int32_t m = p->m;
    begin(p, scale);
    for (; q->iterations < ITERATIONS; q->iterations++) {
        const double most = miss(p), mu = dot(m, q->x, q->slack) / m;
        if (mu < COMPLEMENTARY * scale * scale && most < KEPT * scale) break;
        if ((q->most_work > 0 && q->work > q->most_work) || (q->stop && q->stop(q->ctx, 0)) || !set_matrix(p)) break;
        for (int32_t i = 0; i < m; i++) q->both[i] = -q->slack[i];
        newton(p); /* predictor */
        const double a = step_to(q, m, 1);
        double after = 0;
        for (int32_t i = 0; i < m; i++) after += (q->x[i] + a * q->dx[i]) * (q->slack[i] + a * q->dslack[i]);
        const double less = after / m / mu, centre = less * less * less * mu;
        for (int32_t i = 0; i < m; i++) q->both[i] = (centre - q->dx[i] * q->dslack[i]) / q->x[i] - q->slack[i];
        newton(p); /* corrector */
        correct(p, centre);
        go(p, step_to(q, m, SHORT_OF_BOUND));
    }
    q->largest = 0;
    for (int32_t i = 0; i < m; i++) q->largest = fmax(q->largest, q->x[i]);
    if (p->by_rows) gather(p);
}

static rg_status set_places(rg_interior *q)
{
    rg_status s = RG_MEM_GROW(&q->mem, q->at, q->at_room, (size_t)q->R.count);
    if (s == RG_OK) s = RG_MEM_GROW(&q->mem, q->weight, q->weight_room, (size_t)q->R.count);
    if (s == RG_OK) s = RG_MEM_GROW(&q->mem, q->sum, q->sum_room, (size_t)q->R.count);
    if (s != RG_OK) return s;
    for (; q->known < q->R.count; q->known++) q->at[q->known] = -1;
    return RG_OK;
}

rg_status rg_interior_solve(rg_interior *q, int32_t m)
{
    problem p = {q, m, rg_dense_room(m), 0};
    double scale = 0;
    for (int32_t i = 0; i < m; i++) scale = fmax(scale, q->d[i]);
    q->iterations = 0;
    memset(q->x, 0, (size_t)m * sizeof *q->x);
    memset(q->v, 0, (size_t)q->n * sizeof *q->v);
    if (!(scale > 0)) return RG_OK;
    rg_status s = lay_few(q);
    if (s != RG_OK) return s;
    s = set_places(q);
    if (s != RG_OK) return s;
    double new_rows = 0;
    for (int32_t i = 0; i < m; i++) new_rows += q->at[q->of[i]] < 0;
    const double by_rows = 4 * new_rows * q->few.L.S.entries + RECKONED * m * (double)m * m / 6;
    p.by_rows = by_rows < RECKONED * numbers(&q->few, &NONE);
    s = p.by_rows ? set_rows(&p) : set_ways(q);
    if (s != RG_OK) return s;
    memset(q->y, 0, (size_t)q->E.count * sizeof *q->y);
    iterate(&p, scale);
    return RG_OK;
}
