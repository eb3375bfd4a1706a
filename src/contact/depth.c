#include "contact/depth.h"

/* Sine of the angle of edges that count as parallel: their cross product is no axis, and what lies in one plane with
 * them is told by the normals. */
static const double PARALLEL = 1e-9;

rg_vec3 rg_depth_normal(const rg_vec3 *x, int32_t n)
{
    rg_vec3 sum = {0, 0, 0};
    for (int32_t i = 1; i + 1 < n; i++)
        sum = rg_vec3_add(sum, rg_vec3_cross(rg_vec3_sub(x[i], x[0]), rg_vec3_sub(x[i + 1], x[0])));
    const double length = rg_vec3_length(sum);
    return length > 0 ? rg_vec3_scale(1 / length, sum) : (rg_vec3){0, 0, 0};
}

/* How far b must be moved along a's normal, this way or that. */
static double through_plane(const rg_plate *a, const rg_plate *b)
{
    double low = INFINITY, high = -INFINITY;
    for (int32_t k = 0; k < b->n; k++) {
        const double d = rg_vec3_dot(a->normal, rg_vec3_sub(b->x[k], a->x[0]));
        if (d < low) low = d;
        if (d > high) high = d;
    }
    return high < -low ? high : -low;
}

static void shadow(const rg_plate *a, rg_vec3 u, rg_vec3 origin, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int32_t k = 0; k < a->n; k++) {
        const double d = rg_vec3_dot(u, rg_vec3_sub(a->x[k], origin));
        if (d < *low) *low = d;
        if (d > *high) *high = d;
    }
}

static rg_vec3 side(const rg_plate *a, int32_t k)
{
    return rg_vec3_sub(a->x[k + 1 < a->n ? k + 1 : 0], a->x[k]);
}

double rg_depth_of(const rg_plate *a, const rg_plate *b, double least, rg_vec3 *axis)
{
    double depth = through_plane(a, b);
    rg_vec3 how = a->normal;
    if (!(depth > least)) return 0;
    const double other = through_plane(b, a);
    if (!(other > least)) return 0;
    if (other < depth) depth = other, how = b->normal;
    const rg_vec3 origin = a->x[0];
    for (int32_t i = 0; i < a->n; i++) {
        const rg_vec3 e = side(a, i);
        for (int32_t k = 0; k < b->n; k++) {
            const rg_vec3 g = side(b, k);
            rg_vec3 u = rg_vec3_cross(e, g);
            const double length = rg_vec3_length(u);
            if (!(length > PARALLEL * rg_vec3_length(e) * rg_vec3_length(g))) continue;
            u = rg_vec3_scale(1 / length, u);
            double a_low, a_high, b_low, b_high;
            shadow(a, u, origin, &a_low, &a_high);
            shadow(b, u, origin, &b_low, &b_high);
            const double d = a_high - b_low < b_high - a_low ? a_high - b_low : b_high - a_low;
            if (d < depth) depth = d, how = u;
            if (!(depth > least)) return 0;
        }
    }
    if (axis) *axis = how;
    return depth;
}

/* Where a goes through b's plane, along the direction d from the origin. */
static void cut_of(const rg_plate *a, const rg_plate *b, rg_vec3 d, rg_vec3 origin, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int32_t k = 0; k < a->n; k++) {
        const rg_vec3 p = a->x[k], e = side(a, k), q = a->x[k + 1 < a->n ? k + 1 : 0];
        /* Both in the same way: a corner in the plane must be on one side of it for both of its edges, or it is
         * missed. */
        const double s = rg_vec3_dot(b->normal, rg_vec3_sub(p, b->x[0])),
            t = rg_vec3_dot(b->normal, rg_vec3_sub(q, b->x[0]));
        if (s * t > 0 || s == t) continue;
        const double at = rg_vec3_dot(d, rg_vec3_sub(rg_vec3_axpy(s / (s - t), e, p), origin));
        *low = fmin(*low, at);
        *high = fmax(*high, at);
    }
}

double rg_depth_stretch(const rg_plate *a, const rg_plate *b)
{
    const rg_vec3 d = rg_vec3_cross(a->normal, b->normal);
    const double length = rg_vec3_length(d);
    double low, high, other_low, other_high;
    if (!(length > 0)) return 0;
    cut_of(a, b, rg_vec3_scale(1 / length, d), a->x[0], &low, &high);
    cut_of(b, a, rg_vec3_scale(1 / length, d), a->x[0], &other_low, &other_high);
    return fmax(0, fmin(high, other_high) - fmax(low, other_low));
}
