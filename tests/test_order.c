/* base/order.c: what comes out is in order, and all that went in, however the keys lie. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/order.h"
#include "near.h"

#include <float.h>
#include <stdlib.h>

enum { MOST = 5000, WAYS = 9 };

/* Spread out, in heaps, all the same, in order, the other way round, far apart, next to each other, around zero. */
static double key(int way, int i, int n, unsigned *seed)
{
    const double x = noise(seed);
    switch (way) {
    case 0: return x;
    case 1: return 1e-9 * x + (i % 3 == 0);
    case 2: return 1.25;
    case 3: return i;
    case 4: return n - i / 2;
    case 5: return x * DBL_MAX;
    case 6: return x * DBL_MIN * DBL_EPSILON * 8;
    case 7: return i % 2 ? 0.0 : -0.0;
    default: return pow(10, 300 * x);
    }
}

static void everything_in_order(void **state)
{
    (void)state;
    static const int sizes[] = {0, 1, 2, 3, 16, 17, 40, 1000, MOST};
    static rg_keyed list[MOST], room[MOST], was[MOST];
    static int32_t count[MOST];
    static unsigned char seen[MOST];
    unsigned seed = 29;
    for (int way = 0; way < WAYS; way++)
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
            const int n = sizes[k];
            memset(seen, 0, sizeof seen);
            for (int i = 0; i < n; i++) { /* v: every number once, not in order */
                const int32_t v = (int32_t)((i * 7919LL + 13) % n);
                was[v] = list[i] = (rg_keyed){key(way, i, n, &seed), v, -i};
            }
            rg_order_keyed(list, n, room, count);
            for (int i = 0; i < n; i++) {
                const rg_keyed *p = i > 0 ? &list[i - 1] : NULL, *q = &list[i];
                assert_true(!p || p->key < q->key || (p->key == q->key && p->v < q->v));
                assert_false(seen[list[i].v]++);
                assert_true(list[i].key == was[list[i].v].key && list[i].w == was[list[i].v].w);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(everything_in_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
