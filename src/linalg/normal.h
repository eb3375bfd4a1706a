/* normal.h -- L L^T = D + the sum of w_i a_i^T a_i over sparse rows a_i: the order and the pattern of L are found once,
 * and serve for as long as the rows that come and go fit into it; the weights change all the time.
 * Uses  supernodal.h rows.h        Used by  qr.c, unfold/interior.c */
#ifndef RG_NORMAL_H
#define RG_NORMAL_H

#include "linalg/rows.h"
#include "linalg/supernodal.h"

typedef struct rg_normal {
    rg_memory mem;
    int32_t n;
    rg_supernodal L;    /* L.S.n 0: not analysed yet */
    int32_t *diagonal;  /* [n] slots */
    int32_t *scratch;   /* [2][n] */
    int64_t analyses;
} rg_normal;

/* Where the products of the numbers of rows go in L.x: of rows 0 ... rows - 1 of one list. */
typedef struct rg_slots {
    int32_t *to;
    size_t room, used;
    int32_t rows;
} rg_slots;

/* n unknowns, nothing analysed. RG_ENOMEM. Owner: the caller, rg_normal_free, also after a failure. */
rg_status rg_normal_init(rg_normal *N, const rg_memory *mem, int32_t n);
void rg_normal_free(rg_normal *N);
/* Order and pattern for the rows of all lists together; slots found before are void. RG_ENOMEM. */
rg_status rg_normal_analyse(rg_normal *N, const rg_rows *const *lists, int32_t count);
/* Finds the slots of rows s->rows ... of a list; *fits zero: one has no place in the pattern, and those before it are
 * found. RG_ENOMEM. */
rg_status rg_normal_find(const rg_normal *N, const rg_rows *rows, rg_slots *s, int *fits);
/* x[numbers of L] += w[i] a_i^T a_i, for rows 0 ... s->rows - 1; w NULL: all 1; rows of weight 0 cost nothing. */
void rg_normal_add(const rg_rows *rows, const rg_slots *s, const double *w, double *x);
void rg_normal_free_slots(const rg_memory *mem, rg_slots *s);
/* How many numbers L.x has. */
static inline size_t rg_normal_numbers(const rg_normal *N) { return (size_t)N->L.S.panel[N->L.S.count]; }

#endif
