#include "pattern/faces.h"
#include "base/order.h"

#include <string.h>

/* Grows with the angle of a direction from -pi to pi, as -2 to 2, and costs no atan2. */
static double turn_of(rg_vec2 d)
{
    const double part = d.y / (fabs(d.x) + fabs(d.y));
    return d.x >= 0 ? part : d.y < 0 || (d.y == 0 && signbit(d.y)) ? -2 - part : 2 - part;
}

rg_status rg_star_init(rg_star *s, const rg_memory *mem, int32_t nv, int32_t ne, const rg_vec2 *X, const rg_edge *E)
{
    memset(s, 0, sizeof *s);
    s->mem = *mem;
    rg_keyed *spokes = NULL;
    size_t room = 0;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(s->start, (size_t)nv + 2), RG_ARRAY(s->edge, 2 * (size_t)ne)) != RG_OK ||
        RG_MEM_GROW(mem, spokes, room, 2 * (size_t)ne) != RG_OK) return RG_ENOMEM;
    int32_t *cursor = s->start + 1;
    for (int32_t e = 0; e < ne; e++)
        for (int i = 0; i < 2; i++) s->start[E[e].v[i] + 2]++;
    for (int32_t v = 2; v <= nv; v++) s->start[v] += s->start[v - 1];
    for (int32_t e = 0; e < ne; e++)
        for (int i = 0; i < 2; i++) {
            if (e + 2 * RG_SOON < ne) {
                rg_mem_soon(&cursor[E[e + 2 * RG_SOON].v[i]]);
                rg_mem_soon(&X[E[e + 2 * RG_SOON].v[i]]);
                rg_mem_soon(&spokes[cursor[E[e + RG_SOON].v[i]]]);
            }
            rg_vec2 d = rg_vec2_sub(X[E[e].v[!i]], X[E[e].v[i]]);
            spokes[cursor[E[e].v[i]]++] = (rg_keyed){turn_of(d), e, 0};
        }
    for (int32_t v = 0; ne > 0 && v < nv; v++)
        rg_order_few(spokes + s->start[v], s->start[v + 1] - s->start[v]);
    for (int32_t j = 0; j < 2 * ne; j++) s->edge[j] = spokes[j].v;
    rg_mem_free(mem, spokes);
    return RG_OK;
}

rg_status rg_star_sort(rg_star *s, int32_t nv, const rg_vec2 *X, const rg_edge *E, const unsigned char *which)
{
    rg_keyed *spokes = NULL;
    size_t room = 0;
    rg_status status = RG_OK;
    for (int32_t v = 0; status == RG_OK && v < nv; v++) {
        const int32_t n = s->start[v + 1] - s->start[v];
        int32_t *edge = s->edge + s->start[v];
        if (!which[v]) continue;
        status = RG_MEM_GROW(&s->mem, spokes, room, (size_t)n);
        for (int32_t i = 0; status == RG_OK && i < n; i++) {
            const int32_t *end = E[edge[i]].v;
            spokes[i] = (rg_keyed){turn_of(rg_vec2_sub(X[end[end[0] == v]], X[v])), edge[i], 0};
        }
        if (status == RG_OK) rg_order_few(spokes, n);
        for (int32_t i = 0; status == RG_OK && i < n; i++) edge[i] = spokes[i].v;
    }
    rg_mem_free(&s->mem, spokes);
    return status;
}

void rg_star_free(rg_star *s)
{
    if (!s->mem.resize) return;
    RG_MEM_FREE(&s->mem, s->start, s->edge);
    memset(s, 0, sizeof *s);
}

rg_status rg_faces_init(rg_faces *f, const rg_memory *mem, int32_t nv, int32_t ne, const rg_vec2 *X, const rg_edge *E,
                        const int32_t *star_start, const int32_t *star)
{
    const int32_t halves = 2 * ne;
    memset(f, 0, sizeof *f);
    f->mem = *mem;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(f->next, (size_t)halves), RG_ARRAY(f->face, (size_t)halves),
                      RG_ARRAY(f->first, (size_t)halves), RG_ARRAY(f->area, (size_t)halves)) != RG_OK) return RG_ENOMEM;
    /* Arriving at v over an edge, the face on the left goes on over the edge before it, counter-clockwise. */
    for (int32_t v = 0; v < nv; v++)
        for (int32_t j = star_start[v]; j < star_start[v + 1]; j++) {
            const int32_t e = star[j], before = star[j > star_start[v] ? j - 1 : star_start[v + 1] - 1];
            if (j + RG_SOON < star_start[nv]) {
                rg_mem_soon(&E[star[j + RG_SOON]]);
                rg_mem_soon(&f->next[2 * star[j + RG_SOON]]);
            }
            const int32_t arriving = 2 * e + (E[e].v[0] == v), leaving = 2 * before + (E[before].v[1] == v);
            f->next[arriving] = leaving;
        }
    for (int32_t h = 0; h < halves; h++) f->face[h] = -1;
    for (int32_t h = 0; h < halves; h++) {
        if (h + 2 * RG_SOON < halves) {
            const int32_t second = f->next[h + 2 * RG_SOON], third = f->next[f->next[h + RG_SOON]];
            rg_mem_soon(&f->next[second]), rg_mem_soon(&f->face[second]), rg_mem_soon(&E[second >> 1]);
            rg_mem_soon(&f->next[third]), rg_mem_soon(&f->face[third]), rg_mem_soon(&E[third >> 1]);
        }
        if (f->face[h] >= 0) continue;
        const rg_vec2 from = X[rg_tail(E, h)]; /* sums of small numbers round less */
        double twice = 0;
        int32_t g = h;
        do {
            f->face[g] = f->count;
            twice += rg_vec2_turn(from, X[rg_tail(E, g)], X[rg_head(E, g)]);
            g = f->next[g];
        } while (g != h);
        f->first[f->count] = h;
        f->area[f->count++] = twice / 2;
    }
    return RG_OK;
}

void rg_faces_free(rg_faces *f)
{
    if (!f->mem.resize) return;
    RG_MEM_FREE(&f->mem, f->next, f->face, f->first, f->area);
    memset(f, 0, sizeof *f);
}

rg_status rg_walk_make(rg_walk *w, const rg_memory *mem, int32_t nv, int32_t ne, const rg_vec2 *X, const rg_edge *E)
{
    if (w->there) return RG_OK;
    rg_status s = rg_star_init(&w->star, mem, nv, ne, X, E);
    if (s == RG_OK) s = rg_faces_init(&w->faces, mem, nv, ne, X, E, w->star.start, w->star.edge);
    w->there = s == RG_OK;
    if (s != RG_OK) rg_walk_free(w);
    return s;
}

void rg_walk_free(rg_walk *w)
{
    rg_star_free(&w->star);
    rg_faces_free(&w->faces);
    w->there = 0;
}
