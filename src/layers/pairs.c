#include "layers/pairs.h"

#include <stdlib.h>
#include <string.h>

/* Words of common places: half a gigabyte. */
static const int64_t MOST_WORDS = (int64_t)1 << 25;
/* Pairs, and words of the bits that tell who lies over whom: asked for before memory is taken for them, so that it is
 * three gigabytes at the most. A Miura-ori of 256 by 256 has 25 million pairs, and half of the words. */
static const int64_t MOST_PAIRS = (int64_t)1 << 25, MOST_ROW_WORDS = (int64_t)1 << 27;

void rg_pairs_free(rg_pairs *p)
{
    if (!p->mem.resize) return;
    const rg_memory mem = p->mem;
    RG_MEM_FREE(&mem, p->bit, p->of_bit, p->facet, p->row, p->before, p->start, p->number, p->common_start,
                p->common_word, p->common);
    memset(p, 0, sizeof *p);
}

static uint64_t *row_of(const rg_pairs *p, uint64_t *rows, int32_t f) { return rows + (size_t)f * (size_t)p->words; }
static void set(uint64_t *row, int32_t bit) { row[bit >> 6] |= UINT64_C(1) << (bit & 63); }
static void clear(uint64_t *row, int32_t bit) { row[bit >> 6] &= ~(UINT64_C(1) << (bit & 63)); }

/* Cells whose facets are those of another cell as well tell nothing new. */
typedef struct stack { const int32_t *facet; int32_t n; } stack;

static int by_facets(const void *a, const void *b)
{
    const stack *p = a, *q = b;
    if (p->n != q->n) return p->n < q->n ? -1 : 1;
    return memcmp(p->facet, q->facet, (size_t)p->n * sizeof *p->facet);
}

static int32_t different_stacks(const rg_cells *c, stack *s)
{
    int32_t n = 0, kept = 0;
    for (int32_t i = 0; i < c->faces.count; i++)
        if (c->over_start[i + 1] - c->over_start[i] > 1)
            s[n++] = (stack){c->over + c->over_start[i], c->over_start[i + 1] - c->over_start[i]};
    qsort(s, (size_t)n, sizeof *s, by_facets);
    for (int32_t i = 0; i < n; i++)
        if (kept == 0 || by_facets(&s[kept - 1], &s[i]) != 0) s[kept++] = s[i];
    return kept;
}

/* Bits by the first cell that each facet is over. */
static void stand_together(rg_pairs *p, const rg_cells *c)
{
    int32_t n = 0;
    for (int32_t f = 0; f < p->nf; f++) p->bit[f] = -1;
    for (int32_t j = 0; j < c->over_start[c->faces.count]; j++)
        if (p->bit[c->over[j]] < 0) p->bit[c->over[j]] = n++;
    for (int32_t f = 0; f < p->nf; f++)
        if (p->bit[f] < 0) p->bit[f] = n++; /* no wider than rounding */
    for (int32_t f = 0; f < p->nf; f++) p->of_bit[p->bit[f]] = f;
}

static rg_status number_pairs(rg_pairs *p)
{
    int64_t twice = 0;
    for (size_t i = 0; i < (size_t)p->nf * (size_t)p->words; i++) {
        p->before[i] = (int32_t)twice;
        twice += __builtin_popcountll(p->row[i]);
        if (twice > 2 * MOST_PAIRS) return RG_EFORMAT;
    }
    if (RG_MEM_ARRAYS(&p->mem, RG_ARRAY(p->facet, (size_t)twice / 2),
                      RG_ARRAY(p->number, (size_t)twice)) != RG_OK) return RG_ENOMEM;
    /* Rising by the lower facet, then by the bit of the other. */
    int32_t at = 0;
    for (int32_t f = 0; f < p->nf; f++) {
        p->start[f + 1] = p->start[f];
        for (int32_t w = 0; w < p->words; w++)
            for (uint64_t bits = row_of(p, p->row, f)[w]; bits; bits &= bits - 1) {
                const int32_t g = p->of_bit[64 * w + __builtin_ctzll(bits)];
                if (g > f) {
                    p->facet[p->count][0] = f, p->facet[p->count][1] = g;
                    p->number[at++] = p->count++;
                } else {
                    p->number[at++] = rg_pairs_find(p, g, f);
                }
                p->start[f + 1] = at;
            }
    }
    return RG_OK;
}

/* For each facet f and each g over it: the union of the stacks that have both. */
static rg_status find_common(rg_pairs *p, const stack *s, int32_t stacks, const rg_stop *stop)
{
    const size_t words = (size_t)p->words;
    int32_t *start = rg_mem_array(&p->mem, (size_t)p->nf + 2, sizeof *start), *of = NULL;
    uint64_t *bits = rg_mem_array(&p->mem, (size_t)stacks * words, sizeof *bits);
    uint64_t *sum = rg_mem_array(&p->mem, (size_t)p->nf * words, sizeof *sum);
    size_t word_room = 0, common_room = 0;
    int64_t total = 0;
    rg_status status = start && bits && sum ? RG_OK : RG_ENOMEM;
    for (int32_t i = 0; status == RG_OK && i < stacks; i++)
        for (int32_t j = 0; j < s[i].n; j++) {
            set(bits + (size_t)i * words, p->bit[s[i].facet[j]]);
            start[s[i].facet[j] + 2]++;
            total++;
        }
    if (total > INT32_MAX) status = RG_EFORMAT;
    if (status == RG_OK && !(of = rg_mem_array(&p->mem, (size_t)total, sizeof *of))) status = RG_ENOMEM;
    for (int32_t f = 2; status == RG_OK && f <= p->nf; f++) start[f] += start[f - 1];
    for (int32_t i = 0; status == RG_OK && i < stacks; i++)
        for (int32_t j = 0; j < s[i].n; j++) of[start[s[i].facet[j] + 1]++] = i;
    for (int32_t f = 0; status == RG_OK && f < p->nf; f++) {
        if (rg_stop_asked(stop)) status = RG_EFORMAT;
        for (int32_t k = start[f]; k < start[f + 1]; k++) {
            const stack *t = &s[of[k]];
            const uint64_t *add = bits + (size_t)of[k] * words;
            for (int32_t j = t->n - 1; j >= 0 && t->facet[j] > f; j--) {
                uint64_t *to = row_of(p, sum, t->facet[j]);
                for (size_t w = 0; w < words; w++) to[w] |= add[w];
            }
        }
        for (int32_t j = p->start[f]; status == RG_OK && j < p->start[f + 1]; j++) {
            const int32_t pair = p->number[j], g = p->facet[pair][1];
            if (g == f) continue; /* listed at the lower facet */
            uint64_t *from = row_of(p, sum, g);
            int64_t n = p->common_start[pair];
            status = RG_MEM_GROW(&p->mem, p->common_word, word_room, (size_t)n + words);
            if (status == RG_OK) status = RG_MEM_GROW(&p->mem, p->common, common_room, (size_t)n + words);
            if (status != RG_OK) break;
            clear(from, p->bit[f]), clear(from, p->bit[g]);
            for (size_t w = 0; w < words; w++) {
                if (from[w]) p->common_word[n] = (int32_t)w, p->common[n++] = from[w];
                from[w] = 0;
            }
            p->common_start[pair + 1] = n;
            if (n > MOST_WORDS) status = RG_EFORMAT;
        }
    }
    RG_MEM_FREE(&p->mem, start, of, bits, sum);
    return status;
}

rg_status rg_pairs_init(rg_pairs *p, const rg_memory *mem, const rg_cells *c, int32_t nf, const rg_stop *stop)
{
    memset(p, 0, sizeof *p);
    p->mem = *mem;
    p->nf = nf;
    p->words = (nf + 63) / 64;
    const size_t size = (size_t)nf * (size_t)p->words;
    stack *s;
    if (size > (size_t)MOST_ROW_WORDS) return RG_EFORMAT;
    rg_status status = RG_MEM_ARRAYS(mem, RG_ARRAY(s, (size_t)c->faces.count), RG_ARRAY(p->bit, (size_t)nf),
                                     RG_ARRAY(p->of_bit, (size_t)nf), RG_ARRAY(p->row, size), RG_ARRAY(p->before, size),
                                     RG_ARRAY(p->start, (size_t)nf + 1));
    if (status == RG_OK) stand_together(p, c);
    const int32_t stacks = status == RG_OK ? different_stacks(c, s) : 0;
    for (int32_t i = 0; status == RG_OK && i < stacks; i++) {
        if (rg_stop_asked(stop)) status = RG_EFORMAT;
        for (int32_t j = 0; j < s[i].n; j++)
            for (int32_t k = j + 1; k < s[i].n; k++) {
                set(row_of(p, p->row, s[i].facet[j]), p->bit[s[i].facet[k]]);
                set(row_of(p, p->row, s[i].facet[k]), p->bit[s[i].facet[j]]);
            }
    }
    if (status == RG_OK) status = number_pairs(p);
    if (status == RG_OK) status = RG_MEM_ARRAYS(mem, RG_ARRAY(p->common_start, (size_t)p->count + 1));
    if (status == RG_OK) status = find_common(p, s, stacks, stop);
    rg_mem_free(mem, s);
    return status;
}
