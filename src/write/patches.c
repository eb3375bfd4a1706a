#include "write/patches.h"

#include <string.h>

/* From the plane to the pattern: the other way of an isometry. */
static rg_vec2 unfolded(const rg_isometry *q, rg_vec2 x)
{
    const rg_vec2 d = rg_vec2_sub(x, q->t);
    return (rg_vec2){rg_vec2_dot(d, q->c[0]), rg_vec2_dot(d, q->c[1])};
}

/* Over a cell, the facet that all others lie on the one side of; by level: the highest (side > 0) or lowest. */
static int32_t outermost(const rg_layers *l, int32_t cell, int side, const int32_t *level)
{
    const rg_cells *c = &l->cells;
    int32_t best = c->over[c->over_start[cell]];
    for (int32_t i = c->over_start[cell] + 1; i < c->over_start[cell + 1]; i++) {
        const int32_t f = c->over[i];
        if (side * (level ? level[f] - level[best] : rg_layers_above(l, best, f)) > 0) best = f;
    }
    return best;
}

/* The mesh's edge of facet f that lies along a segment. */
static int32_t edge_along(const rg_layers *l, int32_t segment, int32_t f)
{
    const rg_cells *c = &l->cells;
    for (int32_t i = c->along_start[segment]; i < c->along_start[segment + 1]; i++) {
        const int32_t e = c->along[i];
        if (l->flat.beside[e][0] == f || l->flat.beside[e][1] == f) return e;
    }
    return -1;
}

static rg_status add(rg_patches *p, const rg_layers *l, int32_t cell, int32_t f, int32_t raise)
{
    const rg_cells *c = &l->cells;
    const size_t k = (size_t)p->count;
    int32_t n = p->start ? p->start[k] : 0, h = c->faces.first[cell];
    const int32_t from = n;
    rg_status s = RG_MEM_GROW(&p->mem, p->facet, p->room[0], k + 1);
    if (s == RG_OK) s = RG_MEM_GROW(&p->mem, p->raise, p->room[1], k + 1);
    if (s == RG_OK) s = RG_MEM_GROW(&p->mem, p->start, p->room[2], k + 2);
    do {
        if (s == RG_OK) s = RG_MEM_GROW(&p->mem, p->edge, p->room[3], (size_t)n + 1);
        if (s == RG_OK) s = RG_MEM_GROW(&p->mem, p->corner, p->room[4], (size_t)n + 1);
        if (s != RG_OK) return s;
        p->corner[n] = unfolded(&l->flat.place[f], c->graph.X[rg_tail(c->graph.E, h)]);
        p->edge[n++] = edge_along(l, h >> 1, f);
        h = c->faces.next[h];
    } while (h != c->faces.first[cell]);
    /* Turned over, the facet runs the other way: its sides are those before its corners. */
    for (int32_t i = from, j = n - 1; l->flat.up[f] < 0 && i < j; i++, j--) {
        const rg_vec2 x = p->corner[i];
        p->corner[i] = p->corner[j], p->corner[j] = x;
    }
    for (int32_t i = from, j = n - 2; l->flat.up[f] < 0 && i < j; i++, j--) {
        const int32_t e = p->edge[i];
        p->edge[i] = p->edge[j], p->edge[j] = e;
    }
    p->facet[k] = l->flat.part[l->flat.part_start[f]];
    p->raise[k] = raise;
    p->start[k] = from;
    p->start[k + 1] = n;
    p->count++;
    return RG_OK;
}

rg_status rg_patches_init(rg_patches *p, const rg_memory *mem, const rg_layers *l)
{
    const rg_cells *c = &l->cells;
    int32_t cuts = 0, *level = rg_mem_array(mem, (size_t)l->flat.nf, sizeof *level);
    *p = (rg_patches){.mem = *mem};
    const int32_t levels = level ? rg_layers_levels(l, level, &cuts) : -1;
    rg_status s = levels < 0 ? RG_ENOMEM : RG_OK;
    for (int32_t k = 0; s == RG_OK && cuts > 0 && k < c->faces.count; k++)
        for (int side = -1; s == RG_OK && side <= 1 && c->over_start[k + 1] > c->over_start[k] + 1; side += 2) {
            const int32_t f = outermost(l, k, side, NULL);
            if (f != outermost(l, k, side, level)) s = add(p, l, k, f, side > 0 ? levels - level[f] : -1 - level[f]);
        }
    for (int32_t f = 1; s == RG_OK && p->apart == 0 && f < l->flat.nf; f++) {
        p->low = l->flat.part[l->flat.part_start[0]], p->high = l->flat.part[l->flat.part_start[f]];
        p->apart = level[f] - level[0];
    }
    rg_mem_free(mem, level);
    return s;
}

void rg_patches_free(rg_patches *p)
{
    void *block[] = {p->facet, p->raise, p->start, p->edge, p->corner};
    for (int i = 0; p->mem.resize && i < 5; i++) rg_mem_free(&p->mem, block[i]);
    *p = (rg_patches){0};
}
