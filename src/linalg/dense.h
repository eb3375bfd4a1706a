/* dense.h -- small dense matrices: products of rows, and L L^T.
 * Uses  lanes.h        Used by  unfold/
 *
 * Each sum is taken in the same order whatever the registers, so the bits are always the same. */
#ifndef RG_DENSE_H
#define RG_DENSE_H

#include <stddef.h>
#include <stdint.h>

/* H[i * room + j] = g_i . g_j for from <= i < m, j <= i: the rows g are n long, `stride` apart, n a multiple of four (filled up
 * with zeros). */
void rg_dense_gram(int32_t from, int32_t m, int32_t n, const double *g, size_t stride, double *H, size_t room);
/* x . y, n a multiple of four */
double rg_dense_dot(int32_t n, const double *x, const double *y);

/* A = L L^T in place. A: m x m, its lower triangle, by columns that are `room` apart, room >= m + 8.
 * update[RG_DENSE_WIDE * room]: scratch. Non-zero: done; zero: a pivot is not positive (or NaN). */
enum { RG_DENSE_WIDE = 4 };
int rg_dense_factor(int32_t m, double *A, size_t room, double *update);
/* b <- (L L^T) \ b */
void rg_dense_solve(int32_t m, const double *L, size_t room, double *b);

#endif
