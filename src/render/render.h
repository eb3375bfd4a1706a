/* render.h -- one frame of a fold as a picture: two-sided paper, soft light, creases drawn, a shadow on the floor.
 * Paper    section 4        Uses  canvas.h seen.h ink.h print.h shadow.h triangles.h        Used by  frames.c */
#ifndef RG_RENDER_H
#define RG_RENDER_H

#include "render/print.h"
#include "render/seen.h"
#include "mesh/triangles.h"

typedef struct rg_render rg_render;

/* Draws sheets with the facets of `m` in pictures like *p, with `print` on their front (NULL: nothing). `m`, `t` and
 * `print` are kept by reference and have to stay. RG_EARG: see rg_picture_check; RG_ENOMEM. Owner: the caller,
 * rg_render_destroy (NULL is fine). */
rg_status rg_render_create(const rg_memory *mem, const rg_mesh *m, const rg_triangles *t, const rg_picture *p,
                           const rg_print *print, rg_render **render, rg_diag *why);
/* shot->camera: made for the same *p. rgb: out, p->height rows of p->width pixels of 3 bytes, top row first. Allocates
 * nothing of ours. */
void rg_render_frame(rg_render *r, const rg_shot *shot, unsigned char *rgb);
void rg_render_destroy(rg_render *r);

#endif
