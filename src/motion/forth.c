#include "motion/forth.h"

#include <string.h>

int32_t rg_forth_parts(const rg_settings *s)
{
    const int lands = s->method != RG_METHOD_AUTO && s->method != RG_METHOD_ADAPTIVE;
    return lands ? 1 : rg_gaps_parts(s->frames - 1, fabs(s->to), 0);
}

typedef struct keeper {
    rg_forth *r;
    int looks;          /* for what lies between */
    rg_gap_filler between;
    double *last;       /* [N] what was kept last, at: */
    double s;           /* of it, as it was due */
    double is_at;       /* and as it is */
} keeper;

static int read(void *ctx, double progress, double *rho, rg_vec2 *X)
{
    (void)X; /* it is the pattern given */
    return rg_straight_between(ctx, progress, rho);
}

/* Keeps where f is, at progress s, as the next frame or as a state before it, and what is needed between it and what
 * was kept last. */
static rg_status keep(keeper *k, double s, int is_frame)
{
    rg_forth *r = k->r;
    const rg_mesh *m = &r->f->mesh;
    const size_t N = (size_t)m->N;
    const double *rho = r->f->rho;
    rg_status status = RG_OK;
    if (k->looks && r->count > 0) status = rg_gap_fill(&k->between, r->count - 1, k->s, k->last, s, rho);
    if (is_frame && r->due) r->due[r->count] = s;
    if (status == RG_OK && is_frame) memcpy(r->rho + (size_t)r->count++ * N, rho, N * sizeof *rho);
    else if (status == RG_OK) status = rg_gaps_add(r->gaps, &k->between.mem, m, r->count - 1, rho, NULL);
    memcpy(k->last, rho, N * sizeof *rho);
    k->s = s;
    k->is_at = r->f->s;
    return status;
}

/* What was kept last is no frame. */
static int ends_between(const rg_forth *r)
{
    return r->gaps->count > 0 && r->gaps->after[r->gaps->count - 1] == r->count - 1;
}

rg_status rg_forth_run(rg_forth *r, const rg_memory *mem, rg_watch *watch)
{
    rg_straight *f = r->f;
    keeper k = {.r = r, .looks = 1, .is_at = -1};
    rg_step_info info = {0};
    r->count = 0;
    k.last = rg_mem_array(mem, (size_t)f->mesh.N, sizeof *k.last);
    rg_status s = rg_gap_filler_init(&k.between, mem, &f->mesh, r->gaps, 0, read, f);
    if (!k.last) s = RG_ENOMEM;
    while (s == RG_OK && info.outcome == RG_RUNNING) {
        s = rg_straight_step(f, &info);
        if (s == RG_OK && r->trace) s = rg_trace_follow(r->trace, f);
        if (s == RG_OK && info.frame >= 0)
            s = keep(&k, rg_straight_frame_progress(f, info.frame), info.frame % r->parts == 0);
        if (rg_watch_tell(watch, f->s_end > 0 ? info.progress / f->s_end : 1)) break;
    }
    k.looks = f->apart.parts == 0; /* the progress of several is none that one could be read off at */
    const int more = s == RG_OK && (f->s != k.is_at || ends_between(r));
    if (more && f->s == k.is_at) r->gaps->count--; /* it becomes the last frame */
    if (more) s = keep(&k, f->s, 1);
    r->outcome = info.outcome;
    rg_gap_filler_free(&k.between);
    rg_mem_free(mem, k.last);
    return s;
}
