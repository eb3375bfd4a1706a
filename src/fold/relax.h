/* relax.h -- the relaxed stepper: folding where fold angles alone cannot go, the creases roll through the sheet as
 * well.
 * Paper    eqs. (14), (19) as one system; section 3.3; both penalties of section 4
 * Uses  relaxation.h        Used by  attempt.c diagnose.c
 *
 * Unknowns z = (rho, u): fold angles, and the ways in which the vertices of the pattern may move. Every step projects a
 * wish,
 *
 *     dz = dz0 - W A^T (A W A^T)^+ (A dz0 + r),      W = diag(1 for a crease, (w l_v)^2 for a way of vertex v),
 *
 * l_v^2 the shortest crease at v squared, times what is left of what the facets round v may shrink; w the vertex
 * compliance. Creases at half a turn are held there, and where the projected wish would lose progress, progress is one
 * more row of A. A step is taken when it closes, stays on the branch that it came from and keeps the facets; else it is
 * shortened.
 *
 * What was found is a path: nodes, each closed, by rising progress. Between two nodes the path is what closes the
 * points of their chord, so it depends on nothing but them. */
#ifndef RG_RELAX_H
#define RG_RELAX_H

#include "fold/relaxation.h"

/* m's arrays are borrowed. from[N] NULL: flat. target[N]: NAN: none. Both are copied; `from` closes. RG_ENOMEM. Owner:
 * the caller, rg_relax_free. *F must stay where it is. */
rg_status rg_relax_init(rg_relax *F, const rg_mesh *m, const rg_settings *s, const rg_relaxation *how,
                        const double *from, const double *target);
/* Every step is to have the symmetry G, borrowed, on the mesh; before the first one. RG_ENOMEM. */
rg_status rg_relax_keep(rg_relax *F, const rg_symmetry *G);
void rg_relax_free(rg_relax *F);
/* One step, of which F->s tells the progress. Allocates nothing. */
void rg_relax_step(rg_relax *F);
/* One that waits runs on, for so much more work. */
void rg_relax_go_on(rg_relax *F, double work);
/* What a full step from the state wishes for, F->wish, and is let, F->dz; F->J.A.y: how hard each row resists. */
void rg_relax_wish_and_step(rg_relax *F);

#endif
