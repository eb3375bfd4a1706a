#include "pattern/graph.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Nothing left: as it was. */
static void measure(rg_graph *g)
{
    if (g->nv == 0) return;
    rg_vec2 low = g->X[0], high = low;
    for (int32_t v = 1; v < g->nv; v++) {
        low = (rg_vec2){fmin(low.x, g->X[v].x), fmin(low.y, g->X[v].y)};
        high = (rg_vec2){fmax(high.x, g->X[v].x), fmax(high.y, g->X[v].y)};
    }
    g->size = fmax(high.x - low.x, high.y - low.y);
}

rg_status rg_graph_compact(rg_graph *g, const unsigned char *drop)
{
    int32_t *number = rg_mem_array(&g->mem, (size_t)g->nv, sizeof *number);
    if (!number) return RG_ENOMEM;
    int32_t n = 0;
    for (int32_t e = 0; e < g->ne; e++)
        if (!drop[e]) g->E[n++] = g->E[e];
    g->ne = n;
    for (int32_t e = 0; e < n; e++) {
        if (e + RG_SOON < n) rg_mem_soon(&number[g->E[e + RG_SOON].v[1]]);
        number[g->E[e].v[0]] = number[g->E[e].v[1]] = 1;
    }
    n = 0;
    for (int32_t v = 0; v < g->nv; v++) {
        if (!number[v]) continue;
        g->X[n] = g->X[v];
        number[v] = n++;
    }
    g->nv = n;
    for (int32_t e = 0; e < g->ne; e++)
        for (int i = 0; i < 2; i++) {
            if (e + RG_SOON < g->ne) rg_mem_soon(&number[g->E[e + RG_SOON].v[i]]);
            g->E[e].v[i] = number[g->E[e].v[i]];
        }
    rg_mem_free(&g->mem, number);
    measure(g);
    return RG_OK;
}

void rg_graph_free(rg_graph *g)
{
    if (!g->mem.resize) return;
    RG_MEM_FREE(&g->mem, g->X, g->E);
    memset(g, 0, sizeof *g);
}
