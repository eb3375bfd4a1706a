/* svg.h -- line segments to a drawing in the colours of Origami Simulator.
 * Used by  files/convert.c
 *
 * Border black, mountain red, valley blue, auxiliary yellow, unassigned magenta, lines that cut the folded model gray;
 * a fold angle that is not 180 degrees is the opacity. y points down in the file. */
#ifndef RG_SAVE_SVG_H
#define RG_SAVE_SVG_H

#include "base/file.h"
#include "lines/lines.h"

/* Writes all or nothing. Every coordinate reads back as the same double. Lost:
 * targets of unassigned lines, editor and reference. RG_EWRITE, RG_ENOMEM: why->text. */
rg_status rg_svg_write(const rg_lines *l, const rg_dest *to, rg_diag *why);

#endif
