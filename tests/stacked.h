/* stacked.h -- is an order of facets one that paper can have? By samples: piles of facets over points, and what joins the piles on
 * both sides of a crease. Shares nothing with src/layers. Include after cmocka.h and near.h.
 *
 * Facets are put in the plane by lengths along and across the crease that they are reached over. */
#ifndef STACKED_H
#define STACKED_H

#include "mesh/mesh.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_PILE = 600 };

typedef struct stacked {
    const rg_mesh *m;
    const double *angle;     /* [N] 0 or +-pi */
    rg_vec2 **x;             /* [nf] corners as they lie */
    int *flipped;            /* [nf] its back is up */
    const char *only;        /* [nf] non-zero: the facets that are there; NULL: all */
    int points;              /* piles looked at, over points and beside creases */
    int32_t wrong[4];        /* facets of the first thing that is wrong */
    const char *what;
} stacked;

/* +1: g lies above f, -1: below; 0: not known, which is wrong where they overlap. */
typedef int (*stacked_order)(const void *ctx, int32_t f, int32_t g);

/* The corners of facet g over edge e of facet f, of which it is the mirror image or goes on. */
static inline void stacked_place(stacked *s, int32_t f, int32_t g, int32_t e, int folds)
{
    const rg_mesh *m = s->m;
    const int32_t *v = m->edge[e];
    rg_vec2 p[2] = {{0, 0}, {0, 0}};
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
        for (int k = 0; k < 2; k++)
            if (m->facet_vertex[j] == v[k]) p[k] = s->x[f][j - m->facet_start[f]];
    const rg_vec2 flat = rg_vec2_sub(m->X[v[1]], m->X[v[0]]), now = rg_vec2_sub(p[1], p[0]);
    const double n = rg_vec2_dot(flat, flat);
    s->flipped[g] = folds ? !s->flipped[f] : s->flipped[f];
    const double side = s->flipped[g] ? -1 : 1;
    for (int32_t j = m->facet_start[g]; j < m->facet_start[g + 1]; j++) {
        const rg_vec2 r = rg_vec2_sub(m->X[m->facet_vertex[j]], m->X[v[0]]);
        const double along = rg_vec2_dot(r, flat) / n, across = side * rg_vec2_cross(flat, r) / n;
        s->x[g][j - m->facet_start[g]] = (rg_vec2){p[0].x + along * now.x - across * now.y, p[0].y + along * now.y + across * now.x};
    }
}

static inline void stacked_init(stacked *s, const rg_mesh *m, const double *angle)
{
    *s = (stacked){.m = m, .angle = angle};
    int *seen = calloc((size_t)m->nf, sizeof *seen);
    int32_t *queue = calloc((size_t)m->nf, sizeof *queue), n = 1;
    s->x = calloc((size_t)m->nf, sizeof *s->x);
    s->flipped = calloc((size_t)m->nf, sizeof *s->flipped);
    assert_true(seen && queue && s->x && s->flipped);
    for (int32_t f = 0; f < m->nf; f++) s->x[f] = calloc((size_t)(m->facet_start[f + 1] - m->facet_start[f]), sizeof **s->x);
    for (int32_t j = 0; j < m->facet_start[1]; j++) s->x[0][j] = m->X[m->facet_vertex[j]];
    seen[0] = 1;
    for (int32_t i = 0; i < n; i++)
        for (int32_t j = m->facet_start[queue[i]]; j < m->facet_start[queue[i] + 1]; j++) {
            const int32_t e = m->facet_edge[j], g = m->edge_facet[e][m->edge_facet[e][0] == queue[i]];
            if (g < 0 || seen[g]) continue;
            stacked_place(s, queue[i], g, e, angle[m->edge_crease[e]] != 0);
            seen[g] = 1;
            queue[n++] = g;
        }
    free(seen);
    free(queue);
}

static inline void stacked_free(stacked *s)
{
    for (int32_t f = 0; f < s->m->nf; f++) free(s->x[f]);
    free(s->x);
    free(s->flipped);
}

/* How far inside facet f the point is; negative: outside. By the winding of its corners. */
static inline double stacked_inside(const stacked *s, int32_t f, rg_vec2 p)
{
    const int32_t n = s->m->facet_start[f + 1] - s->m->facet_start[f];
    double turn = 0, near_by = INFINITY;
    for (int32_t i = 0; i < n; i++) {
        const rg_vec2 a = rg_vec2_sub(s->x[f][i], p), b = rg_vec2_sub(s->x[f][(i + 1) % n], p), d = rg_vec2_sub(b, a);
        const double t = fmin(1, fmax(0, -rg_vec2_dot(a, d) / rg_vec2_dot(d, d)));
        turn += atan2(rg_vec2_cross(a, b), rg_vec2_dot(a, b));
        near_by = fmin(near_by, hypot(a.x + t * d.x, a.y + t * d.y));
    }
    return fabs(turn) > RG_PI ? near_by : -near_by;
}

static inline int stacked_has(const stacked *s, int32_t f) { return f >= 0 && (!s->only || s->only[f]); }

/* Facets over p, and the least distance of any border from it. */
static inline int stacked_pile(const stacked *s, rg_vec2 p, int32_t *pile, double *clear)
{
    int n = 0;
    for (int32_t f = 0; f < s->m->nf; f++) {
        const double in = stacked_inside(s, f, p);
        *clear = fmin(*clear, fabs(in));
        if (in > 0 && stacked_has(s, f)) {
            assert_true(n < MOST_PILE);
            pile[n++] = f;
        }
    }
    return n;
}

static inline int stacked_wrong(stacked *s, const char *what, int32_t a, int32_t b, int32_t c, int32_t d)
{
    s->what = what;
    s->wrong[0] = a, s->wrong[1] = b, s->wrong[2] = c, s->wrong[3] = d;
    return 0;
}

/* A pile has one order from bottom to top: how many lie below each are 0, 1, 2, ... in some order. */
static inline int stacked_is_pile(stacked *s, stacked_order order, const void *ctx, const int32_t *pile, int n, int *rank)
{
    char taken[MOST_PILE] = {0};
    s->points++;
    for (int i = 0; i < n; i++) {
        rank[i] = 0;
        for (int j = 0; j < n; j++) {
            if (i == j) continue;
            const int o = order(ctx, pile[j], pile[i]);
            if (o == 0 || o != -order(ctx, pile[i], pile[j])) return stacked_wrong(s, "no order", pile[i], pile[j], -1, -1);
            rank[i] += o > 0;
        }
        if (taken[rank[i]]++) return stacked_wrong(s, "a circle", pile[i], -1, -1, -1);
    }
    return 1;
}

typedef struct stacked_join { int a, b; int32_t f, g; } stacked_join; /* ranks; left and right, or both on one side */

static inline int stacked_rank(const int32_t *pile, int n, const int *rank, int32_t f)
{
    for (int i = 0; i < n; i++)
        if (pile[i] == f) return rank[i];
    return -1;
}

/* Beside the point p of a crease: piles left and right of its line, and what joins them. 1 also where p is no good sample. */
static inline int stacked_at_crease(stacked *s, stacked_order order, const void *ctx, rg_vec2 p, rg_vec2 d, double off)
{
    static int32_t pile[2][MOST_PILE];
    static int rank[2][MOST_PILE];
    static stacked_join fold[2][MOST_PILE], through[MOST_PILE];
    const rg_mesh *m = s->m;
    int n[2], folds[2] = {0, 0}, throughs = 0;
    for (int side = 0; side < 2; side++) {
        const double k = side ? -off : off;
        double clear = INFINITY;
        n[side] = stacked_pile(s, (rg_vec2){p.x - k * d.y, p.y + k * d.x}, pile[side], &clear);
        if (clear < 0.9 * off) return 1; /* another border runs by */
        if (!stacked_is_pile(s, order, ctx, pile[side], n[side], rank[side])) return 0;
    }
    /* What is over both points and has no edge through p goes on; edges through p join what they join. */
    static char has_edge[20000];
    assert_true(m->nf < (int32_t)sizeof has_edge);
    memset(has_edge, 0, (size_t)m->nf);
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const int32_t size = m->facet_start[f + 1] - m->facet_start[f], i = j - m->facet_start[f];
            const rg_vec2 a = rg_vec2_sub(s->x[f][i], p), b = rg_vec2_sub(s->x[f][(i + 1) % size], p);
            const double length = rg_vec2_length(rg_vec2_sub(b, a));
            if (!(fabs(rg_vec2_cross(a, b)) < 0.1 * off * length && rg_vec2_dot(a, b) < 0)) continue;
            if (!stacked_has(s, f)) continue;
            has_edge[f] = 1;
            const int32_t e = m->facet_edge[j], g = m->edge_facet[e][m->edge_facet[e][0] == f];
            if (g < f || !stacked_has(s, g)) continue; /* the border, or seen from the other facet */
            if (s->angle[m->edge_crease[e]] != 0) {
                const int side = stacked_rank(pile[1], n[1], rank[1], f) >= 0;
                const int ra = stacked_rank(pile[side], n[side], rank[side], f), rb = stacked_rank(pile[side], n[side], rank[side], g);
                if (ra < 0 || rb < 0) return stacked_wrong(s, "a fold does not lie where it should", f, g, -1, -1);
                fold[side][folds[side]++] = (stacked_join){ra < rb ? ra : rb, ra < rb ? rb : ra, f, g};
            } else {
                const int first = stacked_rank(pile[0], n[0], rank[0], f) >= 0;
                through[throughs++] = (stacked_join){stacked_rank(pile[0], n[0], rank[0], first ? f : g),
                                                     stacked_rank(pile[1], n[1], rank[1], first ? g : f), f, g};
            }
        }
    for (int i = 0; i < n[0]; i++) {
        const int r = stacked_rank(pile[1], n[1], rank[1], pile[0][i]);
        if (r >= 0 && !has_edge[pile[0][i]]) through[throughs++] = (stacked_join){rank[0][i], r, pile[0][i], pile[0][i]};
    }
    for (int i = 0; i < throughs; i++)
        for (int j = 0; j < i; j++)
            if ((through[i].a < through[j].a) != (through[i].b < through[j].b))
                return stacked_wrong(s, "sheets cross", through[i].f, through[i].g, through[j].f, through[j].g);
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < folds[side]; i++) {
            const stacked_join *q = &fold[side][i];
            for (int j = 0; j < throughs; j++) {
                const int at = side ? through[j].b : through[j].a;
                if (q->a < at && at < q->b) return stacked_wrong(s, "a sheet runs through a fold", q->f, q->g, through[j].f, through[j].g);
            }
            for (int j = 0; j < i; j++) {
                const stacked_join *r = &fold[side][j];
                const int low = q->a < r->a && r->a < q->b, high = q->a < r->b && r->b < q->b;
                if (low != high) return stacked_wrong(s, "folds cross", q->f, q->g, r->f, r->g);
            }
        }
    return 1;
}

/* Whether all samples are well: `points` over the whole, and `per_crease` on each edge; off: how far beside creases is looked. */
static inline int stacked_is_valid(stacked *s, stacked_order order, const void *ctx, int points, int per_crease, double off, unsigned seed)
{
    static int32_t pile[MOST_PILE];
    static int rank[MOST_PILE];
    const rg_mesh *m = s->m;
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t i = 0; i < m->facet_start[f + 1] - m->facet_start[f]; i++) {
            low = (rg_vec2){fmin(low.x, s->x[f][i].x), fmin(low.y, s->x[f][i].y)};
            high = (rg_vec2){fmax(high.x, s->x[f][i].x), fmax(high.y, s->x[f][i].y)};
        }
    for (int k = 0; k < points; k++) {
        const double u = (noise(&seed) + 1) / 2, v = (noise(&seed) + 1) / 2;
        double clear = INFINITY;
        const int n = stacked_pile(s, (rg_vec2){low.x + u * (high.x - low.x), low.y + v * (high.y - low.y)}, pile, &clear);
        if (clear > 0.5 * off && !stacked_is_pile(s, order, ctx, pile, n, rank)) return 0;
    }
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t f = m->edge_facet[e][0], g = m->edge_facet[e][1], c = m->edge_crease[e];
        if (!stacked_has(s, f) || !stacked_has(s, g)) continue;
        /* A valley puts the next facet on the front. */
        if (s->angle[c] != 0 && order(ctx, f, g) != ((s->angle[c] > 0) == !s->flipped[f] ? 1 : -1))
            return stacked_wrong(s, "mountain for valley", f, g, -1, -1);
        const int32_t n = m->facet_start[f + 1] - m->facet_start[f];
        for (int32_t i = 0; i < n; i++) {
            if (m->facet_edge[m->facet_start[f] + i] != e) continue;
            const rg_vec2 a = s->x[f][i], d = rg_vec2_sub(s->x[f][(i + 1) % n], a);
            const double length = rg_vec2_length(d);
            for (int k = 0; k < per_crease; k++) {
                const double t = (noise(&seed) + 1) / 2;
                if (!stacked_at_crease(s, order, ctx, (rg_vec2){a.x + t * d.x, a.y + t * d.y}, (rg_vec2){d.x / length, d.y / length}, off))
                    return 0;
            }
        }
    }
    return 1;
}

#endif
