/* space.h -- lines drawn in space, laid flat; where a block of lines goes; and which sides of facets are the sheet's
 * border.
 * Uses  plane.h affine.h        Used by  dxf.c */
#ifndef RG_SPACE_H
#define RG_SPACE_H

#include "base/vec.h"
#include "lines/lines.h"

/* x' = A x + t. */
typedef struct rg_map3 { rg_mat3 A; rg_vec3 t; } rg_map3;

rg_vec3 rg_map3_point(rg_map3 p, rg_vec3 x);
/* p after q. */
rg_map3 rg_map3_after(rg_map3 p, rg_map3 q);
rg_map3 rg_map3_shifted(rg_vec3 t);
rg_map3 rg_map3_scaled(double x, double y, double z);
rg_map3 rg_map3_turned(double degrees); /* about z */
/* The plane that an entity is drawn in, by its normal: AutoCAD's arbitrary axis algorithm. */
rg_map3 rg_map3_of_normal(rg_vec3 n);

typedef struct rg_space {
    rg_vec3 *ends; /* both of every line */
    size_t room;
    int is_spatial; /* some z is not 0 */
    int32_t *side;  /* lines that are sides of facets, and of no kind by name or colour */
    int32_t sides;
    size_t side_room;
} rg_space;

/* Adds a line to *lines, and its ends to *s. RG_ENOMEM. */
rg_status rg_space_add(rg_space *s, rg_lines *lines, rg_vec3 a, rg_vec3 b, char assignment, int32_t where);
/* Line i is the side of a facet. RG_ENOMEM. */
rg_status rg_space_side(rg_space *s, rg_lines *lines, int32_t i);
/* A side that only one facet has is the sheet's border. RG_ENOMEM. */
rg_status rg_space_border(const rg_space *s, rg_lines *lines);
/* Drawings in space lie in a plane, as sheets do before they are folded: what is off it by the part `merge` of the size
 * is told, by more is RG_EFORMAT, with the line that leaves it. RG_ENOMEM. */
rg_status rg_space_flatten(const rg_space *s, rg_lines *lines, double merge, rg_diag *why);
void rg_space_free(rg_space *s, const rg_memory *mem);

#endif
