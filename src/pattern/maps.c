#include "pattern/maps.h"
#include "base/order.h"

#include <stdlib.h>
#include <string.h>

static const double SAME_TARGET = 1e-6;
/* Vertices moved in all that is tried: a second's work, enough for every place in a ring of 1,400. */
static const int64_t MOST_MOVED = 4000000;
/* In so many tries vertices are looked for one by one, before they are put in order. */
enum { TRIES_UNSORTED = 8 };
/* Vertices are sorted along a direction in which few are side by side. */
static const double ACROSS_X = 0.3302, ACROSS_Y = 0.9439;

typedef struct ends { int32_t low, high, e; } ends;

typedef struct search {
    int32_t nv, ne;
    const rg_vec2 *X;
    const rg_edge *E;
    rg_vec2 middle;
    double tol;
    const rg_memory *mem;
    rg_keyed *spots;              /* [nv] vertices by how far along they are; NULL until one is looked for */
    ends *edges;                  /* [ne] sorted; NULL until one is looked for */
    int32_t *vertex_to, *edge_to; /* [nv], [ne] where each of them goes */
    int32_t *taken;               /* [nv] the last try in which a vertex went there */
    int32_t tries;
    rg_status status;             /* RG_ENOMEM: there was no room to sort */
} search;

static double along(rg_vec2 x) { return ACROSS_X * x.x + ACROSS_Y * x.y; }

static int by_ends(const void *a, const void *b)
{
    const ends *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return (p->high > q->high) - (p->high < q->high);
}

static ends ends_of(int32_t a, int32_t b, int32_t e) { return (ends){a < b ? a : b, a < b ? b : a, e}; }

static rg_vec2 from_middle(const search *s, int32_t v) { return rg_vec2_sub(s->X[v], s->middle); }

/* Non-zero while spot i may be nearer to x than `nearest`; *v, *nearest: updated. */
static int nearer(const search *s, int32_t i, rg_vec2 x, double *nearest, int32_t *v)
{
    if (!(fabs(s->spots[i].key - along(x)) <= *nearest)) return 0;
    const rg_vec2 off = rg_vec2_sub(from_middle(s, s->spots[i].v), x);
    if (!(fabs(off.x) <= *nearest && fabs(off.y) <= *nearest)) return 1;
    const double distance = rg_vec2_length(off);
    if (distance <= *nearest) *nearest = distance, *v = s->spots[i].v;
    return 1;
}

/* The vertex nearest to x, from the middle, of those in the same place: short edges have both ends there. -1: none. */
static int32_t vertex_at(const search *s, rg_vec2 x)
{
    const double at = along(x);
    int32_t low = 0, high = s->nv, v = -1;
    while (low < high) {
        const int32_t half = low + (high - low) / 2;
        if (s->spots[half].key < at) low = half + 1;
        else high = half;
    }
    double nearest = s->tol;
    for (int32_t i = low; i < s->nv && nearer(s, i, x, &nearest, &v); i++) {}
    for (int32_t i = low - 1; i >= 0 && nearer(s, i, x, &nearest, &v); i--) {}
    return v;
}

static int same_target(double a, double b) { return (isnan(a) && isnan(b)) || fabs(a - b) <= SAME_TARGET; }

static char exchanged(char assignment)
{
    return assignment == RG_MOUNTAIN ? RG_VALLEY : assignment == RG_VALLEY ? RG_MOUNTAIN : assignment;
}

static rg_status sort_vertices(search *s)
{
    const size_t nv = (size_t)s->nv;
    rg_keyed *room;
    int32_t *count;
    if (s->spots) return RG_OK;
    if (RG_MEM_ARRAYS(s->mem, RG_ARRAY(s->spots, nv), RG_ARRAY(room, nv), RG_ARRAY(count, nv)) != RG_OK)
        return RG_ENOMEM;
    for (int32_t v = 0; v < s->nv; v++) s->spots[v] = (rg_keyed){along(from_middle(s, v)), v, 0};
    rg_order_keyed(s->spots, s->nv, room, count);
    RG_MEM_FREE(s->mem, room, count);
    return RG_OK;
}

static rg_status sort_edges(search *s)
{
    if (s->edges) return RG_OK;
    s->edges = rg_mem_array(s->mem, (size_t)s->ne, sizeof *s->edges);
    if (!s->edges) return RG_ENOMEM;
    for (int32_t e = 0; e < s->ne; e++) s->edges[e] = ends_of(s->E[e].v[0], s->E[e].v[1], e);
    qsort(s->edges, (size_t)s->ne, sizeof *s->edges, by_ends);
    return RG_OK;
}

static rg_vec2 image(const search *s, const rg_map *g, int32_t v)
{
    const rg_vec2 x = from_middle(s, v);
    const double y = g->mirror ? -x.y : x.y;
    return (rg_vec2){g->c * x.x - g->s * y, g->s * x.x + g->c * y};
}

/* Whether some vertex is there, found without any order. */
static int is_there(const search *s, rg_vec2 x)
{
    for (int32_t v = 0; v < s->nv; v++) {
        const rg_vec2 off = rg_vec2_sub(from_middle(s, v), x);
        if (fabs(off.x) <= s->tol && fabs(off.y) <= s->tol) return 1;
    }
    return 0;
}

static int move_vertices(search *s, const rg_map *g)
{
    s->tries++;
    /* Most drawings have no symmetry, and do not have to be put in order to see it. */
    const int few = !s->spots && s->tries <= TRIES_UNSORTED;
    if (few && !(is_there(s, image(s, g, s->nv / 2)) && is_there(s, image(s, g, s->nv / 3)))) return 0;
    s->status = sort_vertices(s);
    if (s->status != RG_OK) return 0;
    for (int32_t v = 0; v < s->nv; v++) {
        const int32_t to = vertex_at(s, image(s, g, v));
        if (to < 0 || s->taken[to] == s->tries) return 0;
        s->taken[to] = s->tries;
        s->vertex_to[v] = to;
    }
    return 1;
}

/* Does it take the drawing to itself, one way or the other? g->keeps: out. */
static int applies(search *s, rg_map *g)
{
    if (!move_vertices(s, g)) return 0;
    s->status = sort_edges(s);
    if (s->status != RG_OK) return 0;
    int same = 1, other = 1;
    for (int32_t e = 0; e < s->ne && (same || other); e++) {
        const ends key = ends_of(s->vertex_to[s->E[e].v[0]], s->vertex_to[s->E[e].v[1]], e);
        const ends *found = bsearch(&key, s->edges, (size_t)s->ne, sizeof key, by_ends);
        if (!found) return 0;
        const rg_edge *a = &s->E[e], *b = &s->E[found->e];
        same &= a->assignment == b->assignment && same_target(a->target, b->target);
        other &= exchanged(a->assignment) == b->assignment && same_target(-a->target, b->target);
        s->edge_to[e] = found->e;
    }
    g->keeps = same;
    return same || other;
}

typedef struct room { size_t map, vertex, edge; } room;

static rg_status keep(rg_maps *g, room *r, const search *s, const rg_map *map)
{
    const size_t n = (size_t)g->count, nv = (size_t)g->nv, ne = (size_t)g->ne;
    rg_status status = RG_MEM_GROW(&g->mem, g->map, r->map, n + 1);
    if (status == RG_OK) status = RG_MEM_GROW(&g->mem, g->vertex, r->vertex, (n + 1) * nv);
    if (status == RG_OK) status = RG_MEM_GROW(&g->mem, g->edge, r->edge, (n + 1) * ne);
    if (status != RG_OK) return status;
    g->map[n] = *map;
    memcpy(g->vertex + n * nv, s->vertex_to, nv * sizeof *g->vertex);
    memcpy(g->edge + n * ne, s->edge_to, ne * sizeof *g->edge);
    g->count++;
    return RG_OK;
}

/* Wherever the furthest vertex may go, turned or mirrored: y = (c + i s) x, or (c + i s) times the conjugate of x. */
static rg_status keep_identity(rg_maps *g, room *r, search *s)
{
    for (int32_t v = 0; v < s->nv; v++) s->vertex_to[v] = v;
    for (int32_t e = 0; e < s->ne; e++) s->edge_to[e] = e;
    return keep(g, r, s, &(rg_map){1, 0, 0, 1});
}

static rg_status try_all(rg_maps *g, search *s)
{
    int32_t furthest = 0;
    int64_t moved = 0;
    room r = {0, 0, 0};
    double most = -1;
    for (int32_t v = 0; v < s->nv; v++) {
        const rg_vec2 y = from_middle(s, v);
        const double square = rg_vec2_dot(y, y);
        if (square > most) most = square, furthest = v;
    }
    const rg_vec2 x = from_middle(s, furthest);
    const double far = rg_vec2_length(x);
    if (!(far > 2 * s->tol)) return RG_OK;
    for (int32_t n = 0; n <= s->nv && moved < MOST_MOVED; n++) { /* to itself first: the one by nothing is number 0 */
        const int32_t v = n == 0 ? furthest : n - 1;
        const rg_vec2 y = from_middle(s, v);
        if (!(fabs(y.x) + fabs(y.y) >= far - 2 * s->tol)) continue; /* most lie nearer */
        const double length = rg_vec2_length(y);
        if ((n > 0 && v == furthest) || !(fabs(length - far) <= s->tol)) continue;
        moved += 2 * (int64_t)s->nv;
        for (int mirror = 0; mirror < 2; mirror++) {
            const double xy = mirror ? -x.y : x.y, both = far * length;
            if (n == 0 && !mirror) {
                const rg_status status = keep_identity(g, &r, s);
                if (status != RG_OK) return status;
                continue;
            }
            rg_map map = {(x.x * y.x + xy * y.y) / both, (x.x * y.y - xy * y.x) / both, mirror, 0};
            const int fits = applies(s, &map) && s->vertex_to[furthest] == v;
            if (!fits && s->status == RG_OK) continue;
            const rg_status status = fits ? keep(g, &r, s, &map) : s->status;
            if (status != RG_OK) return status;
        }
    }
    return RG_OK;
}

static void fill(search *s)
{
    for (int32_t v = 0; v < s->nv; v++) {
        s->middle.x += s->X[v].x / s->nv;
        s->middle.y += s->X[v].y / s->nv;
    }
}

rg_status rg_maps_find(rg_maps *g, const rg_memory *mem, int32_t nv, const rg_vec2 *X, int32_t ne, const rg_edge *E,
                       double tol)
{
    search s = {.mem = mem, .nv = nv, .ne = ne, .X = X, .E = E, .tol = tol};
    memset(g, 0, sizeof *g);
    g->mem = *mem;
    g->nv = nv, g->ne = ne;
    rg_status status = RG_MEM_ARRAYS(mem, RG_ARRAY(s.vertex_to, (size_t)nv), RG_ARRAY(s.edge_to, (size_t)ne),
                                     RG_ARRAY(s.taken, (size_t)nv));
    if (status == RG_OK && nv > 0) {
        fill(&s);
        g->middle = s.middle;
        status = try_all(g, &s);
    }
    RG_MEM_FREE(mem, s.spots, s.edges, s.vertex_to, s.edge_to, s.taken);
    if (status != RG_OK) rg_maps_free(g);
    return status;
}

void rg_maps_free(rg_maps *g)
{
    if (!g->mem.resize) return;
    RG_MEM_FREE(&g->mem, g->map, g->vertex, g->edge);
    memset(g, 0, sizeof *g);
}
