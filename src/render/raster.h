/* raster.h -- which triangle is nearest at each sample, without OpenGL.
 * Uses  gl.h for what a scene is        Used by  canvas.c piled.c print.c */
#ifndef RG_RASTER_H
#define RG_RASTER_H

#include "render/gl.h"

/* As rg_gl_draw has it: what is first wins where depths are the same. A sample that lies on the edge between two
 * triangles is one's only. mark[height][pitch]: out; depth[height][pitch]: scratch. Allocates nothing. */
void rg_raster_draw(const rg_gl_scene *scene, int32_t x, int32_t y, int32_t width, int32_t height, uint32_t *mark,
                    double *depth, int32_t pitch);
/* Every triangle at every sample that it covers, whatever lies before it: takes each row of samples, first ... last -
 * 1, that one of them covers. */
typedef void (*rg_raster_take)(void *ctx, uint32_t mark, int32_t row, int32_t first, int32_t last);
void rg_raster_cover(const rg_gl_scene *scene, int32_t x, int32_t y, int32_t width, int32_t height, rg_raster_take take,
                     void *ctx);

#endif
