#include "render/frames.h"
#include "base/status.h"
#include "base/text.h"
#include "motion/ending.h"
#include "render/caption.h"
#include "render/lift.h"
#include "render/render.h"
#include "render/tint.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

/* More would mostly wait: OpenGL in software has its own threads, and layers are found by one thread at a time. */
enum { MOST_THREADS = 8 };

/* The motion's allocator, for one thread at a time. */
typedef struct guard {
    pthread_mutex_t lock;
    rg_memory mem;
} guard;

typedef struct studio {
    const rg_motion *motion;
    const rg_frames *wish;
    guard guard;
    rg_memory mem; /* through the guard */
    rg_triangles triangles;
    rg_lift *layers;
    rg_stage stage;
    rg_camera *camera; /* [frames] */
    rg_tint_scale tint;
    char title[200];   /* of the caption */
    pthread_mutex_t lock;
    pthread_cond_t moved;
    int32_t next, taken; /* frame to be drawn next, to be taken next */
    rg_status status;
    rg_diag *why;
} studio;

typedef struct painter {
    studio *studio;
    int is_first; /* in the caller's thread */
    rg_render *render;
    rg_vec3 *x, *lift;
    unsigned char (*tint)[3]; /* [nf] */
    unsigned char *rgb;
    pthread_t thread;
} painter;

static void *guarded_resize(void *ctx, void *block, size_t bytes)
{
    guard *g = ctx;
    pthread_mutex_lock(&g->lock);
    void *p = g->mem.resize(g->mem.ctx, block, bytes);
    pthread_mutex_unlock(&g->lock);
    return p;
}

static int is_wanted(const rg_frames *w, int32_t frame)
{
    return frame >= w->first && (frame - w->first) % w->step == 0;
}

/* The next frame that is wanted, in *frame; 0: there is none. Layers follow from frame to frame, so that all frames are
 * gone through, one thread at a time. */
static int next_frame(painter *p, int32_t *frame)
{
    studio *s = p->studio;
    int found = 0;
    pthread_mutex_lock(&s->lock);
    while (!found && s->status == RG_OK && s->next < s->motion->report.frame_count) {
        s->status = rg_lift_next(s->layers, p->x, p->lift);
        if (s->status != RG_OK) rg_fail(s->status, s->why, 0, "%s", rg_status_text(s->status));
        *frame = s->next++;
        found =
            s->status == RG_OK && is_wanted(s->wish, *frame) && !(s->wish->has && s->wish->has(s->wish->ctx, *frame));
    }
    if (s->status != RG_OK) pthread_cond_broadcast(&s->moved);
    pthread_mutex_unlock(&s->lock);
    return found;
}

/* In the caller's thread: tells how far it is. Zero: it is to end. */
static int goes_on(studio *s)
{
    const rg_frames *w = s->wish;
    const rg_picture *p = &w->picture;
    pthread_mutex_lock(&s->lock);
    const double done = (double)(s->taken - w->first) / (s->motion->report.frame_count - w->first);
    pthread_mutex_unlock(&s->lock);
    if (!p->progress || p->progress(p->progress_ctx, fmin(1, done)) == 0) return 1;
    pthread_mutex_lock(&s->lock);
    if (s->status == RG_OK) s->status = rg_fail(RG_ECANCELLED, s->why, 0, "%s", rg_status_text(RG_ECANCELLED));
    pthread_cond_broadcast(&s->moved);
    pthread_mutex_unlock(&s->lock);
    return 0;
}

/* Waits for the frame's turn; 0: there is none, something failed. */
static int wait_turn(studio *s, int32_t frame)
{
    pthread_mutex_lock(&s->lock);
    while (s->status == RG_OK && s->taken != frame) pthread_cond_wait(&s->moved, &s->lock);
    const int go = s->status == RG_OK;
    pthread_mutex_unlock(&s->lock);
    return go;
}

static void end_turn(studio *s, rg_status status, const rg_diag *why)
{
    pthread_mutex_lock(&s->lock);
    if (s->status == RG_OK && status != RG_OK) {
        s->status = status;
        if (s->why) *s->why = *why;
    }
    s->taken += s->wish->step;
    pthread_cond_broadcast(&s->moved);
    pthread_mutex_unlock(&s->lock);
}

static void caption(const studio *s, int32_t frame, unsigned char *rgb)
{
    const rg_picture *p = &s->wish->picture;
    unsigned char ink[3];
    char percent[40];
    /* What is short of the end, by more than a tenth shows, is not rounded up to it. */
    const double folded = s->motion->frame[frame].percent;
    rg_text(percent, sizeof percent, "%.0f %%", folded < 99.95 ? fmin(folded, 99) : folded);
    rg_caption_ink(p->background, ink);
    rg_caption_draw(s->title, percent, ink, p->width, p->height, rgb);
}

static void *paint(void *ctx)
{
    painter *p = ctx;
    studio *s = p->studio;
    const rg_frames *w = s->wish;
    for (int32_t frame; next_frame(p, &frame);) {
        rg_diag why = {0, ""};
        if (p->is_first && !goes_on(s)) break;
        rg_stage_put(&s->stage, frame, p->x, s->motion->mesh.nv);
        rg_stage_turn(&s->stage, frame, p->lift, s->motion->mesh.nf);
        if (p->tint) rg_tint_facets(&s->tint, s->motion, frame, p->lift, p->tint);
        const rg_shot shot = {p->x, p->lift, &s->camera[frame], (const unsigned char(*)[3])p->tint,
                              rg_ending_layers(s->motion, frame)};
        rg_render_frame(p->render, &shot, p->rgb);
        if (w->picture.caption) caption(s, frame, p->rgb);
        if (w->in_order && !wait_turn(s, frame)) break;
        const rg_status status = w->take(w->ctx, &s->mem, frame, p->rgb, &why);
        end_turn(s, status, &why);
    }
    return NULL;
}

static rg_status painter_init(painter *p, studio *s)
{
    const rg_picture *picture = &s->wish->picture;
    *p = (painter){.studio = s};
    rg_status status =
        rg_render_create(&s->mem, &s->motion->mesh, &s->triangles, picture, s->wish->print, &p->render, s->why);
    if (status != RG_OK) return status;
    const size_t nf = (size_t)s->motion->mesh.nf;
    status = RG_MEM_ARRAYS(&s->mem, RG_ARRAY(p->x, (size_t)s->motion->mesh.nv), RG_ARRAY(p->lift, nf),
                           RG_ARRAY(p->rgb, 3 * (size_t)picture->width * (size_t)picture->height));
    if (status == RG_OK && s->tint.by != RG_COLOUR_PAPER) status = RG_MEM_ARRAYS(&s->mem, RG_ARRAY(p->tint, nf));
    return status == RG_OK ? status : rg_fail(status, s->why, 0, "out of memory for the picture");
}

static void painter_free(painter *p)
{
    if (!p->studio) return;
    const rg_memory *mem = &p->studio->mem;
    rg_render_destroy(p->render);
    RG_MEM_FREE(mem, p->x, p->lift, p->rgb, p->tint);
    *p = (painter){0};
}

/* One of them is the caller's thread; where no other can be had, it does all. Signals are left to the caller's. */
static void paint_all(painter *p, int32_t count)
{
    sigset_t all, old;
    int32_t started = 1;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    while (started < count && pthread_create(&p[started].thread, NULL, paint, &p[started]) == 0) started++;
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    paint(&p[0]);
    for (int32_t i = 1; i < started; i++) pthread_join(p[i].thread, NULL);
}

static int32_t threads_for(const rg_motion *m, const rg_frames *f)
{
    const int32_t frames = (m->report.frame_count - 1 - f->first) / f->step + 1;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const int32_t here = processors < 1 ? 1 : processors > MOST_THREADS ? MOST_THREADS : (int32_t)processors;
    const int32_t n = f->threads > 0 ? f->threads : here;
    return n < frames ? n : frames;
}

/* One painter is enough: less memory, fewer threads. */
static rg_status draw(studio *s)
{
    const int32_t wished = threads_for(s->motion, s->wish);
    painter *p = rg_mem_array(&s->mem, (size_t)wished, sizeof *p);
    if (!p) return rg_fail(RG_ENOMEM, s->why, 0, "out of memory for the picture");
    rg_status status = painter_init(&p[0], s);
    int32_t count = 1;
    rg_diag *why = s->why, unused;
    s->why = &unused;
    while (status == RG_OK && count < wished && painter_init(&p[count], s) == RG_OK) count++;
    if (count < wished) painter_free(&p[count]);
    s->why = why;
    p[0].is_first = 1;
    if (status == RG_OK) paint_all(p, count);
    for (int32_t i = 0; i < count; i++) painter_free(&p[i]);
    rg_mem_free(&s->mem, p);
    return status != RG_OK ? status : s->status;
}

/* Stage, camera, triangles, layers. */
static rg_status set_up(studio *s)
{
    const rg_motion *m = s->motion;
    char tells[80];
    s->tint = rg_tint_of(m, s->wish->picture.colour);
    rg_tint_words(&s->tint, tells, sizeof tells);
    const char *title = m->title && *m->title ? m->title : s->wish->picture.title ? s->wish->picture.title : "";
    rg_text(s->title, sizeof s->title, "%s%s%s", title, *title && *tells ? ": " : "", tells);
    rg_status status = rg_picture_check(&s->wish->picture, s->why);
    if (status != RG_OK) return status;
    s->camera = rg_mem_array(&s->mem, (size_t)m->report.frame_count, sizeof *s->camera);
    status = s->camera ? rg_stage_init(&s->mem, m, &s->wish->picture, &s->stage) : RG_ENOMEM;
    if (status == RG_OK) {
        status = rg_camera_follow(&s->stage, &s->wish->picture, s->camera, s->why);
        if (status != RG_OK) return status;
    }
    if (status == RG_OK) status = rg_triangles_init(&s->mem, &m->mesh, &s->triangles);
    if (status == RG_OK) status = rg_lift_create(&s->mem, m, &s->triangles, &s->layers);
    return status == RG_OK ? status : rg_fail(status, s->why, 0, "%s", rg_status_text(status));
}

rg_status rg_frames_draw(const rg_motion *m, const rg_frames *f, rg_diag *why)
{
    studio s = {.motion = m, .wish = f, .guard = {.mem = m->mem}, .taken = f->first, .why = why};
    pthread_mutex_init(&s.guard.lock, NULL);
    pthread_mutex_init(&s.lock, NULL);
    pthread_cond_init(&s.moved, NULL);
    s.mem = (rg_memory){guarded_resize, &s.guard};
    rg_status status = set_up(&s);
    if (status == RG_OK) status = draw(&s);
    rg_lift_destroy(s.layers);
    rg_triangles_free(&s.triangles);
    rg_stage_free(&s.stage);
    rg_mem_free(&s.mem, s.camera);
    pthread_cond_destroy(&s.moved);
    pthread_mutex_destroy(&s.lock);
    pthread_mutex_destroy(&s.guard.lock);
    return status;
}
