/* caption.h -- a line of text at the lower edge of a picture.
 * Used by  camera.c frames.c */
#ifndef RG_CAPTION_H
#define RG_CAPTION_H

#include <stdint.h>

/* left: at the lower left, right: at the lower right, cut off where there is no room for both. ASCII; what is none is a
 * question mark. ink: the colour. rgb: in and out, rows of pixels of 3 bytes, top row first. */
void rg_caption_draw(const char *left, const char *right, const unsigned char ink[3], int32_t width, int32_t height,
                     unsigned char *rgb);
/* Rows of pixels that it takes from the bottom of such a picture. */
int32_t rg_caption_height(int32_t width, int32_t height);
/* White or near black, whichever is read better on that background. */
void rg_caption_ink(const unsigned char background[3], unsigned char ink[3]);

#endif
