#include "contact/near.h"

#include <string.h>

/* Of the longer of two edges: what is shorter is a point. And sine squared of edges that count as parallel. */
static const double NO_LENGTH = 1e-14, PARALLEL = 1e-14;

/* ----------------------------------------------------------------------- nearest points ---- */

static double part_of(double x) { return x > 0 ? x < 1 ? x : 1 : 0; }

static double apart(rg_vec3 d, rg_vec3 *n)
{
    const double length = rg_vec3_length(d);
    *n = length > 0 ? rg_vec3_scale(1 / length, d) : (rg_vec3){0, 0, 0};
    return length;
}

/* The nearest point of a segment: how far along it. */
static double along(rg_vec3 p, rg_vec3 a, rg_vec3 b)
{
    const rg_vec3 e = rg_vec3_sub(b, a);
    const double length = rg_vec3_dot(e, e);
    return length > 0 ? part_of(rg_vec3_dot(e, rg_vec3_sub(p, a)) / length) : 0;
}

static rg_vec3 from_triangle(rg_vec3 p, rg_vec3 a, rg_vec3 b, rg_vec3 c, const double w[3])
{
    return rg_vec3_axpy(-w[0], a, rg_vec3_axpy(-w[1], b, rg_vec3_axpy(-w[2], c, p)));
}

/* Above the triangle the foot of p is nearest; beside it a point of one of the sides. */
double rg_near_triangle(rg_vec3 p, rg_vec3 a, rg_vec3 b, rg_vec3 c, double weight[3], rg_vec3 *n)
{
    const rg_vec3 e = rg_vec3_sub(b, a), f = rg_vec3_sub(c, a), r = rg_vec3_sub(p, a), m = rg_vec3_cross(e, f);
    const double area = rg_vec3_dot(m, m);
    if (area > 0) {
        const double v = rg_vec3_dot(m, rg_vec3_cross(r, f)) / area, w = rg_vec3_dot(m, rg_vec3_cross(e, r)) / area;
        if (v >= 0 && w >= 0 && v + w <= 1) {
            weight[0] = 1 - v - w, weight[1] = v, weight[2] = w;
            return apart(from_triangle(p, a, b, c, weight), n);
        }
    }
    const rg_vec3 corner[3] = {a, b, c};
    double least = INFINITY;
    for (int k = 0; k < 3; k++) {
        double w[3] = {0, 0, 0};
        rg_vec3 m_k;
        w[(k + 1) % 3] = along(p, corner[k], corner[(k + 1) % 3]);
        w[k] = 1 - w[(k + 1) % 3];
        const double d = apart(from_triangle(p, a, b, c, w), &m_k);
        if (!(d < least)) continue;
        least = d;
        *n = m_k;
        memcpy(weight, w, sizeof w);
    }
    return least;
}

/* The point of the line of the first that is nearest to the line of the second, kept on the segment; then the nearest
 * point of the second, kept on it, and once more the first (Lumelsky 1985). */
double rg_near_segments(rg_vec3 a, rg_vec3 b, rg_vec3 c, rg_vec3 d, double *s, double *t, rg_vec3 *n)
{
    const rg_vec3 e = rg_vec3_sub(b, a), g = rg_vec3_sub(d, c), r = rg_vec3_sub(a, c);
    const double ee = rg_vec3_dot(e, e), gg = rg_vec3_dot(g, g), eg = rg_vec3_dot(e, g),
        least = NO_LENGTH * fmax(ee, gg);
    const double slant = ee * gg - eg * eg;
    *s = slant > PARALLEL * ee * gg ? part_of((eg * rg_vec3_dot(g, r) - gg * rg_vec3_dot(e, r)) / slant) : 0;
    *t = gg > least ? (eg * *s + rg_vec3_dot(g, r)) / gg : 0;
    if (!(*t >= 0 && *t <= 1) || !(slant > PARALLEL * ee * gg)) {
        *t = part_of(*t);
        *s = ee > least ? part_of((eg * *t - rg_vec3_dot(e, r)) / ee) : 0;
    }
    return apart(rg_vec3_sub(rg_vec3_axpy(*s, e, a), rg_vec3_axpy(*t, g, c)), n);
}

/* ------------------------------------------------------------------------------- all of them ---- */

rg_status rg_near_work_init(const rg_plates *p, rg_near_work *w)
{
    const rg_mesh *m = p->mesh;
    memset(w, 0, sizeof *w);
    w->mem = p->mem;
    if (RG_MEM_ARRAYS(&p->mem, RG_ARRAY(w->box, (size_t)p->nodes), RG_ARRAY(w->leaf, (size_t)p->parts),
                      RG_ARRAY(w->corner_part, (size_t)m->nv), RG_ARRAY(w->edge_part, (size_t)m->ne),
                      RG_ARRAY(w->side, (size_t)p->start[p->parts])) != RG_OK) {
        rg_near_work_free(w);
        return RG_ENOMEM;
    }
    for (int32_t i = 0; i < p->nodes; i++)
        if (p->node[i].part >= 0) w->leaf[p->node[i].part] = i;
    for (int32_t v = 0; v < m->nv; v++) w->corner_part[v] = -1;
    for (int32_t e = 0; e < m->ne; e++) w->edge_part[e] = -1;
    for (int32_t a = 0; a < p->parts; a++)
        for (int32_t j = p->start[a]; j < p->start[a + 1]; j++) {
            const int32_t f = p->facet[a], v = p->vertex[j],
                u = p->vertex[j + 1 < p->start[a + 1] ? j + 1 : p->start[a]];
            if (w->corner_part[v] < 0) w->corner_part[v] = a;
            w->side[j] = -1;
            for (int32_t i = m->facet_start[f]; i < m->facet_start[f + 1]; i++) {
                const int32_t next = m->facet_vertex[i + 1 < m->facet_start[f + 1] ? i + 1 : m->facet_start[f]];
                if (m->facet_vertex[i] == v && next == u) w->side[j] = m->facet_edge[i];
            }
            if (w->side[j] >= 0 && w->edge_part[w->side[j]] < 0) w->edge_part[w->side[j]] = a;
        }
    return RG_OK;
}

void rg_near_work_free(rg_near_work *w)
{
    if (!w->mem.resize) return;
    RG_MEM_FREE(&w->mem, w->box, w->leaf, w->corner_part, w->edge_part, w->side);
    memset(w, 0, sizeof *w);
}

/* -------------------------------------------------------------------------- candidates ---- */

typedef struct candidates {
    const rg_plates *p;
    const rg_vec3 *x, *y;
    const rg_near_work *w;
    double reach;
    rg_near_visitor *visit;
    void *ctx;
} candidates;

static int are_near(const rg_box *a, const rg_box *b, double reach)
{
    return a->low.x - b->high.x <= reach && b->low.x - a->high.x <= reach && a->low.y - b->high.y <= reach &&
           b->low.y - a->high.y <= reach && a->low.z - b->high.z <= reach && b->low.z - a->high.z <= reach;
}

/* Corners of part a, as far as they are looked at there, against part b. */
static void corners(const candidates *c, int32_t a, int32_t b)
{
    const rg_plates *p = c->p;
    const rg_box *box = &c->w->box[c->w->leaf[b]];
    for (int32_t j = p->start[a]; j < p->start[a + 1]; j++) {
        const int32_t v = p->vertex[j];
        if (c->w->corner_part[v] != a) continue;
        rg_box at = {c->x[v], c->x[v]};
        if (c->y) rg_box_take_in(&at, c->y[v]);
        if (are_near(&at, box, c->reach)) c->visit(c->ctx, RG_NEAR_CORNER, v, b);
    }
}

static rg_box around_edge(const candidates *c, int32_t e)
{
    const int32_t *v = c->p->mesh->edge[e];
    rg_box box = {c->x[v[0]], c->x[v[0]]};
    rg_box_take_in(&box, c->x[v[1]]);
    for (int i = 0; c->y && i < 2; i++) rg_box_take_in(&box, c->y[v[i]]);
    return box;
}

static void edges(const candidates *c, int32_t a, int32_t b)
{
    const rg_plates *p = c->p;
    rg_box of_b[RG_PLATE_CORNERS];
    for (int32_t k = p->start[b]; k < p->start[b + 1]; k++)
        if (c->w->side[k] >= 0) of_b[k - p->start[b]] = around_edge(c, c->w->side[k]);
    for (int32_t i = p->start[a]; i < p->start[a + 1]; i++) {
        const int32_t d = c->w->side[i];
        if (d < 0 || c->w->edge_part[d] != a) continue;
        const rg_box box = around_edge(c, d);
        for (int32_t k = p->start[b]; k < p->start[b + 1]; k++) {
            const int32_t e = c->w->side[k];
            if (e < 0 || c->w->edge_part[e] != b || !are_near(&box, &of_b[k - p->start[b]], c->reach)) continue;
            c->visit(c->ctx, RG_NEAR_EDGES, d, e);
        }
    }
}

static int nodes_near(void *ctx, int32_t i, int32_t k)
{
    const candidates *c = ctx;
    return are_near(&c->w->box[i], &c->w->box[k], c->reach);
}

static void features(void *ctx, int32_t i, int32_t k)
{
    const candidates *c = ctx;
    const int32_t a = c->p->node[i].part, b = c->p->node[k].part;
    if (c->p->facet[a] == c->p->facet[b]) return;
    corners(c, a, b);
    corners(c, b, a);
    edges(c, a, b);
}

void rg_near_candidates(const rg_plates *p, const rg_vec3 *x, const rg_vec3 *y, double reach, rg_near_work *w,
                        rg_near_visitor *visit, void *ctx)
{
    candidates c = {p, x, y, w, reach, visit, ctx};
    rg_plates_boxes(p, x, w->box);
    if (y) rg_plates_boxes_take_in(p, y, w->box);
    rg_plates_walk_pairs(&(rg_plates_walk){p, nodes_near, features, &c});
}
