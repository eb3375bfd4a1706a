#include "fold/system.h"
#include "fold/tuning.h"

#include <stdio.h>
#include <string.h>


void rg_straight_accept(rg_straight *f, const double *rho, double s)
{
    memcpy(f->rho, rho, (size_t)f->mesh.N * sizeof *rho);
    f->s = s;
}

void rg_straight_stop(rg_straight *f, const char *why)
{
    int arrived = f->s_end >= 1;
    for (int32_t i = 0; i < f->mesh.N && arrived; i++)
        if (rg_drive_is_driven(&f->drive, i)) arrived = fabs(f->rho[i] / f->drive.target[i] - 1) <= ARRIVED;
    f->outcome = arrived ? RG_FOLDED : RG_STOPPED;
    snprintf(f->reason, sizeof f->reason, "%s%s", why,
             arrived ? "; every crease is within 1 % of its target" : "");
}

double rg_straight_frame_progress(const rg_straight *f, int32_t frame)
{
    /* a part has the same bits among any number */
    return f->due ? f->due[frame] : f->s_end * ((double)frame / (f->settings.frames - 1));
}
