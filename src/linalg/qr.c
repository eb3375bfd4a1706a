#include "linalg/qr.h"
#include "base/lanes.h"
#include "linalg/normal.h"

#include <math.h>
#include <string.h>

/* What an eliminated front hands up to the next: its last rows in the columns that are left, by columns, and where each
 * begins. */
typedef struct part {
    double *x;       /* [columns][rows] */
    int32_t *lead;   /* [rows] rising */
    int32_t rows, next; /* next: of the fronts with the same parent, -1: the last */
} part;

typedef struct factor {
    const rg_memory *mem;
    rg_rows A;       /* upright */
    rg_normal R;     /* of the pattern of A^T A, which is that of R: a supernode is a front */
    int32_t *first;  /* [rows of A] its leading column in the order of elimination */
    int32_t *order;  /* [rows of A] by rising leading columns */
    int32_t *begin;  /* [columns + 1] into order */
    int32_t *place;  /* [columns] of a column in the present front */
    int32_t *child;  /* [fronts] the first that hands up to it, -1: none */
    part *part;      /* [fronts] */
} factor;

/* ------------------------------------------------------------------------------------------------------ rows ---- */

static void put(rg_rows *A, int32_t *n, int32_t col, double x)
{
    A->col[*n] = col;
    A->x[(*n)++] = x;
}

/* Upright, so that there is less to eliminate: the rows of B where they are more than the creases, else those of
 * B^T. */
static rg_status list_rows(const rg_sparse *B, int upright, const rg_memory *mem, rg_rows *A)
{
    const size_t rows = upright ? 3 * (size_t)B->M : (size_t)B->N, entries = 3 * (size_t)B->start[B->M];
    int32_t n = 0;
    A->mem = *mem;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(A->start, rows + 1), RG_ARRAY(A->col, entries),
                      RG_ARRAY(A->x, entries)) != RG_OK) return RG_ENOMEM;
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

/* By leading columns; rows without any are left out. */
static void sort_rows(factor *f)
{
    const int32_t columns = f->R.n, *place = f->R.L.S.place;
    for (int32_t i = 0; i < f->A.count; i++) {
        f->first[i] = columns;
        for (int32_t e = f->A.start[i]; e < f->A.start[i + 1]; e++)
            if (place[f->A.col[e]] < f->first[i]) f->first[i] = place[f->A.col[e]];
        if (f->first[i] < columns) f->begin[f->first[i] + 1]++;
    }
    for (int32_t j = 0; j < columns; j++) f->begin[j + 1] += f->begin[j];
    for (int32_t i = f->A.count; i-- > 0;) /* begin[j + 1] goes down to where column j begins, */
        if (f->first[i] < columns) f->order[--f->begin[f->first[i] + 1]] = i;
    for (int32_t j = 0; j < columns; j++) f->begin[j] = f->begin[j + 1]; /* and one place to the left */
    f->begin[columns] = 0;
    for (int32_t i = 0; i < f->A.count; i++) f->begin[columns] += f->first[i] < columns;
}

static rg_status make(factor *f, const rg_sparse *B)
{
    const int upright = 3 * (int64_t)B->M > B->N;
    const int32_t columns = upright ? B->N : 3 * B->M;
    const rg_rows *const list = &f->A;
    rg_status s = list_rows(B, upright, f->mem, &f->A);
    if (s == RG_OK) s = rg_normal_init(&f->R, f->mem, columns);
    if (s == RG_OK) s = rg_normal_analyse(&f->R, &list, 1);
    if (s != RG_OK) return s;
    const size_t fronts = (size_t)f->R.L.S.count;
    if (RG_MEM_ARRAYS(f->mem, RG_ARRAY(f->first, (size_t)f->A.count), RG_ARRAY(f->order, (size_t)f->A.count),
                      RG_ARRAY(f->begin, (size_t)columns + 1), RG_ARRAY(f->place, (size_t)columns),
                      RG_ARRAY(f->child, fronts), RG_ARRAY(f->part, fronts)) != RG_OK) return RG_ENOMEM;
    for (size_t k = 0; k < fronts; k++) f->child[k] = -1;
    sort_rows(f);
    return RG_OK;
}

static void free_part(const factor *f, int32_t front)
{
    RG_MEM_FREE(f->mem, f->part[front].x, f->part[front].lead);
    f->part[front].x = NULL, f->part[front].lead = NULL, f->part[front].rows = 0;
}

static void free_factor(factor *f)
{
    for (int32_t k = 0; f->part && k < f->R.L.S.count; k++) free_part(f, k);
    RG_MEM_FREE(f->mem, f->first, f->order, f->begin, f->place, f->child, f->part);
    rg_rows_free(&f->A);
    rg_normal_free(&f->R);
}

/* --------------------------------------------------------------------------------------------------- a front ---- */

/* A dense matrix of the rows that begin in a supernode's columns, and of what its children handed up. */
typedef struct front {
    int32_t rows, columns, pivots; /* pivots: the supernode's own columns, the first */
    double *x;                     /* [columns][rows] */
    int32_t *below;                /* [columns + 1] so many rows begin in that column or before it */
    int32_t *lead;                 /* [rows] of each that was taken, in which column */
} front;

/* The front of supernode s, its rows sorted by where they begin. below[k]: where the rows end that begin in columns up
 * to k. */
static rg_status gather(factor *f, int32_t s, front *F)
{
    const rg_symbolic *S = &f->R.L.S;
    const int32_t *col = S->row + S->start[s], from = f->begin[S->column[s]], to = f->begin[S->column[s + 1]];
    F->columns = S->start[s + 1] - S->start[s];
    F->pivots = S->column[s + 1] - S->column[s];
    F->rows = to - from;
    for (int32_t k = 0; k < F->columns; k++) f->place[col[k]] = k;
    for (int32_t c = f->child[s]; c >= 0; c = f->part[c].next) F->rows += f->part[c].rows;
    if (RG_MEM_ARRAYS(f->mem, RG_ARRAY(F->x, (size_t)F->rows * (size_t)F->columns),
                      RG_ARRAY(F->below, (size_t)F->columns + 1),
                      RG_ARRAY(F->lead, (size_t)F->rows)) != RG_OK) return RG_ENOMEM;
    for (int32_t i = from; i < to; i++) F->below[f->place[f->first[f->order[i]]] + 1]++;
    for (int32_t c = f->child[s]; c >= 0; c = f->part[c].next) {
        const int32_t *up = S->row + S->start[c] + S->column[c + 1] - S->column[c];
        for (int32_t i = 0; i < f->part[c].rows; i++) F->below[f->place[up[f->part[c].lead[i]]] + 1]++;
    }
    for (int32_t k = 0; k < F->columns; k++) F->below[k + 1] += F->below[k];
    const size_t tall = (size_t)F->rows;
    for (int32_t i = from; i < to; i++) {
        const int32_t row = f->order[i], at = F->below[f->place[f->first[row]]]++;
        for (int32_t e = f->A.start[row]; e < f->A.start[row + 1]; e++)
            F->x[(size_t)f->place[S->place[f->A.col[e]]] * tall + (size_t)at] = f->A.x[e];
    }
    for (int32_t c = f->child[s]; c >= 0; c = f->part[c].next) {
        const part *p = &f->part[c];
        const int32_t own = S->column[c + 1] - S->column[c], wide = S->start[c + 1] - S->start[c] - own;
        const int32_t *up = S->row + S->start[c] + own;
        for (int32_t i = 0; i < p->rows; i++) {
            const int32_t at = F->below[f->place[up[p->lead[i]]]]++;
            for (int32_t k = p->lead[i]; k < wide; k++)
                F->x[(size_t)f->place[up[k]] * tall + (size_t)at] = p->x[(size_t)k * (size_t)p->rows + (size_t)i];
        }
        free_part(f, c);
    }
    return RG_OK;
}

/* Householder's reflection takes the n numbers of column k from row r on to the first of them, and goes over the
 * columns behind. */
static void turn(front *F, int32_t k, int32_t r, int32_t n, double length)
{
    const size_t tall = (size_t)F->rows;
    double *v = F->x + (size_t)k * tall + (size_t)r;
    const double pivot = v[0] > 0 ? -length : length, scale = 1 / (length * (length + fabs(v[0])));
    v[0] -= pivot;
    for (int32_t j = k + 1; j < F->columns; j++) {
        double *to = F->x + (size_t)j * tall + (size_t)r;
        rg_lanes_add(n, -scale * rg_lanes_dot(n, v, to), v, to);
    }
    v[0] = pivot;
}

/* Its own columns are eliminated, of which those that are no longer than `cut` count as zero, and what is left becomes
 * as few rows as there are columns. *pivots grows by the rows that its own columns take, which are returned; *taken:
 * rows in all. */
static int32_t eliminate(front *F, double cut, int32_t *pivots, int32_t *taken)
{
    int32_t r = 0, own = 0;
    for (int32_t k = 0; k < F->columns; k++) {
        const int32_t n = F->below[k] - r;
        double *v = F->x + (size_t)k * (size_t)F->rows + (size_t)r;
        const double length = n > 0 ? sqrt(rg_lanes_dot(n, v, v)) : 0;
        if (k == F->pivots) own = r;
        if (!(length > (k < F->pivots ? cut : 0))) continue;
        if (n > 1) turn(F, k, r, n, length);
        *pivots += k < F->pivots;
        F->lead[r++] = k;
    }
    *taken = r;
    return F->pivots == F->columns ? r : own;
}

/* What is left, to the front in whose columns it begins. */
static rg_status hand_up(factor *f, int32_t s, const front *F, int32_t own, int32_t taken)
{
    const rg_symbolic *S = &f->R.L.S;
    const size_t rows = (size_t)(taken - own), wide = (size_t)(F->columns - F->pivots);
    part *p = &f->part[s];
    if (rows == 0 || wide == 0) return RG_OK;
    if (RG_MEM_ARRAYS(f->mem, RG_ARRAY(p->x, rows * wide), RG_ARRAY(p->lead, rows)) != RG_OK) return RG_ENOMEM;
    p->rows = (int32_t)rows;
    for (size_t i = 0; i < rows; i++) p->lead[i] = F->lead[(size_t)own + i] - F->pivots;
    for (size_t k = 0; k < wide; k++)
        memcpy(p->x + k * rows, F->x + ((size_t)F->pivots + k) * (size_t)F->rows + (size_t)own, rows * sizeof *p->x);
    const int32_t parent = S->of[S->row[S->start[s] + F->pivots]];
    p->next = f->child[parent];
    f->child[parent] = s;
    return RG_OK;
}

rg_status rg_qr_rank(const rg_sparse *B, double cut, int32_t *rank)
{
    factor f = {.mem = &B->mem};
    int32_t pivots = 0;
    rg_status s = B->M > 0 && B->N > 0 ? make(&f, B) : RG_OK;
    for (int32_t k = 0; s == RG_OK && k < f.R.L.S.count; k++) {
        front F = {0};
        int32_t own = 0, taken = 0;
        s = gather(&f, k, &F);
        if (s == RG_OK) own = eliminate(&F, cut, &pivots, &taken);
        if (s == RG_OK) s = hand_up(&f, k, &F, own, taken);
        RG_MEM_FREE(f.mem, F.x, F.below, F.lead);
    }
    free_factor(&f);
    if (s == RG_OK) *rank = pivots;
    return s;
}
