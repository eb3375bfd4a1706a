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
    return RG_MEM_ARRAYS(mem, RG_ARRAY(s->below, nf + 1), RG_ARRAY(s->rank, nf + 1), RG_ARRAY(s->start, nf + 1),
                         RG_ARRAY(s->queue, nf + 1), RG_ARRAY(s->count, nf + 1), RG_ARRAY(s->height, nf));
}

void rg_stack_free(rg_stack *s)
{
    if (!s->mem.resize) return;
    RG_MEM_FREE(&s->mem, s->sample, s->sorted, s->place, s->pair, s->below, s->rank, s->start, s->upper, s->queue,
                s->height, s->count);
    memset(s, 0, sizeof *s);
}

static axes axes_of(rg_vec3 base, rg_vec3 up)
{
    const rg_vec3 off = fabs(up.x) < 0.6 ? (rg_vec3){1, 0, 0} : (rg_vec3){0, 1, 0};
    rg_vec3 u = rg_vec3_cross(off, up);
    u = rg_vec3_scale(1 / rg_vec3_length(u), u);
    return (axes){base, u, rg_vec3_cross(up, u), up};
}

typedef struct side { rg_vec2 from, d; double inset; } side; /* of a triangle that is counter-clockwise */

/* Columns first ... last are the grid points of a row that are inside of all three. */
static void span(const side e[3], double v, double spacing, double *first, double *last)
{
    *first = -INFINITY, *last = INFINITY;
    for (int i = 0; i < 3; i++) {
        /* inside: d.x (v - from.y) - d.y (u - from.x) >= inset */
        const double rest = e[i].d.x * (v - e[i].from.y) - e[i].inset;
        if (e[i].d.y > 0) *last = fmin(*last, e[i].from.x + rest / e[i].d.y);
        else if (e[i].d.y < 0) *first = fmax(*first, e[i].from.x + rest / e[i].d.y);
        else if (!(rest >= 0)) *last = -INFINITY;
    }
    *first = ceil(*first / spacing), *last = floor(*last / spacing);
}

static rg_status add_triangle(rg_stack *s, int32_t f, const rg_vec2 p[3])
{
    const double low = fmin(p[0].y, fmin(p[1].y, p[2].y)), high = fmax(p[0].y, fmax(p[1].y, p[2].y));
    side e[3];
    for (int i = 0; i < 3; i++) {
        const rg_vec2 d = rg_vec2_sub(p[(i + 1) % 3], p[i]);
        e[i] = (side){p[i], d, INSET * s->spacing * rg_vec2_length(d)};
    }
    for (double row = ceil(low / s->spacing); row <= floor(high / s->spacing); row++) {
        double first, last;
        span(e, row * s->spacing, s->spacing, &first, &last);
        if (!(last >= first) || !isfinite(last - first)) continue; /* three corners in one point bound nothing */
        const size_t need = (size_t)s->samples + (size_t)(last - first) + 1;
        if (need > INT32_MAX) return RG_ENOMEM;
        const rg_status ok = RG_MEM_GROW(&s->mem, s->sample, s->sample_room, need);
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

/* By column or by row, those of the same one in the order that they were in. */
static rg_status sort_along(rg_stack *s, int rows)
{
    int32_t low = INT32_MAX, high = INT32_MIN;
    for (int32_t i = 0; i < s->samples; i++) {
        const int32_t at = rows ? s->sample[i].row : s->sample[i].column;
        if (at < low) low = at;
        if (at > high) high = at;
    }
    const size_t lines = (size_t)((int64_t)high - low) + 1;
    rg_status ok = RG_MEM_GROW(&s->mem, s->place, s->place_room, lines + 1);
    if (ok == RG_OK) ok = RG_MEM_GROW(&s->mem, s->sorted, s->sorted_room, s->sample_room);
    if (ok != RG_OK) return ok;
    memset(s->place, 0, (lines + 1) * sizeof *s->place);
    for (int32_t i = 0; i < s->samples; i++) s->place[(rows ? s->sample[i].row : s->sample[i].column) - low + 1]++;
    for (size_t k = 0; k < lines; k++) s->place[k + 1] += s->place[k];
    for (int32_t i = 0; i < s->samples; i++)
        s->sorted[s->place[(rows ? s->sample[i].row : s->sample[i].column) - low]++] = s->sample[i];
    rg_stack_sample *swap = s->sample;
    const size_t room = s->sample_room;
    s->sample = s->sorted, s->sample_room = s->sorted_room;
    s->sorted = swap, s->sorted_room = room;
    return RG_OK;
}

/* By point, and there by facet, as they were made. */
static rg_status sort_by_point(rg_stack *s)
{
    if (s->samples == 0) return RG_OK;
    const rg_status ok = sort_along(s, 0);
    return ok == RG_OK ? sort_along(s, 1) : ok;
}

static int by_height(const void *a, const void *b)
{
    const rg_stack_sample *p = a, *q = b;
    if (p->height != q->height) return p->height < q->height ? -1 : 1;
    return p->facet < q->facet ? -1 : p->facet > q->facet;
}

/* A pile is all samples of a point. How high they lay: that point of every facet over it, followed back to where these
 * were apart, and compared along the direction that was up for them in the mean. */
static void measure_pile(rg_stack *s, rg_stack_sample *pile, int32_t n, const axes *A, const rg_vec3 *x,
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
}

/* Sorts a pile, lowest first, and notes who lies right above whom. */
static rg_status pair_up(rg_stack *s, rg_stack_sample *pile, int32_t n)
{
    const size_t need = (size_t)s->pairs + (size_t)n;
    const rg_status ok = RG_MEM_GROW(&s->mem, s->pair, s->pair_room, need);
    if (ok != RG_OK) return ok;
    qsort(pile, (size_t)n, sizeof *pile, by_height);
    for (int32_t i = 0; i + 1 < n; i++) {
        const int32_t a = pile[i].facet, b = pile[i + 1].facet;
        if (a != b) s->pair[s->pairs++] = a < b ? (rg_stack_pair){a, b, 1} : (rg_stack_pair){b, a, -1};
    }
    return RG_OK;
}

static int32_t pile_end(const rg_stack *s, int32_t i)
{
    int32_t j = i + 1;
    while (j < s->samples && s->sample[j].row == s->sample[i].row && s->sample[j].column == s->sample[i].column) j++;
    return j;
}

static rg_status compare(rg_stack *s, const int32_t *facet, int32_t n, const axes *A, const rg_vec3 *x,
                         const rg_place *back)
{
    rg_status ok = RG_OK;
    s->pairs = 0;
    for (int32_t i = 0; i < n; i++) s->height[facet[i]] = 0, s->count[facet[i]] = 0;
    for (int32_t i = 0, j; ok == RG_OK && i < s->samples; i = j) {
        j = pile_end(s, i);
        if (j - i < 2) continue;
        measure_pile(s, s->sample + i, j - i, A, x, back);
        ok = pair_up(s, s->sample + i, j - i);
    }
    for (int32_t i = 0; i < n; i++)
        if (s->count[facet[i]] > 0) s->height[facet[i]] /= s->count[facet[i]];
    return ok;
}

/* The same with heights that are the facets' own: in what order they had their turns. */
static rg_status compare_turns(rg_stack *s, int32_t n)
{
    rg_status ok = RG_OK;
    s->pairs = 0;
    for (int32_t i = 0; i < n; i++) s->height[s->queue[i]] = i;
    for (int32_t i = 0, j; ok == RG_OK && i < s->samples; i = j) {
        j = pile_end(s, i);
        for (int32_t k = i; k < j; k++) s->sample[k].height = s->height[s->sample[k].facet];
        if (j - i > 1) ok = pair_up(s, s->sample + i, j - i);
    }
    return ok;
}

static int by_ends(const void *a, const void *b)
{
    const rg_stack_pair *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/* Each two facets once, on top the one that most points say is on top. Returns whether all points agree. */
static int settle_pairs(rg_stack *s)
{
    int32_t kept = 0, agree = 1;
    if (s->pairs > 0) qsort(s->pair, (size_t)s->pairs, sizeof *s->pair, by_ends);
    for (int32_t i = 0, j; i < s->pairs; i = j) {
        rg_stack_pair p = s->pair[i];
        for (j = i + 1; j < s->pairs && by_ends(&s->pair[i], &s->pair[j]) == 0; j++) {
            agree &= s->pair[j].above == s->pair[i].above;
            p.above += s->pair[j].above;
        }
        s->pair[kept++] = p;
    }
    s->pairs = kept;
    return agree;
}

static int32_t lower(const rg_stack_pair *p) { return p->above >= 0 ? p->a : p->b; }

static rg_status link_pairs(rg_stack *s, const int32_t *facet, int32_t n)
{
    const rg_status ok = RG_MEM_GROW(&s->mem, s->upper, s->upper_room, (size_t)s->pairs);
    if (ok != RG_OK) return ok;
    for (int32_t i = 0; i < n; i++) s->below[facet[i]] = 0, s->rank[facet[i]] = i;
    memset(s->start, 0, ((size_t)n + 1) * sizeof *s->start);
    for (int32_t i = 0; i < s->pairs; i++) s->start[s->rank[lower(&s->pair[i])]]++;
    for (int32_t k = 0, at = 0; k <= n; k++) at += s->start[k], s->start[k] = at;
    for (int32_t i = s->pairs - 1; i >= 0; i--) {
        const rg_stack_pair *p = &s->pair[i];
        const int32_t low = lower(p), high = low == p->a ? p->b : p->a;
        s->upper[--s->start[s->rank[low]]] = high;
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

/* Level by level from the bottom: a facet's turn comes when all right under it have had theirs. Returns how many
 * circles were cut. */
static int32_t climb(rg_stack *s, const int32_t *facet, int32_t n, int32_t *level, int32_t *levels)
{
    int32_t head = 0, tail = 0, top = 0, cuts = 0;
    for (int32_t i = 0; i < n; i++) {
        level[facet[i]] = 0;
        if (s->below[facet[i]] == 0) s->queue[tail++] = facet[i];
    }
    for (; head < n; head++) {
        if (head == tail) {
            const int32_t f = lowest(s, facet, n);
            s->below[f] = 0;
            s->queue[tail++] = f;
            cuts++;
        }
        const int32_t f = s->queue[head];
        if (level[f] > top) top = level[f];
        for (int32_t i = s->start[s->rank[f]]; i < s->start[s->rank[f] + 1]; i++) {
            const int32_t u = s->upper[i];
            if (s->below[u] == 0) continue; /* has had its turn where a circle was cut */
            if (level[u] <= level[f]) level[u] = level[f] + 1;
            if (--s->below[u] == 0) s->queue[tail++] = u;
        }
    }
    *levels = top + 1;
    return cuts;
}

rg_status rg_stack_order(rg_stack *s, const int32_t *facet, int32_t n, rg_vec3 base, rg_vec3 up, const rg_vec3 *x,
                         const rg_place *back, int32_t *level, int32_t *levels)
{
    const axes A = axes_of(base, up);
    rg_status ok = RG_OK;
    s->samples = 0;
    for (int32_t i = 0; ok == RG_OK && i < n; i++) ok = add_facet(s, facet[i], &A, x);
    if (ok == RG_OK) ok = sort_by_point(s);
    if (ok == RG_OK) ok = compare(s, facet, n, &A, x, back);
    *levels = 1;
    for (int32_t i = 0; i < n; i++) level[facet[i]] = 0;
    if (ok != RG_OK || s->pairs == 0) return ok;
    const int agree = settle_pairs(s);
    ok = link_pairs(s, facet, n);
    if (ok != RG_OK || (climb(s, facet, n, level, levels) == 0 && agree)) return ok;
    /* Somewhere the order is not the one found there: two facets may have come to one level. All turns are taken for
     * the order, and no two facets of a pile are then alike. */
    ok = compare_turns(s, n);
    if (ok != RG_OK) return ok;
    settle_pairs(s);
    ok = link_pairs(s, facet, n);
    if (ok == RG_OK) climb(s, facet, n, level, levels);
    return ok;
}
