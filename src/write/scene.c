#include "write/scene.h"
#include "base/bytes.h"
#include "write/png.h"

#include <string.h>

int rg_scene_kind(const rg_mesh *mesh, int32_t crease)
{
    const char a = mesh->assignment[mesh->crease_edge[crease]];
    return a == RG_MOUNTAIN ? RG_MOUNTAINS : a == RG_VALLEY ? RG_VALLEYS : RG_OTHERS;
}

int32_t rg_scene_corners(const rg_mesh *mesh, int32_t f) { return mesh->facet_start[f + 1] - mesh->facet_start[f]; }

static unsigned char *vector(unsigned char *to, double x, double y, double z)
{
    return rg_bytes_f32(rg_bytes_f32(rg_bytes_f32(to, x), y), z);
}

static void lay_out(rg_scene *g)
{
    const size_t nf = (size_t)g->mesh->nf, nv = (size_t)g->mesh->nv, nt = (size_t)g->t.start[nf],
                 frames = (size_t)g->frames;
    const size_t size_of_facets[RG_PARTS] = {12 * (size_t)g->mesh->facet_start[nf],
                                          24 * (size_t)g->most,
                                          24 * nt,
                                          8 * (size_t)g->creases,
                                          4 * frames,
                                          16 * nf * frames,
                                          12 * nf * frames,
                                          g->image ? 8 * (size_t)g->mesh->facet_start[nf] : 0,
                                          (g->image_bytes + 3) / 4 * 4};
    const size_t size_of_morphs[RG_PARTS] = {12 * nv,
                                          0,
                                          24 * nt,
                                          8 * (size_t)g->creases,
                                          4 * frames,
                                          12 * nv * (frames - 1),
                                          4 * (frames - 1) * frames,
                                          g->image ? 8 * nv : 0,
                                          (g->image_bytes + 3) / 4 * 4};
    for (int k = 0; k < RG_PARTS; k++)
        g->start[k + 1] = g->start[k] + (g->morphs ? size_of_morphs[k] : size_of_facets[k]);
}

static void centres(rg_scene *g)
{
    const rg_mesh *mesh = g->mesh;
    for (int32_t f = 0; f < mesh->nf; f++) {
        rg_vec2 sum = {0, 0};
        for (int32_t j = mesh->facet_start[f]; j < mesh->facet_start[f + 1]; j++) {
            sum.x += mesh->X[mesh->facet_vertex[j]].x;
            sum.y += mesh->X[mesh->facet_vertex[j]].y;
        }
        g->centre[f] = (rg_vec2){sum.x / rg_scene_corners(mesh, f), sum.y / rg_scene_corners(mesh, f)};
    }
}

/* Corners of each facet about its centre, and the two normals, as often as a facet may need them. */
static void facet_meshes(rg_scene *g)
{
    const rg_mesh *mesh = g->mesh;
    unsigned char *to = g->bytes + g->start[RG_PART_POSITIONS];
    for (int32_t f = 0; f < mesh->nf; f++)
        for (int32_t j = mesh->facet_start[f]; j < mesh->facet_start[f + 1]; j++) {
            const rg_vec2 x = rg_vec2_sub(mesh->X[mesh->facet_vertex[j]], g->centre[f]);
            to = vector(to, x.x, x.y, 0);
        }
    to = g->bytes + g->start[RG_PART_NORMALS];
    for (int side = RG_FRONT; side <= RG_BACK; side++)
        for (int32_t i = 0; i < g->most; i++) to = vector(to, 0, 0, side == RG_FRONT ? 1 : -1);
}

/* The place of a vertex among the corners of its facet. */
static uint32_t corner_of(const rg_mesh *mesh, int32_t f, int32_t v)
{
    const int32_t *corner = mesh->facet_vertex + mesh->facet_start[f];
    uint32_t i = 0;
    while (corner[i] != v) i++;
    return i;
}

/* Triangles that face the front, then the same ones turned over: facet by facet, or for the whole sheet. */
static void triangles(rg_scene *g)
{
    unsigned char *to = g->bytes + g->start[RG_PART_TRIANGLES];
    const int32_t parts = g->morphs ? 1 : g->mesh->nf;
    for (int32_t f = 0; f < parts; f++) {
        const int32_t end = g->t.start[g->morphs ? g->mesh->nf : f + 1];
        for (int side = RG_FRONT; side <= RG_BACK; side++)
            for (int32_t i = g->t.start[f]; i < end; i++)
                for (int k = 0; k < 3; k++) {
                    const int32_t v = g->t.v[i][side == RG_FRONT ? k : 2 - k];
                    to = rg_bytes_u32(to, g->morphs ? (uint32_t)v : corner_of(g->mesh, f, v));
                }
    }
}

/* The two ends of each crease: corners of the facet on its first side, which it goes with; or vertices of the sheet,
 * kind by kind. */
static void crease_ends(rg_scene *g)
{
    const rg_mesh *mesh = g->mesh;
    unsigned char *to = g->bytes + g->start[RG_PART_CREASES];
    for (int kind = 0; kind < (g->morphs ? RG_LINE_KINDS : 1); kind++) {
        for (int32_t i = 0; i < g->creases; i++) {
            const int32_t e = mesh->crease_edge[i];
            if (g->morphs && rg_scene_kind(mesh, i) != kind) continue;
            for (int end = 0; end < 2; end++) {
                const int32_t v = mesh->edge[e][end];
                to = rg_bytes_u32(to, g->morphs ? (uint32_t)v : corner_of(mesh, mesh->edge_facet[e][0], v));
            }
            g->of_kind[kind + 1]++;
        }
        if (kind + 2 <= RG_LINE_KINDS) g->of_kind[kind + 2] = g->of_kind[kind + 1];
    }
}

static rg_status turns_and_shifts(rg_scene *g)
{
    const rg_mesh *mesh = g->mesh;
    const rg_vec3 middle = rg_motion_middle(g->m);
    for (int32_t f = 0; f < mesh->nf; f++) g->last_turn[f] = (rg_turn){0, 0, 0, 1};
    for (int32_t k = 0; k < g->frames; k++) {
        if (rg_picture_ended(g->p, (double)k / g->frames)) return RG_ECANCELLED;
        rg_pose_facets(mesh, mesh->X, &g->m->tree, rg_motion_angles(g->m, k), g->place);
        for (int32_t f = 0; f < mesh->nf; f++) {
            const size_t at = (size_t)f * (size_t)g->frames + (size_t)k;
            const rg_vec3 centre = {g->centre[f].x, g->centre[f].y, 0};
            const rg_turn q = rg_turn_from_matrix(&g->place[f].R, g->last_turn[f]);
            const rg_vec3 shift =
                rg_vec3_sub(rg_vec3_add(rg_mat3_mul_vec(g->place[f].R, centre), g->place[f].t), middle);
            rg_bytes_f32(vector(g->bytes + g->start[RG_PART_TURNS] + 16 * at, q.x, q.y, q.z), q.w);
            vector(g->bytes + g->start[RG_PART_SHIFTS] + 12 * at, shift.x, shift.y, shift.z);
            g->last_turn[f] = q;
            g->last_shift[f] = shift;
        }
    }
    return RG_OK;
}

/* The mesh is the last frame, for viewers without morphs; displacements are from there as it was rounded, so that
 * roundings don't add up. Weight k is 1 in frame k. */
static rg_status displacements(rg_scene *g)
{
    rg_status s = rg_motion_place_centred(g->m, g->frames - 1, g->last);
    unsigned char *mesh = g->bytes + g->start[RG_PART_POSITIONS], *to = g->bytes + g->start[RG_PART_DISPLACEMENTS];
    unsigned char *weight = g->bytes + g->start[RG_PART_WEIGHTS];
    for (int32_t v = 0; v < g->mesh->nv; v++) mesh = vector(mesh, g->last[v].x, g->last[v].y, g->last[v].z);
    for (int32_t k = 0; s == RG_OK && k < g->frames - 1; k++) {
        s = rg_picture_ended(g->p, (double)k / g->frames) ? RG_ECANCELLED : rg_motion_place_centred(g->m, k, g->x);
        for (int32_t v = 0; v < g->mesh->nv; v++)
            to = vector(to, g->x[v].x - (float)g->last[v].x, g->x[v].y - (float)g->last[v].y,
                        g->x[v].z - (float)g->last[v].z);
    }
    for (int32_t k = 0; k < g->frames; k++)
        for (int32_t i = 0; i < g->frames - 1; i++) weight = rg_bytes_f32(weight, i == k);
    return s;
}

/* The pattern's box is stretched over the picture, whose first row is its upper one. */
static void places(rg_scene *g)
{
    const rg_mesh *mesh = g->mesh;
    unsigned char *to = g->bytes + g->start[RG_PART_PRINT];
    rg_vec2 low = mesh->X[0], high = mesh->X[0];
    for (int32_t v = 1; v < mesh->nv; v++) {
        low = (rg_vec2){fmin(low.x, mesh->X[v].x), fmin(low.y, mesh->X[v].y)};
        high = (rg_vec2){fmax(high.x, mesh->X[v].x), fmax(high.y, mesh->X[v].y)};
    }
    for (int32_t i = 0; i < (g->morphs ? mesh->nv : mesh->facet_start[mesh->nf]); i++) {
        const rg_vec2 x = mesh->X[g->morphs ? i : mesh->facet_vertex[i]];
        to = rg_bytes_f32(rg_bytes_f32(to, (x.x - low.x) / (high.x - low.x)), (high.y - x.y) / (high.y - low.y));
    }
    memcpy(g->bytes + g->start[RG_PART_IMAGE], g->image, g->image_bytes);
}

static rg_status fill(rg_scene *g)
{
    unsigned char *time = g->bytes + g->start[RG_PART_TIMES];
    for (int32_t k = 0; k < g->frames; k++) time = rg_bytes_f32(time, k / g->p->fps);
    triangles(g);
    crease_ends(g);
    if (g->image) places(g);
    if (g->morphs) return displacements(g);
    centres(g);
    facet_meshes(g);
    return turns_and_shifts(g);
}

void rg_scene_free(rg_scene *g)
{
    const rg_memory *mem = &g->m->mem;
    RG_MEM_FREE(mem, g->bytes, g->centre, g->place, g->x, g->last, g->last_turn, g->last_shift, g->normals_of,
                g->image);
    rg_triangles_free(&g->t);
}

rg_status rg_scene_init(rg_scene *g, const rg_motion *m, const rg_picture *p)
{
    const rg_memory *mem = &m->mem;
    const size_t nf = (size_t)m->mesh.nf, nv = (size_t)m->mesh.nv;
    *g = (rg_scene){.m = m, .mesh = &m->mesh, .p = p, .frames = m->report.frame_count};
    g->creases = p->lines == RG_LINES_NONE ? 0 : m->mesh.N;
    g->morphs = m->space != NULL;
    for (int32_t k = 1; k < g->frames; k++)
        g->morphs |= memcmp(rg_motion_pattern(m, k), m->mesh.X, nv * sizeof *m->mesh.X) != 0;
    for (int32_t f = 0; f < m->mesh.nf; f++)
        g->most = rg_scene_corners(g->mesh, f) > g->most ? rg_scene_corners(g->mesh, f) : g->most;
    rg_status s = rg_triangles_init(mem, &m->mesh, &g->t);
    if (s == RG_OK && p->image) s = rg_png_load(mem, p->image, &g->image, &g->image_bytes, NULL);
    if (s != RG_OK) return s;
    lay_out(g);
    if (g->start[RG_PARTS] > UINT32_MAX / 2) return RG_EWRITE; /* the format counts no further */
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(g->bytes, g->start[RG_PARTS]), RG_ARRAY(g->centre, nf), RG_ARRAY(g->place, nf),
                      RG_ARRAY(g->x, nv), RG_ARRAY(g->last, nv), RG_ARRAY(g->last_turn, nf),
                      RG_ARRAY(g->last_shift, nf), RG_ARRAY(g->normals_of, (size_t)g->most + 1));
    return s == RG_OK ? fill(g) : s;
}
