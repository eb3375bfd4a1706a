/* flow.h -- folding where the straight way is blocked: fold angles and pattern give way together.
 * Paper    eqs. (14), (19) as one system; section 3.3; both penalties of section 4
 * Uses  joint.h adjust.h limit.h        Used by  motion
 *
 * Each step wishes drho0 by mountain and valley and dX0 by the closed vertices, back to the pattern given otherwise, and
 * takes the nearest step that the joint system allows, in a metric that says how readily what gives way:
 *   - the pattern by `give`: moving a vertex by the shortest line at it counts as much as 1/give radian of a crease;
 *   - a crease on the wrong side of flat stands by its wish, so that the others have to give way;
 *   - a crease at half a turn stays there, unless the step takes it back by itself.
 * Steps are accepted by what they do to closure, facets and limits, else shortened. Which creases lose the contest at the
 * flat start, where all branches meet, shows soon after it: then the run starts again with those asked for more loudly. */
#ifndef RG_FLOW_H
#define RG_FLOW_H

#include "fold/adjust.h"
#include "fold/limit.h"
#include "kinematics/joint.h"

typedef struct rg_flow_law {
    double gain;      /* of adjust.h; 0: closed vertices wish nothing */
    double give;      /* of the pattern; 0: only as gain asks, eq. (19) to the letter */
    int kawasaki;     /* eq. (16) kept at every flat-foldable vertex on the way */
    int together;     /* creases are paced so that all arrive at once; zero: each at its own constant rate */
    double stubborn;  /* how readily a crease on the wrong side gives way: 1 as any other, less is less */
    int32_t attempts; /* starts with louder creases */
} rg_flow_law;

typedef struct rg_flow {
    rg_memory mem;
    const rg_mesh *mesh;      /* borrowed */
    rg_flow_law law;
    double step, tol, s_end;
    int32_t N, U;
    rg_freedom freedom;
    rg_joint J;
    rg_adjust adjust;
    rg_limit limit;
    const rg_symmetry *symmetry; /* borrowed, on mesh; set after init: kept in every step; NULL: none */
    rg_vec2 *spare;           /* [nv] scratch */
    double *from, *target;    /* [N] radians; equal: the crease stays where it is; target NAN: wishes nothing */
    double *end;              /* [N] target where there is one, closed on the pattern given if that is possible */
    int32_t driven;
    int from_flat;
    double *rho, *u, s;       /* the state: closed, [N] [U], progress */
    double *old_rho, *old_u, old_s; /* the state before it, or the start while no state is proper */
    int proper;               /* the start is left behind, and the limits are kept */
    double *trial, *trial_u;
    double *wish, *z, *scale, *dz; /* [N + U] */
    double *loud, *pull;      /* [N] */
    unsigned char *held;      /* [N] at its limit in this step */
    double h;                 /* part of the largest step that is taken now */
    int end_is_closed, landed;
    int32_t attempt, steps, idle;
    double best_s, best_least; /* what idle steps failed to better */
    int64_t assemblies;
    double work, budget;      /* of factorisations, about seconds of a slow machine */
    double closure;
    rg_outcome outcome;
    char reason[240];
} rg_flow;

/* from[N] NULL: flat. target[N]: NAN: none. Both are copied; `from` closes. RG_ENOMEM.
 * Owner: the caller, rg_flow_free. */
rg_status rg_flow_init(rg_flow *F, const rg_mesh *m, const rg_settings *s, const rg_flow_law *law, const double *from,
                       const double *target);
void rg_flow_free(rg_flow *F);
/* One step, of which F->s tells the progress; F->attempt has grown when it began again. Allocates nothing. */
void rg_flow_step(rg_flow *F);
/* The closed state at progress s, between the one before the last step and the present one: F->trial, F->trial_u.
 * Zero: none was found. */
int rg_flow_at(rg_flow *F, double s);

/* What a full step from the state wishes for, F->wish, and is let, F->dz; F->J.A.y: how hard each row resists. */
void rg_flow_wish_and_step(rg_flow *F);

#endif
