#include "write/html.h"
#include "base/base64.h"
#include "base/bytes.h"
#include "base/json.h"
#include "render/lift.h"

#include <string.h>

/* write/page.html, made an array by make; the data go where MARK is. */
static const unsigned char PAGE[] = {
#include "write/page.h"
};
static const char MARK[] = "@DATA@";

typedef struct book {
    const rg_motion *m;
    const rg_mesh *mesh;
    rg_triangles t;
    rg_lift *layers;
    int rigid;           /* facets keep their shape: the page finds their turns; else it moves the vertices alone */
    rg_vec3 *x, *lift;   /* [nv], [nf] */
    rg_vec3 middle;      /* of the sheet: single precision is about it */
    unsigned char *bytes; /* room for one frame */
} book;

static unsigned char *vector(unsigned char *to, rg_vec3 v)
{
    return rg_bytes_f32(rg_bytes_f32(rg_bytes_f32(to, v.x), v.y), v.z);
}

/* The bytes from b->bytes up to `end` as a string of base64. */
static rg_status bytes(rg_json *j, const book *b, const char *key, const unsigned char *end)
{
    char *text = rg_base64_text(&b->m->mem, "", b->bytes, (size_t)(end - b->bytes));
    if (!text) return RG_ENOMEM;
    rg_json_string(j, key, text);
    rg_mem_free(&b->m->mem, text);
    return RG_OK;
}

/* Corners about the centre of their facet. */
static rg_status flat(rg_json *j, book *b)
{
    const rg_mesh *m = b->mesh;
    unsigned char *to = b->bytes;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t from = m->facet_start[f], end = m->facet_start[f + 1];
        rg_vec2 sum = {0, 0};
        for (int32_t i = from; i < end; i++) {
            sum.x += m->X[m->facet_vertex[i]].x;
            sum.y += m->X[m->facet_vertex[i]].y;
        }
        const rg_vec2 centre = {sum.x / (end - from), sum.y / (end - from)};
        for (int32_t i = from; i < end; i++) {
            const rg_vec2 x = rg_vec2_sub(m->X[m->facet_vertex[i]], centre);
            to = rg_bytes_f32(rg_bytes_f32(to, x.x), x.y);
        }
    }
    return bytes(j, b, "flat", to);
}

/* The sheet: how many corners each facet has, what edge begins at each, and triangles by places among the corners. */
static rg_status sheet(rg_json *j, book *b)
{
    const rg_mesh *m = b->mesh;
    rg_json_open_line(j, "corners", '[');
    for (int32_t f = 0; f < m->nf; f++) rg_json_integer(j, NULL, m->facet_start[f + 1] - m->facet_start[f]);
    rg_json_close(j);
    rg_json_open_line(j, "edges", '[');
    for (int32_t i = 0; i < m->facet_start[m->nf]; i++)
        rg_json_string(j, NULL, (const char[]){m->assignment[m->facet_edge[i]], 0});
    rg_json_close(j);
    rg_json_open_line(j, "triangles", '[');
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t i = 3 * b->t.start[f]; i < 3 * b->t.start[f + 1]; i++) {
            int32_t corner = m->facet_start[f];
            while (m->facet_vertex[corner] != b->t.v[i / 3][i % 3]) corner++;
            rg_json_integer(j, NULL, corner - m->facet_start[f]);
        }
    rg_json_close(j);
    rg_json_integers(j, "vertex", m->facet_vertex, m->facet_start[m->nf]);
    rg_json_bool(j, "rigid", b->rigid);
    return b->rigid ? flat(j, b) : RG_OK;
}

static rg_status one_frame(rg_json *j, book *b, int32_t k)
{
    rg_status s = rg_lift_next(b->layers, b->x, b->lift);
    if (s != RG_OK) return s;
    unsigned char *to = b->bytes;
    int lifted = 0;
    rg_json_open_line(j, NULL, '{');
    rg_json_number(j, "percent", b->m->frame[k].percent);
    for (int32_t v = 0; v < b->mesh->nv; v++) to = vector(to, rg_vec3_sub(b->x[v], b->middle));
    s = bytes(j, b, "points", to);
    to = b->bytes;
    for (int32_t f = 0; f < b->mesh->nf; f++) {
        to = vector(to, b->lift[f]);
        lifted |= b->lift[f].x != 0 || b->lift[f].y != 0 || b->lift[f].z != 0;
    }
    if (s == RG_OK && lifted) s = bytes(j, b, "lift", to);
    rg_json_close(j);
    return s;
}

static void looks(rg_json *j, const rg_motion *m, const rg_picture *p)
{
    const struct { const char *key; const unsigned char *c; } paper[] = {
        {"front", p->front}, {"back", p->back}, {"background", p->background}};
    rg_json_string(j, "title", m->title ? m->title : "");
    rg_json_string(j, "author", m->author ? m->author : "");
    rg_json_open(j, "paper", '{');
    for (int i = 0; i < 3; i++)
        rg_json_integers(j, paper[i].key, (const int32_t[]){paper[i].c[0], paper[i].c[1], paper[i].c[2]}, 3);
    rg_json_close(j);
    rg_json_open_line(j, "camera", '{');
    rg_json_number(j, "azimuth", p->azimuth);
    rg_json_number(j, "elevation", p->elevation);
    rg_json_number(j, "zoom", p->zoom);
    rg_json_close(j);
}

static rg_status data(book *b, const rg_picture *p, FILE *out)
{
    rg_json json, *j = &json;
    rg_json_begin(j, out);
    rg_json_open(j, NULL, '{');
    looks(j, b->m, p);
    rg_status s = sheet(j, b);
    rg_json_open(j, "frames", '[');
    for (int32_t k = 0; s == RG_OK && k < b->m->report.frame_count; k++) s = one_frame(j, b, k);
    rg_json_close(j);
    rg_json_close(j);
    return s;
}

static rg_status book_init(book *b, const rg_motion *m)
{
    const rg_memory *mem = &m->mem;
    const size_t nf = (size_t)m->mesh.nf, nv = (size_t)m->mesh.nv, corners = (size_t)m->mesh.facet_start[nf];
    *b = (book){.m = m, .mesh = &m->mesh, .rigid = 1, .middle = rg_motion_middle(m)};
    for (int32_t k = 0; k < m->report.frame_count; k++)
        b->rigid &= memcmp(rg_motion_pattern(m, k), m->mesh.X, nv * sizeof *m->mesh.X) == 0;
    rg_status s = rg_triangles_init(mem, &m->mesh, &b->t);
    if (s == RG_OK) s = rg_lift_create(mem, m, &b->t, &b->layers);
    if (s != RG_OK) return s;
    b->x = rg_mem_array(mem, nv, sizeof *b->x);
    b->lift = rg_mem_array(mem, nf, sizeof *b->lift);
    b->bytes = rg_mem_array(mem, 12 * nf + 12 * nv + 8 * corners, 1);
    return b->x && b->lift && b->bytes ? RG_OK : RG_ENOMEM;
}

static void book_free(book *b)
{
    void *block[] = {b->x, b->lift, b->bytes};
    for (size_t i = 0; i < sizeof block / sizeof *block; i++) rg_mem_free(&b->m->mem, block[i]);
    rg_lift_destroy(b->layers);
    rg_triangles_free(&b->t);
}

rg_status rg_html_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame;
    book b;
    size_t mark = 0;
    while (memcmp(PAGE + mark, MARK, sizeof MARK - 1) != 0) mark++; /* the page has one: the tests read it */
    rg_status s = book_init(&b, m);
    if (s == RG_OK) {
        const size_t rest = mark + sizeof MARK - 1;
        fwrite(PAGE, 1, mark, out);
        s = data(&b, p, out);
        fwrite(PAGE + rest, 1, sizeof PAGE - rest, out);
    }
    book_free(&b);
    return s;
}
