#include "linalg/rows.h"

#include <string.h>

rg_status rg_rows_init(rg_rows *r, const rg_memory *mem)
{
    memset(r, 0, sizeof *r);
    r->mem = *mem;
    const rg_status s = RG_MEM_GROW(mem, r->start, r->start_room, 1);
    if (s == RG_OK) r->start[0] = 0;
    return s;
}

void rg_rows_free(rg_rows *r)
{
    if (!r->mem.resize) return;
    RG_MEM_FREE(&r->mem, r->start, r->col, r->x);
    memset(r, 0, sizeof *r);
}

void rg_rows_clear(rg_rows *r) { r->count = 0; }

rg_status rg_rows_add(rg_rows *r, int32_t n, const int32_t *col, const double *x)
{
    const int32_t first = r->start[r->count];
    if (r->count > INT32_MAX - 2 || first > INT32_MAX - n) return RG_ENOMEM;
    const size_t entries = (size_t)first + (size_t)n;
    rg_status s = RG_MEM_GROW(&r->mem, r->start, r->start_room, (size_t)r->count + 2);
    if (s == RG_OK) s = RG_MEM_GROW(&r->mem, r->col, r->col_room, entries);
    if (s == RG_OK) s = RG_MEM_GROW(&r->mem, r->x, r->x_room, entries);
    if (s != RG_OK) return s;
    int32_t end = first;
    for (int32_t i = 0; i < n; i++) {
        int32_t at = first;
        while (at < end && r->col[at] != col[i]) at++;
        if (at == end) r->col[end] = col[i], r->x[end++] = 0;
        r->x[at] += x[i];
    }
    r->start[++r->count] = end;
    return RG_OK;
}
