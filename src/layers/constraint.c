#include "layers/constraint.h"

#include <stdlib.h>
#include <string.h>

void rg_constraints_free(rg_constraints *k)
{
    if (!k->mem.resize) return;
    const rg_memory mem = k->mem;
    RG_MEM_FREE(&mem, k->item, k->start, k->of, k->hinge, k->hinge_edge);
    memset(k, 0, sizeof *k);
}

/* What lies along one segment: facets left and right of it by the edge they have there. */
typedef struct taco { int32_t a, b, edge; } taco;
typedef struct place {
    taco *fold[2], *flat; /* left, right; a left of it and b right */
    int32_t folds[2], flats;
    const int32_t *across;
    int32_t crossings, segment;
} place;

typedef struct maker { rg_constraints *k; const rg_pairs *p; } maker;

/* Multiplies the order of g over f into the case. Zero: they overlap by no more than rounding. */
static int times(const maker *w, rg_constraint_case *c, int32_t f, int32_t g)
{
    const int32_t pair = f == g ? -1 : rg_pairs_find(w->p, f, g);
    if (pair < 0) return 0;
    c->pair[c->n++] = pair;
    if (f > g) c->sign = (signed char)-c->sign;
    return 1;
}

static rg_status add(maker *w, rg_constraint_case c, const int32_t (*of)[2], int n)
{
    c.n = 0, c.sign = 1;
    c.pair[2] = c.pair[3] = -1;
    for (int i = 0; i < n; i++)
        if (!times(w, &c, of[i][0], of[i][1])) return RG_OK;
    const size_t need = (size_t)w->k->count + 1;
    if (need > INT32_MAX / 4) return RG_ENOMEM;
    const rg_status s = RG_MEM_GROW(&w->k->mem, w->k->item, w->k->room, need);
    if (s == RG_OK) w->k->item[w->k->count++] = c;
    return s;
}

static rg_constraint_case case_of(rg_rule rule, const taco *p, int32_t third, int32_t fourth, int32_t edge, int32_t at)
{
    return (rg_constraint_case){
        .rule = rule, .facet = {p->a, p->b, third, fourth}, .edge = {p->edge, edge}, .segment = at};
}

static rg_status taco_taco(maker *w, const taco *p, const taco *q, int32_t at)
{
    if (p->edge > q->edge) {
        const taco *swap = p;
        p = q, q = swap;
    }
    return add(w, case_of(RG_RULE_TACO_TACO, p, q->a, q->b, q->edge, at),
               (const int32_t[][2]){{p->a, q->a}, {p->b, q->a}, {p->a, q->b}, {p->b, q->b}}, 4);
}

static rg_status taco_tortilla(maker *w, const taco *p, int32_t t, int32_t edge, int32_t at)
{
    return add(w, case_of(RG_RULE_TACO_TORTILLA, p, t, -1, edge, at), (const int32_t[][2]){{p->a, t}, {p->b, t}}, 2);
}

/* u, v: the other tortilla left and right; v -1: the same facet. */
static rg_status tortilla_tortilla(maker *w, const taco *p, int32_t u, int32_t v, int32_t edge, int32_t at)
{
    return add(w, case_of(RG_RULE_TORTILLA_TORTILLA, p, u, v, edge, at),
               (const int32_t[][2]){{p->a, u}, {p->b, v < 0 ? u : v}}, 2);
}

static rg_status cases_at(maker *w, const place *q)
{
    const int32_t at = q->segment;
    rg_status s = RG_OK;
    for (int side = 0; side < 2; side++)
        for (int32_t i = 0; s == RG_OK && i < q->folds[side]; i++) {
            const taco *t = &q->fold[side][i];
            for (int32_t j = i + 1; s == RG_OK && j < q->folds[side]; j++) s = taco_taco(w, t, &q->fold[side][j], at);
            for (int32_t j = 0; s == RG_OK && j < q->crossings; j++) s = taco_tortilla(w, t, q->across[j], -1, at);
            for (int32_t j = 0; s == RG_OK && j < q->flats; j++)
                s = taco_tortilla(w, t, side ? q->flat[j].b : q->flat[j].a, q->flat[j].edge, at);
        }
    for (int32_t i = 0; s == RG_OK && i < q->flats; i++) {
        for (int32_t j = i + 1; s == RG_OK && j < q->flats; j++)
            s = tortilla_tortilla(w, &q->flat[i], q->flat[j].a, q->flat[j].b, q->flat[j].edge, at);
        for (int32_t j = 0; s == RG_OK && j < q->crossings; j++)
            s = tortilla_tortilla(w, &q->flat[i], q->across[j], -1, -1, at);
    }
    return s;
}

/* Sorts the edges along a segment into the place. */
static void sort_out(place *q, const rg_mesh *m, const rg_flat *f, const rg_cells *c, int32_t i)
{
    const rg_vec2 d = rg_vec2_sub(c->graph.X[c->graph.E[i].v[1]], c->graph.X[c->graph.E[i].v[0]]);
    q->folds[0] = q->folds[1] = q->flats = 0;
    q->segment = i;
    q->across = c->across + c->across_start[i];
    q->crossings = c->across_start[i + 1] - c->across_start[i];
    for (int32_t j = c->along_start[i]; j < c->along_start[i + 1]; j++) {
        const int32_t e = c->along[j], a = f->beside[e][0], b = f->beside[e][1];
        if (a < 0 || b < 0) continue; /* a border keeps nobody out */
        const int back = rg_vec2_dot(d, rg_vec2_sub(f->x[m->edge[e][1]], f->x[m->edge[e][0]])) < 0;
        const int right = back != (f->up[a] < 0); /* facet a is left of its edge where its front is up */
        if (f->turn[e]) q->fold[right][q->folds[right]++] = (taco){a, b, e};
        else q->flat[q->flats++] = right ? (taco){b, a, e} : (taco){a, b, e};
    }
}

static int by_facets(const void *a, const void *b)
{
    const rg_constraint_case *p = a, *q = b;
    if (p->rule != q->rule) return p->rule < q->rule ? -1 : 1;
    for (int i = 0; i < 4; i++)
        if (p->facet[i] != q->facet[i]) return p->facet[i] < q->facet[i] ? -1 : 1;
    for (int i = 0; i < 2; i++)
        if (p->edge[i] != q->edge[i]) return p->edge[i] < q->edge[i] ? -1 : 1;
    return (p->segment > q->segment) - (p->segment < q->segment);
}

static int is_same(const rg_constraint_case *p, const rg_constraint_case *q)
{
    return p->rule == q->rule && memcmp(p->facet, q->facet, sizeof p->facet) == 0 &&
           memcmp(p->edge, q->edge, sizeof p->edge) == 0;
}

static void drop_doubles(rg_constraints *k)
{
    int32_t n = 0;
    if (k->count == 0) return;
    qsort(k->item, (size_t)k->count, sizeof *k->item, by_facets);
    for (int32_t i = 0; i < k->count; i++)
        if (n == 0 || !is_same(&k->item[n - 1], &k->item[i])) k->item[n++] = k->item[i];
    k->count = n;
}

/* start[pair] after counting two to the right, as the fill moves each on by one. */
static rg_status list_by_pair(rg_constraints *k, int32_t pairs)
{
    if (RG_MEM_ARRAYS(&k->mem, RG_ARRAY(k->start, (size_t)pairs + 2),
                      RG_ARRAY(k->of, 4 * (size_t)k->count)) != RG_OK) return RG_ENOMEM;
    for (int32_t i = 0; i < k->count; i++)
        for (int j = 0; j < k->item[i].n; j++) k->start[k->item[i].pair[j] + 2]++;
    for (int32_t i = 2; i <= pairs; i++) k->start[i] += k->start[i - 1];
    for (int32_t i = 0; i < k->count; i++)
        for (int j = 0; j < k->item[i].n; j++) k->of[k->start[k->item[i].pair[j] + 1]++] = i;
    return RG_OK;
}

/* A valley folds the other facet onto the front: above it where its front is up. */
static rg_status find_hinges(rg_constraints *k, const rg_mesh *m, const rg_flat *f, const rg_pairs *p)
{
    if (RG_MEM_ARRAYS(&k->mem, RG_ARRAY(k->hinge, (size_t)p->count),
                      RG_ARRAY(k->hinge_edge, (size_t)p->count)) != RG_OK) return RG_ENOMEM;
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t a = f->beside[e][0], b = f->beside[e][1];
        if (f->turn[e] == 0 || f->turn[e] == 2 || a < 0 || b < 0) continue;
        const int32_t low = a < b ? a : b, pair = rg_pairs_find(p, a, b);
        if (pair < 0) continue;
        const signed char order = f->turn[e] == f->up[low] ? 1 : -1;
        k->hinge[pair] = (signed char)(k->hinge[pair] == 0 || k->hinge[pair] == order ? order : 2);
        k->hinge_edge[pair] = e;
    }
    return RG_OK;
}

rg_status rg_constraints_init(rg_constraints *k, const rg_memory *mem, const rg_mesh *m, const rg_flat *f,
                              const rg_cells *c, const rg_pairs *p)
{
    memset(k, 0, sizeof *k);
    k->mem = *mem;
    int32_t most = 0;
    for (int32_t i = 0; i < c->graph.ne; i++)
        if (c->along_start[i + 1] - c->along_start[i] > most) most = c->along_start[i + 1] - c->along_start[i];
    taco *room = rg_mem_array(mem, 3 * (size_t)most, sizeof *room);
    place q = {.fold = {room, room + most}, .flat = room + 2 * (size_t)most};
    maker w = {k, p};
    rg_status s = room ? RG_OK : RG_ENOMEM;
    for (int32_t i = 0; s == RG_OK && i < c->graph.ne; i++) {
        sort_out(&q, m, f, c, i);
        s = cases_at(&w, &q);
    }
    rg_mem_free(mem, room);
    if (s == RG_OK) {
        drop_doubles(k);
        s = list_by_pair(k, p->count);
    }
    return s == RG_OK ? find_hinges(k, m, f, p) : s;
}
