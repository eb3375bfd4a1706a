#include "render/print.h"
#include "render/raster.h"

#include <string.h>

enum { FINE = RG_SAMPLES_FINE };
#define MARK ((UINT32_C(1) << RG_SAMPLES_MARK_BITS) - 1)

/* ---- a picture on the paper */

/* From a place in the picture, (x, y, 1) in samples, to one on the pattern's box, (u w, v w, w), both 0 ... 1 and v
 * down. */
typedef struct map { double row[3][3]; } map;

/* The ray through a sample meets the facet's plane at P + a (Q - P) + b (R - P) with (a, b, 1) ~ [Q - P, R - P, P -
 * eye]^-1 ray; the inverse by cross products. */
static map map_of(const rg_mesh *m, const rg_shot *shot, const rg_triangles *t, int32_t f, rg_vec2 low, rg_vec2 size)
{
    const rg_camera *c = shot->camera;
    const int32_t *v = t->v[t->largest[f]];
    const rg_vec3 lift = shot->lift ? shot->lift[f] : (rg_vec3){0, 0, 0},
                  p = rg_vec3_sub(rg_vec3_add(shot->x[v[0]], lift), c->eye);
    const rg_vec3 a = rg_vec3_sub(shot->x[v[1]], shot->x[v[0]]), b = rg_vec3_sub(shot->x[v[2]], shot->x[v[0]]);
    const rg_vec3 row[3] = {rg_vec3_cross(b, p), rg_vec3_cross(p, a), rg_vec3_cross(a, b)};
    /* ray = ((x / FINE - half width) right - (y / FINE - half height) up) / scale - back */
    const rg_vec3 dx = rg_vec3_scale(1 / (FINE * c->scale), c->right),
                  dy = rg_vec3_scale(-1 / (FINE * c->scale), c->up);
    const rg_vec3 d0 = rg_vec3_sub(
        rg_vec3_axpy(-c->half_width / c->scale, c->right, rg_vec3_scale(c->half_height / c->scale, c->up)), c->back);
    const rg_vec2 X = m->X[v[0]], A = rg_vec2_sub(m->X[v[1]], X), B = rg_vec2_sub(m->X[v[2]], X);
    map out;
    const rg_vec3 along[3] = {dx, dy, d0};
    for (int i = 0; i < 3; i++) {
        const double ha = rg_vec3_dot(row[0], along[i]), hb = rg_vec3_dot(row[1], along[i]),
                     h = rg_vec3_dot(row[2], along[i]);
        out.row[0][i] = (h * (X.x - low.x) + ha * A.x + hb * B.x) / size.x;
        out.row[1][i] = h - (h * (X.y - low.y) + ha * A.y + hb * B.y) / size.y;
        out.row[2][i] = h;
    }
    return out;
}

static const unsigned char *pixel_at(const rg_print *p, const map *g, double x, double y)
{
    double h[3];
    for (int i = 0; i < 3; i++) h[i] = g->row[i][0] * x + g->row[i][1] * y + g->row[i][2];
    const double u = h[0] / h[2] * p->width, v = h[1] / h[2] * p->height;
    const int32_t i = u > 0 ? u < p->width ? (int32_t)u : p->width - 1 : 0,
                  j = v > 0 ? v < p->height ? (int32_t)v : p->height - 1 : 0;
    return p->rgba + 4 * ((size_t)j * (size_t)p->width + (size_t)i);
}

void rg_print_paint(const rg_print *print, const rg_seen *s, const rg_shot *shot, const rg_triangles *t,
                    const rg_picture *p, const rg_samples *tile)
{
    const rg_mesh *m = s->mesh;
    rg_vec2 low = m->X[0], high = m->X[0];
    for (int32_t v = 1; v < m->nv; v++) {
        low = (rg_vec2){fmin(low.x, m->X[v].x), fmin(low.y, m->X[v].y)};
        high = (rg_vec2){fmax(high.x, m->X[v].x), fmax(high.y, m->X[v].y)};
    }
    const rg_vec2 size = rg_vec2_sub(high, low);
    map g = {{{0}}};
    uint32_t of = 0; /* the mark that g is of: neighbours mostly show one facet */
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const size_t at = (size_t)y * (size_t)tile->pitch + (size_t)x;
            const uint32_t mark = tile->at[at] & MARK;
            if (!mark) continue;
            tile->colour[at] = s->paper[mark];
            if (!s->front[mark - 1]) continue;
            if (mark != of) g = map_of(m, shot, t, (int32_t)mark - 1, low, size), of = mark;
            const unsigned char *c = pixel_at(print, &g, tile->x + x + 0.5, tile->y + y + 0.5);
            const double *light = s->light[mark - 1];
            unsigned char rgb[3];
            for (int k = 0; k < 3; k++)
                rgb[k] = (unsigned char)(light[k] * (c[3] * c[k] + (255 - c[3]) * p->front[k]) / 255 + 0.5);
            tile->colour[at] = rg_samples_colour(rgb);
        }
}

/* ---- light that goes through */

typedef struct layers {
    const rg_seen *seen;
    const rg_samples *tile;
    uint32_t *count;
} layers;

/* More would not fit where colours are added up, and are dark in any case. */
enum { MOST = 2000 };

static void add(void *ctx, uint32_t mark, int32_t row, int32_t first, int32_t last)
{
    const layers *l = ctx;
    const size_t at = (size_t)row * (size_t)l->tile->pitch;
    for (int32_t i = first; i < last; i++)
        if (l->count[at + (size_t)i] < MOST) {
            l->tile->colour[at + (size_t)i] += l->seen->paper[mark];
            l->count[at + (size_t)i]++;
        }
}

/* The mean colour of n layers with their light, seen before what is behind: T^n of that comes through, and each layer
 * takes some of the light from those behind it. */
static uint64_t through(uint64_t sum, uint32_t n, double clear, const unsigned char *behind)
{
    unsigned char rgb[3];
    const double passes = pow(clear, n), dims = 0.7 + 0.3 * pow(0.8, n - 1);
    for (int k = 0; k < 3; k++) {
        const double mean = (double)(sum >> 20 * k & 0xfffff) / n * dims;
        rgb[k] = (unsigned char)(passes * behind[k] + (1 - passes) * mean + 0.5);
    }
    return rg_samples_colour(rgb);
}

void rg_print_see_through(const rg_seen *s, const rg_gl_scene *scene, const rg_picture *p, const rg_samples *tile,
                          uint32_t *count, const unsigned char *rgb, size_t stride)
{
    layers l = {s, tile, count};
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const size_t at = (size_t)y * (size_t)tile->pitch + (size_t)x;
            tile->colour[at] = 0, count[at] = 0;
        }
    rg_raster_cover(scene, tile->x, tile->y, tile->width, tile->height, add, &l);
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const size_t at = (size_t)y * (size_t)tile->pitch + (size_t)x;
            const unsigned char *behind = rgb + (size_t)(y / FINE) * stride + 3 * (size_t)(x / FINE);
            const uint32_t mark = tile->at[at] & MARK;
            if (count[at] > 0) tile->colour[at] = through(tile->colour[at], count[at], p->see_through, behind);
            else if (mark) tile->colour[at] = s->paper[mark]; /* on an edge OpenGL may see a facet where we do not */
        }
}
