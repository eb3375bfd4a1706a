/* pose.h -- fold angles to positions, by a spanning tree of facets.
 * Paper    Fig. 1        Uses  mesh.h        Used by  motion, write, render */
#ifndef RG_POSE_H
#define RG_POSE_H

#include "mesh/mesh.h"

/* How a facet is reached from the one before it, for the pattern as given. */
typedef struct rg_hinge {
    int32_t facet, from, crease; /* from -1: the fixed facet */
    rg_vec2 u;                   /* along the hinge */
    double across;               /* of the hinge from the line through 0 along u */
} rg_hinge;

/* A spanning tree of the facets, breadth first from the fixed facet, so that paths are short and rounding is low. */
typedef struct rg_tree {
    rg_memory mem;
    int32_t nf;
    int32_t *order;  /* [nf] facets, parents before children */
    int32_t *via;    /* [nf] edge over which facet f is reached, -1 for the fixed facet */
    rg_hinge *hinge; /* [nf] in that order */
    int32_t nv;
    /* [nv + 1]: the facets at each vertex; the one nearest the root comes first, and places it. */
    int32_t *corner_start, *corner_facet;
} rg_tree;

/* fixed_facet -1: the one nearest the centre of the sheet. RG_EARG: no such facet. */
rg_status rg_tree_init(const rg_mesh *m, int32_t fixed_facet, rg_tree *t);
void rg_tree_free(rg_tree *t);

typedef struct rg_place { rg_mat3 R; rg_vec3 t; } rg_place; /* x -> R x + t */

/* X[nv]: the pattern, m->X or what adjusting made of it.
 * place[nf]: out, where each facet goes; the fixed facet stays in z = 0.   rho[N]: radians. */
void rg_pose_facets(const rg_mesh *m, const rg_vec2 *X, const rg_tree *t, const double *rho, rg_place *place);
/* x[nv]: out, vertex positions, each taken from the facet nearest the tree's root that has it. */
void rg_pose_vertices(const rg_mesh *m, const rg_vec2 *X, const rg_tree *t, const rg_place *place, rg_vec3 *x);
/* Largest distance between two placements of one vertex by different facets, file units. */
double rg_pose_gap(const rg_vec2 *X, const rg_tree *t, const rg_place *place);
/* Largest | 3D length / pattern length - 1 | over the edges, with vertices as placed by x. */
double rg_pose_strain(const rg_mesh *m, const rg_vec2 *X, const rg_vec3 *x);
/* Newell's normal of facet f with vertices at x[nv], as long as its area: right for any facet, also where corners lie
 * in a line. */
rg_vec3 rg_pose_area(const rg_mesh *m, int32_t f, const rg_vec3 *x);
/* The same, unit; along z where there is none. */
rg_vec3 rg_pose_normal(const rg_mesh *m, int32_t f, const rg_vec3 *x);

#endif
