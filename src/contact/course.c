#include "contact/course.h"

#include <string.h>

rg_status rg_course_init(const rg_mesh *m, rg_course *c)
{
    memset(c, 0, sizeof *c);
    c->mem = m->mem;
    rg_status s = rg_plates_init(m, &c->plates);
    if (s == RG_OK) s = rg_contact_work_init(&c->plates, &c->look);
    if (s == RG_OK) s = rg_sweep_work_init(&c->plates, &c->sweep);
    const size_t nv = (size_t)m->nv;
    if (s == RG_OK) s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(c->worst, nv));
    for (int i = 0; i < 3; i++) {
        if (s == RG_OK)
            s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(c->X[i], nv), RG_ARRAY(c->x[i], nv),
                              RG_ARRAY(c->place[i], (size_t)m->nf));
        c->state[i] = (rg_plates_state){c->X[i], c->place[i], c->x[i]};
    }
    c->found = (rg_course_found){.first = -1, .time = 1, .facet = {-1, -1}, .deepest_state = -1,
                                 .deepest = {.facet = {-1, -1}},
                                 .first_unproved = -1};
    if (s != RG_OK) rg_course_free(c);
    return s;
}

void rg_course_free(rg_course *c)
{
    if (!c->mem.resize) return;
    rg_sweep_work_free(&c->sweep);
    rg_contact_work_free(&c->look);
    rg_plates_free(&c->plates);
    for (int i = 0; i < 3; i++) {
        RG_MEM_FREE(&c->mem, c->X[i], c->place[i], c->x[i]);
    }
    rg_mem_free(&c->mem, c->worst);
    memset(c, 0, sizeof *c);
}

/* The way from state k - 1 to state k, if nothing crossed before; bend: the larger second difference at its ends. */
static rg_status look_between(rg_course *c, int32_t k, double bend)
{
    rg_course_found *f = &c->found;
    const rg_plates_state *from = &c->state[(k + 2) % 3], *to = &c->state[k % 3];
    if (f->first >= 0) return RG_OK;
    rg_sweep_found way, first;
    rg_status s = rg_sweep_step(&c->plates, from, to, RG_CONTACT_TOLERANCE, &c->sweep, &way);
    f->ways++;
    first = way;
    const double allowed = fmin(RG_CONTACT_BETWEEN, RG_CONTACT_TOLERANCE + 2 * bend / 8 / c->plates.size);
    if (s == RG_OK && way.verdict == RG_SWEEP_CONTACT)
        s = rg_sweep_step(&c->plates, from, to, allowed, &c->sweep, &way);
    /* Where something was found, the rest was followed no farther than there. */
    if (way.verdict != RG_SWEEP_FREE) c->sweep.n_now = 0;
    else if (first.verdict != RG_SWEEP_FREE) rg_sweep_forget_new(&c->sweep);
    rg_sweep_go_on(&c->sweep);
    if (s != RG_OK || first.verdict == RG_SWEEP_FREE) return s;
    if (way.verdict == RG_SWEEP_CONTACT) {
        f->first = k;
        f->between = 1;
        f->time = first.time;
        memcpy(f->facet, first.facet, sizeof f->facet);
    } else if (f->unproved++ == 0) {
        f->first_unproved = k;
    }
    return RG_OK;
}

/* State k by itself; of one between frames only whether it is the first that crosses. */
static void look_at(rg_course *c, int32_t k, int is_frame)
{
    rg_course_found *f = &c->found;
    if (!is_frame && f->first >= 0) return;
    const rg_vec3 *x = c->state[k % 3].x;
    rg_contact_hit hit = c->last;
    /* What crossed before crosses still, as a rule; then only what is deeper than all so far is looked for. */
    const int still = f->crossing > 0 && rg_contact_depth(&c->plates, x, hit.facet[0], hit.facet[1],
                                                          RG_CONTACT_TOLERANCE) > 0;
    const double least = still ? f->deepest.depth : RG_CONTACT_TOLERANCE;
    const int found = rg_contact_deepest(&c->plates, x, least, &c->look, &hit);
    if (!found && !still) return;
    c->last = hit;
    if (f->first < 0) {
        f->first = k;
        memcpy(f->facet, hit.facet, sizeof f->facet);
    }
    if (!is_frame) return;
    f->crossing++;
    if (!found || !(hit.depth > f->deepest.depth)) return;
    f->deepest = hit;
    f->deepest_state = k;
    memcpy(c->worst, x, (size_t)c->plates.mesh->nv * sizeof *c->worst);
}

/* The most that any corner's way bends at the state before the last. */
static double bend_of(const rg_course *c, int32_t k)
{
    const rg_vec3 *x = c->x[(k + 1) % 3], *y = c->x[(k + 2) % 3], *z = c->x[k % 3];
    double most = 0; /* squared */
    for (int32_t v = 0; v < c->plates.mesh->nv; v++) {
        const rg_vec3 d = rg_vec3_add(rg_vec3_axpy(-2, y[v], x[v]), z[v]);
        most = fmax(most, rg_vec3_dot(d, d));
    }
    return sqrt(most);
}

/* What comes after a way is needed to know how it bends, so that ways are looked at one state late. */
rg_status rg_course_add(rg_course *c, const rg_plates_state *s, int is_frame)
{
    const rg_mesh *m = c->plates.mesh;
    const int32_t k = c->found.states++;
    rg_status status = RG_OK;
    memcpy(c->X[k % 3], s->X, (size_t)m->nv * sizeof *s->X);
    memcpy(c->place[k % 3], s->place, (size_t)m->nf * sizeof *s->place);
    memcpy(c->x[k % 3], s->x, (size_t)m->nv * sizeof *s->x);
    if (k >= 2) {
        const double bend = bend_of(c, k);
        status = look_between(c, k - 1, fmax(bend, c->bend));
        c->bend = bend;
    }
    look_at(c, k, is_frame);
    return status;
}

rg_status rg_course_end(rg_course *c)
{
    rg_course_found *f = &c->found;
    rg_status s = RG_OK;
    if (f->states >= 2 && f->first != f->states - 1) s = look_between(c, f->states - 1, c->bend);
    if (f->deepest_state >= 0)
        f->pairs = rg_contact_pairs(&c->plates, c->worst, RG_CONTACT_TOLERANCE, &c->look, NULL, 0, NULL);
    return s;
}

/* Cosine of the angle that an axis which tells above from below may have with the normal. */
static const double UPRIGHT = 0.5;

int rg_course_side(const rg_course *c, int32_t i, int32_t facet[2])
{
    const rg_sweep_side *s = &c->sweep.before[i];
    for (int k = 0; k < 2; k++) facet[k] = c->plates.facet[s->part[k]];
    return s->axis.z > UPRIGHT ? 1 : s->axis.z < -UPRIGHT ? -1 : 0;
}
