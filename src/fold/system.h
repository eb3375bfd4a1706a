/* system.h -- one system of creases on its way from flat to folded, straight on: its state, its aim, what it works on.
 * Paper    eqs. (10), (14), section 4        Uses  drive.h limit.h path.h project.h
 * Used by  start.c newton.c integrate.c fixed.c apart.c straight.c */
#ifndef RG_SYSTEM_H
#define RG_SYSTEM_H

#include "fold/drive.h"
#include "fold/limit.h"
#include "fold/path.h"
#include "kinematics/project.h"

typedef struct rg_straight rg_straight;

/* Its independent components, each a system of its own: apart.h. */
typedef struct rg_apart {
    rg_memory mem;
    const struct rg_apart_of *of; /* borrowed */
    int32_t parts;   /* 0: the sheet is in one piece */
    rg_straight **part;  /* [parts] owned */
    int32_t *start;  /* [parts + 1] into crease */
    int32_t *crease; /* [N] by part: which crease of the sheet each of its creases is */
} rg_apart;

/* What was spent. */
typedef struct rg_cost {
    int64_t steps, solves, iterations, factorizations, assemblies;
    double seconds;
} rg_cost;

struct rg_straight {
    rg_memory mem;
    rg_settings settings;
    const double *due;            /* see rg_straight_set_due */
    int32_t most_steps;           /* see rg_straight_set_most_steps */
    rg_mesh mesh;
    rg_constraint K;
    rg_drive drive;
    rg_limit limit;
    /* the folds of its components; with any, of what follows only the state and the end are used */
    rg_apart apart;
    rg_straight *self;
    rg_project P;
    double *rho;                  /* [N] the state: always closed to settings.tol under newton */
    double *trial, *wish, *t;     /* [N] */
    double *pull, *best;          /* [N] */
    double *end;                  /* [N] the folded state that is aimed at */
    double *largest;              /* [N] the most that each has turned at a node, radians */
    double *k[3];                 /* [N] stages of heun and rk4; scratch of adaptive */
    rg_path path;                 /* adaptive: the nodes; the state lags behind the last one */
    double h;                     /* and the next step from there */
    int one_way;                  /* as far as is known, the sheet can go one way only */
    int32_t order;                /* of Adams and Bashforth's formula, where it can go several ways */
    int smooth, path_ended;       /* steps are adaptive ones; and there is no way on from the last node for them */
    int64_t nodes;                /* made by them */
    double s, s_end, ds;          /* progress, where to stop, size of the next step in s */
    double stands;                /* frames up to there stand at a node, as nothing closes before it */
    int end_is_closed;            /* the folded state closes to tolerance: land on it exactly */
    int32_t frame;                /* the next frame to reach */
    int32_t steps;
    int graded;                   /* the caller keeps ds below a part of what lies behind and before the state */
    int32_t idle;                 /* steps since ... */
    double idle_s;                /* ... progress was made, from there */
    int64_t assemblies;
    double moved;                 /* the farthest that a crease may have gone since the last factorisation */
    double closure;
    rg_outcome outcome;
    char reason[240];
    double seconds_solving;
};

/* The state is rho now, at progress s. */
void rg_straight_accept(rg_straight *f, const double *rho, double s);
/* It is over, and arrived if every crease is within 1 % of its target. */
void rg_straight_stop(rg_straight *f, const char *why);

/* The progress at which a frame is due. */
double rg_straight_frame_progress(const rg_straight *f, int32_t frame);

#endif
