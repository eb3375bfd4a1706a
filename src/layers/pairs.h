/* pairs.h -- facets that lie on each other, and threes of them that have a common place.
 * Uses  cells.h        Used by  constraint.c overlap.c */
#ifndef RG_LAYERS_PAIRS_H
#define RG_LAYERS_PAIRS_H

#include "layers/cells.h"

typedef struct rg_pairs {
    rg_memory mem;
    int32_t nf, count, words;   /* facets, pairs, 64-bit words in a row of facets */
    /* [nf] where a facet stands in a row, and which facet stands there: facets that are over one place stand together,
     * so that common places are few words */
    int32_t *bit, *of_bit;
    int32_t (*facet)[2];        /* [count] the lower one first */
    uint64_t *row;              /* [nf][words] bit of g in row f: f and g overlap */
    int32_t *before;            /* [nf][words] pairs with facet f up to that word, see rg_pairs_find */
    int32_t *start, *number;    /* [nf + 1]: pairs of facet f by the bit of the other one */
    int64_t *common_start;      /* [count + 1] */
    int32_t *common_word;       /* which word of a row ... */
    uint64_t *common;           /* ... and its bits: facets over a place that both facets of the pair are over */
} rg_pairs;

/* RG_ENOMEM; RG_EFORMAT: too many for the memory that this may take, or `stop` (NULL: nobody) ends it.
 * Owner: the caller, rg_pairs_free, also after a failure. */
rg_status rg_pairs_init(rg_pairs *p, const rg_memory *mem, const rg_cells *c, int32_t nf, const rg_stop *stop);
void rg_pairs_free(rg_pairs *p);
/* The pair of f and g; -1: they do not overlap. */
static inline int32_t rg_pairs_find(const rg_pairs *p, int32_t f, int32_t g)
{
    const int32_t b = p->bit[g];
    const size_t at = (size_t)f * (size_t)p->words + (size_t)(b >> 6);
    const uint64_t bit = UINT64_C(1) << (b & 63);
    if (!(p->row[at] & bit)) return -1;
    return p->number[p->before[at] + __builtin_popcountll(p->row[at] & (bit - 1))];
}

#endif
