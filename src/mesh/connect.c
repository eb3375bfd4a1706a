#include "mesh/connect.h"
#include "base/memory.h"

#include <string.h>

void rg_mesh_free(rg_mesh *m)
{
    if (!m->mem.resize) return;
    rg_memory mem = m->mem;
    RG_MEM_FREE(&mem, m->X, m->edge, m->assignment, m->target, m->still, m->edge_facet, m->facet_start, m->facet_vertex,
                m->facet_edge, m->crease_edge, m->edge_crease, m->inner_vertex, m->loop_start, m->loop_crease,
                m->loop_theta);
    memset(m, 0, sizeof *m);
}

rg_status rg_mesh_copy(const rg_mesh *m, rg_mesh *out)
{
    rg_mesh copy = *m;
    const size_t nv = (size_t)m->nv, ne = (size_t)m->ne, nf = (size_t)m->nf, N = (size_t)m->N, M = (size_t)m->M;
    const size_t corners = (size_t)m->facet_start[m->nf], spokes = (size_t)m->loop_start[m->M];
    const rg_status s = RG_MEM_COPIES(
        &m->mem, RG_ARRAY(copy.X, nv), RG_ARRAY(copy.edge, ne), RG_ARRAY(copy.assignment, ne), RG_ARRAY(copy.still, ne),
        RG_ARRAY(copy.target, ne), RG_ARRAY(copy.edge_facet, ne), RG_ARRAY(copy.facet_start, nf + 1),
        RG_ARRAY(copy.facet_vertex, corners), RG_ARRAY(copy.facet_edge, corners), RG_ARRAY(copy.crease_edge, N),
        RG_ARRAY(copy.edge_crease, ne), RG_ARRAY(copy.inner_vertex, M), RG_ARRAY(copy.loop_start, M + 1),
        RG_ARRAY(copy.loop_crease, spokes), RG_ARRAY(copy.loop_theta, spokes));
    *out = s == RG_OK ? copy : (rg_mesh){0};
    return s;
}

int32_t rg_mesh_edge_between(const rg_mesh *m, int32_t f, int32_t a, int32_t b)
{
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
        const int32_t *v = m->edge[m->facet_edge[j]];
        if ((v[0] == a && v[1] == b) || (v[0] == b && v[1] == a)) return m->facet_edge[j];
    }
    return -1;
}

int32_t rg_mesh_opposite(const rg_mesh *m, int32_t triangle, int32_t e)
{
    const int32_t *v = m->facet_vertex + m->facet_start[triangle], a = m->edge[e][0], b = m->edge[e][1];
    return v[0] != a && v[0] != b ? v[0] : v[1] != a && v[1] != b ? v[1] : v[2];
}

void rg_mesh_sectors_at(const rg_mesh *m, int32_t k, const rg_vec2 *X, double *theta)
{
    const int32_t first = m->loop_start[k], last = m->loop_start[k + 1], v = m->inner_vertex[k];
    for (int32_t j = first; j < last; j++) {
        const int32_t *e = m->edge[m->crease_edge[m->loop_crease[j]]];
        const int32_t *g = m->edge[m->crease_edge[m->loop_crease[j + 1 < last ? j + 1 : first]]];
        const rg_vec2 a = rg_vec2_sub(X[e[e[0] == v]], X[v]), b = rg_vec2_sub(X[g[g[0] == v]], X[v]);
        const double turn = atan2(rg_vec2_cross(a, b), rg_vec2_dot(a, b));
        theta[j] = turn > 0 ? turn : turn + 2 * RG_PI;
    }
}

void rg_mesh_sectors(const rg_mesh *m, const rg_vec2 *X, double *theta)
{
    for (int32_t k = 0; k < m->M; k++) rg_mesh_sectors_at(m, k, X, theta);
}

double rg_mesh_twice_area(const rg_mesh *m, int32_t f, const rg_vec2 *X)
{
    const int32_t *v = m->facet_vertex, first = m->facet_start[f];
    double twice = 0;
    for (int32_t j = first + 1; j + 1 < m->facet_start[f + 1]; j++)
        twice += rg_vec2_turn(X[v[first]], X[v[j]], X[v[j + 1]]);
    return twice;
}

static rg_status join_facets(rg_mesh *m)
{
    if (RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->edge_facet, (size_t)m->ne), RG_ARRAY(m->edge_crease, (size_t)m->ne),
                      RG_ARRAY(m->crease_edge, (size_t)m->ne)) != RG_OK) return RG_ENOMEM;
    for (int32_t e = 0; e < m->ne; e++) m->edge_facet[e][0] = m->edge_facet[e][1] = -1;
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const int32_t e = m->facet_edge[j];
            m->edge_facet[e][m->edge[e][0] != m->facet_vertex[j]] = f;
        }
    for (int32_t e = 0; e < m->ne; e++) {
        const int inside = m->edge_facet[e][0] >= 0 && m->edge_facet[e][1] >= 0;
        m->edge_crease[e] = inside ? m->N : -1;
        if (inside) m->crease_edge[m->N++] = e;
        else m->N0++;
    }
    return RG_OK;
}

/* A facet's corner takes one counter-clockwise from the edge that leaves it to the edge that arrives there, by its
 * angle: following the corners of a vertex goes once around it. corner[j]: the crease after facet_edge[j] around
 * facet_vertex[j], as a position in the facet lists, found over the edge's other facet. */
static rg_status walk_loops(rg_mesh *m, const int32_t *inner)
{
    const int32_t corners = m->facet_start[m->nf];
    int32_t *leaving, *first, *before;
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(leaving, 2 * (size_t)m->ne), RG_ARRAY(first, (size_t)m->nv),
                                RG_ARRAY(before, (size_t)corners));
    if (s != RG_OK) goto out;
    for (int32_t v = 0; v < m->nv; v++) first[v] = -1;
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const int32_t e = m->facet_edge[j], v = m->facet_vertex[j];
            leaving[2 * e + (m->edge[e][0] != v)] = j;
            before[j] = j > m->facet_start[f] ? j - 1 : m->facet_start[f + 1] - 1;
            if (first[v] < 0 || m->edge_crease[e] < m->edge_crease[m->facet_edge[first[v]]]) first[v] = j;
        }
    int32_t at = 0, k = 0;
    for (int32_t v = 0; v < m->nv; v++) {
        if (!inner[v]) continue;
        m->inner_vertex[k] = v;
        int32_t j = first[v];
        do {
            const int32_t arriving = m->facet_edge[before[j]];
            m->loop_crease[at++] = m->edge_crease[m->facet_edge[j]];
            j = leaving[2 * arriving + (m->edge[arriving][0] != v)];
        } while (j != first[v]);
        m->loop_start[++k] = at;
    }
    rg_mesh_sectors(m, m->X, m->loop_theta);
out:
    RG_MEM_FREE(&m->mem, leaving, first, before);
    return s;
}

rg_status rg_mesh_connect(rg_mesh *m)
{
    rg_status s = join_facets(m);
    if (s != RG_OK) return s;
    int32_t *inner = rg_mem_array(&m->mem, (size_t)m->nv, sizeof *inner), spokes = 0;
    if (!inner) return RG_ENOMEM;
    for (int32_t v = 0; v < m->nv; v++) inner[v] = 1;
    for (int32_t e = 0; e < m->ne; e++)
        if (m->edge_crease[e] < 0) inner[m->edge[e][0]] = inner[m->edge[e][1]] = 0;
    for (int32_t v = 0; v < m->nv; v++) m->M += inner[v];
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t *v = m->edge[m->crease_edge[i]];
        spokes += inner[v[0]] + inner[v[1]];
    }
    s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->inner_vertex, (size_t)m->M), RG_ARRAY(m->loop_start, (size_t)m->M + 1),
                      RG_ARRAY(m->loop_crease, (size_t)spokes), RG_ARRAY(m->loop_theta, (size_t)spokes));
    if (s == RG_OK) s = walk_loops(m, inner);
    rg_mem_free(&m->mem, inner);
    return s;
}
