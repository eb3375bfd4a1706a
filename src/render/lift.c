#include "render/lift.h"
#include "motion/ending.h"
#include "render/coplanar.h"
#include "render/stack.h"

/* Between two layers, in parts of the sheet's size; less where there are so many that RG_LIFT_MOST says so. */
#define STEP 5e-5
/* How far to look back at most, radians: near enough that what comes to lie flat is almost flat. Frames further apart
 * than that are looked at in between. */
#define LOOK_BACK (10 * RG_DEG)

struct rg_lift {
    rg_memory mem;
    const rg_motion *motion;
    int32_t frame;                  /* the next one */
    rg_place *place, *was, *back;   /* [nf] in this frame, a little before, from this to that */
    double *rho;                    /* [N] a little before */
    double *lift;                   /* [nf] along the facet's own normal, of the frame before */
    int32_t *level;                 /* [nf] */
    rg_coplanar coplanar;
    rg_stack stack;
};

rg_status rg_lift_create(const rg_memory *mem, const rg_motion *m, const rg_triangles *t, rg_lift **layers)
{
    const size_t nf = (size_t)m->mesh.nf;
    rg_lift *l = rg_mem_array(mem, 1, sizeof *l);
    if (!l) return RG_ENOMEM;
    *l = (rg_lift){.mem = *mem, .motion = m};
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(l->place, nf), RG_ARRAY(l->was, nf), RG_ARRAY(l->back, nf),
                                RG_ARRAY(l->rho, (size_t)m->mesh.N), RG_ARRAY(l->lift, nf), RG_ARRAY(l->level, nf));
    if (s == RG_OK) s = rg_coplanar_init(&l->coplanar, mem, &m->mesh);
    if (s == RG_OK) s = rg_stack_init(&l->stack, mem, &m->mesh, t);
    if (s != RG_OK) {
        rg_lift_destroy(l);
        return s;
    }
    *layers = l;
    return RG_OK;
}

void rg_lift_destroy(rg_lift *l)
{
    if (!l) return;
    rg_coplanar_free(&l->coplanar);
    rg_stack_free(&l->stack);
    RG_MEM_FREE(&l->mem, l->place, l->was, l->back, l->rho, l->lift, l->level, l);
}

/* Where the facets lay a little before, each with its lift: those that lie on each other already stay in order. Before
 * the first frame the sheet was a little flatter. */
static void look_back(rg_lift *l, const rg_vec2 *X)
{
    const rg_mesh *m = &l->motion->mesh;
    const double *now = rg_motion_angles(l->motion, l->frame);
    const double *before = l->frame > 0 ? rg_motion_angles(l->motion, l->frame - 1) : NULL;
    double most = 0;
    for (int32_t i = 0; i < m->N; i++) most = fmax(most, fabs(now[i] - (before ? before[i] : 0)));
    const double part = most > LOOK_BACK ? LOOK_BACK / most : 1;
    for (int32_t i = 0; i < m->N; i++) l->rho[i] = now[i] + part * ((before ? before[i] : 0) - now[i]);
    if (l->motion->space)
        rg_motion_facets(l->motion, l->frame > 0 ? l->frame - 1 : 0, l->was); /* no angles make such a sheet */
    else rg_pose_facets(m, X, &l->motion->tree, l->rho, l->was);
    for (int32_t f = 0; f < m->nf; f++) {
        const rg_mat3 R = l->place[f].R, B = l->was[f].R;
        const rg_mat3 inverse = {{{R.c[0].x, R.c[1].x, R.c[2].x},
                                  {R.c[0].y, R.c[1].y, R.c[2].y},
                                  {R.c[0].z, R.c[1].z, R.c[2].z}}};
        const rg_mat3 turn = rg_mat3_mul(B, inverse);
        const rg_vec3 was = rg_vec3_axpy(l->lift[f], B.c[2], l->was[f].t);
        l->back[f] = (rg_place){turn, rg_vec3_sub(was, rg_mat3_mul_vec(turn, l->place[f].t))};
    }
}

static rg_status lift_group(rg_lift *l, int32_t g, const rg_vec3 *x, rg_vec3 *lift)
{
    const rg_mesh *m = &l->motion->mesh;
    const rg_coplanar *c = &l->coplanar;
    const int32_t *facet = c->member + c->start[g], n = c->start[g + 1] - c->start[g];
    if (n < 2) return RG_OK;
    const rg_vec3 up = l->place[c->first[g]].R.c[2], base = x[m->facet_vertex[m->facet_start[c->first[g]]]];
    int32_t levels;
    const rg_status s = rg_stack_order(&l->stack, facet, n, base, up, x, l->back, l->level, &levels);
    if (s != RG_OK || levels < 2) return s;
    const double step = fmin(STEP, 2 * RG_LIFT_MOST / (levels - 1)) * m->size;
    for (int32_t i = 0; i < n; i++)
        lift[facet[i]] = rg_vec3_scale((l->level[facet[i]] - 0.5 * (levels - 1)) * step, up);
    return RG_OK;
}

/* The flat end, whose order is known: each facet along its stack's normal, by its level. */
static rg_status lift_end(rg_lift *l, const rg_layers *known, rg_vec3 *lift)
{
    const rg_mesh *m = &l->motion->mesh;
    const rg_flat *flat = &known->flat;
    const int32_t levels = rg_layers_levels(known, l->level, NULL);
    if (levels < 0) return RG_ENOMEM;
    const double step = levels < 2 ? 0 : fmin(STEP, 2 * RG_LIFT_MOST / (levels - 1)) * m->size;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t g = flat->facet_of[f];
        lift[f] = rg_vec3_scale((l->level[g] - 0.5 * (levels - 1)) * step * flat->up[g], l->place[f].R.c[2]);
    }
    return RG_OK;
}

rg_status rg_lift_next(rg_lift *l, rg_vec3 *x, rg_vec3 *lift)
{
    const rg_mesh *m = &l->motion->mesh;
    if (l->frame >= l->motion->report.frame_count) return RG_EARG;
    const rg_vec2 *X = rg_motion_pattern(l->motion, l->frame);
    rg_motion_facets(l->motion, l->frame, l->place);
    rg_status s = RG_OK;
    if (l->motion->space) s = rg_motion_place(l->motion, l->frame, x);
    else rg_pose_vertices(m, X, &l->motion->tree, l->place, x);
    const rg_layers *known = rg_ending_layers(l->motion, l->frame);
    for (int32_t f = 0; f < m->nf; f++) lift[f] = (rg_vec3){0, 0, 0};
    if (s == RG_OK && known) s = lift_end(l, known, lift);
    if (!known) {
        look_back(l, X);
        rg_coplanar_find(&l->coplanar, l->place, x);
    }
    for (int32_t g = 0; !known && s == RG_OK && g < l->coplanar.groups; g++) s = lift_group(l, g, x, lift);
    for (int32_t f = 0; f < m->nf; f++) l->lift[f] = rg_vec3_dot(lift[f], l->place[f].R.c[2]);
    l->frame++;
    return s;
}
