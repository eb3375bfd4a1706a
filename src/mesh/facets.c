#include "base/memory.h"
#include "base/status.h"
#include "mesh/connect.h"
#include "pattern/faces.h"
#include "pattern/source.h"

#include <stdlib.h>
#include <string.h>

static rg_status copy_edges(const rg_pattern *p, rg_mesh *m)
{
    m->nv = p->nv;
    m->ne = p->ne;
    m->X = rg_mem_array(&m->mem, (size_t)p->nv, sizeof *m->X);
    m->edge = rg_mem_array(&m->mem, (size_t)p->ne, sizeof *m->edge);
    m->assignment = rg_mem_array(&m->mem, (size_t)p->ne, 1);
    m->target = rg_mem_array(&m->mem, (size_t)p->ne, sizeof *m->target);
    if (!m->X || !m->edge || !m->assignment || !m->target) return RG_ENOMEM;
    memcpy(m->X, p->X, (size_t)p->nv * sizeof *m->X);
    for (int32_t e = 0; e < p->ne; e++) {
        memcpy(m->edge[e], p->E[e].v, sizeof m->edge[e]);
        m->assignment[e] = p->E[e].assignment;
        m->target[e] = p->E[e].target;
    }
    return RG_OK;
}

static rg_status copy_facets(const rg_pattern *p, const rg_faces *faces, rg_mesh *m)
{
    m->facet_start = rg_mem_array(&m->mem, (size_t)faces->count + 1, sizeof *m->facet_start);
    m->facet_vertex = rg_mem_array(&m->mem, 2 * (size_t)p->ne, sizeof *m->facet_vertex);
    m->facet_edge = rg_mem_array(&m->mem, 2 * (size_t)p->ne, sizeof *m->facet_edge);
    if (!m->facet_start || !m->facet_vertex || !m->facet_edge) return RG_ENOMEM;
    int32_t at = 0;
    for (int32_t f = 0; f < faces->count; f++) {
        if (faces->area[f] < 0) continue;
        int32_t h = faces->first[f];
        do {
            m->facet_vertex[at] = rg_tail(p->E, h);
            m->facet_edge[at++] = h >> 1;
            h = faces->next[h];
        } while (h != faces->first[f]);
        m->facet_start[++m->nf] = at;
    }
    return RG_OK;
}

typedef struct place { int32_t was, f; } place;

static int by_number(const void *a, const void *b)
{
    const place *p = a, *q = b;
    if ((p->was < 0) != (q->was < 0)) return p->was < 0 ? 1 : -1;
    if (p->was != q->was) return p->was < q->was ? -1 : 1;
    return (p->f > q->f) - (p->f < q->f);
}

/* Facets are numbered as the file numbers its faces; those that it does not have come last. */
static rg_status sort_facets(const rg_pattern *p, rg_mesh *m)
{
    if (m->nf == 0 || p->source.faces == 0) return RG_OK;
    const size_t corners = (size_t)m->facet_start[m->nf];
    int32_t *was = rg_mem_array(&m->mem, (size_t)m->nf, sizeof *was), *old[3] = {m->facet_start, m->facet_vertex, m->facet_edge};
    place *at = rg_mem_array(&m->mem, (size_t)m->nf, sizeof *at);
    int32_t *start = rg_mem_array(&m->mem, (size_t)m->nf + 1, sizeof *start);
    int32_t *vertex = rg_mem_array(&m->mem, corners, sizeof *vertex), *edge = rg_mem_array(&m->mem, corners, sizeof *edge);
    rg_status s = was && at && start && vertex && edge ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) s = rg_source_faces(&p->source, m->nf, m->facet_start, m->facet_vertex, was);
    if (s == RG_OK) {
        for (int32_t f = 0; f < m->nf; f++) at[f] = (place){was[f], f};
        qsort(at, (size_t)m->nf, sizeof *at, by_number);
        for (int32_t f = 0; f < m->nf; f++) {
            const int32_t from = old[0][at[f].f], n = old[0][at[f].f + 1] - from;
            memcpy(vertex + start[f], old[1] + from, (size_t)n * sizeof *vertex);
            memcpy(edge + start[f], old[2] + from, (size_t)n * sizeof *edge);
            start[f + 1] = start[f] + n;
        }
        m->facet_start = start, m->facet_vertex = vertex, m->facet_edge = edge;
    }
    int32_t *const gone[3] = {s == RG_OK ? old[0] : start, s == RG_OK ? old[1] : vertex, s == RG_OK ? old[2] : edge};
    for (int i = 0; i < 3; i++) rg_mem_free(&m->mem, gone[i]);
    rg_mem_free(&m->mem, was);
    rg_mem_free(&m->mem, at);
    return s;
}

rg_status rg_mesh_from_pattern(const rg_pattern *p, const rg_memory *mem, rg_mesh *m, rg_diag *why)
{
    memset(m, 0, sizeof *m);
    if (!p->info.is_disk) return rg_fail(RG_ESHEET, why, 0, "not one sheet without holes: %s", p->info.not_disk);
    rg_faces faces;
    m->mem = *mem;
    m->size = p->info.size;
    rg_status s = rg_faces_init(&faces, mem, p->nv, p->ne, p->X, p->E, p->star_start, p->star);
    if (s == RG_OK) s = copy_edges(p, m);
    if (s == RG_OK) s = copy_facets(p, &faces, m);
    if (s == RG_OK) s = sort_facets(p, m);
    if (s == RG_OK) s = rg_mesh_connect(m);
    rg_faces_free(&faces);
    if (s != RG_OK) {
        rg_mesh_free(m);
        rg_fail(s, why, 0, "out of memory");
    }
    return s;
}
