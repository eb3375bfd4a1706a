/* affine.h -- affine maps of the plane, by value: where a drawing puts what is drawn elsewhere.
 * Uses  vec.h        Used by  paint.h space.c */
#ifndef RG_AFFINE_H
#define RG_AFFINE_H

#include "base/vec.h"

typedef struct rg_affine { double a, b, c, d, e, f; } rg_affine; /* x' = a x + c y + e, y' = b x + d y + f */

static inline rg_affine rg_affine_shift(double x, double y) { return (rg_affine){1, 0, 0, 1, x, y}; }
static inline rg_affine rg_affine_scale(double x, double y) { return (rg_affine){x, 0, 0, y, 0, 0}; }

/* q first, then p. */
static inline rg_affine rg_affine_mul(rg_affine p, rg_affine q)
{
    return (rg_affine){p.a * q.a + p.c * q.b, p.b * q.a + p.d * q.b, p.a * q.c + p.c * q.d, p.b * q.c + p.d * q.d,
                       p.a * q.e + p.c * q.f + p.e, p.b * q.e + p.d * q.f + p.f};
}

static inline rg_vec2 rg_affine_point(rg_affine m, rg_vec2 x)
{
    return (rg_vec2){m.a * x.x + m.c * x.y + m.e, m.b * x.x + m.d * x.y + m.f};
}

/* From the axis of x towards that of y; exact at quarter turns. */
static inline rg_affine rg_affine_turn(double degrees)
{
    const double quarter = degrees / 90;
    double c = cos(degrees * RG_DEG), s = sin(degrees * RG_DEG);
    if (isfinite(quarter) && quarter == floor(quarter)) {
        const int turns = (int)fmod(fmod(quarter, 4) + 4, 4);
        c = turns == 0 ? 1 : turns == 2 ? -1 : 0;
        s = turns == 1 ? 1 : turns == 3 ? -1 : 0;
    }
    return (rg_affine){c, s, -s, c, 0, 0};
}

#endif
