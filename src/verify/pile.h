/* pile.h -- the layers of a flat end: does the order of the file hold everywhere? Paper    none; the conditions are
 * those of Akitaya, Demaine and Ku (2017) after Justin (1994)        Uses  apart.h faults.h Used by  certificate.c */
#ifndef RG_PILE_H
#define RG_PILE_H

#include "verify/faults.h"
#include "verify/apart.h"

typedef struct rg_pile {
    int is_flat;    /* the last frame lies in one plane, folded */
    int32_t pairs;  /* facets that lie over each other there */
    int32_t seen;   /* of these, that came in some order */
} rg_pile;

/* The last frame, if it is folded flat: every two facets over each other have an order, at creases the one that
 * mountain and valley ask for; no three go round; nothing that goes on across a crease lies between its two facets; two
 * creases on one line are beside or in each other; flat creases keep what is above them above; and facets lie as they
 * came to, where that is known. All pairs and triples are gone through. sides: of the way to the last frame.
 * RG_ENOMEM. */
rg_status rg_pile_check(const rg_record *r, const rg_pieces *p, const rg_aparts *sides, rg_faults *all, rg_pile *found);

#endif
