/* csv.h -- fold angles as a table: a row a frame, a column a crease, degrees.
 * Uses  motion.h        Used by  output.c
 *
 * The first row says what the columns are: frame, percent, and the creases: "c0_M 4-5 (0.5 0)-(0.5 1) target -180" is
 * number 0 of the report, a mountain from vertex 4 to vertex 5, between these points of the file, aimed at -180
 * degrees; "added" ends what triangulation added. */
#ifndef RG_CSV_H
#define RG_CSV_H

#include "motion/motion.h"
#include <stdio.h>

/* All frames; `frame` and `p` are not looked at. RG_OK: what could not be written shows at the file's commit. */
rg_status rg_csv_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
