#include "render/camera.h"
#include "base/status.h"
#include "render/caption.h"

#include <float.h>

/* A sheet that just fills the picture's shorter side is that many halves of it away: perspective is felt and parallel
 * folds still look parallel. */
static const double LENS = 7;
/* Part of the picture left free on each side. */
static const double MARGIN = 0.06;
/* Room before and behind the sheet, in parts of its size, for lifted layers. */
static const double DEPTH_ROOM = 0.02;
/* The floor is that part of the sheet's size below its lowest point: a sheet that lies flat has a soft seam. */
static const double FLOOR = 0.01;
/* Frames before and after that have a say in where the camera is, in parts of all frames; and no more than so many,
 * half a minute of a film, so that time goes by the frames and not by their square. */
static const double REACH = 0.1;
enum { MOST_REACH = 1000 };
/* ---- where the sheet is seen */

/* Along the camera's axes: what is seen of a point at (r, u, b) from the eye at (0, 0, d) is at r / (d - b), u / (d -
 * b). The sheet fits between -w and w where d >= b + |r| / w for all of it. */
typedef struct extent {
    double right, left, top, bottom; /* most of b + r / w, b - r / w, b + u / h, b - u / h */
    double front, back;              /* most and least of b */
    double ground;                   /* least height */
} extent;

typedef struct track {
    const rg_stage *stage;
    rg_camera camera;   /* what all frames have in common */
    double wide, high;  /* w, h of above: the half picture without its margins */
    rg_vec3 *x;         /* [nv] */
    double *at[4];      /* [frames] of the eye: right, up, back; the floor */
    double *work;       /* [frames] */
    int32_t frames;
} track;

static extent extent_of(const track *t, double r0, double u0)
{
    const rg_camera *c = &t->camera;
    const int32_t nv = t->stage->motion->mesh.nv;
    extent e = {-DBL_MAX, -DBL_MAX, -DBL_MAX, -DBL_MAX, -DBL_MAX, DBL_MAX, DBL_MAX};
    for (int32_t v = 0; v < nv; v++) {
        const double r = (rg_vec3_dot(c->right, t->x[v]) - r0) / t->wide,
                     u = (rg_vec3_dot(c->up, t->x[v]) - u0) / t->high;
        const double b = rg_vec3_dot(c->back, t->x[v]);
        e.right = fmax(e.right, b + r), e.left = fmax(e.left, b - r);
        e.top = fmax(e.top, b + u), e.bottom = fmax(e.bottom, b - u);
        e.front = fmax(e.front, b), e.back = fmin(e.back, b);
        e.ground = fmin(e.ground, t->x[v].z);
    }
    return e;
}

/* The nearest eye that sees all of it. Where the picture is not filled across one of its sides, that side's middle is
 * found anew from there. */
static void middle_of(const track *t, double eye[3])
{
    const rg_camera *c = &t->camera;
    const extent e = extent_of(t, 0, 0);
    const double by_width = 0.5 * (e.right + e.left), by_height = 0.5 * (e.top + e.bottom);
    double low[2] = {DBL_MAX, DBL_MAX}, high[2] = {-DBL_MAX, -DBL_MAX};
    eye[0] = 0.5 * t->wide * (e.right - e.left);
    eye[1] = 0.5 * t->high * (e.top - e.bottom);
    eye[2] = fmax(by_width, by_height);
    enum { ROUNDS = 4 }; /* each leaves about a seventh, the lens's perspective, of what was off */
    for (int i = 0; i < ROUNDS; i++) {
        for (int k = 0; k < 2; k++) low[k] = DBL_MAX, high[k] = -DBL_MAX;
        for (int32_t v = 0; v < t->stage->motion->mesh.nv; v++) {
            const double away = eye[2] - rg_vec3_dot(c->back, t->x[v]);
            const double seen[2] = {(rg_vec3_dot(c->right, t->x[v]) - eye[0]) / away,
                                    (rg_vec3_dot(c->up, t->x[v]) - eye[1]) / away};
            for (int k = 0; k < 2; k++) low[k] = fmin(low[k], seen[k]), high[k] = fmax(high[k], seen[k]);
        }
        const int slack = by_width < by_height ? 0 : 1;
        eye[slack] += 0.5 * (low[slack] + high[slack]) * (eye[2] - 0.5 * (e.front + e.back));
    }
}

/* ---- over time */

static int32_t clamp(int32_t k, int32_t n) { return k < 0 ? 0 : k >= n ? n - 1 : k; }

/* The mean of the frames around, the nearer the more; beyond the ends it is as at the ends. */
static void smooth(const track *t, double *a, int32_t reach)
{
    for (int32_t k = 0; k < t->frames; k++) {
        double sum = 0, weights = 0;
        for (int32_t i = -reach; i <= reach; i++) {
            const double w = 1 + reach - (i < 0 ? -i : i);
            sum += w * a[clamp(k + i, t->frames)];
            weights += w;
        }
        t->work[k] = sum / weights;
    }
    for (int32_t k = 0; k < t->frames; k++) a[k] = t->work[k];
}

/* Above all frames around, and smooth. */
static void smooth_above(const track *t, double *a, int32_t reach)
{
    for (int32_t k = 0; k < t->frames; k++) {
        t->work[k] = a[k];
        for (int32_t i = -reach; i <= reach; i++) t->work[k] = fmax(t->work[k], a[clamp(k + i, t->frames)]);
    }
    for (int32_t k = 0; k < t->frames; k++) a[k] = t->work[k];
    smooth(t, a, reach);
}

/* The facet that has a point of the pattern in it or on its rim, else -1; corners are counter-clockwise, facets need
 * not be convex. */
static int32_t facet_with(const rg_mesh *m, rg_vec2 p)
{
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t first = m->facet_start[f], last = m->facet_start[f + 1];
        int inside = 0;
        for (int32_t j = first, i = last - 1; j < last; i = j++) {
            const rg_vec2 a = m->X[m->facet_vertex[i]], b = m->X[m->facet_vertex[j]], d = rg_vec2_sub(b, a),
                          q = rg_vec2_sub(p, a);
            const double length = rg_vec2_length(d), along = rg_vec2_dot(q, d) / length;
            if (fabs(rg_vec2_cross(d, q)) <= 1e-9 * m->size * length && along >= -1e-9 * m->size &&
                along <= length + 1e-9 * m->size)
                return f;
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
        }
        if (inside) return f;
    }
    return -1;
}

/* Where a point of the sheet, given on the pattern, is in a frame: by the triangle of three of its facet's corners. */
static rg_vec3 place_of(const track *t, int32_t facet, rg_vec2 p)
{
    const rg_mesh *m = &t->stage->motion->mesh;
    const int32_t *v = m->facet_vertex + m->facet_start[facet], n = m->facet_start[facet + 1] - m->facet_start[facet];
    int32_t second = 1, third = 2;
    double most = 0;
    for (int32_t i = 1; i < n; i++)
        for (int32_t j = i + 1; j < n; j++) {
            const double turn = fabs(rg_vec2_turn(m->X[v[0]], m->X[v[i]], m->X[v[j]]));
            if (turn > most) most = turn, second = i, third = j;
        }
    const rg_vec2 a = m->X[v[0]], b = m->X[v[second]], c = m->X[v[third]];
    const double whole = rg_vec2_turn(a, b, c), B = rg_vec2_turn(a, p, c) / whole, C = rg_vec2_turn(a, b, p) / whole;
    return rg_vec3_axpy(1 - B - C, t->x[v[0]], rg_vec3_axpy(B, t->x[v[second]], rg_vec3_scale(C, t->x[v[third]])));
}

static rg_status pose(const track *t, int32_t k)
{
    const rg_status s = rg_motion_place(t->stage->motion, k, t->x);
    if (s == RG_OK) rg_stage_put(t->stage, k, t->x, t->stage->motion->mesh.nv);
    return s;
}

static rg_status follow(track *t, const rg_picture *p, rg_camera *camera, rg_diag *why)
{
    const rg_mesh *m = &t->stage->motion->mesh;
    const int32_t reach = (int32_t)fmin(MOST_REACH, REACH * t->frames);
    const rg_vec2 target = {p->target[0], p->target[1]};
    const int32_t facet = p->targeted ? facet_with(m, target) : -1;
    if (p->targeted && facet < 0)
        return rg_fail(RG_EARG, why, 0, "the camera's target (%g, %g) is not on the sheet", target.x, target.y);
    rg_status s = RG_OK;
    for (int32_t k = 0; s == RG_OK && k < t->frames; k++) {
        double eye[3];
        if ((s = pose(t, k)) != RG_OK) break;
        middle_of(t, eye);
        if (facet >= 0) {
            const rg_vec3 at = place_of(t, facet, target);
            eye[0] = rg_vec3_dot(t->camera.right, at), eye[1] = rg_vec3_dot(t->camera.up, at);
        }
        for (int i = 0; i < 2; i++) t->at[i][k] = eye[i];
    }
    if (s == RG_OK) smooth(t, t->at[0], reach), smooth(t, t->at[1], reach);
    for (int32_t k = 0; s == RG_OK && k < t->frames; k++) {
        if ((s = pose(t, k)) != RG_OK) break;
        const extent e = extent_of(t, t->at[0][k], t->at[1][k]);
        t->at[2][k] = fmax(fmax(e.right, e.left), fmax(e.top, e.bottom));
        t->at[3][k] = -e.ground;
        camera[k] = t->camera;
        camera[k].near = e.front, camera[k].far = e.back;
    }
    if (s != RG_OK) return rg_fail(s, why, 0, "%s", rg_status_text(s));
    smooth_above(t, t->at[2], reach);
    smooth_above(t, t->at[3], reach);
    const double room = DEPTH_ROOM * m->size;
    for (int32_t k = 0; k < t->frames; k++) {
        rg_camera *c = &camera[k];
        const double away = t->at[2][k];
        c->near = away - c->near - room, c->far = away - c->far + room;
        if (!(c->near > 0) || !isfinite(c->far))
            return rg_fail(RG_EARG, why, 0, "there is nothing to take a picture of");
        c->eye = rg_vec3_axpy(t->at[0][k], c->right, rg_vec3_axpy(t->at[1][k], c->up, rg_vec3_scale(away, c->back)));
        c->ground = -t->at[3][k] - FLOOR * m->size;
    }
    return RG_OK;
}

static void aim(rg_camera *c, double azimuth, double elevation, double roll)
{
    const double ca = cos(azimuth), sa = sin(azimuth), ce = cos(elevation), se = sin(elevation);
    c->back = (rg_vec3){ce * ca, ce * sa, se};
    c->right = (rg_vec3){-sa, ca, 0};
    c->up = rg_vec3_cross(c->back, c->right);
    const rg_vec3 right = c->right;
    c->right = rg_vec3_axpy(cos(roll), right, rg_vec3_scale(sin(roll), c->up));
    c->up = rg_vec3_axpy(cos(roll), c->up, rg_vec3_scale(-sin(roll), right));
}

rg_status rg_camera_follow(const rg_stage *stage, const rg_picture *p, rg_camera *camera, rg_diag *why)
{
    rg_status s = rg_picture_check(p, why);
    if (s != RG_OK) return s;
    const rg_memory *mem = &stage->mem;
    const size_t frames = (size_t)stage->motion->report.frame_count;
    track t = {.stage = stage, .frames = (int32_t)frames};
    const int32_t below = p->caption ? rg_caption_height(p->width, p->height) : 0;
    t.camera.half_width = 0.5 * p->width,
    t.camera.half_height = 0.5 * (p->height > 2 * below ? p->height - below : p->height);
    const double scale = LENS * fmin(t.camera.half_width, t.camera.half_height);
    aim(&t.camera, stage->azimuth, stage->elevation, stage->roll);
    t.camera.scale = p->zoom * scale;
    t.wide = (1 - 2 * MARGIN) * t.camera.half_width / scale, t.high = (1 - 2 * MARGIN) * t.camera.half_height / scale;
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(t.x, (size_t)stage->motion->mesh.nv), RG_ARRAY(t.at[0], frames),
                      RG_ARRAY(t.at[1], frames), RG_ARRAY(t.at[2], frames), RG_ARRAY(t.at[3], frames),
                      RG_ARRAY(t.work, frames));
    s = s == RG_OK ? follow(&t, p, camera, why) : rg_fail(s, why, 0, "out of memory for the camera");
    RG_MEM_FREE(mem, t.x, t.at[0], t.at[1], t.at[2], t.at[3], t.work);
    return s;
}

rg_vec3 rg_camera_project(const rg_camera *c, rg_vec3 x)
{
    const rg_vec3 d = rg_vec3_sub(x, c->eye);
    const double away = -rg_vec3_dot(c->back, d);
    const double u = rg_vec3_dot(c->right, d) / away, v = rg_vec3_dot(c->up, d) / away;
    /* 1 / away is what is linear on the screen. */
    const double depth = (1 / c->near - 1 / away) / (1 / c->near - 1 / c->far);
    return (rg_vec3){c->half_width + c->scale * u, c->half_height - c->scale * v, depth};
}
