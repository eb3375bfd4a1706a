#include "render/seen.h"
#include "render/samples.h"

#include <float.h>
#include <string.h>

rg_status rg_seen_init(const rg_memory *mem, const rg_mesh *m, rg_gl_vertex *corner, rg_seen *s)
{
    const size_t nf = (size_t)m->nf;
    *s = (rg_seen){.mem = *mem, .mesh = m, .corner = corner};
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) corner[j].mark = 1 + (uint32_t)f;
    return RG_MEM_ARRAYS(mem, RG_ARRAY(s->box, nf), RG_ARRAY(s->front, nf), RG_ARRAY(s->wide, nf),
                         RG_ARRAY(s->light, nf), RG_ARRAY(s->paper, nf + 1));
}

void rg_seen_free(rg_seen *s)
{
    if (!s->mem.resize) return;
    RG_MEM_FREE(&s->mem, s->box, s->front, s->wide, s->light, s->paper);
    memset(s, 0, sizeof *s);
}

/* Where the lamps are, along the camera's right, up and back: one from the upper left, a weaker one from the right.
 * They go with the camera, so that every azimuth looks alike. */
static const double KEY[3] = {-0.48, 0.55, 0.68}, FILL[3] = {0.75, -0.20, 0.63};

/* Steeper than the key lamp, so that the shadow stays near what throws it. */
rg_vec3 rg_seen_lamp(const rg_camera *c)
{
    static const double aside = -0.3, behind = -0.1; /* over its height */
    const rg_vec3 away = {c->back.x, c->back.y, 0};
    return rg_vec3_axpy(aside, c->right, rg_vec3_axpy(behind, away, (rg_vec3){0, 0, 1}));
}

/* n: towards the viewer. So much light is all around that either side of the paper, in its darkest place, stands out
 * from the background by 3 : 1, the least contrast of what has a meaning (WCAG 2.1, 1.4.11). */
static double light(const rg_camera *c, rg_vec3 n)
{
    static const double around = 0.68, key = 0.32, fill = 0.12;
    const double r = rg_vec3_dot(n, c->right), u = rg_vec3_dot(n, c->up), b = rg_vec3_dot(n, c->back);
    const double from_key = KEY[0] * r + KEY[1] * u + KEY[2] * b, from_fill = FILL[0] * r + FILL[1] * u + FILL[2] * b;
    return fmin(1, around + key * fmax(0, from_key) + fill * fmax(0, from_fill));
}

/* The side one sees, and its colour. */
static void shade(rg_seen *s, int32_t f, const rg_shot *shot, rg_vec3 lift, const rg_picture *p)
{
    const rg_mesh *m = s->mesh;
    const rg_camera *c = shot->camera;
    rg_vec3 n = rg_pose_normal(m, f, shot->x);
    const rg_vec3 at = rg_vec3_add(shot->x[m->facet_vertex[m->facet_start[f]]], lift);
    s->front[f] = rg_vec3_dot(n, rg_vec3_sub(c->eye, at)) >= 0;
    if (!s->front[f]) n = rg_vec3_scale(-1, n);
    const double level = light(c, n), bright[3] = {pow(level, 0.80), pow(level, 0.92), level}; /* warm shadows */
    const unsigned char *paper = shot->tint ? shot->tint[f] : s->front[f] ? p->front : p->back;
    unsigned char rgb[3];
    for (int i = 0; i < 3; i++) {
        s->light[f][i] = bright[i];
        rgb[i] = (unsigned char)(bright[i] * paper[i] + 0.5);
    }
    s->paper[f + 1] = rg_samples_colour(rgb);
}

static rg_box both(rg_box a, rg_box b)
{
    return (rg_box){fminf(a.left, b.left), fminf(a.top, b.top), fmaxf(a.right, b.right), fmaxf(a.bottom, b.bottom)};
}

static float width_of(const rg_seen *s, int32_t f)
{
    const int32_t first = s->mesh->facet_start[f], last = s->mesh->facet_start[f + 1];
    double area = 0, round = 0;
    for (int32_t j = first, i = last - 1; j < last; i = j++) {
        const rg_gl_vertex *a = &s->corner[i], *b = &s->corner[j], *o = &s->corner[first];
        area += ((double)a->x - o->x) * ((double)b->y - o->y) - ((double)b->x - o->x) * ((double)a->y - o->y);
        round += hypot((double)b->x - a->x, (double)b->y - a->y);
    }
    return round > 0 ? (float)(fabs(area) / round) : 0;
}

void rg_seen_look(rg_seen *s, const rg_shot *shot, const rg_picture *p, int fine)
{
    static const rg_box nothing = {FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX};
    const rg_mesh *m = s->mesh;
    s->all = nothing;
    for (int32_t f = 0; f < m->nf; f++) {
        const rg_vec3 up = shot->lift ? shot->lift[f] : (rg_vec3){0, 0, 0};
        s->box[f] = nothing;
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const rg_vec3 at = rg_camera_project(shot->camera, rg_vec3_add(shot->x[m->facet_vertex[j]], up));
            rg_gl_vertex *v = &s->corner[j];
            v->x = (float)(fine * at.x), v->y = (float)(fine * at.y), v->z = (float)at.z;
            s->box[f] = both(s->box[f], (rg_box){v->x, v->y, v->x, v->y});
        }
        s->all = both(s->all, s->box[f]);
        s->wide[f] = width_of(s, f);
        shade(s, f, shot, up, p);
    }
}
