/* qr.h -- the rank of C by a sparse QR factorisation that reveals it, for sheets of any size.
 * Paper    eq. (9): what the pseudo-inverse leaves free        Uses  sparse.h normal.h        Used by  mobility.c
 *
 * R has the pattern of the Cholesky factor of A^T A, whose supernodes are the fronts: each gathers the rows that begin
 * in its columns, eliminates those and hands the rest up the tree. Columns that depend on those before them are
 * dropped, and their rows go on.
 *   M. Heath: Some extensions of an algorithm for sparse linear least squares problems. SIAM J. Sci. Stat. Comput. 3
 *     (1982).
 *   T. Davis: Algorithm 915, SuiteSparseQR: multifrontal multithreaded rank-revealing sparse QR factorization. ACM
 *     Trans. Math. Software 38 (2011). Tests compare with it; it is under the GPL. */
#ifndef RG_QR_H
#define RG_QR_H

#include "linalg/sparse.h"

/* The rows of each vertex are to be orthonormal or zero, see scale.h. A column that is no longer than `cut` when those
 * before it are taken out counts as zero. RG_ENOMEM, *rank is then untouched. */
rg_status rg_qr_rank(const rg_sparse *B, double cut, int32_t *rank);

#endif
