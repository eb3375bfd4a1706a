/* qr.h -- the rank of C by a sparse QR factorisation that reveals it, for sheets of any size.
 * Paper    eq. (9): what the pseudo-inverse leaves free        Uses  sparse.h normal.h        Used by  mobility.c
 *
 * R is made row by row with plane rotations, where the Cholesky factor of A^T A would be; columns that turn out to depend on those before
 * them are dropped, and what their rows still hold goes on. SuiteSparse's SPQR, under the GPL, does the same; tests compare the two.
 *   A. George, M. Heath: Solution of sparse linear least squares problems using Givens rotations. Linear Algebra Appl. 34 (1980).
 *   M. Heath: Some extensions of an algorithm for sparse linear least squares problems. SIAM J. Sci. Stat. Comput. 3 (1982). */
#ifndef RG_QR_H
#define RG_QR_H

#include "linalg/sparse.h"

/* The rows of each vertex are to be orthonormal or zero, see scale.h. A column that is no longer than `cut` when those before it are
 * taken out counts as zero. RG_ENOMEM. */
rg_status rg_qr_rank(const rg_sparse *B, double cut, int32_t *rank);

#endif
