#include "mesh/components.h"
#include "base/classes.h"

static void join_at_vertices(const rg_mesh *m, int32_t *up)
{
    for (int32_t k = 0; k < m->M; k++)
        for (int32_t j = m->loop_start[k] + 1; j < m->loop_start[k + 1]; j++)
            rg_class_join(up, m->loop_crease[j - 1], m->loop_crease[j]);
}

static void join_at_added(const rg_mesh *m, int32_t *up)
{
    for (int32_t i = m->N - m->added; i < m->N; i++)
        for (int side = 0; side < 2; side++) {
            const int32_t f = m->edge_facet[m->crease_edge[i]][side];
            for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
                if (m->edge_crease[m->facet_edge[j]] >= 0) rg_class_join(up, i, m->edge_crease[m->facet_edge[j]]);
        }
}

/* Creases that reach no interior vertex and no triangle are groups of one; they are made one group. */
static rg_status join_single(const rg_mesh *m, int32_t *up)
{
    int32_t *size = rg_mem_array(&m->mem, (size_t)m->N, sizeof *size), first = -1;
    if (!size) return RG_ENOMEM;
    for (int32_t i = 0; i < m->N; i++) size[rg_class_of(up, i)]++;
    for (int32_t i = 0; i < m->N; i++) {
        if (rg_class_of(up, i) != i || size[i] > 1) continue;
        if (first >= 0) rg_class_join(up, first, i);
        else first = i;
    }
    rg_mem_free(&m->mem, size);
    return RG_OK;
}

static int32_t number(const rg_mesh *m, int32_t *up)
{
    int32_t count = 0;
    for (int32_t i = 0; i < m->N; i++) up[i] = rg_class_of(up, i);
    for (int32_t i = 0; i < m->N; i++) up[i] = up[i] == i ? count++ : up[up[i]];
    return count;
}

int32_t rg_components_find(const rg_mesh *m, int32_t *part)
{
    for (int32_t i = 0; i < m->N; i++) part[i] = i;
    join_at_vertices(m, part);
    return number(m, part);
}

rg_status rg_components_find_coarse(const rg_mesh *m, int32_t *part, int32_t *count)
{
    for (int32_t i = 0; i < m->N; i++) part[i] = i;
    join_at_vertices(m, part);
    join_at_added(m, part);
    const rg_status s = join_single(m, part);
    if (s == RG_OK) *count = number(m, part);
    return s;
}
