/* read.h -- a crease pattern file of any format: which one it is, and its lines.
 * Uses  opx.h cp.h fold.h svg.h dxf.h ori.h kinds.h        Used by  files */
#ifndef RG_READ_H
#define RG_READ_H

#include "lines/lines.h"

/* The format of the bytes: by s->format, else by what they begin with, else by the extension of `path` (may be NULL).
 * RG_EFORMAT: none that is known, why->text says what it looks like. */
rg_status rg_read_format(const void *bytes, size_t size, const char *path, const rg_reading *s, rg_format *format,
                         rg_diag *why);
/* The format that a path's extension names; RG_FORMAT_AUTO: none. */
rg_format rg_read_extension(const char *path);

/* Reads the bytes; `path` as above, `keep` as in fold.h. *out is initialised here; on failure it is left freed.
 * RG_EFORMAT: why->line, why->text. RG_ENOMEM, RG_ECANCELLED (s->progress, asked every few milliseconds): why->text
 * too. */
rg_status rg_read_bytes(const void *bytes, size_t size, const char *path, const rg_reading *s, int keep, rg_lines *out,
                        rg_diag *why);
/* The same from a file; "-" is standard input. RG_EREAD: why->text. */
rg_status rg_read_file(const char *path, const rg_reading *s, int keep, rg_lines *out, rg_diag *why);

/* No more is read of a drawing: four million lines as ORIPA writes them; nor of what is no regular file, which may have
 * no end. A motion on a disk may be as long as it is. */
#define RG_MOST_BYTES ((size_t)1 << 30)

/* All bytes of a file, "-" being standard input; *bytes: the caller's, also after a failure. RG_EREAD, RG_ENOMEM,
 * RG_EFORMAT (too large): why->text. */
rg_status rg_read_whole(const char *path, const rg_memory *mem, char **bytes, size_t *size, rg_diag *why);
/* The same of a motion. */
rg_status rg_read_motion(const char *path, const rg_memory *mem, char **bytes, size_t *size, rg_diag *why);

#endif
