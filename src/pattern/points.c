#include "pattern/points.h"
#include "base/order.h"

#include <string.h>

/* Cells of a sheet's side where the tolerance asks for more: cell numbers stay whole in a double and in 64 bits. */
static const double MOST_CELLS = 1e9;
/* A cell's side over the tolerance: of a point's neighbours within it, most lie in the point's own cell. */
static const double WIDE = 4;
/* More than rounding moves the edge of a cell, in cells. */
static const double ROUNDING = 1e-6;

rg_status rg_points_init(rg_points *p, const rg_memory *mem, rg_vec2 origin, double size, double tol)
{
    memset(p, 0, sizeof *p);
    p->mem = *mem;
    p->origin = origin;
    p->tol = tol;
    p->cell = fmax(WIDE * tol, size / MOST_CELLS);
    p->heads = 64;
    p->head = rg_mem_array(mem, p->heads, sizeof *p->head);
    if (!p->head) return RG_ENOMEM;
    memset(p->head, -1, p->heads * sizeof *p->head);
    return RG_OK;
}

void rg_points_free(rg_points *p)
{
    if (!p->mem.resize) return;
    RG_MEM_FREE(&p->mem, p->X, p->next, p->head, p->spread);
    memset(p, 0, sizeof *p);
}

static inline size_t slot(const rg_points *p, int64_t i, int64_t j)
{
    uint64_t h = (uint64_t)i * UINT64_C(0x9E3779B97F4A7C15) ^ (uint64_t)j * UINT64_C(0xC2B2AE3D27D4EB4F);
    h ^= h >> 29;
    h *= UINT64_C(0xBF58476D1CE4E5B9);
    return (size_t)(h >> 32) & (p->heads - 1);
}

/* The whole number below: a call of floor takes longer. */
static inline int64_t below(double x)
{
    const int64_t i = (int64_t)x;
    return i - (x < (double)i);
}

static inline int64_t column(const rg_points *p, double x) { return below((x - p->origin.x) / p->cell); }
static inline int64_t row(const rg_points *p, double y) { return below((y - p->origin.y) / p->cell); }

/* Cells that may have points within the tolerance of x: columns i[0] to i[1], rows j[0] to j[1]. */
static inline void cells_about(const rg_points *p, rg_vec2 x, int64_t i[2], int64_t j[2])
{
    const double reach = p->tol + ROUNDING * p->cell;
    i[0] = column(p, x.x - reach), i[1] = column(p, x.x + reach);
    j[0] = row(p, x.y - reach), j[1] = row(p, x.y + reach);
}

static void link(rg_points *p, int32_t v)
{
    size_t at = slot(p, column(p, p->X[v].x), row(p, p->X[v].y));
    p->next[v] = p->head[at];
    p->head[at] = v;
}

static rg_status rehash(rg_points *p, size_t heads)
{
    int32_t *head = rg_mem_array(&p->mem, heads, sizeof *head);
    if (!head) return RG_ENOMEM;
    rg_mem_free(&p->mem, p->head);
    p->head = head;
    p->heads = heads;
    memset(p->head, -1, p->heads * sizeof *p->head);
    for (int32_t v = 0; v < p->count; v++) link(p, v);
    return RG_OK;
}

rg_status rg_points_add(rg_points *p, rg_vec2 x, int32_t *vertex)
{
    int64_t columns[2], rows[2];
    double best = INFINITY;
    int32_t found = -1;
    cells_about(p, x, columns, rows);
    for (int64_t i = columns[0]; i <= columns[1]; i++)
        for (int64_t j = rows[0]; j <= rows[1]; j++)
            for (int32_t v = p->head[slot(p, i, j)]; v >= 0; v = p->next[v]) {
                const rg_vec2 off = rg_vec2_sub(p->X[v], x);
                if (!(fabs(off.x) <= p->tol && fabs(off.y) <= p->tol)) continue;
                const double d = rg_vec2_length(off);
                if (d > p->tol || d > best || (d == best && v > found)) continue;
                best = d;
                found = v;
            }
    if (found >= 0) {
        p->merged_max = fmax(p->merged_max, best);
        *vertex = found;
        if (p->is_settled) return RG_OK;
        p->spread[found].sum.x += x.x - p->X[found].x;
        p->spread[found].sum.y += x.y - p->X[found].y;
        p->spread[found].count++;
        return RG_OK;
    }
    const size_t need = (size_t)p->count + 1;
    rg_status s = RG_MEM_GROW(&p->mem, p->X, p->room, need);
    if (s == RG_OK) s = RG_MEM_GROW(&p->mem, p->next, p->next_room, need);
    if (s == RG_OK && !p->is_settled) s = RG_MEM_GROW(&p->mem, p->spread, p->spread_room, need);
    if (s == RG_OK && need > p->heads) s = rehash(p, 4 * p->heads);
    if (s != RG_OK) return s;
    p->X[p->count] = x;
    if (!p->is_settled) p->spread[p->count] = (rg_spread){{0, 0}, 1};
    link(p, p->count);
    *vertex = p->count++;
    return RG_OK;
}

void rg_points_expect(const rg_points *p, rg_vec2 x, int soon)
{
    int64_t columns[2], rows[2];
    cells_about(p, x, columns, rows);
    for (int64_t i = columns[0]; i <= columns[1]; i++)
        for (int64_t j = rows[0]; j <= rows[1]; j++) {
            const int32_t *head = &p->head[slot(p, i, j)];
            if (!soon) rg_mem_soon(head);
            else if (*head >= 0) rg_mem_soon(&p->X[*head]), rg_mem_soon(&p->next[*head]);
        }
}

void rg_points_forget(rg_points *p)
{
    const int32_t v = --p->count;
    p->head[slot(p, column(p, p->X[v].x), row(p, p->X[v].y))] = p->next[v]; /* the newest stands first in its chain */
}

/* What was merged is behind: the vertices are taken as new points, in their order. Those that the mean brought within
 * the tolerance of each other are one then, where the first of them is. */
rg_status rg_points_settle(rg_points *p, int32_t *now)
{
    const int32_t n = p->count;
    for (int32_t v = 0; v < n; v++) {
        const rg_spread *d = &p->spread[v];
        p->X[v] = (rg_vec2){p->X[v].x + d->sum.x / d->count, p->X[v].y + d->sum.y / d->count};
    }
    rg_mem_free(&p->mem, p->spread);
    p->spread = NULL;
    p->is_settled = 1;
    p->count = 0;
    memset(p->head, -1, p->heads * sizeof *p->head);
    rg_status s = RG_OK;
    for (int32_t v = 0; s == RG_OK && v < n; v++) s = rg_points_add(p, p->X[v], &now[v]); /* written at or before v */
    return s;
}

/* Swept along a direction that no drawing is aligned with, so that rows and columns of a grid do not fall together. */
rg_status rg_points_nearest(const rg_memory *mem, const rg_vec2 *X, int32_t n, double *distance, int32_t *at)
{
    static const rg_vec2 along = {0.8253356149096783, 0.5646424733950354}; /* (cos, sin) of 0.6 */
    rg_keyed *line, *room;
    int32_t *count;
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(line, (size_t)n), RG_ARRAY(room, (size_t)n),
                                      RG_ARRAY(count, (size_t)n));
    if (s != RG_OK) return s;
    for (int32_t v = 0; v < n; v++) line[v] = (rg_keyed){rg_vec2_dot(along, X[v]), v, 0};
    rg_order_keyed(line, n, room, count);
    *distance = INFINITY;
    for (int32_t i = 0; i < n; i++) {
        if (i + RG_SOON < n) rg_mem_soon(&X[line[i + RG_SOON].v]);
        for (int32_t j = i + 1; j < n && line[j].key - line[i].key < *distance; j++) {
            const rg_vec2 off = rg_vec2_sub(X[line[i].v], X[line[j].v]);
            if (!(fabs(off.x) < *distance && fabs(off.y) < *distance)) continue;
            const double d = rg_vec2_length(off);
            if (!(d < *distance)) continue;
            *distance = d;
            if (at) *at = line[i].v;
        }
    }
    RG_MEM_FREE(mem, line, room, count);
    return RG_OK;
}
