/* shadow.h -- the soft shadow that a sheet throws on the floor.
 * Uses  camera.h triangles.h        Used by  render.c */
#ifndef RG_SHADOW_H
#define RG_SHADOW_H

#include "render/camera.h"
#include "mesh/triangles.h"

typedef struct rg_shadow {
    rg_memory mem;
    float *dark, *work; /* [side][side] of the floor, 0 ... 1 */
    double x, y, cell;  /* its first corner and the size of its cells, on the stage */
} rg_shadow;

/* RG_ENOMEM. Owner: the caller, rg_shadow_free, also after a failure. */
rg_status rg_shadow_init(const rg_memory *mem, rg_shadow *s);
void rg_shadow_free(rg_shadow *s);
/* x[m->nv]: positions on the stage; lamp: towards the light. rgb: in and out, rows of pixels of 3 bytes, top row first:
 * the floor is made darker where it lies in the shadow. Nothing happens where the camera does not look down on the
 * floor. Allocates nothing. */
void rg_shadow_draw(rg_shadow *s, const rg_mesh *m, const rg_triangles *t, const rg_vec3 *x, const rg_camera *c,
                    rg_vec3 lamp, int32_t width, int32_t height, unsigned char *rgb);

#endif
