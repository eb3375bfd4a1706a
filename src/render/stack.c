#include "render/stack.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* Points of the grid over the whole sheet. */
#define POINTS 40000.0
#define POINTS_A_FACET 16.0
/* Facets that only touch do not overlap: a point counts when it is that far inside, in parts of the grid's spacing. */
#define INSET 0.1
/* Heights that differ by less, in parts of the sheet's size, are the same; then the facet's number decides. */
#define SAME_HEIGHT 1e-7

typedef struct axes { rg_vec3 base, u, v, up; } axes; /* of a plane */

rg_status rg_stack_init(rg_stack *s, const rg_memory *mem, const rg_mesh *m, const rg_triangles *t)
{
    const size_t nf = (size_t)m->nf;
    *s = (rg_stack){.mem = *mem, .mesh = m, .triangles = t};
    double area = 0;
    for (int32_t i = 0; i < t->start[m->nf]; i++)
        area += 0.5 * rg_vec2_turn(m->X[t->v[i][0]], m->X[t->v[i][1]], m->X[t->v[i][2]]);
    s->spacing = sqrt(area / (POINTS + POINTS_A_FACET * m->nf));
    int32_t **array[] = {&s->below, &s->start, &s->queue, &s->count};
    for (int i = 0; i < 4; i++)
        if (!(*array[i] = rg_mem_array(mem, nf + 1, sizeof **array[i]))) return RG_ENOMEM;
    s->height = rg_mem_array(mem, nf, sizeof *s->height);
    return s->height ? RG_OK : RG_ENOMEM;
}

void rg_stack_free(rg_stack *s)
{
    if (!s->mem.resize) return;
    void *block[] = {s->sample, s->pair, s->below, s->start, s->upper, s->queue, s->height, s->count};
    for (int i = 0; i < 8; i++) rg_mem_free(&s->mem, block[i]);
    memset(s, 0, sizeof *s);
}

static axes axes_of(rg_vec3 base, rg_vec3 up)
{
    const rg_vec3 off = fabs(up.x) < 0.6 ? (rg_vec3){1, 0, 0} : (rg_vec3){0, 1, 0};
    rg_vec3 u = rg_vec3_cross(off, up);
    u = rg_vec3_scale(1 / rg_vec3_length(u), u);
    return (axes){base, u, rg_vec3_cross(up, u), up};
}

/* Columns first ... last are the grid points of a row that are inside of triangle p, p counter-clockwise. */
static void span(const rg_vec2 p[3], double v, double spacing, double *first, double *last)
{
    *first = -INFINITY, *last = INFINITY;
    for (int i = 0; i < 3; i++) {
        const rg_vec2 a = p[i], d = rg_vec2_sub(p[(i + 1) % 3], a);
        /* inside: d.x (v - a.y) - d.y (u - a.x) >= inset |d| */
        const double rest = d.x * (v - a.y) - INSET * spacing * rg_vec2_length(d);
        if (d.y > 0) *last = fmin(*last, a.x + rest / d.y);
        else if (d.y < 0) *first = fmax(*first, a.x + rest / d.y);
        else if (!(rest >= 0)) *last = -INFINITY;
    }
    *first = ceil(*first / spacing), *last = floor(*last / spacing);
}

static rg_status add_triangle(rg_stack *s, int32_t f, const rg_vec2 p[3])
{
    const double low = fmin(p[0].y, fmin(p[1].y, p[2].y)), high = fmax(p[0].y, fmax(p[1].y, p[2].y));
    for (double row = ceil(low / s->spacing); row <= floor(high / s->spacing); row++) {
        double first, last;
        span(p, row * s->spacing, s->spacing, &first, &last);
        if (!(last >= first)) continue;
        const size_t need = (size_t)s->samples + (size_t)(last - first) + 1;
        if (need > INT32_MAX) return RG_ENOMEM;
        const rg_status ok = rg_mem_grow(&s->mem, (void **)&s->sample, &s->sample_room, need, sizeof *s->sample);
        if (ok != RG_OK) return ok;
        for (double column = first; column <= last; column++)
            s->sample[s->samples++] = (rg_stack_sample){(int32_t)row, (int32_t)column, f, 0};
    }
    return RG_OK;
}

static rg_status add_facet(rg_stack *s, int32_t f, const axes *A, const rg_vec3 *x)
{
    const rg_triangles *t = s->triangles;
    rg_status ok = RG_OK;
    for (int32_t i = t->start[f]; ok == RG_OK && i < t->start[f + 1]; i++) {
        rg_vec2 p[3];
        for (int k = 0; k < 3; k++) {
            const rg_vec3 d = rg_vec3_sub(x[t->v[i][k]], A->base);
            p[k] = (rg_vec2){rg_vec3_dot(A->u, d), rg_vec3_dot(A->v, d)};
        }
        if (rg_vec2_turn(p[0], p[1], p[2]) < 0) {
            const rg_vec2 swap = p[1];
            p[1] = p[2], p[2] = swap;
        }
        ok = add_triangle(s, f, p);
    }
    return ok;
}

static int by_point(const void *a, const void *b)
{
    const rg_stack_sample *p = a, *q = b;
    if (p->row != q->row) return p->row < q->row ? -1 : 1;
    if (p->column != q->column) return p->column < q->column ? -1 : 1;
    return p->facet < q->facet ? -1 : p->facet > q->facet;
}

static int by_height(const void *a, const void *b)
{
    const rg_stack_sample *p = a, *q = b;
    if (p->height != q->height) return p->height < q->height ? -1 : 1;
    return p->facet < q->facet ? -1 : p->facet > q->facet;
}

/* One pile: the same point of the plane on every facet over it, followed back to where these were apart, and compared
 * along the direction that was up for them in the mean. */
static rg_status sort_pile(rg_stack *s, rg_stack_sample *pile, int32_t n, const axes *A, const rg_vec3 *x,
                           const rg_place *back)
{
    const rg_mesh *m = s->mesh;
    rg_vec3 up = {0, 0, 0};
    for (int32_t i = 0; i < n; i++) up = rg_vec3_add(up, rg_mat3_mul_vec(back[pile[i].facet].R, A->up));
    const double length = rg_vec3_length(up), cell = SAME_HEIGHT * m->size;
    up = length > SAME_HEIGHT ? rg_vec3_scale(1 / length, up) : A->up;
    const rg_vec3 at = rg_vec3_axpy(pile->column * s->spacing, A->u,
                                    rg_vec3_axpy(pile->row * s->spacing, A->v, A->base));
    for (int32_t i = 0; i < n; i++) {
        const int32_t f = pile[i].facet;
        const double off = rg_vec3_dot(A->up, rg_vec3_sub(x[m->facet_vertex[m->facet_start[f]]], at));
        const rg_vec3 was = rg_vec3_add(rg_mat3_mul_vec(back[f].R, rg_vec3_axpy(off, A->up, at)), back[f].t);
        pile[i].height = floor(rg_vec3_dot(up, was) / cell + 0.5);
        s->height[f] += rg_vec3_dot(A->up, was);
        s->count[f]++;
    }
    qsort(pile, (size_t)n, sizeof *pile, by_height);
    const size_t need = (size_t)s->pairs + (size_t)n;
    const rg_status ok = rg_mem_grow(&s->mem, (void **)&s->pair, &s->pair_room, need, sizeof *s->pair);
    for (int32_t i = 0; ok == RG_OK && i + 1 < n; i++) {
        const int32_t a = pile[i].facet, b = pile[i + 1].facet;
        if (a != b) s->pair[s->pairs++] = a < b ? (rg_stack_pair){a, b, 1} : (rg_stack_pair){b, a, -1};
    }
    return ok;
}

static rg_status compare(rg_stack *s, const axes *A, const rg_vec3 *x, const rg_place *back)
{
    rg_status ok = RG_OK;
    if (s->samples > 0) qsort(s->sample, (size_t)s->samples, sizeof *s->sample, by_point);
    for (int32_t i = 0, j; ok == RG_OK && i < s->samples; i = j) {
        for (j = i + 1; j < s->samples && s->sample[j].row == s->sample[i].row
                        && s->sample[j].column == s->sample[i].column; j++) continue;
        if (j - i > 1) ok = sort_pile(s, s->sample + i, j - i, A, x, back);
    }
    return ok;
}

static int by_ends(const void *a, const void *b)
{
    const rg_stack_pair *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/* Each two facets once, on top the one that most points say is on top. */
static void settle_pairs(rg_stack *s)
{
    int32_t kept = 0;
    if (s->pairs > 0) qsort(s->pair, (size_t)s->pairs, sizeof *s->pair, by_ends);
    for (int32_t i = 0, j; i < s->pairs; i = j) {
        rg_stack_pair p = s->pair[i];
        for (j = i + 1; j < s->pairs && by_ends(&s->pair[i], &s->pair[j]) == 0; j++) p.above += s->pair[j].above;
        s->pair[kept++] = p;
    }
    s->pairs = kept;
}

static rg_status link_pairs(rg_stack *s, const int32_t *facet, int32_t n)
{
    const rg_status ok = rg_mem_grow(&s->mem, (void **)&s->upper, &s->upper_room, (size_t)s->pairs, sizeof *s->upper);
    if (ok != RG_OK) return ok;
    for (int32_t i = 0; i < n; i++) s->below[facet[i]] = 0;
    memset(s->start, 0, ((size_t)s->mesh->nf + 1) * sizeof *s->start);
    for (int32_t i = 0; i < s->pairs; i++) s->start[s->pair[i].above >= 0 ? s->pair[i].a : s->pair[i].b]++;
    for (int32_t f = 0, at = 0; f <= s->mesh->nf; f++) at += s->start[f], s->start[f] = at;
    for (int32_t i = s->pairs - 1; i >= 0; i--) {
        const rg_stack_pair *p = &s->pair[i];
        const int32_t low = p->above >= 0 ? p->a : p->b, high = p->above >= 0 ? p->b : p->a;
        s->upper[--s->start[low]] = high;
        s->below[high]++;
    }
    return RG_OK;
}

/* The facet without a level that lay lowest. */
static int32_t lowest(const rg_stack *s, const int32_t *facet, int32_t n)
{
    int32_t best = -1;
    for (int32_t i = 0; i < n; i++)
        if (s->below[facet[i]] > 0 && (best < 0 || s->height[facet[i]] < s->height[best])) best = facet[i];
    return best;
}

/* Level by level from the bottom: a facet's turn comes when all right under it have had theirs. */
static void climb(rg_stack *s, const int32_t *facet, int32_t n, int32_t *level, int32_t *levels)
{
    int32_t head = 0, tail = 0, top = 0;
    for (int32_t i = 0; i < n; i++) {
        level[facet[i]] = 0;
        if (s->below[facet[i]] == 0) s->queue[tail++] = facet[i];
    }
    for (; head < n; head++) {
        if (head == tail) {
            const int32_t f = lowest(s, facet, n);
            s->below[f] = 0;
            s->queue[tail++] = f;
        }
        const int32_t f = s->queue[head];
        if (level[f] > top) top = level[f];
        for (int32_t i = s->start[f]; i < s->start[f + 1]; i++) {
            const int32_t u = s->upper[i];
            if (s->below[u] == 0) continue; /* has had its turn where a circle was cut */
            if (level[u] <= level[f]) level[u] = level[f] + 1;
            if (--s->below[u] == 0) s->queue[tail++] = u;
        }
    }
    *levels = top + 1;
}

rg_status rg_stack_order(rg_stack *s, const int32_t *facet, int32_t n, rg_vec3 base, rg_vec3 up, const rg_vec3 *x,
                         const rg_place *back, int32_t *level, int32_t *levels)
{
    const axes A = axes_of(base, up);
    rg_status ok = RG_OK;
    s->samples = s->pairs = 0;
    for (int32_t i = 0; i < n; i++) s->height[facet[i]] = 0, s->count[facet[i]] = 0;
    for (int32_t i = 0; ok == RG_OK && i < n; i++) ok = add_facet(s, facet[i], &A, x);
    if (ok == RG_OK) ok = compare(s, &A, x, back);
    if (ok == RG_OK) settle_pairs(s);
    if (ok == RG_OK) ok = link_pairs(s, facet, n);
    if (ok != RG_OK) return ok;
    for (int32_t i = 0; i < n; i++)
        if (s->count[facet[i]] > 0) s->height[facet[i]] /= s->count[facet[i]];
    climb(s, facet, n, level, levels);
    return RG_OK;
}
