/* print.h -- the colours of samples one by one: a picture printed on the paper, and paper that light goes through.
 * Uses  seen.h samples.h raster.h        Used by  frames.c render.c key.c */
#ifndef RG_PRINT_H
#define RG_PRINT_H

#include "render/samples.h"
#include "render/seen.h"
#include "mesh/triangles.h"

/* Pixels of 4 bytes, red, green, blue and how opaque, top row first; the pattern's box is stretched over it. */
typedef struct rg_print {
    const unsigned char *rgba;
    int32_t width, height;
} rg_print;

/* colour[]: out, where there is a piece, of the sheet with that picture on its front.
 * rgb: what is behind, as for rg_samples_mean. */
void rg_print_paint(const rg_print *print, const rg_seen *s, const rg_shot *shot, const rg_triangles *t,
                    const rg_picture *p, const rg_samples *tile);
/* Each sample by all facets that lie over it: a part p->see_through of the light passes each of them. Which is in front
 * makes no difference. scene: of the tile; count[]: scratch, as many as samples. */
void rg_print_see_through(const rg_seen *s, const rg_gl_scene *scene, const rg_picture *p, const rg_samples *tile,
                          uint32_t *count, const unsigned char *rgb, size_t stride);

#endif
