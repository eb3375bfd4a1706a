/* components.h -- groups of creases that are joined through interior vertices: each moves without the others.
 * Uses  mesh.h        Used by  apart.c measure.c */
#ifndef RG_COMPONENTS_H
#define RG_COMPONENTS_H

#include "mesh/mesh.h"

/* part[m->N]: out, the group of each crease, numbered from 0 by their first creases. Returns how many there are. */
int32_t rg_components_find(const rg_mesh *m, int32_t *part);
/* The same groups, fewer: creases without interior vertices, each a group of its own, are made one, and an added crease
 * is joined to those of its two triangles, which limit how far it may turn. RG_ENOMEM. */
rg_status rg_components_find_coarse(const rg_mesh *m, int32_t *part, int32_t *count);

#endif
