/* convert.h -- lines, wherever they come from, to a file of any format that is written.
 * Uses  save, pattern/planar.h        Used by  example.c */
#ifndef RG_CONVERT_H
#define RG_CONVERT_H

#include "base/file.h"
#include "lines/lines.h"

/* Whether a format is one that crease patterns are written in; else RG_EARG, named by `out`, the path asked for. */
rg_status rg_convert_check(rg_format f, const char *out, rg_diag *why);
/* Takes the lines over, also on failure. `warn` is told what the format cannot hold; NULL: nobody. RG_ENOMEM,
 * RG_EWRITE, RG_ECANCELLED. */
rg_status rg_convert_lines(rg_lines *l, rg_format format, const rg_reading *r, const rg_dest *to, rg_warning warn,
                           void *ctx, rg_diag *why);

#endif
