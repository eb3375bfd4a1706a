#include "write/apng.h"
#include "base/status.h"
#include "write/change.h"
#include "write/deflate.h"
#include "write/png.h"

#include <math.h>
#include <string.h>

enum { RGB = 3, AS_IT_IS = 0 }; /* bytes a pixel; the filter: rows that are alike are found as well without one */

struct rg_apng {
    rg_memory mem;
    FILE *file;
    int32_t width, height, frames;
    uint32_t sequence;
    unsigned delay, unit; /* a frame is shown for delay / unit seconds */
    unsigned char *before;   /* [height][width][3] */
    unsigned char *rows;     /* [height][1 + width * 3] */
    unsigned char *packed;   /* [4 + room] a sequence number and a frame's data */
};

static rg_status put_head(rg_apng *a, int32_t frames, rg_diag *why)
{
    unsigned char animation[8];
    rg_png_number(rg_png_number(animation, (uint32_t)frames, 4), 0, 4); /* for ever */
    const rg_status s = rg_png_begin(a->file, a->width, a->height, why);
    return s == RG_OK ? rg_png_chunk(a->file, "acTL", animation, sizeof animation, why) : s;
}

/* 1 / fps as a fraction of two numbers of 16 bits. */
static void set_delay(rg_apng *a, double fps)
{
    unsigned times = 1;
    while (times < 1000 && fabs(fps * times - floor(fps * times + 0.5)) > 1e-9 && 10 * fps * times <= 65535) times *= 10;
    a->delay = times;
    a->unit = (unsigned)(fps * times + 0.5);
}

rg_status rg_apng_create(const rg_memory *mem, FILE *file, int32_t width, int32_t height, double fps, int32_t frames,
                         rg_apng **apng, rg_diag *why)
{
    const size_t row = RGB * (size_t)width;
    rg_apng *a = rg_mem_array(mem, 1, sizeof *a);
    if (!a) return rg_fail(RG_ENOMEM, why, 0, "out of memory for the APNG");
    *a = (rg_apng){.mem = *mem, .file = file, .width = width, .height = height};
    a->before = rg_mem_array(mem, (size_t)height, row);
    a->rows = rg_mem_array(mem, (size_t)height, 1 + row);
    a->packed = rg_mem_array(mem, 4 + rg_deflate_room((1 + row) * (size_t)height), 1);
    set_delay(a, fps);
    rg_status s = a->before && a->rows && a->packed ? put_head(a, frames, why)
                                                    : rg_fail(RG_ENOMEM, why, 0, "out of memory for the APNG");
    if (s != RG_OK) {
        rg_apng_destroy(a);
        return s;
    }
    *apng = a;
    return RG_OK;
}

static size_t set_rows(rg_apng *a, const unsigned char *rgb, const rg_change *c)
{
    const size_t stride = RGB * (size_t)a->width, row = RGB * (size_t)c->width;
    const unsigned char *from = rgb + (size_t)c->top * stride + RGB * (size_t)c->left;
    unsigned char *to = a->rows;
    for (int32_t y = 0; y < c->height; y++, from += stride, to += row) {
        *to++ = AS_IT_IS;
        memcpy(to, from, row);
    }
    return (size_t)(to - a->rows);
}

static rg_status put_control(rg_apng *a, const rg_change *c, rg_diag *why)
{
    unsigned char control[26], *to = rg_png_number(control, a->sequence++, 4);
    to = rg_png_number(rg_png_number(to, (uint32_t)c->width, 4), (uint32_t)c->height, 4);
    to = rg_png_number(rg_png_number(to, (uint32_t)c->left, 4), (uint32_t)c->top, 4);
    to = rg_png_number(rg_png_number(to, a->delay, 2), a->unit, 2);
    *to++ = 0; /* leave it there afterwards */
    *to++ = 0; /* in place of what was there */
    return rg_png_chunk(a->file, "fcTL", control, sizeof control, why);
}

rg_status rg_apng_add(rg_apng *a, const unsigned char *rgb, rg_diag *why)
{
    const rg_change c = rg_change_find(rgb, a->frames > 0 ? a->before : NULL, a->width, a->height, RGB);
    rg_status s = put_control(a, &c, why);
    if (s != RG_OK) return s;
    const size_t n = rg_deflate_pack(a->rows, set_rows(a, rgb, &c), a->packed + 4);
    if (n == 0) return rg_fail(RG_ENOMEM, why, 0, "out of memory for the APNG");
    if (a->frames == 0) {
        s = rg_png_chunk(a->file, "IDAT", a->packed + 4, n, why);
    } else {
        rg_png_number(a->packed, a->sequence++, 4);
        s = rg_png_chunk(a->file, "fdAT", a->packed, 4 + n, why);
    }
    memcpy(a->before, rgb, RGB * (size_t)a->width * (size_t)a->height);
    a->frames++;
    return s;
}

rg_status rg_apng_finish(rg_apng *a, rg_diag *why) { return rg_png_chunk(a->file, "IEND", (const unsigned char *)"", 0, why); }

void rg_apng_destroy(rg_apng *a)
{
    if (!a) return;
    rg_mem_free(&a->mem, a->before);
    rg_mem_free(&a->mem, a->rows);
    rg_mem_free(&a->mem, a->packed);
    rg_mem_free(&a->mem, a);
}
