#include "linalg/symbolic.h"
#include "linalg/dissect.h"

#include <camd.h>

#include <string.h>

/* Operations a row. Dissection takes some 8 microseconds a row and saves half of a factorisation, of which a fold makes
 * a hundred or so, at 15 operations a nanosecond. */
static const double DISSECT_FROM = 4000;
/* A supernode and its parent become one if that has so few columns, and of its numbers at most this part is zero. */
static const struct { int32_t columns; double zeros; } MERGE[] = {{4, 1}, {16, 0.8}, {48, 0.1}, {INT32_MAX, 0.05}};

_Static_assert(sizeof(int) == sizeof(int32_t), "CAMD's integers are ours");

/* The elimination in one order. */
typedef struct elimination {
    int32_t *order;  /* [n] row of A that is eliminated as the k-th */
    int32_t *place;  /* [n] and its inverse */
    int32_t *parent; /* [n] the elimination tree, -1: a root; children come before parents, a subtree in one piece */
    int32_t *size;   /* [n] of the subtree */
    int32_t *count;  /* [n] numbers in the column of L, the diagonal among them */
    double flops, entries;
} elimination;

typedef struct work {
    const rg_memory *mem;
    int32_t n;
    int32_t *start, *to; /* neighbours of each row of A, both ways, without itself */
    int32_t *a, *b, *c;  /* [n] scratch */
} work;

static void free_elimination(const rg_memory *mem, elimination *e)
{
    RG_MEM_FREE(mem, e->order, e->place, e->parent, e->size, e->count);
    memset(e, 0, sizeof *e);
}

static rg_status make_elimination(const rg_memory *mem, size_t n, elimination *e)
{
    *e = (elimination){0};
    return RG_MEM_ARRAYS(mem, RG_ARRAY(e->order, n), RG_ARRAY(e->place, n), RG_ARRAY(e->parent, n),
                         RG_ARRAY(e->size, n), RG_ARRAY(e->count, n));
}

static rg_status make_work(work *w, const rg_memory *mem, int32_t n, const int32_t *start, const int32_t *row)
{
    *w = (work){.mem = mem, .n = n};
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(w->start, (size_t)n + 1), RG_ARRAY(w->a, (size_t)n), RG_ARRAY(w->b, (size_t)n),
                      RG_ARRAY(w->c, (size_t)n)) != RG_OK) return RG_ENOMEM;
    int64_t edges = 0;
    for (int32_t j = 0; j < n; j++)
        for (int32_t at = start[j]; at < start[j + 1]; at++)
            if (row[at] < j) w->a[row[at]]++, w->a[j]++, edges += 2;
    if (edges > INT32_MAX) return RG_ENOMEM;
    w->to = rg_mem_array(mem, (size_t)edges, sizeof *w->to);
    if (!w->to) return RG_ENOMEM;
    for (int32_t j = 0; j < n; j++) w->start[j + 1] = w->start[j] + w->a[j], w->a[j] = w->start[j];
    for (int32_t j = 0; j < n; j++)
        for (int32_t at = start[j]; at < start[j + 1]; at++)
            if (row[at] < j) w->to[w->a[row[at]]++] = j, w->to[w->a[j]++] = row[at];
    return RG_OK;
}

static void free_work(work *w)
{
    RG_MEM_FREE(w->mem, w->start, w->to, w->a, w->b, w->c);
}

/* order[n + 1]: out.   set[n]: sets are eliminated one after the other, NULL: all are one. */
static rg_status minimum_degree(const work *w, const int32_t *set, int32_t *order)
{
    enum { ARRAYS = 10 };
    const size_t n = (size_t)w->n, edges = (size_t)w->start[w->n];
    const size_t room = edges + edges / 5 + n + 1; /* as its authors advise */
    if (room >= INT32_MAX) return RG_ENOMEM;
    int32_t *list, *all;
    const rg_status s = RG_MEM_ARRAYS(w->mem, RG_ARRAY(list, room), RG_ARRAY(all, ARRAYS * (n + 1)));
    if (s != RG_OK) return s;
    int32_t *array[ARRAYS];
    for (size_t i = 0; i < ARRAYS; i++) array[i] = all + i * (n + 1);
    int32_t *from = array[0], *length = array[1];
    for (int32_t i = 0; i < w->n; i++) from[i] = w->start[i], length[i] = w->start[i + 1] - w->start[i];
    memcpy(list, w->to, edges * sizeof *list);
    double info[CAMD_INFO];
    camd_2(w->n, from, list, length, (int)room, (int)edges, array[2], array[3], array[4], array[5], array[6],
           array[7], array[8], NULL, info, set, array[9]);
    memcpy(order, array[4], n * sizeof *order);
    RG_MEM_FREE(w->mem, list, all);
    return RG_OK;
}

/* Liu's algorithm: each row's neighbours that come before it are climbed from, past what is known to lie below. */
static void make_tree(const work *w, elimination *e)
{
    int32_t *above = w->a; /* an ancestor, as far up as is known */
    for (int32_t k = 0; k < w->n; k++) {
        const int32_t i = e->order[k];
        e->parent[k] = above[k] = -1;
        for (int32_t at = w->start[i]; at < w->start[i + 1]; at++)
            for (int32_t j = e->place[w->to[at]], next; j >= 0 && j < k; j = next) {
                next = above[j];
                above[j] = k;
                if (next < 0) e->parent[j] = k;
            }
    }
}

static void make_sizes(int32_t n, elimination *e)
{
    for (int32_t k = 0; k < n; k++) e->size[k] = 1;
    for (int32_t k = 0; k < n; k++)
        if (e->parent[k] >= 0) e->size[e->parent[k]] += e->size[k];
}

/* Renumbers so that each subtree is in one piece, right before its root the child with the largest key. */
static void postorder(const work *w, elimination *e, const int32_t *key)
{
    const int32_t n = w->n;
    int32_t *heavy = w->a, *end = w->b, *to = w->c; /* end: where what is still to be placed of a subtree ends */
    for (int32_t k = 0; k < n; k++) heavy[k] = -1;
    for (int32_t k = 0; k < n; k++) {
        const int32_t p = e->parent[k];
        if (p >= 0 && (heavy[p] < 0 || key[k] >= key[heavy[p]])) heavy[p] = k;
    }
    int32_t end_of_roots = n;
    for (int32_t k = n - 1; k >= 0; k--) {
        const int32_t p = e->parent[k];
        int32_t *last = p < 0 ? &end_of_roots : &end[p], after = *last;
        if (p >= 0 && heavy[p] == k) after = to[p];
        else *last -= e->size[k];
        to[k] = after - 1;
        end[k] = to[k] - (heavy[k] < 0 ? 0 : e->size[heavy[k]]);
    }
    int32_t *order = w->a, *parent = w->b; /* heavy and end are done with */
    for (int32_t k = 0; k < n; k++) order[to[k]] = e->order[k];
    memcpy(e->order, order, (size_t)n * sizeof *order);
    for (int32_t k = 0; k < n; k++) parent[to[k]] = e->parent[k] < 0 ? -1 : to[e->parent[k]];
    memcpy(e->parent, parent, (size_t)n * sizeof *parent);
    for (int32_t k = 0; k < n; k++) order[to[k]] = e->count[k];
    memcpy(e->count, order, (size_t)n * sizeof *order);
    for (int32_t k = 0; k < n; k++) e->place[e->order[k]] = k;
    make_sizes(n, e);
}

/* Numbers of each column of L. Row i of L is a subtree of the elimination tree, pruned: its leaves add one each, and
 * where two of its branches meet one is taken off again. */
static void count_columns(const work *w, elimination *e)
{
    const int32_t n = w->n;
    int32_t *latest = w->a, *leaf = w->b, *up = w->c; /* of row i: first descendant and number of its last leaf */
    for (int32_t k = 0; k < n; k++) latest[k] = leaf[k] = -1, up[k] = k, e->count[k] = e->size[k] == 1;
    for (int32_t k = 0; k < n; k++) {
        const int32_t i = e->order[k], first = k - e->size[k] + 1;
        if (e->parent[k] >= 0) e->count[e->parent[k]]--;
        for (int32_t at = w->start[i]; at < w->start[i + 1]; at++) {
            const int32_t r = e->place[w->to[at]];
            if (r <= k || first <= latest[r]) continue; /* not below the diagonal; not a leaf */
            latest[r] = first;
            e->count[k]++;
            int32_t meet = leaf[r];
            leaf[r] = k;
            if (meet < 0) continue;
            while (up[meet] != meet) up[meet] = up[up[meet]], meet = up[meet];
            e->count[meet]--;
        }
        if (e->parent[k] >= 0) up[k] = e->parent[k];
    }
    e->flops = e->entries = 0;
    for (int32_t k = 0; k < n; k++) {
        if (e->parent[k] >= 0) e->count[e->parent[k]] += e->count[k];
        e->entries += e->count[k];
        e->flops += (double)e->count[k] * e->count[k];
    }
}

/* set as in minimum_degree. */
static rg_status eliminate(const work *w, const int32_t *set, elimination *e)
{
    rg_status s = make_elimination(w->mem, (size_t)w->n, e);
    if (s == RG_OK) s = minimum_degree(w, set, e->order);
    if (s != RG_OK) return s;
    for (int32_t k = 0; k < w->n; k++) e->place[e->order[k]] = k;
    make_tree(w, e);
    make_sizes(w->n, e);
    postorder(w, e, e->size);
    count_columns(w, e);
    postorder(w, e, e->count);
    return RG_OK;
}

/* The better of both orders. */
static rg_status choose_order(const work *w, elimination *e)
{
    rg_status s = eliminate(w, NULL, e);
    if (s != RG_OK || e->flops < DISSECT_FROM * w->n) return s;
    int32_t *set = rg_mem_array(w->mem, (size_t)w->n, sizeof *set);
    elimination dissected = {0};
    s = set && rg_dissect(w->mem, w->n, w->start, w->to, set) >= 0 ? eliminate(w, set, &dissected) : RG_ENOMEM;
    if (s == RG_OK && dissected.flops < e->flops) {
        elimination dearer = *e;
        *e = dissected;
        dissected = dearer;
    }
    free_elimination(w->mem, &dissected);
    rg_mem_free(w->mem, set);
    return s;
}

/* Numbers on and below the diagonal of a panel. */
static double trapezoid(double wide, double tall) { return wide * tall - wide * (wide - 1) / 2; }

static int worth_merging(int32_t columns, double zeros)
{
    int k = 0;
    while (columns > MERGE[k].columns) k++;
    return zeros <= MERGE[k].zeros;
}

/* of[k] = the first column of the supernode of column k; tall[first] its rows. Returns how many supernodes. */
static int32_t find_supernodes(int32_t n, const elimination *e, int32_t *of, int32_t *tall, int32_t *wide)
{
    int32_t count = 0;
    for (int32_t k = 0; k < n; k++) { /* columns of the same pattern */
        const int32_t joins = k > 0 && e->parent[k - 1] == k && e->count[k - 1] == e->count[k] + 1;
        of[k] = joins ? of[k - 1] : k;
        if (!joins) tall[k] = e->count[k], wide[k] = 0;
        wide[of[k]]++;
    }
    /* From the top down, each with what comes right after it, if that is its parent. */
    int32_t after = -1;
    double zeros = 0; /* in the one after */
    for (int32_t k = n; k > 0;) {
        const int32_t s = of[k - 1], last = k - 1;
        double filled = 0;
        int merged = 0;
        count++;
        if (after >= 0 && e->parent[last] >= 0 && e->parent[last] < after + wide[after]) {
            const int32_t columns = wide[s] + wide[after], rows = wide[s] + tall[after];
            filled = zeros + trapezoid(columns, rows) - trapezoid(wide[s], tall[s]) -
                     trapezoid(wide[after], tall[after]);
            merged = worth_merging(columns, filled / trapezoid(columns, rows));
            if (merged) wide[s] = columns, tall[s] = rows, count--;
        }
        zeros = merged ? filled : 0;
        after = s;
        k = s;
    }
    for (int32_t s = 0; s < n; s += wide[s])
        for (int32_t k = s; k < s + wide[s]; k++) of[k] = s;
    return count;
}

/* Which rows each supernode has. */
static void fill_rows(const work *w, const elimination *e, rg_symbolic *S)
{
    int32_t *filled = w->a, *seen = w->b;
    for (int32_t s = 0; s < S->count; s++) {
        filled[s] = S->start[s];
        seen[s] = -1;
        for (int32_t k = S->column[s]; k < S->column[s + 1]; k++) S->row[filled[s]++] = k;
    }
    for (int32_t k = 0; k < w->n; k++) {
        const int32_t i = e->order[k];
        for (int32_t at = w->start[i]; at < w->start[i + 1]; at++) {
            const int32_t below = e->place[w->to[at]];
            if (below >= k) continue;
            for (int32_t s = S->of[below]; s != S->of[k] && seen[s] != k; s = S->of[e->parent[S->column[s + 1] - 1]]) {
                seen[s] = k;
                S->row[filled[s]++] = k;
            }
        }
    }
}

static rg_status make_panels(const work *w, const elimination *e, rg_symbolic *S)
{
    const rg_memory *mem = w->mem;
    const size_t n = (size_t)w->n;
    int32_t *of = w->a, *tall = w->b, *wide = w->c;
    S->count = find_supernodes(w->n, e, of, tall, wide);
    const size_t count = (size_t)S->count;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(S->place, n), RG_ARRAY(S->of, n), RG_ARRAY(S->column, count + 1),
                      RG_ARRAY(S->start, count + 1), RG_ARRAY(S->panel, count + 1)) != RG_OK) return RG_ENOMEM;
    int64_t rows = 0, numbers = 0;
    int32_t s = 0;
    for (int32_t k = 0; k < w->n; k += wide[k], s++) {
        S->column[s] = k;
        S->start[s] = (int32_t)rows;
        S->panel[s] = (int32_t)numbers;
        rows += tall[k];
        numbers += (int64_t)((tall[k] + 3) & ~3) * wide[k];
        if (rows > INT32_MAX || numbers > INT32_MAX - RG_SYMBOLIC_PAD) return RG_ENOMEM;
        for (int32_t j = k; j < k + wide[k]; j++) S->of[j] = s;
    }
    S->column[s] = w->n;
    S->start[s] = (int32_t)rows;
    S->panel[s] = (int32_t)numbers;
    memcpy(S->place, e->place, n * sizeof *S->place);
    S->row = rg_mem_array(mem, (size_t)rows, sizeof *S->row);
    if (!S->row) return RG_ENOMEM;
    fill_rows(w, e, S);
    return RG_OK;
}

rg_status rg_symbolic_init(rg_symbolic *S, const rg_memory *mem, int32_t n, const int32_t *start, const int32_t *row)
{
    work w;
    elimination e = {0};
    memset(S, 0, sizeof *S);
    S->mem = *mem;
    S->n = n;
    rg_status s = make_work(&w, mem, n, start, row);
    if (s == RG_OK) s = choose_order(&w, &e);
    if (s == RG_OK) s = make_panels(&w, &e, S);
    S->flops = e.flops;
    S->entries = e.entries;
    free_elimination(mem, &e);
    free_work(&w);
    if (s != RG_OK) rg_symbolic_free(S);
    return s;
}

void rg_symbolic_free(rg_symbolic *S)
{
    if (!S->mem.resize) return;
    RG_MEM_FREE(&S->mem, S->place, S->column, S->start, S->row, S->panel, S->of);
    memset(S, 0, sizeof *S);
}
