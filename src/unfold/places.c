#include "unfold/places.h"

/* What a row collects: no more than two ends of an edge, or four corners. */
typedef struct collected {
    int32_t n, col[16];
    double x[16];
} collected;

static void take_vertex(collected *c, int32_t v, rg_vec3 a)
{
    const double of[] = {a.x, a.y, a.z};
    for (int i = 0; i < 3; i++) c->col[c->n] = 3 * v + i, c->x[c->n++] = of[i];
}

/* a . dX_v */
static void take_pattern(const rg_linkage *P, const double *scale, collected *c, int32_t v, rg_vec2 a)
{
    const rg_freedom *F = &P->freedom;
    for (int i = 0; i < 2; i++) {
        const int32_t way = F->way[v][i];
        if (way < 0) continue;
        c->col[c->n] = 3 * P->mesh->nv + way;
        c->x[c->n++] = scale[P->N + way] * rg_vec2_dot(a, F->direction[way]);
    }
}

/* n / h of a facet over its edge from a to b, and how far along it the third corner stands. */
static rg_vec3 lever(const rg_linkage *P, int32_t a, int32_t b, int32_t third, double *t)
{
    const rg_vec3 e = rg_vec3_sub(P->p[b], P->p[a]), r = rg_vec3_sub(P->p[third], P->p[a]), n = rg_vec3_cross(e, r);
    const double squared = rg_vec3_dot(e, e), area = rg_vec3_dot(n, n);
    *t = rg_vec3_dot(e, r) / squared;
    return rg_vec3_scale(sqrt(squared) / area, n); /* |n| = area, h = area / |e| */
}

static rg_status add_fold(const rg_linkage *P, double scale, int32_t e, rg_rows *fold)
{
    const rg_mesh *m = P->mesh;
    const int32_t a = m->edge[e][0], b = m->edge[e][1];
    const int32_t x = rg_mesh_opposite(m, m->edge_facet[e][0], e), y = rg_mesh_opposite(m, m->edge_facet[e][1], e);
    double t, u;
    const rg_vec3 left = rg_vec3_scale(1 / scale, lever(P, a, b, x, &t));
    const rg_vec3 right = rg_vec3_scale(-1 / scale, lever(P, a, b, y, &u));
    collected c = {0};
    take_vertex(&c, x, left);
    take_vertex(&c, y, right);
    take_vertex(&c, a, rg_vec3_axpy(t - 1, left, rg_vec3_scale(u - 1, right)));
    take_vertex(&c, b, rg_vec3_axpy(-t, left, rg_vec3_scale(-u, right)));
    return rg_rows_add(fold, c.n, c.col, c.x);
}

static rg_status add_edge(const rg_linkage *P, const double *scale, int32_t e, rg_rows *rigid)
{
    const int32_t a = P->mesh->edge[e][0], b = P->mesh->edge[e][1];
    const rg_vec3 d = rg_vec3_sub(P->p[b], P->p[a]);
    const rg_vec2 D = rg_vec2_sub(P->X[b], P->X[a]);
    const double part = 1 / rg_vec2_length(D);
    collected c = {0};
    take_vertex(&c, b, rg_vec3_scale(part, d));
    take_vertex(&c, a, rg_vec3_scale(-part, d));
    take_pattern(P, scale, &c, b, (rg_vec2){-part * D.x, -part * D.y});
    take_pattern(P, scale, &c, a, (rg_vec2){part * D.x, part * D.y});
    return rg_rows_add(rigid, c.n, c.col, c.x);
}

static rg_status add_root(const rg_linkage *P, const double *scale, int32_t v, rg_rows *rigid)
{
    const rg_mat3 *R = &P->place[P->tree.order[0]].R;
    const rg_vec3 unit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    rg_status s = RG_OK;
    for (int i = 0; i < 3 && s == RG_OK; i++) {
        collected c = {0};
        c.col[0] = 3 * v + i, c.x[0] = 1, c.n = 1;
        take_pattern(P, scale, &c, v, (rg_vec2){-rg_vec3_dot(R->c[0], unit[i]), -rg_vec3_dot(R->c[1], unit[i])});
        s = rg_rows_add(rigid, c.n, c.col, c.x);
    }
    return s;
}

rg_status rg_places_rows(const rg_linkage *P, const double *scale, rg_rows *fold, rg_rows *rigid)
{
    const rg_mesh *m = P->mesh;
    const int32_t *root = m->facet_vertex + m->facet_start[P->tree.order[0]];
    rg_status s = RG_OK;
    for (int32_t i = 0; i < P->N && s == RG_OK; i++) s = add_fold(P, scale[i], m->crease_edge[i], fold);
    for (int32_t e = 0; e < m->ne && s == RG_OK; e++) s = add_edge(P, scale, e, rigid);
    for (int i = 0; i < 3 && s == RG_OK; i++) s = add_root(P, scale, root[i], rigid);
    return s;
}
