/* run.h -- one fold by one method, one solver, one step size: what it costs and how far off it is.
 * Uses  straight.h        Used by  model.c reference.c relaxed.c */
#ifndef RG_RUN_H
#define RG_RUN_H

#include "fold/straight.h"

/* Beside rg_method's: the relaxed stepper, see relaxed.h. */
#define RG_METHOD_RELAXED ((rg_method)(RG_METHOD_ADAPTIVE + 1))

/* Multiplications of C and r anew over those of a product with C, of which a block has three: two turns of a 3 x 3
 * frame by one angle each, 4 x 3 multiplications a turn, less what the zeros of a turn save. */
enum { RG_ASSEMBLY_PASSES = 6 };

/* How to fold. */
typedef struct rg_way {
    rg_method method;
    rg_solver solver;
    double step, tol; /* radians */
    double grade;     /* a step is at most this part of what is behind and of what is ahead, in s; 0: no such rule */
} rg_way;

/* The frames to compare with. */
typedef struct rg_frames {
    int32_t N, count, room;
    double *rho; /* [room][N] radians; `count` of them are there */
} rg_frames;

typedef struct rg_run {
    rg_way way;
    rg_method method; /* that was used, never AUTO */
    rg_solver solver; /* the same */
    rg_outcome outcome;
    int32_t frames;   /* reached */
    double percent;   /* reached */
    double error;     /* max over frames and creases of |rho - reference|, radians; NAN: nothing to compare with */
    double pattern_error; /* the same of vertices, over the sheet's size; NAN: they stay, or nothing to compare */
    double closure;   /* the largest in a frame, radians */
    double beyond;    /* the most a crease was beyond half a turn in a frame, radians */
    double seconds;   /* of all it takes, the least of several times */
    double passes;    /* the same in products with C, counted */
    int64_t steps, solves, iterations, factorizations, assemblies;
} rg_run;

/* Folds m. with NULL: nothing to compare with; keep NULL, or frames to fill. seconds: of this once. RG_ENOMEM, or what
 * the fold says of the way. */
rg_status rg_run_make(rg_run *r, const rg_mesh *m, const rg_settings *s, const rg_way *way, const rg_frames *with,
                      rg_frames *keep, rg_diag *why);
/* Again and again until its time is known, or `patience` seconds are over. */
rg_status rg_run_time(rg_run *r, const rg_mesh *m, const rg_settings *s, double patience, rg_diag *why);

/* Largest |a - b| over frames that both have. */
double rg_frames_distance(const rg_frames *a, const rg_frames *b);
/* Room for `room` frames of N creases. RG_ENOMEM. Owner: the caller, rg_mem_free(rho). */
rg_status rg_frames_init(rg_frames *f, const rg_memory *mem, int32_t N, int32_t room);

const char *rg_run_method_name(rg_method m);
const char *rg_run_solver_name(rg_solver s);

#endif
