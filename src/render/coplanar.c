#include "render/coplanar.h"

#include <stdlib.h>
#include <string.h>

/* Cells of the hash table: of a normal's coordinates, and of a plane's distance from the origin in parts of the sheet's
 * size. A facet is sought within half a cell, so that normals may differ by 0.01. */
#define CELL 0.02
/* Sizes from the origin, from where on all planes have one cell. */
#define FARTHEST 1e9
/* For small facets, which are in many planes by their thickness alone. */
#define MOST_TURN (0.5 * CELL)

typedef struct plane { double at[4]; } plane; /* normal, distance over the sheet's size */

static rg_vec3 first_corner(const rg_mesh *m, int32_t f, const rg_vec3 *x)
{
    return x[m->facet_vertex[m->facet_start[f]]];
}

typedef struct sized { double area; int32_t f; } sized;

static int larger_first(const void *a, const void *b)
{
    const sized *p = a, *q = b;
    if (p->area != q->area) return p->area > q->area ? -1 : 1;
    return p->f < q->f ? -1 : p->f > q->f;
}

static rg_status sort_by_area(rg_coplanar *c)
{
    const int32_t nf = c->mesh->nf;
    sized *key = rg_mem_array(&c->mem, (size_t)nf, sizeof *key);
    if (!key) return RG_ENOMEM;
    for (int32_t f = 0; f < nf; f++) key[f] = (sized){rg_mesh_twice_area(c->mesh, f, c->mesh->X), f};
    qsort(key, (size_t)nf, sizeof *key, larger_first);
    for (int32_t f = 0; f < nf; f++) c->by_area[f] = key[f].f;
    rg_mem_free(&c->mem, key);
    return RG_OK;
}

rg_status rg_coplanar_init(rg_coplanar *c, const rg_memory *mem, const rg_mesh *m)
{
    const size_t nf = (size_t)m->nf;
    *c = (rg_coplanar){.mem = *mem, .mesh = m, .heads = 16};
    while (c->heads < 2 * nf) c->heads *= 2;
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(c->by_area, nf), RG_ARRAY(c->next, nf), RG_ARRAY(c->group, nf),
                                      RG_ARRAY(c->first, nf), RG_ARRAY(c->member, nf), RG_ARRAY(c->head, c->heads),
                                      RG_ARRAY(c->start, nf + 1));
    return s == RG_OK ? sort_by_area(c) : s;
}

void rg_coplanar_free(rg_coplanar *c)
{
    if (!c->mem.resize) return;
    RG_MEM_FREE(&c->mem, c->by_area, c->head, c->next, c->group, c->first, c->start, c->member);
    memset(c, 0, sizeof *c);
}

static size_t slot(const rg_coplanar *c, const int64_t cell[4])
{
    uint64_t h = 0;
    for (int i = 0; i < 4; i++) {
        h = (h ^ (uint64_t)cell[i]) * UINT64_C(0x9E3779B97F4A7C15);
        h ^= h >> 31;
    }
    return (size_t)h & (c->heads - 1);
}

/* The group whose plane facet f lies in, seen from either side; -1: none yet. */
static int32_t seek(const rg_coplanar *c, int32_t f, const plane *p, const rg_place *place, const rg_vec3 *x)
{
    const rg_mesh *m = c->mesh;
    for (int way = 0; way < 16; way++) {
        int64_t cell[4];
        for (int i = 0; i < 4; i++) cell[i] = (int64_t)floor(p->at[i] / CELL - 0.5) + (way >> i & 1);
        for (int32_t g = c->head[slot(c, cell)]; g >= 0; g = c->next[g]) {
            const rg_vec3 n = place[c->first[g]].R.c[2], o = first_corner(m, c->first[g], x);
            if (!(rg_vec3_length(rg_vec3_cross(n, place[f].R.c[2])) <= MOST_TURN)) continue;
            double most = 0;
            for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
                most = fmax(most, fabs(rg_vec3_dot(n, rg_vec3_sub(x[m->facet_vertex[j]], o))));
            if (most <= RG_COPLANAR_THICKNESS * m->size) return g;
        }
    }
    return -1;
}

static int32_t found_group(rg_coplanar *c, int32_t f, const plane *p)
{
    int64_t cell[4];
    for (int i = 0; i < 4; i++) cell[i] = (int64_t)floor(p->at[i] / CELL);
    const size_t at = slot(c, cell);
    const int32_t g = c->groups++;
    c->first[g] = f;
    c->next[g] = c->head[at];
    c->head[at] = g;
    return g;
}

void rg_coplanar_find(rg_coplanar *c, const rg_place *place, const rg_vec3 *x)
{
    const rg_mesh *m = c->mesh;
    memset(c->head, -1, c->heads * sizeof *c->head);
    c->groups = 0;
    for (int32_t i = 0; i < m->nf; i++) {
        const int32_t f = c->by_area[i];
        const rg_vec3 n = place[f].R.c[2];
        /* Positions that are read may be anywhere; cells are counted by whole numbers. */
        const double d = fmax(-FARTHEST, fmin(FARTHEST, rg_vec3_dot(n, first_corner(m, f, x)) / m->size));
        const plane up = {{n.x, n.y, n.z, d}}, down = {{-n.x, -n.y, -n.z, -d}};
        int32_t g = seek(c, f, &up, place, x);
        if (g < 0) g = seek(c, f, &down, place, x);
        c->group[f] = g >= 0 ? g : found_group(c, f, &up);
    }
    memset(c->start, 0, ((size_t)c->groups + 1) * sizeof *c->start);
    for (int32_t f = 0; f < m->nf; f++) c->start[c->group[f] + 1]++;
    for (int32_t g = 0; g < c->groups; g++) c->start[g + 1] += c->start[g];
    for (int32_t f = 0; f < m->nf; f++) c->member[c->start[c->group[f]]++] = f;
    for (int32_t g = c->groups; g > 0; g--) c->start[g] = c->start[g - 1];
    c->start[0] = 0;
}
