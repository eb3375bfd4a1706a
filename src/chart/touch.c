#include "chart/touch.h"
#include "base/clock.h"

rg_status rg_touch_measure(rg_touch touch[RG_TOUCHES], const rg_pattern *p, const rg_settings *settings,
                           rg_progress progress, void *ctx, rg_diag *why)
{
    static const rg_contact_mode how[RG_TOUCHES] = {RG_CONTACT_REPORT, RG_CONTACT_AVOID};
    for (int k = 0; k < RG_TOUCHES; k++) {
        rg_settings s = *settings;
        rg_motion *m = NULL;
        s.contact = how[k];
        s.method = RG_METHOD_AUTO, s.solver = RG_SOLVER_AUTO; /* as it comes: the others are charted by themselves */
        touch[k] = (rg_touch){0};
        if (progress && progress(ctx, 1)) return RG_OK;
        const double begun = rg_seconds();
        const rg_status status = rg_motion_create(p, &s, progress, ctx, &m, why);
        if (status != RG_OK) return status;
        const rg_report *r = rg_motion_report(m);
        touch[k] = (rg_touch){.seconds = rg_seconds() - begun, .outcome = r->outcome,
                              .crosses = r->contact == RG_CONTACT_CROSSES,
                              .percent = r->folded_percent, .from = r->first_contact_percent, .depth = r->contact_depth,
                              .frames = r->contact_frames, .added = r->added_creases};
        rg_motion_destroy(m);
    }
    return RG_OK;
}
