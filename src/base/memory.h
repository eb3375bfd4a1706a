/* memory.h -- checked arrays over the caller's allocator.
 * Used by  every file that allocates.  Thread safety: that of the allocator given. */
#ifndef RG_MEMORY_H
#define RG_MEMORY_H

#include "rigami.h"
#include <stddef.h>

/* The allocator to use when the caller gave none (NULL): realloc and free. */
rg_memory rg_mem_default(const rg_memory *given);

/* A zeroed array of n elements, or NULL when memory is short or n * size overflows. n = 0 gives a valid block.
 * Owner: the caller, who frees it with rg_mem_free and the same allocator. */
void *rg_mem_array(const rg_memory *mem, size_t n, size_t size);

/* Arrays that are made together, all or none: RG_MEM_ARRAYS(mem, RG_ARRAY(s->x, n), RG_ARRAY(s->y, m)) is RG_OK, or
 * RG_ENOMEM, and then all of them are NULL. Each as by rg_mem_array. */
#define RG_MEM_ARRAYS(mem, ...) \
    rg_mem_arrays(mem, (const rg_array[]){__VA_ARGS__}, sizeof((const rg_array[]){__VA_ARGS__}) / sizeof(rg_array))
#define RG_ARRAY(pointer, n) {&(pointer), n, sizeof *(pointer)}
typedef struct rg_array {
    void *pointer; /* where the pointer to it is kept */
    size_t n, size;
} rg_array;
rg_status rg_mem_arrays(const rg_memory *mem, const rg_array *array, size_t count);

/* Another's arrays, to which the pointers point, are copied: RG_MEM_COPIES(mem, RG_ARRAY(s->x, n)) leaves copies there;
 * NULL stays NULL. RG_ENOMEM: all of them are NULL. */
#define RG_MEM_COPIES(mem, ...) \
    rg_mem_copies(mem, (const rg_array[]){__VA_ARGS__}, sizeof((const rg_array[]){__VA_ARGS__}) / sizeof(rg_array))
rg_status rg_mem_copies(const rg_memory *mem, const rg_array *array, size_t count);

/* Frees several blocks: RG_MEM_FREE(mem, s->x, s->y). NULL is fine. */
#define RG_MEM_FREE(mem, ...) \
    rg_mem_free_all(mem, (void *[]){__VA_ARGS__}, sizeof((void *[]){__VA_ARGS__}) / sizeof(void *))
void rg_mem_free_all(const rg_memory *mem, void **block, size_t count);

/* Makes room for at least `need` elements in *block, growing by half; keeps what is there, new elements are not
 * zeroed. RG_ENOMEM leaves *block and *room as they were. */
rg_status rg_mem_grow(const rg_memory *mem, void **block, size_t *room, size_t need, size_t size);

/* The same, by name: RG_MEM_GROW(mem, s->x, s->room, n + 1) of an array s->x that has room for s->room elements. */
#define RG_MEM_GROW(mem, array, room, need) rg_mem_grow(mem, (void **)&(array), &(room), need, sizeof *(array))

/* A copy of a string (NULL gives NULL), or NULL when memory is short. */
char *rg_mem_string(const rg_memory *mem, const char *text);

/* What p points to will be needed soon: memory that is read here and there takes as long as all else on large
 * drawings. */
static inline void rg_mem_soon(const void *p)
{
#ifdef __GNUC__
    __builtin_prefetch(p);
#else
    (void)p;
#endif
}
enum { RG_SOON = 16 }; /* steps of a loop before */

/* Frees a block; NULL is fine. */
void rg_mem_free(const rg_memory *mem, void *block);

#endif
