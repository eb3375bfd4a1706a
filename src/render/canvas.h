/* canvas.h -- the nearest triangle at each sample: by OpenGL in a process of its own, or by ours.
 * Paper    section 4        Uses  gl.h raster.h        Used by  render.c
 *
 * OpenGL in software compiles code as it draws, and ends the process that it is in when memory is short: so it gets one
 * of its own, a child that shares the scene and the samples. Where there is none to be had, where it ends, says no or
 * does not answer, and in builds without OpenGL, the same is drawn by raster.c, here. A sample on a facet's edge may
 * then go to its other side. */
#ifndef RG_CANVAS_H
#define RG_CANVAS_H

#include "render/gl.h"

typedef struct rg_canvas {
    rg_memory mem;
    rg_gl_vertex *vertex; /* [vertices] to be filled by the caller */
    uint32_t *corner;     /* [corners] to be filled by the caller */
    int32_t width, height; /* samples */
    uint32_t *mark;       /* [height][width] */
    double *depth;        /* [height][width] of ours */
    size_t shared;        /* bytes from vertex[] on that the child has too; 0: there is no child */
    int socket;           /* to the child, -1: there is none */
    long child;
} rg_canvas;

/* RG_ENOMEM. Owner: the caller, rg_canvas_free, also after a failure. */
rg_status rg_canvas_init(const rg_memory *mem, int32_t width, int32_t height, size_t vertices, size_t corners,
                         int by_gl, rg_canvas *c);
void rg_canvas_free(rg_canvas *c);
/* Of the first `corners` of corner[]. The samples are in c->mark, c->width a row, until the next call; they may be
 * written on. */
void rg_canvas_draw(rg_canvas *c, int32_t corners, int32_t x, int32_t y, int32_t width, int32_t height);

#endif
