#include "pattern/pieces.h"
#include "base/classes.h"
#include "base/status.h"
#include "pattern/faces.h"

#include <stdlib.h>
#include <string.h>

/* What hangs together, by the lowest of its vertices. */
typedef struct part {
    int32_t lowest;
    int32_t outside; /* a half-edge of its outer border; -1: it has none */
    int32_t sheet;   /* the piece that it belongs to, from 0; -1: none */
    int32_t around;  /* the part around it that lies in no other; itself: there is none */
    rg_vec2 low, high;
    double area;
} part;

typedef struct drawing {
    const rg_graph *g;
    const rg_faces *faces;
    int32_t *of;   /* [nv] the part of a vertex */
    part *part;    /* [parts] by their lowest vertices */
    int32_t parts;
} drawing;

/* Does a ray from x cross the outer border of a part an odd number of times? */
static int encloses(const drawing *d, const part *p, rg_vec2 x)
{
    int odd = 0;
    int32_t h = p->outside;
    if (!(x.x >= p->low.x && x.x <= p->high.x && x.y >= p->low.y && x.y <= p->high.y)) return 0;
    do {
        const rg_vec2 a = d->g->X[rg_tail(d->g->E, h)], b = d->g->X[rg_head(d->g->E, h)];
        if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
        h = d->faces->next[h];
    } while (h != p->outside);
    return odd;
}

static rg_status find_parts(drawing *d)
{
    const rg_graph *g = d->g;
    for (int32_t v = 0; v < g->nv; v++) d->of[v] = v;
    for (int32_t e = 0; e < g->ne; e++) {
        if (e + RG_SOON < g->ne) rg_mem_soon(&d->of[g->E[e + RG_SOON].v[1]]);
        rg_class_join(d->of, g->E[e].v[0], g->E[e].v[1]);
    }
    for (int32_t v = 0; v < g->nv; v++) d->parts += (d->of[v] = rg_class_of(d->of, v)) == v;
    d->part = rg_mem_array(&g->mem, (size_t)d->parts, sizeof *d->part);
    if (!d->part) return RG_ENOMEM;
    int32_t parts = 0;
    for (int32_t v = 0; v < g->nv; v++) { /* the lowest of a part comes before the others */
        const int is_first = d->of[v] == v;
        d->of[v] = is_first ? parts++ : d->of[d->of[v]];
        part *p = &d->part[d->of[v]];
        if (is_first) *p = (part){v, -1, -1, d->of[v], g->X[v], g->X[v], 0};
        p->low = (rg_vec2){fmin(p->low.x, g->X[v].x), fmin(p->low.y, g->X[v].y)};
        p->high = (rg_vec2){fmax(p->high.x, g->X[v].x), fmax(p->high.y, g->X[v].y)};
    }
    for (int32_t k = 0; k < d->faces->count; k++) {
        if (!(d->faces->area[k] < 0)) continue;
        part *p = &d->part[d->of[rg_tail(g->E, d->faces->first[k])]];
        if (d->faces->area[k] < p->area) p->area = d->faces->area[k], p->outside = d->faces->first[k];
    }
    return RG_OK;
}

typedef struct sized { double area; int32_t k; } sized;

static int by_area(const void *a, const void *b)
{
    const sized *p = a, *q = b;
    return p->area != q->area ? (p->area < q->area ? -1 : 1) : (p->k > q->k) - (p->k < q->k);
}

/* The largest come first: what is around a part is known before it, and is asked of the outmost ones only. */
static rg_status find_outmost(drawing *d)
{
    sized *all;
    int32_t *outmost, count = 0;
    const rg_status s = RG_MEM_ARRAYS(&d->g->mem, RG_ARRAY(all, (size_t)d->parts), RG_ARRAY(outmost, (size_t)d->parts));
    for (int32_t k = 0; s == RG_OK && k < d->parts; k++) all[k] = (sized){d->part[k].area, k};
    if (s == RG_OK && d->parts > 0) qsort(all, (size_t)d->parts, sizeof *all, by_area);
    for (int32_t n = 0; s == RG_OK && n < d->parts; n++) {
        part *own = &d->part[all[n].k];
        for (int32_t i = 0; own->around == all[n].k && i < count; i++) {
            const part *q = &d->part[outmost[i]];
            if (q->area < own->area && encloses(d, q, d->g->X[own->lowest])) own->around = outmost[i];
        }
        if (own->around == all[n].k && own->outside >= 0) outmost[count++] = all[n].k;
    }
    RG_MEM_FREE(&d->g->mem, all, outmost);
    return s;
}

/* Sheets are numbered as their first lines come in the file. */
static rg_status number(drawing *d, const rg_lines *lines, rg_piece **piece, int32_t *pieces)
{
    const rg_graph *g = d->g;
    size_t room = 0;
    rg_status s = RG_OK;
    for (int32_t e = 0; s == RG_OK && e < g->ne; e++) {
        const int32_t k = d->of[g->E[e].v[0]];
        part *own = &d->part[k];
        if (own->sheet < 0) {
            part *p = &d->part[own->around];
            if (p->outside >= 0 && p->sheet < 0) {
                s = RG_MEM_GROW(&g->mem, *piece, room, (size_t)*pieces + 1);
                if (s != RG_OK) break;
                const rg_vec2 a = rg_lines_own(lines, p->low, g->size), b = rg_lines_own(lines, p->high, g->size);
                (*piece)[*pieces] = (rg_piece){.low = {a.x, fmin(a.y, b.y)}, .high = {b.x, fmax(a.y, b.y)}};
                p->sheet = (*pieces)++;
            }
            own->sheet = p->sheet;
        }
        if (own->sheet >= 0) (*piece)[own->sheet].lines++;
    }
    return s;
}

static rg_status take_one(drawing *d, rg_graph *g, int32_t sheet)
{
    unsigned char *drop = rg_mem_array(&g->mem, (size_t)g->ne, 1);
    if (!drop) return RG_ENOMEM;
    for (int32_t e = 0; e < g->ne; e++) drop[e] = d->part[d->of[g->E[e].v[0]]].sheet != sheet;
    const rg_status s = rg_graph_compact(g, drop);
    rg_mem_free(&g->mem, drop);
    return s;
}

rg_status rg_pieces_find(rg_graph *g, const rg_lines *lines, int32_t take, rg_walk *walk, rg_piece **piece,
                         int32_t *pieces, rg_diag *why)
{
    drawing d = {.g = g, .faces = &walk->faces};
    *piece = NULL;
    *pieces = 0;
    rg_status s = RG_MEM_ARRAYS(&g->mem, RG_ARRAY(d.of, (size_t)g->nv));
    if (s == RG_OK) s = rg_walk_make(walk, &g->mem, g->nv, g->ne, g->X, g->E);
    if (s == RG_OK) s = find_parts(&d);
    if (s == RG_OK) s = find_outmost(&d);
    if (s == RG_OK) s = number(&d, lines, piece, pieces);
    if (s == RG_OK && take > *pieces)
        s = rg_fail(RG_EARG, why, 0, "there is no sheet %d: the drawing has %d", (int)take, (int)*pieces);
    if (s == RG_OK && take > 0) {
        rg_walk_free(walk);
        s = take_one(&d, g, take - 1);
    }
    RG_MEM_FREE(&g->mem, d.of, d.part);
    return s;
}
