/* sweep.h -- whether facets would meet between two states.
 * Uses  plates.h front.h near.h        Used by  motion
 *
 * Between two states the second facet of a pair, the one of the greater number, moves, as the first one sees it, like this: it turns steadily about one axis,
 * and one point of it, their common corner or else its middle, goes straight. So both are rigid all the time, stacks that
 * swing as a whole do not move against each other, and which facet of the sheet is held fixed does not matter. (Where the
 * pattern of the two states differs, corners go straight in the plane of their facet.)
 *
 * What is decided is conservative, after the advancement of Mirtich (1996), but of second order: along an axis u that parts two
 * plates by s, a corner with velocity v leaves at least s + (u . v) h - c h^2 / 2 after a time h, where c bounds what the
 * turning adds. Layers that lie close and move together are so passed in one step or two. */
#ifndef RG_SWEEP_H
#define RG_SWEEP_H

#include "contact/front.h"
#include "contact/plates.h"

typedef enum rg_sweep_verdict {
    RG_SWEEP_FREE,    /* proved: nothing crosses between the states */
    RG_SWEEP_CONTACT, /* at `time` a pair comes as near as the rule allows */
    RG_SWEEP_GAVE_UP  /* neither: a leap, or more advancements than are made; nothing was found up to `time` */
} rg_sweep_verdict;

/* What may not happen. Pairs that have a corner in common touch there, so for them only depth counts. */
typedef struct rg_sweep_rule {
    double depth; /* a pair may cross up to this part of the sheet's size, above 0; RG_CONTACT_TOLERANCE */
    double keep;  /* 0: as above; else pairs without a common corner keep this part, below 1, of the distance they begin with */
    /* Non-zero: this pair of facets is not looked at, as something else sees to it. May be NULL. */
    int (*skip)(void *ctx, int32_t f, int32_t g);
    void *ctx;
} rg_sweep_rule;

typedef struct rg_sweep_found {
    rg_sweep_verdict verdict;
    double time;         /* 0 ... 1: up to there nothing happens */
    int32_t facet[2];    /* of the first contact, or the pair that was given up, the smaller number first; -1: free */
    rg_vec3 axis;        /* unit, as the state begins: from the second facet to the first, what parts them least badly */
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

typedef struct rg_sweep_work {
    rg_memory mem;
    rg_sweep_ball *ball; /* [nodes] */
    rg_place *back;      /* [nf] from the second state back to the first */
    rg_front_work front;
} rg_sweep_work;

/* RG_ENOMEM: *w is zeroed. */
rg_status rg_sweep_work_init(const rg_plates *p, rg_sweep_work *w);
void rg_sweep_work_free(rg_sweep_work *w);

/* Looks at all pairs of facets between two states, and says which comes first. Hinges are passed through where a crease goes
 * through half a turn. Allocates nothing. */
rg_sweep_found rg_sweep_step(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, const rg_sweep_rule *rule,
                             rg_sweep_work *w);

#endif
