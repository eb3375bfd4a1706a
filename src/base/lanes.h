/* lanes.h -- four numbers at once.
 * Used by  the loops over creases, vertices and panels that take the time
 *
 * Arithmetic on a quad is that of four doubles, in the same order and with the same rounding, so a function that is
 * compiled once more for wider registers (RG_WIDE) gives the same bits there. */
#ifndef RG_LANES_H
#define RG_LANES_H

#include <math.h>
#include <stdint.h>

typedef double rg_quad __attribute__((vector_size(32)));
typedef double rg_quad_anywhere __attribute__((vector_size(32), aligned(8))); /* in an array of doubles */
typedef int64_t rg_quad_int __attribute__((vector_size(32)));

/* Not by clang: up to 17 it gives the chosen version a name of its own, so that other files do not find the
 * function. */
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && \
    defined(__has_attribute)
#if __has_attribute(target_clones)
#define RG_WIDE __attribute__((target_clones("avx2", "default")))
#endif
#endif
#ifndef RG_WIDE
#define RG_WIDE
#endif
/* A part of such a function: it must be compiled with it. Quads are not passed by value, which has no settled way. */
#define RG_WITHIN static inline __attribute__((always_inline))

/* a . b, in eight sums that are added up at the end: one sum waits for itself at each product. */
static inline double rg_lanes_dot(int32_t n, const double *a, const double *b)
{
    rg_quad s = {0}, t = {0};
    int32_t i = 0;
    for (; i + 8 <= n; i += 8) {
        s += *(const rg_quad_anywhere *)(a + i) * *(const rg_quad_anywhere *)(b + i);
        t += *(const rg_quad_anywhere *)(a + i + 4) * *(const rg_quad_anywhere *)(b + i + 4);
    }
    s += t;
    double sum = (s[0] + s[1]) + (s[2] + s[3]);
    for (; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* The largest |a_i|; NaN where there is one. */
static inline double rg_lanes_largest(int32_t n, const double *a)
{
    double most = 0;
    for (int32_t i = 0; i < n; i++)
        if (!(fabs(a[i]) <= most)) most = fabs(a[i]);
    return most;
}

/* y <- y + a x */
static inline void rg_lanes_add(int32_t n, double a, const double *x, double *y)
{
    int32_t i = 0;
    for (; i + 4 <= n; i += 4) *(rg_quad_anywhere *)(y + i) += a * *(const rg_quad_anywhere *)(x + i);
    for (; i < n; i++) y[i] += a * x[i];
}

/* y <- x + a y */
static inline void rg_lanes_add_to(int32_t n, double a, const double *x, double *y)
{
    int32_t i = 0;
    for (; i + 4 <= n; i += 4)
        *(rg_quad_anywhere *)(y + i) = *(const rg_quad_anywhere *)(x + i) + a * *(rg_quad_anywhere *)(y + i);
    for (; i < n; i++) y[i] = x[i] + a * y[i];
}

#endif
