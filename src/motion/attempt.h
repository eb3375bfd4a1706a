/* attempt.h -- one try at a motion: the path as far as it came, and frames read off it.
 * Uses  trace.h relax.h gaps.h        Used by  the other files of this room; chart
 *
 * A path knows nothing of frames. It is found once, as states of rising progress; frames are read off it, as many and
 * where they are asked for (frames.c). */
#ifndef RG_ATTEMPT_H
#define RG_ATTEMPT_H

#include "fold/trace.h"
#include "fold/relax.h"
#include "motion/gaps.h"
#include "motion/motion.h"
#include "motion/watch.h"

typedef struct rg_attempt {
    rg_memory mem;
    rg_mesh mesh;             /* owned */
    double *target;           /* [mesh.N] what was aimed at, radians; NAN: nothing */
    double *from;             /* [mesh.N] where it began */
    rg_relax *relax;          /* owned; NULL: straight on */
    double *largest;          /* [mesh.N] of what went straight on: the most that each turned at a node; else NULL */
    rg_trace *trace;          /* owned: the path of what went straight on; NULL: it was not kept */
    rg_symmetry *symmetry;    /* owned: what the relaxation keeps; NULL: none */
    int backwards;            /* found from its end: its path runs the other way round */
    int is_from_flat;
    double to;                /* of the settings */
    double *rho;              /* [count][mesh.N] frames; NULL: not read off yet */
    rg_vec2 *flat;            /* [count][mesh.nv] the pattern of each; NULL: that of the mesh */
    int32_t count;
    rg_gaps gaps;             /* what lies between them */
    double *due;              /* [count] progress of the path at each of them; NULL: they cannot be read off again */
    int is_read;              /* its frames were read off as they were found, evenly as is due, and cannot be again */
    rg_outcome outcome;
    char reason[200];
    double score;             /* to compare attempts by: how far it came, 0 ... 1 */
    double overfold;          /* the most that a crease was beyond half a turn, radians */
    double moved;             /* the farthest that a vertex of the pattern went, lengths */
    double moved_at_end;
    int32_t strays;           /* driven creases flat or on their wrong side at the end of a part of the way which is not
                               * known to go on to the end */
    const char *method, *solver;
    rg_cost cost;
    double work;              /* of a relaxation, as rg_relax counts it */
    int32_t *vertex, vertices; /* what resists most at the end: vertex numbers, strongest first */
    int32_t *crease, creases;  /* short of their targets, and not let any nearer */
} rg_attempt;

/* A relaxation to try. */
typedef struct rg_relaxed_try {
    rg_relaxation how;
    const double *from;      /* [mesh.N] radians; NULL: flat */
    const double *target;    /* [mesh.N] radians; NAN: none */
    const rg_symmetry *keeps; /* on a mesh with the same vertices; NULL: none */
    int backwards;           /* the same motion, looked for from its end */
    double budget;           /* of its work */
} rg_relaxed_try;

void rg_attempt_free(rg_attempt *t);
/* Straight on along the motion that closes exactly, on the pattern given. most_steps 0: as many as it takes. keeps: its
 * path can be read again. *m is taken over, also on failure. */
rg_status rg_attempt_straight(rg_attempt *t, rg_mesh *m, const rg_settings *s, int32_t most_steps, int keeps,
                              rg_watch *watch, rg_diag *why);
/* Relaxed. *m is taken over, also on failure. */
rg_status rg_attempt_relaxed(rg_attempt *t, rg_mesh *m, const rg_settings *s, const rg_relaxed_try *how,
                             rg_watch *watch, rg_diag *why);
/* One whose relaxation waits runs on, for so much more work. */
rg_status rg_attempt_go_on(rg_attempt *t, double work, rg_watch *watch, rg_diag *why);
/* A path that was found some other way, from flat to `target`: read(ctx, progress, rho[N], X[nv]) gives its state at a
 * progress 0 ... 1, always. Its frames are read off at once. *m is taken over, also on failure. RG_ENOMEM. */
rg_status rg_attempt_from_path(rg_attempt *t, rg_mesh *m, const rg_settings *s, const double *target,
                               rg_path_reader *read, void *ctx, rg_diag *why);
/* In frames.c: frames by settings->frames, to and pace; where the path stopped short, those that it reached and the
 * last state. RG_ENOMEM. */
rg_status rg_attempt_read(rg_attempt *t, const rg_settings *s);
/* The same off any path, as rg_attempt_from_path has it. RG_ENOMEM. */
rg_status rg_attempt_read_path(rg_attempt *t, const rg_settings *s, rg_path_reader *read, void *ctx);
/* Of what goes straight on, as they are found: f, made with `parts` times as many frames, runs to its end, and what
 * lies between them is kept, too. trace: out; may be NULL. */
rg_status rg_attempt_run(rg_attempt *t, rg_straight *f, int32_t parts, rg_trace *trace, rg_watch *watch);
/* Frames that can be read off again are let go. */
void rg_attempt_forget_frames(rg_attempt *t);
/* Fold angles and pattern of frame k. */
const double *rg_attempt_angles(const rg_attempt *t, int32_t k);
const rg_vec2 *rg_attempt_pattern(const rg_attempt *t, int32_t k);
/* The states that the path is made of: nodes of a relaxation, frames of what went straight on. */
int32_t rg_attempt_states(const rg_attempt *t);
const double *rg_attempt_state(const rg_attempt *t, int32_t k);

/* The most that crease i turned on the whole path, radians. */
double rg_attempt_largest_angle(const rg_attempt *t, int32_t i);

#endif
