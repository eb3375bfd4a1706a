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

/* Makes room for at least `need` elements in *block, growing by half; keeps what is there, new elements are not
 * zeroed. RG_ENOMEM leaves *block and *room as they were. */
rg_status rg_mem_grow(const rg_memory *mem, void **block, size_t *room, size_t need, size_t size);

/* A copy of a string (NULL gives NULL), or NULL when memory is short. */
char *rg_mem_string(const rg_memory *mem, const char *text);

/* Frees a block; NULL is fine. */
void rg_mem_free(const rg_memory *mem, void *block);

#endif
