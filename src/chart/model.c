#include "chart/model.h"
#include "kinematics/mobility.h"

#include <string.h>

static const double PATIENCE = 1;

rg_status rg_model_fold(rg_model *o, const rg_mesh *m, const rg_settings *s, int32_t drawn, const rg_frames *with,
                        rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    const rg_way way = {RG_METHOD_AUTO, RG_SOLVER_AUTO, s->step, s->tol, 0};
    rg_frames kept;
    memset(o, 0, sizeof *o);
    o->unknowns = m->N;
    o->constraints = 3 * m->M;
    o->ways = -1;
    rg_status status = rg_frames_init(&kept, &mem, m->N, s->frames);
    if (status == RG_OK) status = rg_run_make(&o->run, m, s, &way, NULL, &kept, why);
    if (status == RG_OK) status = rg_run_time(&o->run, m, s, PATIENCE, why);
    if (status == RG_OK) status = rg_mobility(m, NULL, kept.rho + (size_t)(kept.count / 2) * (size_t)m->N, &o->ways);
    for (int32_t k = 0; status == RG_OK && k < kept.count; k++)
        for (int32_t i = 0; i < m->N; i++) {
            const double rho = kept.rho[(size_t)k * (size_t)m->N + (size_t)i];
            if (i >= drawn) o->bend = fmax(o->bend, fabs(rho));
            else if (k < with->count && with->count >= 2) {
                const double off = fabs(rho - with->rho[(size_t)k * (size_t)with->N + (size_t)i]);
                if (k == 0 && i == 0) o->run.error = 0;
                if (!(off <= o->run.error)) o->run.error = off;
            }
        }
    rg_mem_free(&mem, kept.rho);
    return status;
}
