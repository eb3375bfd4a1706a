#include "chart/reference.h"
#include "base/clock.h"

#include <string.h>

/* Steps of the first try, as a part of what is behind and ahead: shorter than the way from one frame to the next nearly
 * everywhere, as frames cut longer ones anyway. */
static const double FIRST_GRADE = 1.0 / 32;
/* Known well enough, radians. */
static const double KNOWN = 1e-12;
/* Of two tries of order 4, the finer one is off by this part of their difference. */
static const double OF_THE_CHANGE = 1.0 / 15;
/* Singular values where they are quick, as nothing is more accurate. */
static const int32_t SVD_UP_TO = 24;
/* Seconds after which no further halving is begun. */
static const double PATIENCE = 6;
static const double CLOSED = 1e-13;

void rg_reference_free(rg_reference *ref)
{
    if (!ref->mem.resize) return;
    rg_mem_free(&ref->mem, ref->frames.rho);
    memset(ref, 0, sizeof *ref);
}

static rg_status in_closed_form(rg_reference *ref, const rg_mesh *m, const rg_settings *s)
{
    const int32_t frames = s->frames;
    rg_exact x = {0};
    rg_drive d = {0};
    rg_constraint K = {0};
    rg_status status = rg_exact_init(&x, &ref->mem, m);
    if (status == RG_OK && x.found) status = rg_drive_init(&d, &ref->mem, m, s->to < 0 ? -1 : 1);
    if (status == RG_OK && x.found) status = rg_constraint_init(&K, &ref->mem, m);
    if (status == RG_OK && x.found) {
        for (int32_t k = 0; k < frames; k++) {
            double *rho = ref->frames.rho + (size_t)k * (size_t)m->N;
            rg_exact_at(&x, &d, fabs(s->to) * k / (frames - 1), rho);
            ref->closure = fmax(ref->closure, rg_constraint_closure(&K, rho, NULL));
        }
        ref->frames.count = frames;
        ref->exact = 1;
        ref->error = 1e-15;
    }
    rg_constraint_free(&K);
    rg_drive_free(&d);
    rg_exact_free(&x);
    return status;
}

static rg_status by_halving(rg_reference *ref, const rg_mesh *m, const rg_settings *s, rg_diag *why)
{
    rg_frames fine;
    const double begun = rg_seconds();
    rg_status status = rg_frames_init(&fine, &ref->mem, m->N, s->frames);
    const rg_solver solver = m->N <= SVD_UP_TO && rg_pinv_built() ? RG_SOLVER_SVD : RG_SOLVER_AUTO;
    rg_way way = {RG_METHOD_RK4, solver, s->step, CLOSED, FIRST_GRADE};
    ref->error = INFINITY;
    for (int32_t n = 0; status == RG_OK && n < RG_HALVINGS; n++, way.grade /= 2) {
        rg_run run;
        status = rg_run_make(&run, m, s, &way, NULL, &fine, why);
        if (status != RG_OK) break;
        const double change = n > 0 ? rg_frames_distance(&fine, &ref->frames) : NAN;
        ref->grade[n] = way.grade;
        ref->change[n] = change;
        ref->halvings = n + 1;
        if (n > 0 && !(OF_THE_CHANGE * change < ref->error)) break; /* no better than the one before, which is kept */
        if (n > 0) ref->error = OF_THE_CHANGE * change;
        const rg_frames coarse = ref->frames;
        ref->frames = fine;
        fine = coarse;
        fine.count = 0;
        if (ref->error <= KNOWN || rg_seconds() - begun > PATIENCE) break;
    }
    rg_mem_free(&ref->mem, fine.rho);
    return status;
}

rg_status rg_reference_make(rg_reference *ref, const rg_memory *mem, const rg_mesh *m, const rg_settings *s,
                            rg_diag *why)
{
    memset(ref, 0, sizeof *ref);
    ref->mem = *mem;
    rg_status status = rg_frames_init(&ref->frames, mem, m->N, s->frames);
    if (status == RG_OK) status = in_closed_form(ref, m, s);
    if (status == RG_OK && !ref->exact) status = by_halving(ref, m, s, why);
    if (status != RG_OK) rg_reference_free(ref);
    return status;
}
