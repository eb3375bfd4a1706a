/* order.h -- numbers put in order, much faster than by a function that compares two of them.
 * Used by  pattern */
#ifndef RG_ORDER_H
#define RG_ORDER_H

#include <stdint.h>

typedef struct rg_keyed { double key; int32_t v, w; } rg_keyed;

/* list[n] by key, then by v; no key is NAN. In time proportional to n where keys are spread out, as those of drawings
 * are, and n log n wherever they lie. room[n], count[n]: scratch. */
void rg_order_keyed(rg_keyed *list, int32_t n, rg_keyed *room, int32_t *count);
/* The same of a few, without scratch; of more, by comparing. */
void rg_order_few(rg_keyed *list, int32_t n);

#endif
