/* dxf.h -- .dxf: LINE, LWPOLYLINE, POLYLINE and INSERT of AutoCAD's exchange format, as text.
 * Uses  colour.h affine.h        Used by  read.c
 *
 * The assignment goes by the layer's name where that says it (mountain, valley, cut, border, aux ...), else by colour:
 * the line's own or its layer's. In a block, colour 0 and layer 0 are those of the INSERT. Curves are refused, and so is a
 * block that repeats itself; what is on the paper of a layout is left out. y points up in the file. */
#ifndef RG_DXF_H
#define RG_DXF_H

#include "read/lines.h"

/* *out is initialised here; on failure it is left freed. RG_EFORMAT: why->line, why->text. */
rg_status rg_dxf_read(const void *bytes, size_t size, const rg_memory *mem, rg_lines *out, rg_diag *why);

#endif
