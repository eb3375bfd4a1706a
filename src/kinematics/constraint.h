/* constraint.h -- all vertices: C (3M x N) and r at given fold angles.
 * Paper    eqs. (6)-(8), (11), (12)        Uses  loop.h sparse.h mesh.h        Used by  project.c fold.c motion.c */
#ifndef RG_CONSTRAINT_H
#define RG_CONSTRAINT_H

#include "kinematics/loop.h"
#include "linalg/sparse.h"
#include "mesh/mesh.h"

typedef struct rg_constraint {
    rg_memory mem;
    rg_sparse C;    /* eq. (8) */
    double *r;      /* [3M] eq. (12), per vertex in the order b, c, a, which is x, y, z of the axial vector */
    rg_turn *theta; /* per block of C: cosine and sine of the sector angle, fixed by the mesh */
    rg_turn *rho;   /* [N] cosine and sine of the fold angles given last */
} rg_constraint;

rg_status rg_constraint_init(rg_constraint *K, const rg_memory *mem, const rg_mesh *m);
void rg_constraint_free(rg_constraint *K);

/* Refills C and r for rho[N], radians. Returns the largest rotation angle of F over the vertices, radians (NaN if one
 * is NaN). Allocates nothing. */
double rg_constraint_assemble(rg_constraint *K, const double *rho);
/* The same angle alone; C and r stay as they are. worst: out, the vertex k it is at, -1: none; may be NULL. */
double rg_constraint_closure(rg_constraint *K, const double *rho, int32_t *worst);

#endif
