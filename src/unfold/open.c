#include "unfold/open.h"
#include "unfold/stride.h"

#include <string.h>

/* What rows are wished open by where creases open by OPEN of their angle: layers, nested creases, edges beside each
 * other. The second matters: a corner 2e-5 inside a crease that opens to 30 degrees is outside the wedge. */
static const double OPEN = 0.03, LAYER = 2e-3, INSIDE = 5e-4, BESIDE = 3e-5;
static const double SOFT = 1e-5, SOFT_IN_PLANE = 0.03; /* compliance, and in the plane, as many times it */
static const double BOUND = 1e-12;                     /* compliance of half a turn */
static const double GIVE = 0.2;                        /* of the pattern, as in rg_stride_scale */
static const int32_t ITERATIONS = 24, CLOSE = 20;
static const double LARGEST = 0.6; /* change of an unknown in an iteration, over part: rows are linear only so far */
static const double LARGEST_AT_ONCE = 0.1, REPAIR_LARGEST = 0.1;
static const double FIRST = 1e-3, GROWTH = 1.2; /* the end is opened by so much first, and then more and more */
static const int32_t SETTLE = 12, STEPS = 200, FAILURES = 20, CLOSE_SLOWLY = 8;
/* Lengths of the sheet: facets that cross less deep are as good as apart, while they lie on each other. */
static const double FINE = 2e-5;
static const double STILL_AT_ONCE = 1e-4, CLOSED = 1e-12, CLOSED_ENOUGH = 1e-10;
static const double NEAR = 6e-3;      /* pairs are looked at this near */
static const double MAY_CLOSE = 0.7;  /* the part of its distance that a pair may come nearer by */
static const double SIDE_HARD = 1e-8; /* compliance of what near parts ask while it opens */
/* Repair: near parts are to be apart by so much, hard, or softly; in the plane by so much; less than this part
 * of it counts as touching. Compliances: apart, not nearer, softly. */
static const double REPAIR_APART = 5e-5, REPAIR_APART_SOFTLY = 1e-3;
/* 2e-4 but for its last bit, on which long motions hang: as it was when they were looked at. */
static const double REPAIR_INSIDE = 0.00019999999999999998, REPAIR_BESIDE = 2e-5;
static const double TOUCHING = 0.5;
static const double REPAIR_HARD = 1e-7, REPAIR_KEEP = 1e-9, REPAIR_SOFT = 1e-4;
static const double REPAIR_MARGIN = 0.1; /* of the way's */
static const double NEAR_HALF_TURN = 0.3;

static rg_row *add_end_row(const rg_opening *o, const rg_end_row *from)
{
    return rg_nearest_add(o->q, from->terms, from->v, from->weight, rg_end_normal(from, o->P->place));
}

static rg_status add_end_rows(const rg_opening *o, double part)
{
    const rg_linkage *P = o->P;
    const double scale = o->way->grow ? part / OPEN : 1;
    for (int32_t k = 0; k < o->end->count; k++) {
        const rg_end_row *from = &o->end->row[k];
        const int is_live = !o->way->grow || rg_end_is_live(from, P);
        if (from->i >= 0) {
            unsigned char *flag = rg_proximity_flags(o->near, from->edges, from->i, from->j);
            *flag = (unsigned char)(is_live ? *flag | RG_PROXIMITY_LAYER : *flag & ~RG_PROXIMITY_LAYER);
        }
        if (!is_live) continue;
        const double gap = rg_end_gap(from, P->place, P->p);
        const int layer = from->kind == RG_END_LAYER;
        const double want = layer ? LAYER * scale : (from->kind == RG_END_INSIDE ? INSIDE : BESIDE) * scale * scale;
        rg_row *row = add_end_row(o, from);
        if (!row) return RG_ENOMEM;
        row->b = -gap;
        row->c = o->way->hard;
        row->soft_b = want - gap;
        row->soft_c = layer ? SOFT : SOFT_IN_PLANE * SOFT;
    }
    return RG_OK;
}

/* Creases folded by `from` stay within half a turn less the margin on the side of towards[N]; 0: as they like. */
static rg_status add_bounds(const rg_opening *o, const double *towards, double from, double margin)
{
    for (int32_t i = 0; i < o->P->N; i++) {
        if (fabs(o->z[i]) < from || towards[i] == 0) continue;
        rg_row *row = rg_nearest_add_bound(o->q, i, towards[i]);
        if (!row) return RG_ENOMEM;
        row->b = -(RG_PI - margin - fabs(o->z[i]));
        row->c = BOUND;
    }
    return RG_OK;
}

/* Goes along q->dz, no farther than rows are linear. Returns how far it wished to. */
static double go(const rg_opening *o, double largest)
{
    const rg_linkage *P = o->P;
    const double *dz = o->q->dz;
    double most = 0;
    for (int32_t i = 0; i < P->n; i++) most = fmax(most, fabs(dz[i]) / (i < P->N ? 1 : P->freedom.reach[i - P->N]));
    const double f = fmin(1, largest / fmax(most, 1e-12));
    for (int32_t i = 0; i < P->n; i++) o->z[i] += f * dz[i];
    return most;
}

/* At z, with no rows. Returns what closure is off. */
static double stand(const rg_opening *o)
{
    const double angle = rg_nearest_stand(o->q, o->z);
    rg_nearest_clear(o->q);
    return angle;
}

/* On which side a near pair is and how far, as rg_sides_tell, if it is not past what it would meet. */
static int tell(const rg_opening *o, rg_close_pair *at, rg_vec3 *n, double *d)
{
    return rg_sides_tell(&o->end->sides, o->P, at, n, d) && *d >= -RG_STRIDE_NOT_THERE;
}

/* Near parts, by their sides: what is right now may not become wrong. */
static rg_status add_side_rows(const rg_opening *o)
{
    rg_proximity *near = o->near;
    const rg_status s = rg_proximity_find(near, o->P->p, NEAR, 0);
    for (int32_t k = 0; s == RG_OK && k < near->count; k++) {
        rg_close_pair *at = &near->pair[k];
        rg_vec3 n;
        double d;
        if (!tell(o, at, &n, &d)) continue;
        rg_row *row = rg_nearest_add(o->q, 4, at->v, at->weight, n);
        if (!row) return RG_ENOMEM;
        row->b = d > 0 ? -MAY_CLOSE * d : -d;
        row->c = SIDE_HARD;
        row->pushed = rg_proximity_flags(near, at->kind, at->i, at->j);
        const int is_said = rg_sides_is_behind(&o->end->sides, at) || *row->pushed & RG_PROXIMITY_LAYER;
        row->pushed_by = is_said ? 0 : RG_PROXIMITY_PUSHED; /* by another row */
    }
    return s;
}

/* One iteration towards part; *step: out, how far it wished to go. */
static rg_status iterate(const rg_opening *o, double part, double *step)
{
    const rg_linkage *P = o->P;
    const int grow = o->way->grow, more = grow && part > FIRST;
    double *wish = o->q->wish;
    for (int32_t i = 0; i < P->n; i++) wish[i] = (i < P->N ? 1 - part : 1) * o->end->z[i] - o->z[i];
    rg_status s = add_end_rows(o, part);
    if (s == RG_OK && more) s = add_side_rows(o);
    if (s == RG_OK && more) s = rg_crossed_add(o->crossed, P, o->near, o->q);
    if (s == RG_OK) s = add_bounds(o, o->end->z, 0, o->way->margin * (grow ? part * part / (OPEN * OPEN) : 1));
    if (s == RG_OK) s = rg_nearest_solve(o->q, wish, P->K.r, 1);
    if (s == RG_OK) *step = go(o, grow ? LARGEST * part : LARGEST_AT_ONCE);
    return s;
}

static rg_status worst_side(rg_opening *o)
{
    const rg_status s = rg_proximity_find(o->near, o->P->p, NEAR, 0);
    o->worst = 1;
    for (int32_t k = 0; s == RG_OK && k < o->near->count; k++) {
        rg_vec3 n;
        double d;
        if (tell(o, &o->near->pair[k], &n, &d)) o->worst = fmin(o->worst, d);
    }
    return s;
}

/* Closes z. Zero: it does not, or a crease goes past half a turn, or facets cross there. */
static int close_grown(const rg_opening *o)
{
    rg_contact_hit hit;
    rg_stride_hold(o->P, o->z, o->q->scale);
    const int closed = rg_stride_close(o->P, o->q, o->z, CLOSED, CLOSE_SLOWLY);
    rg_stride_scale(o->P, GIVE, o->q->scale);
    rg_linkage_put(o->P, o->z);
    return closed && !(rg_linkage_past_half_turn(o->P, o->z) > RG_STRIDE_OVER) &&
           !rg_contact_deepest(o->crossed->plates, o->P->p, FINE, o->crossed->look, &hit);
}

/* The end is opened by very little first, then more and more, as long as rows hold: a path, each state of which is
 * closed. */
static rg_status open_slowly(rg_opening *o)
{
    const size_t bytes = (size_t)o->P->n * sizeof *o->z;
    double *good = rg_mem_array(&o->q->mem, (size_t)o->P->n, sizeof *good), part = FIRST, step;
    if (!good) return RG_ENOMEM;
    rg_status s = RG_OK;
    memcpy(good, o->z, bytes);
    for (int failed = 0, n = 0; s == RG_OK && failed < FAILURES && n < STEPS && rg_nearest_work(o->q) < o->until; n++) {
        stand(o);
        s = iterate(o, part, &step);
        if (s != RG_OK) break;
        if (!close_grown(o)) {
            failed++; /* what has begun to cross is parted by the next one */
            continue;
        }
        failed = 0;
        memcpy(good, o->z, bytes);
        if (n >= SETTLE) s = o->keep(o->ctx, o->z);
        if (part == o->way->part) break;
        if (n >= SETTLE) part = fmin(o->way->part, GROWTH * part);
    }
    memcpy(o->z, good, bytes);
    rg_mem_free(&o->q->mem, good);
    return s;
}

static rg_status open_at_once(rg_opening *o)
{
    rg_status s = RG_OK;
    for (int32_t n = 0; n < ITERATIONS && s == RG_OK && rg_nearest_work(o->q) < o->until; n++) {
        double step;
        const double angle = stand(o);
        s = iterate(o, o->way->part, &step);
        if (s == RG_OK && step < STILL_AT_ONCE && angle < CLOSED_ENOUGH) break;
    }
    return s;
}

/* Of all near pairs: not nearer, softly apart, and apart by their sides where they are very near. o->worst: out. */
static rg_status add_near_rows(rg_opening *o)
{
    o->worst = 1;
    for (int32_t k = 0; k < o->near->count; k++) {
        rg_close_pair *at = &o->near->pair[k];
        rg_vec3 n = rg_proximity_direction(at, o->P->p);
        double d = at->d;
        rg_sides_tell(&o->end->sides, o->P, at, &n, &d);
        o->worst = fmin(o->worst, d);
        rg_row *row = rg_nearest_add(o->q, 4, at->v, at->weight, n);
        if (!row) return RG_ENOMEM;
        row->b = -MAY_CLOSE * fmax(d, 0) - 1e-12;
        row->c = REPAIR_KEEP;
        if (d < REPAIR_APART_SOFTLY) row->soft_b = REPAIR_APART_SOFTLY / 2 - d, row->soft_c = REPAIR_SOFT;
        if (!(d < 2 * REPAIR_APART)) continue;
        row = rg_nearest_add(o->q, 4, at->v, at->weight, n);
        if (!row) return RG_ENOMEM;
        row->b = REPAIR_APART - d;
        row->c = REPAIR_HARD;
    }
    return RG_OK;
}

static int is_in_plane(const rg_end_row *row) { return row->kind != RG_END_LAYER; }

static double least_gap_in_plane(const rg_opening *o)
{
    double least = INFINITY;
    for (int32_t k = 0; k < o->end->count; k++) {
        const rg_end_row *row = &o->end->row[k];
        if (is_in_plane(row)) least = fmin(least, rg_end_gap(row, o->P->place, o->P->p));
    }
    return least;
}

static rg_status add_plane_rows(const rg_opening *o)
{
    for (int32_t k = 0; k < o->end->count; k++) {
        const rg_end_row *from = &o->end->row[k];
        if (!is_in_plane(from)) continue;
        rg_row *row = add_end_row(o, from);
        if (!row) return RG_ENOMEM;
        const double want = from->kind == RG_END_INSIDE ? REPAIR_INSIDE : REPAIR_BESIDE;
        row->b = want - rg_end_gap(from, o->P->place, o->P->p);
        row->c = REPAIR_KEEP;
    }
    return RG_OK;
}

/* Pushes near parts of a state near the end apart, by their sides. */
static rg_status repair(rg_opening *o)
{
    rg_status s = RG_OK;
    for (int n = 0; n < o->way->repair && s == RG_OK && rg_nearest_work(o->q) < o->until; n++) {
        const double angle = stand(o);
        s = rg_proximity_find(o->near, o->P->p, NEAR, 0);
        if (s == RG_OK) s = add_near_rows(o);
        if (s != RG_OK) break;
        if (o->worst > TOUCHING * REPAIR_APART && !(least_gap_in_plane(o) <= -1e-6) && angle < 1e-9) break;
        s = add_plane_rows(o);
        if (s == RG_OK) s = add_bounds(o, o->z, RG_PI - NEAR_HALF_TURN, REPAIR_MARGIN * o->way->margin);
        if (s == RG_OK) s = rg_nearest_solve(o->q, NULL, o->P->K.r, 1);
        if (s != RG_OK) break;
        go(o, REPAIR_LARGEST);
        rg_stride_close(o->P, o->q, o->z, 1e-11, 3);
    }
    if (s != RG_OK) return s;
    rg_stride_close(o->P, o->q, o->z, CLOSED, CLOSE);
    o->angle = stand(o);
    s = rg_proximity_find(o->near, o->P->p, NEAR, 0);
    return s == RG_OK ? add_near_rows(o) : s;
}

rg_status rg_open(rg_opening *o)
{
    rg_stride_scale(o->P, GIVE, o->q->scale);
    memcpy(o->z, o->end->z, (size_t)o->P->n * sizeof *o->z);
    o->q->all = 1;
    rg_status s = o->way->grow ? open_slowly(o) : open_at_once(o);
    o->q->all = 0;
    if (s != RG_OK) return s;
    rg_stride_close(o->P, o->q, o->z, CLOSED, CLOSE);
    o->angle = stand(o);
    s = worst_side(o);
    return s == RG_OK && o->way->repair > 0 && o->angle < 1e-6 ? repair(o) : s;
}
