#include "unfold/home.h"
#include "unfold/stride.h"

#include <string.h>

/* Less is next to flat; and steps, radians. */
static const double NEXT_TO_FLAT = 2 * RG_DEG, STEP = 6 * RG_DEG, CLOSED = 1e-11, CLOSED_HALF = 1e-13;
/* Radians: a sheet whose creases are all folded by less lies all but flat, its facets side by side. */
static const double LIES_NEARLY = 20 * RG_DEG;
static const double LEAST_AREA = 0.05; /* of a facet, of what it was; steps are refused from twice as much on */
static const int NEWTON = 12;

static rg_status keep_flat(rg_track *p)
{
    memset(p->scratch, 0, (size_t)p->P->n * sizeof *p->scratch);
    return rg_track_keep(p, p->scratch);
}

rg_status rg_home_finish(rg_track *p, const double *z)
{
    rg_stride_scale(p->P, 1, p->q->scale);
    for (int32_t i = 0; i < p->P->n; i++) p->scratch[i] = z[i] / 2;
    rg_status s = RG_OK;
    if (rg_stride_close(p->P, p->q, p->scratch, CLOSED_HALF, NEWTON)) s = rg_track_keep(p, p->scratch);
    return s == RG_OK ? keep_flat(p) : s;
}

/* The crease that meets crease i at a corner v where no other that is still folded does; -1: it is none, or there
 * are more. */
static int32_t goes_on_as(const rg_mesh *m, const double *z, int32_t i, int32_t v)
{
    int32_t found = -1;
    for (int32_t k = 0; k < m->N; k++) {
        const int32_t *ends = m->edge[m->crease_edge[k]];
        if (k == i || z[k] == 0 || (ends[0] != v && ends[1] != v)) continue;
        if (found >= 0) return -1;
        found = k;
    }
    return found;
}

/* Creases that are next to flat are flat, of the pattern as given; what is left of straight folds is folded evenly. */
static void tidy(const rg_linkage *P, const double *z, double *out)
{
    const rg_mesh *m = P->mesh;
    memset(out, 0, (size_t)P->n * sizeof *out);
    for (int32_t i = 0; i < P->N; i++) out[i] = fabs(z[i]) < NEXT_TO_FLAT ? 0 : z[i];
    for (int32_t i = 0; i < P->N; i++)
        for (int end = 0; out[i] != 0 && end < 2; end++) {
            const int32_t k = goes_on_as(m, out, i, m->edge[m->crease_edge[i]][end]);
            if (k > i && fabs(out[k] - out[i]) < NEXT_TO_FLAT) out[k] = out[i];
        }
}

static double largest(const rg_linkage *P, const double *z)
{
    double most = 0;
    for (int32_t i = 0; i < P->N; i++) most = fmax(most, fabs(z[i]));
    return most;
}

/* All creases of `from` go to 0 evenly, with the pattern that it has, from part `first` on; and then the pattern. */
static rg_status go_straight(rg_track *p, const double *from, int first, int *home)
{
    const int32_t N = p->P->N, n = p->P->n, count = p->count;
    const int steps = (int)ceil(largest(p->P, from) / STEP);
    rg_status s = RG_OK;
    int moved = 0;
    rg_stride_scale(p->P, 1, p->q->scale);
    *home = 1;
    for (int k = first; s == RG_OK && *home && k < steps; k++) {
        const double left = 1 - (double)k / steps;
        for (int32_t i = 0; i < n; i++) p->scratch[i] = i < N ? left * from[i] : from[i];
        *home = rg_stride_close(p->P, p->q, p->scratch, CLOSED, NEWTON);
        for (int32_t i = 0; i < N; i++) *home &= fabs(p->scratch[i] - left * from[i]) < NEXT_TO_FLAT;
        *home = *home && rg_linkage_least_area(p->P, p->scratch + N) >= LEAST_AREA;
        if (!*home) break;
        rg_linkage_put(p->P, p->scratch);
        *home = !rg_track_crosses(p, p->P->p);
        if (*home) s = rg_track_keep(p, p->scratch);
    }
    if (s != RG_OK || !*home) {
        p->count = count;
        return s;
    }
    for (int32_t i = 0; i < n; i++) {
        p->scratch[i] = i < N ? 0 : from[i];
        moved |= p->scratch[i] != 0;
    }
    if (moved) s = rg_track_keep(p, p->scratch);
    return s == RG_OK ? keep_flat(p) : s;
}

rg_status rg_home_go(rg_track *p, const double *z, int *home)
{
    double *from = rg_mem_array(&p->mem, (size_t)p->P->n, sizeof *from);
    if (!from) return RG_ENOMEM;
    /* Where all but some creases are flat, closure is all but singular: those that are next to flat are made so
     * first. */
    tidy(p->P, z, from);
    rg_status s = go_straight(p, from, 0, home);
    /* Flat, any pattern closes, and what the pattern gave by holds it back: it goes home as it is now, and once the
     * sheet lies flat its creases are those of the drawing. */
    if (s == RG_OK && !*home && largest(p->P, z) < LIES_NEARLY) s = go_straight(p, z, 1, home);
    rg_mem_free(&p->mem, from);
    return s;
}
