/* gaps.h -- states between the frames of a motion, where these are too far apart to say how one comes from the other.
 * Uses  mesh.h        Used by  attempt.h assemble.c forth.c keeping.c motion.h unfolding.c, write
 *
 * How many frames are asked for says how a motion is shown. What it is, and whether it passes through itself, must not
 * depend on that: it is looked at in its frames and in these states, read off the same path, so many that from one to
 * the next no crease turns by more than a few degrees. A file has them too, so that whoever checks it sees the same. */
#ifndef RG_GAPS_H
#define RG_GAPS_H

#include "mesh/mesh.h"

/* What gives a state: rho[N], X[nv], at a progress of the path. Zero: it is not known there. */
typedef int rg_path_reader(void *ctx, double progress, double *rho, rg_vec2 *X);

typedef struct rg_gaps {
    int32_t count;
    int32_t *after; /* [count] the frame that each comes after, rising */
    double *rho;    /* [count][N] */
    rg_vec2 *flat;  /* [count][nv] the pattern of each; NULL: the mesh's own in all of them */
    size_t room[3];
} rg_gaps;

void rg_gaps_free(rg_gaps *g, const rg_memory *mem);
/* One more, copied; X NULL: the mesh's own pattern, in all or in none. RG_ENOMEM. */
rg_status rg_gaps_add(rg_gaps *g, const rg_memory *mem, const rg_mesh *m, int32_t after, const double *rho,
                      const rg_vec2 *X);
/* Fold angles and pattern of the j-th. */
const double *rg_gaps_angles(const rg_gaps *g, const rg_mesh *m, int32_t j);
const rg_vec2 *rg_gaps_pattern(const rg_gaps *g, const rg_mesh *m, int32_t j);

/* The most that one of N creases turns from a to b, radians. */
double rg_gaps_turn(int32_t N, const double *a, const double *b);
/* The crease that does. */
int32_t rg_gaps_leader(int32_t N, const double *a, const double *b);
/* `ways` even ways make up `whole` of a path on which something turns by `angle`: into how many even parts each of them
 * is to be cut. */
int32_t rg_gaps_parts(int32_t ways, double whole, double angle);

/* What reads them off a path. */
typedef struct rg_gap_filler {
    rg_memory mem;
    const rg_mesh *m;     /* borrowed */
    rg_gaps *gaps;        /* borrowed: where they go */
    rg_path_reader *read;
    void *ctx;
    int moves;            /* non-zero: states have patterns of their own */
    double *rho;          /* scratch */
    rg_vec2 *flat;
} rg_gap_filler;

/* RG_ENOMEM. Owner: the caller, rg_gap_filler_free, also after a failure. */
rg_status rg_gap_filler_init(rg_gap_filler *q, const rg_memory *mem, const rg_mesh *m, rg_gaps *g, int moves,
                             rg_path_reader *read, void *ctx);
void rg_gap_filler_free(rg_gap_filler *q);
/* Those that are needed between frame `after`, a[N] at progress s0, and the next one, b[N] at s1. RG_ENOMEM. */
rg_status rg_gap_fill(rg_gap_filler *q, int32_t after, double s0, const double *a, double s1, const double *b);

#endif
