/* constraint.h -- what creases that lie on each other, or run through facets, ask of the order of facets.
 * Source   H. Akitaya, E. Demaine, J. Ku et al., taco-taco, taco-tortilla, tortilla-tortilla conditions; transitivity
 *          is in pairs.h
 * Uses  pairs.h        Used by  propagate.c
 *
 * A taco is two facets at a folded crease, on one side of its line; a tortilla goes on across the line, as one facet or
 * as two at a crease that stays flat. Let o(f, g) be +1 where g lies above f, -1 below. Then, all of these facets
 * having a common place:
 *   taco A B, taco C D, one side     o(A,C) o(B,C) o(A,D) o(B,D) = 1    of C, D none or both lie between A and B
 *   taco A B, tortilla T             o(A,T) o(B,T) = 1                  T is not between A and B
 *   tortillas T T', U U'             o(T,U) o(T',U') = 1                they do not cross
 * So each is an equation of signs; only transitivity is not. */
#ifndef RG_LAYERS_CONSTRAINT_H
#define RG_LAYERS_CONSTRAINT_H

#include "layers/pairs.h"

typedef enum rg_rule {
    RG_RULE_HINGE,
    RG_RULE_TACO_TACO,
    RG_RULE_TACO_TORTILLA,
    RG_RULE_TORTILLA_TORTILLA,
    RG_RULE_TRANSITIVITY
} rg_rule;

typedef struct rg_constraint_case {
    rg_rule rule;
    /* taco A B, taco C D; taco A B, tortilla T (-1); tortilla T T', U U', or U and -1: one facet on both sides */
    int32_t facet[4];
    int32_t edge[2];     /* of the mesh: of the first two, and of the others; -1: none, it runs through the facet */
    int32_t segment;     /* of the cells, one of those along which it holds */
    int32_t pair[4], n;  /* 2 or 4 */
    signed char sign;    /* the product of their orders: +1 where the second facet of a pair lies above the first */
} rg_constraint_case;

typedef struct rg_constraints {
    rg_memory mem;
    rg_constraint_case *item; /* [count] rising by rule, facets, edges; each once */
    int32_t count;
    size_t room;
    int32_t *start, *of;      /* [pairs + 1]: the cases that a pair is in */
    signed char *hinge;       /* [pairs] order of a pair at a crease, by mountain and valley; 0: free; 2: both */
    int32_t *hinge_edge;      /* [pairs] that crease, of the mesh */
} rg_constraints;

/* RG_ENOMEM. Owner: the caller, rg_constraints_free, also after a failure. */
rg_status rg_constraints_init(rg_constraints *k, const rg_memory *mem, const rg_mesh *m, const rg_flat *f,
                              const rg_cells *c, const rg_pairs *p);
void rg_constraints_free(rg_constraints *k);

#endif
