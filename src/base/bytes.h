/* bytes.h -- numbers as little-endian bytes, as binary files have them, on any machine.
 * Used by  write */
#ifndef RG_BYTES_H
#define RG_BYTES_H

#include <stdint.h>
#include <string.h>

/* Each returns the byte after those that it wrote. */
static inline unsigned char *rg_bytes_u16(unsigned char *to, uint32_t x)
{
    for (int i = 0; i < 2; i++) *to++ = (unsigned char)(x >> 8 * i);
    return to;
}
static inline unsigned char *rg_bytes_u32(unsigned char *to, uint32_t x)
{
    for (int i = 0; i < 4; i++) *to++ = (unsigned char)(x >> 8 * i);
    return to;
}
static inline unsigned char *rg_bytes_f32(unsigned char *to, double x)
{
    const float rounded = (float)x;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return rg_bytes_u32(to, bits);
}

#endif
