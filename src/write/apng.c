#include "write/apng.h"
#include "base/status.h"
#include "write/change.h"
#include "write/png.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <string.h>
#include <zlib.h>

enum { RGB = 3, AS_IT_IS = 0 }; /* bytes a pixel; the filter */

struct rg_apng {
    rg_memory mem;
    FILE *file;
    int32_t width, height, frames;
    uint32_t sequence;
    unsigned delay, unit; /* a frame is shown for delay / unit seconds */
    unsigned char *before;   /* [height][width][3] */
    unsigned char *rows; /* [height][1 + width * 3] */
    unsigned char *packed;   /* [4 + room] a sequence number and a frame's data */
    size_t room;
};

static unsigned char *big_endian(unsigned char *to, uint32_t x, int bytes)
{
    for (int i = bytes - 1; i >= 0; i--) *to++ = (unsigned char)(x >> 8 * i);
    return to;
}

static rg_status put_chunk(rg_apng *a, const char *kind, const unsigned char *data, size_t n, rg_diag *why)
{
    unsigned char head[8], tail[4];
    uLong crc = crc32(crc32(0, NULL, 0), (const Bytef *)kind, 4);
    crc = crc32_z(crc, data, n);
    memcpy(big_endian(head, (uint32_t)n, 4), kind, 4);
    big_endian(tail, (uint32_t)crc, 4);
    errno = 0;
    const int done =
        fwrite(head, 1, 8, a->file) == 8 && fwrite(data, 1, n, a->file) == n && fwrite(tail, 1, 4, a->file) == 4;
    return done ? RG_OK : rg_fail(RG_EWRITE, why, 0, "%s", strerror(errno));
}

static rg_status put_head(rg_apng *a, int32_t frames, int for_ever, rg_diag *why)
{
    static const unsigned char signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10}, perceptual[1] = {0};
    unsigned char size[13], animation[8];
    big_endian(big_endian(size, (uint32_t)a->width, 4), (uint32_t)a->height, 4);
    memcpy(size + 8, "\10\2\0\0\0", 5); /* 8 bits, RGB, the one way to pack, the one set of filters, not interlaced */
    big_endian(big_endian(animation, (uint32_t)frames, 4), for_ever ? 0 : 1, 4);
    errno = 0;
    if (fwrite(signature, 1, 8, a->file) != 8) return rg_fail(RG_EWRITE, why, 0, "%s", strerror(errno));
    rg_status s = put_chunk(a, "IHDR", size, sizeof size, why);
    if (s == RG_OK) s = put_chunk(a, "acTL", animation, sizeof animation, why);
    if (s == RG_OK) s = put_chunk(a, "sRGB", perceptual, 1, why);
    return s;
}

/* 1 / fps as a fraction of two numbers of 16 bits. */
static void set_delay(rg_apng *a, double fps)
{
    unsigned times = 1;
    while (times < 1000 && fabs(fps * times - floor(fps * times + 0.5)) > 1e-9 && 10 * fps * times <= 65535)
        times *= 10;
    a->delay = times;
    a->unit = (unsigned)(fps * times + 0.5);
}

rg_status rg_apng_create(const rg_memory *mem, FILE *file, int32_t width, int32_t height, double fps, int32_t frames,
                         int for_ever, rg_apng **apng, rg_diag *why)
{
    const size_t row = RGB * (size_t)width;
    rg_apng *a = rg_mem_array(mem, 1, sizeof *a);
    if (!a) return rg_fail(RG_ENOMEM, why, 0, "out of memory for the APNG");
    *a = (rg_apng){.mem = *mem, .file = file, .width = width, .height = height};
    a->room = compressBound((1 + row) * (size_t)height);
    a->before = rg_mem_array(mem, (size_t)height, row);
    a->rows = rg_mem_array(mem, (size_t)height, 1 + row);
    a->packed = rg_mem_array(mem, 4 + a->room, 1);
    set_delay(a, fps);
    rg_status s = a->before && a->rows && a->packed ? put_head(a, frames, for_ever, why)
                                                        : rg_fail(RG_ENOMEM, why, 0, "out of memory for the APNG");
    if (s != RG_OK) {
        rg_apng_destroy(a);
        return s;
    }
    *apng = a;
    return RG_OK;
}

static size_t gather(rg_apng *a, const unsigned char *rgb, const rg_change *c)
{
    const size_t stride = RGB * (size_t)a->width, row = RGB * (size_t)c->width;
    const unsigned char *from = rgb + (size_t)c->top * stride + RGB * (size_t)c->left;
    unsigned char *to = a->rows;
    for (int32_t y = 0; y < c->height; y++, from += stride) {
        *to++ = AS_IT_IS;
        memcpy(to, from, row);
        to += row;
    }
    return (size_t)(to - a->rows);
}

/* The delay times `times`, as a fraction of two numbers of 16 bits: hundredths where it is long. */
static unsigned char *put_delay(const rg_apng *a, double times, unsigned char *to)
{
    const double n = floor(a->delay * times + 0.5),
                 hundredths = fmin(65535, floor(100.0 * a->delay / a->unit * times + 0.5));
    if (n <= 65535) return big_endian(big_endian(to, (uint32_t)n, 2), a->unit, 2);
    return big_endian(big_endian(to, (uint32_t)hundredths, 2), 100, 2);
}

static rg_status put_control(rg_apng *a, const rg_change *c, double times, rg_diag *why)
{
    unsigned char control[26], *to = big_endian(control, a->sequence++, 4);
    to = big_endian(big_endian(to, (uint32_t)c->width, 4), (uint32_t)c->height, 4);
    to = big_endian(big_endian(to, (uint32_t)c->left, 4), (uint32_t)c->top, 4);
    to = put_delay(a, times, to);
    *to++ = 0; /* leave it there afterwards */
    *to++ = 0; /* in place of what was there */
    return put_chunk(a, "fcTL", control, sizeof control, why);
}

rg_status rg_apng_add(rg_apng *a, const unsigned char *rgb, double times, rg_diag *why)
{
    const rg_change c = rg_change_find(rgb, a->frames > 0 ? a->before : NULL, a->width, a->height, RGB);
    rg_status s = put_control(a, &c, times, why);
    if (s != RG_OK) return s;
    uLongf n = (uLongf)a->room;
    if (compress2(a->packed + 4, &n, a->rows, (uLong)gather(a, rgb, &c), RG_PNG_EFFORT) != Z_OK)
        return rg_fail(RG_ENOMEM, why, 0, "out of memory for the APNG");
    if (n > INT_MAX - 4) return rg_fail(RG_EWRITE, why, 0, "a picture is too large for an APNG");
    if (a->frames == 0) {
        s = put_chunk(a, "IDAT", a->packed + 4, n, why);
    } else {
        big_endian(a->packed, a->sequence++, 4);
        s = put_chunk(a, "fdAT", a->packed, 4 + n, why);
    }
    memcpy(a->before, rgb, RGB * (size_t)a->width * (size_t)a->height);
    a->frames++;
    return s;
}

rg_status rg_apng_finish(rg_apng *a, rg_diag *why) { return put_chunk(a, "IEND", (const unsigned char *)"", 0, why); }

void rg_apng_destroy(rg_apng *a)
{
    if (!a) return;
    RG_MEM_FREE(&a->mem, a->before, a->rows, a->packed, a);
}
