#include "pattern/overlap.h"

#include <stdlib.h>
#include <string.h>

/* Warnings of one kind before the rest is counted only. */
enum { MOST_WARNINGS = 20 };
/* Of lines nearly in one line, how often one is taken as the base for the others. What is left is cut the long way. */
enum { MOST_BASES = 8 };
/* Directions go round at this angle, where nobody draws. */
static const double SEAM = 1.2345;

typedef struct item { double angle, away; int32_t e; } item; /* away: from the middle of the drawing */
typedef struct event { double t; int32_t vertex, e; int begins; } event;       /* an end of an edge along the base */
typedef struct piece { int32_t e, v[2]; double t; } piece;                     /* t: along the edge */
typedef struct heap { int32_t *e, n; } heap;                                   /* the first of them on top */
enum { BORDERS, MOUNTAINS, VALLEYS, OTHERS, HEAPS };
enum { AS_IT_IS, OPEN, CLOSED };                                               /* of an edge: as drawn, or in pieces */

typedef struct sweep {
    rg_lines *lines;
    const rg_vec2 *X;
    const rg_edge *E;
    int32_t ne;
    double tol;
    item *items;
    event *events;
    piece *pieces;
    int32_t piece_count;
    unsigned char *state;
    heap heaps[HEAPS];
    int told;
} sweep;

int rg_overlap_rank(char assignment)
{
    return assignment == RG_BORDER ? 0 : assignment == RG_MOUNTAIN || assignment == RG_VALLEY ? 1 : 2;
}

rg_status rg_overlap_warn(rg_lines *lines, const rg_vec2 *X, const rg_edge *keep, const rg_edge *other, int *told)
{
    const char p = keep->assignment, q = other->assignment;
    if (rg_overlap_rank(p) != 1 || rg_overlap_rank(q) != 1 || p == q || (*told)++ >= MOST_WARNINGS) return RG_OK;
    const rg_vec2 at = rg_lines_own(lines, X[keep->v[0]], 0);
    return rg_lines_warn(lines, other->where,
                         "mountain and valley drawn on one line from (%.6g, %.6g): the first one stays", at.x, at.y);
}

rg_status rg_overlap_warn_more(rg_lines *lines, int told)
{
    if (told <= MOST_WARNINGS) return RG_OK;
    return rg_lines_warn(lines, 0, "%d more lines are drawn as mountain and as valley", told - MOST_WARNINGS);
}

/* -------------------------------------------------------------------------------------------------- heaps ---- */

static void push(heap *h, int32_t e)
{
    int32_t i = h->n++;
    for (; i > 0 && h->e[(i - 1) / 2] > e; i = (i - 1) / 2) h->e[i] = h->e[(i - 1) / 2];
    h->e[i] = e;
}

static void pop(heap *h)
{
    const int32_t last = h->e[--h->n];
    int32_t i = 0;
    for (int32_t child; (child = 2 * i + 1) < h->n; i = child) {
        if (child + 1 < h->n && h->e[child + 1] < h->e[child]) child++;
        if (last <= h->e[child]) break;
        h->e[i] = h->e[child];
    }
    h->e[i] = last;
}

/* The first edge of a kind that is open, or -1. */
static int32_t top(sweep *s, int kind)
{
    heap *h = &s->heaps[kind];
    while (h->n > 0 && s->state[h->e[0]] != OPEN) pop(h);
    return h->n > 0 ? h->e[0] : -1;
}

static int kind_of(char assignment)
{
    switch (assignment) {
    case RG_BORDER: return BORDERS;
    case RG_MOUNTAIN: return MOUNTAINS;
    case RG_VALLEY: return VALLEYS;
    default: return OTHERS;
    }
}

/* -------------------------------------------------------------------------------------------------- sweep ---- */

static rg_vec2 way(const sweep *s, int32_t e) { return rg_vec2_sub(s->X[s->E[e].v[1]], s->X[s->E[e].v[0]]); }

static int by_place(const void *a, const void *b)
{
    const event *p = a, *q = b;
    if (p->t != q->t) return p->t < q->t ? -1 : 1;
    if (p->vertex != q->vertex) return p->vertex < q->vertex ? -1 : 1;
    return p->e < q->e ? -1 : p->e > q->e;
}

/* The edge that stays from vertex u to v, which comes next along d. */
static rg_status stretch(sweep *s, int32_t u, int32_t v, rg_vec2 d)
{
    const int32_t border = top(s, BORDERS), m = top(s, MOUNTAINS), y = top(s, VALLEYS);
    const int32_t first = m < 0 || (y >= 0 && y < m) ? y : m;
    const int32_t e = border >= 0 ? border : first >= 0 ? first : top(s, OTHERS);
    if (e < 0 || u == v) return RG_OK;
    const rg_vec2 along = way(s, e);
    const int back = rg_vec2_dot(along, d) < 0;
    piece *p = &s->pieces[s->piece_count++];
    *p = (piece){e, {back ? v : u, back ? u : v}, 0};
    p->t = rg_vec2_dot(along, rg_vec2_sub(s->X[p->v[0]], s->X[s->E[e].v[0]]));
    if (border >= 0 || m < 0 || y < 0) return RG_OK;
    rg_edge keep = s->E[e];
    keep.v[0] = p->v[0];
    return rg_overlap_warn(s->lines, s->X, &keep, &s->E[e == m ? y : m], &s->told);
}

/* n edges' 2n ends in order along d. */
static rg_status sweep_events(sweep *s, int32_t ends, rg_vec2 d)
{
    rg_status status = RG_OK;
    for (int k = 0; k < HEAPS; k++) s->heaps[k].n = 0;
    for (int32_t i = 0; status == RG_OK && i < ends; i++) {
        const event *q = &s->events[i];
        if (i > 0) status = stretch(s, q[-1].vertex, q->vertex, d);
        s->state[q->e] = q->begins ? OPEN : CLOSED;
        if (q->begins) push(&s->heaps[kind_of(s->E[q->e].assignment)], q->e);
    }
    return status;
}

/* Whether any two of the edges share more than an end. */
static int overlap(const sweep *s, int32_t ends)
{
    int32_t open = 0, before = 0;
    for (int32_t i = 0; i < ends; i++) {
        if (i == 0 || s->events[i].vertex != s->events[i - 1].vertex) before = open;
        open += s->events[i].begins ? 1 : -1;
        if (before > 1) return 1;
    }
    return 0;
}

/* An edge that lies along the base, from o along the unit vector d; 0: it does not. */
static int take(sweep *s, int32_t e, rg_vec2 o, rg_vec2 d, int32_t *ends)
{
    const int32_t *v = s->E[e].v;
    const rg_vec2 a = rg_vec2_sub(s->X[v[0]], o), b = rg_vec2_sub(s->X[v[1]], o);
    const double from = rg_vec2_dot(a, d), to = rg_vec2_dot(b, d);
    if (!(fabs(rg_vec2_cross(d, a)) <= s->tol / 2 && fabs(rg_vec2_cross(d, b)) <= s->tol / 2)) return 0;
    if (!(fabs(to - from) > s->tol)) return 0;
    s->events[(*ends)++] = (event){from, v[0], e, from < to};
    s->events[(*ends)++] = (event){to, v[1], e, from > to};
    return 1;
}

/* Edges that may lie in one line: the longest and all that lie along it, then the longest of the rest. */
static rg_status one_group(sweep *s, item *items, int32_t n)
{
    rg_status status = RG_OK;
    for (int pass = 0; status == RG_OK && n > 1 && pass < MOST_BASES; pass++) {
        int32_t base = items[0].e, rest = 0, ends = 0;
        for (int32_t i = 1; i < n; i++)
            if (rg_vec2_length(way(s, items[i].e)) > rg_vec2_length(way(s, base))) base = items[i].e;
        const double length = rg_vec2_length(way(s, base));
        const rg_vec2 o = s->X[s->E[base].v[0]], to = way(s, base), d = {to.x / length, to.y / length};
        for (int32_t i = 0; i < n; i++)
            if (!take(s, items[i].e, o, d, &ends) && items[i].e != base) items[rest++] = items[i];
        qsort(s->events, (size_t)ends, sizeof *s->events, by_place);
        if (overlap(s, ends)) status = sweep_events(s, ends, d);
        n = rest;
    }
    return status;
}

/* ------------------------------------------------------------------------------------------------- groups ---- */

static int by_angle(const void *a, const void *b)
{
    const item *p = a, *q = b;
    return p->angle != q->angle ? (p->angle < q->angle ? -1 : 1) : (p->e > q->e) - (p->e < q->e);
}

static int by_distance(const void *a, const void *b)
{
    const item *p = a, *q = b;
    return p->away != q->away ? (p->away < q->away ? -1 : 1) : (p->e > q->e) - (p->e < q->e);
}

static void fill_items(sweep *s)
{
    const rg_vec2 middle = s->ne > 0 ? s->X[s->E[s->ne / 2].v[0]] : (rg_vec2){0, 0};
    for (int32_t e = 0; e < s->ne; e++) {
        rg_vec2 d = way(s, e);
        double angle = atan2(d.y, d.x) - SEAM;
        while (angle < 0) {
            angle += RG_PI;
            d = (rg_vec2){-d.x, -d.y};
        }
        s->items[e] = (item){angle, rg_vec2_cross(d, rg_vec2_sub(s->X[s->E[e].v[0]], middle)) / rg_vec2_length(d), e};
    }
}

/* Edges of nearly one direction, and of these such as are nearly as far away: neighbours in a sorted list. */
static rg_status all_groups(sweep *s, double size)
{
    rg_status status = RG_OK;
    qsort(s->items, (size_t)s->ne, sizeof *s->items, by_angle);
    for (int32_t from = 0, to; status == RG_OK && from < s->ne; from = to) {
        for (to = from + 1; to < s->ne && s->items[to].angle - s->items[to - 1].angle <= s->tol / size;) to++;
        qsort(s->items + from, (size_t)(to - from), sizeof *s->items, by_distance);
        for (int32_t i = from, j; status == RG_OK && i < to; i = j) {
            for (j = i + 1; j < to && s->items[j].away - s->items[j - 1].away <= s->tol;) j++;
            status = one_group(s, s->items + i, j - i);
        }
    }
    return status;
}

static int by_edge(const void *a, const void *b)
{
    const piece *p = a, *q = b;
    if (p->e != q->e) return p->e < q->e ? -1 : 1;
    return (p->t > q->t) - (p->t < q->t);
}

/* The edges that stayed as they are and the pieces of others, in the order of the edges. */
static rg_status put_together(sweep *s, rg_edge **E, int32_t *ne, size_t *room)
{
    rg_edge *made = NULL;
    size_t made_room = 0;
    const rg_status status = RG_MEM_GROW(&s->lines->mem, made, made_room, (size_t)s->ne + (size_t)s->piece_count);
    if (status != RG_OK) return status;
    qsort(s->pieces, (size_t)s->piece_count, sizeof *s->pieces, by_edge);
    int32_t n = 0, at = 0;
    for (int32_t e = 0; e < s->ne; e++) {
        if (s->state[e] == AS_IT_IS) made[n++] = s->E[e];
        for (; at < s->piece_count && s->pieces[at].e == e; at++) {
            made[n] = s->E[e];
            memcpy(made[n++].v, s->pieces[at].v, sizeof made->v);
        }
    }
    rg_mem_free(&s->lines->mem, *E);
    *E = made;
    *ne = n;
    *room = made_room;
    return RG_OK;
}

rg_status rg_overlap_resolve(rg_lines *lines, const rg_vec2 *X, double tol, double size, rg_edge **E, int32_t *ne,
                             size_t *room)
{
    const rg_memory *mem = &lines->mem;
    const size_t n = (size_t)*ne;
    sweep s = {.lines = lines, .X = X, .E = *E, .ne = *ne, .tol = tol};
    rg_status status = RG_MEM_ARRAYS(mem, RG_ARRAY(s.items, n), RG_ARRAY(s.events, 2 * n), RG_ARRAY(s.pieces, 2 * n),
                                     RG_ARRAY(s.state, n));
    for (int k = 0; k < HEAPS; k++) {
        s.heaps[k].e = rg_mem_array(mem, n, sizeof *s.heaps[k].e);
        if (!s.heaps[k].e) status = RG_ENOMEM;
    }
    if (status == RG_OK) {
        fill_items(&s);
        status = all_groups(&s, size);
    }
    if (status == RG_OK) status = rg_overlap_warn_more(lines, s.told);
    if (status == RG_OK && s.piece_count > 0) status = put_together(&s, E, ne, room);
    RG_MEM_FREE(mem, s.items, s.events, s.pieces, s.state, s.heaps[0].e, s.heaps[1].e, s.heaps[2].e, s.heaps[3].e);
    return status;
}
