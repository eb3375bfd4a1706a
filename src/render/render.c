#include "render/render.h"
#include "base/status.h"
#include "render/gl.h"
#include "render/samples.h"

#include <float.h>
#include <string.h>

enum { FINE = RG_SAMPLES_FINE };
/* A picture is drawn in tiles of at most so many pixels a side: their samples stay in the cache, 1.3 MB of marks and as
 * much of depths, and are whole blocks of 64 as the software that mostly draws them has it. */
enum { TILE = 192 };
/* Lines, in parts of the picture's shorter side: on a 720 pixel picture each facet shows 1.1 pixel of its crease. */
#define LINE_WIDTH (1.1 / 720)
/* No line is wider than that part of the mean edge: dense patterns keep more paper than ink. */
#define LINE_SHARE 0.035
/* Below half a sample lines fall apart into dots. */
#define LINE_LEAST (0.5 / FINE)

typedef struct box { /* in samples */
    float left, top, right, bottom;
} box;

struct rg_render {
    rg_memory mem;
    const rg_mesh *mesh;
    const rg_triangles *triangles;
    rg_picture picture;
    rg_gl *gl;
    int32_t tile_width, tile_height; /* pixels */
    double mean_edge;                /* length */
    uint32_t *triangle;              /* [3 triangles] corners of facets, as in mesh->facet_vertex, facet by facet */
    uint32_t *chosen;                /* [3 triangles] those of a tile */
    rg_gl_vertex *corner;            /* [mesh->facet_start[nf]] as seen; a facet's mark is 1 + its number */
    box *seen;                       /* [nf] */
    uint64_t *paper;                 /* [1 + nf] colour by mark */
    uint64_t ink[RG_SAMPLES_INKS];   /* colour by ink */
};

enum { NO_INK, RIM, MOUNTAIN, VALLEY, UNASSIGNED, INKS };
static const unsigned char INK[INKS][3] = {
    [RIM] = {62, 52, 48}, [MOUNTAIN] = {196, 30, 44}, [VALLEY] = {30, 74, 180}, [UNASSIGNED] = {120, 112, 108}};

/* What an edge's line is drawn with. Creases without a wish of their own show by their light alone. */
static uint32_t ink_of(char assignment)
{
    switch (assignment) {
    case 'M': return MOUNTAIN;
    case 'V': return VALLEY;
    case 'U': return UNASSIGNED;
    case 'F': return NO_INK;
    default: return RIM;
    }
}

/* Triangles by their facets' corners, which are the same in every frame. corner_of: [nv] */
static void plan(rg_render *r, uint32_t *corner_of)
{
    const rg_mesh *m = r->mesh;
    const rg_triangles *t = r->triangles;
    for (int32_t f = 0; f < m->nf; f++) {
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            corner_of[m->facet_vertex[j]] = (uint32_t)j;
            r->corner[j].mark = 1 + (uint32_t)f;
        }
        for (int32_t i = t->start[f]; i < t->start[f + 1]; i++)
            for (int k = 0; k < 3; k++) r->triangle[3 * (size_t)i + (size_t)k] = corner_of[t->v[i][k]];
    }
    double sum = 0;
    for (int32_t e = 0; e < m->ne; e++)
        sum += rg_vec2_length(rg_vec2_sub(m->X[m->edge[e][0]], m->X[m->edge[e][1]]));
    r->mean_edge = sum / m->ne;
    r->paper[0] = rg_samples_colour(r->picture.background);
    for (int i = 0; i < INKS; i++) r->ink[i] = rg_samples_colour(INK[i]);
}

static rg_status allocate(rg_render *r)
{
    const rg_mesh *m = r->mesh;
    const size_t corners = 3 * (size_t)r->triangles->start[m->nf];
    if (corners > INT32_MAX || m->nf >= 1 << RG_SAMPLES_MARK_BITS) return RG_ENOMEM;
    r->triangle = rg_mem_array(&r->mem, corners, sizeof *r->triangle);
    r->chosen = rg_mem_array(&r->mem, corners, sizeof *r->chosen);
    r->corner = rg_mem_array(&r->mem, (size_t)m->facet_start[m->nf], sizeof *r->corner);
    r->seen = rg_mem_array(&r->mem, (size_t)m->nf, sizeof *r->seen);
    r->paper = rg_mem_array(&r->mem, (size_t)m->nf + 1, sizeof *r->paper);
    uint32_t *corner_of = rg_mem_array(&r->mem, (size_t)m->nv, sizeof *corner_of);
    const int all = r->triangle && r->chosen && r->corner && r->seen && r->paper && corner_of;
    if (all) plan(r, corner_of);
    rg_mem_free(&r->mem, corner_of);
    return all ? RG_OK : RG_ENOMEM;
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
    s = allocate(r);
    if (s != RG_OK) rg_fail(s, why, 0, "out of memory for the picture");
    else s = rg_gl_create(&mem, FINE * r->tile_width, FINE * r->tile_height, &r->gl, why);
    if (s != RG_OK) {
        rg_render_destroy(r);
        return s;
    }
    int32_t w, h;
    rg_gl_size(r->gl, &w, &h);
    if (w / FINE < r->tile_width) r->tile_width = w / FINE;
    if (h / FINE < r->tile_height) r->tile_height = h / FINE;
    *render = r;
    return RG_OK;
}

void rg_render_destroy(rg_render *r)
{
    if (!r) return;
    rg_gl_destroy(r->gl);
    void *block[] = {r->triangle, r->chosen, r->corner, r->seen, r->paper, r};
    for (int i = 0; i < 6; i++) rg_mem_free(&r->mem, block[i]);
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

/* The colour of the side one sees. */
static uint64_t colour_of(const rg_render *r, int32_t f, const rg_vec3 *x, rg_vec3 lift, const rg_camera *c)
{
    const rg_mesh *m = r->mesh;
    rg_vec3 n = normal_of(m, f, x);
    const rg_vec3 at = rg_vec3_add(x[m->facet_vertex[m->facet_start[f]]], lift);
    const int front = rg_vec3_dot(n, rg_vec3_sub(c->eye, at)) >= 0;
    if (!front) n = rg_vec3_scale(-1, n);
    const double level = light(c, n), bright[3] = {pow(level, 0.80), pow(level, 0.92), level}; /* warm shadows */
    const unsigned char *paper = front ? r->picture.front : r->picture.back;
    unsigned char rgb[3];
    for (int i = 0; i < 3; i++) rgb[i] = (unsigned char)(bright[i] * paper[i] + 0.5);
    return rg_samples_colour(rgb);
}

static box both(box a, box b)
{
    return (box){fminf(a.left, b.left), fminf(a.top, b.top), fmaxf(a.right, b.right), fmaxf(a.bottom, b.bottom)};
}

/* Where facets are seen and in which colour; the box around them all. */
static box look(rg_render *r, const rg_vec3 *x, const rg_vec3 *lift, const rg_camera *c)
{
    static const box nothing = {FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX};
    const rg_mesh *m = r->mesh;
    box all = nothing;
    for (int32_t f = 0; f < m->nf; f++) {
        const rg_vec3 up = lift ? lift[f] : (rg_vec3){0, 0, 0};
        r->seen[f] = nothing;
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const rg_vec3 p = rg_camera_project(c, rg_vec3_add(x[m->facet_vertex[j]], up));
            rg_gl_vertex *v = &r->corner[j];
            v->x = (float)(FINE * p.x), v->y = (float)(FINE * p.y), v->z = (float)p.z;
            r->seen[f] = both(r->seen[f], (box){v->x, v->y, v->x, v->y});
        }
        all = both(all, r->seen[f]);
        r->paper[f + 1] = colour_of(r, f, x, up, c);
    }
    return all;
}

static int meet(box a, box b)
{
    return a.left <= b.right && a.right >= b.left && a.top <= b.bottom && a.bottom >= b.top;
}

/* The lines of facets in a tile, each on its own facet only. */
static void draw_lines(const rg_render *r, const rg_samples *tile, box here, float half)
{
    const rg_mesh *m = r->mesh;
    for (int32_t f = 0; f < m->nf; f++) {
        if (!meet(r->seen[f], here)) continue;
        const int32_t first = m->facet_start[f], last = m->facet_start[f + 1];
        for (int rim = 1; rim >= 0; rim--) /* the rim below the creases that end on it */
            for (int32_t j = first; j < last; j++) {
                const uint32_t ink = ink_of(m->assignment[m->facet_edge[j]]);
                if (ink == NO_INK || (ink == RIM) != rim) continue;
                const rg_gl_vertex *a = &r->corner[j], *b = &r->corner[j + 1 < last ? j + 1 : first];
                const rg_samples_line line = {{a->x, b->x}, {a->y, b->y}, half, a->mark, ink};
                rg_samples_draw(tile, &line);
            }
    }
}

typedef struct area { /* pixels */
    int32_t x, y, width, height;
} area;

static rg_status draw_tile(rg_render *r, area a, float half, unsigned char *rgb, rg_diag *why)
{
    const rg_triangles *t = r->triangles;
    const box here = {(float)(FINE * a.x), (float)(FINE * a.y), (float)(FINE * (a.x + a.width)),
                      (float)(FINE * (a.y + a.height))};
    size_t corners = 0;
    for (int32_t f = 0; f < r->mesh->nf; f++) {
        if (!meet(r->seen[f], here)) continue;
        const size_t n = 3 * (size_t)(t->start[f + 1] - t->start[f]);
        memcpy(r->chosen + corners, r->triangle + 3 * (size_t)t->start[f], n * sizeof *r->chosen);
        corners += n;
    }
    if (corners == 0) return RG_OK;
    const rg_gl_scene scene = {r->corner, r->chosen, (int32_t)corners};
    rg_samples tile = {NULL, 0, FINE * a.width, FINE * a.height, FINE * a.x, FINE * a.y};
    const rg_status s = rg_gl_draw(r->gl, &scene, tile.x, tile.y, tile.width, tile.height, &tile.at, &tile.pitch, why);
    if (s != RG_OK) return s;
    if (r->picture.creases) draw_lines(r, &tile, here, half);
    const size_t stride = 3 * (size_t)r->picture.width;
    rg_samples_mean(&tile, r->paper, r->ink, rgb + (size_t)a.y * stride + 3 * (size_t)a.x, stride);
    return RG_OK;
}

static float half_width(const rg_render *r, const rg_camera *c)
{
    const rg_picture *p = &r->picture;
    const int32_t shorter = p->width < p->height ? p->width : p->height;
    const double pixels = c->scale / (0.5 * (c->near + c->far)); /* a unit of length, about */
    const double width = fmin(LINE_WIDTH * shorter, LINE_SHARE * r->mean_edge * pixels);
    return (float)(FINE * (width >= LINE_LEAST ? width : LINE_LEAST));
}

/* From 0 to `most`, also for what is no number. */
static int32_t within(double x, int32_t most) { return x > 0 ? x < most ? (int32_t)x : most : 0; }

static void fill(const rg_picture *p, unsigned char *rgb)
{
    const size_t stride = 3 * (size_t)p->width;
    for (int32_t x = 0; x < p->width; x++) memcpy(rgb + 3 * (size_t)x, p->background, 3);
    for (int32_t y = 1; y < p->height; y++) memcpy(rgb + (size_t)y * stride, rgb, stride);
}

rg_status rg_render_frame(rg_render *r, const rg_vec3 *x, const rg_vec3 *lift, const rg_camera *camera,
                          unsigned char *rgb, rg_diag *why)
{
    const rg_picture *p = &r->picture;
    const float half = half_width(r, camera);
    const box all = look(r, x, lift, camera);
    const int32_t left = within(floor(all.left / FINE), p->width), right = within(ceil(all.right / FINE), p->width);
    const int32_t top = within(floor(all.top / FINE), p->height), bottom = within(ceil(all.bottom / FINE), p->height);
    rg_status s = RG_OK;
    fill(p, rgb);
    for (area a = {.y = top}; s == RG_OK && a.y < bottom; a.y += r->tile_height)
        for (a.x = left; s == RG_OK && a.x < right; a.x += r->tile_width) {
            a.width = right - a.x < r->tile_width ? right - a.x : r->tile_width;
            a.height = bottom - a.y < r->tile_height ? bottom - a.y : r->tile_height;
            s = draw_tile(r, a, half, rgb, why);
        }
    return s;
}
