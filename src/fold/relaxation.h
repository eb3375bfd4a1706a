/* relaxation.h -- one relaxation on its way: what it may do, its state, its path, what it works on.
 * Paper    eqs. (14), (19), section 4
 * Uses  coupled.h adjust.h limit.h        Used by  closing.c chord.c relax.c */
#ifndef RG_RELAXATION_H
#define RG_RELAXATION_H

#include "fold/adjust.h"
#include "fold/limit.h"
#include "kinematics/coupled.h"

/* How readily what gives way. */
typedef struct rg_relaxation {
    double compliance; /* w; 0: the pattern moves only as gain asks, eq. (19) to the letter */
    double gain;       /* of adjust.h; 0: closed vertices wish nothing */
    int kawasaki;      /* non-zero: eq. (16) is kept at every flat-foldable vertex on the way */
    double farthest;   /* it ends where a vertex of the pattern goes farther, a length; 0: however far */
} rg_relaxation;

typedef struct rg_relax {
    rg_memory mem;
    rg_mesh mesh;             /* its arrays are borrowed */
    rg_relaxation how;
    double step, tol, s_end;  /* radians, radians, 0 ... 1 */
    int32_t N, U, n;          /* creases, ways of vertices, N + U */
    rg_freedom freedom;
    rg_constraint K;
    rg_coupled J;             /* steps and closing */
    rg_adjust adjust;
    rg_limit limit;
    const rg_symmetry *symmetry; /* borrowed, on mesh: kept in every step; NULL: none */
    rg_coupled orbits;        /* of it, where the drawing is even to rounding: */
    int by_orbits;            /* then steps and closing are solved for one of each orbit */
    rg_vec2 *spare;           /* [nv] scratch */
    double *from, *target;    /* [N] radians; equal: the crease stays where it is; target NAN: wishes nothing */
    double *slope;            /* [N] of progress: 1 / (driven way), 0 for creases that are not driven */
    double *end;              /* [N] target where there is one, closed on the pattern given if that is possible */
    int32_t driven;
    int from_is_singular, end_is_closed, landed;
    /* the step from which it is seen whether the branch leads to the start, then to the end; steps till then */
    int32_t look_after, look_pause;
    double *z, s;             /* [n] the state, closed; its progress */
    int32_t nodes;
    double *node, *node_s;    /* [nodes][n]; the path, by rising progress */
    double *trial, *wish, *dz, *scale, *chord; /* [n] */
    double *g, *t, left;      /* [n] scaled: the slope of progress; what the constraint leaves over of it; g . t */
    double *pull;             /* [N] */
    unsigned char *held;      /* [N] at its limit in this step */
    double h;                 /* part of the largest step that is taken now */
    double share;             /* of the usual length that a step has, at most 1: counts of steps are of usual ones */
    int32_t steps, idle, room; /* room: for nodes */
    double best_s, best_least; /* what idle steps failed to better */
    int64_t assemblies;
    double work, budget;      /* of factorisations, about seconds of a slow machine; 0: no budget */
    int foresees;             /* ends as soon as the budget cannot do */
    int waits;                /* ended so, or for being slow: may go on with foresees zero, rg_relax_go_on */
    double damping;           /* of corrections, against what is open; 0 but where states between nodes are closed */
    double closure;           /* of trial */
    rg_outcome outcome;
    char reason[240];
} rg_relax;

#endif
