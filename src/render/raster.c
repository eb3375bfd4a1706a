#include "render/raster.h"

#include <math.h>
#include <string.h>

/* A triangle's corners from the top row down, and from left to right in one row, so that an edge gives the same places
 * for both of its triangles. */
typedef struct triangle { double x[3], y[3]; } triangle;

static int above(const rg_gl_vertex *a, const rg_gl_vertex *b) { return a->y < b->y || (a->y == b->y && a->x <= b->x); }

static triangle in_order(const rg_gl_vertex *a, const rg_gl_vertex *b, const rg_gl_vertex *c, int32_t x, int32_t y)
{
    const rg_gl_vertex *v[3] = {a, b, c};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2 - i; j++)
            if (!above(v[j], v[j + 1])) {
                const rg_gl_vertex *swap = v[j];
                v[j] = v[j + 1], v[j + 1] = swap;
            }
    triangle t;
    for (int i = 0; i < 3; i++) t.x[i] = (double)v[i]->x - x, t.y[i] = (double)v[i]->y - y;
    return t;
}

/* The first sample whose middle is not before `at`. */
static int32_t first_from(double at, int32_t most)
{
    const double n = ceil(at - 0.5);
    return n > 0 ? n < most ? (int32_t)n : most : 0;
}

static double along(const triangle *t, int from, int to, double y)
{
    const double high = t->y[to] - t->y[from];
    return high > 0 ? t->x[from] + (t->x[to] - t->x[from]) * ((y - t->y[from]) / high) : t->x[from];
}

/* first ... last - 1: the samples of a row that are inside. */
static void span(const triangle *t, int32_t row, int32_t width, int32_t *first, int32_t *last)
{
    const double y = row + 0.5, far = along(t, 0, 2, y), near = y < t->y[1] ? along(t, 0, 1, y) : along(t, 1, 2, y);
    *first = first_from(fmin(far, near), width);
    *last = first_from(fmax(far, near), width);
}

void rg_raster_draw(const rg_gl_scene *s, int32_t x, int32_t y, int32_t width, int32_t height, uint32_t *mark,
                    double *depth, int32_t pitch)
{
    for (int32_t row = 0; row < height; row++) {
        memset(mark + (size_t)row * (size_t)pitch, 0, (size_t)width * sizeof *mark);
        for (int32_t i = 0; i < width; i++) depth[(size_t)row * (size_t)pitch + (size_t)i] = 1;
    }
    for (int32_t k = 0; k + 2 < s->corners; k += 3) {
        const rg_gl_vertex *a = &s->vertex[s->corner[k]], *b = &s->vertex[s->corner[k + 1]],
                           *c = &s->vertex[s->corner[k + 2]];
        const double ux = (double)b->x - a->x, uy = (double)b->y - a->y, vx = (double)c->x - a->x,
                     vy = (double)c->y - a->y;
        const double turn = ux * vy - uy * vx, uz = (double)b->z - a->z, vz = (double)c->z - a->z;
        if (!(fabs(turn) > 0)) continue;
        const double by_x = (uz * vy - vz * uy) / turn, by_y = (vz * ux - uz * vx) / turn;
        /* Where a triangle is seen from its edge, the plane is steep: no depth is outside that of the corners. */
        const double least = fmin(a->z, fmin(b->z, c->z)), most = fmax(a->z, fmax(b->z, c->z));
        const triangle t = in_order(a, b, c, x, y);
        const int32_t bottom = first_from(t.y[2], height);
        for (int32_t row = first_from(t.y[0], height); row < bottom; row++) {
            int32_t first, last;
            span(&t, row, width, &first, &last);
            const double from = a->z + by_y * (row + 0.5 + y - a->y) + by_x * (0.5 + x - a->x);
            uint32_t *m = mark + (size_t)row * (size_t)pitch;
            double *d = depth + (size_t)row * (size_t)pitch;
            for (int32_t i = first; i < last; i++) {
                const double z = fmin(most, fmax(least, from + by_x * i));
                if (z < d[i]) d[i] = z, m[i] = a->mark;
            }
        }
    }
}

void rg_raster_cover(const rg_gl_scene *s, int32_t x, int32_t y, int32_t width, int32_t height, rg_raster_take take,
                     void *ctx)
{
    for (int32_t k = 0; k + 2 < s->corners; k += 3) {
        const rg_gl_vertex *a = &s->vertex[s->corner[k]];
        const triangle t = in_order(a, &s->vertex[s->corner[k + 1]], &s->vertex[s->corner[k + 2]], x, y);
        const int32_t bottom = first_from(t.y[2], height);
        for (int32_t row = first_from(t.y[0], height); row < bottom; row++) {
            int32_t first, last;
            span(&t, row, width, &first, &last);
            if (first < last) take(ctx, a->mark, row, first, last);
        }
    }
}
