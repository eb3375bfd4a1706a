/* faces.h -- a plane graph by its half-edges: stars of vertices, cycles of faces.
 * Half-edge 2e runs from v[0] to v[1] of edge e, 2e + 1 back; each belongs to the face on its left.
 * Used by  pattern.c, mesh/facets.c */
#ifndef RG_FACES_H
#define RG_FACES_H

#include "pattern/pattern.h"

typedef struct rg_star {
    rg_memory mem;
    int32_t *start; /* [nv + 1] */
    int32_t *edge;  /* [2 ne] edges of v counter-clockwise by direction: edge[start[v]] ... edge[start[v + 1] - 1] */
} rg_star;

/* RG_ENOMEM. Owner of both: the caller, rg_star_free, rg_faces_free, also after a failure. */
rg_status rg_star_init(rg_star *s, const rg_memory *mem, int32_t nv, int32_t ne, const rg_vec2 *X, const rg_edge *E);
void rg_star_free(rg_star *s);
/* Puts the edges of those vertices in order where which[v] != 0, whose edges have changed. RG_ENOMEM. */
rg_status rg_star_sort(rg_star *s, int32_t nv, const rg_vec2 *X, const rg_edge *E, const unsigned char *which);

typedef struct rg_faces {
    rg_memory mem;
    int32_t count;
    int32_t *next;  /* [2 ne] the half-edge after it around its face */
    int32_t *face;  /* [2 ne] */
    int32_t *first; /* [count] the lowest half-edge of a face */
    double *area;   /* [count] negative: the outside of a piece, walked clockwise */
} rg_faces;

rg_status rg_faces_init(rg_faces *f, const rg_memory *mem, int32_t nv, int32_t ne, const rg_vec2 *X, const rg_edge *E,
                        const int32_t *star_start, const int32_t *star);
void rg_faces_free(rg_faces *f);

/* Both of one graph; zeroed: there are none yet. */
typedef struct rg_walk { rg_star star; rg_faces faces; int there; } rg_walk;

/* Where there are none yet. RG_ENOMEM. */
rg_status rg_walk_make(rg_walk *w, const rg_memory *mem, int32_t nv, int32_t ne, const rg_vec2 *X, const rg_edge *E);
void rg_walk_free(rg_walk *w);

static inline int32_t rg_tail(const rg_edge *E, int32_t h) { return E[h >> 1].v[h & 1]; }
static inline int32_t rg_head(const rg_edge *E, int32_t h) { return E[h >> 1].v[!(h & 1)]; }

#endif
