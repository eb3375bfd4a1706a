#include "pattern/check.h"
#include "base/text.h"

#include <stdlib.h>

/* Larger than any drawing program's rounding, smaller than what one sees: flat-foldable drawings read from files
 * are off by less, patterns drawn by eye by more. */
static const double KAWASAKI = 0.01 * RG_DEG;

void rg_check_sectors(const struct rg_pattern *p, int32_t v, double *theta)
{
    const int32_t *star = p->star + p->star_start[v], n = p->star_start[v + 1] - p->star_start[v];
    for (int32_t i = 0; i < n; i++) {
        if (p->star_start[v] + i + 2 * RG_SOON < p->star_start[p->nv]) {
            rg_mem_soon(&p->E[star[i + 2 * RG_SOON]]);
            rg_mem_soon(&p->X[p->E[star[i + RG_SOON]].v[0]]);
            rg_mem_soon(&p->X[p->E[star[i + RG_SOON]].v[1]]);
        }
        const rg_edge *e = &p->E[star[i]], *f = &p->E[star[(i + 1) % n]];
        const rg_vec2 a = rg_vec2_sub(p->X[e->v[e->v[0] == v]], p->X[v]);
        const rg_vec2 b = rg_vec2_sub(p->X[f->v[f->v[0] == v]], p->X[v]);
        const double turn = atan2(rg_vec2_cross(a, b), rg_vec2_dot(a, b));
        theta[i] = turn > 0 ? turn : turn + 2 * RG_PI;
    }
}

static rg_status add(struct rg_pattern *p, size_t *room, int32_t v, rg_theorem theorem, double by)
{
    rg_status s = RG_MEM_GROW(&p->mem, p->unfoldable, *room, (size_t)p->unfoldables + 1);
    if (s == RG_OK) p->unfoldable[p->unfoldables++] = (rg_unfoldable){v, p->X[v].x, p->X[v].y, theorem, by};
    return s;
}

/* Targets are written in whole degrees as a rule, which round a vertex add up to less than this. */
static const double TARGETS = 1 * RG_DEG;

/* Over a crease along axis x and on to the next one: a turn about x by rho of a turn about z by theta. */
static rg_mat3 over_crease(double rho, double theta)
{
    const double c = cos(rho), s = sin(rho), C = cos(theta), S = sin(theta);
    return (rg_mat3){{{C, c * S, s * S}, {-S, c * C, s * C}, {0, -s, c}}};
}

/* The angle, radians, by which the paper round a vertex misses itself when each crease is at its target; 0: it is not
 * said for all of them, or they all lie flat or folded flat, which theorems are for. It is the rotation that eq. (1)
 * asks to be none. */
static double targets_miss(const struct rg_pattern *p, int32_t v, const double *theta)
{
    const int32_t *star = p->star + p->star_start[v], n = p->star_start[v + 1] - p->star_start[v];
    rg_mat3 F = rg_mat3_identity();
    int is_flat = 1;
    for (int32_t i = 0; i < n; i++) {
        const double rho = p->E[star[i]].target;
        if (!isfinite(rho)) return 0;
        is_flat &= fabs(rho) == RG_PI;
    }
    if (is_flat) return 0;
    for (int32_t i = 0; i < n; i++) F = rg_mat3_mul(F, over_crease(p->E[star[i]].target, theta[i]));
    const rg_vec3 twice = {F.c[1].z - F.c[2].y, F.c[2].x - F.c[0].z, F.c[0].y - F.c[1].x};
    return atan2(rg_vec3_length(twice), F.c[0].x + F.c[1].y + F.c[2].z - 1);
}

/* The sector that is strictly the smallest among its neighbours has its two creases folded the same way: they would
 * shut it in from both sides. Returns by how much it is smaller where that is most, 0 where all is well. */
static double big_little_big(const struct rg_pattern *p, int32_t v, const double *theta)
{
    const int32_t *star = p->star + p->star_start[v], n = p->star_start[v + 1] - p->star_start[v];
    double most = 0;
    for (int32_t i = 0; n > 2 && i < n; i++) {
        const char a = p->E[star[i]].assignment, b = p->E[star[(i + 1) % n]].assignment;
        const double less = fmin(theta[(i + n - 1) % n], theta[(i + 1) % n]) - theta[i];
        if (a == b && (a == RG_MOUNTAIN || a == RG_VALLEY) && less > KAWASAKI) most = fmax(most, less);
    }
    return most;
}

int32_t rg_check_most_edges(const struct rg_pattern *p)
{
    int32_t most = 1;
    for (int32_t v = 0; v < p->nv; v++) {
        const int32_t n = p->star_start[v + 1] - p->star_start[v];
        if (n > most) most = n;
    }
    return most;
}

int32_t rg_check_crowded(const struct rg_pattern *p)
{
    for (int32_t v = 0; v < p->nv; v++)
        if (p->star_start[v + 1] - p->star_start[v] > RG_MOST_AT_A_VERTEX) return v;
    return -1;
}

void rg_check_crowded_text(const struct rg_pattern *p, int32_t v, char text[200])
{
    const rg_vec2 at = rg_lines_own(&p->lines, p->X[v], p->info.size);
    rg_text(text, 200, "%d creases meet at (%.6g, %.6g), and no more than %d at one vertex are folded",
            (int)(p->star_start[v + 1] - p->star_start[v]), at.x, at.y, RG_MOST_AT_A_VERTEX);
}

rg_status rg_check_vertices(struct rg_pattern *p)
{
    size_t room = 0;
    rg_status s = RG_OK;
    double *theta = rg_mem_array(&p->mem, (size_t)rg_check_most_edges(p), sizeof *theta);
    if (!theta) return RG_ENOMEM;
    for (int32_t v = 0; s == RG_OK && v < p->nv; v++) {
        if (p->rim[v]) continue;
        const int32_t n = p->star_start[v + 1] - p->star_start[v];
        int32_t mountains = 0, valleys = 0, cuts = 0;
        double alternating = 0;
        rg_check_sectors(p, v, theta);
        for (int32_t i = 0; i < n; i++) {
            mountains += p->E[p->star[p->star_start[v] + i]].assignment == RG_MOUNTAIN;
            valleys += p->E[p->star[p->star_start[v] + i]].assignment == RG_VALLEY;
            cuts += p->E[p->star[p->star_start[v] + i]].assignment == RG_CUT;
            alternating += (i % 2 ? -theta[i] : theta[i]) / 2; /* every other angle, less half a turn */
        }
        if (cuts) continue; /* the end of a slit: the paper does not go all the way round */
        const double miss = targets_miss(p, v, theta);
        if (miss > TARGETS && (s = add(p, &room, v, RG_TARGETS, miss / RG_DEG)) != RG_OK) break;
        const int32_t excess = abs(mountains - valleys);
        const int maekawa = mountains + valleys < n || excess == 2;
        p->info.maekawa_violations += !maekawa;
        if (n % 2) {
            s = add(p, &room, v, RG_DEGREE, n);
            continue;
        }
        p->info.kawasaki_max_deg = fmax(p->info.kawasaki_max_deg, fabs(alternating) / RG_DEG);
        if (!(fabs(alternating) <= KAWASAKI)) s = add(p, &room, v, RG_KAWASAKI, fabs(alternating) / RG_DEG);
        if (s == RG_OK && !maekawa) s = add(p, &room, v, RG_MAEKAWA, excess);
        const double shut_in = big_little_big(p, v, theta);
        if (s == RG_OK && shut_in > 0) s = add(p, &room, v, RG_BIG_LITTLE_BIG, shut_in / RG_DEG);
    }
    rg_mem_free(&p->mem, theta);
    return s;
}
