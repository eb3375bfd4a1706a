/* places.h -- steps of a sheet of rigid triangles by where its vertices go, instead of by its fold angles.
 * Paper    Fig. 1, eqs. (14), (19)        Uses  linkage.h rows.h        Used by  nearest.c
 *
 * Along the tree of linkage.h a vertex hangs on every crease of its way to the root, so a row that says how two
 * vertices move against each other is full. By places such a row has the numbers of its vertices only. Unknowns (dp,
 * du'): the velocity of each vertex, and of the pattern, du = scale du'. Triangles are rigid where edges keep their
 * length, eq. (14) and (19) in other words:
 *
 *     edge i j     (p_i - p_j) . (dp_i - dp_j) = (X_i - X_j) . (dX_i - dX_j)
 *     root         dp_i = R dX_i
 *
 * and a fold angle is a function of the four corners of its two facets: with the unit normals n of both, heights h of
 * their third corners over the crease and t how far along it these stand,
 *     drho = n . dp / h of both third corners, less the same (1 - t, t) of the ends
 * Bridson, Marino, Fedkiw, Simulation of clothing with folds and wrinkles, 2003. */
#ifndef RG_PLACES_H
#define RG_PLACES_H

#include "linalg/rows.h"
#include "unfold/linkage.h"

static inline int32_t rg_places_count(const rg_linkage *P) { return 3 * P->mesh->nv + P->U; }

/* Where the linkage is put now: fold[N]: drho / scale of each crease; rigid: what is 0 while facets stay rigid.
 * scale[n] as that of nearest.h. RG_ENOMEM. */
rg_status rg_places_rows(const rg_linkage *P, const double *scale, rg_rows *fold, rg_rows *rigid);

#endif
