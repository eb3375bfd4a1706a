#include "unfold/end.h"

#include <string.h>

/* Drawings are rounded: edges are on one line within the first (lengths of the sheet) and the second (sine). */
static const double ON_LINE = 1e-4, ONE_DIRECTION = 1e-3;
/* A common stretch, an overlap (area), two corners of it, that are less are rounding. */
static const double STRETCH = 1e-5, OVERLAP = 1e-6, ONE_CORNER = 1e-6;
/* A point is in a facet if it is not farther outside than that. */
static const double INSIDE = 1e-9, ABOUT_INSIDE = 1e-5;
/* A weight below is rounding. */
static const double NOTHING = 1e-7;

/* Rows live while what they are about is nearer than that, in the plane of a crease, and else while facets face each
 * other to 25 degrees. */
static const double LIVES_INSIDE = 1e-3, LIVES = 2e-4, LIVES_FACING = 0.9;

/* A height (lengths of the sheet) that shows which of two facets is above, what a crossing counts from: layers that are
 * nearer lie on each other; and how alike they lie there. */
static const double SHOWN = 1e-4, ALIKE = 0.9;

/* A triangle cut by three half planes has six corners at most. */
typedef struct shape { int n; rg_vec2 x[8]; } shape;

/* A folded or border edge at the flat end. */
typedef struct line {
    int32_t edge, a, b, facet[2], facets;
    rg_vec2 along, in; /* unit; in: across, into the paper */
    double length;
} line;

typedef struct builder {
    rg_end *e;
    rg_linkage *P;
    const rg_mesh *m;
    const rg_end_rules *rules;
    const rg_end_order *order;
    shape *triangle;      /* [nf] in the plane, counter-clockwise */
    int32_t (*corner)[3]; /* [nf] its vertices in that order */
    line *line;
    int32_t lines;
} builder;

static int over(const builder *w, int32_t f, int32_t g)
{
    return w->e->sides.over[(size_t)f * (size_t)w->m->nf + (size_t)g];
}

static int is_stopped(const builder *w) { return rg_stop_asked(w->order->stop); }

/* Where the order says so, whether they overlap there or not. */
static int above(const builder *w, int32_t f, int32_t g) { return w->order->above(w->order->ctx, f, g); }

static rg_vec2 towards(rg_vec2 a, rg_vec2 b, double t)
{
    return (rg_vec2){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

static void cut(shape *s, rg_vec2 a, rg_vec2 b)
{
    shape out = {0};
    for (int i = 0; i < s->n; i++) {
        const rg_vec2 x = s->x[i], y = s->x[(i + 1) % s->n];
        const double p = rg_vec2_turn(a, b, x), q = rg_vec2_turn(a, b, y);
        if (p >= 0) out.x[out.n++] = x;
        if ((p > 0 && q < 0) || (p < 0 && q > 0)) out.x[out.n++] = towards(x, y, p / (p - q));
        if (out.n > 6) break; /* rounding: more there can't be */
    }
    *s = out;
}

static shape common(const shape *a, const shape *b)
{
    shape s = *a;
    for (int i = 0; i < 3 && s.n > 0; i++) cut(&s, b->x[i], b->x[(i + 1) % 3]);
    return s;
}

static double area(const shape *s)
{
    double sum = 0;
    for (int i = 1; i + 1 < s->n; i++) sum += rg_vec2_turn(s->x[0], s->x[i], s->x[i + 1]);
    return sum / 2;
}

static int boxes_meet(const shape *a, const shape *b)
{
    for (int axis = 0; axis < 2; axis++) {
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++) {
                const rg_vec2 x = k ? b->x[i] : a->x[i];
                low[k] = fmin(low[k], axis ? x.y : x.x);
                high[k] = fmax(high[k], axis ? x.y : x.x);
            }
        if (high[0] < low[1] || high[1] < low[0]) return 0;
    }
    return 1;
}

static int covers(const shape *t, rg_vec2 x, double tol)
{
    for (int i = 0; i < 3; i++) {
        const rg_vec2 a = t->x[i], b = t->x[(i + 1) % 3];
        if (rg_vec2_turn(a, b, x) < -tol * rg_vec2_length(rg_vec2_sub(b, a))) return 0;
    }
    return 1;
}

static void weights_at(const shape *t, rg_vec2 x, double *w)
{
    const double whole = rg_vec2_turn(t->x[0], t->x[1], t->x[2]);
    w[1] = rg_vec2_turn(t->x[0], x, t->x[2]) / whole;
    w[2] = rg_vec2_turn(t->x[0], t->x[1], x) / whole;
    w[0] = 1 - w[1] - w[2];
}

/* ---- rows */

static void add_term(rg_end_row *row, int32_t v, double weight)
{
    for (int32_t i = 0; i < row->terms; i++)
        if (row->v[i] == v) {
            row->weight[i] += weight;
            return;
        }
    row->v[row->terms] = v;
    row->weight[row->terms++] = weight;
}

static int same_row(const rg_end_row *a, const rg_end_row *b)
{
    if (a->terms != b->terms || a->kind != b->kind || a->frame != b->frame) return 0;
    for (int32_t i = 0; i < a->terms; i++) {
        int32_t j = 0;
        while (j < b->terms && b->v[j] != a->v[i]) j++;
        if (j == b->terms || fabs(a->weight[i] - b->weight[j]) > NOTHING) return 0;
    }
    return rg_vec3_dot(a->n, b->n) > 1 - NOTHING;
}

/* n: in the plane of the flat end. A row that says nothing, or what another one says, is left out. */
static rg_status add_row(builder *w, rg_end_row row, rg_vec3 n)
{
    rg_end *e = w->e;
    int32_t terms = 0;
    for (int32_t i = 0; i < row.terms; i++) {
        if (fabs(row.weight[i]) < NOTHING) continue;
        row.v[terms] = row.v[i];
        row.weight[terms++] = row.weight[i];
    }
    row.terms = terms;
    if (terms == 0) return RG_OK;
    const rg_mat3 *R = &w->P->place[row.frame].R;
    row.n = (rg_vec3){rg_vec3_dot(R->c[0], n), rg_vec3_dot(R->c[1], n), rg_vec3_dot(R->c[2], n)};
    for (int32_t k = 0; k < e->count; k++)
        if (same_row(&row, &e->row[k])) return RG_OK;
    const rg_status s = RG_MEM_GROW(&e->mem, e->row, e->room, (size_t)e->count + 1);
    if (s == RG_OK) e->row[e->count++] = row;
    return s;
}

/* LAYER: a third facet between u and l at x. */
static int is_between(const builder *w, int32_t u, int32_t l, rg_vec2 x)
{
    for (int32_t f = 0; f < w->m->nf; f++)
        if (over(w, u, f) > 0 && over(w, f, l) > 0 && covers(&w->triangle[f], x, INSIDE)) return 1;
    return 0;
}

static int32_t edge_of(const builder *w, int32_t f, const double *weight)
{
    int32_t v[2], n = 0;
    for (int k = 0; k < 3 && n < 2; k++)
        if (fabs(weight[k]) >= NOTHING) v[n++] = w->corner[f][k];
    return n == 2 ? rg_mesh_edge_between(w->m, f, v[0], v[1]) : -1;
}

/* Where a corner of the one meets the other, or two edges cross, the row is of that pair. */
static void set_pair(const builder *w, int32_t u, const double *a, int32_t l, const double *b, rg_end_row *row)
{
    row->i = row->j = -1;
    for (int k = 0; k < 3; k++) {
        if (fabs(a[k] - 1) < NOTHING) row->i = w->corner[u][k], row->j = l;
        else if (fabs(b[k] - 1) < NOTHING) row->i = w->corner[l][k], row->j = u;
    }
    if (row->i >= 0) return;
    const int32_t e = edge_of(w, u, a), f = edge_of(w, l, b);
    if (e < 0 || f < 0) return;
    row->edges = 1;
    row->i = e > f ? e : f, row->j = e > f ? f : e;
}

static rg_status layer_rows(builder *w, int32_t u, int32_t l)
{
    const shape s = common(&w->triangle[u], &w->triangle[l]);
    rg_status status = RG_OK;
    for (int i = 0; i < s.n && status == RG_OK; i++) {
        int again = 0;
        for (int k = 0; k < i; k++) again |= rg_vec2_length(rg_vec2_sub(s.x[i], s.x[k])) < ONE_CORNER;
        if (again || is_between(w, u, l, s.x[i])) continue;
        rg_end_row row = {.kind = RG_END_LAYER, .frame = l, .other = u};
        double a[3], b[3];
        weights_at(&w->triangle[u], s.x[i], a);
        weights_at(&w->triangle[l], s.x[i], b);
        set_pair(w, u, a, l, b, &row);
        for (int k = 0; k < 3; k++) add_term(&row, w->corner[u][k], a[k]);
        for (int k = 0; k < 3; k++) add_term(&row, w->corner[l][k], -b[k]);
        status = add_row(w, row, (rg_vec3){0, 0, 1});
    }
    return status;
}

/* f is a facet at v, or at the edge v ... v2. */
static int has(const builder *w, int32_t f, int32_t v, int32_t v2)
{
    int n = 0;
    for (int k = 0; k < 3; k++) n += w->corner[f][k] == v || w->corner[f][k] == v2;
    return n == (v == v2 ? 1 : 2);
}

/* At x, where v ... v2 of f meets u ... u2 of g: one that has neither of them lies between. */
static int third_between(const builder *w, int32_t f, const int32_t *v, int32_t g, const int32_t *u, rg_vec2 x)
{
    const int side = over(w, f, g);
    for (int32_t h = 0; side != 0 && h < w->m->nf; h++)
        if (over(w, f, h) == side && over(w, h, g) == side && !has(w, h, v[0], v[1]) && !(u && has(w, h, u[0], u[1])) &&
            covers(&w->triangle[h], x, INSIDE))
            return 1;
    return 0;
}

/* Which pairs lie behind a third facet. */
static void find_behind(builder *w)
{
    const rg_mesh *m = w->m;
    const rg_tree *t = &w->P->tree;
    rg_sides *sides = &w->e->sides;
    const rg_vec2 *x = w->e->x;
    for (int32_t v = 0; v < m->nv && !is_stopped(w); v++)
        for (int32_t g = 0; g < m->nf; g++) {
            unsigned char *flag = &sides->corner_behind[(size_t)v * (size_t)m->nf + (size_t)g];
            const int32_t both[2] = {v, v};
            for (int32_t k = t->corner_start[v]; k < t->corner_start[v + 1] && !*flag && !has(w, g, v, v); k++)
                *flag = (unsigned char)third_between(w, t->corner_facet[k], both, g, NULL, x[v]);
        }
    for (int32_t a = 0; a < m->ne && !is_stopped(w); a++)
        for (int32_t b = 0; b < a; b++) {
            const int32_t *v = m->edge[a], *u = m->edge[b];
            const double p = rg_vec2_turn(x[v[0]], x[v[1]], x[u[0]]), q = rg_vec2_turn(x[v[0]], x[v[1]], x[u[1]]);
            const double r = rg_vec2_turn(x[u[0]], x[u[1]], x[v[0]]), s = rg_vec2_turn(x[u[0]], x[u[1]], x[v[1]]);
            if (!(p * q < 0) || !(r * s < 0)) continue;
            const rg_vec2 at = towards(x[u[0]], x[u[1]], p / (p - q));
            unsigned char *flag = &sides->edge_behind[(size_t)a * (size_t)m->ne + (size_t)b];
            for (int k = 0; k < 4 && !*flag; k++) {
                const int32_t f = m->edge_facet[a][k / 2], g = m->edge_facet[b][k % 2];
                if (f >= 0 && g >= 0) *flag = (unsigned char)third_between(w, f, v, g, u, at);
            }
        }
}

static rg_status overlaps(builder *w)
{
    const int32_t nf = w->m->nf;
    signed char *to = w->e->sides.over;
    rg_status status = RG_OK;
    for (int32_t f = 0; f < nf; f++)
        for (int32_t g = 0; g < f; g++) {
            const int order = above(w, f, g);
            if (order == 0 || !boxes_meet(&w->triangle[f], &w->triangle[g])) continue;
            const shape s = common(&w->triangle[f], &w->triangle[g]);
            if (s.n < 3 || area(&s) < OVERLAP) continue;
            to[(size_t)f * (size_t)nf + (size_t)g] = (signed char)order;
            to[(size_t)g * (size_t)nf + (size_t)f] = (signed char)-order;
        }
    for (int32_t f = 0; f < nf && status == RG_OK && !is_stopped(w); f++)
        for (int32_t g = 0; g < nf && status == RG_OK; g++)
            if (over(w, f, g) > 0) status = layer_rows(w, f, g);
    return status;
}

static rg_vec2 middle(const shape *t)
{
    return (rg_vec2){(t->x[0].x + t->x[1].x + t->x[2].x) / 3, (t->x[0].y + t->x[1].y + t->x[2].y) / 3};
}

static void find_lines(builder *w)
{
    const rg_mesh *m = w->m;
    const rg_vec2 *x = w->e->x;
    for (int32_t e = 0; e < m->ne; e++) {
        line l = {.edge = e, .a = m->edge[e][0], .b = m->edge[e][1]};
        double side[2] = {0, 0};
        const rg_vec2 d = rg_vec2_sub(x[l.b], x[l.a]);
        l.length = rg_vec2_length(d);
        l.along = (rg_vec2){d.x / l.length, d.y / l.length};
        l.in = (rg_vec2){-l.along.y, l.along.x};
        for (int i = 0; i < 2; i++) {
            const int32_t f = m->edge_facet[e][i];
            if (f < 0) continue;
            side[l.facets] = rg_vec2_dot(l.in, rg_vec2_sub(middle(&w->triangle[f]), x[l.a]));
            l.facet[l.facets++] = f;
        }
        if (l.facets == 2 && side[0] * side[1] < 0) continue; /* stays flat */
        if (side[0] < 0) l.in = (rg_vec2){-l.in.x, -l.in.y};
        w->line[w->lines++] = l;
    }
}

/* One facet is over l's one facet and under its other. */
static int lies_in(const builder *w, int32_t f, const line *l)
{
    return l->facets == 2 && above(w, f, l->facet[0]) * above(w, f, l->facet[1]) == -1;
}

static int all_in(const builder *w, const line *inner, const line *outer)
{
    for (int32_t i = 0; i < inner->facets; i++)
        if (!lies_in(w, inner->facet[i], outer)) return 0;
    return 1;
}

/* Flags: 1, one of these facets is over f; 2, one is under it. */
static int sides_of(const builder *w, int32_t f, const int32_t *facet, int32_t n)
{
    int which = 0;
    for (int32_t i = 0; i < n; i++) which |= over(w, facet[i], f) > 0 ? 1 : over(w, facet[i], f) < 0 ? 2 : 0;
    return which;
}

/* Non-zero: at x, facets of the one are over those of the other, or a third one lies between: LAYER keeps them
 * apart. */
static int are_apart(const builder *w, const int32_t *one, int32_t n, const line *l, rg_vec2 x)
{
    for (int32_t i = 0; i < n; i++)
        for (int32_t k = 0; k < l->facets; k++)
            if (over(w, one[i], l->facet[k]) != 0) return 1;
    for (int32_t f = 0; f < w->m->nf; f++) {
        if (!covers(&w->triangle[f], x, ABOUT_INSIDE)) continue;
        const int mine = sides_of(w, f, one, n), its = sides_of(w, f, l->facet, l->facets);
        if (((mine & 1) && (its & 2)) || ((mine & 2) && (its & 1))) return 1;
    }
    return 0;
}

static void add_edge(rg_end_row *row, const line *l, double at, double weight)
{
    const double t = fmax(0, fmin(1, at / l->length));
    add_term(row, l->a, weight * (1 - t));
    add_term(row, l->b, weight * t);
}

/* Two edges on one line: K outside, the other inside; or each with its paper on its own side. */
static rg_status edge_rows(builder *w, const line *k, const line *l)
{
    const rg_vec2 *x = w->e->x;
    if (fabs(rg_vec2_cross(k->along, l->along)) > ONE_DIRECTION) return RG_OK;
    const rg_vec2 from = rg_vec2_sub(x[l->a], x[k->a]), to = rg_vec2_sub(x[l->b], x[k->a]);
    if (fabs(rg_vec2_dot(k->in, from)) > ON_LINE || fabs(rg_vec2_dot(k->in, to)) > ON_LINE) return RG_OK;
    const double p = rg_vec2_dot(k->along, from), q = rg_vec2_dot(k->along, to);
    const double low = fmax(0, fmin(p, q)), high = fmin(k->length, fmax(p, q));
    if (high - low < STRETCH) return RG_OK;
    rg_end_row row = {.frame = k->facet[0], .other = l->facet[0], .i = -1};
    double sign;
    if (rg_vec2_dot(k->in, l->in) < 0) {
        const rg_vec2 middle_of_both = towards(x[k->a], x[k->b], (low + high) / 2 / k->length);
        if (w->rules->more && are_apart(w, k->facet, k->facets, l, middle_of_both)) return RG_OK;
        row.kind = RG_END_BESIDE;
        sign = -1;
    } else {
        const int mine = all_in(w, k, l), its = all_in(w, l, k);
        if (mine == its) return RG_OK;
        row.kind = RG_END_INSIDE;
        sign = its ? 1 : -1;
    }
    rg_status status = RG_OK;
    for (int end = 0; end < 2 && status == RG_OK; end++) {
        const double at = end ? high : low;
        const rg_vec2 place = towards(x[k->a], x[k->b], at / k->length);
        row.terms = 0;
        add_edge(&row, l, rg_vec2_dot(l->along, rg_vec2_sub(place, x[l->a])), sign);
        add_edge(&row, k, at, -sign);
        status = add_row(w, row, (rg_vec3){k->in.x, k->in.y, 0});
    }
    return status;
}

/* What corner v on K asks: +1 inside, -1 round or beside; 0 nothing. */
static int corner_side(const builder *w, const line *k, int32_t v, double at, rg_end_kind *kind)
{
    const rg_tree *t = &w->P->tree;
    const int32_t *facet = t->corner_facet + t->corner_start[v], n = t->corner_start[v + 1] - t->corner_start[v];
    *kind = RG_END_INSIDE;
    for (int32_t i = 0; i < n; i++)
        if (lies_in(w, facet[i], k)) return 1;
    if (at < ON_LINE || at > k->length - ON_LINE) return 0;
    int near = 0, over_both = 0, under_both = 0, mine = 0;
    for (int32_t i = 0; i < n; i++) {
        double in = 0;
        for (int j = 0; j < 3; j++)
            in = fmax(in, rg_vec2_dot(k->in, rg_vec2_sub(w->triangle[facet[i]].x[j], w->e->x[v])));
        if (in > ON_LINE) {
            int up = 1, down = 1;
            near = 1;
            for (int32_t j = 0; j < k->facets; j++) {
                up &= above(w, facet[i], k->facet[j]) > 0;
                down &= above(w, facet[i], k->facet[j]) < 0;
            }
            over_both |= up, under_both |= down;
        }
        for (int32_t j = 0; j < k->facets; j++) mine |= facet[i] == k->facet[j];
    }
    if (!w->rules->more || k->facets != 2) return 0;
    if (over_both && under_both) return -1;
    *kind = RG_END_BESIDE;
    return !near && !mine && !are_apart(w, facet, n, k, w->e->x[v]) ? -1 : 0;
}

static rg_status corner_rows(builder *w, const line *k)
{
    const rg_vec2 *x = w->e->x;
    rg_status status = RG_OK;
    for (int32_t v = 0; v < w->m->nv && status == RG_OK; v++) {
        if (v == k->a || v == k->b) continue;
        const rg_vec2 d = rg_vec2_sub(x[v], x[k->a]);
        const double at = rg_vec2_dot(k->along, d);
        if (fabs(rg_vec2_dot(k->in, d)) > ON_LINE || at < -ON_LINE || at > k->length + ON_LINE) continue;
        rg_end_row row = {.frame = k->facet[0], .other = w->P->own[v], .i = -1};
        const int side = corner_side(w, k, v, at, &row.kind);
        if (side == 0) continue;
        add_term(&row, v, side);
        add_edge(&row, k, at, -side);
        status = add_row(w, row, (rg_vec3){k->in.x, k->in.y, 0});
    }
    return status;
}

static rg_status in_plane(builder *w)
{
    rg_status status = RG_OK;
    for (int32_t i = 0; i < w->lines && status == RG_OK && !is_stopped(w); i++)
        for (int32_t k = 0; k < i && status == RG_OK; k++) status = edge_rows(w, &w->line[i], &w->line[k]);
    for (int32_t i = 0; i < w->lines && status == RG_OK; i++) status = corner_rows(w, &w->line[i]);
    return status;
}

static void lay_out(builder *w)
{
    rg_end *e = w->e;
    const rg_mesh *m = w->m;
    for (int32_t v = 0; v < m->nv; v++) e->x[v] = (rg_vec2){w->P->p[v].x, w->P->p[v].y};
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t *v = m->facet_vertex + m->facet_start[f];
        const int up = w->P->place[f].R.c[2].z > 0;
        e->sides.up[f] = up ? 1 : -1;
        w->corner[f][0] = v[0];
        w->corner[f][1] = v[up ? 1 : 2];
        w->corner[f][2] = v[up ? 2 : 1];
        w->triangle[f].n = 3;
        for (int k = 0; k < 3; k++) w->triangle[f].x[k] = e->x[w->corner[f][k]];
    }
}

rg_status rg_end_init(rg_end *e, const rg_memory *mem, rg_linkage *P, const double *z, const rg_end_rules *rules,
                      const rg_end_order *order)
{
    const rg_mesh *m = P->mesh;
    builder w = {.e = e, .P = P, .m = m, .rules = rules, .order = order};
    memset(e, 0, sizeof *e);
    e->mem = *mem;
    e->keep = rules->keep;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(e->z, (size_t)P->n), RG_ARRAY(e->x, (size_t)m->nv),
                                RG_ARRAY(w.triangle, (size_t)m->nf), RG_ARRAY(w.corner, (size_t)m->nf),
                                RG_ARRAY(w.line, (size_t)m->ne));
    if (s == RG_OK) s = rg_sides_init(&e->sides, mem, m);
    if (s == RG_OK) {
        memcpy(e->z, z, (size_t)P->n * sizeof *z);
        rg_linkage_put(P, e->z);
        lay_out(&w);
        s = overlaps(&w);
    }
    if (s == RG_OK) {
        find_lines(&w);
        s = in_plane(&w);
        find_behind(&w);
        rg_sides_finish(&e->sides, e->x, order->stop);
    }
    RG_MEM_FREE(mem, w.triangle, w.corner, w.line);
    return s;
}

void rg_end_free(rg_end *e)
{
    if (!e->mem.resize) return;
    rg_sides_free(&e->sides);
    RG_MEM_FREE(&e->mem, e->z, e->row, e->x);
    memset(e, 0, sizeof *e);
}

/* How far the places are from each other that a row is of, squared. */
static double apart_squared(const rg_end_row *row, const rg_linkage *P)
{
    rg_vec3 d = {0, 0, 0};
    for (int32_t i = 0; i < row->terms; i++) d = rg_vec3_axpy(row->weight[i], P->p[row->v[i]], d);
    return rg_vec3_dot(d, d);
}

/* The cosine between the normals of a row's two facets. */
static double facing(const rg_end_row *row, const rg_linkage *P)
{
    return rg_vec3_dot(P->place[row->frame].R.c[2], P->place[row->other].R.c[2]);
}

int rg_end_is_live(const rg_end_row *row, const rg_linkage *P)
{
    const double length = sqrt(apart_squared(row, P));
    if (row->kind == RG_END_INSIDE) return length < LIVES_INSIDE;
    return length < LIVES && fabs(facing(row, P)) > LIVES_FACING;
}

/* Two rows of the same two facets. */
static int is_of_same(const rg_end_row *a, const rg_end_row *b)
{
    return a->kind == b->kind && a->frame == b->frame && a->other == b->other;
}

/* Rows are of places of the paper, which slide on each other. One that slid on a slope went up or down by that, which
 * does not say what is over it. */
int rg_end_is_upset(const rg_end *e, const rg_linkage *P)
{
    for (int32_t k = 0; k < e->count;) { /* rows of two facets follow each other */
        const rg_end_row *first = &e->row[k];
        double low = INFINITY, high = -INFINITY, slid = 0;
        for (; k < e->count && is_of_same(&e->row[k], first); k++) {
            const double gap = rg_end_gap(&e->row[k], P->place, P->p);
            low = fmin(low, gap), high = fmax(high, gap);
            slid = fmax(slid, sqrt(fmax(0, apart_squared(&e->row[k], P) - gap * gap)));
        }
        const double alike = fabs(facing(first, P)), by_slope = slid * sqrt(fmax(0, 1 - alike * alike));
        if (first->kind == RG_END_LAYER && low < -SHOWN - by_slope && high <= SHOWN && alike >= ALIKE) return 1;
    }
    return 0;
}

rg_vec3 rg_end_normal(const rg_end_row *row, const rg_place *place)
{
    return rg_mat3_mul_vec(place[row->frame].R, row->n);
}

double rg_end_gap(const rg_end_row *row, const rg_place *place, const rg_vec3 *p)
{
    const rg_vec3 n = rg_end_normal(row, place);
    double sum = 0;
    for (int32_t i = 0; i < row->terms; i++) sum += row->weight[i] * rg_vec3_dot(n, p[row->v[i]]);
    return sum;
}
