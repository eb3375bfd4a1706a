#include "unfold/nearest.h"
#include "linalg/dense.h"

#include <string.h>

/* A row counts as broken when it misses its bound by more than the first (lengths of the sheet, radians) and this part of it. */
static const double BROKEN = 1e-9, BROKEN_PART = 1e-3;
/* Times that broken rows are added: most steps need one to three. */
static const int ROUNDS = 8;
/* A row that closure leaves this little of has next to no leverage; it is not blown up further. */
static const double LEAST_LEVERAGE = 1e-3;
/* What is left of a row of norm 1 outside the directions of the others is rounding below this. */
static const double NEW_DIRECTION = 1e-9;
/* A compliance below this is too near to rounding in H to be told from none. */
static const double LEAST_COMPLIANCE = 1e-11;

static int32_t in_fours(int32_t n) { return (n + 3) & ~3; }

rg_status rg_nearest_init(rg_nearest *q, const rg_memory *mem, rg_linkage *P)
{
    memset(q, 0, sizeof *q);
    q->mem = q->q.mem = *mem;
    q->P = P;
    q->stride = (size_t)in_fours(P->n);
    double **vector[] = {&q->scale, &q->y0, &q->y, &q->dz, &q->scratch, &q->wish};
    int ok = 1;
    for (int i = 0; i < 6; i++) ok &= (*vector[i] = rg_mem_array(mem, q->stride, sizeof(double))) != NULL;
    q->right = rg_mem_array(mem, (size_t)P->J.A.rows, sizeof *q->right);
    q->dp = rg_mem_array(mem, (size_t)P->mesh->nv, sizeof *q->dp);
    if (ok && q->right && q->dp) return RG_OK;
    rg_nearest_free(q);
    return RG_ENOMEM;
}

void rg_nearest_free(rg_nearest *q)
{
    if (!q->mem.resize) return;
    rg_interior_free(&q->q);
    void *block[] = {q->scale, q->row, q->Q, q->F, q->norm, q->active, q->y0, q->y, q->dz, q->scratch, q->wish, q->right, q->dp};
    for (int i = 0; i < 13; i++) rg_mem_free(&q->mem, block[i]);
    memset(q, 0, sizeof *q);
}

void rg_nearest_clear(rg_nearest *q) { q->count = q->made = q->ways = 0; }

rg_row *rg_nearest_add(rg_nearest *q)
{
    if (rg_mem_grow(&q->mem, (void **)&q->row, &q->room, (size_t)q->count + 1, sizeof *q->row) != RG_OK) return NULL;
    rg_row *row = &q->row[q->count++];
    memset(row, 0, sizeof *row);
    row->crease = row->at = -1;
    row->c = LEAST_COMPLIANCE;
    return row;
}

/* y - what of it is not free of A: y <- y - A^+ (A y + r). */
static void project(rg_nearest *q, double *y, const double *r)
{
    rg_least *A = &q->P->J.A;
    rg_least_mul(A, y, q->right);
    for (int32_t i = 0; r && i < A->rows; i++) q->right[i] += r[i];
    if (A->rows > 0) {
        rg_least_solve(A, q->right, q->scratch); /* eq. (15) */
        for (int32_t i = 0; i < q->P->n; i++) y[i] -= q->scratch[i];
    }
    q->work += 8 * (double)A->start[A->columns] + 4 * A->L.S.entries;
}

static void move(rg_nearest *q, const double *y)
{
    for (int32_t i = 0; i < q->P->n; i++) q->dz[i] = y[i] * q->scale[i];
    rg_linkage_velocity(q->P, q->dz, q->dp);
}

double rg_nearest_value(const rg_nearest *q, const rg_row *row)
{
    if (row->crease >= 0) return row->weight[0] * q->dz[row->crease];
    double sum = 0;
    for (int32_t i = 0; i < row->terms; i++) sum += row->weight[i] * rg_vec3_dot(row->n, q->dp[row->v[i]]);
    return sum;
}

void rg_nearest_project(rg_nearest *q, const double *wish, const double *r)
{
    for (int32_t i = 0; i < q->P->n; i++) q->y0[i] = wish ? wish[i] / q->scale[i] : 0;
    project(q, q->y0, r);
    move(q, q->y0);
}

/* g (norm 1) as a row of F, and its new direction, if it has one, as one more of Q: Gram and Schmidt, twice. */
static rg_status split(rg_nearest *q, double *g, double *f)
{
    const rg_status s = rg_mem_grow(&q->mem, (void **)&q->Q, &q->Q_room, ((size_t)q->ways + 1) * q->stride, sizeof *q->Q);
    if (s != RG_OK) return s;
    memset(f, 0, q->stride * sizeof *f);
    for (int pass = 0; pass < 2; pass++)
        for (int32_t j = 0; j < q->ways; j++) {
            const double *e = q->Q + (size_t)j * q->stride, part = rg_dense_dot((int32_t)q->stride, e, g);
            f[j] += part;
            for (size_t i = 0; i < q->stride; i++) g[i] -= part * e[i];
        }
    const double rest = sqrt(rg_dense_dot((int32_t)q->stride, g, g));
    q->work += 4 * (double)q->ways * q->P->n;
    if (!(rest > NEW_DIRECTION) || q->ways >= q->P->n) return RG_OK;
    double *e = q->Q + (size_t)q->ways * q->stride;
    for (size_t i = 0; i < q->stride; i++) e[i] = g[i] / rest;
    f[q->ways++] = rest;
    return RG_OK;
}

static rg_status make(rg_nearest *q, rg_row *row)
{
    const int32_t n = q->P->n;
    const size_t at = (size_t)q->made;
    rg_status s = rg_mem_grow(&q->mem, (void **)&q->F, &q->F_room, (at + 1) * q->stride, sizeof *q->F);
    if (s == RG_OK) s = rg_mem_grow(&q->mem, (void **)&q->norm, &q->norm_room, at + 1, sizeof *q->norm);
    if (s != RG_OK) return s;
    double *g = q->y, whole = 0, free_part = 0;
    memset(g, 0, q->stride * sizeof *g);
    if (row->crease >= 0) g[row->crease] = row->weight[0];
    for (int32_t i = 0; row->crease < 0 && i < row->terms; i++)
        if (row->weight[i] != 0) rg_linkage_row(q->P, row->v[i], rg_vec3_scale(row->weight[i], row->n), g);
    for (int32_t i = 0; i < n; i++) {
        g[i] *= q->scale[i];
        whole += g[i] * g[i];
    }
    project(q, g, NULL);
    for (int32_t i = 0; i < n; i++) free_part += g[i] * g[i];
    const double norm = fmax(sqrt(free_part), LEAST_LEVERAGE * sqrt(whole));
    q->norm[at] = norm > 0 ? norm : 1;
    for (int32_t i = 0; i < n; i++) g[i] /= q->norm[at];
    s = split(q, g, q->F + at * q->stride);
    if (s == RG_OK) row->at = q->made++;
    return s;
}

static rg_status activate(rg_nearest *q, int32_t row, int soft)
{
    const size_t n = (size_t)q->actives + 1;
    rg_status s = q->row[row].at < 0 ? make(q, &q->row[row]) : RG_OK;
    if (s == RG_OK) s = rg_mem_grow(&q->mem, (void **)&q->active, &q->active_room, n, sizeof *q->active);
    if (s == RG_OK) q->active[q->actives++] = 2 * row + soft;
    return s;
}

static int is_active(const rg_nearest *q, int32_t what)
{
    for (int32_t i = 0; i < q->actives; i++)
        if (q->active[i] == what) return 1;
    return 0;
}

/* Activates what q->dz breaks. *more: out, whether there was anything. */
static rg_status add_broken(rg_nearest *q, int with_soft, int *more)
{
    rg_status s = RG_OK;
    *more = 0;
    for (int32_t i = 0; i < q->count && s == RG_OK; i++) {
        const rg_row *row = &q->row[i];
        const double value = rg_nearest_value(q, row);
        for (int soft = 0; soft <= (with_soft && row->soft_c > 0) && s == RG_OK; soft++) {
            const double b = soft ? q->row[i].soft_b : q->row[i].b;
            if (!(b - value > BROKEN + BROKEN_PART * fabs(b)) || is_active(q, 2 * i + soft)) continue;
            s = activate(q, i, soft);
            *more = 1;
        }
    }
    return s;
}

/* The quadratic program of the active rows: q->y. */
static rg_status push(rg_nearest *q)
{
    const int32_t m = q->actives, k = q->ways;
    const size_t stride = rg_interior_stride(k);
    const rg_status s = rg_interior_reserve(&q->q, m, k);
    if (s != RG_OK) return s;
    memset(q->scratch, 0, q->stride * sizeof *q->scratch); /* y0 along Q */
    for (int32_t j = 0; j < k; j++) q->scratch[j] = rg_dense_dot((int32_t)q->stride, q->Q + (size_t)j * q->stride, q->y0);
    for (int32_t i = 0; i < m; i++) {
        const rg_row *row = &q->row[q->active[i] / 2];
        const int soft = q->active[i] % 2;
        const double *f = q->F + (size_t)row->at * q->stride, part = 1 / q->norm[row->at];
        memcpy(q->q.F + (size_t)i * stride, f, stride * sizeof *f);
        q->q.c[i] = fmax((soft ? row->soft_c : row->c) * part * part, LEAST_COMPLIANCE);
        q->q.d[i] = (soft ? row->soft_b : row->b) * part - rg_dense_dot((int32_t)q->stride, f, q->scratch);
    }
    rg_interior_solve(&q->q, m, k);
    q->pushed = m;
    memcpy(q->y, q->y0, q->stride * sizeof *q->y);
    for (int32_t j = 0; j < k; j++) {
        const double x = q->q.v[j], *e = q->Q + (size_t)j * q->stride;
        for (size_t i = 0; i < q->stride; i++) q->y[i] += x * e[i];
    }
    return RG_OK;
}

rg_status rg_nearest_solve(rg_nearest *q, const double *wish, const double *r, int with_soft)
{
    int more = 0;
    rg_nearest_project(q, wish, r);
    const int32_t before = q->carry ? q->pushed : 0;
    rg_status s = RG_OK;
    q->actives = q->pushed = 0;
    for (int32_t i = 0; i < before && s == RG_OK; i++)
        if (q->q.x[i] > q->q.slack[i] && q->active[i] / 2 < q->count) s = activate(q, q->active[i] / 2, q->active[i] % 2);
    if (s == RG_OK) s = add_broken(q, with_soft, &more);
    more |= q->actives > 0;
    for (int round = 0; s == RG_OK && more && round < ROUNDS; round++) {
        s = push(q);
        if (s != RG_OK) break;
        move(q, q->y);
        s = add_broken(q, with_soft, &more);
    }
    return s;
}
