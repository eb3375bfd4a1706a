/* trace.h -- the nodes of a motion straight on, kept, so that its states can be read off again, to the bit.
 * Paper    eq. (10): what its integral is        Uses  straight.h        Used by  attempt.c forth.c stepping.c
 *
 * A run lets its nodes go as it goes on. What was read off them depends on the last few that there were as soon as it
 * could be read, and on nothing else: with these it is read again. Where a run is no longer smooth, its steps end on
 * frames, and there is nothing to keep. */
#ifndef RG_TRACE_H
#define RG_TRACE_H

#include "fold/straight.h"

/* Of one system. */
typedef struct rg_trace_part {
    int32_t N, count;
    size_t room[4];
    double *s;              /* [count] progress of the nodes */
    double *rho;            /* [count][N] */
    double *t;              /* [count][N] as in rg_node */
    unsigned char *told;    /* [count] does it have t; could the sheet go one way only, as far as was known then */
    double until;           /* its states are those of the nodes up to here */
    int ended, ended_one_way; /* there was no way on from the last node; as above, then */
} rg_trace_part;

typedef struct rg_trace {
    rg_memory mem;
    rg_settings settings;
    int32_t parts;
    rg_trace_part *part;
    rg_straight *reader;    /* owned; NULL: nobody has read yet */
} rg_trace;

/* Of the systems of f, before its first step. RG_ENOMEM. Owner: the caller, rg_trace_free, also after a failure. */
rg_status rg_trace_init(rg_trace *q, const rg_memory *mem, const rg_straight *f);
void rg_trace_free(rg_trace *q);
/* After each step of f: what is new. RG_ENOMEM. */
rg_status rg_trace_follow(rg_trace *q, const rg_straight *f);
/* Makes the reader, for the mesh that f was made for. RG_ENOMEM. */
rg_status rg_trace_open(rg_trace *q, const rg_mesh *m);
/* rho[N]: out, the state at progress s. Returns its closure; NAN: it is not kept. Opened before; allocates nothing. */
double rg_trace_read(rg_trace *q, double s, double *rho);

#endif
