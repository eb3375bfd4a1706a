/* ink.h -- the lines of facets: creases in their colours, rims, and outlines wherever the sheet turns away.
 * Uses  seen.h samples.h        Used by  render.c */
#ifndef RG_INK_H
#define RG_INK_H

#include "render/samples.h"
#include "render/seen.h"

/* colour[RG_SAMPLES_INKS]: out. */
void rg_ink_colours(uint64_t *colour);
/* Puts the lines of the facets that meet `here` on a tile, each on its own facet only; where facets are seen through,
 * the lines that lie behind others faintly. */
void rg_ink_draw(const rg_seen *s, const rg_picture *p, rg_box here, const rg_samples *tile);

#endif
