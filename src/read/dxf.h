/* dxf.h -- .dxf: LINE, LWPOLYLINE, POLYLINE, 3DFACE and INSERT of AutoCAD's exchange format, as text.
 * Uses  colour.h kinds.h space.h tables.h        Used by  read.c
 *
 * The assignment goes by the layer's name where that says it (mountain, valley, cut, border, aux ...), else by colour:
 * the line's own or its layer's. In a block, colour 0 and layer 0 are those of the INSERT. Facets of meshes are read as
 * lines.
 * Curves are refused where they are creases or border, and so is a block that repeats itself; layers that are off or
 * frozen, what is on the paper of a layout, and entities that are no lines, are left out and told. Drawings in space
 * lie in one plane.
 * y points up in the file. */
#ifndef RG_DXF_H
#define RG_DXF_H

#include "lines/lines.h"

/* settings: kind, merge. *out is initialised here; on failure it is left freed. RG_EFORMAT: why->line, why->text. */
rg_status rg_dxf_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop,
                      const rg_reading *s, rg_lines *out, rg_diag *why);

#endif
