#include "write/deflate.h"

#ifdef RG_LIBDEFLATE

#include <libdeflate.h>

enum { EFFORT = 1 };

size_t rg_deflate_room(size_t n) { return libdeflate_zlib_compress_bound(NULL, n); }

size_t rg_deflate_pack(const unsigned char *bytes, size_t n, unsigned char *packed)
{
    struct libdeflate_compressor *c = libdeflate_alloc_compressor(EFFORT);
    if (!c) return 0;
    const size_t size = libdeflate_zlib_compress(c, bytes, n, packed, rg_deflate_room(n));
    libdeflate_free_compressor(c);
    return size;
}

uint32_t rg_deflate_crc(uint32_t crc, const void *bytes, size_t n) { return libdeflate_crc32(crc, bytes, n); }

#else

#include <zlib.h>

enum { EFFORT = 3 }; /* from 4 on, packing takes twice as long */

size_t rg_deflate_room(size_t n) { return compressBound((uLong)n); }

size_t rg_deflate_pack(const unsigned char *bytes, size_t n, unsigned char *packed)
{
    uLongf size = (uLongf)rg_deflate_room(n);
    return compress2(packed, &size, bytes, (uLong)n, EFFORT) == Z_OK ? size : 0;
}

uint32_t rg_deflate_crc(uint32_t crc, const void *bytes, size_t n) { return (uint32_t)crc32_z(crc, bytes, n); }

#endif
