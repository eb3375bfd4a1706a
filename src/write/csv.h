/* csv.h -- fold angles as a table: a row a frame, a column a crease, degrees.
 * Uses  motion.h        Used by  output.c
 *
 * The first row names the creases c0_M, c1_V, ...: the crease's number, as the report has it, and its assignment. */
#ifndef RG_CSV_H
#define RG_CSV_H

#include "motion/motion.h"
#include <stdio.h>

/* All frames; `frame` and `p` are not looked at. RG_OK: what could not be written shows at the file's commit. */
rg_status rg_csv_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
