#include "pattern/source.h"

#include <stdlib.h>
#include <string.h>

/* The file's number of the end of a line that lies at x, if any does: ends are moved by less than `tol`. */
static int32_t end_at(const rg_lines *l, int32_t line, rg_vec2 x, double tol)
{
    const rg_line *q = &l->line[line];
    const double a = rg_vec2_length(rg_vec2_sub(q->a, x)), b = rg_vec2_length(rg_vec2_sub(q->b, x));
    if (!(fmin(a, b) <= tol)) return -1;
    return l->vertex[2 * line + !(a <= b)];
}

void rg_source_vertices(const rg_graph *g, const rg_lines *l, int32_t *of)
{
    const double tol = 2 * g->merged_max + 1e-12 * g->size;
    for (int32_t v = 0; v < g->nv; v++) of[v] = -1;
    for (int32_t e = 0; l->vertex && e < g->ne; e++)
        for (int i = 0; i < 2; i++) {
            const int32_t v = g->E[e].v[i], was = end_at(l, g->E[e].line, g->X[v], tol);
            if (was >= 0 && (of[v] < 0 || was < of[v])) of[v] = was;
        }
}

typedef struct place { int32_t was, v; } place;

static int by_number(const void *a, const void *b)
{
    const place *p = a, *q = b;
    if ((p->was < 0) != (q->was < 0)) return p->was < 0 ? 1 : -1;
    if (p->was != q->was) return p->was < q->was ? -1 : 1;
    return (p->v > q->v) - (p->v < q->v);
}

rg_status rg_source_sort(rg_graph *g, const rg_lines *lines)
{
    if (!lines->vertex || g->nv == 0) return RG_OK;
    int32_t *of;
    place *at;
    rg_vec2 *X;
    const rg_status s = RG_MEM_ARRAYS(&g->mem, RG_ARRAY(of, (size_t)g->nv), RG_ARRAY(at, (size_t)g->nv),
                                      RG_ARRAY(X, (size_t)g->nv));
    if (s == RG_OK) {
        rg_source_vertices(g, lines, of);
        for (int32_t v = 0; v < g->nv; v++) at[v] = (place){of[v], v};
        qsort(at, (size_t)g->nv, sizeof *at, by_number);
        memcpy(X, g->X, (size_t)g->nv * sizeof *X);
        for (int32_t v = 0; v < g->nv; v++) g->X[v] = X[at[v].v], of[at[v].v] = v;
        for (int32_t e = 0; e < g->ne; e++)
            for (int i = 0; i < 2; i++) g->E[e].v[i] = of[g->E[e].v[i]];
    }
    RG_MEM_FREE(&g->mem, of, at, X);
    return s;
}

rg_status rg_source_init(rg_source *s, const rg_graph *g, rg_lines *lines)
{
    *s = (rg_source){.mem = g->mem, .nv = g->nv, .ne = g->ne};
    if (RG_MEM_ARRAYS(&g->mem, RG_ARRAY(s->vertex, (size_t)g->nv), RG_ARRAY(s->edge, (size_t)g->ne),
                      RG_ARRAY(s->where, (size_t)g->ne)) != RG_OK) return RG_ENOMEM;
    rg_source_vertices(g, lines, s->vertex);
    for (int32_t e = 0; e < g->ne; e++) s->edge[e] = g->E[e].line, s->where[e] = g->E[e].where;
    s->lines = lines->count;
    s->y_down = lines->y_down;
    s->frame = lines->frame;
    s->keeper = lines->keeper;
    s->faces = lines->faces;
    s->face_start = lines->face_start;
    s->face_vertex = lines->face_vertex;
    lines->frame = NULL;
    lines->face_start = lines->face_vertex = NULL;
    if (lines->memo && !(s->memo = rg_mem_string(&g->mem, lines->memo))) return RG_ENOMEM;
    return RG_OK;
}

static int32_t *copied(const rg_memory *mem, const int32_t *from, int32_t n)
{
    int32_t *to = from ? rg_mem_array(mem, (size_t)n, sizeof *to) : NULL;
    if (to && n > 0) memcpy(to, from, (size_t)n * sizeof *to);
    return to;
}

rg_status rg_source_copy(const rg_source *s, const rg_memory *mem, rg_source *out)
{
    *out = *s;
    out->mem = *mem;
    out->vertex = copied(mem, s->vertex, s->nv);
    out->edge = copied(mem, s->edge, s->ne);
    out->where = copied(mem, s->where, s->ne);
    out->face_start = copied(mem, s->face_start, s->faces + 1);
    out->face_vertex = copied(mem, s->face_vertex, s->face_start ? s->face_start[s->faces] : 0);
    out->memo = s->memo ? rg_mem_string(mem, s->memo) : NULL;
    out->frame = s->frame ? s->keeper->share(s->frame) : NULL;
    const int faces = !s->face_start || (out->face_start && out->face_vertex);
    if (!s->vertex || (out->vertex && out->edge && out->where && faces && (out->memo || !s->memo))) return RG_OK;
    rg_source_free(out);
    return RG_ENOMEM;
}

void rg_source_free(rg_source *s)
{
    if (s->mem.resize) RG_MEM_FREE(&s->mem, s->vertex, s->edge, s->where, s->face_start, s->face_vertex, s->memo);
    if (s->frame) s->keeper->free(s->frame);
    memset(s, 0, sizeof *s);
}

rg_status rg_source_follow(rg_source *s, int32_t nv, const int32_t *vertex, int32_t ne, const int32_t *edge)
{
    int32_t *of_vertex = s->vertex ? rg_mem_array(&s->mem, (size_t)nv, sizeof *of_vertex) : NULL;
    int32_t *of_edge = s->edge ? rg_mem_array(&s->mem, (size_t)ne, sizeof *of_edge) : NULL;
    int32_t *where = s->where ? rg_mem_array(&s->mem, (size_t)ne, sizeof *where) : NULL;
    if ((s->vertex && !of_vertex) || (s->edge && !of_edge) || (s->where && !where)) {
        RG_MEM_FREE(&s->mem, of_vertex, of_edge, where);
        return RG_ENOMEM;
    }
    for (int32_t v = 0; of_vertex && v < nv; v++) {
        const int32_t was = vertex[v];
        of_vertex[v] = was >= 0 && was < s->nv ? s->vertex[was] : -1;
    }
    for (int32_t e = 0; e < ne; e++) {
        const int known = edge[e] >= 0 && edge[e] < s->ne;
        if (of_edge) of_edge[e] = known ? s->edge[edge[e]] : -1;
        if (where) where[e] = known ? s->where[edge[e]] : 0;
    }
    RG_MEM_FREE(&s->mem, s->vertex, s->edge, s->where);
    s->vertex = of_vertex, s->edge = of_edge, s->where = where;
    s->nv = nv, s->ne = ne;
    return RG_OK;
}

/* ------------------------------------------------------------------------------------------------------- faces ---- */

/* A set of numbers as one: order does not matter. The constants are those of splitmix64. */
static uint64_t mix(int32_t number)
{
    uint64_t x = (uint64_t)number + UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
    return x ^ x >> 31;
}

typedef struct face { uint64_t set; int32_t number; } face;

static int by_set(const void *a, const void *b)
{
    const face *p = a, *q = b;
    if (p->set != q->set) return p->set < q->set ? -1 : 1;
    return (p->number > q->number) - (p->number < q->number);
}

static int32_t find_set(const face *list, int32_t n, uint64_t set)
{
    int32_t low = 0, high = n;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (list[middle].set < set) low = middle + 1;
        else high = middle;
    }
    return low < n && list[low].set == set ? list[low].number : -1;
}

/* The file's faces as sets of those of its vertices that are still there. list[faces]: out */
static rg_status file_faces(const rg_source *s, face *list)
{
    int32_t most = -1;
    for (int32_t v = 0; v < s->nv; v++) most = s->vertex[v] > most ? s->vertex[v] : most;
    unsigned char *there = rg_mem_array(&s->mem, (size_t)most + 1, 1);
    if (!there) return RG_ENOMEM;
    for (int32_t v = 0; v < s->nv; v++)
        if (s->vertex[v] >= 0) there[s->vertex[v]] = 1;
    for (int32_t f = 0; f < s->faces; f++) {
        list[f] = (face){0, f};
        for (int32_t k = s->face_start[f]; k < s->face_start[f + 1]; k++) {
            const int32_t v = s->face_vertex[k];
            if (v <= most && there[v]) list[f].set += mix(v);
        }
    }
    rg_mem_free(&s->mem, there);
    if (s->faces > 0) qsort(list, (size_t)s->faces, sizeof *list, by_set);
    return RG_OK;
}

rg_status rg_source_faces(const rg_source *s, int32_t nf, const int32_t *facet_start, const int32_t *facet_vertex,
                          int32_t *source)
{
    for (int32_t f = 0; f < nf; f++) source[f] = -1;
    if (s->faces == 0 || !s->vertex) return RG_OK;
    face *list = rg_mem_array(&s->mem, (size_t)s->faces, sizeof *list);
    const rg_status status = list ? file_faces(s, list) : RG_ENOMEM;
    for (int32_t f = 0; status == RG_OK && f < nf; f++) {
        uint64_t set = 0;
        int known = 1;
        for (int32_t k = facet_start[f]; k < facet_start[f + 1]; k++) {
            const int32_t v = facet_vertex[k];
            known &= v < s->nv && s->vertex[v] >= 0;
            if (known) set += mix(s->vertex[v]);
        }
        if (known) source[f] = find_set(list, s->faces, set);
    }
    rg_mem_free(&s->mem, list);
    return status;
}
