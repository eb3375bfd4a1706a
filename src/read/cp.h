/* cp.h -- .cp: one line segment a line, `code x1 y1 x2 y2`, as ORIPA, Orihime, Oriedita and others write it.
 * Used by  read.c
 *
 * Codes: 1 border, 2 mountain, 3 valley, 0 and 4 auxiliary; what other whole numbers there are, those programs take for
 * auxiliary too. They draw with y down: it is turned round here, and the assignments are kept. */
#ifndef RG_CP_H
#define RG_CP_H

#include "lines/lines.h"

/* *out is initialised here; on failure it is left freed. RG_ECANCELLED: by `stop`.
 * RG_EFORMAT: why->line, why->text. A line with a coordinate
 * that is not a finite number is dropped with a warning. */
rg_status rg_cp_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop, rg_lines *out,
                      rg_diag *why);

#endif
