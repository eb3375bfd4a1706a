/* photo.h -- pictures of motions made by hand, and their pixels.  Include after cmocka.h, near.h and motions.h. */
#ifndef PHOTO_H
#define PHOTO_H

#include "motions.h"
#include "render/camera.h"
#include "render/render.h"

typedef struct photo {
    rg_picture picture;
    rg_place place; /* on the stage */
    rg_camera camera;
    unsigned char *rgb;
} photo;

/* Also without OpenGL pictures are made. */
static inline photo take_as(const rg_motion *m, int32_t frame, rg_picture picture, const rg_print *print, const unsigned char (*tint)[3],
                            const rg_layers *layers)
{
    photo p = {.picture = picture};
    rg_triangles t;
    rg_stage stage;
    rg_render *r = NULL;
    rg_diag why = {0, ""};
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x);
    rg_camera *camera = calloc((size_t)m->report.frame_count, sizeof *camera);
    p.rgb = calloc((size_t)picture.width * (size_t)picture.height, 3);
    assert_true(x && p.rgb && camera);
    assert_int_equal(rg_triangles_init(NULL, &m->mesh, &t), RG_OK);
    assert_int_equal(rg_stage_init(&m->mem, m, &picture, &stage), RG_OK);
    if (rg_camera_follow(&stage, &picture, camera, &why) != RG_OK) fail_msg("%s", why.text);
    if (rg_render_create(NULL, &m->mesh, &t, &picture, print, &r, &why) != RG_OK) fail_msg("%s", why.text);
    assert_int_equal(rg_motion_place(m, frame, x), RG_OK);
    rg_stage_put(&stage, frame, x, m->mesh.nv);
    const rg_shot shot = {x, NULL, &camera[frame], tint, layers};
    rg_render_frame(r, &shot, p.rgb);
    p.place = stage.place[frame];
    p.camera = camera[frame];
    rg_render_destroy(r);
    rg_triangles_free(&t);
    rg_stage_free(&stage);
    free(x);
    free(camera);
    return p;
}

static inline photo take(const rg_motion *m, int32_t frame, rg_picture picture, const rg_print *print)
{
    return take_as(m, frame, picture, print, NULL, NULL);
}

static inline const unsigned char *pixel(const photo *p, int x, int y) { return p->rgb + 3 * ((size_t)y * (size_t)p->picture.width + (size_t)x); }

static inline int is_background(const photo *p, int x, int y) { return memcmp(pixel(p, x, y), p->picture.background, 3) == 0; }

static inline rg_picture plain(int32_t width, int32_t height)
{
    rg_picture p = rg_picture_default();
    p.width = width;
    p.height = height;
    p.lines = RG_LINES_NONE;
    p.shadow = 0;
    p.aimed = 1;
    return p;
}

/* A pinhole camera, written down anew: along the axis, the picture's plane is where a unit is c->scale pixels. */
static inline rg_vec2 seen(const photo *p, rg_vec3 at)
{
    const rg_camera *c = &p->camera;
    const rg_vec3 x = rg_vec3_add(rg_mat3_mul_vec(p->place.R, at), p->place.t);
    const double d[3] = {x.x - c->eye.x, x.y - c->eye.y, x.z - c->eye.z};
    const double away = -(d[0] * c->back.x + d[1] * c->back.y + d[2] * c->back.z);
    return (rg_vec2){c->scale * (d[0] * c->right.x + d[1] * c->right.y + d[2] * c->right.z) / away,
                     c->scale * (d[0] * c->up.x + d[1] * c->up.y + d[2] * c->up.z) / away};
}

#endif
