/* deflate.h -- the one door to what packs bytes as zlib streams: libdeflate, or zlib where that is not there.
 * Uses  base        Used by  png.c apng.c
 *
 * Pictures are flat areas and rows like the ones above, which any of them finds at its lowest effort. */
#ifndef RG_DEFLATE_H
#define RG_DEFLATE_H

#include <stddef.h>
#include <stdint.h>

/* The most bytes that n can become. */
size_t rg_deflate_room(size_t n);
/* How many bytes there are in packed[rg_deflate_room(n)]; 0: out of memory. */
size_t rg_deflate_pack(const unsigned char *bytes, size_t n, unsigned char *packed);
/* CRC-32 of what had `crc` (0: of nothing) and n more bytes. */
uint32_t rg_deflate_crc(uint32_t crc, const void *bytes, size_t n);

#endif
