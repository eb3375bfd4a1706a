#include "chart/exact.h"

#include <string.h>

/* Sector angles and ratios of a drawing in 16 decimals agree far better, those of one in three decimals do not. */
static const double AGREES = 1e-9;
static const int BISECTIONS = 60;

void rg_exact_free(rg_exact *x)
{
    if (!x->mem.resize) return;
    rg_mem_free(&x->mem, x->c);
    memset(x, 0, sizeof *x);
}

/* tan(rho / 2) of the four creases at vertex k over that of its first one. Zero: it is no such vertex, or its mountains
 * and valleys are not those of one. */
static int ratios(const rg_mesh *m, int32_t k, double tangent[4])
{
    const int32_t at = m->loop_start[k];
    const double *theta = m->loop_theta + at;
    double sign[4];
    if (m->loop_start[k + 1] - at != 4 || !(fabs(theta[0] + theta[2] - RG_PI) <= AGREES)) return 0;
    for (int i = 0; i < 4; i++) {
        const double target = m->target[m->crease_edge[m->loop_crease[at + i]]];
        sign[i] = target > 0 ? 1 : target < 0 ? -1 : 0; /* NaN: 0 */
        if (sign[i] == 0) return 0;
    }
    const int alike = sign[0] == sign[2]; /* then the other two are not */
    if (alike == (sign[1] == sign[3])) return 0;
    const double a = theta[0], b = theta[1];
    const double p = alike ? -cos((a + b) / 2) / cos((a - b) / 2) : sin((a + b) / 2) / sin((a - b) / 2);
    if (!(fabs(p) > AGREES && fabs(p) < 1 / AGREES)) return 0;
    tangent[0] = 1;
    tangent[1] = p;
    tangent[2] = alike ? 1 : -1;
    tangent[3] = alike ? -p : p;
    return sign[1] * sign[0] * p > 0; /* else it is mountain and valley of the other way to fold */
}

/* c of the creases at vertex k from any that is known there. Zero: they do not agree. */
static int spread(rg_exact *x, const rg_mesh *m, int32_t k, int *news)
{
    const int32_t *crease = m->loop_crease + m->loop_start[k];
    double tangent[4], unit = 0;
    if (!ratios(m, k, tangent)) return 0;
    for (int i = 0; i < 4 && unit == 0; i++) unit = x->c[crease[i]] / tangent[i];
    if (unit == 0) return 1;
    for (int i = 0; i < 4; i++) {
        double *c = &x->c[crease[i]];
        if (*c == 0) *c = unit * tangent[i], *news = 1;
        else if (!(fabs(*c / (unit * tangent[i]) - 1) <= AGREES)) return 0;
    }
    return 1;
}

rg_status rg_exact_init(rg_exact *x, const rg_memory *mem, const rg_mesh *m)
{
    memset(x, 0, sizeof *x);
    x->mem = *mem;
    x->N = m->N;
    x->c = rg_mem_array(mem, (size_t)m->N, sizeof *x->c);
    if (!x->c) {
        rg_exact_free(x);
        return RG_ENOMEM;
    }
    if (m->M == 0) return RG_OK;
    const int32_t first = m->loop_crease[0];
    x->c[first] = m->target[m->crease_edge[first]] < 0 ? -1 : 1;
    for (int news = 1; news;) {
        news = 0;
        for (int32_t k = 0; k < m->M; k++)
            if (!spread(x, m, k, &news)) return RG_OK;
    }
    for (int32_t i = 0; i < m->N; i++)
        if (x->c[i] == 0) return RG_OK; /* not reached: it folds by itself */
    x->found = 1;
    return RG_OK;
}

static void at(const rg_exact *x, double sign, double u, double *rho)
{
    for (int32_t i = 0; i < x->N; i++) rho[i] = sign * 2 * atan2(x->c[i] * sin(u), cos(u));
}

void rg_exact_at(const rg_exact *x, const rg_drive *d, double s, double *rho)
{
    const double sign = x->c[0] * d->target[0] < 0 ? -1 : 1; /* mountain and valley may be exchanged */
    double low = 0, high = RG_PI / 2;
    for (int n = 0; n < BISECTIONS; n++) {
        const double u = (low + high) / 2;
        at(x, sign, u, rho);
        if (rg_drive_progress(d, rho) < s) low = u;
        else high = u;
    }
    at(x, sign, s >= 1 ? RG_PI / 2 : (low + high) / 2, rho);
}
