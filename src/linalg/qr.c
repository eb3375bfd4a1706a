#include "linalg/qr.h"
#include "linalg/normal.h"

#include <math.h>
#include <string.h>

typedef struct factor {
    rg_rows A;        /* upright */
    rg_normal R;      /* of the pattern of A^T A, which has room for R: row j of it where column j of L would be */
    int32_t *first;   /* [rows of A] its leading column in the order of elimination */
    int32_t *order;   /* [rows of A] by rising leading columns */
    int32_t *count;   /* [columns + 1] scratch of sorting */
    double *x;        /* [columns] the row that is worked in, in the order of elimination */
} factor;

static void put(rg_rows *A, int32_t *n, int32_t col, double x)
{
    A->col[*n] = col;
    A->x[(*n)++] = x;
}

/* Upright, so that there is less to eliminate: the rows of B where they are more than the creases, else those of B^T. */
static rg_status list_rows(const rg_sparse *B, int upright, const rg_memory *mem, rg_rows *A)
{
    const size_t rows = upright ? 3 * (size_t)B->M : (size_t)B->N, entries = 3 * (size_t)B->start[B->M];
    int32_t n = 0;
    A->mem = *mem;
    A->start = rg_mem_array(mem, rows + 1, sizeof *A->start);
    A->col = rg_mem_array(mem, entries, sizeof *A->col);
    A->x = rg_mem_array(mem, entries, sizeof *A->x);
    if (!A->start || !A->col || !A->x) return RG_ENOMEM;
    for (int32_t row = 0; upright && row < 3 * B->M; row++) {
        for (int32_t b = B->start[row / 3]; b < B->start[row / 3 + 1]; b++) {
            const double v[3] = {B->x[b].x, B->x[b].y, B->x[b].z};
            put(A, &n, B->col[b], v[row % 3]);
        }
        A->start[++A->count] = n;
    }
    for (int32_t i = 0; !upright && i < B->N; i++) {
        for (int e = 0; e < 2; e++) {
            const int32_t b = B->slot[i][e];
            if (b < 0) continue;
            const double v[3] = {B->x[b].x, B->x[b].y, B->x[b].z};
            for (int a = 0; a < 3; a++) put(A, &n, 3 * B->row[b] + a, v[a]);
        }
        A->start[++A->count] = n;
    }
    return RG_OK;
}

/* Rows that begin late meet fewer others. */
static void sort_rows(factor *f, int32_t columns)
{
    const int32_t *place = f->R.L.S.place;
    for (int32_t i = 0; i < f->A.count; i++) {
        f->first[i] = columns;
        for (int32_t e = f->A.start[i]; e < f->A.start[i + 1]; e++)
            if (place[f->A.col[e]] < f->first[i]) f->first[i] = place[f->A.col[e]];
        f->count[f->first[i]]++;
    }
    for (int32_t j = 0, sum = 0; j <= columns; j++) {
        const int32_t n = f->count[j];
        f->count[j] = sum;
        sum += n;
    }
    for (int32_t i = 0; i < f->A.count; i++) f->order[f->count[f->first[i]]++] = i;
}

static rg_status make(factor *f, const rg_memory *mem, const rg_sparse *B)
{
    const int upright = 3 * (int64_t)B->M > B->N;
    const int32_t columns = upright ? B->N : 3 * B->M;
    const rg_rows *const list = &f->A;
    rg_status s = list_rows(B, upright, mem, &f->A);
    if (s == RG_OK) s = rg_normal_init(&f->R, mem, columns);
    if (s == RG_OK) s = rg_normal_analyse(&f->R, &list, 1);
    f->first = rg_mem_array(mem, (size_t)f->A.count, sizeof *f->first);
    f->order = rg_mem_array(mem, (size_t)f->A.count, sizeof *f->order);
    f->count = rg_mem_array(mem, (size_t)columns + 1, sizeof *f->count);
    f->x = rg_mem_array(mem, (size_t)columns, sizeof *f->x);
    if (s == RG_OK && !(f->first && f->order && f->count && f->x)) s = RG_ENOMEM;
    if (s == RG_OK) rg_supernodal_clear(&f->R.L);
    if (s == RG_OK) sort_rows(f, columns);
    return s;
}

/* Where row j of R has its numbers: R[0 ... n - 1] in the columns col[]. */
static double *row_of(factor *f, int32_t j, const int32_t **col, int32_t *n)
{
    const rg_symbolic *S = &f->R.L.S;
    const int32_t s = S->of[j], at = j - S->column[s];
    *n = S->start[s + 1] - S->start[s] - at;
    *col = S->row + S->start[s] + at;
    return f->R.L.x + (size_t)S->panel[s] + (size_t)at * (size_t)rg_symbolic_stride(S, s) + at;
}

/* The row in f->x, whose first column is j, is turned into the rows of R that it meets, up the tree of elimination, until it comes to a
 * place that is empty, which it takes, or to its end. */
static void turn_in(factor *f, int32_t j)
{
    const int32_t *col;
    int32_t n;
    for (; j >= 0; j = n > 1 ? col[1] : -1) {
        double *R = row_of(f, j, &col, &n);
        if (f->x[j] == 0) continue;
        if (R[0] == 0) {
            for (int32_t k = 0; k < n; k++) R[k] = f->x[col[k]], f->x[col[k]] = 0;
            return;
        }
        const double r = hypot(R[0], f->x[j]), c = R[0] / r, d = f->x[j] / r;
        for (int32_t k = 0; k < n; k++) {
            const double a = R[k], b = f->x[col[k]];
            R[k] = c * a + d * b;
            f->x[col[k]] = c * b - d * a;
        }
        f->x[j] = 0;
    }
}

/* Column j of what is left is no longer than `cut` where R's diagonal is not: it counts as zero, and the rest of that row is one as any other.
 * By rising j, so that all that comes to a column has come. */
static int32_t reveal(factor *f, int32_t columns, double cut)
{
    const int32_t *col;
    int32_t n, rank = 0;
    for (int32_t j = 0; j < columns; j++) {
        double *R = row_of(f, j, &col, &n);
        const int counts = fabs(R[0]) > cut;
        rank += counts;
        if (counts || R[0] == 0) continue;
        R[0] = 0;
        for (int32_t k = 1; k < n; k++) f->x[col[k]] = R[k], R[k] = 0;
        turn_in(f, n > 1 ? col[1] : -1);
    }
    return rank;
}

rg_status rg_qr_rank(const rg_sparse *B, double cut, int32_t *rank)
{
    factor f = {0};
    const rg_memory *mem = &B->mem;
    *rank = 0;
    if (B->M == 0 || B->N == 0) return RG_OK;
    const rg_status s = make(&f, mem, B);
    for (int32_t i = 0; s == RG_OK && i < f.A.count; i++) {
        const int32_t row = f.order[i];
        if (f.A.start[row] == f.A.start[row + 1]) continue;
        for (int32_t e = f.A.start[row]; e < f.A.start[row + 1]; e++) f.x[f.R.L.S.place[f.A.col[e]]] = f.A.x[e];
        turn_in(&f, f.first[row]);
    }
    if (s == RG_OK) *rank = reveal(&f, f.R.n, cut);
    rg_rows_free(&f.A);
    rg_normal_free(&f.R);
    void *block[] = {f.first, f.order, f.count, f.x};
    for (int i = 0; i < 4; i++) rg_mem_free(mem, block[i]);
    return s;
}
