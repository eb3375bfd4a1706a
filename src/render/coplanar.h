/* coplanar.h -- which facets lie in one plane, by a hash table over planes.
 * Uses  pose.h        Used by  lift.c */
#ifndef RG_COPLANAR_H
#define RG_COPLANAR_H

#include "pose/pose.h"

/* Within that part of the sheet's size of one plane is in that plane. */
#define RG_COPLANAR_THICKNESS 1e-3

typedef struct rg_coplanar {
    rg_memory mem;
    const rg_mesh *mesh;
    int32_t *by_area;     /* [nf] the largest first: a large facet says best where a plane is */
    int32_t *head, *next; /* [heads], [nf] chains of the hash table, over the first facets of groups */
    int32_t *group;       /* [nf] group of each facet */
    int32_t *first;       /* [groups] facet that says where the group's plane is */
    int32_t *start;       /* [groups + 1] into member */
    int32_t *member;      /* [nf] facets of each group, by number */
    int32_t groups;
    size_t heads;
} rg_coplanar;

/* `m` is kept by reference. RG_ENOMEM. Owner: the caller, rg_coplanar_free, also after a failure. */
rg_status rg_coplanar_init(rg_coplanar *c, const rg_memory *mem, const rg_mesh *m);
/* Groups the facets as they lie, whichever side is up. place[nf], x[nv]: see pose.h. Allocates nothing.
 * Facets at the edge of the tolerance may be told apart though each is near a third one. */
void rg_coplanar_find(rg_coplanar *c, const rg_place *place, const rg_vec3 *x);
void rg_coplanar_free(rg_coplanar *c);

#endif
