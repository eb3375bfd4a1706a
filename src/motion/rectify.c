#include "motion/rectify.h"
#include "kinematics/freedom.h"
#include "linalg/least.h"

#include <string.h>

/* Newton's method on sums that are off by 1e-5 comes to rounding in three or four steps. */
static const int STEPS = 12;

/* One sum: sectors first ... first + count - 1 of interior vertex k, round and round; signs change at creases folded
 * before `stage`. */
typedef struct sum { int32_t k, first, count, stage; } sum;

typedef struct rectify {
    const rg_mesh *m;
    const rg_simple *q;
    rg_freedom freedom;
    sum *row;
    int32_t rows;
    size_t room;
    rg_least A;
    int32_t *at;     /* [entries] of A, in the order in which `derive` comes to them */
    double *r;       /* [rows] */
} rectify;

static int32_t crease_at(const rg_mesh *m, int32_t k, int32_t i)
{
    const int32_t n = m->loop_start[k + 1] - m->loop_start[k];
    return m->loop_crease[m->loop_start[k] + i % n];
}

/* The facet of the sector between crease i of interior vertex k and the next: on the left of the one, seen from the
 * vertex. */
static int32_t facet_at(const rg_mesh *m, int32_t k, int32_t i)
{
    const int32_t e = m->crease_edge[crease_at(m, k, i)];
    return m->edge_facet[e][m->edge[e][0] != m->inner_vertex[k]];
}

static int is_folded(const rectify *t, int32_t k, int32_t i, int32_t stage)
{
    const int32_t s = t->q->stage[t->m->crease_edge[crease_at(t->m, k, i)]];
    return s >= 0 && s < stage;
}

static rg_status add(rectify *t, int32_t k, int32_t first, int32_t count, int32_t stage)
{
    const rg_status s = RG_MEM_GROW(&t->m->mem, t->row, t->room, (size_t)t->rows + 1);
    if (s == RG_OK) t->row[t->rows++] = (sum){k, first, count, stage};
    return s;
}

/* What fold c asks of vertex k: each run of sectors that it turns. */
static rg_status add_runs(rectify *t, int32_t k, const rg_simple_fold *c)
{
    const int32_t n = t->m->loop_start[k + 1] - t->m->loop_start[k];
    rg_status s = RG_OK;
    for (int32_t i = 0; s == RG_OK && i < n; i++) {
        int32_t count = 0;
        const int begins = !c->moves[facet_at(t->m, k, i + n - 1)] && c->moves[facet_at(t->m, k, i)];
        if (!begins) continue;
        while (c->moves[facet_at(t->m, k, i + count)]) count++;
        s = add(t, k, i, count, c->stage);
    }
    return s;
}

static rg_status list_rows(rectify *t)
{
    rg_status s = RG_OK;
    for (int32_t k = 0; s == RG_OK && k < t->m->M; k++) {
        int32_t folded = 0;
        const int32_t n = t->m->loop_start[k + 1] - t->m->loop_start[k];
        for (int32_t i = 0; i < n; i++) folded += is_folded(t, k, i, 1);
        if (folded) s = add(t, k, 0, n, 1);
        for (int32_t f = 0; s == RG_OK && f < t->q->folds; f++) s = add_runs(t, k, &t->q->fold[f]);
    }
    return s;
}

/* ---------------------------------------------------------------------------------------------- the numbers ---- */

/* Receives the derivative of row i by what vertex v moves by. */
typedef void take(void *ctx, int32_t i, int32_t v, rg_vec2 d);

static rg_vec2 spoke(const rectify *t, const rg_vec2 *X, int32_t k, int32_t i, int32_t *far)
{
    const int32_t *v = t->m->edge[t->m->crease_edge[crease_at(t->m, k, i)]], at = t->m->inner_vertex[k];
    *far = v[v[0] == at];
    return rg_vec2_sub(X[*far], X[at]);
}

/* d angle / d end of the spoke, turned a quarter over its length squared. */
static void give(take *f, void *ctx, int32_t row, int32_t far, int32_t at, rg_vec2 d, double weight)
{
    const double n = rg_vec2_dot(d, d);
    const rg_vec2 g = {-weight * d.y / n, weight * d.x / n};
    f(ctx, row, far, g);
    f(ctx, row, at, (rg_vec2){-g.x, -g.y});
}

/* The sums on the pattern X; returns the largest. f NULL: no derivatives. */
static double derive(rectify *t, const rg_vec2 *X, take *f, void *ctx)
{
    double most = 0;
    for (int32_t j = 0; j < t->rows; j++) {
        const sum *s = &t->row[j];
        double sign = 1, all = 0;
        for (int32_t i = s->first; i < s->first + s->count; i++) {
            int32_t a, b;
            const rg_vec2 d = spoke(t, X, s->k, i, &a), e = spoke(t, X, s->k, i + 1, &b);
            double angle = atan2(rg_vec2_cross(d, e), rg_vec2_dot(d, e));
            if (angle < 0) angle += 2 * RG_PI;
            all += sign * angle;
            if (f) {
                give(f, ctx, j, b, t->m->inner_vertex[s->k], e, sign);
                give(f, ctx, j, a, t->m->inner_vertex[s->k], d, -sign);
            }
            if (is_folded(t, s->k, i + 1, s->stage)) sign = -sign;
        }
        t->r[j] = remainder(all, RG_PI);
        most = fabs(t->r[j]) <= most ? most : fabs(t->r[j]);
    }
    return most;
}

/* ------------------------------------------------------------------------------------------------ the matrix ---- */

/* Derivatives: counted by column, then put into their columns, then added up in their places. */
typedef struct entries {
    const rg_freedom *freedom;
    int32_t *start, *row; /* [U + 2], [n]: columns, as they are filled */
    int32_t *at, n;       /* [n] where each goes, in the order in which they come */
    double *x;
} entries;

static void count(void *ctx, int32_t i, int32_t v, rg_vec2 d)
{
    entries *e = ctx;
    (void)i, (void)d;
    for (int k = 0; k < 2; k++)
        if (e->freedom->way[v][k] >= 0) e->start[e->freedom->way[v][k] + 2]++;
}

static void place(void *ctx, int32_t i, int32_t v, rg_vec2 d)
{
    entries *e = ctx;
    (void)d;
    for (int k = 0; k < 2; k++) {
        if (e->freedom->way[v][k] < 0) continue;
        const int32_t j = e->start[e->freedom->way[v][k] + 1]++;
        e->row[j] = i;
        e->at[e->n++] = j;
    }
}

static void put(void *ctx, int32_t i, int32_t v, rg_vec2 d)
{
    entries *e = ctx;
    (void)i;
    for (int k = 0; k < 2; k++) {
        const int32_t w = e->freedom->way[v][k];
        if (w >= 0) e->x[e->at[e->n++]] += rg_vec2_dot(d, e->freedom->direction[w]);
    }
}

/* A row comes to a column several times, one after the other: that is one entry. to[]: out, which. */
static void join(entries *e, int32_t columns, int32_t *to)
{
    int32_t out = 0, begin = 0;
    for (int32_t c = 0; c < columns; c++) {
        const int32_t end = e->start[c + 1], first = out;
        for (int32_t j = begin; j < end; j++) {
            if (out == first || e->row[out - 1] != e->row[j]) e->row[out++] = e->row[j];
            to[j] = out - 1;
        }
        begin = end;
        e->start[c + 1] = out;
    }
    for (int32_t j = 0; j < e->n; j++) e->at[j] = to[e->at[j]];
}

static rg_status plan(rectify *t)
{
    const rg_memory *mem = &t->m->mem;
    const int32_t U = t->freedom.U;
    entries e = {.freedom = &t->freedom, .start = rg_mem_array(mem, (size_t)U + 2, sizeof *e.start)};
    if (!e.start) return RG_ENOMEM;
    derive(t, t->m->X, count, &e);
    for (int32_t c = 2; c < U + 2; c++) e.start[c] += e.start[c - 1];
    const size_t all = (size_t)e.start[U + 1];
    int32_t *to;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(to, all), RG_ARRAY(e.row, all), RG_ARRAY(e.at, all));
    if (s == RG_OK) {
        derive(t, t->m->X, place, &e);
        join(&e, U, to);
        s = rg_least_init(&t->A, mem, t->rows, U, e.start, e.row);
        t->at = e.at, e.at = NULL;
    }
    RG_MEM_FREE(mem, to, e.start, e.row, e.at);
    return s;
}

/* The matrix at X, its rows of length 1. norm[rows]: scratch. */
static void fill(rectify *t, const rg_vec2 *X, double *norm)
{
    entries e = {.freedom = &t->freedom, .at = t->at, .x = t->A.x};
    const int32_t all = t->A.start[t->freedom.U];
    memset(t->A.x, 0, (size_t)all * sizeof *t->A.x);
    memset(norm, 0, (size_t)t->rows * sizeof *norm);
    derive(t, X, put, &e);
    for (int32_t j = 0; j < all; j++) norm[t->A.row[j]] = hypot(norm[t->A.row[j]], t->A.x[j]);
    for (int32_t j = 0; j < all; j++)
        if (norm[t->A.row[j]] > 0) t->A.x[j] /= norm[t->A.row[j]];
    for (int32_t i = 0; i < t->rows; i++)
        if (norm[i] > 0) t->r[i] /= norm[i];
    rg_least_renew(&t->A);
}

static rg_status solve(rectify *t, rg_vec2 *X, double *off)
{
    const rg_memory *mem = &t->m->mem;
    const size_t U = (size_t)t->freedom.U;
    double *u, *du, *norm;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(u, U), RG_ARRAY(du, U), RG_ARRAY(norm, (size_t)t->rows));
    if (s == RG_OK) s = plan(t);
    for (int n = 0; s == RG_OK && n < STEPS; n++) {
        fill(t, X, norm);
        rg_least_solve(&t->A, t->r, du);
        for (size_t i = 0; i < U; i++) u[i] -= du[i];
        rg_freedom_move(&t->freedom, u, X);
        const double now = derive(t, X, NULL, NULL);
        const int better = now < *off / 2;
        *off = now;
        if (!better) break; /* rounding, or no such pattern */
    }
    rg_least_free(&t->A);
    RG_MEM_FREE(mem, t->at, u, du, norm);
    return s;
}

rg_status rg_rectify(const rg_mesh *m, const rg_simple *stages, rg_vec2 *X, double *moved, double *off)
{
    rectify t = {.m = m, .q = stages};
    *moved = *off = 0;
    memcpy(X, m->X, (size_t)m->nv * sizeof *X);
    rg_status s = rg_freedom_init(&t.freedom, &m->mem, m, 1);
    if (s == RG_OK) s = list_rows(&t);
    if (s == RG_OK && !(t.r = rg_mem_array(&m->mem, (size_t)t.rows, sizeof *t.r))) s = RG_ENOMEM;
    if (s == RG_OK) *off = derive(&t, X, NULL, NULL);
    if (s == RG_OK && !(*off <= RG_RECTIFIED) && t.freedom.U > 0) s = solve(&t, X, off);
    for (int32_t v = 0; v < m->nv; v++) *moved = fmax(*moved, rg_vec2_length(rg_vec2_sub(X[v], m->X[v])));
    rg_freedom_free(&t.freedom);
    RG_MEM_FREE(&m->mem, t.row, t.r);
    return s;
}
