#include "motion/ending.h"
#include "base/status.h"
#include "motion/seen.h"

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

/* Of several orders, one that the facets came in. */
static rg_status choose(rg_motion *m)
{
    const rg_seen_frames seen = {&m->mesh, &m->tree, m->rho, m->flat, m->report.frame_count};
    if (!m->ends_flat || m->report.frame_count < 2 || m->layers->parts.count == 0) return rg_layers_choose(m->layers, NULL);
    double *wish = rg_mem_array(&m->mem, (size_t)m->layers->pairs.count, sizeof *wish);
    rg_status s = wish ? rg_seen_order(m->layers, &seen, wish) : RG_ENOMEM;
    if (s == RG_OK) s = rg_layers_choose_near(m->layers, wish);
    rg_mem_free(&m->mem, wish);
    return s;
}

rg_status rg_ending_find(rg_motion *m, rg_watch *watch, rg_diag *why)
{
    const rg_stop stop = {rg_watch_asked, watch};
    double *angle = rg_mem_array(&m->mem, (size_t)m->mesh.N, sizeof *angle);
    rg_layers_info info;
    rg_status s = RG_OK;
    if (!angle) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->ends_flat = whole_turns(m, m->report.frame_count - 1, angle);
    for (int32_t i = 0; !m->ends_flat && i < m->mesh.N; i++) angle[i] = fabs(m->settings.to) * m->target[i];
    if (watch && rg_watch_asked(watch)) {
        rg_mem_free(&m->mem, angle);
        m->report.layers = rg_layers_state_name(RG_LAYERS_UNSOLVED);
        m->report.layer_orders = "";
        m->report.layers_reason = "interrupted";
        return RG_OK;
    }
    s = rg_layers_of_mesh(&m->mesh, angle, m->source.y_down, &m->mem, watch ? &stop : NULL, &m->layers, why);
    if (s == RG_OK) {
        info = *rg_layers_get_info(m->layers);
        m->report.layers = rg_layers_state_name(info.state);
        m->report.layer_orders = info.count;
        m->report.layers_reason = m->layers->info.reason;
        if (info.state == RG_LAYERS_VALID) s = choose(m);
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
