#include "kinematics/constraint.h"
#include "base/lanes.h"
#include "kinematics/turn.h"

#include <string.h>

/* Vertices sorted by degree, four together. */
static rg_status make_fours(rg_constraint *K)
{
    const rg_sparse *C = &K->C;
    int32_t most = 0, at = 0;
    for (int32_t k = 0; k < C->M; k++)
        if (C->start[k + 1] - C->start[k] > most) most = C->start[k + 1] - C->start[k];
    int32_t *count = rg_mem_array(&K->mem, (size_t)most + 2, sizeof *count);
    int32_t *sorted = rg_mem_array(&K->mem, (size_t)C->M, sizeof *sorted);
    size_t blocks = 0;
    if (count && sorted) {
        for (int32_t k = 0; k < C->M; k++) count[C->start[k + 1] - C->start[k] + 1]++;
        for (int32_t d = 0; d <= most; d++) {
            size_t fours = ((size_t)count[d + 1] + 3) / 4;
            K->fours += (int32_t)fours;
            blocks += 4 * fours * (size_t)d;
            count[d + 1] += count[d];
        }
        for (int32_t k = 0; k < C->M; k++) sorted[count[C->start[k + 1] - C->start[k]]++] = k;
        K->four = rg_mem_array(&K->mem, (size_t)K->fours, sizeof *K->four);
        K->crease = rg_mem_array(&K->mem, blocks, sizeof *K->crease);
        K->theta_cos = rg_mem_array(&K->mem, blocks, sizeof *K->theta_cos);
        K->theta_sin = rg_mem_array(&K->mem, blocks, sizeof *K->theta_sin);
    }
    int ok = K->four && K->crease && K->theta_cos && K->theta_sin;
    for (int32_t k = 0, g = 0; ok && k < C->M; g++) {
        rg_four *four = &K->four[g];
        four->degree = C->start[sorted[k] + 1] - C->start[sorted[k]];
        four->at = at;
        for (int lane = 0; lane < 4; lane++) {
            int32_t last = lane ? four->vertex[lane - 1] : sorted[k];
            int more = k < C->M && C->start[sorted[k] + 1] - C->start[sorted[k]] == four->degree;
            four->vertex[lane] = more ? sorted[k++] : last;
            for (int32_t i = 0; i < four->degree; i++)
                K->crease[4 * (at + i) + lane] = C->col[C->start[four->vertex[lane]] + i];
        }
        at += four->degree;
    }
    rg_mem_free(&K->mem, count);
    rg_mem_free(&K->mem, sorted);
    return ok ? RG_OK : RG_ENOMEM;
}

rg_status rg_constraint_init(rg_constraint *K, const rg_memory *mem, const rg_mesh *m)
{
    memset(K, 0, sizeof *K);
    rg_status s = rg_sparse_init(&K->C, mem, m->M, m->N, m->loop_start, m->loop_crease);
    if (s != RG_OK) return s;
    K->mem = *mem;
    int32_t blocks = m->loop_start[m->M];
    const size_t whole = ((size_t)m->N + 3) & ~(size_t)3;
    K->r = rg_mem_array(mem, 3 * (size_t)m->M, sizeof *K->r);
    K->theta = rg_mem_array(mem, (size_t)blocks, sizeof *K->theta);
    K->cos = rg_mem_array(mem, whole, sizeof *K->cos);
    K->sin = rg_mem_array(mem, whole, sizeof *K->sin);
    K->still = rg_mem_array(mem, (size_t)m->N, 1);
    if (!K->r || !K->theta || !K->cos || !K->sin || !K->still || make_fours(K) != RG_OK) {
        rg_constraint_free(K);
        return RG_ENOMEM;
    }
    rg_constraint_set_theta(K, m->loop_theta);
    for (int32_t i = 0; m->still && i < m->N; i++) K->still[i] = m->still[m->crease_edge[i]];
    rg_constraint_set_still(K);
    return RG_OK;
}

void rg_constraint_free(rg_constraint *K)
{
    if (!K->mem.resize) return;
    rg_memory mem = K->mem;
    rg_sparse_free(&K->C);
    void *all[] = {K->r, K->theta, K->cos, K->sin, K->four, K->crease, K->theta_cos, K->theta_sin, K->still};
    for (int i = 0; i < 9; i++) rg_mem_free(&mem, all[i]);
    memset(K, 0, sizeof *K);
}

void rg_constraint_set_theta(rg_constraint *K, const double *theta)
{
    for (int32_t j = 0; j < K->C.start[K->C.M]; j++) K->theta[j] = (rg_turn){cos(theta[j]), sin(theta[j])};
    for (int32_t g = 0; g < K->fours; g++)
        for (int lane = 0; lane < 4; lane++)
            for (int32_t i = 0; i < K->four[g].degree; i++) {
                rg_turn t = K->theta[K->C.start[K->four[g].vertex[lane]] + i];
                int32_t at = 4 * (K->four[g].at + i) + lane;
                K->theta_cos[at] = t.cos;
                K->theta_sin[at] = t.sin;
            }
}

static void turn_creases(rg_constraint *K, const double *rho)
{
    int32_t whole = K->C.N & ~3;
    rg_turn_creases(whole, rho, K->cos, K->sin);
    if (whole == K->C.N) return;
    double rest[4] = {0};
    memcpy(rest, rho + whole, (size_t)(K->C.N - whole) * sizeof *rho);
    rg_turn_creases(4, rest, K->cos + whole, K->sin + whole);
}

/* One row of A, A <- A chi: eq. (1). */
RG_WITHIN void advance(rg_quad *x, rg_quad *y, rg_quad *z, const rg_quad *rho_cos, const rg_quad *rho_sin,
                       const rg_quad *theta_cos, const rg_quad *theta_sin)
{
    const rg_quad turned = *rho_cos * *y + *rho_sin * *z;
    *z = *rho_cos * *z - *rho_sin * *y;
    *y = *theta_cos * turned - *theta_sin * *x;
    *x = *theta_cos * *x + *theta_sin * turned;
}

/* v[4] <- four vectors */
RG_WITHIN void scatter(const rg_quad *x, const rg_quad *y, const rg_quad *z, rg_vec3 *v0, rg_vec3 *v1, rg_vec3 *v2, rg_vec3 *v3)
{
    *v0 = (rg_vec3){(*x)[0], (*y)[0], (*z)[0]};
    *v1 = (rg_vec3){(*x)[1], (*y)[1], (*z)[1]};
    *v2 = (rg_vec3){(*x)[2], (*y)[2], (*z)[2]};
    *v3 = (rg_vec3){(*x)[3], (*y)[3], (*z)[3]};
}

/* Round each vertex of the four, as rg_loop_walk does: C's numbers and r if they are wanted. bad: out, a measure of the
 * rotation angle of F that rises with it, sin^2 up to a right angle and 2 - sin^2 beyond; NaN for NaN. Loops of three and
 * four are written out: compilers unroll them at -O3 only. */
RG_WITHIN void walk_four(rg_constraint *K, const rg_four *four, int wanted, rg_quad *bad)
{
    const int32_t *crease = K->crease + 4 * four->at, *start = K->C.start, *vertex = four->vertex;
    const double *tc = K->theta_cos + 4 * four->at, *ts = K->theta_sin + 4 * four->at;
    const double *cosine = K->cos, *sine = K->sin;
    rg_vec3 *c0 = K->C.x + start[vertex[0]], *c1 = K->C.x + start[vertex[1]];
    rg_vec3 *c2 = K->C.x + start[vertex[2]], *c3 = K->C.x + start[vertex[3]];
    rg_quad xx = {1, 1, 1, 1}, xy = {0}, xz = {0}, yx = {0}, yy = xx, yz = {0}, zx = {0}, zy = {0}, zz = xx; /* columns of A */
    for (int32_t i = 0; i < four->degree; i++, crease += 4, tc += 4, ts += 4) {
        const rg_quad rc = {cosine[crease[0]], cosine[crease[1]], cosine[crease[2]], cosine[crease[3]]};
        const rg_quad rs = {sine[crease[0]], sine[crease[1]], sine[crease[2]], sine[crease[3]]};
        const rg_quad c = *(const rg_quad_anywhere *)tc, s = *(const rg_quad_anywhere *)ts;
        if (wanted) scatter(&xx, &xy, &xz, c0 + i, c1 + i, c2 + i, c3 + i); /* (b, c, a)_i = A_i e_x      eqs. (2)-(7) */
        advance(&xx, &yx, &zx, &rc, &rs, &c, &s);
        advance(&xy, &yy, &zy, &rc, &rs, &c, &s);
        advance(&xz, &yz, &zz, &rc, &rs, &c, &s);
    }
    const rg_quad r0 = (yz - zy) * 0.5, r1 = (zx - xz) * 0.5, r2 = (xy - yx) * 0.5; /* eq. (13) */
    rg_vec3 *r = (rg_vec3 *)K->r; /* eq. (12) */
    if (wanted) scatter(&r0, &r1, &r2, r + vertex[0], r + vertex[1], r + vertex[2], r + vertex[3]);
    const rg_quad sine2 = r0 * r0 + r1 * r1 + r2 * r2, twice = xx + yy + zz - 1;
    const rg_quad_int acute = twice > 0;
    *bad = (rg_quad)((acute & (rg_quad_int)sine2) | (~acute & (rg_quad_int)(2 - sine2)));
}

/* All vertices; returns the one at which F turns most, one that is NaN if there is one. */
RG_WIDE static int32_t walk_all(rg_constraint *K, int wanted)
{
    rg_quad most = {-1, -1, -1, -1}, sum = {0};
    rg_quad_int where = {0}, here = {0};
    for (int32_t g = 0; g < K->fours; g++, here += 1) {
        rg_quad bad;
        if (wanted) walk_four(K, &K->four[g], 1, &bad);
        else walk_four(K, &K->four[g], 0, &bad);
        const rg_quad_int more = bad > most;
        most = (rg_quad)((more & (rg_quad_int)bad) | (~more & (rg_quad_int)most));
        where = (more & here) | (~more & where);
        sum += bad;
    }
    int lane = 0;
    for (int i = 1; i < 4; i++)
        if (most[i] > most[lane]) lane = i;
    const double all = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    for (int32_t g = 0; all != all && g < K->fours; g++) {
        rg_quad bad;
        walk_four(K, &K->four[g], 0, &bad);
        for (int i = 0; i < 4; i++)
            if (bad[i] != bad[i]) return K->four[g].vertex[i];
    }
    return K->fours ? K->four[where[lane]].vertex[lane] : -1;
}

double rg_constraint_angle(const rg_constraint *K, int32_t k)
{
    if (k < 0) return 0;
    rg_mat3 A = rg_mat3_identity();
    for (int32_t j = K->C.start[k]; j < K->C.start[k + 1]; j++)
        A = rg_loop_advance(A, (rg_turn){K->cos[K->C.col[j]], K->sin[K->C.col[j]]}, K->theta[j]);
    return rg_loop_angle(A);
}

void rg_constraint_set_still(rg_constraint *K)
{
    K->stills = 0;
    for (int32_t i = 0; i < K->C.N; i++) K->stills += K->still[i] != 0;
}

void rg_constraint_forget_still(rg_constraint *K)
{
    for (int32_t j = 0; K->stills && j < K->C.start[K->C.M]; j++)
        if (K->still[K->C.col[j]]) K->C.x[j] = (rg_vec3){0, 0, 0};
}

double rg_constraint_assemble(rg_constraint *K, const double *rho)
{
    turn_creases(K, rho);
    const int32_t worst = walk_all(K, 1);
    rg_constraint_forget_still(K);
    return rg_constraint_angle(K, worst);
}

double rg_constraint_closure(rg_constraint *K, const double *rho, int32_t *worst)
{
    turn_creases(K, rho);
    int32_t k = walk_all(K, 0);
    double angle = rg_constraint_angle(K, k);
    if (worst) *worst = angle != 0 ? k : -1; /* also where it is NaN */
    return angle;
}
