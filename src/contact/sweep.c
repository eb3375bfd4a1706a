#include "contact/sweep.h"

#include <stdlib.h>
#include <string.h>

/* A facet that turns by more, as another one sees it, has leapt: there is no telling which way it went. */
static const double LEAP = RG_PI / 2;
/* Of the depth that is allowed: what is as near to it as this is contact. It keeps steps from getting ever shorter;
 * what is told as contact is off by no more. */
static const double CLOSE = 0.01;
/* A pair that takes more is given up. Each advances at least by the root of what is left over what turning adds, so
 * that even quarter turns take some dozens. */
enum { ADVANCEMENTS = 400 };

rg_status rg_sweep_work_init(const rg_plates *p, rg_sweep_work *w)
{
    memset(w, 0, sizeof *w);
    w->mem = p->mem;
    rg_status s = RG_MEM_ARRAYS(&p->mem, RG_ARRAY(w->ball, (size_t)p->nodes), RG_ARRAY(w->back, (size_t)p->mesh->nf));
    if (s == RG_OK) s = rg_front_work_init(p, &w->front);
    if (s != RG_OK) rg_sweep_work_free(w);
    return s;
}

void rg_sweep_work_free(rg_sweep_work *w)
{
    if (!w->mem.resize) return;
    RG_MEM_FREE(&w->mem, w->ball, w->back, w->before, w->now);
    rg_front_work_free(&w->front);
    memset(w, 0, sizeof *w);
}

static double larger(double a, double b) { return a > b ? a : b; }

/* ----------------------------------------------------------------------- one pair, moving ---- */

/* All as the first facet sees it. The second's corners: y = p(t) + turn(t) Q (r + t dr), where p' = turn(t) v: the
 * point p is one of the second's, and goes on a screw. */
typedef struct pair {
    int32_t na, nb;
    rg_vec2 a[RG_PLATE_CORNERS], da[RG_PLATE_CORNERS], r[RG_PLATE_CORNERS], dr[RG_PLATE_CORNERS];
    rg_vec3 p, v, axis; /* axis: unit, or none */
    rg_mat3 Q;          /* of the second as it begins */
    double angle, reach; /* reach: the farthest corner from p, at any time */
    double stretch;     /* the longest dr */
    double over;        /* less than this they may lie on each other */
    int straight;       /* non-zero: p goes straight, p' = v */
    int stiff;            /* zero: the first changes its shape too */
    /* now */
    /* the first's corners, then the second's: places, velocities */
    rg_vec3 x[2 * RG_PLATE_CORNERS], u[2 * RG_PLATE_CORNERS];
} pair;

static rg_mat3 transposed_times(rg_mat3 A, rg_mat3 B)
{
    rg_mat3 C;
    for (int k = 0; k < 3; k++)
        C.c[k] = (rg_vec3){rg_vec3_dot(A.c[0], B.c[k]), rg_vec3_dot(A.c[1], B.c[k]), rg_vec3_dot(A.c[2], B.c[k])};
    return C;
}

static rg_mat3 transpose(rg_mat3 A)
{
    return (rg_mat3){{{A.c[0].x, A.c[1].x, A.c[2].x}, {A.c[0].y, A.c[1].y, A.c[2].y}, {A.c[0].z, A.c[1].z, A.c[2].z}}};
}

/* The axis of a rotation, unit, and its angle; none near half a turn. */
static rg_vec3 turn_of(rg_mat3 R, double *angle)
{
    const rg_vec3 skew = {R.c[1].z - R.c[2].y, R.c[2].x - R.c[0].z, R.c[0].y - R.c[1].x};
    const double length = rg_vec3_length(skew);
    *angle = atan2(length / 2, (R.c[0].x + R.c[1].y + R.c[2].z - 1) / 2);
    return length > 0 ? rg_vec3_scale(1 / length, skew) : (rg_vec3){0, 0, 0};
}

static rg_vec3 lifted(rg_mat3 Q, rg_vec2 r) { return rg_vec3_axpy(r.x, Q.c[0], rg_vec3_scale(r.y, Q.c[1])); }

static rg_vec2 between(rg_vec2 from, rg_vec2 to, double t)
{
    return (rg_vec2){from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
}

/* The place of the second facet as the first sees it. */
static rg_place seen_from(const rg_plates_state *s, int32_t f, int32_t g)
{
    const rg_place *A = &s->place[f], *B = &s->place[g];
    const rg_vec3 d = rg_vec3_sub(B->t, A->t);
    return (rg_place){transposed_times(A->R, B->R), {rg_vec3_dot(A->R.c[0], d), rg_vec3_dot(A->R.c[1], d),
                                                     rg_vec3_dot(A->R.c[2], d)}};
}

/* The velocity with which a point starts on a screw of this turn that brings it to the end of d: of its circle the
 * chord is the part of d across the axis, so that it starts by half the angle off it. */
static rg_vec3 screw_of(rg_vec3 axis, double angle, rg_vec3 d)
{
    const rg_vec3 lift = rg_vec3_scale(rg_vec3_dot(axis, d), axis), chord = rg_vec3_sub(d, lift);
    const double half = angle / 2, along = half > 0 ? half * cos(half) / sin(half) : 1;
    return rg_vec3_add(lift, rg_vec3_axpy(along, chord, rg_vec3_scale(-half, rg_vec3_cross(axis, chord))));
}

/* Where it has come to from there after a time: turning by `gone` on the way, with c and s its cosine and sine. */
static rg_vec3 on_screw(rg_vec3 axis, double angle, rg_vec3 v, double time, double c, double s)
{
    const rg_vec3 lift = rg_vec3_scale(rg_vec3_dot(axis, v), axis), out = rg_vec3_sub(v, lift);
    if (!(angle > 0)) return rg_vec3_scale(time, v);
    return rg_vec3_axpy(time, lift, rg_vec3_axpy(s / angle, out,
                                                 rg_vec3_scale((1 - c) / angle, rg_vec3_cross(axis, out))));
}

/* corner: the one that the two facets share, -1: none. Returns zero: it leaps. */
static int set_pair(pair *m, const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, int32_t a,
                    int32_t b, int32_t corner)
{
    const int32_t *va = p->vertex + p->start[a], *vb = p->vertex + p->start[b];
    const rg_place begin = seen_from(from, p->facet[a], p->facet[b]), end = seen_from(to, p->facet[a], p->facet[b]);
    m->na = p->start[a + 1] - p->start[a];
    m->nb = p->start[b + 1] - p->start[b];
    m->Q = begin.R;
    m->axis = turn_of(rg_mat3_mul(end.R, transpose(begin.R)), &m->angle);
    if (!(m->angle <= LEAP)) return 0;
    rg_vec2 pivot = {0, 0}, pivot_to = {0, 0};
    if (corner >= 0) {
        pivot = from->X[corner], pivot_to = to->X[corner];
        m->p = (rg_vec3){pivot.x, pivot.y, 0};
        m->v = (rg_vec3){pivot_to.x - pivot.x, pivot_to.y - pivot.y, 0};
    } else {
        for (int32_t k = 0; k < m->nb; k++) {
            pivot = (rg_vec2){pivot.x + from->X[vb[k]].x / m->nb, pivot.y + from->X[vb[k]].y / m->nb};
            pivot_to = (rg_vec2){pivot_to.x + to->X[vb[k]].x / m->nb, pivot_to.y + to->X[vb[k]].y / m->nb};
        }
        m->p = rg_vec3_add(begin.t, lifted(begin.R, pivot));
        m->v = screw_of(m->axis, m->angle, rg_vec3_sub(rg_vec3_add(end.t, lifted(end.R, pivot_to)), m->p));
    }
    m->straight = corner >= 0;
    m->over = RG_CONTACT_STRETCH * p->size;
    m->stiff = 1;
    for (int32_t k = 0; k < m->na; k++) {
        m->a[k] = from->X[va[k]];
        m->da[k] = rg_vec2_sub(to->X[va[k]], m->a[k]);
        m->stiff = m->stiff && m->da[k].x == 0 && m->da[k].y == 0;
    }
    m->reach = m->stretch = 0;
    for (int32_t k = 0; k < m->nb; k++) {
        m->r[k] = rg_vec2_sub(from->X[vb[k]], pivot);
        m->dr[k] = rg_vec2_sub(rg_vec2_sub(to->X[vb[k]], pivot_to), m->r[k]);
        m->reach = fmax(m->reach, sqrt(fmax(rg_vec2_dot(m->r[k], m->r[k]),
                                            rg_vec2_dot(between(m->r[k], rg_vec2_sub(to->X[vb[k]], pivot_to), 1),
                                                        rg_vec2_sub(to->X[vb[k]], pivot_to)))));
        m->stretch = fmax(m->stretch, sqrt(rg_vec2_dot(m->dr[k], m->dr[k])));
    }
    return 1;
}

/* Rodrigues' formula. */
static rg_vec3 turned(rg_vec3 axis, double c, double s, rg_vec3 x)
{
    return rg_vec3_axpy(c, x, rg_vec3_axpy(s, rg_vec3_cross(axis, x),
                                           rg_vec3_scale((1 - c) * rg_vec3_dot(axis, x), axis)));
}

static void go_to(pair *m, double t)
{
    const double c = cos(t * m->angle), s = sin(t * m->angle);
    const rg_vec3 omega = rg_vec3_scale(m->angle, m->axis);
    const rg_mat3 Q = {{turned(m->axis, c, s, m->Q.c[0]), turned(m->axis, c, s, m->Q.c[1]),
                        turned(m->axis, c, s, m->Q.c[2])}};
    for (int32_t k = 0; k < m->na; k++) {
        m->x[k] = (rg_vec3){m->a[k].x + t * m->da[k].x, m->a[k].y + t * m->da[k].y, 0};
        m->u[k] = (rg_vec3){m->da[k].x, m->da[k].y, 0};
    }
    const rg_vec3 way = m->straight ? rg_vec3_scale(t, m->v) : on_screw(m->axis, m->angle, m->v, t, c, s);
    const rg_vec3 p = rg_vec3_add(m->p, way);
    const rg_vec3 v = m->straight ? m->v : turned(m->axis, c, s, m->v);
    for (int32_t k = 0; k < m->nb; k++) {
        const rg_vec3 arm = lifted(Q, (rg_vec2){m->r[k].x + t * m->dr[k].x, m->r[k].y + t * m->dr[k].y});
        m->x[m->na + k] = rg_vec3_add(p, arm);
        m->u[m->na + k] = rg_vec3_add(rg_vec3_add(v, lifted(Q, m->dr[k])), rg_vec3_cross(omega, arm));
    }
}

/* How long s + v h - c h^2 / 2 stays above 0. */
static double while_positive(double s, double v, double c)
{
    if (!(s > 0)) return 0;
    if (!(c > 0)) return v < 0 ? s / -v : INFINITY;
    return v >= 0 ? (v + sqrt(v * v + 2 * c * s)) / c : 2 * s / (sqrt(v * v + 2 * c * s) - v);
}

/* Along the unit vector u, the second plate being on its side: how long they are surely no nearer than `limit`. *gap:
 * out, now. */
static double holds(const pair *m, rg_vec3 u, double limit, double *gap)
{
    const rg_vec3 lever = rg_vec3_scale(m->angle, rg_vec3_cross(m->axis, u));
    /* u . y'' = u . (omega x (p' + omega x arm + 2 Q dr)), and u . (omega x z) = (u x omega) . z. */
    const double c = rg_vec3_length(lever) * (m->angle * m->reach + 2 * m->stretch +
                                              (m->straight ? 0 : rg_vec3_length(m->v)));
    double top = -INFINITY, least = INFINITY, time = INFINITY;
    for (int32_t k = 0; k < m->na; k++) top = fmax(top, rg_vec3_dot(u, m->x[k]));
    for (int32_t i = m->na; i < m->na + m->nb; i++) {
        const double s = rg_vec3_dot(u, m->x[i]), v = rg_vec3_dot(u, m->u[i]);
        if (s < least) least = s;
        if (m->stiff) time = fmin(time, while_positive(s - top - limit, v, c));
        for (int32_t k = 0; k < m->na && !m->stiff; k++)
            time = fmin(time, while_positive(s - rg_vec3_dot(u, m->x[k]) - limit, v - rg_vec3_dot(u, m->u[k]), c));
    }
    *gap = least - top;
    return time;
}

static double gap_along(const pair *m, rg_vec3 u)
{
    double top = -INFINITY, least = INFINITY;
    for (int32_t k = 0; k < m->na; k++) top = fmax(top, rg_vec3_dot(u, m->x[k]));
    for (int32_t i = m->na; i < m->na + m->nb; i++) least = fmin(least, rg_vec3_dot(u, m->x[i]));
    return least - top;
}

static rg_vec3 side_of(const pair *m, int32_t first, int32_t n, int32_t k)
{
    return rg_vec3_sub(m->x[first + (k + 1) % n], m->x[first + k]);
}

static rg_vec3 normal_of(const pair *m, int32_t first, int32_t n)
{
    rg_vec3 sum = {0, 0, 0};
    for (int32_t i = 1; i + 1 < n; i++)
        sum = rg_vec3_add(sum, rg_vec3_cross(rg_vec3_sub(m->x[first + i], m->x[first]),
                                             rg_vec3_sub(m->x[first + i + 1], m->x[first])));
    return sum;
}

static int is_none(rg_vec3 u) { return u.x == 0 && u.y == 0 && u.z == 0; }

/* Sine of edges that count as parallel. */
static const double PARALLEL = 1e-9;

static rg_vec3 unit(rg_vec3 d, double shortest)
{
    const double length = rg_vec3_length(d);
    return length > shortest ? rg_vec3_scale(1 / length, d) : (rg_vec3){0, 0, 0};
}

/* The k-th axis along which two plates may be apart: the line of the middles; those of the separating-axis theorem, the
 * normals and all edges by all edges; and in one plane across an edge. None: where edges are parallel. Zero: there are
 * no more. */
static int axis_number(const pair *m, int32_t k, rg_vec3 *u)
{
    rg_vec3 d = {0, 0, 0};
    double shortest = 0;
    if (k == 0) {
        for (int32_t i = 0; i < m->na; i++) d = rg_vec3_axpy(-1.0 / m->na, m->x[i], d);
        for (int32_t i = 0; i < m->nb; i++) d = rg_vec3_axpy(1.0 / m->nb, m->x[m->na + i], d);
    } else if (k <= 2) {
        d = k == 1 ? normal_of(m, 0, m->na) : normal_of(m, m->na, m->nb);
    } else if ((k -= 3) < m->na * m->nb) {
        const rg_vec3 e = side_of(m, 0, m->na, k / m->nb), g = side_of(m, m->na, m->nb, k % m->nb);
        d = rg_vec3_cross(e, g);
        shortest = PARALLEL * rg_vec3_length(e) * rg_vec3_length(g);
    } else if ((k -= m->na * m->nb) < m->na) {
        d = rg_vec3_cross(side_of(m, 0, m->na, k), normal_of(m, 0, m->na));
    } else if ((k -= m->na) < m->nb) {
        d = rg_vec3_cross(side_of(m, m->na, m->nb, k), normal_of(m, m->na, m->nb));
    } else {
        return 0;
    }
    *u = unit(d, shortest);
    return 1;
}

/* What parts two plates along u and along v parts them along all between, by no less than the sum of both over |u + v|.
 * That is at least 1 up to 120 degrees; beyond it the middle one is looked at: layers that lie on each other are parted
 * by none. */
static int are_joined(const pair *m, rg_vec3 u, rg_vec3 v, double limit)
{
    if (rg_vec3_dot(u, v) >= -0.5) return 1;
    const rg_vec3 middle = unit(rg_vec3_add(u, v), PARALLEL);
    return !is_none(middle) && gap_along(m, middle) >= limit - m->over;
}

/* Now they are apart along v and along u: do they come from the one to the other by axes between? Where both lie in one
 * plane and on each other, they don't come from above to below. */
static int goes_over(const pair *m, rg_vec3 v, rg_vec3 u, double limit)
{
    rg_vec3 w;
    if (is_none(v) || are_joined(m, v, u, limit)) return 1;
    for (int32_t k = 0; axis_number(m, k, &w); k++)
        for (int side = 0; side < 2; side++, w = rg_vec3_scale(-1, w))
            if (!is_none(w) && gap_along(m, w) >= limit && are_joined(m, v, w, limit) && are_joined(m, w, u, limit))
                return 1;
    return 0;
}

/* What the axes tried so far give. */
typedef struct best { double time, gap; rg_vec3 axis; } best;

/* side: that on which the second is, or none. */
static int try_axis(const pair *m, rg_vec3 u, rg_vec3 side, double limit, double enough, best *b)
{
    for (int turn = 0; turn < 2; turn++, u = rg_vec3_scale(-1, u)) {
        double gap;
        const double time = holds(m, u, limit, &gap);
        if (!(gap > b->gap || time > b->time) || !goes_over(m, side, u, limit)) continue;
        if (gap > b->gap) b->gap = gap;
        if (time > b->time) b->time = time, b->axis = u;
        if (b->time >= enough) return 1;
    }
    return 0;
}

/* The last good one first; no more than needed. */
static void try_axes(const pair *m, rg_vec3 side, double limit, double enough, best *b)
{
    rg_vec3 u;
    if (!is_none(b->axis) && try_axis(m, b->axis, side, limit, enough, b)) return;
    for (int32_t k = 0; axis_number(m, k, &u); k++)
        if (!is_none(u) && try_axis(m, u, side, limit, enough, b)) return;
}

/* ----------------------------------------------------------------------------- one pair, all ---- */

typedef struct sweep {
    const rg_plates *p;
    const rg_plates_state *from, *to;
    double depth; /* file units */
    rg_sweep_work *w;
    rg_sweep_found found;
    rg_status status;
    int rigid; /* non-zero: no facet changes its shape */
    int32_t of[2], shared, corner; /* of the last two facets that were asked for: what they share */
    pair m;
} sweep;

static void end_at(sweep *s, rg_sweep_verdict verdict, double time, int32_t a, int32_t b, rg_vec3 axis)
{
    if (!(time < s->found.time) && s->found.verdict != RG_SWEEP_FREE) return;
    const rg_place *A = &s->from->place[s->p->facet[a]];
    s->found.verdict = verdict;
    s->found.time = time;
    s->found.facet[0] = s->p->facet[a];
    s->found.facet[1] = s->p->facet[b];
    s->found.axis = rg_vec3_scale(-1, rg_mat3_mul_vec(A->R, axis));
}

static int by_pair(const void *a, const void *b)
{
    const rg_sweep_side *p = a, *q = b;
    return p->part[0] != q->part[0] ? p->part[0] - q->part[0] : p->part[1] - q->part[1];
}

/* On which side the second was as the step before ended; none: not known. */
static rg_vec3 side_before(const rg_sweep_work *w, int32_t a, int32_t b)
{
    const rg_sweep_side key = {{a, b}, {0, 0, 0}}, *at = NULL;
    if (w->n_before) at = bsearch(&key, w->before, (size_t)w->n_before, sizeof key, by_pair);
    return at ? at->axis : (rg_vec3){0, 0, 0};
}

static void keep_side(sweep *s, int32_t a, int32_t b, rg_vec3 side)
{
    rg_sweep_work *w = s->w;
    if (is_none(side) || s->status != RG_OK) return;
    s->status = RG_MEM_GROW(&w->mem, w->now, w->room_now, (size_t)w->n_now + 1);
    if (s->status == RG_OK) w->now[w->n_now++] = (rg_sweep_side){{a, b}, side};
}

/* They are apart along u now, and were on `side`, or on none that is known. It is known that they are on this one if it
 * was so before, or if nothing else parts them that is more than 60 degrees off. */
static rg_vec3 settled(const pair *m, rg_vec3 side, rg_vec3 u, double limit)
{
    const rg_vec3 none = {0, 0, 0};
    rg_vec3 w;
    if (rg_vec3_dot(side, u) > 0.5) return u;
    for (int32_t k = 0; axis_number(m, k, &w); k++)
        for (int sign = 0; sign < 2; sign++, w = rg_vec3_scale(-1, w))
            if (!is_none(w) && rg_vec3_dot(w, u) < 0.5 && gap_along(m, w) >= limit) return none;
    return u;
}

static void advance(sweep *s, int32_t a, int32_t b, int32_t corner)
{
    pair *m = &s->m;
    const double limit = -s->depth;
    rg_vec3 side = side_before(s->w, a, b);
    best now = {0, -INFINITY, side};
    double t = 0;
    s->found.pairs++;
    if (!set_pair(m, s->p, s->from, s->to, a, b, corner)) {
        end_at(s, RG_SWEEP_GAVE_UP, 0, a, b, (rg_vec3){0, 0, 0});
        return;
    }
    go_to(m, 0);
    for (int32_t n = 0; n < ADVANCEMENTS; n++) {
        const double enough = s->found.time - t;
        now.time = 0;
        now.gap = -INFINITY;
        s->found.advancements++;
        try_axes(m, side, limit, enough, &now);
        const int done = now.time >= enough;
        if (!done && !(now.gap + s->depth > CLOSE * s->depth)) {
            end_at(s, RG_SWEEP_CONTACT, t, a, b, now.axis);
            return;
        }
        t = done ? s->found.time : t + now.time;
        if (!done || !(rg_vec3_dot(side, now.axis) > 0.5)) go_to(m, t);
        side = settled(m, side, now.axis, limit);
        if (!done) continue;
        keep_side(s, a, b, side);
        return;
    }
    end_at(s, RG_SWEEP_GAVE_UP, t, a, b, now.axis);
}

/* The angle between two facets about their common edge e, as the first sees it. */
static double fold_of(const rg_plates_state *s, int32_t f, int32_t g, const int32_t *e)
{
    const rg_vec3 n = seen_from(s, f, g).R.c[2];
    const rg_vec2 d = rg_vec2_sub(s->X[e[1]], s->X[e[0]]);
    return atan2((d.y * n.x - d.x * n.y) / rg_vec2_length(d), n.z);
}

/* A crease that goes through half a turn, either way. A hinge can do nothing else. */
static void close_hinge(sweep *s, int32_t a, int32_t b, int32_t e)
{
    const int32_t f = s->p->facet[a], g = s->p->facet[b], *end = s->p->mesh->edge[e];
    const double before = fold_of(s->from, f, g, end), after = fold_of(s->to, f, g, end);
    s->found.pairs++;
    if (!(fabs(after - before) > RG_PI)) return;
    /* What it is beyond is as deep as the smaller facet reaches. */
    double reach = INFINITY;
    for (int side = 0; side < 2; side++) {
        const int32_t part = side ? b : a;
        double most = 0;
        for (int32_t j = s->p->start[part]; j < s->p->start[part + 1]; j++) {
            const rg_vec2 x = s->from->X[s->p->vertex[j]];
            most = fmax(most, fabs(rg_vec2_turn(s->from->X[end[0]], s->from->X[end[1]], x)) /
                                  rg_vec2_length(rg_vec2_sub(s->from->X[end[1]], s->from->X[end[0]])));
        }
        reach = fmin(reach, most);
    }
    if (!(fmin(RG_PI - fabs(before), RG_PI - fabs(after)) * reach > s->depth)) return;
    const double beyond = RG_PI - fabs(before);
    end_at(s, RG_SWEEP_CONTACT, fmin(1, beyond / (2 * RG_PI - fabs(before) - fabs(after))), a, b, (rg_vec3){0, 0, 0});
}

/* The crease of two facets, if these parts have it both; -1: none. */
static int32_t hinge_of(const rg_plates *p, int32_t a, int32_t b)
{
    const rg_mesh *m = p->mesh;
    const int32_t f = p->facet[a], g = p->facet[b];
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
        const int32_t e = m->facet_edge[j];
        if (m->edge_facet[e][0] != g && m->edge_facet[e][1] != g) continue;
        int found = 0;
        for (int side = 0; side < 2; side++)
            for (int32_t k = p->start[side ? b : a]; k < p->start[(side ? b : a) + 1]; k++)
                found += p->vertex[k] == m->edge[e][0] || p->vertex[k] == m->edge[e][1];
        if (found == 4) return e;
    }
    return -1;
}

/* A point on a screw that turns by up to `angle`, and comes farther by no more than d: how far off its chord it gets.
 * It is faster than that by the arc over its chord; what turns by more than half is looked at as if it did not. */
static double arc_over(double angle, double d)
{
    const double half = fmin(angle, RG_PI) / 2;
    return half > 0 ? half / sin(half) * d * angle / 8 : 0;
}

/* As the first facet sees it, so that it stays where it is: do the second's corners stay on one side of it, near the
 * one that is known? They go straight but for the height of an arc about the middle, and of the middle's. */
static int stays_away(sweep *s, int32_t a, int32_t b, double arm)
{
    const rg_plates *p = s->p;
    const rg_place *back = &s->w->back[p->facet[a]];
    const rg_vec3 *x = s->from->x, *y = s->to->x;
    const double angle = rg_front_angle(&back->R, &s->w->back[p->facet[b]].R);
    const int32_t *v = p->vertex + p->start[a], n = p->start[a + 1] - p->start[a], nb = p->start[b + 1] - p->start[b];
    rg_box A = {x[v[0]], x[v[0]]}, B = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    rg_vec3 goes = {0, 0, 0};
    for (int32_t k = 1; k < n; k++) rg_box_take_in(&A, x[v[k]]);
    for (int32_t j = p->start[b]; j < p->start[b + 1]; j++) {
        const rg_vec3 c = x[p->vertex[j]], d = rg_vec3_add(rg_mat3_mul_vec(back->R, y[p->vertex[j]]), back->t);
        rg_box_take_in(&B, c);
        rg_box_take_in(&B, d);
        goes = rg_vec3_axpy(1.0 / nb, rg_vec3_sub(d, c), goes);
    }
    const double by = arm * angle * angle / 8 + arc_over(angle, rg_vec3_length(goes));
    const double gap[6] = {B.low.x - A.high.x, A.low.x - B.high.x, B.low.y - A.high.y, A.low.y - B.high.y,
                           B.low.z - A.high.z, A.low.z - B.high.z};
    int most = 0;
    for (int k = 1; k < 6; k++)
        if (gap[k] > gap[most]) most = k;
    if (!(gap[most] > by)) return 0;
    const rg_mat3 *R = &s->from->place[p->facet[a]].R;
    const double sign = most % 2 ? -1 : 1;
    const rg_vec3 row[3] = {{R->c[0].x, R->c[1].x, R->c[2].x}, {R->c[0].y, R->c[1].y, R->c[2].y},
                            {R->c[0].z, R->c[1].z, R->c[2].z}};
    const rg_vec3 u = rg_vec3_scale(sign, row[most / 2]), before = side_before(s->w, a, b);
    if (!is_none(before) && !(rg_vec3_dot(before, u) > 0.5)) return 0; /* to be looked at closely */
    if (!is_none(before)) keep_side(s, a, b, u);
    return 1;
}

/* A facet of many corners has many parts, whose pairs follow each other. */
static int32_t shared_by(sweep *s, int32_t f, int32_t g)
{
    if (s->of[0] == f && s->of[1] == g) return s->shared;
    s->of[0] = f, s->of[1] = g;
    return s->shared = rg_plates_shared(s->p->mesh, f, g, &s->corner);
}

static void meet(sweep *s, int32_t a, int32_t b, double arm)
{
    const rg_plates *p = s->p;
    if (p->facet[a] == p->facet[b]) return;
    if (p->facet[a] > p->facet[b]) {
        const int32_t swap = a;
        a = b, b = swap;
    }
    const int32_t shared = shared_by(s, p->facet[a], p->facet[b]);
    const int32_t hinge = shared > 1 ? hinge_of(p, a, b) : -1;
    if (hinge >= 0) close_hinge(s, a, b, hinge);
    else if (shared > 0 || !s->rigid || !stays_away(s, a, b, arm)) advance(s, a, b, s->corner);
}

/* How near the segment from q to r comes to the origin. */
static double nearest_on(rg_vec3 q, rg_vec3 r)
{
    const rg_vec3 d = rg_vec3_sub(r, q);
    const double length = rg_vec3_dot(d, d), t = length > 0 ? -rg_vec3_dot(q, d) / length : 0;
    return rg_vec3_length(t <= 0 ? q : t >= 1 ? r : rg_vec3_axpy(t, d, q));
}

/* Seen from a facet below the one node, so that it stays where it is, the middle of a part below the other goes along
 * an arc; both are within their arms of their middles. From another facet of that node its chord begins there too, but
 * comes to an end that is off by the distance times the angle between them. So if the one chord comes nowhere near,
 * none does. */
static int passes(const sweep *s, const rg_sweep_ball *a, const rg_sweep_ball *b)
{
    const rg_vec3 q = rg_vec3_sub(b->middle[0], a->middle[0]), d = rg_vec3_sub(b->middle[1], a->middle[1]);
    const rg_mat3 *R = &s->w->back[a->facet].R;
    const double near_0 = a->radius[0] + b->radius[0], near_1 = a->radius[1] + b->radius[1];
    const double turned_off = near_1 + a->spread * (rg_vec3_length(d) + near_1);
    const rg_vec3 to = rg_mat3_mul_vec(*R, d);
    const double away = nearest_on(q, to) - fmax(near_0, turned_off) - a->arm - b->arm;
    if (!(away > 0)) return 0;
    const double angle = rg_front_angle(R, &s->w->back[b->facet].R) + a->spread + b->spread;
    return away > arc_over(angle, rg_vec3_length(rg_vec3_sub(to, q)) + near_0 + turned_off);
}

/* Whichever of a pair is the first. */
static int may_meet(void *ctx, int32_t i, int32_t k)
{
    const sweep *s = ctx;
    const rg_sweep_ball *a = &s->w->ball[i], *b = &s->w->ball[k];
    return !passes(s, a, b) || !passes(s, b, a);
}

static void meet_leaves(void *ctx, int32_t i, int32_t k)
{
    sweep *s = ctx;
    meet(s, s->p->node[i].part, s->p->node[k].part, larger(s->w->ball[i].arm, s->w->ball[k].arm));
}

/* ----------------------------------------------------------------------------------- step ---- */

/* The corners of part a about their middle, in both states. */
static void leaf_ball(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, int32_t a,
                      rg_sweep_ball *ball)
{
    const int32_t *v = p->vertex + p->start[a], n = p->start[a + 1] - p->start[a];
    *ball = (rg_sweep_ball){.facet = p->facet[a]};
    double most = 0; /* squared */
    for (int end = 0; end < 2; end++) {
        const rg_vec3 *x = end ? to->x : from->x;
        rg_vec3 middle = {0, 0, 0};
        for (int32_t k = 0; k < n; k++) middle = rg_vec3_add(middle, x[v[k]]);
        middle = rg_vec3_scale(1.0 / n, middle);
        for (int32_t k = 0; k < n; k++) {
            const rg_vec3 d = rg_vec3_sub(x[v[k]], middle);
            most = larger(most, rg_vec3_dot(d, d));
        }
        ball->middle[end] = middle;
    }
    ball->arm = sqrt(most);
}

/* The ball around two. */
static void join_balls(const rg_sweep_ball *a, const rg_sweep_ball *b, int end, rg_sweep_ball *both)
{
    const rg_vec3 d = rg_vec3_sub(b->middle[end], a->middle[end]);
    const double far = rg_vec3_length(d), r = a->radius[end], q = b->radius[end];
    if (r >= far + q || q >= far + r) {
        both->middle[end] = r >= q ? a->middle[end] : b->middle[end];
        both->radius[end] = larger(r, q);
        return;
    }
    both->radius[end] = (far + r + q) / 2;
    both->middle[end] = rg_vec3_axpy((both->radius[end] - r) / far, d, a->middle[end]);
}

/* Facets turn otherwise than the first below their node by no more than the next nodes differ, and theirs from
 * these. */
static void find_balls(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, rg_sweep_work *w)
{
    for (int32_t f = 0; f < p->mesh->nf; f++) {
        const rg_place *A = &from->place[f], *B = &to->place[f];
        w->back[f].R = rg_mat3_mul(A->R, transpose(B->R));
        w->back[f].t = rg_vec3_sub(A->t, rg_mat3_mul_vec(w->back[f].R, B->t));
    }
    for (int32_t i = p->nodes - 1; i >= 0; i--) {
        rg_sweep_ball *ball = &w->ball[i];
        if (p->node[i].part >= 0) {
            leaf_ball(p, from, to, p->node[i].part, ball);
            continue;
        }
        const rg_sweep_ball *left = &w->ball[i + 1], *right = &w->ball[p->node[i].right];
        join_balls(left, right, 0, ball);
        join_balls(left, right, 1, ball);
        ball->arm = larger(left->arm, right->arm);
        ball->facet = left->facet;
        const double angle = rg_front_angle(&w->back[left->facet].R, &w->back[right->facet].R);
        ball->spread = larger(left->spread, right->spread + angle);
    }
}

static int keeps_shape(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to)
{
    return from->X == to->X || memcmp(from->X, to->X, (size_t)p->mesh->nv * sizeof *from->X) == 0;
}

rg_status rg_sweep_step(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, double depth,
                        rg_sweep_work *w,
                        rg_sweep_found *found)
{
    sweep s = {.p = p, .from = from, .to = to, .depth = depth * p->size, .w = w, .of = {-1, -1}};
    s.found = (rg_sweep_found){.verdict = RG_SWEEP_FREE, .time = 1, .facet = {-1, -1}};
    w->n_now = 0;
    if (p->parts > 1 && rg_front_shows_moving(p, from, to, s.depth, &w->front)) {
        s.found.in_front = 1;
    } else if (p->parts > 1) {
        s.rigid = keeps_shape(p, from, to);
        find_balls(p, from, to, w);
        rg_plates_walk_pairs(&(rg_plates_walk){p, may_meet, meet_leaves, &s});
    }
    *found = s.found;
    return s.status;
}

void rg_sweep_forget_new(rg_sweep_work *w)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < w->n_now; i++) {
        const rg_sweep_side now = w->now[i];
        if (rg_vec3_dot(side_before(w, now.part[0], now.part[1]), now.axis) > 0.5) w->now[kept++] = now;
    }
    w->n_now = kept;
}

void rg_sweep_go_on(rg_sweep_work *w)
{
    rg_sweep_side *list = w->before;
    const size_t room = w->room_before;
    if (w->n_now) qsort(w->now, (size_t)w->n_now, sizeof *w->now, by_pair);
    w->before = w->now, w->room_before = w->room_now, w->n_before = w->n_now;
    w->now = list, w->room_now = room, w->n_now = 0;
}
