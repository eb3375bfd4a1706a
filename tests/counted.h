/* counted.h -- an allocator that counts what is out and refuses once `left` requests are through. */
#ifndef COUNTED_H
#define COUNTED_H

#include "rigami.h"

#include <stdlib.h>

typedef struct counted { _Atomic long left, asked, out; } counted; /* writers of films ask from several threads */

static inline void *counted_resize(void *ctx, void *block, size_t bytes)
{
    counted *c = ctx;
    if (bytes == 0) {
        c->out -= block != NULL;
        free(block);
        return NULL;
    }
    c->asked++;
    if (c->left-- <= 0) return NULL;
    void *p = realloc(block, bytes);
    c->out += p && !block;
    return p;
}

#endif
