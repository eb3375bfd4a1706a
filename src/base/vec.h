/* vec.h -- small vectors and matrices, passed by value.
 * Paper    Fig. 3: a rotation matrix per fold line        Used by  every folder */
#ifndef RG_VEC_H
#define RG_VEC_H

#include <math.h>

#define RG_PI 3.14159265358979323846264338327950288
#define RG_DEG (RG_PI / 180.0) /* radians in a degree */

typedef struct rg_vec2 { double x, y; } rg_vec2;
typedef struct rg_vec3 { double x, y, z; } rg_vec3;
typedef struct rg_mat3 { rg_vec3 c[3]; } rg_mat3; /* columns */

static inline rg_vec2 rg_vec2_sub(rg_vec2 a, rg_vec2 b) { return (rg_vec2){a.x - b.x, a.y - b.y}; }
static inline double rg_vec2_dot(rg_vec2 a, rg_vec2 b) { return a.x * b.x + a.y * b.y; }
static inline double rg_vec2_cross(rg_vec2 a, rg_vec2 b) { return a.x * b.y - a.y * b.x; }
static inline double rg_vec2_length(rg_vec2 a) { return hypot(a.x, a.y); }

/* How far x is off the segment from a to b. */
static inline double rg_vec2_off_segment(rg_vec2 a, rg_vec2 b, rg_vec2 x)
{
    const rg_vec2 along = rg_vec2_sub(b, a), to = rg_vec2_sub(x, a);
    const double part = fmin(1, fmax(0, rg_vec2_dot(along, to) / rg_vec2_dot(along, along)));
    return rg_vec2_length((rg_vec2){to.x - part * along.x, to.y - part * along.y});
}

/* Twice the signed area of the triangle a b c; positive when it turns counter-clockwise. */
static inline double rg_vec2_turn(rg_vec2 a, rg_vec2 b, rg_vec2 c)
{
    return rg_vec2_cross(rg_vec2_sub(b, a), rg_vec2_sub(c, a));
}

static inline rg_vec3 rg_vec3_add(rg_vec3 a, rg_vec3 b) { return (rg_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline rg_vec3 rg_vec3_sub(rg_vec3 a, rg_vec3 b) { return (rg_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline rg_vec3 rg_vec3_scale(double s, rg_vec3 a) { return (rg_vec3){s * a.x, s * a.y, s * a.z}; }
static inline double rg_vec3_dot(rg_vec3 a, rg_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double rg_vec3_length(rg_vec3 a) { return sqrt(rg_vec3_dot(a, a)); }
static inline rg_vec3 rg_vec3_axpy(double s, rg_vec3 a, rg_vec3 b) /* s a + b */
{
    return (rg_vec3){s * a.x + b.x, s * a.y + b.y, s * a.z + b.z};
}
static inline rg_vec3 rg_vec3_cross(rg_vec3 a, rg_vec3 b)
{
    return (rg_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline rg_mat3 rg_mat3_identity(void)
{
    return (rg_mat3){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}
static inline rg_vec3 rg_mat3_mul_vec(rg_mat3 A, rg_vec3 v)
{
    return rg_vec3_axpy(v.x, A.c[0], rg_vec3_axpy(v.y, A.c[1], rg_vec3_scale(v.z, A.c[2])));
}
static inline rg_mat3 rg_mat3_mul(rg_mat3 A, rg_mat3 B)
{
    return (rg_mat3){{rg_mat3_mul_vec(A, B.c[0]), rg_mat3_mul_vec(A, B.c[1]), rg_mat3_mul_vec(A, B.c[2])}};
}

#endif
