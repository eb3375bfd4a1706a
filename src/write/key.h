/* key.h -- a number that two runs have in common if they draw the same pictures.
 * Uses  motion.h print.h        Used by  film.c */
#ifndef RG_KEY_H
#define RG_KEY_H

#include "motion/motion.h"
#include "render/print.h"

enum { RG_KEY_ROOM = 17 };
/* Of all that a frame's picture depends on: this program's version, the motion, the picture, what is printed on the
 * paper (NULL: nothing). text: out, 16 hexadecimal digits. Returns `text`. */
const char *rg_key_of(const rg_motion *m, const rg_picture *p, const rg_print *print, char text[RG_KEY_ROOM]);

#endif
