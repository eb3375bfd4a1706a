/* count.h -- how many orders there are, part by part, and any one of them.
 * Uses  propagate.h        Used by  blame.c
 *
 * Pairs that constraints with two unknown orders join are a part; parts don't touch each other, so the orders of the
 * whole are products. Within a part one pair is tried both ways; what is left falls into parts again, and those are
 * counted each for itself. The pair that is tried is the one that was most often in the way so far (F. Boussemart et
 * al., "Boosting systematic search by weighting constraints", ECAI 2004): weights are gathered while one order is
 * looked for, again and again from the beginning with more work each time, and stay as they are while orders are
 * counted and chosen, so that each has its number. */
#ifndef RG_LAYERS_COUNT_H
#define RG_LAYERS_COUNT_H

#include "layers/propagate.h"

typedef struct rg_parts {
    rg_memory mem;
    int32_t count;
    int32_t *start, *pair; /* [count + 1]: the unknown pairs of each, rising by their first ones */
    uint64_t *orders;      /* [count] how many there are; where `more`, how many are numbered */
    uint64_t *counted;     /* [count] how many there are; where `more`, at least */
    unsigned char *more;   /* [count] non-zero: there are more, counting them was given up */
    signed char *found;    /* [pairs] an order of each part, the one numbered 0 where `more` and orders is 1 */
    int32_t *weight;       /* [pairs] how often each was in the way as the first order was looked for; then it stays */
} rg_parts;

typedef enum rg_count_result { RG_COUNT_DONE, RG_COUNT_NONE, RG_COUNT_UNSOLVED } rg_count_result;

/* Of what is not known in o, which is propagated. NONE: part `*at` has no order. UNSOLVED: the work ran out before an
 * order of each part was found. work: of finding an order of each, and again of counting all, as o->work counts it.
 * RG_ENOMEM. Owner: the caller, rg_parts_free, also after a failure. */
rg_status rg_parts_init(rg_parts *q, const rg_memory *mem, rg_orders *o, int64_t work, rg_count_result *result,
                        int32_t *at);
void rg_parts_free(rg_parts *q);
/* Makes part i of o known: order `which` of it, which < q->orders[i]. RG_ENOMEM. */
rg_status rg_parts_choose(const rg_parts *q, rg_orders *o, int32_t i, uint64_t which);
/* An order of part i that agrees with wish[pairs] as far as pair after pair can: > 0, < 0 or 0, as orders of pairs.
 * RG_ENOMEM. */
rg_status rg_parts_choose_near(const rg_parts *q, rg_orders *o, int32_t i, const double *wish);

#endif
