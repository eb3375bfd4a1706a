#include "pattern/cuts.h"
#include "base/memory.h"

#include <string.h>

/* Edge by edge, along each; those of edge e begin at start[e], [ne + 2]. */
static rg_status sort_cuts(rg_splitter *s, int32_t *start)
{
    int32_t crowd = 0, *count;
    for (size_t i = 0; i < s->cut_count; i++) start[s->cuts[i].w + 2]++;
    for (int32_t e = 0; e < s->ne; e++) {
        crowd = start[e + 2] > crowd ? start[e + 2] : crowd;
        start[e + 2] += start[e + 1];
    }
    rg_keyed *sorted, *room;
    const rg_status status = RG_MEM_ARRAYS(&s->mem, RG_ARRAY(sorted, s->cut_count), RG_ARRAY(room, (size_t)crowd),
                                           RG_ARRAY(count, (size_t)crowd));
    if (status != RG_OK) return status;
    for (size_t i = 0; i < s->cut_count; i++) sorted[start[s->cuts[i].w + 1]++] = s->cuts[i];
    for (int32_t e = 0; e < s->ne; e++)
        if (start[e + 1] > start[e] + 1) rg_order_keyed(sorted + start[e], start[e + 1] - start[e], room, count);
    RG_MEM_FREE(&s->mem, room, count, s->cuts);
    s->cuts = sorted;
    s->cut_room = s->cut_count;
    return RG_OK;
}

static double square_of(const rg_splitter *s, int32_t u, int32_t v)
{
    const rg_vec2 d = rg_vec2_sub(s->points.X[u], s->points.X[v]);
    return rg_vec2_dot(d, d);
}

/* How many of n cuts of an edge to make now: all, or the first alone where vertices lie so near both sides of a short
 * edge that a part between two of them is longer than the whole. Parts get shorter and shorter then, and the rounds
 * end. */
static int32_t cuts_to_make(const rg_splitter *s, const rg_edge *e, const rg_keyed *cuts, int32_t n)
{
    const double whole = n > 1 ? square_of(s, e->v[0], e->v[1]) : 0;
    for (int32_t i = 1; i < n; i++) {
        if (i + RG_SOON < n) rg_mem_soon(&s->points.X[cuts[i + RG_SOON].v]);
        if (!(square_of(s, cuts[i - 1].v, cuts[i].v) < whole)) return 1;
    }
    return n;
}

/* Whether a cut leaves the edge where it was. A piece between two such ones crosses nothing that the edge does not
 * cross, which has been seen to: it need not be looked at again. Most crossings are so; those that fell to a vertex
 * nearby are not. */
static int stays(const rg_splitter *s, const rg_edge *e, int32_t vertex)
{
    const rg_vec2 a = s->points.X[e->v[0]], d = rg_vec2_sub(s->points.X[e->v[1]], a);
    const double off = rg_vec2_cross(d, rg_vec2_sub(s->points.X[vertex], a));
    return off * off < s->exact * s->exact * rg_vec2_dot(d, d);
}

/* Of an edge's n cuts those that make a piece come first then; returns how many. *left: out, whether any is left for
 * the next round. */
static int32_t choose(rg_splitter *s, int32_t e, rg_keyed *cuts, int32_t n, int *left)
{
    const int32_t *v = s->E[e].v, made = cuts_to_make(s, &s->E[e], cuts, n);
    int32_t kept = 0, before = v[0];
    *left = made < n;
    if (n > 0) s->touched[v[0]] = s->touched[v[1]] = 1;
    for (int32_t i = 0; i < made; i++) {
        if (cuts[i].v == before || cuts[i].v == v[1]) continue;
        s->touched[before = cuts[i].v] = 1;
        cuts[kept++] = cuts[i];
    }
    return kept;
}

/* Edge e in n + 1 pieces, to E[to] and on. */
static void cut(rg_splitter *s, int32_t e, const rg_keyed *cuts, int32_t n, int left, int32_t to)
{
    rg_edge rest = s->E[e];
    const rg_edge whole = rest;
    int bent = left; /* from the last cut on; what is still to be cut has to be looked at */
    for (int32_t i = 0; i < n; i++) {
        if (i + RG_SOON < n) rg_mem_soon(&s->points.X[cuts[i + RG_SOON].v]);
        const int bends = left || !stays(s, &whole, cuts[i].v);
        s->fresh_count += s->fresh[to] = (unsigned char)(bent || bends);
        bent = bends;
        s->E[to] = rest;
        s->E[to++].v[1] = rest.v[0] = cuts[i].v;
    }
    s->fresh_count += s->fresh[to] = (unsigned char)bent;
    s->E[to] = rest;
}

/* What each edge is cut at is put together; start[e]: in and out. Until they are moved, fresh[e] says whether
 * something is left of an edge. */
static void choose_all(rg_splitter *s, int32_t *start)
{
    int32_t n = 0;
    for (int32_t e = 0; e < s->ne; e++) {
        const int32_t from = start[e], count = start[e + 1] - from;
        int left = 0;
        const int32_t kept = count > 0 ? choose(s, e, s->cuts + from, count, &left) : 0;
        if (kept > 0 && n < from) memmove(s->cuts + n, s->cuts + from, (size_t)kept * sizeof *s->cuts);
        s->fresh[e] = (unsigned char)left;
        start[e] = n;
        n += kept;
    }
    start[s->ne] = n;
}

/* From the last edge on, so that each is moved to where nothing is needed any more; those before the first that is cut
 * stay. */
static void cut_all(rg_splitter *s, const int32_t *start)
{
    int32_t e = s->ne - 1;
    s->fresh_count = 0;
    for (; e >= 0 && start[e + 1] > 0; e--)
        cut(s, e, s->cuts + start[e], start[e + 1] - start[e], s->fresh[e], e + start[e]);
    for (; e >= 0; e--) s->fresh_count += s->fresh[e];
    s->ne += start[s->ne];
}

rg_status rg_cuts_make(rg_splitter *s)
{
    const size_t nv = (size_t)s->points.count;
    int32_t *start = rg_mem_array(&s->mem, (size_t)s->ne + 2, sizeof *start);
    rg_status status = start ? sort_cuts(s, start) : RG_ENOMEM;
    if (status == RG_OK) status = RG_MEM_GROW(&s->mem, s->touched, s->touched_room, nv);
    if (status == RG_OK) {
        memset(s->touched, 0, nv);
        choose_all(s, start);
        const size_t pieces = (size_t)s->ne + (size_t)start[s->ne];
        status = RG_MEM_GROW(&s->mem, s->E, s->room, pieces);
        if (status == RG_OK) status = RG_MEM_GROW(&s->mem, s->fresh, s->fresh_room, pieces);
        if (status == RG_OK) cut_all(s, start);
    }
    rg_mem_free(&s->mem, start);
    return status;
}
