#include "pattern/alike.h"
#include "base/classes.h"

#include <stdlib.h>
#include <string.h>

/* Vertices that are as near as this part of the sheet's size are in one place: drawings by hand are that good. */
static const double SAME_PLACE = 1e-4;
static const double SAME_TARGET = 1e-6;
/* Vertices moved in all that is tried: a second's work, enough for every place in a ring of 1,400. */
static const int64_t MOST_MOVED = 4000000;
/* Vertices are sorted along a direction in which few are side by side. */
static const double ACROSS_X = 0.3302, ACROSS_Y = 0.9439;

typedef struct spot { double along; int32_t v; } spot;
typedef struct ends { int32_t low, high, e; } ends;

typedef struct search {
    const rg_pattern *p;
    rg_vec2 middle;
    double tol;
    spot *spots; /* [nv] sorted */
    ends *edges; /* [ne] sorted */
    int32_t *vertex_to, *edge_to; /* [nv], [ne] where each of them goes */
    int32_t *vertex_up, *edge_up; /* [nv], [ne] towards the least of its orbit, which goes up to itself */
} search;

static double along(rg_vec2 x) { return ACROSS_X * x.x + ACROSS_Y * x.y; }

static int by_along(const void *a, const void *b)
{
    const spot *p = a, *q = b;
    return p->along != q->along ? (p->along < q->along ? -1 : 1) : (p->v > q->v) - (p->v < q->v);
}

static int by_ends(const void *a, const void *b)
{
    const ends *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return (p->high > q->high) - (p->high < q->high);
}

static ends ends_of(int32_t a, int32_t b, int32_t e) { return (ends){a < b ? a : b, a < b ? b : a, e}; }

static rg_vec2 from_middle(const search *s, int32_t v) { return rg_vec2_sub(s->p->X[v], s->middle); }

/* Non-zero while spot i may be nearer to x than `nearest`; *v, *nearest: updated. */
static int nearer(const search *s, int32_t i, rg_vec2 x, double *nearest, int32_t *v)
{
    if (!(fabs(s->spots[i].along - along(x)) <= *nearest)) return 0;
    const double distance = rg_vec2_length(rg_vec2_sub(from_middle(s, s->spots[i].v), x));
    if (distance <= *nearest) *nearest = distance, *v = s->spots[i].v;
    return 1;
}

/* The vertex nearest to x, from the middle, of those in the same place: short edges have both ends there. -1: none. */
static int32_t vertex_at(const search *s, rg_vec2 x)
{
    const double at = along(x);
    int32_t low = 0, high = s->p->nv, v = -1;
    while (low < high) {
        const int32_t half = low + (high - low) / 2;
        if (s->spots[half].along < at) low = half + 1;
        else high = half;
    }
    double nearest = s->tol;
    for (int32_t i = low; i < s->p->nv && nearer(s, i, x, &nearest, &v); i++) {}
    for (int32_t i = low - 1; i >= 0 && nearer(s, i, x, &nearest, &v); i--) {}
    return v;
}

static int same_target(double a, double b) { return (isnan(a) && isnan(b)) || fabs(a - b) <= SAME_TARGET; }

static char exchanged(char assignment)
{
    return assignment == RG_MOUNTAIN ? RG_VALLEY : assignment == RG_VALLEY ? RG_MOUNTAIN : assignment;
}

/* Multiplies by the unit number c + i s, after taking the conjugate if `mirror`. keeps, exchanges: out. */
static void try_map(const search *s, double c, double si, int mirror, int *keeps, int *exchanges)
{
    const rg_pattern *p = s->p;
    *keeps = *exchanges = 0;
    for (int32_t v = 0; v < p->nv; v++) {
        const rg_vec2 x = from_middle(s, v);
        const double y = mirror ? -x.y : x.y;
        if ((s->vertex_to[v] = vertex_at(s, (rg_vec2){c * x.x - si * y, si * x.x + c * y})) < 0) return;
    }
    int same = 1, other = 1;
    for (int32_t e = 0; e < p->ne && (same || other); e++) {
        const ends key = ends_of(s->vertex_to[p->E[e].v[0]], s->vertex_to[p->E[e].v[1]], e);
        const ends *found = bsearch(&key, s->edges, (size_t)p->ne, sizeof key, by_ends);
        if (!found) return;
        const rg_edge *a = &p->E[e], *b = &p->E[found->e];
        same &= a->assignment == b->assignment && same_target(a->target, b->target);
        other &= exchanged(a->assignment) == b->assignment && same_target(-a->target, b->target);
        s->edge_to[e] = found->e;
    }
    *keeps = same;
    *exchanges = other && !same;
}

static void note(rg_likeness *l, int mirror, double angle)
{
    if (!mirror) {
        l->turns++;
        return;
    }
    double line = fmod(angle / 2 / RG_DEG + 360, 180);
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

static void count_orbits(const search *s, rg_alike *a)
{
    for (int32_t e = 0; e < s->p->ne; e++) a->creases += s->edge_up[e] == e && s->p->E[e].assignment != RG_BORDER;
    for (int32_t v = 0; v < s->p->nv; v++) a->vertices += s->vertex_up[v] == v && !s->p->rim[v];
}

/* Wherever the furthest vertex may go, turned or mirrored. */
static void try_all(const search *s, rg_alike *a)
{
    int32_t furthest = 0;
    int64_t moved = 0;
    for (int32_t v = 1; v < s->p->nv; v++)
        if (rg_vec2_length(from_middle(s, v)) > rg_vec2_length(from_middle(s, furthest))) furthest = v;
    const rg_vec2 x = from_middle(s, furthest);
    const double far = rg_vec2_length(x);
    if (!(far > 2 * s->tol)) return;
    for (int32_t v = 0; v < s->p->nv && moved < MOST_MOVED; v++) {
        const rg_vec2 y = from_middle(s, v);
        const double length = rg_vec2_length(y);
        if (!(fabs(length - far) <= s->tol)) continue;
        moved += 2 * (int64_t)s->p->nv;
        for (int mirror = 0; mirror < 2; mirror++) { /* y = (c + i s) x, or (c + i s) times its conjugate */
            const double xy = mirror ? -x.y : x.y, c = (x.x * y.x + xy * y.y) / (far * length), si = (x.x * y.y - xy * y.x) / (far * length);
            int keeps, exchanges;
            try_map(s, c, si, mirror, &keeps, &exchanges);
            if (keeps) note(&a->same, mirror, atan2(si, c));
            if (exchanges) note(&a->exchanged, mirror, atan2(si, c));
            if (!keeps && !exchanges) continue;
            a->order++;
            join(s->vertex_up, s->p->nv, s->vertex_to);
            join(s->edge_up, s->p->ne, s->edge_to);
        }
    }
}

static void fill(search *s)
{
    const rg_pattern *p = s->p;
    for (int32_t v = 0; v < p->nv; v++) {
        s->middle.x += p->X[v].x / p->nv;
        s->middle.y += p->X[v].y / p->nv;
    }
    for (int32_t v = 0; v < p->nv; v++) {
        s->spots[v] = (spot){along(from_middle(s, v)), v};
        s->vertex_up[v] = v;
    }
    for (int32_t e = 0; e < p->ne; e++) {
        s->edges[e] = ends_of(p->E[e].v[0], p->E[e].v[1], e);
        s->edge_up[e] = e;
    }
    qsort(s->spots, (size_t)p->nv, sizeof *s->spots, by_along);
    qsort(s->edges, (size_t)p->ne, sizeof *s->edges, by_ends);
}

rg_status rg_alike_find(const rg_pattern *p, rg_alike *a)
{
    const size_t nv = (size_t)p->nv, ne = (size_t)p->ne;
    search s = {.p = p, .tol = SAME_PLACE * p->info.size};
    memset(a, 0, sizeof *a);
    s.spots = rg_mem_array(&p->mem, nv, sizeof *s.spots);
    s.edges = rg_mem_array(&p->mem, ne, sizeof *s.edges);
    s.vertex_to = rg_mem_array(&p->mem, 2 * nv, sizeof *s.vertex_to);
    s.edge_to = rg_mem_array(&p->mem, 2 * ne, sizeof *s.edge_to);
    const rg_status status = s.spots && s.edges && s.vertex_to && s.edge_to ? RG_OK : RG_ENOMEM;
    if (status == RG_OK && nv > 0) {
        s.vertex_up = s.vertex_to + nv;
        s.edge_up = s.edge_to + ne;
        fill(&s);
        try_all(&s, a);
        count_orbits(&s, a);
    }
    rg_mem_free(&p->mem, s.spots);
    rg_mem_free(&p->mem, s.edges);
    rg_mem_free(&p->mem, s.vertex_to);
    rg_mem_free(&p->mem, s.edge_to);
    return status;
}
