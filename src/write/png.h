/* png.h -- one picture as PNG.
 * Uses  base        Used by  write */
#ifndef RG_PNG_H
#define RG_PNG_H

#include "base/memory.h"
#include <stdio.h>

#define RG_PNG_SOFTWARE "rigami" /* what each file says that it was made by, near its beginning */
#define RG_PNG_EFFORT 3          /* zlib's: more takes twice as long, for pictures a fifth smaller */

/* rgb: height rows of width pixels of 3 bytes, top row first. The same picture gives the same bytes. run: a word that
 * says what it is of, "tEXtRun" NUL `run`, near its beginning after the program's name; NULL: none. RG_EWRITE:
 * why->text says why; the file is then of no use. RG_ENOMEM. The file stays open and the caller's. */
rg_status rg_png_write(FILE *file, int32_t width, int32_t height, const unsigned char *rgb, const char *run,
                       rg_diag *why);

/* rgba: out, height rows of width pixels of 4 bytes, top row first; owner: the caller, rg_mem_free. RG_EREAD: no such
 * file, or no PNG, why->text says what; RG_ENOMEM. */
rg_status rg_png_read(const rg_memory *mem, const char *path, int32_t *width, int32_t *height, unsigned char **rgba,
                      rg_diag *why);

/* The file's own bytes, once it is known to be such a picture. bytes: out, owner: the caller, rg_mem_free. As above. */
rg_status rg_png_load(const rg_memory *mem, const char *path, unsigned char **bytes, size_t *n, rg_diag *why);

#endif
