/* stride.h -- one step of a motion in which no two facets pass through each other.
 * Paper    eqs. (10), (14), (15), (19); what section 4 leaves as future work
 * Uses  crossed.h proximity.h nearest.h sides.h end.h        Used by  home.c landing.c open.c passage.c track.c
 *
 * Each step wishes every crease on towards its target, and takes the nearest step that keeps the sheet closed and every
 * near pair apart: a velocity damper (Faverjon and Tournassoud, 1987) lets a pair close in by a part of its distance
 * only. Below a floor dm nothing comes nearer at all, and what is below is pushed up softly. The floor is what makes it
 * go: with none, steps shrink with the distances. It is lowered where the motion stalls, an interior point's homotopy
 * in the thickness of paper. A step is taken if it closes, and if conservative advancement meets nothing on the way;
 * else it is halved. */
#ifndef RG_STRIDE_H
#define RG_STRIDE_H

#include "unfold/crossed.h"
#include "unfold/end.h"
#include "unfold/proximity.h"
#include "unfold/nearest.h"
#include "unfold/sides.h"

typedef enum rg_stride_state {
    RG_STRIDE_GOES,
    RG_STRIDE_ARRIVED,
    RG_STRIDE_STUCK,   /* with the lowest floor */
    RG_STRIDE_NO_STEP, /* of all halves of a step none is one that paper can make */
    RG_STRIDE_SPENT
} rg_stride_state;

/* A part that is farther on its wrong side (lengths of the sheet), in a state that does not cross, has gone round. */
#define RG_STRIDE_NOT_THERE 1e-4
/* What rounding and closing may put a crease past half a turn, radians. */
#define RG_STRIDE_OVER 1e-4

typedef struct rg_stride {
    rg_memory mem;
    rg_linkage *P;           /* borrowed */
    rg_proximity near;
    rg_nearest q;
    rg_crossed *crossed;     /* borrowed */
    const rg_end *end;       /* borrowed; NULL: the motion does not come from a flat end */
    const rg_sides *sides;   /* of it */
    const double *target;   /* borrowed [N] radians, all 0: unfolding; NAN: none */
    double *z, *z1, *wish;  /* [n] */
    rg_vec3 *p1;            /* [nv] */
    double *middle;         /* [n] scratch */
    unsigned char *pushed;  /* [N + rows of the end] in the last step */
    double h, dm, pace;     /* part of the largest step; floor; part of the wish that rows let through lately */
    double *merit, *went;   /* [RG_STRIDE_MOST + 1] how far it was after each step, as judge measures and in the mean */
    int32_t steps, since;   /* taken; the step at which the floor was lowered last */
    double turn;            /* the most that a crease turns in the step found last */
    double mean, least;     /* progress: mean over driven creases, and of the last of them */
    double budget;          /* the most of rg_nearest_work(&q) */
    rg_stride_state state;
} rg_stride;

enum { RG_STRIDE_MOST = 1500 };

/* From z[n], closed. RG_ENOMEM. Owner: the caller, rg_stride_free, also after a failure. */
rg_status rg_stride_init(rg_stride *s, const rg_memory *mem, rg_linkage *P, rg_crossed *crossed, const rg_end *end,
                         const double *z, const double *target);
void rg_stride_free(rg_stride *s);
/* One step taken: s->z; or s->state says why not. */
rg_status rg_stride_take(rg_stride *s);

/* One step that is wished to be s->wish, none nearer than the floor; *gone: out, zero: no part of it can be gone. */
rg_status rg_stride_towards(rg_stride *s, double floor, int *gone);

/* row: what facet f's area changes by, as a part of what it was, where P is put. */
void rg_stride_area(const rg_linkage *P, int32_t f, rg_row *row);
/* W^1/2 of the unknowns: 1 for drawn creases, more for added ones, `give` times the reach of a way of the pattern. */
void rg_stride_scale(const rg_linkage *P, double give, double *scale);
/* Creases of z[N] that are locked at half a turn turn less readily: closing knows of no bounds. */
void rg_stride_hold(const rg_linkage *P, const double *z, double *scale);
/* One step of Newton's method that closes z, which is off by `angle`; damped, as where equations all but depend on each
 * other, such as near flat, full steps overshoot. */
void rg_stride_newton(rg_linkage *P, rg_nearest *q, double *z, double angle);
/* So many of them at most: z is closed to `tol` or, returning zero, as near as it came. */
int rg_stride_close(rg_linkage *P, rg_nearest *q, double *z, double tol, int32_t most);

#endif
