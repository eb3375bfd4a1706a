#include "motion/ending.h"
#include "base/status.h"

/* Nearer than that to flat, or to half a turn, a crease counts as there: layers do not depend on so little. */
static const double THERE = 0.5 * RG_DEG;
/* How far to look back at most, so that what comes to lie flat is almost flat; as render/lift.c does. */
static const double LOOK_BACK = 10 * RG_DEG;

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

/* A facet's part that has the point of the pattern most inside. */
static int32_t part_at(const rg_mesh *m, const rg_flat *f, int32_t g, rg_vec2 x)
{
    int32_t best = f->part[f->part_start[g]];
    double most = -INFINITY;
    for (int32_t k = f->part_start[g]; k < f->part_start[g + 1]; k++) {
        const int32_t *v = m->facet_vertex + m->facet_start[f->part[k]], n = m->facet_start[f->part[k] + 1] - m->facet_start[f->part[k]];
        double least = INFINITY;
        for (int32_t j = 0; j < n; j++) least = fmin(least, rg_vec2_turn(m->X[v[j]], m->X[v[(j + 1) % n]], x));
        if (!(least > most)) continue;
        most = least;
        best = f->part[k];
    }
    return best;
}

/* wish[pairs]: out, how much higher the second facet of each lay than the first a little before the last frame, summed over places
 * where both are. place[nf]: as they lay then. at, up: [facets] scratch. */
static void look_before(const rg_motion *m, const rg_place *place, rg_vec3 *at, rg_vec3 *up, double *wish)
{
    const rg_layers *l = m->layers;
    const rg_flat *f = &l->flat;
    const rg_cells *c = &l->cells;
    for (int32_t i = 0; i < c->faces.count; i++) {
        const int32_t *over = c->over + c->over_start[i], n = c->over_start[i + 1] - c->over_start[i];
        for (int32_t j = 0; j < n; j++) {
            const rg_isometry *q = &f->place[over[j]];
            const rg_vec2 r = rg_vec2_sub(c->point[i], q->t), x = {rg_vec2_dot(q->c[0], r), rg_vec2_dot(q->c[1], r)};
            const rg_place *p = &place[part_at(&m->mesh, f, over[j], x)];
            at[j] = rg_vec3_add(rg_mat3_mul_vec(p->R, (rg_vec3){x.x, x.y, 0}), p->t);
            up[j] = rg_vec3_scale(f->up[over[j]], p->R.c[2]);
        }
        for (int32_t j = 0; j < n; j++)
            for (int32_t k = j + 1; k < n; k++) /* facets over a cell rise */
                wish[rg_pairs_find(&l->pairs, over[j], over[k])] += rg_vec3_dot(rg_vec3_add(up[j], up[k]), rg_vec3_sub(at[k], at[j]));
    }
}

/* Of several orders, one that the facets came in. */
static rg_status choose(rg_motion *m, double *rho)
{
    const rg_mesh *mesh = &m->mesh;
    const int32_t last = m->report.frame_count - 1;
    if (!m->ends_flat || last < 1 || m->layers->parts.count == 0) return rg_layers_choose(m->layers, NULL);
    rg_place *place = rg_mem_array(&m->mem, (size_t)mesh->nf, sizeof *place);
    rg_vec3 *at = rg_mem_array(&m->mem, 2 * (size_t)m->layers->flat.nf, sizeof *at);
    double *wish = rg_mem_array(&m->mem, (size_t)m->layers->pairs.count, sizeof *wish), most = 0;
    rg_status s = place && at && wish ? RG_OK : RG_ENOMEM;
    const double *now = rg_motion_angles(m, last), *before = rg_motion_angles(m, last - 1);
    for (int32_t i = 0; i < mesh->N; i++) most = fmax(most, fabs(now[i] - before[i]));
    const double part = most > LOOK_BACK ? LOOK_BACK / most : 1;
    for (int32_t i = 0; i < mesh->N; i++) rho[i] = now[i] + part * (before[i] - now[i]);
    if (s == RG_OK) {
        rg_pose_facets(mesh, rg_motion_pattern(m, last), &m->tree, rho, place);
        look_before(m, place, at, at + m->layers->flat.nf, wish);
        s = rg_layers_choose_near(m->layers, wish);
    }
    rg_mem_free(&m->mem, place);
    rg_mem_free(&m->mem, at);
    rg_mem_free(&m->mem, wish);
    return s;
}

rg_status rg_ending_find(rg_motion *m, rg_diag *why)
{
    double *angle = rg_mem_array(&m->mem, (size_t)m->mesh.N, sizeof *angle);
    rg_layers_info info;
    rg_status s = RG_OK;
    if (!angle) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    m->ends_flat = whole_turns(m, m->report.frame_count - 1, angle);
    for (int32_t i = 0; !m->ends_flat && i < m->mesh.N; i++) angle[i] = fabs(m->settings.to) * m->target[i];
    s = rg_layers_of_mesh(&m->mesh, angle, m->source.y_down, &m->mem, &m->layers, why);
    if (s == RG_OK) {
        info = *rg_layers_get_info(m->layers);
        m->report.layers = rg_layers_state_name(info.state);
        m->report.layer_orders = info.count;
        m->report.layers_reason = m->layers->info.reason;
        if (info.state == RG_LAYERS_VALID) s = choose(m, angle);
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
