#include "write/key.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* FNV-1a of eight bytes at a time, stirred as in splitmix64: nobody forges what he has folded himself. */
static uint64_t add(uint64_t key, const void *bytes, size_t n)
{
    const unsigned char *at = bytes;
    for (; n > 0;) {
        uint64_t word = 0;
        const size_t k = n < sizeof word ? n : sizeof word;
        memcpy(&word, at, k);
        key = (key ^ word) * UINT64_C(0x100000001b3);
        key ^= key >> 29;
        at += k, n -= k;
    }
    return key;
}

static uint64_t add_text(uint64_t key, const char *text)
{
    return text ? add(key, text, strlen(text) + 1) : add(key, "", 1);
}

static uint64_t add_motion(uint64_t key, const rg_motion *m)
{
    const rg_mesh *g = &m->mesh;
    const size_t nv = (size_t)g->nv, ne = (size_t)g->ne, nf = (size_t)g->nf, N = (size_t)g->N,
                 frames = (size_t)m->report.frame_count;
    key = add(add(add(key, &nv, sizeof nv), &ne, sizeof ne), &frames, sizeof frames);
    key = add(add(key, g->X, nv * sizeof *g->X), g->edge, ne * sizeof *g->edge);
    key = add(add(key, g->assignment, ne), g->facet_start, (nf + 1) * sizeof *g->facet_start);
    key = add(key, g->facet_vertex, (size_t)g->facet_start[nf] * sizeof *g->facet_vertex);
    if (m->rho) key = add(key, m->rho, frames * N * sizeof *m->rho);
    if (m->flat) key = add(key, m->flat, frames * nv * sizeof *m->flat);
    if (m->space) key = add(key, m->space, frames * nv * sizeof *m->space);
    for (size_t k = 0; k < frames; k++) key = add(key, &m->frame[k].percent, sizeof m->frame[k].percent);
    return add_text(key, m->title);
}

/* Field by field: between them is what nobody has set. What only films and models go by is not among them. */
static uint64_t add_picture(uint64_t key, const rg_picture *p)
{
    const double numbers[] = {p->azimuth,   p->elevation,  p->zoom,       p->target[0],
                              p->target[1], p->line_width, p->see_through};
    const int32_t whole[] = {p->width,          p->height, p->aimed,   p->targeted,
                             (int32_t)p->lines, p->shadow, p->caption, (int32_t)p->colour};
    key = add(add(key, numbers, sizeof numbers), whole, sizeof whole);
    key = add(add(add(key, p->front, 3), p->back, 3), p->background, 3);
    return add_text(key, p->title);
}

const char *rg_key_of(const rg_motion *m, const rg_picture *p, const rg_print *print, char text[RG_KEY_ROOM])
{
    uint64_t key = add_text(UINT64_C(0xcbf29ce484222325), RG_VERSION);
    key = add_picture(add_motion(key, m), p);
    if (print)
        key = add(add(key, &print->width, sizeof print->width), print->rgba,
                  4 * (size_t)print->width * (size_t)print->height);
    snprintf(text, RG_KEY_ROOM, "%016" PRIx64, key);
    return text;
}
