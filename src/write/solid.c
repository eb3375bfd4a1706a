#include "write/solid.h"

#include <math.h>
#include <stdlib.h>

enum { UPPER, LOWER };
/* Corners lie on a lattice of so many steps, as a power of two, over the farthest coordinate: well above the rounding
 * of a fold, so that what lies in one place does so to the bit, well below what a printer does, and exact in single
 * precision (24 bits), with room to move. */
enum { STEPS = 22 };
/* How corners are moved apart, in steps: along no axis, nor a plane of two. */
static const rg_vec3 APART = {2, 3, 4};

typedef struct solid {
    const rg_mesh *m;
    rg_vec3 *place[2]; /* [corners] of each corner of each facet, above and below */
    int32_t *same[2];  /* [corners] the first corner of the same vertex that lies in the same place: corners are told
                          apart by it */
    int32_t *facet;    /* [corners] */
    int32_t *
        at; /* [nv] a corner of each vertex: of an outer one that from which all others are reached counter-clockwise */
    int32_t *ring;     /* [most] corners round the vertex at work */
    double step;       /* of the lattice */
    rg_solid_take take;
    void *ctx;
} solid;

/* On the lattice; + 0: no negative nought, which would be another number to who compares bits. */
static rg_vec3 on_lattice(double step, rg_vec3 v)
{
    return (rg_vec3){step * round(v.x / step) + 0, step * round(v.y / step) + 0, step * round(v.z / step) + 0};
}

static int32_t next_in_facet(const solid *s, int32_t j)
{
    return j + 1 < s->m->facet_start[s->facet[j] + 1] ? j + 1 : s->m->facet_start[s->facet[j]];
}
static int32_t before_in_facet(const solid *s, int32_t j)
{
    return j > s->m->facet_start[s->facet[j]] ? j - 1 : s->m->facet_start[s->facet[j] + 1] - 1;
}

static int32_t corner_of(const rg_mesh *m, int32_t f, int32_t v)
{
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
        if (m->facet_vertex[j] == v) return j;
    return -1;
}

/* The corner of the same vertex in the facet over an edge of facet f; -1: that is the border. */
static int32_t over(const solid *s, int32_t edge, int32_t f, int32_t v)
{
    const int32_t *side = s->m->edge_facet[edge], g = side[0] == f ? side[1] : side[0];
    return g < 0 ? -1 : corner_of(s->m, g, v);
}

/* Counter-clockwise round its vertex: over the edge that comes in. */
static int32_t turn(const solid *s, int32_t j)
{
    return over(s, s->m->facet_edge[before_in_facet(s, j)], s->facet[j], s->m->facet_vertex[j]);
}
static int32_t turn_back(const solid *s, int32_t j)
{
    return over(s, s->m->facet_edge[j], s->facet[j], s->m->facet_vertex[j]);
}

static void triangle(const solid *s, int side_a, int32_t a, int side_b, int32_t b, int side_c, int32_t c)
{
    const int32_t p = s->same[side_a][a], q = s->same[side_b][b], r = s->same[side_c][c];
    if ((side_a == side_b && p == q) || (side_b == side_c && q == r) || (side_c == side_a && r == p))
        return; /* nothing is between them */
    const rg_vec3 corner[] = {s->place[side_a][p], s->place[side_b][q], s->place[side_c][r]};
    s->take(s->ctx, corner);
}

/* On both sides of the sheet, seen from above counter-clockwise. */
static void twice(const solid *s, int32_t a, int32_t b, int32_t c)
{
    triangle(s, UPPER, a, UPPER, b, UPPER, c);
    triangle(s, LOWER, c, LOWER, b, LOWER, a);
}

/* Corners round a vertex in their order; returns how many. *closed: out, whether they go all the way round. */
static int32_t go_round(const solid *s, int32_t v, int *closed)
{
    int32_t j = s->at[v], n = 0;
    for (int32_t back = turn_back(s, j); back >= 0 && back != s->at[v]; back = turn_back(s, j)) j = back;
    const int32_t first = j;
    do s->ring[n++] = j;
    while ((j = turn(s, j)) >= 0 && j != first);
    *closed = j == first;
    return n;
}

static int equal(rg_vec3 a, rg_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* Neighbours round a vertex whose corners lie in one place, as those of facets that lie flat beside each other do, have
 * one corner, so that no triangle has two corners there. */
static void join(solid *s, int32_t n, int closed)
{
    for (int side = UPPER; side <= LOWER; side++) {
        for (int32_t i = 0; i < n; i++) {
            const int32_t j = s->ring[i], before = i ? s->ring[i - 1] : j;
            s->same[side][j] = i && equal(s->place[side][j], s->place[side][before]) ? s->same[side][before] : j;
        }
        /* The last ones may belong to the first. */
        const int32_t first = s->same[side][s->ring[0]];
        for (int32_t i = n - 1; closed && i > 0 && equal(s->place[side][s->ring[i]], s->place[side][first]); i--)
            s->same[side][s->ring[i]] = first;
    }
}

typedef struct spot { rg_vec3 x; int32_t corner; int side; } spot;

static int by_place(const void *a, const void *b)
{
    const spot *p = a, *q = b;
    if (p->x.x != q->x.x) return p->x.x < q->x.x ? -1 : 1;
    if (p->x.y != q->x.y) return p->x.y < q->x.y ? -1 : 1;
    if (p->x.z != q->x.z) return p->x.z < q->x.z ? -1 : 1;
    if (p->side != q->side) return p->side < q->side ? -1 : 1;
    return (p->corner > q->corner) - (p->corner < q->corner);
}

/* One pass: of those that lie in one place the first stays, the k-th goes k moves on. Returns how many went. */
static int32_t part(solid *s, spot *list, int32_t n)
{
    int32_t moved = 0;
    if (n > 0) qsort(list, (size_t)n, sizeof *list, by_place);
    for (int32_t i = 1, k = 0; i < n; i++) {
        k = equal(list[i].x, list[i - 1].x) ? k + 1 : 0;
        moved += k > 0;
        s->place[list[i].side][list[i].corner] = rg_vec3_axpy(k * s->step, APART, list[i].x);
    }
    for (int32_t i = 0; i < n; i++) list[i].x = s->place[list[i].side][list[i].corner];
    return moved;
}

/* What lies in one place and is not one is moved apart, by less than one sees: STL knows corners by their places only,
 * and takes what lies on each other, as layers of folded paper do, for one. Who is moved may meet another: until none
 * does. Each pass leaves every place taken that was, and only those go on that find theirs taken, so that it ends. */
static rg_status move_apart(solid *s, const rg_memory *mem)
{
    const int32_t corners = s->m->facet_start[s->m->nf];
    spot *list = rg_mem_array(mem, 2 * (size_t)corners, sizeof *list);
    int32_t n = 0;
    if (!list) return RG_ENOMEM;
    for (int side = UPPER; side <= LOWER; side++)
        for (int32_t j = 0; j < corners; j++)
            if (s->same[side][j] == j) list[n++] = (spot){s->place[side][j], j, side};
    while (part(s, list, n) > 0) continue;
    rg_mem_free(mem, list);
    return RG_OK;
}

static void facets(const solid *s, const rg_triangles *t)
{
    for (int32_t f = 0; f < s->m->nf; f++)
        for (int32_t i = t->start[f]; i < t->start[f + 1]; i++)
            twice(s, corner_of(s->m, f, t->v[i][0]), corner_of(s->m, f, t->v[i][1]), corner_of(s->m, f, t->v[i][2]));
}

/* A strip over each crease, a wall at each edge of the border. */
static void edges(const solid *s)
{
    const rg_mesh *m = s->m;
    for (int32_t j = 0; j < m->facet_start[m->nf]; j++) {
        const int32_t e = m->facet_edge[j], k = next_in_facet(s, j), f = s->facet[j];
        const int32_t g = m->edge_facet[e][0] == f ? m->edge_facet[e][1] : m->edge_facet[e][0];
        if (g < 0) {
            triangle(s, UPPER, k, UPPER, j, LOWER, j);
            triangle(s, UPPER, k, LOWER, j, LOWER, k);
        } else if (f < g) { /* each crease once: this facet has it from j to k */
            const int32_t a = corner_of(m, g, m->facet_vertex[k]), b = corner_of(m, g, m->facet_vertex[j]);
            twice(s, k, j, b);
            twice(s, k, b, a);
        }
    }
}

/* What is left open round a vertex: a fan, or at the border a wall. */
static void vertices(const solid *s)
{
    for (int32_t v = 0; v < s->m->nv; v++) {
        int closed;
        if (s->at[v] < 0) continue;
        const int32_t n = go_round(s, v, &closed);
        for (int32_t i = 1; closed && i + 1 < n; i++) twice(s, s->ring[0], s->ring[i], s->ring[i + 1]);
        for (int32_t i = 0; !closed && i + 1 < n; i++) {
            triangle(s, UPPER, s->ring[i], UPPER, s->ring[i + 1], LOWER, s->ring[i + 1]);
            triangle(s, UPPER, s->ring[i], LOWER, s->ring[i + 1], LOWER, s->ring[i]);
        }
    }
}

/* Newell's: along the normal of a facet. */
static rg_vec3 normal_of(const rg_mesh *m, const rg_vec3 *x, int32_t f)
{
    rg_vec3 n = {0, 0, 0};
    const rg_vec3 o = x[m->facet_vertex[m->facet_start[f]]];
    for (int32_t j = m->facet_start[f] + 1; j + 1 < m->facet_start[f + 1]; j++)
        n = rg_vec3_add(
            n, rg_vec3_cross(rg_vec3_sub(x[m->facet_vertex[j]], o), rg_vec3_sub(x[m->facet_vertex[j + 1]], o)));
    return rg_vec3_scale(1 / rg_vec3_length(n), n);
}

static void place(solid *s, const rg_vec3 *x, double thickness)
{
    const rg_mesh *m = s->m;
    double farthest = thickness;
    for (int32_t v = 0; v < m->nv; v++) {
        s->at[v] = -1;
        farthest = fmax(farthest, thickness + fmax(fabs(x[v].x), fmax(fabs(x[v].y), fabs(x[v].z))));
    }
    int power;
    frexp(farthest, &power);
    s->step = ldexp(1, power - STEPS);
    for (int32_t f = 0; f < m->nf; f++) {
        const rg_vec3 n = normal_of(m, x, f);
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            s->facet[j] = f;
            s->at[m->facet_vertex[j]] = j;
            s->place[UPPER][j] = on_lattice(s->step, rg_vec3_axpy(thickness / 2, n, x[m->facet_vertex[j]]));
            s->place[LOWER][j] = on_lattice(s->step, rg_vec3_axpy(-thickness / 2, n, x[m->facet_vertex[j]]));
        }
    }
    for (int32_t v = 0; v < m->nv; v++) {
        int closed;
        if (s->at[v] < 0) continue;
        const int32_t n = go_round(s, v, &closed);
        join(s, n, closed);
    }
}

rg_status rg_solid_make(const rg_memory *mem, const rg_mesh *m, const rg_triangles *t, const rg_vec3 *x,
                        double thickness, rg_solid_take take, void *ctx)
{
    const size_t corners = (size_t)m->facet_start[m->nf];
    solid s = {.m = m, .take = take, .ctx = ctx};
    rg_status status = RG_MEM_ARRAYS(mem, RG_ARRAY(s.place[UPPER], corners), RG_ARRAY(s.place[LOWER], corners),
                                     RG_ARRAY(s.same[UPPER], corners), RG_ARRAY(s.same[LOWER], corners),
                                     RG_ARRAY(s.facet, corners), RG_ARRAY(s.at, (size_t)m->nv),
                                     RG_ARRAY(s.ring, (size_t)m->nf));
    if (status == RG_OK) {
        place(&s, x, thickness);
        status = move_apart(&s, mem);
    }
    if (status == RG_OK) {
        facets(&s, t);
        edges(&s);
        vertices(&s);
    }
    RG_MEM_FREE(mem, s.place[UPPER], s.place[LOWER], s.same[UPPER], s.same[LOWER], s.facet, s.at, s.ring);
    return status;
}
