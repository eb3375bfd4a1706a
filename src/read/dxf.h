/* dxf.h -- .dxf: LINE, LWPOLYLINE and POLYLINE of AutoCAD's exchange format, as text.
 * Uses  colour.h        Used by  read.c
 *
 * The assignment goes by the layer's name where that says it (mountain, valley, cut, border, aux ...), else by colour:
 * the line's own or its layer's. Curves are refused. y points up in the file. */
#ifndef RG_DXF_H
#define RG_DXF_H

#include "read/lines.h"

/* *out is initialised here; on failure it is left freed. RG_EFORMAT: why->line, why->text. */
rg_status rg_dxf_read(const void *bytes, size_t size, const rg_memory *mem, rg_lines *out, rg_diag *why);

#endif
