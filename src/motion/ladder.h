/* ladder.h -- what a search looks for and has found so far; one try at a rung of its ladder, and which of two is
 * better.
 * Paper    sections 3.1 to 3.4        Uses  attempt.h race.h        Used by  retract.h search.h */
#ifndef RG_LADDER_H
#define RG_LADDER_H

#include "base/race.h"
#include "motion/attempt.h"

/* A way to look for, on the creases as drawn. */
typedef struct rg_problem {
    const rg_mesh *drawn; /* borrowed */
    const double *from;   /* [drawn->N] radians; NULL: flat */
    const double *to;     /* [drawn->N] radians, NAN: none; NULL: the mesh's own targets */
    int end_is_known;     /* non-zero: `to` closes, so that it may be looked for from there */
    int keeps;            /* non-zero: the path of what goes straight on is kept, too */
} rg_problem;

/* So many tries are told of; few searches make more. */
enum { RG_MOST_TRIED = 64 };

typedef struct rg_search {
    rg_attempt best;
    const char *triangulation, *why_triangulated;
    char strategy[160];
    const char *rung, *direction;
    double compliance;
    int32_t tries;        /* rungs up to the one that is kept, and retractions */
    rg_cost cost;         /* of all tries */
    rg_try tried[RG_MOST_TRIED]; /* the first of them */
    int32_t tried_count;
} rg_search;

/* The facets as drawn, or cut: so that inside angles are split, or by the shortest diagonals. Either folds patterns
 * that the other does not. */
typedef enum rg_cut_how { RG_AS_DRAWN, RG_CUT_SPLIT, RG_CUT_SHORT } rg_cut_how;

typedef struct rg_rung {
    const char *name;
    int straight;
    rg_cut_how how;
    rg_relaxation relaxation;
    int backwards;
    double part;       /* of the work that one try may cost */
    rg_effort from;    /* the effort that it takes */
} rg_rung;

enum { RG_MOST_GROUPS = 8 };

/* What all tries of a search share. */
typedef struct rg_ladder {
    const rg_problem *problem;
    const rg_settings *settings;
    rg_watch *watch;           /* of the calling thread */
    int triangles;             /* all facets are triangles as they are */
    int moves;                 /* the pattern may be moved */
    rg_symmetry group[RG_MOST_GROUPS]; /* of the facets as drawn: the largest first, the last of order 1 */
    int32_t groups;
    int32_t *blocked, blocked_count; /* vertices that blocked the first try of all */
    double told;               /* progress, 0 ... 1 */
    const rg_rung *kept;       /* of the try that is kept, and the symmetry: */
    const rg_symmetry *kept_group;
} rg_ladder;

/* One try. */
typedef struct rg_ladder_try {
    const rg_rung *r;
    const rg_symmetry *G;       /* that is kept; NULL: none */
    rg_relaxation how;
    double work;                /* that it may take */
    const unsigned char *which; /* facets to cut; NULL: all */
} rg_ladder_try;

rg_cut_how rg_ladder_cut(const rg_ladder *l, const rg_rung *r);
/* By the rung alone. */
rg_ladder_try rg_ladder_plain(const rg_ladder *l, const rg_rung *r, const rg_symmetry *G);
rg_status rg_ladder_make(const rg_ladder *l, const rg_ladder_try *one, rg_watch *watch, rg_attempt *t, rg_diag *why);
/* The k-th of several at once. *ended: out, the race gave it up, or the watch did. */
rg_status rg_ladder_race(rg_ladder *l, const rg_ladder_try *one, rg_race *race, int32_t k, int in_calling_thread,
                         rg_attempt *t, int *ended, rg_diag *why);
/* How many threads they may take. */
int rg_ladder_workers(const rg_ladder *l);
/* As rg_progress, ctx: the ladder. What is told never runs backwards, whichever try it is of. */
int rg_ladder_tell(void *ladder, double done);
void rg_cost_add(rg_cost *sum, const rg_cost *c);
/* One try that counts. */
void rg_ladder_note(rg_search *q, const rg_ladder_try *one, const rg_attempt *t);

/* It stopped; a crease is past half a turn, or left behind; it ends on another pattern; or all is well. */
enum { RG_STOPS, RG_OVERFOLDED, RG_ELSEWHERE, RG_WELL };
int rg_ladder_rank(const rg_attempt *t);
int rg_ladder_is_better(const rg_attempt *t, const rg_attempt *old);

#endif
