/* symbolic.h -- which order to eliminate in, and where L of L L^T = A has numbers, from where the symmetric A has them.
 * Paper    the backslash of eq. (15)        Uses  dissect.h, CAMD        Used by  supernodal.c
 *
 * Minimum degree, and on large sheets nested dissection finished by minimum degree, whichever takes fewer operations.
 * Columns of L of (nearly) the same pattern are put together, a supernode.
 *   P. Amestoy, T. Davis, I. Duff: An approximate minimum degree ordering algorithm. SIAM J. Matrix Anal. Appl. 17
 *     (1996).
 *   J. Liu: The role of elimination trees in sparse factorization. SIAM J. Matrix Anal. Appl. 11 (1990).
 *   J. Gilbert, E. Ng, B. Peyton: An efficient algorithm to compute row and column counts for sparse Cholesky
 *     factorization. SIAM J. Matrix Anal. Appl. 15 (1994). */
#ifndef RG_SYMBOLIC_H
#define RG_SYMBOLIC_H

#include "base/memory.h"

/* Numbers are read four or eight at a time, also behind the last panel, where they are of no consequence. */
enum { RG_SYMBOLIC_PAD = 8 };

typedef struct rg_symbolic {
    rg_memory mem;
    int32_t n, count;       /* order; supernodes */
    double flops, entries;  /* of one factorisation, of L */
    int32_t *place;         /* [n] row and column of L of row i of A */
    int32_t *column;        /* [count + 1] first column of each supernode */
    int32_t *start;         /* [count + 1] into row: its rows, its own columns first */
    int32_t *row;           /* rising */
    int32_t *panel;         /* [count + 1] where its numbers start, columns rg_symbolic_stride apart */
    int32_t *of;            /* [n] supernode of a column */
} rg_symbolic;

/* Rows of a supernode, and so many more that fours come out even. */
static inline int32_t rg_symbolic_stride(const rg_symbolic *S, int32_t supernode)
{
    return (S->start[supernode + 1] - S->start[supernode] + 3) & ~3;
}

/* The pattern of A, n x n: the rows of each column, of one triangle or of both, none twice in a column. RG_ENOMEM, also
 * where L has more numbers than an int32_t counts. Owner: the caller, rg_symbolic_free. The same pattern gives the same
 * order. */
rg_status rg_symbolic_init(rg_symbolic *S, const rg_memory *mem, int32_t n, const int32_t *start, const int32_t *row);
void rg_symbolic_free(rg_symbolic *S);

#endif
