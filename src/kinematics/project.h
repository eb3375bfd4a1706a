/* project.h -- turns the step the creases wish for into one the paper allows.
 * Paper    eqs. (9), (10), (14), (15), Fig. 4        Uses  constraint.h cg.h        Used by  fold */
#ifndef RG_PROJECT_H
#define RG_PROJECT_H

#include "kinematics/constraint.h"
#include "linalg/cg.h"
#include "linalg/cholesky.h"
#include "linalg/jacobi.h"
#include "linalg/rank.h"
#include "linalg/scale.h"

typedef struct rg_project {
    rg_memory mem;
    rg_solver solver; /* CG, CHOLESKY or SVD: never AUTO */
    rg_jacobi jacobi;
    rg_scale scale;   /* B = S C: what the direct solvers solve with */
    rg_cholesky cholesky;
    rg_pinv pinv;
    rg_cg_work cg;
    double *b, *y, *x; /* [3M] [3M] [N] */
    double *u;         /* [3M] P B n for the n that is held */
    double *q;         /* [N] or, by columns, (B^T B + beta I) \ n */
    double left;       /* 1 - (B n) . u, or n . q */
    const double *u_of; /* that n, NULL: neither is made yet */
    int fresh;         /* B and the preconditioner belong to the present numbers of C */
    int factored;      /* the factor belongs to them, or to numbers near them */
    int stale;         /* to numbers near them */
    const double *held; /* the n that steps keep to */
    int64_t solves, iterations, factorizations;
} rg_project;

/* RG_EABSENT: that solver is not in this build. RG_SOLVER_AUTO chooses by size. */
rg_status rg_project_init(rg_project *P, const rg_memory *mem, const rg_constraint *K, rg_solver solver);
void rg_project_free(rg_project *P);

/* Tells that C has new numbers. */
void rg_project_renew(rg_project *P);
/* The same, and that they are so near to those factored last that the factor will do; should it not, it is made
 * anew. */
void rg_project_renew_near(rg_project *P);

/* drho = drho0 - C^T y   where   (C C^T) y = r + C drho0                                               eq. (15)
 *   drho0[N]  in   wished step, radians; NULL: none, so that only the residual is worked off
 *   feed      in   non-zero: r as in eq. (14); zero: the pure projection of eq. (9)
 *   hold[N]   in   unit vector: C^T y is kept orthogonal to it, so that the component of drho0 along it is obeyed to
 *                  the letter; NULL: none
 *   drho[N]   out  allowed step, radians; may be drho0
 *   tol       in   of the linear solve, relative to the first answer it finds
 * P->y afterwards holds y, how hard each vertex resists, if feed is zero and hold NULL. Allocates nothing.
 * RG_OK, also when the solver ran out of iterations (read rep->stop). */
rg_status rg_project_step(rg_project *P, const rg_constraint *K, const double *drho0, int feed,
                          const double *hold, double *drho, double tol, rg_cg_report *rep);

/* The same without r, hold and P->y, cheaper: t = (I - C^+ C) wish, to tol relative to C^+ C wish.       eq. (9) */
rg_status rg_project_tangent(rg_project *P, const rg_constraint *K, const double *wish, double *t, double tol,
                             rg_cg_report *rep);

#endif
