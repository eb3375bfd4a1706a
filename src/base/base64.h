/* base64.h -- bytes as text, for files that hold everything in themselves.
 * Used by  write/gltf.c write/html.c */
#ifndef RG_BASE64_H
#define RG_BASE64_H

#include "base/memory.h"

/* `prefix`, the n bytes in base64 with padding, and a final 0. NULL when memory is short. Owner: the caller,
 * rg_mem_free. */
char *rg_base64_text(const rg_memory *mem, const char *prefix, const unsigned char *bytes, size_t n);

#endif
