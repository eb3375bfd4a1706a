#include "kinematics/constraint.h"
#include "base/lanes.h"
#include "kinematics/kawasaki.h"
#include "kinematics/turn.h"

#include <string.h>

static int32_t degree(const rg_sparse *C, int32_t k) { return C->start[k + 1] - C->start[k]; }

/* sorted[count]: out, the vertices by rising degree. of_degree[most + 2]: scratch, zero. *fours: out, how many there
 * are of them. Returns the blocks that they take. */
static size_t sort_by_degree(const rg_sparse *C, const int32_t *vertex, int32_t count, int32_t most,
                             int32_t *of_degree, int32_t *sorted, int32_t *fours)
{
    size_t blocks = 0;
    *fours = 0;
    for (int32_t n = 0; n < count; n++) of_degree[degree(C, vertex ? vertex[n] : n) + 1]++;
    for (int32_t d = 0; d <= most; d++) {
        const size_t more = ((size_t)of_degree[d + 1] + 3) / 4;
        *fours += (int32_t)more;
        blocks += 4 * more * (size_t)d;
        of_degree[d + 1] += of_degree[d];
    }
    for (int32_t n = 0; n < count; n++) {
        const int32_t k = vertex ? vertex[n] : n;
        sorted[of_degree[degree(C, k)]++] = k;
    }
    return blocks;
}

rg_status rg_fours_init(rg_fours *w, const rg_memory *mem, const rg_sparse *C, const int32_t *vertex, int32_t count)
{
    int32_t most = 0, at = 0;
    memset(w, 0, sizeof *w);
    for (int32_t k = 0; k < C->M; k++)
        if (degree(C, k) > most) most = degree(C, k);
    int32_t *of_degree, *sorted;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(of_degree, (size_t)most + 2), RG_ARRAY(sorted, (size_t)count));
    if (s != RG_OK) return s;
    const size_t blocks = sort_by_degree(C, vertex, count, most, of_degree, sorted, &w->count);
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(w->four, (size_t)w->count), RG_ARRAY(w->crease, blocks),
                      RG_ARRAY(w->theta_cos, blocks), RG_ARRAY(w->theta_sin, blocks));
    for (int32_t k = 0, g = 0; s == RG_OK && k < count; g++) {
        rg_four *four = &w->four[g];
        four->degree = degree(C, sorted[k]);
        four->at = at;
        for (int lane = 0; lane < 4; lane++) {
            const int32_t last = lane ? four->vertex[lane - 1] : sorted[k];
            const int32_t v = k < count && degree(C, sorted[k]) == four->degree ? sorted[k++] : last;
            four->vertex[lane] = v;
            for (int32_t i = 0; i < four->degree; i++) w->crease[4 * (at + i) + lane] = C->col[C->start[v] + i];
        }
        at += four->degree;
    }
    RG_MEM_FREE(mem, of_degree, sorted);
    if (s != RG_OK) memset(w, 0, sizeof *w);
    return s;
}

void rg_fours_free(rg_fours *w, const rg_memory *mem)
{
    RG_MEM_FREE(mem, w->four, w->crease, w->theta_cos, w->theta_sin);
    memset(w, 0, sizeof *w);
}

static int32_t other_end(const rg_mesh *m, int32_t crease, int32_t v)
{
    const int32_t *e = m->edge[m->crease_edge[crease]];
    return e[e[0] == v];
}

/* What a pattern that gives way takes besides. */
static rg_status make_moving(rg_constraint *K, const rg_mesh *m, const rg_freedom *f, int kawasaki)
{
    const size_t blocks = (size_t)m->loop_start[m->M];
    K->mesh = m;
    K->freedom = f;
    const rg_status s = RG_MEM_ARRAYS(&K->mem, RG_ARRAY(K->X, (size_t)m->nv), RG_ARRAY(K->kawasaki, (size_t)m->M),
                                      RG_ARRAY(K->far, blocks), RG_ARRAY(K->turning, blocks),
                                      RG_ARRAY(K->normal, blocks), RG_ARRAY(K->sector, blocks));
    if (s != RG_OK) return s;
    memcpy(K->X, m->X, (size_t)m->nv * sizeof *K->X);
    memcpy(K->sector, m->loop_theta, blocks * sizeof *K->sector);
    for (int32_t k = 0; k < m->M; k++) {
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++)
            K->far[j] = other_end(m, m->loop_crease[j], m->inner_vertex[k]);
        K->kawasaki[k] = kawasaki && f->U && rg_kawasaki_holds(m, k, K->sector) ? 3 * m->M + K->kept++ : -1;
    }
    return RG_OK;
}

rg_status rg_constraint_init_moving(rg_constraint *K, const rg_memory *mem, const rg_mesh *m, const rg_freedom *f,
                                    int kawasaki)
{
    memset(K, 0, sizeof *K);
    rg_status s = rg_sparse_init(&K->C, mem, m->M, m->N, m->loop_start, m->loop_crease);
    if (s != RG_OK) return s;
    K->mem = *mem;
    const size_t whole = ((size_t)m->N + 3) & ~(size_t)3;
    if (f) s = make_moving(K, m, f, kawasaki);
    if (s == RG_OK) s = RG_MEM_ARRAYS(mem, RG_ARRAY(K->r, 3 * (size_t)m->M + (size_t)K->kept),
                                      RG_ARRAY(K->theta, (size_t)m->loop_start[m->M]), RG_ARRAY(K->cos, whole),
                                      RG_ARRAY(K->sin, whole), RG_ARRAY(K->still, (size_t)m->N));
    if (s == RG_OK) s = rg_fours_init(&K->all, mem, &K->C, NULL, m->M);
    if (s != RG_OK) {
        rg_constraint_free(K);
        return s;
    }
    rg_constraint_set_theta(K, m->loop_theta);
    for (int32_t i = 0; m->still && i < m->N; i++) K->still[i] = m->still[m->crease_edge[i]];
    rg_constraint_set_still(K);
    return RG_OK;
}

rg_status rg_constraint_init(rg_constraint *K, const rg_memory *mem, const rg_mesh *m)
{
    return rg_constraint_init_moving(K, mem, m, NULL, 0);
}

void rg_constraint_free(rg_constraint *K)
{
    if (!K->mem.resize) return;
    rg_memory mem = K->mem;
    rg_sparse_free(&K->C);
    rg_fours_free(&K->all, &mem);
    RG_MEM_FREE(&mem, K->r, K->theta, K->cos, K->sin, K->still, K->X, K->kawasaki, K->far, K->turning, K->normal,
                K->sector);
    memset(K, 0, sizeof *K);
}

/* ---------------------------------------------------------------------------------------------- sector angles ---- */

/* What theta says of these vertices, by fours. */
static void deal_sectors(const rg_constraint *K, rg_fours *w)
{
    for (int32_t g = 0; g < w->count; g++)
        for (int lane = 0; lane < 4; lane++)
            for (int32_t i = 0; i < w->four[g].degree; i++) {
                const rg_turn t = K->theta[K->C.start[w->four[g].vertex[lane]] + i];
                const int32_t at = 4 * (w->four[g].at + i) + lane;
                w->theta_cos[at] = t.cos;
                w->theta_sin[at] = t.sin;
            }
}

void rg_constraint_set_theta(rg_constraint *K, const double *theta)
{
    for (int32_t j = 0; j < K->C.start[K->C.M]; j++) K->theta[j] = (rg_turn){cos(theta[j]), sin(theta[j])};
    deal_sectors(K, &K->all);
}

rg_status rg_constraint_set_pattern(rg_constraint *K, const rg_mesh *m, const rg_vec2 *X)
{
    double *theta = rg_mem_array(&K->mem, (size_t)m->loop_start[m->M], sizeof *theta);
    if (!theta) return RG_ENOMEM;
    rg_mesh_sectors(m, X, theta);
    rg_constraint_set_theta(K, theta);
    rg_mem_free(&K->mem, theta);
    return RG_OK;
}

/* The cosines and sines between the directions from vertex k, on the pattern as it is moved, and how those turn. */
static void look_round(rg_constraint *K, int32_t k)
{
    const int32_t first = K->C.start[k], last = K->C.start[k + 1];
    const rg_vec2 at = K->X[K->mesh->inner_vertex[k]];
    rg_vec2 start = {0, 0}, before = {0, 0}; /* unit vectors: the first one, the one before */
    for (int32_t j = first; j < last; j++) {
        const rg_vec2 d = rg_vec2_sub(K->X[K->far[j]], at);
        const double inverse = 1 / sqrt(rg_vec2_dot(d, d));
        const rg_vec2 e = {inverse * d.x, inverse * d.y};
        K->turning[j] = (rg_vec2){-inverse * e.y, inverse * e.x};
        if (j == first) start = e;
        else K->theta[j - 1] = (rg_turn){rg_vec2_dot(before, e), rg_vec2_cross(before, e)};
        before = e;
    }
    if (first < last) K->theta[last - 1] = (rg_turn){rg_vec2_dot(before, start), rg_vec2_cross(before, start)};
}

static void move(rg_constraint *K, rg_fours *w, const double *u)
{
    if (K->freedom->U) rg_freedom_move(K->freedom, u, K->X);
    for (int32_t g = 0; g < w->count; g++)
        for (int lane = 0; lane < 4; lane++) {
            const int32_t k = w->four[g].vertex[lane];
            if (lane == 0 || k != w->four[g].vertex[lane - 1]) look_round(K, k);
        }
    deal_sectors(K, w);
}

/* r' of the vertices that keep eq. (16) among these. Returns the largest. */
static double assemble_kawasaki(rg_constraint *K, const rg_fours *w)
{
    double most = 0;
    for (int32_t g = 0; K->kept > 0 && g < w->count; g++)
        for (int lane = 0; lane < 4; lane++) {
            const int32_t k = w->four[g].vertex[lane];
            if (K->kawasaki[k] < 0) continue;
            double *sum = &K->r[K->kawasaki[k]];
            rg_mesh_sectors_at(K->mesh, k, K->X, K->sector);
            rg_kawasaki_alternate(K->mesh, k, K->sector, sum, NULL);
            if (!(fabs(*sum) <= most)) most = fabs(*sum);
        }
    return most;
}

/* ---------------------------------------------------------------------------------------------------- the walk ---- */

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

/* v0 ... v3 <- four vectors */
RG_WITHIN void scatter(const rg_quad *x, const rg_quad *y, const rg_quad *z, rg_vec3 *v0, rg_vec3 *v1, rg_vec3 *v2,
                       rg_vec3 *v3)
{
    *v0 = (rg_vec3){(*x)[0], (*y)[0], (*z)[0]};
    *v1 = (rg_vec3){(*x)[1], (*y)[1], (*z)[1]};
    *v2 = (rg_vec3){(*x)[2], (*y)[2], (*z)[2]};
    *v3 = (rg_vec3){(*x)[3], (*y)[3], (*z)[3]};
}

/* Round each vertex of the four, as rg_loop_walk does: C's numbers and r if they are wanted, and normals if they are.
 *   bad  out  rises with the rotation angle of F: sin^2 up to a right angle, 2 - sin^2 beyond; NaN for NaN
 * Loops of three and four are written out: compilers unroll them at -O3 only. */
RG_WITHIN void walk_four(rg_constraint *K, const rg_fours *w, const rg_four *four, int wanted, int normals,
                         rg_quad *bad)
{
    const int32_t *crease = w->crease + 4 * four->at, *start = K->C.start, *vertex = four->vertex;
    const double *tc = w->theta_cos + 4 * four->at, *ts = w->theta_sin + 4 * four->at;
    const double *cosine = K->cos, *sine = K->sin;
    rg_vec3 *c0 = K->C.x + start[vertex[0]], *c1 = K->C.x + start[vertex[1]];
    rg_vec3 *c2 = K->C.x + start[vertex[2]], *c3 = K->C.x + start[vertex[3]];
    rg_quad xx = {1, 1, 1, 1}, xy = {0}, xz = {0}, yx = {0}, yy = xx, yz = {0}, zx = {0}, zy = {0}, zz = xx; /* of A */
    for (int32_t i = 0; i < four->degree; i++, crease += 4, tc += 4, ts += 4) {
        const rg_quad rc = {cosine[crease[0]], cosine[crease[1]], cosine[crease[2]], cosine[crease[3]]};
        const rg_quad rs = {sine[crease[0]], sine[crease[1]], sine[crease[2]], sine[crease[3]]};
        const rg_quad c = *(const rg_quad_anywhere *)tc, s = *(const rg_quad_anywhere *)ts;
        if (wanted) scatter(&xx, &xy, &xz, c0 + i, c1 + i, c2 + i, c3 + i); /* (b, c, a)_i = A_i e_x   eqs. (2)-(7) */
        advance(&xx, &yx, &zx, &rc, &rs, &c, &s);
        advance(&xy, &yy, &zy, &rc, &rs, &c, &s);
        advance(&xz, &yz, &zz, &rc, &rs, &c, &s);
        if (normals) { /* A_(i+1) e_z: turning by theta is about the facet's normal, which it leaves as it is */
            rg_vec3 *n0 = K->normal + start[vertex[0]], *n1 = K->normal + start[vertex[1]];
            rg_vec3 *n2 = K->normal + start[vertex[2]], *n3 = K->normal + start[vertex[3]];
            scatter(&zx, &zy, &zz, n0 + i, n1 + i, n2 + i, n3 + i);
        }
    }
    const rg_quad r0 = (yz - zy) * 0.5, r1 = (zx - xz) * 0.5, r2 = (xy - yx) * 0.5; /* eq. (13) */
    rg_vec3 *r = (rg_vec3 *)K->r; /* eq. (12) */
    if (wanted) scatter(&r0, &r1, &r2, r + vertex[0], r + vertex[1], r + vertex[2], r + vertex[3]);
    const rg_quad sine2 = r0 * r0 + r1 * r1 + r2 * r2, twice = xx + yy + zz - 1;
    const rg_quad_int acute = twice > 0;
    *bad = (rg_quad)((acute & (rg_quad_int)sine2) | (~acute & (rg_quad_int)(2 - sine2)));
}

/* All vertices; returns the one at which F turns most, one that is NaN if there is one. */
RG_WIDE static int32_t walk_all(rg_constraint *K, const rg_fours *w, int wanted)
{
    rg_quad most = {-1, -1, -1, -1}, sum = {0};
    rg_quad_int where = {0}, here = {0};
    const int normals = wanted && K->normal;
    for (int32_t g = 0; g < w->count; g++, here += 1) {
        rg_quad bad;
        if (normals) walk_four(K, w, &w->four[g], 1, 1, &bad);
        else if (wanted) walk_four(K, w, &w->four[g], 1, 0, &bad);
        else walk_four(K, w, &w->four[g], 0, 0, &bad);
        const rg_quad_int more = bad > most;
        most = (rg_quad)((more & (rg_quad_int)bad) | (~more & (rg_quad_int)most));
        where = (more & here) | (~more & where);
        sum += bad;
    }
    int lane = 0;
    for (int i = 1; i < 4; i++)
        if (most[i] > most[lane]) lane = i;
    const double all = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    for (int32_t g = 0; all != all && g < w->count; g++) {
        rg_quad bad;
        walk_four(K, w, &w->four[g], 0, 0, &bad);
        for (int i = 0; i < 4; i++)
            if (bad[i] != bad[i]) return w->four[g].vertex[i];
    }
    return w->count ? w->four[where[lane]].vertex[lane] : -1;
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

static double assemble(rg_constraint *K, const rg_fours *w, const double *rho)
{
    turn_creases(K, rho);
    const int32_t worst = walk_all(K, w, 1);
    rg_constraint_forget_still(K);
    return rg_constraint_angle(K, worst);
}

double rg_constraint_assemble(rg_constraint *K, const double *rho) { return assemble(K, &K->all, rho); }

double rg_constraint_assemble_at(rg_constraint *K, rg_fours *some, const double *rho, const double *u, double *off)
{
    rg_fours *w = some ? some : &K->all;
    move(K, w, u);
    const double most = assemble_kawasaki(K, w);
    if (off) *off = most;
    return assemble(K, w, rho);
}

double rg_constraint_closure(rg_constraint *K, const double *rho, int32_t *worst)
{
    turn_creases(K, rho);
    int32_t k = walk_all(K, &K->all, 0);
    double angle = rg_constraint_angle(K, k);
    if (worst) *worst = angle != 0 ? k : -1; /* also where it is NaN */
    return angle;
}
