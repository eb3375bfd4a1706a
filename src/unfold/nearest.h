/* nearest.h -- the nearest step to a wished one that keeps the sheet closed, and rows of what must not come nearer.
 * Paper    eqs. (14), (15), (19), with inequalities        Uses  places.h interior.h        Used by  crossed.c stride.c
 *
 *     min  1/2 |W^-1/2 (dz - wish)|^2 + sum s_i^2 / (2 c_i)
 *     s.t. A dz = -r,   row_i dz + s_i >= b_i
 *
 * with W^1/2 = diag(scale). y = W^-1/2 dz. What closes is projected onto, eq. (15); what rows change of it is
 * interior.h's, by the places of vertices, where it is sparse; and is projected once more. Rows are made only when the
 * step would break them: of thousands, most never are. */
#ifndef RG_NEAREST_H
#define RG_NEAREST_H

#include "unfold/interior.h"
#include "unfold/places.h"

enum { RG_ROW_TERMS = 6 };

/* n . sum weight[i] dp_v[i], or, with crease >= 0, weight[0] drho of it, or, with facet >= 0, sum weight[i] du of the
 * ways
 * v[i]; and what it must be at least. */
typedef struct rg_row {
    int32_t terms, crease, facet, v[RG_ROW_TERMS];
    double weight[RG_ROW_TERMS];
    rg_vec3 n;
    double b, c;           /* bound, compliance */
    double soft_b, soft_c; /* the same once more, more compliant; soft_c 0: no */
    int glued;             /* non-zero: of layers that still lie on each other */
    int32_t feature;       /* corner, or nv and an edge, that it is about; -1: neither */
    double d;              /* how far from what it would meet */
    double floor;          /* what its gap may not be less than after the step, for the caller */
    int32_t carried;       /* how n turns with what it is about, for the caller; 0: it does not */
    double base;           /* what the row is along the projected wish */
    int32_t at;            /* among the rows that are made, -1: not */
    /* NULL, or who remembers, by a flag, that a row of the same pushed: then it is active from the start, else only
     * when it is broken, whatever q->all says. */
    unsigned char *pushed, pushed_by;
    int active;            /* flags: the row, 1, and its soft form, 2; 4 times them: what is broken of it */
    int closing;           /* non-zero: it pushed when it was solved without soft forms last */
    int32_t next;          /* broken too, of the same feature; -1: none */
} rg_row;

typedef struct rg_nearest {
    rg_memory mem;
    rg_linkage *P;       /* borrowed */
    double *scale;      /* [n] */
    rg_row *row;
    size_t room;
    int32_t count;
    int32_t *head;      /* [nv + ne] the first broken row of each feature */
    int32_t *active;    /* 2 * row, and 1 more for its soft form */
    size_t active_room;
    int32_t actives;
    int all;            /* non-zero: most rows are expected to push: all are active from the start */
    int laid;           /* the rows of places.h are those of the state */
    double *y0, *y, *dz, *scratch; /* [n] */
    double *wish;       /* [n] for the caller */
    double *right;      /* [rows of A] */
    rg_vec3 *dp;        /* [nv] */
    rg_interior q;
    double work;        /* but for q.work */
} rg_nearest;

rg_status rg_nearest_init(rg_nearest *q, const rg_memory *mem, rg_linkage *P);
void rg_nearest_free(rg_nearest *q);

/* P is put and A renewed with q->scale at the state z[n]. Returns what closure is off, radians. */
double rg_nearest_stand(rg_nearest *q, const double *z);
/* No rows; the state is where it stands now. */
void rg_nearest_clear(rg_nearest *q);
/* A new row of so many terms along n, else zero but for c; NULL: no memory. */
rg_row *rg_nearest_add(rg_nearest *q, int32_t terms, const int32_t *v, const double *weight, rg_vec3 n);
/* The same of fold angle i: it is away from half a turn on the side of `sign`. */
rg_row *rg_nearest_add_bound(rg_nearest *q, int32_t i, double sign);
/* What a row is along q->dz, after rg_nearest_solve. */
double rg_nearest_value(const rg_nearest *q, const rg_row *row);
/* q->dz: out. wish[n], NULL: none. r[rows of A]: what closure is off. with_soft: the soft forms too. Keeps the rows
 * that are made from one call to the next, until rg_nearest_clear. RG_ENOMEM. */
rg_status rg_nearest_solve(rg_nearest *q, const double *wish, const double *r, int with_soft);
/* The same without rows. */
void rg_nearest_project(rg_nearest *q, const double *wish, const double *r);
/* Work of all calls, multiplications. */
static inline double rg_nearest_work(const rg_nearest *q) { return q->work + q->q.work; }

#endif
