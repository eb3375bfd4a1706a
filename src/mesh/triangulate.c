#include "base/memory.h"
#include "mesh/connect.h"
#include "mesh/inside.h"
#include "mesh/polygon.h"
#include "mesh/symmetry.h"

#include <string.h>

/* An ear with an angle of a smaller sine is a sliver, whose hinges are ill-conditioned: taken only where there is no
 * other. An ear at an inside angle waits even longer, for one that leaves it to be split. */
static const double SLIVER = 0.02, OF_SLIVER = 1e6, OF_INSIDE = 1e20;
/* Lengths that differ by less are alike: rounding does not choose. */
static const double ALIKE = 1e-9;

/* Of cutting off that corner; short diagonals first, as they bend a facet least. INFINITY: not possible. */
static double score(const rg_polygon *p, int32_t i)
{
    const int32_t before = (i + p->n - 1) % p->n, after = (i + 1) % p->n;
    const double least = rg_polygon_least_sine(p, before, i, after);
    if (!(least > 0)) return INFINITY;
    const double diagonal = rg_vec2_length(rg_vec2_sub(p->X[p->v[after]], p->X[p->v[before]]));
    return (least >= SLIVER ? diagonal : OF_SLIVER * diagonal / least) * (p->inside[i] ? OF_INSIDE : 1);
}

static int32_t best_ear(const rg_polygon *p, const double *of)
{
    int32_t best = -1;
    for (int32_t i = 0; i < p->n; i++)
        if (of[i] < INFINITY && (best < 0 || of[i] < of[best])) best = i;
    return best;
}

static void remove_corner(rg_polygon *p, double *of, int32_t i, int32_t diagonal)
{
    p->e[(i + p->n - 1) % p->n] = diagonal;
    const size_t rest = (size_t)(p->n - i - 1);
    memmove(p->v + i, p->v + i + 1, rest * sizeof *p->v);
    memmove(p->e + i, p->e + i + 1, rest * sizeof *p->e);
    memmove(p->inside + i, p->inside + i + 1, rest);
    memmove(of + i, of + i + 1, rest * sizeof *of);
    p->n--;
}

static void put_ear(rg_mesh *m, const rg_polygon *p, int32_t i, int32_t diagonal)
{
    const int32_t before = (i + p->n - 1) % p->n, after = (i + 1) % p->n;
    rg_polygon_add_triangle(m, (int32_t[]){p->v[before], p->v[i], p->v[after]},
                            (int32_t[]){p->e[before], p->e[i], diagonal});
}

/* What is left of a facet, as a facet. */
static void put_rest(rg_mesh *m, const rg_polygon *p)
{
    const int32_t at = m->facet_start[m->nf];
    memcpy(m->facet_vertex + at, p->v, (size_t)p->n * sizeof *p->v);
    memcpy(m->facet_edge + at, p->e, (size_t)p->n * sizeof *p->e);
    m->facet_start[++m->nf] = at + p->n;
}

/* Cuts off ears until a triangle is left. A facet whose corners lie so close to one line that no ear can be told from a
 * sliver without area stays as it is: it is planar and needs no added crease. */
static void cut_ears(rg_mesh *m, rg_polygon *p, double *of)
{
    for (int32_t i = 0; i < p->n; i++) of[i] = score(p, i);
    while (p->n > 3) {
        int32_t ear = best_ear(p, of);
        if (ear < 0) { /* a corner that was cut off may have been in the way of another ear */
            for (int32_t i = 0; i < p->n; i++) of[i] = score(p, i);
            ear = best_ear(p, of);
        }
        if (ear < 0) break;
        const int32_t before = (ear + p->n - 1) % p->n, after = (ear + 1) % p->n;
        const int32_t diagonal = rg_polygon_add_diagonal(m, p->v[after], p->v[before]);
        p->inside[before] = p->inside[after] = 0;
        put_ear(m, p, ear, diagonal);
        remove_corner(p, of, ear, diagonal);
        const int32_t left = (ear + p->n - 1) % p->n, right = ear % p->n;
        of[left] = score(p, left);
        of[right] = score(p, right);
    }
    put_rest(m, p);
}

/* ------------------------------------------------------------------------------------------------- by orbit ---- */

typedef struct cutter {
    const rg_mesh *m;
    const rg_symmetry *G;        /* on m; NULL: none */
    int split;
    const unsigned char *which;  /* [m->nf] NULL: all */
    unsigned char *inside;       /* along m->facet_vertex */
    rg_polygon p;                /* the facet that is being cut */
    rg_polygon_work w;
    double *of;                  /* [most corners] scratch */
    int32_t *at;                 /* [m->nv] corner of p at that vertex */
    int32_t *chord;              /* [3 corners] i, j, edge: the diagonals across p */
    int32_t chords;
    struct pieces { int32_t facet, facets, edge, edges; } *made; /* [m->nf] what a facet became in out */
    int across;                  /* out: facets were cut across, whose pieces may be cut on */
    rg_mesh *out;
} cutter;

static const int32_t *moved(const int32_t *to, int32_t g, int32_t n) { return to + (size_t)g * (size_t)n; }

static int32_t representative(const cutter *c, int32_t f) { return c->G ? c->G->facet_orbit[f] : f; }

static int stays(const cutter *c, int32_t g, int32_t f) { return moved(c->G->facet, g, c->m->nf)[f] == f; }

static int is_fixed(const cutter *c, int32_t f)
{
    for (int32_t g = 1; c->G && g < c->G->order; g++)
        if (stays(c, g, f)) return 1;
    return 0;
}

static void load(cutter *c, int32_t f)
{
    const int32_t first = c->m->facet_start[f];
    c->p.n = c->m->facet_start[f + 1] - first;
    c->p.inside = c->inside + first;
    memcpy(c->p.v, c->m->facet_vertex + first, (size_t)c->p.n * sizeof *c->p.v);
    memcpy(c->p.e, c->m->facet_edge + first, (size_t)c->p.n * sizeof *c->p.e);
}

/* Are the diagonals i j and k l, corners of one facet, in each other's way? */
static int cross(int32_t i, int32_t j, int32_t k, int32_t l)
{
    const int k_between = k > i && k < j, l_between = l > i && l < j;
    return k != i && k != j && l != i && l != j && k_between != l_between;
}

static void swap_to_rise(int32_t *i, int32_t *j)
{
    const int32_t was = *i;
    if (*i > *j) *i = *j, *j = was;
}

/* The image of corners i < j, again rising. */
static void move_corners(const cutter *c, int32_t g, int32_t *i, int32_t *j)
{
    const int32_t *vertex = moved(c->G->vertex, g, c->m->nv);
    *i = c->at[vertex[c->p.v[*i]]];
    *j = c->at[vertex[c->p.v[*j]]];
    swap_to_rise(i, j);
}

static int may_cross_facet(const cutter *c, int32_t f, int32_t i, int32_t j)
{
    for (int32_t g = 0; g < c->G->order; g++) {
        int32_t k = i, l = j;
        if (!stays(c, g, f)) continue;
        move_corners(c, g, &k, &l);
        if (cross(i, j, k, l) || !rg_polygon_has_diagonal(&c->p, k, l)) return 0;
    }
    return 1;
}

/* As that of an ear: short ones first, slivers last, but one that splits an inside angle before all, and one that cuts
 * it off unsplit after all. */
static double score_across(const rg_polygon *p, int32_t i, int32_t j)
{
    const double length = rg_vec2_length(rg_vec2_sub(p->X[p->v[j]], p->X[p->v[i]]));
    const double least = rg_polygon_least_sine_at(p, i, j);
    double s = least >= SLIVER ? length : OF_SLIVER * length / least;
    if (p->inside[i] || p->inside[j]) s /= OF_INSIDE;
    if ((j - i == 2 && p->inside[i + 1]) || (p->n - j + i == 2 && p->inside[(j + 1) % p->n])) s *= OF_INSIDE;
    return s;
}

/* Every orbit of diagonals has one at the least corner of an orbit of corners. Zero: none divides the facet. */
static int best_across(const cutter *c, int32_t f, int32_t *best_i, int32_t *best_j)
{
    double best = INFINITY;
    for (int32_t i = 0; i < c->p.n; i++) {
        int32_t least = i;
        for (int32_t g = 1; g < c->G->order; g++) {
            const int32_t to = stays(c, g, f) ? c->at[moved(c->G->vertex, g, c->m->nv)[c->p.v[i]]] : i;
            least = to < least ? to : least;
        }
        for (int32_t n = 2; least == i && n <= c->p.n - 2; n++) {
            int32_t k = i, l = (i + n) % c->p.n;
            swap_to_rise(&k, &l);
            const double s = score_across(&c->p, k, l);
            if (!(s < best * (1 - ALIKE)) || !may_cross_facet(c, f, k, l)) continue;
            best = s;
            *best_i = k, *best_j = l;
        }
    }
    return best < INFINITY;
}

static void draw_across(cutter *c, int32_t f, int32_t i, int32_t j)
{
    c->chords = 0;
    for (int32_t g = 0; g < c->G->order; g++) {
        int32_t k = i, l = j, known = 0;
        if (!stays(c, g, f)) continue;
        move_corners(c, g, &k, &l);
        for (int32_t n = 0; n < c->chords; n++) known |= c->chord[3 * n] == k && c->chord[3 * n + 1] == l;
        if (known) continue;
        int32_t *chord = c->chord + 3 * c->chords++;
        chord[0] = k, chord[1] = l;
        chord[2] = rg_polygon_add_diagonal(c->out, c->p.v[k], c->p.v[l]);
    }
}

/* The chord from corner i that goes farthest, not beyond corner k and not from corner `first` to `last`; -1: none. */
static int32_t farthest(const cutter *c, int32_t i, int32_t k, int32_t first, int32_t last)
{
    int32_t best = -1;
    for (int32_t n = 0; n < c->chords; n++) {
        const int32_t *chord = c->chord + 3 * n;
        if (chord[0] != i || chord[1] > k || (chord[0] == first && chord[1] == last)) continue;
        if (best < 0 || chord[1] > c->chord[3 * best + 1]) best = n;
    }
    return best;
}

/* The pieces of the corners first ... last, which edge `closing` closes: what chords cut off, then what is left. */
static void put_pieces(cutter *c, int32_t first, int32_t last, int32_t closing)
{
    for (int32_t i = first; i < last;) {
        const int32_t n = farthest(c, i, last, first, last);
        if (n >= 0) put_pieces(c, i, c->chord[3 * n + 1], c->chord[3 * n + 2]);
        i = n < 0 ? i + 1 : c->chord[3 * n + 1];
    }
    int32_t at = c->out->facet_start[c->out->nf];
    for (int32_t i = first; i < last;) {
        const int32_t n = farthest(c, i, last, first, last);
        c->out->facet_vertex[at] = c->p.v[i];
        c->out->facet_edge[at++] = n < 0 ? c->p.e[i] : c->chord[3 * n + 2];
        i = n < 0 ? i + 1 : c->chord[3 * n + 1];
    }
    c->out->facet_vertex[at] = c->p.v[last];
    c->out->facet_edge[at++] = closing;
    c->out->facet_start[++c->out->nf] = at;
}

/* Zero: nothing divides it. */
static int cut_across(cutter *c, int32_t f)
{
    int32_t i = 0, j = 0;
    for (int32_t k = 0; k < c->p.n; k++) c->at[c->p.v[k]] = k;
    if (!best_across(c, f, &i, &j)) return 0;
    draw_across(c, f, i, j);
    put_pieces(c, 0, c->p.n - 1, c->p.e[c->p.n - 1]);
    c->across = 1;
    return 1;
}

/* Piece t of facet f, moved by g, as the last facet of out or, put zero, looked at only: zero if it is turned over. */
static int move_piece(cutter *c, int32_t f, int32_t g, int32_t t, int32_t first_edge, int put)
{
    rg_mesh *o = c->out;
    const int32_t *vertex = moved(c->G->vertex, g, c->m->nv), *edge = moved(c->G->edge, g, c->m->ne);
    const int32_t first = o->facet_start[t], n = o->facet_start[t + 1] - first, mirrored = g >= c->G->turns;
    if (!put) {
        int32_t v[3];
        for (int32_t k = 0; k < 3; k++) v[k] = vertex[o->facet_vertex[first + (mirrored ? 2 - k : k)]];
        return n > 3 || rg_vec2_turn(o->X[v[0]], o->X[v[1]], o->X[v[2]]) > 0;
    }
    const int32_t at = o->facet_start[o->nf];
    for (int32_t k = 0; k < n; k++) {
        const int32_t from = mirrored ? n - 1 - k : k, by = mirrored ? (from + n - 1) % n : from;
        const int32_t e = o->facet_edge[first + by];
        o->facet_vertex[at + k] = vertex[o->facet_vertex[first + from]];
        o->facet_edge[at + k] = e < c->m->ne ? edge[e] : first_edge + (e - c->made[f].edge);
    }
    o->facet_start[++o->nf] = at + n;
    return 1;
}

/* A drawing by hand may be less like its images than a sliver is wide. */
static int images_are_proper(cutter *c, int32_t f)
{
    for (int32_t g = 1; c->G && g < c->G->order; g++)
        for (int32_t t = 0; t < c->made[f].facets; t++)
            if (!move_piece(c, f, g, c->made[f].facet + t, 0, 0)) return 0;
    return 1;
}

static void cut_first(cutter *c, int32_t f)
{
    rg_mesh *o = c->out;
    const int whole = c->which && !c->which[f], fixed = is_fixed(c, f);
    const struct pieces before = {o->nf, 0, o->ne, 0};
    if (whole || (fixed && !cut_across(c, f))) put_rest(o, &c->p);
    else if (!fixed && !(c->split && rg_polygon_cut(&c->p, &c->w, o))) cut_ears(o, &c->p, c->of);
    c->made[f] = (struct pieces){before.facet, o->nf - before.facet, before.edge, o->ne - before.edge};
    if (c->made[f].facets == 1 || images_are_proper(c, f)) return;
    o->added -= c->made[f].edges;
    o->nf = before.facet, o->ne = before.edge;
    load(c, f);
    put_rest(o, &c->p);
    c->made[f] = (struct pieces){before.facet, 1, before.edge, 0};
}

static void cut_image(cutter *c, int32_t first, int32_t f)
{
    const struct pieces *of = &c->made[first];
    const int32_t edge = c->out->ne;
    int32_t g = 0;
    c->made[f] = (struct pieces){c->out->nf, of->facets, edge, of->edges};
    if (of->facets == 1) {
        put_rest(c->out, &c->p);
        return;
    }
    while (moved(c->G->facet, g, c->m->nf)[first] != f) g++;
    const int32_t *vertex = moved(c->G->vertex, g, c->m->nv);
    for (int32_t n = 0; n < of->edges; n++) {
        const int32_t *from = c->out->edge[of->edge + n];
        rg_polygon_add_diagonal(c->out, vertex[from[0]], vertex[from[1]]);
    }
    for (int32_t t = 0; t < of->facets; t++) move_piece(c, first, g, of->facet + t, edge, 1);
}

static void cut_facets(cutter *c)
{
    for (int32_t f = 0; f < c->m->nf; f++) {
        const int32_t first = representative(c, f);
        load(c, f);
        if (first == f) cut_first(c, f);
        else cut_image(c, first, f);
    }
}

/* Which pieces are to be cut on: next[c->out->nf], all zero if none is. */
static void tell_next(const cutter *c, unsigned char *next)
{
    memset(next, 0, (size_t)c->out->nf);
    for (int32_t f = 0; c->across && f < c->m->nf; f++)
        memset(next + c->made[f].facet, !c->which || c->which[representative(c, f)], (size_t)c->made[f].facets);
}

static rg_status cut_all(const rg_mesh *m, const rg_symmetry *G, int split, const unsigned char *which, int32_t most,
                         unsigned char *next, rg_mesh *out)
{
    const size_t n = (size_t)most, table = (size_t)(most < RG_POLYGON_LARGEST ? most : RG_POLYGON_LARGEST);
    cutter c = {.m = m, .G = G, .split = split, .which = which, .out = out, .p.X = out->X};
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(c.inside, (size_t)m->facet_start[m->nf]), RG_ARRAY(c.of, n),
                                RG_ARRAY(c.p.v, n), RG_ARRAY(c.p.e, n), RG_ARRAY(c.w.cost, table * table),
                                RG_ARRAY(c.w.apex, table * table), RG_ARRAY(c.at, (size_t)m->nv),
                                RG_ARRAY(c.chord, 3 * n), RG_ARRAY(c.made, (size_t)m->nf));
    if (s == RG_OK && split) s = rg_inside_find(m, c.inside);
    if (s == RG_OK) cut_facets(&c);
    if (s == RG_OK && next) tell_next(&c, next);
    RG_MEM_FREE(&m->mem, c.inside, c.of, c.p.v, c.p.e, c.w.cost, c.w.apex, c.at, c.chord, c.made);
    return s;
}

/* Once. next: as tell_next, with room for one more than there are corners; NULL: nobody asks. */
static rg_status triangulate(const rg_mesh *m, const rg_symmetry *G, int split, const unsigned char *which,
                             unsigned char *next, rg_mesh *out)
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
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(out->X, (size_t)m->nv), RG_ARRAY(out->edge, ne),
                                RG_ARRAY(out->assignment, ne), RG_ARRAY(out->target, ne),
                                RG_ARRAY(out->facet_start, nf + 1), RG_ARRAY(out->facet_vertex, corners),
                                RG_ARRAY(out->facet_edge, corners));
    if (s == RG_OK && m->still) s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(out->still, ne));
    if (s == RG_OK) {
        memcpy(out->X, m->X, (size_t)m->nv * sizeof *out->X);
        memcpy(out->edge, m->edge, (size_t)m->ne * sizeof *out->edge);
        memcpy(out->assignment, m->assignment, (size_t)m->ne);
        memcpy(out->target, m->target, (size_t)m->ne * sizeof *out->target);
        if (m->still) memcpy(out->still, m->still, (size_t)m->ne);
        s = cut_all(m, G, split, which, most, next, out);
    }
    if (s == RG_OK) s = rg_mesh_connect(out);
    if (s != RG_OK) rg_mesh_free(out);
    return s;
}

rg_status rg_triangulate_all(const rg_mesh *m, rg_mesh *out) { return triangulate(m, NULL, 1, NULL, NULL, out); }

rg_status rg_triangulate_short(const rg_mesh *m, rg_mesh *out) { return triangulate(m, NULL, 0, NULL, NULL, out); }

rg_status rg_triangulate_some(const rg_mesh *m, const unsigned char *which, int shorter, rg_mesh *out)
{
    return triangulate(m, NULL, !shorter, which, NULL, out);
}

rg_status rg_triangulate_orbits(const rg_mesh *m, const rg_symmetry *G, const unsigned char *which, int shorter,
                                rg_mesh *out)
{
    if (!G || G->order == 1) return rg_triangulate_some(m, which, shorter, out);
    const size_t corners = (size_t)m->facet_start[m->nf];
    unsigned char *now, *next;
    memset(out, 0, sizeof *out);
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(now, corners), RG_ARRAY(next, corners));
    if (s == RG_OK) s = triangulate(m, G, !shorter, which, next, out);
    /* What was cut across is cut on, as a sheet of its own. */
    while (s == RG_OK && memchr(next, 1, (size_t)out->nf)) {
        rg_mesh before = *out;
        unsigned char *was = now;
        rg_symmetry on;
        now = next, next = was;
        s = rg_symmetry_on(&on, G, &before);
        memset(out, 0, sizeof *out);
        if (s == RG_OK) s = triangulate(&before, &on, !shorter, now, next, out);
        rg_symmetry_free(&on);
        rg_mesh_free(&before);
    }
    RG_MEM_FREE(&m->mem, now, next);
    return s;
}

/* Edges of m keep their numbers and directions; what lies across an added one is of the same facet. */
void rg_triangulate_trace(const rg_mesh *m, const rg_mesh *cut, int32_t *facet)
{
    for (int32_t t = 0; t < cut->nf; t++) facet[t] = -1;
    for (int32_t e = 0; e < m->ne; e++)
        for (int side = 0; side < 2; side++)
            if (cut->edge_facet[e][side] >= 0) facet[cut->edge_facet[e][side]] = m->edge_facet[e][side];
    for (int more = 1; more;) {
        more = 0;
        for (int32_t e = m->ne; e < cut->ne; e++)
            for (int side = 0; side < 2; side++) {
                const int32_t here = cut->edge_facet[e][side], there = cut->edge_facet[e][!side];
                if (facet[here] >= 0 || facet[there] < 0) continue;
                facet[here] = facet[there];
                more = 1;
            }
    }
}
