/* isometry.h -- one sheet, rigid facets, closed vertices, angles that are those of the places, creases on their side, a
 * steady path. Uses  record.h faults.h        Used by  certificate.c */
#ifndef RG_ISOMETRY_H
#define RG_ISOMETRY_H

#include "verify/faults.h"
#include "verify/record.h"

typedef struct rg_isometry {
    double sheet;    /* the farthest that a frame's border is off the border given, over the sheet's size */
    double rigid;    /* the farthest that a corner is off its facet as placed, over the sheet's size */
    double closed;   /* the largest rotation left round an inner vertex, radians */
    double angle;    /* the largest difference of an angle to the places, radians */
    double leap;     /* the largest change of a mountain or valley from one frame to the next, radians */
    int32_t open;    /* creases without a target that end on the other side of flat than their letters say */
    double wrong;    /* the most that a crease is on the wrong side of flat on the way, radians */
} rg_isometry;

/* Is the pattern one sheet, its facets side by side? Fills r->side. The rest makes sense only if so: returns zero if
 * not. RG_ENOMEM. */
rg_status rg_isometry_pattern(rg_record *r, rg_faults *all, int *whole);
/* Everything about frames but contact. RG_ENOMEM. */
rg_status rg_isometry_frames(const rg_record *r, rg_faults *all, rg_isometry *found);

#endif
