#include "write/gltf.h"
#include "base/base64.h"
#include "base/bytes.h"
#include "base/json.h"
#include "pose/turn.h"
#include "render/picture.h"
#include "mesh/triangles.h"
#include "write/png.h"

#include <string.h>

enum { FLOAT = 5126, UINT = 5125, VERTICES = 34962, INDICES = 34963 };
enum { FRONT, BACK };
/* Materials of lines come after those of the two sides. */
enum { MOUNTAINS, VALLEYS, OTHERS, KINDS, FIRST_LINES = BACK + 1, LINES_MODE = 1 };
/* As in pictures: creases by kind, or all alike. */
static const unsigned char INK[KINDS][3] = {{200, 44, 44}, {36, 84, 190}, {120, 112, 108}}, EDGE_INK[3] = {84, 72, 66};
static const double ROUGHNESS = 0.9;

/* Parts of the buffer. What moves is turns and shifts of facets, or displacements of vertices and their weights. The
 * last two are there where a picture is printed on the front: where it is on the paper, and its file. */
enum {
    POSITIONS,
    NORMALS,
    TRIANGLES,
    CREASES,
    TIMES,
    TURNS,
    SHIFTS,
    PRINT,
    IMAGE,
    PARTS,
    DISPLACEMENTS = TURNS,
    WEIGHTS = SHIFTS
};

typedef struct model {
    const rg_motion *m;
    const rg_mesh *mesh;
    const rg_picture *p;
    int32_t frames;
    int morphs;
    rg_triangles t;
    unsigned char *bytes;
    size_t start[PARTS + 1]; /* of each part, and the end */
    rg_vec2 *centre;         /* [nf] */
    rg_place *place;         /* [nf] of the frame at work */
    rg_vec3 *x, *last;       /* [nv] of the frame at work, and of the last one */
    rg_turn *last_turn;      /* [nf] */
    rg_vec3 *last_shift;     /* [nf] */
    int32_t *normals_of;     /* [most + 1] accessor of that many normals to the front, to the back: the next; 0: none */
    int32_t most;            /* corners of a facet */
    int32_t accessors;
    unsigned char *image;    /* the picture's file; NULL: none */
    size_t image_bytes;
    int32_t print;           /* accessor of places in the picture: of the first facet, or of all vertices */
    int32_t creases;         /* that are drawn: all or none; the first `of_kind[k]` ... of kind k in the buffer */
    int32_t of_kind[KINDS + 1];
    int32_t lines;           /* accessor of the first crease's ends, or of those of the first kind that is there */
} model;

static int kind_of(const rg_mesh *mesh, int32_t crease)
{
    const char a = mesh->assignment[mesh->crease_edge[crease]];
    return a == RG_MOUNTAIN ? MOUNTAINS : a == RG_VALLEY ? VALLEYS : OTHERS;
}

/* ------------------------------------------------------------------------------------------------ bytes ---- */

static int32_t corners(const rg_mesh *mesh, int32_t f) { return mesh->facet_start[f + 1] - mesh->facet_start[f]; }

static unsigned char *vector(unsigned char *to, double x, double y, double z)
{
    return rg_bytes_f32(rg_bytes_f32(rg_bytes_f32(to, x), y), z);
}

static void lay_out(model *g)
{
    const size_t nf = (size_t)g->mesh->nf, nv = (size_t)g->mesh->nv, nt = (size_t)g->t.start[nf],
                 frames = (size_t)g->frames;
    const size_t size_of_facets[PARTS] = {12 * (size_t)g->mesh->facet_start[nf],
                                          24 * (size_t)g->most,
                                          24 * nt,
                                          8 * (size_t)g->creases,
                                          4 * frames,
                                          16 * nf * frames,
                                          12 * nf * frames,
                                          g->image ? 8 * (size_t)g->mesh->facet_start[nf] : 0,
                                          (g->image_bytes + 3) / 4 * 4};
    const size_t size_of_morphs[PARTS] = {12 * nv,
                                          0,
                                          24 * nt,
                                          8 * (size_t)g->creases,
                                          4 * frames,
                                          12 * nv * (frames - 1),
                                          4 * (frames - 1) * frames,
                                          g->image ? 8 * nv : 0,
                                          (g->image_bytes + 3) / 4 * 4};
    for (int k = 0; k < PARTS; k++)
        g->start[k + 1] = g->start[k] + (g->morphs ? size_of_morphs[k] : size_of_facets[k]);
}

static void centres(model *g)
{
    const rg_mesh *mesh = g->mesh;
    for (int32_t f = 0; f < mesh->nf; f++) {
        rg_vec2 sum = {0, 0};
        for (int32_t j = mesh->facet_start[f]; j < mesh->facet_start[f + 1]; j++) {
            sum.x += mesh->X[mesh->facet_vertex[j]].x;
            sum.y += mesh->X[mesh->facet_vertex[j]].y;
        }
        g->centre[f] = (rg_vec2){sum.x / corners(mesh, f), sum.y / corners(mesh, f)};
    }
}

/* Corners of each facet about its centre, and the two normals, as often as a facet may need them. */
static void facet_meshes(model *g)
{
    const rg_mesh *mesh = g->mesh;
    unsigned char *to = g->bytes + g->start[POSITIONS];
    for (int32_t f = 0; f < mesh->nf; f++)
        for (int32_t j = mesh->facet_start[f]; j < mesh->facet_start[f + 1]; j++) {
            const rg_vec2 x = rg_vec2_sub(mesh->X[mesh->facet_vertex[j]], g->centre[f]);
            to = vector(to, x.x, x.y, 0);
        }
    to = g->bytes + g->start[NORMALS];
    for (int side = FRONT; side <= BACK; side++)
        for (int32_t i = 0; i < g->most; i++) to = vector(to, 0, 0, side == FRONT ? 1 : -1);
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
static void triangles(model *g)
{
    unsigned char *to = g->bytes + g->start[TRIANGLES];
    const int32_t parts = g->morphs ? 1 : g->mesh->nf;
    for (int32_t f = 0; f < parts; f++) {
        const int32_t end = g->t.start[g->morphs ? g->mesh->nf : f + 1];
        for (int side = FRONT; side <= BACK; side++)
            for (int32_t i = g->t.start[f]; i < end; i++)
                for (int k = 0; k < 3; k++) {
                    const int32_t v = g->t.v[i][side == FRONT ? k : 2 - k];
                    to = rg_bytes_u32(to, g->morphs ? (uint32_t)v : corner_of(g->mesh, f, v));
                }
    }
}

/* The two ends of each crease: corners of the facet on its first side, which it goes with; or vertices of the sheet,
 * kind by kind. */
static void crease_ends(model *g)
{
    const rg_mesh *mesh = g->mesh;
    unsigned char *to = g->bytes + g->start[CREASES];
    for (int kind = 0; kind < (g->morphs ? KINDS : 1); kind++) {
        for (int32_t i = 0; i < g->creases; i++) {
            const int32_t e = mesh->crease_edge[i];
            if (g->morphs && kind_of(mesh, i) != kind) continue;
            for (int end = 0; end < 2; end++) {
                const int32_t v = mesh->edge[e][end];
                to = rg_bytes_u32(to, g->morphs ? (uint32_t)v : corner_of(mesh, mesh->edge_facet[e][0], v));
            }
            g->of_kind[kind + 1]++;
        }
        if (kind + 2 <= KINDS) g->of_kind[kind + 2] = g->of_kind[kind + 1];
    }
}

static rg_status turns_and_shifts(model *g)
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
            rg_bytes_f32(vector(g->bytes + g->start[TURNS] + 16 * at, q.x, q.y, q.z), q.w);
            vector(g->bytes + g->start[SHIFTS] + 12 * at, shift.x, shift.y, shift.z);
            g->last_turn[f] = q;
            g->last_shift[f] = shift;
        }
    }
    return RG_OK;
}

/* The mesh is the last frame, for viewers without morphs; displacements are from there as it was rounded, so that
 * roundings don't add up. Weight k is 1 in frame k. */
static rg_status displacements(model *g)
{
    rg_status s = rg_motion_place_centred(g->m, g->frames - 1, g->last);
    unsigned char *mesh = g->bytes + g->start[POSITIONS], *to = g->bytes + g->start[DISPLACEMENTS];
    unsigned char *weight = g->bytes + g->start[WEIGHTS];
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
static void places(model *g)
{
    const rg_mesh *mesh = g->mesh;
    unsigned char *to = g->bytes + g->start[PRINT];
    rg_vec2 low = mesh->X[0], high = mesh->X[0];
    for (int32_t v = 1; v < mesh->nv; v++) {
        low = (rg_vec2){fmin(low.x, mesh->X[v].x), fmin(low.y, mesh->X[v].y)};
        high = (rg_vec2){fmax(high.x, mesh->X[v].x), fmax(high.y, mesh->X[v].y)};
    }
    for (int32_t i = 0; i < (g->morphs ? mesh->nv : mesh->facet_start[mesh->nf]); i++) {
        const rg_vec2 x = mesh->X[g->morphs ? i : mesh->facet_vertex[i]];
        to = rg_bytes_f32(rg_bytes_f32(to, (x.x - low.x) / (high.x - low.x)), (high.y - x.y) / (high.y - low.y));
    }
    memcpy(g->bytes + g->start[IMAGE], g->image, g->image_bytes);
}

static rg_status fill(model *g)
{
    unsigned char *time = g->bytes + g->start[TIMES];
    for (int32_t k = 0; k < g->frames; k++) time = rg_bytes_f32(time, k / g->p->fps);
    triangles(g);
    crease_ends(g);
    if (g->image) places(g);
    if (g->morphs) return displacements(g);
    centres(g);
    facet_meshes(g);
    return turns_and_shifts(g);
}

static void model_free(model *g)
{
    const rg_memory *mem = &g->m->mem;
    void *block[] = {g->bytes,     g->centre,     g->place,      g->x,    g->last,
                     g->last_turn, g->last_shift, g->normals_of, g->image};
    for (size_t i = 0; i < sizeof block / sizeof *block; i++) rg_mem_free(mem, block[i]);
    rg_triangles_free(&g->t);
}

static rg_status model_init(model *g, const rg_motion *m, const rg_picture *p)
{
    const rg_memory *mem = &m->mem;
    const size_t nf = (size_t)m->mesh.nf, nv = (size_t)m->mesh.nv;
    *g = (model){.m = m, .mesh = &m->mesh, .p = p, .frames = m->report.frame_count};
    g->creases = p->lines == RG_LINES_NONE ? 0 : m->mesh.N;
    g->morphs = m->space != NULL;
    for (int32_t k = 1; k < g->frames; k++)
        g->morphs |= memcmp(rg_motion_pattern(m, k), m->mesh.X, nv * sizeof *m->mesh.X) != 0;
    for (int32_t f = 0; f < m->mesh.nf; f++) g->most = corners(g->mesh, f) > g->most ? corners(g->mesh, f) : g->most;
    rg_status s = rg_triangles_init(mem, &m->mesh, &g->t);
    if (s == RG_OK && p->image) s = rg_png_load(mem, p->image, &g->image, &g->image_bytes, NULL);
    if (s != RG_OK) return s;
    lay_out(g);
    if (g->start[PARTS] > UINT32_MAX / 2) return RG_EARG;
    g->bytes = rg_mem_array(mem, g->start[PARTS], 1);
    g->centre = rg_mem_array(mem, nf, sizeof *g->centre);
    g->place = rg_mem_array(mem, nf, sizeof *g->place);
    g->x = rg_mem_array(mem, nv, sizeof *g->x);
    g->last = rg_mem_array(mem, nv, sizeof *g->last);
    g->last_turn = rg_mem_array(mem, nf, sizeof *g->last_turn);
    g->last_shift = rg_mem_array(mem, nf, sizeof *g->last_shift);
    g->normals_of = rg_mem_array(mem, (size_t)g->most + 1, sizeof *g->normals_of);
    if (!g->bytes || !g->centre || !g->place || !g->x || !g->last || !g->last_turn || !g->last_shift || !g->normals_of)
        return RG_ENOMEM;
    return fill(g);
}

/* ------------------------------------------------------------------------------------------------- JSON ---- */

static float float_at(const unsigned char *at)
{
    const uint32_t bits = (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Only parts that are there have a buffer view, in their order. */
static int view_of(const model *g, int part)
{
    int view = 0;
    for (int k = 0; k < part; k++) view += g->start[k + 1] > g->start[k];
    return view;
}

/* n elements of 1 to 4 numbers each; `bounds`: say the least and the largest, as the format asks for in places. */
static void accessor(rg_json *j, model *g, int part, size_t offset, size_t n, int width, int component, int bounds)
{
    static const char *const type[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const unsigned char *at = g->bytes + g->start[part] + offset;
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "bufferView", view_of(g, part));
    rg_json_integer(j, "byteOffset", (int64_t)offset);
    rg_json_integer(j, "componentType", component);
    rg_json_integer(j, "count", (int64_t)n);
    rg_json_string(j, "type", type[width]);
    if (bounds) {
        double low[4], high[4];
        for (int k = 0; k < width; k++) low[k] = high[k] = float_at(at + 4 * k);
        for (size_t i = 1; i < n; i++)
            for (int k = 0; k < width; k++) {
                const double x = float_at(at + 4 * (i * (size_t)width + (size_t)k));
                low[k] = fmin(low[k], x), high[k] = fmax(high[k], x);
            }
        rg_json_numbers(j, "min", low, width);
        rg_json_numbers(j, "max", high, width);
    }
    rg_json_close(j);
    g->accessors++;
}

/* Accessor 0 is the times; then five a facet: corners, front, back, turns, shifts; then normals by number of corners.
 */
static int32_t accessor_of(int32_t f) { return 1 + 5 * f; }

static void facet_accessors(rg_json *j, model *g)
{
    const rg_mesh *mesh = g->mesh;
    const size_t frames = (size_t)g->frames;
    for (int32_t f = 0; f < mesh->nf; f++) {
        const size_t first = (size_t)g->t.start[f], n = (size_t)(g->t.start[f + 1] - g->t.start[f]);
        accessor(j, g, POSITIONS, 12 * (size_t)mesh->facet_start[f], (size_t)corners(mesh, f), 3, FLOAT, 1);
        accessor(j, g, TRIANGLES, 24 * first, 3 * n, 1, UINT, 0);
        accessor(j, g, TRIANGLES, 24 * first + 12 * n, 3 * n, 1, UINT, 0);
        accessor(j, g, TURNS, 16 * (size_t)f * frames, frames, 4, FLOAT, 0);
        accessor(j, g, SHIFTS, 12 * (size_t)f * frames, frames, 3, FLOAT, 0);
        g->normals_of[corners(mesh, f)] = 1;
    }
    for (int32_t n = 0; n <= g->most; n++) {
        if (!g->normals_of[n]) continue;
        g->normals_of[n] = g->accessors;
        accessor(j, g, NORMALS, 0, (size_t)n, 3, FLOAT, 0);
        accessor(j, g, NORMALS, 12 * (size_t)g->most, (size_t)n, 3, FLOAT, 0);
    }
}

/* Accessor 0 is the times; then vertices, front, back, weights; then the displacements frame by frame. */
enum { MORPH_POSITION = 1, MORPH_FRONT, MORPH_BACK, MORPH_WEIGHTS, MORPH_TARGETS };

static void morph_accessors(rg_json *j, model *g)
{
    const size_t nv = (size_t)g->mesh->nv, n = (size_t)g->t.start[g->mesh->nf], frames = (size_t)g->frames;
    accessor(j, g, POSITIONS, 0, nv, 3, FLOAT, 1);
    accessor(j, g, TRIANGLES, 0, 3 * n, 1, UINT, 0);
    accessor(j, g, TRIANGLES, 12 * n, 3 * n, 1, UINT, 0);
    accessor(j, g, WEIGHTS, 0, (frames - 1) * frames, 1, FLOAT, 0);
    for (size_t k = 0; k < frames - 1; k++) accessor(j, g, DISPLACEMENTS, 12 * nv * k, nv, 3, FLOAT, 1);
}

/* After those of facets: a crease each, or a kind each. */
static void crease_accessors(rg_json *j, model *g)
{
    g->lines = g->accessors;
    for (int32_t i = 0; i < (g->morphs ? 0 : g->creases); i++) accessor(j, g, CREASES, 8 * (size_t)i, 2, 1, UINT, 0);
    for (int k = 0; k < (g->morphs ? KINDS : 0); k++) {
        const size_t first = (size_t)g->of_kind[k], n = (size_t)g->of_kind[k + 1] - first;
        if (n > 0) accessor(j, g, CREASES, 8 * first, 2 * n, 1, UINT, 0);
    }
}

/* After all others, so that their numbers are the same with and without. */
static void print_accessors(rg_json *j, model *g)
{
    g->print = g->accessors;
    if (g->morphs) accessor(j, g, PRINT, 0, (size_t)g->mesh->nv, 2, FLOAT, 0);
    for (int32_t f = 0; f < (g->morphs ? 0 : g->mesh->nf); f++)
        accessor(j, g, PRINT, 8 * (size_t)g->mesh->facet_start[f], (size_t)corners(g->mesh, f), 2, FLOAT, 0);
}

static void views(rg_json *j, const model *g)
{
    static const int target[PARTS] = {VERTICES, VERTICES, INDICES, INDICES, 0, 0, 0, VERTICES, 0};
    rg_json_open(j, "bufferViews", '[');
    for (int k = 0; k < PARTS; k++) {
        const int vertices = target[k] == VERTICES || (g->morphs && k == DISPLACEMENTS);
        if (g->start[k + 1] == g->start[k]) continue;
        rg_json_open_line(j, NULL, '{');
        rg_json_integer(j, "buffer", 0);
        rg_json_integer(j, "byteOffset", (int64_t)g->start[k]);
        rg_json_integer(j, "byteLength",
                        k == IMAGE ? (int64_t)g->image_bytes : (int64_t)(g->start[k + 1] - g->start[k]));
        if (vertices) rg_json_integer(j, "byteStride", k == PRINT ? 8 : 12);
        if (vertices || target[k]) rg_json_integer(j, "target", vertices ? VERTICES : target[k]);
        rg_json_close(j);
    }
    rg_json_close(j);
}

/* Paper colours are sRGB, glTF's are linear light. */
static double linear(unsigned char c)
{
    const double x = c / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

static void material(rg_json *j, const char *name, const unsigned char c[3], int printed)
{
    rg_json_open(j, NULL, '{');
    rg_json_string(j, "name", name);
    rg_json_open_line(j, "pbrMetallicRoughness", '{');
    if (printed) {
        rg_json_open(j, "baseColorTexture", '{');
        rg_json_integer(j, "index", 0);
        rg_json_close(j);
    } else {
        rg_json_numbers(j, "baseColorFactor", (const double[]){linear(c[0]), linear(c[1]), linear(c[2]), 1}, 4);
    }
    rg_json_number(j, "metallicFactor", 0);
    rg_json_number(j, "roughnessFactor", ROUGHNESS);
    rg_json_close(j);
    rg_json_close(j);
}

static void picture(rg_json *j, const model *g)
{
    rg_json_open_line(j, "images", '[');
    rg_json_open(j, NULL, '{');
    rg_json_integer(j, "bufferView", view_of(g, IMAGE));
    rg_json_string(j, "mimeType", "image/png");
    rg_json_close(j);
    rg_json_close(j);
    rg_json_open_line(j, "textures", '[');
    rg_json_open(j, NULL, '{');
    rg_json_integer(j, "source", 0);
    rg_json_close(j);
    rg_json_close(j);
}

static void targets(rg_json *j, const model *g)
{
    if (!g->morphs) return;
    rg_json_open(j, "targets", '[');
    for (int32_t k = 0; k < g->frames - 1; k++) {
        rg_json_open(j, NULL, '{');
        rg_json_integer(j, "POSITION", MORPH_TARGETS + k);
        rg_json_close(j);
    }
    rg_json_close(j);
}

static void name_of(const rg_mesh *mesh, int32_t crease, char name[24])
{
    snprintf(name, 24, "c%d_%c", (int)crease, mesh->assignment[mesh->crease_edge[crease]]);
}

/* Lines without normals, which viewers show in their own colour whatever the light. Those of a kind are named in their
 * order. */
static void lines(rg_json *j, const model *g, int kind, int32_t position, int32_t indices)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_open(j, "attributes", '{');
    rg_json_integer(j, "POSITION", position);
    rg_json_close(j);
    rg_json_integer(j, "indices", indices);
    rg_json_integer(j, "material", FIRST_LINES + kind);
    rg_json_integer(j, "mode", LINES_MODE);
    targets(j, g);
    if (g->morphs) {
        char name[24];
        rg_json_open(j, "extras", '{');
        rg_json_open(j, "creases", '[');
        for (int32_t i = 0; i < g->creases; i++) {
            if (kind_of(g->mesh, i) != kind) continue;
            name_of(g->mesh, i, name);
            rg_json_string(j, NULL, name);
        }
        rg_json_close(j);
        rg_json_close(j);
    }
    rg_json_close(j);
}

/* print: accessor of places in the picture, -1: none. */
static void primitive(rg_json *j, const model *g, int side, int32_t position, int32_t normal, int32_t indices,
                      int32_t print)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_open(j, "attributes", '{');
    rg_json_integer(j, "POSITION", position);
    if (!g->morphs) rg_json_integer(j, "NORMAL", normal);
    if (print >= 0) rg_json_integer(j, "TEXCOORD_0", print);
    rg_json_close(j);
    rg_json_integer(j, "indices", indices);
    rg_json_integer(j, "material", side);
    targets(j, g);
    rg_json_close(j);
}

static void meshes(rg_json *j, const model *g)
{
    rg_json_open(j, "meshes", '[');
    for (int32_t f = 0; f < (g->morphs ? 1 : g->mesh->nf); f++) {
        rg_json_open(j, NULL, '{');
        rg_json_open(j, "primitives", '[');
        for (int side = FRONT; side <= BACK; side++) {
            const int32_t print = g->image && side == FRONT ? g->print + f : -1;
            if (g->morphs) primitive(j, g, side, MORPH_POSITION, 0, MORPH_FRONT + side, print);
            else
                primitive(j, g, side, accessor_of(f), g->normals_of[corners(g->mesh, f)] + side,
                          accessor_of(f) + 1 + side, print);
        }
        for (int k = 0, next = g->lines; g->morphs && k < KINDS; k++)
            if (g->of_kind[k + 1] > g->of_kind[k]) lines(j, g, k, MORPH_POSITION, next++);
        rg_json_close(j);
        rg_json_close(j);
    }
    for (int32_t i = 0; i < (g->morphs ? 0 : g->creases); i++) {
        rg_json_open_line(j, NULL, '{');
        rg_json_open(j, "primitives", '[');
        lines(j, g, kind_of(g->mesh, i), accessor_of(g->mesh->edge_facet[g->mesh->crease_edge[i]][0]), g->lines + i);
        rg_json_close(j);
        rg_json_close(j);
    }
    rg_json_close(j);
}

/* glTF has y up and metres: what is here z is turned there, and units of the file that are known become metres. */
static void upright(rg_json *j, double metres)
{
    const double half = sqrt(0.5);
    rg_json_numbers(j, "rotation", (const double[]){-half, 0, 0, half}, 4);
    if (metres > 0 && metres != 1) rg_json_numbers(j, "scale", (const double[]){metres, metres, metres}, 3);
}

/* The nodes of the creases that go with facet f: the facets' own come before them. */
static void children(rg_json *j, const model *g, int32_t f)
{
    const rg_mesh *mesh = g->mesh;
    int some = 0;
    for (int32_t k = mesh->facet_start[f]; k < mesh->facet_start[f + 1]; k++) {
        const int32_t e = mesh->facet_edge[k], i = mesh->edge_crease[e];
        if (i < 0 || i >= g->creases || mesh->edge_facet[e][0] != f) continue;
        if (!some++) rg_json_open(j, "children", '[');
        rg_json_integer(j, NULL, 1 + mesh->nf + i);
    }
    if (some) rg_json_close(j);
}

static void nodes(rg_json *j, const model *g)
{
    rg_json_open(j, "nodes", '[');
    rg_json_open(j, NULL, '{');
    rg_json_string(j, "name", g->m->title && *g->m->title ? g->m->title : "sheet");
    upright(j, g->m->report.pattern->unit);
    if (g->morphs) rg_json_integer(j, "mesh", 0);
    if (!g->morphs) {
        rg_json_open_line(j, "children", '[');
        for (int32_t f = 0; f < g->mesh->nf; f++) rg_json_integer(j, NULL, f + 1);
        rg_json_close(j);
    }
    rg_json_close(j);
    for (int32_t f = 0; f < (g->morphs ? 0 : g->mesh->nf); f++) {
        const rg_turn q = g->last_turn[f];
        const rg_vec3 t = g->last_shift[f];
        char name[24];
        snprintf(name, sizeof name, "facet %d", (int)f);
        rg_json_open_line(j, NULL, '{');
        rg_json_string(j, "name", name);
        rg_json_integer(j, "mesh", f);
        rg_json_numbers(j, "rotation", (const double[]){q.x, q.y, q.z, q.w}, 4);
        rg_json_numbers(j, "translation", (const double[]){t.x, t.y, t.z}, 3);
        children(j, g, f);
        rg_json_close(j);
    }
    for (int32_t i = 0; i < (g->morphs ? 0 : g->creases); i++) {
        char name[24];
        name_of(g->mesh, i, name);
        rg_json_open_line(j, NULL, '{');
        rg_json_string(j, "name", name);
        rg_json_integer(j, "mesh", g->mesh->nf + i);
        rg_json_close(j);
    }
    rg_json_close(j);
}

static void channel(rg_json *j, int32_t sampler, int32_t node, const char *path)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "sampler", sampler);
    rg_json_open(j, "target", '{');
    rg_json_integer(j, "node", node);
    rg_json_string(j, "path", path);
    rg_json_close(j);
    rg_json_close(j);
}

static void sampler(rg_json *j, int32_t output)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "input", 0);
    rg_json_integer(j, "output", output);
    rg_json_string(j, "interpolation", "LINEAR");
    rg_json_close(j);
}

static void animation(rg_json *j, const model *g)
{
    rg_json_open(j, "animations", '[');
    rg_json_open(j, NULL, '{');
    rg_json_string(j, "name", "fold");
    rg_json_open(j, "channels", '[');
    if (g->morphs) channel(j, 0, 0, "weights");
    for (int32_t f = 0; f < (g->morphs ? 0 : g->mesh->nf); f++) {
        channel(j, 2 * f, f + 1, "rotation");
        channel(j, 2 * f + 1, f + 1, "translation");
    }
    rg_json_close(j);
    rg_json_open(j, "samplers", '[');
    if (g->morphs) sampler(j, MORPH_WEIGHTS);
    for (int32_t f = 0; f < (g->morphs ? 0 : g->mesh->nf); f++) {
        sampler(j, accessor_of(f) + 3);
        sampler(j, accessor_of(f) + 4);
    }
    rg_json_close(j);
    rg_json_close(j);
    rg_json_close(j);
}

/* uri NULL: the buffer is the next chunk of the same file. */
static size_t describe(model *g, const char *uri, FILE *out)
{
    rg_json json, *j = &json;
    rg_json_begin(j, out);
    rg_json_open(j, NULL, '{');
    rg_json_open_line(j, "asset", '{');
    rg_json_string(j, "version", "2.0");
    rg_json_string(j, "generator", "rigami " RG_VERSION);
    rg_json_close(j);
    rg_json_integer(j, "scene", 0);
    rg_json_open_line(j, "scenes", '[');
    rg_json_open(j, NULL, '{');
    rg_json_integers(j, "nodes", (const int32_t[]){0}, 1);
    rg_json_close(j);
    rg_json_close(j);
    rg_json_open(j, "materials", '[');
    material(j, "front", g->p->front, g->image != NULL);
    material(j, "back", g->p->back, 0);
    for (int k = 0; g->creases > 0 && k < KINDS; k++)
        material(j,
                 k == MOUNTAINS ? "mountain"
                 : k == VALLEYS ? "valley"
                                : "crease",
                 g->p->lines == RG_LINES_EDGES ? EDGE_INK : INK[k], 0);
    rg_json_close(j);
    if (g->image) picture(j, g);
    rg_json_open(j, "accessors", '[');
    g->accessors = 0;
    accessor(j, g, TIMES, 0, (size_t)g->frames, 1, FLOAT, 1);
    if (g->morphs) morph_accessors(j, g);
    else facet_accessors(j, g);
    crease_accessors(j, g);
    if (g->image) print_accessors(j, g);
    rg_json_close(j);
    meshes(j, g);
    nodes(j, g);
    animation(j, g);
    views(j, g);
    rg_json_open(j, "buffers", '[');
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "byteLength", (int64_t)g->start[PARTS]);
    if (uri) rg_json_string(j, "uri", uri);
    rg_json_close(j);
    rg_json_close(j);
    rg_json_close(j);
    return j->bytes;
}

/* -------------------------------------------------------------------------------------------- containers ---- */

rg_status rg_gltf_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame;
    model g;
    char *uri = NULL;
    rg_status s = model_init(&g, m, p);
    if (s == RG_OK) {
        uri = rg_base64_text(&m->mem, "data:application/octet-stream;base64,", g.bytes, g.start[PARTS]);
        if (uri) describe(&g, uri, out);
        else s = RG_ENOMEM;
    }
    rg_mem_free(&m->mem, uri);
    model_free(&g);
    return s;
}

static void chunk_head(uint32_t bytes, const char type[4], FILE *out)
{
    unsigned char head[8];
    memcpy(rg_bytes_u32(head, bytes), type, 4);
    fwrite(head, 1, sizeof head, out);
}

/* Chunks are multiples of four bytes; all parts of the buffer are. */
static rg_status write_chunks(model *g, FILE *out)
{
    const size_t json = describe(g, NULL, NULL), padding = (4 - json % 4) % 4;
    const size_t total = 12 + 8 + json + padding + 8 + g->start[PARTS];
    unsigned char head[12] = "glTF";
    if (total > UINT32_MAX) return RG_EARG;
    rg_bytes_u32(rg_bytes_u32(head + 4, 2), (uint32_t)total);
    fwrite(head, 1, sizeof head, out);
    chunk_head((uint32_t)(json + padding), "JSON", out);
    describe(g, NULL, out);
    fwrite("   ", 1, padding, out);
    chunk_head((uint32_t)g->start[PARTS], "BIN", out);
    fwrite(g->bytes, 1, g->start[PARTS], out);
    return RG_OK;
}

rg_status rg_gltf_write_binary(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame;
    model g;
    rg_status s = model_init(&g, m, p);
    if (s == RG_OK) s = write_chunks(&g, out);
    model_free(&g);
    return s;
}
