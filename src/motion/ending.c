#include "motion/ending.h"
#include "base/status.h"

/* Nearer than that to flat, or to half a turn, a crease counts as there: layers do not depend on so little. */
static const double THERE = 0.5 * RG_DEG;

/* angle[N]: out, those of a frame, to the next half turn. Returns whether all are there, and one at half a turn. */
static int whole_turns(const rg_motion *m, int32_t frame, double *angle)
{
    const double *rho = rg_motion_angles(m, frame);
    int folded = 0;
    for (int32_t i = 0; i < m->mesh.N; i++) {
        angle[i] = RG_PI * round(rho[i] / RG_PI);
        folded |= angle[i] != 0;
        if (!(fabs(rho[i] - angle[i]) <= THERE)) return 0;
        if (i >= m->mesh.N - m->mesh.added && angle[i] != 0) return 0; /* a facet bent on itself */
    }
    return folded;
}

static const char *state_name(rg_layers_state s)
{
    switch (s) {
    case RG_LAYERS_VALID: return "valid";
    case RG_LAYERS_NONE: return "none";
    case RG_LAYERS_UNSOLVED: return "unsolved";
    case RG_LAYERS_NOT_FLAT: return "not flat";
    }
    return "";
}

rg_status rg_ending_find(rg_motion *m, rg_diag *why)
{
    double *angle = rg_mem_array(&m->mem, (size_t)m->mesh.N, sizeof *angle);
    rg_layers_info info;
    rg_status s = RG_OK;
    if (!angle) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->ends_flat = whole_turns(m, m->report.frame_count - 1, angle);
    for (int32_t i = 0; !m->ends_flat && i < m->mesh.N; i++) angle[i] = fabs(m->settings.to) * m->target[i];
    s = rg_layers_of_mesh(&m->mesh, angle, &m->mem, &m->layers, why);
    if (s == RG_OK) {
        rg_layers_get_info(m->layers, &info);
        m->report.layers = state_name(info.state);
        m->report.layer_orders = info.count;
        m->report.layers_reason = m->layers->info.reason;
        if (info.state == RG_LAYERS_VALID) s = rg_layers_choose(m->layers, NULL);
        if (s != RG_OK) rg_fail(s, why, 0, "out of memory");
    }
    rg_mem_free(&m->mem, angle);
    return s;
}

const rg_layers *rg_ending_layers(const rg_motion *m, int32_t frame)
{
    const int is_there = m->layers && m->ends_flat && frame == m->report.frame_count - 1;
    return is_there && m->layers->info.state == RG_LAYERS_VALID ? m->layers : NULL;
}
