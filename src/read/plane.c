#include "read/plane.h"

/* What of space is left, by the axis that points at the eye. */
static const rg_vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};

static void measure(const rg_vec3 *x, int32_t n, const int32_t *pair, int32_t pairs, rg_level *p)
{
    const rg_vec3 normal = rg_vec3_cross(p->e1, p->e2), o = n ? x[0] : Z;
    double low = 0, high = 0;
    for (int32_t i = 0; i < n; i++) {
        const double at = rg_vec3_dot(normal, rg_vec3_sub(x[i], o));
        low = fmin(low, at), high = fmax(high, at);
    }
    p->off = high - low;
    p->change = 0;
    p->at = 0;
    for (int32_t i = 0; i < pairs; i++) {
        const rg_vec3 d = rg_vec3_sub(x[pair[2 * i + 1]], x[pair[2 * i]]);
        const double change = fabs(rg_vec3_length(d) - hypot(rg_vec3_dot(p->e1, d), rg_vec3_dot(p->e2, d)));
        if (!(change <= p->change)) p->change = change, p->at = i;
    }
}

/* Two axes across n, as coordinates are kept where that is along an axis of space. */
static void across(rg_vec3 n, double exact, rg_level *p)
{
    const rg_vec3 size = {fabs(n.x), fabs(n.y), fabs(n.z)};
    p->e1 = size.y + size.z <= exact ? Y : X;
    p->e2 = size.x + size.y <= exact ? Y : size.x + size.z <= exact ? rg_vec3_scale(-1, Z) : Z;
    if (size.x + size.y <= exact || size.x + size.z <= exact || size.y + size.z <= exact) return;
    const double largest = size.x > size.y ? (size.x > size.z ? n.x : n.z) : size.y > size.z ? n.y : n.z;
    n = rg_vec3_scale(largest < 0 ? -1 : 1, n);
    p->e1 = rg_vec3_cross(size.z < 0.9 ? Z : Y, n);
    p->e1 = rg_vec3_scale(1 / rg_vec3_length(p->e1), p->e1);
    p->e2 = rg_vec3_cross(n, p->e1);
}

int rg_plane_find(const rg_vec3 *x, int32_t n, const int32_t *pair, int32_t pairs, double exact, double tol,
                  rg_level *p)
{
    const rg_vec3 o = n ? x[0] : X;
    rg_vec3 d = {0, 0, 0}, normal = d;
    *p = (rg_level){.e1 = X, .e2 = Y};
    for (int32_t i = 0; i < n; i++) {
        const rg_vec3 v = rg_vec3_sub(x[i], o);
        if (rg_vec3_length(v) > rg_vec3_length(d)) d = v;
    }
    const double size = rg_vec3_length(d);
    if (!(size > 0) || !isfinite(size)) return 2;
    d = rg_vec3_scale(1 / size, d);
    for (int32_t i = 0; i < n; i++) {
        const rg_vec3 c = rg_vec3_cross(d, rg_vec3_sub(x[i], o));
        if (rg_vec3_length(c) > rg_vec3_length(normal)) normal = c;
    }
    if (!(rg_vec3_length(normal) > 0)) return 2;
    normal = rg_vec3_scale(1 / rg_vec3_length(normal), normal);
    across(normal, exact, p);
    measure(x, n, pair, pairs, p);
    if (p->off <= exact * size) return 2;
    const rg_level general = *p;
    const rg_vec3 eye[] = {Z, Y, X};
    for (int i = 0; i < 3; i++) {
        across(eye[i], 0, p);
        measure(x, n, pair, pairs, p);
        if (pairs > 0 ? p->change <= tol * size : p->off <= tol * size) return 1;
    }
    *p = general;
    return pairs > 0 ? p->change <= tol * size : p->off <= tol * size;
}
