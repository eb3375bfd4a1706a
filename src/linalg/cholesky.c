#include "linalg/cholesky.h"

#include <string.h>

#ifdef RG_GPL
#include <cholmod.h>

/* The rows of B have length 1. Rounding along what the sheet can do is amplified by 1 / beta, so beta is far above it;
 * modes that are slower than beta cost the iteration a step each, so it is below all but a few: the slowest mode of a
 * sheet of n x n vertices is about n^-4. */
static const double BETA = 1e-9;
/* Where a pivot fails all the same. */
static const double BETA_GROWTH = 100, BETA_LARGEST = 1e-2;
/* METIS takes as long as several factorisations of a small sheet, and pays on a large one. */
static const double METIS_FROM = 3e8;
/* A vertex of that many creases makes so large a clique of columns that both shapes are tried. */
static const int32_t HIGH_DEGREE = 10;

typedef struct state {
    cholmod_common common;
    cholmod_sparse *A; /* one triangle of the matrix, in the order of the factor */
    cholmod_factor *L;
    cholmod_dense *b, *z, *work[2];
} state;

int rg_cholesky_built(void) { return 1; }

/* Calls visit(ctx, row, column) for each product of two numbers of B that is added to the matrix, in the order of
 * add_products below: the lower triangle, in the order of B. */
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

static void visit_all(const rg_cholesky *L, const rg_sparse *B, visitor *visit, void *ctx)
{
    if (L->shape == RG_SHAPE_COLUMNS) visit_columns(B, visit, ctx);
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

/* Collects the places (i, j) of the products, by columns. */
typedef struct places {
    const int32_t *order; /* NULL: as they come */
    int upper;            /* row <= column, else row >= column */
    int32_t n, *count, *start, *row, *to;
    int64_t products, at;
} places;

static void place(const places *p, int32_t *i, int32_t *j)
{
    if (p->order) *i = p->order[*i], *j = p->order[*j];
    if (p->upper ? *i > *j : *i < *j) {
        int32_t swap = *i;
        *i = *j, *j = swap;
    }
}

static void count_one(void *ctx, int32_t i, int32_t j)
{
    places *p = ctx;
    place(p, &i, &j);
    p->count[j]++;
    p->products++;
}

static void enter_one(void *ctx, int32_t i, int32_t j)
{
    places *p = ctx;
    place(p, &i, &j);
    p->row[p->start[j] + p->count[j]++] = i;
}

/* Columns are short: a look through the rows is as quick as anything. */
static void find_one(void *ctx, int32_t i, int32_t j)
{
    places *p = ctx;
    place(p, &i, &j);
    int32_t at = p->start[j];
    while (p->row[at] != i) at++;
    p->to[p->at++] = at;
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

/* The pattern of the matrix as CHOLMOD has it, and with `to` the way of each product into it. */
static cholmod_sparse *pattern(rg_cholesky *L, const rg_sparse *B, const int32_t *order, int upper, int32_t **to)
{
    state *k = L->state;
    places p = {.order = order, .upper = upper, .n = L->n};
    cholmod_sparse *A = NULL;
    p.count = rg_mem_array(&L->mem, (size_t)L->n, sizeof *p.count);
    p.start = rg_mem_array(&L->mem, (size_t)L->n + 1, sizeof *p.start);
    if (!p.count || !p.start) goto out;
    visit_all(L, B, count_one, &p);
    for (int32_t j = 0; j < L->n; j++) p.start[j + 1] = p.start[j] + p.count[j] + 1;
    p.row = rg_mem_array(&L->mem, (size_t)p.start[L->n], sizeof *p.row);
    if (!p.row) goto out;
    for (int32_t j = 0; j < L->n; j++) { /* the diagonal, also of a crease at no vertex */
        p.row[p.start[j]] = j;
        p.count[j] = 1;
    }
    visit_all(L, B, enter_one, &p);
    int32_t at = 0;
    for (int32_t j = 0; j < L->n; j++) {
        int32_t n = sort_unique(p.row + p.start[j], p.count[j]);
        memmove(p.row + at, p.row + p.start[j], (size_t)n * sizeof *p.row);
        p.start[j] = at;
        at += n;
    }
    p.start[L->n] = at;
    A = cholmod_allocate_sparse((size_t)L->n, (size_t)L->n, (size_t)at, 1, 1, upper ? 1 : -1, CHOLMOD_REAL, &k->common);
    if (!A) goto out;
    memcpy(A->p, p.start, ((size_t)L->n + 1) * sizeof *p.start);
    memcpy(A->i, p.row, (size_t)at * sizeof *p.row);
    memset(A->x, 0, (size_t)at * sizeof(double));
    if (to) {
        p.to = *to = rg_mem_array(&L->mem, (size_t)p.products, sizeof *p.to);
        if (p.to) visit_all(L, B, find_one, &p);
        else cholmod_free_sparse(&A, &k->common);
    }
out:
    rg_mem_free(&L->mem, p.count);
    rg_mem_free(&L->mem, p.start);
    rg_mem_free(&L->mem, p.row);
    return A;
}

static cholmod_factor *analyze(state *k, cholmod_sparse *A, int ordering)
{
    k->common.nmethods = 1;
    k->common.method[0].ordering = ordering;
    k->common.postorder = ordering != CHOLMOD_NATURAL;
    return cholmod_analyze(A, &k->common);
}

/* The order by AMD, or METIS where that leaves less to do. */
static rg_status find_order(rg_cholesky *L, const rg_sparse *B)
{
    state *k = L->state;
    rg_status s = RG_ENOMEM;
    cholmod_factor *metis = NULL, *amd = NULL, *best;
    cholmod_sparse *A = pattern(L, B, NULL, 1, NULL);
    if (!A || !(amd = analyze(k, A, CHOLMOD_AMD))) goto out;
    best = amd;
    L->flops = k->common.fl;
    L->entries = k->common.lnz;
    if (L->flops > METIS_FROM && (metis = analyze(k, A, CHOLMOD_METIS)) != NULL && k->common.fl < L->flops) {
        best = metis;
        L->flops = k->common.fl;
        L->entries = k->common.lnz;
    }
    const int *perm = best->Perm;
    for (int32_t j = 0; j < L->n; j++) L->order[perm[j]] = j;
    s = RG_OK;
out:
    cholmod_free_sparse(&A, &k->common);
    cholmod_free_factor(&amd, &k->common);
    cholmod_free_factor(&metis, &k->common);
    return s;
}

static rg_status init_shape(rg_cholesky *L, const rg_memory *mem, const rg_sparse *B, rg_shape shape)
{
    memset(L, 0, sizeof *L);
    L->mem = *mem;
    L->shape = shape;
    L->n = shape == RG_SHAPE_ROWS ? 3 * B->M : B->N;
    if (B->M == 0) return RG_OK;
    state *k = L->state = rg_mem_array(mem, 1, sizeof *k);
    if (!k) return RG_ENOMEM;
    cholmod_start(&k->common);
    k->common.print = 0;
    L->order = rg_mem_array(mem, (size_t)L->n, sizeof *L->order);
    L->x = rg_mem_array(mem, (size_t)L->n, sizeof *L->x);
    L->B = *B;
    L->B.x = rg_mem_array(mem, (size_t)B->start[B->M], sizeof *B->x);
    k->b = cholmod_allocate_dense((size_t)L->n, 1, (size_t)L->n, CHOLMOD_REAL, &k->common);
    rg_status s = L->order && L->x && L->B.x && k->b ? find_order(L, B) : RG_ENOMEM;
    if (s != RG_OK) rg_cholesky_free(L);
    return s;
}

/* The numbers are entered in the order of the factor, so that CHOLMOD has nothing to move: it wants the upper triangle
 * for its simplicial, the lower one for its supernodal factorisation. */
static rg_status finish_init(rg_cholesky *L, const rg_sparse *B)
{
    state *k = L->state;
    if (!k) return RG_OK;
    int supernodal = L->flops >= k->common.supernodal_switch * L->entries;
    k->common.supernodal = supernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    k->A = pattern(L, B, L->order, !supernodal, &L->to);
    k->L = k->A ? analyze(k, k->A, CHOLMOD_NATURAL) : NULL;
    if (k->L) return RG_OK;
    rg_cholesky_free(L);
    return RG_ENOMEM;
}

static int32_t largest_degree(const rg_sparse *B)
{
    int32_t most = 0;
    for (int32_t k = 0; k < B->M; k++)
        if (B->start[k + 1] - B->start[k] > most) most = B->start[k + 1] - B->start[k];
    return most;
}

rg_status rg_cholesky_init(rg_cholesky *L, const rg_memory *mem, const rg_sparse *B, rg_shape shape)
{
    rg_cholesky rows;
    rg_status s = init_shape(L, mem, B, shape == RG_SHAPE_ROWS ? shape : RG_SHAPE_COLUMNS);
    if (s != RG_OK) return s;
    if (shape == RG_SHAPE_AUTO && largest_degree(B) >= HIGH_DEGREE) {
        s = init_shape(&rows, mem, B, RG_SHAPE_ROWS);
        if (s != RG_OK) {
            rg_cholesky_free(L);
            return s;
        }
        rg_cholesky dearer = rows.flops < L->flops ? *L : rows;
        if (rows.flops < L->flops) *L = rows;
        rg_cholesky_free(&dearer);
    }
    return finish_init(L, B);
}

void rg_cholesky_free(rg_cholesky *L)
{
    if (!L->mem.resize) return;
    state *k = L->state;
    rg_mem_free(&L->mem, L->order);
    rg_mem_free(&L->mem, L->to);
    rg_mem_free(&L->mem, L->x);
    rg_mem_free(&L->mem, L->B.x);
    if (k) {
        cholmod_free_sparse(&k->A, &k->common);
        cholmod_free_factor(&k->L, &k->common);
        cholmod_free_dense(&k->b, &k->common);
        cholmod_free_dense(&k->z, &k->common);
        cholmod_free_dense(&k->work[0], &k->common);
        cholmod_free_dense(&k->work[1], &k->common);
        cholmod_finish(&k->common);
        rg_mem_free(&L->mem, k);
    }
    memset(L, 0, sizeof *L);
}

rg_status rg_cholesky_update(rg_cholesky *L, const rg_sparse *B)
{
    state *k = L->state;
    if (!k) return RG_OK;
    memcpy(L->B.x, B->x, (size_t)B->start[B->M] * sizeof *B->x);
    memset(k->A->x, 0, k->A->nzmax * sizeof(double));
    if (L->shape == RG_SHAPE_COLUMNS) add_columns(B, L->to, k->A->x);
    else add_rows(B, L->to, k->A->x);
    for (double beta = BETA; beta <= BETA_LARGEST; beta *= BETA_GROWTH) {
        double shift[2] = {beta, 0};
        L->factorizations++;
        if (!cholmod_factorize_p(k->A, shift, NULL, 0, k->L, &k->common)) return RG_ENOMEM;
        L->beta = beta;
        if (k->L->minor == k->L->n) return RG_OK;
    }
    return RG_OK; /* NaN in B: whoever solves with it sees NaN come out */
}

/* b <- (matrix + beta I) \ b */
static void solve(rg_cholesky *L, double *b)
{
    state *k = L->state;
    double *x = k->b->x;
    for (int32_t j = 0; j < L->n; j++) x[L->order[j]] = b[j];
    L->triangular++;
    if (!cholmod_solve2(CHOLMOD_A, k->L, k->b, NULL, &k->z, NULL, &k->work[0], &k->work[1], &k->common)) return;
    x = k->z->x;
    for (int32_t j = 0; j < L->n; j++) b[j] = x[L->order[j]];
}

#else

int rg_cholesky_built(void) { return 0; }
rg_status rg_cholesky_init(rg_cholesky *L, const rg_memory *mem, const rg_sparse *B, rg_shape shape)
{
    (void)mem, (void)B, (void)shape;
    memset(L, 0, sizeof *L);
    return RG_EABSENT;
}
void rg_cholesky_free(rg_cholesky *L) { (void)L; }
rg_status rg_cholesky_update(rg_cholesky *L, const rg_sparse *B)
{
    (void)L, (void)B;
    return RG_EABSENT;
}
static void solve(rg_cholesky *L, double *b) { (void)L, (void)b; }

#endif

void rg_cholesky_apply(rg_cholesky *L, const double *r, double *y)
{
    const int32_t m = 3 * L->B.M;
    if (!L->state) return;
    if (L->shape == RG_SHAPE_ROWS) {
        memmove(y, r, (size_t)m * sizeof *r);
        solve(L, y);
        return;
    }
    rg_sparse_mul_t(&L->B, r, L->x);
    solve(L, L->x);
    for (int32_t k = 0; k < L->B.M; k++) {
        rg_vec3 sum = rg_sparse_mul_row(&L->B, k, L->x);
        y[3 * k] = (r[3 * k] - sum.x) / L->beta;
        y[3 * k + 1] = (r[3 * k + 1] - sum.y) / L->beta;
        y[3 * k + 2] = (r[3 * k + 2] - sum.z) / L->beta;
    }
}
