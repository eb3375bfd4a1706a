#include "verify/pile.h"

#include <string.h>

/* Of the sheet's size: what is narrower than this is how the drawing is rounded, no facet over another. */
static const double NARROW = 1e-4;
/* Of the sheet's size: all in one plane. */
static const double PLANE = 1e-6;
/* Radians: creases flat, or at half a turn. */
static const double THERE = 0.5 * RG_DEG;
/* Cosine of the angle that an axis which tells above from below may have with the normal: what lies over the other is
 * not beside it. */
static const double UPRIGHT = 0.5;

typedef struct pile {
    const rg_record *r;
    const rg_pieces *p;
    rg_faults *all;
    rg_pile *found;
    int32_t last;
    rg_vec2 *at;             /* [nv] in the plane */
    signed char *up;         /* [nf] 1: its front looks up */
    signed char *above;      /* [nf][nf] 1: the first over the second, -1: under, 0: not said */
    unsigned char *over;     /* [nf][nf] 1: they lie over each other, 2: and came in some order; 0: not */
    int32_t *crease, creases; /* edges at half a turn and flat ones between two facets */
} pile;

static signed char *order(const pile *q, int32_t f, int32_t g)
{
    return &q->above[(size_t)f * (size_t)q->r->nf + (size_t)g];
}
static unsigned char *over(const pile *q, int32_t f, int32_t g)
{
    return &q->over[(size_t)f * (size_t)q->r->nf + (size_t)g];
}
static const double *end_angles(const pile *q) { return q->r->rho + (size_t)q->last * (size_t)q->r->ne; }

/* -------------------------------------------------------------------------------- the plane ---- */

static int lies_flat(pile *q)
{
    const rg_record *r = q->r;
    const rg_vec3 *x = r->x + (size_t)q->last * (size_t)r->nv;
    const rg_record_place first = rg_record_fit(r, q->last, 0, NULL);
    int folded = 0;
    for (int32_t v = 0; v < r->nv; v++) {
        const rg_vec3 d = rg_vec3_sub(x[v], x[r->corner[0]]);
        if (!(fabs(rg_vec3_dot(d, first.R.c[2])) <= PLANE * r->size)) return 0;
        q->at[v] = (rg_vec2){rg_vec3_dot(d, first.R.c[0]), rg_vec3_dot(d, first.R.c[1])};
    }
    for (int32_t f = 0; f < r->nf; f++)
        q->up[f] = rg_vec3_dot(rg_record_fit(r, q->last, f, NULL).R.c[2], first.R.c[2]) > 0 ? 1 : -1;
    for (int32_t e = 0; e < r->ne; e++) {
        if (r->side[e][0] < 0 || r->side[e][1] < 0) continue;
        q->crease[q->creases++] = e;
        folded |= fabs(end_angles(q)[e]) >= RG_PI - THERE;
    }
    return folded;
}

static int32_t piece_of(const pile *q, int32_t a, rg_vec2 x[RG_PIECE_MOST])
{
    const int32_t n = q->p->start[a + 1] - q->p->start[a];
    for (int32_t k = 0; k < n; k++) x[k] = q->at[q->p->corner[q->p->start[a] + k]];
    return n;
}

/* How wide a place two facets have in common; 0: none. */
static double common_width(const pile *q, int32_t f, int32_t g)
{
    rg_vec2 a[RG_PIECE_MOST], b[RG_PIECE_MOST], common[RG_PIECE_COMMON];
    double widest = 0;
    for (int32_t i = q->p->first[f]; i < q->p->first[f + 1]; i++)
        for (int32_t k = q->p->first[g]; k < q->p->first[g + 1]; k++) {
            const int32_t na = piece_of(q, i, a), nb = piece_of(q, k, b), m = rg_pieces_common(a, na, b, nb, common);
            widest = fmax(widest, rg_pieces_width(common, m));
        }
    return widest;
}

/* -------------------------------------------------------------------------------- what is said ---- */

static void take_orders(pile *q)
{
    const rg_record *r = q->r;
    for (int32_t i = 0; i < r->orders; i++) {
        const int32_t f = r->order[i][0], g = r->order[i][1];
        const int sign = r->order[i][2] * q->up[g];
        if (sign == 0 || f == g) continue;
        if (*order(q, f, g) * sign < 0)
            rg_faults_add(q->all, q->last, f, g, "lie above and below each other by the file's orders");
        *order(q, f, g) = (signed char)sign;
        *order(q, g, f) = (signed char)-sign;
    }
}

static void check_pairs(pile *q)
{
    for (int32_t f = 0; f < q->r->nf; f++)
        for (int32_t g = 0; g < f; g++) {
            if (!(common_width(q, f, g) > NARROW * q->r->size)) continue;
            *over(q, f, g) = *over(q, g, f) = 1;
            q->found->pairs++;
            if (*order(q, f, g) == 0) {
                rg_faults_add(q->all, q->last, g, f, "lie over each other, and the file does not say in which order");
                continue;
            }
        }
}

/* As they come to lie. */
static void check_sides(pile *q, const rg_aparts *sides)
{
    for (int32_t i = 0; i < sides->n; i++) {
        const rg_apart *s = &sides->list[i];
        const int32_t f = q->p->facet[s->a], g = q->p->facet[s->b];
        if (!*over(q, f, g) || !(fabs(s->axis.z) > UPRIGHT)) continue;
        q->found->seen += *over(q, f, g) == 1;
        *over(q, f, g) = *over(q, g, f) = 2;
        if (*order(q, g, f) * q->up[f] * s->axis.z < 0)
            rg_faults_add(q->all, q->last, f, g, "lie in the other order than they came in");
    }
}

/* In a valley the fronts look at each other: what lies on the front of the one is the other. */
static void check_hinges(pile *q)
{
    for (int32_t i = 0; i < q->creases; i++) {
        const int32_t e = q->crease[i], f = q->r->side[e][0], g = q->r->side[e][1];
        const double rho = end_angles(q)[e];
        if (!(fabs(rho) >= RG_PI - THERE) || !*over(q, f, g)) continue;
        if (*order(q, f, g) * q->up[g] * rho < 0)
            rg_faults_add(q->all, q->last, f, g, "lie in the other order than the %s between them asks for",
                          rho > 0 ? "valley" : "mountain");
    }
}

/* ---------------------------------------------------------------------------------------- triples ---- */

/* The widest place of three. */
static double place_of_three(const pile *q, int32_t f, int32_t g, int32_t h)
{
    rg_vec2 a[RG_PIECE_MOST], b[RG_PIECE_MOST], c[RG_PIECE_MOST], ab[RG_PIECE_COMMON], abc[RG_PIECE_COMMON];
    double widest = 0;
    for (int32_t i = q->p->first[f]; i < q->p->first[f + 1]; i++)
        for (int32_t k = q->p->first[g]; k < q->p->first[g + 1]; k++) {
            const int32_t na = piece_of(q, i, a), nb = piece_of(q, k, b), n = rg_pieces_common(a, na, b, nb, ab);
            for (int32_t j = q->p->first[h]; n >= 3 && n <= RG_PIECE_MOST && j < q->p->first[h + 1]; j++) {
                const int32_t nc = piece_of(q, j, c), m = rg_pieces_common(ab, n, c, nc, abc);
                widest = fmax(widest, rg_pieces_width(abc, m));
            }
        }
    return widest;
}

/* Only facets that are part of a circle of the whole order can be part of a small one: what is above nothing that is
 * left is taken away, as long as there is such a one. left[nf], under[nf]: room. */
static void check_triples(pile *q, int32_t *under, int32_t *left)
{
    const int32_t nf = q->r->nf;
    int32_t n = 0, done = 0;
    memset(under, 0, (size_t)nf * sizeof *under);
    for (int32_t f = 0; f < nf; f++)
        for (int32_t g = 0; g < nf; g++) under[f] += *over(q, f, g) && *order(q, f, g) > 0;
    for (int32_t f = 0; f < nf; f++)
        if (under[f] == 0) left[n++] = f;
    for (; done < n; done++)
        for (int32_t g = 0; g < nf; g++)
            if (*over(q, left[done], g) && *order(q, g, left[done]) > 0 && --under[g] == 0) left[n++] = g;
    if (n == nf) return;
    n = 0;
    for (int32_t f = 0; f < nf; f++)
        if (under[f] > 0) left[n++] = f;
    for (int32_t i = 0; i < n; i++)
        for (int32_t k = 0; k < n; k++) {
            const int32_t f = left[i], g = left[k];
            if (!(f < g) || !*over(q, f, g)) continue;
            for (int32_t j = 0; j < n; j++) {
                const int32_t h = left[j], fg = *order(q, f, g);
                if (!(f < h) || !*over(q, g, h) || !*over(q, h, f) || *order(q, g, h) != fg || *order(q, h, f) != fg ||
                    fg == 0) continue;
                if (place_of_three(q, f, g, h) > NARROW * q->r->size)
                    rg_faults_add(q->all, q->last, f, g, "and facet %d lie over each other in a circle", (int)h);
            }
        }
}

/* ---------------------------------------------------------------------------------------- creases ---- */

/* On which side of the line of an edge a facet of it lies: 1 left, -1 right. */
static int side_of_line(const pile *q, int32_t e, int32_t f)
{
    const int32_t *v = q->r->edge[e];
    double most = 0;
    for (int32_t j = q->r->start[f]; j < q->r->start[f + 1]; j++) {
        const double d = rg_vec2_turn(q->at[v[0]], q->at[v[1]], q->at[q->r->corner[j]]);
        if (fabs(d) > fabs(most)) most = d;
    }
    return most > 0 ? 1 : -1;
}

static rg_vec2 along(rg_vec2 a, rg_vec2 b, double t) { return (rg_vec2){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

/* Is x within a facet by at least `by`? */
static int is_within(const pile *q, int32_t f, rg_vec2 x, double by)
{
    rg_vec2 c[RG_PIECE_MOST];
    const rg_vec2 box[4] = {{x.x - by, x.y - by}, {x.x + by, x.y - by}, {x.x + by, x.y + by}, {x.x - by, x.y + by}};
    double area = 0;
    for (int32_t i = q->p->first[f]; i < q->p->first[f + 1]; i++) {
        rg_vec2 common[RG_PIECE_COMMON];
        const int32_t n = piece_of(q, i, c);
        area += fabs(rg_pieces_area(common, rg_pieces_common(box, 4, c, n, common)));
    }
    return area >= 4 * by * by * (1 - 1e-6);
}

/* The stretch of the segment a b that is within a convex piece, as parts of it. */
static int clip_segment(const rg_vec2 *c, int32_t n, rg_vec2 a, rg_vec2 b, double *from, double *to)
{
    const double way = rg_pieces_area(c, n) < 0 ? -1 : 1;
    *from = 0, *to = 1;
    for (int32_t k = 0; k < n; k++) {
        const double s = way * rg_vec2_turn(c[k], c[(k + 1) % n], a), t = way * rg_vec2_turn(c[k], c[(k + 1) % n], b);
        if (s < 0 && t < 0) return 0;
        if (s < 0) *from = fmax(*from, s / (s - t));
        if (t < 0) *to = fmin(*to, s / (s - t));
    }
    return *from < *to;
}

/* A facet that goes on across the line of a crease lies on one and the same side of both facets of it: of a folded one,
 * as paper can't be between there; of a flat one, as both are one piece there. */
static void check_across(pile *q)
{
    const double by = NARROW * q->r->size;
    for (int32_t i = 0; i < q->creases; i++) {
        const int32_t e = q->crease[i], f = q->r->side[e][0], g = q->r->side[e][1];
        const rg_vec2 a = q->at[q->r->edge[e][0]], b = q->at[q->r->edge[e][1]];
        const double length = rg_vec2_length(rg_vec2_sub(b, a));
        for (int32_t h = 0; h < q->r->nf; h++) {
            if (h == f || h == g || !*over(q, f, h) || !*over(q, g, h) || *order(q, f, h) == *order(q, g, h)) continue;
            int across = 0;
            for (int32_t k = q->p->first[h]; k < q->p->first[h + 1] && !across; k++) {
                rg_vec2 c[RG_PIECE_MOST];
                double from, to;
                const int32_t n = piece_of(q, k, c);
                if (!clip_segment(c, n, a, b, &from, &to) || !((to - from) * length > 4 * by)) continue;
                for (int part = 1; part < 8 && !across; part++)
                    across = is_within(q, h, along(a, b, from + part * (to - from) / 8), by);
            }
            if (across)
                rg_faults_add(q->all, q->last, f, g, "have facet %d between them, which goes on across their crease",
                              (int)h);
        }
    }
}

/* Two creases that lie on one line for more than a narrow stretch. */
static int on_one_line(const pile *q, int32_t d, int32_t e)
{
    const rg_vec2 a = q->at[q->r->edge[d][0]], b = q->at[q->r->edge[d][1]], p = q->at[q->r->edge[e][0]],
        s = q->at[q->r->edge[e][1]];
    const rg_vec2 u = rg_vec2_sub(b, a);
    const double length = rg_vec2_length(u), by = NARROW * q->r->size;
    if (!(fabs(rg_vec2_turn(a, b, p)) <= by * length && fabs(rg_vec2_turn(a, b, s)) <= by * length)) return 0;
    const double t = rg_vec2_dot(u, rg_vec2_sub(p, a)) / length, w = rg_vec2_dot(u, rg_vec2_sub(s, a)) / length;
    return fmin(length, fmax(t, w)) - fmax(0, fmin(t, w)) > 4 * by;
}

static int between(const pile *q, int32_t h, int32_t f, int32_t g) { return *order(q, h, f) * *order(q, h, g) < 0; }

static void check_two(pile *q, int32_t d, int32_t e)
{
    const int32_t f = q->r->side[d][0], g = q->r->side[d][1], h = q->r->side[e][0], k = q->r->side[e][1];
    const int folded_d = fabs(end_angles(q)[d]) >= RG_PI - THERE, folded_e = fabs(end_angles(q)[e]) >= RG_PI - THERE;
    if (f == h || f == k || g == h || g == k) return; /* about one facet: across() and the pairs say all */
    if (folded_d && folded_e) {
        if (side_of_line(q, d, f) != side_of_line(q, d, h)) return;
        if (!*over(q, f, h) || !*over(q, f, k) || !*over(q, g, h) || !*over(q, g, k)) return;
        if (between(q, h, f, g) != between(q, k, f, g))
            rg_faults_add(q->all, q->last, f, g,
                          "have one of facets %d and %d between them, whose crease lies on theirs", (int)h, (int)k);
    } else if (folded_d || folded_e) {
        const int32_t A = folded_d ? f : h, B = folded_d ? g : k, C = folded_d ? h : f, D = folded_d ? k : g,
            line = folded_d ? d : e;
        const int32_t in = side_of_line(q, line, A) == side_of_line(q, line, C) ? C : D;
        if (*over(q, A, in) && *over(q, B, in) && between(q, in, A, B))
            rg_faults_add(q->all, q->last, A, B, "have facet %d between them, which goes on flat across their crease",
                          (int)in);
    } else {
        const int same = side_of_line(q, d, f) == side_of_line(q, d, h);
        const int32_t F = same ? h : k, G = same ? k : h;
        if (*over(q, f, F) && *over(q, g, G) && *order(q, f, F) != *order(q, g, G))
            rg_faults_add(q->all, q->last, f, g, "change places with facets %d and %d at a flat crease", (int)F,
                          (int)G);
    }
}

static void check_lines(pile *q)
{
    for (int32_t i = 0; i < q->creases; i++)
        for (int32_t k = 0; k < i; k++)
            if (on_one_line(q, q->crease[i], q->crease[k])) check_two(q, q->crease[i], q->crease[k]);
}

rg_status rg_pile_check(const rg_record *r, const rg_pieces *p, const rg_aparts *sides, rg_faults *all, rg_pile *found)
{
    const size_t nf = (size_t)r->nf;
    pile q = {.r = r, .p = p, .all = all, .found = found, .last = r->frames - 1};
    *found = (rg_pile){0};
    int32_t *under, *left;
    rg_status s = RG_MEM_ARRAYS(&r->mem, RG_ARRAY(under, nf), RG_ARRAY(left, nf), RG_ARRAY(q.at, (size_t)r->nv),
                                RG_ARRAY(q.up, nf), RG_ARRAY(q.crease, (size_t)r->ne));
    found->is_flat = s == RG_OK && lies_flat(&q);
    if (found->is_flat) s = RG_MEM_ARRAYS(&r->mem, RG_ARRAY(q.above, nf * nf), RG_ARRAY(q.over, nf * nf));
    if (s == RG_OK && found->is_flat) {
        take_orders(&q);
        check_pairs(&q);
        check_sides(&q, sides);
        check_hinges(&q);
        check_triples(&q, under, left);
        check_across(&q);
        check_lines(&q);
    }
    RG_MEM_FREE(&r->mem, under, left, q.at, q.up, q.crease, q.above, q.over);
    return s;
}
