/* cuts.h -- which facets are cut into triangles, and which of them could do without: whole orbits of facets.
 * Paper    section 3.2        Uses  attempt.h        Used by  retract.c */
#ifndef RG_CUTS_H
#define RG_CUTS_H

#include "mesh/symmetry.h"
#include "motion/attempt.h"

typedef struct rg_cuts {
    rg_memory mem;
    const rg_mesh *none;  /* borrowed: the facets as drawn */
    const rg_symmetry *G; /* borrowed: of none; NULL: facets are cut one by one */
    int32_t *piece_of;    /* [corners] scratch: facet that a facet of an attempt's mesh is a piece of */
    unsigned char *which; /* [none->nf] those to cut */
    int32_t cut;          /* how many they are */
    double *bend;         /* [none->nf] radians, the most that it bends, as last measured; negative: it is whole */
    int32_t bends;        /* how many can bend */
} rg_cuts;

/* all: an attempt for which all facets were cut, measured. RG_ENOMEM. Owner: the caller, rg_cuts_free. */
rg_status rg_cuts_init(rg_cuts *c, const rg_memory *mem, const rg_mesh *none, const rg_symmetry *G,
                       const rg_attempt *all);
void rg_cuts_free(rg_cuts *c);

/* How facets bend on the path of t, for which c->which were cut. */
void rg_cuts_measure(rg_cuts *c, const rg_attempt *t);

/* What is to be cut next, of the facets that can bend: those that do by `least` or more; all but the n that do least,
 * or more to make orbits whole; those at one of the vertices, and their images. */
void rg_cuts_bending(rg_cuts *c, double least);
void rg_cuts_all_but(rg_cuts *c, int32_t n);
void rg_cuts_around(rg_cuts *c, const int32_t *vertex, int32_t vertices);

#endif
