#include "linalg/cholesky.h"

#include <string.h>

/* The rows of B have length 1. Rounding is amplified by 1 / beta, so beta is far above it; modes that are slower than
 * beta cost the iteration a step each, so it is below all but a few: the slowest mode of a sheet of n x n vertices is
 * about n^-4. */
static const double BETA = 1e-10;
/* Where a pivot fails all the same. */
static const double BETA_GROWTH = 100, BETA_LARGEST = 1e-2;
/* A vertex of that many creases makes so large a clique of columns that both shapes are tried. */
static const int32_t HIGH_DEGREE = 10;

/* Calls visit(ctx, i, j) for each product of two numbers of B that is added to the matrix at (i, j), in the order in
 * which add_columns and add_rows add them. */
typedef void visitor(void *ctx, int32_t i, int32_t j);

static void visit_columns(const rg_sparse *B, visitor *visit, void *ctx)
{
    for (int32_t k = 0; k < B->M; k++)
        for (int32_t p = B->start[k]; p < B->start[k + 1]; p++)
            for (int32_t q = B->start[k]; q <= p; q++) visit(ctx, B->col[p], B->col[q]);
}

static void visit_rows(const rg_sparse *B, visitor *visit, void *ctx)
{
    for (int32_t k = 0; k < B->M; k++)
        for (int32_t a = 0; a < 3; a++)
            for (int32_t b = 0; b <= a; b++) visit(ctx, 3 * k + a, 3 * k + b);
    for (int32_t i = 0; i < B->N; i++) {
        if (B->slot[i][0] < 0 || B->slot[i][1] < 0) continue;
        int32_t k = B->row[B->slot[i][0]], l = B->row[B->slot[i][1]];
        for (int32_t a = 0; a < 3; a++)
            for (int32_t b = 0; b < 3; b++) visit(ctx, 3 * k + a, 3 * l + b);
    }
}

static void visit_all(rg_shape shape, const rg_sparse *B, visitor *visit, void *ctx)
{
    if (shape == RG_SHAPE_COLUMNS) visit_columns(B, visit, ctx);
    else visit_rows(B, visit, ctx);
}

static void add_columns(const rg_sparse *B, const int32_t *to, double *x)
{
    for (int32_t k = 0; k < B->M; k++) {
        const rg_vec3 *v = B->x + B->start[k];
        for (int32_t p = 0, d = B->start[k + 1] - B->start[k]; p < d; p++)
            for (int32_t q = 0; q <= p; q++) x[*to++] += rg_vec3_dot(v[p], v[q]);
    }
}

static void add_rows(const rg_sparse *B, const int32_t *to, double *x)
{
    for (int32_t k = 0; k < B->M; k++, to += 6)
        for (int32_t j = B->start[k]; j < B->start[k + 1]; j++) {
            rg_vec3 v = B->x[j];
            x[to[0]] += v.x * v.x;
            x[to[1]] += v.y * v.x, x[to[2]] += v.y * v.y;
            x[to[3]] += v.z * v.x, x[to[4]] += v.z * v.y, x[to[5]] += v.z * v.z;
        }
    for (int32_t i = 0; i < B->N; i++) {
        if (B->slot[i][0] < 0 || B->slot[i][1] < 0) continue;
        rg_vec3 v = B->x[B->slot[i][0]], w = B->x[B->slot[i][1]];
        x[to[0]] += v.x * w.x, x[to[1]] += v.x * w.y, x[to[2]] += v.x * w.z;
        x[to[3]] += v.y * w.x, x[to[4]] += v.y * w.y, x[to[5]] += v.y * w.z;
        x[to[6]] += v.z * w.x, x[to[7]] += v.z * w.y, x[to[8]] += v.z * w.z;
        to += 9;
    }
}

/* The products, listed by columns of the lower triangle, and where they go. */
typedef struct products {
    int32_t count, *start, *row; /* [n + 1] */
    const rg_supernodal *L;
    int32_t *to;
} products;

static void count_one(void *ctx, int32_t i, int32_t j)
{
    products *p = ctx;
    p->start[(i > j ? i : j) + 1]++;
    p->count++;
}

static void enter_one(void *ctx, int32_t i, int32_t j)
{
    products *p = ctx;
    p->row[p->start[i > j ? i : j]++] = i > j ? j : i;
}

static void find_one(void *ctx, int32_t i, int32_t j)
{
    products *p = ctx;
    *p->to++ = rg_supernodal_slot(p->L, i, j);
}

static int32_t sort_unique(int32_t *row, int32_t n)
{
    int32_t kept = 0;
    for (int32_t a = 0; a < n; a++) {
        int32_t i = row[a], b = kept;
        while (b > 0 && row[b - 1] > i) b--;
        if (b > 0 && row[b - 1] == i) continue;
        memmove(row + b + 1, row + b, (size_t)(kept - b) * sizeof *row);
        row[b] = i;
        kept++;
    }
    return kept;
}

static rg_status init_shape(rg_cholesky *P, const rg_memory *mem, const rg_sparse *B, rg_shape shape)
{
    const int32_t n = shape == RG_SHAPE_ROWS ? 3 * B->M : B->N;
    memset(P, 0, sizeof *P);
    P->mem = *mem;
    P->shape = shape;
    products p = {.start = rg_mem_array(mem, (size_t)n + 2, sizeof *p.start)};
    rg_status s = RG_ENOMEM;
    if (!p.start) return s;
    for (int32_t j = 0; j < n; j++) count_one(&p, j, j); /* the diagonal, also of a crease at no vertex */
    visit_all(shape, B, count_one, &p);
    for (int32_t j = 0; j < n; j++) p.start[j + 1] += p.start[j];
    p.row = rg_mem_array(mem, (size_t)p.count, sizeof *p.row);
    if (p.row) {
        for (int32_t j = 0; j < n; j++) enter_one(&p, j, j);
        visit_all(shape, B, enter_one, &p); /* start[j] is now where j + 1 starts */
        int32_t at = 0, from = 0;
        for (int32_t j = 0; j < n; j++) {
            int32_t kept = sort_unique(p.row + from, p.start[j] - from);
            memmove(p.row + at, p.row + from, (size_t)kept * sizeof *p.row);
            from = p.start[j];
            p.start[j] = at;
            at += kept;
        }
        p.start[n] = at;
        s = rg_supernodal_init(&P->L, mem, n, p.start, p.row);
    }
    RG_MEM_FREE(mem, p.start, p.row);
    return s;
}

static void count_only(void *ctx, int32_t i, int32_t j)
{
    (void)i, (void)j;
    ++*(int32_t *)ctx;
}

static rg_status finish_init(rg_cholesky *P, const rg_sparse *B)
{
    int32_t count = 0;
    visit_all(P->shape, B, count_only, &count);
    P->B = *B;
    const rg_status s = RG_MEM_ARRAYS(&P->mem, RG_ARRAY(P->to, (size_t)count), RG_ARRAY(P->x, (size_t)B->N),
                                      RG_ARRAY(P->B.x, (size_t)B->start[B->M]));
    if (s == RG_OK) visit_all(P->shape, B, find_one, &(products){.L = &P->L, .to = P->to});
    return s;
}

static int32_t largest_degree(const rg_sparse *B)
{
    int32_t most = 0;
    for (int32_t k = 0; k < B->M; k++)
        if (B->start[k + 1] - B->start[k] > most) most = B->start[k + 1] - B->start[k];
    return most;
}

rg_status rg_cholesky_init(rg_cholesky *P, const rg_memory *mem, const rg_sparse *B, rg_shape shape)
{
    rg_status s = init_shape(P, mem, B, shape == RG_SHAPE_ROWS ? shape : RG_SHAPE_COLUMNS);
    if (s == RG_OK && shape == RG_SHAPE_AUTO && largest_degree(B) >= HIGH_DEGREE) {
        rg_cholesky rows;
        s = init_shape(&rows, mem, B, RG_SHAPE_ROWS);
        int better = s == RG_OK && rows.L.S.flops < P->L.S.flops;
        rg_cholesky dearer = better ? *P : rows;
        if (better) *P = rows;
        rg_cholesky_free(&dearer);
    }
    if (s == RG_OK) s = finish_init(P, B);
    if (s != RG_OK) rg_cholesky_free(P);
    return s;
}

void rg_cholesky_free(rg_cholesky *P)
{
    if (!P->mem.resize) return;
    rg_supernodal_free(&P->L);
    RG_MEM_FREE(&P->mem, P->to, P->x, P->B.x);
    memset(P, 0, sizeof *P);
}

void rg_cholesky_update(rg_cholesky *P, const rg_sparse *B)
{
    memcpy(P->B.x, B->x, (size_t)B->start[B->M] * sizeof *B->x);
    for (P->beta = BETA;; P->beta *= BETA_GROWTH) {
        rg_supernodal_clear(&P->L);
        if (P->shape == RG_SHAPE_COLUMNS) add_columns(B, P->to, P->L.x);
        else add_rows(B, P->to, P->L.x);
        P->factorizations++;
        if (rg_supernodal_factor(&P->L, P->beta)) return;
        if (P->beta >= BETA_LARGEST) return; /* NaN in B: whoever solves with it sees NaN come out */
    }
}

void rg_cholesky_apply(rg_cholesky *P, const double *r, double *y)
{
    const int32_t M = P->B.M;
    P->triangular++;
    if (P->shape == RG_SHAPE_ROWS) {
        memmove(y, r, 3 * (size_t)M * sizeof *r);
        rg_supernodal_solve(&P->L, y);
        return;
    }
    rg_sparse_mul_t(&P->B, r, P->x);
    rg_supernodal_solve(&P->L, P->x);
    for (int32_t k = 0; k < M; k++) {
        rg_vec3 sum = rg_sparse_mul_row(&P->B, k, P->x);
        y[3 * k] = (r[3 * k] - sum.x) / P->beta;
        y[3 * k + 1] = (r[3 * k + 1] - sum.y) / P->beta;
        y[3 * k + 2] = (r[3 * k + 2] - sum.z) / P->beta;
    }
}

void rg_cholesky_solve(rg_cholesky *P, double *x)
{
    P->triangular++;
    rg_supernodal_solve(&P->L, x);
}
