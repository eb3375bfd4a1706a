/* linkage.h -- where the vertices of a sheet of rigid triangles are, and how they move when fold angles and pattern do.
 * Paper    Fig. 1; the derivatives of it        Uses  pose.h coupled.h        Used by  the other files of this room
 *
 * State z = (rho, u): fold angles, and what the vertices of the pattern moved by, as ways of freedom.h. Positions
 * follow from a tree of facets. With hinge (a, b) of facet f under facet p, at the point Q of space, and n = R e_z of
 * either:
 *     drho of the hinge:  f and all below it turn by axis drho about Q
 *     dX of a or b:       the hinge turns in the plane by dphi = (d x (dX_b - dX_a)) / |d|^2, d = X_b - X_a; so f and
 *                         all below it turn by (n_p - n_f) dphi about Q, and go by (R_p - R_f) dX_a
 *     dX of v itself:     R_f dX, f its own facet
 * The tree is cut open along other creases; at a closed state and for a step that closes to first order it does not
 * matter which way round one goes. */
#ifndef RG_LINKAGE_H
#define RG_LINKAGE_H

#include "kinematics/coupled.h"
#include "pose/pose.h"

typedef struct rg_linkage {
    rg_memory mem;
    const rg_mesh *mesh;      /* borrowed: triangles */
    rg_freedom freedom;
    rg_constraint K;          /* closure, eqs. (12), (14), (19) */
    rg_coupled J;
    rg_tree tree;
    int32_t N, U, n;          /* n = N + U */
    int32_t *parent;          /* [nf] -1: the fixed facet */
    int32_t *crease;          /* [nf] of its hinge */
    int32_t (*ends)[2];       /* [nf] a, b: the facet turns by +rho about a -> b */
    int32_t *own;             /* [nv] the facet that places the vertex */
    rg_vec2 *X;               /* [nv] the pattern, at the state placed last */
    rg_place *place;          /* [nf] */
    rg_vec3 *p;               /* [nv] positions */
    rg_vec3 *axis, *hinge;    /* [nf] */
    rg_vec2 *trial_X;         /* [nv] */
    rg_place *trial_place;    /* [nf] scratch of rg_linkage_positions */
    rg_vec3 *turn, *slip;     /* [nf] scratch: velocity of a facet's point x is slip + turn x x */
} rg_linkage;

/* m: triangles. RG_ENOMEM. Owner: the caller, rg_linkage_free. */
rg_status rg_linkage_init(rg_linkage *P, const rg_memory *mem, const rg_mesh *m);
void rg_linkage_free(rg_linkage *P);

/* P->X, place, p, axis, hinge at z[n]. Allocates nothing, as all below. */
void rg_linkage_put(rg_linkage *P, const double *z);
/* Only positions: x[nv]. Leaves what rg_linkage_put made as it is. */
void rg_linkage_positions(rg_linkage *P, const double *z, rg_vec3 *x);
/* dp[nv]: out, the derivative of p along dz[n]. */
void rg_linkage_velocity(rg_linkage *P, const double *dz, rg_vec3 *dp);
/* The farthest, radians, that a crease is past half a turn at z; 0: none is. */
double rg_linkage_past_half_turn(const rg_linkage *P, const double *z);
/* The least area of a facet at u, over its area in the pattern given; negative: one has turned over. */
double rg_linkage_least_area(rg_linkage *P, const double *u);
/* The same of facet f with vertices at X[nv]. */
double rg_linkage_area(const rg_linkage *P, int32_t f, const rg_vec2 *X);

#endif
