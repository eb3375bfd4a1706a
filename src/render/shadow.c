#include "render/shadow.h"

#include <float.h>
#include <string.h>

/* Cells of the floor on a side: with the blur below, steps between them are below a grey level. */
enum { SIDE = 192 };
/* How soft it is: three running means of that many cells to each side, which is nearly a bell. */
enum { BLUR = 6, TIMES = 3, ROOM = BLUR * TIMES + 1 };
/* How dark it is at most. */
static const double DARKEST = 0.4;
/* From flatter than that, radians, the floor is a line and shadows have no end. */
static const double FLATTEST = 0.05;

rg_status rg_shadow_init(const rg_memory *mem, rg_shadow *s)
{
    *s = (rg_shadow){.mem = *mem};
    return RG_MEM_ARRAYS(mem, RG_ARRAY(s->dark, SIDE * SIDE), RG_ARRAY(s->work, SIDE));
}

void rg_shadow_free(rg_shadow *s)
{
    if (!s->mem.resize) return;
    RG_MEM_FREE(&s->mem, s->dark, s->work);
    memset(s, 0, sizeof *s);
}

/* Where a point's shadow falls. */
static rg_vec2 fall(rg_vec3 x, rg_vec3 lamp, double ground)
{
    const double up = (x.z - ground) / lamp.z;
    return (rg_vec2){x.x - up * lamp.x, x.y - up * lamp.y};
}

static int cell_of(double at) { return at > 0 ? at < SIDE ? (int)at : SIDE : 0; }

/* Cells whose middles are in the triangle, whichever way it runs. */
static void darken(rg_shadow *s, rg_vec2 a, rg_vec2 b, rg_vec2 c)
{
    const double whole = rg_vec2_turn(a, b, c), sign = whole < 0 ? -1 : 1;
    if (whole == 0) return;
    const double low = fmin(a.x, fmin(b.x, c.x)), high = fmax(a.x, fmax(b.x, c.x));
    const double bottom = fmin(a.y, fmin(b.y, c.y)), top = fmax(a.y, fmax(b.y, c.y));
    for (int row = cell_of((bottom - s->y) / s->cell); row < cell_of((top - s->y) / s->cell + 1); row++)
        for (int i = cell_of((low - s->x) / s->cell); i < cell_of((high - s->x) / s->cell + 1); i++) {
            const rg_vec2 p = {s->x + (i + 0.5) * s->cell, s->y + (row + 0.5) * s->cell};
            if (sign * rg_vec2_turn(a, b, p) >= 0 && sign * rg_vec2_turn(b, c, p) >= 0 &&
                sign * rg_vec2_turn(c, a, p) >= 0)
                s->dark[row * SIDE + i] = 1;
        }
}

/* The mean of 2 BLUR + 1 cells in a row, `apart` from each other in memory; beyond the floor there is no shadow. */
static void run(rg_shadow *s, float *first, int apart)
{
    float sum = 0;
    for (int i = 0; i < SIDE; i++) s->work[i] = first[i * apart];
    for (int i = 0; i < BLUR; i++) sum += s->work[i];
    for (int i = 0; i < SIDE; i++) {
        if (i + BLUR < SIDE) sum += s->work[i + BLUR];
        if (i > BLUR) sum -= s->work[i - BLUR - 1];
        first[i * apart] = sum / (2 * BLUR + 1);
    }
}

static void cast(rg_shadow *s, const rg_mesh *m, const rg_triangles *t, const rg_vec3 *x, rg_vec3 lamp, double ground)
{
    rg_vec2 low = {DBL_MAX, DBL_MAX}, high = {-DBL_MAX, -DBL_MAX};
    for (int32_t v = 0; v < m->nv; v++) {
        const rg_vec2 p = fall(x[v], lamp, ground);
        low.x = fmin(low.x, p.x), low.y = fmin(low.y, p.y), high.x = fmax(high.x, p.x), high.y = fmax(high.y, p.y);
    }
    s->cell = fmax(high.x - low.x, high.y - low.y) / (SIDE - 2 * ROOM);
    if (!(s->cell > 0)) s->cell = m->size / SIDE;
    s->x = 0.5 * (low.x + high.x - SIDE * s->cell), s->y = 0.5 * (low.y + high.y - SIDE * s->cell);
    memset(s->dark, 0, SIDE * SIDE * sizeof *s->dark);
    for (int32_t i = 0; i < t->start[m->nf]; i++)
        darken(s, fall(x[t->v[i][0]], lamp, ground), fall(x[t->v[i][1]], lamp, ground),
               fall(x[t->v[i][2]], lamp, ground));
    for (int time = 0; time < TIMES; time++)
        for (int i = 0; i < SIDE; i++) run(s, s->dark + i * SIDE, 1);
    for (int time = 0; time < TIMES; time++)
        for (int i = 0; i < SIDE; i++) run(s, s->dark + i, SIDE);
}

/* Between the middles of four cells; 0 outside. */
static double dark_at(const rg_shadow *s, double x, double y)
{
    const double u = (x - s->x) / s->cell - 0.5, v = (y - s->y) / s->cell - 0.5;
    if (!(u >= 0 && v >= 0 && u < SIDE - 1 && v < SIDE - 1)) return 0;
    const int i = (int)u, row = (int)v;
    const double a = u - i, b = v - row;
    const float *d = s->dark + row * SIDE + i;
    return (1 - b) * ((1 - a) * d[0] + a * d[1]) + b * ((1 - a) * d[SIDE] + a * d[SIDE + 1]);
}

void rg_shadow_draw(rg_shadow *s, const rg_mesh *m, const rg_triangles *t, const rg_vec3 *x, const rg_camera *c,
                    rg_vec3 lamp, int32_t width, int32_t height, unsigned char *rgb)
{
    if (!(c->back.z > sin(FLATTEST)) || !(lamp.z > sin(FLATTEST))) return;
    cast(s, m, t, x, lamp, c->ground);
    for (int32_t row = 0; row < height; row++) {
        const double v = (c->half_height - (row + 0.5)) / c->scale;
        for (int32_t i = 0; i < width; i++) {
            const double u = (i + 0.5 - c->half_width) / c->scale;
            const rg_vec3 d = rg_vec3_sub(rg_vec3_axpy(u, c->right, rg_vec3_scale(v, c->up)), c->back);
            if (!(d.z < 0)) continue;
            const double far = (c->ground - c->eye.z) / d.z,
                         dark = dark_at(s, c->eye.x + far * d.x, c->eye.y + far * d.y);
            if (!(dark > 0)) continue;
            unsigned char *p = rgb + 3 * ((size_t)row * (size_t)width + (size_t)i);
            for (int k = 0; k < 3; k++) p[k] = (unsigned char)(p[k] * (1 - DARKEST * dark) + 0.5);
        }
    }
}
