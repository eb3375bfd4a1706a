/* connect.h -- what follows from edges and facets: which facets an edge joins, creases, loops around interior vertices.
 * Paper    sections 2, 3.2: M, N, N0, theta        Used by  facets.c triangulate.c */
#ifndef RG_CONNECT_H
#define RG_CONNECT_H

#include "mesh/mesh.h"

/* Given nv, X, ne, edge, assignment, target, nf and the facet lists of *m, with size and added set, makes the rest.
 * RG_ENOMEM. */
rg_status rg_mesh_connect(rg_mesh *m);

#endif
