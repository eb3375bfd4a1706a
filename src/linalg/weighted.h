/* weighted.h -- a graph with weights, and its parting: two parts, and the nodes between them, which separate them.
 * Used by  cut.c separator.c */
#ifndef RG_WEIGHTED_H
#define RG_WEIGHTED_H

#include "base/memory.h"

typedef struct rg_weighted {
    int32_t n;
    int32_t *start, *to; /* [n + 1], neighbours */
    int32_t *weight;     /* [n] unknowns in a node */
    int32_t *edge;       /* as `to`: edges of the finest copy in an edge */
    int32_t total;       /* sum of weights */
} rg_weighted;

/* Arrays of zeros. Non-zero: made; zero: out of memory, and nothing to free. */
int rg_weighted_init(rg_weighted *g, const rg_memory *mem, int32_t n, int32_t edges);
void rg_weighted_free(rg_weighted *g, const rg_memory *mem);
/* c: out, g with all nodes of one number as one. of[n]: that number, below `fewer`. Non-zero: made. */
int rg_weighted_contract(const rg_weighted *g, const rg_memory *mem, const int32_t *of, int32_t fewer, rg_weighted *c);

enum { RG_SEPARATOR = 2 }; /* parts are 0 and 1 */

typedef struct rg_parting {
    const rg_weighted *g;
    int32_t *part;     /* [n] */
    int32_t weight[3]; /* of parts and separator */
} rg_parting;

/* The larger part may have so much of what half of the weights would be. */
extern const double RG_PARTING_MOST;

/* Sums weights up. */
void rg_parting_weigh(rg_parting *p);
/* The smaller, the better. */
double rg_parting_cost(const rg_parting *p);

#endif
