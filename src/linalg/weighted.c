#include "linalg/weighted.h"

#include <string.h>

const double RG_PARTING_MOST = 1.2;
/* The part of its own weight that a separator costs more where it cuts off nothing, against one that halves. */
static const double UNBALANCE = 0.1;

void rg_weighted_free(rg_weighted *g, const rg_memory *mem)
{
    RG_MEM_FREE(mem, g->start, g->to, g->weight, g->edge);
    memset(g, 0, sizeof *g);
}

int rg_weighted_init(rg_weighted *g, const rg_memory *mem, int32_t n, int32_t edges)
{
    *g = (rg_weighted){.n = n};
    return RG_MEM_ARRAYS(mem, RG_ARRAY(g->start, (size_t)n + 1), RG_ARRAY(g->to, (size_t)edges),
                         RG_ARRAY(g->weight, (size_t)n), RG_ARRAY(g->edge, (size_t)edges)) == RG_OK;
}

int rg_weighted_contract(const rg_weighted *g, const rg_memory *mem, const int32_t *of, int32_t fewer, rg_weighted *c)
{
    int32_t *first, *next, *at; /* at: 1 + where the present node's edge to another one is */
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(first, (size_t)fewer), RG_ARRAY(next, (size_t)g->n),
                                      RG_ARRAY(at, (size_t)fewer));
    const int made = s == RG_OK && rg_weighted_init(c, mem, fewer, g->start[g->n]);
    if (made) {
        for (int32_t v = g->n - 1; v >= 0; v--) next[v] = first[of[v]] - 1, first[of[v]] = v + 1;
        int32_t edges = 0;
        for (int32_t k = 0; k < fewer; k++) {
            c->start[k] = edges;
            for (int32_t v = first[k] - 1; v >= 0; v = next[v]) {
                c->weight[k] += g->weight[v];
                for (int32_t j = g->start[v]; j < g->start[v + 1]; j++) {
                    const int32_t l = of[g->to[j]];
                    if (l == k) continue;
                    if (at[l] <= c->start[k]) {
                        c->to[edges] = l;
                        c->edge[edges] = 0;
                        at[l] = ++edges;
                    }
                    c->edge[at[l] - 1] += g->edge[j];
                }
            }
        }
        c->start[fewer] = edges;
        c->total = g->total;
    }
    RG_MEM_FREE(mem, first, next, at);
    return made;
}

void rg_parting_weigh(rg_parting *p)
{
    p->weight[0] = p->weight[1] = p->weight[2] = 0;
    for (int32_t v = 0; v < p->g->n; v++) p->weight[p->part[v]] += p->g->weight[v];
}

double rg_parting_cost(const rg_parting *p)
{
    const double larger = p->weight[0] > p->weight[1] ? p->weight[0] : p->weight[1], half = (double)p->g->total / 2;
    const double over = larger / half - RG_PARTING_MOST;
    return p->weight[2] * (1 + UNBALANCE * larger / half) + (over > 0 ? over * p->g->total : 0);
}
