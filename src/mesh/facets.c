#include "base/memory.h"
#include "base/status.h"
#include "mesh/connect.h"
#include "pattern/check.h"

#include <string.h>

static rg_status copy_edges(const rg_pattern *p, rg_mesh *m)
{
    const size_t ne = (size_t)p->ne;
    m->nv = p->nv;
    m->ne = p->ne;
    m->X = p->X;
    m->still = p->still;
    rg_status s = RG_MEM_COPIES(&m->mem, RG_ARRAY(m->X, (size_t)p->nv), RG_ARRAY(m->still, ne));
    if (s != RG_OK) return s;
    s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->edge, ne), RG_ARRAY(m->assignment, ne), RG_ARRAY(m->target, ne));
    for (int32_t e = 0; s == RG_OK && e < p->ne; e++) {
        memcpy(m->edge[e], p->E[e].v, sizeof m->edge[e]);
        m->assignment[e] = p->E[e].assignment;
        m->target[e] = p->E[e].target;
    }
    return s;
}

static rg_status copy_facets(const rg_pattern *p, rg_mesh *m)
{
    const size_t nf = (size_t)p->plane.facets, corners = (size_t)p->facet_start[nf];
    m->nf = p->plane.facets;
    m->facet_start = p->facet_start;
    m->facet_vertex = p->facet_vertex;
    m->facet_edge = p->facet_edge;
    return RG_MEM_COPIES(&m->mem, RG_ARRAY(m->facet_start, nf + 1), RG_ARRAY(m->facet_vertex, corners),
                         RG_ARRAY(m->facet_edge, corners));
}

rg_status rg_mesh_from_pattern(const rg_pattern *p, const rg_memory *mem, rg_mesh *m, rg_diag *why)
{
    memset(m, 0, sizeof *m);
    if (!p->info.is_disk) return rg_fail(RG_ESHEET, why, 0, "not one sheet without holes: %s", p->info.not_disk);
    const int32_t crowded = rg_check_crowded(p);
    if (crowded >= 0) {
        char text[200];
        rg_check_crowded_text(p, crowded, text);
        return rg_fail(RG_ESHEET, why, 0, "%s", text);
    }
    m->mem = *mem;
    m->size = p->info.size;
    rg_status s = copy_edges(p, m);
    if (s == RG_OK) s = copy_facets(p, m);
    if (s == RG_OK) s = rg_mesh_connect(m);
    if (s != RG_OK) {
        rg_mesh_free(m);
        rg_fail(s, why, 0, "out of memory");
    }
    return s;
}
