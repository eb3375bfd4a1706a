/* sweep.h -- whether facets would meet between two states.
 * Uses  plates.h front.h        Used by  course.c
 *
 * Between two states the second facet of a pair, the one of the greater number, moves, as the first one sees it, on a
 * screw: it turns steadily about one axis and goes along it. So both are rigid all the time, stacks that swing as a
 * whole do not move against each other, which facet is held fixed does not matter, and what turns about one line, as a
 * simple fold does, turns about that line. Facets with a common corner turn about it, and where the pattern of the two
 * states differs, it and all others go straight in the plane of their facet.
 *
 * What is decided is conservative, after the advancement of Mirtich (1996), but of second order: along an axis u that
 * parts two plates by s, a corner with velocity v leaves at least s + (u . v) h - c h^2 / 2 after a time h, where c
 * bounds what the turning adds. Layers that lie close and move together are so passed in one step or two. */
#ifndef RG_SWEEP_H
#define RG_SWEEP_H

#include "contact/front.h"
#include "contact/plates.h"

typedef enum rg_sweep_verdict {
    RG_SWEEP_FREE,    /* proved: nothing crosses between the states */
    RG_SWEEP_CONTACT, /* at `time` a pair is as deep as is allowed */
    RG_SWEEP_GAVE_UP  /* neither: a leap, or more advancements than are made; nothing was found up to `time` */
} rg_sweep_verdict;

typedef struct rg_sweep_found {
    rg_sweep_verdict verdict;
    double time;         /* 0 ... 1: up to there nothing happens */
    int32_t facet[2];    /* of the first contact, or the pair that was given up, the smaller number first; -1: free */
    /* unit, as the state begins: from the second facet to the first, what parts them least badly */
    rg_vec3 axis;
    int in_front;        /* non-zero: proved at once for all pairs, by front.h */
    int32_t pairs, advancements; /* looked at, made */
} rg_sweep_found;

/* What is below a node of the tree, in both states: parts whose middles are in two balls. */
typedef struct rg_sweep_ball {
    rg_vec3 middle[2];
    double radius[2];
    double arm;    /* the farthest corner of a part from its middle */
    double spread; /* its facets turn by as much more, or otherwise, than the first of them */
    int32_t facet; /* that first one */
} rg_sweep_ball;

/* The second part of a pair, by the greater number, is apart from the first along this axis, unit, as the first part's
 * facet sees it: its front looks along z. */
typedef struct rg_sweep_side { int32_t part[2]; rg_vec3 axis; } rg_sweep_side;

typedef struct rg_sweep_work {
    rg_memory mem;
    rg_sweep_ball *ball; /* [nodes] */
    rg_place *back;      /* [nf] from the second state back to the first */
    rg_front_work front;
    rg_sweep_side *before, *now; /* [n_before] as the step begins, by part; [n_now] as it ends */
    size_t room_before, room_now;
    int32_t n_before, n_now;
} rg_sweep_work;

/* RG_ENOMEM: *w is zeroed. */
rg_status rg_sweep_work_init(const rg_plates *p, rg_sweep_work *w);
void rg_sweep_work_free(rg_sweep_work *w);

/* Looks at all pairs of facets between two states, and says which first comes to cross deeper than `depth`, above 0, of
 * the sheet's size. Hinges are passed through where a crease goes through half a turn, and layers that lie on each
 * other where one comes from above to below: each pair keeps the side on which it was in w->before, or goes round from
 * it. Where it is now, and known, is kept in w->now. RG_ENOMEM. */
rg_status rg_sweep_step(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, double depth,
                        rg_sweep_work *w,
                        rg_sweep_found *found);
/* Of what is kept now, only pairs that were on such a side before: what a rule that allows much lets be known is not
 * sure. */
void rg_sweep_forget_new(rg_sweep_work *w);
/* What is kept now is what the next step begins with. */
void rg_sweep_go_on(rg_sweep_work *w);

#endif
