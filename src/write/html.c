#include "write/html.h"
#include "base/base64.h"
#include "base/bytes.h"
#include "base/json.h"
#include "base/text.h"
#include "motion/ending.h"
#include "render/lift.h"
#include "render/picture.h"
#include "render/stage.h"
#include "render/tint.h"
#include "write/patches.h"
#include "write/png.h"

#include <string.h>

/* The pieces of write/page/, joined and made an array by make; the data go where MARK is. */
static const unsigned char PAGE[] = {
#include "write/page.h"
};
static const char MARK[] = "@DATA@";

typedef struct book {
    const rg_motion *m;
    const rg_mesh *mesh;
    rg_triangles t;
    rg_lift *layers;
    rg_stage stage;
    rg_tint_scale tint;
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

static rg_status points(rg_json *j, const book *b, const char *key, const rg_vec2 *X)
{
    unsigned char *to = b->bytes;
    for (int32_t v = 0; v < b->mesh->nv; v++)
        to = rg_bytes_f32(rg_bytes_f32(to, X[v].x - b->middle.x), X[v].y - b->middle.y);
    return bytes(j, b, key, to);
}

/* The sheet: how many corners each facet has, the vertex and the edge that begin at each, triangles by places among the
 * corners; the edges' ends and assignments; the pattern given. */
static rg_status sheet(rg_json *j, book *b)
{
    const rg_mesh *m = b->mesh;
    rg_json_open_line(j, "corners", '[');
    for (int32_t f = 0; f < m->nf; f++) rg_json_integer(j, NULL, m->facet_start[f + 1] - m->facet_start[f]);
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
    rg_json_integers(j, "edge", m->facet_edge, m->facet_start[m->nf]);
    rg_json_integers(j, "ends", m->edge[0], 2 * m->ne);
    char *kinds = rg_mem_array(&b->m->mem, (size_t)m->ne + 1, 1);
    if (!kinds) return RG_ENOMEM;
    memcpy(kinds, m->assignment, (size_t)m->ne);
    rg_json_string(j, "assignment", kinds);
    rg_mem_free(&b->m->mem, kinds);
    rg_json_bool(j, "rigid", b->rigid);
    return points(j, b, "pattern", m->X);
}

static rg_status one_frame(rg_json *j, book *b, int32_t k)
{
    rg_status s = rg_lift_next(b->layers, b->x, b->lift);
    if (s != RG_OK) return s;
    const int32_t nv = b->mesh->nv, nf = b->mesh->nf;
    unsigned char *to = b->bytes;
    int lifted = 0;
    rg_stage_put(&b->stage, k, b->x, nv);
    rg_stage_turn(&b->stage, k, b->lift, nf);
    rg_json_open_line(j, NULL, '{');
    rg_json_number(j, "percent", b->m->frame[k].percent);
    for (int32_t v = 0; v < nv; v++) to = vector(to, b->x[v]);
    s = bytes(j, b, "points", to);
    to = b->bytes;
    for (int32_t f = 0; f < nf; f++) {
        to = vector(to, b->lift[f]);
        lifted |= b->lift[f].x != 0 || b->lift[f].y != 0 || b->lift[f].z != 0;
    }
    if (s == RG_OK && lifted) s = bytes(j, b, "lift", to);
    if (s == RG_OK && !b->rigid) s = points(j, b, "flat", rg_motion_pattern(b->m, k));
    if (s == RG_OK && b->tint.by != RG_COLOUR_PAPER) {
        rg_tint_facets(&b->tint, b->m, k, b->lift, (unsigned char(*)[3])b->bytes);
        s = bytes(j, b, "tint", b->bytes + 3 * (size_t)nf);
    }
    rg_json_close(j);
    return s;
}

/* What the last frame, whose places and lifts are in b, needs besides where its layers lie in a circle: pieces of
 * facets, with the side that begins at each corner, where that is in the pattern, and how far each piece is moved from
 * its facet. */
static rg_status patches(rg_json *j, const book *b)
{
    const rg_layers *l = rg_ending_layers(b->m, b->m->report.frame_count - 1);
    rg_patches p;
    if (!l) return RG_OK;
    rg_status s = rg_patches_init(&p, &b->m->mem, l);
    if (s == RG_OK && p.count > 0) {
        const int32_t n = p.start[p.count];
        const rg_vec3 step = rg_vec3_scale(1.0 / p.apart, rg_vec3_sub(b->lift[p.high], b->lift[p.low]));
        rg_json_open(j, "patches", '{');
        rg_json_integers(j, "facet", p.facet, p.count);
        rg_json_open_line(j, "corners", '[');
        for (int32_t k = 0; k < p.count; k++) rg_json_integer(j, NULL, p.start[k + 1] - p.start[k]);
        rg_json_close(j);
        rg_json_integers(j, "edge", p.edge, n);
        rg_json_open_line(j, "at", '[');
        for (int32_t i = 0; i < n; i++) {
            rg_json_number(j, NULL, p.corner[i].x - b->middle.x);
            rg_json_number(j, NULL, p.corner[i].y - b->middle.y);
        }
        rg_json_close(j);
        rg_json_open_line(j, "lift", '[');
        for (int32_t k = 0; k < p.count; k++) {
            const rg_vec3 by = rg_vec3_scale(p.raise[k], step);
            rg_json_number(j, NULL, by.x);
            rg_json_number(j, NULL, by.y);
            rg_json_number(j, NULL, by.z);
        }
        rg_json_close(j);
        rg_json_close(j);
    }
    rg_patches_free(&p);
    return s;
}

/* What happened, in a line: nothing where all went well. */
static void told(rg_json *j, const rg_motion *m, const rg_tint_scale *t)
{
    const rg_report *r = &m->report;
    const int first = (int)strcspn(r->reason, ";"); /* what follows is for those who look into it */
    char stopped[sizeof r->reason + 60] = "", crosses[80] = "", colours[80], text[sizeof stopped + 200];
    if (r->outcome == RG_STOPPED)
        rg_text(stopped, sizeof stopped, "Stopped short at %.1f %%: %.*s. ", r->folded_percent, first, r->reason);
    if (r->contact == RG_CONTACT_CROSSES)
        rg_text(crosses, sizeof crosses, "It passes through itself from %.1f %% on. ", r->first_contact_percent);
    rg_tint_words(t, colours, sizeof colours);
    rg_text(text, sizeof text, "%s%s%s%s%s", stopped, crosses, *colours ? "Colours: " : "", colours,
            *colours ? "." : "");
    rg_json_string(j, "told", text);
    rg_json_number(j, "crosses", r->contact == RG_CONTACT_CROSSES ? r->first_contact_percent : NAN); /* null: nowhere */
}

static void looks(rg_json *j, const book *b, const rg_picture *p)
{
    const struct { const char *key; const unsigned char *c; } paper[] = {
        {"front", p->front}, {"back", p->back}, {"background", p->background}};
    const char *title = b->m->title && *b->m->title ? b->m->title : p->title;
    rg_json_string(j, "title", title ? title : "");
    rg_json_string(j, "author", b->m->author ? b->m->author : "");
    told(j, b->m, &b->tint);
    rg_json_open(j, "paper", '{');
    for (int i = 0; i < 3; i++)
        rg_json_integers(j, paper[i].key, (const int32_t[]){paper[i].c[0], paper[i].c[1], paper[i].c[2]}, 3);
    rg_json_close(j);
    rg_json_integer(j, "lines", p->lines);
    rg_json_number(j, "line_width", p->line_width);
    rg_json_bool(j, "shadow", p->shadow);
    rg_json_number(j, "hold", p->hold);
    rg_json_open_line(j, "camera", '{');
    rg_json_number(j, "azimuth", b->stage.azimuth);
    rg_json_number(j, "elevation", b->stage.elevation);
    rg_json_number(j, "roll", b->stage.roll);
    rg_json_number(j, "zoom", p->zoom);
    rg_json_close(j);
}

static rg_status image(rg_json *j, const book *b, const rg_picture *p)
{
    const rg_memory *mem = &b->m->mem;
    unsigned char *all = NULL;
    size_t n = 0;
    if (!p->image) return RG_OK;
    const rg_status s = rg_png_load(mem, p->image, &all, &n, NULL);
    if (s != RG_OK) return s;
    char *text = rg_base64_text(mem, "", all, n);
    if (text) rg_json_string(j, "image", text);
    rg_mem_free(mem, all);
    if (!text) return RG_ENOMEM;
    rg_mem_free(mem, text);
    return RG_OK;
}

static rg_status data(book *b, const rg_picture *p, FILE *out)
{
    rg_json json, *j = &json;
    rg_json_begin(j, out);
    rg_json_open(j, NULL, '{');
    looks(j, b, p);
    rg_status s = image(j, b, p);
    if (s == RG_OK) s = sheet(j, b);
    rg_json_open(j, "frames", '[');
    for (int32_t k = 0; s == RG_OK && k < b->m->report.frame_count; k++)
        s = rg_picture_ended(p, (double)k / b->m->report.frame_count) ? RG_ECANCELLED : one_frame(j, b, k);
    rg_json_close(j);
    if (s == RG_OK) s = patches(j, b);
    rg_json_close(j);
    return s;
}

static rg_status book_init(book *b, const rg_motion *m, const rg_picture *p)
{
    const rg_memory *mem = &m->mem;
    const size_t nf = (size_t)m->mesh.nf, nv = (size_t)m->mesh.nv;
    *b = (book){.m = m,
                .mesh = &m->mesh,
                .rigid = m->space == NULL,
                .middle = rg_motion_middle(m),
                .tint = rg_tint_of(m, p->colour)};
    for (int32_t k = 0; k < m->report.frame_count; k++)
        b->rigid &= memcmp(rg_motion_pattern(m, k), m->mesh.X, nv * sizeof *m->mesh.X) == 0;
    rg_status s = rg_triangles_init(mem, &m->mesh, &b->t);
    if (s == RG_OK) s = rg_stage_init(mem, m, p, &b->stage);
    if (s == RG_OK) s = rg_lift_create(mem, m, &b->t, &b->layers);
    if (s != RG_OK) return s;
    return RG_MEM_ARRAYS(mem, RG_ARRAY(b->x, nv), RG_ARRAY(b->lift, nf), RG_ARRAY(b->bytes, 12 * nf + 12 * nv));
}

static void book_free(book *b)
{
    RG_MEM_FREE(&b->m->mem, b->x, b->lift, b->bytes);
    rg_lift_destroy(b->layers);
    rg_stage_free(&b->stage);
    rg_triangles_free(&b->t);
}

rg_status rg_html_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame;
    book b;
    size_t mark = 0;
    while (memcmp(PAGE + mark, MARK, sizeof MARK - 1) != 0) mark++; /* the page has one: the tests read it */
    rg_status s = book_init(&b, m, p);
    if (s == RG_OK) {
        const size_t rest = mark + sizeof MARK - 1;
        fwrite(PAGE, 1, mark, out);
        s = data(&b, p, out);
        fwrite(PAGE + rest, 1, sizeof PAGE - rest, out);
    }
    book_free(&b);
    return s;
}
