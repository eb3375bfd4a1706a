/* track.h -- the path: closed states from flat to the end, or the other way round, and what lies between two of them.
 * Uses  contact.h linkage.h nearest.h        Used by  home.c passage.c unfold.c */
#ifndef RG_TRACK_H
#define RG_TRACK_H

#include "contact/contact.h"
#include "unfold/linkage.h"
#include "unfold/nearest.h"

/* A state whose facets cross deeper (lengths of the sheet) is none: less than what counts as a crossing. */
#define RG_TRACK_WRONG 8e-5

typedef struct rg_track {
    rg_memory mem;
    rg_linkage *P;         /* borrowed */
    rg_nearest *q;         /* borrowed: by it states are closed */
    rg_plates plates;      /* to look at states with code that the steps are not made by */
    rg_contact_work look;
    double *end;           /* [n] the end: fold angles, and the pattern nearest to the one drawn that closes */
    double *z;             /* [count][n] */
    double *progress;      /* [count] 0 flat ... 1 the end */
    size_t z_room, progress_room;
    int32_t count;
    double *scratch, *best; /* [n] */
    rg_vec3 *x;            /* [2][nv] */
} rg_track;

/* No states yet, end all 0. RG_ENOMEM. Owner: the caller, rg_track_free, also after a failure. */
rg_status rg_track_init(rg_track *p, const rg_memory *mem, rg_linkage *P, rg_nearest *q);
void rg_track_free(rg_track *p);

/* How far creases that are driven have come to the end, in the mean. */
double rg_track_progress(const rg_track *p, const double *z);
/* One more state. ctx: the path; as who opens or lands calls it. RG_ENOMEM. */
rg_status rg_track_keep(void *ctx, const double *z);
void rg_track_reverse(rg_track *p);
/* Non-zero: facets cross in the state whose positions are x[nv]. */
int rg_track_crosses(rg_track *p, const rg_vec3 *x);
/* The same anywhere between two states, where frames may be. */
int rg_track_crosses_between(rg_track *p);
/* Steps that are held by rows go back a little at times, and what is read off by progress would leap over that: where a
 * short way leads straight on, and is free, it takes its place. */
void rg_track_rise(rg_track *p);
/* The closed state at a progress between 0 and 1: p->scratch. Between two states it is what closes near the straight
 * way between them. Allocates nothing. */
void rg_track_read(rg_track *p, double progress);

#endif
