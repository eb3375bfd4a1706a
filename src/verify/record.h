/* record.h -- a motion as its file has it: a pattern, frames with places and angles, the order of the last one's
 * facets.
 * Uses  read/value.h        Used by  every file of verify/
 *
 * Nothing here or in the other files of this room is of the rooms that fold: what they did wrong must not be done wrong
 * again. */
#ifndef RG_RECORD_H
#define RG_RECORD_H

#include "base/memory.h"
#include "base/vec.h"

typedef struct rg_record {
    rg_memory mem;
    int32_t nv, ne, nf;
    int32_t frames;           /* states: frames, and what the file has between them */
    double size;              /* the diagonal of the pattern over sqrt(2): the side of a square */
    rg_vec2 *X;               /* [nv] the pattern */
    int32_t (*edge)[2];       /* [ne] */
    char *assignment;         /* [ne] */
    double *target;           /* [ne] radians */
    unsigned char *added;     /* [ne] non-zero: not of the pattern */
    unsigned char *open;      /* [ne] non-zero: the pattern asks no angle of it, whatever its letter */
    int32_t *start, *corner;  /* [nf + 1], counter-clockwise in the pattern, whatever way the file has them */
    unsigned char *turned;    /* [nf] non-zero: the file has it clockwise */
    /* [ne] the facets left and right of edge[e][0] -> edge[e][1]; -1: none; found by isometry.c */
    int32_t (*side)[2];
    int32_t after_all;        /* of these, after the last frame: between that and none */
    int32_t *number;          /* [frames] the frame's number in the file; of what lies between two, the second's */
    double *percent;          /* [frames] NAN: not said */
    rg_vec3 *x;               /* [frames][nv] */
    double *rho;              /* [frames][ne] radians */
    rg_vec2 *flat;            /* [frames][nv] the pattern of each frame */
    int32_t orders;
    /* [orders] of the last frame: the first lies above the second, by the second's front: 1; below: -1 */
    int32_t (*order)[3];
} rg_record;

/* bytes[size]: FOLD. RG_EFORMAT: why->text says what cannot be read; RG_ENOMEM. *r is zeroed on failure. */
rg_status rg_record_parse(const char *bytes, size_t size, const rg_memory *mem, rg_record *r, rg_diag *why);
void rg_record_free(rg_record *r);

/* Where facet f goes in a frame: x = R (X, 0) + t, with the normal R.c[2] by the way its corners run, and its farthest
 * two corners in line. *off: out, may be NULL: the farthest that a corner of it is from there. */
typedef struct rg_record_place { rg_mat3 R; rg_vec3 t; } rg_record_place;
rg_record_place rg_record_fit(const rg_record *r, int32_t frame, int32_t f, double *off);

#endif
