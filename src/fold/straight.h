/* straight.h -- straight on: the time loop from flat to folded on the pattern given, one step at a time.
 * Paper    eqs. (10), (14), section 4        Uses  system.h        Used by  run.c steer.c attempt.c diagnose.c rest.c
 *
 * Creases that no vertex joins are systems of their own, in step frame by frame; one that is held does not hold the
 * others. */
#ifndef RG_STRAIGHT_H
#define RG_STRAIGHT_H

#include "fold/system.h"

/* Takes a copy of what it needs of the pattern. RG_ESHEET: not one sheet without holes, why->text says where;
 * RG_ENOMEM, RG_EABSENT. Owner: the caller, rg_straight_destroy. */
rg_status rg_straight_create(const rg_pattern *p, const rg_settings *s, rg_straight **fold, rg_diag *why);
void rg_straight_destroy(rg_straight *f);
/* One step of the time loop; allocates nothing. A run that cannot go on is no error: info->outcome is RG_STOPPED. */
rg_status rg_straight_step(rg_straight *f, rg_step_info *info);
/* A fold of a mesh, its independent components apart; *m is taken over, also on failure. */
rg_status rg_straight_from_mesh(rg_mesh *m, const rg_settings *s, rg_straight **fold, rg_diag *why);
/* The same as one system, whatever components there are. */
rg_status rg_straight_from_mesh_together(rg_mesh *m, const rg_settings *s, rg_straight **fold, rg_diag *why);

/* The systems that are solved: f itself, or its components. Returns how many. */
int32_t rg_straight_systems(const rg_straight *f, rg_straight *const **system);
/* Of all systems. */
rg_cost rg_straight_cost(const rg_straight *f);
/* largest[N]: out, the most that each crease has turned at a node of the path, radians. */
void rg_straight_largest(const rg_straight *f, double *largest);
/* That of the system with most creases; never RG_SOLVER_AUTO. */
rg_solver rg_straight_solver(const rg_straight *f);

/* Frames are due at these progresses, rising, [settings.frames], borrowed; NULL: evenly. Before the first step. */
void rg_straight_set_due(rg_straight *f, const double *due);
/* One system stands at rho, closed, at progress s, and goes on from there step by step; the next frame is `frame`. */
void rg_straight_stand(rg_straight *f, const double *rho, double s, int32_t frame);
/* rho[N]: out, the state at progress s, a little before the frame that was made last; between frames the way stays as
 * it is. Zero: it is not known. Allocates nothing. */
int rg_straight_between(rg_straight *f, double s, double *rho);
/* It gives up after so many steps; 0: only where it creeps, or after very many. */
void rg_straight_set_most_steps(rg_straight *f, int32_t most);
#endif
