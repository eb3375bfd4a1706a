/* cp.h -- line segments to .cp: `code x1 y1 x2 y2`, one a line.
 * Used by  files/convert.c */
#ifndef RG_SAVE_CP_H
#define RG_SAVE_CP_H

#include "lines/lines.h"

/* Writes the file whole or not at all; "-" is standard output. Every coordinate reads back as the same double; y points
 * down in the file. Lost: targets, titles, and the difference between unassigned, auxiliary and cut lines, which all
 * become auxiliary (4). RG_EWRITE, RG_ENOMEM: why->text. */
rg_status rg_cp_write(const rg_lines *l, const char *path, rg_diag *why);

#endif
