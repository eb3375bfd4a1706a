/* path.h -- the way travelled so far, as nodes with their directions, and what lies between and beyond them.
 * Paper    eq. (10): what its integral is                Used by  system.c */
#ifndef RG_PATH_H
#define RG_PATH_H

#include "base/memory.h"

/* Twice six conditions make a polynomial of degree 11; more would amplify rounding at its ends. */
enum { RG_PATH_WINDOW = 6, RG_PATH_NODES = 16 };

typedef struct rg_node {
    double s;    /* progress */
    double *rho; /* [N], and zeros to a multiple of four */
    double *t;   /* likewise; drho/ds */
    int has_t;   /* zero: t is not known there, as at flat and at flat-folded */
} rg_node;

typedef struct rg_path {
    rg_memory mem;
    int32_t N, count;
    rg_node node[RG_PATH_NODES]; /* by rising s */
} rg_path;

rg_status rg_path_init(rg_path *p, const rg_memory *mem, int32_t N);
void rg_path_free(rg_path *p);
/* Forgets all nodes. */
void rg_path_clear(rg_path *p);
/* Copies a node in, at its place by s; the oldest makes room where there is none. t NULL: not known. */
void rg_path_insert(rg_path *p, double s, const double *rho, const double *t);

/* The polynomial through nodes first ... first + n - 1, rho and, where known, t.   rho[N], t[N]: out; either may be
 * NULL */
void rg_path_evaluate(const rg_path *p, int32_t first, int32_t n, double s, double *rho, double *t);
/* The window of up to RG_PATH_WINDOW nodes that suits s best. */
void rg_path_window(const rg_path *p, double s, int32_t *first, int32_t *n);
/* The two nodes on either side of s, or what there is of them. */
void rg_path_around(const rg_path *p, double s, int32_t *first, int32_t *n);
/* Forgets the nodes beyond s, all but the first two. */
void rg_path_cut(rg_path *p, double s);
/* Product of |s - s_i| over the conditions at nodes first ... first + n - 1, what an error at s is proportional to: 2 a
 * node where t is known and counts, 1 elsewhere. */
double rg_path_reach(const rg_path *p, int32_t first, int32_t n, double s, int conditions);
/* w[n]: weights of t in the integral from `from` to `to` of the polynomial through nodes first ... first + n - 1,
 * which all have t; n <= 9. */
void rg_path_integral(const rg_path *p, int32_t first, int32_t n, double from, double to, double *w);

#endif
