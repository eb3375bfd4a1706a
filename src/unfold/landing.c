#include "unfold/landing.h"

#include <math.h>

/* Of what it is open by, a crease is closed by this part in a step; the pattern goes twice as fast, at first order. */
static const double PART = 0.2;
/* Done when creases are open by less than this part of their angle, in the mean; then it is thinner than a drawing is
 * exact. */
static const double ENOUGH = 2e-4;
static const int STEPS = 80;
/* A step that gets less than this part of what was wished is a jam. */
static const double JAMMED = 0.02;

static double open_by(const rg_stride *s, const double *end)
{
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < s->P->N; i++) {
        if (end[i] == 0) continue;
        sum += fabs(end[i] - s->z[i]) / fabs(end[i]);
        n++;
    }
    return n ? sum / n : 0;
}

rg_status rg_landing_run(rg_stride *s, const double *end, rg_status (*keep)(void *ctx, const double *z), void *ctx,
                         double *left)
{
    const rg_linkage *P = s->P;
    rg_status status = RG_OK;
    int jams = 0;
    *left = open_by(s, end);
    for (int n = 0; n < STEPS && *left > ENOUGH && status == RG_OK && rg_nearest_work(&s->q) < s->budget; n++) {
        int gone;
        for (int32_t i = 0; i < P->n; i++) s->wish[i] = PART * (i < P->N ? 1 : 2 - PART) * (end[i] - s->z[i]);
        status = rg_stride_towards(s, 0, &gone);
        if (status != RG_OK || !gone) break;
        const double now = open_by(s, end);
        jams = now > *left * (1 - JAMMED) ? jams + 1 : 0;
        *left = now;
        status = keep(ctx, s->z);
        if (jams > 2) break;
    }
    return status;
}
