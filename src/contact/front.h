/* front.h -- sheets of which every facet shows its front to one side: they meet themselves nowhere.
 * Uses  plates.h        Used by  contact.c sweep.c
 *
 * Look at the sheet along a direction d, and let every facet be seen from its front, n_f . d > 0. The picture then is a
 * map of a disk into the plane that keeps orientation on every facet, so as many points of the sheet lie behind a point
 * of the plane as the picture of the border winds round it. Where that is a simple curve, it is one or none: no two
 * facets cover each other, and none can cross. One product a facet and one sweep over the border do for all pairs. */
#ifndef RG_FRONT_H
#define RG_FRONT_H

#include "contact/plates.h"

typedef struct rg_front_work {
    rg_memory mem;
    rg_vec3 *normal;    /* [nf] */
    rg_vec2 *from, *to; /* [nv] the picture */
    int32_t *order;    /* [borders] places in p->border, by where they begin */
    double *low, *high; /* [borders] from where to where, across the picture */
} rg_front_work;

/* RG_ENOMEM: *w is zeroed. */
rg_status rg_front_work_init(const rg_plates *p, rg_front_work *w);
void rg_front_work_free(rg_front_work *w);

/* Non-zero: seen along some direction, every facet of x[nv] shows its front, and the border is simple. normal[n]: the
 * facets' or their parts' in x, unit. Zero says nothing. Allocates nothing. */
int rg_front_shows(const rg_plates *p, const rg_vec3 *x, const rg_vec3 *normal, int32_t n, rg_front_work *w);
/* Non-zero: from one state to the next no two facets cross deeper than `depth` (file units), however they move, as long
 * as each corner keeps within depth / 2 of a straight and steady way, and so if each facet turns steadily about the
 * middle of its box, which goes straight. All of it as seen from a place that may turn with the sheet. Zero says
 * nothing. Allocates nothing. */
int rg_front_shows_moving(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, double depth,
                          rg_front_work *w);

/* The angle of the rotation from R to S. */
double rg_front_angle(const rg_mat3 *R, const rg_mat3 *S);

#endif
