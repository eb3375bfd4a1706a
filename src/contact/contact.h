/* contact.h -- which facets of a state cross, and how deep.
 * Uses  plates.h depth.h front.h        Used by  motion
 *
 * Facets that share a corner or a crease touch there, which is no depth; what they do beyond it counts like any other
 * crossing, if it is over more than RG_CONTACT_STRETCH of the sheet. Layers in one plane have no depth either, whatever
 * their order. */
#ifndef RG_CONTACT_H
#define RG_CONTACT_H

#include "contact/depth.h"
#include "contact/front.h"
#include "contact/plates.h"

typedef struct rg_contact_hit {
    int32_t facet[2];
    double depth; /* over the sheet's size */
    rg_vec3 axis; /* unit: along which moving the second facet, or back, parts them */
} rg_contact_hit;

typedef struct rg_contact_work {
    rg_memory mem;
    rg_box *box;         /* [nodes] */
    rg_vec3 *corner;     /* [corners of parts] where they are */
    rg_vec3 *normal;     /* [parts] */
    rg_front_work front;
} rg_contact_work;

/* Room for states of these plates; one per thread. RG_ENOMEM: *w is zeroed. */
rg_status rg_contact_work_init(const rg_plates *p, rg_contact_work *w);
void rg_contact_work_free(rg_contact_work *w);

/* Pairs of facets that cross deeper than `least` of the sheet (RG_CONTACT_TOLERANCE), as vertices are placed by x[nv].
 * Returns how many; the first `room` of them are in hit[], in an order that depends on nothing but the sheet.
 *   deepest  out, may be NULL; depth 0, facets -1 where there are none. Of a facet in several parts: its deepest part
 * Allocates nothing. */
int32_t rg_contact_pairs(const rg_plates *p, const rg_vec3 *x, double least, rg_contact_work *w, rg_contact_hit *hit,
                         int32_t room,
                         rg_contact_hit *deepest);
/* The deepest of all pairs that cross deeper than `least`; zero: there is none, *deepest is then untouched. Much
 * cheaper than to count them, as whatever cannot be deeper than the deepest so far is left out. Allocates nothing. */
int rg_contact_deepest(const rg_plates *p, const rg_vec3 *x, double least, rg_contact_work *w, rg_contact_hit *deepest);
/* The depth of one pair of facets, over the sheet's size; 0 where it is not more than `least`. Allocates nothing. */
double rg_contact_depth(const rg_plates *p, const rg_vec3 *x, int32_t f, int32_t g, double least);

#endif
