#include "linalg/least.h"
#include "base/lanes.h"

#include <math.h>
#include <string.h>

/* Rounding in a factor of norm 2 or so is some 1e-15 and must not make a pivot negative; slow modes are far above. */
static const double BETA = 1e-11;
/* Where a pivot fails all the same, beta grows by the first and the factorisation is repeated, up to the second. */
static const double BETA_GROWTH = 100, BETA_LARGEST = 1;
/* A factor is right but for its beta: it needs two or three iterations. */
static const int32_t MOST_ITERATIONS = 6;
/* Curvature over what the preconditioner makes of the residual is lambda / (lambda + beta) along a mode of A A^T: below
 * this it is rounding in modes that no column can turn, and a step along it would be nothing but noise. */
static const double OUT_OF_REACH = 0.1;
/* Each leaves some 1e-5 of what is out of reach, rounding over beta. */
static const int PASSES = 2;
/* Part of b, in the metric of the preconditioner, that is not chased further unless another is asked for. */
static const double TOLERANCE = 1e-12;

/* The pattern of A A^T by columns, from that of A by rows. */
static rg_status square(const rg_least *A, int32_t *start, int32_t **rows)
{
    const size_t m = (size_t)A->rows, entries = (size_t)A->start[A->columns];
    int32_t *first, *column, *seen, *row = NULL;
    size_t room = 0, at = 0;
    rg_status s = RG_MEM_ARRAYS(&A->mem, RG_ARRAY(first, m + 2), RG_ARRAY(column, entries), RG_ARRAY(seen, m));
    if (s == RG_OK) {
        for (size_t j = 0; j < entries; j++) first[A->row[j] + 2]++;
        for (size_t i = 2; i <= m; i++) first[i] += first[i - 1];
        for (int32_t c = 0; c < A->columns; c++)
            for (int32_t j = A->start[c]; j < A->start[c + 1]; j++) column[first[A->row[j] + 1]++] = c;
    }
    for (int32_t i = 0; s == RG_OK && i < A->rows; i++) {
        start[i] = (int32_t)at;
        for (int32_t k = first[i]; s == RG_OK && k < first[i + 1]; k++)
            for (int32_t j = A->start[column[k]]; s == RG_OK && j < A->start[column[k] + 1]; j++) {
                if (seen[A->row[j]] == i + 1) continue;
                seen[A->row[j]] = i + 1;
                s = at < INT32_MAX ? RG_MEM_GROW(&A->mem, row, room, at + 2) : RG_ENOMEM;
                if (s == RG_OK) row[at++] = A->row[j];
            }
        if (s == RG_OK && seen[i] != i + 1) { /* a row without entries still has its place on the diagonal */
            s = RG_MEM_GROW(&A->mem, row, room, at + 2);
            if (s == RG_OK) row[at++] = i;
        }
    }
    start[A->rows] = (int32_t)at;
    RG_MEM_FREE(&A->mem, first, column, seen);
    *rows = row;
    return s;
}

static rg_status plan(rg_least *A)
{
    int32_t *start = rg_mem_array(&A->mem, (size_t)A->rows + 1, sizeof *start), *row = NULL;
    size_t products = 0, at = 0;
    for (int32_t c = 0; c < A->columns; c++) {
        const size_t n = (size_t)(A->start[c + 1] - A->start[c]);
        products += n * (n + 1) / 2;
    }
    A->to = rg_mem_array(&A->mem, products, sizeof *A->to);
    rg_status s = start && A->to ? square(A, start, &row) : RG_ENOMEM;
    if (s == RG_OK && A->rows > 0) s = rg_supernodal_init(&A->L, &A->mem, A->rows, start, row);
    for (int32_t c = 0; s == RG_OK && c < A->columns; c++)
        for (int32_t i = A->start[c]; i < A->start[c + 1]; i++)
            for (int32_t j = A->start[c]; j <= i; j++) A->to[at++] = rg_supernodal_slot(&A->L, A->row[i], A->row[j]);
    RG_MEM_FREE(&A->mem, start, row);
    return s;
}

rg_status rg_least_init(rg_least *A, const rg_memory *mem, int32_t rows, int32_t columns, const int32_t *start,
                       const int32_t *row)
{
    memset(A, 0, sizeof *A);
    A->mem = *mem;
    A->tolerance = TOLERANCE;
    A->rows = rows;
    A->columns = columns;
    const size_t m = (size_t)rows, n = (size_t)columns, entries = (size_t)start[columns];
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(A->start, n + 1), RG_ARRAY(A->row, entries), RG_ARRAY(A->x, entries),
                                RG_ARRAY(A->t, n), RG_ARRAY(A->y, m), RG_ARRAY(A->r, m), RG_ARRAY(A->z, m),
                                RG_ARRAY(A->p, m), RG_ARRAY(A->q, m));
    if (s == RG_OK) {
        memcpy(A->start, start, (n + 1) * sizeof *start);
        memcpy(A->row, row, entries * sizeof *row);
        s = plan(A);
    }
    if (s != RG_OK) rg_least_free(A);
    return s;
}

void rg_least_free(rg_least *A)
{
    if (!A->mem.resize) return;
    const rg_memory mem = A->mem;
    rg_supernodal_free(&A->L);
    RG_MEM_FREE(&mem, A->to, A->start, A->row, A->x, A->y, A->r, A->z, A->p, A->q, A->t);
    memset(A, 0, sizeof *A);
}

void rg_least_renew(rg_least *A)
{
    if (A->rows == 0) return;
    for (A->beta = fmax(BETA, A->damping); A->beta <= BETA_LARGEST; A->beta *= BETA_GROWTH) {
        const int32_t *to = A->to;
        rg_supernodal_clear(&A->L);
        for (int32_t c = 0; c < A->columns; c++)
            for (int32_t i = A->start[c]; i < A->start[c + 1]; i++)
                for (int32_t j = A->start[c]; j <= i; j++) A->L.x[*to++] += A->x[i] * A->x[j];
        A->factorizations++;
        if (rg_supernodal_factor(&A->L, A->beta)) return;
    }
}

void rg_least_mul(const rg_least *A, const double *x, double *y)
{
    memset(y, 0, (size_t)A->rows * sizeof *y);
    for (int32_t i = 0; i < A->columns; i++)
        for (int32_t j = A->start[i]; j < A->start[i + 1]; j++) y[A->row[j]] += A->x[j] * x[i];
}

void rg_least_mul_t(const rg_least *A, const double *y, double *x)
{
    for (int32_t i = 0; i < A->columns; i++) {
        double sum = 0;
        for (int32_t j = A->start[i]; j < A->start[i + 1]; j++) sum += A->x[j] * y[A->row[j]];
        x[i] = sum;
    }
}

static void precondition(rg_least *A, const double *r, double *z)
{
    memcpy(z, r, (size_t)A->rows * sizeof *z);
    if (A->rows > 0) rg_supernodal_solve(&A->L, z);
}

/* Conjugate gradients on A A^T y = b. Zero: what is out of reach outweighs the rest, and y is what it was. */
static int iterate(rg_least *A)
{
    const int32_t m = A->rows;
    double gamma = rg_lanes_dot(m, A->r, A->z);
    const double target = A->tolerance * A->tolerance * gamma;
    for (int32_t n = 0; n < MOST_ITERATIONS && gamma > target; n++) {
        rg_least_mul_t(A, A->p, A->t);
        rg_least_mul(A, A->t, A->q);
        const double curvature = rg_lanes_dot(m, A->p, A->q);
        if (!(curvature > OUT_OF_REACH * gamma)) return n > 0; /* nothing left to move, or NaN */
        const double alpha = gamma / curvature;
        for (int32_t i = 0; i < m; i++) A->y[i] += alpha * A->p[i];
        for (int32_t i = 0; i < m; i++) A->r[i] -= alpha * A->q[i];
        precondition(A, A->r, A->z);
        const double old = gamma;
        gamma = rg_lanes_dot(m, A->r, A->z);
        for (int32_t i = 0; i < m; i++) A->p[i] = A->z[i] + gamma / old * A->p[i];
        A->iterations++;
    }
    return 1;
}

/* What no column reaches is beta z, but for rounding, as (A A^T + beta I) z = r: takes that off r. */
static void leave_out_of_reach(rg_least *A)
{
    for (int pass = 0; pass < PASSES; pass++) {
        for (int32_t i = 0; i < A->rows; i++) A->r[i] -= A->beta * A->z[i];
        precondition(A, A->r, A->z);
    }
    memcpy(A->p, A->z, (size_t)A->rows * sizeof *A->p);
}

void rg_least_solve(rg_least *A, const double *b, double *x)
{
    const int32_t m = A->rows;
    memset(A->y, 0, (size_t)m * sizeof *A->y);
    memcpy(A->r, b, (size_t)m * sizeof *A->r);
    precondition(A, A->r, A->z);
    memcpy(A->p, A->z, (size_t)m * sizeof *A->p);
    if (A->damping > BETA) {
        memcpy(A->y, A->z, (size_t)m * sizeof *A->y);
    } else if (!iterate(A)) {
        leave_out_of_reach(A);
        iterate(A);
    }
    A->solves++;
    rg_least_mul_t(A, A->y, x);
}
