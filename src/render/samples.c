#include "render/samples.h"

#include <math.h>

enum { FINE = RG_SAMPLES_FINE, LANE = 20 };
#define MARK ((UINT32_C(1) << RG_SAMPLES_MARK_BITS) - 1)

/* ---- lines */

/* Not fmin and fmax: these are calls, and what is not a number may come out as the limit. */
static double lesser(double a, double b) { return a < b ? a : b; }
static double greater(double a, double b) { return a > b ? a : b; }

/* The first whole number n from 0 to `most` with n + 1/2 beyond x. */
static int32_t centre_beyond(double x, int32_t most)
{
    return x > -0.5 ? x < most ? (int32_t)(x + 0.5) : most : 0;
}

/* On a row a line is what its long sides and what its ends leave of it: |along x - at| <= reach for both. A side that
 * the row is parallel to leaves all; the first and the last row have seen to it. */
typedef struct strip { double slope, reach; } strip;

static strip strip_of(double d, double by, double reach)
{
    return d != 0 ? (strip){by / d, reach / fabs(d)} : (strip){0, INFINITY};
}

void rg_samples_draw(const rg_samples *s, const rg_samples_line *l)
{
    const double dx = l->x[1] - l->x[0], dy = l->y[1] - l->y[0], length = sqrt(dx * dx + dy * dy);
    const double ex = length > 0 ? dx / length : 1, ey = length > 0 ? dy / length : 0, half = l->half;
    const double far = 0.5 * length + 0.5 * half;
    const double mx = 0.5 * ((double)l->x[0] + l->x[1]) - s->x, my = 0.5 * ((double)l->y[0] + l->y[1]) - s->y;
    /* Inside: |ey (x - mx) - ex (y - my)| <= half and |ex (x - mx) + ey (y - my)| <= far. */
    const strip side = strip_of(ey, ex, half), end = strip_of(ex, -ey, far);
    const double tall = fabs(ey) * far + fabs(ex) * half;
    const int32_t last = centre_beyond(my + tall, s->height);
    for (int32_t row = centre_beyond(my - tall, s->height); row < last; row++) {
        const double y = row + 0.5 - my, a = side.slope * y, b = end.slope * y;
        const int32_t to = centre_beyond(mx + lesser(a + side.reach, b + end.reach), s->width);
        uint32_t *at = s->at + (size_t)row * (size_t)s->pitch;
        for (int32_t i = centre_beyond(mx + greater(a - side.reach, b - end.reach), s->width); i < to; i++)
            if (l->mark ? (at[i] & MARK) == l->mark : at[i] != 0)
                at[i] = (at[i] & MARK) | l->ink << RG_SAMPLES_MARK_BITS;
    }
}

/* ---- pixels */

uint64_t rg_samples_colour(const unsigned char rgb[3])
{
    return (uint64_t)rgb[0] | (uint64_t)rgb[1] << LANE | (uint64_t)rgb[2] << 2 * LANE;
}

static unsigned char mean_of(uint64_t sum, int lane)
{
    const unsigned n = FINE * FINE;
    return (unsigned char)(((unsigned)(sum >> lane * LANE & ((1u << LANE) - 1)) + n / 2) / n);
}

void rg_samples_mean(const rg_samples *s, const uint64_t *paper, const uint64_t *ink, unsigned char *rgb, size_t stride)
{
    for (int32_t y = 0; y < s->height / FINE; y++) {
        const size_t row = (size_t)(FINE * y) * (size_t)s->pitch;
        unsigned char *to = rgb + (size_t)y * stride;
        for (int32_t x = 0; x < s->width / FINE; x++, to += 3) {
            const size_t first = row + (size_t)(FINE * x);
            uint32_t differ = 0, any = 0;
            for (int i = 0; i < FINE; i++)
                for (int j = 0; j < FINE; j++) {
                    const uint32_t p = s->at[first + (size_t)i * (size_t)s->pitch + (size_t)j];
                    differ |= p ^ s->at[first], any |= p;
                }
            if (!any) continue;
            const uint64_t behind = rg_samples_colour(to);
            const int n = differ || s->colour ? FINE : 1;
            uint64_t sum = 0;
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) {
                    const size_t at = first + (size_t)i * (size_t)s->pitch + (size_t)j;
                    const uint32_t p = s->at[at];
                    sum += p > MARK    ? ink[p >> RG_SAMPLES_MARK_BITS]
                           : !p        ? behind
                           : s->colour ? s->colour[at]
                                       : paper[p];
                }
            if (n == 1) sum *= FINE * FINE;
            for (int k = 0; k < 3; k++) to[k] = mean_of(sum, k);
        }
    }
}
