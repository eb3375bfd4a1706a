#include "render/render.h"
#include "base/status.h"
#include "render/canvas.h"
#include "render/ink.h"
#include "render/piled.h"
#include "render/shadow.h"

#include <string.h>

enum { FINE = RG_SAMPLES_FINE };
/* A picture is drawn in tiles of at most so many pixels a side: their samples stay in the cache, 1.3 MB of marks and as
 * much of depths, and are whole blocks of 64 as the software that mostly draws them has it. */
enum { TILE = 192 };

struct rg_render {
    rg_memory mem;
    const rg_mesh *mesh;
    const rg_triangles *triangles;
    const rg_print *print;
    rg_picture picture;
    rg_canvas canvas;
    rg_seen seen;
    rg_shadow shadow;
    int32_t tile_width, tile_height; /* pixels */
    uint32_t *triangle;              /* [3 triangles] corners of facets, as in mesh->facet_vertex, facet by facet */
    uint64_t *colour;                /* [samples of a tile] where samples have colours of their own, else NULL */
    uint32_t *count;                 /* [samples of a tile] facets, where light goes through them, else NULL */
    uint64_t ink[RG_SAMPLES_INKS];   /* colour by ink */
};

/* Triangles by their facets' corners, which are the same in every frame. corner_of: [nv] */
static void plan(rg_render *r, uint32_t *corner_of)
{
    const rg_mesh *m = r->mesh;
    const rg_triangles *t = r->triangles;
    for (int32_t f = 0; f < m->nf; f++) {
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) corner_of[m->facet_vertex[j]] = (uint32_t)j;
        for (int32_t i = t->start[f]; i < t->start[f + 1]; i++)
            for (int k = 0; k < 3; k++) r->triangle[3 * (size_t)i + (size_t)k] = corner_of[t->v[i][k]];
    }
    rg_ink_colours(r->ink);
}

static rg_status allocate(rg_render *r)
{
    const rg_mesh *m = r->mesh;
    const rg_picture *p = &r->picture;
    const size_t corners = 3 * (size_t)r->triangles->start[m->nf];
    if (corners > INT32_MAX || m->nf >= 1 << RG_SAMPLES_MARK_BITS) return RG_ENOMEM;
    rg_status s = rg_canvas_init(&r->mem, FINE * r->tile_width, FINE * r->tile_height, (size_t)m->facet_start[m->nf],
                                 corners, 1, &r->canvas);
    if (s == RG_OK) s = rg_seen_init(&r->mem, m, r->canvas.vertex, &r->seen);
    if (s == RG_OK && p->shadow) s = rg_shadow_init(&r->mem, &r->shadow);
    if (s != RG_OK) return s;
    const size_t samples = (size_t)r->canvas.width * (size_t)r->canvas.height;
    if (p->see_through > 0 && !(r->count = rg_mem_array(&r->mem, samples, sizeof *r->count))) return RG_ENOMEM;
    if ((r->count || r->print) && !(r->colour = rg_mem_array(&r->mem, samples, sizeof *r->colour))) return RG_ENOMEM;
    uint32_t *corner_of;
    s = RG_MEM_ARRAYS(&r->mem, RG_ARRAY(r->triangle, corners), RG_ARRAY(corner_of, (size_t)m->nv));
    if (s == RG_OK) plan(r, corner_of);
    rg_mem_free(&r->mem, corner_of);
    return s;
}

rg_status rg_render_create(const rg_memory *memory, const rg_mesh *m, const rg_triangles *t, const rg_picture *p,
                           const rg_print *print, rg_render **render, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(memory);
    rg_status s = rg_picture_check(p, why);
    if (s != RG_OK) return s;
    rg_render *r = rg_mem_array(&mem, 1, sizeof *r);
    if (!r) return rg_fail(RG_ENOMEM, why, 0, "out of memory for the picture");
    *r = (rg_render){.mem = mem, .mesh = m, .triangles = t, .picture = *p, .print = print};
    r->tile_width = p->width < TILE ? p->width : TILE;
    r->tile_height = p->height < TILE ? p->height : TILE;
    s = allocate(r);
    if (s != RG_OK) {
        rg_render_destroy(r);
        return rg_fail(s, why, 0, "out of memory for the picture");
    }
    *render = r;
    return RG_OK;
}

void rg_render_destroy(rg_render *r)
{
    if (!r) return;
    rg_seen_free(&r->seen);
    rg_shadow_free(&r->shadow);
    rg_canvas_free(&r->canvas);
    RG_MEM_FREE(&r->mem, r->triangle, r->colour, r->count, r);
}

typedef struct area { /* pixels */
    int32_t x, y, width, height;
} area;

static void draw_tile(rg_render *r, const rg_shot *shot, area a, unsigned char *rgb)
{
    const rg_triangles *t = r->triangles;
    const rg_box here = {(float)(FINE * a.x), (float)(FINE * a.y), (float)(FINE * (a.x + a.width)),
                         (float)(FINE * (a.y + a.height))};
    size_t corners = 0;
    for (int32_t f = 0; f < r->mesh->nf; f++) {
        if (!rg_box_meet(r->seen.box[f], here)) continue;
        const size_t n = 3 * (size_t)(t->start[f + 1] - t->start[f]);
        memcpy(r->canvas.corner + corners, r->triangle + 3 * (size_t)t->start[f], n * sizeof *r->triangle);
        corners += n;
    }
    if (corners == 0) return;
    const rg_samples tile = {r->canvas.mark, r->canvas.width, FINE * a.width, FINE * a.height,
                             FINE * a.x,     FINE * a.y,      r->colour};
    const rg_gl_scene scene = {r->canvas.vertex, r->canvas.corner, (int32_t)corners};
    if (shot->layers) rg_piled_draw(shot->layers, &r->seen, &scene, &tile);
    else rg_canvas_draw(&r->canvas, (int32_t)corners, tile.x, tile.y, tile.width, tile.height);
    const size_t stride = 3 * (size_t)r->picture.width;
    unsigned char *to = rgb + (size_t)a.y * stride + 3 * (size_t)a.x;
    if (r->print) rg_print_paint(r->print, &r->seen, shot, t, &r->picture, &tile);
    if (r->count) rg_print_see_through(&r->seen, &scene, &r->picture, &tile, r->count, to, stride);
    if (r->picture.lines != RG_LINES_NONE) rg_ink_draw(&r->seen, &r->picture, here, &tile);
    rg_samples_mean(&tile, r->seen.paper, r->ink, to, stride);
}

/* From 0 to `most`, also for what is no number. */
static int32_t within(double x, int32_t most) { return x > 0 ? x < most ? (int32_t)x : most : 0; }

static void fill(const rg_picture *p, unsigned char *rgb)
{
    const size_t stride = 3 * (size_t)p->width;
    for (int32_t x = 0; x < p->width; x++) memcpy(rgb + 3 * (size_t)x, p->background, 3);
    for (int32_t y = 1; y < p->height; y++) memcpy(rgb + (size_t)y * stride, rgb, stride);
}

void rg_render_frame(rg_render *r, const rg_shot *shot, unsigned char *rgb)
{
    const rg_picture *p = &r->picture;
    rg_seen_look(&r->seen, shot, p, FINE);
    const rg_box all = r->seen.all;
    const int32_t left = within(floor(all.left / FINE), p->width), right = within(ceil(all.right / FINE), p->width);
    const int32_t top = within(floor(all.top / FINE), p->height), bottom = within(ceil(all.bottom / FINE), p->height);
    fill(p, rgb);
    if (p->shadow)
        rg_shadow_draw(&r->shadow, r->mesh, r->triangles, shot->x, shot->camera, rg_seen_lamp(shot->camera), p->width,
                       p->height, rgb);
    for (area a = {.y = top}; a.y < bottom; a.y += r->tile_height)
        for (a.x = left; a.x < right; a.x += r->tile_width) {
            a.width = right - a.x < r->tile_width ? right - a.x : r->tile_width;
            a.height = bottom - a.y < r->tile_height ? bottom - a.y : r->tile_height;
            draw_tile(r, shot, a, rgb);
        }
}
