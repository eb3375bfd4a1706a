#include "unfold/stride.h"

#include <string.h>

/* Lengths are parts of the sheet, angles radians. */
static const double STEP = 3 * RG_DEG;   /* of a crease: so small that the rows, linear, hold over it */
static const double MOVE = 0.02;         /* of a vertex, for the same reason */
static const double DAMPER = 0.7;        /* part of the distance to the floor that a step may use up */
static const double DAMPER_CLOSING = 0.85; /* the same after closing, which bends the step */
static const double REACH = 2.2;         /* pairs are looked at as far as two vertices can come in a step, and more */
static const double FLOOR = 6e-3;        /* keeps steps at 3 degrees; smaller ones shrink like the square root of it */
static const double FLOOR_LAST = 1e-5, FLOOR_LESS = 0.6;
static const int32_t PATIENCE = 12;      /* the floor is lowered when so many steps */
static const double SLOW = 0.02;         /* bring less than this part of what is left */
static const double SOFT = 0.3, SOFT_MOST = 1e-3;
static const double SOFT_COMPLIANCE = 1e-5; /* 1e-3 is too weak to open, 1e-7 stops the motion */
static const double ONE_WAY = 0.5;        /* cosine: ways that are nearer are the same */
static const double HARD_COMPLIANCE = 1e-10; /* of a row, so that rows that contradict each other give a little */
/* And of a glued pair, lest layers on each other make a program of each closing. */
static const double CLOSING_ROUNDS = 1e-6;
static const double THICK = 0.006;       /* the floor over how far it is open: a dozen layers share the room */
static const double BELOW_FLOOR = 0.2;   /* what closing may take of a distance that is below the floor */
static const double NEAR_HALF_TURN = 0.6; /* creases this near to half a turn get their bound as a row */
static const double OVER_ROUNDING = 1e-8; /* what a crease past half a turn may go on by in a step */
static const double ADDED_BACK = 0.1, PATTERN_BACK = 0.5; /* what added creases, pattern are wished back by in a step */
static const double ADDED_SCALE = 3;     /* an added crease bends more readily than a drawn one leaves its wish */
static const double LOCKED = 1e-3, HELD = 0.1; /* radians from half a turn; how readily that turns in closing */
static const double LEAST_AREA = 0.1;    /* of a facet, of what it was */
/* Facets of less get a row; and what it keeps: a little more than the least. */
static const double SMALL_AREA = 0.5, AREA_FLOOR = 0.12;
/* Of the step: else it went to another branch. */
static const double MOST_CORRECTION = 0.7, ALWAYS_CORRECTED = 1e-3;
static const double GAP = 0.1;           /* of its distance, that a pair must keep over a step */
/* A pair is well apart from this distance on, and its side clear where the shortest line is within 60 degrees of the
 * normal; edges that are nearer to parallel (sine) have none. */
static const double APART = 1e-5, STEEP = 0.5, PARALLEL = 1e-3;
static const double IS_NORMAL = 1 - 1e-9; /* cosine: the shortest line is the normal, but for rounding */
static const double WRONG_BY = 1e-5;     /* a glued pair may not be farther than that on its wrong side, and go on */
static const double MAY_FALL = 2;        /* or is as far as it was, but for so many times what closing leaves */
static const double CROSSED = 6e-5;      /* a step after which facets cross deeper (lengths of the sheet) is none */
static const double STILL = 1e-7;        /* a step in which no crease turns by more is none */
static const double DAMPING = 0.1; /* of closing, over what is open */
static const double CLOSED = 1e-11, HARDLY_OPEN = 1e-8;
/* Frozen rows that can't all hold keep kicking Newton off: rows for some iterations only. */
static const int WITH_ROWS = 5, NEWTON = 12;
static const int HALVINGS = 12;
static const double ARRIVED_FLAT = 0.985, ARRIVED_FOLDED = 0.993;
static const double PATTERN_MOVED = 0.05; /* by the most, where it has arrived folded */
static const double GLUE = 2e-5, RELEASE = 3e-5, SIDE_RELEASE = 1e-5; /* from where a pair is glued, released */
/* Near the end steps are a part of how far it is open. */
static const double HARDLY_OPEN_END = 0.08, GROWTH = 0.3, LAGGING = 0.7, OPENS = 1.05;
static const double SIDE_COUNTS = 1e-3;  /* pairs nearer than that are held by their side in the order */

/* What rows of the end let go, and push up, as for pairs. */
static const double END_FLOOR = 1e-4, END_BACK = 0.5, END_BACK_MOST = 1e-5, END_ROUNDING = 1e-6;
static const double END_INSIDE = 5e-4, END_SOFT_MOST = 1e-4;

void rg_stride_scale(const rg_linkage *P, double give, double *scale)
{
    for (int32_t i = 0; i < P->N; i++) scale[i] = i < P->N - P->mesh->added ? 1 : ADDED_SCALE;
    for (int32_t i = 0; i < P->U; i++) scale[P->N + i] = give * P->freedom.reach[i];
}

void rg_stride_hold(const rg_linkage *P, const double *z, double *scale)
{
    for (int32_t i = 0; i < P->N; i++)
        if (fabs(z[i]) > RG_PI - LOCKED) scale[i] *= HELD;
}

void rg_stride_newton(rg_linkage *P, rg_nearest *q, double *z, double angle)
{
    P->J.A.damping = DAMPING * angle;
    rg_coupled_renew(&P->J, q->scale);
    q->work += 20 * P->J.A.L.S.entries + P->J.A.L.S.flops;
    rg_nearest_project(q, NULL, P->K.r);
    P->J.A.damping = 0;
    for (int32_t k = 0; k < P->n; k++) z[k] += q->dz[k];
}

int rg_stride_close(rg_linkage *P, rg_nearest *q, double *z, double tol, int32_t most)
{
    for (int32_t i = 0;; i++) {
        const double angle = rg_coupled_assemble(&P->J, z, z + P->N, NULL);
        if (angle <= tol) return 1;
        if (i == most || !(angle < 1)) return 0;
        rg_stride_newton(P, q, z, angle);
    }
}

static void measure(rg_stride *s)
{
    double sum = 0, least = 1;
    int32_t driven = 0;
    for (int32_t i = 0; i < s->P->N; i++) {
        if (isnan(s->target[i])) continue;
        const double part = s->target[i] == 0 ? 1 - fabs(s->z[i]) / RG_PI : s->z[i] / s->target[i];
        sum += part;
        least = fmin(least, part);
        driven++;
    }
    s->mean = driven ? sum / driven : 1;
    s->least = least;
}

static unsigned char *flags_of(rg_stride *s, const rg_close_pair *at)
{
    return rg_proximity_flags(&s->near, at->kind, at->i, at->j);
}

/* What a row's n turns with: nothing, a facet, two edges, or, from BY_END on, what a row of the end is carried by. */
enum { FIXED, BY_FACET, BY_EDGES, BY_END };

/* The normal by which a pair's side is remembered; zero: it has none. */
static rg_vec3 normal_of(const rg_linkage *P, const rg_close_pair *at)
{
    if (at->kind == 0) return P->place[at->j].R.c[2];
    const rg_vec3 a = rg_vec3_sub(P->p[at->v[1]], P->p[at->v[0]]), b = rg_vec3_sub(P->p[at->v[3]], P->p[at->v[2]]);
    const rg_vec3 c = rg_vec3_cross(a, b);
    const double length = rg_vec3_length(c);
    if (!(length > PARALLEL * rg_vec3_length(a) * rg_vec3_length(b))) return (rg_vec3){0, 0, 0};
    return rg_vec3_scale(1 / length, c);
}

/* Of a pair that is well apart, on which side it is. */
static void remember(rg_stride *s, const rg_close_pair *at)
{
    unsigned char *flag = flags_of(s, at);
    const double along = rg_vec3_dot(at->n, normal_of(s->P, at));
    *flag &= (unsigned char)~(RG_PROXIMITY_ABOVE | RG_PROXIMITY_BELOW);
    if (fabs(along) > STEEP) *flag |= along > 0 ? RG_PROXIMITY_ABOVE : RG_PROXIMITY_BELOW;
}

/* As rg_sides_tell, and where the order does not say, by where it was when last apart. */
static int tell(rg_stride *s, rg_close_pair *at, rg_vec3 *n, double *d)
{
    if (rg_sides_tell(s->sides, s->P, at, n, d)) return 1;
    const unsigned char flag = *flags_of(s, at);
    const int side = flag & RG_PROXIMITY_ABOVE ? 1 : flag & RG_PROXIMITY_BELOW ? -1 : 0;
    const rg_vec3 up = rg_vec3_scale(side, normal_of(s->P, at));
    if (!(rg_vec3_dot(up, up) > 0)) return 0;
    const double along = rg_vec3_dot(rg_proximity_apart(at, s->P->p), up);
    if (at->d > GLUE && fabs(along) < STEEP * at->d) return 0; /* past the rim */
    *n = up;
    *d = along;
    return 1;
}

typedef void of_pair(rg_stride *s, int32_t kind, int32_t i, int32_t j, unsigned char *flags);

static void for_all_pairs(rg_stride *s, of_pair *what)
{
    const rg_mesh *m = s->P->mesh;
    for (int32_t kind = 0; kind < 2; kind++)
        for (int32_t i = 0; i < (kind ? m->ne : m->nv); i++)
            for (int32_t j = 0; j < (kind ? i : m->nf); j++)
                what(s, kind, i, j, rg_proximity_flags(&s->near, kind, i, j));
}

/* Where two layers lie on each other at the start they are glued. */
static void glue(rg_stride *s, int32_t kind, int32_t i, int32_t j, unsigned char *flags)
{
    rg_close_pair at;
    rg_vec3 n;
    double d;
    if (*flags || !(rg_proximity_distance(&s->near, kind, i, j, s->P->p, &at) < SIDE_COUNTS)) return;
    const int told = rg_sides_tell(s->sides, s->P, &at, &n, &d);
    if (at.d < GLUE || (told && d < SIDE_RELEASE)) *flags |= RG_PROXIMITY_GLUED;
}

/* Released is for ever. */
static void release(rg_stride *s, int32_t kind, int32_t i, int32_t j, unsigned char *flags)
{
    rg_close_pair at;
    rg_vec3 n;
    double d;
    if (!(*flags & RG_PROXIMITY_GLUED)) return;
    const double apart = rg_proximity_distance(&s->near, kind, i, j, s->P->p, &at);
    const int told = tell(s, &at, &n, &d);
    if (!(apart > RELEASE) || (told && d < SIDE_RELEASE)) return;
    *flags &= (unsigned char)~RG_PROXIMITY_GLUED;
}

rg_status rg_stride_init(rg_stride *s, const rg_memory *mem, rg_linkage *P, rg_crossed *crossed, const rg_end *end,
                         const double *z, const double *target)
{
    memset(s, 0, sizeof *s);
    s->mem = *mem;
    s->P = P;
    s->crossed = crossed;
    s->end = end;
    s->sides = end ? &end->sides : NULL;
    s->target = target;
    rg_status status = RG_MEM_ARRAYS(mem, RG_ARRAY(s->z, (size_t)P->n), RG_ARRAY(s->z1, (size_t)P->n),
                                     RG_ARRAY(s->wish, (size_t)P->n), RG_ARRAY(s->p1, (size_t)P->mesh->nv),
                                     RG_ARRAY(s->middle, (size_t)P->n), RG_ARRAY(s->merit, RG_STRIDE_MOST + 1),
                                     RG_ARRAY(s->went, RG_STRIDE_MOST + 1),
                                     RG_ARRAY(s->pushed, (size_t)P->N + (size_t)(end ? end->count : 0)));
    if (status == RG_OK) status = rg_proximity_init(&s->near, mem, P->mesh);
    if (status == RG_OK) status = rg_nearest_init(&s->q, mem, P);
    if (status != RG_OK) return status;
    memcpy(s->z, z, (size_t)P->n * sizeof *z);
    rg_stride_scale(P, 1, s->q.scale);
    s->h = s->pace = 1;
    s->dm = FLOOR;
    s->budget = INFINITY;
    rg_nearest_stand(&s->q, s->z);
    measure(s);
    if (end) for_all_pairs(s, glue);
    return RG_OK;
}

void rg_stride_free(rg_stride *s)
{
    if (!s->mem.resize) return;
    rg_proximity_free(&s->near);
    rg_nearest_free(&s->q);
    RG_MEM_FREE(&s->mem, s->z, s->z1, s->wish, s->p1, s->middle, s->pushed, s->merit, s->went);
    memset(s, 0, sizeof *s);
}

static int is_unfolding(const rg_stride *s)
{
    for (int32_t i = 0; i < s->P->N; i++)
        if (!isnan(s->target[i]) && s->target[i] != 0) return 0;
    return 1;
}

static double pattern_moved(const rg_stride *s, int most)
{
    double sum = 0, largest = 0;
    for (int32_t i = 0; i < s->P->U; i++) {
        const double x = s->z[s->P->N + i] / s->P->freedom.reach[i];
        sum += x * x;
        largest = fmax(largest, fabs(x));
    }
    return most ? largest : s->P->U ? sqrt(sum / s->P->U) : 0;
}

/* Whether the motion is there, or stalls; the floor is lowered where it does. */
static void judge(rg_stride *s)
{
    const double merit = s->mean + 0.3 * s->least - 0.3 * pattern_moved(s, 0); /* 1.3 when it is done */
    if (is_unfolding(s) ? s->least > ARRIVED_FLAT : s->least > ARRIVED_FOLDED && pattern_moved(s, 1) < PATTERN_MOVED) {
        s->state = RG_STRIDE_ARRIVED;
        return;
    }
    if (s->steps >= RG_STRIDE_MOST || !(rg_nearest_work(&s->q) < s->budget)) {
        s->state = RG_STRIDE_SPENT;
        return;
    }
    s->merit[s->steps] = merit;
    s->went[s->steps] = s->mean;
    if (s->steps - s->since < PATIENCE) return;
    const double went = s->went[s->steps - PATIENCE];
    if (s->end && s->mean < HARDLY_OPEN_END && s->mean > OPENS * went) return; /* it grows by parts of itself */
    if (merit - s->merit[s->steps - PATIENCE] >= SLOW * fmax(0.02, 1 - merit / 1.3)) return;
    if (s->dm < FLOOR_LAST) s->state = RG_STRIDE_STUCK;
    s->dm *= FLOOR_LESS;
    s->since = s->steps;
}

static void make_wish(rg_stride *s)
{
    const rg_linkage *P = s->P;
    const double step = STEP * s->h;
    if (s->end && s->mean < HARDLY_OPEN_END) { /* the way off the end goes as e, and the pattern as e^2 */
        const double part = GROWTH * s->h;
        for (int32_t i = 0; i < P->n; i++) {
            const double end = s->end->z[i], off = s->z[i] - end;
            const double least = i < P->N && !isnan(s->target[i]) ? LAGGING * s->mean * end : 0;
            s->wish[i] = i < P->N ? part * (fabs(off) < fabs(least) ? -least : off) : 2 * part * off;
        }
        s->pace = 1;
        return;
    }
    for (int32_t i = 0; i < P->N; i++) {
        const double left = s->target[i] - s->z[i];
        s->wish[i] = s->pace * (isnan(left) ? -ADDED_BACK * s->h * s->z[i] : fmax(-step, fmin(step, left)));
    }
    for (int32_t i = P->N; i < P->n; i++) s->wish[i] = s->pace * -PATTERN_BACK * s->h * s->z[i];
}

/* The floor of now: where the end has hardly opened, layers can't be as far apart as later. */
static double floor_of(const rg_stride *s)
{
    return s->end && s->end->keep ? fmin(s->dm, THICK * s->mean) : s->dm;
}

/* Non-zero: the first rows, which part what has crossed, part this pair the other way: it has leaked through, and what
 * is remembered of it is of the wrong side. */
static int has_leaked(const rg_stride *s, int32_t crossed, const rg_close_pair *at, rg_vec3 n)
{
    for (int32_t k = 0; k < crossed; k++) {
        const rg_row *row = &s->q.row[k];
        if (memcmp(row->v, at->v, sizeof at->v) != 0) continue;
        if (row->weight[0] * at->weight[0] * rg_vec3_dot(row->n, n) < 0) return 1;
    }
    return 0;
}

static rg_status add_pair_rows(rg_stride *s)
{
    const int32_t crossed = s->q.count;
    const double dm = floor_of(s);
    rg_proximity *near = &s->near;
    rg_status status = rg_proximity_find(near, s->P->p, REACH * MOVE * s->h / DAMPER + 1e-9, s->sides ? GLUE : 0);
    for (int32_t k = 0; status == RG_OK && k < near->count; k++) {
        rg_close_pair *at = &near->pair[k];
        unsigned char *flags = flags_of(s, at);
        /* No distance to go by, nor a straight way from state to state that does not cut through what turns. */
        if (s->sides && at->d < GLUE) *flags |= RG_PROXIMITY_GLUED;
        if (at->kind == 1 && !rg_proximity_is_inside(at)) continue; /* the corner has a row */
        const int glued = *flags & RG_PROXIMITY_GLUED;
        if (s->sides && !glued && at->d > APART) remember(s, at);
        const rg_vec3 shortest = rg_proximity_direction(at, s->P->p);
        rg_vec3 n = shortest;
        double d = at->d;
        if (s->sides && (glued || at->d < SIDE_COUNTS)) {
            const int told = tell(s, at, &n, &d) && d >= -RG_STRIDE_NOT_THERE;
            if (glued && !told) continue;
            if (!told) n = shortest, d = at->d;
        }
        if (has_leaked(s, crossed, at, n)) {
            *flags &= (unsigned char)~(RG_PROXIMITY_ABOVE | RG_PROXIMITY_BELOW);
            continue;
        }
        rg_row *row = rg_nearest_add(&s->q, 4, at->v, at->weight, n);
        if (!row) return RG_ENOMEM;
        row->feature = at->kind == 0 ? at->i : s->P->mesh->nv + at->i;
        if (fabs(rg_vec3_dot(n, normal_of(s->P, at))) > IS_NORMAL) row->carried = at->kind == 0 ? BY_FACET : BY_EDGES;
        row->d = d;
        row->c = HARD_COMPLIANCE;
        row->b = -DAMPER * fmax(0, d - dm);
        row->floor = d - DAMPER_CLOSING * fmax(0, d - dm) - BELOW_FLOOR * fmin(fmax(d, 0), dm);
        if (glued) row->floor -= CLOSING_ROUNDS;
        row->glued = glued ? 1 : 0;
        row->pushed = flags;
        row->pushed_by = RG_PROXIMITY_PUSHED;
        if (d < dm) row->soft_b = fmin(SOFT * (dm - d), SOFT_MOST), row->soft_c = SOFT_COMPLIANCE;
    }
    return status;
}

/* Of what a corner or an edge is near to one way, only the nearest pushes it up: in a stack that is the next layer, and
 * what is behind it is pushed by that. */
static void push_nearest(rg_stride *s, int32_t first)
{
    rg_nearest *q = &s->q;
    for (int32_t i = first; i < q->count; i++) {
        rg_row *row = &q->row[i];
        row->next = q->head[row->feature];
        q->head[row->feature] = i;
    }
    for (int32_t i = first; i < q->count; i++) {
        rg_row *row = &q->row[i];
        for (int32_t k = q->head[row->feature]; k >= 0 && row->soft_c > 0; k = q->row[k].next) {
            const rg_row *other = &q->row[k];
            if (other->d < row->d && rg_vec3_dot(other->n, row->n) > ONE_WAY) row->soft_c = 0;
        }
    }
    for (int32_t i = first; i < q->count; i++) q->head[q->row[i].feature] = q->row[i].next = -1;
}

static rg_status add_end_rows(rg_stride *s)
{
    for (int32_t k = 0; s->end && s->end->keep && k < s->end->count; k++) {
        const rg_end_row *from = &s->end->row[k];
        if (!rg_end_is_live(from, s->P)) continue;
        const double d = rg_end_gap(from, s->P->place, s->P->p);
        if (d < -RG_STRIDE_NOT_THERE) continue;
        rg_row *row = rg_nearest_add(&s->q, from->terms, from->v, from->weight, rg_end_normal(from, s->P->place));
        if (!row) return RG_ENOMEM;
        row->carried = BY_END + k;
        row->pushed = &s->pushed[s->P->N + k];
        row->pushed_by = 1;
        row->c = HARD_COMPLIANCE;
        row->b = -DAMPER * fmax(0, d - END_FLOOR);
        row->floor = d > 0 ? (1 - DAMPER_CLOSING) * d : d - END_ROUNDING;
        row->glued = 1;
        if (from->kind == RG_END_INSIDE && d < END_INSIDE)
            row->soft_b = fmin(SOFT * (END_INSIDE - d), END_SOFT_MOST), row->soft_c = SOFT_COMPLIANCE;
        else if (d < 0)
            row->soft_b = fmin(-END_BACK * d, END_BACK_MOST), row->soft_c = SOFT_COMPLIANCE;
    }
    return RG_OK;
}

static rg_status add_bounds(rg_stride *s)
{
    for (int32_t i = 0; i < s->P->N; i++) {
        const double rho = fabs(s->z[i]);
        if (rho < RG_PI - NEAR_HALF_TURN) continue;
        rg_row *row = rg_nearest_add_bound(&s->q, i, s->z[i]);
        if (!row) return RG_ENOMEM;
        row->b = fmin(0, rho - RG_PI);
        row->pushed = &s->pushed[i];
        row->pushed_by = 1;
        if (!(rho > RG_PI)) continue;
        row->soft_b = rho - RG_PI; /* one that is locked there can't go back at once */
        row->soft_c = SOFT_COMPLIANCE;
    }
    return RG_OK;
}

void rg_stride_area(const rg_linkage *P, int32_t f, rg_row *row)
{
    const rg_freedom *F = &P->freedom;
    const int32_t *v = P->mesh->facet_vertex + P->mesh->facet_start[f];
    const rg_vec2 *X = P->mesh->X;
    const double whole = rg_vec2_turn(X[v[0]], X[v[1]], X[v[2]]);
    row->facet = f;
    for (int i = 0; i < 3; i++) {
        const rg_vec2 far = rg_vec2_sub(P->X[v[(i + 2) % 3]], P->X[v[(i + 1) % 3]]);
        for (int k = 0; k < 2; k++) {
            const int32_t way = F->way[v[i]][k];
            if (way < 0) continue;
            row->v[row->terms] = way;
            row->weight[row->terms++] = -rg_vec2_cross(F->direction[way], far) / whole;
        }
    }
}

/* Facets that have become small do not become much smaller. */
static rg_status add_area_rows(rg_stride *s)
{
    for (int32_t f = 0; f < s->P->mesh->nf; f++) {
        const double part = rg_linkage_area(s->P, f, s->P->X);
        if (part >= SMALL_AREA) continue;
        rg_row *row = rg_nearest_add(&s->q, 0, NULL, NULL, (rg_vec3){0, 0, 0});
        if (!row) return RG_ENOMEM;
        rg_stride_area(s->P, f, row);
        row->c = HARD_COMPLIANCE;
        row->b = -DAMPER * fmax(0, part - AREA_FLOOR);
        row->floor = part - DAMPER_CLOSING * fmax(0, part - AREA_FLOOR);
    }
    return RG_OK;
}

/* n of a row, as it is turned where vertices are at p and facets in place: else a corner that slides on a facet that
 * turns would seem to leave it, or to go through. */
static rg_vec3 normal_at(const rg_stride *s, const rg_row *row, const rg_vec3 *p, const rg_place *place)
{
    const int32_t *v = row->v;
    if (row->carried == FIXED) return row->n;
    if (row->carried >= BY_END) return rg_end_normal(&s->end->row[row->carried - BY_END], place);
    const rg_vec3 m = row->carried == BY_FACET
                          ? rg_vec3_cross(rg_vec3_sub(p[v[2]], p[v[1]]), rg_vec3_sub(p[v[3]], p[v[1]]))
                          : rg_vec3_cross(rg_vec3_sub(p[v[1]], p[v[0]]), rg_vec3_sub(p[v[3]], p[v[2]]));
    const double length = rg_vec3_length(m);
    if (!(length > 0)) return row->n;
    return rg_vec3_scale((rg_vec3_dot(m, row->n) > 0 ? 1 : -1) / length, m);
}

/* How far the parts of a row are apart there. */
static double gap(const rg_stride *s, const rg_row *row, const rg_vec3 *p, const rg_place *place)
{
    const rg_vec3 n = normal_at(s, row, p, place);
    double sum = 0;
    for (int32_t i = 0; i < row->terms; i++) sum += row->weight[i] * rg_vec3_dot(n, p[row->v[i]]);
    return sum;
}

/* What closing has to leave: rows as they are frozen for this step, at the positions that z1 has. */
static void set_floors(rg_stride *s)
{
    rg_linkage_positions(s->P, s->z1, s->p1);
    for (int32_t k = 0; k < s->q.count; k++) {
        rg_row *row = &s->q.row[k];
        if (row->facet >= 0) {
            row->b = row->floor - rg_linkage_area(s->P, row->facet, s->P->trial_X);
            continue;
        }
        const int32_t i = row->crease;
        row->b = i >= 0 ? fabs(s->z1[i]) - fmax(RG_PI + RG_STRIDE_OVER / 2, fabs(s->z[i]))
                        : row->floor - CLOSING_ROUNDS / 10 - gap(s, row, s->p1, s->P->trial_place);
    }
}

/* Closes z1. Zero: it does not. */
static rg_status close_trial(rg_stride *s, int *closed)
{
    rg_linkage *P = s->P;
    double last = INFINITY;
    *closed = 0;
    for (int i = 0; i < WITH_ROWS; i++) {
        const double angle = rg_coupled_assemble(&P->J, s->z1, s->z1 + P->N, NULL);
        if (!(angle < 1)) return RG_OK;
        set_floors(s);
        const rg_status status = rg_nearest_solve(&s->q, NULL, P->K.r, 0);
        if (status != RG_OK) return status;
        double now = 0;
        for (int32_t k = 0; k < P->n; k++) now = fmax(now, fabs(s->q.dz[k]) / s->q.scale[k]);
        if ((angle < HARDLY_OPEN && s->q.actives == 0) || !(now < last)) break; /* rows that can't all hold */
        last = now;
        for (int32_t k = 0; k < P->n; k++) s->z1[k] += s->q.dz[k];
    }
    *closed = rg_stride_close(P, &s->q, s->z1, CLOSED, NEWTON);
    return RG_OK;
}

/* Non-zero: a glued pair has gone to the wrong side. */
static int changes_side(const rg_stride *s)
{
    for (int32_t k = 0; k < s->q.count; k++) {
        const rg_row *row = &s->q.row[k];
        if (!row->glued) continue;
        const double now = gap(s, row, s->p1, s->P->trial_place);
        if (now >= -WRONG_BY) continue;
        if (!(now >= gap(s, row, s->P->p, s->P->place) - MAY_FALL * CLOSING_ROUNDS)) return 1;
    }
    return 0;
}

/* Facets cross at s->p1. */
static int crosses(const rg_stride *s)
{
    rg_contact_hit hit;
    return rg_contact_deepest(s->crossed->plates, s->p1, CROSSED, s->crossed->look, &hit);
}

/* What is read off between two states is closed for itself, and bends: do facets cross half way from z to z1? s->p1 is
 * lost. */
static int crosses_half_way(rg_stride *s)
{
    rg_linkage *P = s->P;
    for (int32_t i = 0; i < P->n; i++) s->middle[i] = (s->z[i] + s->z1[i]) / 2;
    rg_stride_close(P, &s->q, s->middle, CLOSED, NEWTON);
    rg_linkage_positions(P, s->middle, s->p1);
    return crosses(s);
}

/* Non-zero: the trial step f dz, closed to z1, is one that paper can make. */
static int is_good(rg_stride *s, const double *dz, double f)
{
    const rg_linkage *P = s->P;
    double off = 0, step = 0;
    for (int32_t i = 0; i < P->n; i++) {
        const double want = f * dz[i] / s->q.scale[i], have = (s->z1[i] - s->z[i]) / s->q.scale[i];
        off += (have - want) * (have - want);
        step += want * want;
    }
    if (!(sqrt(off) <= MOST_CORRECTION * sqrt(step) + ALWAYS_CORRECTED)) return 0;
    if (!(rg_linkage_least_area(s->P, s->z1 + P->N) >= LEAST_AREA)) return 0;
    for (int32_t i = 0; i < P->N; i++)
        if (!(fabs(s->z1[i]) <= fmax(RG_PI + RG_STRIDE_OVER, fabs(s->z[i]) + OVER_ROUNDING))) return 0;
    rg_linkage_positions(s->P, s->z1, s->p1);
    if (changes_side(s) || crosses(s)) return 0;
    return rg_proximity_meet(&s->near, P->p, s->p1, GAP) >= 1 && !crosses_half_way(s);
}

/* The nearest step to s->wish that rows allow: q->dz. *f: out, the part of it that is short enough for them. */
static rg_status find_step(rg_stride *s, double *f)
{
    rg_linkage *P = s->P;
    rg_nearest *q = &s->q;
    rg_nearest_clear(q);
    rg_status status = rg_crossed_add(s->crossed, P, &s->near, q);
    const int32_t first = q->count;
    if (status == RG_OK) status = add_pair_rows(s);
    if (status == RG_OK) push_nearest(s, first);
    if (status == RG_OK) status = add_end_rows(s);
    if (status == RG_OK) status = add_bounds(s);
    if (status == RG_OK) status = add_area_rows(s);
    if (status == RG_OK) status = rg_nearest_solve(q, s->wish, P->K.r, 1);
    if (status != RG_OK) return status;
    double turn = 0, move = 0, shift = 0;
    for (int32_t i = 0; i < P->N; i++) turn = fmax(turn, fabs(q->dz[i]));
    for (int32_t i = 0; i < P->U; i++) shift = fmax(shift, fabs(q->dz[P->N + i]) / P->freedom.reach[i]);
    for (int32_t v = 0; v < P->mesh->nv; v++) move = fmax(move, rg_vec3_length(q->dp[v]));
    *f = fmin(fmin(1, 1.5 * STEP * s->h / turn), fmin(MOVE * s->h / move, 0.2 / shift));
    s->turn = turn * *f;
    return RG_OK;
}

/* Goes f of q->dz, or half as far, and so on, whatever first is a step that paper can make. *halvings: out; -1: none
 * is. */
static rg_status go(rg_stride *s, double f, int *halvings)
{
    const rg_linkage *P = s->P;
    memcpy(s->wish, s->q.dz, (size_t)P->n * sizeof *s->wish); /* from here on: the step */
    for (*halvings = 0; *halvings < HALVINGS; ++*halvings, f /= 2) {
        int closed;
        for (int32_t i = 0; i < P->n; i++) s->z1[i] = s->z[i] + f * s->wish[i];
        const rg_status status = close_trial(s, &closed);
        if (status != RG_OK) return status;
        const int good = closed && is_good(s, s->wish, f);
        if (good) memcpy(s->z, s->z1, (size_t)P->n * sizeof *s->z);
        rg_nearest_stand(&s->q, s->z);
        if (!good) continue;
        if (s->sides) for_all_pairs(s, release);
        s->h = fmax(1e-3, fmin(1, 1.3 * s->h * pow(0.5, *halvings / 2.0)));
        return RG_OK;
    }
    *halvings = -1;
    return RG_OK;
}

rg_status rg_stride_towards(rg_stride *s, double floor, int *gone)
{
    double f;
    int halvings = -1;
    s->dm = floor;
    rg_status status = find_step(s, &f);
    if (status == RG_OK) status = go(s, f, &halvings);
    *gone = halvings >= 0;
    return status;
}

rg_status rg_stride_take(rg_stride *s)
{
    double f;
    int halvings;
    judge(s);
    if (s->state != RG_STRIDE_GOES) return RG_OK;
    make_wish(s);
    rg_status status = find_step(s, &f);
    if (status != RG_OK) return status;
    s->pace = fmin(1, fmax(0.05, 1.25 * s->pace * f));
    if (!(s->turn >= STILL)) { /* held: the floor gives */
        if (s->dm < FLOOR_LAST) s->state = RG_STRIDE_STUCK;
        s->dm *= FLOOR_LESS;
        s->since = s->steps;
        return RG_OK;
    }
    status = go(s, f, &halvings);
    if (status != RG_OK) return status;
    if (halvings < 0) {
        s->state = RG_STRIDE_NO_STEP;
        return RG_OK;
    }
    s->steps++;
    measure(s);
    return RG_OK;
}
