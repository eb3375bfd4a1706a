/* dxf.h -- line segments to AutoCAD's exchange format (R12, text), for cutters.
 * Used by  files/convert.c write/dxffile.c
 *
 * A layer a kind, so that a cutter can be told what to do with each: cut (border and slits, solid), score-mountain
 * (dash dot), score-valley (dashes), score-unassigned (dots), aux (thin dashes). Colours are those of ORIPA today: 3,
 * 1, 5, 6, 8. $INSUNITS is the unit of the file, where it is known. y points up. Dashes are as long as fits the
 * drawing. */
#ifndef RG_SAVE_DXF_H
#define RG_SAVE_DXF_H

#include "base/file.h"
#include "lines/lines.h"
#include <stdio.h>

/* Writes n lines to an open file; metres: in a unit of theirs, 0: not known. */
void rg_dxf_put(FILE *out, const rg_line *line, int32_t n, double metres);
/* Writes all or nothing. Every coordinate reads back as the same double. Lost: targets, titles,
 * and that a line cuts the folded model: it becomes auxiliary. RG_EWRITE, RG_ENOMEM: why->text. */
rg_status rg_dxf_write(const rg_lines *l, const rg_dest *to, rg_diag *why);

#endif
