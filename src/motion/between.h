/* between.h -- a state between two of a track: on their chord, closed, with one crease where it is asked for.
 * Paper    eqs. (14), (19) as one system        Uses  steer.h coupled.h motion.h        Used by  fold.h, write
 *
 * Where both have the pattern given, fold angles close it; else the pattern moves as well, as in fold/relax.h. */
#ifndef RG_BETWEEN_H
#define RG_BETWEEN_H

#include "fold/steer.h"
#include "kinematics/coupled.h"
#include "motion/motion.h"

typedef struct rg_between {
    rg_memory mem;
    rg_mesh mesh;        /* its arrays are borrowed */
    double tol;
    int moves;           /* non-zero: patterns move, by: */
    rg_freedom freedom;
    rg_constraint K;
    rg_coupled J;
    double *scale, *dz;  /* [n] */
    rg_steer steer;      /* or do not */
    double *z;           /* [n] the state: fold angles, then ways of the pattern */
    rg_vec2 *flat;       /* [nv] its pattern */
    double *theta;       /* [corners] scratch */
} rg_between;

/* Owner: the caller, rg_between_free, also after a failure. RG_ENOMEM, RG_EABSENT. */
rg_status rg_between_init(rg_between *B, const rg_memory *mem, const rg_mesh *m, int moves, const rg_settings *s);
void rg_between_free(rg_between *B);
/* Part of the way from a state to another, crease c at `angle`: in B->z, B->flat. Returns its closure; NAN: it does not
 * close. Allocates nothing. */
double rg_between_at(rg_between *B, const rg_motion_state *from, const rg_motion_state *to, double part, int32_t c,
                     double angle);

#endif
