/* states.h -- from one folded state to the next: the ways between them, each an attempt or two.
 * Paper    section 4, Fig. 9        Uses  search.h overlay.h        Used by  assemble.c
 *
 * A way is first looked for directly: a relaxed path from the fold angles of one state to those of the next, on a mesh
 * that has the creases of both, forwards or, where the next state is known exactly, backwards from it. Where that is
 * blocked, as the paper says of sinks, the first state is unfolded to flat, as it would fold but backwards, and the
 * next one folded. */
#ifndef RG_STATES_H
#define RG_STATES_H

#include "motion/overlay.h"
#include "motion/search.h"

/* An attempt as part of the whole: its frames after the first, or, with the roles of first and last exchanged,
 * backwards. */
typedef struct rg_stretch {
    rg_attempt attempt;
    double compliance, gain;
    int backwards;
    int end_only;      /* of its frames only the end is kept; negative: none */
    double begin, end; /* of the whole way, in ways from state to state */
    int32_t reaches;   /* the state that its end is, from 0; -1: none */
} rg_stretch;

typedef struct rg_states {
    rg_memory mem;
    rg_settings settings;
    int32_t count;
    double asked;         /* rg_reading.merge of the first */
    double merge;         /* of lines of several files, as in rg_lines */
    double tol;           /* within which one point of two meshes is one, file units */
    rg_mesh *state;       /* [count] each state's own */
    rg_stretch *stretch;  /* [2 count] the first is the first state itself */
    int32_t stretches;
    int32_t *by_flat, by_flat_count; /* [count] as in rg_report */
    rg_cost cost;
    int32_t tries;
    rg_outcome outcome;
    char reason[240];
    rg_progress progress;
    void *ctx;
} rg_states;

/* Frames of a stretch that are kept, and which frame of its attempt the k-th of them is. */
int32_t rg_stretch_frames(const rg_stretch *s);
int32_t rg_stretch_frame(const rg_stretch *s, int32_t k);

/* Walks as far as it can. Owner: the caller, rg_states_free, also after a failure. */
rg_status rg_states_run(rg_states *q, const rg_pattern *const *pattern, int32_t count, const rg_settings *s,
                        rg_progress progress, void *ctx, rg_diag *why);
void rg_states_free(rg_states *q);

#endif
