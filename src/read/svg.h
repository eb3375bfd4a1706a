/* svg.h -- .svg: a drawing, with assignments by colour and fold angles by opacity.
 * Uses  paint.h xml.h        Used by  read.c
 *
 * line, polyline, polygon, rect and straight paths that are stroked, in g, a, switch and svg with any transforms, and
 * what use repeats of them and of symbols; styles as attributes, in style="" and in <style>. Curves are refused, as
 * paper folds along straight lines only, and so is a use that repeats itself. An opacity below 1 is a fold angle, as a
 * part of 180 degrees. y points down in the file. Ends miss each other by more than elsewhere, as drawing programs
 * round to thousandths: rg_lines.merge says so. */
#ifndef RG_SVG_H
#define RG_SVG_H

#include "lines/lines.h"

/* settings: targets (opacities are fold angles), kind. *out is initialised here; on failure it is left freed.
 * RG_EFORMAT:
 * why->line, why->text. Loads nothing from anywhere. */
rg_status rg_svg_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop,
                      const rg_reading *s, rg_lines *out, rg_diag *why);

#endif
