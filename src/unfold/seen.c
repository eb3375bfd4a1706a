#include "unfold/seen.h"

#include <string.h>

/* How far to look back at most before what comes to lie flat, so that it is almost flat; as render/lift.c does. */
static const double LOOK_BACK = 10 * RG_DEG;
/* What is less apart, summed over places, in parts of the sheet's size, may be on its wrong side there: it counts as no
 * crossing. Only of facets that never are more apart, what is above rounding tells. */
static const double APART[] = {1e-4, 1e-7};

/* A facet's part that has the point of the pattern most inside. */
static int32_t part_at(const rg_mesh *m, const rg_flat *f, int32_t g, rg_vec2 x)
{
    int32_t best = f->part[f->part_start[g]];
    double most = -INFINITY;
    for (int32_t k = f->part_start[g]; k < f->part_start[g + 1]; k++) {
        const int32_t first = m->facet_start[f->part[k]], n = m->facet_start[f->part[k] + 1] - first;
        const int32_t *v = m->facet_vertex + first;
        double least = INFINITY;
        for (int32_t j = 0; j < n; j++) least = fmin(least, rg_vec2_turn(m->X[v[j]], m->X[v[(j + 1) % n]], x));
        if (!(least > most)) continue;
        most = least;
        best = f->part[k];
    }
    return best;
}

/* height[pairs]: out, how much higher the second facet of each lies than the first, summed over places where both are
 * at the end. place[nf]: as they lie. at, up: [facets] scratch. */
static void look(const rg_layers *l, const rg_mesh *m, const rg_place *place, rg_vec3 *at, rg_vec3 *up, double *height)
{
    const rg_flat *f = &l->flat;
    const rg_cells *c = &l->cells;
    memset(height, 0, (size_t)l->pairs.count * sizeof *height);
    for (int32_t i = 0; i < c->faces.count; i++) {
        const int32_t *over = c->over + c->over_start[i], n = c->over_start[i + 1] - c->over_start[i];
        for (int32_t j = 0; j < n; j++) {
            const rg_isometry *q = &f->place[over[j]];
            const rg_vec2 r = rg_vec2_sub(c->point[i], q->t), x = {rg_vec2_dot(q->c[0], r), rg_vec2_dot(q->c[1], r)};
            const rg_place *p = &place[part_at(m, f, over[j], x)];
            at[j] = rg_vec3_add(rg_mat3_mul_vec(p->R, (rg_vec3){x.x, x.y, 0}), p->t);
            up[j] = rg_vec3_scale(f->up[over[j]], p->R.c[2]);
        }
        for (int32_t j = 0; j < n; j++)
            for (int32_t k = j + 1; k < n; k++) /* facets over a cell rise */
                height[rg_pairs_find(&l->pairs, over[j], over[k])] +=
                    rg_vec3_dot(rg_vec3_add(up[j], up[k]), rg_vec3_sub(at[k], at[j]));
    }
}

/* Frame k, and back from there towards the one before. rho[N]: out. Returns the pattern. */
static const rg_vec2 *a_little_before(const rg_seen_frames *m, int32_t k, double *rho)
{
    const double *now = m->rho + (size_t)k * (size_t)m->mesh->N, *before = now - m->mesh->N;
    double most = 0;
    for (int32_t i = 0; i < m->mesh->N; i++) most = fmax(most, fabs(now[i] - before[i]));
    const double part = most > LOOK_BACK ? LOOK_BACK / most : 1;
    for (int32_t i = 0; i < m->mesh->N; i++) rho[i] = now[i] + part * (before[i] - now[i]);
    return m->flat ? m->flat + (size_t)k * (size_t)m->mesh->nv : m->mesh->X;
}

rg_status rg_seen_order(const rg_layers *l, const rg_seen_frames *m, double *wish)
{
    const size_t pairs = (size_t)l->pairs.count;
    int32_t unknown = l->pairs.count;
    rg_place *place;
    rg_vec3 *at;
    double *rho, *height;
    const rg_status s = RG_MEM_ARRAYS(&l->mem, RG_ARRAY(place, (size_t)m->mesh->nf),
                                      RG_ARRAY(at, 2 * (size_t)l->flat.nf), RG_ARRAY(rho, (size_t)m->mesh->N),
                                      RG_ARRAY(height, pairs));
    memset(wish, 0, pairs * sizeof *wish);
    for (int pass = 0; pass < 2; pass++)
        for (int32_t k = m->count - 1; s == RG_OK && k > 0 && unknown > 0; k--) {
            rg_pose_facets(m->mesh, a_little_before(m, k, rho), m->tree, rho, place);
            look(l, m->mesh, place, at, at + l->flat.nf, height);
            for (size_t i = 0; i < pairs; i++) {
                if (wish[i] != 0 || !(fabs(height[i]) > APART[pass] * m->mesh->size)) continue;
                wish[i] = height[i];
                unknown--;
            }
        }
    RG_MEM_FREE(&l->mem, place, at, rho, height);
    return s;
}
