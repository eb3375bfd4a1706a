#include "fold/limit.h"

#include <string.h>

rg_status rg_limit_init(rg_limit *l, const rg_memory *mem, const rg_mesh *m)
{
    memset(l, 0, sizeof *l);
    l->mem = *mem;
    l->N = m->N;
    l->first_added = m->N - m->added;
    l->neighbour = rg_mem_array(mem, (size_t)m->added, sizeof *l->neighbour);
    if (!l->neighbour) return RG_ENOMEM;
    for (int32_t a = 0; a < m->added; a++) {
        int32_t e = m->crease_edge[l->first_added + a], n = 0;
        for (int32_t k = 0; k < 4; k++) l->neighbour[a][k] = -1;
        for (int side = 0; side < 2; side++) {
            int32_t f = m->edge_facet[e][side];
            for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
                if (m->facet_edge[j] != e && n < 4) l->neighbour[a][n++] = m->edge_crease[m->facet_edge[j]];
        }
    }
    return RG_OK;
}

void rg_limit_free(rg_limit *l)
{
    if (!l->mem.resize) return;
    rg_mem_free(&l->mem, l->neighbour);
    memset(l, 0, sizeof *l);
}

double rg_limit_pull(const rg_limit *l, const double *rho, double *pull)
{
    double worst = 0;
    for (int32_t i = 0; i < l->N; i++) {
        double low = -RG_PI, high = RG_PI;
        if (i >= l->first_added) {
            const int32_t *near = l->neighbour[i - l->first_added];
            for (int k = 0; k < 4; k++) {
                if (near[k] < 0) continue;
                double angle = rho[near[k]];
                if (angle < 0 && -RG_PI - angle > low) low = -RG_PI - angle;
                if (angle > 0 && RG_PI - angle < high) high = RG_PI - angle;
            }
            if (low > 0) low = 0; /* a neighbour beyond half a turn leaves nothing but flat */
            if (high < 0) high = 0;
        }
        pull[i] = rho[i] < low ? low - rho[i] : rho[i] > high ? high - rho[i] : 0;
        if (fabs(pull[i]) > worst) worst = fabs(pull[i]);
    }
    return worst;
}
