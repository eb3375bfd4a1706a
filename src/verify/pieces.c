#include "verify/pieces.h"

#include <stdlib.h>
#include <string.h>

/* Sine of a corner that is turned inwards by rounding only. */
static const double STRAIGHT = 1e-7;
/* Of the sheet's size: what is narrower than this is how the drawing is rounded, no facet over another. */
static const double NARROW = 1e-4;

static double sine_at(rg_vec2 a, rg_vec2 b, rg_vec2 c)
{
    const rg_vec2 u = rg_vec2_sub(b, a), v = rg_vec2_sub(c, b);
    return rg_vec2_cross(u, v) / (rg_vec2_length(u) * rg_vec2_length(v) + 1e-300);
}

static int all_outwards(const rg_vec2 *X, const int32_t *c, int32_t n)
{
    int good = n <= RG_PIECE_MOST;
    double turned = 0;
    for (int32_t i = 0; good && i < n; i++) {
        const rg_vec2 a = X[c[i]], b = X[c[(i + 1) % n]], d = X[c[(i + 2) % n]];
        good = sine_at(a, b, d) >= -STRAIGHT;
        turned += atan2(rg_vec2_cross(rg_vec2_sub(b, a), rg_vec2_sub(d, b)),
                        rg_vec2_dot(rg_vec2_sub(b, a), rg_vec2_sub(d, b)));
    }
    return good && turned < 3 * RG_PI; /* a star goes round twice */
}

static void add(rg_pieces *p, int32_t f, const int32_t *c, int32_t n)
{
    p->facet[p->n] = f;
    memcpy(p->corner + p->start[p->n], c, (size_t)n * sizeof *c);
    p->start[p->n + 1] = p->start[p->n] + n;
    p->n++;
}

/* Is q left of a -> b, or to the right by an angle whose sine is at most `near`? */
static int is_left(rg_vec2 a, rg_vec2 b, rg_vec2 q, double near)
{
    return rg_vec2_turn(a, b, q) >= -near * rg_vec2_length(rg_vec2_sub(b, a)) * rg_vec2_length(rg_vec2_sub(q, a));
}

/* The triangle at corner i holds no other vertex, nor has one on its rim, as near as that. */
static int is_ear(const rg_vec2 *X, const int32_t *c, int32_t n, int32_t i, double near)
{
    const rg_vec2 a = X[c[(i + n - 1) % n]], b = X[c[i]], d = X[c[(i + 1) % n]];
    if (!(sine_at(a, b, d) > STRAIGHT)) return 0;
    for (int32_t k = 0; k < n; k++) {
        const rg_vec2 q = X[c[k]];
        if (c[k] == c[i] || c[k] == c[(i + 1) % n] || c[k] == c[(i + n - 1) % n]) continue;
        if (is_left(a, b, q, near) && is_left(b, d, q, near) && is_left(d, a, q, near)) return 0;
    }
    return 1;
}

/* Ears off, one after the other; corners in line that are left over have no area. An ear with a corner on its rim
 * leaves a polygon that touches itself, and is taken only where there is no other. c[n] is used up. */
static void cut(rg_pieces *p, const rg_vec2 *X, int32_t f, int32_t *c, int32_t n)
{
    while (n >= 3) {
        int32_t i = 0;
        while (i < n && !is_ear(X, c, n, i, STRAIGHT)) i++;
        for (i %= n; i < n && !is_ear(X, c, n, i, 0); i++) continue;
        if (i == n) return;
        add(p, f, (const int32_t[]){c[(i + n - 1) % n], c[i], c[(i + 1) % n]}, 3);
        memmove(c + i, c + i + 1, (size_t)(n - i - 1) * sizeof *c);
        n--;
    }
}

rg_status rg_pieces_init(const rg_record *r, rg_pieces *p)
{
    const size_t corners = (size_t)r->start[r->nf];
    memset(p, 0, sizeof *p);
    p->mem = r->mem;
    int32_t *c;
    const rg_status s = RG_MEM_ARRAYS(&r->mem, RG_ARRAY(p->facet, corners), RG_ARRAY(p->first, (size_t)r->nf + 1),
                                      RG_ARRAY(p->start, corners + 1), RG_ARRAY(p->corner, 3 * corners),
                                      RG_ARRAY(c, corners));
    if (s != RG_OK) return s;
    for (int32_t f = 0; f < r->nf; f++) {
        const int32_t n = r->start[f + 1] - r->start[f];
        memcpy(c, r->corner + r->start[f], (size_t)n * sizeof *c);
        p->first[f] = p->n;
        if (all_outwards(r->flat, c, n)) add(p, f, c, n);
        else cut(p, r->flat, f, c, n);
    }
    p->first[r->nf] = p->n;
    rg_mem_free(&r->mem, c);
    return RG_OK;
}

typedef struct span { double low[2], high[2]; int32_t piece; } span;

static int by_low(const void *a, const void *b)
{
    const span *p = a, *q = b;
    return p->low[0] < q->low[0] ? -1 : p->low[0] > q->low[0] ? 1 : p->piece - q->piece;
}

static int32_t piece_of(const rg_record *r, const rg_pieces *p, int32_t a, rg_vec2 x[RG_PIECE_MOST])
{
    const int32_t n = p->start[a + 1] - p->start[a];
    for (int32_t k = 0; k < n; k++) x[k] = r->flat[p->corner[p->start[a] + k]];
    return n;
}

/* What is missing of a facet in its pieces is no wider than rounding. */
static void check_simple(const rg_record *r, const rg_pieces *p, rg_faults *all)
{
    for (int32_t f = 0; f < r->nf; f++) {
        const int32_t *c = r->corner + r->start[f], corners = r->start[f + 1] - r->start[f];
        double sum = 0, area = 0, round = 0;
        for (int32_t k = 0; k < corners; k++) {
            const rg_vec2 q = r->flat[c[k]], s = r->flat[c[(k + 1) % corners]];
            area += rg_vec2_turn(r->flat[c[0]], q, s) / 2;
            round += rg_vec2_length(rg_vec2_sub(s, q));
        }
        for (int32_t a = p->first[f]; a < p->first[f + 1]; a++) {
            rg_vec2 x[RG_PIECE_MOST];
            const int32_t n = piece_of(r, p, a, x);
            sum += rg_pieces_area(x, n);
        }
        if (!(4 * fabs(sum - area) <= NARROW * r->size * round))
            rg_faults_add(all, -1, f, -1, "is no simple polygon in the pattern");
    }
}

rg_status rg_pieces_check(const rg_record *r, const rg_pieces *p, rg_faults *all)
{
    span *s = rg_mem_array(&p->mem, (size_t)p->n, sizeof *s);
    if (!s) return RG_ENOMEM;
    check_simple(r, p, all);
    for (int32_t a = 0; a < p->n; a++) {
        rg_vec2 x[RG_PIECE_MOST];
        const int32_t n = piece_of(r, p, a, x);
        s[a] = (span){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, a};
        for (int32_t k = 0; k < n; k++) {
            s[a].low[0] = fmin(s[a].low[0], x[k].x), s[a].high[0] = fmax(s[a].high[0], x[k].x);
            s[a].low[1] = fmin(s[a].low[1], x[k].y), s[a].high[1] = fmax(s[a].high[1], x[k].y);
        }
    }
    qsort(s, (size_t)p->n, sizeof *s, by_low);
    for (int32_t i = 0; i < p->n; i++)
        for (int32_t k = i + 1; k < p->n && s[k].low[0] < s[i].high[0]; k++) {
            const int32_t f = p->facet[s[i].piece], g = p->facet[s[k].piece];
            rg_vec2 a[RG_PIECE_MOST], b[RG_PIECE_MOST], common[RG_PIECE_COMMON];
            if (f == g || s[i].low[1] >= s[k].high[1] || s[k].low[1] >= s[i].high[1]) continue;
            const int32_t na = piece_of(r, p, s[i].piece, a), nb = piece_of(r, p, s[k].piece, b);
            const int32_t n = rg_pieces_common(a, na, b, nb, common);
            if (rg_pieces_width(common, n) > NARROW * r->size)
                rg_faults_add(all, -1, f < g ? f : g, f < g ? g : f, "lie over each other in the pattern");
        }
    rg_mem_free(&p->mem, s);
    return RG_OK;
}

void rg_pieces_free(rg_pieces *p)
{
    if (!p->mem.resize) return;
    RG_MEM_FREE(&p->mem, p->facet, p->first, p->start, p->corner);
    memset(p, 0, sizeof *p);
}

double rg_pieces_area(const rg_vec2 *a, int32_t n)
{
    double sum = 0;
    for (int32_t i = 1; i + 1 < n; i++) sum += rg_vec2_turn(a[0], a[i], a[i + 1]) / 2;
    return sum;
}

double rg_pieces_width(const rg_vec2 *a, int32_t n)
{
    double round = 0;
    for (int32_t k = 0; k < n; k++) round += rg_vec2_length(rg_vec2_sub(a[(k + 1) % n], a[k]));
    return round > 0 ? 4 * fabs(rg_pieces_area(a, n)) / round : 0;
}

/* a, cut by the line of one side of b after the other (Sutherland and Hodgman 1974). */
int32_t rg_pieces_common(const rg_vec2 *a, int32_t na, const rg_vec2 *b, int32_t nb, rg_vec2 common[RG_PIECE_COMMON])
{
    const double way = rg_pieces_area(b, nb) < 0 ? -1 : 1;
    rg_vec2 from[RG_PIECE_COMMON];
    int32_t n = na;
    for (int32_t i = 0; i < na; i++) common[i] = rg_pieces_area(a, na) < 0 ? a[na - 1 - i] : a[i];
    for (int32_t side = 0; side < nb && n > 0; side++) {
        const rg_vec2 p = b[side], q = b[(side + 1) % nb];
        const int32_t m = n;
        memcpy(from, common, (size_t)m * sizeof *from);
        n = 0;
        for (int32_t i = 0; i < m && n + 2 <= RG_PIECE_COMMON; i++) {
            const rg_vec2 s = from[i], e = from[(i + 1) % m];
            const double at = way * rg_vec2_turn(p, q, s), then = way * rg_vec2_turn(p, q, e);
            if (at >= 0) common[n++] = s;
            if ((at > 0 && then < 0) || (at < 0 && then > 0)) {
                const double t = at / (at - then);
                common[n++] = (rg_vec2){s.x + t * (e.x - s.x), s.y + t * (e.y - s.y)};
            }
        }
    }
    return n;
}
