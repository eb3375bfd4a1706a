#include "pattern/planar.h"
#include "base/status.h"
#include "pattern/crossings.h"
#include "pattern/cuts.h"
#include "pattern/loose.h"
#include "pattern/overlap.h"

#include <stdlib.h>
#include <string.h>

/* Splitting moves lines by up to the tolerance, which can make new crossings; each round is rarer than the last. */
enum { MOST_ROUNDS = 40 };
/* Warnings of one kind before the rest is counted only. */
enum { MOST_WARNINGS = 20 };
/* Crossings are guessed from so many pairs of lines, of which so many have to cross to mean anything; that few lines
 * are not asked. */
enum { PAIRS_LOOKED_AT = 200000, TO_MEAN_ANYTHING = 10, FEW_LINES = 3000 };
/* Parts of the size and of the tolerance that rounding moves a crossing off its two lines, and more. */
static const double ROUNDING = 1e-13, OF_TOLERANCE = 1e-3;
/* Reading the file is the first half of the work. */
static const double BEGINS = 0.5;
/* Of a drawing; and of one that is to fold: who looks for contact takes lengths to the fourth power, and parts of the
 * size down to 1e-14. Beyond these that is nothing, or endless, and what lies apart is told to cross. */
static const double SMALLEST = 1e-100, SMALLEST_TO_FOLD = 1e-60, LARGEST_TO_FOLD = 1e70;

/* ------------------------------------------------------------------------------------------------ doubles */

typedef struct keyed { int32_t high, e; int rank; } keyed; /* of the edges of one lower vertex */
/* Of so few, the edges of a vertex are put in order by inserting one after the other. */
enum { A_FEW = 12 };

static int by_end(const void *a, const void *b)
{
    const keyed *p = a, *q = b;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    if (p->rank != q->rank) return p->rank < q->rank ? -1 : 1;
    return p->e < q->e ? -1 : p->e > q->e;
}

static void sort(keyed *k, int32_t n)
{
    if (n > A_FEW) {
        qsort(k, (size_t)n, sizeof *k, by_end);
        return;
    }
    for (int32_t i = 1; i < n; i++) {
        const keyed one = k[i];
        int32_t at = i;
        for (; at > 0 && by_end(&k[at - 1], &one) > 0; at--) k[at] = k[at - 1];
        k[at] = one;
    }
}

static int32_t lower(const rg_edge *e) { return e->v[0] < e->v[1] ? e->v[0] : e->v[1]; }

/* Of two edges with the same ends, one is new. */
static int may_be_double(const rg_splitter *s, const rg_edge *e)
{
    return !s->touched || (s->touched[e->v[0]] && s->touched[e->v[1]]);
}

/* Those that may be doubles by their lower vertex, then by the other one. start[nv + 2]: out, where those of a vertex
 * begin. */
static rg_status sort_edges(const rg_splitter *s, int32_t *start, keyed **key)
{
    const int32_t nv = s->points.count;
    int32_t *list = NULL, n = 0;
    size_t room = 0, key_room = 0;
    rg_status status = RG_OK;
    for (int32_t e = 0; status == RG_OK && e < s->ne; e++) {
        if (!may_be_double(s, &s->E[e])) continue;
        if (e + RG_SOON < s->ne) rg_mem_soon(&start[lower(&s->E[e + RG_SOON]) + 2]);
        status = RG_MEM_GROW(&s->mem, list, room, (size_t)n + 1);
        if (status != RG_OK) break;
        list[n++] = e;
        start[lower(&s->E[e]) + 2]++;
    }
    if (status == RG_OK) status = RG_MEM_GROW(&s->mem, *key, key_room, (size_t)n);
    for (int32_t v = 0; status == RG_OK && v < nv; v++) start[v + 2] += start[v + 1];
    for (int32_t i = 0; status == RG_OK && i < n; i++) {
        const rg_edge *edge = &s->E[list[i]];
        const int32_t low = lower(edge);
        if (i + RG_SOON < n) rg_mem_soon(&start[lower(&s->E[list[i + RG_SOON]]) + 1]);
        (*key)[start[low + 1]++] = (keyed){edge->v[0] + edge->v[1] - low, list[i], rg_overlap_rank(edge->assignment)};
    }
    for (int32_t v = 0; status == RG_OK && v < nv; v++)
        if (start[v + 1] > start[v] + 1) sort(*key + start[v], start[v + 1] - start[v]);
    rg_mem_free(&s->mem, list);
    return status;
}

/* What `fresh` says of an edge that is to go. */
enum { DROPPED = 2 };

static void drop(rg_splitter *s)
{
    const unsigned char *first = memchr(s->fresh, DROPPED, (size_t)s->ne);
    if (!first) return;
    int32_t n = (int32_t)(first - s->fresh);
    for (int32_t e = n; e < s->ne; e++)
        if (s->fresh[e] != DROPPED) s->fresh[n] = s->fresh[e], s->E[n++] = s->E[e];
    s->ne = n;
}

/* Of edges with the same ends the first of the highest rank stays: border, then mountain and valley, then the rest. */
static rg_status merge_doubles(rg_splitter *s, rg_lines *lines)
{
    const int32_t nv = s->points.count;
    keyed *key = NULL;
    int32_t *start = rg_mem_array(&s->mem, (size_t)nv + 2, sizeof *start);
    rg_status status = start ? sort_edges(s, start, &key) : RG_ENOMEM;
    int told = 0;
    for (int32_t v = 0; status == RG_OK && v < nv; v++)
        for (int32_t first = start[v], i = first + 1; status == RG_OK && i < start[v + 1]; i++) {
            if (key[i].high != key[first].high) {
                first = i;
                continue;
            }
            s->fresh_count -= s->fresh[key[i].e];
            s->fresh[key[i].e] = DROPPED;
            status = rg_overlap_warn(lines, s->points.X, &s->E[key[first].e], &s->E[key[i].e], &told);
        }
    if (status == RG_OK) status = rg_overlap_warn_more(lines, told);
    if (status == RG_OK) drop(s);
    RG_MEM_FREE(&s->mem, key, start);
    return status;
}

/* -------------------------------------------------------------------------------------------------- lines */

static double wish(const rg_line *l)
{
    if (isfinite(l->target)) return l->target;
    if (isinf(l->target)) return NAN; /* free */
    return l->assignment == RG_MOUNTAIN ? -RG_PI : l->assignment == RG_VALLEY ? RG_PI : NAN;
}

/* s NULL: every line is. */
static int is_used(const rg_line *l, const rg_reading *s)
{
    return !s || (l->assignment != RG_CUT && (l->assignment != RG_FLAT || s->aux_creases));
}

/* Warns of a line without length; from the MOST_WARNINGS'th on they are only counted. */
static rg_status without_length(rg_lines *lines, int32_t where, rg_vec2 at, int *told)
{
    if (++*told > MOST_WARNINGS) return RG_OK;
    at = rg_lines_own(lines, at, 0);
    return rg_lines_warn(lines, where, "a line without length at (%.6g, %.6g) is left out", at.x, at.y);
}

/* The line's edge, unless it has no length; a vertex that was made for it goes with it. */
static rg_status add_line(rg_splitter *s, rg_lines *lines, const rg_line *l, char assignment, int *told)
{
    const int32_t count = s->points.count;
    rg_edge e = {{0, 0}, assignment, wish(l), l->where, (int32_t)(l - lines->line)};
    rg_status status = rg_points_add(&s->points, l->a, &e.v[0]);
    if (status == RG_OK) status = rg_points_add(&s->points, l->b, &e.v[1]);
    if (status == RG_OK && e.v[0] == e.v[1]) {
        if (s->points.count > count) rg_points_forget(&s->points);
        return without_length(lines, l->where, l->a, told);
    }
    if (status == RG_OK) status = RG_MEM_GROW(&s->mem, s->E, s->room, (size_t)s->ne + 1);
    if (status == RG_OK) s->E[s->ne++] = e;
    return status;
}

/* Ends that came to lie within the tolerance of each other when vertices moved to the mean of theirs. */
static rg_status settle(rg_splitter *s, rg_lines *lines, int *told)
{
    int32_t *now = rg_mem_array(&s->mem, (size_t)s->points.count, sizeof *now), n = 0;
    rg_status status = now ? rg_points_settle(&s->points, now) : RG_ENOMEM;
    for (int32_t e = 0; status == RG_OK && e < s->ne; e++) {
        rg_edge edge = s->E[e];
        for (int i = 0; i < 2; i++) edge.v[i] = now[edge.v[i]];
        if (edge.v[0] != edge.v[1]) s->E[n++] = edge;
        else status = without_length(lines, edge.where, s->points.X[edge.v[0]], told);
    }
    s->ne = n;
    rg_mem_free(&s->mem, now);
    return status;
}

static rg_status add_lines(rg_splitter *s, rg_lines *lines, const rg_reading *settings)
{
    int32_t cuts = 0, first_cut = 0;
    int told = 0;
    rg_status status = RG_OK;
    for (int32_t i = 0; status == RG_OK && i < lines->count; i++) {
        const rg_line *l = &lines->line[i];
        const char assignment = settings && l->assignment == RG_FLAT ? RG_UNASSIGNED : l->assignment;
        if (settings && l->assignment == RG_CUT && !cuts++) first_cut = l->where;
        if (is_used(l, settings)) status = add_line(s, lines, l, assignment, &told);
        if (status == RG_OK) status = rg_splitter_done(s, 1);
    }
    if (status == RG_OK) status = settle(s, lines, &told);
    if (status == RG_OK && told > MOST_WARNINGS)
        status = rg_lines_warn(lines, 0, "%d more lines without length are left out", told - MOST_WARNINGS);
    if (status == RG_OK && cuts)
        status = rg_lines_warn(lines, first_cut, "%d cuts of the folded model are left out", (int)cuts);
    return status;
}

/* A pair of lines, as the numbers of a simple sequence have it: the same every time. */
static int32_t pick(uint64_t *state, int32_t n)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (int32_t)((*state >> 33) % (uint64_t)n);
}

/* Is it to be feared, before anything is kept of them, that there are more crossings than may be? Guessed from pairs of
 * lines. */
static int crosses_too_often(const rg_splitter *s)
{
    uint64_t state = 1;
    int32_t crossing = 0;
    if (s->ne <= FEW_LINES) return 0;
    for (int i = 0; i < PAIRS_LOOKED_AT; i++) {
        const int32_t *p = s->E[pick(&state, s->ne)].v, *q = s->E[pick(&state, s->ne)].v;
        const rg_vec2 *X = s->points.X, a = X[p[0]], b = X[p[1]], u = X[q[0]], v = X[q[1]];
        crossing += rg_vec2_turn(u, v, a) * rg_vec2_turn(u, v, b) < 0 &&
                    rg_vec2_turn(a, b, u) * rg_vec2_turn(a, b, v) < 0;
    }
    /* Two a crossing, which is of n^2 / 2 pairs. Guessed at twice what may be, it is not by chance. */
    const double cuts = (double)s->ne * (double)s->ne * crossing / PAIRS_LOOKED_AT;
    return crossing >= TO_MEAN_ANYTHING && cuts > 2.0 * RG_MOST_CUTS;
}

static rg_status planarise(rg_splitter *s, rg_lines *lines, rg_vec2 low, rg_vec2 high, rg_diag *why)
{
    const double size = fmax(high.x - low.x, high.y - low.y);
    rg_status status = rg_overlap_resolve(lines, s->points.X, s->points.tol, size, &s->E, &s->ne, &s->room);
    if (status != RG_OK || s->ne == 0) return status;
    status = RG_MEM_GROW(&s->mem, s->fresh, s->fresh_room, (size_t)s->ne);
    if (status == RG_OK) memset(s->fresh, 1, (size_t)s->ne), s->fresh_count = s->ne;
    if (status == RG_OK) status = merge_doubles(s, lines);
    if (status == RG_OK && crosses_too_often(s)) s->too_many = "crossings", status = RG_EFORMAT;
    for (int round = 0; status == RG_OK && s->ne > 0; round++) {
        if (round == MOST_ROUNDS)
            return rg_fail(RG_EFORMAT, why, 0,
                           "lines lie too close together to tell crossings apart: try another --merge");
        if (s->fresh_count == 0) break;
        status = rg_crossings_find(s, low, high);
        if (status != RG_OK || !s->cut_count) break;
        status = rg_cuts_make(s);
        if (status == RG_OK) status = merge_doubles(s, lines);
    }
    if (s->too_many) return rg_fail(RG_EFORMAT, why, 0, "too many %s: this is no crease pattern", s->too_many);
    return status;
}

/* settings NULL: of every line, loose ends too. */
static rg_status graph(rg_lines *lines, const rg_reading *settings, double merge, const rg_reading *ask, rg_graph *g,
                       rg_diag *why)
{
    memset(g, 0, sizeof *g);
    g->mem = lines->mem;
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t i = 0; i < lines->count; i++)
        for (int end = 0; end < 2 && is_used(&lines->line[i], settings); end++) {
            rg_vec2 x = end ? lines->line[i].b : lines->line[i].a;
            low = (rg_vec2){fmin(low.x, x.x), fmin(low.y, x.y)};
            high = (rg_vec2){fmax(high.x, x.x), fmax(high.y, x.y)};
        }
    g->size = high.x >= low.x ? fmax(high.x - low.x, high.y - low.y) : 0;
    const double smallest = settings ? SMALLEST_TO_FOLD : SMALLEST;
    if (!isfinite(g->size * g->size) || (settings && g->size > LARGEST_TO_FOLD))
        return rg_fail(RG_EFORMAT, why, 0, "the coordinates are too large to compute with");
    if (!(g->size > 0)) return RG_OK;
    if (g->size < smallest)
        return rg_fail(RG_EFORMAT, why, 0, "the whole drawing is smaller than %g: too small to compute with", smallest);

    rg_splitter s = {.mem = g->mem, .ask = ask, .progress = BEGINS};
    rg_status status = rg_points_init(&s.points, &s.mem, low, g->size, merge * g->size);
    s.exact = fmin(ROUNDING * g->size, OF_TOLERANCE * s.points.tol);
    if (status == RG_OK) status = add_lines(&s, lines, settings);
    if (status == RG_OK) status = planarise(&s, lines, low, high, why);
    if (status == RG_OK) {
        g->X = s.points.X;
        g->nv = s.points.count;
        g->E = s.E;
        g->ne = s.ne;
        g->merged_max = s.points.merged_max;
        s.points.X = NULL;
        s.E = NULL;
        if (settings) status = rg_loose_drop(g, lines);
    }
    if (status == RG_ECANCELLED) rg_fail(status, why, 0, "%s", rg_status_text(status));
    rg_points_free(&s.points);
    rg_crossings_free(&s);
    RG_MEM_FREE(&s.mem, s.E, s.fresh, s.touched);
    return status;
}

rg_status rg_planar_from_lines(rg_lines *lines, const rg_reading *s, rg_graph *g, rg_diag *why)
{
    return graph(lines, s, s->merge, s, g, why);
}

rg_status rg_planar_from_all_lines(rg_lines *lines, double merge, const rg_reading *ask, rg_graph *g, rg_diag *why)
{
    return graph(lines, NULL, merge, ask, g, why);
}
