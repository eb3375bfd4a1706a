/* rows.h -- a list of sparse rows, made one after the other.
 * Used by  normal.c, unfold/ */
#ifndef RG_ROWS_H
#define RG_ROWS_H

#include "base/memory.h"

typedef struct rg_rows {
    rg_memory mem;
    int32_t count;
    int32_t *start;      /* [count + 1] */
    int32_t *col;        /* [start[count]] no column twice in a row */
    double *x;
    size_t start_room, col_room, x_room;
} rg_rows;

/* An empty list. RG_ENOMEM. Owner: the caller, rg_rows_free, also after a failure. */
rg_status rg_rows_init(rg_rows *r, const rg_memory *mem);
void rg_rows_free(rg_rows *r);
void rg_rows_clear(rg_rows *r);
/* One more: x[n] at col[n]; numbers at the same column are added up. RG_ENOMEM: the list is as it was. Allocates only
 * where it has never been as long. */
rg_status rg_rows_add(rg_rows *r, int32_t n, const int32_t *col, const double *x);

/* row_i . v */
static inline double rg_rows_dot(const rg_rows *r, int32_t i, const double *v)
{
    double sum = 0;
    for (int32_t j = r->start[i]; j < r->start[i + 1]; j++) sum += r->x[j] * v[r->col[j]];
    return sum;
}

/* v <- v + a row_i */
static inline void rg_rows_gather(const rg_rows *r, int32_t i, double a, double *v)
{
    for (int32_t j = r->start[i]; j < r->start[i + 1]; j++) v[r->col[j]] += a * r->x[j];
}

#endif
