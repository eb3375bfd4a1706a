#include "kinematics/kawasaki.h"

#include <math.h>

/* A vertex counts as flat-foldable when Kawasaki's sum is off by no more (radians, 1.15 degrees): twice what drawings
 * by hand are. */
static const double FLAT_FOLDABLE = 0.02;

static int is_drawn(const rg_mesh *m, int32_t crease) { return crease < m->N - m->added; }

int32_t rg_kawasaki_alternate(const rg_mesh *m, int32_t k, const double *theta, double *sum, double *sign)
{
    const int32_t first = m->loop_start[k], last = m->loop_start[k + 1];
    int32_t n = 0, start = -1, before = -1;
    double turn = 1, angle = 0, total = 0;
    for (int32_t j = first; j < last; j++) {
        if (sign) sign[j - first] = 0;
        if (is_drawn(m, m->loop_crease[j]) && start < 0) start = j;
    }
    for (int32_t i = 0; start >= 0 && i <= last - first; i++) {
        const int32_t j = first + (start - first + i) % (last - first);
        if (is_drawn(m, m->loop_crease[j])) {
            if (before >= 0) {
                total += turn * angle;
                if (sign) sign[j - first] += turn, sign[before - first] -= turn;
                turn = -turn;
                n++;
            }
            before = j;
            angle = 0;
        }
        angle += theta[j];
    }
    *sum = total; /* eq. (18) */
    return n;
}

int rg_kawasaki_holds(const rg_mesh *m, int32_t k, const double *theta)
{
    double sum;
    const int32_t n = rg_kawasaki_alternate(m, k, theta, &sum, NULL);
    return n >= 4 && n % 2 == 0 && fabs(sum) <= FLAT_FOLDABLE; /* eq. (16) */
}
