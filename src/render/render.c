#include "render/render.h"
#include "base/status.h"
#include "render/gl.h"

/* Every pixel is the mean of FINE x FINE samples. */
enum { FINE = 3 };
/* A picture is drawn in tiles of at most so many pixels a side: 38 MB of samples. */
enum { TILE = 1024 };
/* Lines, in parts of the picture's shorter side: on a 720 pixel picture each facet shows 1.1 pixel of its crease. */
#define LINE_WIDTH (1.1 / 720)
/* No line is wider than that part of the mean edge: dense patterns keep more paper than ink. */
#define LINE_SHARE 0.035
/* Below half a sample lines fall apart into dots. */
#define LINE_LEAST (0.5 / FINE)

struct rg_render {
    rg_memory mem;
    const rg_mesh *mesh;
    const rg_triangles *triangles;
    rg_picture picture;
    rg_gl *gl;
    int32_t tile_width, tile_height; /* pixels */
    double mean_edge;                /* length */
    rg_gl_vertex *vertex;            /* [start[2 nf]] */
    int32_t *start;                  /* [2 nf + 1] */
};

static const unsigned char MOUNTAIN[3] = {196, 30, 44}, VALLEY[3] = {30, 74, 180}, UNASSIGNED[3] = {120, 112, 108},
                           RIM[3] = {62, 52, 48};

/* The colour of an edge's line, NULL: none. Creases without a wish of their own show by their light alone. */
static const unsigned char *ink(char assignment)
{
    switch (assignment) {
    case 'M': return MOUNTAIN;
    case 'V': return VALLEY;
    case 'U': return UNASSIGNED;
    case 'F': return NULL;
    default: return RIM;
    }
}

/* Where each facet's triangles and lines go; they are the same in every frame. */
static void plan(rg_render *r)
{
    const rg_mesh *m = r->mesh;
    int32_t at = 0;
    for (int32_t f = 0; f < m->nf; f++) {
        r->start[2 * (size_t)f] = at;
        at += 3 * (r->triangles->start[f + 1] - r->triangles->start[f]);
        r->start[2 * (size_t)f + 1] = at;
        for (int32_t j = m->facet_start[f]; r->picture.creases && j < m->facet_start[f + 1]; j++)
            if (ink(m->assignment[m->facet_edge[j]])) at += 6;
    }
    r->start[2 * (size_t)m->nf] = at;
    double sum = 0;
    for (int32_t e = 0; e < m->ne; e++)
        sum += rg_vec2_length(rg_vec2_sub(m->X[m->edge[e][0]], m->X[m->edge[e][1]]));
    r->mean_edge = sum / m->ne;
}

rg_status rg_render_create(const rg_memory *memory, const rg_mesh *m, const rg_triangles *t, const rg_picture *p,
                           rg_render **render, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(memory);
    rg_status s = rg_gl_check(why);
    if (s == RG_OK) s = rg_camera_check(p, why);
    if (s != RG_OK) return s;
    rg_render *r = rg_mem_array(&mem, 1, sizeof *r);
    if (!r) return rg_fail(RG_ENOMEM, why, 0, "out of memory for the picture");
    *r = (rg_render){.mem = mem, .mesh = m, .triangles = t, .picture = *p};
    r->tile_width = p->width < TILE ? p->width : TILE;
    r->tile_height = p->height < TILE ? p->height : TILE;
    const int64_t vertices = 3 * (int64_t)t->start[m->nf] + 6 * (int64_t)m->facet_start[m->nf];
    r->start = rg_mem_array(&mem, 2 * (size_t)m->nf + 1, sizeof *r->start);
    r->vertex = vertices > INT32_MAX ? NULL : rg_mem_array(&mem, (size_t)vertices, sizeof *r->vertex);
    if (!r->start || !r->vertex) s = rg_fail(RG_ENOMEM, why, 0, "out of memory for the picture");
    if (s == RG_OK) s = rg_gl_create(&mem, FINE * r->tile_width, FINE * r->tile_height, &r->gl, why);
    if (s != RG_OK) {
        rg_render_destroy(r);
        return s;
    }
    int32_t w, h;
    rg_gl_size(r->gl, &w, &h);
    if (w / FINE < r->tile_width) r->tile_width = w / FINE;
    if (h / FINE < r->tile_height) r->tile_height = h / FINE;
    plan(r);
    *render = r;
    return RG_OK;
}

void rg_render_destroy(rg_render *r)
{
    if (!r) return;
    rg_gl_destroy(r->gl);
    rg_mem_free(&r->mem, r->vertex);
    rg_mem_free(&r->mem, r->start);
    rg_mem_free(&r->mem, r);
}

/* Newell's normal: right for any facet, also where corners lie in a line. */
static rg_vec3 normal_of(const rg_mesh *m, int32_t f, const rg_vec3 *x)
{
    const int32_t first = m->facet_start[f], last = m->facet_start[f + 1];
    const rg_vec3 base = x[m->facet_vertex[first]];
    rg_vec3 n = {0, 0, 0};
    for (int32_t j = first + 1; j + 1 < last; j++)
        n = rg_vec3_add(n, rg_vec3_cross(rg_vec3_sub(x[m->facet_vertex[j]], base),
                                         rg_vec3_sub(x[m->facet_vertex[j + 1]], base)));
    const double length = rg_vec3_length(n);
    return length > 0 ? rg_vec3_scale(1 / length, n) : (rg_vec3){0, 0, 1};
}

/* A lamp from the upper left, a weaker one from the right, and enough light all around that nothing is black. n: towards
 * the viewer. The lamps go with the camera, so that every azimuth looks alike. */
static double light(const rg_camera *c, rg_vec3 n)
{
    static const double around = 0.60, key = 0.38, fill = 0.16;
    const double r = rg_vec3_dot(n, c->right), u = rg_vec3_dot(n, c->up), b = rg_vec3_dot(n, c->back);
    const double from_key = -0.53 * r + 0.66 * u + 0.53 * b, from_fill = 0.80 * r - 0.20 * u + 0.57 * b;
    const double sum = around + key * fmax(0, from_key) + fill * fmax(0, from_fill);
    return fmin(1, sum);
}

static rg_gl_vertex sample(const rg_camera *c, rg_vec3 x)
{
    const rg_vec3 p = rg_camera_project(c, x);
    return (rg_gl_vertex){(float)(FINE * p.x), (float)(FINE * p.y), (float)p.z, {0, 0, 0, 255}};
}

static void paint(rg_gl_vertex *v, const unsigned char rgb[3], const double bright[3])
{
    for (int i = 0; i < 3; i++) v->rgba[i] = (unsigned char)(bright[i] * rgb[i] + 0.5);
}

/* A line as two triangles, a little longer than its edge so that corners are filled. */
static rg_gl_vertex *draw_line(rg_gl_vertex *v, rg_gl_vertex a, rg_gl_vertex b, float half, const unsigned char rgb[3])
{
    const float dx = b.x - a.x, dy = b.y - a.y, length = hypotf(dx, dy);
    const float ex = length > 0 ? half * dx / length : half, ey = length > 0 ? half * dy / length : 0;
    const float end = 0.5f;
    static const double full[3] = {1, 1, 1};
    paint(&a, rgb, full);
    a.z = b.z = 0;
    rg_gl_vertex corner[4] = {a, a, a, a};
    for (int i = 0; i < 4; i++) {
        const float side = i & 1 ? 1.0f : -1.0f;
        corner[i].x = (i < 2 ? a.x - end * ex : b.x + end * ex) - side * ey;
        corner[i].y = (i < 2 ? a.y - end * ey : b.y + end * ey) + side * ex;
    }
    static const int order[6] = {0, 1, 2, 2, 1, 3};
    for (int i = 0; i < 6; i++) *v++ = corner[order[i]];
    return v;
}

/* One facet: its triangles in the colour of the side one sees, then its lines. */
static void draw_facet(rg_render *r, int32_t f, const rg_vec3 *x, rg_vec3 lift, const rg_camera *c, float half)
{
    const rg_mesh *m = r->mesh;
    const rg_triangles *t = r->triangles;
    rg_vec3 n = normal_of(m, f, x);
    const rg_vec3 at = rg_vec3_add(x[m->facet_vertex[m->facet_start[f]]], lift);
    const int front = rg_vec3_dot(n, rg_vec3_sub(c->eye, at)) >= 0;
    if (!front) n = rg_vec3_scale(-1, n);
    const double level = light(c, n), bright[3] = {pow(level, 0.80), pow(level, 0.92), level}; /* warm shadows */
    rg_gl_vertex *v = r->vertex + r->start[2 * (size_t)f];
    for (int32_t i = t->start[f]; i < t->start[f + 1]; i++)
        for (int k = 0; k < 3; k++, v++) {
            *v = sample(c, rg_vec3_add(x[t->v[i][k]], lift));
            paint(v, front ? r->picture.front : r->picture.back, bright);
        }
    if (!r->picture.creases) return;
    const int32_t first = m->facet_start[f], last = m->facet_start[f + 1];
    for (int rim = 1; rim >= 0; rim--) /* the rim below the creases that end on it */
        for (int32_t j = first; j < last; j++) {
            const unsigned char *rgb = ink(m->assignment[m->facet_edge[j]]);
            if (!rgb || (rgb == RIM) != rim) continue;
            const int32_t next = j + 1 < last ? j + 1 : first;
            v = draw_line(v, sample(c, rg_vec3_add(x[m->facet_vertex[j]], lift)),
                          sample(c, rg_vec3_add(x[m->facet_vertex[next]], lift)), half, rgb);
        }
}

/* The mean of FINE x FINE samples for each pixel of a tile. */
static void average(const unsigned char *rgba, int32_t pitch, int32_t width, int32_t height, unsigned char *rgb,
                    size_t stride)
{
    for (int32_t y = 0; y < height; y++, rgb += stride)
        for (int32_t x = 0; x < width; x++)
            for (int k = 0; k < 3; k++) {
                const unsigned char *p = rgba + 4 * ((size_t)FINE * (size_t)y * (size_t)pitch + (size_t)FINE * (size_t)x) + k;
                int sum = FINE * FINE / 2;
                for (int i = 0; i < FINE; i++, p += 4 * (size_t)pitch)
                    for (int j = 0; j < FINE; j++) sum += p[4 * j];
                rgb[3 * (size_t)x + (size_t)k] = (unsigned char)(sum / (FINE * FINE));
            }
}

rg_status rg_render_frame(rg_render *r, const rg_vec3 *x, const rg_vec3 *lift, const rg_camera *camera,
                          unsigned char *rgb, rg_diag *why)
{
    const rg_picture *p = &r->picture;
    const int32_t shorter = p->width < p->height ? p->width : p->height;
    const double pixels = camera->scale / (0.5 * (camera->near + camera->far)); /* a unit of length, about */
    double width = fmin(LINE_WIDTH * shorter, LINE_SHARE * r->mean_edge * pixels);
    if (!(width >= LINE_LEAST)) width = LINE_LEAST;
    for (int32_t f = 0; f < r->mesh->nf; f++)
        draw_facet(r, f, x, lift ? lift[f] : (rg_vec3){0, 0, 0}, camera, (float)(FINE * width));
    const rg_gl_scene scene = {r->vertex, r->start, r->mesh->nf, {p->background[0], p->background[1], p->background[2]}};
    const size_t stride = 3 * (size_t)p->width;
    for (int32_t y = 0; y < p->height; y += r->tile_height)
        for (int32_t at = 0; at < p->width; at += r->tile_width) {
            const int32_t w = p->width - at < r->tile_width ? p->width - at : r->tile_width;
            const int32_t h = p->height - y < r->tile_height ? p->height - y : r->tile_height;
            const unsigned char *rgba;
            int32_t pitch;
            const rg_status s = rg_gl_draw(r->gl, &scene, FINE * at, FINE * y, FINE * w, FINE * h, &rgba, &pitch, why);
            if (s != RG_OK) return s;
            average(rgba, pitch, w, h, rgb + (size_t)y * stride + 3 * (size_t)at, stride);
        }
    return RG_OK;
}
