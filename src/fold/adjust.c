#include "fold/adjust.h"
#include "pattern/closed.h"

#include <string.h>

/* Directions that add up to less cancel each other. */
static const double CANCELLED = 1e-9;

static char assignment(const rg_mesh *m, int32_t crease) { return m->assignment[m->crease_edge[crease]]; }

static rg_vec2 spoke(const rg_mesh *m, int32_t v, int32_t crease)
{
    const int32_t *e = m->edge[m->crease_edge[crease]];
    return rg_vec2_sub(m->X[e[e[0] == v]], m->X[v]);
}

/* How the angle from a to b grows when the vertex between them moves. */
static rg_vec2 growth(rg_vec2 a, rg_vec2 b)
{
    const double aa = rg_vec2_dot(a, a), bb = rg_vec2_dot(b, b);
    return (rg_vec2){b.y / bb - a.y / aa, -b.x / bb + a.x / aa};
}

static double sector(rg_vec2 a, rg_vec2 b)
{
    const double turn = atan2(rg_vec2_cross(a, b), rg_vec2_dot(a, b));
    return turn > 0 ? turn : turn + 2 * RG_PI;
}

/* The direction that shrinks the inside angles at interior vertex k; zero: not a closed vertex. drawn: scratch. */
static int closed(const rg_mesh *m, int32_t k, int32_t *drawn, rg_vec2 *direction)
{
    const int32_t v = m->inner_vertex[k];
    int32_t n = 0, found = 0;
    rg_vec2 sum = {0, 0};
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++)
        if (m->loop_crease[j] < m->N - m->added) drawn[n++] = m->loop_crease[j];
    for (int32_t i = 0; n >= 3 && i < n; i++) {
        const int32_t a = drawn[i], c = drawn[(i + 1) % n], b = drawn[(i + 2) % n];
        const rg_vec2 xa = spoke(m, v, a), xc = spoke(m, v, c), xb = spoke(m, v, b);
        const int inside = rg_closed_inside(assignment(m, a), assignment(m, c), assignment(m, b), sector(xa, xc),
                                            sector(xc, xb));
        if (!inside) continue;
        const rg_vec2 grows = inside == 1 ? growth(xa, xc) : growth(xc, xb);
        const double length = rg_vec2_length(grows);
        sum = (rg_vec2){sum.x - grows.x / length, sum.y - grows.y / length};
        found++;
    }
    const double length = rg_vec2_length(sum);
    *direction = length > CANCELLED ? (rg_vec2){sum.x / length, sum.y / length} : (rg_vec2){0, 0};
    return found > 0;
}

rg_status rg_adjust_init(rg_adjust *a, const rg_memory *mem, const rg_freedom *f)
{
    const rg_mesh *m = f->mesh;
    memset(a, 0, sizeof *a);
    a->mem = *mem;
    a->freedom = f;
    int32_t *drawn = rg_mem_array(mem, (size_t)m->N, sizeof *drawn);
    a->k = rg_mem_array(mem, (size_t)m->M, sizeof *a->k);
    a->direction = rg_mem_array(mem, (size_t)m->M, sizeof *a->direction);
    const int ok = drawn && a->k && a->direction;
    for (int32_t k = 0; ok && k < m->M; k++)
        if (closed(m, k, drawn, &a->direction[a->count])) a->k[a->count++] = k;
    rg_mem_free(mem, drawn);
    if (!ok) rg_adjust_free(a);
    return ok ? RG_OK : RG_ENOMEM;
}

void rg_adjust_free(rg_adjust *a)
{
    if (!a->mem.resize) return;
    rg_mem_free(&a->mem, a->k);
    rg_mem_free(&a->mem, a->direction);
    memset(a, 0, sizeof *a);
}

/* "Angle unevenness" of section 3.3, over pi; creases beyond half a turn count as folded. */
static double unevenness(const rg_mesh *m, int32_t k, const double *rho)
{
    double most = 0, least = RG_PI;
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
        if (m->loop_crease[j] >= m->N - m->added) continue;
        const double angle = fmin(fabs(rho[m->loop_crease[j]]), RG_PI);
        most = fmax(most, angle);
        least = fmin(least, angle);
    }
    return (most - least) / RG_PI;
}

void rg_adjust_wish(const rg_adjust *a, const double *rho, double gain, double *u)
{
    const rg_freedom *f = a->freedom;
    memset(u, 0, (size_t)f->U * sizeof *u);
    for (int32_t i = 0; f->U > 0 && i < a->count; i++) {
        const int32_t *way = f->way[f->mesh->inner_vertex[a->k[i]]];
        const double by = gain * f->reach[way[0]] * unevenness(f->mesh, a->k[i], rho);
        u[way[0]] += by * a->direction[i].x;
        u[way[1]] += by * a->direction[i].y;
    }
}
