/* fold.h -- FOLD 1.0 to 1.2: one frame of a file, flat, with assignments and fold angles.
 * Uses  value.h locate.h        Used by  read.c
 *
 * Edges are taken from the faces where they are missing, assignments from the signs of the fold angles. Faces of the
 * file run counter-clockwise seen from the front: where they run clockwise, the drawing shows the back, and mountain
 * and valley are exchanged here. 'J' is read as an auxiliary line, 'C' as a border inside the paper. Coordinates in
 * space are read where they lie in one plane; a folded form is told by faces that are turned over, whatever its class.
 * y points up in the file, but for those of programs that draw it downwards (file_creator). */
#ifndef RG_FOLD_READ_H
#define RG_FOLD_READ_H

#include "lines/lines.h"

/* s: file_frame, flip, targets. `keep` non-zero: also lines.frame and lines.vertex. *out is initialised here; on
 * failure it is left freed. RG_EFORMAT: why->text begins with the place in the file's tree, why->line is the line of
 * that place, or of what it is missing in; so are warnings. */
rg_status rg_fold_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop,
                       const rg_reading *s, int keep, rg_lines *out, rg_diag *why);

#endif
