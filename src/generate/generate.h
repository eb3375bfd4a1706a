/* generate.h -- example patterns, as line segments.
 * Uses  kinds.h save/opx.h        Used by  files/example.c, tests */
#ifndef RG_GENERATE_H
#define RG_GENERATE_H

#include "lines/lines.h"

/* What rg_generate writes. *out is initialised here, and left freed on failure; its title says what it is. */
rg_status rg_generate_lines(const char *kind, int32_t n, int32_t m, double angle, const rg_memory *mem, rg_lines *out,
                            rg_diag *why);

/* The same in a size and a unit: e->side and e->cell not both. e->format does not count. */
rg_status rg_generate_example(const char *kind, const rg_example *e, const rg_memory *mem, rg_lines *out, rg_diag *why);

#endif
