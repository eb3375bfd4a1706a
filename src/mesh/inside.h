/* inside.h -- which corners of facets are inside angles of closed vertices.
 * Paper    sections 3.1, 3.2, Fig. 5        Uses  mesh.h closed.h        Used by  triangulate.c */
#ifndef RG_INSIDE_H
#define RG_INSIDE_H

#include "mesh/mesh.h"

/* flag[along m->facet_vertex]: out, non-zero where the corner is the inside angle of a closed triple of creases as
 * drawn; a sector that an added crease runs through is split already and none. RG_ENOMEM. */
rg_status rg_inside_find(const rg_mesh *m, unsigned char *flag);

#endif
