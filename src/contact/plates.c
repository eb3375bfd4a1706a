#include "contact/plates.h"

#include <stdlib.h>
#include <string.h>

/* Sine of a corner turned inwards that still counts as straight: drawings are rounded. */
static const double STRAIGHT = -1e-7;
/* Facets of more corners are left as triangles: putting them together again takes the third power of the corners. */
enum { JOINED_LARGEST = 64 };

/* -------------------------------------------------------------------------- convex parts ---- */

static double corner_sine(const rg_vec2 *X, int32_t a, int32_t b, int32_t c)
{
    const rg_vec2 u = rg_vec2_sub(X[b], X[a]), v = rg_vec2_sub(X[c], X[b]);
    const double n = sqrt(rg_vec2_dot(u, u) * rg_vec2_dot(v, v));
    return n > 0 ? rg_vec2_cross(u, v) / n : 0;
}

static int is_convex(const rg_vec2 *X, const int32_t *v, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        if (!(corner_sine(X, v[i], v[(i + 1) % n], v[(i + 2) % n]) >= STRAIGHT)) return 0;
    return 1;
}

static int in_triangle(const rg_vec2 *X, int32_t a, int32_t b, int32_t c, int32_t p)
{
    return p != a && p != b && p != c && rg_vec2_turn(X[a], X[b], X[p]) >= 0 && rg_vec2_turn(X[b], X[c], X[p]) >= 0 &&
           rg_vec2_turn(X[c], X[a], X[p]) >= 0;
}

/* The corner of v that is best cut off; -1: none can be. */
static int32_t best_ear(const rg_vec2 *X, const int32_t *v, int32_t n)
{
    int32_t best = -1;
    double most = 0;
    for (int32_t i = 0; i < n; i++) {
        const int32_t a = v[(i + n - 1) % n], b = v[i], c = v[(i + 1) % n];
        const double sine = corner_sine(X, a, b, c);
        int whole = sine > most;
        for (int32_t k = 0; whole && k < n; k++) whole = !in_triangle(X, a, b, c, v[k]);
        if (whole) most = sine, best = i;
    }
    return best;
}

static void add_part(rg_plates *p, int32_t f, const int32_t *v, int32_t n)
{
    p->facet[p->parts] = f;
    memcpy(p->vertex + p->start[p->parts], v, (size_t)n * sizeof *v);
    p->start[p->parts + 1] = p->start[p->parts] + n;
    p->parts++;
}

/* Puts the second of two parts that have an edge in common into the first, if that stays convex and small. */
static int join(const rg_vec2 *X, int32_t *a, int32_t *na, const int32_t *b, int32_t nb)
{
    int32_t both[2 * RG_PLATE_CORNERS];
    if (*na + nb - 2 > RG_PLATE_CORNERS) return 0;
    for (int32_t i = 0; i < *na; i++)
        for (int32_t k = 0; k < nb; k++) {
            if (a[i] != b[(k + 1) % nb] || a[(i + 1) % *na] != b[k]) continue;
            int32_t n = 0;
            for (int32_t q = 1; q <= *na; q++) both[n++] = a[(i + q) % *na];
            for (int32_t q = 2; q < nb; q++) both[n++] = b[(k + q) % nb];
            if (!is_convex(X, both, n)) continue;
            memcpy(a, both, (size_t)n * sizeof *a);
            *na = n;
            return 1;
        }
    return 0;
}

/* Triangles, and what of them can be put together (Hertel and Mehlhorn 1983). v[n] is used up; piece: room for n - 2 of
 * RG_PLATE_CORNERS, count: how many corners each has. */
static void cut(rg_plates *p, int32_t f, int32_t *v, int32_t n, int32_t *piece, int32_t *count)
{
    const rg_vec2 *X = p->mesh->X;
    const int joined = n <= JOINED_LARGEST;
    int32_t pieces = 0;
    while (n >= 3) {
        const int32_t i = n > 3 ? best_ear(X, v, n) : 0;
        if (i < 0) break; /* what is left has no area */
        const int32_t ear[3] = {v[(i + n - 1) % n], v[i], v[(i + 1) % n]};
        memcpy(piece + (size_t)pieces * RG_PLATE_CORNERS, ear, sizeof ear);
        count[pieces++] = 3;
        memmove(v + i, v + i + 1, (size_t)(n - i - 1) * sizeof *v);
        n--;
    }
    for (int again = joined; again;) {
        again = 0;
        for (int32_t a = 0; a < pieces && !again; a++)
            for (int32_t b = 0; b < pieces && !again; b++) {
                if (a == b || !join(X, piece + (size_t)a * RG_PLATE_CORNERS, &count[a],
                                    piece + (size_t)b * RG_PLATE_CORNERS, count[b])) continue;
                pieces--;
                memcpy(piece + (size_t)b * RG_PLATE_CORNERS, piece + (size_t)pieces * RG_PLATE_CORNERS,
                       RG_PLATE_CORNERS * sizeof *piece);
                count[b] = count[pieces];
                again = 1;
            }
    }
    for (int32_t a = 0; a < pieces; a++) add_part(p, f, piece + (size_t)a * RG_PLATE_CORNERS, count[a]);
}

static rg_status find_parts(rg_plates *p)
{
    const rg_mesh *m = p->mesh;
    int32_t largest = 3;
    for (int32_t f = 0; f < m->nf; f++)
        if (m->facet_start[f + 1] - m->facet_start[f] > largest) largest = m->facet_start[f + 1] - m->facet_start[f];
    int32_t *v, *count, *piece;
    if (RG_MEM_ARRAYS(&p->mem, RG_ARRAY(v, (size_t)largest), RG_ARRAY(count, (size_t)largest),
                      RG_ARRAY(piece, (size_t)largest * RG_PLATE_CORNERS)) != RG_OK) return RG_ENOMEM;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t n = m->facet_start[f + 1] - m->facet_start[f], *corner = m->facet_vertex + m->facet_start[f];
        p->first[f] = p->parts;
        memcpy(v, corner, (size_t)n * sizeof *v);
        if (n <= RG_PLATE_CORNERS && is_convex(m->X, corner, n)) add_part(p, f, corner, n);
        else cut(p, f, v, n, piece, count);
    }
    p->first[m->nf] = p->parts;
    RG_MEM_FREE(&p->mem, v, count, piece);
    return RG_OK;
}

/* ---------------------------------------------------------------------------------- tree ---- */

typedef struct place { rg_vec2 at; int32_t part; } place;

static int by_x(const void *a, const void *b)
{
    const place *p = a, *q = b;
    return p->at.x < q->at.x ? -1 : p->at.x > q->at.x ? 1 : p->part - q->part;
}

static int by_y(const void *a, const void *b)
{
    const place *p = a, *q = b;
    return p->at.y < q->at.y ? -1 : p->at.y > q->at.y ? 1 : p->part - q->part;
}

/* Halves, across the longer side of the middles' box. Returns the node after the last one. */
static int32_t grow(rg_plates *p, place *at, int32_t n, int32_t node)
{
    rg_plates_node *new = &p->node[node];
    if (n == 1) {
        *new = (rg_plates_node){at[0].part, -1, node + 1};
        return node + 1;
    }
    rg_vec2 low = at[0].at, high = at[0].at;
    for (int32_t i = 1; i < n; i++) {
        low = (rg_vec2){fmin(low.x, at[i].at.x), fmin(low.y, at[i].at.y)};
        high = (rg_vec2){fmax(high.x, at[i].at.x), fmax(high.y, at[i].at.y)};
    }
    qsort(at, (size_t)n, sizeof *at, high.x - low.x >= high.y - low.y ? by_x : by_y);
    const int32_t right = grow(p, at, n / 2, node + 1);
    const int32_t end = grow(p, at + n / 2, n - n / 2, right);
    *new = (rg_plates_node){-1, right, end};
    return end;
}

static rg_status find_tree(rg_plates *p)
{
    place *at = rg_mem_array(&p->mem, (size_t)p->parts, sizeof *at);
    if (!at) return RG_ENOMEM;
    for (int32_t a = 0; a < p->parts; a++) {
        at[a].part = a;
        for (int32_t j = p->start[a]; j < p->start[a + 1]; j++) {
            at[a].at.x += p->mesh->X[p->vertex[j]].x / (p->start[a + 1] - p->start[a]);
            at[a].at.y += p->mesh->X[p->vertex[j]].y / (p->start[a + 1] - p->start[a]);
        }
    }
    p->nodes = p->parts ? grow(p, at, p->parts, 0) : 0;
    rg_mem_free(&p->mem, at);
    return RG_OK;
}

/* ----------------------------------------------------------------------------------- all ---- */

rg_status rg_plates_init(const rg_mesh *m, rg_plates *p)
{
    memset(p, 0, sizeof *p);
    p->mem = m->mem;
    p->mesh = m;
    const size_t corners = (size_t)m->facet_start[m->nf];
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t v = 0; v < m->nv; v++) {
        low = (rg_vec2){fmin(low.x, m->X[v].x), fmin(low.y, m->X[v].y)};
        high = (rg_vec2){fmax(high.x, m->X[v].x), fmax(high.y, m->X[v].y)};
    }
    p->size = m->nv ? hypot(high.x - low.x, high.y - low.y) / sqrt(2) : 0;
    /* A facet of n corners has at most n - 2 parts, of no more than 3 (n - 2) corners together. */
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(p->facet, corners), RG_ARRAY(p->start, corners + 1),
                                RG_ARRAY(p->vertex, 3 * corners), RG_ARRAY(p->first, (size_t)m->nf + 1),
                                RG_ARRAY(p->node, 2 * corners), RG_ARRAY(p->border, (size_t)m->ne));
    for (int32_t e = 0; s == RG_OK && e < m->ne; e++)
        if (m->edge_crease[e] < 0) p->border[p->borders++] = e;
    if (s == RG_OK) s = find_parts(p);
    if (s == RG_OK) s = find_tree(p);
    if (s != RG_OK) rg_plates_free(p);
    return s;
}

void rg_plates_free(rg_plates *p)
{
    if (!p->mem.resize) return;
    RG_MEM_FREE(&p->mem, p->facet, p->start, p->vertex, p->first, p->node, p->border);
    memset(p, 0, sizeof *p);
}

static int32_t shared(const int32_t *a, int32_t na, const int32_t *b, int32_t nb, int32_t *v)
{
    int32_t n = 0;
    *v = -1;
    for (int32_t i = 0; i < na && n < 2; i++)
        for (int32_t k = 0; k < nb; k++)
            if (a[i] == b[k]) {
                *v = a[i];
                n++;
                break;
            }
    return n;
}

int32_t rg_plates_shared(const rg_mesh *m, int32_t f, int32_t g, int32_t *v)
{
    const int32_t *at = m->facet_start;
    return shared(m->facet_vertex + at[f], at[f + 1] - at[f], m->facet_vertex + at[g], at[g + 1] - at[g], v);
}

rg_vec2 rg_plates_middle(const rg_mesh *m, int32_t f)
{
    const int32_t n = m->facet_start[f + 1] - m->facet_start[f];
    rg_vec2 middle = {0, 0};
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
        middle.x += m->X[m->facet_vertex[j]].x / n;
        middle.y += m->X[m->facet_vertex[j]].y / n;
    }
    return middle;
}

/* --------------------------------------------------------------------------------- boxes ---- */

static void around_children(const rg_plates *p, rg_box *box)
{
    for (int32_t i = p->nodes - 1; i >= 0; i--) {
        if (p->node[i].part >= 0) continue;
        const rg_box *left = &box[i + 1], *right = &box[p->node[i].right];
        box[i] = *left;
        rg_box_take_in(&box[i], right->low);
        rg_box_take_in(&box[i], right->high);
    }
}

void rg_plates_boxes(const rg_plates *p, const rg_vec3 *x, rg_box *box)
{
    for (int32_t i = 0; i < p->nodes; i++) {
        const int32_t a = p->node[i].part;
        if (a < 0) continue;
        const int32_t *v = p->vertex + p->start[a], n = p->start[a + 1] - p->start[a];
        box[i] = (rg_box){x[v[0]], x[v[0]]};
        for (int32_t k = 1; k < n; k++) rg_box_take_in(&box[i], x[v[k]]);
    }
    around_children(p, box);
}

void rg_plates_boxes_take_in(const rg_plates *p, const rg_vec3 *y, rg_box *box)
{
    for (int32_t i = 0; i < p->nodes; i++) {
        const int32_t a = p->node[i].part;
        for (int32_t j = a < 0 ? 0 : p->start[a]; a >= 0 && j < p->start[a + 1]; j++)
            rg_box_take_in(&box[i], y[p->vertex[j]]);
    }
    around_children(p, box);
}

/* ---------------------------------------------------------------------------------- pairs ---- */

static void visit_two(const rg_plates_walk *w, int32_t i, int32_t k)
{
    if (!w->may(w->ctx, i, k)) return;
    const rg_plates_node *a = &w->p->node[i], *b = &w->p->node[k];
    if (a->part >= 0 && b->part >= 0) {
        w->meet(w->ctx, i, k);
    } else if (b->part >= 0 || (a->part < 0 && a->end - i >= b->end - k)) {
        visit_two(w, i + 1, k);
        visit_two(w, a->right, k);
    } else {
        visit_two(w, i, k + 1);
        visit_two(w, i, b->right);
    }
}

static void visit(const rg_plates_walk *w, int32_t i)
{
    const rg_plates_node *n = &w->p->node[i];
    if (n->part >= 0) return;
    visit(w, i + 1);
    visit(w, n->right);
    visit_two(w, i + 1, n->right);
}

void rg_plates_walk_pairs(const rg_plates_walk *w)
{
    if (w->p->nodes > 0) visit(w, 0);
}
