/* file.h -- output files that appear whole or not at all.
 * Used by  save, generate, write */
#ifndef RG_FILE_H
#define RG_FILE_H

#include "base/memory.h"
#include <stdio.h>

typedef struct rg_file {
    rg_memory mem;
    FILE *stream;     /* write here; buffered, binary */
    char *path, *temporary; /* temporary NULL: written in place (standard output, a device, a pipe) */
} rg_file;

/* Opens a file beside `path` to write into; "-" is standard output. What is no regular file is written in place, a
 * symbolic link is followed. RG_EWRITE: why->text says what and why, why->line is 0; RG_ENOMEM. */
rg_status rg_file_begin(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why);
/* Puts it in the place of `path`. RG_EWRITE: something could not be written, now or before; `path` is as it was. */
rg_status rg_file_commit(rg_file *f, rg_diag *why);
/* Throws it away; harmless after commit and on a zeroed struct. */
void rg_file_abandon(rg_file *f);

#endif
