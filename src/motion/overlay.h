/* overlay.h -- two meshes of one sheet, of which one has all lines of the other: what its vertices and creases are
 * there.
 * Paper    section 4: transition from one folded state to another
 * Uses     mesh.h        Used by  assemble.c stages.c states.c */
#ifndef RG_OVERLAY_H
#define RG_OVERLAY_H

#include "mesh/mesh.h"

/* A place on the coarse mesh: weights of up to three of its vertices, which are an edge's or a triangle's. */
typedef struct rg_spot { int32_t n, at[3]; double weight[3]; } rg_spot;

typedef struct rg_overlay {
    rg_memory mem;
    int32_t nv, N;   /* of the fine mesh */
    rg_spot *spot;   /* [nv] */
    int32_t *crease; /* [N] the coarse crease that it is a part of, -1: none */
} rg_overlay;

/* Adds the mesh's border and creases to the lines, creases without assignment; added_only: those that triangulation
 * added and that rho, if given, bends. RG_ENOMEM. */
rg_status rg_overlay_draw(rg_lines *l, const rg_mesh *m, int added_only, const double *rho);
/* A mesh of the lines, which are taken over; its creases have no assignment and the target NAN. merge: as in
 * rg_reading. */
rg_status rg_overlay_mesh(rg_lines *l, double merge, rg_mesh *m, rg_diag *why);

/* tol: distance, file units. RG_ENOMEM. Owner: the caller, rg_overlay_free, also after a failure. */
rg_status rg_overlay_init(rg_overlay *o, const rg_mesh *fine, const rg_mesh *coarse, double tol);
void rg_overlay_free(rg_overlay *o);
/* of_fine[N]: out, the angle of the crease that each is a part of, 0 where there is none. */
void rg_overlay_angles(const rg_overlay *o, const double *of_coarse, double *of_fine);
/* X[nv]: out, where the fine mesh's vertices are when the coarse one's are at `coarse`. */
void rg_overlay_points(const rg_overlay *o, const rg_vec2 *coarse, rg_vec2 *X);

#endif
