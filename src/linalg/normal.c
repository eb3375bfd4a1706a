#include "linalg/normal.h"

#include <string.h>

rg_status rg_normal_init(rg_normal *N, const rg_memory *mem, int32_t n)
{
    memset(N, 0, sizeof *N);
    N->mem = *mem;
    N->n = n;
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(N->diagonal, (size_t)n), RG_ARRAY(N->scratch, 2 * (size_t)n));
    if (s != RG_OK) rg_normal_free(N);
    return s;
}

void rg_normal_free(rg_normal *N)
{
    if (!N->mem.resize) return;
    rg_supernodal_free(&N->L);
    RG_MEM_FREE(&N->mem, N->diagonal, N->scratch);
    memset(N, 0, sizeof *N);
}

/* Rows by columns: those of column j are of[first[j]] ... of[first[j + 1] - 1], numbered through all lists. */
typedef struct transposed { int32_t *first, *of; } transposed;

static rg_status transpose(const rg_normal *N, const rg_rows *const *lists, int32_t count, transposed *t)
{
    size_t entries = 0;
    for (int32_t k = 0; k < count; k++) entries += (size_t)lists[k]->start[lists[k]->count];
    if (entries > INT32_MAX) return RG_ENOMEM;
    const rg_status s = RG_MEM_ARRAYS(&N->mem, RG_ARRAY(t->first, (size_t)N->n + 2), RG_ARRAY(t->of, entries));
    if (s != RG_OK) return s;
    for (int32_t k = 0; k < count; k++)
        for (int32_t j = 0; j < lists[k]->start[lists[k]->count]; j++) t->first[lists[k]->col[j] + 2]++;
    for (int32_t j = 2; j <= N->n; j++) t->first[j] += t->first[j - 1];
    int32_t base = 0;
    for (int32_t k = 0; k < count; base += lists[k++]->count)
        for (int32_t i = 0; i < lists[k]->count; i++)
            for (int32_t j = lists[k]->start[i]; j < lists[k]->start[i + 1]; j++)
                t->of[t->first[lists[k]->col[j] + 1]++] = base + i;
    return RG_OK;
}

/* The pattern by columns, both triangles and the diagonal. */
static rg_status find_pattern(const rg_normal *N, const rg_rows *const *lists, int32_t count, const transposed *t,
                              int32_t *start, int32_t **row)
{
    int32_t *seen = rg_mem_array(&N->mem, (size_t)N->n, sizeof *seen);
    size_t room = 0, at = 0;
    rg_status s = seen ? RG_OK : RG_ENOMEM;
    for (int32_t j = 0; s == RG_OK && j < N->n; j++) {
        start[j] = (int32_t)at;
        s = at <= (size_t)(INT32_MAX - N->n)
            ? rg_mem_grow(&N->mem, (void **)row, &room, at + (size_t)N->n, sizeof **row) : RG_ENOMEM;
        if (s != RG_OK) break;
        (*row)[at++] = j;
        seen[j] = j + 1;
        for (int32_t p = t->first[j]; p < t->first[j + 1]; p++) {
            int32_t k = 0, i = t->of[p];
            while (i >= lists[k]->count) i -= lists[k++]->count;
            for (int32_t e = lists[k]->start[i]; e < lists[k]->start[i + 1]; e++) {
                const int32_t c = lists[k]->col[e];
                if (seen[c] == j + 1) continue;
                seen[c] = j + 1;
                (*row)[at++] = c;
            }
        }
    }
    if (s == RG_OK) start[N->n] = (int32_t)at;
    rg_mem_free(&N->mem, seen);
    (void)count;
    return s;
}

rg_status rg_normal_analyse(rg_normal *N, const rg_rows *const *lists, int32_t count)
{
    transposed t = {0};
    int32_t *start = rg_mem_array(&N->mem, (size_t)N->n + 1, sizeof *start), *row = NULL;
    rg_status s = start ? transpose(N, lists, count, &t) : RG_ENOMEM;
    rg_supernodal_free(&N->L);
    if (s == RG_OK) s = find_pattern(N, lists, count, &t, start, &row);
    if (s == RG_OK) s = rg_supernodal_init(&N->L, &N->mem, N->n, start, row);
    for (int32_t j = 0; s == RG_OK && j < N->n; j++) N->diagonal[j] = rg_supernodal_slot(&N->L, j, j);
    N->analyses++;
    RG_MEM_FREE(&N->mem, t.first, t.of, start, row);
    return s;
}

rg_status rg_normal_find(const rg_normal *N, const rg_rows *rows, rg_slots *s, int *fits)
{
    *fits = 1;
    for (; s->rows < rows->count; s->rows++) {
        const int32_t first = rows->start[s->rows], n = rows->start[s->rows + 1] - first;
        const size_t products = (size_t)n * ((size_t)n + 1) / 2;
        const rg_status status = RG_MEM_GROW(&N->mem, s->to, s->room, s->used + products);
        if (status != RG_OK) return status;
        *fits = rg_supernodal_find(&N->L, n, rows->col + first, N->scratch, N->scratch + N->n, s->to + s->used);
        if (!*fits) return RG_OK;
        s->used += products;
    }
    return RG_OK;
}

void rg_normal_add(const rg_rows *rows, const rg_slots *s, const double *w, double *x)
{
    const int32_t *to = s->to;
    for (int32_t i = 0; i < s->rows; i++) {
        const int32_t n = rows->start[i + 1] - rows->start[i];
        const double *a = rows->x + rows->start[i], of = w ? w[i] : 1;
        if (of == 0) {
            to += n * (n + 1) / 2;
            continue;
        }
        for (int32_t p = 0; p < n; p++) {
            const double part = of * a[p];
            for (int32_t q = 0; q <= p; q++) x[*to++] += part * a[q];
        }
    }
}

void rg_normal_free_slots(const rg_memory *mem, rg_slots *s)
{
    rg_mem_free(mem, s->to);
    memset(s, 0, sizeof *s);
}
