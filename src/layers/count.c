#include "layers/count.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the work that looking for one order may take, the part that the first attempt gets. */
enum { FIRST_SHARE = 4000 };
/* Of orders too many to count so many are numbered, if they are found with so much work. */
enum { NUMBERED = 100, WORK_OF_SOME = 1000000 };
/* For an order near to a wished one; then another will do. */
static const int64_t WORK_OF_NEAR = 50000000;

typedef struct counter {
    rg_orders *o;
    int32_t *list;        /* parts, each after its length, as far as `used` */
    size_t used, room;
    uint64_t *open;       /* [nf][words] as rows of pairs: those of the list being divided that are in no part yet */
    int32_t *weight;      /* [pairs] lent */
    int learns;           /* non-zero: weights are gathered, and orders found are kept in `found` */
    signed char *found;   /* [pairs] */
    int32_t settled;      /* of o->trail, what was known before */
    int64_t limit;        /* of o->work */
    int out_of_work;
    rg_status status;
} counter;

static int goes_on(counter *c)
{
    if (c->o->work > c->limit) c->out_of_work = 1;
    return c->status == RG_OK && !c->out_of_work;
}

static void push(counter *c, int32_t i)
{
    if (c->status == RG_OK) c->status = RG_MEM_GROW(&c->o->mem, c->list, c->room, c->used + 1);
    if (c->status == RG_OK) c->list[c->used++] = i;
}

/* Turns the pair's two bits over. */
static void turn(counter *c, int32_t pair)
{
    const rg_pairs *p = c->o->pairs;
    for (int end = 0; end < 2; end++) {
        const int32_t f = p->facet[pair][end], b = p->bit[p->facet[pair][!end]];
        c->open[(size_t)f * (size_t)p->words + (size_t)(b >> 6)] ^= UINT64_C(1) << (b & 63);
    }
}

static int is_open(const counter *c, int32_t pair)
{
    const rg_pairs *p = c->o->pairs;
    const int32_t b = p->bit[p->facet[pair][1]];
    return c->open[(size_t)p->facet[pair][0] * (size_t)p->words + (size_t)(b >> 6)] >> (b & 63) & 1;
}

static void reach(counter *c, int32_t pair)
{
    turn(c, pair);
    push(c, pair);
}

/* Pairs that one and the same constraint leaves open together with this one. */
static void reach_from(counter *c, int32_t pair)
{
    const rg_pairs *p = c->o->pairs;
    const rg_constraints *k = c->o->constraints;
    const size_t words = (size_t)p->words;
    for (int32_t j = k->start[pair]; j < k->start[pair + 1]; j++) {
        const rg_constraint_case *x = &k->item[k->of[j]];
        for (int i = 0; i < x->n; i++)
            if (is_open(c, x->pair[i])) reach(c, x->pair[i]);
    }
    for (int end = 0; end < 2; end++) {
        const int32_t f = p->facet[pair][end];
        const uint64_t *row = c->open + (size_t)f * words;
        c->o->work += p->common_start[pair + 1] - p->common_start[pair];
        for (int64_t i = p->common_start[pair]; i < p->common_start[pair + 1]; i++) {
            const size_t w = (size_t)p->common_word[i];
            for (uint64_t bits = p->common[i] & row[w]; bits; bits &= bits - 1)
                reach(c, rg_pairs_find(p, f, p->of_bit[(int32_t)(64 * w) + __builtin_ctzll(bits)]));
        }
    }
}

/* The pair that weighs most becomes the first of the part, which is tried. */
static void put_heaviest_first(counter *c, size_t first, int32_t n)
{
    size_t best = first;
    for (size_t j = first + 1; j < first + (size_t)n; j++)
        if (c->weight[c->list[j]] > c->weight[c->list[best]]) best = j;
    const int32_t pair = c->list[best];
    c->list[best] = c->list[first];
    c->list[first] = pair;
}

/* Facets that could not be ordered: each two of them. */
static void learn(counter *c)
{
    const rg_conflict *x = &c->o->conflict;
    for (int32_t i = 0; i < x->n; i++)
        for (int32_t j = i + 1; j < x->n; j++) {
            const int32_t pair = x->facet[i] == x->facet[j] ? -1 : rg_pairs_find(c->o->pairs, x->facet[i], x->facet[j]);
            if (pair >= 0) c->weight[pair]++;
        }
}

/* Puts the parts of what is unknown among n pairs at the end of the list. from: where they begin in it; NULL: all
 * pairs. */
static void divide(counter *c, const size_t *from, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        const int32_t pair = from ? c->list[*from + (size_t)i] : i;
        if (!c->o->value[pair]) turn(c, pair);
    }
    for (int32_t i = 0; c->status == RG_OK && i < n; i++) {
        const int32_t pair = from ? c->list[*from + (size_t)i] : i;
        if (!is_open(c, pair)) continue;
        const size_t head = c->used;
        push(c, 0);
        reach(c, pair);
        for (size_t j = head + 1; c->status == RG_OK && j < c->used; j++) reach_from(c, c->list[j]);
        if (c->status != RG_OK) break;
        c->list[head] = (int32_t)(c->used - head - 1);
        put_heaviest_first(c, head + 1, c->list[head]);
    }
}

static uint64_t product(uint64_t a, uint64_t b) { return b && a > UINT64_MAX / b ? UINT64_MAX : a * b; }

static uint64_t count_part(counter *c, size_t first, int32_t n, uint64_t cap);

/* How many orders what is left of n pairs has, at most `cap` of them counted. */
static uint64_t count_rest(counter *c, size_t first, int32_t n, uint64_t cap)
{
    const size_t begin = c->used;
    uint64_t total = 1;
    divide(c, &first, n);
    const size_t end = c->used;
    /* All is known down here: the last time that is said of a part's pairs, it is of an order that stands. */
    for (int32_t j = c->settled; c->learns && begin == end && j < c->o->known; j++) {
        const int32_t pair = c->o->trail[j];
        c->found[pair] = c->o->value[pair];
    }
    for (size_t at = begin; total && at < end; at += 1 + (size_t)c->list[at])
        total = product(total, count_part(c, at + 1, c->list[at], total < cap ? (cap - 1) / total + 1 : 1));
    c->used = begin;
    return c->status == RG_OK ? total : 0;
}

static uint64_t try_order(counter *c, size_t first, int32_t n, int value, uint64_t cap)
{
    const int32_t known = c->o->known;
    uint64_t orders = 0;
    if (rg_orders_set(c->o, c->list[first], value) && rg_orders_propagate(c->o)) orders = count_rest(c, first, n, cap);
    else if (c->learns) learn(c);
    rg_orders_undo(c->o, known);
    return orders;
}

/* Of one part. Out of work, it is a number that there are at least. */
static uint64_t count_part(counter *c, size_t first, int32_t n, uint64_t cap)
{
    uint64_t total = 0;
    for (int value = 1; value >= -1 && total < cap && goes_on(c); value -= 2) {
        const uint64_t more = try_order(c, first, n, value, cap - total);
        total = more > UINT64_MAX - total ? UINT64_MAX : total + more;
    }
    return total;
}

static rg_status begin(counter *c, rg_orders *o, int32_t *weight, int64_t work)
{
    memset(c, 0, sizeof *c);
    c->o = o;
    c->weight = weight;
    c->limit = work > INT64_MAX - o->work ? INT64_MAX : o->work + work;
    c->open = rg_mem_array(&o->mem, (size_t)o->pairs->nf * (size_t)o->pairs->words, sizeof *c->open);
    return c->open ? RG_OK : RG_ENOMEM;
}

static void end(counter *c)
{
    RG_MEM_FREE(&c->o->mem, c->open, c->list);
}

/* ---------------------------------------------------------------------------------------------- parts ---- */

void rg_parts_free(rg_parts *q)
{
    if (!q->mem.resize) return;
    const rg_memory mem = q->mem;
    RG_MEM_FREE(&mem, q->start, q->pair, q->orders, q->counted, q->more, q->found, q->weight);
    memset(q, 0, sizeof *q);
}

static rg_status keep_parts(rg_parts *q, const counter *c)
{
    for (size_t at = 0; at < c->used; at += 1 + (size_t)c->list[at]) q->count++;
    if (RG_MEM_ARRAYS(&q->mem, RG_ARRAY(q->start, (size_t)q->count + 1), RG_ARRAY(q->pair, c->used),
                      RG_ARRAY(q->orders, (size_t)q->count), RG_ARRAY(q->counted, (size_t)q->count),
                      RG_ARRAY(q->more, (size_t)q->count)) != RG_OK) return RG_ENOMEM;
    int32_t i = 0;
    for (size_t at = 0; at < c->used; at += 1 + (size_t)c->list[at], i++) {
        memcpy(q->pair + q->start[i], c->list + at + 1, (size_t)c->list[at] * sizeof *q->pair);
        q->start[i + 1] = q->start[i] + c->list[at];
    }
    return RG_OK;
}

/* Of a part whose orders are too many to count: how many can be numbered, each being found anew among those before
 * it. */
static uint64_t count_some(counter *c, size_t first, int32_t n)
{
    const int64_t limit = c->limit;
    c->limit = c->o->work + WORK_OF_SOME;
    c->out_of_work = 0;
    const uint64_t some = count_part(c, first, n, NUMBERED);
    const int all = !c->out_of_work;
    c->limit = limit;
    c->out_of_work = c->o->work > limit;
    return all ? some : 1;
}

typedef struct sized { int32_t pairs, part; size_t first; } sized;

static int by_size(const void *a, const void *b)
{
    const sized *p = a, *q = b;
    return p->pairs != q->pairs ? (p->pairs < q->pairs ? -1 : 1) : (p->part > q->part) - (p->part < q->part);
}

static rg_status count_by_size(rg_parts *q, counter *c, int64_t work)
{
    sized *part = rg_mem_array(&q->mem, (size_t)q->count, sizeof *part);
    if (!part) return RG_ENOMEM;
    size_t head = 0;
    for (int32_t i = 0; i < q->count; i++, head += 1 + (size_t)c->list[head])
        part[i] = (sized){c->list[head], i, head + 1};
    qsort(part, (size_t)q->count, sizeof *part, by_size);
    c->limit = c->o->work + work;
    c->out_of_work = 0;
    for (int32_t k = 0; c->status == RG_OK && k < q->count; k++) {
        const int32_t i = part[k].part;
        put_heaviest_first(c, part[k].first, part[k].pairs);
        const uint64_t n = count_part(c, part[k].first, part[k].pairs, UINT64_MAX);
        q->more[i] = (unsigned char)(c->out_of_work || n == UINT64_MAX);
        q->counted[i] = n > 1 ? n : 1;
        q->orders[i] = q->more[i] ? count_some(c, part[k].first, part[k].pairs) : q->counted[i];
    }
    rg_mem_free(&q->mem, part);
    return c->status;
}

/* Whether a part has an order: 1, 0, or -1: the work ran out. */
static int has_order(counter *c, size_t first, int32_t n, int64_t work)
{
    const int64_t end = c->o->work + work;
    int64_t share = work / FIRST_SHARE;
    for (;;) {
        c->limit = end - c->o->work < share ? end : c->o->work + share;
        c->out_of_work = 0;
        put_heaviest_first(c, first, n);
        const uint64_t orders = count_part(c, first, n, 1);
        if (orders) return 1;
        if (!c->out_of_work) return 0;
        if (c->o->work >= end || c->status != RG_OK) return -1;
        share += share / 2;
    }
}

rg_status rg_parts_init(rg_parts *q, const rg_memory *mem, rg_orders *o, int64_t work, rg_count_result *result,
                        int32_t *at)
{
    counter c;
    memset(q, 0, sizeof *q);
    q->mem = *mem;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(q->weight, (size_t)o->pairs->count),
                      RG_ARRAY(q->found, (size_t)o->pairs->count)) != RG_OK) return RG_ENOMEM;
    rg_status s = begin(&c, o, q->weight, work);
    if (s == RG_OK) divide(&c, NULL, o->pairs->count);
    if (s == RG_OK) s = c.status;
    if (s == RG_OK) s = keep_parts(q, &c);
    *result = RG_COUNT_DONE;
    /* One of each first: whether there is any must not wait for the number of another. */
    size_t head = 0;
    c.learns = 1;
    c.found = q->found;
    c.settled = o->known;
    for (int32_t i = 0; s == RG_OK && i < q->count && *result == RG_COUNT_DONE; i++, head += 1 + (size_t)c.list[head]) {
        const int has = has_order(&c, head + 1, c.list[head], work);
        *at = i;
        q->orders[i] = has > 0;
        s = c.status;
        if (has <= 0) *result = has ? RG_COUNT_UNSOLVED : RG_COUNT_NONE;
    }
    c.learns = 0;
    /* Then the smaller ones before the larger ones, which take what work is left. */
    if (s == RG_OK && *result == RG_COUNT_DONE) s = count_by_size(q, &c, work);
    end(&c);
    return s;
}

/* --------------------------------------------------------------------------------------- one of them ---- */

static void choose_part(counter *c, size_t first, int32_t n, uint64_t which);

/* The first part's number changes fastest. */
static void choose_rest(counter *c, size_t first, int32_t n, uint64_t which)
{
    const size_t begin = c->used;
    divide(c, &first, n);
    const size_t end = c->used;
    for (size_t at = begin; c->status == RG_OK && at < end; at += 1 + (size_t)c->list[at]) {
        const uint64_t here = which ? count_part(c, at + 1, c->list[at], which + 1) : 1;
        if (here == 0) break;
        choose_part(c, at + 1, c->list[at], which % here);
        which /= here;
    }
    c->used = begin;
}

static void choose_part(counter *c, size_t first, int32_t n, uint64_t which)
{
    for (int value = 1; value >= -1 && c->status == RG_OK; value -= 2) {
        const uint64_t here = try_order(c, first, n, value, which + 1);
        if (which >= here) {
            which -= here;
            continue;
        }
        rg_orders_set(c->o, c->list[first], value);
        rg_orders_propagate(c->o);
        choose_rest(c, first, n, which);
        return;
    }
}

/* What is wished for most is decided first: a pair that wishes for nothing has either order, and may force others. */
static void put_surest_first(counter *c, size_t first, int32_t n, const double *wish)
{
    size_t best = first;
    for (size_t i = first; i < first + (size_t)n; i++)
        if (fabs(wish[c->list[i]]) > fabs(wish[c->list[best]])) best = i;
    const int32_t was = c->list[first];
    c->list[first] = c->list[best];
    c->list[best] = was;
}

static void choose_part_near(counter *c, size_t first, int32_t n, const double *wish)
{
    put_surest_first(c, first, n, wish);
    const int wanted = wish[c->list[first]] < 0 ? -1 : 1;
    const int value = try_order(c, first, n, wanted, 1) ? wanted : -wanted;
    const size_t begin = c->used;
    if (!goes_on(c) || !rg_orders_set(c->o, c->list[first], value) || !rg_orders_propagate(c->o)) return;
    divide(c, &first, n);
    const size_t end = c->used;
    for (size_t at = begin; goes_on(c) && at < end; at += 1 + (size_t)c->list[at])
        choose_part_near(c, at + 1, c->list[at], wish);
    c->used = begin;
}

/* The part's pairs as a list. */
static rg_status begin_part(counter *c, const rg_parts *q, rg_orders *o, int32_t i)
{
    rg_status s = begin(c, o, q->weight, INT64_MAX);
    for (int32_t j = q->start[i]; s == RG_OK && j < q->start[i + 1]; j++) {
        push(c, q->pair[j]);
        s = c->status;
    }
    if (s == RG_OK) put_heaviest_first(c, 0, q->start[i + 1] - q->start[i]);
    return s;
}

static rg_status take_found(const rg_parts *q, rg_orders *o, int32_t i)
{
    for (int32_t j = q->start[i]; j < q->start[i + 1]; j++) rg_orders_set(o, q->pair[j], q->found[q->pair[j]]);
    rg_orders_propagate(o);
    return RG_OK;
}

rg_status rg_parts_choose_near(const rg_parts *q, rg_orders *o, int32_t i, const double *wish)
{
    counter c;
    const int32_t known = o->known;
    rg_status s = begin_part(&c, q, o, i);
    c.limit = o->work + WORK_OF_NEAR;
    if (s == RG_OK) choose_part_near(&c, 0, q->start[i + 1] - q->start[i], wish);
    if (s == RG_OK) s = c.status;
    const int out_of_work = c.out_of_work;
    end(&c);
    if (s != RG_OK || !out_of_work) return s;
    rg_orders_undo(o, known);
    return take_found(q, o, i);
}

rg_status rg_parts_choose(const rg_parts *q, rg_orders *o, int32_t i, uint64_t which)
{
    counter c;
    if (q->more[i] && q->orders[i] == 1) return take_found(q, o, i);
    rg_status s = begin_part(&c, q, o, i);
    if (s == RG_OK) choose_part(&c, 0, q->start[i + 1] - q->start[i], which);
    if (s == RG_OK) s = c.status;
    end(&c);
    return s;
}
