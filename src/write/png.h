/* png.h -- one picture as PNG, and the parts that an animation shares.
 * Uses  deflate.h        Used by  film.c apng.c */
#ifndef RG_PNG_H
#define RG_PNG_H

#include "base/memory.h"
#include <stdio.h>

#define RG_PNG_SOFTWARE "rigami" /* what each file says that it was made by, near its beginning */

/* rgb: height rows of width pixels of 3 bytes, top row first. The same picture gives the same bytes.
 * RG_EWRITE: why->text says why; the file is then of no use. RG_ENOMEM. The file stays open and the caller's. */
rg_status rg_png_write(const rg_memory *mem, FILE *file, int32_t width, int32_t height, const unsigned char *rgb,
                       rg_diag *why);

/* The signature, and what is to be known of pictures of that size. RG_EWRITE. */
rg_status rg_png_begin(FILE *file, int32_t width, int32_t height, rg_diag *why);
/* A chunk with n bytes of data. RG_EWRITE. */
rg_status rg_png_chunk(FILE *file, const char kind[4], const unsigned char *data, size_t n, rg_diag *why);
/* x as so many bytes, the highest first; returns the place after them. */
unsigned char *rg_png_number(unsigned char *to, uint32_t x, int bytes);

#endif
