#include "kinematics/freedom.h"

#include <string.h>

/* The border goes straight through a vertex when its directions differ by no more (radians). */
static const double STRAIGHT = 1e-6;

/* The two neighbours of a vertex along the border of the sheet. */
static void border_neighbours(const rg_mesh *m, int32_t (*next)[2])
{
    for (int32_t v = 0; v < m->nv; v++) next[v][0] = next[v][1] = -1;
    for (int32_t e = 0; e < m->ne; e++)
        for (int i = 0; m->edge_crease[e] < 0 && i < 2; i++) {
            const int32_t v = m->edge[e][i];
            next[v][next[v][0] >= 0] = m->edge[e][!i];
        }
}

static rg_vec2 towards(const rg_mesh *m, int32_t from, int32_t to)
{
    const rg_vec2 d = rg_vec2_sub(m->X[to], m->X[from]);
    const double length = rg_vec2_length(d);
    return (rg_vec2){d.x / length, d.y / length};
}

static void add_way(rg_freedom *f, int32_t v, int which, rg_vec2 direction)
{
    f->way[v][which] = f->U;
    f->vertex[f->U] = v;
    f->direction[f->U++] = direction;
}

static void find_ways(rg_freedom *f, int32_t (*next)[2])
{
    const rg_mesh *m = f->mesh;
    for (int32_t v = 0; v < m->nv; v++) {
        if (next[v][0] < 0) {
            add_way(f, v, 0, (rg_vec2){1, 0});
            add_way(f, v, 1, (rg_vec2){0, 1});
        } else if (next[v][1] >= 0) {
            const rg_vec2 a = towards(m, v, next[v][0]), b = towards(m, next[v][1], v);
            if (rg_vec2_dot(a, b) > 0 && fabs(rg_vec2_cross(a, b)) <= STRAIGHT) add_way(f, v, 0, a);
        }
    }
}

static void measure_reach(rg_freedom *f)
{
    const rg_mesh *m = f->mesh;
    for (int32_t i = 0; i < f->U; i++) f->reach[i] = INFINITY;
    for (int32_t e = 0; e < m->ne; e++) {
        if (m->edge_crease[e] >= m->N - m->added) continue;
        const double length = rg_vec2_length(rg_vec2_sub(m->X[m->edge[e][1]], m->X[m->edge[e][0]]));
        for (int k = 0; k < 4; k++) {
            const int32_t way = f->way[m->edge[e][k / 2]][k % 2];
            if (way >= 0) f->reach[way] = fmin(f->reach[way], length);
        }
    }
}

rg_status rg_freedom_init(rg_freedom *f, const rg_memory *mem, const rg_mesh *m, int movable)
{
    memset(f, 0, sizeof *f);
    f->mem = *mem;
    f->mesh = m;
    const size_t nv = (size_t)m->nv;
    int32_t(*next)[2];
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(f->way, nv), RG_ARRAY(f->vertex, 2 * nv),
                                      RG_ARRAY(f->direction, 2 * nv), RG_ARRAY(f->reach, 2 * nv), RG_ARRAY(next, nv));
    if (s != RG_OK) return s;
    for (int32_t v = 0; v < m->nv; v++) f->way[v][0] = f->way[v][1] = -1;
    border_neighbours(m, next);
    if (movable) find_ways(f, next);
    measure_reach(f);
    rg_mem_free(mem, next);
    return RG_OK;
}

void rg_freedom_free(rg_freedom *f)
{
    if (!f->mem.resize) return;
    RG_MEM_FREE(&f->mem, f->way, f->vertex, f->direction, f->reach);
    memset(f, 0, sizeof *f);
}

/* X[nv] grows by the ways u[U]. */
static void add_ways(const rg_freedom *f, const double *u, rg_vec2 *X)
{
    for (int32_t i = 0; i < f->U; i++) {
        rg_vec2 *x = &X[f->vertex[i]];
        *x = (rg_vec2){x->x + u[i] * f->direction[i].x, x->y + u[i] * f->direction[i].y};
    }
}

void rg_freedom_move(const rg_freedom *f, const double *u, rg_vec2 *X)
{
    memcpy(X, f->mesh->X, (size_t)f->mesh->nv * sizeof *X);
    add_ways(f, u, X);
}

double rg_freedom_farthest(const rg_freedom *f, const double *u)
{
    double most = 0;
    for (int32_t v = 0; f->U > 0 && v < f->mesh->nv; v++) {
        const int32_t *w = f->way[v];
        most = fmax(most, hypot(w[0] < 0 ? 0 : u[w[0]], w[1] < 0 ? 0 : u[w[1]])); /* two ways are at right angles */
    }
    return most;
}

void rg_freedom_mean(const rg_freedom *f, const rg_symmetry *G, double *u, rg_vec2 *d)
{
    memset(d, 0, (size_t)f->mesh->nv * sizeof *d);
    add_ways(f, u, d);
    rg_symmetry_mean_vectors(G, d);
    for (int32_t i = 0; i < f->U; i++) u[i] = rg_vec2_dot(d[f->vertex[i]], f->direction[i]);
}

int rg_freedom_room(const rg_freedom *f, const rg_vec2 *X, double least, double *room)
{
    const rg_mesh *m = f->mesh;
    int proper = 1;
    for (int32_t i = 0; room && i < f->U; i++) room[i] = 1;
    for (int32_t k = 0; f->U > 0 && k < m->nf; k++) {
        const double now = rg_mesh_twice_area(m, k, X), given = rg_mesh_twice_area(m, k, m->X);
        const double part = (now / given - least) / (1 - least);
        if (!(now >= least * given)) proper = 0;
        for (int32_t j = 2 * m->facet_start[k]; room && part < 1 && j < 2 * m->facet_start[k + 1]; j++) {
            const int32_t way = f->way[m->facet_vertex[j / 2]][j % 2];
            if (way >= 0) room[way] = fmax(0, fmin(room[way], part));
        }
    }
    return proper;
}
