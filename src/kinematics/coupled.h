/* coupled.h -- closure of every vertex by fold angles and pattern together, and Kawasaki's theorem by the pattern.
 * Paper    eqs. (7), (8), (11) with the columns of (17) beside them; (16)-(18)        Uses  loop.h freedom.h least.h
 * Used by  orbits.c between.c linkage.c
 *
 * F depends on the sector angles theta as it does on rho: dF/dtheta_i = [A_(i+1) e_z]x F, the normal of that facet, seen from
 * the first. So what rho cannot close, X can:
 *
 *     [ C  D ] [drho]      [r ]        D = dr/dX          eqs. (11), (17)
 *     [ 0  G ] [ dX ] = -  [r']        G = dG/dX          eqs. (17), (18) */
#ifndef RG_COUPLED_H
#define RG_COUPLED_H

#include "kinematics/freedom.h"
#include "linalg/least.h"

typedef struct rg_coupled {
    rg_memory mem;
    const rg_mesh *mesh;       /* borrowed */
    const rg_freedom *freedom; /* borrowed */
    int32_t N, U, M, K;        /* creases, ways to move, interior vertices, vertices kept flat-foldable */
    rg_least A;                 /* (3M + K) x (N + U), its columns scaled */
    rg_vec2 *X;                /* [nv] */
    double *theta;             /* sector angles, along mesh->loop_crease */
    double *r;                 /* [3M + K] r and r', eqs. (12), (19) */
    int32_t *far;              /* along mesh->loop_crease: the vertex at the other end of that crease */
    int32_t *kawasaki;         /* [M] row of A, -1: not kept */
    rg_vec3 *direction, *normal; /* along mesh->loop_crease: columns by rho, by theta */
    double *sign;              /* scratch */
    int32_t *at;               /* along mesh->loop_crease: entry of A->x */
    int32_t (*at_own)[2];      /* [M], and along mesh->loop_crease: entries of the ways of a vertex */
    int32_t (*at_far)[2];
} rg_coupled;

/* kawasaki non-zero: keeps eq. (16) at every vertex where the pattern given obeys it. RG_ENOMEM.
 * Owner: the caller, rg_coupled_free. */
rg_status rg_coupled_init(rg_coupled *J, const rg_memory *mem, const rg_mesh *m, const rg_freedom *f, int kawasaki);
void rg_coupled_free(rg_coupled *J);

/* r at rho[N], u[U]. Returns the largest rotation angle of F; *off: out, the largest |r'| (may be NULL). */
double rg_coupled_assemble(rg_coupled *J, const double *rho, const double *u, double *off);
/* The same of some interior vertices only, vertex[count]; the others' part of what was assembled is left. */
double rg_coupled_assemble_some(rg_coupled *J, const int32_t *vertex, int32_t count, const double *rho, const double *u, double *off);
/* How interior vertex k responds to its far vertices: the gradient g of the direction of loop entry j, and the change of r by it. */
void rg_coupled_turn(const rg_coupled *J, int32_t k, int32_t j, rg_vec2 *g, rg_vec3 *normal);
/* +1 and -1 by turns for the sectors between drawn creases of vertex k, summed: *sum, eq. (18); sign[j]: of the direction of its loop
 * entry j in it (NULL: not asked for). Returns the number of drawn creases. */
int32_t rg_coupled_alternate(const rg_coupled *J, int32_t k, double *sum, double *sign);
/* A with column i times scale[i], at what was assembled last; and what belongs to it. */
void rg_coupled_renew(rg_coupled *J, const double *scale);

#endif
