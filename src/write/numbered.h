/* numbered.h -- file names with the frame's number in them: name-%04d.png.
 * Uses  base        Used by  film.c output.c */
#ifndef RG_NUMBERED_H
#define RG_NUMBERED_H

#include "rigami.h"

typedef struct rg_numbered {
    const char *path;
    int before, digits; /* characters before the number; its least digits, 0 ... 9 */
    const char *after;
} rg_numbered;

/* Looks for %d or %04d (any digit for the 4) in the last part of a path; borrows `path`. Returns how many there are:
 * with one, *n says where it is. A % of another kind is part of the name. */
int rg_numbered_find(const char *path, rg_numbered *n);
/* Bytes that a name takes, with its end. */
size_t rg_numbered_room(const rg_numbered *n);
void rg_numbered_name(const rg_numbered *n, int32_t frame, char *name, size_t room);

#endif
