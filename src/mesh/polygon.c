#include "mesh/polygon.h"

#include <string.h>

/* Three points of a drawing on one line turn by rounding only: relative to the lengths, more than 2^-52 times
 * coordinates over lengths for any sheet that keeps its vertices 2e-5 apart. */
static const double COLLINEAR = 1e-10;
/* Angles that differ by less are alike, so that rounding does not choose between the two ways across a square. */
static const double ALIKE = 1e-9;

static double sine(rg_vec2 a, rg_vec2 b, rg_vec2 c) /* of the angle at a */
{
    return rg_vec2_turn(a, b, c) / (rg_vec2_length(rg_vec2_sub(b, a)) * rg_vec2_length(rg_vec2_sub(c, a)));
}

/* Is x in the triangle a b c or, by rounding, on its border? */
static int in_triangle(rg_vec2 a, rg_vec2 b, rg_vec2 c, rg_vec2 x)
{
    const rg_vec2 corner[4] = {a, b, c, a};
    for (int i = 0; i < 3; i++) {
        const rg_vec2 p = corner[i], q = corner[i + 1];
        const double lengths = rg_vec2_length(rg_vec2_sub(q, p)) * rg_vec2_length(rg_vec2_sub(x, p));
        if (rg_vec2_turn(p, q, x) < -COLLINEAR * lengths) return 0;
    }
    return 1;
}

double rg_polygon_least_sine(const rg_polygon *p, int32_t i, int32_t j, int32_t k)
{
    const rg_vec2 a = p->X[p->v[i]], b = p->X[p->v[j]], c = p->X[p->v[k]];
    const double least = fmin(sine(a, b, c), fmin(sine(b, c, a), sine(c, a, b)));
    if (!(least > COLLINEAR)) return 0;
    for (int32_t x = 0; x < p->n; x++)
        if (x != i && x != j && x != k && in_triangle(a, b, c, p->X[p->v[x]])) return 0;
    return least;
}

static rg_vec2 corner(const rg_polygon *p, int32_t i) { return p->X[p->v[(i + p->n) % p->n]]; }

static int is_along(rg_vec2 at, rg_vec2 side, rg_vec2 x)
{
    return fabs(sine(at, side, x)) <= COLLINEAR && rg_vec2_dot(rg_vec2_sub(side, at), rg_vec2_sub(x, at)) > 0;
}

/* Does the ray from corner i to x start inside? Between the sides of a corner of less than half a turn it is left of
 * one and right of the other; at one of more, it does not where it is right of the one and left of the other. */
static int starts_inside(const rg_polygon *p, int32_t i, rg_vec2 x)
{
    const rg_vec2 at = corner(p, i), next = corner(p, i + 1), last = corner(p, i - 1);
    const double of_next = sine(at, next, x), of_last = sine(at, x, last);
    if (is_along(at, next, x) || is_along(at, last, x)) return 0;
    if (sine(at, next, last) > COLLINEAR) return of_next > COLLINEAR && of_last > COLLINEAR;
    return of_next > COLLINEAR || of_last > COLLINEAR;
}

int rg_polygon_has_diagonal(const rg_polygon *p, int32_t i, int32_t j)
{
    const rg_vec2 a = corner(p, i), b = corner(p, j);
    if (!starts_inside(p, i, b) || !starts_inside(p, j, a)) return 0;
    for (int32_t k = 0; k < p->n; k++) {
        const int32_t l = (k + 1) % p->n;
        if (k == i || k == j || l == i || l == j) continue;
        const rg_vec2 c = corner(p, k), d = corner(p, l);
        const double at_c = sine(a, b, c), at_d = sine(a, b, d), at_a = sine(c, d, a), at_b = sine(c, d, b);
        const int one_side = (at_c > COLLINEAR && at_d > COLLINEAR) || (at_c < -COLLINEAR && at_d < -COLLINEAR);
        const int other_side = (at_a > COLLINEAR && at_b > COLLINEAR) || (at_a < -COLLINEAR && at_b < -COLLINEAR);
        if (!one_side && !other_side) return 0;
    }
    return 1;
}

double rg_polygon_least_sine_at(const rg_polygon *p, int32_t i, int32_t j)
{
    const rg_vec2 a = corner(p, i), b = corner(p, j);
    const double at_a = fmin(fabs(sine(a, b, corner(p, i - 1))), fabs(sine(a, b, corner(p, i + 1))));
    return fmin(at_a, fmin(fabs(sine(b, a, corner(p, j - 1))), fabs(sine(b, a, corner(p, j + 1)))));
}

int32_t rg_polygon_add_diagonal(rg_mesh *m, int32_t from, int32_t to)
{
    m->edge[m->ne][0] = from;
    m->edge[m->ne][1] = to;
    m->assignment[m->ne] = RG_FLAT;
    m->target[m->ne] = NAN;
    m->added++;
    return m->ne++;
}

void rg_polygon_add_triangle(rg_mesh *m, const int32_t v[3], const int32_t e[3])
{
    const int32_t at = m->facet_start[m->nf];
    memcpy(m->facet_vertex + at, v, 3 * sizeof *v);
    memcpy(m->facet_edge + at, e, 3 * sizeof *e);
    m->facet_start[++m->nf] = at + 3;
}

static int is_side(const rg_polygon *p, int32_t i, int32_t j) { return j - i == 1 || j - i == p->n - 1; }

/* A corner whose angle is in one triangle with both its sides: no diagonal ends there. i < j < k. */
static int32_t leaves_whole(const rg_polygon *p, int32_t i, int32_t j, int32_t k)
{
    const int ij = is_side(p, i, j), jk = is_side(p, j, k), ik = is_side(p, i, k);
    return (p->inside[i] && ij && ik) + (p->inside[j] && ij && jk) + (p->inside[k] && jk && ik);
}

static int is_less(rg_polygon_cost a, rg_polygon_cost b)
{
    return a.whole != b.whole ? a.whole < b.whole : a.sharp < b.sharp * (1 - ALIKE);
}

/* The best way to cut the corners i ... k off along i k, those of all shorter chains being known. */
static void cut_chain(const rg_polygon *p, int32_t i, int32_t k, rg_polygon_work *w)
{
    rg_polygon_cost best = {INT32_MAX, INFINITY};
    for (int32_t j = i + 1; j < k; j++) {
        const rg_polygon_cost a = w->cost[i * p->n + j], b = w->cost[j * p->n + k];
        if (!(a.sharp < INFINITY && b.sharp < INFINITY)) continue;
        const double least = rg_polygon_least_sine(p, i, j, k);
        if (!(least > 0)) continue;
        const double sharp = fmax(fmax(a.sharp, b.sharp), 1 / least);
        const rg_polygon_cost c = {a.whole + b.whole + leaves_whole(p, i, j, k), sharp};
        if (!is_less(c, best)) continue;
        best = c;
        w->apex[i * p->n + k] = j;
    }
    w->cost[i * p->n + k] = best;
}

/* The edge from corner i to corner k, with the triangles that it cuts off added first. */
static int32_t add_chain(const rg_polygon *p, const int32_t *apex, int32_t i, int32_t k, rg_mesh *m)
{
    if (k - i == 1) return p->e[i];
    const int32_t j = apex[i * p->n + k], v[3] = {p->v[i], p->v[j], p->v[k]};
    const int32_t before = add_chain(p, apex, i, j, m), after = add_chain(p, apex, j, k, m);
    const int32_t across = k - i == p->n - 1 ? p->e[k] : rg_polygon_add_diagonal(m, p->v[k], p->v[i]);
    rg_polygon_add_triangle(m, v, (int32_t[]){before, after, across});
    return across;
}

/* Triangles of positive area that are joined like those of a triangulation cover the facet once, so none of their sides
 * needs to be looked at. The last chain is the whole facet: the side k i is its closing one. */
int rg_polygon_cut(const rg_polygon *p, rg_polygon_work *w, rg_mesh *m)
{
    if (p->n > RG_POLYGON_LARGEST) return 0;
    for (int32_t i = 0; i + 1 < p->n; i++) w->cost[i * p->n + i + 1] = (rg_polygon_cost){0, 0};
    for (int32_t length = 2; length < p->n; length++)
        for (int32_t i = 0; i + length < p->n; i++) cut_chain(p, i, i + length, w);
    if (!(w->cost[p->n - 1].sharp < INFINITY)) return 0;
    add_chain(p, w->apex, 0, p->n - 1, m);
    return 1;
}
