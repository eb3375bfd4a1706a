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

/* All object pointers look alike. */
static void put(const rg_array *a, void *block) { memcpy(a->pointer, &block, sizeof block); }

static void *get(const rg_array *a)
{
    void *block;
    memcpy(&block, a->pointer, sizeof block);
    return block;
}

/* The i-th could not be made: nor are the others. */
static rg_status make_none(const rg_memory *mem, const rg_array *array, size_t i, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        if (k < i) rg_mem_free(mem, get(&array[k]));
        put(&array[k], NULL);
    }
    return RG_ENOMEM;
}

rg_status rg_mem_arrays(const rg_memory *mem, const rg_array *array, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        void *block = rg_mem_array(mem, array[i].n, array[i].size);
        if (!block) return make_none(mem, array, i, count);
        put(&array[i], block);
    }
    return RG_OK;
}

rg_status rg_mem_copies(const rg_memory *mem, const rg_array *array, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const void *from = get(&array[i]);
        if (!from) continue;
        void *block = rg_mem_array(mem, array[i].n, array[i].size);
        if (!block) return make_none(mem, array, i, count);
        memcpy(block, from, array[i].n * array[i].size);
        put(&array[i], block);
    }
    return RG_OK;
}

void rg_mem_free_all(const rg_memory *mem, void **block, size_t count)
{
    for (size_t i = 0; i < count; i++) rg_mem_free(mem, block[i]);
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
