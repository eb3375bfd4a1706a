/* constraint.h -- all vertices: C (3M x N) and r at given fold angles, and how r changes where the pattern may give
 * way.
 * Paper    eqs. (6)-(8), (11), (12); (16)-(18)        Uses  loop.h turn.h sparse.h freedom.h kawasaki.h
 * Used by  mobility.c project.c tangent.c coupled.c
 *
 * F depends on the sector angles theta as it does on rho: dF/dtheta_i = [A_(i+1) e_z]x F, the normal of that facet,
 * seen from the first. So what rho cannot close, X can:
 *
 *     [ C  D ] [drho]      [r ]        D = dr/dX          eqs. (11), (17)
 *     [ 0  G ] [ dX ] = -  [r']        G = dG/dX          eqs. (17), (18) */
#ifndef RG_CONSTRAINT_H
#define RG_CONSTRAINT_H

#include "kinematics/freedom.h"
#include "kinematics/loop.h"
#include "linalg/sparse.h"

/* Four vertices of as many creases each, walked round together. */
typedef struct rg_four {
    int32_t vertex[4]; /* the last ones of a degree may be the same vertex several times */
    int32_t degree;
    int32_t at;        /* into crease and theta, times four */
} rg_four;

/* Some vertices in fours, by their degree. */
typedef struct rg_fours {
    int32_t count;
    rg_four *four;                 /* [count] */
    int32_t *crease;               /* by four: crease numbers, [at + i][4] */
    double *theta_cos, *theta_sin; /* by four: what theta says */
} rg_fours;

typedef struct rg_constraint {
    rg_memory mem;
    rg_sparse C;    /* eq. (8) */
    double *r;      /* [3M + kept] eq. (12): per vertex b, c, a, the x, y, z of the axial vector; then r', eq. (19) */
    rg_turn *theta; /* per block of C: cosine and sine of the sector angle */
    double *cos, *sin; /* [N] of the fold angles given last */
    unsigned char *still; /* [N] non-zero: the crease does not turn, its column of C is 0; may be set by the owner */
    int32_t stills;       /* how many */
    rg_fours all;
    /* Where the pattern may give way; else 0 and NULL: */
    const rg_mesh *mesh;          /* borrowed */
    const rg_freedom *freedom;    /* borrowed */
    rg_vec2 *X;                   /* [nv] the pattern as it is moved */
    int32_t kept;                 /* vertices kept flat-foldable */
    int32_t *kawasaki;            /* [M] their entries of r, -1: not kept */
    int32_t *far;                 /* per block of C: the vertex at the other end of that crease */
    rg_vec2 *turning;             /* per block: by how much its direction turns with dX of that end */
    rg_vec3 *normal;              /* per block: change of r by the sector angle behind it */
    double *sector;               /* per block: that angle, where it is asked for */
} rg_constraint;

rg_status rg_constraint_init(rg_constraint *K, const rg_memory *mem, const rg_mesh *m);
/* The same, and the pattern may give way; f NULL: it may not. kawasaki non-zero: eq. (16) is kept at every vertex where
 * the pattern given obeys it. Both: RG_ENOMEM. Owner: the caller, rg_constraint_free. */
rg_status rg_constraint_init_moving(rg_constraint *K, const rg_memory *mem, const rg_mesh *m, const rg_freedom *f,
                                    int kawasaki);
void rg_constraint_free(rg_constraint *K);

/* still[N] has changed. */
void rg_constraint_set_still(rg_constraint *K);
/* The columns of creases that are still become 0, as assembling makes them. */
void rg_constraint_forget_still(rg_constraint *K);
/* Other sector angles, theta[], radians, in the order of the mesh's loop_theta. */
void rg_constraint_set_theta(rg_constraint *K, const double *theta);
/* Those of the pattern X[nv] of the mesh. RG_ENOMEM. */
rg_status rg_constraint_set_pattern(rg_constraint *K, const rg_mesh *m, const rg_vec2 *X);

/* Refills C and r for rho[N], radians. Returns the largest rotation angle of F over the vertices, radians (NaN if one
 * is NaN). Allocates nothing. */
double rg_constraint_assemble(rg_constraint *K, const double *rho);
/* The same at u[U] of the freedom, for some vertices only (NULL: for all); of the others all stays as it is.
 * *off: out, the largest |r'|; may be NULL. */
double rg_constraint_assemble_at(rg_constraint *K, rg_fours *some, const double *rho, const double *u, double *off);
/* Fours of interior vertices, vertex[count] (NULL: all). Owner: the caller, rg_fours_free. */
rg_status rg_fours_init(rg_fours *w, const rg_memory *mem, const rg_sparse *C, const int32_t *vertex, int32_t count);
void rg_fours_free(rg_fours *w, const rg_memory *mem);
/* The rotation angle of F at vertex k, for the fold angles given last. */
double rg_constraint_angle(const rg_constraint *K, int32_t k);
/* The same angle alone; C and r stay as they are. worst: out, the vertex k it is at, -1: none; may be NULL. */
double rg_constraint_closure(rg_constraint *K, const double *rho, int32_t *worst);

#endif
