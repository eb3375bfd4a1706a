/* orbits.h -- the joint system of a symmetric sheet, with one unknown for each orbit and the rows of one vertex of each.
 * Paper    eqs. (7), (8), (11), (16)-(18)        Uses  coupled.h symmetry.h        Used by  relax.c
 *
 * A state that has the symmetry has it after a step x = Q y too: the columns of Q are orthonormal, each with as much for every
 * crease of an orbit or, for the vertices of one, with a vector that is turned from one to the next, as far as it is its own image
 * under what takes the vertex to itself. What closes at one vertex of an orbit closes at all. So
 *
 *     min ||x||  with  A x = b      becomes      min ||y||  with  (R A Q) y = R b
 *
 * where R picks the rows of one vertex an orbit: as many times fewer rows and columns as the group has elements. */
#ifndef RG_ORBITS_H
#define RG_ORBITS_H

#include "kinematics/coupled.h"

typedef struct rg_orbits {
    rg_memory mem;
    rg_coupled *J;             /* borrowed: what is assembled */
    const rg_symmetry *G;    /* borrowed, on J->mesh */
    int32_t count, *vertex;  /* [count] interior vertices, the first of each orbit */
    int32_t *kawasaki;       /* [count] row of A, -1: not kept */
    int32_t *column;         /* [N] of the creases */
    double *part;            /* [N] of each in it */
    int32_t (*way)[2];       /* [nv] columns by which vertices move, -1: none */
    rg_vec2 (*direction)[2]; /* [nv] part of each in them */
    rg_least A;               /* R A Q, with what belongs to it */
    int32_t *at;             /* along mesh->loop_crease: entry of A.x of the crease */
    int32_t (*at_own)[2], (*at_far)[2]; /* [M], and along mesh->loop_crease: of the ways of a vertex */
    double *b, *y;           /* [rows] [columns] scratch */
} rg_orbits;

/* RG_ENOMEM. Owner: the caller, rg_orbits_free. */
rg_status rg_orbits_init(rg_orbits *O, rg_coupled *J, const rg_symmetry *G);
void rg_orbits_free(rg_orbits *O);

/* As rg_coupled_assemble, at one vertex of each orbit: of a drawing that is symmetric to rounding all that there is to know. */
double rg_orbits_assemble(rg_orbits *O, const double *rho, const double *u, double *off);
/* As rg_coupled_renew; scale[N + U] is alike in an orbit. */
void rg_orbits_renew(rg_orbits *O, const double *scale);
/* x[N + U]: out, the least with A x = A z + r. z[N + U], r of rg_coupled's rows; NULL: nothing. Allocates nothing. */
void rg_orbits_solve(rg_orbits *O, const double *z, const double *r, double *x);

#endif
