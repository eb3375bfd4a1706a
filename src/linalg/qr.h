/* qr.h -- the rank of C by a sparse QR factorisation that reveals it, for sheets of any size.
 * Paper    eq. (9): what the pseudo-inverse leaves free        Uses  sparse.h, SPQR        Used by  mobility.c */
#ifndef RG_QR_H
#define RG_QR_H

#include "linalg/sparse.h"

int rg_qr_built(void); /* non-zero: this build has it */

/* The rows of each vertex are to be orthonormal or zero, see scale.h. What is smaller than `cut` in the course of the
 * factorisation counts as zero. RG_ENOMEM; RG_EABSENT in a build without SPQR. Not the allocator of the caller but malloc() is
 * asked for memory, as SPQR knows no other; all of it is returned. */
rg_status rg_qr_rank(const rg_sparse *B, double cut, int32_t *rank);

#endif
