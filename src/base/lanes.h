/* lanes.h -- four numbers at once.
 * Used by  the loops over creases, vertices and panels that take the time
 *
 * Arithmetic on a quad is that of four doubles, in the same order and with the same rounding, so a function that is
 * compiled once more for wider registers (RG_WIDE) gives the same bits there. */
#ifndef RG_LANES_H
#define RG_LANES_H

#include <stdint.h>

typedef double rg_quad __attribute__((vector_size(32)));
typedef double rg_quad_anywhere __attribute__((vector_size(32), aligned(8))); /* in an array of doubles */
typedef int64_t rg_quad_int __attribute__((vector_size(32)));

/* Not by clang: up to 17 it gives the chosen version a name of its own, so that other files do not find the function. */
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
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

#endif
