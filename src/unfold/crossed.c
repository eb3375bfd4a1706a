#include "unfold/crossed.h"

#include <math.h>

/* Depths (lengths of the sheet) from which pairs count; what of the depth is asked for at once, and compliances: not
 * deeper, and out of it. */
static const double BEGUN = 1e-6, BACK = 0.5, BACK_MOST = 1e-4, NOT_DEEPER = 1e-9, OUT = 1e-6;
/* Corners of a facet within this (lengths of the sheet) are as far along an axis: an edge or a facet that is square to
 * it. */
static const double AS_FAR = 1e-9;

/* Corners of a facet that are as far along an axis as any: one, the ends of an edge, or all. */
typedef struct support {
    int32_t n, v[3];
    double at;
} support;

static support farthest(const rg_linkage *P, int32_t f, rg_vec3 axis)
{
    const int32_t *v = P->mesh->facet_vertex + P->mesh->facet_start[f];
    support s = {0, {-1, -1, -1}, -INFINITY};
    for (int k = 0; k < 3; k++) s.at = fmax(s.at, rg_vec3_dot(axis, P->p[v[k]]));
    for (int k = 0; k < 3; k++)
        if (rg_vec3_dot(axis, P->p[v[k]]) > s.at - AS_FAR) s.v[s.n++] = v[k];
    return s;
}

/* A corner alone, and the other is none of its facet's. */
static int is_apart(const support *one, const support *other)
{
    const int32_t v = one->v[0];
    return one->n == 1 && other->n >= 1 && other->v[0] != v && other->v[1] != v && other->v[2] != v;
}

/* Where `one` of facet f meets `other` of facet g: *at, out, of f less g. Zero: at a corner that they have in common,
 * or in a way that has no one place. */
static int place(const rg_linkage *P, const rg_proximity *near, int32_t f, const support *one, int32_t g,
                 const support *other, rg_close_pair *at)
{
    int of_g = 0; /* its first part */
    if (is_apart(one, other)) {
        rg_proximity_distance(near, 0, one->v[0], g, P->p, at);
    } else if (is_apart(other, one)) {
        rg_proximity_distance(near, 0, other->v[0], f, P->p, at);
        of_g = 1;
    } else {
        if (one->n != 2 || other->n != 2) return 0;
        const int32_t a = rg_mesh_edge_between(P->mesh, f, one->v[0], one->v[1]);
        const int32_t b = rg_mesh_edge_between(P->mesh, g, other->v[0], other->v[1]);
        if (a < 0 || b < 0 || a == b) return 0;
        rg_proximity_distance(near, 1, a > b ? a : b, a > b ? b : a, P->p, at);
        of_g = b > a;
    }
    for (int i = 0; of_g && i < 4; i++) at->weight[i] = -at->weight[i];
    return 1;
}

rg_status rg_crossed_add(rg_crossed *c, const rg_linkage *P, rg_proximity *near, rg_nearest *q)
{
    const int32_t n = rg_contact_pairs(c->plates, P->p, BEGUN, c->look, c->hit, RG_CROSSED_MOST, NULL);
    for (int32_t k = 0; k < n && k < RG_CROSSED_MOST; k++) {
        const rg_contact_hit *h = &c->hit[k];
        const rg_vec3 back = rg_vec3_scale(-1, h->axis);
        const support high[2] = {farthest(P, h->facet[0], h->axis), farthest(P, h->facet[1], h->axis)};
        const support low[2] = {farthest(P, h->facet[0], back), farthest(P, h->facet[1], back)};
        /* The one that is to go along the axis. */
        const int up = high[0].at + low[1].at <= high[1].at + low[0].at ? 1 : 0;
        rg_close_pair at;
        if (!place(P, near, h->facet[up], &low[up], h->facet[!up], &high[!up], &at)) continue;
        rg_row *row = rg_nearest_add(q, 4, at.v, at.weight, h->axis);
        if (!row) return RG_ENOMEM;
        /* It has to go back the way it came: its distance is not to be kept. */
        *rg_proximity_flags(near, at.kind, at.i, at.j) |= RG_PROXIMITY_GLUED;
        row->c = NOT_DEEPER;
        row->floor = -h->depth;
        row->soft_b = fmin(BACK * h->depth, BACK_MOST);
        row->soft_c = OUT;
    }
    return RG_OK;
}
