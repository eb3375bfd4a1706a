#include "save/fold.h"
#include "base/file.h"
#include "base/json.h"
#include "base/unit.h"
#include "read/value.h"

#include <string.h>

/* --------------------------------------------------------------------------------------------- what was there ---- */

/* Levels of objects and lists in a value. */
static int depth(const rg_value *v, int most)
{
    int deepest = 0;
    if (most == 0) return 1;
    for (size_t i = 0; i < rg_value_count(v); i++) {
        const int d = depth(rg_value_at(v, i), most - 1);
        if (d > deepest) deepest = d;
    }
    for (const void *k = NULL; (k = rg_value_next(v, k));) {
        const int d = depth(rg_value_under(k), most - 1);
        if (d > deepest) deepest = d;
    }
    return deepest + 1;
}

static void put(rg_json *j, const char *key, const rg_value *v, int level)
{
    int64_t integer = 0;
    double real = 0;
    switch (rg_value_kind(v)) {
    case RG_KIND_OBJECT:
    case RG_KIND_LIST: {
        const char kind = rg_value_kind(v) == RG_KIND_OBJECT ? '{' : '[';
        if (level > 0) rg_json_open_line(j, key, kind);
        else rg_json_open(j, key, kind);
        for (size_t i = 0; i < rg_value_count(v); i++) put(j, NULL, rg_value_at(v, i), level + 1);
        for (const void *k = NULL; (k = rg_value_next(v, k));) put(j, rg_value_key(k), rg_value_under(k), level + 1);
        rg_json_close(j);
        break;
    }
    case RG_KIND_INTEGER:
        rg_value_integer(v, &integer);
        rg_json_integer(j, key, integer);
        break;
    case RG_KIND_REAL:
        rg_value_number(v, &real);
        rg_json_number(j, key, real);
        break;
    case RG_KIND_BOOL: rg_json_bool(j, key, rg_value_is_true(v)); break;
    default: rg_json_string(j, key, rg_value_text(v)); break;
    }
}

static int begins(const char *s, const char *word) { return strncmp(s, word, strlen(word)) == 0; }

static int among(const char *key, const char *const *keys)
{
    for (; *keys; keys++)
        if (strcmp(key, *keys) == 0) return 1;
    return 0;
}

/* Whether what a key of the old frame says is still so. */
static int holds(const rg_fold_sheet *s, const char *key, const rg_value *v)
{
    static const char *const topology[] = {"vertices_vertices", "vertices_edges", "vertices_faces", "faces_faces",
                                           NULL};
    const int all = s->same_vertices && s->same_edges && s->same_faces;
    if (depth(v, RG_JSON_DEPTH) >= RG_JSON_DEPTH - 1) return 0;
    if (among(key, topology) || strcmp(key, "file_frames") == 0) return all;
    if (strcmp(key, "faceOrders") == 0) return s->same_faces;
    if (strcmp(key, "edgeOrders") == 0) return s->same_edges;
    if (begins(key, "vertices_")) return s->same_vertices && rg_value_count(v) == (size_t)s->nv;
    if (begins(key, "edges_")) return s->same_edges && rg_value_count(v) == (size_t)s->ne;
    if (begins(key, "faces_")) return s->same_faces && rg_value_count(v) == (size_t)s->nf;
    return 1;
}

/* What put_head, put_edges and put_faces write. */
static const char *const OURS[] = {"file_spec", "file_creator", "file_author", "file_title", "file_description",
    "frame_classes", "frame_attributes", "frame_parent", "frame_inherit", "vertices_coords", "edges_vertices",
    "edges_assignment", "edges_foldAngle", "edges_foldAngles", "edges_faces", "faces_vertices", "faces_edges",
    "rigami:editor", "rigami:reference", "rigami:vertices_source", "rigami:edges_source", NULL};

int32_t rg_fold_put_rest(rg_json *j, const rg_value *frame, const rg_fold_sheet *s, const char *const *ours)
{
    int32_t lost = 0;
    for (const void *k = NULL; (k = rg_value_next(frame, k));) {
        const char *key = rg_value_key(k);
        if (among(key, ours)) continue;
        const int is_old = strcmp(key, "edges_lengths") == 0; /* a name of 1.0 */
        const int is_twice = is_old && rg_value_get(frame, "edges_length");
        if (is_twice || !holds(s, key, rg_value_under(k))) lost++;
        else put(j, is_old ? "edges_length" : key, rg_value_under(k), 0);
    }
    return lost;
}

void rg_fold_put_source(rg_json *j, const char *key, const int32_t *source, int32_t known, int32_t n)
{
    rg_json_open_line(j, key, '[');
    for (int32_t i = 0; i < n; i++) {
        if (i < known && source[i] >= 0) rg_json_integer(j, NULL, source[i]);
        else rg_json_string(j, NULL, NULL);
    }
    rg_json_close(j);
}

/* ------------------------------------------------------------------------------------------------- the pattern ---- */

static void put_text(rg_json *j, const char *key, const char *text)
{
    if (text) rg_json_string(j, key, text);
}

static void put_head(rg_json *j, const rg_lines *l)
{
    rg_json_number(j, "file_spec", 1.2);
    rg_json_string(j, "file_creator", "rigami " RG_VERSION);
    put_text(j, "file_author", l->author);
    put_text(j, "file_title", l->title);
    put_text(j, "file_description", l->memo);
    put_text(j, "rigami:editor", l->editor);
    put_text(j, "rigami:reference", l->reference);
    rg_json_open_line(j, "frame_classes", '[');
    rg_json_string(j, NULL, "creasePattern");
    rg_json_close(j);
    rg_json_open_line(j, "frame_attributes", '[');
    rg_json_string(j, NULL, "2D");
    rg_json_close(j);
}

static void put_edges(rg_json *j, const rg_fold_sheet *s)
{
    rg_json_open(j, "vertices_coords", '[');
    for (int32_t v = 0; v < s->nv; v++) rg_json_numbers(j, NULL, (const double[]){s->X[v].x, s->X[v].y}, 2);
    rg_json_close(j);
    rg_json_open(j, "edges_vertices", '[');
    for (int32_t e = 0; e < s->ne; e++) rg_json_integers(j, NULL, s->E + 2 * e, 2);
    rg_json_close(j);
    rg_json_open_line(j, "edges_assignment", '[');
    for (int32_t e = 0; e < s->ne; e++) rg_json_string(j, NULL, (const char[]){s->letter[e], 0});
    rg_json_close(j);
    rg_json_numbers(j, "edges_foldAngle", s->angle, s->ne);
}

/* The faces on the left and on the right of each edge. */
static rg_status put_edges_faces(rg_json *j, const rg_lines *l, const rg_fold_sheet *s)
{
    int32_t *side = rg_mem_array(&l->mem, (size_t)s->ne, 2 * sizeof *side);
    if (!side) return RG_ENOMEM;
    for (int32_t f = 0; f < s->nf; f++)
        for (int32_t k = s->face_start[f]; k < s->face_start[f + 1]; k++)
            side[2 * s->face_edge[k] + (s->E[2 * s->face_edge[k]] != s->face_vertex[k])] = f + 1;
    rg_json_open(j, "edges_faces", '[');
    for (int32_t e = 0; e < s->ne; e++) {
        rg_json_open_line(j, NULL, '[');
        for (int i = 0; i < 2; i++)
            if (side[2 * e + i]) rg_json_integer(j, NULL, side[2 * e + i] - 1);
        rg_json_close(j);
    }
    rg_json_close(j);
    rg_mem_free(&l->mem, side);
    return RG_OK;
}

static rg_status put_faces(rg_json *j, const rg_lines *l, const rg_fold_sheet *s)
{
    const struct { const char *key; const int32_t *list; } lists[] = {{"faces_vertices", s->face_vertex},
                                                                      {"faces_edges", s->face_edge}};
    for (int i = 0; i < 2; i++) {
        rg_json_open(j, lists[i].key, '[');
        for (int32_t f = 0; f < s->nf; f++)
            rg_json_integers(j, NULL, lists[i].list + s->face_start[f], s->face_start[f + 1] - s->face_start[f]);
        rg_json_close(j);
    }
    return put_edges_faces(j, l, s);
}

rg_status rg_fold_write(const rg_lines *l, const rg_fold_sheet *sheet, const rg_dest *to, int32_t *lost, rg_diag *why)
{
    rg_file f;
    rg_json j;
    rg_status s = rg_file_begin_to(&f, &l->mem, to, why);
    if (s != RG_OK) return s;
    rg_json_begin(&j, f.stream);
    rg_json_open(&j, NULL, '{');
    put_head(&j, l);
    put_edges(&j, sheet);
    if (sheet->nf > 0) s = put_faces(&j, l, sheet);
    if (l->metres > 0 && rg_unit_name(l->metres) && !rg_value_get(l->frame, "frame_unit"))
        rg_json_string(&j, "frame_unit", rg_unit_name(l->metres));
    if (sheet->vertex_source)
        rg_fold_put_source(&j, "rigami:vertices_source", sheet->vertex_source, sheet->nv, sheet->nv);
    if (sheet->edge_source) rg_fold_put_source(&j, "rigami:edges_source", sheet->edge_source, sheet->ne, sheet->ne);
    *lost = rg_fold_put_rest(&j, l->frame, sheet, OURS);
    rg_json_close(&j);
    if (s == RG_OK) return rg_file_commit(&f, why);
    rg_file_abandon(&f);
    return s;
}
