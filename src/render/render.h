/* render.h -- one frame of a fold as a picture: two-sided paper, soft light, creases drawn.
 * Paper    section 4        Uses  gl.h camera.h triangles.h        Used by  frames.c */
#ifndef RG_RENDER_H
#define RG_RENDER_H

#include "render/camera.h"
#include "render/triangles.h"

typedef struct rg_render rg_render;

/* Draws sheets with the facets of `m` in pictures like *p. `m` and `t` are kept by reference and have to stay.
 * RG_EARG: see rg_camera_check; RG_EABSENT: this build or this machine makes no pictures; RG_ENOMEM.
 * Owner: the caller, rg_render_destroy (NULL is fine). */
rg_status rg_render_create(const rg_memory *mem, const rg_mesh *m, const rg_triangles *t, const rg_picture *p,
                           rg_render **render, rg_diag *why);
/* x[m->nv]: positions. lift[m->nf]: how far to move each facet, NULL: nowhere. camera: made for the same *p.
 * rgb: out, p->height rows of p->width pixels of 3 bytes, top row first. Allocates nothing of ours. */
rg_status rg_render_frame(rg_render *r, const rg_vec3 *x, const rg_vec3 *lift, const rg_camera *camera,
                          unsigned char *rgb, rg_diag *why);
void rg_render_destroy(rg_render *r);

#endif
