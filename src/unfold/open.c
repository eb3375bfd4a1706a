#include "unfold/open.h"
#include "unfold/stride.h"

#include <string.h>

/* What rows are wished open by where creases open by OPEN of their angle: layers, nested creases, edges beside each other. The
 * second matters: a corner 2e-5 inside a crease that opens to 30 degrees is outside the wedge. */
static const double OPEN = 0.03, LAYER = 2e-3, INSIDE = 5e-4, BESIDE = 3e-5;
static const double SOFT = 1e-5, SOFT_IN_PLANE = 0.03; /* compliance, and in the plane, as many times it */
static const double BOUND = 1e-12;                     /* compliance of half a turn */
static const int32_t ITERATIONS = 24, CLOSE = 20;
static const double LARGEST = 0.6; /* change of an unknown in an iteration, over part: rows are linear only so far */
static const double LARGEST_AT_ONCE = 0.1, REPAIR_LARGEST = 0.1;
static const double FIRST = 1e-3, GROWTH = 1.2; /* the end is opened by so much first, and then more and more */
static const int32_t SETTLE = 12, STEPS = 200, FAILURES = 20, CLOSE_SLOWLY = 8;
static const double FINE = 2e-5; /* lengths of the sheet: facets that cross less deep are as good as apart, while they lie on each other */
static const double OVER = 1e-4; /* radians past half a turn: closing may put a crease there, as in stride.c */
static const double STILL_AT_ONCE = 1e-4, CLOSED = 1e-12, CLOSED_ENOUGH = 1e-10;
/* Repair: pairs are looked at this near; less than that part of what is wanted counts as touching. */
static const double NEAR = 6e-3, TOUCHING = 0.5;
static const double NOT_THERE = 1e-4; /* what is farther on its wrong side, and does not cross, has gone round */
static const double SIDE_HARD = 1e-8; /* compliance of what near parts ask while it opens */
static const double REPAIR_HARD = 1e-7, REPAIR_KEEP = 1e-9, REPAIR_SOFT = 1e-4; /* compliances: apart, not nearer, softly */
static const double REPAIR_INSIDE = 2e-4, REPAIR_BESIDE = 2e-5, REPAIR_SCALE = 5e-5; /* of rows in the plane where want is the last */
static const double NEAR_HALF_TURN = 0.3;

static unsigned char *flag_of(const rg_linkage *P, rg_proximity *near, int edges, int32_t i, int32_t j)
{
    return edges ? near->edge + (size_t)i * (size_t)P->mesh->ne + (size_t)j : near->corner + (size_t)i * (size_t)P->mesh->nf + (size_t)j;
}

static rg_status add_end_rows(const rg_linkage *P, const rg_end *e, rg_proximity *near, rg_nearest *q, const rg_open_way *way,
                              double part)
{
    const double scale = way->scaled || way->grow ? part / OPEN : 1;
    for (int32_t k = 0; k < e->count; k++) {
        const rg_end_row *from = &e->row[k];
        const int is_live = !way->grow || rg_end_is_live(e, from, P);
        if (from->i >= 0) {
            unsigned char *flag = flag_of(P, near, from->edges, from->i, from->j);
            *flag = (unsigned char)(is_live ? *flag | RG_PROXIMITY_LAYER : *flag & ~RG_PROXIMITY_LAYER);
        }
        if (!is_live) continue;
        const double gap = rg_end_gap(from, P->place, P->p);
        const int layer = from->kind == RG_END_LAYER;
        const double want = layer ? LAYER * scale : (from->kind == RG_END_INSIDE ? INSIDE : BESIDE) * scale * scale;
        rg_row *row = rg_nearest_add(q);
        if (!row) return RG_ENOMEM;
        row->terms = from->terms;
        memcpy(row->v, from->v, sizeof row->v);
        memcpy(row->weight, from->weight, sizeof row->weight);
        row->n = rg_end_normal(from, P->place);
        row->b = -gap;
        row->c = way->hard;
        row->soft_b = want - gap;
        row->soft_c = layer ? SOFT : SOFT_IN_PLANE * SOFT;
    }
    return RG_OK;
}

/* Creases that end folded stay within half a turn less the margin. */
static rg_status add_bounds(const rg_linkage *P, const double *z, const double *end, double from, double margin, rg_nearest *q)
{
    for (int32_t i = 0; i < P->N; i++) {
        if (fabs(z[i]) < from || (end && end[i] == 0)) continue;
        rg_row *row = rg_nearest_add(q);
        if (!row) return RG_ENOMEM;
        row->crease = i;
        row->weight[0] = (end ? end[i] : z[i]) > 0 ? -1 : 1;
        row->b = -(RG_PI - margin - fabs(z[i]));
        row->c = BOUND;
    }
    return RG_OK;
}

/* Goes along q->dz, no farther than rows are linear. Returns how far it wished to. */
static double go(const rg_linkage *P, const rg_nearest *q, double *z, double largest)
{
    double most = 0;
    for (int32_t i = 0; i < P->n; i++) most = fmax(most, fabs(q->dz[i]) / (i < P->N ? 1 : P->freedom.reach[i - P->N]));
    const double f = fmin(1, largest / fmax(most, 1e-12));
    for (int32_t i = 0; i < P->n; i++) z[i] += f * q->dz[i];
    return most;
}

static double stand(rg_linkage *P, rg_nearest *q, const double *z)
{
    const double angle = rg_coupled_assemble(&P->J, z, z + P->N, NULL);
    rg_coupled_renew(&P->J, q->scale);
    q->work += P->J.A.L.S.flops;
    rg_linkage_put(P, z);
    rg_nearest_clear(q);
    return angle;
}

static double least_gap(const rg_linkage *P, const rg_end *e, int in_plane)
{
    double least = INFINITY;
    for (int32_t k = 0; k < e->count; k++)
        if (!in_plane || e->row[k].kind != RG_END_LAYER) least = fmin(least, rg_end_gap(&e->row[k], P->place, P->p));
    return least;
}

/* Near parts, by their sides: what is right now may not become wrong. */
static rg_status add_side_rows(const rg_linkage *P, const rg_end *e, rg_proximity *near, rg_nearest *q)
{
    rg_status s = rg_proximity_find(near, P->p, NEAR, 0);
    for (int32_t k = 0; s == RG_OK && k < near->count; k++) {
        rg_close_pair *at = &near->pair[k];
        rg_vec3 n;
        double d;
        if (!rg_sides_tell(&e->sides, P, at, &n, &d) || d < -NOT_THERE) continue;
        rg_row *row = rg_nearest_add(q);
        if (!row) return RG_ENOMEM;
        row->terms = 4;
        for (int i = 0; i < 4; i++) row->v[i] = at->v[i], row->weight[i] = at->weight[i];
        row->n = n;
        row->b = d > 0 ? -0.7 * d : -d;
        row->c = SIDE_HARD;
        const size_t wide = (size_t)(at->kind ? P->mesh->ne : P->mesh->nf), pair = (size_t)at->i * wide + (size_t)at->j;
        const int behind = (at->kind ? e->sides.edge_behind : e->sides.corner_behind)[pair];
        row->pushed = flag_of(P, near, at->kind, at->i, at->j);
        row->pushed_by = behind || *row->pushed & RG_PROXIMITY_LAYER ? 0 : RG_PROXIMITY_PUSHED; /* another row says it */
    }
    return s;
}

/* One iteration towards part; *step: out, how far it wished to go. */
static rg_status iterate(rg_linkage *P, const rg_end *e, const rg_open_way *way, double part, rg_crossed *crossed, rg_proximity *near,
                         rg_nearest *q, double *z, double *step)
{
    for (int32_t i = 0; i < P->n; i++) q->wish[i] = (i < P->N ? 1 - part : 1) * e->z[i] - z[i];
    rg_status s = add_end_rows(P, e, near, q, way, part);
    if (s == RG_OK && way->grow && part > FIRST) s = add_side_rows(P, e, near, q);
    if (s == RG_OK && way->grow && part > FIRST) s = rg_crossed_add(crossed, P, near, q);
    if (s == RG_OK) s = add_bounds(P, z, e->z, 0, way->margin * (way->grow ? part * part / (OPEN * OPEN) : 1), q);
    if (s == RG_OK) s = rg_nearest_solve(q, q->wish, P->J.r, 1);
    if (s == RG_OK) *step = go(P, q, z, way->grow ? LARGEST * part : LARGEST_AT_ONCE);
    return s;
}

static rg_status worst_side(const rg_linkage *P, const rg_end *e, rg_proximity *near, double *worst)
{
    const rg_status s = rg_proximity_find(near, P->p, NEAR, 0);
    *worst = 1;
    for (int32_t k = 0; s == RG_OK && k < near->count; k++) {
        rg_close_pair *at = &near->pair[k];
        rg_vec3 n;
        double d;
        if (rg_sides_tell(&e->sides, P, at, &n, &d) && d >= -NOT_THERE) *worst = fmin(*worst, d);
    }
    return s;
}

static double over_half_turn(const rg_linkage *P, const double *z)
{
    double most = 0;
    for (int32_t i = 0; i < P->N; i++) most = fmax(most, fabs(z[i]) - RG_PI);
    return most;
}

/* The end is opened by very little first, then more and more, as long as rows hold: a path, each state of which is closed. */
static rg_status open_slowly(rg_linkage *P, const rg_end *e, const rg_open_way *way, double most, rg_crossed *crossed,
                             rg_proximity *near, rg_nearest *q, double *z, rg_open_keep keep, void *ctx)
{
    double *good = rg_mem_array(&q->mem, (size_t)P->n, sizeof *good), part = FIRST, step;
    if (!good) return RG_ENOMEM;
    rg_status s = RG_OK;
    memcpy(good, z, (size_t)P->n * sizeof *z);
    for (int failed = 0, n = 0; s == RG_OK && failed < FAILURES && n < STEPS && q->work + q->q.work < most; n++) {
        rg_contact_hit hit;
        stand(P, q, z);
        s = iterate(P, e, way, part, crossed, near, q, z, &step);
        if (s != RG_OK) break;
        rg_stride_hold(P, z, q->scale);
        const int closed = rg_stride_close(P, q, z, CLOSED, CLOSE_SLOWLY);
        rg_stride_scale(P, way->give, q->scale);
        rg_linkage_put(P, z);
        if (!closed || over_half_turn(P, z) > OVER || rg_contact_deepest(crossed->plates, P->p, FINE, crossed->look, &hit)) {
            failed++; /* what has begun to cross is parted by the next one */
            continue;
        }
        failed = 0;
        memcpy(good, z, (size_t)P->n * sizeof *z);
        if (n >= SETTLE) s = keep(ctx, z);
        if (part == way->part) break;
        if (n >= SETTLE) part = fmin(way->part, GROWTH * part);
    }
    memcpy(z, good, (size_t)P->n * sizeof *z);
    rg_mem_free(&q->mem, good);
    return s;
}

rg_status rg_open(rg_linkage *P, const rg_end *e, const rg_open_way *way, double budget, rg_crossed *crossed, rg_proximity *near,
                  rg_nearest *q, double *z, rg_open_keep keep, void *ctx, rg_open_result *result)
{
    const double most = q->work + q->q.work + budget;
    rg_stride_scale(P, way->give, q->scale);
    memcpy(z, e->z, (size_t)P->n * sizeof *z);
    rg_status s = RG_OK;
    q->all = 1;
    if (way->grow) s = open_slowly(P, e, way, most, crossed, near, q, z, keep, ctx);
    for (int32_t n = 0; n < ITERATIONS && s == RG_OK && !way->grow && q->work + q->q.work < most; n++) {
        double step;
        const double angle = stand(P, q, z);
        s = iterate(P, e, way, way->part, crossed, near, q, z, &step);
        if (s == RG_OK && step < STILL_AT_ONCE && angle < CLOSED_ENOUGH) break;
    }
    q->all = 0;
    if (s != RG_OK) return s;
    rg_stride_close(P, q, z, CLOSED, CLOSE);
    result->angle = stand(P, q, z);
    s = worst_side(P, e, near, &result->worst);
    if (s != RG_OK) return s;
    result->least = least_gap(P, e, 0);
    return way->repair > 0 && result->angle < 1e-6
               ? rg_open_repair(P, e, REPAIR_SCALE, 1e-3, way->margin / 10, way->repair, most - q->work - q->q.work, near, q, z,
                                result) : RG_OK;
}

static rg_status add_near_rows(const rg_linkage *P, const rg_end *e, double want, double soft, rg_proximity *near,
                               rg_nearest *q, double *worst)
{
    *worst = 1;
    for (int32_t k = 0; k < near->count; k++) {
        rg_close_pair *at = &near->pair[k];
        rg_vec3 n = {0, 0, 0};
        double d = at->d;
        for (int i = 0; i < 4; i++) n = rg_vec3_axpy(at->weight[i] / fmax(at->d, 1e-300), P->p[at->v[i]], n);
        rg_sides_tell(&e->sides, P, at, &n, &d);
        *worst = fmin(*worst, d);
        for (int hard = 0; hard < 2; hard++) {
            if (hard && !(d < 2 * want)) continue;
            rg_row *row = rg_nearest_add(q);
            if (!row) return RG_ENOMEM;
            row->terms = 4;
            for (int i = 0; i < 4; i++) row->v[i] = at->v[i], row->weight[i] = at->weight[i];
            row->n = n;
            row->b = hard ? want - d : -0.7 * fmax(d, 0) - 1e-12;
            row->c = hard ? REPAIR_HARD : REPAIR_KEEP;
            if (!hard && d < soft) row->soft_b = soft / 2 - d, row->soft_c = REPAIR_SOFT;
        }
    }
    return RG_OK;
}

static rg_status add_plane_rows(const rg_linkage *P, const rg_end *e, double want, rg_nearest *q)
{
    for (int32_t k = 0; k < e->count; k++) {
        const rg_end_row *from = &e->row[k];
        if (from->kind == RG_END_LAYER) continue;
        rg_row *row = rg_nearest_add(q);
        if (!row) return RG_ENOMEM;
        row->terms = from->terms;
        memcpy(row->v, from->v, sizeof row->v);
        memcpy(row->weight, from->weight, sizeof row->weight);
        row->n = rg_end_normal(from, P->place);
        row->b = (from->kind == RG_END_INSIDE ? REPAIR_INSIDE : REPAIR_BESIDE) * want / REPAIR_SCALE - rg_end_gap(from, P->place, P->p);
        row->c = REPAIR_KEEP;
    }
    return RG_OK;
}

rg_status rg_open_repair(rg_linkage *P, const rg_end *e, double want, double soft, double margin, int32_t most, double budget, rg_proximity *near,
                         rg_nearest *q, double *z, rg_open_result *result)
{
    const double spent = q->work + q->q.work;
    rg_status s = RG_OK;
    for (int32_t n = 0; n < most && s == RG_OK && q->work + q->q.work - spent < budget; n++) {
        const double angle = stand(P, q, z);
        s = rg_proximity_find(near, P->p, NEAR, 0);
        if (s == RG_OK) s = add_near_rows(P, e, want, soft, near, q, &result->worst);
        if (s == RG_OK && result->worst > TOUCHING * want && !(least_gap(P, e, 1) <= -1e-6) && angle < 1e-9) break;
        if (s == RG_OK) s = add_plane_rows(P, e, want, q);
        if (s == RG_OK) s = add_bounds(P, z, NULL, RG_PI - NEAR_HALF_TURN, margin, q);
        if (s == RG_OK) s = rg_nearest_solve(q, NULL, P->J.r, 1);
        if (s != RG_OK) break;
        go(P, q, z, REPAIR_LARGEST);
        rg_stride_close(P, q, z, 1e-11, 3);
    }
    if (s != RG_OK) return s;
    rg_stride_close(P, q, z, CLOSED, CLOSE);
    result->angle = stand(P, q, z);
    s = rg_proximity_find(near, P->p, NEAR, 0);
    if (s == RG_OK) s = add_near_rows(P, e, want, soft, near, q, &result->worst);
    result->least = least_gap(P, e, 0);
    return s;
}
