/* classes.h -- numbers that belong together, each going up to the least of its class, which goes up to itself. */
#ifndef RG_CLASSES_H
#define RG_CLASSES_H

#include <stdint.h>

static inline int32_t rg_class_of(int32_t *up, int32_t i)
{
    while (up[i] != i) i = up[i] = up[up[i]];
    return i;
}

static inline void rg_class_join(int32_t *up, int32_t a, int32_t b)
{
    a = rg_class_of(up, a), b = rg_class_of(up, b);
    if (a < b) up[b] = a;
    else up[a] = b;
}

#endif
