#include "read/space.h"
#include "base/memory.h"
#include "base/status.h"
#include "read/affine.h"
#include "read/plane.h"

#include <stdlib.h>

/* Coordinates in space lie in a plane if they are off it by less than this part of their size: digits of a text. */
static const double FLATNESS = 1e-9;


/* --------------------------------------------------------------------------------------------------- maps ---- */

rg_vec3 rg_map3_point(rg_map3 p, rg_vec3 x) { return rg_vec3_add(rg_mat3_mul_vec(p.A, x), p.t); }

rg_map3 rg_map3_after(rg_map3 p, rg_map3 q)
{
    return (rg_map3){rg_mat3_mul(p.A, q.A), rg_map3_point(p, q.t)};
}

rg_map3 rg_map3_shifted(rg_vec3 t) { return (rg_map3){rg_mat3_identity(), t}; }

rg_map3 rg_map3_scaled(double x, double y, double z)
{
    return (rg_map3){{{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}, {0, 0, 0}};
}

rg_map3 rg_map3_turned(double degrees)
{
    const rg_affine turn = rg_affine_turn(degrees);
    return (rg_map3){{{{turn.a, turn.b, 0}, {turn.c, turn.d, 0}, {0, 0, 1}}}, {0, 0, 0}};
}

rg_map3 rg_map3_of_normal(rg_vec3 n)
{
    static const rg_vec3 y = {0, 1, 0}, z = {0, 0, 1};
    const double nearly = 1.0 / 64; /* part of that algorithm */
    if (n.x == 0 && n.y == 0 && n.z > 0) return rg_map3_shifted((rg_vec3){0, 0, 0});
    n = rg_vec3_scale(1 / rg_vec3_length(n), n);
    rg_vec3 x = rg_vec3_cross(fabs(n.x) < nearly && fabs(n.y) < nearly ? y : z, n);
    x = rg_vec3_scale(1 / rg_vec3_length(x), x);
    return (rg_map3){{{x, rg_vec3_cross(n, x), n}}, {0, 0, 0}};
}

/* -------------------------------------------------------------------------------------------------- lines ---- */

rg_status rg_space_add(rg_space *q, rg_lines *lines, rg_vec3 a, rg_vec3 b, char assignment, int32_t where)
{
    rg_status s =
        RG_MEM_GROW(&lines->mem, q->ends, q->room, 2 * ((size_t)lines->count + 1));
    if (s == RG_OK) s = rg_lines_add(lines, (rg_vec2){a.x, a.y}, (rg_vec2){b.x, b.y}, assignment, where);
    if (s != RG_OK) return s;
    q->ends[2 * lines->count - 2] = a;
    q->ends[2 * lines->count - 1] = b;
    q->is_spatial |= a.z != 0 || b.z != 0;
    return RG_OK;
}

rg_status rg_space_side(rg_space *q, rg_lines *lines, int32_t i)
{
    const rg_status s =
        RG_MEM_GROW(&lines->mem, q->side, q->side_room, (size_t)q->sides + 1);
    if (s == RG_OK) q->side[q->sides++] = i;
    return s;
}

void rg_space_free(rg_space *q, const rg_memory *mem)
{
    RG_MEM_FREE(mem, q->ends, q->side);
}

typedef struct ends { rg_vec2 low, high; int32_t line; } ends;

static int compare_points(rg_vec2 a, rg_vec2 b)
{
    return a.x != b.x ? (a.x > b.x) - (a.x < b.x) : (a.y > b.y) - (a.y < b.y);
}

static int by_ends(const void *a, const void *b)
{
    const ends *p = a, *q = b;
    const int low = compare_points(p->low, q->low), high = low ? low : compare_points(p->high, q->high);
    return high ? high : (p->line > q->line) - (p->line < q->line);
}

rg_status rg_space_border(const rg_space *q, rg_lines *lines)
{
    if (q->sides == 0) return RG_OK;
    ends *e = rg_mem_array(&lines->mem, (size_t)q->sides, sizeof *e);
    if (!e) return RG_ENOMEM;
    for (int32_t i = 0; i < q->sides; i++) {
        const rg_line *l = &lines->line[q->side[i]];
        const int turned = compare_points(l->a, l->b) > 0;
        e[i] = (ends){turned ? l->b : l->a, turned ? l->a : l->b, q->side[i]};
    }
    qsort(e, (size_t)q->sides, sizeof *e, by_ends);
    for (int32_t i = 0, end; i < q->sides; i = end) {
        for (end = i + 1; end < q->sides && compare_points(e[i].low, e[end].low) == 0 &&
                          compare_points(e[i].high, e[end].high) == 0;)
            end++;
        if (end == i + 1) lines->line[e[i].line].assignment = RG_BORDER;
    }
    rg_mem_free(&lines->mem, e);
    return RG_OK;
}

/* The first line that is not in the plane of those before it. */
static int32_t first_off(const rg_space *q, int32_t lines, double tol)
{
    const rg_vec3 o = q->ends[0];
    rg_vec3 along = {0, 0, 0}, normal = along;
    for (int32_t i = 0; i < 2 * lines; i++) {
        const rg_vec3 x = rg_vec3_sub(q->ends[i], o);
        if (!(rg_vec3_length(along) > tol)) along = x;
        else if (!(rg_vec3_length(normal) > tol * rg_vec3_length(along))) normal = rg_vec3_cross(along, x);
        else if (fabs(rg_vec3_dot(normal, x)) > tol * rg_vec3_length(normal)) return i / 2;
    }
    return 0;
}

rg_status rg_space_flatten(const rg_space *q, rg_lines *lines, double merge, rg_diag *why)
{
    rg_level p;
    const int32_t n = lines->count;
    double size = 0;
    if (!q->is_spatial || n == 0) return RG_OK;
    int32_t *pair = rg_mem_array(&lines->mem, 2 * (size_t)n, sizeof *pair);
    if (!pair) return RG_ENOMEM;
    for (int32_t i = 0; i < 2 * n; i++) {
        pair[i] = i;
        size = fmax(size, rg_vec3_length(rg_vec3_sub(q->ends[i], q->ends[0])));
    }
    const int flat = rg_plane_find(q->ends, 2 * n, pair, n, FLATNESS, merge, &p);
    rg_mem_free(&lines->mem, pair);
    if (!flat) {
        const int32_t i = first_off(q, n, merge * size);
        const double z = q->ends[2 * i].z, w = q->ends[2 * i + 1].z;
        return rg_fail(RG_EFORMAT, why, lines->line[i].where,
                       "this line leaves the plane of those before it, at z = %.6g: a flat drawing is needed",
                       fabs(z) > fabs(w) ? z : w);
    }
    for (int32_t i = 0; i < n; i++) {
        const rg_vec3 a = q->ends[2 * i], b = q->ends[2 * i + 1];
        lines->line[i].a = (rg_vec2){rg_vec3_dot(p.e1, a), rg_vec3_dot(p.e2, a)};
        lines->line[i].b = (rg_vec2){rg_vec3_dot(p.e1, b), rg_vec3_dot(p.e2, b)};
    }
    return flat == 2 ? RG_OK
                     : rg_lines_warn(lines, 0, "the drawing is off a plane by up to %.3g, and taken for flat", p.off);
}
