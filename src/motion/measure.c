#include "motion/measure.h"
#include "kinematics/loop.h"
#include "mesh/components.h"

#include <string.h>

/* A new maximum, or NaN as soon as there is one. */
static double larger(double most, double value)
{
    return value <= most || isnan(most) ? most : value;
}

/* Largest rotation angle of F over the interior vertices, for fold angles rho on the pattern X. */
static double closure(const rg_mesh *m, const rg_vec2 *X, const double *rho)
{
    double worst = 0;
    for (int32_t k = 0; k < m->M; k++) {
        const int32_t first = m->loop_start[k], last = m->loop_start[k + 1], v = m->inner_vertex[k];
        rg_mat3 F = rg_mat3_identity();
        for (int32_t j = first; j < last; j++) {
            const int32_t *e = m->edge[m->crease_edge[m->loop_crease[j]]];
            const int32_t *g = m->edge[m->crease_edge[m->loop_crease[j + 1 < last ? j + 1 : first]]];
            const rg_vec2 a = rg_vec2_sub(X[e[e[0] == v]], X[v]), b = rg_vec2_sub(X[g[g[0] == v]], X[v]);
            const double lengths = rg_vec2_length(a) * rg_vec2_length(b), angle = rho[m->loop_crease[j]];
            F = rg_loop_advance(F, (rg_turn){cos(angle), sin(angle)},
                                (rg_turn){rg_vec2_dot(a, b) / lengths, rg_vec2_cross(a, b) / lengths});
        }
        worst = larger(worst, rg_loop_angle(F));
    }
    return worst;
}

static void measure_angles(rg_motion *m, int32_t k)
{
    rg_report *r = &m->report;
    const double *rho = rg_motion_angles(m, k);
    double sum = 0, least = INFINITY;
    int32_t driven = 0, wrong = 0;
    for (int32_t i = 0; i < m->mesh.N; i++) {
        const double way = m->target[i] - m->from[i];
        if (isnan(m->target[i])) continue;
        r->max_overfold_deg = larger(r->max_overfold_deg, (fabs(rho[i]) - RG_PI) / RG_DEG);
        if (way == 0) continue;
        const double part = 100 * fabs(rho[i] - m->from[i]) / fabs(way);
        sum += part;
        least = fmin(least, part);
        wrong += (rho[i] - m->from[i]) * way < 0 && part > 1e-4;
        driven++;
    }
    m->frame[k].percent = r->folded_percent = driven ? sum / driven : k ? 100 : 0;
    r->least_folded_percent = driven ? least : r->folded_percent;
    r->wrong_side_creases = wrong;
}

/* Largest displacement of a vertex from the pattern given, over the sheet's size. */
static double displacement(const rg_mesh *m, const rg_vec2 *X)
{
    double most = 0;
    for (int32_t v = 0; v < m->nv; v++) most = larger(most, rg_vec2_length(rg_vec2_sub(X[v], m->X[v])) / m->size);
    return most;
}

rg_status rg_measure_frames(rg_motion *m)
{
    rg_report *r = &m->report;
    int32_t *part = rg_mem_array(&m->mem, (size_t)m->mesh.N, sizeof *part);
    rg_place *place = rg_mem_array(&m->mem, (size_t)m->mesh.nf, sizeof *place);
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    const rg_status s = part && place && x ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) r->components = rg_components_find(&m->mesh, part);
    for (int32_t k = 0; s == RG_OK && k < r->frame_count; k++) {
        const double *rho = rg_motion_angles(m, k);
        const rg_vec2 *X = rg_motion_pattern(m, k);
        measure_angles(m, k);
        m->frame[k].closure_residual = closure(&m->mesh, X, rho);
        r->max_closure_residual = larger(r->max_closure_residual, m->frame[k].closure_residual);
        rg_pose_facets(&m->mesh, X, &m->tree, rho, place);
        rg_pose_vertices(&m->mesh, X, &m->tree, place, x);
        r->max_edge_strain = larger(r->max_edge_strain, rg_pose_strain(&m->mesh, X, x));
        r->max_strain_from_original = larger(r->max_strain_from_original, rg_pose_strain(&m->mesh, m->mesh.X, x));
        r->max_adjustment = larger(r->max_adjustment, displacement(&m->mesh, X));
        r->max_facet_gap = larger(r->max_facet_gap, rg_pose_gap(&m->mesh, X, place) / m->mesh.size);
    }
    rg_mem_free(&m->mem, part);
    rg_mem_free(&m->mem, place);
    rg_mem_free(&m->mem, x);
    return s;
}
