/* Patterns from the caller's arrays: rigami.h, rg_pattern_create. */
#include "base/settings.h"
#include "base/status.h"
#include "pattern/build.h"

static char *name(const rg_memory *mem, const char *text, rg_status *s)
{
    char *copy = rg_mem_string(mem, text);
    if (text && !copy) *s = RG_ENOMEM;
    return copy;
}

static rg_status add_lines(const rg_drawing *d, int targets, rg_lines *l)
{
    rg_status s = RG_OK;
    l->metres = d->unit;
    l->title = name(&l->mem, d->title, &s);
    l->author = name(&l->mem, d->author, &s);
    for (int32_t e = 0; s == RG_OK && e < d->edges; e++) {
        const double *a = d->at[d->ends[e][0]], *b = d->at[d->ends[e][1]];
        s = rg_lines_add(l, (rg_vec2){a[0], a[1]}, (rg_vec2){b[0], b[1]}, d->assignment[e], e + 1);
        if (s == RG_OK && targets && d->target) l->line[e].target = d->target[e];
    }
    return s;
}

rg_status rg_pattern_create(const rg_drawing *drawing, const rg_reading *given, rg_pattern **pattern, rg_diag *why)
{
    rg_reading r;
    rg_drawing d;
    rg_lines l;
    rg_status s = rg_reading_take(given, &r, why);
    if (s == RG_OK) s = rg_drawing_take(drawing, &d, why);
    if (s != RG_OK) return s;
    const rg_memory mem = rg_mem_default(r.memory);
    rg_lines_init(&l, &mem);
    s = add_lines(&d, r.targets, &l);
    if (s == RG_OK && r.progress && r.progress(r.progress_ctx, 0)) s = RG_ECANCELLED;
    if (s == RG_OK) return rg_pattern_from_lines(&l, &r, pattern, why);
    rg_lines_free(&l);
    return rg_fail(s, why, 0, "%s", rg_status_text(s));
}
