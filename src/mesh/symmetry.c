#include "mesh/symmetry.h"
#include "base/classes.h"
#include "pattern/maps.h"

#include <stdlib.h>
#include <string.h>

/* A mirror line this near to an axis, or to half way between them (radians, twice its angle), lies there. */
static const double ON_AXIS = 1e-9;
/* What is found within the first of these parts of the sheet may be no group, where vertices lie as near to each other:
 * then the next one is tried. */
static const double SAME_PLACE[] = {RG_SAME_PLACE, RG_SAME_PLACE / 30, RG_SAME_PLACE / 1000};
enum { SAME_PLACES = sizeof SAME_PLACE / sizeof *SAME_PLACE };

void rg_symmetry_free(rg_symmetry *G)
{
    if (!G->mem.resize) return;
    const rg_memory mem = G->mem;
    RG_MEM_FREE(&mem, G->A, G->vertex, G->edge, G->crease, G->facet, G->vertex_orbit, G->edge_orbit, G->crease_orbit,
                G->facet_orbit);
    memset(G, 0, sizeof *G);
}

static rg_status make_room(rg_symmetry *G, const rg_memory *mem, const rg_mesh *m, int32_t order)
{
    memset(G, 0, sizeof *G);
    G->mem = *mem;
    G->order = order;
    G->nv = m->nv, G->ne = m->ne, G->N = m->N, G->nf = m->nf;
    const size_t n = (size_t)order, nv = (size_t)m->nv, ne = (size_t)m->ne, N = (size_t)m->N, nf = (size_t)m->nf;
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(G->A, n), RG_ARRAY(G->vertex, n * nv), RG_ARRAY(G->edge, n * ne),
                                      RG_ARRAY(G->crease, n * N), RG_ARRAY(G->facet, n * nf),
                                      RG_ARRAY(G->vertex_orbit, nv), RG_ARRAY(G->edge_orbit, ne),
                                      RG_ARRAY(G->crease_orbit, N), RG_ARRAY(G->facet_orbit, nf));
    if (s != RG_OK) rg_symmetry_free(G);
    return s;
}

/* ------------------------------------------------------------------------ where edges, creases and facets go ---- */

typedef struct ends { int32_t low, high, e; } ends;

static ends ends_of(int32_t a, int32_t b, int32_t e) { return (ends){a < b ? a : b, a < b ? b : a, e}; }

static int by_ends(const void *a, const void *b)
{
    const ends *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return (p->high > q->high) - (p->high < q->high);
}

static int move_edges(rg_symmetry *G, const rg_mesh *m, const ends *sorted, int32_t g)
{
    const int32_t *vertex = G->vertex + (size_t)g * (size_t)m->nv;
    int32_t *edge = G->edge + (size_t)g * (size_t)m->ne, *crease = G->crease + (size_t)g * (size_t)m->N;
    for (int32_t e = 0; e < m->ne; e++) {
        const ends key = ends_of(vertex[m->edge[e][0]], vertex[m->edge[e][1]], e);
        const ends *found = bsearch(&key, sorted, (size_t)m->ne, sizeof key, by_ends);
        if (!found || (m->edge_crease[e] < 0) != (m->edge_crease[found->e] < 0)) return 0;
        edge[e] = found->e;
        if (m->edge_crease[e] >= 0) crease[m->edge_crease[e]] = m->edge_crease[found->e];
    }
    return 1;
}

/* The facet on the left of a corner's edge goes to the one on the left of its image, or on the right, when mirrored. */
static int move_facets(rg_symmetry *G, const rg_mesh *m, int32_t g)
{
    const int32_t *vertex = G->vertex + (size_t)g * (size_t)m->nv, *edge = G->edge + (size_t)g * (size_t)m->ne;
    int32_t *facet = G->facet + (size_t)g * (size_t)m->nf;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t j = m->facet_start[f], e = edge[m->facet_edge[j]];
        const int right = (m->edge[e][0] != vertex[m->facet_vertex[j]]) != (g >= G->turns);
        const int32_t to = m->edge_facet[e][right];
        if (to < 0 || m->facet_start[to + 1] - m->facet_start[to] != m->facet_start[f + 1] - j) return 0;
        facet[f] = to;
    }
    return 1;
}

static void find_orbits(int32_t order, int32_t n, const int32_t *to, int32_t *orbit)
{
    for (int32_t i = 0; i < n; i++) orbit[i] = i;
    for (int32_t g = 1; g < order; g++)
        for (int32_t i = 0; i < n; i++) rg_class_join(orbit, i, to[(size_t)g * (size_t)n + (size_t)i]);
    for (int32_t i = 0; i < n; i++) orbit[i] = rg_class_of(orbit, i);
}

static rg_vec2 turned(const rg_symmetry *G, int32_t g, rg_vec2 d)
{
    const double(*A)[2] = (const double(*)[2])G->A[g];
    return (rg_vec2){A[0][0] * d.x + A[0][1] * d.y, A[1][0] * d.x + A[1][1] * d.y};
}

static void measure_off(rg_symmetry *G, const rg_mesh *m)
{
    for (int32_t g = 0; g < G->order; g++) {
        const int32_t *vertex = G->vertex + (size_t)g * (size_t)m->nv;
        for (int32_t e = 0; e < m->ne; e++) {
            const int32_t a = m->edge[e][0], b = m->edge[e][1];
            const rg_vec2 d = rg_vec2_sub(m->X[b], m->X[a]), there = rg_vec2_sub(m->X[vertex[b]], m->X[vertex[a]]);
            const rg_vec2 image = turned(G, g, d);
            G->off = fmax(G->off, fabs(atan2(rg_vec2_cross(image, there), rg_vec2_dot(image, there))));
        }
    }
}

/* Given A, vertex and turns, the rest. RG_EARG: m does not go to itself. */
static rg_status move_all(rg_symmetry *G, const rg_mesh *m)
{
    ends *sorted = rg_mem_array(&G->mem, (size_t)m->ne, sizeof *sorted);
    if (!sorted) return RG_ENOMEM;
    for (int32_t e = 0; e < m->ne; e++) sorted[e] = ends_of(m->edge[e][0], m->edge[e][1], e);
    qsort(sorted, (size_t)m->ne, sizeof *sorted, by_ends);
    int fits = 1;
    for (int32_t g = 0; fits && g < G->order; g++) fits = move_edges(G, m, sorted, g) && move_facets(G, m, g);
    rg_mem_free(&G->mem, sorted);
    if (!fits) return RG_EARG;
    measure_off(G, m);
    find_orbits(G->order, m->nv, G->vertex, G->vertex_orbit);
    find_orbits(G->order, m->ne, G->edge, G->edge_orbit);
    find_orbits(G->order, m->N, G->crease, G->crease_orbit);
    find_orbits(G->order, m->nf, G->facet, G->facet_orbit);
    return RG_OK;
}

/* ----------------------------------------------------------------------------------- the group of a drawing ---- */

/* An element's angle, 0 ... 2 pi, and its number among the maps. */
typedef struct place { double angle; int32_t n; } place;

static int by_angle(const void *a, const void *b)
{
    const place *p = a, *q = b;
    return p->angle != q->angle ? (p->angle < q->angle ? -1 : 1) : (p->n > q->n) - (p->n < q->n);
}

/* Turns, and mirrors if `mirror`, that keep mountains and valleys, by angle; the one by nothing is the first. */
static int32_t sort(const rg_maps *all, int mirror, place *p)
{
    int32_t n = 0;
    for (int32_t i = 0; i < all->count; i++) {
        const rg_map *g = &all->map[i];
        if (!g->keeps || g->mirror != mirror) continue;
        const double angle = i == 0 ? 0 : atan2(g->s, g->c);
        p[n++] = (place){angle < 0 ? angle + 2 * RG_PI : angle, i};
    }
    qsort(p, (size_t)n, sizeof *p, by_angle);
    return n;
}

static const int32_t *of_vertices(const rg_maps *all, int32_t n) { return all->vertex + (size_t)n * (size_t)all->nv; }

/* Is going by a after b the same as going by c? */
static int is_product(const rg_maps *all, int32_t a, int32_t b, int32_t c)
{
    const int32_t *by_a = of_vertices(all, a), *by_b = of_vertices(all, b), *by_c = of_vertices(all, c);
    for (int32_t v = 0; v < all->nv; v++)
        if (by_a[by_b[v]] != by_c[v]) return 0;
    return 1;
}

/* Elements by angle are a group when each is the one before, turned by the least turn, all round; and when a mirror
 * undoes itself and turns the other way round. */
static int is_group(const rg_maps *all, const place *turn, int32_t turns, const place *mirror, int32_t mirrors)
{
    const int32_t least = turn[turns > 1].n;
    if (mirrors != 0 && mirrors != turns) return 0;
    for (int32_t k = 0; k < turns; k++)
        if (!is_product(all, least, turn[k].n, turn[(k + 1) % turns].n)) return 0;
    for (int32_t k = 0; k < mirrors; k++)
        if (!is_product(all, least, mirror[k].n, mirror[(k + 1) % turns].n)) return 0;
    return mirrors == 0 || (is_product(all, mirror[0].n, mirror[0].n, turn[0].n) &&
                            is_product(all, mirror[0].n, least, mirror[turns - 1].n));
}

/* Cosine and sine, exact where they are 0, 1 or -1. */
static void cos_sin(double angle, double *c, double *s)
{
    const double quarter = angle / (RG_PI / 2), nearest = round(quarter);
    *c = cos(angle), *s = sin(angle);
    if (fabs(quarter - nearest) > 1e-12) return;
    const int q = (int)fmod(fmod(nearest, 4) + 4, 4);
    *c = q == 0 ? 1 : q == 2 ? -1 : 0;
    *s = q == 1 ? 1 : q == 3 ? -1 : 0;
}

/* A drawing's angles are off by what its vertices are: turns are by even steps, mirror lines lie evenly about their
 * mean, which is taken along an axis if it is as good as along it. */
static void fill_matrices(rg_symmetry *G, const place *mirror)
{
    const int32_t n = G->turns;
    const double step = 2 * RG_PI / n;
    double c, s, first = 0;
    for (int32_t k = 0; k < G->order - n; k++) first += (mirror[k].angle - step * k) / n;
    const double even = round(first / (RG_PI / 2)) * RG_PI / 2;
    if (fabs(first - even) <= ON_AXIS) first = even;
    for (int32_t g = 0; g < G->order; g++) {
        const int sign = g < n ? 1 : -1;
        cos_sin(g < n ? step * g : first + step * (g - n), &c, &s);
        G->A[g][0][0] = c, G->A[g][0][1] = -sign * s;
        G->A[g][1][0] = s, G->A[g][1][1] = sign * c;
    }
}

static rg_status adopt(rg_symmetry *G, const rg_memory *mem, const rg_mesh *m, const rg_maps *all, const place *turn,
                       int32_t turns, const place *mirror, int32_t mirrors)
{
    const size_t nv = (size_t)m->nv;
    rg_status s = make_room(G, mem, m, turns + mirrors);
    if (s != RG_OK) return s;
    G->turns = turns;
    G->middle = all->middle;
    for (int32_t g = 0; g < G->order; g++) {
        const int32_t n = g < turns ? turn[g].n : mirror[g - turns].n;
        memcpy(G->vertex + (size_t)g * nv, of_vertices(all, n), nv * sizeof *G->vertex);
    }
    fill_matrices(G, mirror);
    s = move_all(G, m);
    if (s != RG_OK) rg_symmetry_free(G);
    return s;
}

static rg_status only_nothing(rg_symmetry *G, const rg_memory *mem, const rg_mesh *m)
{
    rg_status s = make_room(G, mem, m, 1);
    if (s != RG_OK) return s;
    G->turns = 1;
    G->A[0][0][0] = G->A[0][1][1] = 1;
    for (int32_t v = 0; v < m->nv; v++) G->vertex[v] = v;
    return move_all(G, m);
}

/* Within tol. *found: zero if that makes no group. */
static rg_status find_within(rg_symmetry *G, const rg_memory *mem, const rg_mesh *m, const rg_edge *E, double tol,
                             int *found)
{
    rg_maps all;
    *found = 0;
    rg_status s = rg_maps_find(&all, mem, m->nv, m->X, m->ne, E, tol);
    if (s != RG_OK) return s;
    place *turn, *mirror;
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(turn, (size_t)all.count), RG_ARRAY(mirror, (size_t)all.count));
    if (s == RG_OK) {
        const int32_t turns = sort(&all, 0, turn), mirrors = sort(&all, 1, mirror);
        if (turns > 0 && is_group(&all, turn, turns, mirror, mirrors)) {
            s = adopt(G, mem, m, &all, turn, turns, mirror, mirrors);
            *found = s == RG_OK;
            if (s == RG_EARG) s = RG_OK;
        }
    }
    RG_MEM_FREE(mem, turn, mirror);
    rg_maps_free(&all);
    return s;
}

rg_status rg_symmetry_find(rg_symmetry *G, const rg_memory *mem, const rg_mesh *m)
{
    int found = 0;
    memset(G, 0, sizeof *G);
    rg_edge *E = rg_mem_array(mem, (size_t)m->ne, sizeof *E);
    if (!E) return RG_ENOMEM;
    for (int32_t e = 0; e < m->ne; e++)
        E[e] = (rg_edge){{m->edge[e][0], m->edge[e][1]}, m->assignment[e], m->target[e], 0, e};
    rg_status s = RG_OK;
    for (int k = 0; s == RG_OK && !found && k < SAME_PLACES; k++)
        s = find_within(G, mem, m, E, SAME_PLACE[k] * m->size, &found);
    if (s == RG_OK && !found) s = only_nothing(G, mem, m);
    rg_mem_free(mem, E);
    return s;
}

/* ------------------------------------------------------------------------------------- parts, other meshes ---- */

rg_status rg_symmetry_on(rg_symmetry *out, const rg_symmetry *G, const rg_mesh *m)
{
    rg_status s = make_room(out, &G->mem, m, G->order);
    if (s != RG_OK) return s;
    out->turns = G->turns;
    out->middle = G->middle;
    memcpy(out->A, G->A, (size_t)G->order * sizeof *G->A);
    memcpy(out->vertex, G->vertex, (size_t)G->order * (size_t)G->nv * sizeof *G->vertex);
    s = move_all(out, m);
    if (s != RG_OK) rg_symmetry_free(out);
    return s;
}

static void copy_element(rg_symmetry *out, int32_t to, const rg_symmetry *G, int32_t g)
{
    memcpy(out->A[to], G->A[g], sizeof *G->A);
    const struct { int32_t *to, *from; size_t n; } of[] = {
        {out->vertex, G->vertex, (size_t)G->nv}, {out->edge, G->edge, (size_t)G->ne},
        {out->crease, G->crease, (size_t)G->N}, {out->facet, G->facet, (size_t)G->nf}};
    for (int i = 0; i < 4; i++)
        memcpy(of[i].to + (size_t)to * of[i].n, of[i].from + (size_t)g * of[i].n, of[i].n * sizeof(int32_t));
}

rg_status rg_symmetry_part(rg_symmetry *out, const rg_symmetry *G, int32_t every, int32_t mirror)
{
    const int32_t turns = G->turns / every, mirrors = mirror < 0 || G->order == G->turns ? 0 : turns;
    const rg_mesh size = {.nv = G->nv, .ne = G->ne, .N = G->N, .nf = G->nf};
    const rg_status s = make_room(out, &G->mem, &size, turns + mirrors);
    if (s != RG_OK) return s;
    out->turns = turns;
    out->middle = G->middle;
    out->off = G->off;
    for (int32_t k = 0; k < turns; k++) copy_element(out, k, G, k * every);
    for (int32_t k = 0; k < mirrors; k++) copy_element(out, turns + k, G, G->turns + mirror + k * every);
    find_orbits(out->order, out->nv, out->vertex, out->vertex_orbit);
    find_orbits(out->order, out->ne, out->edge, out->edge_orbit);
    find_orbits(out->order, out->N, out->crease, out->crease_orbit);
    find_orbits(out->order, out->nf, out->facet, out->facet_orbit);
    return RG_OK;
}

static int is_before(rg_subgroup a, rg_subgroup b)
{
    return a.order != b.order ? a.order > b.order : (a.mirror < 0) > (b.mirror < 0);
}

/* Mirrors that a turn of G takes to each other make parts that are alike: with an even `every` there are two kinds. */
int32_t rg_symmetry_subgroups(const rg_symmetry *G, rg_subgroup *list, int32_t most)
{
    int32_t n = 0;
    for (int32_t every = 1; every <= G->turns; every++) {
        if (G->turns % every != 0) continue;
        const int32_t kinds = G->order == G->turns ? 0 : every % 2 == 0 ? 2 : 1;
        for (int32_t mirror = -1; mirror < kinds; mirror++) {
            const rg_subgroup part = {every, mirror, G->turns / every * (mirror < 0 ? 1 : 2)};
            int32_t i = n < most ? n++ : most; /* of more the largest are kept */
            for (; i > 0 && is_before(part, list[i - 1]); i--)
                if (i < most) list[i] = list[i - 1];
            if (i < most) list[i] = part;
        }
    }
    return n;
}

/* ---------------------------------------------------------------------------------------------------- means ---- */

void rg_symmetry_mean(const rg_symmetry *G, double *x)
{
    const size_t N = (size_t)G->N;
    for (size_t i = 0; i < N; i++) {
        if (G->crease_orbit[i] != (int32_t)i) continue;
        double sum = 0;
        int alike = 1;
        for (size_t g = 0; g < (size_t)G->order; g++) {
            const double there = x[G->crease[g * N + i]];
            sum += there;
            alike &= there == x[i];
        }
        for (size_t g = 0; !alike && g < (size_t)G->order; g++) x[G->crease[g * N + i]] = sum / G->order;
    }
}

void rg_symmetry_mean_vectors(const rg_symmetry *G, rg_vec2 *d)
{
    const size_t nv = (size_t)G->nv;
    if (G->order == 1) return;
    for (size_t v = 0; v < nv; v++) {
        if (G->vertex_orbit[v] != (int32_t)v) continue;
        rg_vec2 mean = {0, 0};
        for (size_t g = 0; g < (size_t)G->order; g++) {
            const double(*A)[2] = (const double(*)[2])G->A[g];
            const rg_vec2 there = d[G->vertex[g * nv + v]];
            mean.x += (A[0][0] * there.x + A[1][0] * there.y) / G->order;
            mean.y += (A[0][1] * there.x + A[1][1] * there.y) / G->order;
        }
        for (int32_t g = 0; g < G->order; g++) d[G->vertex[(size_t)g * nv + v]] = turned(G, g, mean);
    }
}

double rg_symmetry_off(const rg_symmetry *G, const double *x)
{
    double most = 0;
    for (size_t n = 0; n < (size_t)G->order * (size_t)G->N; n++) {
        const double off = fabs(x[G->crease[n]] - x[n % (size_t)G->N]);
        if (isnan(off)) return NAN;
        most = fmax(most, off);
    }
    return most;
}
