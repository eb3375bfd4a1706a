/* constraint.h -- all vertices: C (3M x N) and r at given fold angles.
 * Paper    eqs. (6)-(8), (11), (12)        Uses  loop.h turn.h sparse.h mesh.h        Used by  mobility.c project.c */
#ifndef RG_CONSTRAINT_H
#define RG_CONSTRAINT_H

#include "kinematics/loop.h"
#include "linalg/sparse.h"
#include "mesh/mesh.h"

/* Four vertices of as many creases each, walked round together. */
typedef struct rg_four {
    int32_t vertex[4]; /* the last ones of a degree may be the same vertex several times */
    int32_t degree;
    int32_t at;        /* into crease and theta, times four */
} rg_four;

typedef struct rg_constraint {
    rg_memory mem;
    rg_sparse C;    /* eq. (8) */
    double *r;      /* [3M] eq. (12), per vertex in the order b, c, a, which is x, y, z of the axial vector */
    rg_turn *theta; /* per block of C: cosine and sine of the sector angle */
    double *cos, *sin; /* [N] of the fold angles given last */
    unsigned char *still; /* [N] non-zero: this crease does not turn, its column of C is 0; the mesh's, or set by the owner */
    int32_t stills;       /* how many */
    int32_t fours;
    rg_four *four;
    int32_t *crease;                /* by four: crease numbers, [at + i][4] */
    double *theta_cos, *theta_sin;  /* by four: what theta says */
} rg_constraint;

rg_status rg_constraint_init(rg_constraint *K, const rg_memory *mem, const rg_mesh *m);
void rg_constraint_free(rg_constraint *K);

/* still[N] has changed. */
void rg_constraint_set_still(rg_constraint *K);
/* The columns of creases that are still become 0, as assembling makes them. */
void rg_constraint_forget_still(rg_constraint *K);
/* Other sector angles, theta[], radians, in the order of the mesh's loop_theta. */
void rg_constraint_set_theta(rg_constraint *K, const double *theta);

/* Refills C and r for rho[N], radians. Returns the largest rotation angle of F over the vertices, radians (NaN if one
 * is NaN). Allocates nothing. */
double rg_constraint_assemble(rg_constraint *K, const double *rho);
/* The rotation angle of F at vertex k, for the fold angles given last. */
double rg_constraint_angle(const rg_constraint *K, int32_t k);
/* The same angle alone; C and r stay as they are. worst: out, the vertex k it is at, -1: none; may be NULL. */
double rg_constraint_closure(rg_constraint *K, const double *rho, int32_t *worst);

#endif
