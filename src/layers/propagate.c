#include "layers/propagate.h"

#include <string.h>

rg_status rg_orders_init(rg_orders *o, const rg_memory *mem, const rg_pairs *p, const rg_constraints *k)
{
    const size_t size = (size_t)p->nf * (size_t)p->words;
    memset(o, 0, sizeof *o);
    o->mem = *mem;
    o->pairs = p;
    o->constraints = k;
    return RG_MEM_ARRAYS(mem, RG_ARRAY(o->value, (size_t)p->count), RG_ARRAY(o->trail, (size_t)p->count),
                         RG_ARRAY(o->above, size), RG_ARRAY(o->below, size));
}

void rg_orders_free(rg_orders *o)
{
    if (!o->mem.resize) return;
    const rg_memory mem = o->mem;
    RG_MEM_FREE(&mem, o->value, o->trail, o->above, o->below);
    memset(o, 0, sizeof *o);
}

static void flip(rg_orders *o, int32_t pair)
{
    int32_t low = o->pairs->facet[pair][0], high = o->pairs->facet[pair][1];
    if (o->value[pair] < 0) {
        const int32_t swap = low;
        low = high, high = swap;
    }
    const int32_t *bit = o->pairs->bit, l = bit[low], h = bit[high];
    const size_t words = (size_t)o->pairs->words;
    o->above[(size_t)low * words + (size_t)(h >> 6)] ^= UINT64_C(1) << (h & 63);
    o->below[(size_t)high * words + (size_t)(l >> 6)] ^= UINT64_C(1) << (l & 63);
}

int rg_orders_set(rg_orders *o, int32_t pair, int value)
{
    if (o->value[pair]) return o->value[pair] == value;
    o->value[pair] = (signed char)value;
    flip(o, pair);
    o->trail[o->known++] = pair;
    return 1;
}

void rg_orders_undo(rg_orders *o, int32_t known)
{
    while (o->known > known) {
        const int32_t pair = o->trail[--o->known];
        flip(o, pair);
        o->value[pair] = 0;
    }
    if (o->done > known) o->done = known;
}

/* low < high is known for two facets that overlap: does it agree? */
static int set_order(rg_orders *o, int32_t low, int32_t high)
{
    const int32_t pair = rg_pairs_find(o->pairs, low, high);
    return rg_orders_set(o, pair, low < high ? 1 : -1);
}

static int in_circle(rg_orders *o, int32_t a, int32_t b, int32_t c)
{
    o->conflict = (rg_conflict){RG_RULE_TRANSITIVITY, {a, b, c, -1}, 3, {-1, -1}};
    return 0;
}

static int draw_transitivity(rg_orders *o, int32_t pair)
{
    const rg_pairs *p = o->pairs;
    const int64_t first = p->common_start[pair], last = p->common_start[pair + 1];
    const int32_t a = p->facet[pair][o->value[pair] < 0], b = p->facet[pair][o->value[pair] > 0]; /* a < b */
    const size_t words = (size_t)p->words;
    const uint64_t *above_a = o->above + (size_t)a * words, *above_b = o->above + (size_t)b * words;
    const uint64_t *below_a = o->below + (size_t)a * words, *below_b = o->below + (size_t)b * words;
    o->work += last - first;
    for (int64_t i = first; i < last; i++) {
        const size_t w = (size_t)p->common_word[i];
        for (uint64_t bits = p->common[i] & above_b[w] & ~above_a[w]; bits; bits &= bits - 1) {
            const int32_t c = p->of_bit[(int32_t)(64 * w) + __builtin_ctzll(bits)];
            if (!set_order(o, a, c)) return in_circle(o, a, b, c);
        }
        for (uint64_t bits = p->common[i] & below_a[w] & ~below_b[w]; bits; bits &= bits - 1) {
            const int32_t c = p->of_bit[(int32_t)(64 * w) + __builtin_ctzll(bits)];
            if (!set_order(o, c, b)) return in_circle(o, a, b, c);
        }
    }
    return 1;
}

static int draw_case(rg_orders *o, const rg_constraint_case *c)
{
    int sign = c->sign, unknown = -1;
    for (int i = 0; i < c->n; i++) {
        const int value = o->value[c->pair[i]];
        if (value) sign *= value;
        else if (unknown >= 0) return 1;
        else unknown = c->pair[i];
    }
    if (unknown >= 0 ? rg_orders_set(o, unknown, sign) : sign > 0) return 1;
    o->conflict = (rg_conflict){c->rule, {c->facet[0], c->facet[1], c->facet[2], c->facet[3]}, c->facet[3] < 0 ? 3 : 4,
                                {c->edge[0], c->edge[1]}};
    return 0;
}

int rg_orders_propagate(rg_orders *o)
{
    const rg_constraints *k = o->constraints;
    while (o->done < o->known) {
        const int32_t pair = o->trail[o->done++];
        o->work += k->start[pair + 1] - k->start[pair] + 1;
        for (int32_t j = k->start[pair]; j < k->start[pair + 1]; j++)
            if (!draw_case(o, &k->item[k->of[j]])) return 0;
        if (!draw_transitivity(o, pair)) return 0;
    }
    return 1;
}

int rg_orders_set_hinges(rg_orders *o)
{
    const rg_constraints *k = o->constraints;
    for (int32_t i = 0; i < o->pairs->count; i++) {
        if (!k->hinge[i]) continue;
        if (k->hinge[i] != 2 && rg_orders_set(o, i, k->hinge[i])) continue;
        const int32_t *facet = o->pairs->facet[i];
        o->conflict = (rg_conflict){RG_RULE_HINGE, {facet[0], facet[1], -1, -1}, 2, {k->hinge_edge[i], -1}};
        return 0;
    }
    return 1;
}
