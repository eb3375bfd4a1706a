/* foldfile.h -- the motion as FOLD 1.2: the crease pattern, and every frame of the motion as a frame of the file.
 * Uses  motion.h base/json.h        Used by  output.c
 *
 * The key frame is the crease pattern in 2D with edges_foldAngle as aimed at; creases added by triangulation are 'F'
 * there and true in rigami:edges_added. Each frame of file_frames inherits it and has vertices_coords in 3D,
 * edges_foldAngle, rigami:percent and rigami:closure_residual; where creases were adjusted, also
 * rigami:vertices_flatCoords, the pattern that this frame is folded from. Angles in degrees, valley positive; all
 * numbers read back as the same doubles. */
#ifndef RG_FOLDFILE_H
#define RG_FOLDFILE_H

#include "motion/motion.h"
#include <stdio.h>

/* All frames; `frame` and `p` are not looked at. RG_ENOMEM. */
rg_status rg_foldfile_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
