/* coupled.h -- closure by fold angles and pattern together, and the least step that works it off: one unknown for each
 * crease and each way of a vertex, or one for each orbit of a symmetric sheet and the rows of one vertex of each.
 * Paper    eqs. (14), (15), (19)        Uses  constraint.h symmetry.h least.h        Used by  fold, motion, unfold
 *
 * With S the scales of the unknowns and A the matrix of constraint.h,
 *
 *     dz = dz0 - S (A S)^+ (A dz0 + r)
 *
 * A state that has a symmetry has it after a step x = Q y too: the columns of Q are orthonormal, each with as much for
 * every crease of an orbit or, for the vertices of one, with a vector that is turned from one to the next, as far as it
 * is its own image under what takes the vertex to itself. What closes at one vertex of an orbit closes at all. So
 *
 *     min ||x||  with  A x = b      becomes      min ||y||  with  (R A Q) y = R b
 *
 * where R picks the rows of one vertex an orbit: as many times fewer rows and columns as the group has elements.
 * Without one, both are 1. */
#ifndef RG_COUPLED_H
#define RG_COUPLED_H

#include "kinematics/constraint.h"
#include "linalg/least.h"

typedef struct rg_coupled {
    rg_memory mem;
    rg_constraint *K;        /* borrowed: what is assembled; its pattern may give way */
    const rg_symmetry *G;    /* borrowed, on K->mesh; NULL: none */
    int32_t count, *vertex;  /* [count] interior vertices that have rows */
    rg_fours some;           /* with G: of these */
    int32_t *kawasaki;       /* [count] row of A, -1: not kept */
    int32_t *column;         /* [N] of the creases */
    double *part;            /* [N] of each in it */
    int32_t (*way)[2];       /* [nv] columns by which vertices move, -1: none */
    rg_vec2 (*direction)[2]; /* [nv] part of each in them */
    rg_least A;              /* R A S Q; without G its columns are creases, then ways, in their order */
    int32_t *at;             /* along mesh->loop_crease: entry of A.x of the crease */
    int32_t (*at_own)[2], (*at_far)[2]; /* [M], and along mesh->loop_crease: of the ways of a vertex */
    double *sign, *b, *y;    /* [corners] [rows] [columns] scratch */
} rg_coupled;

/* RG_ENOMEM. Owner: the caller, rg_coupled_free. */
rg_status rg_coupled_init(rg_coupled *J, const rg_memory *mem, rg_constraint *K, const rg_symmetry *G);
void rg_coupled_free(rg_coupled *J);

/* K at rho[N], u[U]; with G at one vertex of each orbit, which of a drawing that is symmetric to rounding is all that
 * there is to know. Returns the largest rotation angle of F; *off: out, the largest |r'| (may be NULL). */
double rg_coupled_assemble(rg_coupled *J, const double *rho, const double *u, double *off);
/* A with column i times scale[i], at what was assembled last; and what belongs to it. scale[N + U] is alike in an
 * orbit. */
void rg_coupled_renew(rg_coupled *J, const double *scale);
/* x[N + U]: out, the least with A x = A z + r. z[N + U], r of K's rows; NULL: nothing. Allocates nothing. */
void rg_coupled_solve(rg_coupled *J, const double *z, const double *r, double *x);

#endif
