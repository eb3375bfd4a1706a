/* One state as a picture of its own: rigami.h, rg_motion_draw and rg_fold_draw. */
#include "base/status.h"
#include "motion/fold.h"
#include "render/frames.h"
#include "render/picture.h"
#include "write/png.h"

#include <string.h>

typedef struct sheet_of_pixels { unsigned char *rgb; size_t bytes; } sheet_of_pixels;

static rg_status take(void *ctx, const rg_memory *mem, int32_t frame, const unsigned char *rgb, rg_diag *why)
{
    const sheet_of_pixels *to = ctx;
    (void)mem, (void)frame, (void)why;
    memcpy(to->rgb, rgb, to->bytes);
    return RG_OK;
}

/* A motion of one frame, its arrays lent. */
static rg_status draw(const rg_motion *one, const rg_picture *p, unsigned char *rgb, rg_diag *why)
{
    sheet_of_pixels to = {rgb, 3 * (size_t)p->width * (size_t)p->height};
    rg_print print = {NULL, 0, 0};
    unsigned char *rgba = NULL;
    rg_status s = p->image ? rg_png_read(&one->mem, p->image, &print.width, &print.height, &rgba, why) : RG_OK;
    if (s != RG_OK) return s;
    print.rgba = rgba;
    const rg_frames f = {
        .picture = *p, .print = p->image ? &print : NULL, .step = 1, .threads = 1, .take = take, .ctx = &to};
    s = rg_frames_draw(one, &f, why);
    rg_mem_free(&one->mem, rgba);
    return s;
}

rg_status rg_motion_draw(const rg_motion *m, int32_t frame, const rg_picture *picture, unsigned char *rgb, rg_diag *why)
{
    rg_picture p;
    rg_status s = rg_picture_take(picture, &p, why);
    if (s != RG_OK) return s;
    if (frame < 0 || frame >= m->report.frame_count)
        return rg_fail(RG_EARG, why, 0, "there is no frame %d", (int)frame);
    rg_motion one = *m;
    const size_t k = (size_t)frame, N = (size_t)m->mesh.N, nv = (size_t)m->mesh.nv;
    one.rho += k * N;
    one.frame += k;
    if (one.flat) one.flat += k * nv;
    if (one.space) one.space += k * nv;
    one.ends_flat = m->ends_flat && frame == m->report.frame_count - 1;
    one.report.frame_count = 1;
    one.report.frames = one.frame;
    return draw(&one, &p, rgb, why);
}

rg_status rg_fold_draw(const rg_fold *f, const rg_picture *picture, unsigned char *rgb, rg_diag *why)
{
    rg_picture p;
    rg_status s = rg_picture_take(picture, &p, why);
    if (s != RG_OK) return s;
    rg_motion one = *f->shared->motion;
    rg_frame frame = {100 * f->progress, f->closure};
    one.rho = f->rho;
    one.flat = f->flat;
    one.space = NULL;
    one.frame = &frame;
    one.ends_flat = one.ends_flat && !f->steered && !f->between && f->at == one.report.frame_count - 1;
    one.report.frame_count = 1;
    one.report.frames = &frame;
    return draw(&one, &p, rgb, why);
}
