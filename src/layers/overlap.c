#include "layers/overlap.h"

#include <string.h>

void rg_overlaps_free(rg_overlaps *o)
{
    if (!o->mem.resize) return;
    const rg_memory mem = o->mem;
    RG_MEM_FREE(&mem, o->start, o->loop, o->corner);
    memset(o, 0, sizeof *o);
}

typedef struct walk {
    const rg_cells *c;
    int32_t *start, *cell;  /* [nf + 2]: the cells under each facet, rising */
    int32_t *in;            /* [cells] the pair that has this cell, + 1 */
    int32_t *seen;          /* [2 segments] the pair whose border was walked along this half-edge, + 1 */
} walk;

static int on_border(const walk *w, int32_t h, int32_t mark)
{
    return w->in[w->c->faces.face[h]] == mark && w->in[w->c->faces.face[h ^ 1]] != mark;
}

static rg_status add_corner(rg_overlaps *o, rg_vec2 x)
{
    const rg_status s = rg_mem_grow(&o->mem, (void **)&o->corner, &o->corner_room, (size_t)o->corners + 1, sizeof *o->corner);
    if (s == RG_OK) o->corner[o->corners++] = x;
    return s;
}

/* Corners of the loop from `first` on that lie in the line of those beside them only cut it. */
static void drop_straight(rg_overlaps *o, int32_t first, double tol)
{
    int32_t n = o->corners - first;
    rg_vec2 *x = o->corner + first;
    for (int32_t i = 0; n > 3 && i < n;) {
        const rg_vec2 a = x[(i + n - 1) % n], b = x[(i + 1) % n], d = rg_vec2_sub(b, a);
        if (!(fabs(rg_vec2_cross(d, rg_vec2_sub(x[i], a))) <= tol * rg_vec2_length(d))) {
            i++;
            continue;
        }
        memmove(x + i, x + i + 1, (size_t)(n - i - 1) * sizeof *x);
        n--;
        if (i) i--;
    }
    o->corners = first + n;
}

/* The border of the marked cells, from half-edge h back to it: round each end over the marked cells that meet there. */
static rg_status walk_loop(rg_overlaps *o, walk *w, int32_t h, int32_t mark)
{
    const rg_cells *c = w->c;
    const int32_t first = o->corners;
    rg_status s = RG_OK;
    for (int32_t g = h; s == RG_OK && w->seen[g] != mark;) {
        w->seen[g] = mark;
        s = add_corner(o, c->graph.X[rg_tail(c->graph.E, g)]);
        for (g = c->faces.next[g]; !on_border(w, g, mark);) g = c->faces.next[g ^ 1];
    }
    if (s == RG_OK) drop_straight(o, first, c->tol);
    if (s == RG_OK) s = rg_mem_grow(&o->mem, (void **)&o->loop, &o->loop_room, (size_t)o->loops + 2, sizeof *o->loop);
    if (s == RG_OK) o->loop[o->loops++] = first, o->loop[o->loops] = o->corners;
    return s;
}

static rg_status one_pair(rg_overlaps *o, walk *w, const int32_t *facet, int32_t mark)
{
    const rg_cells *c = w->c;
    rg_status s = RG_OK;
    int32_t j = w->start[facet[1]];
    for (int32_t i = w->start[facet[0]]; i < w->start[facet[0] + 1]; i++) {
        while (j < w->start[facet[1] + 1] && w->cell[j] < w->cell[i]) j++;
        if (j < w->start[facet[1] + 1] && w->cell[j] == w->cell[i]) w->in[w->cell[i]] = mark;
    }
    for (int32_t i = w->start[facet[0]]; s == RG_OK && i < w->start[facet[0] + 1]; i++) {
        if (w->in[w->cell[i]] != mark) continue;
        int32_t h = c->faces.first[w->cell[i]];
        do {
            if (on_border(w, h, mark) && w->seen[h] != mark) s = walk_loop(o, w, h, mark);
            h = c->faces.next[h];
        } while (s == RG_OK && h != c->faces.first[w->cell[i]]);
    }
    return s;
}

rg_status rg_overlaps_init(rg_overlaps *o, const rg_memory *mem, const rg_cells *c, const rg_pairs *p)
{
    memset(o, 0, sizeof *o);
    o->mem = *mem;
    const int32_t cells = c->faces.count;
    walk w = {.c = c};
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(w.start, (size_t)p->nf + 2),
                                RG_ARRAY(w.cell, (size_t)c->over_start[cells]), RG_ARRAY(w.in, (size_t)cells),
                                RG_ARRAY(w.seen, 2 * (size_t)c->graph.ne), RG_ARRAY(o->start, (size_t)p->count + 1));
    if (s == RG_OK) s = rg_mem_grow(mem, (void **)&o->loop, &o->loop_room, 1, sizeof *o->loop);
    if (s == RG_OK) {
        o->loop[0] = 0;
        for (int32_t j = 0; j < c->over_start[cells]; j++) w.start[c->over[j] + 2]++;
        for (int32_t f = 2; f <= p->nf; f++) w.start[f] += w.start[f - 1];
        for (int32_t i = 0; i < cells; i++)
            for (int32_t j = c->over_start[i]; j < c->over_start[i + 1]; j++) w.cell[w.start[c->over[j] + 1]++] = i;
    }
    for (int32_t i = 0; s == RG_OK && i < p->count; i++) {
        s = one_pair(o, &w, p->facet[i], i + 1);
        o->start[i + 1] = o->loops;
    }
    RG_MEM_FREE(mem, w.start, w.cell, w.in, w.seen);
    return s;
}
