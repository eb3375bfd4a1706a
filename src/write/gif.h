/* gif.h -- an animation as GIF: one palette, and of each picture only what changed.
 * Uses  palette.h        Used by  film.c */
#ifndef RG_GIF_H
#define RG_GIF_H

#include "write/palette.h"
#include <stdio.h>

typedef struct rg_gif rg_gif;

/* The colours chosen in *p, which has to stay and is used. for_ever: it goes round, else it is shown once. fps above 50
 * is shown as 50: shorter delays are not kept by viewers. RG_EWRITE, RG_ENOMEM: why->text says why; the file is then of
 * no use. It stays open and the caller's. Owner: the caller, rg_gif_destroy (NULL is fine). */
rg_status rg_gif_create(const rg_memory *mem, FILE *file, int32_t width, int32_t height, double fps, int for_ever,
                        rg_palette *p, rg_gif **gif, rg_diag *why);
/* rgb: rows of pixels of 3 bytes, top row first. times: how long it is shown, over what fps says. */
rg_status rg_gif_add(rg_gif *g, const unsigned char *rgb, double times, rg_diag *why);
/* The end of the file; nothing can be added after it. */
rg_status rg_gif_finish(rg_gif *g, rg_diag *why);
void rg_gif_destroy(rg_gif *g);

#endif
