#include "fold/blame.h"
#include "fold/tuning.h"

#include <stdlib.h>

static int stronger(const void *a, const void *b)
{
    const rg_force *p = a, *q = b;
    if (p->size != q->size) return p->size > q->size ? -1 : 1;
    return p->k < q->k ? -1 : p->k > q->k;
}

int32_t rg_blame_vertices(const rg_mesh *m, const rg_vec3 *C, const double *y, rg_force *by, int32_t *vertex)
{
    int32_t n = 0;
    for (int32_t k = 0; k < m->M; k++) {
        const rg_vec3 reaction = {y[3 * k], y[3 * k + 1], y[3 * k + 2]};
        by[k] = (rg_force){0, k};
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++)
            by[k].size += fabs(rg_vec3_dot(C[j], reaction));
    }
    qsort(by, (size_t)m->M, sizeof *by, stronger);
    while (n < m->M && n < MOST_BLAMED && by[n].size > 0 && by[n].size >= AS_STRONG * by[0].size) {
        vertex[n] = m->inner_vertex[by[n].k];
        n++;
    }
    return n;
}
