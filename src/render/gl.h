/* gl.h -- the one door to OpenGL: a context off the screen that tells which triangle is nearest at each sample.
 * Paper    section 4        Uses  base        Used by  canvas.c raster.c seen.c
 *
 * Built for OSMesa, for EGL without a surface, or for neither (RG_GL_osmesa, RG_GL_egl, RG_GL_none). What GL keeps
 * inside is allocated by GL, not by rg_memory. One handle belongs to one thread at a time. */
#ifndef RG_GL_H
#define RG_GL_H

#include "base/memory.h"

typedef struct rg_gl rg_gl;

typedef struct rg_gl_vertex {
    float x, y, z; /* samples right, samples down, depth 0 (near) ... 1 (far) */
    uint32_t mark; /* of the triangle, the same at its three corners; above 0 */
} rg_gl_vertex;

typedef struct rg_gl_scene {
    const rg_gl_vertex *vertex;
    const uint32_t *corner; /* [corners] three vertices a triangle; what is first wins where depths are the same */
    int32_t corners;
} rg_gl_scene;

/* RG_OK if this build has OpenGL, else RG_EABSENT and a sentence. */
rg_status rg_gl_check(rg_diag *why);
/* A canvas of width x height samples; it may be made smaller where GL's limits ask for it: rg_gl_size tells.
 * RG_EABSENT: no such part in this build or on this machine. Owner: the caller, rg_gl_destroy (NULL is fine). */
rg_status rg_gl_create(const rg_memory *mem, int32_t width, int32_t height, rg_gl **gl, rg_diag *why);
void rg_gl_size(const rg_gl *gl, int32_t *width, int32_t *height);
/* Draws the part of the scene whose upper left sample is (x, y), `width` x `height` samples, no larger than the canvas.
 * mark: out, rows of *pitch samples, top row first: the mark of what is seen there, 0: nothing. Lent until the next
 * call on this handle; may be written on. */
rg_status rg_gl_draw(rg_gl *gl, const rg_gl_scene *scene, int32_t x, int32_t y, int32_t width, int32_t height,
                     uint32_t **mark, int32_t *pitch, rg_diag *why);
void rg_gl_destroy(rg_gl *gl);

#endif
