/* chord.h -- what lies between two nodes of a path: the points of their chord, closed at their part of the progress.
 * Uses  relaxation.h closing.h        Used by  relax.c attempt.c frames.c relaxed.c
 *
 * Closing changes the less the nearer a point is to a node, and creases may go as far past half a turn as at the nodes
 * and no farther. So the path is continuous, comes to every node, and depends on nothing but these two. */
#ifndef RG_CHORD_H
#define RG_CHORD_H

#include "fold/relaxation.h"

/* Largest change of a crease from a to b, radians. */
double rg_chord_size(const rg_relax *F, const double *a, const double *b);
/* Does the path between the closed states a[n] and b[n] stay on their branch, smoothly? Where that is not shown they
 * are too far apart. spare: scratch for RG_CHORD_SPARE states. */
enum { RG_CHORD_SPARE = 7 };
int rg_chord_holds(rg_relax *F, const double *a, const double *b, double *spare);
/* z[n]: out, the state of the path at progress s, within the nodes there are. Depends on the nodes on either side
 * alone.
 * Returns its closure, radians; NAN: none was found. Allocates nothing. */
double rg_chord_at(rg_relax *F, double s, double *z);

#endif
