#include "verify/through.h"

#include <stdlib.h>
#include <string.h>

/* Facets with a common corner: over less of the sheet it is how the corner is rounded. And what lies over the other by
 * less is beside it. */
static const double STRETCH = 1e-3;
/* Sine of sides that count as parallel. */
static const double PARALLEL = 1e-9;
/* Radians that one facet may turn by, as another one sees it: more leaves open which way it went. */
static const double LEAP = RG_PI / 2;
/* A way in so many halvings is not looked at closer: a 4000th of a frame. */
enum { HALVINGS = 12 };
/* The way from middle to middle, both normals, all sides by all sides, and across all sides. */
enum { MOST_AXES = 3 + RG_PIECE_MOST * RG_PIECE_MOST + 2 * RG_PIECE_MOST };

typedef struct polygon { int32_t n; rg_vec3 x[RG_PIECE_MOST]; } polygon;

static rg_vec3 unit(rg_vec3 a)
{
    const double n = rg_vec3_length(a);
    return n > 0 ? rg_vec3_scale(1 / n, a) : a;
}

static rg_vec3 normal_of(const polygon *p)
{
    rg_vec3 sum = {0, 0, 0};
    for (int32_t k = 1; k + 1 < p->n; k++)
        sum = rg_vec3_add(sum, rg_vec3_cross(rg_vec3_sub(p->x[k], p->x[0]), rg_vec3_sub(p->x[k + 1], p->x[0])));
    return unit(sum);
}

/* The axes along which two plates can be parted: both normals, and all sides by all sides. Returns how many. */
static int32_t find_axes(const polygon *a, const polygon *b, rg_vec3 *axis)
{
    int32_t n = 0;
    axis[n++] = normal_of(a);
    axis[n++] = normal_of(b);
    for (int32_t i = 0; i < a->n; i++)
        for (int32_t k = 0; k < b->n; k++) {
            const rg_vec3 e = rg_vec3_sub(a->x[(i + 1) % a->n], a->x[i]),
                g = rg_vec3_sub(b->x[(k + 1) % b->n], b->x[k]);
            const rg_vec3 u = rg_vec3_cross(e, g);
            const double length = rg_vec3_length(u);
            if (length > PARALLEL * rg_vec3_length(e) * rg_vec3_length(g)) axis[n++] = rg_vec3_scale(1 / length, u);
        }
    return n;
}

static void span(const polygon *p, rg_vec3 u, double *low, double *high)
{
    *low = INFINITY, *high = -INFINITY;
    for (int32_t k = 0; k < p->n; k++) {
        const double d = rg_vec3_dot(u, p->x[k]);
        *low = d < *low ? d : *low;
        *high = d > *high ? d : *high;
    }
}

/* The least way that parts them; not more than `least`: found out of what axis comes first. */
static double depth_of(const polygon *a, const polygon *b, double least, rg_vec3 *axis)
{
    double depth = INFINITY;
    const int32_t n = find_axes(a, b, axis);
    for (int32_t i = 0; i < n && depth > least; i++) {
        double al, ah, bl, bh;
        span(a, axis[i], &al, &ah);
        span(b, axis[i], &bl, &bh);
        depth = fmin(depth, fmin(ah - bl, bh - al));
    }
    return depth;
}

/* How long the common line of two planes is in both. */
static double stretch_of(const polygon *a, const polygon *b)
{
    const rg_vec3 d = unit(rg_vec3_cross(normal_of(a), normal_of(b)));
    double low = -INFINITY, high = INFINITY;
    for (int turn = 0; turn < 2; turn++) {
        const polygon *p = turn ? b : a, *q = turn ? a : b;
        const rg_vec3 n = normal_of(q);
        double from = INFINITY, to = -INFINITY;
        for (int32_t k = 0; k < p->n; k++) {
            const rg_vec3 e = p->x[k], g = p->x[(k + 1) % p->n];
            const double s = rg_vec3_dot(n, rg_vec3_sub(e, q->x[0])), t = rg_vec3_dot(n, rg_vec3_sub(g, q->x[0]));
            if (s * t > 0 || s == t) continue;
            const double at = rg_vec3_dot(d, rg_vec3_axpy(s / (s - t), rg_vec3_sub(g, e), e));
            from = fmin(from, at), to = fmax(to, at);
        }
        low = fmax(low, from), high = fmin(high, to);
    }
    return high > low ? high - low : 0;
}

/* ----------------------------------------------------------------------------- one frame ---- */

typedef struct look {
    const rg_record *r;
    const rg_pieces *p;
    rg_faults *all;
    rg_through *found;
    rg_record_place *place[2]; /* [nf] of a frame and the next */
    rg_vec3 (*low), (*high);   /* [n] boxes */
    int32_t *order;            /* [n] */
    double *arm;               /* [n] */
    rg_vec3 (*middle)[2];      /* [n] */
    rg_vec3 *axis;             /* [2 MOST_AXES] */
} look;

static polygon piece_at(const look *l, int32_t frame, int32_t a)
{
    polygon p = {.n = l->p->start[a + 1] - l->p->start[a]};
    for (int32_t k = 0; k < p.n; k++)
        p.x[k] = l->r->x[(size_t)frame * (size_t)l->r->nv + (size_t)l->p->corner[l->p->start[a] + k]];
    return p;
}

/* A corner that two facets have in common; -1: none. *two: out, whether they have another one. */
static int32_t common_corner(const rg_record *r, int32_t f, int32_t g, int *two)
{
    int32_t found = -1;
    *two = 0;
    for (int32_t i = r->start[f]; i < r->start[f + 1]; i++)
        for (int32_t k = r->start[g]; k < r->start[g + 1]; k++)
            if (r->corner[i] == r->corner[k]) {
                *two = found >= 0;
                found = r->corner[i];
            }
    return found;
}

static void check_pair(look *l, int32_t frame, int32_t a, int32_t b)
{
    const int32_t f = l->p->facet[a], g = l->p->facet[b];
    const polygon A = piece_at(l, frame, a), B = piece_at(l, frame, b);
    const double depth = depth_of(&A, &B, RG_THROUGH_LEAST * l->r->size, l->axis) / l->r->size;
    int two;
    if (!(depth > RG_THROUGH_LEAST)) return;
    if (common_corner(l->r, f, g, &two) >= 0 && !(stretch_of(&A, &B) > STRETCH * l->r->size)) return;
    l->found->depth = fmax(l->found->depth, depth);
    rg_faults_add(l->all, frame, f, g, "cross, %.3g of the sheet deep", depth);
}

typedef struct start { double at; int32_t piece; } start;

static int by_start(const void *a, const void *b)
{
    const start *p = a, *q = b;
    return p->at < q->at ? -1 : p->at > q->at ? 1 : p->piece - q->piece;
}

/* Pairs whose boxes meet, in the order of where these begin. */
static rg_status check_frame(look *l, int32_t frame)
{
    start *s = rg_mem_array(&l->r->mem, (size_t)l->p->n, sizeof *s);
    if (!s) return RG_ENOMEM;
    for (int32_t a = 0; a < l->p->n; a++) {
        const polygon p = piece_at(l, frame, a);
        span(&p, (rg_vec3){1, 0, 0}, &l->low[a].x, &l->high[a].x);
        span(&p, (rg_vec3){0, 1, 0}, &l->low[a].y, &l->high[a].y);
        span(&p, (rg_vec3){0, 0, 1}, &l->low[a].z, &l->high[a].z);
        s[a] = (start){l->low[a].x, a};
    }
    qsort(s, (size_t)l->p->n, sizeof *s, by_start);
    for (int32_t i = 0; i < l->p->n; i++)
        for (int32_t k = i + 1; k < l->p->n && s[k].at <= l->high[s[i].piece].x; k++) {
            const int32_t a = s[i].piece, b = s[k].piece;
            if (l->p->facet[a] == l->p->facet[b] || l->low[a].y > l->high[b].y || l->low[b].y > l->high[a].y ||
                l->low[a].z > l->high[b].z ||
                l->low[b].z > l->high[a].z)
                continue;
            check_pair(l, frame, a < b ? a : b, a < b ? b : a);
        }
    rg_mem_free(&l->r->mem, s);
    return RG_OK;
}

/* -------------------------------------------------------------------------- between frames ---- */

/* A pair as its first facet sees it: corner i of the second is at p + way of the pivot + turn(t) Q (r + t dr). The
 * pivot, a common corner, goes straight by dp; or else it is the middle and goes on the screw of the turn: dp = rise +
 * chord, the one along the axis, the other that of the arc about it. */
typedef struct way {
    int32_t na, nb;
    rg_vec2 a[RG_PIECE_MOST], da[RG_PIECE_MOST], r[RG_PIECE_MOST], dr[RG_PIECE_MOST];
    rg_vec3 p, dp, axis, rise, chord;
    rg_mat3 Q;
    double angle, bend; /* bend: the most that the second time derivative of a corner's place can be */
    int screw;
    double allowed, over; /* file units */
} way;

static rg_mat3 inverse_times(const rg_mat3 *A, const rg_mat3 *B)
{
    rg_mat3 C;
    for (int k = 0; k < 3; k++)
        C.c[k] = (rg_vec3){rg_vec3_dot(A->c[0], B->c[k]), rg_vec3_dot(A->c[1], B->c[k]), rg_vec3_dot(A->c[2], B->c[k])};
    return C;
}

static rg_vec3 put(const rg_mat3 *Q, rg_vec2 r)
{
    return rg_vec3_add(rg_vec3_scale(r.x, Q->c[0]), rg_vec3_scale(r.y, Q->c[1]));
}

/* The arc of a circle that is seen under an angle, by its chord. */
static double arc_length(double angle, double chord)
{
    return angle > 0 ? chord * (angle / 2) / sin(angle / 2) : chord;
}

static void set_way(const look *l, int32_t frame, int32_t a, int32_t b, int32_t corner, way *w)
{
    const int32_t *ca = l->p->corner + l->p->start[a], *cb = l->p->corner + l->p->start[b], f = l->p->facet[a],
        g = l->p->facet[b];
    const rg_vec2 *X = l->r->flat + (size_t)frame * (size_t)l->r->nv, *Y = X + l->r->nv;
    rg_mat3 Q[2];
    rg_vec3 at[2];
    rg_vec2 pivot[2];
    w->na = l->p->start[a + 1] - l->p->start[a], w->nb = l->p->start[b + 1] - l->p->start[b];
    for (int end = 0; end < 2; end++) {
        const rg_vec2 *Z = end ? Y : X;
        const rg_record_place *A = &l->place[end][f], *B = &l->place[end][g];
        pivot[end] = (rg_vec2){0, 0};
        for (int32_t k = 0; corner < 0 && k < w->nb; k++)
            pivot[end] = (rg_vec2){pivot[end].x + Z[cb[k]].x / w->nb, pivot[end].y + Z[cb[k]].y / w->nb};
        if (corner >= 0) pivot[end] = Z[corner];
        Q[end] = inverse_times(&A->R, &B->R);
        const rg_vec3 d = rg_vec3_sub(rg_vec3_add(put(&B->R, pivot[end]), B->t), A->t);
        at[end] = (rg_vec3){rg_vec3_dot(A->R.c[0], d), rg_vec3_dot(A->R.c[1], d), rg_vec3_dot(A->R.c[2], d)};
    }
    w->p = at[0], w->dp = rg_vec3_sub(at[1], at[0]), w->Q = Q[0];
    /* Q1 Q0^T, whose skew part is the axis by the sine. */
    rg_vec3 skew = {0, 0, 0};
    double trace = 0;
    for (int k = 0; k < 3; k++) {
        skew = rg_vec3_add(skew, rg_vec3_cross(Q[0].c[k], Q[1].c[k]));
        trace += rg_vec3_dot(Q[0].c[k], Q[1].c[k]);
    }
    const double sine = rg_vec3_length(skew) / 2;
    w->angle = atan2(sine, (trace - 1) / 2);
    w->axis = unit(skew);
    double arm = 0, change = 0;
    for (int32_t k = 0; k < w->na; k++) w->a[k] = X[ca[k]], w->da[k] = rg_vec2_sub(Y[ca[k]], X[ca[k]]);
    for (int32_t k = 0; k < w->nb; k++) {
        const rg_vec2 q = rg_vec2_sub(Y[cb[k]], pivot[1]);
        w->r[k] = rg_vec2_sub(X[cb[k]], pivot[0]);
        w->dr[k] = rg_vec2_sub(q, w->r[k]);
        arm = fmax(arm, fmax(rg_vec2_length(w->r[k]), rg_vec2_length(q)));
        change = fmax(change, rg_vec2_length(w->dr[k]));
    }
    w->bend = w->angle * (w->angle * arm + 2 * change);
    w->rise = rg_vec3_scale(rg_vec3_dot(w->axis, w->dp), w->axis);
    w->chord = rg_vec3_sub(w->dp, w->rise);
    w->over = STRETCH * l->r->size;
    w->screw = corner < 0 && w->angle > 0;
    /* speed squared over the radius */
    if (w->screw)
        w->bend += w->angle * arc_length(w->angle, rg_vec3_length(w->chord));
}

/* On a circle with a chord c that is seen under the angle a from its middle, after the part t of the arc: along the
 * chord c sin(ta/2) cos((1-t)a/2) / sin(a/2), and beside it c sin(ta/2) sin((1-t)a/2) / sin(a/2), away from the middle.
 * *v: velocity. */
static rg_vec3 along_screw(const way *w, double t, rg_vec3 *v)
{
    if (!w->screw) {
        *v = w->dp;
        return rg_vec3_scale(t, w->dp);
    }
    const double h = w->angle / 2, s = sin(t * h) / sin(h), e = (1 - t) * h, u = h / sin(h), k = (1 - 2 * t) * h;
    const rg_vec3 beside = rg_vec3_cross(w->chord, w->axis);
    *v = rg_vec3_add(w->rise, rg_vec3_axpy(u * cos(k), w->chord, rg_vec3_scale(u * sin(k), beside)));
    return rg_vec3_axpy(t, w->rise, rg_vec3_axpy(s * cos(e), w->chord, rg_vec3_scale(s * sin(e), beside)));
}

/* Places and velocities at a time. */
static void at_time(const way *w, double t, polygon *a, polygon *b, rg_vec3 *va, rg_vec3 *vb)
{
    const double c = cos(t * w->angle), s = sin(t * w->angle);
    rg_vec3 speed;
    const rg_vec3 pivot = rg_vec3_add(w->p, along_screw(w, t, &speed));
    a->n = w->na, b->n = w->nb;
    for (int32_t k = 0; k < w->na; k++) {
        a->x[k] = (rg_vec3){w->a[k].x + t * w->da[k].x, w->a[k].y + t * w->da[k].y, 0};
        va[k] = (rg_vec3){w->da[k].x, w->da[k].y, 0};
    }
    for (int32_t k = 0; k < w->nb; k++) {
        rg_vec3 turned[2];
        for (int i = 0; i < 2; i++) {
            const rg_vec3 z = put(&w->Q, i ? w->dr[k] : (rg_vec2){w->r[k].x + t * w->dr[k].x,
                                                                  w->r[k].y + t * w->dr[k].y});
            const rg_vec3 along = rg_vec3_scale(rg_vec3_dot(w->axis, z), w->axis), out = rg_vec3_sub(z, along);
            turned[i] = rg_vec3_add(along, rg_vec3_axpy(c, out, rg_vec3_scale(s, rg_vec3_cross(w->axis, out))));
        }
        b->x[k] = rg_vec3_add(pivot, turned[0]);
        vb[k] = rg_vec3_add(rg_vec3_add(speed, turned[1]), rg_vec3_scale(w->angle, rg_vec3_cross(w->axis, turned[0])));
    }
}

/* Within h of this time, the second plate is never deeper than allowed beyond the first along u: places are linear in
 * time but for bend h^2 / 2, and what is linear is least at an end. */
static int holds_along(const way *w, rg_vec3 u, double h, const polygon *a, const polygon *b, const rg_vec3 *va,
                       const rg_vec3 *vb)
{
    for (int end = -1; end <= 1; end += 2) {
        double top = -INFINITY, low = INFINITY;
        for (int32_t k = 0; k < a->n; k++) top = fmax(top, rg_vec3_dot(u, a->x[k]) + end * h * rg_vec3_dot(u, va[k]));
        for (int32_t k = 0; k < b->n; k++) low = fmin(low, rg_vec3_dot(u, b->x[k]) + end * h * rg_vec3_dot(u, vb[k]));
        if (!(low - top - w->bend * h * h / 2 >= -w->allowed)) return 0;
    }
    return 1;
}

typedef enum outcome { PROVED, THROUGH, ROUND, OPEN } outcome;

/* How far apart along u, the second beyond the first. */
static double gap_along(const polygon *a, const polygon *b, rg_vec3 u)
{
    double al, ah, bl, bh;
    span(a, u, &al, &ah);
    span(b, u, &bl, &bh);
    return bl - ah;
}

/* Axes along which two plates may be apart: the way from middle to middle, those of find_axes, and, for plates in one
 * plane, across their sides. */
static int32_t all_axes(const polygon *a, const polygon *b, rg_vec3 *axis)
{
    rg_vec3 middle = {0, 0, 0};
    for (int32_t k = 0; k < a->n; k++) middle = rg_vec3_axpy(-1.0 / a->n, a->x[k], middle);
    for (int32_t k = 0; k < b->n; k++) middle = rg_vec3_axpy(1.0 / b->n, b->x[k], middle);
    axis[0] = unit(middle);
    int32_t n = 1 + find_axes(a, b, axis + 1);
    for (int side = 0; side < 2; side++) {
        const polygon *p = side ? b : a;
        const rg_vec3 m = axis[1 + side];
        for (int32_t k = 0; k < p->n; k++)
            axis[n++] = unit(rg_vec3_cross(rg_vec3_sub(p->x[(k + 1) % p->n], p->x[k]), m));
    }
    return n;
}

static int is_known(rg_vec3 side) { return side.x != 0 || side.y != 0 || side.z != 0; }

/* What parts two things along u and along v parts them along all between: along (u + v) / |u + v| by no less than the
 * sum of both over |u + v|, which is 1 or more up to 120 degrees. Beyond that the middle is asked: what lies on the
 * other over more than a STRETCH is not parted by it. So one and the same side goes over into the other. */
static int is_one_side(const polygon *a, const polygon *b, rg_vec3 u, rg_vec3 v, double allowed, double over)
{
    const rg_vec3 both = rg_vec3_add(u, v);
    return rg_vec3_dot(u, v) >= -0.5 || (rg_vec3_length(both) > PARALLEL &&
                                         gap_along(a, b, unit(both)) >= -allowed - over);
}

/* At a time, they are apart along v and along u; is there a way from the one to the other without passing through each
 * other? Where both lie in one plane, over each other, there is none from above to below. */
static int goes_over(const way *w, double t, rg_vec3 v, rg_vec3 u, rg_vec3 *axis)
{
    polygon a, b;
    rg_vec3 va[RG_PIECE_MOST], vb[RG_PIECE_MOST];
    if (!is_known(v)) return 1;
    at_time(w, t, &a, &b, va, vb);
    if (is_one_side(&a, &b, v, u, w->allowed, w->over)) return 1;
    for (int32_t i = all_axes(&a, &b, axis) - 1; i >= 0; i--)
        for (int sign = -1; sign <= 1; sign += 2) {
            const rg_vec3 m = rg_vec3_scale(sign, axis[i]);
            if (is_known(m) && gap_along(&a, &b, m) >= -w->allowed && is_one_side(&a, &b, v, m, w->allowed, w->over) &&
                is_one_side(&a, &b, m, u, w->allowed, w->over))
                return 1;
        }
    return 0;
}

/* Nothing else parts them that is more than 60 degrees off: only then is it known on which side they are. */
static int is_only(const polygon *a, const polygon *b, rg_vec3 u, double allowed, rg_vec3 *axis)
{
    for (int32_t i = all_axes(a, b, axis) - 1; i >= 0; i--)
        for (int sign = -1; sign <= 1; sign += 2) {
            const rg_vec3 m = rg_vec3_scale(sign, axis[i]);
            if (is_known(m) && rg_vec3_dot(m, u) < 0.5 && gap_along(a, b, m) >= -allowed) return 0;
        }
    return 1;
}

/* From t - h to t + h. *side: that on which the second is known to be as it begins, and then as it ends. axis: room for
 * axes. */
static outcome prove(const way *w, double t, double h, int halvings, rg_vec3 *axis, rg_vec3 *side)
{
    polygon a, b, c, d;
    rg_vec3 va[RG_PIECE_MOST], vb[RG_PIECE_MOST], vc[RG_PIECE_MOST], vd[RG_PIECE_MOST], best = {0, 0, 0};
    double depth = INFINITY, most = -INFINITY;
    int round = 0;
    at_time(w, t, &a, &b, va, vb);
    at_time(w, t + h, &c, &d, vc, vd);
    if (is_known(*side) && holds_along(w, *side, h, &a, &b, va, vb)) return PROVED;
    const int32_t n = all_axes(&a, &b, axis);
    for (int32_t i = 0; i < n; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const rg_vec3 u = rg_vec3_scale(sign, axis[i]);
            if (i > 0) depth = fmin(depth, -gap_along(&a, &b, u));
            const double gap = gap_along(&c, &d, u);
            if (!is_known(u) || !(gap > most) || !holds_along(w, u, h, &a, &b, va, vb)) continue;
            if (goes_over(w, t - h, *side, u, axis + n)) most = gap, best = u;
            else round = 1;
        }
    if (is_known(best)) {
        if (!(rg_vec3_dot(*side, best) > 0.5) && !is_only(&c, &d, best, w->allowed, axis)) best = (rg_vec3){0, 0, 0};
        *side = best;
        return PROVED;
    }
    if (depth > w->allowed) return THROUGH;
    if (halvings == 0) return round ? ROUND : OPEN;
    const outcome first = prove(w, t - h / 2, h / 2, halvings - 1, axis, side);
    return first != PROVED ? first : prove(w, t + h / 2, h / 2, halvings - 1, axis, side);
}

static double from_origin(rg_vec3 q, rg_vec3 r)
{
    const rg_vec3 d = rg_vec3_sub(r, q);
    const double n = rg_vec3_dot(d, d), t = n > 0 ? fmin(1, fmax(0, -rg_vec3_dot(q, d) / n)) : 0;
    return rg_vec3_length(rg_vec3_axpy(t, d, q));
}

/* The middle of the second goes on an arc of a quarter at most, as the first sees it (what turns by more is no way at
 * all): does it come near enough for corners to meet? */
static int comes_near(const look *l, int32_t a, int32_t b)
{
    rg_vec3 at[2];
    for (int end = 0; end < 2; end++) {
        const rg_mat3 *R = &l->place[end][l->p->facet[a]].R;
        const rg_vec3 d = rg_vec3_sub(l->middle[b][end], l->middle[a][end]);
        at[end] = (rg_vec3){rg_vec3_dot(R->c[0], d), rg_vec3_dot(R->c[1], d), rg_vec3_dot(R->c[2], d)};
    }
    const double arc = arc_length(LEAP, rg_vec3_length(rg_vec3_sub(at[1], at[0])));
    return from_origin(at[0], at[1]) <= l->arm[a] + l->arm[b] + LEAP * arc / 8;
}

/* Do the two pieces have an edge in common, that is a crease or a cut? Its angle says all of them. */
static int are_hinged(const look *l, int32_t a, int32_t b)
{
    int n = 0;
    for (int32_t i = l->p->start[a]; i < l->p->start[a + 1]; i++)
        for (int32_t k = l->p->start[b]; k < l->p->start[b + 1]; k++) n += l->p->corner[i] == l->p->corner[k];
    return n > 1;
}

static void find_arms(look *l, int32_t frame)
{
    for (int32_t a = 0; a < l->p->n; a++) {
        l->arm[a] = 0;
        for (int end = 0; end < 2; end++) {
            const polygon p = piece_at(l, frame + end, a);
            rg_vec3 m = {0, 0, 0};
            for (int32_t k = 0; k < p.n; k++) m = rg_vec3_axpy(1.0 / p.n, p.x[k], m);
            for (int32_t k = 0; k < p.n; k++) l->arm[a] = fmax(l->arm[a], rg_vec3_length(rg_vec3_sub(p.x[k], m)));
            l->middle[a][end] = m;
        }
    }
}

/* One pair; *side: as it begins, out: as it ends. */
static void check_pair_on_way(look *l, int32_t frame, int32_t a, int32_t b, double allowed, rg_vec3 *side)
{
    const int32_t f = l->p->facet[a], g = l->p->facet[b];
    const rg_vec3 before = *side;
    way w;
    int two;
    const int32_t corner = common_corner(l->r, f, g, &two);
    *side = (rg_vec3){0, 0, 0};
    if (two && are_hinged(l, a, b)) return;
    set_way(l, frame, a, b, corner, &w);
    if (!(w.angle <= LEAP)) {
        rg_faults_add(l->all, frame + 1, f, g,
                      "come near, and turn by %.3g degrees against each other from the frame before: no telling how",
                      w.angle / RG_DEG);
        return;
    }
    /* As in a frame, if that can be; what the path's bends leave open, else, and then it is told. */
    outcome o = OPEN;
    for (int more = 0; more < 2 && o != PROVED; more++) {
        w.allowed = (more ? allowed : RG_THROUGH_LEAST) * l->r->size;
        *side = before;
        o = prove(&w, 0.5, 0.5, HALVINGS, l->axis, side);
        if (o == PROVED && more) l->found->allowed = fmax(l->found->allowed, allowed);
    }
    if (o == PROVED) return;
    *side = (rg_vec3){0, 0, 0};
    if (o == THROUGH)
        rg_faults_add(l->all, frame + 1, f, g,
                      "pass through each other on the way from the frame before, deeper than %.2g of the sheet",
            allowed);
    else if (o == ROUND)
        rg_faults_add(l->all, frame + 1, f, g,
                      "lie on each other, and come to lie the other way round on the way from the frame before");
    else rg_faults_add(l->all, frame + 1, f, g, "could not be proved apart on the way from the frame before");
}

/* Of pairs that come near; those that are far from each other are on no side. */
static rg_status check_way(look *l, int32_t frame, double allowed)
{
    rg_status s = RG_OK;
    rg_aparts before = l->found->sides;
    int32_t at = 0;
    l->found->sides = (rg_aparts){.mem = l->r->mem};
    find_arms(l, frame);
    for (int32_t a = 0; a < l->p->n; a++)
        for (int32_t b = a + 1; s == RG_OK && b < l->p->n; b++) {
            if (l->p->facet[a] == l->p->facet[b] || !comes_near(l, a, b)) continue;
            rg_vec3 side = rg_aparts_next(&before, &at, a, b);
            check_pair_on_way(l, frame, a, b, allowed, &side);
            if (is_known(side)) s = rg_aparts_add(&l->found->sides, a, b, side);
        }
    rg_aparts_free(&before);
    return s;
}

/* The most that a corner's path bends at frame k: a steady curve is off its chords by no more than an eighth of
 * that. */
static double bend_at(const rg_record *r, int32_t k)
{
    double most = 0;
    if (k <= 0 || k + 1 >= r->frames) return 0;
    const rg_vec3 *x = r->x + (size_t)(k - 1) * (size_t)r->nv, *y = x + r->nv, *z = y + r->nv;
    for (int32_t v = 0; v < r->nv; v++)
        most = fmax(most, rg_vec3_length(rg_vec3_add(rg_vec3_axpy(-2, y[v], x[v]), z[v])));
    return most / r->size;
}

rg_status rg_through_frames(const rg_record *r, const rg_pieces *p, rg_faults *all, rg_through *found)
{
    look l = {.r = r, .p = p, .all = all, .found = found};
    *found = (rg_through){.allowed = RG_THROUGH_LEAST, .sides = {.mem = r->mem}};
    const size_t nf = (size_t)r->nf, n = (size_t)p->n;
    rg_status s = RG_MEM_ARRAYS(&r->mem, RG_ARRAY(l.place[0], nf), RG_ARRAY(l.place[1], nf), RG_ARRAY(l.low, n),
                                RG_ARRAY(l.high, n), RG_ARRAY(l.arm, n), RG_ARRAY(l.middle, n),
                                RG_ARRAY(l.axis, 2 * MOST_AXES));
    for (int32_t k = 0; s == RG_OK && k < r->frames; k++) s = check_frame(&l, k);
    for (int32_t k = 0; s == RG_OK && k + 1 < r->frames; k++) {
        for (int end = 0; end < 2; end++)
            for (int32_t f = 0; f < r->nf; f++) l.place[end][f] = rg_record_fit(r, k + end, f, NULL);
        const double bend = fmax(bend_at(r, k), bend_at(r, k + 1));
        const double allowed = fmin(RG_THROUGH_MOST, RG_THROUGH_LEAST + 2 * bend / 8);
        s = check_way(&l, k, allowed);
    }
    RG_MEM_FREE(&r->mem, l.place[0], l.place[1], l.low, l.high, l.arm, l.middle, l.axis);
    return s;
}
