/* report.h -- what a motion came to, as JSON; the keys of a pattern are also those of `info`.
 * Uses  base/json.h motion.h        Used by  info.c */
#ifndef RG_REPORT_H
#define RG_REPORT_H

#include "base/json.h"

/* Counts of a pattern as members of the object that is open. */
void rg_report_pattern(rg_json *j, const rg_pattern_info *info);

#endif
