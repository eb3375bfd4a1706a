#include "pattern/alike.h"
#include "base/classes.h"
#include "pattern/maps.h"

#include <string.h>

static void note(rg_likeness *l, const rg_map *g)
{
    if (!g->mirror) {
        l->turns++;
        return;
    }
    double line = fmod(atan2(g->s, g->c) / 2 / RG_DEG + 360, 180);
    if (line > 180 - 1e-6) line = 0;
    int32_t i = l->mirrors < RG_MOST_MIRRORS ? l->mirrors : RG_MOST_MIRRORS;
    l->mirrors++;
    for (; i > 0 && l->mirror[i - 1] > line; i--)
        if (i < RG_MOST_MIRRORS) l->mirror[i] = l->mirror[i - 1];
    if (i < RG_MOST_MIRRORS) l->mirror[i] = line;
}

static void join(int32_t *up, int32_t n, const int32_t *to)
{
    for (int32_t i = 0; i < n; i++) rg_class_join(up, i, to[i]);
}

/* up: scratch, [ne] and [nv] towards the least of an orbit. */
static void count_orbits(const rg_pattern *p, const rg_maps *g, int32_t *edge_up, int32_t *vertex_up, rg_alike *a)
{
    for (int32_t e = 0; e < p->ne; e++) edge_up[e] = e;
    for (int32_t v = 0; v < p->nv; v++) vertex_up[v] = v;
    for (int32_t n = 0; n < g->count; n++) {
        join(vertex_up, p->nv, g->vertex + (size_t)n * (size_t)p->nv);
        join(edge_up, p->ne, g->edge + (size_t)n * (size_t)p->ne);
    }
    for (int32_t e = 0; e < p->ne; e++) a->creases += edge_up[e] == e && p->E[e].assignment != RG_BORDER;
    for (int32_t v = 0; v < p->nv; v++) a->vertices += vertex_up[v] == v && !p->rim[v];
}

rg_status rg_alike_find(const rg_pattern *p, rg_alike *a)
{
    rg_maps g;
    memset(a, 0, sizeof *a);
    int32_t *edge_up, *vertex_up;
    rg_status s = RG_MEM_ARRAYS(&p->mem, RG_ARRAY(edge_up, (size_t)p->ne), RG_ARRAY(vertex_up, (size_t)p->nv));
    if (s == RG_OK) s = rg_maps_find(&g, &p->mem, p->nv, p->X, p->ne, p->E, RG_SAME_PLACE * p->info.size);
    if (s == RG_OK) {
        for (int32_t n = 0; n < g.count; n++) note(g.map[n].keeps ? &a->same : &a->exchanged, &g.map[n]);
        a->order = g.count;
        count_orbits(p, &g, edge_up, vertex_up, a);
        rg_maps_free(&g);
    }
    RG_MEM_FREE(&p->mem, edge_up, vertex_up);
    return s;
}
