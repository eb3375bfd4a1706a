#include "pattern/plane.h"
#include "pattern/faces.h"
#include "pattern/source.h"

#include <stdlib.h>
#include <string.h>

/* A point that is meant to be on an edge is no farther from it than this part of the sheet's size. */
static const double ON_EDGE = 0.01;

/* ------------------------------------------------------------------------------------------------ facets ---- */

static rg_status find_facets(struct rg_pattern *p, const rg_faces *faces)
{
    if (RG_MEM_ARRAYS(&p->mem, RG_ARRAY(p->facet_start, (size_t)faces->count + 1),
                      RG_ARRAY(p->facet_vertex, 2 * (size_t)p->ne),
                      RG_ARRAY(p->facet_edge, 2 * (size_t)p->ne)) != RG_OK) return RG_ENOMEM;
    int32_t at = 0;
    for (int32_t f = 0; f < faces->count; f++) {
        if (faces->area[f] < 0) continue;
        int32_t h = faces->first[f];
        do {
            p->facet_vertex[at] = rg_tail(p->E, h);
            p->facet_edge[at++] = h >> 1;
            h = faces->next[h];
        } while (h != faces->first[f]);
        p->facet_start[++p->plane.facets] = at;
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
static rg_status sort_facets(struct rg_pattern *p)
{
    if (p->plane.facets == 0 || p->source.faces == 0) return RG_OK;
    const size_t corners = (size_t)p->facet_start[p->plane.facets];
    const size_t facets = (size_t)p->plane.facets;
    int32_t *was, *start, *vertex, *edge, *old[3] = {p->facet_start, p->facet_vertex, p->facet_edge};
    place *at;
    rg_status s = RG_MEM_ARRAYS(&p->mem, RG_ARRAY(was, facets), RG_ARRAY(at, facets), RG_ARRAY(start, facets + 1),
                                RG_ARRAY(vertex, corners), RG_ARRAY(edge, corners));
    if (s == RG_OK) s = rg_source_faces(&p->source, p->plane.facets, p->facet_start, p->facet_vertex, was);
    if (s == RG_OK) {
        for (int32_t f = 0; f < p->plane.facets; f++) at[f] = (place){was[f], f};
        qsort(at, (size_t)p->plane.facets, sizeof *at, by_number);
        for (int32_t f = 0; f < p->plane.facets; f++) {
            const int32_t from = old[0][at[f].f], n = old[0][at[f].f + 1] - from;
            memcpy(vertex + start[f], old[1] + from, (size_t)n * sizeof *vertex);
            memcpy(edge + start[f], old[2] + from, (size_t)n * sizeof *edge);
            start[f + 1] = start[f] + n;
        }
        p->facet_start = start, p->facet_vertex = vertex, p->facet_edge = edge;
    }
    if (s == RG_OK) RG_MEM_FREE(&p->mem, old[0], old[1], old[2]);
    else RG_MEM_FREE(&p->mem, start, vertex, edge);
    RG_MEM_FREE(&p->mem, was, at);
    return s;
}

/* ------------------------------------------------------------------------------------------------- lending ---- */

static rg_status lend_edges(struct rg_pattern *p)
{
    const size_t ne = (size_t)p->ne;
    if (RG_MEM_ARRAYS(&p->mem, RG_ARRAY(p->ends, ne), RG_ARRAY(p->letter, ne + 1), RG_ARRAY(p->target, ne),
                      RG_ARRAY(p->where, ne)) != RG_OK) return RG_ENOMEM;
    for (int32_t e = 0; e < p->ne; e++) {
        memcpy(p->ends[e], p->E[e].v, sizeof p->ends[e]);
        p->letter[e] = p->E[e].assignment;
        p->target[e] = p->E[e].target;
        p->where[e] = p->E[e].where;
    }
    return RG_OK;
}

rg_status rg_plane_lend(struct rg_pattern *p)
{
    rg_faces faces = {0};
    rg_status s = lend_edges(p);
    if (s == RG_OK && p->info.is_disk) {
        s = rg_faces_init(&faces, &p->mem, p->nv, p->ne, p->X, p->E, p->star_start, p->star);
        if (s == RG_OK) s = find_facets(p, &faces);
        if (s == RG_OK) s = sort_facets(p);
        rg_faces_free(&faces);
    }
    p->plane = (rg_plane){.vertices = p->nv, .edges = p->ne, .facets = p->plane.facets, .at = (const double(*)[2])p->X,
                          .ends = (const int32_t(*)[2])p->ends, .assignment = p->letter, .target = p->target,
                          .line = p->where, .facet_start = p->facet_start, .facet_vertex = p->facet_vertex};
    return s;
}

void rg_plane_free(struct rg_pattern *p)
{
    RG_MEM_FREE(&p->mem, p->ends, p->letter, p->target, p->where, p->facet_start, p->facet_vertex, p->facet_edge);
}

const rg_plane *rg_pattern_get_plane(const rg_pattern *p) { return &p->plane; }

/* -------------------------------------------------------------------------------------------- which edge ---- */

int32_t rg_pattern_edge_between(const rg_pattern *p, int32_t v, int32_t w)
{
    if (v < 0 || v >= p->nv) return -1;
    for (int32_t k = p->star_start[v]; k < p->star_start[v + 1]; k++) {
        const int32_t *end = p->ends[p->star[k]];
        if (end[0] == w || end[1] == w) return v == w ? -1 : p->star[k];
    }
    return -1;
}

int32_t rg_pattern_edge_at(const rg_pattern *p, const double x[2])
{
    const rg_vec2 at = {x[0], p->source.y_down ? 0 - x[1] : x[1]};
    double nearest = ON_EDGE * p->info.size;
    int32_t found = -1;
    for (int32_t e = 0; e < p->ne; e++) {
        const double d = rg_vec2_off_segment(p->X[p->ends[e][0]], p->X[p->ends[e][1]], at);
        if (d < nearest) nearest = d, found = e;
    }
    return found;
}

/* -------------------------------------------------------------------------------------------- what it is to do ---- */

static int is_crease(const rg_pattern *p, int32_t e) { return e >= 0 && e < p->ne && p->letter[e] != RG_BORDER; }

rg_status rg_pattern_set_target(rg_pattern *p, int32_t e, double radians)
{
    if (!is_crease(p, e) || !(fabs(radians) <= RG_PI || radians == RG_FREE)) return RG_EARG;
    p->E[e].target = p->target[e] = radians == RG_FREE ? NAN : radians;
    if (p->still) p->still[e] = 0;
    return RG_OK;
}

rg_status rg_pattern_pin(rg_pattern *p, int32_t e)
{
    if (!is_crease(p, e)) return RG_EARG;
    if (!p->still && !(p->still = rg_mem_array(&p->mem, (size_t)p->ne, 1))) return RG_ENOMEM;
    p->E[e].target = p->target[e] = NAN;
    p->still[e] = 1;
    return RG_OK;
}
