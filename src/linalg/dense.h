/* dense.h -- small dense matrices: L L^T.
 * Uses  lanes.h        Used by  unfold/
 *
 * Each sum is taken in the same order whatever the registers, so the bits are always the same. */
#ifndef RG_DENSE_H
#define RG_DENSE_H

#include <stddef.h>
#include <stdint.h>

/* A = L L^T in place. A: m x m, its lower triangle, by columns that are `room` apart, room >= m + 8.
 * update[RG_DENSE_WIDE * room + 8]: scratch. Non-zero: done; zero: a pivot is not positive (or NaN). */
enum { RG_DENSE_WIDE = 4 };
int rg_dense_factor(int32_t m, double *A, size_t room, double *update);
/* The room that m columns need. */
static inline size_t rg_dense_room(int32_t m) { return (((size_t)m + 3) & ~(size_t)3) + 8; }
/* b <- (L L^T) \ b */
void rg_dense_solve(int32_t m, const double *L, size_t room, double *b);

#endif
