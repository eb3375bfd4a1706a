#include "unfold/track.h"
#include "unfold/stride.h"

#include <string.h>

/* Between two states so many places are looked at, less one, that the way between two of them is straight to BENT
 * (lengths of the sheet). */
enum { LEAST_BETWEEN = 4, MOST_BETWEEN = 40 };
static const double BENT = 2e-5;
/* Closing a state that is read off, radians: as well as rounding lets it, and at least so well that it is closed. */
static const double READ_CLOSED = 1e-13, CLOSED = 1e-10, NO_BETTER = 0.5, NEAR_DUE = 1e-6;
static const int READ_NEWTON = 45, SECANTS = 8;
/* The farthest, radians, that creases turn on a way that is cut short. */
static const double SHORT_CUT = 10 * RG_DEG;

rg_status rg_track_init(rg_track *p, const rg_memory *mem, rg_linkage *P, rg_nearest *q)
{
    memset(p, 0, sizeof *p);
    p->mem = *mem;
    p->P = P;
    p->q = q;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(p->end, (size_t)P->n), RG_ARRAY(p->scratch, (size_t)P->n),
                                RG_ARRAY(p->best, (size_t)P->n), RG_ARRAY(p->x, 2 * (size_t)P->mesh->nv));
    if (s == RG_OK) s = rg_plates_init(P->mesh, &p->plates);
    if (s == RG_OK) s = rg_contact_work_init(&p->plates, &p->look);
    if (s != RG_OK) rg_track_free(p);
    return s;
}

void rg_track_free(rg_track *p)
{
    if (!p->mem.resize) return;
    rg_contact_work_free(&p->look);
    rg_plates_free(&p->plates);
    RG_MEM_FREE(&p->mem, p->end, p->z, p->progress, p->scratch, p->best, p->x);
    memset(p, 0, sizeof *p);
}

double rg_track_progress(const rg_track *p, const double *z)
{
    const rg_mesh *m = p->P->mesh;
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < m->N - m->added; i++) {
        const double target = m->target[m->crease_edge[i]];
        if (isnan(target) || target == 0) continue;
        sum += z[i] / p->end[i];
        n++;
    }
    return n ? sum / n : 1;
}

rg_status rg_track_keep(void *ctx, const double *z)
{
    rg_track *p = ctx;
    const size_t n = (size_t)p->P->n, at = (size_t)p->count;
    rg_status s = RG_MEM_GROW(&p->mem, p->z, p->z_room, (at + 1) * n);
    if (s == RG_OK) s = RG_MEM_GROW(&p->mem, p->progress, p->progress_room, at + 1);
    if (s != RG_OK) return s;
    memcpy(p->z + at * n, z, n * sizeof *z);
    p->progress[at] = rg_track_progress(p, z);
    p->count++;
    return RG_OK;
}

void rg_track_reverse(rg_track *p)
{
    const size_t n = (size_t)p->P->n;
    for (int32_t i = 0, j = p->count - 1; i < j; i++, j--) {
        const double was = p->progress[i];
        p->progress[i] = p->progress[j];
        p->progress[j] = was;
        memcpy(p->scratch, p->z + (size_t)i * n, n * sizeof *p->z);
        memcpy(p->z + (size_t)i * n, p->z + (size_t)j * n, n * sizeof *p->z);
        memcpy(p->z + (size_t)j * n, p->scratch, n * sizeof *p->z);
    }
}

/* p->scratch closed, as well as it goes. */
static void close(rg_track *p)
{
    rg_linkage *P = p->P;
    double best = INFINITY, before = INFINITY;
    for (int i = 0; i <= READ_NEWTON; i++) {
        const double angle = rg_coupled_assemble(&P->J, p->scratch, p->scratch + P->N, NULL);
        const int is_closed = angle <= READ_CLOSED || (angle <= CLOSED && angle > NO_BETTER * before);
        if (angle < best) memcpy(p->best, p->scratch, (size_t)P->n * sizeof *p->best), best = angle;
        if (is_closed || !(angle < 1)) break;
        before = angle;
        rg_stride_newton(P, p->q, p->scratch, angle);
    }
    if (best < INFINITY) memcpy(p->scratch, p->best, (size_t)P->n * sizeof *p->best);
}

static const double *state(const rg_track *p, int32_t k) { return p->z + (size_t)k * (size_t)p->P->n; }

/* The state a part t from node k to node j, closed: p->scratch. */
static void between(rg_track *p, int32_t k, int32_t j, double t)
{
    const int32_t n = p->P->n;
    const double *a = state(p, k), *b = state(p, j);
    const int last = j + 1 == p->count; /* into the end: angles by e, pattern by e^2 */
    for (int32_t i = 0; i < n; i++) {
        const double part = last && i >= p->P->N ? 1 - (1 - t) * (1 - t) : t;
        p->scratch[i] = a[i] + part * (b[i] - a[i]);
    }
    rg_stride_scale(p->P, 1, p->q->scale);
    rg_stride_hold(p->P, p->scratch, p->q->scale);
    close(p);
}

void rg_track_read(rg_track *p, double due)
{
    const size_t n = (size_t)p->P->n;
    int32_t k = 0;
    while (k + 2 < p->count && p->progress[k + 1] < due) k++;
    const double from = p->progress[k], to = p->progress[k + 1];
    if (due <= from || due >= to) {
        memcpy(p->scratch, p->z + (size_t)(due >= to ? k + 1 : k) * n, n * sizeof *p->scratch);
        return;
    }
    double low = 0, high = 1, at_low = from, at_high = to;
    for (int i = 0; i < SECANTS; i++) {
        const double t = low + (high - low) * (due - at_low) / (at_high - at_low);
        between(p, k, k + 1, t);
        const double at = rg_track_progress(p, p->scratch);
        if (fabs(at - due) <= NEAR_DUE || !(t > low && t < high)) return;
        if (at < due) low = t, at_low = at;
        else high = t, at_high = at;
    }
}

int rg_track_crosses(rg_track *p, const rg_vec3 *x)
{
    rg_contact_hit hit;
    return rg_contact_deepest(&p->plates, x, RG_TRACK_WRONG, &p->look, &hit);
}

/* Parts of the way from state k to state j, so many that each is all but straight: how far off the chord's middle
 * its middle is goes with the square. */
static int parts_between(rg_track *p, int32_t k, int32_t j)
{
    const int32_t nv = p->P->mesh->nv;
    double most = 0;
    rg_linkage_positions(p->P, state(p, k), p->x);
    rg_linkage_positions(p->P, state(p, j), p->x + nv);
    between(p, k, j, 0.5);
    rg_linkage_put(p->P, p->scratch);
    for (int32_t v = 0; v < nv; v++) {
        const rg_vec3 middle = rg_vec3_scale(0.5, rg_vec3_add(p->x[v], p->x[nv + v]));
        most = fmax(most, rg_vec3_length(rg_vec3_sub(p->P->p[v], middle)));
    }
    return (int)fmin(MOST_BETWEEN, fmax(LEAST_BETWEEN, ceil(sqrt(most / BENT))));
}

/* Facets cross somewhere on the way from state k to state j. */
static int crosses_on(rg_track *p, int32_t k, int32_t j)
{
    const int parts = parts_between(p, k, j);
    for (int part = 1; part < parts; part++) {
        between(p, k, j, (double)part / parts);
        rg_linkage_put(p->P, p->scratch);
        if (rg_track_crosses(p, p->P->p)) return 1;
    }
    return 0;
}

int rg_track_crosses_between(rg_track *p)
{
    rg_stride_scale(p->P, 1, p->q->scale);
    for (int32_t k = 0; k + 1 < p->count; k++)
        if (crosses_on(p, k, k + 1)) return 1;
    return 0;
}

/* Is it a short way from state k straight to state j, and free? */
static int goes_straight(rg_track *p, int32_t k, int32_t j)
{
    const double *a = state(p, k), *b = state(p, j);
    for (int32_t i = 0; i < p->P->N; i++)
        if (!(fabs(b[i] - a[i]) <= SHORT_CUT)) return 0;
    return !crosses_on(p, k, j);
}

/* States between k and j go. */
static void cut_out(rg_track *p, int32_t k, int32_t j)
{
    const size_t n = (size_t)p->P->n, rest = (size_t)(p->count - j);
    memmove(p->z + (size_t)(k + 1) * n, p->z + (size_t)j * n, rest * n * sizeof *p->z);
    memmove(p->progress + k + 1, p->progress + j, rest * sizeof *p->progress);
    p->count -= j - k - 1;
}

void rg_track_rise(rg_track *p)
{
    rg_stride_scale(p->P, 1, p->q->scale);
    for (int32_t k = 0; k + 1 < p->count; k++) {
        int32_t from = k, to = k + 1;
        if (p->progress[to] > p->progress[k]) continue;
        while (from > 0 && p->progress[from] >= p->progress[k + 1]) from--;
        while (to + 1 < p->count && p->progress[to] <= p->progress[k]) to++;
        if (goes_straight(p, k, to)) cut_out(p, k, to);              /* without the fall */
        else if (goes_straight(p, from, k + 1)) cut_out(p, from, k + 1); /* or without what it falls from */
        else if (goes_straight(p, from, to)) cut_out(p, from, to);
        else continue;
        k = from > 0 ? from - 1 : -1; /* what comes together now is looked at again */
    }
}
