#include "mesh/triangles.h"

#include <string.h>

/* Which facet of m each triangle of T belongs to. Old edges keep their numbers and know the facet on either side; from
 * there it spreads over the added edges. queue: [T->nf]. */
static void find_owners(const rg_mesh *m, const rg_mesh *T, int32_t *owner, int32_t *queue)
{
    int32_t head = 0, tail = 0;
    for (int32_t t = 0; t < T->nf; t++) owner[t] = -1;
    for (int32_t e = 0; e < m->ne; e++) {
        const int turned = T->edge[e][0] != m->edge[e][0];
        for (int side = 0; side < 2; side++) {
            const int32_t t = T->edge_facet[e][side ^ turned];
            if (t < 0 || owner[t] >= 0) continue;
            owner[t] = m->edge_facet[e][side];
            queue[tail++] = t;
        }
    }
    while (head < tail) {
        const int32_t t = queue[head++];
        for (int32_t j = T->facet_start[t]; j < T->facet_start[t + 1]; j++) {
            const int32_t e = T->facet_edge[j];
            if (e < m->ne) continue;
            const int32_t next = T->edge_facet[e][T->edge_facet[e][0] == t];
            if (next < 0 || owner[next] >= 0) continue;
            owner[next] = owner[t];
            queue[tail++] = next;
        }
    }
}

static void sort_by_owner(const rg_mesh *m, const rg_mesh *T, const int32_t *owner, rg_triangles *t)
{
    for (int32_t i = 0; i < T->nf; i++)
        if (owner[i] >= 0) t->start[owner[i] + 1]++;
    for (int32_t f = 0; f < m->nf; f++) t->start[f + 1] += t->start[f];
    for (int32_t f = 0; f < m->nf; f++) t->largest[f] = t->start[f]; /* fill pointers, for now */
    for (int32_t i = 0; i < T->nf; i++) {
        if (owner[i] < 0) continue;
        const int32_t *v = T->facet_vertex + T->facet_start[i];
        memcpy(t->v[t->largest[owner[i]]++], v, 3 * sizeof *v);
    }
    for (int32_t f = 0; f < m->nf; f++) {
        double most = -1;
        for (int32_t i = t->start[f]; i < t->start[f + 1]; i++) {
            const double area = rg_vec2_turn(m->X[t->v[i][0]], m->X[t->v[i][1]], m->X[t->v[i][2]]);
            if (area > most) most = area, t->largest[f] = i;
        }
    }
}

rg_status rg_triangles_init(const rg_memory *memory, const rg_mesh *m, rg_triangles *t)
{
    const rg_memory mem = rg_mem_default(memory);
    *t = (rg_triangles){.mem = mem};
    rg_mesh T;
    rg_status s = rg_triangulate_all(m, &T);
    if (s != RG_OK) return s;
    const size_t nf = (size_t)m->nf, nt = (size_t)T.nf;
    int32_t *owner;
    s = RG_MEM_ARRAYS(&mem, RG_ARRAY(owner, 2 * nt), RG_ARRAY(t->start, nf + 1), RG_ARRAY(t->v, nt),
                      RG_ARRAY(t->largest, nf));
    if (s == RG_OK) {
        find_owners(m, &T, owner, owner + nt);
        sort_by_owner(m, &T, owner, t);
    }
    rg_mem_free(&mem, owner);
    rg_mesh_free(&T);
    return s;
}

void rg_triangles_free(rg_triangles *t)
{
    RG_MEM_FREE(&t->mem, t->start, t->v, t->largest);
    *t = (rg_triangles){.mem = t->mem};
}
