#include "motion/motion.h"
#include "base/status.h"
#include "kinematics/mobility.h"
#include "pattern/source.h"
#include "pose/lie.h"

#include <string.h>

void rg_motion_destroy(rg_motion *m)
{
    if (!m) return;
    const rg_memory mem = m->mem;
    rg_mesh_free(&m->mesh);
    rg_tree_free(&m->tree);
    void *block[] = {m->target, m->from, m->rho, m->flat, m->frame, m->blocking_vertex, m->blocking_crease, m->blocking_at,
                     m->state_frame, m->by_flat, m->space};
    for (int i = 0; i < 11; i++) rg_mem_free(&m->mem, block[i]);
    rg_layers_destroy(m->layers);
    rg_source_free(&m->source);
    rg_mem_free(&mem, m->title);
    rg_mem_free(&mem, m->author);
    rg_mem_free(&mem, m);
}

const rg_report *rg_motion_report(const rg_motion *m) { return &m->report; }

void rg_motion_get_sheet(const rg_motion *m, rg_sheet *sheet)
{
    *sheet = (rg_sheet){m->mesh.nv, m->mesh.N, m->mesh.nf, m->mesh.facet_start, m->mesh.facet_vertex,
                        (const double(*)[2])m->mesh.X};
}

const double *rg_motion_angles(const rg_motion *m, int32_t frame)
{
    return frame < 0 || frame >= m->report.frame_count ? NULL : m->rho + (size_t)frame * (size_t)m->mesh.N;
}

const rg_vec2 *rg_motion_pattern(const rg_motion *m, int32_t frame)
{
    return m->flat ? m->flat + (size_t)frame * (size_t)m->mesh.nv : m->mesh.X;
}

const double (*rg_motion_flat(const rg_motion *m, int32_t frame))[2]
{
    return rg_motion_angles(m, frame) ? (const double(*)[2])rg_motion_pattern(m, frame) : NULL;
}

void rg_motion_facets(const rg_motion *m, int32_t frame, rg_place *place)
{
    const rg_vec2 *X = rg_motion_pattern(m, frame);
    if (m->space) rg_lie_facets(&m->mesh, X, m->space + (size_t)frame * (size_t)m->mesh.nv, place);
    else rg_pose_facets(&m->mesh, X, &m->tree, rg_motion_angles(m, frame), place);
}

rg_status rg_motion_place(const rg_motion *m, int32_t frame, rg_vec3 *x)
{
    const size_t nv = (size_t)m->mesh.nv;
    if (m->space && nv > 0) memcpy(x, m->space + (size_t)frame * nv, nv * sizeof *x);
    if (m->space) return RG_OK;
    rg_place *place = rg_mem_array(&m->mem, (size_t)m->mesh.nf, sizeof *place);
    if (!place) return RG_ENOMEM;
    const rg_vec2 *X = rg_motion_pattern(m, frame);
    rg_pose_facets(&m->mesh, X, &m->tree, rg_motion_angles(m, frame), place);
    rg_pose_vertices(&m->mesh, X, &m->tree, place, x);
    rg_mem_free(&m->mem, place);
    return RG_OK;
}

rg_vec3 rg_motion_middle(const rg_motion *m)
{
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t v = 0; v < m->mesh.nv; v++) {
        const rg_vec2 x = m->mesh.X[v];
        low = (rg_vec2){fmin(low.x, x.x), fmin(low.y, x.y)};
        high = (rg_vec2){fmax(high.x, x.x), fmax(high.y, x.y)};
    }
    return (rg_vec3){low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2, 0};
}

rg_status rg_motion_place_centred(const rg_motion *m, int32_t frame, rg_vec3 *x)
{
    const rg_vec3 middle = rg_motion_middle(m);
    const rg_status s = rg_motion_place(m, frame, x);
    for (int32_t v = 0; s == RG_OK && v < m->mesh.nv; v++) x[v] = rg_vec3_sub(x[v], middle);
    return s;
}

rg_status rg_motion_pose(const rg_motion *m, int32_t frame, double (*xyz)[3])
{
    if (!rg_motion_angles(m, frame)) return RG_EARG;
    return rg_motion_place(m, frame, (rg_vec3 *)xyz);
}

rg_status rg_motion_crease(const rg_motion *m, int32_t i, rg_crease *out)
{
    if (i < 0 || i >= m->mesh.N) return RG_EARG;
    const int32_t e = m->mesh.crease_edge[i], *v = m->mesh.edge[e];
    *out = (rg_crease){{v[0], v[1]}, {{0, 0}, {0, 0}}, m->mesh.assignment[e], m->target ? m->target[i] : m->mesh.target[e], i >= m->mesh.N - m->mesh.added,
                       e < m->source.ne ? m->source.where[e] : 0};
    for (int k = 0; k < 2; k++) {
        const rg_vec2 x = m->mesh.X[v[k]];
        out->at[k][0] = x.x;
        out->at[k][1] = m->source.y_down ? 0 - x.y : x.y; /* 0, never -0 */
    }
    return RG_OK;
}

rg_status rg_motion_mobility(const rg_motion *m, int32_t frame, int32_t *ways)
{
    const double *rho = rg_motion_angles(m, frame);
    return rho ? rg_mobility(&m->mesh, m->flat ? rg_motion_pattern(m, frame) : NULL, rho, ways) : RG_EARG;
}

rg_status rg_motion_check_settings(const rg_settings *s, rg_diag *why)
{
    if (s->frames < 2) return rg_fail(RG_EARG, why, 0, "there must be at least 2 frames");
    if (!(s->adjust == RG_ADJUST_AUTO || (s->adjust >= 0 && s->adjust <= 1)))
        return rg_fail(RG_EARG, why, 0, "the gain of crease adjustment must be within 0 and 1");
    return RG_OK;
}
