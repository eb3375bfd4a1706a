#include "write/palette.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Colours that agree in their upper bits are one tint. */
enum { BITS = 6, TINTS = 1 << 3 * BITS };
enum { UNKNOWN = 255 };

struct rg_tint {
    double sum[3];
    double count;
};

typedef struct swatch { /* a tint that was seen */
    double at[3], weight;
    int32_t tint;
} swatch;

typedef struct box { /* swatches first ... last - 1, to be shown in one colour */
    int32_t first, last;
    double error; /* sum of weight * squared distance from the mean */
} box;

rg_status rg_palette_init(rg_palette *p, const rg_memory *mem)
{
    *p = (rg_palette){.mem = *mem};
    return RG_MEM_ARRAYS(mem, RG_ARRAY(p->tint, TINTS), RG_ARRAY(p->nearest, TINTS));
}

void rg_palette_free(rg_palette *p)
{
    if (!p->mem.resize) return;
    RG_MEM_FREE(&p->mem, p->tint, p->nearest);
    memset(p, 0, sizeof *p);
}

static int tint_of(const unsigned char rgb[3])
{
    const int low = 8 - BITS;
    return (rgb[0] >> low) << 2 * BITS | (rgb[1] >> low) << BITS | rgb[2] >> low;
}

void rg_palette_see(rg_palette *p, const unsigned char *rgb, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++, rgb += 3) {
        struct rg_tint *t = &p->tint[tint_of(rgb)];
        for (int k = 0; k < 3; k++) t->sum[k] += rgb[k];
        t->count++;
    }
}

static void mean_of(const swatch *s, const box *b, double mean[3])
{
    double weight = 0;
    mean[0] = mean[1] = mean[2] = 0;
    for (int32_t i = b->first; i < b->last; i++) {
        for (int k = 0; k < 3; k++) mean[k] += s[i].weight * s[i].at[k];
        weight += s[i].weight;
    }
    for (int k = 0; k < 3; k++) mean[k] /= weight;
}

static double error_of(const swatch *s, const box *b, double by_axis[3])
{
    double mean[3];
    mean_of(s, b, mean);
    by_axis[0] = by_axis[1] = by_axis[2] = 0;
    for (int32_t i = b->first; i < b->last; i++)
        for (int k = 0; k < 3; k++) by_axis[k] += s[i].weight * (s[i].at[k] - mean[k]) * (s[i].at[k] - mean[k]);
    return by_axis[0] + by_axis[1] + by_axis[2];
}

#define COMPARE_ALONG(axis)                                          \
    static int along_##axis(const void *a, const void *b)            \
    {                                                                \
        const swatch *p = a, *q = b;                                 \
        if (p->at[axis] != q->at[axis]) return p->at[axis] < q->at[axis] ? -1 : 1; \
        return p->tint < q->tint ? -1 : p->tint > q->tint;           \
    }
COMPARE_ALONG(0)
COMPARE_ALONG(1)
COMPARE_ALONG(2)

/* Cuts a box in two across the axis with most error, where that leaves least of it: between two parts that is greatest
 * where weight * weight * distance of the means squared is. */
static void cut(swatch *s, box *a, box *b)
{
    static int (*const along[3])(const void *, const void *) = {along_0, along_1, along_2};
    double by_axis[3], total = 0, weights = 0, sum = 0, weight = 0, best = -1;
    error_of(s, a, by_axis);
    const int axis = by_axis[0] >= by_axis[1] && by_axis[0] >= by_axis[2] ? 0 : by_axis[1] >= by_axis[2] ? 1 : 2;
    qsort(s + a->first, (size_t)(a->last - a->first), sizeof *s, along[axis]);
    for (int32_t i = a->first; i < a->last; i++) total += s[i].weight * s[i].at[axis], weights += s[i].weight;
    int32_t middle = a->first + 1;
    for (int32_t i = a->first; i + 1 < a->last; i++) {
        sum += s[i].weight * s[i].at[axis], weight += s[i].weight;
        const double apart = sum / weight - (total - sum) / (weights - weight);
        const double gain = weight * (weights - weight) * apart * apart;
        if (gain > best) best = gain, middle = i + 1;
    }
    *b = (box){middle, a->last, 0};
    a->last = middle;
    a->error = error_of(s, a, by_axis);
    b->error = error_of(s, b, by_axis);
}

static int32_t cut_all(swatch *s, int32_t n, box *boxes)
{
    int32_t count = n > 0;
    double by_axis[3];
    boxes[0] = (box){0, n, 0};
    if (n > 0) boxes[0].error = error_of(s, &boxes[0], by_axis);
    while (count > 0 && count < RG_PALETTE_COLOURS) {
        int32_t worst = 0;
        for (int32_t i = 1; i < count; i++)
            if (boxes[i].error > boxes[worst].error) worst = i;
        if (!(boxes[worst].error > 0) || boxes[worst].last - boxes[worst].first < 2) break;
        cut(s, &boxes[worst], &boxes[count]);
        count++;
    }
    return count;
}

rg_status rg_palette_choose(rg_palette *p)
{
    int32_t n = 0;
    box boxes[RG_PALETTE_COLOURS];
    for (int t = 0; t < TINTS; t++) n += p->tint[t].count > 0;
    swatch *s = rg_mem_array(&p->mem, (size_t)n, sizeof *s);
    if (!s) return RG_ENOMEM;
    n = 0;
    for (int t = 0; t < TINTS; t++) {
        const struct rg_tint *seen = &p->tint[t];
        if (!(seen->count > 0)) continue;
        s[n] =
            (swatch){.weight = sqrt(seen->count), .tint = t}; /* the root: thin lines count for more than their area */
        for (int k = 0; k < 3; k++) s[n].at[k] = seen->sum[k] / seen->count;
        n++;
    }
    p->colours = cut_all(s, n, boxes);
    for (int32_t i = 0; i < p->colours; i++) {
        double mean[3];
        mean_of(s, &boxes[i], mean);
        for (int k = 0; k < 3; k++) p->colour[i][k] = (unsigned char)(mean[k] + 0.5);
    }
    memset(p->nearest, UNKNOWN, TINTS);
    rg_mem_free(&p->mem, s);
    return RG_OK;
}

int rg_palette_index(rg_palette *p, const unsigned char rgb[3])
{
    unsigned char *nearest = &p->nearest[tint_of(rgb)];
    if (*nearest != UNKNOWN) return *nearest;
    const int low = 8 - BITS, half = 1 << (low - 1);
    int least = INT_MAX;
    for (int i = 0; i < p->colours; i++) {
        int d = 0;
        for (int k = 0; k < 3; k++) {
            const int off = p->colour[i][k] - ((rgb[k] >> low << low) + half);
            d += off * off;
        }
        if (d < least) least = d, *nearest = (unsigned char)i;
    }
    return *nearest;
}
