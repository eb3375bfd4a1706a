/* build.h -- from the lines of a file to the pattern that is folded, and what is known of it.
 * Uses  pattern.h        Used by  overlay.c files/pattern.c */
#ifndef RG_BUILD_H
#define RG_BUILD_H

#include "pattern/pattern.h"

/* Takes over *lines (also on failure, where it is freed). */
rg_status rg_pattern_from_lines(rg_lines *lines, const rg_reading *s, rg_pattern **pattern, rg_diag *why);

#endif
