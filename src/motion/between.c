#include "motion/between.h"

#include <string.h>

/* What moving a vertex of the pattern by the shortest line at it counts, in radians of a crease, as in the search. */
static const double COMPLIANCE = 1;
static const int32_t CLOSINGS = 30;
/* A closing that leaves more than this part of the residual is rounding. */
static const double GOOD_GAIN = 0.5;

rg_status rg_between_init(rg_between *B, const rg_memory *mem, const rg_mesh *m, int moves, const rg_settings *settings)
{
    memset(B, 0, sizeof *B);
    B->mem = *mem;
    B->mesh = *m;
    B->tol = settings->tol;
    B->moves = moves;
    rg_status s = rg_freedom_init(&B->freedom, mem, &B->mesh, moves);
    const size_t n = (size_t)m->N + (size_t)B->freedom.U;
    if (s == RG_OK && moves) s = rg_constraint_init_moving(&B->K, mem, &B->mesh, &B->freedom, 0);
    if (s == RG_OK && moves) s = rg_coupled_init(&B->J, mem, &B->K, NULL);
    if (s == RG_OK && !moves) s = rg_steer_init(&B->steer, mem, &B->mesh, settings);
    if (s == RG_OK) s = RG_MEM_ARRAYS(mem, RG_ARRAY(B->scale, n), RG_ARRAY(B->dz, n), RG_ARRAY(B->z, n),
                                      RG_ARRAY(B->flat, (size_t)m->nv),
                                      RG_ARRAY(B->theta, (size_t)m->loop_start[m->M]));
    return s;
}

void rg_between_free(rg_between *B)
{
    if (!B->mem.resize) return;
    rg_freedom_free(&B->freedom);
    rg_coupled_free(&B->J);
    rg_constraint_free(&B->K);
    rg_steer_free(&B->steer);
    RG_MEM_FREE(&B->mem, B->scale, B->dz, B->z, B->flat, B->theta);
    memset(B, 0, sizeof *B);
}

/* Works off what is open, by creases and pattern, until rounding is left. */
static double close_together(rg_between *B, int32_t c)
{
    const int32_t N = B->mesh.N, n = N + B->freedom.U;
    double before = INFINITY, best = NAN;
    for (int32_t i = 0; i < n; i++) B->scale[i] = i == c ? 0 : i < N ? 1 : COMPLIANCE * B->freedom.reach[i - N];
    for (int32_t k = 0; k < CLOSINGS; k++) {
        const double closure = rg_coupled_assemble(&B->J, B->z, B->z + N, NULL);
        if (!(closure <= 2.5)) return NAN;
        if (closure <= B->tol) best = closure;
        if (closure <= B->tol && closure > GOOD_GAIN * before) return closure;
        before = closure;
        rg_coupled_renew(&B->J, B->scale);
        rg_coupled_solve(&B->J, NULL, B->K.r, B->dz);
        for (int32_t i = 0; i < n; i++) B->z[i] -= B->scale[i] * B->dz[i];
    }
    return best;
}

double rg_between_at(rg_between *B, const rg_motion_state *from, const rg_motion_state *to, double part, int32_t c,
                     double angle)
{
    const int32_t N = B->mesh.N;
    double closure;
    for (int32_t i = 0; i < N; i++) B->z[i] = from->rho[i] + part * (to->rho[i] - from->rho[i]);
    B->z[c] = angle;
    for (int32_t w = 0; w < B->freedom.U; w++) {
        const int32_t v = B->freedom.vertex[w];
        const rg_vec2 a = rg_vec2_sub(from->X[v], B->mesh.X[v]), d = rg_vec2_sub(to->X[v], from->X[v]);
        B->z[N + w] = rg_vec2_dot(a, B->freedom.direction[w]) + part * rg_vec2_dot(d, B->freedom.direction[w]);
    }
    if (B->moves) {
        closure = close_together(B, c);
        rg_freedom_move(&B->freedom, B->z + N, B->flat);
        return closure;
    }
    memcpy(B->flat, from->X, (size_t)B->mesh.nv * sizeof *B->flat);
    rg_mesh_sectors(&B->mesh, from->X, B->theta);
    return rg_steer_close(&B->steer, B->theta, c, B->z);
}
