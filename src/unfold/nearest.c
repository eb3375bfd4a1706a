#include "unfold/nearest.h"

#include <string.h>

/* A row counts as broken when it misses its bound by more than the first (lengths of the sheet, radians) and this part
 * of it. */
static const double BROKEN = 1e-9, BROKEN_PART = 1e-3;
/* Times that broken rows are added: most steps need one to four. In the first of them of all that a corner or an edge
 * would meet one way, within 60 degrees, only the nearest: in a stack that is the next layer, which mostly keeps it
 * from those behind. */
static const int ROUNDS = 8, NEAREST_ROUNDS = 4;
static const double ONE_WAY = 0.5;
/* A compliance below this is too near to rounding to be told from none. */
static const double LEAST_COMPLIANCE = 1e-11;

rg_status rg_nearest_init(rg_nearest *q, const rg_memory *mem, rg_linkage *P)
{
    memset(q, 0, sizeof *q);
    q->mem = *mem;
    q->P = P;
    const size_t n = (size_t)P->n, nv = (size_t)P->mesh->nv, features = nv + (size_t)P->mesh->ne;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(q->scale, n), RG_ARRAY(q->y0, n), RG_ARRAY(q->y, n), RG_ARRAY(q->dz, n),
                                RG_ARRAY(q->scratch, n), RG_ARRAY(q->wish, n), RG_ARRAY(q->right, (size_t)P->J.A.rows),
                                RG_ARRAY(q->dp, nv), RG_ARRAY(q->head, features));
    for (size_t i = 0; s == RG_OK && i < features; i++) q->head[i] = -1;
    if (s == RG_OK) s = rg_interior_init(&q->q, mem, rg_places_count(P));
    if (s != RG_OK) rg_nearest_free(q);
    return s;
}

void rg_nearest_free(rg_nearest *q)
{
    if (!q->mem.resize) return;
    rg_interior_free(&q->q);
    RG_MEM_FREE(&q->mem, q->scale, q->row, q->active, q->y0, q->y, q->dz, q->scratch, q->wish, q->right, q->dp,
                q->head);
    memset(q, 0, sizeof *q);
}

double rg_nearest_stand(rg_nearest *q, const double *z)
{
    rg_linkage *P = q->P;
    const double angle = rg_coupled_assemble(&P->J, z, z + P->N, NULL);
    rg_coupled_renew(&P->J, q->scale);
    q->work += P->J.A.L.S.flops;
    rg_linkage_put(P, z);
    return angle;
}

void rg_nearest_clear(rg_nearest *q)
{
    q->count = q->laid = 0;
    rg_interior_clear(&q->q);
}

rg_row *rg_nearest_add(rg_nearest *q, int32_t terms, const int32_t *v, const double *weight, rg_vec3 n)
{
    if (RG_MEM_GROW(&q->mem, q->row, q->room, (size_t)q->count + 1) != RG_OK) return NULL;
    rg_row *row = &q->row[q->count++];
    memset(row, 0, sizeof *row);
    row->crease = row->facet = row->at = row->feature = row->next = -1;
    row->c = LEAST_COMPLIANCE;
    row->terms = terms;
    for (int32_t i = 0; i < terms; i++) row->v[i] = v[i], row->weight[i] = weight[i];
    row->n = n;
    return row;
}

rg_row *rg_nearest_add_bound(rg_nearest *q, int32_t i, double sign)
{
    rg_row *row = rg_nearest_add(q, 0, NULL, NULL, (rg_vec3){0, 0, 0});
    if (!row) return NULL;
    row->crease = i;
    row->weight[0] = sign > 0 ? -1 : 1;
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
    for (int32_t i = 0; i < row->terms; i++)
        sum += row->weight[i] * (row->facet >= 0 ? q->dz[q->P->N + row->v[i]] : rg_vec3_dot(row->n, q->dp[row->v[i]]));
    return sum;
}

void rg_nearest_project(rg_nearest *q, const double *wish, const double *r)
{
    for (int32_t i = 0; i < q->P->n; i++) q->y0[i] = wish ? wish[i] / q->scale[i] : 0;
    project(q, q->y0, r);
    move(q, q->y0);
}

/* The rows of the state: what creases turn by, what stays rigid. */
static rg_status lay(rg_nearest *q)
{
    if (q->laid) return RG_OK;
    for (int32_t i = 0; i < q->P->U; i++) q->q.g[3 * q->P->mesh->nv + i] = 1;
    const rg_status s = rg_places_rows(q->P, q->scale, &q->q.J, &q->q.E);
    q->laid = s == RG_OK;
    return s;
}

static rg_status make(rg_nearest *q, rg_row *row)
{
    int32_t col[3 * RG_ROW_TERMS + 12], n = 0;
    double x[3 * RG_ROW_TERMS + 12];
    rg_status s = lay(q);
    if (s != RG_OK) return s;
    if (row->crease >= 0) {
        const rg_rows *J = &q->q.J;
        for (int32_t j = J->start[row->crease]; j < J->start[row->crease + 1]; j++) {
            col[n] = J->col[j];
            x[n++] = row->weight[0] * q->scale[row->crease] * J->x[j];
        }
    }
    for (int32_t i = 0; row->facet >= 0 && i < row->terms; i++) {
        col[n] = 3 * q->P->mesh->nv + row->v[i];
        x[n++] = row->weight[i] * q->scale[q->P->N + row->v[i]];
    }
    for (int32_t i = 0; row->crease < 0 && row->facet < 0 && i < row->terms; i++) {
        if (row->weight[i] == 0) continue;
        const double a[] = {row->n.x, row->n.y, row->n.z};
        for (int k = 0; k < 3; k++) col[n] = 3 * row->v[i] + k, x[n++] = row->weight[i] * a[k];
    }
    s = rg_rows_add(&q->q.R, n, col, x);
    if (s == RG_OK) row->at = q->q.R.count - 1;
    return s;
}

static rg_status activate(rg_nearest *q, int32_t row, int soft)
{
    const size_t n = (size_t)q->actives + 1;
    rg_status s = q->row[row].at < 0 ? make(q, &q->row[row]) : RG_OK;
    if (s == RG_OK) s = RG_MEM_GROW(&q->mem, q->active, q->active_room, n);
    if (s != RG_OK) return s;
    q->active[q->actives++] = 2 * row + soft;
    q->row[row].active |= 1 << soft;
    return RG_OK;
}

/* Flags: the row, 1, and its soft form, 2, that q->dz breaks and that are not active. Where it pushed as hard as the
 * hardest it would give by as much as its compliance says: what is broken by less is not worth a row. */
static int broken(const rg_nearest *q, const rg_row *row, int with_soft)
{
    const double value = rg_nearest_value(q, row);
    int which = 0;
    for (int soft = 0; soft <= (with_soft && row->soft_c > 0); soft++) {
        const double b = soft ? row->soft_b : row->b;
        const double gives = (soft ? 0 : row->c) * q->q.largest;
        if (!(row->active >> soft & 1) && b - value > BROKEN + BROKEN_PART * fabs(b) + gives) which |= 1 << soft;
    }
    return which;
}

/* Takes a broken row into the list of its feature, or instead of one of it that is farther the same way. */
static void list(rg_nearest *q, int32_t i, int only_nearest)
{
    rg_row *row = &q->row[i];
    int32_t *at = &q->head[row->feature];
    row->next = -1;
    for (; *at >= 0; at = &q->row[*at].next) {
        rg_row *other = &q->row[*at];
        if (!only_nearest || rg_vec3_dot(row->n, other->n) < ONE_WAY) continue;
        if (!(row->d < other->d)) return;
        row->next = other->next;
        break;
    }
    *at = i;
}

/* Activates what q->dz breaks. *more: out, whether there was anything. */
static rg_status add_broken(rg_nearest *q, int with_soft, int only_nearest, int *more)
{
    rg_status s = RG_OK;
    *more = 0;
    for (int32_t i = 0; i < q->count; i++) {
        const int which = broken(q, &q->row[i], with_soft);
        q->row[i].active = (q->row[i].active & 3) | which << 2;
        *more |= which != 0;
        if (which && q->row[i].feature >= 0) list(q, i, only_nearest);
    }
    for (int32_t i = 0; i < q->count; i++) {
        const rg_row *row = &q->row[i];
        if (row->active < 4 || row->feature < 0) continue;
        int listed = 0;
        for (int32_t k = q->head[row->feature]; k >= 0 && !listed; k = q->row[k].next) listed = k == i;
        if (!listed) q->row[i].active &= 3;
    }
    for (int32_t i = 0; i < q->count && s == RG_OK; i++) {
        const int which = q->row[i].active >> 2;
        if (q->row[i].feature >= 0) q->head[q->row[i].feature] = -1;
        for (int soft = 0; soft < 2 && s == RG_OK; soft++)
            if (which >> soft & 1) s = activate(q, i, soft);
    }
    return s;
}

/* The quadratic program of the active rows: q->y, closed once more. */
static rg_status push(rg_nearest *q, const double *r)
{
    const int32_t m = q->actives, N = q->P->N;
    rg_status s = rg_interior_reserve(&q->q, m);
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < m; i++) {
        const rg_row *row = &q->row[q->active[i] / 2];
        const int soft = q->active[i] % 2;
        q->q.of[i] = row->at;
        q->q.c[i] = fmax(soft ? row->soft_c : row->c, LEAST_COMPLIANCE);
        q->q.d[i] = (soft ? row->soft_b : row->b) - row->base;
    }
    s = rg_interior_solve(&q->q, m);
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < N; i++) q->y[i] = q->y0[i] + rg_rows_dot(&q->q.J, i, q->q.v);
    for (int32_t i = 0; i < q->P->U; i++) q->y[N + i] = q->y0[N + i] + q->q.v[3 * q->P->mesh->nv + i];
    project(q, q->y, r);
    return RG_OK;
}

/* A row that is active from the start. */
static int is_expected(const rg_nearest *q, const rg_row *row, int with_soft)
{
    if (!with_soft) return row->closing;
    return row->pushed ? *row->pushed & row->pushed_by : q->all;
}

static void remember_pushing(rg_nearest *q, int with_soft)
{
    for (int32_t i = 0; i < q->count; i++) {
        if (!with_soft) q->row[i].closing = 0;
        else if (q->row[i].pushed) *q->row[i].pushed &= (unsigned char)~q->row[i].pushed_by;
    }
    for (int32_t i = 0; i < q->actives; i++) {
        rg_row *row = &q->row[q->active[i] / 2];
        if (!(q->q.x[i] > q->q.slack[i])) continue;
        if (!with_soft) row->closing = 1;
        else if (row->pushed) *row->pushed |= row->pushed_by;
    }
}

rg_status rg_nearest_solve(rg_nearest *q, const double *wish, const double *r, int with_soft)
{
    int more = 0;
    rg_nearest_project(q, wish, r);
    rg_status s = RG_OK;
    q->actives = 0;
    for (int32_t i = 0; i < q->count; i++) {
        q->row[i].active = 0;
        q->row[i].base = rg_nearest_value(q, &q->row[i]);
    }
    for (int32_t i = 0; i < q->count && s == RG_OK; i++)
        for (int soft = 0; soft <= (with_soft && q->row[i].soft_c > 0) && s == RG_OK; soft++)
            if (is_expected(q, &q->row[i], with_soft)) s = activate(q, i, soft);
    if (s == RG_OK && q->actives == 0) s = add_broken(q, with_soft, 1, &more);
    more |= q->actives > 0;
    for (int round = 0; s == RG_OK && more && round < ROUNDS; round++) {
        s = push(q, r);
        if (s != RG_OK) break;
        move(q, q->y);
        s = add_broken(q, with_soft, round + 1 < NEAREST_ROUNDS, &more);
    }
    if (s == RG_OK) remember_pushing(q, with_soft);
    return s;
}
