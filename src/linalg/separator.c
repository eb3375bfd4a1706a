#include "linalg/separator.h"
#include "linalg/cut.h"

#include <math.h>
#include <string.h>

/* Coarser copies are made until so few nodes are left, or until one saves less than this part of them. */
static const int32_t COARSEST = 80;
static const double LEAST_SAVING = 0.05;
/* No node of a copy is heavier than this, against what those of the coarsest weigh in the mean. */
static const double HEAVIEST = 1.5;
/* Parts are grown from so many nodes of the coarsest copy. */
enum { SEEDS = 4 };
/* Copies of so few nodes are made coarser in so many ways, of which the best is kept. */
enum { TRIALS = 3, TRIALS_FROM = 300 };
/* What is matched next lies about this part of all nodes farther on, in the first way; no simple fraction. */
static const double FIRST_STRIDE = 0.118;
/* Passes of refinement on each copy, and moves in a row without a gain that end one. */
static const int32_t PASSES = 6, IDLE_MOVES = 60;

/* The first number from `from` on without a divisor in common with n. */
static int32_t coprime(int32_t n, int32_t from)
{
    for (int32_t k = from < 1 ? 1 : from;; k++) {
        int32_t a = n, b = k;
        while (b) {
            const int32_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1) return k;
    }
}

/* Each node with the neighbour that most edges lead to, if that is free; in another order for each trial. Returns how
 * many nodes are left. */
static int32_t match(const rg_weighted *g, int32_t trial, int32_t *of)
{
    const int32_t heaviest = 1 + (int32_t)(HEAVIEST * g->total / COARSEST);
    const int64_t stride = trial ? coprime(g->n, (int32_t)(g->n * (FIRST_STRIDE + 0.5 * trial / TRIALS))) : 1;
    int32_t fewer = 0;
    for (int32_t v = 0; v < g->n; v++) of[v] = -1;
    for (int32_t k = 0; k < g->n; k++) {
        const int32_t v = (int32_t)(k * stride % g->n);
        int32_t best = -1, most = 0;
        if (of[v] >= 0) continue;
        for (int32_t j = g->start[v]; j < g->start[v + 1]; j++) {
            const int32_t u = g->to[j];
            if (of[u] >= 0 || g->weight[u] + g->weight[v] > heaviest) continue;
            if (best < 0 || g->edge[j] > most || (g->edge[j] == most && g->weight[u] < g->weight[best]))
                best = u, most = g->edge[j];
        }
        if (best >= 0) of[best] = fewer;
        of[v] = fewer++;
    }
    return fewer;
}

/* --------------------------------------------------------------------------------------------- refining ---- */

/* Nodes by falling key, a heap of which each knows its place. */
typedef struct heap { int32_t count, *node, *place, *key; } heap; /* place[n]: 1 + that in node, 0: not in it */

static void put(heap *h, int32_t at, int32_t v)
{
    h->node[at] = v;
    h->place[v] = at + 1;
}

static int before(const heap *h, int32_t u, int32_t v)
{
    return h->key[u] > h->key[v] || (h->key[u] == h->key[v] && u < v);
}

static void sift(heap *h, int32_t at)
{
    const int32_t v = h->node[at];
    for (int32_t up; at > 0 && before(h, v, h->node[up = (at - 1) / 2]); at = up) put(h, at, h->node[up]);
    for (int32_t down; (down = 2 * at + 1) < h->count; at = down) {
        if (down + 1 < h->count && before(h, h->node[down + 1], h->node[down])) down++;
        if (!before(h, h->node[down], v)) break;
        put(h, at, h->node[down]);
    }
    put(h, at, v);
}

static void heap_add(heap *h, int32_t v, int32_t key)
{
    h->key[v] = key;
    h->node[h->count++] = v;
    sift(h, h->count - 1);
}

static void heap_take(heap *h, int32_t v)
{
    const int32_t at = h->place[v] - 1, last = h->node[--h->count];
    h->place[v] = 0;
    if (last == v) return;
    put(h, at, last);
    sift(h, at);
}

static void heap_change(heap *h, int32_t v, int32_t by)
{
    h->key[v] += by;
    sift(h, h->place[v] - 1);
}

/* A parting that is being made better. */
typedef struct refinement {
    rg_parting p;
    heap to[2];         /* nodes of the separator, by what the separator loses as they go to that part */
    int32_t *moved;     /* [n] the pass in which a node left the separator */
    int32_t *log, *was; /* changes of the pass, to be taken back: node and what it was */
    int32_t changes, pass;
} refinement;

/* What the separator loses when v goes to a part: v, less v's neighbours in the other part. */
static int32_t loss(const refinement *r, int32_t v, int32_t part)
{
    int32_t sum = r->p.g->weight[v];
    for (int32_t j = r->p.g->start[v]; j < r->p.g->start[v + 1]; j++)
        if (r->p.part[r->p.g->to[j]] == 1 - part) sum -= r->p.g->weight[r->p.g->to[j]];
    return sum;
}

static void change(refinement *r, int32_t v, int32_t part)
{
    r->log[r->changes] = v;
    r->was[r->changes++] = r->p.part[v];
    r->p.weight[r->p.part[v]] -= r->p.g->weight[v];
    r->p.weight[part] += r->p.g->weight[v];
    r->p.part[v] = part;
}

static void move(refinement *r, int32_t v, int32_t part)
{
    const rg_weighted *g = r->p.g;
    heap_take(&r->to[0], v);
    heap_take(&r->to[1], v);
    change(r, v, part);
    r->moved[v] = r->pass;
    for (int32_t j = g->start[v]; j < g->start[v + 1]; j++) {
        const int32_t u = g->to[j];
        if (r->p.part[u] == RG_SEPARATOR) { /* going to the other part, it would take v back */
            if (r->to[0].place[u]) heap_change(&r->to[1 - part], u, -g->weight[v]);
        } else if (r->p.part[u] == 1 - part) {
            change(r, u, RG_SEPARATOR);
            for (int32_t k = g->start[u]; k < g->start[u + 1]; k++) {
                const int32_t w = g->to[k];
                if (r->p.part[w] == RG_SEPARATOR && r->to[0].place[w]) heap_change(&r->to[part], w, g->weight[u]);
            }
            if (r->moved[u] == r->pass) continue;
            heap_add(&r->to[0], u, loss(r, u, 0));
            heap_add(&r->to[1], u, loss(r, u, 1));
        }
    }
}

/* Fiduccia and Mattheyses's passes: the best move again and again, even if it gains nothing; then back to the best cut
 * that was met. */
static void refine(refinement *r)
{
    const rg_weighted *g = r->p.g;
    rg_parting_weigh(&r->p);
    for (int32_t n = 0; n < PASSES; n++) {
        r->pass++;
        r->changes = 0;
        for (int32_t v = 0; v < g->n; v++)
            for (int part = 0; part < 2 && r->p.part[v] == RG_SEPARATOR; part++)
                heap_add(&r->to[part], v, loss(r, v, part));
        const double from = rg_parting_cost(&r->p);
        double least = from;
        int32_t kept = 0;
        for (int32_t idle = 0; r->to[0].count > 0 && idle < IDLE_MOVES; idle++) {
            const int32_t lighter = r->p.weight[1] < r->p.weight[0];
            int32_t to = lighter;
            const int32_t a = r->to[lighter].node[0], b = r->to[1 - lighter].node[0];
            if (r->to[1 - lighter].key[b] > r->to[lighter].key[a] &&
                r->p.weight[1 - lighter] + g->weight[b] <= RG_PARTING_MOST * g->total / 2)
                to = 1 - lighter;
            move(r, r->to[to].node[0], to);
            const double c = rg_parting_cost(&r->p);
            if (c < least) least = c, kept = r->changes, idle = -1;
        }
        for (int side = 0; side < 2; side++) {
            for (int32_t i = 0; i < r->to[side].count; i++) r->to[side].place[r->to[side].node[i]] = 0;
            r->to[side].count = 0;
        }
        while (r->changes > kept) { /* back, the last first */
            const int32_t v = r->log[--r->changes];
            r->p.weight[r->p.part[v]] -= g->weight[v];
            r->p.weight[r->was[r->changes]] += g->weight[v];
            r->p.part[v] = r->was[r->changes];
        }
        if (!(least < from)) return;
    }
}

static rg_status init_refinement(const rg_memory *mem, refinement *r, const rg_weighted *g)
{
    const size_t n = (size_t)g->n;
    *r = (refinement){.p = {.g = g}};
    heap *a = &r->to[0], *b = &r->to[1];
    /* A node leaves the separator once a pass, and comes into it twice at the most. */
    return RG_MEM_ARRAYS(mem, RG_ARRAY(r->p.part, n), RG_ARRAY(r->moved, n), RG_ARRAY(a->node, n),
                         RG_ARRAY(a->place, n), RG_ARRAY(a->key, n), RG_ARRAY(b->node, n), RG_ARRAY(b->place, n),
                         RG_ARRAY(b->key, n), RG_ARRAY(r->log, 3 * n), RG_ARRAY(r->was, 3 * n));
}

static void free_refinement(const rg_memory *mem, refinement *r)
{
    RG_MEM_FREE(mem, r->p.part, r->moved, r->to[0].node, r->to[0].place, r->to[0].key, r->to[1].node, r->to[1].place,
                r->to[1].key, r->log, r->was);
}

/* Nodes as they are met from v on, breadth first; those of another component come after all of v's. Returns the last
 * one of v's. */
static int32_t breadth_first(const rg_weighted *g, int32_t v, int32_t *met, int32_t *order)
{
    int32_t count = 0, done = 0, farthest = -1;
    memset(met, 0, (size_t)g->n * sizeof *met);
    for (int32_t other = 0; count < g->n;) {
        met[v] = 1;
        order[count++] = v;
        for (; done < count; done++)
            for (int32_t j = g->start[order[done]]; j < g->start[order[done] + 1]; j++)
                if (!met[g->to[j]]) met[g->to[j]] = 1, order[count++] = g->to[j];
        if (farthest < 0) farthest = order[count - 1];
        while (other < g->n && met[other]) other++;
        v = other;
    }
    return farthest;
}

/* Half of the coarsest copy, grown from a node; the best of several. */
static void part_coarsest(refinement *r, int32_t *best)
{
    const rg_weighted *g = r->p.g;
    double least = INFINITY;
    int32_t seed = 0, *order = r->log, *met = r->was; /* not in use yet */
    for (int32_t k = 0; k < SEEDS; k++) {
        const int32_t farthest = breadth_first(g, seed, met, order);
        int32_t grown = 0;
        for (int32_t i = 0; i < g->n; i++) {
            const int32_t v = order[i];
            r->p.part[v] = 2 * (grown + g->weight[v] / 2) > g->total; /* 0: the half that was grown */
            if (r->p.part[v] == 0) grown += g->weight[v];
        }
        for (int32_t v = 0; v < g->n; v++) {
            if (r->p.part[v] != 0) continue;
            for (int32_t j = g->start[v]; j < g->start[v + 1]; j++)
                if (r->p.part[g->to[j]] == 1) r->p.part[v] = RG_SEPARATOR;
        }
        refine(r);
        const double c = rg_parting_cost(&r->p);
        if (c < least) least = c, memcpy(best, r->p.part, (size_t)g->n * sizeof *best);
        seed = k < 2 ? farthest : (int32_t)((int64_t)(k - 1) * g->n / (SEEDS - 2)) % g->n;
    }
    memcpy(r->p.part, best, (size_t)g->n * sizeof *best);
}

static int separate(const rg_memory *mem, const rg_weighted *g, int32_t trial, int32_t *part, double *least)
{
    const int32_t trials = trial == 0 && g->n <= TRIALS_FROM ? TRIALS : 1;
    refinement r = {0};
    int32_t *of = NULL, *coarse_part = NULL;
    int done = 0, coarser = 1;
    *least = INFINITY;
    if (init_refinement(mem, &r, g) != RG_OK) goto out;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(of, (size_t)g->n), RG_ARRAY(coarse_part, (size_t)g->n)) != RG_OK) goto out;
    for (int32_t t = 0; t < trials && coarser; t++) {
        rg_weighted coarse = {0};
        double c = 0;
        const int32_t fewer = g->n > COARSEST ? match(g, trials > 1 ? t + 1 : trial, of) : g->n;
        coarser = fewer < (1 - LEAST_SAVING) * g->n;
        if (coarser) {
            if (!rg_weighted_contract(g, mem, of, fewer, &coarse)) goto out;
            const int made = separate(mem, &coarse, trials > 1 ? t + 1 : trial, coarse_part, &c);
            rg_weighted_free(&coarse, mem);
            if (!made) goto out;
            for (int32_t v = 0; v < g->n; v++) r.p.part[v] = coarse_part[of[v]];
            refine(&r);
            if (!rg_cut(&r.p, mem, coarse_part)) goto out;
        } else
            part_coarsest(&r, coarse_part);
        c = rg_parting_cost(&r.p);
        if (c < *least) *least = c, memcpy(part, r.p.part, (size_t)g->n * sizeof *part);
    }
    done = 1;
out:
    free_refinement(mem, &r);
    RG_MEM_FREE(mem, of, coarse_part);
    return done;
}

int rg_separate(const rg_weighted *g, const rg_memory *mem, int32_t *part)
{
    double least;
    return separate(mem, g, 0, part, &least);
}
