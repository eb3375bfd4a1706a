/* draw.h -- crease patterns drawn by tests.  Include after cmocka.h and near.h. */
#ifndef DRAW_H
#define DRAW_H

#include "pattern/pattern.h"
#include "pattern/build.h"

#include <stdlib.h>

static inline rg_lines drawing(void)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    rg_lines_init(&l, &mem);
    return l;
}

/* Lines are numbered from 1, as if they were those of a file. */
static inline void draw(rg_lines *l, char assignment, double x0, double y0, double x1, double y1)
{
    assert_int_equal(rg_lines_add(l, (rg_vec2){x0, y0}, (rg_vec2){x1, y1}, assignment, l->count + 1), RG_OK);
}

static inline void draw_polygon(rg_lines *l, char assignment, const rg_vec2 *x, int32_t n)
{
    for (int32_t i = 0; i < n; i++) draw(l, assignment, x[i].x, x[i].y, x[(i + 1) % n].x, x[(i + 1) % n].y);
}

static inline void draw_box(rg_lines *l, double x0, double y0, double x1, double y1)
{
    const rg_vec2 x[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    draw_polygon(l, RG_BORDER, x, 4);
}

/* x -> scale R(angle) x + (dx, dy) */
static inline void draw_moved(rg_lines *l, double scale, double angle, double dx, double dy)
{
    for (int32_t i = 0; i < l->count; i++)
        for (int end = 0; end < 2; end++) {
            rg_vec2 *x = end ? &l->line[i].b : &l->line[i].a, was = *x;
            *x = (rg_vec2){scale * (cos(angle) * was.x - sin(angle) * was.y) + dx, scale * (sin(angle) * was.x + cos(angle) * was.y) + dy};
        }
}

/* Takes the lines over. */
static inline rg_pattern *pattern_with(rg_lines *l, const rg_reading *s)
{
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    rg_status status = rg_pattern_from_lines(l, s, &p, &why);
    if (status != RG_OK) print_error("status %d, line %d: %s\n", status, why.line, why.text);
    assert_int_equal(status, RG_OK);
    return p;
}

static inline rg_pattern *pattern_of(rg_lines *l)
{
    rg_reading s = rg_reading_default();
    return pattern_with(l, &s);
}

static inline int whole_noise(unsigned *seed, int n) /* 0 ... n - 1 */
{
    return (int)((noise(seed) + 1) / 2 * n);
}

/* A sheet with facets of any shape: a jittered grid of n x n cells cut into triangles, from which inner edges are taken
 * out, each with probability `out`. Every third grid point is not moved, so that some corners are straight. What is left
 * may hang loose, or lie apart in a facet: then it is no disk, and the caller draws another one. */
static inline void draw_patchwork(rg_lines *l, int n, double out, unsigned *seed)
{
    rg_vec2 *x = malloc((size_t)(n + 1) * (size_t)(n + 1) * sizeof *x);
    assert_non_null(x);
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++) {
            const int inner = i > 0 && i < n && j > 0 && j < n && (i + 2 * j) % 3 != 0;
            const double dx = 0.3 * noise(seed), dy = 0.3 * noise(seed);
            x[i * (n + 1) + j] = (rg_vec2){i + inner * dx, j + inner * dy};
        }
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++)
            for (int way = 0; way < 3; way++) { /* right, up, across */
                const int u = i + (way != 1), v = j + (way != 0), rim = way == 0 ? j == 0 || j == n : way == 1 ? i == 0 || i == n : 0;
                if (u > n || v > n || (!rim && (noise(seed) + 1) / 2 < out)) continue;
                const rg_vec2 a = x[i * (n + 1) + j], b = x[u * (n + 1) + v];
                draw(l, rim ? RG_BORDER : noise(seed) < 0 ? RG_MOUNTAIN : RG_VALLEY, a.x, a.y, b.x, b.y);
            }
    free(x);
}

#endif
