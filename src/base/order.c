#include "base/order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* So few are put in order faster by inserting one after the other, without a function to compare them. */
enum { A_FEW = 16 };

static int by_key(const void *a, const void *b)
{
    const rg_keyed *p = a, *q = b;
    if (p->key != q->key) return p->key < q->key ? -1 : 1;
    return p->v < q->v ? -1 : p->v > q->v;
}

void rg_order_few(rg_keyed *list, int32_t n)
{
    if (n > A_FEW) {
        qsort(list, (size_t)n, sizeof *list, by_key);
        return;
    }
    for (int32_t i = 1; i < n; i++) {
        const rg_keyed one = list[i];
        int32_t k = i;
        for (; k > 0; k--) {
            const rg_keyed *p = &list[k - 1];
            if (!(p->key > one.key || (p->key == one.key && p->v > one.v))) break;
            list[k] = *p;
        }
        list[k] = one;
    }
}

/* Grows with the key, rounding or not, and is less than the number of keys. */
static int32_t bucket(const rg_keyed *one, double low, double scale) { return (int32_t)((one->key - low) * scale); }

/* As many buckets as numbers, each for a part of the range as long as the others': one number in each, more or less.
 * Where many fall into one, they are compared. */
void rg_order_keyed(rg_keyed *list, int32_t n, rg_keyed *room, int32_t *count)
{
    if (n <= A_FEW) {
        rg_order_few(list, n);
        return;
    }
    double low = list[0].key, high = low;
    for (int32_t i = 1; i < n; i++) {
        if (list[i].key < low) low = list[i].key;
        if (list[i].key > high) high = list[i].key;
    }
    const double scale = (n - 1) / (high - low);
    if (!(high > low) || !isfinite(high - low) || !isfinite(scale)) {
        qsort(list, (size_t)n, sizeof *list, by_key);
        return;
    }
    memset(count, 0, (size_t)n * sizeof *count);
    for (int32_t i = 0; i < n; i++) count[bucket(&list[i], low, scale)]++;
    for (int32_t i = 0, at = 0; i < n; i++) {
        const int32_t here = count[i];
        count[i] = at;
        at += here;
    }
    for (int32_t i = 0; i < n; i++) room[count[bucket(&list[i], low, scale)]++] = list[i];
    memcpy(list, room, (size_t)n * sizeof *list);
    for (int32_t i = 0, from = 0; i < n; from = count[i++]) { /* each is at its end now */
        rg_order_few(list + from, count[i] - from);
    }
}
