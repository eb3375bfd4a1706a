#include "fold/drive.h"

#include <string.h>

static int side(char assignment) { return assignment == RG_VALLEY ? 1 : assignment == RG_MOUNTAIN ? -1 : 0; }

/* Creases that follow lean as far as the driven ones turn in the mean, and to the other side where these go against
 * their assignments: then it is the back of the paper that is folded. */
static void set_lean(rg_drive *d, const rg_mesh *m, const unsigned char *still)
{
    double far = 0;
    int32_t with = 0;
    for (int32_t i = 0; i < m->N; i++) {
        if (!rg_drive_is_driven(d, i)) continue;
        const int as = side(m->assignment[m->crease_edge[i]]);
        far += fabs(d->target[i]) / d->count;
        with += d->target[i] * as > 0 ? 1 : d->target[i] * as < 0 ? -1 : 0;
    }
    for (int32_t i = 0; i < m->N; i++) {
        const int follows = isnan(d->target[i]) && !(still && still[i]);
        d->lean[i] = rg_drive_is_driven(d, i) ? d->target[i] : follows
            ? (with < 0 ? -far : far) * side(m->assignment[m->crease_edge[i]]) : 0;
    }
}

void rg_drive_aim(rg_drive *d, const rg_mesh *m, const double *target, const unsigned char *still)
{
    d->count = 0;
    d->steepness = 0;
    for (int32_t i = 0; i < m->N; i++) {
        d->target[i] = i >= m->N - m->added ? 0 : target[i];
        d->count += rg_drive_is_driven(d, i);
    }
    set_lean(d, m, still);
    for (int32_t i = 0; i < m->N; i++)
        d->gradient[i] = rg_drive_is_driven(d, i) ? 1 / (d->count * d->target[i]) : 0;
    for (int32_t i = 0; i < m->N; i++) d->steepness = hypot(d->steepness, d->gradient[i]);
    for (int32_t i = 0; i < m->N; i++) d->along[i] = d->steepness > 0 ? d->gradient[i] / d->steepness : 0;
}

rg_status rg_drive_init(rg_drive *d, const rg_memory *mem, const rg_mesh *m, double sign)
{
    memset(d, 0, sizeof *d);
    d->mem = *mem;
    d->N = m->N;
    d->target = rg_mem_array(mem, (size_t)m->N, sizeof *d->target);
    d->gradient = rg_mem_array(mem, (size_t)m->N, sizeof *d->gradient);
    d->along = rg_mem_array(mem, (size_t)m->N, sizeof *d->along);
    d->lean = rg_mem_array(mem, (size_t)m->N, sizeof *d->lean);
    double *target = rg_mem_array(mem, (size_t)m->N, sizeof *target);
    unsigned char *still = m->still ? rg_mem_array(mem, (size_t)m->N, 1) : NULL;
    const int ok = d->target && d->gradient && d->along && d->lean && target && (still || !m->still);
    for (int32_t i = 0; ok && i < m->N; i++) target[i] = sign * m->target[m->crease_edge[i]];
    for (int32_t i = 0; ok && still && i < m->N; i++) still[i] = m->still[m->crease_edge[i]];
    if (ok) rg_drive_aim(d, m, target, still);
    else rg_drive_free(d);
    rg_mem_free(mem, target);
    rg_mem_free(mem, still);
    return ok ? RG_OK : RG_ENOMEM;
}

void rg_drive_free(rg_drive *d)
{
    if (!d->mem.resize) return;
    rg_mem_free(&d->mem, d->target);
    rg_mem_free(&d->mem, d->gradient);
    rg_mem_free(&d->mem, d->along);
    rg_mem_free(&d->mem, d->lean);
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
