#include "write/png.h"
#include "base/status.h"
#include "write/deflate.h"

#include <errno.h>
#include <limits.h>
#include <string.h>

enum { RGB = 3, AS_IT_IS = 0 }; /* bytes a pixel; the filter: rows that are alike are found as well without one */

unsigned char *rg_png_number(unsigned char *to, uint32_t x, int bytes)
{
    for (int i = bytes - 1; i >= 0; i--) *to++ = (unsigned char)(x >> 8 * i);
    return to;
}

rg_status rg_png_chunk(FILE *file, const char kind[4], const unsigned char *data, size_t n, rg_diag *why)
{
    unsigned char head[8], tail[4];
    if (n > INT_MAX) return rg_fail(RG_EWRITE, why, 0, "a picture is too large for a PNG");
    memcpy(rg_png_number(head, (uint32_t)n, 4), kind, 4);
    rg_png_number(tail, rg_deflate_crc(rg_deflate_crc(0, kind, 4), data, n), 4);
    errno = 0;
    const int done = fwrite(head, 1, 8, file) == 8 && fwrite(data, 1, n, file) == n && fwrite(tail, 1, 4, file) == 4;
    return done ? RG_OK : rg_fail(RG_EWRITE, why, 0, "%s", strerror(errno));
}

rg_status rg_png_begin(FILE *file, int32_t width, int32_t height, rg_diag *why)
{
    static const unsigned char signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10}, perceptual[1] = {0};
    unsigned char size[13];
    rg_png_number(rg_png_number(size, (uint32_t)width, 4), (uint32_t)height, 4);
    memcpy(size + 8, "\10\2\0\0\0", 5); /* 8 bits, RGB, the one way to pack, the one set of filters, not interlaced */
    errno = 0;
    if (fwrite(signature, 1, 8, file) != 8) return rg_fail(RG_EWRITE, why, 0, "%s", strerror(errno));
    const rg_status s = rg_png_chunk(file, "IHDR", size, sizeof size, why);
    return s == RG_OK ? rg_png_chunk(file, "sRGB", perceptual, 1, why) : s;
}

static rg_status put_picture(FILE *file, const unsigned char *packed, size_t n, int32_t width, int32_t height,
                             rg_diag *why)
{
    static const char by[] = "Software\0" RG_PNG_SOFTWARE;
    rg_status s = rg_png_begin(file, width, height, why);
    if (s == RG_OK) s = rg_png_chunk(file, "tEXt", (const unsigned char *)by, sizeof by - 1, why);
    if (s == RG_OK) s = rg_png_chunk(file, "IDAT", packed, n, why);
    return s == RG_OK ? rg_png_chunk(file, "IEND", (const unsigned char *)"", 0, why) : s;
}

rg_status rg_png_write(const rg_memory *mem, FILE *file, int32_t width, int32_t height, const unsigned char *rgb,
                       rg_diag *why)
{
    if (width < 1 || height < 1)
        return rg_fail(RG_EARG, why, 0, "a picture of %d x %d pixels", (int)width, (int)height);
    const size_t row = RGB * (size_t)width, n = (1 + row) * (size_t)height;
    unsigned char *rows = NULL, *packed = NULL;
    size_t rows_room = 0, packed_room = 0, size = 0;
    rg_status s = rg_mem_grow(mem, (void **)&rows, &rows_room, n, 1);
    if (s == RG_OK) s = rg_mem_grow(mem, (void **)&packed, &packed_room, rg_deflate_room(n), 1);
    for (int32_t y = 0; s == RG_OK && y < height; y++) {
        unsigned char *to = rows + (1 + row) * (size_t)y;
        *to = AS_IT_IS;
        memcpy(to + 1, rgb + row * (size_t)y, row);
    }
    if (s == RG_OK) size = rg_deflate_pack(rows, n, packed);
    s = size > 0 ? put_picture(file, packed, size, width, height, why)
                 : rg_fail(RG_ENOMEM, why, 0, "out of memory for the PNG");
    rg_mem_free(mem, rows);
    rg_mem_free(mem, packed);
    return s;
}
