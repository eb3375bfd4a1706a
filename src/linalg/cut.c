#include "linalg/cut.h"

#include <math.h>
#include <string.h>

/* Layers of neighbours beside a separator among which a better one is looked for. */
static const int32_t LAYERS = 20;

/* Side 2 v of node v is that where it is entered, 2 v + 1 that where it is left. */
typedef struct flow {
    int32_t n;                 /* nodes in the band */
    int32_t *node;             /* [n] */
    int32_t *local;            /* [nodes of the graph] 1 + number in the band, 0: outside */
    int32_t *from_a, *to_b;    /* [n] has a neighbour in what is left of part 0, of part 1 */
    int32_t *start, *to, *back, *f; /* edges of the band, the same the other way round, flow along them */
    int32_t *through;          /* [n] */
    int32_t *level, *next, *queue; /* [2 n]: distance from part 0, edge to try next */
} flow;

static void free_flow(const rg_memory *mem, flow *F)
{
    RG_MEM_FREE(mem, F->node, F->local, F->from_a, F->to_b, F->start, F->to, F->back, F->f, F->through, F->level,
                F->next, F->queue);
}

/* The separator and LAYERS layers of neighbours on both sides, as far as parts stay large enough. */
static int make_band(const rg_memory *mem, const rg_parting *p, flow *F)
{
    const rg_weighted *g = p->g;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(F->node, (size_t)g->n), RG_ARRAY(F->local, (size_t)g->n)) != RG_OK) return 0;
    for (int32_t v = 0; v < g->n; v++)
        if (p->part[v] == RG_SEPARATOR) F->node[F->n] = v, F->local[v] = ++F->n;
    int32_t left[2];
    for (int i = 0; i < 2; i++) left[i] = p->weight[i] - (int32_t)((1 - RG_PARTING_MOST / 2) * g->total);
    for (int32_t layer = 0, from = 0; layer < LAYERS; layer++)
        for (const int32_t to = F->n; from < to; from++) {
            const int32_t v = F->node[from];
            for (int32_t j = g->start[v]; j < g->start[v + 1]; j++) {
                const int32_t u = g->to[j], part = p->part[u];
                if (F->local[u] || g->weight[u] > left[part]) continue;
                left[part] -= g->weight[u];
                F->node[F->n] = u;
                F->local[u] = ++F->n;
            }
        }
    int32_t edges = 0;
    for (int32_t i = 0; i < F->n; i++) edges += g->start[F->node[i] + 1] - g->start[F->node[i]];
    const size_t n = (size_t)F->n, e = (size_t)edges;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(F->from_a, n), RG_ARRAY(F->to_b, n), RG_ARRAY(F->start, n + 1),
                      RG_ARRAY(F->to, e), RG_ARRAY(F->back, e), RG_ARRAY(F->f, e), RG_ARRAY(F->through, n),
                      RG_ARRAY(F->level, 2 * n), RG_ARRAY(F->next, 2 * n), RG_ARRAY(F->queue, 2 * n)) != RG_OK)
        return 0;
    int32_t *at = F->next;
    for (int32_t i = 0; i < F->n; i++) {
        const int32_t v = F->node[i];
        F->start[i + 1] = F->start[i];
        for (int32_t j = g->start[v]; j < g->start[v + 1]; j++) {
            const int32_t u = g->to[j];
            if (F->local[u]) F->start[i + 1]++;
            else if (p->part[u] == 0) F->from_a[i] = 1;
            else F->to_b[i] = 1;
        }
    }
    for (int32_t i = 0; i < F->n; i++) at[i] = F->start[i];
    for (int32_t i = 0; i < F->n; i++) /* so that each list is rising ... */
        for (int32_t v = F->node[i], j = g->start[v]; j < g->start[v + 1]; j++)
            if (F->local[g->to[j]]) F->to[at[F->local[g->to[j]] - 1]++] = i;
    for (int32_t i = 0; i < F->n; i++) at[i] = F->start[i];
    for (int32_t i = 0; i < F->n; i++) /* ... and is met in its own order */
        for (int32_t j = F->start[i]; j < F->start[i + 1]; j++) F->back[j] = at[F->to[j]]++;
    return 1;
}

/* Levels by distance from part 0. Non-zero: part 1 can be reached. */
static int find_levels(const rg_parting *p, flow *F)
{
    int32_t count = 0;
    int reached = 0;
    for (int32_t x = 0; x < 2 * F->n; x++) F->level[x] = -1;
    for (int32_t v = 0; v < F->n; v++)
        if (F->from_a[v]) F->level[2 * v] = 0, F->queue[count++] = 2 * v;
    for (int32_t at = 0; at < count; at++) {
        const int32_t x = F->queue[at], v = x / 2, weight = p->g->weight[F->node[v]];
        const int32_t other = x ^ 1;
        if ((x & 1) && F->to_b[v]) reached = 1;
        if (F->level[other] < 0 && ((x & 1) ? F->through[v] > 0 : F->through[v] < weight))
            F->level[other] = F->level[x] + 1, F->queue[count++] = other;
        for (int32_t j = F->start[v]; j < F->start[v + 1]; j++) {
            const int32_t y = 2 * F->to[j] + !(x & 1); /* out to in; or back, where something came in */
            if (F->level[y] >= 0 || (!(x & 1) && F->f[F->back[j]] == 0)) continue;
            F->level[y] = F->level[x] + 1;
            F->queue[count++] = y;
        }
    }
    return reached;
}

/* One way more from in-side `first` to part 1 along rising levels; returns how much went along it. path: scratch. */
static int32_t augment(const rg_parting *p, flow *F, int32_t first, int32_t *path)
{
    int32_t depth = 0, x = first;
    for (;;) {
        const int32_t v = x / 2, out = x & 1;
        if (out && F->to_b[v]) break;
        int32_t y = -1;
        for (; F->next[x] <= F->start[v + 1]; F->next[x]++) {
            const int32_t j = F->next[x];
            if (j == F->start[v + 1]) { /* after all edges, through the node */
                const int can = out ? F->through[v] > 0 : F->through[v] < p->g->weight[F->node[v]];
                if (can && F->level[x ^ 1] == F->level[x] + 1) y = x ^ 1;
            } else if (out || F->f[F->back[j]] > 0) {
                const int32_t z = 2 * F->to[j] + !out;
                if (F->level[z] == F->level[x] + 1) y = z;
            }
            if (y >= 0) break;
        }
        if (y >= 0) {
            path[depth++] = x;
            x = y;
        } else {
            if (depth == 0) return 0;
            x = path[--depth];
            F->next[x]++; /* that way is a dead end */
        }
    }
    path[depth] = x;
    int32_t most = INT32_MAX;
    for (int32_t i = 0; i < depth; i++) {
        const int32_t v = path[i] / 2, j = F->next[path[i]];
        int32_t room = INT32_MAX;
        if (j == F->start[v + 1]) room = path[i] & 1 ? F->through[v] : p->g->weight[F->node[v]] - F->through[v];
        else if (!(path[i] & 1)) room = F->f[F->back[j]];
        if (room < most) most = room;
    }
    for (int32_t i = 0; i < depth; i++) {
        const int32_t v = path[i] / 2, j = F->next[path[i]];
        if (j == F->start[v + 1]) F->through[v] += path[i] & 1 ? -most : most;
        else if (path[i] & 1) F->f[j] += most;
        else F->f[F->back[j]] -= most;
    }
    return most;
}

/* Levels by distance to part 1, against the stream. */
static void find_levels_back(const rg_parting *p, flow *F)
{
    int32_t count = 0;
    for (int32_t x = 0; x < 2 * F->n; x++) F->level[x] = -1;
    for (int32_t v = 0; v < F->n; v++)
        if (F->to_b[v]) F->level[2 * v + 1] = 0, F->queue[count++] = 2 * v + 1;
    for (int32_t at = 0; at < count; at++) {
        const int32_t x = F->queue[at], v = x / 2, out = x & 1, weight = p->g->weight[F->node[v]];
        if (F->level[x ^ 1] < 0 && (out ? F->through[v] < weight : F->through[v] > 0))
            F->level[x ^ 1] = 0, F->queue[count++] = x ^ 1;
        for (int32_t j = F->start[v]; j < F->start[v + 1]; j++) {
            const int32_t y = 2 * F->to[j] + !out;
            if (F->level[y] >= 0 || (out && F->f[j] == 0)) continue;
            F->level[y] = 0;
            F->queue[count++] = y;
        }
    }
}

int rg_cut(rg_parting *p, const rg_memory *mem, int32_t *spare)
{
    flow F = {0};
    const int made = make_band(mem, p, &F);
    if (made) {
        memcpy(spare, p->part, (size_t)p->g->n * sizeof *spare);
        while (find_levels(p, &F)) {
            for (int32_t x = 0; x < 2 * F.n; x++) F.next[x] = F.start[x / 2];
            for (int32_t v = 0; v < F.n; v++)
                while (F.from_a[v] && augment(p, &F, 2 * v, F.queue) > 0) {}
        }
        const double before = rg_parting_cost(p);
        for (int32_t v = 0; v < F.n; v++) /* the cut next to part 0 */
            p->part[F.node[v]] = F.level[2 * v + 1] >= 0 ? 0 : F.level[2 * v] >= 0 ? RG_SEPARATOR : 1;
        rg_parting_weigh(p);
        const double near = rg_parting_cost(p);
        find_levels_back(p, &F);
        if (near < before) for (int32_t v = 0; v < F.n; v++) spare[F.node[v]] = p->part[F.node[v]];
        for (int32_t v = 0; v < F.n; v++) /* that next to part 1 */
            p->part[F.node[v]] = F.level[2 * v] >= 0 ? 1 : F.level[2 * v + 1] >= 0 ? RG_SEPARATOR : 0;
        rg_parting_weigh(p);
        if (!(rg_parting_cost(p) < fmin(before, near))) {
            memcpy(p->part, spare, (size_t)p->g->n * sizeof *spare);
            rg_parting_weigh(p);
        }
    }
    free_flow(mem, &F);
    return made;
}
