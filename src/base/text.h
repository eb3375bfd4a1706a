/* text.h -- printf for people's eyes, the same whatever locale the caller has set.
 * Used by  every file that puts a number into a sentence.  Thread safety: changes the locale of the calling thread
 * alone, while it prints. */
#ifndef RG_TEXT_H
#define RG_TEXT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#if defined(__GNUC__)
#define RG_FORMAT_AT(n) __attribute__((format(printf, n, n + 1)))
#else
#define RG_FORMAT_AT(n)
#endif

/* As snprintf, vsnprintf and fprintf. */
int rg_text(char *text, size_t room, const char *format, ...) RG_FORMAT_AT(3);
int rg_text_with(char *text, size_t room, const char *format, va_list args);
int rg_text_to(FILE *out, const char *format, ...) RG_FORMAT_AT(2);

/* What a file says, in one line: as rg_status_one_line has it. */
void rg_text_shown(FILE *out, const char *text);

#endif
