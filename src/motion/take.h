/* take.h -- one try at a motion: its frames, as far as it came.
 * Uses  fold.h flow.h        Used by  strategy.c */
#ifndef RG_TAKE_H
#define RG_TAKE_H

#include "fold/flow.h"
#include "fold/fold.h"
#include "motion/motion.h"

typedef struct rg_take {
    rg_memory mem;
    rg_mesh mesh;             /* owned */
    double *target;           /* [mesh.N] what was aimed at, radians; NAN: nothing */
    double *from;             /* [mesh.N] where it began */
    double *rho;              /* [room][mesh.N] frames */
    rg_vec2 *flat;            /* [room][mesh.nv] the pattern of each; NULL: that of the mesh */
    int32_t count;
    rg_outcome outcome;
    char reason[200];
    double score;             /* to compare takes by: how far it came */
    double overfold;          /* the most a crease was beyond half a turn in a frame, radians */
    double to;                /* of the settings */
    int32_t strays;           /* driven creases that are flat or on its wrong side in the last frame of a part of the way that
                               * is not known to go on to the end */
    double moved;             /* the farthest a vertex of the pattern went, over frames, lengths */
    const char *method, *solver;
    rg_flow_law law;          /* of a flow */
    rg_cost cost;
    double work;              /* of a flow, as rg_flow counts it */
    int32_t *vertex, vertices; /* what resists most at the end: vertex numbers, strongest first */
    int32_t *crease, creases;  /* short of their targets, and not let any nearer */
} rg_take;

/* Tells how far it is, 0 ... 1, and asks whether to go on. */
typedef struct rg_watch {
    rg_progress progress; /* NULL: nobody watches */
    void *ctx;
    int cancelled;
} rg_watch;

void rg_take_free(rg_take *t);
/* Straight on along the motion that closes exactly: rg_fold. *m is taken over, also on failure. */
rg_status rg_take_straight(rg_take *t, rg_mesh *m, const rg_settings *s, rg_watch *watch, rg_diag *why);
/* Where that is blocked: rg_flow, from `from` (NULL: flat). G: on a mesh with the same vertices, kept; NULL: none. budget: of its
 * work. */
rg_status rg_take_flow(rg_take *t, rg_mesh *m, const rg_settings *s, const rg_flow_law *law, const double *from,
                       const double *target, const rg_symmetry *G, double budget, rg_watch *watch, rg_diag *why);
/* The frames of a motion that was found some other way and goes from flat to `target`: read(ctx, progress, rho[N], X[nv]) gives the
 * state at a progress 0 ... 1 of it. *m is taken over, also on failure. */
rg_status rg_take_read(rg_take *t, rg_mesh *m, const rg_settings *s, const double *target,
                       void (*read)(void *ctx, double progress, double *rho, rg_vec2 *X), void *ctx, rg_diag *why);
/* A flow from `target` to flat that came there, as the motion from flat to `target` that it is backwards: its frames the other
 * way round. One that did not come there is no such motion: its score is then nothing. */
void rg_take_turn_round(rg_take *t, const double *target);

#endif
