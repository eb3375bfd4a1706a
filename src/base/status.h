/* status.h -- filling a diagnosis.
 * Used by  readers, pattern, writers */
#ifndef RG_STATUS_H
#define RG_STATUS_H

#include "rigami.h"

/* Writes a printf-style message and a line number (0: none) into *why (may be NULL) and returns `s`, so that a
 * failing branch is one statement: return rg_fail(RG_EFORMAT, why, line, "..."). Long text is cut, and is one line. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
rg_status rg_fail(rg_status s, rg_diag *why, int line, const char *format, ...);

/* Blanks for control characters, and ? for what is no UTF-8, so that what a file says stays one line of a message, and
 * moves no cursor. */
void rg_status_one_line(char *text);

#endif
