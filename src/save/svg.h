/* svg.h -- line segments to a drawing in the colours of Origami Simulator.
 * Used by  files/convert.c
 *
 * Border black, mountain red, valley blue, auxiliary yellow, unassigned magenta, lines that cut the folded model gray;
 * a fold angle that is not 180 degrees is the opacity. y points down in the file. */
#ifndef RG_SAVE_SVG_H
#define RG_SAVE_SVG_H

#include "lines/lines.h"

/* Writes the file whole or not at all; "-" is standard output. Every coordinate reads back as the same double. Lost:
 * targets of unassigned lines, editor and reference. RG_EWRITE, RG_ENOMEM: why->text. */
rg_status rg_svg_write(const rg_lines *l, const char *path, rg_diag *why);

#endif
