/* locate.h -- the lines of a JSON text that its values stand in, for messages: a parser keeps none.
 * Used by  fold.c ori.c files/motion.c */
#ifndef RG_LOCATE_H
#define RG_LOCATE_H

#include <stddef.h>
#include <stdint.h>

/* The line of the value at a path like frames[3].edges[0], or of the last one on the way that there is. The text is
 * JSON that a parser took; "" is its whole. */
int32_t rg_locate_line(const char *text, size_t size, const char *path);
/* The same of the path that a message begins with, up to ": ". */
int32_t rg_locate_told(const char *text, size_t size, const char *message);
/* Those of the first n elements of the list at that path; what is not there is left as it is. */
void rg_locate_lines(const char *text, size_t size, const char *path, int32_t *line, int32_t n);

#endif
