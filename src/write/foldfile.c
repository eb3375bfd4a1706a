#include "write/foldfile.h"
#include "base/json.h"
#include "motion/ending.h"
#include "base/number.h"
#include "base/unit.h"
#include "pattern/source.h"
#include "read/value.h"
#include "render/picture.h"
#include "save/fold.h"

#include <string.h>

static void strings(rg_json *j, const char *key, const char *a, const char *b)
{
    rg_json_open_line(j, key, '[');
    rg_json_string(j, NULL, a);
    if (b) rg_json_string(j, NULL, b);
    rg_json_close(j);
}

static void head(rg_json *j, const rg_motion *m)
{
    rg_json_number(j, "file_spec", 1.2);
    rg_json_string(j, "file_creator", "rigami " RG_VERSION);
    if (m->title && *m->title) rg_json_string(j, "file_title", m->title);
    if (m->author && *m->author) rg_json_string(j, "file_author", m->author);
    if (m->source.memo) rg_json_string(j, "file_description", m->source.memo);
    strings(j, "file_classes", "singleModel", "animation");
    if (!rg_value_get(m->source.frame, "frame_title")) rg_json_string(j, "frame_title", "crease pattern");
    const char *unit = rg_unit_name(m->report.pattern->unit);
    if (unit && !rg_value_get(m->source.frame, "frame_unit")) rg_json_string(j, "frame_unit", unit);
    strings(j, "frame_classes", "creasePattern", NULL);
    strings(j, "frame_attributes", "2D", "orientable");
}

static void coords2(rg_json *j, const char *key, const rg_vec2 *X, int32_t n)
{
    rg_json_open(j, key, '[');
    for (int32_t v = 0; v < n; v++) rg_json_numbers(j, NULL, (const double[]){X[v].x, X[v].y}, 2);
    rg_json_close(j);
}

static void coords3(rg_json *j, const rg_vec3 *x, int32_t n)
{
    rg_json_open(j, "vertices_coords", '[');
    for (int32_t v = 0; v < n; v++) rg_json_numbers(j, NULL, (const double[]){x[v].x, x[v].y, x[v].z}, 3);
    rg_json_close(j);
}

static void edges(rg_json *j, const rg_mesh *m)
{
    rg_json_open(j, "edges_vertices", '[');
    for (int32_t e = 0; e < m->ne; e++) rg_json_integers(j, NULL, m->edge[e], 2);
    rg_json_close(j);
    rg_json_open_line(j, "edges_assignment", '[');
    for (int32_t e = 0; e < m->ne; e++) rg_json_string(j, NULL, (const char[]){m->assignment[e], 0});
    rg_json_close(j);
    /* Border, flat and undecided edges have 0 in FOLD. */
    rg_json_open_line(j, "edges_foldAngle", '[');
    for (int32_t e = 0; e < m->ne; e++) {
        const int folds = m->assignment[e] == RG_MOUNTAIN ||
                          m->assignment[e] == RG_VALLEY; /* free where nothing says how far: null */
        rg_json_number(j, NULL,
                       m->edge_crease[e] < 0 || (isnan(m->target[e]) && !folds) ? 0 : rg_number_degrees(m->target[e]));
    }
    rg_json_close(j);
}

static void lists(rg_json *j, const char *key, const rg_mesh *m, const int32_t *of)
{
    rg_json_open(j, key, '[');
    for (int32_t f = 0; f < m->nf; f++)
        rg_json_integers(j, NULL, of + m->facet_start[f], m->facet_start[f + 1] - m->facet_start[f]);
    rg_json_close(j);
}

static void key_frame(rg_json *j, const rg_mesh *m)
{
    coords2(j, "vertices_coords", m->X, m->nv);
    edges(j, m);
    lists(j, "faces_vertices", m, m->facet_vertex);
    lists(j, "faces_edges", m, m->facet_edge);
    if (m->added == 0) return;
    rg_json_open_line(j, "rigami:edges_added", '[');
    for (int32_t e = 0; e < m->ne; e++) rg_json_bool(j, NULL, m->edge_crease[e] >= m->N - m->added);
    rg_json_close(j);
}

/* Of the facets of this file, which may be parts of those that the layers know. */
static void face_orders(rg_json *j, const rg_layers *l)
{
    const rg_flat *f = &l->flat;
    rg_json_open(j, "faceOrders", '[');
    for (int32_t i = 0; i < l->pairs.count; i++) {
        const int32_t low = l->pairs.facet[i][0], high = l->pairs.facet[i][1];
        for (int32_t a = f->part_start[low]; a < f->part_start[low + 1]; a++)
            for (int32_t b = f->part_start[high]; b < f->part_start[high + 1]; b++) {
                const int above = rg_layers_above_of_mesh(l, f->part[a], f->part[b]);
                /* On which side of `low` the other one lies, by the normal of `low`. */
                if (above) rg_json_integers(j, NULL, (const int32_t[]){f->part[b], f->part[a], above * f->up[low]}, 3);
            }
    }
    rg_json_close(j);
}

/* Whether n things of ours are the `there` of the file, under the same numbers; `known` of them have a source. */
static int same_numbers(const int32_t *source, int32_t known, int32_t n, size_t there)
{
    int same = source && (size_t)n == there && known == n;
    for (int32_t i = 0; same && i < n; i++) same = source[i] == i;
    return same;
}

/* Their numbers in the file, where those are others. */
static void sources(rg_json *j, const char *key, const int32_t *source, int32_t known, int32_t n, size_t there)
{
    if (source && !same_numbers(source, known, n, there)) rg_fold_put_source(j, key, source, known, n);
}

/* What else the file that was read says, and which of its vertices, edges and faces ours are. */
static rg_status rest(rg_json *j, const rg_motion *m)
{
    static const char *const ours[] = {"file_spec",
                                       "file_creator",
                                       "file_author",
                                       "file_title",
                                       "file_description",
                                       "file_classes",
                                       "file_frames",
                                       "frame_classes",
                                       "frame_attributes",
                                       "frame_parent",
                                       "frame_inherit",
                                       "vertices_coords",
                                       "edges_vertices",
                                       "edges_assignment",
                                       "edges_foldAngle",
                                       "edges_foldAngles",
                                       "edges_faces",
                                       "faces_vertices",
                                       "faces_edges",
                                       "faceOrders",
                                       "rigami:edges_added",
                                       "rigami:vertices_source",
                                       "rigami:edges_source",
                                       "rigami:faces_source",
                                       NULL};
    const rg_source *s = &m->source;
    const rg_mesh *mesh = &m->mesh;
    if (!s->frame) return RG_OK;
    int32_t *face = rg_mem_array(&m->mem, (size_t)mesh->nf, sizeof *face);
    if (!face) return RG_ENOMEM;
    const rg_status status = rg_source_faces(s, mesh->nf, mesh->facet_start, mesh->facet_vertex, face);
    const size_t vertices = rg_value_count(rg_value_get(s->frame, "vertices_coords")), edges = (size_t)s->lines;
    const size_t faces = rg_value_count(rg_value_get(s->frame, "faces_vertices"));
    if (status == RG_OK) {
        const int has_edges = rg_value_count(rg_value_get(s->frame, "edges_vertices")) > 0;
        const rg_fold_sheet sheet = {.nv = mesh->nv, .ne = mesh->ne, .nf = mesh->nf,
                                     .same_vertices = same_numbers(s->vertex, s->nv, mesh->nv, vertices),
                                     .same_edges = has_edges && same_numbers(s->edge, s->ne, mesh->ne, edges),
                                     .same_faces = same_numbers(face, mesh->nf, mesh->nf, faces)};
        sources(j, "rigami:vertices_source", s->vertex, s->nv, mesh->nv, vertices);
        if (has_edges) sources(j, "rigami:edges_source", s->edge, s->ne, mesh->ne, edges);
        if (faces) sources(j, "rigami:faces_source", face, mesh->nf, mesh->nf, faces);
        rg_fold_put_rest(j, s->frame, &sheet, ours);
    }
    rg_mem_free(&m->mem, face);
    return status;
}

/* Where vertices are, by which angles, and on which pattern, where that is not the one given. */
static void state(rg_json *j, const rg_mesh *mesh, const rg_motion_state *s, const rg_vec3 *x)
{
    coords3(j, x, mesh->nv);
    rg_json_open_line(j, "edges_foldAngle", '[');
    for (int32_t e = 0; e < mesh->ne; e++) {
        const int32_t i = mesh->edge_crease[e];
        rg_json_number(j, NULL, i < 0 ? 0 : rg_number_degrees(s->rho[i]));
    }
    rg_json_close(j);
    if (memcmp(s->X, mesh->X, (size_t)mesh->nv * sizeof *s->X) != 0)
        coords2(j, "rigami:vertices_flatCoords", s->X, mesh->nv);
}

/* States number *k ... after a frame, up to the next one; as in rg_motion_state_at. Most frames have none. */
static rg_status between(rg_json *j, const rg_motion *m, int32_t frame, int32_t *k, int32_t *gaps, rg_vec3 *x)
{
    rg_place *place = NULL;
    for (; *gaps < m->gaps.count && m->gaps.after[*gaps] == frame; ++*k) {
        const rg_motion_state s = rg_motion_state_at(m, *k, gaps);
        if (!place) {
            place = rg_mem_array(&m->mem, (size_t)m->mesh.nf, sizeof *place);
            if (!place) return RG_ENOMEM;
            rg_json_open(j, "rigami:between", '[');
        }
        rg_pose_facets(&m->mesh, s.X, &m->tree, s.rho, place);
        rg_pose_vertices(&m->mesh, s.X, &m->tree, place, x);
        rg_json_open(j, NULL, '{');
        state(j, &m->mesh, &s, x);
        rg_json_close(j);
    }
    if (place) rg_json_close(j);
    rg_mem_free(&m->mem, place);
    return RG_OK;
}

/* The frame that is state *k, and the states up to the next frame. */
static rg_status one_frame(rg_json *j, const rg_motion *m, int32_t *k, int32_t *gaps, rg_vec3 *x)
{
    const rg_motion_state s = rg_motion_state_at(m, (*k)++, gaps);
    rg_json_open(j, NULL, '{');
    rg_json_integer(j, "frame_parent", 0);
    rg_json_bool(j, "frame_inherit", 1);
    strings(j, "frame_classes", "foldedForm", NULL);
    strings(j, "frame_attributes", "3D", "orientable");
    rg_json_number(j, "rigami:percent", rg_number_tidy(m->frame[s.frame].percent));
    rg_json_number(j, "rigami:closure_residual", m->frame[s.frame].closure_residual);
    state(j, &m->mesh, &s, x);
    const rg_layers *layers = rg_ending_layers(m, s.frame);
    if (layers) face_orders(j, layers);
    const rg_status status = between(j, m, s.frame, k, gaps, x);
    rg_json_close(j);
    return status;
}

rg_status rg_foldfile_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame;
    rg_json j;
    rg_status s = RG_OK;
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    if (!x) return RG_ENOMEM;
    rg_json_begin(&j, out);
    rg_json_open(&j, NULL, '{');
    head(&j, m);
    key_frame(&j, &m->mesh);
    s = rest(&j, m);
    rg_json_open(&j, "file_frames", '[');
    int32_t gaps = 0;
    for (int32_t k = 0; s == RG_OK && k < rg_motion_states(m);) {
        s = rg_picture_ended(p, (double)k / rg_motion_states(m)) ? RG_ECANCELLED : rg_motion_place(m, k - gaps, x);
        if (s == RG_OK) s = one_frame(&j, m, &k, &gaps, x);
    }
    rg_json_close(&j);
    rg_json_close(&j);
    rg_mem_free(&m->mem, x);
    return s;
}
