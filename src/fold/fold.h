/* fold.h -- the time loop: from flat to folded, one step at a time.
 * Paper    eqs. (10), (14), section 4        Uses  drive.h limit.h project.h        Used by  motion.c */
#ifndef RG_FOLD_H
#define RG_FOLD_H

#include "fold/apart.h"
#include "fold/drive.h"
#include "fold/limit.h"
#include "fold/path.h"
#include "kinematics/project.h"

/* What was spent. */
typedef struct rg_cost {
    int64_t steps, solves, iterations, factorizations, assemblies;
    double seconds;
} rg_cost;

struct rg_fold {
    rg_memory mem;
    rg_settings settings;
    const double *due;            /* see rg_fold_set_due */
    rg_mesh mesh;
    rg_constraint K;
    rg_drive drive;
    rg_limit limit;
    rg_apart apart;               /* the folds of its components; with any, of what follows only the state and the end are used */
    rg_fold *self;
    rg_project P;
    double *rho;                  /* [N] the state: always closed to settings.tol under newton */
    double *trial, *wish, *t;     /* [N] */
    double *pull, *best;          /* [N] */
    double *end;                  /* [N] the folded state that is aimed at */
    double *k[3];                 /* [N] stages of heun and rk4; scratch of adaptive */
    rg_path path;                 /* adaptive: the nodes; the state lags behind the last one */
    double h;                     /* and the next step from there */
    int one_way;                  /* as far as is known, the sheet can go one way only */
    int32_t order;                /* of Adams and Bashforth's formula, where it can go several ways */
    int smooth, path_ended;       /* steps are adaptive ones; and there is no way on from the last node for them */
    int64_t nodes;                /* made by them */
    double s, s_end, ds;          /* progress, where to stop, size of the next step in s */
    int end_is_closed;            /* the folded state closes to tolerance: land on it exactly */
    int32_t frame;                /* the next frame to reach */
    int32_t steps;
    int graded;                   /* the caller keeps ds below a part of what lies behind and before the state */
    int32_t idle;                 /* steps since a frame was reached or ... */
    double idle_s;                /* ... progress was made, from there */
    int64_t assemblies;
    double moved;                 /* the farthest that a crease may have gone since the last factorisation */
    double closure;
    rg_outcome outcome;
    char reason[240];
    double seconds_solving;
};

/* A fold of a mesh, its independent components apart; *m is taken over, also on failure. */
rg_status rg_fold_from_mesh(rg_mesh *m, const rg_settings *s, rg_fold **fold, rg_diag *why);
/* The same as one system, whatever components there are. */
rg_status rg_fold_from_mesh_together(rg_mesh *m, const rg_settings *s, rg_fold **fold, rg_diag *why);

/* The systems that are solved: f itself, or its components. Returns how many. */
int32_t rg_fold_systems(const rg_fold *f, rg_fold *const **system);
/* Of all systems. */
rg_cost rg_fold_cost(const rg_fold *f);
/* That of the system with most creases; never RG_SOLVER_AUTO. */
rg_solver rg_fold_solver(const rg_fold *f);

/* The state is rho now, at progress s. */
void rg_fold_accept(rg_fold *f, const double *rho, double s);
/* It is over, and arrived if every crease is within 1 % of its target. */
void rg_fold_stop(rg_fold *f, const char *why);

/* Frames are due at these progresses, rising, [settings.frames], borrowed; NULL: evenly. Before the first step. */
void rg_fold_set_due(rg_fold *f, const double *due);
/* The progress at which a frame is due. */
double rg_fold_frame_progress(const rg_fold *f, int32_t frame);

/* start.c: leaves the flat state along the branch that mountain and valley ask for. On return f->rho is closed, at
 * progress s1, with as few creases on the wrong side as could be found; RG_FOLDED-like success is non-zero. */
int rg_start_leave_flat(rg_fold *f, double s1);

/* newton.c: works off the residual at f->trial, holding progress at `s`: eq. (14) with the wish along f->t only.
 * Non-zero when closed; f->closure is then the closure of f->trial. */
int rg_newton_correct(rg_fold *f, double s, int32_t most);
/* The same. near: the last factorisation was made so near to f->trial that it will do. t: the direction there, with which
 * progress is held at less cost where a sheet has more creases than equations; NULL: not known. */
int rg_newton_close(rg_fold *f, double s, int32_t most, int near, const double *t);

#endif
