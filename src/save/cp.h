/* cp.h -- line segments to .cp: `code x1 y1 x2 y2`, one a line.
 * Used by  files/convert.c */
#ifndef RG_SAVE_CP_H
#define RG_SAVE_CP_H

#include "base/file.h"
#include "lines/lines.h"

/* Writes all or nothing. Every coordinate reads back as the same double; y points
 * down in the file. Lost: targets, titles, and the difference between unassigned, auxiliary and cut lines, which all
 * become auxiliary (4). RG_EWRITE, RG_ENOMEM: why->text. */
rg_status rg_cp_write(const rg_lines *l, const rg_dest *to, rg_diag *why);

#endif
