/* opx.h -- ORIPA's .opx: a Java bean, written as XML by two dialects of Java's encoder.
 * Paper    section 4 ("crease pattern data is given in ORIPA format")        Uses  xml.h        Used by  read.c
 *
 * Java 6 and older write <void property="lines">, Java 7 and newer <void method="getField"><string>lines</string>. A
 * property that has its default, 0, is not written; an entry of an array that is null is left out, so that its index
 * counts and not its place. y points down in the file: it is turned round here and the assignments are kept, which is
 * the same paper seen from its front. */
#ifndef RG_OPX_H
#define RG_OPX_H

#include "lines/lines.h"

/* *out is initialised here; on failure it is left freed. RG_ECANCELLED: by `stop`.
 * RG_EFORMAT: why->line, why->text. A line with a coordinate that is
 * not a finite number is dropped with a warning. Loads nothing from anywhere, expands no entities. */
rg_status rg_opx_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop, rg_lines *out,
                      rg_diag *why);

#endif
