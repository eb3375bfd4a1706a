#include "linalg/dissect.h"
#include "linalg/separator.h"

#include <string.h>

/* Parts of so many unknowns are left to minimum degree. */
static const int32_t LEAF = 200;
/* A part that has more than this of the whole is no part: a graph so dense is not dissected. */
static const double LARGEST_PART = 0.9;

/* The nodes of one part. id, of: numbers in the whole, of nodes of g and of the part's. */
static int take_part(const rg_memory *mem, const rg_weighted *g, const int32_t *part, int32_t which, const int32_t *id,
                     int32_t *fresh, rg_weighted *c, int32_t **of)
{
    int32_t n = 0, edges = 0;
    for (int32_t v = 0; v < g->n; v++)
        if (part[v] == which) fresh[v] = n++, edges += g->start[v + 1] - g->start[v];
    *of = rg_mem_array(mem, (size_t)n, sizeof **of);
    if (!*of || !rg_weighted_init(c, mem, n, edges)) return 0;
    edges = n = 0;
    for (int32_t v = 0; v < g->n; v++) {
        if (part[v] != which) continue;
        (*of)[n] = id[v];
        c->start[n] = edges;
        c->weight[n] = g->weight[v];
        c->total += g->weight[v];
        for (int32_t j = g->start[v]; j < g->start[v + 1]; j++)
            if (part[g->to[j]] == which) c->to[edges] = fresh[g->to[j]], c->edge[edges++] = g->edge[j];
        n++;
    }
    c->start[n] = edges;
    return 1;
}

/* g and id are taken over. */
static int dissect(const rg_memory *mem, rg_weighted *g, int32_t *id, int32_t *set, int32_t *sets)
{
    const int32_t n = g->n;
    int done = 0, parted = 0;
    int32_t *part = NULL, *fresh = NULL, *of[2] = {NULL, NULL}, weight[3] = {0};
    rg_weighted half[2] = {{0}, {0}};
    if (g->total > LEAF) {
        if (RG_MEM_ARRAYS(mem, RG_ARRAY(part, (size_t)n), RG_ARRAY(fresh, (size_t)n)) != RG_OK) goto out;
        if (!rg_separate(g, mem, part)) goto out;
        for (int32_t v = 0; v < n; v++) weight[part[v]] += g->weight[v];
        parted = 1;
        for (int32_t k = 0; k < 2; k++) parted &= weight[k] > 0 && weight[k] <= LARGEST_PART * g->total;
    }
    if (parted) {
        for (int32_t k = 0; k < 2; k++)
            if (!take_part(mem, g, part, k, id, fresh, &half[k], &of[k])) goto out;
        rg_weighted_free(g, mem);
        for (int32_t k = 0; k < 2; k++) {
            int32_t *taken = of[k];
            of[k] = NULL;
            if (!dissect(mem, &half[k], taken, set, sets)) goto out;
        }
    }
    for (int32_t v = 0; v < n; v++)
        if (!parted || part[v] == RG_SEPARATOR) set[id[v]] = *sets;
    ++*sets;
    done = 1;
out:
    rg_weighted_free(g, mem);
    for (int32_t k = 0; k < 2; k++) rg_weighted_free(&half[k], mem), rg_mem_free(mem, of[k]);
    RG_MEM_FREE(mem, part, fresh, id);
    return done;
}

/* of[n]: out, one number for nodes that are neighbours and have the same other ones, as the equations of one vertex do.
 * met[n]: scratch, zero. Returns how many numbers. */
static int32_t alike(int32_t n, const int32_t *start, const int32_t *to, int32_t *of, uint32_t *sum, int32_t *met)
{
    int32_t fewer = 0;
    for (int32_t v = 0; v < n; v++) {
        sum[v] = (uint32_t)v;
        for (int32_t j = start[v]; j < start[v + 1]; j++) sum[v] += (uint32_t)to[j];
    }
    for (int32_t v = 0; v < n; v++) {
        int marked = 0;
        of[v] = -1;
        for (int32_t j = start[v]; j < start[v + 1] && of[v] < 0; j++) {
            const int32_t u = to[j];
            if (u > v || sum[u] != sum[v] || start[u + 1] - start[u] != start[v + 1] - start[v]) continue;
            if (!marked) {
                for (int32_t k = start[v]; k < start[v + 1]; k++) met[to[k]] = v + 1;
                met[v] = v + 1;
                marked = 1;
            }
            int32_t k = start[u];
            while (k < start[u + 1] && met[to[k]] == v + 1) k++;
            if (k == start[u + 1]) of[v] = of[u];
        }
        if (of[v] < 0) of[v] = fewer++;
    }
    return fewer;
}

int32_t rg_dissect(const rg_memory *mem, int32_t n, const int32_t *start, const int32_t *to, int32_t *set)
{
    const int32_t edges = start[n];
    int32_t *of, *met, *id = NULL, *few = NULL, sets = -1;
    uint32_t *sum;
    rg_weighted all = {0}, g = {0};
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(of, (size_t)n), RG_ARRAY(met, (size_t)n), RG_ARRAY(sum, (size_t)n));
    if (s != RG_OK || !rg_weighted_init(&all, mem, n, edges)) goto out;
    memcpy(all.start, start, ((size_t)n + 1) * sizeof *start);
    memcpy(all.to, to, (size_t)edges * sizeof *to);
    for (int32_t v = 0; v < n; v++) all.weight[v] = 1;
    for (int32_t j = 0; j < edges; j++) all.edge[j] = 1;
    all.total = n;
    const int32_t fewer = alike(n, start, to, of, sum, met);
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(id, (size_t)fewer), RG_ARRAY(few, (size_t)fewer));
    if (s != RG_OK || !rg_weighted_contract(&all, mem, of, fewer, &g)) goto out;
    rg_weighted_free(&all, mem);
    for (int32_t v = 0; v < fewer; v++) id[v] = v;
    sets = 0;
    int32_t *taken = id;
    id = NULL;
    if (!dissect(mem, &g, taken, few, &sets)) sets = -1;
    for (int32_t v = 0; v < n && sets >= 0; v++) set[v] = few[of[v]];
out:
    rg_weighted_free(&all, mem);
    rg_weighted_free(&g, mem);
    RG_MEM_FREE(mem, of, met, id, few, sum);
    return sets;
}
