#include "base/memory.h"
#include "mesh/connect.h"
#include "pattern/pattern.h"

#include <string.h>

/* An ear with an angle of a smaller sine is a sliver, whose hinges are ill-conditioned: taken only where there is no
 * other. */
static const double SLIVER = 0.02;
/* Three points of a drawing on one line turn by rounding only: relative to the lengths, more than 2^-52 times
 * coordinates over lengths for any sheet that keeps its vertices 2e-5 apart. */
static const double COLLINEAR = 1e-10;

typedef struct polygon {
    const rg_vec2 *X;
    int32_t n;
    int32_t *v, *e;  /* [n] corner, and the edge from it to the next one */
    double *score;   /* [n] of cutting off that corner; INFINITY: not possible */
} polygon;

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

/* Short diagonals first, as they bend a facet least; slivers after everything else. */
static double score(const polygon *p, int32_t i)
{
    const int32_t before = (i + p->n - 1) % p->n, after = (i + 1) % p->n;
    const rg_vec2 a = p->X[p->v[before]], b = p->X[p->v[i]], c = p->X[p->v[after]];
    const double at_a = sine(a, b, c), at_b = sine(b, c, a), at_c = sine(c, a, b), least = fmin(at_a, fmin(at_b, at_c));
    if (!(least > COLLINEAR)) return INFINITY;
    for (int32_t j = 0; j < p->n; j++)
        if (j != before && j != i && j != after && in_triangle(a, b, c, p->X[p->v[j]])) return INFINITY;
    const double diagonal = rg_vec2_length(rg_vec2_sub(c, a));
    return least >= SLIVER ? diagonal : 1e6 * diagonal / least;
}

static int32_t best_ear(const polygon *p)
{
    int32_t best = -1;
    for (int32_t i = 0; i < p->n; i++)
        if (p->score[i] < INFINITY && (best < 0 || p->score[i] < p->score[best])) best = i;
    return best;
}

static void remove_corner(polygon *p, int32_t i, int32_t diagonal)
{
    p->e[(i + p->n - 1) % p->n] = diagonal;
    const size_t rest = (size_t)(p->n - i - 1);
    memmove(p->v + i, p->v + i + 1, rest * sizeof *p->v);
    memmove(p->e + i, p->e + i + 1, rest * sizeof *p->e);
    memmove(p->score + i, p->score + i + 1, rest * sizeof *p->score);
    p->n--;
}

static void put_triangle(rg_mesh *m, const polygon *p, int32_t i, int32_t closing)
{
    const int32_t before = (i + p->n - 1) % p->n, after = (i + 1) % p->n, at = m->facet_start[m->nf];
    const int32_t v[3] = {p->v[before], p->v[i], p->v[after]}, e[3] = {p->e[before], p->e[i], closing};
    memcpy(m->facet_vertex + at, v, sizeof v);
    memcpy(m->facet_edge + at, e, sizeof e);
    m->facet_start[++m->nf] = at + 3;
}

/* Cuts off ears until a triangle is left. A facet whose corners lie so close to one line that no ear can be told from a
 * sliver without area stays as it is: it is planar and needs no added crease. */
static void cut_ears(rg_mesh *m, polygon *p)
{
    for (int32_t i = 0; i < p->n; i++) p->score[i] = score(p, i);
    while (p->n > 3) {
        int32_t ear = best_ear(p);
        if (ear < 0) { /* a corner that was cut off may have been in the way of another ear */
            for (int32_t i = 0; i < p->n; i++) p->score[i] = score(p, i);
            ear = best_ear(p);
        }
        if (ear < 0) break;
        const int32_t before = (ear + p->n - 1) % p->n, after = (ear + 1) % p->n;
        m->edge[m->ne][0] = p->v[after];
        m->edge[m->ne][1] = p->v[before];
        m->assignment[m->ne] = RG_FLAT;
        m->target[m->ne] = NAN;
        put_triangle(m, p, ear, m->ne);
        remove_corner(p, ear, m->ne++);
        m->added++;
        const int32_t left = (ear + p->n - 1) % p->n, right = ear % p->n;
        p->score[left] = score(p, left);
        p->score[right] = score(p, right);
    }
    const int32_t at = m->facet_start[m->nf];
    memcpy(m->facet_vertex + at, p->v, (size_t)p->n * sizeof *p->v);
    memcpy(m->facet_edge + at, p->e, (size_t)p->n * sizeof *p->e);
    m->facet_start[++m->nf] = at + p->n;
}

rg_status rg_triangulate_all(const rg_mesh *m, rg_mesh *out)
{
    int32_t most = 3, more = 0;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t n = m->facet_start[f + 1] - m->facet_start[f];
        most = n > most ? n : most;
        more += n - 3;
    }
    const size_t ne = (size_t)m->ne + (size_t)more, nf = (size_t)m->nf + (size_t)more, corners = 3 * nf;
    memset(out, 0, sizeof *out);
    out->mem = m->mem;
    out->size = m->size;
    out->nv = m->nv;
    out->ne = m->ne;
    out->added = m->added;
    out->X = rg_mem_array(&m->mem, (size_t)m->nv, sizeof *out->X);
    out->edge = rg_mem_array(&m->mem, ne, sizeof *out->edge);
    out->assignment = rg_mem_array(&m->mem, ne, 1);
    out->target = rg_mem_array(&m->mem, ne, sizeof *out->target);
    out->facet_start = rg_mem_array(&m->mem, nf + 1, sizeof *out->facet_start);
    out->facet_vertex = rg_mem_array(&m->mem, corners, sizeof *out->facet_vertex);
    out->facet_edge = rg_mem_array(&m->mem, corners, sizeof *out->facet_edge);
    polygon p = {.X = out->X, .v = rg_mem_array(&m->mem, (size_t)most, sizeof *p.v),
                 .e = rg_mem_array(&m->mem, (size_t)most, sizeof *p.e), .score = rg_mem_array(&m->mem, (size_t)most, sizeof *p.score)};
    rg_status s = RG_ENOMEM;
    if (out->X && out->edge && out->assignment && out->target && out->facet_start && out->facet_vertex && out->facet_edge && p.v &&
        p.e && p.score) {
        memcpy(out->X, m->X, (size_t)m->nv * sizeof *out->X);
        memcpy(out->edge, m->edge, (size_t)m->ne * sizeof *out->edge);
        memcpy(out->assignment, m->assignment, (size_t)m->ne);
        memcpy(out->target, m->target, (size_t)m->ne * sizeof *out->target);
        for (int32_t f = 0; f < m->nf; f++) {
            p.n = m->facet_start[f + 1] - m->facet_start[f];
            memcpy(p.v, m->facet_vertex + m->facet_start[f], (size_t)p.n * sizeof *p.v);
            memcpy(p.e, m->facet_edge + m->facet_start[f], (size_t)p.n * sizeof *p.e);
            cut_ears(out, &p);
        }
        s = rg_mesh_connect(out);
    }
    rg_mem_free(&m->mem, p.v);
    rg_mem_free(&m->mem, p.e);
    rg_mem_free(&m->mem, p.score);
    if (s != RG_OK) rg_mesh_free(out);
    return s;
}
