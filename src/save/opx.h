/* opx.h -- line segments to ORIPA's .opx, as Java 8 encodes its bean.
 * Paper    section 4 ("crease pattern data is given in ORIPA format")        Uses  libxml2        Used by  generate */
#ifndef RG_SAVE_OPX_H
#define RG_SAVE_OPX_H

#include "base/file.h"
#include "lines/lines.h"

/* Writes all or nothing. Every coordinate reads back as the same double; y points down in the file. The format has no
 * place for fold angles: targets are lost. Unassigned lines make it a file of main version 2, which an ORIPA older than
 * 2023 refuses. RG_EARG: a coordinate is not a finite number; RG_EWRITE, RG_ENOMEM: why->text. */
rg_status rg_opx_write(const rg_lines *l, const rg_dest *to, rg_diag *why);

#endif
