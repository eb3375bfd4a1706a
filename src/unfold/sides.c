#include "unfold/sides.h"

#include <string.h>

/* Edges that are nearer to parallel (sine) have no normal to be told sides by. */
static const double PARALLEL = 1e-3;
/* The facets at two edges say which way is up as long as they are within 25 degrees of facing each other. */
static const double FACING = 0.9;
/* Where the closest point is on the rim of the facet, its normal tells the side if it is within 60 degrees of the shortest
 * line, or if that is too short to have a direction. */
static const double ACROSS = 0.5, NO_DIRECTION = 2e-5;

rg_status rg_sides_init(rg_sides *s, const rg_memory *mem, const rg_mesh *m)
{
    memset(s, 0, sizeof *s);
    s->mem = *mem;
    s->mesh = m;
    const size_t nf = (size_t)m->nf, ne = (size_t)m->ne;
    s->up = rg_mem_array(mem, nf, 1);
    s->over = rg_mem_array(mem, nf * nf, 1);
    s->corner = rg_mem_array(mem, (size_t)m->nv * nf, 1);
    s->edge = rg_mem_array(mem, ne * ne, 1);
    if (s->up && s->over && s->corner && s->edge) return RG_OK;
    rg_sides_free(s);
    return RG_ENOMEM;
}

void rg_sides_free(rg_sides *s)
{
    if (!s->mem.resize) return;
    void *block[] = {s->up, s->over, s->corner, s->edge};
    for (int i = 0; i < 4; i++) rg_mem_free(&s->mem, block[i]);
    memset(s, 0, sizeof *s);
}

/* One of several that all say the same, or say nothing: 2 once they differ. */
static signed char both(signed char a, signed char b) { return a == 0 ? b : b == 0 || a == b ? a : 2; }

static signed char settled(signed char a) { return a == 2 ? 0 : a; }

void rg_sides_finish(rg_sides *s)
{
    const rg_mesh *m = s->mesh;
    const size_t nf = (size_t)m->nf;
    memset(s->corner, 0, (size_t)m->nv * nf);
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
            for (size_t g = 0; g < nf; g++) {
                signed char *c = &s->corner[(size_t)m->facet_vertex[j] * nf + g];
                *c = both(*c, s->over[(size_t)f * nf + g]);
            }
    for (size_t i = 0; i < (size_t)m->nv * nf; i++) s->corner[i] = settled(s->corner[i]);
    for (int32_t e = 0; e < m->ne; e++)
        for (int32_t f = 0; f < m->ne; f++) {
            signed char c = 0;
            for (int i = 0; i < 4; i++) {
                const int32_t a = m->edge_facet[e][i / 2], b = m->edge_facet[f][i % 2];
                if (a >= 0 && b >= 0) c = both(c, s->over[(size_t)a * nf + (size_t)b]);
            }
            s->edge[(size_t)e * (size_t)m->ne + (size_t)f] = settled(c);
        }
}

/* The normal of a facet that points up at the flat end. */
static rg_vec3 upwards(const rg_sides *s, const rg_linkage *P, int32_t f) { return rg_vec3_scale(s->up[f], P->place[f].R.c[2]); }

static rg_vec3 between(const rg_linkage *P, const rg_close_pair *at)
{
    rg_vec3 d = {0, 0, 0};
    for (int k = 0; k < 4; k++) d = rg_vec3_axpy(at->weight[k], P->p[at->v[k]], d);
    return d;
}

int rg_sides_tell(const rg_sides *s, const rg_linkage *P, const rg_close_pair *at, rg_vec3 *n, double *d)
{
    const rg_mesh *m = s->mesh;
    const rg_vec3 apart = between(P, at);
    if (at->kind == 0) {
        const signed char side = s->corner[(size_t)at->i * (size_t)m->nf + (size_t)at->j];
        if (side == 0) return 0;
        const rg_vec3 up = rg_vec3_scale(side, upwards(s, P, at->j));
        const int rim = at->weight[1] == 0 || at->weight[2] == 0 || at->weight[3] == 0;
        if (rim && fabs(rg_vec3_dot(apart, up)) < ACROSS * at->d && at->d > NO_DIRECTION) return 0;
        *n = up;
    } else {
        const signed char side = s->edge[(size_t)at->i * (size_t)m->ne + (size_t)at->j];
        if (side == 0) return 0;
        const rg_vec3 a = rg_vec3_sub(P->p[at->v[1]], P->p[at->v[0]]), b = rg_vec3_sub(P->p[at->v[3]], P->p[at->v[2]]);
        rg_vec3 c = rg_vec3_cross(a, b);
        const double length = rg_vec3_length(c);
        if (length < PARALLEL * rg_vec3_length(a) * rg_vec3_length(b)) return 0;
        c = rg_vec3_scale(1 / length, c);
        double sense = 0;
        for (int i = 0; i < 4; i++) {
            const int32_t f = m->edge_facet[i < 2 ? at->i : at->j][i % 2];
            if (f < 0) continue;
            const double facing = rg_vec3_dot(upwards(s, P, f), c);
            if (fabs(facing) < FACING || facing * sense < 0) return 0;
            sense = facing;
        }
        *n = rg_vec3_scale(side * (sense > 0 ? 1 : -1), c);
    }
    *d = rg_vec3_dot(*n, apart);
    return 1;
}
