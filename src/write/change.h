/* change.h -- the rectangle of a picture in which it is not like the one before.
 * Used by  gif.c apng.c */
#ifndef RG_CHANGE_H
#define RG_CHANGE_H

#include <stddef.h>
#include <stdint.h>

typedef struct rg_change { int32_t left, top, width, height; } rg_change;

/* Pictures of `bytes` bytes a pixel, width and height above 0. before NULL: all of it. Where nothing changed it is the
 * first pixel: animations have no empty frames. */
rg_change rg_change_find(const unsigned char *now, const unsigned char *before, int32_t width, int32_t height,
                         int bytes);

#endif
