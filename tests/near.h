/* near.h -- comparisons that NaN fails.  Include after cmocka.h. */
#ifndef RG_NEAR_H
#define RG_NEAR_H

#include <math.h>
#include <stdio.h>

#define near(a, b, tol)                                                                                     \
    do {                                                                                                    \
        double near_a = (a), near_b = (b), near_tol = (tol);                                                \
        if (!(fabs(near_a - near_b) <= near_tol)) {                                                         \
            print_error("%s:%d: %s = %.17g, not within %g of %.17g\n", __FILE__, __LINE__, #a, near_a, near_tol, near_b); \
            fail();                                                                                         \
        }                                                                                                   \
    } while (0)

#define below(a, limit)                                                                                     \
    do {                                                                                                    \
        double below_a = (a), below_limit = (limit);                                                        \
        if (!(below_a <= below_limit)) {                                                                    \
            print_error("%s:%d: %s = %.17g, above %g\n", __FILE__, __LINE__, #a, below_a, below_limit);     \
            fail();                                                                                         \
        }                                                                                                   \
    } while (0)

/* A small repeatable source of numbers with entropy, in (-1, 1). */
static inline double noise(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 8388608.0 - 1.0;
}

/* AddressSanitizer takes terabytes of address space: it cannot be limited there. */
#if defined(__SANITIZE_ADDRESS__)
enum { WITH_ASAN = 1 };
#else
enum { WITH_ASAN = 0 };
#endif
#define NO_LIMIT "SKIPPED: memory cannot be limited under AddressSanitizer\n"

#endif
