/* mesh.h -- plates and hinges: facets, creases, interior vertices and their sector angles.
 * Paper    sections 2, 3.2: M, N, N0, theta        Uses  pattern.h        Used by  kinematics, pose, fold, write */
#ifndef RG_MESH_H
#define RG_MESH_H

#include "pattern/pattern.h"

typedef struct rg_mesh {
    rg_memory mem;
    int32_t nv, ne, nf;
    int32_t M, N, N0;         /* interior vertices, creases, perimeter edges */
    int32_t added;            /* creases added by triangulation: the last `added` of the N */
    double size;              /* longer side of the bounding box */
    rg_vec2 *X;               /* [nv] */
    int32_t (*edge)[2];       /* [ne] end vertices */
    char *assignment;         /* [ne] B M V U F */
    double *target;           /* [ne] wished final fold angle, radians; NAN: none */
    unsigned char *still;     /* [ne] non-zero: its crease stays as it is; NULL: none does */
    int32_t (*edge_facet)[2]; /* [ne] facet left of edge[e][0] -> edge[e][1], and right of it; -1: outside */
    int32_t *facet_start;     /* [nf + 1] */
    int32_t *facet_vertex;    /* counter-clockwise */
    int32_t *facet_edge;      /* facet_edge[j] joins facet_vertex[j] to the next one of that facet */
    int32_t *crease_edge;     /* [N] edge number of crease i */
    int32_t *edge_crease;     /* [ne] crease number of edge e, -1: perimeter */
    int32_t *inner_vertex;    /* [M] vertex number of interior vertex k */
    int32_t *loop_start;      /* [M + 1] */
    int32_t *loop_crease;     /* crease numbers counter-clockwise around interior vertex k */
    double *loop_theta;       /* theta[k][i]: angle from that crease to the next one counter-clockwise */
} rg_mesh;

/* Facets of a pattern, not triangulated. RG_ESHEET: not one sheet without holes, why->text says where.
 * Owner: the caller, rg_mesh_free; *m is zeroed on failure. */
rg_status rg_mesh_from_pattern(const rg_pattern *p, const rg_memory *mem, rg_mesh *m, rg_diag *why);
/* The same sheet with every facet cut into triangles by added creases ('F', target NAN, crease numbers after all
 * others; old crease and edge numbers are kept). Never a flipped or a zero-area triangle. DOF = N - 3M = N0 - 3
 * afterwards. Of all ways to cut a facet, one that splits most inside angles of closed vertices, and then has the
 * largest least angle. */
rg_status rg_triangulate_all(const rg_mesh *m, rg_mesh *out);
/* The same by short diagonals, whatever they split: sheets fold one way that do not fold the other. */
rg_status rg_triangulate_short(const rg_mesh *m, rg_mesh *out);
/* Only the facets f with which[f] non-zero (NULL: all), the first way or, shorter non-zero, the second. */
rg_status rg_triangulate_some(const rg_mesh *m, const unsigned char *which, int shorter, rg_mesh *out);
/* facet[cut->nf]: out, the facet of m that each facet of *cut, a triangulation of m, is a piece of. */
void rg_triangulate_trace(const rg_mesh *m, const rg_mesh *cut, int32_t *facet);
/* The edge of facet f between vertices a and b; -1: none. */
int32_t rg_mesh_edge_between(const rg_mesh *m, int32_t f, int32_t a, int32_t b);
/* The corner of a triangle that is not on its edge e. */
int32_t rg_mesh_opposite(const rg_mesh *m, int32_t triangle, int32_t e);
/* theta[loop_start[M]]: out, the angles between creases round interior vertices on another pattern X[nv], as loop_theta
 * is on m->X. */
void rg_mesh_sectors(const rg_mesh *m, const rg_vec2 *X, double *theta);
/* Of interior vertex k only. */
void rg_mesh_sectors_at(const rg_mesh *m, int32_t k, const rg_vec2 *X, double *theta);
/* Twice the area of facet f on the pattern X[nv]; negative: it has turned over. */
double rg_mesh_twice_area(const rg_mesh *m, int32_t f, const rg_vec2 *X);
/* A copy, with an allocator of its own. RG_ENOMEM, *out is then zeroed. */
rg_status rg_mesh_copy(const rg_mesh *m, rg_mesh *out);
void rg_mesh_free(rg_mesh *m);

#endif
