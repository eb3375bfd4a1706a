/* ori.h -- Oriedita's own .ori: JSON with a line segment an entry.
 * Uses  value.h        Used by  read.c
 *
 * A line is {"a": "x,y", "b": "x,y", "color": NAME}, points also as {"x": x, "y": y} or [x, y]. Colours: BLACK_0
 * border, RED_1 mountain, BLUE_2 valley; the others, of which CYAN_3 is the one for it, are auxiliary. Circles, texts
 * and auxiliary lines of their own are no part of the pattern. y points down in the file. Versions v1 and v1.x are
 * known. */
#ifndef RG_ORI_H
#define RG_ORI_H

#include "lines/lines.h"

/* *out is initialised here; on failure it is left freed. RG_ECANCELLED: by `stop`.
 * RG_EFORMAT: why->text begins with the place in the file's tree; why->line. */
rg_status rg_ori_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop, rg_lines *out,
                      rg_diag *why);

#endif
