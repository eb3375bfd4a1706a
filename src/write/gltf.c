#include "write/gltf.h"
#include "base/base64.h"
#include "base/bytes.h"
#include "base/json.h"
#include "write/scene.h"

#include <string.h>

enum { FLOAT = 5126, UINT = 5125, VERTICES = 34962, INDICES = 34963 };
/* Materials of lines come after those of the two sides. */
enum { FIRST_LINES = RG_BACK + 1, LINES_MODE = 1 };
/* As in pictures: creases by kind, or all alike. */
static const unsigned char INK[RG_LINE_KINDS][3] = {{200, 44, 44}, {36, 84, 190}, {120, 112, 108}},
    EDGE_INK[3] = {84, 72, 66};
static const double ROUGHNESS = 0.9;

/* ------------------------------------------------------------------------------------------------- JSON ---- */

static float float_at(const unsigned char *at)
{
    const uint32_t bits = (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Only parts that are there have a buffer view, in their order. */
static int view_of(const rg_scene *g, int part)
{
    int view = 0;
    for (int k = 0; k < part; k++) view += g->start[k + 1] > g->start[k];
    return view;
}

/* n elements of 1 to 4 numbers each; `bounds`: say the least and the largest, as the format asks for in places. */
static void accessor(rg_json *j, rg_scene *g, int part, size_t offset, size_t n, int width, int component, int bounds)
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

static void facet_accessors(rg_json *j, rg_scene *g)
{
    const rg_mesh *mesh = g->mesh;
    const size_t frames = (size_t)g->frames;
    for (int32_t f = 0; f < mesh->nf; f++) {
        const size_t first = (size_t)g->t.start[f], n = (size_t)(g->t.start[f + 1] - g->t.start[f]);
        accessor(j, g, RG_PART_POSITIONS, 12 * (size_t)mesh->facet_start[f], (size_t)rg_scene_corners(mesh, f), 3,
                 FLOAT, 1);
        accessor(j, g, RG_PART_TRIANGLES, 24 * first, 3 * n, 1, UINT, 0);
        accessor(j, g, RG_PART_TRIANGLES, 24 * first + 12 * n, 3 * n, 1, UINT, 0);
        accessor(j, g, RG_PART_TURNS, 16 * (size_t)f * frames, frames, 4, FLOAT, 0);
        accessor(j, g, RG_PART_SHIFTS, 12 * (size_t)f * frames, frames, 3, FLOAT, 0);
        g->normals_of[rg_scene_corners(mesh, f)] = 1;
    }
    for (int32_t n = 0; n <= g->most; n++) {
        if (!g->normals_of[n]) continue;
        g->normals_of[n] = g->accessors;
        accessor(j, g, RG_PART_NORMALS, 0, (size_t)n, 3, FLOAT, 0);
        accessor(j, g, RG_PART_NORMALS, 12 * (size_t)g->most, (size_t)n, 3, FLOAT, 0);
    }
}

/* Accessor 0 is the times; then vertices, front, back, weights; then the displacements frame by frame. */
enum { MORPH_POSITION = 1, MORPH_FRONT, MORPH_BACK, MORPH_WEIGHTS, MORPH_TARGETS };

static void morph_accessors(rg_json *j, rg_scene *g)
{
    const size_t nv = (size_t)g->mesh->nv, n = (size_t)g->t.start[g->mesh->nf], frames = (size_t)g->frames;
    accessor(j, g, RG_PART_POSITIONS, 0, nv, 3, FLOAT, 1);
    accessor(j, g, RG_PART_TRIANGLES, 0, 3 * n, 1, UINT, 0);
    accessor(j, g, RG_PART_TRIANGLES, 12 * n, 3 * n, 1, UINT, 0);
    accessor(j, g, RG_PART_WEIGHTS, 0, (frames - 1) * frames, 1, FLOAT, 0);
    for (size_t k = 0; k < frames - 1; k++) accessor(j, g, RG_PART_DISPLACEMENTS, 12 * nv * k, nv, 3, FLOAT, 1);
}

/* After those of facets: a crease each, or a kind each. */
static void crease_accessors(rg_json *j, rg_scene *g)
{
    g->lines = g->accessors;
    for (int32_t i = 0; i < (g->morphs ? 0 : g->creases); i++)
        accessor(j, g, RG_PART_CREASES, 8 * (size_t)i, 2, 1, UINT, 0);
    for (int k = 0; k < (g->morphs ? RG_LINE_KINDS : 0); k++) {
        const size_t first = (size_t)g->of_kind[k], n = (size_t)g->of_kind[k + 1] - first;
        if (n > 0) accessor(j, g, RG_PART_CREASES, 8 * first, 2 * n, 1, UINT, 0);
    }
}

/* After all others, so that their numbers are the same with and without. */
static void print_accessors(rg_json *j, rg_scene *g)
{
    g->print = g->accessors;
    if (g->morphs) accessor(j, g, RG_PART_PRINT, 0, (size_t)g->mesh->nv, 2, FLOAT, 0);
    for (int32_t f = 0; f < (g->morphs ? 0 : g->mesh->nf); f++)
        accessor(j, g, RG_PART_PRINT, 8 * (size_t)g->mesh->facet_start[f], (size_t)rg_scene_corners(g->mesh, f), 2,
                 FLOAT, 0);
}

static void views(rg_json *j, const rg_scene *g)
{
    static const int target[RG_PARTS] = {VERTICES, VERTICES, INDICES, INDICES, 0, 0, 0, VERTICES, 0};
    rg_json_open(j, "bufferViews", '[');
    for (int k = 0; k < RG_PARTS; k++) {
        const int vertices = target[k] == VERTICES || (g->morphs && k == RG_PART_DISPLACEMENTS);
        if (g->start[k + 1] == g->start[k]) continue;
        rg_json_open_line(j, NULL, '{');
        rg_json_integer(j, "buffer", 0);
        rg_json_integer(j, "byteOffset", (int64_t)g->start[k]);
        rg_json_integer(j, "byteLength",
                        k == RG_PART_IMAGE ? (int64_t)g->image_bytes : (int64_t)(g->start[k + 1] - g->start[k]));
        if (vertices) rg_json_integer(j, "byteStride", k == RG_PART_PRINT ? 8 : 12);
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

static void picture(rg_json *j, const rg_scene *g)
{
    rg_json_open_line(j, "images", '[');
    rg_json_open(j, NULL, '{');
    rg_json_integer(j, "bufferView", view_of(g, RG_PART_IMAGE));
    rg_json_string(j, "mimeType", "image/png");
    rg_json_close(j);
    rg_json_close(j);
    rg_json_open_line(j, "textures", '[');
    rg_json_open(j, NULL, '{');
    rg_json_integer(j, "source", 0);
    rg_json_close(j);
    rg_json_close(j);
}

static void targets(rg_json *j, const rg_scene *g)
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
static void lines(rg_json *j, const rg_scene *g, int kind, int32_t position, int32_t indices)
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
            if (rg_scene_kind(g->mesh, i) != kind) continue;
            name_of(g->mesh, i, name);
            rg_json_string(j, NULL, name);
        }
        rg_json_close(j);
        rg_json_close(j);
    }
    rg_json_close(j);
}

/* print: accessor of places in the picture, -1: none. */
static void primitive(rg_json *j, const rg_scene *g, int side, int32_t position, int32_t normal, int32_t indices,
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

static void meshes(rg_json *j, const rg_scene *g)
{
    rg_json_open(j, "meshes", '[');
    for (int32_t f = 0; f < (g->morphs ? 1 : g->mesh->nf); f++) {
        rg_json_open(j, NULL, '{');
        rg_json_open(j, "primitives", '[');
        for (int side = RG_FRONT; side <= RG_BACK; side++) {
            const int32_t print = g->image && side == RG_FRONT ? g->print + f : -1;
            if (g->morphs) primitive(j, g, side, MORPH_POSITION, 0, MORPH_FRONT + side, print);
            else
                primitive(j, g, side, accessor_of(f), g->normals_of[rg_scene_corners(g->mesh, f)] + side,
                          accessor_of(f) + 1 + side, print);
        }
        for (int k = 0, next = g->lines; g->morphs && k < RG_LINE_KINDS; k++)
            if (g->of_kind[k + 1] > g->of_kind[k]) lines(j, g, k, MORPH_POSITION, next++);
        rg_json_close(j);
        rg_json_close(j);
    }
    for (int32_t i = 0; i < (g->morphs ? 0 : g->creases); i++) {
        rg_json_open_line(j, NULL, '{');
        rg_json_open(j, "primitives", '[');
        lines(j, g, rg_scene_kind(g->mesh, i), accessor_of(g->mesh->edge_facet[g->mesh->crease_edge[i]][0]),
              g->lines + i);
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
static void children(rg_json *j, const rg_scene *g, int32_t f)
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

static void nodes(rg_json *j, const rg_scene *g)
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

static void animation(rg_json *j, const rg_scene *g)
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
static size_t describe(rg_scene *g, const char *uri, FILE *out)
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
    for (int k = 0; g->creases > 0 && k < RG_LINE_KINDS; k++)
        material(j,
                 k == RG_MOUNTAINS ? "mountain"
                 : k == RG_VALLEYS ? "valley"
                                : "crease",
                 g->p->lines == RG_LINES_EDGES ? EDGE_INK : INK[k], 0);
    rg_json_close(j);
    if (g->image) picture(j, g);
    rg_json_open(j, "accessors", '[');
    g->accessors = 0;
    accessor(j, g, RG_PART_TIMES, 0, (size_t)g->frames, 1, FLOAT, 1);
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
    rg_json_integer(j, "byteLength", (int64_t)g->start[RG_PARTS]);
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
    rg_scene g;
    char *uri = NULL;
    rg_status s = rg_scene_init(&g, m, p);
    if (s == RG_OK) {
        uri = rg_base64_text(&m->mem, "data:application/octet-stream;base64,", g.bytes, g.start[RG_PARTS]);
        if (uri) describe(&g, uri, out);
        else s = RG_ENOMEM;
    }
    rg_mem_free(&m->mem, uri);
    rg_scene_free(&g);
    return s;
}

static void chunk_head(uint32_t bytes, const char type[4], FILE *out)
{
    unsigned char head[8];
    memcpy(rg_bytes_u32(head, bytes), type, 4);
    fwrite(head, 1, sizeof head, out);
}

/* Chunks are multiples of four bytes; all parts of the buffer are. */
static rg_status write_chunks(rg_scene *g, FILE *out)
{
    const size_t json = describe(g, NULL, NULL), padding = (4 - json % 4) % 4;
    const size_t total = 12 + 8 + json + padding + 8 + g->start[RG_PARTS];
    unsigned char head[12] = "glTF";
    if (total > UINT32_MAX) return RG_EWRITE; /* the format counts no further */
    rg_bytes_u32(rg_bytes_u32(head + 4, 2), (uint32_t)total);
    fwrite(head, 1, sizeof head, out);
    chunk_head((uint32_t)(json + padding), "JSON", out);
    describe(g, NULL, out);
    fwrite("   ", 1, padding, out);
    chunk_head((uint32_t)g->start[RG_PARTS], "BIN", out);
    fwrite(g->bytes, 1, g->start[RG_PARTS], out);
    return RG_OK;
}

rg_status rg_gltf_write_binary(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame;
    rg_scene g;
    rg_status s = rg_scene_init(&g, m, p);
    if (s == RG_OK) s = write_chunks(&g, out);
    rg_scene_free(&g);
    return s;
}
