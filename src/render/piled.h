/* piled.h -- what is seen of a sheet that is folded flat: by the order of its layers, not by depth.
 * Uses  seen.h samples.h raster.h layers.h        Used by  render.c
 *
 * Depth can't tell: layers have none, and folded to within a part of a degree facets reach through each other. Nor can
 * a lift for each facet: flaps lie on each other in a circle, as those of a closed box do. But over one place all
 * facets are in one order, and which of two lies above is known. So each sample keeps the uppermost of those that cover
 * it. */
#ifndef RG_PILED_H
#define RG_PILED_H

#include "layers/layers.h"
#include "render/samples.h"
#include "render/seen.h"

/* tile->at: out, the mark of what is seen at each sample, 0: nothing. l: of the sheet that s sees, with an order
 * chosen. Facets that the order says nothing of, as they do not overlap when folded flat, are told apart by depth.
 * Allocates nothing. */
void rg_piled_draw(const rg_layers *l, const rg_seen *s, const rg_gl_scene *scene, const rg_samples *tile);

#endif
