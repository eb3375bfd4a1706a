/* symmetry.h -- how a sheet goes to itself: where each vertex, edge, crease and facet goes.
 * Uses  mesh.h maps.h        Used by  triangulate.c freedom.c, fold, motion
 *
 * A group G of turns about the middle of the pattern and of mirrors across lines through it, which take every crease to
 * one that folds alike. A mirror does so too: the plane that stands on the mirror line takes the upper side of the
 * paper to the upper side. So a folded state has the symmetry when rho_g(i) = rho_i for every g of G, and when the
 * pattern that it is folded from, if that has moved, goes to itself: dX_g(v) = A_g dX_v. */
#ifndef RG_SYMMETRY_H
#define RG_SYMMETRY_H

#include "mesh/mesh.h"

typedef struct rg_symmetry {
    rg_memory mem;
    int32_t order;        /* elements, 1: nothing but the one by nothing, which is number 0 */
    int32_t turns;        /* the first so many are turns, by even steps from 0; the others mirrors: none or as many */
    int32_t nv, ne, N, nf;
    rg_vec2 middle;       /* what they leave where it is */
    double off;           /* radians: the most that the direction of an edge, turned, differs from that of its image */
    double (*A)[2][2];    /* [order] A_g, orthogonal, about the middle: a group also where the drawing is not quite */
    int32_t *vertex;      /* [order][nv] vertex[g nv + v] = g(v) */
    int32_t *edge;        /* [order][ne] */
    int32_t *crease;      /* [order][N] */
    int32_t *facet;       /* [order][nf] */
    int32_t *vertex_orbit, *edge_orbit, *crease_orbit, *facet_orbit; /* [nv] [ne] [N] [nf] the least of the orbit */
} rg_symmetry;

/* All that the drawing allows, which may be off by RG_SAME_PLACE. RG_ENOMEM. Owner: the caller, rg_symmetry_free. */
rg_status rg_symmetry_find(rg_symmetry *G, const rg_memory *mem, const rg_mesh *m);
/* The part of it with every `every`-th turn and, of its mirrors, those that are `mirror` modulo `every`; mirror < 0:
 * none. every divides G->turns. RG_ENOMEM. */
rg_status rg_symmetry_part(rg_symmetry *out, const rg_symmetry *G, int32_t every, int32_t mirror);
/* The same elements on another mesh with the same vertices. RG_EARG: they do not take its edges and facets to each
 * other; RG_ENOMEM. *out is then zeroed. */
rg_status rg_symmetry_on(rg_symmetry *out, const rg_symmetry *G, const rg_mesh *m);
void rg_symmetry_free(rg_symmetry *G);

/* A part of G as rg_symmetry_part takes it. */
typedef struct rg_subgroup { int32_t every, mirror, order; } rg_subgroup;
/* The subgroups of G that are not alike, the largest first and G the first of them, of as large ones those with more
 * turns first; the last one is that of order 1, unless there are more than `most`. Returns how many of list[most] were
 * filled. */
int32_t rg_symmetry_subgroups(const rg_symmetry *G, rg_subgroup *list, int32_t most);

/* Facets as rg_triangulate_some cuts them, so that *out has the symmetry too: of every orbit the first facet is cut, if
 * which[that one], and the others are its images. One that some of G take to itself is cut across by a diagonal and all
 * its images at once, the shortest that do not cross each other; what no such diagonals divide stays whole, which loses
 * nothing: the corners of a facet across a mirror come in pairs whose joins are square to the mirror plane, so they are
 * in one plane in every state that has the symmetry. G NULL, or of order 1: as without. */
rg_status rg_triangulate_orbits(const rg_mesh *m, const rg_symmetry *G, const unsigned char *which, int shorter,
                                rg_mesh *out);

/* x[N]: every orbit of creases gets its mean. What is alike already is left to the bit. Allocates nothing; no more than
 * rounding changes when it is done again. */
void rg_symmetry_mean(const rg_symmetry *G, double *x);
/* d[nv], a vector at each vertex: the mean over g of A_g^-1 d_g(v), each turned back. The same, but for rounding. */
void rg_symmetry_mean_vectors(const rg_symmetry *G, rg_vec2 *d);
/* The largest |x_g(i) - x_i|. NaN where one of x is. */
double rg_symmetry_off(const rg_symmetry *G, const double *x);

#endif
