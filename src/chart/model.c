#include "chart/model.h"
#include "kinematics/mobility.h"

#include <string.h>

/* Of the sheet's size, and of a target: as far as two may be apart and still be the same. */
static const double SAME_PLACE = 1e-6, SAME_TARGET = 1e-6;
static const double PATIENCE = 1;

/* ----------------------------------------------------------------------------------------------- symmetry ---- */

/* x -> R x, or mirrored first. */
typedef struct map {
    double cos, sin;
    int mirror;
} map;

static rg_vec2 image(const map *g, rg_vec2 centre, rg_vec2 x)
{
    const double dx = x.x - centre.x, dy = g->mirror ? centre.y - x.y : x.y - centre.y;
    return (rg_vec2){centre.x + g->cos * dx - g->sin * dy, centre.y + g->sin * dx + g->cos * dy};
}

static int32_t vertex_at(const rg_mesh *m, rg_vec2 x)
{
    for (int32_t v = 0; v < m->nv; v++)
        if (fabs(m->X[v].x - x.x) <= SAME_PLACE * m->size && fabs(m->X[v].y - x.y) <= SAME_PLACE * m->size) return v;
    return -1;
}

/* to[nv]: where each vertex goes. Zero: not to a vertex. */
static int moves_vertices(const rg_mesh *m, const map *g, rg_vec2 centre, int32_t *to)
{
    for (int32_t v = 0; v < m->nv; v++)
        if ((to[v] = vertex_at(m, image(g, centre, m->X[v]))) < 0) return 0;
    return 1;
}

/* Edges by vertex, so that one is found from its ends. */
typedef struct star {
    int32_t *start, *edge;
} star;

static int32_t edge_between(const rg_mesh *m, const star *s, int32_t a, int32_t b)
{
    for (int32_t j = s->start[a]; j < s->start[a + 1]; j++) {
        const int32_t e = s->edge[j];
        if (m->edge[e][0] + m->edge[e][1] - a == b) return e;
    }
    return -1;
}

static int same_target(double a, double b)
{
    return (isnan(a) && isnan(b)) || fabs(a - b) <= SAME_TARGET;
}

/* Takes every crease to one of `sign` times its target. crease_to[N]: out. */
static int moves_creases(const rg_mesh *m, const star *s, const int32_t *to, double sign, int32_t *crease_to)
{
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t f = edge_between(m, s, to[m->edge[e][0]], to[m->edge[e][1]]);
        if (f < 0 || (m->edge_crease[e] < 0) != (m->edge_crease[f] < 0)) return 0;
        if (m->edge_crease[e] < 0) continue;
        if (!same_target(sign * m->target[e], m->target[f])) return 0;
        crease_to[m->edge_crease[e]] = m->edge_crease[f];
    }
    return 1;
}

static int32_t root(const int32_t *up, int32_t i)
{
    while (up[i] != i) i = up[i];
    return i;
}

static void join(int32_t *up, int32_t n, const int32_t *to)
{
    for (int32_t i = 0; i < n; i++) {
        const int32_t a = root(up, i), b = root(up, to[i]);
        if (a < b) up[b] = a;
        else up[a] = b;
    }
}

/* What is searched through. */
typedef struct search {
    const rg_mesh *m;
    star star;
    rg_vec2 centre;
    int32_t *vertex_to, *crease_to, *vertex_up, *crease_up;
} search;

static void try_map(search *s, int degrees, int mirror, rg_symmetry *y)
{
    const map g = {cos(degrees * RG_DEG), sin(degrees * RG_DEG), mirror};
    if (!moves_vertices(s->m, &g, s->centre, s->vertex_to)) return;
    if (!moves_creases(s->m, &s->star, s->vertex_to, 1, s->crease_to) &&
        !moves_creases(s->m, &s->star, s->vertex_to, -1, s->crease_to))
        return;
    y->order++;
    join(s->vertex_up, s->m->nv, s->vertex_to);
    join(s->crease_up, s->m->N, s->crease_to);
}

static void count(const search *s, rg_symmetry *y)
{
    for (int32_t i = 0; i < s->m->N; i++) y->creases += s->crease_up[i] == i;
    for (int32_t k = 0; k < s->m->M; k++) y->vertices += s->vertex_up[s->m->inner_vertex[k]] == s->m->inner_vertex[k];
}

static void fill_star(const rg_mesh *m, star *s)
{
    for (int32_t e = 0; e < m->ne; e++)
        for (int end = 0; end < 2; end++) s->start[m->edge[e][end] + 1]++;
    for (int32_t v = 0; v < m->nv; v++) s->start[v + 1] += s->start[v];
    for (int32_t e = m->ne - 1; e >= 0; e--)
        for (int end = 0; end < 2; end++) s->edge[--s->start[m->edge[e][end] + 1]] = e;
    for (int32_t v = 0; v < m->nv; v++) s->start[v] = s->start[v + 1];
    s->start[m->nv] = 2 * m->ne;
}

rg_status rg_symmetry_find(rg_symmetry *y, const rg_memory *mem, const rg_mesh *m)
{
    const size_t nv = (size_t)m->nv, N = (size_t)m->N;
    search s = {.m = m};
    memset(y, 0, sizeof *y);
    int32_t **array[] = {&s.star.start, &s.star.edge, &s.vertex_to, &s.crease_to, &s.vertex_up, &s.crease_up};
    const size_t room[] = {nv + 2, 2 * (size_t)m->ne, nv, N, nv, N};
    rg_status status = RG_OK;
    for (int i = 0; i < 6; i++)
        if (!(*array[i] = rg_mem_array(mem, room[i], sizeof(int32_t)))) status = RG_ENOMEM;
    if (status == RG_OK) {
        fill_star(m, &s.star);
        for (int32_t v = 0; v < m->nv; v++) {
            s.vertex_up[v] = v;
            s.centre.x += m->X[v].x / m->nv;
            s.centre.y += m->X[v].y / m->nv;
        }
        for (int32_t i = 0; i < m->N; i++) s.crease_up[i] = i;
        /* Mirrored in the x axis and turned by 30 degrees is mirrored in the line at 15. */
        for (int degrees = 0; degrees < 360; degrees += 30) {
            if (degrees % 60 == 0 || degrees % 90 == 0) try_map(&s, degrees, 0, y);
            try_map(&s, degrees, 1, y);
        }
        count(&s, y);
    }
    for (int i = 0; i < 6; i++) rg_mem_free(mem, *array[i]);
    return status;
}

/* ------------------------------------------------------------------------------------------------- models ---- */

rg_status rg_model_fold(rg_model *o, const rg_mesh *m, const rg_settings *s, int32_t drawn, const rg_frames *with, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    const rg_way way = {RG_METHOD_AUTO, RG_SOLVER_AUTO, s->step, s->tol, 0};
    rg_frames kept;
    memset(o, 0, sizeof *o);
    o->unknowns = m->N;
    o->constraints = 3 * m->M;
    o->ways = -1;
    rg_status status = rg_frames_init(&kept, &mem, m->N, s->frames);
    if (status == RG_OK) status = rg_run_make(&o->run, m, s, &way, NULL, &kept, why);
    if (status == RG_OK) status = rg_run_time(&o->run, m, s, PATIENCE, why);
    if (status == RG_OK) status = rg_mobility(m, NULL, kept.rho + (size_t)(kept.count / 2) * (size_t)m->N, &o->ways);
    if (status == RG_EABSENT) status = RG_OK;
    for (int32_t k = 0; status == RG_OK && k < kept.count; k++)
        for (int32_t i = 0; i < m->N; i++) {
            const double rho = kept.rho[(size_t)k * (size_t)m->N + (size_t)i];
            if (i >= drawn) o->bend = fmax(o->bend, fabs(rho));
            else if (k < with->count && with->count >= 2) {
                const double off = fabs(rho - with->rho[(size_t)k * (size_t)with->N + (size_t)i]);
                if (k == 0 && i == 0) o->run.error = 0;
                if (!(off <= o->run.error)) o->run.error = off;
            }
        }
    rg_mem_free(&mem, kept.rho);
    return status;
}
