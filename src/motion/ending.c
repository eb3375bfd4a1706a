#include "motion/ending.h"
#include "motion/measure.h"
#include "base/status.h"
#include "unfold/seen.h"

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
    }
    return folded;
}

/* wish[]: as rg_seen_order's; a pair that contact followed all the way is surer, and wishes for more than all
 * others. */
static void wish_for_sides(const rg_motion *m, double *wish)
{
    const rg_layers *l = m->layers;
    double most = 0;
    for (int32_t i = 0; i < l->pairs.count; i++) most = fmax(most, fabs(wish[i]));
    for (int32_t i = 0; i < m->sides; i++) {
        const rg_motion_side *s = &m->side[i];
        const int32_t f = l->flat.facet_of[s->facet[0]], g = l->flat.facet_of[s->facet[1]];
        const int32_t pair = f == g ? -1 : rg_pairs_find(&l->pairs, f, g);
        if (pair < 0 || rg_layers_above_of_mesh(l, s->facet[0], s->facet[1]) == 0) continue;
        wish[pair] = (f < g ? 1 : -1) * s->before * l->flat.up[f] * (1 + most);
    }
}

/* Of several orders, one that the facets came in. */
static rg_status choose(rg_motion *m)
{
    const rg_seen_frames seen = {&m->mesh, &m->tree, m->rho, m->flat, m->report.frame_count};
    rg_status s = rg_layers_choose(m->layers, NULL);
    if (s != RG_OK || !m->ends_flat || m->report.frame_count < 2 || m->layers->parts.count == 0) return s;
    double *wish = rg_mem_array(&m->mem, (size_t)m->layers->pairs.count, sizeof *wish);
    s = wish ? rg_seen_order(m->layers, &seen, wish) : RG_ENOMEM;
    if (s == RG_OK) wish_for_sides(m, wish);
    if (s == RG_OK) s = rg_layers_choose_near(m->layers, wish);
    rg_mem_free(&m->mem, wish);
    return s;
}

/* A motion that seems free, but whose facets come in an order that no flat end has, passes through itself on the last
 * of its way. */
static void tell_wrong_order(rg_motion *m)
{
    rg_report *r = &m->report;
    for (int32_t i = 0; i < m->sides && r->contact == RG_CONTACT_FREE && m->ends_flat; i++) {
        const rg_motion_side *s = &m->side[i];
        const int above = rg_layers_above_of_mesh(m->layers, s->facet[0], s->facet[1]);
        if (above * s->before * m->layers->flat.up[m->layers->flat.facet_of[s->facet[0]]] >= 0) continue;
        const int32_t last = r->frame_count - 1;
        r->contact = RG_CONTACT_CROSSES;
        r->first_contact_frame = last;
        r->first_contact_percent = m->frame[last].percent;
        rg_measure_place(m, s->facet);
    }
}

rg_status rg_ending_find(rg_motion *m, rg_watch *watch, rg_diag *why)
{
    const rg_stop stop = {rg_watch_asked, watch};
    double *angle = rg_mem_array(&m->mem, (size_t)m->mesh.N, sizeof *angle);
    rg_status s = RG_OK;
    if (!angle) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->ends_flat = whole_turns(m, m->report.frame_count - 1, angle);
    for (int32_t i = 0; !m->ends_flat && i < m->mesh.N; i++) angle[i] = fabs(m->settings.to) * m->target[i];
    const int cancelled = watch && rg_watch_asked(watch);
    m->report.layers = rg_layers_state_name(RG_LAYERS_UNSOLVED);
    m->report.layer_orders = "";
    m->report.layers_reason = "interrupted";
    if (!cancelled)
        s = rg_layers_of_mesh(&m->mesh, angle, m->source.y_down, &m->mem, watch ? &stop : NULL, &m->layers, why);
    rg_mem_free(&m->mem, angle);
    if (s != RG_OK || cancelled) return s;
    const rg_layers_info *info = rg_layers_get_info(m->layers);
    m->report.layers = rg_layers_state_name(info->state);
    m->report.layer_orders = info->count;
    m->report.layers_reason = info->reason;
    if (info->state != RG_LAYERS_VALID) return RG_OK;
    s = choose(m);
    if (s != RG_OK) return rg_fail(s, why, 0, "out of memory");
    tell_wrong_order(m);
    return RG_OK;
}

const rg_layers *rg_ending_layers(const rg_motion *m, int32_t frame)
{
    const int is_there = m->layers && m->ends_flat && frame == m->report.frame_count - 1;
    return is_there && m->layers->info.state == RG_LAYERS_VALID ? m->layers : NULL;
}
