/* drawing.h -- a pattern being drawn: lines in units of its own, then fitted to a sheet.
 * Uses  lines/lines.h        Used by  every file of this room */
#ifndef RG_DRAWING_H
#define RG_DRAWING_H

#include "lines/lines.h"

typedef struct rg_sketch {
    rg_lines *lines;
    int32_t n, m;     /* as asked for, already in the kind's range */
    double angle;     /* radians, the same */
    rg_status status; /* the first failure; what is drawn after it is dropped */
} rg_sketch;

/* Lines may meet at their ends only: then the file is the plane graph, and any program reads the same one. */
void rg_drawing_line(rg_sketch *d, rg_vec2 a, rg_vec2 b, char assignment);
/* The lines b[0] - b[1] - ... - b[count - 1], all of one assignment. */
void rg_drawing_path(rg_sketch *d, const rg_vec2 *b, int32_t count, char assignment);
/* Scales and moves it so that it is centred on the origin: what is 1 as drawn is then `cell` or, where that is 0, the
 * longer side is `side`, or that of ORIPA's sheet, 400. */
void rg_drawing_fit(rg_sketch *d, double side, double cell);

static inline char rg_opposite(char assignment) { return assignment == RG_MOUNTAIN ? RG_VALLEY : RG_MOUNTAIN; }

/* Where the line through a in direction u meets the line through b in direction v; they must not be parallel. */
static inline rg_vec2 rg_meet(rg_vec2 a, rg_vec2 u, rg_vec2 b, rg_vec2 v)
{
    const double t = rg_vec2_cross(rg_vec2_sub(b, a), v) / rg_vec2_cross(u, v);
    return (rg_vec2){a.x + t * u.x, a.y + t * u.y};
}

#endif
