/* blame.h -- a few facets that cannot be ordered, whatever the others do.
 * Source   deletion of what is not needed, half of it at once: U. Junker, "QuickXplain" (AAAI 2004)
 * Uses  count.h        Used by  layers.c
 *
 * What holds for some of the facets holds for all: each constraint is of three or four facets that are over one place.
 * So facets that have no order by themselves are the reason why the sheet has none; and when none of them can be
 * spared, a reason to show. */
#ifndef RG_LAYERS_BLAME_H
#define RG_LAYERS_BLAME_H

#include "layers/count.h"

typedef struct rg_blame {
    int32_t *facet, count; /* rising */
    /* What fails of them at once; RG_RULE_TRANSITIVITY too where only trying all orders shows it. */
    rg_rule rule;
    int by_trying;         /* non-zero: only trying all orders shows it */
} rg_blame;

/* Of a sheet that has no order. near[n]: facets where it showed, from which the search goes outwards.
 * facet of *b: room for all; count 0: not found within the work that this may take. RG_ENOMEM. */
rg_status rg_blame_find(rg_blame *b, const rg_memory *mem, const rg_mesh *m, const rg_flat *f, const rg_cells *c,
                        const int32_t *near, int32_t n);

#endif
