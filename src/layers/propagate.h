/* propagate.h -- orders of pairs of facets that are known, and what follows from them.
 * Uses  constraint.h        Used by  count.c
 *
 * An equation of signs gives its last unknown one. Transitivity: of a < b follows, for every facet c that has a common
 * place with both, a < c where b < c and c < b where c < a; facets being bits of a row, 64 of them at once. */
#ifndef RG_LAYERS_PROPAGATE_H
#define RG_LAYERS_PROPAGATE_H

#include "layers/constraint.h"

typedef struct rg_conflict { rg_rule rule; int32_t facet[4], n, edge[2]; } rg_conflict;

typedef struct rg_orders {
    rg_memory mem;
    const rg_pairs *pairs;
    const rg_constraints *constraints;
    signed char *value;      /* [pairs] +1: the second facet lies above the first, -1 below; 0: not known */
    uint64_t *above, *below; /* [nf][words] bit of g in row f: g is known to lie above f, below f */
    int32_t *trail, known;   /* pairs in the order in which they came to be known */
    int32_t done;            /* of the trail, what all is drawn from */
    int64_t work;            /* words and cases looked at, since the beginning */
    rg_conflict conflict;    /* of what failed last */
} rg_orders;

/* Nothing known. p and k are kept by reference. RG_ENOMEM. Owner: the caller, rg_orders_free, also after a failure. */
rg_status rg_orders_init(rg_orders *o, const rg_memory *mem, const rg_pairs *p, const rg_constraints *k);
void rg_orders_free(rg_orders *o);
/* Both: 0: it contradicts, o->conflict says what; then the caller undoes. They allocate nothing. */
int rg_orders_set(rg_orders *o, int32_t pair, int value);
int rg_orders_propagate(rg_orders *o);
/* What creases' mountains and valleys say. */
int rg_orders_set_hinges(rg_orders *o);
/* Back to when `known` was that. */
void rg_orders_undo(rg_orders *o, int32_t known);

#endif
