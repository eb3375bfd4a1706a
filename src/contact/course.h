/* course.h -- a motion, state after state: where it first passes through itself, and how deep it ever does.
 * Uses  contact.h sweep.h        Used by  measure.c
 *
 * Between two states the way is not known, only that each facet is rigid; it is taken to be as in sweep.h. How far that
 * may be off is seen from the states: a steady curve through three of them is nowhere farther from its chords than an
 * eighth of the second difference. What is deeper than both ends of that allow is a crossing; what is not, but can't be
 * proved free, is told. */
#ifndef RG_COURSE_H
#define RG_COURSE_H

#include "contact/contact.h"
#include "contact/sweep.h"

typedef struct rg_course_found {
    int32_t states;
    int32_t first;         /* the first state that crosses, or before which facets cross on the way; -1: none */
    int between;           /* non-zero: on the way from the state before */
    double time;           /* how far on that way, 0 ... 1; 1: in the state */
    int32_t facet[2];      /* which; -1: none */
    int32_t crossing;      /* frames in which facets cross */
    int32_t deepest_state; /* of the frames; -1: none */
    rg_contact_hit deepest;
    int32_t pairs;         /* how many cross in the state that is deepest */
    /* of the ways before the first crossing: */
    int32_t ways, unproved; /* looked at; neither proved free nor surely crossing */
    int32_t first_unproved; /* the state at its end, -1: none */
} rg_course_found;

typedef struct rg_course {
    rg_memory mem;
    rg_plates plates;
    rg_contact_work look;
    rg_sweep_work sweep;
    rg_plates_state state[3]; /* the last three, copies; number k is in k % 3 */
    rg_vec2 *X[3];
    rg_place *place[3];
    rg_vec3 *x[3];
    rg_vec3 *worst;      /* [nv] of the state that is deepest */
    rg_contact_hit last; /* a pair of the last state that crosses */
    double bend;         /* the last second difference, file units */
    rg_course_found found;
} rg_course;

/* The mesh is borrowed. RG_ENOMEM: *c is zeroed. */
rg_status rg_course_init(const rg_mesh *m, rg_course *c);
void rg_course_free(rg_course *c);
/* The next state; it is copied. is_frame zero: it lies between frames, and counts for what crosses first alone.
 * RG_ENOMEM. */
rg_status rg_course_add(rg_course *c, const rg_plates_state *s, int is_frame);
/* After the last one; c->found is complete then. RG_ENOMEM. */
rg_status rg_course_end(rg_course *c);
/* Of a course that ended without a crossing: the i-th of the c->sweep.n_before pairs of parts that came near each
 * other. Returns 1: the second facet came to lie before the front of the first, -1: behind its back, 0: beside it. */
int rg_course_side(const rg_course *c, int32_t i, int32_t facet[2]);

#endif
