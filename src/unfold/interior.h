/* interior.h -- the least step that keeps rows, and how hard each pushes: a convex quadratic program, by an interior
 * point.
 * Uses  normal.h dense.h        Used by  nearest.c
 *
 *     min  1/2 v^T G v + sum s_i^2 / (2 c_i)        G = J^T J + diag g
 *     s.t. E v = 0,   R v + s >= d
 *
 * Layers that lie on each other give the same row many times, which sets of active rows cycle on. An interior point
 * does not mind: each of its iterations solves, with multipliers x and what rows are more than kept by, t,
 *
 *     (G + E^T E / eps + R^T D^-1 R) dv = ...,   D = c + t / x
 *
 * where E is a proximal term, by which it comes to hold exactly. The matrix is sparse, and its pattern hardly changes:
 * it is analysed anew only where rows do not fit. A few rows are cheaper by rows: G + E^T E / eps is factored once and
 * solved with for each, then D + R (G + E^T E / eps)^-1 R^T is a small dense matrix.
 *   Mehrotra, On the implementation of a primal-dual interior point method, 1992.
 *   Friedlander, Orban, A primal-dual regularized interior-point method for convex quadratic programs, 2012. */
#ifndef RG_INTERIOR_H
#define RG_INTERIOR_H

#include "linalg/normal.h"

typedef struct rg_interior {
    rg_memory mem;
    int32_t n;
    rg_rows J, E, R;         /* to be filled in; J and E in the same pattern each time */
    double *g;               /* [n] the same */
    double *c, *d;           /* [m] to be filled in; c positive */
    int32_t *of;             /* [m] the same: which row of R; one may be there twice */
    double *x, *slack;       /* [m] out: multipliers; what rows are more than kept by */
    double *v;               /* [n] out */
    int32_t iterations;      /* of the last call */
    double work, most_work;  /* of all calls: multiplications; what ends one, 0: nothing */
    /* NULL: nobody asks; non-zero: solve ends with what it has, and so does every call after it */
    int (*stop)(void *ctx, double done);
    void *ctx;
    /* Its own. */
    rg_normal few, many;     /* without and with rows of R in the pattern */
    rg_slots few_J, few_E, many_J, many_E, many_R;
    double *base, *many_base; /* J, E and g in the numbers of `few`, of `many` */
    size_t many_base_room;
    int laid, factored, many_laid; /* base, the factor of it, many_base are those of J, E, g */
    double *Z;               /* [solved][n] G^-1 of rows of R, E kept */
    int32_t *at;             /* [known] which of them a row of R has, -1: none */
    size_t Z_room, at_room;
    int32_t solved, known;
    double largest;          /* multiplier of the last solution */
    double *M;               /* dense: R Z, and a factor */
    double *L, *update;
    size_t dense_room, wide_room;
    double *weight, *sum;    /* [rows of R] */
    size_t weight_room, sum_room;
    double *dx, *dslack, *residual, *both, *before, *inverse; /* [m] */
    size_t rows_room;
    double *off, *dv;        /* [n] G v - E^T y - R^T x; its step */
    double *y, *dy, *Ev;     /* [rows of E] multipliers */
} rg_interior;

/* n unknowns, no rows. RG_ENOMEM. Owner: the caller, rg_interior_free, also after a failure. */
rg_status rg_interior_init(rg_interior *q, const rg_memory *mem, int32_t n);
void rg_interior_free(rg_interior *q);
/* No rows; J, E and g are to be made anew. */
void rg_interior_clear(rg_interior *q);
/* Room for m rows; what was in rows before is lost. RG_ENOMEM. */
rg_status rg_interior_reserve(rg_interior *q, int32_t m);
/* m rows, of the R that there are. Rows may be added to R, and it be solved again, until rg_interior_clear. RG_ENOMEM;
 * allocates only what has never been as large, and for a pattern that does not fit. */
rg_status rg_interior_solve(rg_interior *q, int32_t m);

#endif
