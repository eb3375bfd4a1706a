/* say.h -- what the program says on standard error, and how it ends.
 * Used by  every command */
#ifndef SAY_H
#define SAY_H

#include "rigami.h"

/* The whole of what the program may end with. */
enum { ENDS_WELL = 0, ENDS_SHORT = 1, ENDS_USAGE = 2, ENDS_UNWRITTEN = 3 };

/* One line: "rigami: " and a printf-style message, control characters shown as '?'. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void say(const char *format, ...);
/* `text` on one line, as say() shows it: in `room` bytes, which are returned. */
const char *say_plain(const char *text, char *plain, size_t room);
/* "rigami: FILE:LINE: what is wrong", without the line where there is none and without the file if that is NULL or
 * the words begin with it. Returns the exit status that `s` stands for. */
int say_status(rg_status s, const char *file, const rg_diag *why);
/* The same where a motion is read: for what is none, what one is. */
int say_no_motion(rg_status s, const char *file, const rg_diag *why);
/* The same for a warning. */
void say_warning(const char *file, const rg_diag *what);

#endif
