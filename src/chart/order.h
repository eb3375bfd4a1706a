/* order.h -- the order that a method shows: how its error falls with its step, on a smooth stretch of the path.
 * Paper    eq. (10), which is of order 1        Uses  reference.h        Used by  chart.c relaxed.c
 *
 * Two orders. Open: the formula alone, nothing closed and no residual fed back, from one frame of the reference to a
 * later one. Closed: the method as it folds. Where the sheet can go one way only, whoever closes is exact whatever its
 * step, and feeding the residual back makes Euler's method one of order 2; along a freedom of the sheet the order of
 * the formula is what remains. */
#ifndef RG_ORDER_H
#define RG_ORDER_H

#include "chart/reference.h"

enum { RG_ORDERS = 4, RG_ORDER_POINTS = 6 };

typedef struct rg_slope {
    double slope;                    /* NAN: none can be seen */
    int exact;                       /* the error is rounding whatever the step */
    int32_t points;
    double error[RG_ORDER_POINTS];   /* of 2^k times as many steps */
} rg_slope;

typedef struct rg_order {
    rg_method method; /* EULER, NEWTON, HEUN, RK4 */
    rg_slope open, closed;
} rg_order;

/* From frame `from` of the reference to frame `to`. RG_ENOMEM. */
rg_status rg_order_measure(rg_order order[RG_ORDERS], const rg_mesh *m, const rg_settings *s, const rg_reference *ref,
                           int32_t from, int32_t to, rg_diag *why);

/* Slope of log y over log x by least squares; NAN: fewer than two points. */
double rg_slope_of(int32_t n, const double *x, const double *y);

#endif
