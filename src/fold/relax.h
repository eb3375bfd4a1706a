/* relax.h -- the relaxed stepper: folding where fold angles alone cannot go, the creases roll through the sheet as well.
 * Paper    eqs. (14), (19) as one system; section 3.3; both penalties of section 4
 * Uses  orbits.h adjust.h limit.h        Used by  attempt.c diagnose.c
 *
 * Unknowns z = (rho, u): fold angles, and the ways in which the vertices of the pattern may move. Every step projects a wish,
 *
 *     dz = dz0 - W A^T (A W A^T)^+ (A dz0 + r),      W = diag(1 for a crease, (w l_v)^2 for a way of vertex v),
 *
 * l_v^2 the shortest crease at v squared, times what is left of what the facets round v may shrink; w the vertex compliance. Creases at
 * half a turn are held there, and where the projected wish would lose progress, progress is one more row of A. A step is taken when it
 * closes, stays on the branch that it came from and keeps the facets; else it is shortened.
 *
 * What was found is a path: nodes, each closed, by rising progress. Between two nodes the path is what closes the points of
 * their chord, so it depends on nothing but them. */
#ifndef RG_RELAX_H
#define RG_RELAX_H

#include "fold/adjust.h"
#include "fold/limit.h"
#include "kinematics/orbits.h"

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
    rg_coupled J;
    rg_adjust adjust;
    rg_limit limit;
    const rg_symmetry *symmetry; /* borrowed, on mesh: kept in every step; NULL: none */
    rg_orbits orbits;         /* of it, where the drawing is even to rounding: */
    int by_orbits;            /* then steps and closing are solved for one of each orbit */
    rg_vec2 *spare;           /* [nv] scratch */
    double *from, *target;    /* [N] radians; equal: the crease stays where it is; target NAN: wishes nothing */
    double *slope;            /* [N] of progress: 1 / (driven way), 0 for creases that are not driven */
    double *end;              /* [N] target where there is one, closed on the pattern given if that is possible */
    int32_t driven;
    int from_is_singular, end_is_closed, landed;
    double *z, s;             /* [n] the state, closed; its progress */
    int32_t nodes;
    double *node, *node_s;    /* [nodes][n]; the path, by rising progress */
    double *trial, *wish, *dz, *scale, *chord; /* [n] */
    double *g, *t;            /* [n] scaled: the slope of progress; what the constraint leaves over of it */
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

/* m's arrays are borrowed. from[N] NULL: flat. target[N]: NAN: none. Both are copied; `from` closes. RG_ENOMEM. Owner: the caller,
 * rg_relax_free. *F must stay where it is. */
rg_status rg_relax_init(rg_relax *F, const rg_mesh *m, const rg_settings *s, const rg_relaxation *how, const double *from,
                        const double *target);
/* Every step is to have the symmetry G, borrowed, on the mesh; before the first one. RG_ENOMEM. */
rg_status rg_relax_keep(rg_relax *F, const rg_symmetry *G);
void rg_relax_free(rg_relax *F);
/* One step, of which F->s tells the progress. Allocates nothing. */
void rg_relax_step(rg_relax *F);
/* One that waits runs on, for so much more work. */
void rg_relax_go_on(rg_relax *F, double work);
/* z[n]: out, the state of the path at progress s, within the nodes there are. Depends on the nodes on either side alone.
 * Returns its closure, radians; NAN: none was found. Allocates nothing. */
double rg_relax_at(rg_relax *F, double s, double *z);
/* What a full step from the state wishes for, F->wish, and is let, F->dz; F->J.A.y: how hard each row resists. */
void rg_relax_wish_and_step(rg_relax *F);
/* rho[N] closed on the pattern given: a drawing's rounding is made up for by the creases, a little. Zero: it is off by
 * more than that, and rho is left as it is. */
int rg_relax_close_on_pattern(rg_relax *F, double *rho);

#endif
