/* fold.h -- the handle behind rigami.h's rg_fold: a track of states, and the one that it stands on.
 * Uses  attempt.h between.h steer.h        Used by  create.c and the files of rg_fold, such as stepping.c; write
 *
 * The track is the motion's frames until somebody steers. Then the states that were passed are kept in a list of its
 * own, whose last leg grows step by step. Motions never change, so clones and snapshots share one. */
#ifndef RG_FOLD_H
#define RG_FOLD_H

#include "motion/attempt.h"
#include "motion/between.h"

#include <pthread.h>
#include <stdatomic.h>

typedef struct rg_shared {
    rg_motion *motion; /* owned by the last who lets go */
    rg_attempt path;   /* what it was read off; due NULL: no path that can be read again */
    pthread_mutex_t reading; /* reading works within the path */
    atomic_int holders;
} rg_shared;

typedef struct rg_track {
    int32_t count, room;
    double *rho;      /* [room][N] */
    rg_vec2 *flat;    /* [room][nv] */
    double *progress; /* [room] within its leg, 0 ... 1 */
    double *closure;  /* [room] */
} rg_track;

/* All states of one, of which there is at least one, to another that has room for them. */
void rg_track_copy(rg_track *to, const rg_track *from, const rg_mesh *m);

/* How the last leg of a track ended. */
typedef struct rg_ending {
    rg_outcome outcome; /* RG_RUNNING: there is more to come */
    const char *reason;
    int32_t *vertex, *crease, vertices, creases; /* [M] [N] what holds it */
} rg_ending;

struct rg_fold {
    rg_memory mem;
    rg_settings settings;
    rg_shared *shared;
    int steered;        /* zero: the track is the motion's */
    rg_track track;
    rg_ending ending;
    int32_t first;      /* state that the last leg begins with */
    int32_t at;         /* the last state that it has passed */
    int between;        /* non-zero: it is beyond that one, before the next */
    rg_steer *steer;    /* NULL: nobody has steered */
    int aimed;          /* non-zero: roles have changed, a leg begins with the next step */
    rg_between *way[2]; /* on one pattern, with the pattern; NULL: not made yet */
    double *rho;        /* [N] the present state */
    rg_vec2 *flat;      /* [nv] its pattern */
    rg_place *place;    /* [nf] */
    rg_vec3 *x;         /* [nv] */
    double *theta;      /* [corners] scratch */
    double *read;       /* [relax.n] what was read off the path; NULL: nothing yet */
    double *guess;      /* [N] scratch; NULL: none yet */
    double closure, progress;
    int64_t solves, iterations; /* of the engines, before the present call */
    rg_step_info info;
};

/* The last holder's going destroys the motion. NULL is fine. */
void rg_shared_let_go(const rg_memory *mem, rg_shared *s);
const rg_mesh *rg_fold_mesh(const rg_fold *f);
/* State k of the track. */
int32_t rg_fold_states(const rg_fold *f);
const double *rg_fold_state(const rg_fold *f, int32_t k);
const rg_vec2 *rg_fold_pattern(const rg_fold *f, int32_t k);
/* A handle on a motion, which it takes over, or shares with others; at its first frame. RG_ENOMEM. */
rg_status rg_fold_on(rg_shared *shared, const rg_memory *mem, const rg_settings *s, rg_fold **fold);
/* What is in f->rho and f->flat becomes the present state. */
const rg_step_info *rg_fold_look(rg_fold *f);
/* State k of the track becomes the present one; its progress. */
const rg_step_info *rg_fold_stand(rg_fold *f, int32_t k);
double rg_fold_progress(const rg_fold *f, int32_t k);
/* rho[N], X[nv]: out, the state at that part of the way from state k of the track to the next. *closes zero: none was
 * found. RG_ENOMEM. */
rg_status rg_fold_read_between(rg_fold *f, int32_t k, double part, double *rho, rg_vec2 *X, int *closes);
/* Is there more to come of the last leg? Then one state more of it, at the end of the track. */
int rg_fold_has_more(const rg_fold *f);
void rg_fold_advance(rg_fold *f);
/* Room for a track of so many states and a leg after them, which is a list of its own from now on. RG_ENOMEM. */
rg_status rg_fold_own_track(rg_fold *f, int32_t states);
/* The engine to steer by, with roles as below. RG_ENOMEM. */
rg_status rg_fold_make_steer(rg_fold *f);
/* Nobody has set anything: creases aim at what the motion aimed at. */
void rg_fold_aim_as_found(rg_fold *f);

/* As rg_motion_create. path: out, what can be read off again, its mesh that of the motion, to be freed before it; NULL:
 * not asked for. */
rg_status rg_motion_with_path(const rg_pattern *p, const rg_settings *s, rg_progress progress, void *ctx,
                              rg_motion **motion, rg_attempt *path, rg_diag *why);
/* Flat paper and nothing else, to be steered: facets as drawn, or all cut. */
rg_status rg_motion_unfolded(const rg_pattern *p, const rg_settings *s, rg_motion **motion, rg_diag *why);

#endif
