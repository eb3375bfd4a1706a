#include "write/foldfile.h"
#include "base/json.h"
#include "motion/ending.h"

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
    strings(j, "file_classes", "singleModel", "animation");
    rg_json_string(j, "frame_title", "crease pattern");
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
    for (int32_t e = 0; e < m->ne; e++)
        rg_json_number(j, NULL, m->edge_crease[e] < 0 || isnan(m->target[e]) ? 0 : m->target[e] / RG_DEG);
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

static void one_frame(rg_json *j, const rg_motion *m, int32_t k, const rg_vec3 *x)
{
    const rg_mesh *mesh = &m->mesh;
    const rg_vec2 *X = rg_motion_pattern(m, k);
    const double *rho = rg_motion_angles(m, k);
    rg_json_open(j, NULL, '{');
    rg_json_integer(j, "frame_parent", 0);
    rg_json_bool(j, "frame_inherit", 1);
    strings(j, "frame_classes", "foldedForm", NULL);
    strings(j, "frame_attributes", "3D", "orientable");
    rg_json_number(j, "rigami:percent", m->frame[k].percent);
    rg_json_number(j, "rigami:closure_residual", m->frame[k].closure_residual);
    coords3(j, x, mesh->nv);
    rg_json_open_line(j, "edges_foldAngle", '[');
    for (int32_t e = 0; e < mesh->ne; e++) {
        const int32_t i = mesh->edge_crease[e];
        rg_json_number(j, NULL, i < 0 ? 0 : rho[i] / RG_DEG);
    }
    rg_json_close(j);
    const rg_layers *layers = rg_ending_layers(m, k);
    if (layers) face_orders(j, layers);
    if (memcmp(X, mesh->X, (size_t)mesh->nv * sizeof *X) != 0) coords2(j, "rigami:vertices_flatCoords", X, mesh->nv);
    rg_json_close(j);
}

rg_status rg_foldfile_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame, (void)p;
    rg_json j;
    rg_status s = RG_OK;
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    if (!x) return RG_ENOMEM;
    rg_json_begin(&j, out);
    rg_json_open(&j, NULL, '{');
    head(&j, m);
    key_frame(&j, &m->mesh);
    rg_json_open(&j, "file_frames", '[');
    for (int32_t k = 0; s == RG_OK && k < m->report.frame_count; k++) {
        s = rg_motion_place(m, k, x);
        if (s == RG_OK) one_frame(&j, m, k, x);
    }
    rg_json_close(&j);
    rg_json_close(&j);
    rg_mem_free(&m->mem, x);
    return s;
}
