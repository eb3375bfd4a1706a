/* polygon.h -- a facet that is cut into triangles.
 * Paper    section 3.2        Uses  mesh.h        Used by  triangulate.c */
#ifndef RG_POLYGON_H
#define RG_POLYGON_H

#include "mesh/mesh.h"

typedef struct rg_polygon {
    const rg_vec2 *X;
    int32_t n;
    int32_t *v, *e;        /* [n] corner, and the edge from it to the next one; counter-clockwise */
    unsigned char *inside; /* [n] non-zero: an inside angle, which an added crease is to split */
} rg_polygon;

/* Facets of more corners are cut one ear at a time: the best of all ways takes the third power of the corners, and
 * tables. */
enum { RG_POLYGON_LARGEST = 64 };

typedef struct rg_polygon_cost {
    int32_t whole; /* inside angles that are not split */
    double sharp;  /* one over the least sine */
} rg_polygon_cost;

typedef struct rg_polygon_work {
    rg_polygon_cost *cost; /* [RG_POLYGON_LARGEST squared] */
    int32_t *apex;
} rg_polygon_work;

/* The least sine of the angles of the triangle of corners i, j, k, counter-clockwise; 0: it has no area, or another
 * corner lies in it. */
double rg_polygon_least_sine(const rg_polygon *p, int32_t i, int32_t j, int32_t k);
/* Does the join of corners i and j run inside, and touch no other corner? */
int rg_polygon_has_diagonal(const rg_polygon *p, int32_t i, int32_t j);
/* The least sine of the four angles between that join and the sides at its ends. */
double rg_polygon_least_sine_at(const rg_polygon *p, int32_t i, int32_t j);
/* Puts p, as triangles, behind the facets of m, with its diagonals behind the edges: of all triangulations one that
 * leaves fewest inside angles whole, and of those the one whose smallest angle is largest. Returns zero, m untouched:
 * there is none, or p has too many corners. */
int rg_polygon_cut(const rg_polygon *p, rg_polygon_work *w, rg_mesh *m);
/* One diagonal, one facet of three corners. */
int32_t rg_polygon_add_diagonal(rg_mesh *m, int32_t from, int32_t to);
void rg_polygon_add_triangle(rg_mesh *m, const int32_t v[3], const int32_t e[3]);

#endif
