#include "layers/blame.h"

#include <string.h>

/* Facets over cells that all tries together may go through: about a second. */
static const int64_t MOST_LOOKS = 4000000;
/* What one try may look at: as much as decides all small sets. */
static const int64_t WORK_A_TRY = 2000000;

typedef struct search {
    rg_memory mem;
    const rg_mesh *m;
    const rg_flat *f;
    const rg_cells *c;
    unsigned char *in;  /* [nf] the facets of the set that is tried */
    int32_t *over_start, *over;
    int64_t looks;
    int gave_up;
    rg_blame *b;        /* of the last set without an order: rule, by_trying */
    rg_status status;
} search;

/* Cells with only the facets of the set over them. */
static rg_cells cells_of_set(search *s)
{
    rg_cells some = *s->c;
    int32_t n = 0;
    for (int32_t i = 0; i < s->c->faces.count; i++) {
        for (int32_t j = s->c->over_start[i]; j < s->c->over_start[i + 1]; j++)
            if (s->in[s->c->over[j]]) s->over[n++] = s->c->over[j];
        s->over_start[i + 1] = n;
    }
    some.over_start = s->over_start;
    some.over = s->over;
    s->looks += n + s->c->graph.ne;
    return some;
}

/* Whether the facets of the set are known to have no order by themselves. */
static int has_none(search *s)
{
    rg_pairs p = {0};
    rg_constraints k = {0};
    rg_orders o = {0};
    rg_parts q = {0};
    int none = 0, by_trying = 0;
    if (s->looks > MOST_LOOKS) s->gave_up = 1;
    if (s->gave_up || s->status != RG_OK) return 0;
    const rg_cells some = cells_of_set(s);
    rg_status status = rg_pairs_init(&p, &s->mem, &some, s->f->nf, NULL);
    if (status == RG_OK) status = rg_constraints_init(&k, &s->mem, s->m, s->f, &some, &p);
    if (status == RG_OK) status = rg_orders_init(&o, &s->mem, &p, &k);
    if (status == RG_OK) none = !rg_orders_set_hinges(&o) || !rg_orders_propagate(&o);
    if (status == RG_OK && !none) {
        rg_count_result result;
        int32_t part;
        status = rg_parts_init(&q, &s->mem, &o, WORK_A_TRY, &result, &part);
        none = by_trying = status == RG_OK && result == RG_COUNT_NONE;
    }
    if (none) {
        s->b->rule = by_trying ? RG_RULE_TRANSITIVITY : o.conflict.rule;
        s->b->by_trying = by_trying;
    }
    s->looks += o.work / 16 + k.count;
    rg_parts_free(&q);
    rg_orders_free(&o);
    rg_constraints_free(&k);
    rg_pairs_free(&p);
    s->status = status == RG_EFORMAT ? RG_OK : status;
    return none;
}

static void put(search *s, const int32_t *facet, int32_t n, int in)
{
    for (int32_t i = 0; i < n; i++) s->in[facet[i]] = (unsigned char)in;
}

/* Of n facets, which with those in s->in have no order, as few as will do, to the front; returns how many. changed:
 * s->in is not what it was when that was last tried. On return they are in s->in. */
static int32_t least(search *s, int32_t *facet, int32_t n, int changed)
{
    if (changed && has_none(s)) return 0;
    if (n == 1) {
        put(s, facet, 1, 1);
        return 1;
    }
    const int32_t half = n / 2;
    put(s, facet, half, 1);
    const int32_t upper = least(s, facet + half, n - half, 1);
    put(s, facet, half, 0);
    const int32_t lower = least(s, facet, half, upper > 0);
    memmove(facet + lower, facet + half, (size_t)upper * sizeof *facet);
    return lower + upper;
}

/* The facets beside those of the list, after them. */
static int32_t grow(const search *s, int32_t *list, int32_t n)
{
    const int32_t had = n;
    for (int32_t i = 0; i < had; i++)
        for (int32_t j = s->f->start[list[i]]; j < s->f->start[list[i] + 1]; j++)
            for (int side = 0; side < 2; side++) {
                const int32_t g = s->f->beside[s->f->edge[j]][side];
                if (g < 0 || s->in[g]) continue;
                s->in[g] = 1;
                list[n++] = g;
            }
    return n;
}

rg_status rg_blame_find(rg_blame *b, const rg_memory *mem, const rg_mesh *m, const rg_flat *f, const rg_cells *c,
                        const int32_t *near, int32_t n)
{
    search s = {.mem = *mem, .m = m, .f = f, .c = c, .b = b};
    s.status = RG_MEM_ARRAYS(mem, RG_ARRAY(s.in, (size_t)f->nf), RG_ARRAY(s.over_start, (size_t)c->faces.count + 1),
                             RG_ARRAY(s.over, (size_t)c->over_start[c->faces.count]));
    b->count = 0;
    if (s.status == RG_OK) {
        int32_t had = 0, found = 0;
        for (int32_t i = 0; i < n; i++)
            if (!s.in[near[i]]) s.in[near[i]] = 1, b->facet[b->count++] = near[i];
        while (b->count > had && !(found = has_none(&s))) {
            had = b->count;
            b->count = grow(&s, b->facet, b->count);
        }
        if (found) {
            put(&s, b->facet, b->count, 0);
            b->count = least(&s, b->facet, b->count, 0);
            /* Whether this is a set without an order, and by which rule, is asked of itself. */
            memset(s.in, 0, (size_t)f->nf);
            put(&s, b->facet, b->count, 1);
            found = has_none(&s);
        }
        if (!found) b->count = 0;
    }
    for (int32_t i = 1; i < b->count; i++)
        for (int32_t j = i; j > 0 && b->facet[j - 1] > b->facet[j]; j--) {
            const int32_t swap = b->facet[j];
            b->facet[j] = b->facet[j - 1], b->facet[j - 1] = swap;
        }
    RG_MEM_FREE(mem, s.in, s.over_start, s.over);
    return s.status;
}
