#include "render/camera.h"
#include "base/status.h"

#include <float.h>

/* The eye is this many radii of the motion away: perspective is felt and parallel folds still look parallel. */
#define DISTANCE 7.0
/* Part of the picture left free on each side. */
#define MARGIN 0.05
/* Room before and behind the motion, in parts of its depth, for lifted layers. */
#define DEPTH_ROOM 0.02
/* Beyond this zoom one looks at less than a pixel's worth of a large sheet. */
#define MAX_ZOOM 1000.0
/* Frames a second: what the formats of animations can say. */
#define MIN_RATE 0.01
#define MAX_RATE 1000.0

rg_picture rg_picture_default(void)
{
    return (rg_picture){
        .width = 960,
        .height = 720,
        .azimuth = -60 * RG_DEG,
        .elevation = 35 * RG_DEG,
        .zoom = 1,
        .front = {240, 178, 74},
        .back = {252, 248, 240},
        .background = {236, 240, 244},
        .creases = 1,
        .fps = 30,
    };
}

rg_status rg_camera_check(const rg_picture *p, rg_diag *why)
{
    if (p->width < 1 || p->height < 1 || p->width > RG_MAX_PICTURE || p->height > RG_MAX_PICTURE)
        return rg_fail(RG_EARG, why, 0, "a picture of %d x %d pixels: each side may be 1 to %d", (int)p->width,
                       (int)p->height, RG_MAX_PICTURE);
    if (!isfinite(p->azimuth) || !isfinite(p->elevation))
        return rg_fail(RG_EARG, why, 0, "the camera's azimuth and elevation have to be finite");
    if (!(p->zoom > 0 && p->zoom <= MAX_ZOOM))
        return rg_fail(RG_EARG, why, 0, "a zoom of %g: it may be up to %g, and above 0", p->zoom, MAX_ZOOM);
    if (!(p->fps >= MIN_RATE && p->fps <= MAX_RATE))
        return rg_fail(RG_EARG, why, 0, "%g frames a second: it may be %g to %g", p->fps, MIN_RATE, MAX_RATE);
    return RG_OK;
}

typedef struct box {
    double lo[3], hi[3];
} box;

static const box nothing = {{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}};

static void box_add(box *b, double x, double y, double z)
{
    const double at[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        if (at[i] < b->lo[i]) b->lo[i] = at[i];
        if (at[i] > b->hi[i]) b->hi[i] = at[i];
    }
}

static void look(rg_camera *c, double azimuth, double elevation)
{
    const double ca = cos(azimuth), sa = sin(azimuth), ce = cos(elevation), se = sin(elevation);
    c->back = (rg_vec3){ce * ca, ce * sa, se};
    c->right = (rg_vec3){-sa, ca, 0};
    c->up = rg_vec3_cross(c->back, c->right);
}

/* The motion's box along the camera's axes places the eye; what the eye then sees of it, the picture's scale. */
static rg_status frame_motion(const rg_motion *m, rg_camera *c, rg_vec3 *x, box *seen)
{
    box space = nothing;
    *seen = nothing;
    for (int pass = 0; pass < 2; pass++) {
        for (int32_t f = 0; f < m->report.frame_count; f++) {
            const rg_status s = rg_motion_place(m, f, x);
            if (s != RG_OK) return s;
            for (int32_t v = 0; v < m->mesh.nv; v++) {
                const rg_vec3 from = pass == 0 ? x[v] : rg_vec3_sub(x[v], c->eye);
                const double r = rg_vec3_dot(c->right, from), u = rg_vec3_dot(c->up, from);
                const double b = rg_vec3_dot(c->back, from);
                if (pass == 0) box_add(&space, r, u, b);
                else box_add(seen, r / -b, u / -b, -b);
            }
        }
        if (pass == 1) break;
        const double r = 0.5 * (space.lo[0] + space.hi[0]), u = 0.5 * (space.lo[1] + space.hi[1]);
        const double b = 0.5 * (space.lo[2] + space.hi[2]);
        const rg_vec3 span = {space.hi[0] - space.lo[0], space.hi[1] - space.lo[1], space.hi[2] - space.lo[2]};
        const double distance = DISTANCE * 0.5 * rg_vec3_length(span);
        c->eye = rg_vec3_axpy(r, c->right, rg_vec3_axpy(u, c->up, rg_vec3_scale(b + distance, c->back)));
    }
    return RG_OK;
}

rg_status rg_camera_fit(const rg_motion *m, const rg_picture *p, rg_camera *camera, rg_diag *why)
{
    rg_camera c = {.half_width = 0.5 * p->width, .half_height = 0.5 * p->height};
    rg_status s = rg_camera_check(p, why);
    if (s != RG_OK) return s;
    look(&c, p->azimuth, p->elevation);
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    box seen = nothing;
    s = x ? frame_motion(m, &c, x, &seen) : RG_ENOMEM;
    rg_mem_free(&m->mem, x);
    if (s != RG_OK) return rg_fail(s, why, 0, "%s", rg_status_text(s));
    const double wide = seen.hi[0] - seen.lo[0], high = seen.hi[1] - seen.lo[1];
    if (!(wide + high > 0) || !isfinite(wide + high) || !(seen.lo[2] > 0))
        return rg_fail(RG_EARG, why, 0, "there is nothing to take a picture of");
    /* Seen from the edge a flat sheet has no height: then its width alone sets the scale. */
    const double fit = fmin((1 - 2 * MARGIN) * p->width / wide, (1 - 2 * MARGIN) * p->height / high);
    c.scale = p->zoom * fit;
    c.u0 = 0.5 * (seen.lo[0] + seen.hi[0]);
    c.v0 = 0.5 * (seen.lo[1] + seen.hi[1]);
    const double room = DEPTH_ROOM * (seen.hi[2] - seen.lo[2] + m->mesh.size);
    c.near = seen.lo[2] - room;
    c.far = seen.hi[2] + room;
    *camera = c;
    return RG_OK;
}

rg_vec3 rg_camera_project(const rg_camera *c, rg_vec3 x)
{
    const rg_vec3 d = rg_vec3_sub(x, c->eye);
    const double away = -rg_vec3_dot(c->back, d);
    const double u = rg_vec3_dot(c->right, d) / away, v = rg_vec3_dot(c->up, d) / away;
    /* 1 / away is what is linear on the screen. */
    const double depth = (1 / c->near - 1 / away) / (1 / c->near - 1 / c->far);
    return (rg_vec3){c->half_width + c->scale * (u - c->u0), c->half_height - c->scale * (v - c->v0), depth};
}
