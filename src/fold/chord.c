#include "fold/chord.h"
#include "fold/closing.h"
#include "fold/tuning.h"

#include <string.h>

double rg_chord_size(const rg_relax *F, const double *a, const double *b)
{
    double far = 0;
    for (int32_t i = 0; i < F->N; i++) far = fmax(far, fabs(a[i] - b[i]));
    return far;
}

typedef struct chord {
    const double *a, *b; /* [n] closed */
    double s0, s1, size; /* progress there; the largest change of a crease */
    double *spare;
} chord;

/* The largest change of a crease from a point of the line from low to high. */
static double off_line(const rg_relax *F, const double *z, const double *low, const double *high, double part)
{
    double off = 0;
    for (int32_t i = 0; i < F->N; i++) off = fmax(off, fabs(z[i] - (1 - part) * low[i] - part * high[i]));
    return off;
}

/* Does the path stay on its branch between its states low and high, parts `from` and `to` of the chord? Its middle,
 * closed, must lie as near to the chord as a step to its prediction. What is smooth lies a quarter as near to the chord
 * of each half, and so on, while a leap to another branch stays in one of the halves as large as it is. */
static int is_smooth(rg_relax *F, const chord *c, const double *low, double from, const double *high, double to,
                     int32_t halved)
{
    double *middle = c->spare + (size_t)(halved + 1) * (size_t)F->n;
    const double part = (from + to) / 2, s = (1 - part) * c->s0 + part * c->s1;
    const double near = FARTHEST_CORRECTION * c->size / 2 + LITTLE;
    /* near a singular state, what closes to tol is known to its root */
    const double smooth = SMOOTH * c->size + sqrt(F->tol);
    for (int32_t i = 0; i < F->n; i++) middle[i] = (1 - part) * c->a[i] + part * c->b[i];
    if (!rg_closing_between(F, c->a, c->b, s, CORRECTIONS_AT_END, middle, c->spare)) return 0;
    if (!(off_line(F, middle, c->a, c->b, part) <= near)) return 0;
    if (off_line(F, middle, low, high, 0.5) <= smooth) return 1;
    return halved < MOST_HALVES && is_smooth(F, c, low, from, middle, part, halved + 1) &&
           is_smooth(F, c, middle, part, high, to, halved + 1);
}

int rg_chord_holds(rg_relax *F, const double *a, const double *b, double *spare)
{
    const size_t n = (size_t)F->n;
    double least;
    const chord c = {a, b, rg_closing_progress(F, a, &least), rg_closing_progress(F, b, &least), rg_chord_size(F, a, b),
                     spare + n};
    memcpy(spare, F->scale, n * sizeof *spare);
    const int holds = is_smooth(F, &c, a, 0, b, 1, 0);
    memcpy(F->scale, spare, n * sizeof *spare);
    return holds;
}

/* The last node with progress at most s, and not the last of all. */
static int32_t node_before(const rg_relax *F, double s)
{
    int32_t low = 0, high = F->nodes - 1;
    while (high - low > 1) {
        const int32_t middle = (low + high) / 2;
        if (F->node_s[middle] <= s) low = middle;
        else high = middle;
    }
    return low;
}

/* Part t of the chord from a to b. Near a singular state ways of vertices are of second order: at a, or at b. */
static void take_part(const rg_relax *F, const double *a, const double *b, double t, int at_a, int at_b, double *z)
{
    for (int32_t i = 0; i < F->n; i++) {
        const double part = i < F->N ? t : at_a ? t * t : at_b ? 1 - (1 - t) * (1 - t) : t;
        z[i] = (1 - part) * a[i] + part * b[i];
    }
}

/* z: part t of the path between node k and the next one, closed, its progress held. Where what lies on the chord does
 * not close, what lies on that of its half does, whose middle has been closed: so often it is halved. */
static int read_between(rg_relax *F, int32_t k, double t, double *z)
{
    const double *a = F->node + (size_t)k * (size_t)F->n, *b = a + F->n, *low = a, *high = b;
    const double s0 = F->node_s[k], s1 = F->node_s[k + 1];
    int at_low = k == 0 && F->from_is_singular, at_high = F->landed && k == F->nodes - 2;
    double from = 0, to = 1;
    for (int32_t halved = 0;; halved++) {
        take_part(F, low, high, (t - from) / (to - from), at_low, at_high, z);
        rg_closing_even_out(F, z);
        if (rg_closing_between(F, a, b, s0 + t * (s1 - s0), CORRECTIONS_AT_END, z, F->trial)) return 1;
        if (halved == MOST_HALVES) return 0;
        const double middle = (from + to) / 2;
        const int is_low = t < middle;
        double *closed = is_low ? F->wish : F->chord; /* neither is at work here */
        take_part(F, low, high, 0.5, at_low, at_high, z);
        rg_closing_even_out(F, z);
        if (!rg_closing_between(F, a, b, s0 + middle * (s1 - s0), CORRECTIONS_AT_END, z, F->trial)) return 0;
        memcpy(closed, z, (size_t)F->n * sizeof *z);
        if (is_low) high = closed, to = middle, at_high = 0;
        else low = closed, from = middle, at_low = 0;
    }
}

double rg_chord_at(rg_relax *F, double s, double *z)
{
    const size_t n = (size_t)F->n;
    const int32_t last = F->nodes - 1, k = last > 0 ? node_before(F, s) : 0;
    const double s0 = F->node_s[k], s1 = last > 0 ? F->node_s[k + 1] : s0;
    const double t = s >= F->node_s[last] ? 1 : s1 > s0 ? fmin(1, fmax(0, (s - s0) / (s1 - s0))) : 1;
    if (t > 0 && t < 1 && read_between(F, k, t, z)) return F->closure;
    /* A node, closed as it is; or the nearer one, where nothing between closes. */
    const int32_t at = s >= F->node_s[last] ? last : last > 0 && t >= 0.5 ? k + 1 : k;
    memcpy(z, F->node + (size_t)at * n, n * sizeof *z);
    return rg_closing_assemble(F, z, 0, NULL);
}
