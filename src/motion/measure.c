#include "motion/measure.h"
#include "contact/course.h"
#include "kinematics/constraint.h"
#include "mesh/components.h"
#include "mesh/symmetry.h"

#include <string.h>

/* A frame has a symmetry when no crease differs by more from its image, radians: too little to be seen, and far above
 * the rounding of drawings. Of so many groups, the largest ones, the first that all frames have is told. */
static const double SYMMETRIC = 0.01 * RG_DEG;
enum { MOST_GROUPS = 64 };

/* Degrees on the wrong side that are told; lengths, over the sheet's size, that are rounding and closing tolerance. */
static const double WRONG_SIDE = 0.1, ISOMETRIC = 1e-8;

/* A new maximum, or NaN as soon as there is one. */
static double larger(double most, double value)
{
    return value <= most || isnan(most) ? most : value;
}

/* Room for one frame. */
typedef struct gauge {
    rg_constraint K;   /* on the pattern `of` */
    double *sector;    /* [corners] of it */
    const rg_vec2 *of;
    rg_place *place;   /* [nf] */
    rg_vec3 *x;        /* [nv] */
    int32_t *part;     /* [N] */
} gauge;

/* Largest rotation angle of F over the interior vertices, for fold angles rho on the pattern X. */
static double closure(gauge *g, const rg_mesh *m, const rg_vec2 *X, const double *rho)
{
    if (g->of != X) {
        g->of = X;
        rg_mesh_sectors(m, X, g->sector);
        rg_constraint_set_theta(&g->K, g->sector);
    }
    return rg_constraint_closure(&g->K, rho, NULL);
}

double rg_measure_percent(const rg_motion *m, const double *rho, double none)
{
    double sum = 0;
    int32_t driven = 0;
    for (int32_t i = 0; i < m->mesh.N; i++) {
        const double way = m->target[i] - m->from[i];
        if (isnan(way) || way == 0) continue;
        sum += fmin(100, 100 * (rho[i] - m->from[i]) / way);
        driven++;
    }
    return driven ? sum / driven : none;
}

/* Of driven creases in frame k: how far they are, and how they came there from the frame before. */
static void measure_angles(rg_motion *m, int32_t k)
{
    rg_report *r = &m->report;
    const double *rho = rg_motion_angles(m, k), *before = k ? rg_motion_angles(m, k - 1) : rho;
    double least = INFINITY, wrong = 0;
    int32_t driven = 0, creases = 0;
    for (int32_t i = 0; i < m->mesh.N; i++) {
        const double way = m->target[i] - m->from[i];
        r->max_overfold_deg = larger(r->max_overfold_deg, (fabs(rho[i]) - RG_PI) / RG_DEG);
        if (isnan(way) || way == 0) continue;
        const double part = fmin(100, 100 * (rho[i] - m->from[i]) / way);
        least = fmin(least, part);
        if (part < 0) wrong = larger(wrong, fabs(rho[i] - m->from[i]) / RG_DEG);
        creases += part < -1e-4;
        r->max_leap_deg = larger(r->max_leap_deg, fabs(rho[i] - before[i]) / RG_DEG);
        driven++;
    }
    m->frame[k].percent = r->folded_percent = rg_measure_percent(m, rho, k ? 100 : 0);
    r->least_folded_percent = driven ? least + 0 : r->folded_percent; /* 0, never -0 */
    r->max_wrong_side_deg = larger(r->max_wrong_side_deg, wrong);
    r->wrong_side_frames += !(wrong <= WRONG_SIDE);
    r->wrong_side_creases = creases;
}

/* Largest displacement of a vertex from the pattern given, over the sheet's size. */
static double displacement(const rg_mesh *m, const rg_vec2 *X)
{
    double most = 0;
    for (int32_t v = 0; v < m->nv; v++) most = larger(most, rg_vec2_length(rg_vec2_sub(X[v], m->X[v])) / m->size);
    return most;
}

/* Is the border of X the border given, and is every facet the right way up? Ends of a border edge stay on its line, a
 * corner on both of its lines. */
static int is_same_sheet(const rg_mesh *m, const rg_vec2 *X)
{
    int same = 1;
    for (int32_t e = 0; e < m->ne; e++) {
        if (m->edge_crease[e] >= 0) continue;
        const rg_vec2 a = m->X[m->edge[e][0]], d = rg_vec2_sub(m->X[m->edge[e][1]], a);
        for (int k = 0; k < 2; k++)
            same &= fabs(rg_vec2_cross(d, rg_vec2_sub(X[m->edge[e][k]], a))) <= ISOMETRIC * m->size * rg_vec2_length(d);
        same &= rg_vec2_dot(d, rg_vec2_sub(X[m->edge[e][1]], X[m->edge[e][0]])) > 0;
    }
    for (int32_t f = 0; f < m->nf; f++) same &= rg_mesh_twice_area(m, f, X) > 0;
    return same;
}

static rg_status make_room(gauge *g, const rg_memory *mem, const rg_mesh *m)
{
    const rg_status s = rg_constraint_init(&g->K, mem, m);
    if (s != RG_OK) return s;
    return RG_MEM_ARRAYS(mem, RG_ARRAY(g->sector, (size_t)m->loop_start[m->M]), RG_ARRAY(g->place, (size_t)m->nf),
                         RG_ARRAY(g->x, (size_t)m->nv), RG_ARRAY(g->part, (size_t)m->N));
}

/* Where a state's facets and vertices are. */
static void place(const rg_motion *m, const rg_motion_state *s, gauge *g)
{
    rg_pose_facets(&m->mesh, s->X, &m->tree, s->rho, g->place);
    rg_pose_vertices(&m->mesh, s->X, &m->tree, g->place, g->x);
}

static void measure_frame(rg_motion *m, const rg_motion_state *s, gauge *g)
{
    rg_report *r = &m->report;
    const int32_t k = s->frame;
    const double *rho = s->rho;
    const rg_vec2 *X = s->X;
    measure_angles(m, k);
    m->frame[k].closure_residual = closure(g, &m->mesh, X, rho);
    r->max_closure_residual = larger(r->max_closure_residual, m->frame[k].closure_residual);
    place(m, s, g);
    const double strain = rg_pose_strain(&m->mesh, X, g->x);
    r->max_edge_strain = larger(r->max_edge_strain, strain);
    const double from_original = m->flat ? rg_pose_strain(&m->mesh, m->mesh.X, g->x) : strain;
    r->max_strain_from_original = larger(r->max_strain_from_original, from_original);
    const double gap = rg_pose_gap(X, &m->tree, g->place) / m->mesh.size;
    r->max_facet_gap = larger(r->max_facet_gap, gap);
    r->isometric = r->isometric && strain <= ISOMETRIC && gap <= ISOMETRIC && (!m->flat || is_same_sheet(&m->mesh, X));
    r->moved_at_end = m->flat ? displacement(&m->mesh, X) : 0;
    r->max_adjustment = larger(r->max_adjustment, r->moved_at_end);
}

static double asymmetry(const rg_motion *m, const rg_symmetry *G)
{
    double most = 0;
    for (int32_t k = 0; k < m->report.frame_count; k++) most = larger(most, rg_symmetry_off(G, rg_motion_angles(m, k)));
    return most;
}

static rg_status measure_symmetry(rg_motion *m)
{
    rg_symmetry whole, part;
    rg_subgroup list[MOST_GROUPS];
    m->report.symmetry = 1;
    rg_status s = rg_symmetry_find(&whole, &m->mem, &m->mesh);
    if (s != RG_OK) return s;
    const int32_t n = rg_symmetry_subgroups(&whole, list, MOST_GROUPS);
    for (int32_t k = 0; s == RG_OK && m->report.symmetry == 1 && k < n && list[k].order > 1; k++) {
        s = rg_symmetry_part(&part, &whole, list[k].every, list[k].mirror);
        if (s != RG_OK) break;
        const double off = asymmetry(m, &part);
        if (off <= SYMMETRIC) m->report.symmetry = part.order, m->report.max_asymmetry_deg = off / RG_DEG;
        rg_symmetry_free(&part);
    }
    rg_symmetry_free(&whole);
    return s;
}

void rg_measure_place(rg_motion *m, const int32_t facet[2])
{
    for (int k = 0; k < 2; k++) {
        m->report.contact_facets[k] = facet[k];
        rg_motion_drawn(m, rg_plates_middle(&m->mesh, facet[k]), m->report.contact_at[k]);
    }
}

/* State k of the motion, by itself. */
static rg_motion_state find_state(const rg_motion *m, int32_t k)
{
    int32_t gaps = 0;
    for (int32_t i = 0; i < k; i++) rg_motion_state_at(m, i, &gaps);
    return rg_motion_state_at(m, k, &gaps);
}

/* The frame that a state is, or on the way to which it lies. */
static int32_t frame_at(const rg_motion *m, int32_t k)
{
    const rg_motion_state s = find_state(m, k);
    return s.frame + s.is_between;
}

/* A frame has its percent, which is another one in a sequence of states; what lies between two is between theirs. */
static double percent_at(const rg_motion *m, int32_t k)
{
    const rg_motion_state s = find_state(m, k);
    const double from = m->frame[s.frame].percent;
    if (!s.is_between) return from;
    const double a = rg_measure_percent(m, rg_motion_angles(m, s.frame), 100), p = rg_measure_percent(m, s.rho, 100);
    const double b = rg_measure_percent(m, rg_motion_angles(m, s.frame + 1), 100);
    const double part = a < b ? fmin(1, fmax(0, (p - a) / (b - a))) : 0;
    return from + part * (m->frame[s.frame + 1].percent - from);
}

/* What is known of contact once all states are in; a NULL course: nothing is. */
static void measure_contact(rg_motion *m, rg_course *c)
{
    rg_report *r = &m->report;
    r->first_contact_frame = r->deepest_contact_frame = r->contact_facets[0] = r->contact_facets[1] = -1;
    r->first_contact_percent = NAN;
    if (!c) return;
    const rg_course_found *f = &c->found;
    r->contact = f->first < 0 ? RG_CONTACT_FREE : RG_CONTACT_CROSSES;
    r->contact_unproved = f->unproved;
    r->contact_frames = f->crossing;
    if (f->deepest_state >= 0) r->deepest_contact_frame = frame_at(m, f->deepest_state);
    r->contact_pairs = f->pairs;
    r->contact_depth = f->deepest.depth;
    if (f->first < 0) return;
    r->first_contact_frame = frame_at(m, f->first);
    const double percent = percent_at(m, f->first);
    r->first_contact_percent = percent;
    if (f->between) r->first_contact_percent += (1 - f->time) * (percent_at(m, f->first - 1) - percent);
    rg_measure_place(m, f->facet);
}

/* On which side of each other facets come into the last frame. */
static rg_status keep_sides(rg_motion *m, const rg_course *c)
{
    rg_mem_free(&m->mem, m->side);
    m->sides = 0;
    m->side = rg_mem_array(&m->mem, (size_t)c->sweep.n_before, sizeof *m->side);
    if (!m->side) return RG_ENOMEM;
    for (int32_t i = 0; c->found.first < 0 && i < c->sweep.n_before; i++) {
        rg_motion_side *s = &m->side[m->sides];
        s->before = rg_course_side(c, i, s->facet);
        m->sides += s->before != 0;
    }
    return RG_OK;
}

rg_status rg_measure_frames(rg_motion *m, rg_watch *watch)
{
    int looks = m->settings.contact != RG_CONTACT_IGNORE && !(watch && rg_watch_asked(watch));
    int32_t gaps = 0;
    rg_course course = {0};
    gauge g = {0};
    rg_status s = make_room(&g, &m->mem, &m->mesh);
    if (s == RG_OK && looks) s = rg_course_init(&m->mesh, &course);
    if (s == RG_OK) m->report.components = rg_components_find(&m->mesh, g.part);
    m->report.isometric = 1;
    for (int32_t k = 0; s == RG_OK && k < rg_motion_states(m); k++) {
        const rg_motion_state state = rg_motion_state_at(m, k, &gaps);
        if (state.is_between && looks) place(m, &state, &g);
        else if (!state.is_between) measure_frame(m, &state, &g);
        looks = looks && !(watch && rg_watch_asked(watch));
        if (looks) s = rg_course_add(&course, &(rg_plates_state){state.X, g.place, g.x}, !state.is_between);
    }
    if (looks && s == RG_OK) s = rg_course_end(&course);
    if (s == RG_OK) measure_contact(m, looks ? &course : NULL);
    if (looks && s == RG_OK) s = keep_sides(m, &course);
    rg_course_free(&course);
    rg_constraint_free(&g.K);
    RG_MEM_FREE(&m->mem, g.sector, g.place, g.x, g.part);
    if (s != RG_OK) return RG_ENOMEM;
    m->report.symmetry = 1;
    return watch && watch->cancelled ? RG_OK : measure_symmetry(m);
}
