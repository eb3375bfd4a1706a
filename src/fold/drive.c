#include "fold/drive.h"

#include <string.h>

rg_status rg_drive_init(rg_drive *d, const rg_memory *mem, const rg_mesh *m, double sign)
{
    memset(d, 0, sizeof *d);
    d->mem = *mem;
    d->N = m->N;
    d->target = rg_mem_array(mem, (size_t)m->N, sizeof *d->target);
    d->gradient = rg_mem_array(mem, (size_t)m->N, sizeof *d->gradient);
    d->along = rg_mem_array(mem, (size_t)m->N, sizeof *d->along);
    if (!d->target || !d->gradient || !d->along) {
        rg_drive_free(d);
        return RG_ENOMEM;
    }
    for (int32_t i = 0; i < m->N; i++) {
        double target = sign * m->target[m->crease_edge[i]];
        d->target[i] = i >= m->N - m->added ? 0 : target;
        d->count += rg_drive_is_driven(d, i);
    }
    for (int32_t i = 0; i < m->N; i++)
        d->gradient[i] = rg_drive_is_driven(d, i) ? 1 / (d->count * d->target[i]) : 0;
    for (int32_t i = 0; i < m->N; i++) d->steepness = hypot(d->steepness, d->gradient[i]);
    for (int32_t i = 0; i < m->N && d->steepness > 0; i++) d->along[i] = d->gradient[i] / d->steepness;
    return RG_OK;
}

void rg_drive_free(rg_drive *d)
{
    if (!d->mem.resize) return;
    rg_mem_free(&d->mem, d->target);
    rg_mem_free(&d->mem, d->gradient);
    rg_mem_free(&d->mem, d->along);
    memset(d, 0, sizeof *d);
}

int rg_drive_is_driven(const rg_drive *d, int32_t i)
{
    return !isnan(d->target[i]) && d->target[i] != 0;
}

double rg_drive_progress(const rg_drive *d, const double *rho)
{
    double s = 0;
    for (int32_t i = 0; i < d->N; i++) s += d->gradient[i] * rho[i];
    return s;
}

void rg_drive_wish(const rg_drive *d, const double *rho, double s, double *wish)
{
    for (int32_t i = 0; i < d->N; i++) wish[i] = isnan(d->target[i]) ? 0 : (d->target[i] - rho[i]) / (1 - s);
}
