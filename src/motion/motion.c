#include "motion/motion.h"
#include "base/status.h"
#include "kinematics/mobility.h"
#include "pattern/source.h"
#include "pose/lie.h"

#include <string.h>

/* A point that is meant to be on a crease is no farther from it than this part of the sheet's size. */
static const double ON_CREASE = 0.01;
/* Part of the sheet's size that is rounding. */
static const double NEARLY_NOTHING = 1e-9;

void rg_motion_free_stages(rg_stages *q)
{
    if (!q->mem.resize) return;
    RG_MEM_FREE(&q->mem, q->stage, q->fold, q->crease, q->vertex, q->edge);
    memset(q, 0, sizeof *q);
}

void rg_motion_destroy(rg_motion *m)
{
    if (!m) return;
    const rg_memory mem = m->mem;
    rg_mesh_free(&m->mesh);
    rg_tree_free(&m->tree);
    rg_triangles_free(&m->triangles);
    RG_MEM_FREE(&m->mem, m->target, m->from, m->rho, m->flat, m->frame, m->blocking_vertex, m->blocking_crease,
                m->blocking_at, m->state_frame, m->by_flat, m->space, m->tried, m->side);
    rg_gaps_free(&m->gaps, &m->mem);
    rg_layers_destroy(m->layers);
    rg_motion_free_stages(&m->stages);
    rg_source_free(&m->source);
    RG_MEM_FREE(&mem, m->title, m->author, m);
}

const rg_report *rg_motion_report(const rg_motion *m) { return &m->report; }

rg_status rg_motion_name(rg_motion *m, const rg_pattern_info *of)
{
    m->info = *of;
    m->info.title = m->title = rg_mem_string(&m->mem, m->info.title);
    m->info.author = m->author = rg_mem_string(&m->mem, m->info.author);
    m->report.pattern = &m->info;
    return m->title && m->author ? RG_OK : RG_ENOMEM;
}

rg_status rg_motion_hang(rg_motion *m, rg_diag *why)
{
    const int fixed = (int)m->settings.fixed_facet, last = (int)m->mesh.nf - 1;
    const rg_status s = rg_tree_init(&m->mesh, m->settings.fixed_facet, &m->tree);
    if (s == RG_EARG && last >= 0) rg_fail(s, why, 0, "there is no facet %d: the facets are 0 to %d", fixed, last);
    return s;
}

rg_status rg_motion_lend(rg_motion *m)
{
    const rg_mesh *mesh = &m->mesh;
    const rg_status s = rg_triangles_init(&m->mem, mesh, &m->triangles);
    if (s != RG_OK) return s;
    m->sheet = (rg_sheet){.vertices = mesh->nv, .creases = mesh->N, .facets = mesh->nf, .edges = mesh->ne,
                          .added = mesh->added, .flat = (const double(*)[2])mesh->X,
                          .ends = (const int32_t(*)[2])mesh->edge, .assignment = mesh->assignment,
                          .edge_crease = mesh->edge_crease, .crease_edge = mesh->crease_edge,
                          .facet_start = mesh->facet_start, .facet_vertex = mesh->facet_vertex,
                          .edge_facet = (const int32_t(*)[2])mesh->edge_facet,
                          .triangles = m->triangles.start[mesh->nf],
                          .triangle = (const int32_t(*)[3])m->triangles.v, .facet_triangle = m->triangles.start};
    return RG_OK;
}

const rg_sheet *rg_motion_get_sheet(const rg_motion *m) { return &m->sheet; }

const double *rg_motion_angles(const rg_motion *m, int32_t frame)
{
    return frame < 0 || frame >= m->report.frame_count ? NULL : m->rho + (size_t)frame * (size_t)m->mesh.N;
}

const rg_vec2 *rg_motion_pattern(const rg_motion *m, int32_t frame)
{
    return m->flat ? m->flat + (size_t)frame * (size_t)m->mesh.nv : m->mesh.X;
}

int32_t rg_motion_states(const rg_motion *m) { return m->report.frame_count + m->gaps.count; }

rg_motion_state rg_motion_state_at(const rg_motion *m, int32_t k, int32_t *gaps)
{
    const rg_gaps *g = &m->gaps;
    const int32_t j = *gaps, frame = k - j;
    if (j < g->count && g->after[j] < frame) {
        *gaps = j + 1;
        return (rg_motion_state){rg_gaps_angles(g, &m->mesh, j), rg_gaps_pattern(g, &m->mesh, j), g->after[j], 1};
    }
    return (rg_motion_state){rg_motion_angles(m, frame), rg_motion_pattern(m, frame), frame, 0};
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
    rg_motion_facets(m, frame, place);
    rg_pose_vertices(&m->mesh, rg_motion_pattern(m, frame), &m->tree, place, x);
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

void rg_motion_drawn(const rg_motion *m, rg_vec2 at, double drawn[2])
{
    const double nothing = NEARLY_NOTHING * m->mesh.size;
    drawn[0] = fabs(at.x) > nothing ? at.x : 0;
    drawn[1] = fabs(at.y) <= nothing ? 0 : m->source.y_down ? -at.y : at.y;
}

rg_status rg_motion_crease(const rg_motion *m, int32_t i, rg_crease *out)
{
    if (i < 0 || i >= m->mesh.N) return RG_EARG;
    const int32_t e = m->mesh.crease_edge[i], *v = m->mesh.edge[e];
    *out = (rg_crease){{v[0], v[1]}, {{0, 0}, {0, 0}}, m->mesh.assignment[e],
                       m->target ? m->target[i] : m->mesh.target[e], i >= m->mesh.N - m->mesh.added,
                       e < m->source.ne ? m->source.where[e] : 0, e};
    for (int k = 0; k < 2; k++) {
        const rg_vec2 x = m->mesh.X[v[k]];
        out->at[k][0] = x.x;
        out->at[k][1] = m->source.y_down ? 0 - x.y : x.y; /* 0, never -0 */
    }
    return RG_OK;
}

int32_t rg_motion_crease_between(const rg_motion *m, int32_t v, int32_t w)
{
    for (int32_t i = 0; i < m->mesh.N; i++) {
        const int32_t *end = m->mesh.edge[m->mesh.crease_edge[i]];
        if ((end[0] == v && end[1] == w) || (end[0] == w && end[1] == v)) return i;
    }
    return -1;
}

int32_t rg_motion_crease_at(const rg_motion *m, const double x[2])
{
    const rg_vec2 at = {x[0], m->source.y_down ? 0 - x[1] : x[1]};
    double nearest = ON_CREASE * m->mesh.size;
    int32_t found = -1;
    for (int32_t i = 0; i < m->mesh.N - m->mesh.added; i++) {
        const int32_t *end = m->mesh.edge[m->mesh.crease_edge[i]];
        const double d = rg_vec2_off_segment(m->mesh.X[end[0]], m->mesh.X[end[1]], at);
        if (d < nearest) nearest = d, found = i;
    }
    return found;
}

rg_status rg_motion_mobility(const rg_motion *m, int32_t frame, int32_t *ways)
{
    const double *rho = rg_motion_angles(m, frame);
    return rho ? rg_mobility(&m->mesh, m->flat ? rg_motion_pattern(m, frame) : NULL, rho, ways) : RG_EARG;
}
