#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static void *resize(void *ctx, void *block, size_t bytes)
{
    (void)ctx;
    if (bytes == 0) {
        free(block);
        return NULL;
    }
    return realloc(block, bytes);
}

rg_memory rg_mem_default(const rg_memory *given)
{
    return given && given->resize ? *given : (rg_memory){resize, NULL};
}

/* A byte more than asked for, so that an empty array is a block like any other. */
static int bytes_for(size_t n, size_t size, size_t *bytes)
{
    if (size != 0 && n > (SIZE_MAX - 1) / size) return 0;
    *bytes = n * size + 1;
    return 1;
}

void *rg_mem_array(const rg_memory *mem, size_t n, size_t size)
{
    size_t bytes;
    if (!bytes_for(n, size, &bytes)) return NULL;
    void *p = mem->resize(mem->ctx, NULL, bytes);
    if (p) memset(p, 0, bytes);
    return p;
}

rg_status rg_mem_grow(const rg_memory *mem, void **block, size_t *room, size_t need, size_t size)
{
    if (need <= *room) return RG_OK;
    size_t n = *room + *room / 2 + 16, bytes;
    if (n < need) n = need;
    if (!bytes_for(n, size, &bytes)) return RG_ENOMEM;
    void *p = mem->resize(mem->ctx, *block, bytes);
    if (!p) return RG_ENOMEM;
    *block = p;
    *room = n;
    return RG_OK;
}

char *rg_mem_string(const rg_memory *mem, const char *text)
{
    if (!text) return NULL;
    size_t n = strlen(text) + 1;
    char *s = rg_mem_array(mem, n, 1);
    if (s) memcpy(s, text, n);
    return s;
}

void rg_mem_free(const rg_memory *mem, void *block)
{
    if (block) mem->resize(mem->ctx, block, 0);
}
