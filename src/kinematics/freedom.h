/* freedom.h -- how the vertices of a pattern may move while it is folded.
 * Paper    section 3.3, the vector [dX dY]        Uses  symmetry.h        Used by  adjust.c coupled.c rectify.c
 *
 * A vertex inside the sheet moves two ways, one on a straight edge of the sheet along that edge, a corner not at all:
 * the outline stays what it is. */
#ifndef RG_FREEDOM_H
#define RG_FREEDOM_H

#include "mesh/symmetry.h"

typedef struct rg_freedom {
    rg_memory mem;
    const rg_mesh *mesh;   /* borrowed; mesh->X is the pattern given */
    int32_t U;             /* ways to move, 0: a pattern that stays as it is */
    int32_t (*way)[2];     /* [nv] their numbers, -1: none */
    int32_t *vertex;       /* [U] */
    rg_vec2 *direction;    /* [U] unit vectors */
    double *reach;         /* [U] length of the shortest line of the pattern that ends there */
} rg_freedom;

/* movable zero: U = 0. RG_ENOMEM. Owner: the caller, rg_freedom_free. */
rg_status rg_freedom_init(rg_freedom *f, const rg_memory *mem, const rg_mesh *m, int movable);
void rg_freedom_free(rg_freedom *f);
/* X[nv]: out, the pattern moved by u[U], lengths. */
void rg_freedom_move(const rg_freedom *f, const double *u, rg_vec2 *X);
/* The farthest that a vertex goes by u[U], a length. */
double rg_freedom_farthest(const rg_freedom *f, const double *u);
/* u[U]: becomes what moves the pattern alike everywhere, the mean of its displacements over G. d[nv]: scratch. */
void rg_freedom_mean(const rg_freedom *f, const rg_symmetry *G, double *u, rg_vec2 *d);
/* Zero: a facet has turned over, or shrunk to less than `least` of its area. room[U]: out, of each way 1 less the part
 * used up of what the facets round its vertex may shrink, 1 ... 0; NULL: not asked for. */
int rg_freedom_room(const rg_freedom *f, const rg_vec2 *X, double least, double *room);

#endif
