#include "kinematics/tangent.h"
#include "base/lanes.h"

#include <string.h>

/* As exact as rounding lets it be. */
static const double SOLVE_TOLERANCE = 1e-13;
/* What is left of a unit vector by chance when motions are projected out of it is its share of what is left of the
 * space; less than this is rounding. That many vectors in a row have to leave nothing. */
static const double NOTHING = 1e-6;
static const int32_t SURE = 2;
/* Each makes a reaction better by the fourth power of ten or so. */
static const int32_t REFINEMENTS = 3;
/* Squares of what is beyond 2^512 are endless, of what is below 2^-512 nothing: a wish this far from 1 is brought near
 * it, and what comes of it back. */
enum { FAR = 300 };

struct rg_tangent {
    rg_memory mem;
    rg_constraint K;
    rg_project P;
    int32_t *row_start, *column, *vertex;
    double *value, *residual, *angle;
    double *v, *rest, *spare; /* [N] scratch */
    double *basis;
    size_t basis_room;
    int32_t freedoms;      /* -1: not known yet */
    rg_tangent_info info;
};

void rg_tangent_destroy(rg_tangent *t)
{
    if (!t) return;
    const rg_memory mem = t->mem;
    rg_constraint_free(&t->K);
    rg_project_free(&t->P);
    RG_MEM_FREE(&mem, t->row_start, t->column, t->vertex, t->value, t->residual, t->angle, t->v, t->rest, t->spare,
                t->basis);
    rg_mem_free(&mem, t);
}

const rg_tangent_info *rg_tangent_get_info(const rg_tangent *t) { return &t->info; }

/* Blocks of three rows and one column become rows, columns rising.   eq. (8) */
static void compress(rg_tangent *t)
{
    const rg_sparse *C = &t->K.C;
    for (int32_t k = 0; k < C->M; k++) {
        const int32_t n = C->start[k + 1] - C->start[k], at = 3 * C->start[k];
        for (int row = 0; row < 3; row++) t->row_start[3 * k + row] = at + row * n;
        for (int32_t j = C->start[k]; j < C->start[k + 1]; j++) {
            int32_t place = 0;
            for (int32_t i = C->start[k]; i < C->start[k + 1]; i++) place += C->col[i] < C->col[j];
            const double x[3] = {C->x[j].x, C->x[j].y, C->x[j].z};
            for (int row = 0; row < 3; row++) {
                t->column[at + row * n + place] = C->col[j];
                t->value[at + row * n + place] = x[row];
            }
        }
    }
    t->row_start[3 * C->M] = 3 * C->start[C->M];
}

static rg_status fill(rg_tangent *t, const rg_mesh *m, const rg_vec2 *X, const double *rho)
{
    const size_t rows = 3 * (size_t)m->M, entries = 3 * (size_t)m->loop_start[m->M];
    rg_status s = rg_constraint_init(&t->K, &t->mem, m);
    if (s == RG_OK && X) s = rg_constraint_set_pattern(&t->K, m, X);
    if (s == RG_OK) s = rg_project_init(&t->P, &t->mem, &t->K, RG_SOLVER_AUTO);
    if (s == RG_OK) s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(t->row_start, rows + 1), RG_ARRAY(t->column, entries),
                                      RG_ARRAY(t->value, entries), RG_ARRAY(t->residual, rows),
                                      RG_ARRAY(t->vertex, (size_t)m->M), RG_ARRAY(t->angle, (size_t)m->M),
                                      RG_ARRAY(t->v, (size_t)m->N), RG_ARRAY(t->rest, (size_t)m->N),
                                      RG_ARRAY(t->spare, (size_t)m->N));
    if (s != RG_OK) return s;
    rg_constraint_assemble(&t->K, rho);
    compress(t);
    memcpy(t->residual, t->K.r, rows * sizeof *t->residual);
    memcpy(t->vertex, m->inner_vertex, (size_t)m->M * sizeof *t->vertex);
    for (int32_t k = 0; k < m->M; k++) t->angle[k] = rg_constraint_angle(&t->K, k);
    t->info = (rg_tangent_info){3 * m->M, m->N, t->row_start, t->column, t->value, t->residual, t->vertex, t->angle};
    return RG_OK;
}

rg_status rg_tangent_at(const rg_mesh *m, const rg_memory *mem, const rg_vec2 *X, const double *rho,
                        rg_tangent **tangent)
{
    rg_tangent *t = rg_mem_array(mem, 1, sizeof *t);
    if (!t) return RG_ENOMEM;
    t->mem = *mem;
    t->freedoms = -1;
    const rg_status s = fill(t, m, X, rho);
    if (s == RG_OK) *tangent = t;
    else rg_tangent_destroy(t);
    return s;
}

static rg_status project(rg_tangent *t, const double *wish, double *step)
{
    rg_cg_report rep;
    memset(t->P.y, 0, 3 * (size_t)t->K.C.M * sizeof *t->P.y);
    return rg_project_step(&t->P, &t->K, wish, 0, NULL, step, SOLVE_TOLERANCE, &rep); /* eq. (9) */
}

/* The power of two to divide a wish by; 0: it is as it should be. */
static int power_of(int32_t n, const double *wish)
{
    double most = 0;
    int power;
    for (int32_t i = 0; i < n; i++) most = fmax(most, fabs(wish[i]));
    frexp(most, &power);
    return power > FAR || power < -FAR ? power : 0;
}

static void bring_back(int32_t n, double *x, int power)
{
    for (int32_t i = 0; power && i < n; i++) x[i] = ldexp(x[i], power);
}

rg_status rg_tangent_project(rg_tangent *t, const double *wish, double *step, double *reaction)
{
    const int32_t N = t->K.C.N, rows = 3 * t->K.C.M;
    for (int32_t i = 0; i < N; i++)
        if (!isfinite(wish[i])) return RG_EARG;
    const int power = power_of(N, wish);
    for (int32_t i = 0; i < N; i++) t->v[i] = t->K.still[i] ? 0 : power ? ldexp(wish[i], -power) : wish[i];
    rg_status s = project(t, t->v, step);
    if (s == RG_OK && reaction) {
        memcpy(reaction, t->P.y, (size_t)rows * sizeof *reaction);
        for (int32_t i = 0; i < N; i++) t->rest[i] = t->v[i] - step[i];
    }
    /* The factor is of C C^T + beta I, which leaves some of what is taken without its y: more of the same for that. */
    for (int32_t n = 0; s == RG_OK && reaction && n < REFINEMENTS; n++) {
        rg_sparse_mul_t(&t->K.C, reaction, t->v);
        for (int32_t i = 0; i < N; i++) t->v[i] = t->rest[i] - t->v[i];
        s = project(t, t->v, t->spare);
        for (int32_t i = 0; s == RG_OK && i < rows; i++) reaction[i] += t->P.y[i];
    }
    bring_back(N, step, power);
    if (reaction) bring_back(rows, reaction, power);
    return s;
}

/* ---------------------------------------------------------------------------------------------------- basis ---- */

/* -1 ... 1; the constants are those of splitmix64. The same numbers every time. */
static double noise(uint64_t *seed)
{
    uint64_t x = *seed += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
    x ^= x >> 31;
    return (double)(x >> 11) * 0x1p-52 - 1;
}

static void normalise(int32_t n, double *x)
{
    const double length = sqrt(rg_lanes_dot(n, x, x));
    for (int32_t i = 0; i < n; i++) x[i] /= length > 0 ? length : 1;
}

/* x without its parts along the basis; twice, which is enough for rounding. */
static void make_orthogonal(const rg_tangent *t, int32_t freedoms, double *x)
{
    const int32_t N = t->K.C.N;
    for (int pass = 0; pass < 2; pass++)
        for (int32_t k = 0; k < freedoms; k++) {
            const double *b = t->basis + (size_t)k * (size_t)N;
            rg_lanes_add(N, -rg_lanes_dot(N, b, x), b, x);
        }
}

/* A motion that the others do not make, of unit length; the length of what was found: NOTHING or less, there is
 * none. */
static rg_status find_motion(rg_tangent *t, int32_t freedoms, uint64_t *seed, double *x, double *length)
{
    const int32_t N = t->K.C.N;
    for (int32_t i = 0; i < N; i++) x[i] = t->K.still[i] ? 0 : noise(seed);
    normalise(N, x);
    make_orthogonal(t, freedoms, x);
    rg_status s = rg_tangent_project(t, x, x, NULL);
    make_orthogonal(t, freedoms, x);
    *length = sqrt(rg_lanes_dot(N, x, x));
    if (s != RG_OK || !(*length > NOTHING)) return s;
    normalise(N, x);
    s = rg_tangent_project(t, x, x, NULL);
    make_orthogonal(t, freedoms, x);
    *length *= sqrt(rg_lanes_dot(N, x, x)); /* what was rounding is gone now */
    normalise(N, x);
    return s;
}

rg_status rg_tangent_basis(rg_tangent *t, int32_t *freedoms, const double **basis)
{
    const size_t N = (size_t)t->K.C.N;
    uint64_t seed = 1;
    rg_status s = RG_OK;
    for (int32_t n = 0, none = 0; t->freedoms < 0;) {
        double length;
        s = RG_MEM_GROW(&t->mem, t->basis, t->basis_room, ((size_t)n + 1) * N);
        if (s == RG_OK) s = find_motion(t, n, &seed, t->basis + (size_t)n * N, &length);
        if (s != RG_OK) return s;
        none = length > NOTHING ? 0 : none + 1;
        n += none == 0;
        if (none == SURE || n == t->K.C.N - t->K.stills) t->freedoms = n;
    }
    *freedoms = t->freedoms;
    if (basis) *basis = t->basis;
    return s;
}
